// SPDX-License-Identifier: Apache-2.0
#include "neighbours/neighbour_lists.h"

#include "unit/law_helpers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

using namespace brisance;
using law_test::Random;

namespace {

struct All {
    BRISANCE_HD bool operator()(std::int64_t) const { return true; }
};

/// Points in a cube of 1 mm with their supports, as a fluid hands them to the search.
struct Sorted {
    Array<double> x, y, z, h;
    CellGrid grid;
    Array<float> place[3], half;
    Array<double> records;

    void sort(double cell, double reach) {
        grid.build(x.data(), y.data(), z.data(), static_cast<std::int64_t>(x.size()), cell, reach);
        const auto padded = x.size() + lanes<float>;
        for (auto& a : place) a.assign(padded, 1e30f);
        half.assign(padded, 1.0f);
        records.assign(8 * padded, 0.0);
        for (std::size_t k = 0; k < x.size(); ++k) {
            const auto i = static_cast<std::size_t>(grid.index(static_cast<std::int64_t>(k)));
            const double at[3] = {x[i], y[i], z[i]};
            for (std::size_t a = 0; a < 3; ++a) {
                place[a][k] = static_cast<float>(at[a] - grid.view().min[a]);
                records[8 * k + a] = at[a];
            }
            half[k] = static_cast<float>(h[i]);
            records[8 * k + 3] = h[i];
        }
    }
};

}  // namespace

TEST(NeighbourLists, HoldAllPairsWhateverTheSupports) {
    Random random(8);
    for (const double widest : {1.0, 1.2, 5.0, 5.1}) {
        // a hundredth of them, all in one corner, is wide: gas that vents
        const bool plume = widest > 5;  // and some are far out: the grid is sparse
        Sorted c;
        const double usual = 0.05;
        for (int n = 0; n < 3000; ++n) {
            const double wide = plume && n > 2900 ? 6 : 1, p[3] = {wide * random.uniform(0, 1), wide * random.uniform(0, 1), wide * random.uniform(0, 1)};
            c.x.push_back(p[0]);
            c.y.push_back(p[1]);
            c.z.push_back(p[2]);
            const bool corner = p[0] < 0.25 && p[1] < 0.25 && p[2] < 0.2;
            c.h.push_back(usual * (corner ? widest : random.uniform(0.9, 1)));
        }
        const double h_max = usual * widest;
        c.x[1] = c.x[0];  // two in one place
        c.y[1] = c.y[0];
        c.z[1] = c.z[0];
        c.sort(usual, 2 * h_max);
        EXPECT_EQ(c.grid.view().sparse(), plume);
        NeighbourLists lists;
        lists.build(c.grid.view(), {c.place[0].data(), c.place[1].data(), c.place[2].data(), c.half.data(), c.records.data(), h_max}, All{});
        const NeighbourListsView& v = lists.view();
        std::int64_t spare = 0, pairs = 0;
        for (std::int64_t i = 0; i < v.entries; ++i) {
            std::set<std::int64_t> listed;
            for (std::int32_t n = 0; n < v.count[i]; ++n) {
                ASSERT_EQ(*v.at(i, n) % record_length, 0);
                EXPECT_TRUE(listed.insert(*v.at(i, n) / record_length).second) << "twice";
            }
            const double* a = c.records.data() + 8 * i;
            for (std::int64_t j = 0; j < v.entries; ++j) {
                const double* b = c.records.data() + 8 * j;
                const double r = std::sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2])), reach = a[3] + b[3];
                const bool has = listed.count(j) > 0;
                if (i == j) { EXPECT_FALSE(has); }
                else if (r < reach) { EXPECT_TRUE(has) << i << " " << j << ": " << r << " of " << reach; }
                if (has && r >= reach) {
                    ++spare;
                    EXPECT_LT(r, reach * (1 + 1e-5));
                }
                pairs += has;
            }
        }
        EXPECT_GT(pairs, 3000);
        EXPECT_LT(spare, 10);
    }
}
