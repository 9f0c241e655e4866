// SPDX-License-Identifier: Apache-2.0
#include "analysis/distance_map.h"

#include <cmath>
#include <limits>

namespace brisance::analysis {

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

/// The lower envelope of the parabolas f(q) + (p - q)^2 of one line of pixels.
class Envelope {
public:
    explicit Envelope(std::size_t longest) : height_(longest), where_(longest), from_(longest + 1) {}

    /// line: n squared distances, `step` apart; replaced by min over q of line[q] + (p - q)^2.
    void transform(float* line, std::size_t n, std::size_t step) {
        std::size_t count = 0;
        for (std::size_t q = 0; q < n; ++q) {
            const double f = line[q * step];
            if (!(f < infinity)) continue;
            const auto x = static_cast<double>(q);
            double start = -std::numeric_limits<double>::infinity();
            for (; count > 0; --count) {
                start = (f + x * x - height_[count - 1] - where_[count - 1] * where_[count - 1]) / (2 * (x - where_[count - 1]));
                if (start > from_[count - 1]) break;
                start = -std::numeric_limits<double>::infinity();
            }
            height_[count] = f;
            where_[count] = x;
            from_[count] = start;
            ++count;
        }
        if (count == 0) return;
        from_[count] = std::numeric_limits<double>::infinity();
        for (std::size_t p = 0, k = 0; p < n; ++p) {
            const auto x = static_cast<double>(p);
            while (from_[k + 1] < x) ++k;
            line[p * step] = static_cast<float>(height_[k] + (x - where_[k]) * (x - where_[k]));
        }
    }

private:
    std::vector<double> height_, where_, from_;
};

}  // namespace

std::vector<float> distance_to_unset(const DamageRaster& raster, const Mask& mask) {
    std::vector<float> d(mask.size());
    for (std::size_t p = 0; p < d.size(); ++p) d[p] = mask[p] ? infinity : 0.0F;
    Envelope envelope(raster.nx > raster.ny ? raster.nx : raster.ny);
    for (std::size_t x = 0; x < raster.nx; ++x) envelope.transform(&d[x], raster.ny, raster.nx);
    for (std::size_t y = 0; y < raster.ny; ++y) envelope.transform(&d[y * raster.nx], raster.nx, 1);
    for (float& v : d) v = std::sqrt(v);
    return d;
}

}  // namespace brisance::analysis
