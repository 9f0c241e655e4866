// SPDX-License-Identifier: Apache-2.0
// How fast this machine steps one part, by itself: for `brisance bench`, and for what `brisance check` foretells.
#pragma once

#include "app/commands.h"
#include "io/case.h"

#include <functional>
#include <string>

namespace brisance {

/// Wall time of some work, s.
double seconds_of(const std::function<void()>& work);
/// A case that comes with the program, by its path in cases/.
CaseOptions shipped_case(const std::string& file);
/// One of cases/bench with about so many particles in its cube of `edge` mm; 0: as it is.
CaseOptions sized_case(const std::string& file, double particles, double edge);

struct LoopSpeed {
    double rate = 0;        ///< particle-steps per second, all threads
    double particles = 0, neighbours = 0;
    double bytes = 0;       ///< per particle, resident
};
/// Steps such a case, with a preset or without, for about so many seconds, after some steps to warm up.
LoopSpeed loop_speed(const std::string& file, double particles, Precision precision, double edge, double seconds, const std::string& preset = "");

}  // namespace brisance
