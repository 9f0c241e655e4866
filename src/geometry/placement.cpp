// SPDX-License-Identifier: Apache-2.0
#include "geometry/placement.h"

#include "base/error.h"
#include "base/random.h"


#include <algorithm>
#include <cmath>

namespace brisance {

Placement place(const Shape& part, const std::vector<ShapePtr>& later, const PlacementOptions& o) {
    const Box box = part.bounds();
    const double z_low = o.slice ? o.z_low : box.min.z, z_high = o.slice ? o.z_high : box.max.z;
    if (!std::isfinite(box.max.x - box.min.x + box.max.y - box.min.y) || !(z_high > z_low) || !std::isfinite(z_high - z_low))
        throw InputError("its shape is unbounded or empty; cut it with a box or a cylinder");

    const auto section = [&](Point p) {
        double d = part.section_distance(p);
        for (const ShapePtr& s : later) d = std::max(d, -s->section_distance(p));
        return d;
    };
    // The section is the shadow of the part along z: for a prism any level shows it, for other shapes the union of some levels.
    const double middle = 0.5 * (z_low + z_high), height = z_high - z_low;
    std::vector<double> levels{middle};
    if (!o.slice)
        for (double f : {0.1, 0.3, 0.7, 0.9}) levels.push_back(z_low + f * height);
    Region region;
    region.distance = [&](Vec2 p) {
        double d = 1e300;
        for (double z : levels) d = std::min(d, section({p.x, p.y, z}));
        return d;
    };
    region.min = {box.min.x, box.min.y};
    region.max = {box.max.x, box.max.y};

    const double far = std::max(o.spacing_far, o.spacing);
    CloudOptions cloud_options;
    cloud_options.arrangement = o.arrangement;
    cloud_options.angle = o.angle;
    cloud_options.seed = o.seed;
    cloud_options.smoothing = o.smoothing;
    cloud_options.spacing = [&](Vec2 p) {
        const double r = std::hypot(p.x - o.axis_x, p.y - o.axis_y);
        return std::min(far, o.spacing + o.grading_growth * std::max(0.0, r - o.grading_radius));
    };
    const Cloud cloud = fill(region, cloud_options);

    Placement out;
    const int layers = std::max(1, static_cast<int>(std::lround(height / o.spacing_z)));
    out.dz = height / layers;
    out.z_low = z_low;
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
        Column c;
        c.x = cloud.points[i].x;
        c.y = cloud.points[i].y;
        const double phase = o.z_phase ? random_uniform(o.seed, 17, i) - 0.5 : 0.0;
        c.z0 = z_low + (0.5 + phase) * out.dz;
        c.area = cloud.area[i];
        c.spacing = std::sqrt(cloud.area[i]);
        c.layers = layers;
        c.wall_distance = cloud.wall_distance[i];
        c.wall_normal_x = cloud.wall_normal[i].x;
        c.wall_normal_y = cloud.wall_normal[i].y;
        c.wall_layer = cloud.wall_layer[i];
        if (c.wall_layer == 0 && c.wall_distance > 0) {
            // Length of wall per column: its area over the layer's thickness, corrected by the wall's curvature, div n = Laplacian of d.
            const double s = 0.5 * c.wall_distance;
            const Vec2 p = cloud.points[i];
            const double laplacian = (region.distance({p.x + s, p.y}) + region.distance({p.x - s, p.y}) + region.distance({p.x, p.y + s}) +
                                      region.distance({p.x, p.y - s}) - 4 * region.distance(p)) / (s * s);
            // The layer is as thick as the wall is far plus half of the gap to the next layer, which a graded spacing makes wider.
            const double grown = cloud_options.spacing(p - c.wall_distance * cloud.wall_normal[i]) / cloud_options.spacing(p + s * cloud.wall_normal[i]);
            c.wall_length = c.area / (c.wall_distance * (1 + grown)) * std::clamp(1 + c.wall_distance * laplacian, 0.5, 2.0);
        }
        out.columns.push_back(c);
    }
    if (out.columns.empty()) throw InputError("no particle fits at this spacing");
    return out;
}

}  // namespace brisance
