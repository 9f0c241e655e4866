// SPDX-License-Identifier: Apache-2.0
// Random numbers without a state: the value is a function of (seed, stream, counter), so it does not depend on who asks first.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace brisance {

/// The finaliser of SplitMix64 (Steele, Lea, Flood 2014, variant 13 of Stafford): every bit of x reaches every bit of the result.
inline std::uint64_t mix(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
    return x ^ (x >> 31);
}

/// 64 random bits. Streams of one seed, and counters of one stream, are independent of each other.
inline std::uint64_t random_bits(std::uint64_t seed, std::uint64_t stream, std::uint64_t counter) {
    constexpr std::uint64_t golden = 0x9e3779b97f4a7c15ULL;  // 2^64 / golden ratio, the increment of SplitMix64
    std::uint64_t h = mix(seed + golden);
    h = mix((h ^ stream) + golden);
    return mix((h ^ counter) + golden);
}

/// Uniform in the open interval (0, 1): the middles of 2^52 equal parts, so neither 0 nor 1 ever appears.
inline double random_uniform(std::uint64_t seed, std::uint64_t stream, std::uint64_t counter) {
    return (static_cast<double>(random_bits(seed, stream, counter) >> 12) + 0.5) * 0x1p-52;
}

/// Standard normal, by Box and Muller: uses the uniform numbers 2 counter and 2 counter + 1 of the stream.
inline double random_normal(std::uint64_t seed, std::uint64_t stream, std::uint64_t counter) {
    const double radius = std::sqrt(-2 * std::log(random_uniform(seed, stream, 2 * counter)));
    return radius * std::cos(2 * std::numbers::pi * random_uniform(seed, stream, 2 * counter + 1));
}

}  // namespace brisance
