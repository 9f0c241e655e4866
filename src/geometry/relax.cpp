// SPDX-License-Identifier: Apache-2.0
#include "geometry/relax.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace brisance {
namespace {

using Motion = Relaxing::Motion;

constexpr double skin = 0.4;  ///< spacings by which a list of pairs reaches too far, so that it lasts some steps

/// A list of pairs that renews itself when some point has moved by half the skin.
class LastingPairs {
public:
    LastingPairs(Relaxing& cloud, const Section& section, double range) : cloud_(cloud), section_(section), range_(range) { renew(); }

    /// `moved`: the largest step of any point, in spacings.
    void advance(double moved) {
        moved_ += moved;
        if (2 * moved_ > skin) renew();
    }
    const Pairs& get() const { return pairs_; }

private:
    void renew() {
#pragma omp parallel for schedule(static) if (cloud_.points.size() > worth_threads)
        for (std::size_t i = 0; i < cloud_.points.size(); ++i) cloud_.spacing[i] = section_.spacing(cloud_.points[i]);
        pairs_ = find_pairs(cloud_.points, cloud_.spacing, range_ + skin);
        moved_ = 0;
    }

    Relaxing& cloud_;
    const Section& section_;
    double range_, moved_ = 0;
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
                    p = p + (wall.depth - least) * section.normal(p);
                    wall.depth = least;
                }
            }
        }
        largest = std::max(largest, norm(p - old) / spacing);
    }
    return largest;
}

/// -W'(R) / R for the cubic spline in the plane, h of the pair.
double weight(double r2, double h) {
    const double q2 = r2 / (h * h);
    if (q2 >= 4) return 0;
    constexpr double sigma = 10 / (7 * std::numbers::pi);
    const double q = std::sqrt(q2);
    const double slope = q < 1 ? 3 - 2.25 * q : 0.75 * (2 - q) * (2 - q) / q;
    return sigma / (h * h * h * h) * slope;
}

struct Sym2 {
    double xx = 0, yy = 0, xy = 0;
};

}  // namespace

void view_walls(Relaxing& cloud, const Section& section) {
#pragma omp parallel for schedule(static) if (cloud.points.size() > worth_threads)
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
        cloud.walls[i] = {section.depth(cloud.points[i]), section.normal(cloud.points[i])};
    }
}

void repel(Relaxing& cloud, const Section& section, int steps) {
    constexpr double range = 2;
    LastingPairs pairs(cloud, section, range);
    std::vector<Vec2> step(cloud.points.size());
    for (int s = 0; s < steps; ++s) {
#pragma omp parallel for schedule(static) if (cloud.points.size() > worth_threads)
        for (std::size_t i = 0; i < cloud.points.size(); ++i) {
            if (cloud.motion[i] != Motion::free) continue;
            Vec2 sum;
            for (const std::uint32_t j : pairs.get().of(i)) {
                const Vec2 d = cloud.points[i] - cloud.points[j];
                const double r2 = dot(d, d), reach = 0.5 * range * (cloud.spacing[i] + cloud.spacing[j]);
                if (r2 >= reach * reach || r2 == 0) continue;
                const double r = std::sqrt(r2), w = 1 - r / reach;
                sum = sum + w * w / r * d;
            }
            step[i] = 0.25 * cloud.spacing[i] * sum;
        }
        pairs.advance(move(cloud, section, step));
    }
}

std::vector<Vec2> zeroth_order_error(const std::vector<Vec2>& points, const std::vector<double>& spacing,
                                     const std::vector<double>& area, const Pairs& pairs, double smoothing) {
    const std::size_t n = points.size();
    std::vector<Sym2> inverse(n);
#pragma omp parallel for schedule(static) if (n > worth_threads)
    for (std::size_t i = 0; i < n; ++i) {
        Sym2 k;
        for (const std::uint32_t j : pairs.of(i)) {
            const Vec2 xi = points[j] - points[i];
            const double w = area[j] * weight(dot(xi, xi), 0.5 * smoothing * (spacing[i] + spacing[j]));
            k.xx += w * xi.x * xi.x;
            k.yy += w * xi.y * xi.y;
            k.xy += w * xi.x * xi.y;
        }
        // A point with fewer than two neighbours has no gradient; it gets no error either.
        const double det = k.xx * k.yy - k.xy * k.xy;
        if (det > 1e-6) inverse[i] = {k.yy / det, k.xx / det, -k.xy / det};
    }
    std::vector<Vec2> error(n);
#pragma omp parallel for schedule(static) if (n > worth_threads)
    for (std::size_t i = 0; i < n; ++i) {
        Vec2 sum;
        for (const std::uint32_t j : pairs.of(i)) {
            const Vec2 xi = points[j] - points[i];
            const double w = area[j] * weight(dot(xi, xi), 0.5 * smoothing * (spacing[i] + spacing[j]));
            const Sym2& a = inverse[i];
            const Sym2& b = inverse[j];
            sum.x += w * ((a.xx + b.xx) * xi.x + (a.xy + b.xy) * xi.y);
            sum.y += w * ((a.xy + b.xy) * xi.x + (a.yy + b.yy) * xi.y);
        }
        error[i] = sum;
    }
    return error;
}

void centre(Relaxing& cloud, const Section& section, int steps) {
    static double over = getenv("OV") ? atof(getenv("OV")) : 1.5;
    LastingPairs pairs(cloud, section, 2.6);
    std::vector<Vec2> step(cloud.points.size());
    for (int s = 0; s < steps; ++s) {
        const std::vector<Cell> cells = voronoi_cells(section, cloud.points, cloud.spacing, pairs.get(), cloud.walls);
        for (std::size_t i = 0; i < step.size(); ++i) step[i] = over * cells[i].centroid;
        pairs.advance(move(cloud, section, step));
    }
}

void polish(Relaxing& cloud, const Section& section, int steps, double smoothing) {
    static double gamma = getenv("GAMMA") ? atof(getenv("GAMMA")) : 0.1;
    static double mu = getenv("MU") ? atof(getenv("MU")) : 0.7;
    static double wd = getenv("WD") ? atof(getenv("WD")) : 4;
    static int area_interval = getenv("AI") ? atoi(getenv("AI")) : 5;  // steps for which a set of areas is kept
    LastingPairs pairs(cloud, section, std::max(2 * smoothing, 2.6));
    const std::size_t n = cloud.points.size();
    std::vector<double> area(n);
    std::vector<Vec2> step(n);
    std::vector<char> deep(n);
    std::vector<Vec2> normal(n);
    for (std::size_t i = 0; i < n; ++i) deep[i] = cloud.walls[i].depth > wd * smoothing * cloud.spacing[i], normal[i] = cloud.walls[i].normal;
    for (int s = 0; s < steps; ++s) {
        if (s % area_interval == 0) {
            const std::vector<Cell> cells = voronoi_cells(section, cloud.points, cloud.spacing, pairs.get(), cloud.walls);
            for (std::size_t i = 0; i < area.size(); ++i) area[i] = cells[i].area;
        }
        std::vector<Vec2> r = zeroth_order_error(cloud.points, cloud.spacing, area, pairs.get(), smoothing);
        for (std::size_t i = 0; i < n; ++i) if (!deep[i]) r[i] = r[i] - dot(r[i], normal[i]) * normal[i];
#pragma omp parallel for schedule(static) if (n > worth_threads)
        for (std::size_t i = 0; i < n; ++i) {
            Vec2 sum;
            for (const std::uint32_t j : pairs.get().of(i)) {
                const Vec2 xi = cloud.points[j] - cloud.points[i];
                const double r2 = dot(xi, xi), h = 0.5 * smoothing * (cloud.spacing[i] + cloud.spacing[j]);
                if (r2 >= 4 * h * h) continue;
                const double R = std::sqrt(r2), q = R / h;
                const double sigma = 10 / (7 * std::numbers::pi) / (h * h * h * h);
                const double w = sigma * (q < 1 ? 3 - 2.25 * q : 0.75 * (2 - q) * (2 - q) / q);
                const double dw = sigma * (q < 1 ? -2.25 : -0.75 * (4 - q * q) / (q * q)) / (h * R);
                const Vec2 d = r[j] - r[i];
                sum = sum + 2 * area[j] * (w * d + dw * dot(xi, d) * xi);
            }
            const double s2 = cloud.spacing[i] * cloud.spacing[i];
            step[i] = mu * step[i] - gamma * s2 * s2 * sum;
        }
        pairs.advance(move(cloud, section, step));
    }
}

}  // namespace brisance
