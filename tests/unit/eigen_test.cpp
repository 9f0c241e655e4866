// SPDX-License-Identifier: Apache-2.0
// References: tensors built from their principal values, closed forms, and the characteristic polynomial.
#include "law_helpers.h"
#include "math/eigen.h"

#include <algorithm>

using namespace brisance;
using namespace brisance::law_test;

namespace {

struct Three {
    double one, two, three;
};
Sym of(const Three& v, const Mat3<double>& q) { return rotated(q, {v.one, v.two, v.three, 0, 0, 0}); }

double worst(const Principal<double>& p, const Three& v) {
    return std::max({std::abs(p.one - v.one), std::abs(p.two - v.two), std::abs(p.three - v.three)});
}

template <class R> Sym3<R> cast(const Sym& a) {
    return {static_cast<R>(a.xx), static_cast<R>(a.yy), static_cast<R>(a.zz), static_cast<R>(a.xy), static_cast<R>(a.xz), static_cast<R>(a.yz)};
}

}  // namespace

TEST(PrincipalValues, WellSeparatedOnesToRoundOff) {
    Random random(1);
    for (int i = 0; i < 20000; ++i) {
        const double size = random.decades(1e-9, 1e6);
        double v[3] = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
        std::sort(v, v + 3);
        if (std::min(v[2] - v[1], v[1] - v[0]) < 0.05) continue;
        const Three exact{size * v[2], size * v[1], size * v[0]};
        EXPECT_LT(worst(principal(of(exact, random.rotation())), exact), 1e-13 * size);
    }
}

TEST(PrincipalValues, CoincidingOnesToTheRootOfRoundOff) {
    // A double root of the characteristic polynomial moves by sqrt(epsilon) when a coefficient does by epsilon: 1e-7 in double, 2e-3 in float.
    Random random(2);
    const Three shapes[] = {{1, 1, -2}, {2, -1, -1}, {1, 0, 0}, {0, 0, -1}, {3, 3, 3}, {-3, -3, -3}, {1, 1 - 1e-5, -2}, {2, -1, -1 - 1e-9}, {0, 0, 0}};
    for (const Three& v : shapes)
        for (int i = 0; i < 2000; ++i) {
            const double size = random.decades(1e-9, 1e6);
            const Three exact{size * v.one, size * v.two, size * v.three};
            const Mat3<double> q = i == 0 ? Mat3<double>{1, 0, 0, 0, 1, 0, 0, 0, 1} : random.rotation();
            const Sym a = of(exact, q);
            EXPECT_LT(worst(principal(a), exact), 1e-7 * size) << v.one << ' ' << v.two << ' ' << v.three;
            const Principal<float> f = principal(cast<float>(a));
            EXPECT_LT(worst({f.one, f.two, f.three}, exact), 2e-3 * size) << v.one << ' ' << v.two << ' ' << v.three;
        }
}

TEST(PrincipalValues, ClosedForms) {
    const auto check = [](const Sym& a, const Three& exact, double tolerance) {
        const Principal<double> p = principal(a);
        EXPECT_NEAR(p.one, exact.one, tolerance);
        EXPECT_NEAR(p.two, exact.two, tolerance);
        EXPECT_NEAR(p.three, exact.three, tolerance);
    };
    check({0, 0, 0, 0.7, 0, 0}, {0.7, 0, -0.7}, 1e-15);                              // pure shear
    check({3, -1, 7, 0, 0, 0}, {7, 3, -1}, 1e-14);                                   // diagonal
    check({2, 5, -4, 1.5, 0, 0}, {3.5 + std::sqrt(4.5), 3.5 - std::sqrt(4.5), -4}, 1e-14);  // a plane: Mohr's circle
    check({0, 0, 0, 1, 1, 1}, {2, -1, -1}, 1e-7);                                    // ones off the diagonal
    check({2, 2, 2, -1, 0, -1}, {2 + std::sqrt(2.0), 2, 2 - std::sqrt(2.0)}, 1e-14); // second difference matrix
}

TEST(PrincipalValues, RootsOfTheCharacteristicPolynomialInOrder) {
    Random random(3);
    for (int i = 0; i < 20000; ++i) {
        const double size = random.decades(1e-6, 1e3);
        const Sym a = random.sym(size);
        const Principal<double> p = principal(a);
        EXPECT_GE(p.one, p.two);
        EXPECT_GE(p.two, p.three);
        EXPECT_NEAR(p.one + p.two + p.three, trace(a), 1e-14 * size);
        EXPECT_NEAR(p.one * p.one + p.two * p.two + p.three * p.three, ddot(a, a), 1e-13 * size * size);
        for (const double x : {p.one, p.two, p.three}) {
            const Sym shifted{a.xx - x, a.yy - x, a.zz - x, a.xy, a.xz, a.yz};
            EXPECT_NEAR(det(full(shifted)), 0, 1e-13 * size * size * size);
        }
    }
}

TEST(PrincipalValues, PackGivesTheBitsOfTheScalar) {
    Random random(4);
    const auto check = [&](auto zero) {
        using R = decltype(zero);
        using V = Pack<R>;
        for (int i = 0; i < 3000; ++i) {
            Sym3<R> a[lanes<R>];
            Sym3<V> packed{};
            for (int l = 0; l < lanes<R>; ++l) {
                a[l] = cast<R>(l % 4 == 0 ? of({1, 1, -2}, random.rotation()) : random.sym(random.decades(1e-6, 1e2)));
                if (i == 0 && l == 1) a[l] = {};
                std::memcpy(reinterpret_cast<char*>(&packed.xx) + l * sizeof(R), &a[l].xx, sizeof(R));
                std::memcpy(reinterpret_cast<char*>(&packed.yy) + l * sizeof(R), &a[l].yy, sizeof(R));
                std::memcpy(reinterpret_cast<char*>(&packed.zz) + l * sizeof(R), &a[l].zz, sizeof(R));
                std::memcpy(reinterpret_cast<char*>(&packed.xy) + l * sizeof(R), &a[l].xy, sizeof(R));
                std::memcpy(reinterpret_cast<char*>(&packed.xz) + l * sizeof(R), &a[l].xz, sizeof(R));
                std::memcpy(reinterpret_cast<char*>(&packed.yz) + l * sizeof(R), &a[l].yz, sizeof(R));
            }
            const Principal<V> p = principal(packed);
            for (int l = 0; l < lanes<R>; ++l) {
                const Principal<R> s = principal(a[l]);
                ASSERT_TRUE(same_bits(lane(p.one, l), s.one) && same_bits(lane(p.two, l), s.two) && same_bits(lane(p.three, l), s.three));
            }
        }
    };
    check(0.0);
    check(0.0f);
}

TEST(SmallTensors, InverseCofactorAndProductsAgree) {
    Random random(5);
    for (int i = 0; i < 5000; ++i) {
        const Sym s = random.sym(1) + Sym{3, 3, 3, 0, 0, 0};  // positive definite enough
        const Mat3<double> one = full(s) * full(inverse(s));
        const Mat3<double> f{random.uniform(0.5, 1.5), random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3),
                             random.uniform(-0.3, 0.3), random.uniform(0.5, 1.5), random.uniform(-0.3, 0.3),
                             random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), random.uniform(0.5, 1.5)};
        const Mat3<double> j = f * transpose(cofactor(f));
        const double d = det(f);
        const Mat3<double> unit{1, 0, 0, 0, 1, 0, 0, 0, 1};
        EXPECT_LT(std::sqrt(ddot(one - unit, one - unit)), 1e-13);
        EXPECT_LT(std::sqrt(ddot(j - d * unit, j - d * unit)), 1e-14);
        const Mat3<double> a = f * s - f * full(s), b = s * f - full(s) * f;
        EXPECT_LT(ddot(a, a) + ddot(b, b), 1e-28);
        EXPECT_NEAR(ddot(s, s), ddot(full(s), full(s)), 1e-13);
        const Mat3<double> q = random.rotation();
        EXPECT_NEAR(det(q), 1, 1e-14);
        EXPECT_NEAR(det(full(rotated(q, s))), det(full(s)), 1e-12);
    }
}
