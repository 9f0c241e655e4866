// SPDX-License-Identifier: Apache-2.0
#include "geometry/cloud.h"

#include "base/error.h"
#include "base/random.h"
#include "geometry/hilbert.h"
#include "geometry/quadtree.h"
#include "geometry/relax.h"
#include "geometry/section.h"
#include "geometry/voronoi.h"
#include "geometry/wall_layers.h"

#include <algorithm>
#include <cmath>

namespace brisance {
namespace {

/// Streams of random numbers of one seed; wall_layers.cpp uses stream 1.
enum Stream : std::uint64_t { place_in_leaf_x = 2, place_in_leaf_y = 3, first_place = 4 };

struct Rotation {
    double c = 1, s = 0;
    Vec2 operator()(Vec2 p) const { return {c * p.x - s * p.y, s * p.x + c * p.y}; }
    Rotation inverse() const { return {c, -s}; }
};

double farthest_corner(const Region& region) {
    return std::hypot(std::max(std::abs(region.min.x), std::abs(region.max.x)), std::max(std::abs(region.min.y), std::abs(region.max.y)));
}

Section turned(const Region& region, const CloudOptions& options, Rotation turn) {
    return {[&region, turn](Vec2 q) { return region.distance(turn(q)); },
            [&options, turn](Vec2 q) { return options.spacing(turn(q)); }, farthest_corner(region)};
}

/// Start points of the relaxed part: along Hilbert's curve through the leaves one point for each 1 of integral dA / spacing^2,
/// anywhere in its leaf. So every stretch of the curve, and with it every patch of the section, gets its share.
void sow(Relaxing& cloud, const Section& section, const std::vector<Leaf>& leaves, int layers, std::uint64_t seed) {
    std::vector<double> share(leaves.size());
#pragma omp parallel for schedule(static)
    for (std::size_t k = 0; k < leaves.size(); ++k) {
        const Leaf& leaf = leaves[k];
        if (leaf.depth < 0) continue;
        // The relaxed part begins where the last layer ends; a leaf across that line counts with the part beyond it.
        double beyond = 1;
        if (leaf.depth < (layers + 2.5) * leaf.spacing) {
            const LayerDepth d = layer_depth(section, leaf.centre, layers);
            if (d.across > 0) continue;
            if (d.layers < layers) {  // but only if there is such a part
                const LayerDepth deeper = layer_depth(section, leaf.centre - leaf.side * section.normal(leaf.centre), layers);
                if (deeper.across > 0 || deeper.layers < layers) continue;
            }
            beyond = std::clamp(0.5 + (d.layers - layers) * leaf.spacing / leaf.side, 0.0, 1.0);
        }
        share[k] = beyond * leaf.side * leaf.side / (leaf.spacing * leaf.spacing);
    }
    double total = 0;
    for (const double s : share) total += s;
    const double count = std::round(total);
    if (count == 0) return;

    double sum = random_uniform(seed, first_place, 0);
    std::uint64_t placed = 0;
    for (std::size_t k = 0; k < leaves.size(); ++k) {
        const double next = sum + share[k] * count / total;
        for (double i = std::floor(sum) + 1; i <= next; ++i, ++placed) {
            const Vec2 offset{random_uniform(seed, place_in_leaf_x, placed) - 0.5, random_uniform(seed, place_in_leaf_y, placed) - 0.5};
            cloud.points.push_back(leaves[k].centre + leaves[k].side * offset);
            cloud.spacing.push_back(leaves[k].spacing);
            cloud.motion.push_back(Relaxing::Motion::free);
            cloud.walls.push_back({0, {1, 0}});  // depth 0: look at once
        }
        sum = next;
    }
}

/// Sorts by `order` whatever belongs to points.
template <class T>
void permute(std::vector<T>& v, const std::vector<std::size_t>& order) {
    std::vector<T> sorted;
    sorted.reserve(v.size());
    for (const std::size_t i : order) sorted.push_back(v[i]);
    v = std::move(sorted);
}

void scale_to(std::vector<double>& areas, double exact) {
    double sum = 0;
    for (const double a : areas) sum += a;
    for (double& a : areas) a *= exact / sum;
}

Cloud relaxed(const Region& region, const CloudOptions& options) {
    const Rotation turn{std::cos(options.angle), std::sin(options.angle)};
    const Section section = turned(region, options, turn);
    const std::vector<Leaf> leaves = quadtree(section, 0.7);

    Relaxing state;
    std::vector<int> layer;
    for (const WallPoint& w : wall_layers(section, leaves, options.wall_layers, options.seed)) {
        using Place = WallPoint::Place;
        using Motion = Relaxing::Motion;
        state.points.push_back(w.p);
        state.spacing.push_back(section.spacing(w.p));
        state.motion.push_back(w.place == Place::inside ? Motion::free : w.place == Place::along_wall ? Motion::along_wall : Motion::fixed);
        state.walls.push_back({section.depth(w.p), section.normal(w.p)});
        if (w.place == Place::corner && w.layer == 0) state.corners.push_back(w.p);
        layer.push_back(w.place == Place::inside ? -1 : w.layer);
    }
    sow(state, section, leaves, options.wall_layers, options.seed);
    if (state.points.empty()) throw InputError("no point fits: the region is empty, or thinner than half a spacing");
    layer.resize(state.points.size(), -1);
    state.least_depth = options.wall_layers + 0.2;

    const auto sort = [&] {
        const std::vector<std::size_t> order = hilbert_order(state.points);
        permute(state.points, order);
        permute(state.spacing, order);
        permute(state.motion, order);
        permute(state.walls, order);
        permute(layer, order);
    };
    sort();
    repel(state, section, options.relax_steps);
    view_walls(state, section);
    polish(state, section, options.polish_steps, options.smoothing);
    sort();
    view_walls(state, section);

    Cloud cloud;
    const Pairs pairs = find_pairs(state.points, state.spacing, 2.6);
    for (const Cell& c : voronoi_cells(section, state.points, state.spacing, pairs, state.walls)) cloud.area.push_back(c.area);
    scale_to(cloud.area, area(region));
    for (std::size_t i = 0; i < state.points.size(); ++i) {
        cloud.points.push_back(turn(state.points[i]));
        cloud.wall_distance.push_back(state.walls[i].depth);
        cloud.wall_normal.push_back(turn(state.walls[i].normal));
    }
    cloud.wall_layer = std::move(layer);
    return cloud;
}

Cloud lattice(const Region& region, const CloudOptions& options) {
    const Rotation turn{std::cos(options.angle), std::sin(options.angle)};
    const double spacing = options.spacing(0.5 * (region.min + region.max));
    if (!(spacing > 0)) throw InputError("the spacing of a cloud must be > 0");
    const Section section{region.distance, [spacing](Vec2) { return spacing; }, farthest_corner(region)};

    // Rows and columns k + 1/2, so that the lattice has the symmetry of a square about the origin.
    std::vector<Vec2> points;
    const double half = std::ceil(section.reach / spacing);
    for (double j = -half; j < half; ++j) {
        for (double i = -half; i < half; ++i) {
            const Vec2 p = turn(spacing * Vec2{i + 0.5, j + 0.5});
            const bool in_box = p.x > region.min.x && p.x < region.max.x && p.y > region.min.y && p.y < region.max.y;
            if (in_box && region.distance(p) < 0) points.push_back(p);
        }
    }
    if (points.empty()) throw InputError("no point fits: the region is empty, or thinner than half a spacing");
    permute(points, hilbert_order(points));

    Cloud cloud;
    cloud.area.assign(points.size(), spacing * spacing);
    scale_to(cloud.area, area(region));
    for (const Vec2 p : points) {
        const double depth = section.depth(p);
        cloud.wall_distance.push_back(depth);
        cloud.wall_normal.push_back(section.normal(p));
        cloud.wall_layer.push_back(depth < spacing ? 0 : depth < 2 * spacing ? 1 : -1);
    }
    cloud.points = std::move(points);
    return cloud;
}

/// Length of the line at y inside the region.
double length_inside(const Region& region, double y) {
    const auto inside = [&](double x) { return region.distance({x, y}) < 0; };
    const double least_step = 1e-5 * (region.max.x - region.min.x);
    // No wall is nearer than |distance|: along the line, step by that much, then locate each change of sign.
    double x = region.min.x, sum = 0, entered = x;
    bool in = inside(x);
    while (x < region.max.x) {
        const double next = std::min(region.max.x, x + std::max(least_step, std::abs(region.distance({x, y}))));
        const bool next_in = inside(next);
        if (next_in != in) {
            double a = x, b = next;
            for (int i = 0; i < 50; ++i) (inside(0.5 * (a + b)) == in ? a : b) = 0.5 * (a + b);
            if (in) sum += 0.5 * (a + b) - entered;
            entered = 0.5 * (a + b);
            in = next_in;
        }
        x = next;
    }
    return in ? sum + region.max.x - entered : sum;
}

/// Adaptive Simpson's rule for the integral of that length over a < y < b: halves what differs from its halves by more than
/// the tolerance, so it closes in on heights where a wall begins or ends and the length goes like a square root.
double simpson(const Region& region, double a, double b, double at_a, double at_middle, double at_b, double tolerance, int depth) {
    const double middle = 0.5 * (a + b), width = b - a;
    const double q1 = length_inside(region, 0.5 * (a + middle)), q3 = length_inside(region, 0.5 * (middle + b));
    const double coarse = width / 6 * (at_a + 4 * at_middle + at_b);
    const double refined = width / 12 * (at_a + 4 * q1 + 2 * at_middle + 4 * q3 + at_b);
    if (depth == 0 || std::abs(refined - coarse) < tolerance) return refined + (refined - coarse) / 15;
    return simpson(region, a, middle, at_a, q1, at_middle, tolerance, depth - 1) +
           simpson(region, middle, b, at_middle, q3, at_b, tolerance, depth - 1);
}

}  // namespace

Cloud fill(const Region& region, const CloudOptions& options) {
    if (!region.distance || !options.spacing) throw InputError("a cloud needs a region and a spacing");
    if (!(region.max.x > region.min.x) || !(region.max.y > region.min.y)) throw InputError("the box of the region is empty");
    if (options.wall_layers < 1) throw InputError("a cloud needs at least one layer at its walls");
    return options.arrangement == Arrangement::lattice ? lattice(region, options) : relaxed(region, options);
}

double area(const Region& region) {
    const double height = region.max.y - region.min.y;
    constexpr std::size_t panels = 512;
    const auto y_of = [&](double k) { return region.min.y + height * k / static_cast<double>(panels); };

    // Lines at the ends and the middle of each panel.
    std::vector<double> length(2 * panels + 1);
#pragma omp parallel for schedule(static)
    for (std::size_t k = 0; k < length.size(); ++k) length[k] = length_inside(region, y_of(0.5 * static_cast<double>(k)));
    double rough = 0;
    for (const double l : length) rough += l * height / static_cast<double>(length.size());

    std::vector<double> part(panels);
#pragma omp parallel for schedule(dynamic)
    for (std::size_t k = 0; k < panels; ++k) {
        const double a = y_of(static_cast<double>(k)), b = y_of(static_cast<double>(k + 1));
        part[k] = simpson(region, a, b, length[2 * k], length[2 * k + 1], length[2 * k + 2], 1e-8 * rough, 40);
    }
    double sum = 0;
    for (const double p : part) sum += p;
    return sum;
}

}  // namespace brisance
