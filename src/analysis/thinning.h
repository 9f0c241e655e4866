// SPDX-License-Identifier: Apache-2.0
// Thins a mask to lines one pixel wide that keep its connections, ends and holes.
#pragma once

#include "analysis/damage_raster.h"

namespace brisance::analysis {

/// The parallel thinning of Z. Guo and R. W. Hall, Commun. ACM 32 (1989) 359-373, algorithm A1: two sub-iterations, each of which
/// strips pixels of the edge at once, so that the line that stays lies in the middle. Only edge pixels are visited: time grows
/// as the number of set pixels. A last sequential pass removes the steps that are still two pixels thick (see tidy).
Mask thin(const DamageRaster& raster, const Mask& mask);

/// Removes each set pixel with two or more neighbours whose removal changes no connection, so that in what stays a pixel
/// with two neighbours lies on a line, with one at an end, with more at a junction.
void tidy(const DamageRaster& raster, Mask& skeleton);

}  // namespace brisance::analysis
