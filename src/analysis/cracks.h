// SPDX-License-Identifier: Apache-2.0
// What a geologist counts on the face of a cut: radial cracks, the crushed zone around the borehole, the spall ring.
#pragma once

#include "analysis/damage_raster.h"
#include "analysis/section_points.h"

#include <span>
#include <vector>

namespace brisance::analysis {

struct Specimen {
    double hole_radius = 0;   ///< mm
    double outer_radius = 0;  ///< mm
};

/// A piece of damage that hangs together (8-connected pixels).
struct CrackComponent {
    int particles = 0;
    double area = 0;                ///< mm2
    double r_min = 0, r_max = 0;    ///< mm, to within a pixel
    double extent() const { return r_max - r_min; }
};

/// The components of the damage, the one that extends farthest along the radius first.
std::vector<CrackComponent> crack_components(const SectionPoints& points, const DamageRaster& raster, double threshold);

struct RadialCracks {
    std::vector<double> circles;  ///< mm, radii of the test circles, equally spaced from 3 hole radii to 0.8 outer radii
    std::vector<int> arms;        ///< number of cracks that each circle crosses
    double median_arms = 0;       ///< over the circles
    int sustained_arms = 0;       ///< the largest n such that n or more arms are crossed over a quarter of the outer radius
    int long_components = 0;      ///< pieces outside 3 hole radii that extend along the radius over a quarter of the outer radius or more
    double longest = 0;           ///< mm, largest radial extent of any component, the crushed zone it starts from included
};

/// Counts radial cracks by the circles they cross. `sustained_arms` is the number of long radial cracks to quote: it neither falls to zero
/// when they stop short of half the circles, as the median does, nor to one when a ring joins them, as the number of components does.
/// Pieces that extend along the radius by less than three particle sizes (specks, spall) are left out of the arms.
/// Throws std::invalid_argument where 0 <= 3 hole radii < 0.8 outer radii does not hold.
RadialCracks radial_cracks(const SectionPoints& points, const DamageRaster& raster, double threshold, const Specimen& specimen);

/// Number of distinct arcs of set pixels on a circle of this radius, mm; arcs less than `gap` mm apart count as one, and a circle
/// without any gap is a ring: 0.
int arcs_on_circle(const DamageRaster& raster, const Mask& mask, double radius, double gap);

/// Largest r, mm, such that at least `share` of the particles' area within r of the axis is damaged; 0 where there is none. The
/// share is that of all within r, so around a hole of radius h damage that ends sharply at r = a gives
/// sqrt(h^2 + (a^2 - h^2) / share): 1.12 a for h = 0 and a share of 0.8.
double crushed_radius(const SectionPoints& points, double threshold, double share = 0.8);

struct Spall {
    double radius = 0, width = 0;  ///< mm; NaN where there is no spall
    double coverage = 0;           ///< fraction of the circumference
};

/// The ring of circumferential damage beyond 0.75 outer radii. Of the damaged particles there, those where the damage runs along
/// the radius (orientation.h: along > 0) belong to radial cracks and are left out. The others go, by area over circumference, into a
/// histogram of r with bins one particle wide; the band is its highest bin with the neighbours down to half of it. radius: mean of
/// the band; width: the extent of its bins; coverage: the union of the angles of its particles, each taken as 1.5 sizes wide, so
/// that neighbours in any arrangement touch.
Spall find_spall(const SectionPoints& points, double threshold, const Specimen& specimen);

}  // namespace brisance::analysis
