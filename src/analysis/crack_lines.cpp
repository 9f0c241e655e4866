// SPDX-License-Identifier: Apache-2.0
#include "analysis/crack_lines.h"

#include "analysis/distance_map.h"
#include "analysis/thinning.h"

#include <algorithm>
#include <cmath>

namespace brisance::analysis {

namespace {

/// An end of a line (one pixel), or a cluster of pixels where three or more lines meet.
struct Node {
    std::vector<std::size_t> pixels;
    Vec2 centre;
    double width = 0;             ///< mm, to the edge of the damage
    std::vector<std::size_t> branches;  ///< a branch from the node to itself stands twice
};

/// A line from one node to another, without the nodes' pixels. A loop has no nodes.
struct Branch {
    static constexpr std::size_t none = static_cast<std::size_t>(-1);
    std::size_t from = none, to = none;
    std::vector<std::size_t> pixels;
};

struct Graph {
    std::vector<Node> nodes;
    std::vector<Branch> branches;
};

double half_width(const DamageRaster& raster, const std::vector<float>& depth, std::size_t p) { return raster.pixel * (depth[p] - 0.5); }

class Tracer {
public:
    Tracer(const DamageRaster& raster, const std::vector<float>& depth, const Mask& skeleton)
        : raster_(raster), depth_(depth), skeleton_(skeleton), step_(raster.neighbours()), node_(skeleton.size(), -1),
          visited_(skeleton.size(), 0) {}

    Graph trace() {
        for (std::size_t p = 0; p < skeleton_.size(); ++p)
            if (skeleton_[p] && node_[p] < 0 && neighbours(p).size() != 2) gather_node(p);
        for (std::size_t n = 0; n < graph_.nodes.size(); ++n)
            for (std::size_t k = 0; k < graph_.nodes[n].pixels.size(); ++k) leave_node(n, graph_.nodes[n].pixels[k]);
        for (std::size_t p = 0; p < skeleton_.size(); ++p)
            if (skeleton_[p] && node_[p] < 0 && !visited_[p]) follow_loop(p);
        return std::move(graph_);
    }

private:
    std::vector<std::size_t> neighbours(std::size_t p) const {
        std::vector<std::size_t> list;
        for (std::ptrdiff_t s : step_)
            if (const std::size_t q = p + static_cast<std::size_t>(s); skeleton_[q]) list.push_back(q);
        return list;
    }

    void gather_node(std::size_t start) {
        Node node;
        const auto label = static_cast<std::int32_t>(graph_.nodes.size());
        node.pixels.push_back(start);
        node_[start] = label;
        if (neighbours(start).size() > 2)
            for (std::size_t k = 0; k < node.pixels.size(); ++k)
                for (std::size_t q : neighbours(node.pixels[k]))
                    if (node_[q] < 0 && neighbours(q).size() > 2) {
                        node_[q] = label;
                        node.pixels.push_back(q);
                    }
        for (std::size_t p : node.pixels) {
            node.centre = node.centre + (1 / static_cast<double>(node.pixels.size())) * Vec2{raster_.x(p), raster_.y(p)};
            node.width = std::max(node.width, half_width(raster_, depth_, p));
        }
        graph_.nodes.push_back(std::move(node));
    }

    void leave_node(std::size_t n, std::size_t from) {
        for (std::size_t p : neighbours(from)) {
            Branch branch;
            branch.from = n;
            if (node_[p] >= 0) {  // nodes side by side, at least one of them an end: no pixel between them
                branch.to = static_cast<std::size_t>(node_[p]);
                if (branch.to > n) add(std::move(branch));
                continue;
            }
            if (visited_[p]) continue;
            std::size_t before = from, here = p;
            while (node_[here] < 0) {
                visited_[here] = 1;
                branch.pixels.push_back(here);
                const std::size_t after = other_neighbour(here, before);
                before = here;
                here = after;
            }
            branch.to = static_cast<std::size_t>(node_[here]);
            add(std::move(branch));
        }
    }

    void follow_loop(std::size_t start) {
        Branch branch;
        std::size_t before = neighbours(start)[0], here = start;
        while (!visited_[here]) {
            visited_[here] = 1;
            branch.pixels.push_back(here);
            const std::size_t after = other_neighbour(here, before);
            before = here;
            here = after;
        }
        graph_.branches.push_back(std::move(branch));
    }

    std::size_t other_neighbour(std::size_t p, std::size_t than) const {
        const auto two = neighbours(p);
        return two[0] == than ? two[1] : two[0];
    }

    void add(Branch branch) {
        graph_.nodes[branch.from].branches.push_back(graph_.branches.size());
        graph_.nodes[branch.to].branches.push_back(graph_.branches.size());
        graph_.branches.push_back(std::move(branch));
    }

    const DamageRaster& raster_;
    const std::vector<float>& depth_;
    const Mask& skeleton_;
    std::array<std::ptrdiff_t, 8> step_;
    std::vector<std::int32_t> node_;
    Mask visited_;
    Graph graph_;
};

std::vector<Vec2> corners(const DamageRaster& raster, const Graph& graph, const Branch& branch) {
    std::vector<Vec2> line;
    if (branch.from != Branch::none) line.push_back(graph.nodes[branch.from].centre);
    for (std::size_t p : branch.pixels) line.push_back({raster.x(p), raster.y(p)});
    if (branch.to != Branch::none) line.push_back(graph.nodes[branch.to].centre);
    else if (!line.empty()) line.push_back(line.front());
    return line;
}

double length_of(const std::vector<Vec2>& line) {
    double sum = 0;
    for (std::size_t i = 1; i < line.size(); ++i) sum += norm(line[i] - line[i - 1]);
    return sum;
}

/// Mean size, mm, of the particles that own the pixels.
double size_at(const SectionPoints& points, const DamageRaster& raster, const std::vector<std::size_t>& pixels) {
    double sum = 0;
    for (std::size_t p : pixels) sum += points.size[static_cast<std::size_t>(raster.owner[p])];
    return sum / static_cast<double>(pixels.size());
}

/// A disc inside the damage.
struct Disc {
    Vec2 centre;
    double radius;
};

/// The discs around lines that lead from junction to junction or close on themselves, where they are broader than roughness.
std::vector<Disc> broad_discs(const SectionPoints& points, const DamageRaster& raster, const std::vector<float>& depth,
                              const Graph& graph, double spur) {
    const auto free_end = [&](std::size_t n) { return n != Branch::none && graph.nodes[n].branches.size() == 1; };
    std::vector<Disc> discs;
    for (const Branch& branch : graph.branches) {
        if (free_end(branch.from) || free_end(branch.to)) continue;
        for (std::size_t p : branch.pixels)
            if (const double w = half_width(raster, depth, p); w > spur * points.size[static_cast<std::size_t>(raster.owner[p])])
                discs.push_back({{raster.x(p), raster.y(p)}, w});
    }
    return discs;
}

/// Takes the spurs out of the skeleton; says whether there were any.
bool remove_spurs(const SectionPoints& points, const DamageRaster& raster, const std::vector<float>& depth,
                  const Graph& graph, double spur, Mask& skeleton) {
    struct Candidate {
        std::size_t branch, end;
        double length;
    };
    const auto discs = broad_discs(points, raster, depth, graph, spur);
    const auto stands_out = [&](const Node& tip, const Node& junction) {
        double least = norm(tip.centre - junction.centre) - junction.width;
        for (const Disc& d : discs) least = std::min(least, norm(tip.centre - d.centre) - d.radius);
        return least + tip.width;
    };
    bool removed = false;
    for (const Node& junction : graph.nodes) {
        if (junction.branches.size() < 2) continue;
        std::vector<Candidate> spurs;
        for (std::size_t b : junction.branches) {
            const Branch& branch = graph.branches[b];
            const std::size_t end = &graph.nodes[branch.from] == &junction ? branch.to : branch.from;
            const Node& tip = graph.nodes[end];
            if (tip.branches.size() != 1) continue;
            const double length = length_of(corners(raster, graph, branch));
            if (stands_out(tip, junction) < spur * size_at(points, raster, tip.pixels)) spurs.push_back({b, end, length});
        }
        if (spurs.size() == junction.branches.size()) {
            std::stable_sort(spurs.begin(), spurs.end(), [](const Candidate& a, const Candidate& b) { return a.length > b.length; });
            spurs.erase(spurs.begin(), spurs.begin() + 2);
        }
        for (const Candidate& s : spurs) {
            for (std::size_t p : graph.branches[s.branch].pixels) skeleton[p] = 0;
            for (std::size_t p : graph.nodes[s.end].pixels) skeleton[p] = 0;
            removed = true;
        }
    }
    return removed;
}

/// Moving average over up to `reach` points on either side; the ends of an open line stay where they are.
std::vector<Vec2> smoothed(const std::vector<Vec2>& line, std::size_t reach, bool closed) {
    std::vector<Vec2> result(line);
    const std::size_t n = line.size();
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t ring = n - 1;  // a loop repeats its first point
        const std::size_t w = closed ? std::min(reach, (ring - 1) / 2) : std::min({reach, i, n - 1 - i});
        Vec2 sum{};
        for (std::size_t k = 0; k <= 2 * w; ++k) sum = sum + line[closed ? (i + ring - w + k) % ring : i - w + k];
        result[i] = (1 / static_cast<double>(2 * w + 1)) * sum;
    }
    return result;
}

}  // namespace

double CrackLine::length() const { return length_of(points) + tip_first + tip_last; }

std::vector<CrackLine> crack_lines(const SectionPoints& points, const DamageRaster& raster, const Mask& mask, const LineOptions& options) {
    const std::vector<float> depth = distance_to_unset(raster, mask);
    Mask skeleton = thin(raster, mask, depth);
    Graph graph = Tracer(raster, depth, skeleton).trace();
    while (remove_spurs(points, raster, depth, graph, options.spur, skeleton)) {
        tidy(raster, skeleton);
        graph = Tracer(raster, depth, skeleton).trace();
    }
    const auto tip = [&](std::size_t n) { return n != Branch::none && graph.nodes[n].branches.size() == 1 ? graph.nodes[n].width : 0.0; };
    std::vector<CrackLine> lines;
    for (const Branch& branch : graph.branches) {
        const double size = size_at(points, raster, branch.pixels.empty() ? graph.nodes[branch.from].pixels : branch.pixels);
        const auto reach = static_cast<std::size_t>(std::lround(options.smoothing * size / raster.pixel));
        CrackLine line;
        line.points = smoothed(corners(raster, graph, branch), reach, branch.from == Branch::none);
        line.tip_first = tip(branch.from);
        line.tip_last = tip(branch.to);
        lines.push_back(std::move(line));
    }
    for (const Node& node : graph.nodes)
        if (node.branches.empty()) lines.push_back({{node.centre}, node.width, node.width});
    return lines;
}

}  // namespace brisance::analysis
