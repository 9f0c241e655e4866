// SPDX-License-Identifier: Apache-2.0
// Supports, platens and loads: their impulses and their work are what the audit is told.
#include "core_helpers.h"
#include "geometry/placement.h"

using namespace brisance;
using namespace brisance::core_test;

namespace {

const bool all_axes[3] = {true, true, true}, only_x[3] = {true, false, false}, only_z[3] = {false, false, true};

/// A granite ring about the z axis, one layer thick and endless.
SolidPart<double> ring(double inner, double outer, double spacing, const SolidOptions& o, double growth = 0) {
    PlacementOptions p;
    p.spacing = p.spacing_z = spacing;
    p.spacing_far = growth > 0 ? 1.5 * spacing : spacing;
    p.grading_radius = inner;
    p.grading_growth = growth;
    p.slice = true;
    p.z_high = spacing;
    const Placement placement = place(*make_annulus({0, 0, -100}, {0, 0, 100}, inner, outer), {}, p);
    return solid(elastic_granite(), o, placement.columns, placement.dz, true);
}

}  // namespace

TEST(Boundary, FixedPlanesHoldTheirEndsAndCloseTheMomentum) {
    for (const bool pairwise : {false, true}) {
        SolidOptions o;
        o.pairwise = pairwise;
        o.alpha = pairwise ? 0.3 : 0;
        World<double> w;
        w.solids.push_back(block(elastic_granite(), o, Lattice{10, 5, 9, 0.5, 0.5}));
        SolidBody<double>& b = w.solids[0].body;
        w.solids[0].fixed.push_back(make_fixed_plane(b, {0, 0, 0}, {-1, 0, 0}, only_x));
        w.solids[0].fixed.push_back(make_fixed_plane(b, {0, 0, 4.5}, {0, 0, 1}, only_z));
        EXPECT_EQ(w.solids[0].fixed[0].slots.size(), 45u);
        EXPECT_EQ(w.solids[0].fixed[1].slots.size(), 50u);
        set_field(b, b.v, [](Vec3<double> x) { return Vec3<double>{-0.01 - 0.002 * x.y, 0.003 * x.z, 0.01}; });
        begin(w);
        run(w, 6);
        const Audit a = audit(w);
        EXPECT_LT(a.momentum_residual, 1e-13);
        EXPECT_GT(std::abs(w.ledger.impulse[0]), 0.5 * std::abs(w.start.momentum[0]));
        EXPECT_GT(std::abs(w.ledger.impulse[2]), 0.5 * std::abs(w.start.momentum[2]));
        EXPECT_EQ(w.ledger.impulse[1], 0);
        for (std::int64_t slot : w.solids[0].fixed[0].slots) {
            const auto i = static_cast<std::size_t>(slot);
            EXPECT_EQ(b.v[0][i], 0);
            EXPECT_EQ(b.u[0][i], 0);
            EXPECT_NE(b.v[1][i], 0);
        }
        for (std::int64_t slot : w.solids[0].fixed[1].slots) EXPECT_EQ(b.v[2][static_cast<std::size_t>(slot)], 0);
    }
}

TEST(Boundary, FixedPlanesTakeNoEnergyOnceTheyHold) {
    World<double> w;
    SolidOptions o;
    o.zero_energy = 0;
    w.solids.push_back(block(elastic_granite(), o, Lattice{10, 5, 9, 0.5, 0.5}));
    SolidBody<double>& b = w.solids[0].body;
    w.solids[0].fixed.push_back(make_fixed_plane(b, {0, 0, 0}, {-1, 0, 0}, all_axes));
    set_field(b, b.v, [](Vec3<double> x) { return x.x < 0.5 ? Vec3<double>{} : Vec3<double>{0.002 * x.x, 0.001, 0}; });
    begin(w);
    run(w, 10);
    EXPECT_LT(std::abs(audit(w).residual_relative), 1e-13);
}

TEST(Boundary, PlatensReturnWhatHitsThem) {
    // a block of granite and a drop of water against rigid planes
    World<double> w;
    SolidOptions o;
    o.zero_energy = 0;
    w.solids.push_back(block(elastic_granite(), o, Lattice{10, 5, 5, 0.5, 0.5}));
    w.solids[0].platens.push_back(make_solid_platen(w.solids[0].body, Platen{{0, 0, 0}, {-1, 0, 0}}));
    set_field(w.solids[0].body, w.solids[0].body.v, [](Vec3<double>) { return Vec3<double>{-0.01, 0, 0}; });
    FluidPart f = fluid(library("water"), {}, {0.5, 6, 6, 6, 10.2, 0, 0, false});
    std::fill(f.body.v[0].begin(), f.body.v[0].end(), 0.3);
    f.platens.push_back(Platen{{13.5, 0, 0}, {1, 0, 0}});
    w.fluids.push_back(std::move(f));
    begin(w);
    run(w, 8);
    const Audit a = audit(w);
    EXPECT_LT(a.momentum_residual, 1e-13);
    EXPECT_LT(std::abs(a.residual_relative), 1e-12);
    const BodySums rock = sums(w.solids[0].body);
    EXPECT_GT(rock.px, 0.5 * 0.01 * 2.66 * 250 * 0.125);  // it has turned back
    double water = 0;
    for (std::size_t i = 0; i < w.fluids[0].body.mass.size(); ++i) water += w.fluids[0].body.mass[i] * w.fluids[0].body.v[0][i];
    EXPECT_LT(water, 0.25 * 0.3 * 27);  // much of it has splashed sideways
}

TEST(Boundary, APlatenLeavesAtRestWhatRestsOnIt) {
    // columns start at any height above the plane where they end
    FluidPart f = fluid(library("water"), {}, {0.5, 4, 4, 4, 0, 0, 0, false});
    FluidBody& b = f.body;
    Random random(3);
    for (std::size_t i = 0; i < b.mass.size(); ++i) {
        const double phase = random.uniform(-0.24, 0.24);
        b.x[2][i] += phase;
        b.reference[2][i] = b.x[2][i];
    }
    make_ready(f);
    const Platen plane{{0, 0, 0}, {0, 0, -1}};
    EXPECT_EQ(press(plane, b, f.forces).touching, 0);
    for (double& z : b.x[2]) z -= 0.01;
    const ContactReport r = press(plane, b, f.forces);
    // those of the lowest layer that stood no farther than half their spacing from it
    EXPECT_EQ(r.touching, std::count_if(b.reference[2].begin(), b.reference[2].end(), [](double z) { return z < 0.25 + 0.01; }));
    EXPECT_GT(r.touching, 4);
    EXPECT_NEAR(r.penetration, 0.01, 1e-12);
    for (std::size_t i = 0; i < b.mass.size(); ++i) EXPECT_GE(f.forces.fz[i], 0);
}

TEST(Boundary, PressureInAHolePushesEvenly) {
    const double inner = 3, p = 0.1;
    for (const double growth : {0.0, 0.02, 0.05}) {
        SolidPart<double> s = ring(inner, 8, 0.25, {}, growth);
        const ShapePtr hole = make_cylinder({0, 0, -100}, {0, 0, 100}, inner + 0.2);
        const WallPressure load = make_wall_pressure(s.body, s.surface, *hole, {0, 1, 3}, {0, p, 0});
        EXPECT_DOUBLE_EQ(load.at(-1), 0);
        EXPECT_DOUBLE_EQ(load.at(0.25), 0.25 * p);
        EXPECT_DOUBLE_EQ(load.at(2), 0.5 * p);
        EXPECT_DOUBLE_EQ(load.at(9), 0);
        follow(s.surface, s.body, s.pairs, 0);
        std::vector<Vec3<double>> force;
        press(load, 1, s.body, s.pairs, s.surface, force);
        EXPECT_EQ(force.size(), load.points.size());
        double x = 0, y = 0, radial = 0;
        for (std::size_t n = 0; n < force.size(); ++n) {
            const Column& c = s.body.layout.columns[static_cast<std::size_t>(s.surface.column[load.points[n]])];
            const double r = std::hypot(c.x, c.y);
            EXPECT_LT(r, inner + 0.3);
            x += force[n].x;
            y += force[n].y;
            radial += (force[n].x * c.x + force[n].y * c.y) / r;
            EXPECT_NEAR(s.surface.fx[load.points[n]], force[n].x, 1e-15);
        }
        const double whole = p * 2 * pi * inner * s.body.layout.dz;
        EXPECT_NEAR(radial, whole, 0.005 * whole);  // the wall is as long as it should be
        EXPECT_LT(std::hypot(x, y), 0.005 * whole);
    }
}

TEST(Boundary, WorkOfAWallPressureIsBooked) {
    SolidOptions o;
    o.zero_energy = 0;
    o.linear = 0.06;
    o.quadratic = 1.5;
    World<double> w;
    w.solids.push_back(ring(3, 9, 0.4, o));
    w.period = w.solids[0].body.layout.dz;
    const ShapePtr hole = make_cylinder({0, 0, -100}, {0, 0, 100}, 3.2);
    w.solids[0].loads.push_back(make_wall_pressure(w.solids[0].body, w.solids[0].surface, *hole, {0, 0.3, 3}, {0, 0.2, 0}));
    begin(w);
    run(w, 4);
    const Audit a = audit(w);
    EXPECT_GT(a.boundary_work, 0);
    EXPECT_LT(std::abs(a.residual_relative), 1e-12);
    EXPECT_NEAR(a.kinetic + a.internal[0], a.boundary_work, 1e-12 * a.boundary_work);  // from rest: all of it came from the wall
    EXPECT_LT(a.momentum_residual, 1e-12);
}
