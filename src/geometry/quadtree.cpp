// SPDX-License-Identifier: Apache-2.0
#include "geometry/quadtree.h"

#include "base/error.h"

#include <numbers>

namespace brisance {
namespace {

class Cutter {
public:
    Cutter(const Section& section, double fineness) : section_(section), fineness_(fineness) {}

    /// The square with the corner `o` and the edges a and b, with |a| = |b| = side. The curve enters at o and leaves at o + a.
    void cut(Vec2 o, Vec2 a, Vec2 b, double side) {
        const Vec2 centre = o + 0.5 * (a + b);
        const double depth = section_.depth(centre);
        const double half_diagonal = 0.5 * std::numbers::sqrt2 * side;
        if (depth < -half_diagonal) return;  // a distance changes by no more than the way gone: no wall in this square
        const double spacing = section_.spacing(centre);
        if (!(spacing > 0) || !std::isfinite(spacing)) throw InputError("the spacing of a cloud must be > 0 everywhere in its region");
        if (side <= fineness_ * spacing) {
            leaves.push_back({centre, side, spacing, depth});
            return;
        }
        const Vec2 ha = 0.5 * a, hb = 0.5 * b;
        cut(o, hb, ha, 0.5 * side);
        cut(o + hb, ha, hb, 0.5 * side);
        cut(o + ha + hb, ha, hb, 0.5 * side);
        cut(o + a + hb, -1.0 * hb, -1.0 * ha, 0.5 * side);
    }

    std::vector<Leaf> leaves;

private:
    const Section& section_;
    double fineness_;
};

}  // namespace

std::vector<Leaf> quadtree(const Section& section, double fineness) {
    Cutter cutter(section, fineness);
    const double side = 2 * section.reach;
    cutter.cut({-section.reach, -section.reach}, {side, 0}, {0, side}, side);
    return std::move(cutter.leaves);
}

}  // namespace brisance
