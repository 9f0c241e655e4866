// SPDX-License-Identifier: Apache-2.0
// The pairs of columns against sums over all pairs of particles.
#include "core_helpers.h"
#include "math/kernel.h"

#include <map>

using namespace brisance;
using namespace brisance::core_test;

namespace {

constexpr double dz = 0.9, smoothing = 1.3;

/// Columns at random places, finer on the left, each with its own phase along z.
std::vector<Column> random_columns(Random& random, int n, int layers, bool phases) {
    std::vector<Column> columns;
    for (int i = 0; i < n; ++i) {
        Column c;
        c.x = random.uniform(0, 7);
        c.y = random.uniform(0, 7);
        c.spacing = 0.6 + 0.1 * c.x;
        c.area = c.spacing * c.spacing * random.uniform(0.8, 1.2);
        c.z0 = phases ? random.uniform(-0.5, 0.5) * dz : 0;
        c.layers = layers;
        columns.push_back(c);
    }
    return columns;
}

struct Bond {
    double w, dx, dy, dz;
};
/// What the formula says of a bond; w = 0: none.
Bond formula(const Column& a, int ka, const Column& b, int kb, double s = smoothing) {
    const double dx = b.x - a.x, dy = b.y - a.y, z = b.z0 + kb * dz - a.z0 - ka * dz, h_xy = 0.5 * s * (a.spacing + b.spacing), h_z = s * dz;
    const double q = std::sqrt((dx * dx + dy * dy) / (h_xy * h_xy) + z * z / (h_z * h_z));
    if (q >= 2) return {};
    return {b.area * dz / pi / std::pow(std::cbrt(h_xy * h_xy * h_z), 5) * kernel::bond(q), dx, dy, z};
}

/// All bonds that the pairs give to the particle in a slot, by the slot of the other.
std::map<std::int64_t, Bond> bonds_of(const SolidPart<double>& s, std::size_t column, std::int64_t slot) {
    std::map<std::int64_t, Bond> out;
    for (std::int64_t p = s.pairs.begin[column]; p < s.pairs.begin[column + 1]; ++p) {
        const ColumnPair<double>& pair = s.pairs.pairs[static_cast<std::size_t>(p)];
        for (int o = 0; o < pair.count; ++o) {
            const bool fresh = out.emplace(slot + pair.shift + o, Bond{s.pairs.w[static_cast<std::size_t>(pair.weights + o)], pair.dx, pair.dy, pair.z_first + o * s.body.layout.dz}).second;
            EXPECT_TRUE(fresh) << "a bond twice";
        }
    }
    return out;
}

}  // namespace

TEST(ColumnPairs, EveryBondAndNoOther) {
    Random random(11);
    for (const bool phases : {false, true})
        for (const int layers : {1, 3, 8, 21}) {
            // holes and ragged ends, as a part cut by others has them
            const auto present = [&](const Column& c, int k) { return std::fmod(7.3 * c.x + 3.1 * c.y + 2.7 * k, 1.0) > 0.15; };
            const SolidPart<double> s = solid(elastic_granite(), {}, random_columns(random, 60, layers, phases), dz, false, present);
            const Columns& l = s.body.layout;
            std::int64_t count = 0;
            for (std::size_t a = 0; a < l.columns.size(); ++a)
                for (int k = 0; k < layers; ++k) {
                    const std::int64_t slot = l.columns[a].start + k;
                    if (!(l.flags[static_cast<std::size_t>(slot)] & slot_own)) continue;
                    const std::map<std::int64_t, Bond> have = bonds_of(s, a, slot);
                    std::int64_t want = 0;
                    for (std::size_t b = 0; b < l.columns.size(); ++b)
                        for (int m = 0; m < layers; ++m) {
                            const std::int64_t other = l.columns[b].start + m;
                            if (other == slot || !(l.flags[static_cast<std::size_t>(other)] & slot_own)) continue;
                            const Bond f = formula(l.columns[a], k, l.columns[b], m);
                            if (f.w == 0) continue;
                            ++want;
                            const auto it = have.find(other);
                            ASSERT_NE(it, have.end());
                            ASSERT_NEAR(it->second.w, f.w, 1e-13 * f.w + 1e-15);
                            ASSERT_NEAR(it->second.dx, f.dx, 1e-14);
                            ASSERT_NEAR(it->second.dy, f.dy, 1e-14);
                            ASSERT_NEAR(it->second.dz, f.dz, 1e-13);
                        }
                    std::int64_t alive = 0;
                    for (const auto& [other, bond] : have) {
                        ASSERT_GE(other, 0);
                        ASSERT_LT(other, l.slots);
                        alive += (l.flags[static_cast<std::size_t>(other)] & slot_own) != 0;
                    }
                    ASSERT_EQ(alive, want) << "a slot of another column is taken for a neighbour";
                    count += want;
                }
            if (layers == 21) {
                EXPECT_GT(count, 20000);
            }
        }
}

TEST(ColumnPairs, WeightsAreSymmetric) {
    Random random(12);
    const SolidPart<double> s = solid(elastic_granite(), {}, random_columns(random, 60, 9, true), dz, false);
    const Columns& l = s.body.layout;
    for (std::size_t a = 0; a < l.columns.size(); ++a)
        for (const auto& [other, bond] : bonds_of(s, a, l.columns[a].start + 4))
            for (std::size_t b = 0; b < l.columns.size(); ++b) {
                if (other < l.columns[b].start || other >= l.columns[b].start + 9) continue;
                const Bond back = bonds_of(s, b, other).at(l.columns[a].start + 4);
                EXPECT_NEAR(l.columns[a].area * bond.w, l.columns[b].area * back.w, 1e-14 * l.columns[a].area * bond.w + 1e-16);
                EXPECT_EQ(bond.dx, -back.dx);
                EXPECT_EQ(bond.dy, -back.dy);
                EXPECT_NEAR(bond.dz, -back.dz, 1e-14);
            }
}

TEST(ColumnPairs, SumsOfColumnsWithoutEnds) {
    Random random(13);
    const SolidPart<double> s = solid(elastic_granite(), {}, random_columns(random, 80, 8, true), dz, true);
    const Columns& l = s.body.layout;
    double bonds = 0;
    for (std::size_t a = 0; a < l.columns.size(); ++a) {
        Sym3<double> K{};
        Vec3<double> g{};
        for (std::size_t b = 0; b < l.columns.size(); ++b)
            for (int m = -12; m <= 12; ++m) {
                if (a == b && m == 0) continue;
                const Bond f = formula(l.columns[a], 0, l.columns[b], m);
                bonds += f.w > 0;
                K = {K.xx + f.w * f.dx * f.dx, K.yy + f.w * f.dy * f.dy, K.zz + f.w * f.dz * f.dz, K.xy + f.w * f.dx * f.dy, K.xz + f.w * f.dx * f.dz, K.yz + f.w * f.dy * f.dz};
                g = g + f.w * Vec3<double>{f.dx, f.dy, f.dz};
            }
        const double* k = s.pairs.k_inverse.data() + 6 * a;
        const Mat3<double> one = law_test::full(K) * Sym3<double>{k[0], k[1], k[2], k[3], k[4], k[5]};
        const double condition = trace(K) * (k[0] + k[1] + k[2]);
        for (double off : {one.xx - 1, one.yy - 1, one.zz - 1, one.xy, one.xz, one.yx, one.yz, one.zx, one.zy}) EXPECT_NEAR(off, 0, 1e-14 * condition);
        const double* sum = s.pairs.g_sum.data() + 3 * a;
        EXPECT_NEAR(sum[0], g.x, 1e-12);
        EXPECT_NEAR(sum[1], g.y, 1e-12);
        EXPECT_NEAR(sum[2], g.z, 1e-12);
    }
    EXPECT_NEAR(s.pairs.bonds_per_particle, bonds / static_cast<double>(l.columns.size()), 1e-12);
}

TEST(ColumnPairs, TilesWithMissingNeighboursAreMasked) {
    Random random(14);
    int masked = 0, whole = 0;
    for (const int layers : {8, 16, 24, 29}) {
        const SolidPart<double> s = solid(elastic_granite(), {}, random_columns(random, 40, layers, true), dz, false);
        for (const Tile& t : s.body.layout.tiles) {
            bool missing = false;
            for (int lane = 0; lane < s.body.layout.width; ++lane)
                for (const auto& [other, bond] : bonds_of(s, static_cast<std::size_t>(t.column), t.base + lane))
                    missing = missing || !(s.body.layout.flags[static_cast<std::size_t>(other)] & slot_own);
            EXPECT_EQ(t.masked, missing);
            ++(t.masked ? masked : whole);
        }
    }
    EXPECT_GT(masked, 0);
    EXPECT_GT(whole, 0);
    const SolidPart<double> endless = solid(elastic_granite(), {}, random_columns(random, 40, 8, true), dz, true);
    for (const Tile& t : endless.body.layout.tiles) EXPECT_FALSE(t.masked);
}

TEST(ColumnPairs, SingleAndDoubleAgree) {
    Random a(15), b(15);
    const SolidPart<double> d = solid<double>(elastic_granite(), {}, random_columns(a, 50, 8, true), dz, false);
    const SolidPart<float> f = solid<float>(elastic_granite(), {}, random_columns(b, 50, 8, true), dz, false);
    ASSERT_EQ(d.pairs.w.size(), f.pairs.w.size());
    for (std::size_t i = 0; i < d.pairs.w.size(); ++i) EXPECT_NEAR(d.pairs.w[i], static_cast<double>(f.pairs.w[i]), 1e-6 * d.pairs.w[i]);
    for (std::size_t i = 0; i < d.pairs.k_inverse.size(); ++i) EXPECT_EQ(d.pairs.k_inverse[i], f.pairs.k_inverse[i]);
}

TEST(ColumnPairs, ImagesRepeatThePatternHoweverFewLayersThereAre) {
    for (const int layers : {1, 2, 3, 8, 11}) {
        SolidPart<double> s = block(elastic_granite(), {}, Lattice{1, 1, layers, 1, 1, false, false, true});
        SolidBody<double>& b = s.body;
        const auto start = static_cast<std::size_t>(b.layout.columns[0].start);
        for (int k = 0; k < layers; ++k) b.u[0][start + static_cast<std::size_t>(k)] = k + 1;
        fill_images(b.layout, b.u);
        for (int k = -b.layout.pad; k < layers + b.layout.pad; ++k)
            EXPECT_EQ(b.u[0][static_cast<std::size_t>(b.layout.columns[0].start + k)], ((k % layers) + layers) % layers + 1);
    }
}
