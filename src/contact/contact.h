// SPDX-License-Identifier: Apache-2.0
// Penalty contact between parts. Two rules, chosen by the kind of the two:
//
// fluid - fluid: node to node. d_c = (kappa_i + kappa_j)/2 with kappa the current spacing, f = k (d_c - r) along the line of centres.
//
// anything - solid: node to smoothed surface. A solid's first layer carries points on its wall, s_j = x_j + delta_j n_j, and normals
// n_j = cof(F) N/|cof(F) N|; so do the ends of its columns, for fluids. A node i of the other part sees the weighted plane of the points near it,
//   gap = sum omega_ij (x_i - s_j).n_j / sum omega_ij,   f = k (radius_i - gap) (1 + (overlap/radius)^2) n,
// and the reaction goes back to the nodes with the same weights. So a coarse wall is as smooth and as tight as a fine one: node-to-node
// contact would let fine gas through between coarse nodes, and roughen the wall by a quarter of the spacing.
// Where a side meets an end, at the rim of a borehole, the node has a plane of each, and touches the one that it is farther in front of.
//
// Stiffness: the larger of k = factor K A/l from the series of the two moduli rho c^2, and 0.1 m*/dt^2, the hardest spring that the
// step bears with forty contacts at a node. The second matters for gas: a wall at several times its sound speed would run through
// particles held off by their own softness. Damping acts on approach and separation while pressed; no adhesion. Every force has its reaction, so momentum is exact; the work goes into the audit.
#pragma once

#include "contact/node_groups.h"
#include "neighbours/column_pairs.h"
#include "particles/mirrored.h"
#include "particles/solid_body.h"

#include <string>

namespace brisance {

struct ContactOptions {
    double stiffness = 1, damping = 0.05, friction = 0;
    double dt = 0;   ///< us, the step at hand; 0: not known yet
};

/// The walls of a solid as contact sees them: its sides, then the upper ends of its columns, then the lower ones (none in a slice).
struct Surface {
    Array<std::int64_t> slot;    ///< of the particle behind each surface point
    Array<std::int32_t> column;
    Array<double> x, y, z, nx, ny, nz;      ///< current point on the wall, outward normal
    Array<double> vx, vy, vz;               ///< velocity (of t_n-1/2)
    Array<double> mass, area, spacing, dz;  ///< mg, mm2 (reference), mm
    Array<double> modulus;                  ///< GPa
    Array<double> fx, fy, fz;               ///< contact force of t_n, mN = mg mm/us2
    Array<double> ix, iy, iz;               ///< impulse of the coming kick, mg mm/us
    Array<double> jx, jy, jz;               ///< of a body with long steps: impulse applied ahead of what contact gave, mg mm/us
    Array<double> z_reference;
    Array<double> offset;                   ///< of the wall from the particle, at rest, mm
    Array<double> depth;                    ///< how far behind the wall a node is still pushed back, mm
    Array<double> face;                     ///< 0: a side; 1, -1: an upper or lower end
    Array<double> up, down;                 ///< of a side's point: how far it is to the ends of its column, mm; without end in a slice
    Array<std::int64_t> group;              ///< where each group of points that stand together begins, and the end of the last
    std::size_t side_groups = 0;
    std::size_t sides = 0, upper = 0;       ///< how many are sides; and how many sides or upper ends. A particle has no two points of a kind
    double coarsest = 0;                    ///< mm, largest of spacing and dz
    double density = 0;                     ///< g/cm3, at rest
    std::size_t size() const { return slot.size(); }
};

/// A surface as kernels take it.
struct SurfaceView {
    const std::int64_t* slot;
    const std::int32_t* column;
    double *x, *y, *z, *n[3], *v[3], *mass, *area, *spacing, *dz, *modulus, *f[3], *i[3], *j[3], *z_reference, *offset, *depth, *face, *up, *down;
    std::int64_t size, sides, upper;
};
/// Kernels that only read take it too, so that a surface that is constant has one.
inline SurfaceView view(const Surface& constant) {
    auto& s = const_cast<Surface&>(constant);
    return {s.slot.data(), s.column.data(), s.x.data(), s.y.data(), s.z.data(), {s.nx.data(), s.ny.data(), s.nz.data()}, {s.vx.data(), s.vy.data(), s.vz.data()},
            s.mass.data(), s.area.data(), s.spacing.data(), s.dz.data(), s.modulus.data(), {s.fx.data(), s.fy.data(), s.fz.data()},
            {s.ix.data(), s.iy.data(), s.iz.data()}, {s.jx.data(), s.jy.data(), s.jz.data()}, s.z_reference.data(), s.offset.data(), s.depth.data(), s.face.data(), s.up.data(), s.down.data(),
            static_cast<std::int64_t>(s.size()), static_cast<std::int64_t>(s.sides), static_cast<std::int64_t>(s.upper)};
}

/// The surface points of a body: particles of the first layer at its walls, and of the ends of its columns.
template <class R> Surface make_surface(const SolidBody<R>& body);
/// Moves the points with the body, `ahead` us (negative: back) from where its displacements stand, and clears the forces.
template <class R> void follow(Surface& s, const SolidBody<R>& body, const ColumnPairs<R>& pairs, double ahead);
/// The impulse of a kick, f times its length, into ix, iy, iz.
void plan(Surface& s, double kick);
/// The same for a body that takes long steps while contact acts in short ones: the impulse of contact up to now, and that of the next
/// half step foreseen from the force of now. What was foreseen is taken back as contact gives it (`give`), so momentum is exact.
void plan_ahead(Surface& s, double step);
/// One short kick of contact has acted.
void give(Surface& s, double kick);
/// v += i/m for the surface's particles.
template <class R> void push(const Surface& s, SolidBody<R>& body, double kick);
/// Sum of i.v/2 with the velocity as it stands: before and after a kick it makes the work i.(v- + v+)/2, J.
template <class R> double half_work(const Surface& s, const SolidBody<R>& body);

/// What one pass of contact reports.
struct ContactReport {
    double stored = 0;        ///< J
    double penetration = 0;   ///< mm, largest overlap
    std::string where;        ///< the pair with the largest overlap
    std::int64_t touching = 0;
};

/// Forces on fluid particles: arrays beside a FluidBody.
struct FluidForces {
    Array<double> fx, fy, fz;          ///< mN
    Array<double> spacing, modulus;    ///< current spacing kappa, mm (no wider than its support may grow), and rho c^2, GPa, of each particle
    Array<double> press, near;         ///< sums over the fluid that touches a particle: overlap x pressure, and overlap, mm
    NodeGroups groups;                 ///< particles that stand together, some dozen; as `group` has them
    bool grouped = false;              ///< since `begin`
    double largest_spacing = 0;
    double heat = 0;                   ///< of what the pressure around does to particles without their own kind (FluidSolver::equalise), W = J/us
    /// No forces, and the spacing and stiffness of the present state.
    void begin(const FluidBody& body);
    /// The groups of the present state: made by the first pair that asks.
    NodeGroupsView group(const FluidBody& body);
};

/// Where the points of a part are.
struct Places {
    const double *x, *y, *z;
    std::int64_t n;
};
inline Places places(const FluidBody& b) { return {b.x[0].data(), b.x[1].data(), b.x[2].data(), b.size()}; }
inline Places places(const Surface& s) { return {s.x.data(), s.y.data(), s.z.data(), static_cast<std::int64_t>(s.size())}; }

/// A lower bound of the distance that two sets of points can still close before they touch, mm; 0 where they may touch now.
/// `range` is the distance at which they touch; searched no farther than range + horizon, and told in fifths of that.
double clearance(const Places& a, const Places& b, double range, double horizon, double z_low, double period);

/// Node to node between two fluids, each with its images in its mirrors; adds to both force arrays.
ContactReport node_contact(const FluidBody& a, const FluidBody& b, const ContactOptions& o, FluidForces& fa, FluidForces& fb);

/// A fluid against the smoothed surface of a solid.
ContactReport wall_contact(const FluidBody& a, Surface& s, const ContactOptions& o, double z_low, double period, FluidForces& fa);
/// The sides of one solid against those of another: the points of `nodes` against the smoothed surface `wall` (the coarser of the two).
ContactReport surface_contact(Surface& nodes, Surface& wall, const ContactOptions& o, double z_low, double period);

}  // namespace brisance
