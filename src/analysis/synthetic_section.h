// SPDX-License-Identifier: Apache-2.0
// Sections with cracks drawn by hand, on which the analysis is calibrated: the tests and the manual use them, runs do not.
#pragma once

#include "analysis/failure_cause.h"
#include "analysis/point_grid.h"
#include "analysis/section_points.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace brisance::analysis::synthetic {

inline void add_particle(SectionPoints& points, double x, double y, double size) {
    points.x.push_back(x);
    points.y.push_back(y);
    points.size.push_back(size);
    points.damage.push_back(0);
    points.cause.push_back(static_cast<std::uint8_t>(Cause::none));
}

/// Deterministic noise in -1 ... 1 (splitmix64).
inline double noise(std::uint64_t& state) {
    std::uint64_t z = (state += 0x9e3779b97f4a7c15ULL);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1.0p-52 - 1;
}

/// Intact square lattice between two radii, mm, turned by `angle`, rad; each particle moved by up to jitter * spacing in x and y.
inline SectionPoints lattice(double inner, double outer, double spacing, double angle = 0, double jitter = 0, std::uint64_t seed = 1) {
    SectionPoints points;
    const int n = static_cast<int>(outer / spacing) + 2;
    for (int i = -n; i <= n; ++i)
        for (int j = -n; j <= n; ++j) {
            const double u = spacing * (i + jitter * noise(seed)), v = spacing * (j + jitter * noise(seed));
            const double x = u * std::cos(angle) - v * std::sin(angle), y = u * std::sin(angle) + v * std::cos(angle);
            if (const double r = std::hypot(x, y); r >= inner && r <= outer) add_particle(points, x, y, spacing);
        }
    return points;
}

/// Intact rings between two radii, mm, whose spacing grows from `fine` at the inner to `coarse` at the outer one; each ring starts at
/// an azimuth of its own.
inline SectionPoints graded_rings(double inner, double outer, double fine, double coarse, std::uint64_t seed = 1) {
    SectionPoints points;
    for (double r = inner; r < outer;) {
        const double spacing = fine + (coarse - fine) * (r - inner) / (outer - inner);
        const double middle = r + spacing / 2;
        const int n = std::max(1, static_cast<int>(std::lround(2 * std::numbers::pi * middle / spacing)));
        const double start = noise(seed);
        for (int k = 0; k < n; ++k) {
            const double azimuth = start + 2 * std::numbers::pi * k / n;
            add_particle(points, middle * std::cos(azimuth), middle * std::sin(azimuth),
                         std::sqrt(2 * std::numbers::pi * middle * spacing / n));
        }
        r += spacing;
    }
    return points;
}

inline void damage_one(SectionPoints& points, std::size_t i, double damage = 1, Cause cause = Cause::tensile) {
    points.damage[i] = damage;
    points.cause[i] = static_cast<std::uint8_t>(cause);
}

/// Breaks the particles where inside(i) holds.
template <class Inside>
void damage_where(SectionPoints& points, Inside inside, double damage = 1, Cause cause = Cause::tensile) {
    for (std::size_t i = 0; i < points.count(); ++i)
        if (inside(i)) damage_one(points, i, damage, cause);
}

/// Breaks the particles within width / 2 of the straight line from (x_0, y_0) to (x_1, y_1), mm; the ends are cut square.
inline void draw_line(SectionPoints& points, double x_0, double y_0, double x_1, double y_1, double width, double damage = 1) {
    const double length = std::hypot(x_1 - x_0, y_1 - y_0), c = (x_1 - x_0) / length, s = (y_1 - y_0) / length;
    damage_where(points, [&](std::size_t i) {
        const double along = (points.x[i] - x_0) * c + (points.y[i] - y_0) * s;
        const double across = -(points.x[i] - x_0) * s + (points.y[i] - y_0) * c;
        return along >= 0 && along < length && across >= -width / 2 && across < width / 2;
    }, damage);
}

/// Breaks each particle whose Voronoi cell the straight line crosses: the thinnest crack without gaps.
inline void draw_thin_line(SectionPoints& points, double x_0, double y_0, double x_1, double y_1, double damage = 1) {
    const double finest = *std::min_element(points.size.begin(), points.size.end());
    const PointGrid grid(points.x, points.y, 2 * finest);
    const int steps = 1 + static_cast<int>(20 * std::hypot(x_1 - x_0, y_1 - y_0) / finest);
    const double reach = 1.5 * *std::max_element(points.size.begin(), points.size.end());
    for (int k = 0; k <= steps; ++k) {
        const double x = x_0 + (x_1 - x_0) * k / steps, y = y_0 + (y_1 - y_0) * k / steps;
        double nearest = reach;
        std::size_t hit = points.count();
        grid.near(x, y, reach, [&](std::size_t j) {
            if (const double d = std::hypot(points.x[j] - x, points.y[j] - y); d < nearest) nearest = d, hit = j;
        });
        if (hit < points.count()) damage_one(points, hit, damage);
    }
}

}  // namespace brisance::analysis::synthetic
