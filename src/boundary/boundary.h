// SPDX-License-Identifier: Apache-2.0
// What holds or loads the parts from outside: fixed planes, rigid platens, prescribed pressure on walls. Few particles, so the processor's.
#pragma once

#include "contact/contact.h"
#include "geometry/shape.h"

namespace brisance {

/// Components of velocity held at zero for the particles of a solid next to a plane, or in a region. Reaction impulse is what momentum misses.
struct FixedPlane {
    std::vector<std::int64_t> slots;
    std::vector<double> mass;  ///< mg
    bool axis[3] = {false, false, false};
};

/// The particles of each column that end at the plane: within one spacing of it (point, normal outward), at the column's end.
template <class R> FixedPlane make_fixed_plane(const SolidBody<R>& body, Point point, Point normal, const bool axis[3]);
/// The particles whose reference place lies inside a shape.
template <class R> FixedPlane make_fixed_region(const SolidBody<R>& body, const Shape& on, const bool axis[3]);
/// Takes the held components out; adds the impulse given by the support to `impulse`, mg mm/us.
template <class R> void hold(const FixedPlane& plane, SolidBody<R>& body, double impulse[3]);

/// A rigid, frictionless plane: penalty on whatever comes closer than half its spacing, or than where it stood at the start if that is
/// closer (columns end where they end). normal points out of the material.
struct Platen {
    Point point{}, normal{};
};
ContactReport press(const Platen& platen, const FluidBody& body, FluidForces& f);
/// For a solid the gap of the reference configuration counts as touching; forces act on all particles whose column ends there.
struct SolidPlaten {
    Platen platen;
    std::vector<std::int64_t> slots;
    std::vector<double> mass, stiffness;   ///< mg, GPa mm
    std::vector<double> fx, fy, fz;
};
template <class R> SolidPlaten make_solid_platen(const SolidBody<R>& body, const Platen& platen);
template <class R> ContactReport press(SolidPlaten& platen, const SolidBody<R>& body);
/// v += kick f/m.
template <class R> void push(const SolidPlaten& platen, SolidBody<R>& body, double kick);

/// Pressure on the points of a solid's wall that lie inside a shape (reference configuration): f = -p(t) A cof(F) N.
struct WallPressure {
    std::vector<std::size_t> points;      ///< of the Surface
    std::vector<double> times, values;    ///< us, GPa, linear between, constant outside
    double at(double time) const;
};
template <class R> WallPressure make_wall_pressure(const SolidBody<R>& body, const Surface& s, const Shape& on, std::vector<double> times, std::vector<double> values);
/// Adds the load to the surface's forces, and to `load` (force on each loaded point) for the work.
template <class R>
void press(const WallPressure& p, double time, const SolidBody<R>& body, const ColumnPairs<R>& pairs, Surface& s, std::vector<Vec3<double>>& load);

}  // namespace brisance
