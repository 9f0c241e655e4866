// SPDX-License-Identifier: Apache-2.0
#include "app/assembly.h"
#include "app/commands.h"
#include "base/error.h"
#include "base/memory.h"
#include "io/case_file.h"

#include <fmt/format.h>

namespace brisance {

Case open_case(const CaseOptions& o) {
    if (o.threads > 0) exec::set_threads(o.threads);
    std::vector<std::string> settings = o.settings;
    if (!o.until.empty()) settings.push_back("run.until=" + o.until);
    return read_case(o.file, o.preset, settings);
}

void require_memory(const Case& c, const Estimate& e) {
    const double free = available_memory();
    if (e.bytes > free)
        throw ResourceError(fmt::format("{} does not fit: it needs about {:.3g} GiB for {:.4g} particles, {:.3g} GiB are free. Coarser: --preset or "
                                        "--set rock.spacing=...",
                                        c.file, e.bytes / gibibyte, e.particles, free / gibibyte));
}

}  // namespace brisance
