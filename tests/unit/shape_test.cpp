// SPDX-License-Identifier: Apache-2.0
#include "geometry/shape.h"

#include "base/error.h"
#include "base/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

using namespace brisance;

namespace {

Point random_point(std::uint64_t k, double half) {
    const auto u = [&](std::uint64_t stream) { return half * (2 * random_uniform(11, stream, k) - 1); };
    return {u(0), u(1), u(2)};
}

/// Points on the surface of a solid of revolution with an oblique axis: the oracle knows its meridian, a polygon in (r, z).
std::vector<Point> revolve(Point from, Point to, const std::vector<std::pair<double, double>>& meridian, bool closed, double step) {
    const Point axis = (1 / norm(to - from)) * (to - from);
    const Point helper = std::abs(axis.x) < 0.9 ? Point{1, 0, 0} : Point{0, 1, 0};
    Point u = cross(axis, helper);
    u = (1 / norm(u)) * u;
    const Point v = cross(axis, u);
    std::vector<Point> surface;
    for (std::size_t s = 0; s + (closed ? 0 : 1) < meridian.size(); ++s) {
        const auto [r0, z0] = meridian[s];
        const auto [r1, z1] = meridian[(s + 1) % meridian.size()];
        const int n = int(std::ceil(std::hypot(r1 - r0, z1 - z0) / step));
        for (int i = 0; i <= n; ++i) {
            const double r = r0 + (r1 - r0) * i / n, z = z0 + (z1 - z0) * i / n;
            const int m = std::max(1, int(std::ceil(2 * std::numbers::pi * r / step)));
            for (int k = 0; k < m; ++k) {
                const double a = 2 * std::numbers::pi * k / m;
                surface.push_back(from + z * axis + r * std::cos(a) * u + r * std::sin(a) * v);
            }
        }
    }
    return surface;
}

void expect_distance(const Shape& shape, const std::vector<Point>& surface, double step, double half, auto inside) {
    for (std::uint64_t k = 0; k < 300; ++k) {
        const Point p = random_point(k, half);
        double nearest = 1e300;
        for (const Point& s : surface) nearest = std::min(nearest, norm(s - p));
        const double d = shape.distance(p);
        // A sample lies within 0.71 steps of the nearest point of the surface.
        EXPECT_LE(std::abs(d), nearest + 1e-12);
        EXPECT_GE(std::hypot(d, 0.75 * step), nearest - 0.03 * step);
        EXPECT_EQ(d < 0, inside(p));
        EXPECT_EQ(shape.contains(p), inside(p));
    }
}

void expect_bounds(const Shape& shape, const std::vector<Point>& surface, double step) {
    const Box box = shape.bounds();
    Point min{1e300, 1e300, 1e300}, max{-1e300, -1e300, -1e300};
    for (const Point& p : surface) {
        min = {std::min(min.x, p.x), std::min(min.y, p.y), std::min(min.z, p.z)};
        max = {std::max(max.x, p.x), std::max(max.y, p.y), std::max(max.z, p.z)};
    }
    for (const auto& [outer, inner] : {std::pair{box.max.x, max.x}, {box.max.y, max.y}, {box.max.z, max.z},
                                      {-box.min.x, -min.x}, {-box.min.y, -min.y}, {-box.min.z, -min.z}}) {
        EXPECT_GE(outer, inner - 1e-12);
        EXPECT_LE(outer, inner + step);
    }
}

}  // namespace

TEST(Shape, CylinderAgainstSampledSurface) {
    const Point from{0.3, -0.4, -1}, to{1.1, 0.6, 0.9};
    const double radius = 0.8, length = norm(to - from), step = 0.02;
    const auto shape = make_cylinder(from, to, radius);
    const auto surface = revolve(from, to, {{0, 0}, {radius, 0}, {radius, length}, {0, length}}, false, step);
    const Point axis = (1 / length) * (to - from);
    expect_distance(*shape, surface, step, 2.5, [&](Point p) {
        const double z = dot(p - from, axis), r = norm(p - from - z * axis);
        return z > 0 && z < length && r < radius;
    });
    expect_bounds(*shape, surface, step);
}

TEST(Shape, AnnulusAgainstSampledSurface) {
    const Point from{-0.5, 0.2, 0.8}, to{0.7, 0.1, -0.6};
    const double inner = 0.5, outer = 1.2, length = norm(to - from), step = 0.025;
    const auto shape = make_annulus(from, to, inner, outer);
    const auto surface = revolve(from, to, {{inner, 0}, {outer, 0}, {outer, length}, {inner, length}}, true, step);
    const Point axis = (1 / length) * (to - from);
    expect_distance(*shape, surface, step, 2.2, [&](Point p) {
        const double z = dot(p - from, axis), r = norm(p - from - z * axis);
        return z > 0 && z < length && r > inner && r < outer;
    });
    expect_bounds(*shape, surface, step);
}

TEST(Shape, BoxAgainstSampledSurface) {
    const Point min{-1, -0.5, 0.2}, max{0.6, 1.1, 0.9};
    const double step = 0.025;
    std::vector<Point> surface;
    const auto face = [&](Point corner, Point a, Point b) {
        const int n = int(std::ceil(norm(a) / step)), m = int(std::ceil(norm(b) / step));
        for (int i = 0; i <= n; ++i) {
            for (int j = 0; j <= m; ++j) surface.push_back(corner + (double(i) / n) * a + (double(j) / m) * b);
        }
    };
    const Point x{max.x - min.x, 0, 0}, y{0, max.y - min.y, 0}, z{0, 0, max.z - min.z};
    face(min, x, y), face(min + z, x, y), face(min, y, z), face(min + x, y, z), face(min, x, z), face(min + y, x, z);
    const auto shape = make_box(min, max);
    expect_distance(*shape, surface, step, 2, [&](Point p) {
        return p.x > min.x && p.x < max.x && p.y > min.y && p.y < max.y && p.z > min.z && p.z < max.z;
    });
    expect_bounds(*shape, surface, step);
}

TEST(Shape, SphereAndHalfSpace) {
    const auto sphere = make_sphere({1, 2, 3}, 1.5);
    EXPECT_DOUBLE_EQ(sphere->distance({1, 2, 3}), -1.5);
    EXPECT_NEAR(sphere->distance({1, 2 + 4, 3 - 3}), 3.5, 1e-14);
    EXPECT_DOUBLE_EQ(sphere->bounds().min.y, 0.5);
    EXPECT_DOUBLE_EQ(sphere->bounds().max.z, 4.5);

    const auto half = make_half_space({0, 0, 1}, {0, 3, 4});
    EXPECT_NEAR(half->distance({7, 0, 1}), 0, 1e-15);
    EXPECT_NEAR(half->distance({7, 6, 9}), 10, 1e-14);
    EXPECT_TRUE(half->contains({0, 0, 0}));
    EXPECT_TRUE(std::isinf(half->bounds().max.x) && std::isinf(half->bounds().min.z));
}

TEST(Shape, CombinationsHaveTheSignOfTheirSets) {
    const auto a = make_sphere({0, 0, 0}, 1), b = make_box({0, -0.5, -0.5}, {2, 0.5, 0.5}), c = make_sphere({-0.5, 0, 0}, 0.4);
    const auto either = make_union({a, b}), both = make_intersection({a, b}), cut = make_difference(a, {b, c});
    for (std::uint64_t k = 0; k < 5000; ++k) {
        const Point p = random_point(k, 2.2);
        const bool in_a = a->contains(p), in_b = b->contains(p), in_c = c->contains(p);
        EXPECT_EQ(either->contains(p), in_a || in_b);
        EXPECT_EQ(both->contains(p), in_a && in_b);
        EXPECT_EQ(cut->contains(p), in_a && !in_b && !in_c);
        // Their size is a bound: no point of another sign is nearer.
        const Point q = p + (0.999 * std::abs(cut->distance(p)) / norm(p - Point{0.1, 0.2, 0.3})) * (p - Point{0.1, 0.2, 0.3});
        EXPECT_EQ(cut->contains(p), cut->contains(q));
    }
    EXPECT_DOUBLE_EQ(either->bounds().max.x, 2);
    EXPECT_DOUBLE_EQ(either->bounds().min.x, -1);
    EXPECT_DOUBLE_EQ(both->bounds().min.x, 0);
    EXPECT_DOUBLE_EQ(both->bounds().max.x, 1);
    EXPECT_DOUBLE_EQ(cut->bounds().max.x, 1);
}

TEST(Shape, SectionsDoNotSeeEndFaces) {
    // the section of a thin disc is as wide as that of a long bar; the distance in space knows its faces
    const ShapePtr disc = make_cylinder({0, 0, 0}, {0, 0, 0.2}, 5), slab = make_box({-2, -3, 0}, {2, 3, 0.2});
    EXPECT_NEAR(disc->section_distance({1, 0, 0.1}), -4, 1e-12);
    EXPECT_NEAR(disc->distance({1, 0, 0.1}), -0.1, 1e-12);
    EXPECT_GT(disc->section_distance({1, 0, 0.3}), 1e6);
    EXPECT_NEAR(slab->section_distance({1, 0, 0.1}), -1, 1e-12);
    EXPECT_NEAR(make_sphere({0, 0, 0}, 5)->section_distance({1, 0, 3}), 1 - 4, 1e-12);
    EXPECT_NEAR(make_half_space({0, 0, 0}, {1, 0, 1})->section_distance({-2, 0, 1}), -1, 1e-12);
    EXPECT_LT(make_half_space({0, 0, 1}, {0, 0, 1})->section_distance({0, 0, 0}), -1e6);
    const ShapePtr ring = make_difference(disc, {make_cylinder({0, 0, -1}, {0, 0, 1}, 2)});
    EXPECT_NEAR(ring->section_distance({3, 0, 0.1}), -1, 1e-12);
    EXPECT_NEAR(make_union({disc, slab})->section_distance({0, 4, 0.1}), -1, 1e-12);
    EXPECT_NEAR(make_intersection({disc, slab})->section_distance({0, 4, 0.1}), 1, 1e-12);
}

TEST(Shape, RefusesWhatIsNoSolid) {
    EXPECT_THROW(make_cylinder({0, 0, 0}, {0, 0, 0}, 1), InputError);
    EXPECT_THROW(make_cylinder({0, 0, 0}, {0, 0, 1}, 0), InputError);
    EXPECT_THROW(make_annulus({0, 0, 0}, {0, 0, 1}, 2, 1), InputError);
    EXPECT_THROW(make_box({0, 0, 0}, {1, 0, 1}), InputError);
    EXPECT_THROW(make_sphere({0, 0, 0}, -1), InputError);
    EXPECT_THROW(make_half_space({0, 0, 0}, {0, 0, 0}), InputError);
    EXPECT_THROW(make_union({}), InputError);
}
