// SPDX-License-Identifier: Apache-2.0
#include "analysis/thinning.h"

#include <algorithm>

namespace brisance::analysis {

namespace {

/// The eight neighbours of a pixel, in the names of the paper: p2 north, then clockwise to p9 north-west.
struct Neighbourhood {
    bool p2, p3, p4, p5, p6, p7, p8, p9;

    Neighbourhood(const Mask& m, std::size_t p, std::size_t nx)
        : p2(m[p + nx]), p3(m[p + nx + 1]), p4(m[p + 1]), p5(m[p - nx + 1]), p6(m[p - nx]), p7(m[p - nx - 1]), p8(m[p - 1]),
          p9(m[p + nx - 1]) {}

    int count() const { return p2 + p3 + p4 + p5 + p6 + p7 + p8 + p9; }
    /// Number of separate 8-connected runs of set neighbours. One: the pixel may go without cutting or opening anything.
    int runs() const { return (!p2 && (p3 || p4)) + (!p4 && (p5 || p6)) + (!p6 && (p7 || p8)) + (!p8 && (p9 || p2)); }
    /// The smaller number of pairs with a set pixel in the two ways to pair up the ring: an end of a line has one, a flat edge more.
    int pairs() const {
        const int one = (p9 || p2) + (p3 || p4) + (p5 || p6) + (p7 || p8);
        const int two = (p2 || p3) + (p4 || p5) + (p6 || p7) + (p8 || p9);
        return one < two ? one : two;
    }
    bool goes(int sub_iteration) const {
        if (runs() != 1 || pairs() < 2 || pairs() > 3) return false;
        return sub_iteration == 0 ? !((p2 || p3 || !p5) && p4) : !((p6 || p7 || !p9) && p8);
    }
};

}  // namespace

Mask thin(const DamageRaster& raster, const Mask& mask, const std::vector<float>& depth) {
    constexpr float layer = 0.5F;  // pixels
    Mask m = mask;
    const auto step = raster.neighbours();
    std::vector<std::size_t> edge, gone;
    Mask listed(m.size(), 0);
    const auto list = [&](std::size_t p) {
        if (listed[p]) return;
        listed[p] = 1;
        edge.push_back(p);
    };
    for (std::size_t p = 0; p < m.size(); ++p) {
        if (!m[p]) continue;
        bool inside = true;
        for (std::ptrdiff_t s : step) inside = inside && m[p + static_cast<std::size_t>(s)];
        if (!inside) list(p);
    }
    const float deepest = m.empty() ? 0 : *std::max_element(depth.begin(), depth.end());
    for (float level = 1; level < deepest + layer; level += layer) {
        int idle = 0;
        for (int sub = 0; idle < 2; sub = 1 - sub) {
            gone.clear();
            for (std::size_t p : edge)
                if (depth[p] <= level && Neighbourhood(m, p, raster.nx).goes(sub)) gone.push_back(p);
            idle = gone.empty() ? idle + 1 : 0;
            if (gone.empty()) continue;
            for (std::size_t p : gone) m[p] = 0;
            for (std::size_t p : gone)
                for (std::ptrdiff_t s : step)
                    if (const std::size_t q = p + static_cast<std::size_t>(s); m[q]) list(q);
            std::erase_if(edge, [&](std::size_t p) { return !m[p]; });
        }
    }
    tidy(raster, m);
    return m;
}

void tidy(const DamageRaster& raster, Mask& skeleton) {
    for (std::size_t p = 0; p < skeleton.size(); ++p) {
        if (!skeleton[p]) continue;
        const Neighbourhood n(skeleton, p, raster.nx);
        if (n.runs() == 1 && n.count() >= 2) skeleton[p] = 0;
    }
}

}  // namespace brisance::analysis
