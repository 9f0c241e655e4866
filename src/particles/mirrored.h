// SPDX-License-Identifier: Apache-2.0
// The particles of a fluid and, behind them, their images in its planes of symmetry: what its neighbours and its partners in contact see.
#pragma once

#include "particles/fluid_body.h"

namespace brisance {

/// Points as kernels take them.
struct MirroredView {
    const double* place[3] = {};
    const std::int32_t* of = nullptr;  ///< null: there are no mirrors
    const double* signs[3] = {};

    /// The particle that a point stands for.
    BRISANCE_HD std::int64_t particle(std::int64_t point) const { return of ? of[point] : point; }
    /// Sign of a vector's component at a point: -1 across a mirror.
    BRISANCE_HD double sign(std::int64_t point, int axis) const { return of ? signs[axis][point] : 1.0; }
};

class Mirrored {
public:
    /// Images of the particles that are within `reach` of a plane. The body must stay where it is as long as this is used.
    void build(const FluidBody& b, double reach);

    std::int64_t size() const { return size_; }
    const MirroredView& view() const { return view_; }
    const double* place(std::size_t axis) const { return view_.place[axis]; }

private:
    bool fill(const FluidBody& b, double reach, std::int64_t room);

    MirroredView view_;
    std::int64_t size_ = 0;
    std::array<Array<double>, 3> place_, sign_;
    Array<std::int32_t> of_;
};

}  // namespace brisance
