// SPDX-License-Identifier: Apache-2.0
// A body-fitted, relaxed cloud of points in a plane region: the section of a part, one point for each column of particles.
#pragma once

#include "math/vec.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace brisance {

/// A region of the x-y plane.
struct Region {
    std::function<double(Vec2)> distance;  ///< signed distance to the boundary, mm, negative inside
    Vec2 min, max;                         ///< a box that holds the region
};

enum class Arrangement {
    relaxed,  ///< rings along the walls, relaxed blue noise elsewhere: no preferred direction
    lattice   ///< square lattice, rotated by `angle`: for tests, and to show its bias
};

struct CloudOptions {
    Arrangement arrangement = Arrangement::relaxed;
    std::function<double(Vec2)> spacing;  ///< wanted distance between points, mm
    std::uint64_t seed = 1;
    double angle = 0;       ///< rad, rotates the arrangement: the lattice, or for `relaxed` the pattern of start points
    int wall_layers = 2;    ///< layers of points that follow each wall
    int relax_steps = 120;  ///< repulsive relaxation
    int polish_steps = 60;  ///< reduction of the zeroth-order error of the corrected gradient
    double smoothing = 1.3; ///< h / spacing, for the polish
};

struct Cloud {
    std::vector<Vec2> points;
    std::vector<double> area;           ///< mm2; sums to the area of the region
    std::vector<double> wall_distance;  ///< distance to the nearest wall, mm, positive
    std::vector<Vec2> wall_normal;      ///< outward unit normal of the nearest wall
    std::vector<int> wall_layer;        ///< 0 for the first layer at a wall, 1, ...; -1 inside the cloud
};

/// Fills a region with points. The same region, options and seed give the same bits, with any number of threads.
/// Throws InputError where the region is empty or thinner than half a spacing.
Cloud fill(const Region& region, const CloudOptions& options);

/// The area of a region, by quadrature along scan lines with located crossings; relative error below 1e-5.
double area(const Region& region);

}  // namespace brisance
