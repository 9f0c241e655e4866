// SPDX-License-Identifier: Apache-2.0
// Exact Euclidean distances over a picture.
#pragma once

#include "analysis/damage_raster.h"

#include <vector>

namespace brisance::analysis {

/// Distance, in pixels, from the centre of each pixel to that of the nearest pixel of the mask that is not set (0 there); nx * ny values,
/// infinite where every pixel is set. P. F. Felzenszwalb and D. P. Huttenlocher, Theory Comput. 8 (2012) 415: lower envelopes of
/// parabolas, along columns and then along rows; time grows as the number of pixels.
std::vector<float> distance_to_unset(const DamageRaster& raster, const Mask& mask);

}  // namespace brisance::analysis
