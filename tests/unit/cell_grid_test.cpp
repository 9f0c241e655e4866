// SPDX-License-Identifier: Apache-2.0
// Every range query against a search through all points and all their images.
#include "core_helpers.h"
#include "neighbours/ring_map.h"

#include <array>
#include <map>
#include <set>

using namespace brisance;
using namespace brisance::core_test;

namespace {

struct Points {
    std::vector<double> x, y, z;
    std::int64_t size() const { return static_cast<std::int64_t>(x.size()); }
    void add(double a, double b, double c) {
        x.push_back(a);
        y.push_back(b);
        z.push_back(c);
    }
};

using Found = std::set<std::pair<std::int64_t, std::int64_t>>;  // index, image number

void compare(const Points& p, double cell, double reach, double z_low, double period, Random& random, int queries) {
    CellGrid grid;
    grid.build(p.x.data(), p.y.data(), p.z.data(), p.size(), cell, reach, z_low, period);
    std::int64_t own = 0;
    for (std::int64_t k = 0; k < grid.entries(); ++k) own += !grid.image(k);
    EXPECT_EQ(own, p.size());
    for (int n = 0; n < queries; ++n) {
        double at[3];
        if (n % 2 && p.size() > 0) {
            const auto i = static_cast<std::size_t>(random.uniform(0, static_cast<double>(p.size())));
            at[0] = p.x[i], at[1] = p.y[i], at[2] = p.z[i];
        } else {
            at[0] = random.uniform(-4, 4), at[1] = random.uniform(-4, 4), at[2] = period > 0 ? z_low + random.uniform(0, period) : random.uniform(-4, 4);
        }
        const double want_reach = n % 3 ? reach : 0.4 * reach;
        Found want, all;
        const int images = period > 0 ? static_cast<int>(std::ceil(want_reach / period)) + 1 : 0;
        for (std::int64_t i = 0; i < p.size(); ++i)
            for (int m = -images; m <= images; ++m) {
                const auto k = static_cast<std::size_t>(i);
                const double dx = p.x[k] - at[0], dy = p.y[k] - at[1], dz = p.z[k] + m * period - at[2];
                if (dx * dx + dy * dy + dz * dz < want_reach * want_reach) want.insert({i, m});
            }
        std::int64_t visited = 0;
        grid.ranges(at[0], at[1], at[2], want_reach, [&](std::int64_t first, std::int64_t last) {
            EXPECT_LT(first, last);
            for (std::int64_t k = first; k < last; ++k, ++visited) all.insert({grid.index(k), period > 0 ? std::lround(grid.shift(k) / period) : 0});
        });
        EXPECT_EQ(visited, static_cast<std::int64_t>(all.size())) << "an entry came twice";
        for (const auto& w : want) EXPECT_TRUE(all.count(w)) << "point " << w.first << " image " << w.second;
    }
}

Points random_points(Random& random, int n, double low, double high, double z_low, double z_high) {
    Points p;
    for (int i = 0; i < n; ++i) p.add(random.uniform(low, high), random.uniform(low, high), random.uniform(z_low, z_high));
    return p;
}

}  // namespace

TEST(CellGrid, FindsEveryPoint) {
    Random random(3);
    for (const double cell : {0.2, 0.7, 3.0, 50.0}) compare(random_points(random, 400, -3, 3, -3, 3), cell, 0.8, 0, 0, random, 60);
}

TEST(CellGrid, PeriodicImages) {
    Random random(4);
    // longer and shorter than twice the reach, and shorter than the reach itself
    for (const double period : {6.0, 1.3, 0.5, 0.2}) compare(random_points(random, 150, -2, 2, 1.5, 1.5 + period), 0.5, 0.9, 1.5, period, random, 60);
}

TEST(CellGrid, ClustersAndPointsFarAway) {
    Random random(5);
    Points p = random_points(random, 200, 0.999, 1.001, 0.999, 1.001);
    for (int i = 0; i < 30; ++i) p.add(1, 1, 1);  // all in one place
    p.add(1e7, -1e6, 1e5);                         // flung out: must neither cost memory nor be lost
    compare(p, 0.01, 0.05, 0, 0, random, 60);
    CellGrid grid;
    grid.build(p.x.data(), p.y.data(), p.z.data(), p.size(), 0.01, 0.05);
    bool found = false;
    grid.ranges(1e7, -1e6, 1e5, 0.05, [&](std::int64_t first, std::int64_t last) {
        for (std::int64_t k = first; k < last; ++k) found = found || grid.index(k) == p.size() - 1;
    });
    EXPECT_TRUE(found);
}

// A plume around a cluster: the cells stay as small as the cluster wants them, and the points stand as in a full grid.
TEST(CellGrid, SparseFindsEveryPointInTheOrderOfAFullGrid) {
    Random random(9);
    for (const double period : {0.0, 2.5}) {
        Points p = random_points(random, 600, -0.4, 0.4, 0, period > 0 ? period : 3);
        for (int i = 0; i < 60; ++i) p.add(random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(0, period > 0 ? period : 30));
        compare(p, 0.1, 0.25, 0, period, random, 90);
        CellGrid grid;
        grid.build(p.x.data(), p.y.data(), p.z.data(), p.size(), 0.1, 0.25, 0, period);
        const CellGridView& v = grid.view();
        ASSERT_TRUE(v.sparse());
        EXPECT_EQ(v.cell, 0.1);
        using Key = std::array<std::int64_t, 5>;  // strip, z, row in the strip, x, number
        Key before{-1, 0, 0, 0, 0};
        for (std::int64_t k = 0; k < grid.entries(); ++k) {
            const auto i = static_cast<std::size_t>(grid.index(k));
            const int y = v.place(p.y[i], 1), z = v.place(p.z[i] + grid.shift(k), 2);
            const Key here{y / v.strip, z, y % v.strip, v.place(p.x[i], 0), grid.image(k) ? p.size() : grid.index(k)};
            EXPECT_LE(before, here) << k;
            before = here;
        }
    }
    // few points around: full
    const Points p = random_points(random, 600, -0.4, 0.4, 0, 1);
    CellGrid grid;
    grid.build(p.x.data(), p.y.data(), p.z.data(), p.size(), 0.1, 0.25);
    EXPECT_FALSE(grid.view().sparse());
}

// The map of rings against the distance to every point: never more, and where points are near it knows.
TEST(RingMap, BoundsTheDistanceToTheNextPoint) {
    Random random(8);
    for (const double period : {0.0, 2.5})
        for (const int depth : {1, 3, 5})
            for (const int n : {0, 7, 3000}) {
                const double cell = random.uniform(0.15, 0.3), reach = depth * cell;  // with 7 points the grid is sparse, and has no map
                // many of them in a corner of the grid, so that most of it is empty
                Points p = random_points(random, n, -3, n < 300 ? 3 : -1, 0, period > 0 ? period : 3);
                p.add(3, 3, 2);
                CellGrid grid;
                grid.build(p.x.data(), p.y.data(), p.z.data(), p.size(), cell, reach, 0, period);
                RingMap map;
                map.build(grid.view(), depth);
                int told = 0;
                for (int q = 0; q < 400; ++q) {
                    const double x = random.uniform(-4, 4), y = random.uniform(-4, 4), z = random.uniform(0, period > 0 ? period : 4);
                    double nearest = 1e300, axis = 1e300;  // and the same along the axis on which it is furthest
                    for (std::size_t i = 0; i < p.x.size(); ++i)
                        for (int m = -3; m <= 3; ++m) {
                            const double dx = std::abs(p.x[i] - x), dy = std::abs(p.y[i] - y), dz = std::abs(p.z[i] + m * period - z);
                            nearest = std::min(nearest, std::sqrt(dx * dx + dy * dy + dz * dz));
                            axis = std::min(axis, std::max({dx, dy, dz}));
                        }
                    const double bound = map.view().bound({x, y, z});
                    EXPECT_LE(std::min(bound, reach), nearest);
                    EXPECT_LE(bound, depth * grid.view().cell);
                    // a place outside of the grid is looked up at its rim
                    if (n == 3000 && std::abs(x) < 2.8 && std::abs(y) < 2.8 && z > 0.1 && z < 1.9) {
                        EXPECT_GE(bound, std::min({axis - 2 * grid.view().cell, reach, depth * grid.view().cell}) - 1e-12);
                        told += bound > 0;
                    }
                }
                EXPECT_TRUE(n < 3000 || told > 50) << told;
            }
}

TEST(CellGrid, EmptyAndSingle) {
    Random random(6);
    CellGrid grid;
    const double nothing = 0;
    grid.build(&nothing, &nothing, &nothing, 0, 1, 1);
    EXPECT_EQ(grid.entries(), 0);
    grid.ranges(0, 0, 0, 1, [](std::int64_t, std::int64_t) { FAIL() << "no points"; });
    Points p;
    p.add(0.1, 0.2, 0.3);
    compare(p, 1, 0.5, 0, 0, random, 20);
    compare(p, 1, 2.5, 0, 1, random, 20);
}

TEST(CellGrid, PointsOfACellKeepTheirOrder) {
    Random random(7);
    const Points p = random_points(random, 300, 0, 1, 0, 1);
    CellGrid grid;
    grid.build(p.x.data(), p.y.data(), p.z.data(), p.size(), 10, 1);  // one cell
    for (std::int64_t k = 0; k < grid.entries(); ++k) EXPECT_EQ(grid.index(k), k);
}
