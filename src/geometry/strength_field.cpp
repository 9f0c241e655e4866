// SPDX-License-Identifier: Apache-2.0
#include "geometry/strength_field.h"

#include "base/error.h"
#include "base/random.h"

#include <cmath>
#include <numbers>

namespace brisance {
namespace {

constexpr std::uint64_t wave_count = 128;
constexpr double two_pi = 2 * std::numbers::pi;

}  // namespace

StrengthField::StrengthField(double weibull_modulus, double correlation_length, std::uint64_t seed, double z_period)
    : modulus_(weibull_modulus) {
    if (!(weibull_modulus >= 0)) throw InputError("the Weibull modulus of a strength field must not be negative");
    if (!(z_period >= 0)) throw InputError("the period of a strength field must not be negative");
    if (modulus_ == 0) return;
    if (!(correlation_length > 0)) throw InputError("a strength field needs a correlation length > 0");

    mean_ = std::tgamma(1 + 1 / modulus_);
    waves_.reserve(wave_count);
    for (std::uint64_t i = 0; i < wave_count; ++i) {
        Point k{random_normal(seed, 0, i), random_normal(seed, 1, i), random_normal(seed, 2, i)};
        k = (1 / correlation_length) * k;
        if (z_period > 0) k.z = two_pi / z_period * std::round(k.z * z_period / two_pi);
        waves_.push_back({k, two_pi * random_uniform(seed, 3, i)});
    }
}

double StrengthField::gaussian(Point p) const {
    double sum = 0;
    for (const Wave& wave : waves_) sum += std::cos(dot(wave.k, p) + wave.phase);
    return std::sqrt(2.0 / static_cast<double>(wave_count)) * sum;
}

double StrengthField::operator()(Point p) const {
    if (modulus_ == 0) return 1;
    // -ln(1 - Phi(g)), from whichever tail keeps its digits.
    const double g = gaussian(p) / std::numbers::sqrt2;
    const double hazard = g > 0 ? -std::log(0.5 * std::erfc(g)) : -std::log1p(-0.5 * std::erfc(-g));
    return std::pow(hazard, 1 / modulus_) / mean_;
}

}  // namespace brisance
