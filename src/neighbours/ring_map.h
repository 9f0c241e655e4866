// SPDX-License-Identifier: Apache-2.0
// How far every cell of a grid is from the next one that holds points: one look tells most particles that nothing is near them.
#pragma once

#include "math/vec.h"
#include "neighbours/cell_grid.h"

namespace brisance {

/// The map as kernels take it. Rings of cells around a cell: 0 where it holds points itself, 1 where one of its 26 neighbours does, ...
struct RingMapView {
    CellGridView grid;
    const std::uint8_t* rings = nullptr;  ///< null: there is none

    /// A lower bound of the distance from p to the grid's points, mm; no more than the map is deep. Where the grid is periodic it is one
    /// as far as the grid's images reach.
    BRISANCE_HD double bound(const Vec3<double>& p) const {
        if (!rings) return 0;
        const int ring = rings[grid.row(grid.place(p.y, 1), grid.place(p.z, 2)) + grid.place(p.x, 0)];
        return ring > 1 ? (ring - 1) * grid.cell : 0.0;
    }
};

class RingMap {
public:
    /// Looks `depth` rings far; cells that have nothing within them get depth + 1. With a depth of 0, and of a sparse grid, there is
    /// no map, and every bound is 0.
    void build(const CellGridView& grid, int depth);
    const RingMapView& view() const { return view_; }

private:
    RingMapView view_;
    Array<std::uint8_t> rings_, between_;
};

}  // namespace brisance
