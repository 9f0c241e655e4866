// SPDX-License-Identifier: Apache-2.0
// A fixed set of points of one material, for measuring the speed of its strength law: a third elastic, a third yielding, a third failed.
#pragma once

#include "laws/material.h"

#include <vector>

namespace brisance {

class LawBatch {
public:
    /// `points` is rounded up to whole packs. The material needs a strength law.
    LawBatch(const Material& material, int points);

    std::size_t points() const { return packs_.size() * static_cast<std::size_t>(lanes<double>); }
    /// Shares of the set that yield in an update, and that are failed.
    double yielding() const;
    double failed() const;

    /// One update of every point, from the same state each time. Returns a sum over the results, so that nothing can be left out.
    double update() const;

    /// Updates per second of this core, the best of rounds that take `seconds` together.
    double updates_per_second(double seconds) const;

private:
    const Material& material_;
    std::vector<SolidPoint<Pack<double>>> packs_;
};

}  // namespace brisance
