// SPDX-License-Identifier: Apache-2.0
#include "geometry/contour.h"

#include <algorithm>
#include <array>
#include <unordered_map>

namespace brisance {
namespace {

/// Grid nodes, and the edges that leave them to the right (0) or upwards (1), as one number.
std::uint64_t node_key(std::int32_t i, std::int32_t j) {
    return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(i)) << 31) ^ static_cast<std::uint64_t>(static_cast<std::uint32_t>(j));
}
std::uint64_t edge_key(std::int32_t i, std::int32_t j, unsigned direction) { return 2 * node_key(i, j) + direction; }

/// A vertex of the line and the (at most two) vertices next to it.
struct Vertex {
    Vec2 p;
    std::array<std::size_t, 2> next{};
    int degree = 0;
    bool visited = false;
};

class Lines {
public:
    std::size_t vertex(std::uint64_t key, Vec2 a, Vec2 b, double fa, double fb) {
        const auto [it, added] = index_.try_emplace(key, vertices_.size());
        if (added) vertices_.push_back({a + fa / (fa - fb) * (b - a), {}, 0, false});
        return it->second;
    }

    void join(std::size_t a, std::size_t b) {
        const auto link = [&](Vertex& v, std::size_t to) {
            if (v.degree < 2) v.next[static_cast<std::size_t>(v.degree++)] = to;
        };
        link(vertices_[a], b);
        link(vertices_[b], a);
    }

    std::vector<Polyline> trace() {
        std::vector<Polyline> lines;
        for (const bool ends_only : {true, false}) {  // open lines from their ends first, then the closed ones
            for (std::size_t start = 0; start < vertices_.size(); ++start) {
                if (vertices_[start].visited || (ends_only && vertices_[start].degree != 1)) continue;
                Polyline line;
                line.closed = !ends_only;
                std::size_t at = start;
                while (!vertices_[at].visited) {
                    Vertex& v = vertices_[at];
                    v.visited = true;
                    line.vertices.push_back(v.p);
                    for (int k = 0; k < v.degree; ++k) {
                        if (!vertices_[v.next[static_cast<std::size_t>(k)]].visited) {
                            at = v.next[static_cast<std::size_t>(k)];
                            break;
                        }
                    }
                }
                lines.push_back(std::move(line));
            }
        }
        return lines;
    }

private:
    std::unordered_map<std::uint64_t, std::size_t> index_;
    std::vector<Vertex> vertices_;
};

}  // namespace

std::vector<Polyline> contour(const CellSet& set, const std::function<double(Vec2)>& f) {
    const auto node = [&](std::int32_t i, std::int32_t j) {
        return Vec2{set.origin.x + set.side * i, set.origin.y + set.side * j};
    };
    std::unordered_map<std::uint64_t, double> values;
    const auto value = [&](std::int32_t i, std::int32_t j) {
        const auto [it, added] = values.try_emplace(node_key(i, j), 0.0);
        if (added) it->second = f(node(i, j));
        return it->second;
    };

    Lines lines;
    for (const auto [i, j] : set.cells) {
        // Corners and edges anticlockwise from the lower left; edge e runs from corner e to corner e + 1.
        const std::array<Vec2, 4> p{node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)};
        const std::array<double, 4> v{value(i, j), value(i + 1, j), value(i + 1, j + 1), value(i, j + 1)};
        const std::array<std::uint64_t, 4> key{edge_key(i, j, 0), edge_key(i + 1, j, 1), edge_key(i, j + 1, 0), edge_key(i, j, 1)};
        std::array<std::size_t, 4> crossing{};
        std::size_t count = 0;
        for (std::size_t e = 0; e < 4; ++e) {
            const std::size_t n = (e + 1) % 4;
            if ((v[e] < 0) == (v[n] < 0)) continue;
            // Both cells at an edge must compute the same vertex: always from its lower or left end.
            const bool forward = e < 2;
            crossing[count++] = forward ? lines.vertex(key[e], p[e], p[n], v[e], v[n]) : lines.vertex(key[e], p[n], p[e], v[n], v[e]);
        }
        if (count == 2) {
            lines.join(crossing[0], crossing[1]);
        } else if (count == 4) {  // a saddle: the centre decides which two corners belong together
            const bool with_first = (f(0.5 * (p[0] + p[2])) < 0) == (v[0] < 0);
            lines.join(crossing[0], crossing[with_first ? 1 : 3]);
            lines.join(crossing[2], crossing[with_first ? 3 : 1]);
        }
    }
    return lines.trace();
}

}  // namespace brisance
