// SPDX-License-Identifier: Apache-2.0
// The damaged particles of a section as a picture: a mask of pixels, as image analysis sees the face of a cut.
#pragma once

#include "analysis/section_points.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace brisance::analysis {

/// One byte per pixel, row by row in y; the outermost pixels are always 0, so that all eight neighbours of a set pixel exist.
using Mask = std::vector<std::uint8_t>;

struct DamageRaster {
    double x_0 = 0, y_0 = 0;   ///< mm, centre of pixel 0
    double pixel = 0;          ///< mm, edge of a pixel; 0 where nothing is damaged
    std::size_t nx = 0, ny = 0;
    Mask damaged;                     ///< nx * ny
    std::vector<std::int32_t> owner;  ///< nx * ny; the damaged particle that a set pixel belongs to, -1 elsewhere

    std::size_t count() const { return nx * ny; }
    double x(std::size_t p) const { return x_0 + pixel * static_cast<double>(p % nx); }
    double y(std::size_t p) const { return y_0 + pixel * static_cast<double>(p / nx); }  // NOLINT(bugprone-integer-division): the row
    double radius(std::size_t p) const { return std::hypot(x(p), y(p)); }
    /// Whether the pixel at this place is set in a mask of this raster; false outside the picture.
    bool at(const Mask& mask, double x, double y) const;
    /// Index steps to the eight neighbours, anticlockwise from +x; even entries are the four edge neighbours.
    std::array<std::ptrdiff_t, 8> neighbours() const;
};

struct RasterOptions {
    double threshold = 0.8;         ///< damaged: D > threshold
    double pixels_per_size = 3;     ///< pixels across the finest damaged particle; at least 2
    double reach = 0.75;            ///< a particle covers no pixel farther than reach * size: just beyond the corner of a square cell, 0.707
    double bridge = 0.2;            ///< a damaged particle wins a pixel up to bridge * size farther away than its nearest particle
    double smallest_hole = 4;       ///< enclosed holes below this many particle areas are filled
};

/// Rasterises D > threshold. Each pixel belongs to its nearest particle, so the cells are those of Voronoi and a graded cloud leaves
/// no gaps. Two corrections: the bridge joins damaged cells that meet in a corner only (each crack that runs along the diagonal of
/// a lattice), and holes smaller than `smallest_hole` are filled: single intact particles in a crushed zone, or loose spots of the cloud.
/// Time and memory grow as (extent of the damage / pixel)^2, 9 bytes a pixel and 8 while it is built.
DamageRaster rasterise(const SectionPoints& points, const RasterOptions& options = {});

/// Labels of the 8-connected components of a mask: 0 outside, 1 ... n; returns n.
int label_components(const DamageRaster& raster, const Mask& mask, std::vector<std::int32_t>& labels);

}  // namespace brisance::analysis
