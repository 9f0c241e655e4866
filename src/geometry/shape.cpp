// SPDX-License-Identifier: Apache-2.0
#include "geometry/shape.h"

#include "base/error.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace brisance {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double far_away = 1e9;  ///< mm; a section that there is not, finite so that differences of distances stay numbers

/// Signed distance to a rectangle |a| < half_a, |b| < half_b from the two signed distances a' = |a| - half_a, b' = |b| - half_b.
double corner_distance(double a, double b) {
    const double outside = std::hypot(std::max(a, 0.0), std::max(b, 0.0));
    return outside > 0 ? outside : std::max(a, b);
}

/// Solids of revolution about a segment: a cylinder is an annulus without a hole.
class Annulus final : public Shape {
public:
    Annulus(Point from, Point to, double inner, double outer) : inner_(inner), outer_(outer) {
        const Point along = to - from;
        const double length = norm(along);
        if (!(length > 0)) throw InputError("a cylinder needs two different ends of its axis");
        if (!(outer > inner) || !(inner >= 0)) throw InputError("a cylinder needs 0 <= inner radius < outer radius");
        axis_ = (1 / length) * along;
        centre_ = 0.5 * (from + to);
        half_length_ = 0.5 * length;
    }

    double distance(Point p) const override {
        // Its meridian half-plane shows a rectangle: z within the length, r within the wall.
        const double z = dot(p - centre_, axis_);
        return corner_distance(radial(p, z), std::abs(z) - half_length_);
    }
    double section_distance(Point p) const override {
        if (std::abs(axis_.z) < 1 - 1e-12) return distance(p);
        const double z = dot(p - centre_, axis_);
        return std::abs(z) <= half_length_ ? radial(p, z) : far_away;
    }

    Box bounds() const override {
        // The rim of a disc with normal a reaches radius * sqrt(1 - a_x^2) along x.
        const auto reach = [this](double a) { return half_length_ * std::abs(a) + outer_ * std::sqrt(std::max(0.0, 1 - a * a)); };
        const Point half{reach(axis_.x), reach(axis_.y), reach(axis_.z)};
        return {centre_ - half, centre_ + half};
    }

private:
    double radial(Point p, double z) const {
        const double r = norm(p - centre_ - z * axis_);
        return inner_ > 0 ? std::max(r - outer_, inner_ - r) : r - outer_;
    }
    Point centre_, axis_;
    double half_length_ = 0, inner_, outer_;
};

class Block final : public Shape {
public:
    Block(Point min, Point max) : min_(min), max_(max) {
        if (!(max.x > min.x && max.y > min.y && max.z > min.z)) throw InputError("a box needs min < max along x, y and z");
    }

    double distance(Point p) const override {
        const Point centre = 0.5 * (min_ + max_), half = 0.5 * (max_ - min_);
        const double x = std::abs(p.x - centre.x) - half.x;
        const double y = std::abs(p.y - centre.y) - half.y;
        const double z = std::abs(p.z - centre.z) - half.z;
        const double outside = norm(Point{std::max(x, 0.0), std::max(y, 0.0), std::max(z, 0.0)});
        return outside > 0 ? outside : std::max({x, y, z});
    }

    double section_distance(Point p) const override {
        if (p.z < min_.z || p.z > max_.z) return far_away;
        return corner_distance(std::abs(p.x - 0.5 * (min_.x + max_.x)) - 0.5 * (max_.x - min_.x),
                               std::abs(p.y - 0.5 * (min_.y + max_.y)) - 0.5 * (max_.y - min_.y));
    }
    Box bounds() const override { return {min_, max_}; }

private:
    Point min_, max_;
};

class Sphere final : public Shape {
public:
    Sphere(Point centre, double radius) : centre_(centre), radius_(radius) {
        if (!(radius > 0)) throw InputError("a sphere needs a radius > 0");
    }
    double distance(Point p) const override { return norm(p - centre_) - radius_; }
    double section_distance(Point p) const override {
        const double z = p.z - centre_.z;
        return std::abs(z) < radius_ ? std::hypot(p.x - centre_.x, p.y - centre_.y) - std::sqrt(radius_ * radius_ - z * z) : far_away;
    }
    Box bounds() const override {
        const Point half{radius_, radius_, radius_};
        return {centre_ - half, centre_ + half};
    }

private:
    Point centre_;
    double radius_;
};

class HalfSpace final : public Shape {
public:
    HalfSpace(Point point, Point normal) : point_(point) {
        const double length = norm(normal);
        if (!(length > 0)) throw InputError("a half-space needs a normal that is not zero");
        normal_ = (1 / length) * normal;
    }
    double distance(Point p) const override { return dot(p - point_, normal_); }
    double section_distance(Point p) const override {
        const double d = distance(p), slope = std::hypot(normal_.x, normal_.y);
        return slope > 1e-12 ? d / slope : (d > 0 ? far_away : -far_away);
    }
    Box bounds() const override { return {{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}}; }

private:
    Point point_, normal_;
};

Point least(Point a, Point b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
Point greatest(Point a, Point b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }

class Union final : public Shape {
public:
    explicit Union(std::vector<ShapePtr> parts) : parts_(std::move(parts)) {
        if (parts_.empty()) throw InputError("a union needs at least one part");
    }
    double distance(Point p) const override {
        double d = infinity;
        for (const ShapePtr& part : parts_) d = std::min(d, part->distance(p));
        return d;
    }
    double section_distance(Point p) const override {
        double d = infinity;
        for (const ShapePtr& part : parts_) d = std::min(d, part->section_distance(p));
        return d;
    }
    Box bounds() const override {
        Box box = parts_.front()->bounds();
        for (const ShapePtr& part : parts_) {
            const Box b = part->bounds();
            box = {least(box.min, b.min), greatest(box.max, b.max)};
        }
        return box;
    }

private:
    std::vector<ShapePtr> parts_;
};

class Intersection final : public Shape {
public:
    explicit Intersection(std::vector<ShapePtr> parts) : parts_(std::move(parts)) {
        if (parts_.empty()) throw InputError("an intersection needs at least one part");
    }
    double distance(Point p) const override {
        double d = -infinity;
        for (const ShapePtr& part : parts_) d = std::max(d, part->distance(p));
        return d;
    }
    double section_distance(Point p) const override {
        double d = -infinity;
        for (const ShapePtr& part : parts_) d = std::max(d, part->section_distance(p));
        return d;
    }
    Box bounds() const override {
        Box box = parts_.front()->bounds();
        for (const ShapePtr& part : parts_) {
            const Box b = part->bounds();
            box = {greatest(box.min, b.min), least(box.max, b.max)};
        }
        return box;
    }

private:
    std::vector<ShapePtr> parts_;
};

class Difference final : public Shape {
public:
    Difference(ShapePtr first, std::vector<ShapePtr> others) : first_(std::move(first)), others_(std::move(others)) {}
    double distance(Point p) const override {
        double d = first_->distance(p);
        for (const ShapePtr& other : others_) d = std::max(d, -other->distance(p));
        return d;
    }
    double section_distance(Point p) const override {
        double d = first_->section_distance(p);
        for (const ShapePtr& other : others_) d = std::max(d, -other->section_distance(p));
        return d;
    }
    Box bounds() const override { return first_->bounds(); }

private:
    ShapePtr first_;
    std::vector<ShapePtr> others_;
};

}  // namespace

ShapePtr make_cylinder(Point from, Point to, double radius) { return std::make_shared<Annulus>(from, to, 0.0, radius); }
ShapePtr make_annulus(Point from, Point to, double inner_radius, double outer_radius) {
    return std::make_shared<Annulus>(from, to, inner_radius, outer_radius);
}
ShapePtr make_box(Point min, Point max) { return std::make_shared<Block>(min, max); }
ShapePtr make_sphere(Point centre, double radius) { return std::make_shared<Sphere>(centre, radius); }
ShapePtr make_half_space(Point point, Point normal) { return std::make_shared<HalfSpace>(point, normal); }
ShapePtr make_union(std::vector<ShapePtr> parts) { return std::make_shared<Union>(std::move(parts)); }
ShapePtr make_intersection(std::vector<ShapePtr> parts) { return std::make_shared<Intersection>(std::move(parts)); }
ShapePtr make_difference(ShapePtr first, std::vector<ShapePtr> others) {
    return std::make_shared<Difference>(std::move(first), std::move(others));
}

}  // namespace brisance
