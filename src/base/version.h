// SPDX-License-Identifier: Apache-2.0
// Which brisance this is.
#pragma once

#include <string>

namespace brisance {

/// "0.1.0"
std::string version();

/// The commit that was built, with "-dirty" where files differed from it; "unknown" outside a repository.
std::string commit();

/// "g++ 12.2.0, AVX-512, OpenMP 4.5, HDF5 1.10.8, no CUDA": compiler, vector width, and what is compiled in.
std::string build_features();

}  // namespace brisance
