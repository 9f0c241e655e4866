// SPDX-License-Identifier: Apache-2.0
// brisance analyze: the fracture analysis once more, from the snapshots of a run.
#include "app/commands.h"
#include "base/error.h"

namespace brisance {

int analyze_command(const std::string& run, bool) {
    throw InputError("analyze is not there yet: " + run);
}

}  // namespace brisance
