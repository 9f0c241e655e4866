// SPDX-License-Identifier: Apache-2.0
// Where the rock is strong and where it is weak: a Weibull field with a correlation length, fixed in space.
//
//   w = (-ln(1 - U))^(1/m) / Gamma(1 + 1/m),   U = Phi(g),   g = sqrt(2/n) sum cos(k_i . p + phi_i)
//
//   m      Weibull modulus; the mean of w is 1, and a large m is a rock with little scatter
//   g      standard Gaussian field with autocorrelation exp(-r^2 / 2 l^2): k is normal with standard deviation 1/l
//   Phi    distribution function of the standard normal
#pragma once

#include "geometry/shape.h"

#include <cstdint>
#include <vector>

namespace brisance {

/// A property of the rock: it never sees particles, so every arrangement and every resolution meets the same rock.
class StrengthField {
public:
    /// correlation_length and z_period in mm. weibull_modulus 0: the factor is 1 everywhere. z_period 0: not periodic.
    /// Throws InputError on a negative value, or on a correlation length of 0 with a modulus > 0.
    StrengthField(double weibull_modulus, double correlation_length, std::uint64_t seed, double z_period);

    /// The factor w on the strength at p.
    double operator()(Point p) const;

    /// The Gaussian field g itself.
    double gaussian(Point p) const;

private:
    struct Wave {
        Point k;  ///< rad/mm
        double phase;
    };
    std::vector<Wave> waves_;
    double modulus_, mean_ = 1;
};

}  // namespace brisance
