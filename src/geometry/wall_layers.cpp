// SPDX-License-Identifier: Apache-2.0
#include "geometry/wall_layers.h"

#include "base/random.h"
#include "geometry/contour.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>

namespace brisance {
namespace {

constexpr double fine = 0.25;          ///< side of a contour cell / least spacing
constexpr double nearest_pair = 0.62;  ///< of the spacing: points nearer to an earlier one are left out

/// Integral of ds / spacing along a segment, by Simpson's rule.
double count_along(const Section& section, Vec2 a, Vec2 b) {
    const double ends = 1 / section.spacing(a) + 1 / section.spacing(b);
    const double quarters = 1 / section.spacing(0.75 * a + 0.25 * b) + 1 / section.spacing(0.25 * a + 0.75 * b);
    return norm(b - a) / 12 * (ends + 4 * quarters + 2 / section.spacing(0.5 * (a + b)));
}

/// Thick enough for `layers` at both walls and a relaxed cloud between them.
int most_across(int layers) { return 2 * layers + 3; }

/// The depth in layers at which layer `l` runs at p, or nothing where it does not exist.
std::optional<double> level_of(const LayerDepth& d, int l, int layers) {
    if (d.across == 0 ? l < layers : 2 * l + 1 <= d.across) return l + 0.5;
    return std::nullopt;
}
bool in_the_middle(const LayerDepth& d, int l) { return d.across == 2 * l + 1; }

/// One kind of layer, as the zero line of a function. A middle layer lies on the ridge of the depth, which is no zero line;
/// it is traced a quarter of a layer before, from both sides, then pushed onto the ridge.
class Layer {
public:
    Layer(const Section& section, int l, int layers) : section_(section), l_(l), layers_(layers) {}

    double operator()(const LayerDepth& d) const {
        const auto level = level_of(d, l_, layers_);
        return d.layers < 0 || !level ? -1 : d.layers - traced(d, *level);
    }
    double operator()(Vec2 p) const { return (*this)(layer_depth(section_, p, layers_)); }

    struct Foot {
        Vec2 traced, p, normal;  ///< on the traced line, and on the layer
        bool middle;
    };
    /// Moves a point along the normal onto the layer. Nothing where the traced line was a mere jump between thick and thin.
    std::optional<Foot> project(Vec2 p) const {
        for (int i = 0; i < 12; ++i) {
            const LayerDepth d = layer_depth(section_, p, layers_);
            const auto level = level_of(d, l_, layers_);
            if (!level || !(d.layers > 0)) return std::nullopt;
            const double depth = section_.depth(p);
            const Vec2 n = section_.normal(p);
            if (std::abs(d.layers - traced(d, *level)) < 1e-9) {
                const bool middle = in_the_middle(d, l_);
                return Foot{p, middle ? p - depth * (*level / d.layers - 1) * n : p, n, middle};
            }
            p = p - depth * (traced(d, *level) / d.layers - 1) * n;
        }
        return std::nullopt;
    }

private:
    double traced(const LayerDepth& d, double level) const { return in_the_middle(d, l_) ? level - 0.25 : level; }

    const Section& section_;
    int l_, layers_;
};

/// Cells of a grid of side `side` near any layer. The grid's lines are those of the quadtree, so it turns with the frame.
CellSet cells_near_layers(const Section& section, const std::vector<Leaf>& leaves, int layers) {
    const auto near_wall = [&](const Leaf& leaf) {
        const double deepest = (layers + 2) * 1.1 * leaf.spacing;
        return leaf.depth < deepest + leaf.side;
    };
    double least_spacing = 0;
    for (const Leaf& leaf : leaves) {
        if (near_wall(leaf) && (least_spacing == 0 || leaf.spacing < least_spacing)) least_spacing = leaf.spacing;
    }
    CellSet set{{-section.reach, -section.reach}, 2 * section.reach, {}};
    while (set.side > fine * least_spacing) set.side *= 0.5;

    for (const Leaf& leaf : leaves) {
        if (!near_wall(leaf)) continue;
        const int n = std::max(1, static_cast<int>(std::lround(leaf.side / set.side)));
        const Vec2 corner = leaf.centre - Vec2{0.5 * leaf.side, 0.5 * leaf.side} - set.origin;
        const auto i0 = static_cast<std::int32_t>(std::lround(corner.x / set.side));
        const auto j0 = static_cast<std::int32_t>(std::lround(corner.y / set.side));
        for (int j = 0; j < n; ++j) {
            for (int i = 0; i < n; ++i) {
                const Vec2 centre = set.origin + set.side * Vec2{i0 + i + 0.5, j0 + j + 0.5};
                const double depth = section.depth(centre);
                if (depth > -set.side && depth < (layers + 2) * 1.1 * leaf.spacing) set.cells.push_back({i0 + i, j0 + j});
            }
        }
    }
    return set;
}

/// Accepted points, for the question whether a new one comes too near.
class Accepted {
public:
    explicit Accepted(double cell) : cell_(cell) {}

    bool add(Vec2 p, double distance) {
        const auto reach = static_cast<std::int64_t>(std::ceil(distance / cell_));
        const auto i = static_cast<std::int64_t>(std::floor(p.x / cell_)), j = static_cast<std::int64_t>(std::floor(p.y / cell_));
        for (std::int64_t b = j - reach; b <= j + reach; ++b) {
            for (std::int64_t a = i - reach; a <= i + reach; ++a) {
                const auto it = cells_.find(key(a, b));
                if (it == cells_.end()) continue;
                for (const Vec2 q : it->second) {
                    if (norm(q - p) < distance) return false;
                }
            }
        }
        cells_[key(i, j)].push_back(p);
        return true;
    }

private:
    static std::uint64_t key(std::int64_t i, std::int64_t j) {
        return (static_cast<std::uint64_t>(i) << 32) ^ (static_cast<std::uint64_t>(j) & 0xffffffffULL);
    }
    double cell_;
    std::unordered_map<std::uint64_t, std::vector<Vec2>> cells_;
};

/// A layer's line after projection: vertices on the layer, with the corners of the wall put in.
struct Track {
    std::vector<Vec2> traced, p;  ///< as in Layer::Foot
    std::vector<Vec2> normal;
    std::vector<bool> corner;
    bool closed = false, middle = false;
};

/// Projects the vertices of a contour; where that fails the line is cut.
std::vector<Track> tracks(const Layer& layer, const Polyline& line) {
    std::vector<Track> result;
    std::vector<std::optional<Layer::Foot>> feet(line.vertices.size());
#pragma omp parallel for if (feet.size() > 500)
    for (std::size_t i = 0; i < feet.size(); ++i) feet[i] = layer.project(line.vertices[i]);

    const std::size_t n = feet.size();
    std::size_t first = 0;  // a closed line that will be cut starts after a cut
    bool whole = line.closed;
    for (std::size_t i = 0; i < n; ++i) {
        if (!feet[i]) {
            whole = false;
            if (line.closed) first = i;
        }
    }
    Track track;
    const auto finish = [&] {
        if (!track.p.empty()) result.push_back(std::move(track));
        track = {};
    };
    for (std::size_t k = 0; k < n; ++k) {
        const auto& foot = feet[(first + k) % n];
        if (!foot || (!track.p.empty() && foot->middle != track.middle)) finish();
        if (!foot) continue;
        track.middle = foot->middle;
        track.traced.push_back(foot->traced);
        track.p.push_back(foot->p);
        track.normal.push_back(foot->normal);
        track.corner.push_back(false);
    }
    if (whole && result.empty()) track.closed = true;
    finish();
    return result;
}

/// Where the tangents of two neighbouring vertices meet at an angle and the meeting point lies just as deep, the wall has a
/// corner: it becomes a vertex. (On a round wall the meeting point lies less or more deep, by turn^2 / 8 radii.)
void find_corners(Track& track, const Section& section, double cell) {
    constexpr double least_turn = 0.5;  // rad
    Track out;
    out.closed = track.closed;
    out.middle = track.middle;
    const std::size_t n = track.p.size();
    for (std::size_t i = 0; i < n; ++i) {
        out.traced.push_back(track.p[i]);
        out.p.push_back(track.p[i]);
        out.normal.push_back(track.normal[i]);
        out.corner.push_back(false);
        if (i + 1 == n && !track.closed) break;
        const std::size_t j = (i + 1) % n;
        const Vec2 a = track.normal[i], b = track.normal[j];
        const double sine = a.x * b.y - a.y * b.x;
        if (std::abs(sine) < std::sin(least_turn)) continue;
        // q with (q - p_i) . a = 0 and (q - p_j) . b = 0
        const double ca = dot(track.p[i], a), cb = dot(track.p[j], b);
        const Vec2 q{(ca * b.y - cb * a.y) / sine, (a.x * cb - b.x * ca) / sine};
        if (norm(q - track.p[i]) > 2 * cell || norm(q - track.p[j]) > 2 * cell) continue;
        const double expected = std::min(section.depth(track.p[i]), section.depth(track.p[j]));
        if (std::abs(section.depth(q) - expected) > 0.01 * section.spacing(q)) continue;
        out.traced.push_back(q);
        out.p.push_back(q);
        out.normal.push_back(a);
        out.corner.push_back(true);
    }
    track = std::move(out);
}

/// Points at equal counts of ds / spacing along the track; a closed one without corners starts at a random phase.
/// `usual`: the place of points that are not in corners.
void resample(const Section& section, const Layer& layer, const Track& track, int l, WallPoint::Place usual, double phase,
              Accepted& accepted, std::vector<WallPoint>& points) {
    const auto accept = [&](Vec2 p, WallPoint::Place place) {
        if (section.distance(p) < 0 && accepted.add(p, nearest_pair * section.spacing(p))) points.push_back({p, l, place});
    };
    const std::size_t n = track.p.size();
    /// The point between the vertices i and i + 1: interpolated on the traced line, then moved onto the layer.
    const auto place = [&](std::size_t i, double t) {
        const std::size_t next = (i + 1) % n;
        const Vec2 p = (1 - t) * track.p[i] + t * track.p[next];
        const auto foot = layer.project((1 - t) * track.traced[i] + t * track.traced[next]);
        accept(foot && norm(foot->p - p) < 0.2 * section.spacing(p) ? foot->p : p, usual);
    };
    std::vector<std::size_t> corners;
    for (std::size_t i = 0; i < track.p.size(); ++i) {
        if (track.corner[i]) corners.push_back(i);
    }
    for (const std::size_t i : corners) accept(track.p[i], WallPoint::Place::corner);

    // Stretches between corners, or the whole line.
    struct Stretch {
        std::size_t from, steps;
        bool from_corner, to_corner;
    };
    std::vector<Stretch> stretches;
    if (track.closed && corners.empty()) {
        stretches.push_back({0, n, false, false});
    } else if (track.closed) {
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const std::size_t to = corners[(k + 1) % corners.size()];
            stretches.push_back({corners[k], (to + n - corners[k] - 1) % n + 1, true, true});
        }
    } else {
        std::size_t from = 0;
        bool from_corner = false;
        for (const std::size_t c : corners) {
            stretches.push_back({from, c - from, from_corner, true});
            from = c;
            from_corner = true;
        }
        stretches.push_back({from, n - 1 - from, from_corner, false});
    }

    for (const Stretch& s : stretches) {
        std::vector<double> count{0};
        for (std::size_t k = 0; k < s.steps; ++k) {
            const Vec2 a = track.p[(s.from + k) % n], b = track.p[(s.from + k + 1) % n];
            count.push_back(count.back() + norm(b - a) / section.spacing(0.5 * (a + b)));
        }
        // First and last point stand one interval from a corner, half an interval from a free end.
        const bool ring = track.closed && corners.empty();
        const double first = ring ? phase : s.from_corner ? 1.0 : 0.5;
        const double last = ring ? 1 - phase : s.to_corner ? 1.0 : 0.5;
        const double least = s.from_corner || s.to_corner ? 0 : 1;
        const double m = std::max(least, std::round(count.back() - first - last + 1));
        const double interval = count.back() / (m - 1 + first + last);
        std::size_t k = 0;
        for (double i = 0; i < m; ++i) {
            const double at = (i + first) * interval;
            while (k + 2 < count.size() && count[k + 1] <= at) ++k;
            const double step = s.steps > 0 ? count[k + 1] - count[k] : 0;
            place((s.from + k) % n, step > 0 ? std::clamp((at - count[k]) / step, 0.0, 1.0) : 0.0);
        }
    }
}

}  // namespace

LayerDepth layer_depth(const Section& section, Vec2 p, int wall_layers) {
    const double depth = section.depth(p);
    const double spacing = section.spacing(p);
    if (depth < 0) return {depth / spacing, 0};
    const Vec2 n = section.normal(p);
    const double near = count_along(section, p, p + depth * n);

    // To the opposite wall: no wall is nearer than the depth, so each step may be that long.
    const double farthest = 1.5 * (most_across(wall_layers) + 1) * spacing;
    double t = std::max(depth, 1e-9 * spacing);
    for (int i = 0; i < 200 && t < farthest; ++i) {
        const double step = section.depth(p - t * n);
        if (step < 1e-9 * spacing) break;
        t += step;
    }
    if (t >= farthest) return {near, 0};
    const double total = near + count_along(section, p, p - t * n);
    // Round, and let no round-off decide where people's numbers give just half a layer.
    const double across = std::floor(total + 0.5 + 1e-6);
    if (across > most_across(wall_layers)) return {near, 0};
    if (across < 1) return {-1, 0};  // thinner than half a spacing: no layer fits
    return {near * across / total, static_cast<int>(across)};
}

std::vector<WallPoint> wall_layers(const Section& section, const std::vector<Leaf>& leaves, int layers, std::uint64_t seed) {
    const CellSet set = cells_near_layers(section, leaves, layers);
    std::vector<LayerDepth> depth(set.cells.size());
    std::vector<double> spacing(set.cells.size());
#pragma omp parallel for schedule(static)
    for (std::size_t c = 0; c < set.cells.size(); ++c) {
        const Vec2 centre = set.origin + set.side * Vec2{set.cells[c].i + 0.5, set.cells[c].j + 0.5};
        depth[c] = layer_depth(section, centre, layers);
        spacing[c] = section.spacing(centre);
    }

    std::vector<WallPoint> points;
    Accepted accepted(4 * set.side);
    std::uint64_t stream = 0;
    for (int l = 0; 2 * l + 1 <= most_across(layers); ++l) {
        const Layer layer(section, l, layers);
        CellSet near{set.origin, set.side, {}};
        for (std::size_t c = 0; c < set.cells.size(); ++c) {
            // A layer is at least half a spacing thick, and a corner of the cell at most 0.71 sides from its centre.
            const bool exists = depth[c].layers < 0 || level_of(depth[c], l, layers);
            if (exists && (depth[c].layers < 0 || std::abs(layer(depth[c])) < 1.5 * set.side / spacing[c])) {
                near.cells.push_back(set.cells[c]);
            }
        }
        for (const Polyline& line : contour(near, [&](Vec2 p) { return layer(p); })) {
            for (Track& track : tracks(layer, line)) {
                if (!track.middle) find_corners(track, section, set.side);
                const WallPoint::Place usual = !track.closed && l >= layers ? WallPoint::Place::inside
                                               : track.middle               ? WallPoint::Place::middle
                                                                            : WallPoint::Place::along_wall;
                resample(section, layer, track, l, usual, random_uniform(seed, 1, stream++), accepted, points);
            }
        }
    }
    return points;
}

}  // namespace brisance
