// SPDX-License-Identifier: Apache-2.0
#include "geometry/cloud.h"

#include "base/error.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

using namespace brisance;

namespace {

constexpr double pi = std::numbers::pi;

Region disc(double radius, Vec2 centre = {}) {
    return {[=](Vec2 p) { return norm(p - centre) - radius; }, centre - Vec2{radius, radius}, centre + Vec2{radius, radius}};
}
Region annulus(double inner, double outer) {
    return {[=](Vec2 p) { return std::max(norm(p) - outer, inner - norm(p)); }, {-outer, -outer}, {outer, outer}};
}
double rectangle_distance(Vec2 p, double a, double b) {
    const double x = std::abs(p.x) - a, y = std::abs(p.y) - b;
    return x > 0 || y > 0 ? std::hypot(std::max(x, 0.0), std::max(y, 0.0)) : std::max(x, y);
}
Region rectangle(double a, double b) {
    return {[=](Vec2 p) { return rectangle_distance(p, a, b); }, {-a, -b}, {a, b}};
}
Region plate_with_holes() {
    return {[](Vec2 p) { return std::max({rectangle_distance(p, 15, 10), 3 - norm(p - Vec2{-5, 2}), 2 - norm(p - Vec2{6, -3})}); },
            {-15, -10}, {15, 10}};
}

CloudOptions uniform(double spacing, std::uint64_t seed = 1) {
    CloudOptions options;
    options.spacing = [=](Vec2) { return spacing; };
    options.seed = seed;
    return options;
}

/// A slot narrower than four spacings that opens to the outside: beyond its middle the wall across is the nearer one.
Region slotted_disc() {
    return {[](Vec2 p) { return std::max(norm(p) - 9, -rectangle_distance(p - Vec2{-11.5, 4.9}, 8.5, 0.9)); }, {-9, -9}, {9, 9}};
}
double slotted_disc_area() {
    const auto half = [](double y) { return 0.5 * (y * std::sqrt(81 - y * y) + 81 * std::asin(y / 9)); };  // integral of sqrt(81 - y^2)
    return 81 * pi - (half(5.8) - half(4) - 3 * 1.8);
}

struct Example {
    std::string name;
    Region region;
    std::function<double(Vec2)> spacing;
    double exact_area;
    double area_spread;  ///< bound on standard deviation / mean of area / spacing^2
};

std::vector<Example> examples() {
    const auto constant = [](double d) { return [d](Vec2) { return d; }; };
    return {
        {"disc", disc(1.65), constant(0.15), pi * 1.65 * 1.65, 0.06},
        {"small disc", disc(1.65), constant(1.65 / 4), pi * 1.65 * 1.65, 0.06},
        {"smallest disc", disc(1), constant(0.4), pi, 0.08},
        {"disc off the origin", disc(3, {20, -7}), constant(0.25), pi * 9, 0.06},
        {"thick annulus", annulus(3.225, 12), constant(0.4), pi * (144 - 3.225 * 3.225), 0.06},
        {"copper tube", annulus(2.625, 3.225), constant(0.2), pi * (3.225 * 3.225 - 2.625 * 2.625), 0.06},
        {"tube of four rings", annulus(2.625, 3.225), constant(0.15), pi * (3.225 * 3.225 - 2.625 * 2.625), 0.06},
        {"tube of one ring", annulus(5, 5.3), constant(0.31), pi * (5.3 * 5.3 - 25), 0.06},
        {"annulus of eight rings", annulus(5, 7), constant(0.25), pi * (49 - 25), 0.06},
        {"graded annulus", annulus(3.225, 20), [](Vec2 p) { return 0.25 + 0.04 * (norm(p) - 3.225); },
         pi * (400 - 3.225 * 3.225), 0.08},
        {"box", rectangle(10, 6), constant(0.5), 240, 0.06},
        {"bar", rectangle(10, 1.5), constant(1), 60, 0.08},
        {"disc with a slot", slotted_disc(), [](Vec2 p) { return std::min(0.9, 0.6 + 0.1 * std::max(0.0, norm(p) - 3)); }, slotted_disc_area(), 0.12},  // few particles, four corners, a steep grading
        {"plate with two holes", plate_with_holes(), constant(0.5), 600 - 13 * pi, 0.06},
        {"eccentric annulus",
         {[](Vec2 p) { return std::max(norm(p) - 10, 6 - norm(p - Vec2{2.5, 0})); }, {-10, -10}, {10, 10}},
         constant(0.5), pi * 64, 0.06},
    };
}

/// Largest distance from a place in the region to the nearest point, in spacings there.
double largest_hole(const Example& e, const Cloud& cloud) {
    double largest = 0;
    constexpr int n = 240;
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            const Vec2 p{e.region.min.x + (e.region.max.x - e.region.min.x) * (i + 0.5) / n,
                         e.region.min.y + (e.region.max.y - e.region.min.y) * (j + 0.5) / n};
            if (e.region.distance(p) >= 0) continue;
            double nearest = 1e300;
            for (const Vec2 q : cloud.points) nearest = std::min(nearest, dot(q - p, q - p));
            largest = std::max(largest, std::sqrt(nearest) / e.spacing(p));
        }
    }
    return largest;
}

double nearest_pair(const Example& e, const Cloud& cloud) {
    double nearest = 1e300;
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            nearest = std::min(nearest, norm(cloud.points[i] - cloud.points[j]) / e.spacing(cloud.points[i]));
        }
    }
    return nearest;
}

/// The error of a uniform stress, by the definition and over all pairs: sum_j V_j (K_i^-1 + K_j^-1) g_ij, times the spacing.
std::vector<Vec2> stress_error(const Cloud& cloud, double spacing, double smoothing) {
    const double h = smoothing * spacing;
    const std::size_t n = cloud.points.size();
    const auto gradient = [&](Vec2 xi) {  // -dW/dR xi / R
        const double r = norm(xi), q = r / h;
        const double dw_dq = q < 1 ? -3 * q + 2.25 * q * q : q < 2 ? -0.75 * (2 - q) * (2 - q) : 0;
        return -10 / (7 * pi) / (h * h * h) * dw_dq / r * xi;
    };
    struct Matrix {
        double xx = 0, xy = 0, yx = 0, yy = 0;
    };
    std::vector<Matrix> inverse(n);
    for (std::size_t i = 0; i < n; ++i) {
        Matrix k;
        for (std::size_t j = 0; j < n; ++j) {
            const Vec2 xi = cloud.points[j] - cloud.points[i];
            if (j == i || norm(xi) > 2 * h) continue;
            const Vec2 g = gradient(xi);
            k.xx += cloud.area[j] * g.x * xi.x;
            k.xy += cloud.area[j] * g.x * xi.y;
            k.yx += cloud.area[j] * g.y * xi.x;
            k.yy += cloud.area[j] * g.y * xi.y;
        }
        const double det = k.xx * k.yy - k.xy * k.yx;
        inverse[i] = {k.yy / det, -k.xy / det, -k.yx / det, k.xx / det};
    }
    std::vector<Vec2> error(n);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) {
            const Vec2 xi = cloud.points[j] - cloud.points[i];
            if (j == i || norm(xi) > 2 * h) continue;
            const Vec2 g = cloud.area[j] * gradient(xi);
            const Matrix& a = inverse[i];
            const Matrix& b = inverse[j];
            error[i] = error[i] + spacing * Vec2{(a.xx + b.xx) * g.x + (a.xy + b.xy) * g.y, (a.yx + b.yx) * g.x + (a.yy + b.yy) * g.y};
        }
    }
    return error;
}

/// |<exp(i n theta)>| over all bonds shorter than `reach`, of points away from the walls.
double bond_order(const Cloud& cloud, double reach, int n) {
    std::complex<double> sum;
    double bonds = 0;
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
        if (cloud.wall_distance[i] < 3 * reach) continue;
        for (std::size_t j = 0; j < cloud.points.size(); ++j) {
            const Vec2 d = cloud.points[j] - cloud.points[i];
            if (j == i || dot(d, d) > reach * reach) continue;
            sum += std::polar(1.0, n * std::atan2(d.y, d.x));
            ++bonds;
        }
    }
    return std::abs(sum) / bonds;
}

bool same_bits(const Cloud& a, const Cloud& b) {
    if (a.points.size() != b.points.size() || a.area != b.area || a.wall_distance != b.wall_distance || a.wall_layer != b.wall_layer) {
        return false;
    }
    for (std::size_t i = 0; i < a.points.size(); ++i) {
        if (a.points[i].x != b.points[i].x || a.points[i].y != b.points[i].y) return false;
        if (a.wall_normal[i].x != b.wall_normal[i].x || a.wall_normal[i].y != b.wall_normal[i].y) return false;
    }
    return true;
}

}  // namespace

TEST(Area, OfRegionsKnownInClosedForm) {
    for (const Example& e : examples()) EXPECT_NEAR(area(e.region) / e.exact_area, 1, 1e-5) << e.name;
    EXPECT_NEAR(area(annulus(3.225, 72)) / (pi * (72 * 72 - 3.225 * 3.225)), 1, 1e-5);
    EXPECT_NEAR(area(annulus(71.9, 72)) / (pi * (72 * 72 - 71.9 * 71.9)), 1, 1e-5);
}

TEST(Cloud, FillsEveryRegion) {
    for (const Example& e : examples()) {
        SCOPED_TRACE(e.name);
        CloudOptions options;
        options.spacing = e.spacing;
        const Cloud cloud = fill(e.region, options);
        const std::size_t n = cloud.points.size();
        ASSERT_GT(n, 0u);
        ASSERT_EQ(cloud.area.size(), n);
        ASSERT_EQ(cloud.wall_distance.size(), n);
        ASSERT_EQ(cloud.wall_normal.size(), n);
        ASSERT_EQ(cloud.wall_layer.size(), n);

        EXPECT_GT(nearest_pair(e, cloud), 0.5);
        EXPECT_LT(largest_hole(e, cloud), 1.1);

        double sum = 0, mean = 0, square = 0;
        for (std::size_t i = 0; i < n; ++i) {
            const Vec2 p = cloud.points[i];
            EXPECT_LT(e.region.distance(p), 0);
            EXPECT_NEAR(cloud.wall_distance[i], -e.region.distance(p), 1e-9);
            EXPECT_NEAR(norm(cloud.wall_normal[i]), 1, 1e-12);
            const double relative = cloud.area[i] / (e.spacing(p) * e.spacing(p));
            sum += cloud.area[i];
            mean += relative / double(n);
            square += relative * relative / double(n);
        }
        EXPECT_NEAR(sum / e.exact_area, 1, 1e-5);
        EXPECT_NEAR(mean, 1, 0.05);
        EXPECT_LT(std::sqrt(square - mean * mean) / mean, e.area_spread);
    }
}

TEST(Cloud, AreasNearWallsAreLikeThoseInside) {
    const Cloud cloud = fill(annulus(3.225, 12), uniform(0.3));
    double sum[3] = {}, square[3] = {}, count[3] = {};
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
        const int k = cloud.wall_layer[i] < 0 ? 2 : cloud.wall_layer[i];
        const double a = cloud.area[i] / 0.09;
        sum[k] += a, square[k] += a * a, ++count[k];
    }
    for (int k = 0; k < 3; ++k) {
        const double mean = sum[k] / count[k];
        EXPECT_NEAR(mean, 1, 0.015) << "layer " << k;
        EXPECT_LT(std::sqrt(square[k] / count[k] - mean * mean), 0.06) << "layer " << k;
    }
}

TEST(Cloud, LayersFollowTheWalls) {
    const double spacing = 0.3;
    for (const int layers : {1, 2, 3}) {
        CloudOptions options = uniform(spacing);
        options.wall_layers = layers;
        const Cloud cloud = fill(annulus(3.225, 12), options);
        int count[3] = {};
        for (std::size_t i = 0; i < cloud.points.size(); ++i) {
            const Vec2 p = cloud.points[i];
            const double r = norm(p);
            const bool outer = r > 0.5 * (3.225 + 12);
            EXPECT_NEAR(dot(cloud.wall_normal[i], p) / r, outer ? 1 : -1, 1e-9);
            const int layer = cloud.wall_layer[i];
            if (layer < 0) {
                EXPECT_GT(cloud.wall_distance[i], layers * spacing);
            } else {
                ASSERT_LT(layer, layers);
                EXPECT_NEAR(cloud.wall_distance[i], (layer + 0.5) * spacing, 1e-6);
                ++count[layer];
            }
        }
        for (int l = 0; l < layers; ++l) EXPECT_NEAR(count[l], 2 * pi * (12 + 3.225) / spacing, 3);
    }
}

TEST(Cloud, ThinTubeIsCutIntoEqualRings) {
    for (const int rings : {1, 2, 3, 4, 5, 7}) {
        // The thickness is no whole number of spacings; the rings share it.
        const double inner = 3, outer = 3.6, thickness = outer - inner, spacing = thickness / (rings + 0.3);
        const Cloud cloud = fill(annulus(inner, outer), uniform(spacing));
        std::vector<int> count(std::size_t(rings), 0);
        for (std::size_t i = 0; i < cloud.points.size(); ++i) {
            const double ring = (norm(cloud.points[i]) - inner) / thickness * rings - 0.5;
            EXPECT_NEAR(ring, std::round(ring), 1e-5);
            const int k = int(std::lround(ring));
            ++count[std::size_t(k)];
            EXPECT_EQ(cloud.wall_layer[i], std::min(k, rings - 1 - k));
        }
        for (int k = 0; k < rings; ++k) {
            const double radius = inner + thickness * (k + 0.5) / rings;
            EXPECT_NEAR(count[std::size_t(k)], 2 * pi * radius / spacing, 1.01) << rings << " rings, number " << k;
        }
    }
}

TEST(Cloud, CornersAreOccupied) {
    const double spacing = 0.5;
    const Cloud cloud = fill(rectangle(10, 6), uniform(spacing));
    for (const double x : {-1.0, 1.0}) {
        for (const double y : {-1.0, 1.0}) {
            const Vec2 corner{x * (10 - 0.5 * spacing), y * (6 - 0.5 * spacing)};
            double nearest = 1e300;
            for (const Vec2 p : cloud.points) nearest = std::min(nearest, norm(p - corner));
            EXPECT_LT(nearest, 1e-6);
        }
    }
}

TEST(Cloud, UniformStressHardlyPushes) {
    const double spacing = 0.5;
    for (const double smoothing : {1.3, 1.1}) {
        CloudOptions options = uniform(spacing);
        options.smoothing = smoothing;
        const Cloud cloud = fill(disc(12), options);
        const std::vector<Vec2> error = stress_error(cloud, spacing, smoothing);
        double inside = 0, n_inside = 0, along = 0, n_wall = 0;
        for (std::size_t i = 0; i < error.size(); ++i) {
            if (cloud.wall_distance[i] > 4 * smoothing * spacing) {  // beyond that a wall is not felt
                inside += dot(error[i], error[i]);
                ++n_inside;
            } else {  // along the normal the surface passes on its traction; along the wall nothing should happen
                const Vec2 n = cloud.wall_normal[i];
                const double t = error[i].x * n.y - error[i].y * n.x;
                along += t * t;
                ++n_wall;
            }
        }
        EXPECT_LT(std::sqrt(inside / n_inside), 0.009);
        EXPECT_LT(std::sqrt(along / n_wall), 0.009);
    }
}

TEST(Cloud, PolishLowersTheErrorOfTheRelaxedCloud) {
    CloudOptions options = uniform(0.5);
    const auto rms = [&] {
        const Cloud cloud = fill(disc(10), options);
        const std::vector<Vec2> error = stress_error(cloud, 0.5, 1.3);
        double sum = 0, n = 0;
        for (std::size_t i = 0; i < error.size(); ++i) {
            if (cloud.wall_distance[i] < 2.6) continue;
            sum += dot(error[i], error[i]);
            ++n;
        }
        return std::sqrt(sum / n);
    };
    const double polished = rms();
    options.polish_steps = 0;
    EXPECT_LT(polished, 0.4 * rms());
}

TEST(Cloud, SameBitsWithAnyNumberOfThreads) {
    const Region region = annulus(3.225, 20);
    const CloudOptions options = uniform(0.4);
    const int threads = omp_get_max_threads();
    omp_set_num_threads(1);
    const Cloud one = fill(region, options);
    EXPECT_GT(one.points.size(), 7000u);  // enough to be shared between threads
    for (const int n : {2, 3}) {
        omp_set_num_threads(n);
        EXPECT_TRUE(same_bits(one, fill(region, options))) << n << " threads";
    }
    omp_set_num_threads(threads);
}

TEST(Cloud, SeedDecides) {
    const Region region = plate_with_holes();
    const Cloud a = fill(region, uniform(0.6, 1)), again = fill(region, uniform(0.6, 1)), other = fill(region, uniform(0.6, 2));
    EXPECT_TRUE(same_bits(a, again));
    EXPECT_FALSE(same_bits(a, other));
    // Not just somewhat: away from the walls, points of the two meet only by chance.
    int near = 0, inside = 0;
    for (std::size_t i = 0; i < a.points.size(); ++i) {
        if (a.wall_layer[i] >= 0) continue;
        ++inside;
        for (const Vec2 q : other.points) near += norm(a.points[i] - q) < 0.05 * 0.6;
    }
    EXPECT_LT(near, 0.05 * inside);  // by chance pi 0.05^2 = 0.008
}

TEST(Cloud, TurnsWithTheAngleInARoundRegion) {
    const double spacing = 0.4, angle = 0.7;
    const Region region = annulus(3.225, 14);
    CloudOptions options = uniform(spacing);
    const Cloud straight = fill(region, options);
    options.angle = angle;
    const Cloud turned = fill(region, options);
    ASSERT_EQ(straight.points.size(), turned.points.size());
    double farthest = 0;
    for (std::size_t i = 0; i < straight.points.size(); ++i) {
        const Vec2 p = straight.points[i];
        const Vec2 q{std::cos(angle) * p.x - std::sin(angle) * p.y, std::sin(angle) * p.x + std::cos(angle) * p.y};
        farthest = std::max(farthest, norm(q - turned.points[i]));
        EXPECT_NEAR(straight.area[i], turned.area[i], 1e-5 * spacing * spacing);
        EXPECT_EQ(straight.wall_layer[i], turned.wall_layer[i]);
    }
    EXPECT_LT(farthest, 1e-5 * spacing);
}

TEST(Cloud, HasNoPreferredDirection) {
    const double spacing = 0.4;
    CloudOptions options = uniform(spacing);
    const Region region = disc(14);
    double order_4 = 0, order_6 = 0;
    for (const std::uint64_t seed : {1, 2, 3}) {
        options.seed = seed;
        const Cloud cloud = fill(region, options);
        order_4 = std::max(order_4, bond_order(cloud, 1.4 * spacing, 4));
        order_6 = std::max(order_6, bond_order(cloud, 1.4 * spacing, 6));
    }
    EXPECT_LT(order_4, 0.03);
    EXPECT_LT(order_6, 0.15);
    options.arrangement = Arrangement::lattice;
    EXPECT_NEAR(bond_order(fill(region, options), 1.2 * spacing, 4), 1, 1e-9);
}

TEST(Cloud, NeighboursAreNearInMemory) {
    const double spacing = 0.3;
    const Cloud cloud = fill(annulus(3.225, 12), uniform(spacing));
    double sum = 0;
    for (std::size_t i = 1; i < cloud.points.size(); ++i) sum += norm(cloud.points[i] - cloud.points[i - 1]);
    EXPECT_LT(sum / double(cloud.points.size() - 1), 2 * spacing);
}

TEST(Cloud, LatticeIsALattice) {
    const double spacing = 0.25, angle = 0.3;
    const Region region = annulus(2, 6);
    CloudOptions options = uniform(spacing);
    options.arrangement = Arrangement::lattice;
    options.angle = angle;
    const Cloud cloud = fill(region, options);
    EXPECT_NEAR(double(cloud.points.size()), area(region) / (spacing * spacing), 30);
    double sum = 0;
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
        const Vec2 p = cloud.points[i];
        const double x = (std::cos(angle) * p.x + std::sin(angle) * p.y) / spacing, y = (std::cos(angle) * p.y - std::sin(angle) * p.x) / spacing;
        EXPECT_NEAR(x - std::floor(x), 0.5, 1e-9);
        EXPECT_NEAR(y - std::floor(y), 0.5, 1e-9);
        EXPECT_LT(region.distance(p), 0);
        EXPECT_EQ(cloud.area[i], cloud.area[0]);
        const double depth = cloud.wall_distance[i];
        EXPECT_NEAR(depth, -region.distance(p), 1e-12);
        EXPECT_EQ(cloud.wall_layer[i], depth < spacing ? 0 : depth < 2 * spacing ? 1 : -1);
        sum += cloud.area[i];
    }
    EXPECT_NEAR(sum / area(region), 1, 1e-12);
}

TEST(Cloud, RefusesWhatItCannotFill) {
    EXPECT_THROW(fill(annulus(5, 5.04), uniform(0.1)), InputError);  // thinner than half a spacing
    EXPECT_NO_THROW(fill(annulus(5, 5.06), uniform(0.1)));
    const Region nothing{[](Vec2) { return 1.0; }, {-1, -1}, {1, 1}};
    EXPECT_THROW(fill(nothing, uniform(0.1)), InputError);
    EXPECT_THROW(fill(disc(1), uniform(0)), InputError);
    EXPECT_THROW(fill(disc(1), uniform(-1)), InputError);
    EXPECT_THROW(fill(disc(1), CloudOptions{}), InputError);
    CloudOptions lattice = uniform(0.1);
    lattice.arrangement = Arrangement::lattice;
    EXPECT_THROW(fill(nothing, lattice), InputError);
}
