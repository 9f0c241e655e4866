// SPDX-License-Identifier: Apache-2.0
// The particles of a fluid and, behind them, their images in its planes of symmetry: what its neighbours and its partners in contact see.
#pragma once

#include "particles/fluid_body.h"

#include <cmath>

namespace brisance {

class Mirrored {
public:
    /// Images of the particles that are within `reach` of a plane. The body must stay where it is as long as this is used.
    void build(const FluidBody& b, double reach) {
        const std::size_t n = b.mass.size();
        for (std::size_t a = 0; a < 3; ++a) at_[a] = b.x[a].data();
        size_ = n;
        of_.clear();
        if (b.mirrors.empty()) return;
        place_ = b.x;
        of_.resize(n);
        for (std::size_t i = 0; i < n; ++i) of_[i] = static_cast<std::int32_t>(i);
        for (auto& s : sign_) s.assign(n, 1.0);
        for (const Mirror& m : b.mirrors) {  // one after the other, so that corners are filled by images of images
            const auto axis = static_cast<std::size_t>(m.axis);
            const std::size_t standing = of_.size();
            for (std::size_t i = 0; i < standing; ++i) {
                if (std::abs(place_[axis][i] - m.at) > reach) continue;
                for (std::size_t a = 0; a < 3; ++a) {
                    place_[a].push_back(a == axis ? 2 * m.at - place_[a][i] : place_[a][i]);
                    sign_[a].push_back(a == axis ? -sign_[a][i] : sign_[a][i]);
                }
                of_.push_back(of_[i]);
            }
        }
        for (std::size_t a = 0; a < 3; ++a) at_[a] = place_[a].data();
        size_ = of_.size();
    }

    std::int64_t size() const { return static_cast<std::int64_t>(size_); }
    const double* place(std::size_t axis) const { return at_[axis]; }
    /// The particle that a point stands for.
    std::size_t particle(std::size_t point) const { return of_.empty() ? point : static_cast<std::size_t>(of_[point]); }
    /// Sign of a vector's component at a point: -1 across a mirror.
    double sign(std::size_t point, std::size_t axis) const { return of_.empty() ? 1.0 : sign_[axis][point]; }

private:
    std::array<const double*, 3> at_{};
    std::size_t size_ = 0;
    std::array<Array<double>, 3> place_, sign_;
    std::vector<std::int32_t> of_;
};

}  // namespace brisance
