// SPDX-License-Identifier: Apache-2.0
#include "app/assembly.h"
#include "app/commands.h"
#include "base/error.h"
#include "base/memory.h"
#include "exec/device.h"
#include "io/case_file.h"

#include <fmt/format.h>

namespace brisance {

namespace {

void choose_device(const std::string& wanted) {
    if (wanted == "cpu") return exec::use_device(false);
    const exec::DeviceInfo d = exec::device_info();
    if (wanted == "cuda" && !(d.built && d.found)) throw ResourceError("--device cuda: " + d.name);
    exec::use_device(d.found);
}

}  // namespace

Case open_case(const CaseOptions& o) {
    choose_device(o.device);
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
    if (!exec::on_device()) return;
    const exec::DeviceInfo d = exec::device_info();
    if (e.bytes > d.memory_free)
        throw ResourceError(fmt::format("{} does not fit on {}: it needs about {:.3g} GiB for {:.4g} particles, {:.3g} GiB are free there. Coarser: --preset or --set "
                                        "rock.spacing=..., half of it: --set run.precision=single, on the processor: --device cpu",
                                        c.file, d.name, e.bytes / gibibyte, e.particles, d.memory_free / gibibyte));
}

}  // namespace brisance
