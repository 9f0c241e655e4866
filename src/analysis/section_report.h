// SPDX-License-Identifier: Apache-2.0
// All numbers of the fracture analysis of a run, and the JSON file that holds them.
#pragma once

#include "analysis/attenuation.h"
#include "analysis/crack_directions.h"
#include "analysis/cracks.h"
#include "analysis/section_points.h"

#include <string>
#include <vector>

namespace brisance::analysis {

struct SectionOptions {
    double threshold = 0.8;          ///< cracked: D > threshold
    std::vector<double> zone_edges;  ///< mm, two or more (crack_density.h)
    int sectors = 72;                ///< of Eq. 13
    Specimen specimen;
};

/// One section at one time.
struct SectionReport {
    double time = 0;                                 ///< us
    int damaged = 0;
    int tensile = 0, shear = 0, mixed = 0;           ///< of the damaged, by cause; a particle without a cause is in none
    std::vector<double> density_printed, density_lines;  ///< mm / mm2, per zone (crack_density.h)
    std::vector<int> damaged_per_zone;
    std::vector<double> pdf, pdf_normalised;         ///< per sector (crack_directions.h)
    std::vector<double> harmonics;                   ///< |A_1| ... |A_12|
    double radial_coherence = 0;
    IsotropyTest isotropy;
    RadialCracks radial;
    double crushed_radius = 0;                       ///< mm
    Spall spall;
};

SectionReport analyse_section(const SectionPoints& points, double time, const SectionOptions& options);

/// One section over time.
struct SectionHistory {
    std::string name;
    double z = 0;  ///< mm
    std::size_t particles = 0;
    std::vector<SectionReport> times;
};

struct Attenuation {
    PeakBins bins;
    PowerLaw law;
};

/// Two columns over time, of equal length.
struct TimeSeries {
    std::vector<double> time;   ///< us
    std::vector<double> value;  ///< mm
};

struct FractureReport {
    double threshold = 0.8;
    std::vector<double> zone_edges;          ///< mm
    std::vector<SectionHistory> sections;
    Attenuation pressure, radial_stress;
    TimeSeries borehole;                     ///< mean radius of the borehole wall
    TimeSeries burn_front;                   ///< z of the detonation front
};

/// The analysis file of a run, "schema": 1. What is not a finite number is written as null.
std::string to_json(const FractureReport& report);

}  // namespace brisance::analysis
