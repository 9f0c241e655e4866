// SPDX-License-Identifier: Apache-2.0
// What the fracture analysis works on: a cut through the specimen normal to z, one entry for each column of particles it meets.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace brisance::analysis {

/// All vectors hold one value per particle of the section. Reference coordinates relative to the borehole axis.
struct SectionPoints {
    std::vector<double> x, y;          ///< mm
    std::vector<double> size;          ///< mm, square root of the area that the particle stands for: L_i of Eq. 12
    std::vector<double> damage;        ///< D_i, 0 ... 1
    std::vector<std::uint8_t> cause;   ///< a Cause (failure_cause.h)

    std::size_t count() const { return x.size(); }
    double radius(std::size_t i) const { return std::hypot(x[i], y[i]); }
    double azimuth(std::size_t i) const { return std::atan2(y[i], x[i]); }
    double area(std::size_t i) const { return size[i] * size[i]; }
    /// "any particle with D > 0.8 is considered crack" (text under Eq. 12). The text above Eq. 13 has D >= 0.8; one rule serves both.
    bool cracked(std::size_t i, double threshold) const { return damage[i] > threshold; }
};

/// Throws std::invalid_argument where the columns differ in length, or a size is not positive.
inline void check(const SectionPoints& points) {
    const std::size_t n = points.count();
    if (points.y.size() != n || points.size.size() != n || points.damage.size() != n || points.cause.size() != n)
        throw std::invalid_argument("section points: columns of different length");
    for (double s : points.size)
        if (!(s > 0)) throw std::invalid_argument("section points: a size that is not positive");
}

/// The sector, 0 ... sectors - 1, of an azimuth in rad; sector 0 begins at the x axis, and they follow anticlockwise.
inline int sector_of(double azimuth, int sectors) {
    const double turn = azimuth / (2 * std::numbers::pi);
    const int k = static_cast<int>((turn - std::floor(turn)) * sectors);
    return k < sectors ? k : 0;
}

}  // namespace brisance::analysis
