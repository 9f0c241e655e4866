// SPDX-License-Identifier: Apache-2.0
// Solids in space as signed distances (mm, negative inside), and their unions, differences and intersections.
#pragma once

#include "math/vec.h"

#include <memory>
#include <vector>

namespace brisance {

using Point = Vec3<double>;

struct Box {
    Point min, max;
};

class Shape {
public:
    virtual ~Shape() = default;
    /// Signed distance to the surface, mm; negative inside. Exact for primitives; for combinations its sign is exact and its size a bound.
    virtual double distance(Point p) const = 0;
    /// Signed distance, within the plane z = p.z, to the boundary of the shape's cut with that plane, mm; large where the plane misses the
    /// shape or lies inside it altogether. `distance` would see end faces that a section does not have. A cylinder that is not along z
    /// answers with `distance`, a bound.
    virtual double section_distance(Point p) const = 0;
    /// An axis-aligned box that holds the shape (infinite for half-spaces).
    virtual Box bounds() const = 0;
    bool contains(Point p) const { return distance(p) < 0; }
};

using ShapePtr = std::shared_ptr<const Shape>;

/// A cylinder whose axis runs from `from` to `to`.
ShapePtr make_cylinder(Point from, Point to, double radius);
/// A cylinder with a coaxial hole.
ShapePtr make_annulus(Point from, Point to, double inner_radius, double outer_radius);
ShapePtr make_box(Point min, Point max);
ShapePtr make_sphere(Point centre, double radius);
/// All points p with (p - point) . normal < 0.
ShapePtr make_half_space(Point point, Point normal);
ShapePtr make_union(std::vector<ShapePtr> parts);
ShapePtr make_intersection(std::vector<ShapePtr> parts);
/// `first` without all of `others`.
ShapePtr make_difference(ShapePtr first, std::vector<ShapePtr> others);

}  // namespace brisance
