// SPDX-License-Identifier: Apache-2.0
// From the parts of a case to columns of particles: sections by "last part wins", clouds, columns along z with their own phase.
#pragma once

#include "geometry/cloud.h"
#include "geometry/shape.h"
#include "particles/columns.h"

#include <cstdint>
#include <string>
#include <vector>

namespace brisance {

struct PlacementOptions {
    Arrangement arrangement = Arrangement::relaxed;
    double angle = 0;
    std::uint64_t seed = 1;
    double spacing = 0, spacing_far = 0, grading_radius = 0, grading_growth = 0;  ///< mm; growth per mm of distance from the axis
    double spacing_z = 0;      ///< mm
    bool z_phase = true;
    double smoothing = 1.3;
    double axis_x = 0, axis_y = 0;
    bool slice = false;        ///< periodic between z_low and z_high
    double z_low = 0, z_high = 0;
};

struct Placement {
    std::vector<Column> columns;  ///< without slots
    double dz = 0;                ///< mm; divides the height evenly
    double z_low = 0;             ///< mm
};

/// Places the columns of `part`, from which every shape in `later` is cut. Throws InputError where nothing is left.
Placement place(const Shape& part, const std::vector<ShapePtr>& later, const PlacementOptions& options);

}  // namespace brisance
