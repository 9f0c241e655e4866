// SPDX-License-Identifier: Apache-2.0
// Over which directions the damage of a section is spread: Eq. 13, its harmonics, and whether it differs from "all alike".
#pragma once

#include "analysis/section_points.h"

#include <vector>

namespace brisance::analysis {

/// (Eq. 13) PDF_b = sum over sector b of D_i / sum over all sectors of D_i / (bin / 360), over D_i > threshold. `sectors` values, the
/// first sector beginning at +x, anticlockwise; their mean is 1. All zero where nothing is damaged.
std::vector<double> direction_pdf(const SectionPoints& points, double threshold, int sectors = 72);

/// (Eq. 13), normalised, so that runs can be compared: PDF_b times the damaged share of the section,
///   P_b = sectors * sum over sector b of D_i A_i / sum over all particles, damaged or not, of A_i,
/// with A_i = L_i^2. A value is the share of the sector's area that is broken, and the mean over the sectors that of the section.
///
/// The paper says only that the "PDF function is normalized", and quotes 0.000942, 0.001682 and 0.003558, the same in all directions,
/// at 23 us for air, no copper, and water. Eq. 13 itself gives 1 for each of them, so a factor that differs between the runs must
/// have come in. As shares of the section, between radii 3.225 and 72 mm, the three numbers are 15.3, 27.3 and 57.8 mm2: rings of 0.68,
/// 1.15 and 2.14 mm around the borehole - the start of a crushed zone, isotropic, as described. The other reading that keeps the
/// order, sum of D_i in the sector over the number of all particles (72 times less), asks for rock broken alike in all directions
/// out to r = 19, 25 and 37 mm by then. Division by the number of damaged particles reverses the order.
std::vector<double> direction_pdf_normalised(const SectionPoints& points, double threshold, int sectors = 72);

/// |A_m| = |sum D_i exp(i m theta_i)| / sum D_i over D_i > threshold, for m = 1 ... highest (entry m - 1). 4 and 8 show the bias of a square
/// lattice, 6 and 12 that of a hexagonal one. N independent directions give about sqrt(pi / (4 N)). Zero where nothing is damaged.
std::vector<double> direction_harmonics(const SectionPoints& points, double threshold, int highest = 12);

struct IsotropyTest {
    double chi_square = 0;  ///< sum of (n_b - n / k)^2 / (n / k), uncorrected
    double clump = 1;       ///< mean number of particles that come together, by which the counts are too certain
    double p_value = 1;     ///< of chi_square / clump with k - 1 degrees of freedom; small: the directions differ
};

/// Are all directions alike? Pearson's chi-square of the counts of damaged particles at r >= r_from in k sectors against n / k. The
/// particles of one crack fail together, so the plain statistic rejects nearly always; it is divided by the design effect (Rao and
/// Scott, Ann. Stat. 12 (1984) 46, first order): clump = sum n_c^2 / sum n_c over the clumps c, which are the damaged particles of one
/// sector that hang together (closer than 1.5 sizes). A crack then counts once per sector it visits, whatever its number of particles.
/// Choose r_from, mm, beyond the crushed zone: inside it the cracks of a sector are one clump, and nothing can be told.
/// Good for n / clump of some 2 k or more; with fewer clumps a large p says only that there are too few cracks to tell.
/// Wandering cracks and rings tie neighbouring sectors together, which this does not correct. p = 1 where nothing is damaged.
IsotropyTest isotropy_test(const SectionPoints& points, double threshold, int sectors = 72, double r_from = 0);

/// How radial the damage is: sum D_i q_i cos 2(phi_i - theta_i) / sum D_i over D_i > threshold, with phi the local direction of the damage
/// and q its strength (orientation.h). Near 1: radial cracks; near -1: rings and spall; 0: a round patch, or no preference.
double radial_coherence(const SectionPoints& points, double threshold);

}  // namespace brisance::analysis
