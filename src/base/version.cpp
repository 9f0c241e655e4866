// SPDX-License-Identifier: Apache-2.0
#include "base/version.h"

#include "commit.h"

#include <H5public.h>
#include <fmt/format.h>

namespace brisance {

namespace {

std::string compiler() {
#if defined(__clang__)
    return fmt::format("clang++ {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#elif defined(__GNUC__)
    return fmt::format("g++ {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#else
    return "unknown compiler";
#endif
}

std::string vector_width() {
#if defined(__AVX512F__)
    return "AVX-512";
#elif defined(__AVX2__)
    return "AVX2";
#elif defined(__AVX__)
    return "AVX";
#elif defined(__SSE2__)
    return "SSE2";
#elif defined(__ARM_NEON)
    return "NEON";
#else
    return "no vector unit";
#endif
}

/// _OPENMP is the month of the specification.
std::string openmp() {
#if !defined(_OPENMP)
    return "no OpenMP";
#elif _OPENMP >= 202111
    return "OpenMP 5.2";
#elif _OPENMP >= 202011
    return "OpenMP 5.1";
#elif _OPENMP >= 201811
    return "OpenMP 5.0";
#elif _OPENMP >= 201511
    return "OpenMP 4.5";
#else
    return "OpenMP 4.0 or older";
#endif
}

std::string cuda() {
#if defined(BRISANCE_CUDA) && BRISANCE_CUDA + 0
    return "CUDA";
#else
    return "no CUDA";
#endif
}

}  // namespace

std::string version() { return BRISANCE_VERSION; }

std::string commit() { return BRISANCE_COMMIT; }

std::string build_features() {
    return fmt::format("{}, {}, {}, HDF5 {}.{}.{}, {}", compiler(), vector_width(), openmp(), H5_VERS_MAJOR, H5_VERS_MINOR, H5_VERS_RELEASE,
                       cuda());
}

}  // namespace brisance
