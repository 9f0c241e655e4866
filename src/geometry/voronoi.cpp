// SPDX-License-Identifier: Apache-2.0
#include "geometry/voronoi.h"

#include <algorithm>
#include <array>

namespace brisance {
namespace {

constexpr std::size_t most_vertices = 64;
constexpr double farthest_wall = 2.0;  ///< spacings: a wall farther away cuts no cell

/// A convex polygon about the origin, anticlockwise.
struct Polygon {
    std::array<Vec2, most_vertices> v;
    std::size_t size = 0;

    /// Keeps the part with n . x <= offset.
    void clip(Vec2 n, double offset) {
        std::array<double, most_vertices> side{};
        bool cut = false;
        for (std::size_t k = 0; k < size; ++k) {
            side[k] = dot(n, v[k]) - offset;
            cut = cut || side[k] > 0;
        }
        if (!cut) return;
        std::array<Vec2, most_vertices> kept;
        std::size_t m = 0;
        for (std::size_t k = 0; k < size && m + 2 < most_vertices; ++k) {
            const std::size_t next = k + 1 < size ? k + 1 : 0;
            if (side[k] <= 0) kept[m++] = v[k];
            if ((side[k] <= 0) != (side[next] <= 0)) kept[m++] = v[k] + side[k] / (side[k] - side[next]) * (v[next] - v[k]);
        }
        std::copy_n(kept.begin(), m, v.begin());
        size = m;
    }

    Cell cell() const {
        double twice = 0;
        Vec2 moment;
        for (std::size_t k = 0; k < size; ++k) {
            const Vec2 a = v[k], b = v[k + 1 < size ? k + 1 : 0];
            const double cross = a.x * b.y - a.y * b.x;
            twice += cross;
            moment = moment + cross * (a + b);
        }
        if (!(twice > 0)) return {};
        return {0.5 * twice, 1 / (3 * twice) * moment};
    }

    double radius_squared() const {
        double r2 = 0;
        for (std::size_t k = 0; k < size; ++k) r2 = std::max(r2, dot(v[k], v[k]));
        return r2;
    }
};

/// Where the way from p, inside, to p + end, outside, leaves the region first, seen from p.
Vec2 way_out(const Section& section, Vec2 p, Vec2 end, double spacing) {
    const double length = norm(end);
    double t = 0;
    for (int i = 0; i < 100 && t < length; ++i) {  // no wall is nearer than the distance says
        const double d = -section.distance(p + (t / length) * end);
        if (d < 1e-6 * spacing) break;
        t += d;
    }
    return (std::min(t, length) / length) * end;
}

/// Cuts the cell of p at the wall.
double clip_at_wall(Polygon& cell, const Section& section, Vec2 p, double spacing, const WallView& wall) {
    cell.clip(wall.normal, wall.depth);
    for (int i = 0; i < 6; ++i) {  // a corner of the region, or a round wall
        double farthest = 0.02 * spacing;
        Vec2 corner;
        bool outside = false;
        for (std::size_t k = 0; k < cell.size; ++k) {
            const double d = section.distance(p + cell.v[k]);
            if (d > farthest) {
                farthest = d;
                corner = cell.v[k];
                outside = true;
            }
        }
        if (!outside) break;
        Vec2 n = section.normal(p + corner);
        double offset = dot(n, corner) - farthest;
        if (offset <= 0) {  // beyond the middle of a slot the wall across is nearer: take the one that the way there meets first
            const Vec2 first = way_out(section, p, corner, spacing);
            n = section.normal(p + first);
            offset = dot(n, first);
        }
        cell.clip(n, offset);
    }
    // Between the tangent and the wall, over an edge of the cell from a to b along the tangent, the gap grows as t^2:
    // its integral is (t_b gap_b - t_a gap_a) / 3.
    double gap = 0;
    for (std::size_t k = 0; k < cell.size; ++k) {
        const Vec2 a = cell.v[k], b = cell.v[k + 1 < cell.size ? k + 1 : 0];
        const double tolerance = 1e-9 * spacing;
        if (std::abs(dot(wall.normal, a) - wall.depth) > tolerance || std::abs(dot(wall.normal, b) - wall.depth) > tolerance) continue;
        const Vec2 along{-wall.normal.y, wall.normal.x};
        gap -= (dot(along, b) * section.distance(p + b) - dot(along, a) * section.distance(p + a)) / 3;
    }
    return gap;
}

}  // namespace

std::vector<Cell> voronoi_cells(const Section& section, const std::vector<Vec2>& points, const std::vector<double>& spacing,
                                const Pairs& pairs, const std::vector<WallView>& walls) {
    std::vector<Cell> cells(points.size());
#pragma omp parallel if (points.size() > worth_threads)
    {
        struct Near {
            double r2;
            Vec2 d;
        };
        std::vector<Near> near;
#pragma omp for schedule(static)
        for (std::size_t i = 0; i < points.size(); ++i) {
            near.clear();
            for (const std::uint32_t j : pairs.of(i)) {
                const Vec2 d = points[j] - points[i];
                near.push_back({dot(d, d), d});
            }
            std::sort(near.begin(), near.end(), [](const Near& a, const Near& b) { return a.r2 < b.r2; });

            const double far = farthest_wall * spacing[i];
            Polygon polygon;
            polygon.v = {Vec2{-far, -far}, Vec2{far, -far}, Vec2{far, far}, Vec2{-far, far}};
            polygon.size = 4;
            double r2 = polygon.radius_squared();
            for (const Near& q : near) {
                if (q.r2 > 4 * r2) break;  // its bisector passes beyond the cell
                polygon.clip(q.d, 0.5 * q.r2);
                r2 = polygon.radius_squared();
            }
            const bool at_wall = walls[i].depth * walls[i].depth < r2;
            const double gap = at_wall ? clip_at_wall(polygon, section, points[i], spacing[i], walls[i]) : 0;
            cells[i] = polygon.cell();
            cells[i].area += gap;
        }
    }
    return cells;
}

}  // namespace brisance
