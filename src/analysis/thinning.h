// SPDX-License-Identifier: Apache-2.0
// Thins a mask to lines one pixel wide that keep its connections, ends and holes.
#pragma once

#include "analysis/damage_raster.h"

namespace brisance::analysis {

/// The parallel thinning of Z. Guo and R. W. Hall, Commun. ACM 32 (1989) 359-373, algorithm A1: two sub-iterations, each of which
/// strips pixels of the edge at once, so that the line that stays lies in the middle. Alone it strips diamonds rather than circles,
/// and leaves broad damage with lines askew and off the middle; so pixels are let go in the order of their depth, half a pixel at a
/// time, as in distance-ordered thinning (C. J. Pudney, Comput. Vis. Image Underst. 72 (1998) 404). A last sequential pass removes
/// the steps that are still two pixels thick (see tidy).
/// depth: distance_to_unset(raster, mask). Only edge pixels are visited.
Mask thin(const DamageRaster& raster, const Mask& mask, const std::vector<float>& depth);

/// Removes each set pixel with two or more neighbours whose removal changes no connection, so that in what stays a pixel
/// with two neighbours lies on a line, with one at an end, with more at a junction.
void tidy(const DamageRaster& raster, Mask& skeleton);

}  // namespace brisance::analysis
