// SPDX-License-Identifier: Apache-2.0
#include "core_helpers.h"
#include "math/kernel.h"

using namespace brisance;
using namespace brisance::core_test;

namespace {

/// Integral of f over [a, b] by Gauss's rule with five points: exact to degree 9.
template <class F> double gauss(double a, double b, F&& f) {
    const double x[] = {0, 0.53846931010568309, 0.90617984593866399}, w[] = {0.56888888888888889, 0.47862867049936647, 0.23692688505618909};
    const double m = 0.5 * (a + b), r = 0.5 * (b - a);
    double sum = w[0] * f(m);
    for (int i = 1; i < 3; ++i) sum += w[i] * (f(m - r * x[i]) + f(m + r * x[i]));
    return r * sum;
}

}  // namespace

TEST(Kernel, IntegratesToOne) {
    const auto volume = [](double q) { return 4 * pi * q * q * kernel::sigma_3d * kernel::shape(q); };
    const auto area = [](double q) { return 2 * pi * q * kernel::sigma_2d * kernel::shape(q); };
    EXPECT_NEAR(gauss(0, 1, volume) + gauss(1, 2, volume), 1, 1e-14);
    EXPECT_NEAR(gauss(0, 1, area) + gauss(1, 2, area), 1, 1e-14);
}

TEST(Kernel, BondIsTheSlope) {
    for (int i = 1; i < 240; ++i) {
        const double q = 0.01 * i + 0.0037, e = 1e-5;
        const double slope = (kernel::shape(q + e) - kernel::shape(q - e)) / (2 * e);
        EXPECT_NEAR(kernel::bond(q) * q, -slope, 1e-9) << q;
    }
    EXPECT_EQ(kernel::bond(0.0), 3.0);      // -w'/q -> -w''(0)
    EXPECT_EQ(kernel::shape(0.0), 1.0);
    for (double q : {2.0, 2.0000001, 5.0, 1e6}) {
        EXPECT_EQ(kernel::shape(q), 0.0);
        EXPECT_EQ(kernel::bond(q), 0.0);
    }
    for (double e : {1e-9, 1e-12}) {  // both are continuous where the pieces meet
        EXPECT_NEAR(kernel::shape(1 - e), kernel::shape(1 + e), 2 * e);
        EXPECT_NEAR(kernel::bond(1 - e), kernel::bond(1 + e), 10 * e);
    }
}

TEST(Kernel, PacksAndNumbersAgree) {
    alignas(64) double q[8] = {0, 0.3, 0.999999, 1, 1.2, 1.9999, 2, 3};
    const Pack<double> p = load<Pack<double>>(q), w = kernel::shape(p), b = kernel::bond(p);
    alignas(64) float qf[16];
    for (int l = 0; l < 16; ++l) qf[l] = static_cast<float>(q[l % 8]);
    const Pack<float> wf = kernel::shape(load<Pack<float>>(qf)), bf = kernel::bond(load<Pack<float>>(qf));
    for (int l = 0; l < 8; ++l) {
        EXPECT_NEAR(lane(w, l), kernel::shape(q[l]), 1e-15);
        EXPECT_NEAR(lane(b, l), kernel::bond(q[l]), 1e-15);
        EXPECT_NEAR(lane(wf, l), kernel::shape(q[l]), 1e-6);
        EXPECT_NEAR(lane(bf, l), kernel::bond(q[l]), 1e-6);
    }
}

// Sums over a cubic lattice, computed independently: neighbours inside the support, sum V W, and kappa of K = kappa I.
TEST(Kernel, SumsOverACubicLattice) {
    struct Row { double h; int neighbours; double sum, kappa; };
    for (const Row& row : {Row{1.2, 56, 1.000810, 0.981689}, Row{1.3, 80, 0.997262, 0.993484}, Row{1.5, 92, 1.001795, 1.010123}}) {
        SolidOptions options;
        options.smoothing = row.h;
        const double d = 1;  // exact numbers: at h = 1.5 some places lie just on the edge of the support, and outside
        const Lattice lattice{11, 11, 8, d, d, false, false, true};
        const SolidPart<double> s = block(elastic_granite(), options, lattice);
        const std::size_t middle = 5 * 11 + 5;
        int bonds = 0;
        double sum = kernel::sigma_3d / std::pow(row.h, 3);
        for (std::int64_t p = s.pairs.begin[middle]; p < s.pairs.begin[middle + 1]; ++p) {
            const ColumnPair<double>& pair = s.pairs.pairs[static_cast<std::size_t>(p)];
            bonds += pair.count;
            for (int o = 0; o < pair.count; ++o) {
                const double z = pair.z_first + o * s.body.layout.dz, r = std::sqrt(pair.dx * pair.dx + pair.dy * pair.dy + z * z);
                sum += kernel::sigma_3d / std::pow(row.h, 3) * kernel::shape(r / (row.h * d));
            }
        }
        EXPECT_EQ(bonds, row.neighbours);
        EXPECT_NEAR(sum, row.sum, 1e-6);
        const double* k = s.pairs.k_inverse.data() + 6 * middle;
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(1 / k[i], row.kappa, 1e-6);
        for (int i = 3; i < 6; ++i) EXPECT_NEAR(k[i], 0, 1e-14);
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(s.pairs.g_sum[3 * middle + static_cast<std::size_t>(i)], 0, 1e-13);
    }
}
