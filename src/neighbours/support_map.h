// SPDX-License-Identifier: Apache-2.0
// How large the supports near a place are. A gas that vents has particles five times as wide as the rest: everybody would look as far as
// those reach. Blocks of cells, each with the largest support in it and around it, tell who has to.
#pragma once

#include "neighbours/cell_grid.h"

namespace brisance {

/// The map as kernels take it.
struct SupportMapView {
    CellGridView grid;
    int block = 1, n[3] = {1, 1, 1};   ///< cells of a block along an axis, and blocks
    const float* largest = nullptr;    ///< of a block and its 26 neighbours; null: there is no map
    double h_max = 0;

    BRISANCE_HD std::int64_t at(int i, int j, int k) const { return (static_cast<std::int64_t>(k) * n[1] + j) * n[0] + i; }
    /// A bound of h_j over the entries j of the grid with |x - x_j| < h + h_j, for any h up to the largest.
    BRISANCE_HD double near(double x, double y, double z) const {
        if (!largest) return h_max;
        return static_cast<double>(largest[at(grid.place(x, 0) / block, grid.place(y, 1) / block, grid.place(z, 2) / block)]);
    }
};

class SupportMap {
public:
    /// `h`: half of the supports of the grid's entries, none above h_max. Where the cells are as wide as that there is no map.
    void build(const CellGridView& grid, const float* h, double h_max);
    const SupportMapView& view() const { return view_; }

private:
    SupportMapView view_;
    Array<float> own_, largest_;
};

}  // namespace brisance
