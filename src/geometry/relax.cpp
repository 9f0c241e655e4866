// SPDX-License-Identifier: Apache-2.0
#include "geometry/relax.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace brisance {
namespace {

using Motion = Relaxing::Motion;


/// A list of pairs that reaches too far by a skin, and renews itself when some point has moved by half of that.
class LastingPairs {
public:
    /// range and skin in spacings
    LastingPairs(Relaxing& cloud, const Section& section, double range, double skin)
        : cloud_(cloud), section_(section), range_(range), skin_(skin) {
        renew();
    }

    /// `moved`: the largest step of any point, in spacings.
    void advance(double moved) {
        moved_ += moved;
        if (2 * moved_ > skin_) renew();
    }
    const Pairs& get() const { return pairs_; }

private:
    void renew() {
#pragma omp parallel for schedule(static) if (cloud_.points.size() > worth_threads)
        for (std::size_t i = 0; i < cloud_.points.size(); ++i) cloud_.spacing[i] = section_.spacing(cloud_.points[i]);
        pairs_ = find_pairs(cloud_.points, cloud_.spacing, range_ + skin_);
        moved_ = 0;
    }

    Relaxing& cloud_;
    const Section& section_;
    double range_, skin_, moved_ = 0;
    Pairs pairs_;
};

/// Moves the points and returns the largest step in spacings. A free point that may have come too near to the wall is looked at,
/// and put back to the least depth; walls[i].depth is a depth it has at least.
double move(Relaxing& cloud, const Section& section, const std::vector<Vec2>& steps) {
    double largest = 0;
#pragma omp parallel for schedule(static) reduction(max : largest) if (cloud.points.size() > worth_threads)
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
        if (cloud.motion[i] == Motion::fixed) continue;
        const double spacing = cloud.spacing[i];
        Vec2& p = cloud.points[i];
        WallView& wall = cloud.walls[i];
        const Vec2 old = p;
        if (cloud.motion[i] == Motion::along_wall) {
            p = p + steps[i] - dot(steps[i], wall.normal) * wall.normal;
            wall.normal = section.normal(p);
            p = p + (section.depth(p) - wall.depth) * wall.normal;
        } else {
            p = p + steps[i];
            wall.depth -= norm(steps[i]);
            const double least = cloud.least_depth * spacing;
            if (wall.depth < least) {
                wall.depth = section.depth(p);
                if (wall.depth < least) {
                    const Vec2 deeper = p + (wall.depth - least) * section.normal(p);
                    const double depth = section.depth(deeper);
                    p = depth > wall.depth ? deeper : old;  // where the section is too thin for that, stay
                    wall.depth = std::max(depth, wall.depth);
                }
            }
        }
        largest = std::max(largest, norm(p - old) / spacing);
    }
    return largest;
}

/// The cubic spline in the plane: g = w xi with w = -W'(R) / R, and its derivative dg/dxi = w I + slope xi xi^T.
/// Without branches, so that loops over neighbours become vector code.
struct Kernel {
    double w, slope;

    Kernel(double r2, double h) {
        const double q2 = std::max(r2 / (h * h), 1e-24), q = std::sqrt(q2);
        const double t = std::max(2 - q, 0.0);
        const double scale = 10 / (7 * std::numbers::pi) / (h * h * h * h);
        w = scale * (q < 1 ? 3 - 2.25 * q : 0.75 * t * t / q);
        slope = -scale / (h * h) * (q < 1 ? 2.25 / q : 0.75 * t * (2 + q) / (q2 * q));
    }
};

struct Sym2 {
    double xx = 0, yy = 0, xy = 0;
};

/// K^-1 of each point. A point with fewer than two neighbours has no gradient, and gets 0.
std::vector<Sym2> corrections(const std::vector<Vec2>& points, const std::vector<double>& spacing, const std::vector<double>& area,
                              const Pairs& pairs, double smoothing) {
    std::vector<Sym2> inverse(points.size());
#pragma omp parallel for schedule(static) if (points.size() > worth_threads)
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto neighbours = pairs.of(i);
        double xx = 0, yy = 0, xy = 0;
#pragma omp simd reduction(+ : xx, yy, xy)
        for (std::size_t k = 0; k < neighbours.size(); ++k) {
            const std::size_t j = neighbours[k];
            const double x = points[j].x - points[i].x, y = points[j].y - points[i].y;
            const double w = area[j] * Kernel(x * x + y * y, 0.5 * smoothing * (spacing[i] + spacing[j])).w;
            xx += w * x * x;
            yy += w * y * y;
            xy += w * x * y;
        }
        const double det = xx * yy - xy * xy;
        if (det > 1e-6) inverse[i] = {yy / det, xx / det, -xy / det};
    }
    return inverse;
}

std::vector<Vec2> zeroth_order_error(const std::vector<Vec2>& points, const std::vector<double>& spacing,
                                     const std::vector<double>& area, const std::vector<Sym2>& inverse, const Pairs& pairs,
                                     double smoothing) {
    std::vector<Vec2> error(points.size());
#pragma omp parallel for schedule(static) if (points.size() > worth_threads)
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto neighbours = pairs.of(i);
        const Sym2 a = inverse[i];
        double ex = 0, ey = 0;
#pragma omp simd reduction(+ : ex, ey)
        for (std::size_t k = 0; k < neighbours.size(); ++k) {
            const std::size_t j = neighbours[k];
            const double x = points[j].x - points[i].x, y = points[j].y - points[i].y;
            const double w = area[j] * Kernel(x * x + y * y, 0.5 * smoothing * (spacing[i] + spacing[j])).w;
            ex += w * ((a.xx + inverse[j].xx) * x + (a.xy + inverse[j].xy) * y);
            ey += w * ((a.xy + inverse[j].xy) * x + (a.yy + inverse[j].yy) * y);
        }
        error[i] = {ex, ey};
    }
    return error;
}

}  // namespace

void view_walls(Relaxing& cloud, const Section& section) {
#pragma omp parallel for schedule(static) if (cloud.points.size() > worth_threads)
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
        cloud.walls[i] = {section.depth(cloud.points[i]), section.normal(cloud.points[i])};
    }
}

void repel(Relaxing& cloud, const Section& section, int steps) {
    constexpr double range = 2;
    LastingPairs pairs(cloud, section, range, 0.4);
    std::vector<Vec2> step(cloud.points.size());
    for (int s = 0; s < steps; ++s) {
#pragma omp parallel for schedule(static) if (cloud.points.size() > worth_threads)
        for (std::size_t i = 0; i < cloud.points.size(); ++i) {
            if (cloud.motion[i] != Motion::free) continue;
            const Vec2 p = cloud.points[i];
            const auto neighbours = pairs.get().of(i);
            double x = 0, y = 0;
#pragma omp simd reduction(+ : x, y)
            for (std::size_t k = 0; k < neighbours.size(); ++k) {
                const std::size_t j = neighbours[k];
                const double dx = p.x - cloud.points[j].x, dy = p.y - cloud.points[j].y;
                const double r = std::sqrt(std::max(dx * dx + dy * dy, 1e-300));
                const double w = std::max(1 - r / (0.5 * range * (cloud.spacing[i] + cloud.spacing[j])), 0.0);
                x += w * w / r * dx;
                y += w * w / r * dy;
            }
            step[i] = 0.25 * cloud.spacing[i] * Vec2{x, y};
        }
        pairs.advance(move(cloud, section, step));
    }
}

std::vector<Vec2> zeroth_order_error(const std::vector<Vec2>& points, const std::vector<double>& spacing,
                                     const std::vector<double>& area, const Pairs& pairs, double smoothing) {
    return zeroth_order_error(points, spacing, area, corrections(points, spacing, area, pairs, smoothing), pairs, smoothing);
}

void polish(Relaxing& cloud, const Section& section, int steps, double smoothing) {
    constexpr double momentum = 0.7;  // descent with inertia; faster ones let pairs of points drift together
    const double rate = 0.15 * std::pow(std::min(smoothing / 1.3, 1.0), 8);  // the curvature of E^2 grows like h^-8
    constexpr double closest = 0.72;               // spacings: nearer pairs are held apart
    constexpr int interval = 5;                    // steps for which areas and K are kept
    const std::size_t n = cloud.points.size();
    LastingPairs pairs(cloud, section, std::max(2 * smoothing, 2.6), 0.2);

    // A wall is felt down to two supports: through the missing neighbours, and through K of neighbours that miss some.
    std::vector<Vec2> wall_normal(n);
    std::vector<bool> in_corner(n);
    for (std::size_t i = 0; i < n; ++i) {
        const double felt = 4 * smoothing * cloud.spacing[i];
        if (cloud.walls[i].depth > felt) continue;
        wall_normal[i] = cloud.walls[i].normal;
        for (const Vec2 c : cloud.corners) in_corner[i] = in_corner[i] || norm(c - cloud.points[i]) < felt;
        if (in_corner[i] && cloud.motion[i] == Motion::along_wall) cloud.motion[i] = Motion::fixed;
    }
    std::vector<double> area(n);
    std::vector<Sym2> inverse;
    std::vector<Vec2> step(n);
    for (int s = 0; s < steps; ++s) {
        if (s % interval == 0) {
            const std::vector<Cell> cells = voronoi_cells(section, cloud.points, cloud.spacing, pairs.get(), cloud.walls);
            for (std::size_t i = 0; i < n; ++i) area[i] = cells[i].area;
            inverse = corrections(cloud.points, cloud.spacing, area, pairs.get(), smoothing);
        }
        std::vector<Vec2> error = zeroth_order_error(cloud.points, cloud.spacing, area, inverse, pairs.get(), smoothing);
        for (std::size_t i = 0; i < n; ++i) {
            error[i] = in_corner[i] ? Vec2{} : error[i] - dot(error[i], wall_normal[i]) * wall_normal[i];
        }
#pragma omp parallel for schedule(static) if (n > worth_threads)
        for (std::size_t i = 0; i < n; ++i) {
            if (cloud.motion[i] == Motion::fixed) continue;
            const Vec2 p = cloud.points[i], e = error[i];
            const auto neighbours = pairs.get().of(i);
            double gx = 0, gy = 0, px = 0, py = 0;
#pragma omp simd reduction(+ : gx, gy, px, py)
            for (std::size_t k = 0; k < neighbours.size(); ++k) {
                const std::size_t j = neighbours[k];
                const double x = cloud.points[j].x - p.x, y = cloud.points[j].y - p.y;
                const double dx = error[j].x - e.x, dy = error[j].y - e.y;
                const Kernel g(x * x + y * y, 0.5 * smoothing * (cloud.spacing[i] + cloud.spacing[j]));
                const double along = g.slope * (x * dx + y * dy);
                gx += 2 * area[j] * (g.w * dx + along * x);
                gy += 2 * area[j] * (g.w * dy + along * y);
                const double r = std::sqrt(std::max(x * x + y * y, 1e-300));
                const double push = std::max(closest * 0.5 * (cloud.spacing[i] + cloud.spacing[j]) / r - 1, 0.0);
                px += push * x;
                py += push * y;
            }
            const double s2 = cloud.spacing[i] * cloud.spacing[i];
            step[i] = momentum * step[i] - rate * s2 * s2 * Vec2{gx, gy} - 0.1 * Vec2{px, py};
        }
        pairs.advance(move(cloud, section, step));
    }
}

}  // namespace brisance
