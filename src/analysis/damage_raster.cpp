// SPDX-License-Identifier: Apache-2.0
#include "analysis/damage_raster.h"

#include <algorithm>
#include <limits>

namespace brisance::analysis {

namespace {

/// Squared distances, mm2, from each pixel to its nearest particle, and to its nearest damaged one.
struct Distances {
    std::vector<float> to_any, to_damaged;
};

/// Calls visit(p, squared distance) for the pixels whose centres lie within `distance` of (x, y).
template <class Visit>
void for_pixels_near(const DamageRaster& raster, double x, double y, double distance, Visit visit) {
    const auto clip = [](double value, std::size_t n) { return static_cast<std::size_t>(std::clamp(value, 0.0, static_cast<double>(n))); };
    const std::size_t x_from = clip(std::ceil((x - distance - raster.x_0) / raster.pixel), raster.nx);
    const std::size_t x_to = clip(std::floor((x + distance - raster.x_0) / raster.pixel) + 1, raster.nx);
    const std::size_t y_from = clip(std::ceil((y - distance - raster.y_0) / raster.pixel), raster.ny);
    const std::size_t y_to = clip(std::floor((y + distance - raster.y_0) / raster.pixel) + 1, raster.ny);
    for (std::size_t iy = y_from; iy < y_to; ++iy)
        for (std::size_t ix = x_from; ix < x_to; ++ix) {
            const double dx = raster.x_0 + raster.pixel * static_cast<double>(ix) - x;
            const double dy = raster.y_0 + raster.pixel * static_cast<double>(iy) - y;
            const double squared = dx * dx + dy * dy;
            if (squared <= distance * distance) visit(iy * raster.nx + ix, squared);
        }
}

/// A picture that holds all damaged particles with a margin, still empty.
DamageRaster frame(const SectionPoints& points, const RasterOptions& options) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double x_min = infinity, x_max = -infinity, y_min = infinity, y_max = -infinity, finest = infinity;
    for (std::size_t i = 0; i < points.count(); ++i) {
        if (!points.cracked(i, options.threshold)) continue;
        x_min = std::min(x_min, points.x[i] - points.size[i]);
        x_max = std::max(x_max, points.x[i] + points.size[i]);
        y_min = std::min(y_min, points.y[i] - points.size[i]);
        y_max = std::max(y_max, points.y[i] + points.size[i]);
        finest = std::min(finest, points.size[i]);
    }
    DamageRaster raster;
    if (finest == infinity) return raster;
    constexpr double margin = 3;  // pixels
    raster.pixel = finest / std::max(2.0, options.pixels_per_size);
    raster.x_0 = x_min - margin * raster.pixel;
    raster.y_0 = y_min - margin * raster.pixel;
    raster.nx = static_cast<std::size_t>(std::ceil((x_max - x_min) / raster.pixel + 2 * margin)) + 1;
    raster.ny = static_cast<std::size_t>(std::ceil((y_max - y_min) / raster.pixel + 2 * margin)) + 1;
    raster.damaged.assign(raster.count(), 0);
    raster.owner.assign(raster.count(), -1);
    return raster;
}

Distances scatter(const SectionPoints& points, const RasterOptions& options, DamageRaster& raster) {
    constexpr float far = std::numeric_limits<float>::max();
    Distances d{std::vector<float>(raster.count(), far), std::vector<float>(raster.count(), far)};
    for (std::size_t i = 0; i < points.count(); ++i) {
        const bool cracked = points.cracked(i, options.threshold);
        // An intact particle reaches farther: it must not lose a pixel that is nearer to it to a coarser damaged one.
        const double reach = (cracked ? options.reach : std::max(1.0, options.reach)) * points.size[i];
        for_pixels_near(raster, points.x[i], points.y[i], reach, [&](std::size_t p, double squared) {
            const auto s = static_cast<float>(squared);
            if (s < d.to_any[p]) d.to_any[p] = s;
            if (cracked && s < d.to_damaged[p]) {
                d.to_damaged[p] = s;
                raster.owner[p] = static_cast<std::int32_t>(i);
            }
        });
    }
    return d;
}

/// Fills the 4-connected background regions that the picture's edge cannot reach and that are smaller than `smallest` areas of the
/// particle next to them.
void fill_small_holes(const SectionPoints& points, double smallest, DamageRaster& raster) {
    const auto step = raster.neighbours();
    Mask seen(raster.damaged);
    std::vector<std::size_t> region;
    for (std::size_t start = 0; start < raster.count(); ++start) {
        if (seen[start]) continue;
        region.assign(1, start);
        seen[start] = 1;
        bool open = false;
        std::int32_t beside = -1;
        for (std::size_t k = 0; k < region.size(); ++k) {
            const std::size_t p = region[k], ix = p % raster.nx, iy = p / raster.nx;
            const bool edge[4] = {ix + 1 == raster.nx, iy + 1 == raster.ny, ix == 0, iy == 0};  // order of the even neighbours
            for (std::size_t side = 0; side < 4; ++side) {
                if (edge[side]) {
                    open = true;
                    continue;
                }
                const std::size_t q = p + static_cast<std::size_t>(step[2 * side]);
                if (raster.damaged[q]) beside = raster.owner[q];
                if (seen[q]) continue;
                seen[q] = 1;
                region.push_back(q);
            }
        }
        if (open || beside < 0) continue;
        const double area = static_cast<double>(region.size()) * raster.pixel * raster.pixel;
        if (area >= smallest * points.area(static_cast<std::size_t>(beside))) continue;
        for (std::size_t p : region) {
            raster.damaged[p] = 1;
            raster.owner[p] = beside;
        }
    }
}

}  // namespace

bool DamageRaster::at(const Mask& mask, double px, double py) const {
    if (count() == 0) return false;
    const double ix = std::round((px - x_0) / pixel), iy = std::round((py - y_0) / pixel);
    if (ix < 0 || iy < 0 || ix >= static_cast<double>(nx) || iy >= static_cast<double>(ny)) return false;
    return mask[static_cast<std::size_t>(iy) * nx + static_cast<std::size_t>(ix)] != 0;
}

std::array<std::ptrdiff_t, 8> DamageRaster::neighbours() const {
    const auto row = static_cast<std::ptrdiff_t>(nx);
    return {1, row + 1, row, row - 1, -1, -row - 1, -row, -row + 1};
}

DamageRaster rasterise(const SectionPoints& points, const RasterOptions& options) {
    check(points);
    DamageRaster raster = frame(points, options);
    if (raster.count() == 0) return raster;
    const Distances d = scatter(points, options, raster);
    for (std::size_t p = 0; p < raster.count(); ++p) {
        if (raster.owner[p] < 0) continue;
        const double allowance = options.bridge * points.size[static_cast<std::size_t>(raster.owner[p])];
        if (std::sqrt(d.to_damaged[p]) <= std::sqrt(d.to_any[p]) + allowance) raster.damaged[p] = 1;
        else raster.owner[p] = -1;
    }
    fill_small_holes(points, options.smallest_hole, raster);
    return raster;
}

int label_components(const DamageRaster& raster, const Mask& mask, std::vector<std::int32_t>& labels) {
    labels.assign(mask.size(), 0);
    const auto step = raster.neighbours();
    std::vector<std::size_t> stack;
    std::int32_t n = 0;
    for (std::size_t start = 0; start < mask.size(); ++start) {
        if (!mask[start] || labels[start]) continue;
        labels[start] = ++n;
        stack.assign(1, start);
        while (!stack.empty()) {
            const std::size_t p = stack.back();
            stack.pop_back();
            for (std::ptrdiff_t s : step) {
                const std::size_t q = p + static_cast<std::size_t>(s);
                if (!mask[q] || labels[q]) continue;
                labels[q] = n;
                stack.push_back(q);
            }
        }
    }
    return n;
}

}  // namespace brisance::analysis
