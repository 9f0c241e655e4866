// SPDX-License-Identifier: Apache-2.0
// What a case says of its fracture analysis, in the terms of analysis/: shared by the recorder of a run and by `brisance analyze`.
#pragma once

#include "analysis/section_report.h"
#include "io/case.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace brisance {

/// The sections to cut: those of the case, or of a slice the one there is.
inline std::vector<SectionData> sections_of(const Case& c) {
    return c.slice ? std::vector<SectionData>{{"slice", c.slice->z}} : c.analysis.sections;
}

inline analysis::SectionOptions section_options(const Case& c) {
    analysis::SectionOptions o;
    o.threshold = c.analysis.damage_threshold;
    o.zone_edges = c.analysis.zone_radii;
    o.sectors = c.analysis.sectors;
    return o;
}

/// Hole and rim from the particles: the first and the last stand half their size from the walls.
inline analysis::Specimen specimen_of(const std::vector<double>& radius, const std::vector<double>& size) {
    const double inner = *std::min_element(radius.begin(), radius.end()), outer = *std::max_element(radius.begin(), radius.end());
    const double finest = *std::min_element(size.begin(), size.end()), coarsest = *std::max_element(size.begin(), size.end());
    return {std::max(0.0, inner - 0.5 * finest), outer + 0.5 * coarsest};
}

/// Peaks against distance, and the power law over the rock between crushed zone and rim.
inline analysis::Attenuation attenuation_of(const std::vector<double>& radius, const std::vector<double>& peak, const analysis::Specimen& s) {
    const double inner = std::max(s.hole_radius, 0.1);
    analysis::Attenuation a;
    a.bins = analysis::bin_peaks(radius, peak, analysis::logarithmic_edges(inner, s.outer_radius, 30));
    a.law = analysis::fit_power_law(a.bins.r, a.bins.median, inner + 5, inner + 0.65 * (s.outer_radius - inner));
    return a;
}

}  // namespace brisance
