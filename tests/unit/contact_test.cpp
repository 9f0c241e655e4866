// SPDX-License-Identifier: Apache-2.0
// Contact: reactions, clearance, tightness, and the shared state of two materials that meet.
#include "core_helpers.h"
#include "geometry/placement.h"

using namespace brisance;
using namespace brisance::core_test;

namespace {

/// A copper plate whose face looks towards -x at x = 0.
SolidPart<double> plate(int ny, int layers, double spacing, bool periodic, int nx = 4) {
    SolidOptions o;
    o.zero_energy = 0;  // its potential stands half a step apart from the kinetic energy
    return block(library("copper_ofhc"), o, Lattice{nx, ny, layers, spacing, spacing, false, false, periodic, 0, -0.5 * ny * spacing, 0});
}

/// Moves a body's particles a little, at random, so that no symmetry makes sums vanish.
void disturb(SolidPart<double>& s, double size, std::uint64_t seed) {
    Random random(seed);
    set_field(s.body, s.body.u, [&](Vec3<double>) { return Vec3<double>{random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)}; });
    set_field(s.body, s.body.v, [&](Vec3<double>) { return Vec3<double>{random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1)}; });
    const std::array<Array<double>, 3> v = s.body.v;
    respond_to(s);
    s.body.v = v;
    follow(s.surface, s.body, s.pairs, 0);
}

struct Total {
    double x = 0, y = 0, z = 0, size = 0;
    void add(const Array<double>& fx, const Array<double>& fy, const Array<double>& fz) {
        for (std::size_t i = 0; i < fx.size(); ++i) {
            x += fx[i];
            y += fy[i];
            z += fz[i];
            size += std::abs(fx[i]) + std::abs(fy[i]) + std::abs(fz[i]);
        }
    }
    void expect_none() const {
        EXPECT_GT(size, 0);
        EXPECT_LT(std::abs(x) + std::abs(y) + std::abs(z), 1e-13 * size);
    }
};

const ContactOptions rough{1, 0.05, 0.3, 1e-3};

/// A disc of granite, z = 0 to 8 mm, with a hole of radius 3 mm from `bottom` up: layers of `dz`, particles 0.5 mm apart across.
SolidPart<double> disc_with_hole(double bottom, double dz) {
    const ShapePtr disc = make_cylinder({0, 0, 0}, {0, 0, 8}, 8), hole = make_cylinder({0, 0, bottom}, {0, 0, 9}, 3);
    PlacementOptions o;
    o.spacing = 0.5;
    o.spacing_z = dz;
    const Placement placed = place(*disc, {hole}, o);
    SolidPart<double> s = solid(elastic_granite(), {}, placed.columns, placed.dz, false, [&](const Column& c, int k) {
        const Point at{c.x, c.y, (k + 0.5) * placed.dz};
        return disc->contains(at) && !hole->contains(at);
    });
    s.body.layout.z_low = placed.z_low;  // columns start at any height within the first layer
    s.surface = make_surface(s.body);
    respond_to(s);
    follow(s.surface, s.body, s.pairs, 0);
    return s;
}

}  // namespace

TEST(Contact, ReactionEqualsActionBetweenFluids) {
    for (const bool periodic : {false, true})
        for (const int nz : {1, 4}) {
            FluidPart a = disturbed_water({0.2, 6, 6, nz, -1.2, -0.6, 0, periodic}, 0.05, 1);
            FluidPart b = disturbed_water({0.2, 6, 6, nz, -0.08, -0.55, 0, periodic}, 0.05, 2);
            const ContactReport r = node_contact(a.body, b.body, rough, a.forces, b.forces);
            EXPECT_GT(r.touching, 5);
            EXPECT_GT(r.penetration, 0);
            Total t;
            t.add(a.forces.fx, a.forces.fy, a.forces.fz);
            t.add(b.forces.fx, b.forces.fy, b.forces.fz);
            t.expect_none();
        }
}

TEST(Contact, AMirrorStandsForTheOtherHalf) {
    // The upper half of two fluids with a mirror at y = 0 feels what it feels with the lower half in place of the mirror.
    FluidPart half[2] = {disturbed_water({0.2, 4, 4, 4, 0, 0, 0, true}, 0.05, 3), disturbed_water({0.2, 4, 4, 4, -0.7, 0, 0, true}, 0.05, 4)};
    FluidPart whole[2];
    for (std::size_t m = 0; m < 2; ++m) {
        const FluidBody& b = half[m].body;
        const std::size_t n = b.mass.size();
        whole[m] = fluid(library("water"), {}, {0.2, 8, 4, 4, 0, 0, 0, true});
        for (std::size_t i = 0; i < 2 * n; ++i)
            for (std::size_t a = 0; a < 3; ++a) {
                const double sign = i >= n && a == 1 ? -1 : 1;
                whole[m].body.x[a][i] = sign * b.x[a][i % n];
                whole[m].body.v_now[a][i] = sign * b.v_now[a][i % n];
            }
        whole[m].body.rho_now = whole[m].body.rho;
        whole[m].body.e_now = whole[m].body.e;
        whole[m].solver.state(whole[m].body, 0);
        whole[m].forces.begin(whole[m].body);
        half[m].body.mirrors.push_back({1, 0.0});
    }
    const ContactReport of_half = node_contact(half[0].body, half[1].body, {}, half[0].forces, half[1].forces);
    const ContactReport of_whole = node_contact(whole[0].body, whole[1].body, {}, whole[0].forces, whole[1].forces);
    EXPECT_NEAR(2 * of_half.stored, of_whole.stored, 1e-12 * of_whole.stored);
    double across = 0;
    for (std::size_t m = 0; m < 2; ++m) {
        const FluidForces &h = half[m].forces, &w = whole[m].forces;
        for (std::size_t i = 0; i < h.fx.size(); ++i) {
            EXPECT_NEAR(h.fx[i], w.fx[i], 1e-12);
            EXPECT_NEAR(h.fy[i], w.fy[i], 1e-12);
            EXPECT_NEAR(h.fz[i], w.fz[i], 1e-12);
            across += h.fy[i];
        }
    }
    EXPECT_GT(std::abs(across), 1e-6);  // some of it came through the mirror
}

TEST(Contact, GasThatHasExpandedTouchesAllThatItReaches) {
    FluidPart a = disturbed_water({0.2, 6, 6, 6, -1.2, -0.6, 0, false}, 0.05, 1), b = disturbed_water({0.2, 6, 6, 6, -0.4, -0.55, 0, false}, 0.05, 2);
    Random random(5);
    for (FluidPart* p : {&a, &b}) {
        for (double& rho : p->body.rho_now) rho *= std::pow(10.0, random.uniform(-3.5, 0.1));  // up to fifteen times as wide
        p->forces.begin(p->body);
    }
    const ContactOptions springs{1, 0, 0, 0};
    const ContactReport r = node_contact(a.body, b.body, springs, a.forces, b.forces);
    std::int64_t touching = 0;
    double force = 0, worst = 0;
    for (std::size_t i = 0; i < a.body.mass.size(); ++i) {
        Vec3<double> f;
        for (std::size_t j = 0; j < b.body.mass.size(); ++j) {
            const Vec3<double> d{a.body.x[0][i] - b.body.x[0][j], a.body.x[1][i] - b.body.x[1][j], a.body.x[2][i] - b.body.x[2][j]};
            const double wide = 0.5 * (a.forces.spacing[i] + b.forces.spacing[j]), overlap = wide - norm(d), deep = overlap / wide;
            if (!(overlap > 0)) continue;
            ++touching;
            const double k = 4 * a.forces.modulus[i] * b.forces.modulus[j] / (a.forces.modulus[i] + b.forces.modulus[j]) * wide;
            f = f + (k * overlap * (1 + 3 * deep * deep) / norm(d)) * d;
        }
        force = std::max(force, norm(f));
        worst = std::max(worst, norm(f - Vec3<double>{a.forces.fx[i], a.forces.fy[i], a.forces.fz[i]}));
    }
    EXPECT_EQ(r.touching, touching);
    EXPECT_LT(worst, 1e-12 * force);
}

TEST(Contact, GasBetweenClosingWallsTakesTheirSpeedAndNoMore) {
    // One light particle thrown to and fro between two heavy ones that close with u each: a ball with restitution e = 0.85 (damping 0.05)
    // would go on to 12 u.
    FluidPart wall = fluid(library("water"), {}, {0.2, 2, 1, 1, -0.4, 0, 0, false});
    FluidPart gas = fluid(library("air_paper"), {}, {0.2, 1, 1, 1, 0, 0, 0, false});
    FluidBody &w = wall.body, &g = gas.body;
    const double u = 1, dt = 2e-4;
    w.x[0] = {-6.0, 6.0};
    for (std::size_t a : {1u, 2u}) w.x[a] = {g.x[a][0], g.x[a][0]};
    g.x[0][0] = 0;
    g.v[0][0] = 2 * u;
    w.v[0] = {u, -u};
    for (FluidPart* p : {&wall, &gas}) make_ready(*p);
    ContactOptions o;
    o.dt = dt;
    double fastest = 0;
    int bounces = 0;
    for (int n = 0; n * dt * u < 5.7; ++n) {
        for (std::size_t k : {0u, 1u}) w.x[0][k] += dt * w.v_now[0][k];
        for (FluidPart* p : {&wall, &gas}) p->forces.begin(p->body);
        node_contact(gas.body, wall.body, o, gas.forces, wall.forces);
        const double before = g.v[0][0];
        g.v[0][0] += dt * gas.forces.fx[0] / g.mass[0];
        g.x[0][0] += dt * g.v[0][0];
        g.v_now[0][0] = g.v[0][0] + 0.5 * dt * gas.forces.fx[0] / g.mass[0];
        if (before * g.v[0][0] < 0) ++bounces;
        fastest = std::max(fastest, std::abs(g.v[0][0]));
    }
    EXPECT_GT(bounces, 4);
    EXPECT_GT(fastest, u);        // the wall that comes takes it along
    EXPECT_LT(fastest, 3.5 * u);  // (1 + e)/(1 - e) = 2.6, and what the progressive spring adds
}

TEST(Contact, CrushedGasDoesNotRing) {
    // Air at 450 times its density, narrower than the support that the step counts on, shaken between two heavy particles: as stiff as its K and size
    // say, it would be thrown out.
    FluidPart wall = fluid(library("water"), {}, {0.2, 2, 1, 1, -0.4, 0, 0, false});
    FluidPart gas = fluid(library("air_paper"), {}, {0.2, 1, 1, 1, 0, 0, 0, false});
    FluidBody &w = wall.body, &g = gas.body;
    w.x[0] = {-0.09, 0.09};
    for (std::size_t a : {1u, 2u}) w.x[a] = {g.x[a][0], g.x[a][0]};
    g.x[0][0] = 0;
    g.v[0][0] = 0.5;
    g.rho[0] *= 450;
    g.e[0] = 4;
    for (FluidPart* p : {&wall, &gas}) make_ready(*p);
    ContactOptions o;
    gas.solver.rates(g);
    o.dt = StepOptions{}.courant_fluid / gas.solver.stable_rate(g, nullptr, nullptr, nullptr);
    double fastest = 0, farthest = 0;
    for (int n = 0; n < 300; ++n) {
        for (FluidPart* p : {&wall, &gas}) p->forces.begin(p->body);
        ASSERT_GT(node_contact(gas.body, wall.body, o, gas.forces, wall.forces).touching, 0);
        const double a = gas.forces.fx[0] / g.mass[0];
        g.v[0][0] += o.dt * a;
        g.x[0][0] += o.dt * g.v[0][0];
        g.v_now[0][0] = g.v[0][0] + 0.5 * o.dt * a;
        fastest = std::max(fastest, std::abs(g.v[0][0]));
        farthest = std::max(farthest, std::abs(g.x[0][0]));
    }
    EXPECT_LE(fastest, 0.5);
    EXPECT_LT(farthest, 0.03);
    EXPECT_LT(std::abs(g.v[0][0]), 0.05);  // and the damping settles it
}

TEST(Contact, GasAloneInALiquidTakesItsPressureAlongAnIsentrope) {
    // one particle of air in the midst of water under 20 MPa, held in place: it has no neighbour of its kind to tell it of that
    FluidPart water = fluid(library("water"), {}, {0.2, 4, 4, 4, -0.4, -0.4, -0.4, false}), air = fluid(library("air_paper"), {}, {0.2, 1, 1, 1, -0.05, -0.05, -0.05, false});
    for (double& rho : water.body.rho) rho *= 1.009;
    for (FluidPart* p : {&water, &air}) make_ready(*p);
    FluidBody& b = air.body;
    const double around = water.body.pressure[0], start = b.pressure[0], rho_start = b.rho[0], dt = 2e-3;
    ASSERT_GT(around, 100 * start);
    const double none = 0;
    double power = 0, given = 0;
    for (int n = 0; n < 2000; ++n) {
        air.solver.state(b, 0);
        air.solver.rates(b);
        for (FluidPart* p : {&water, &air}) p->forces.begin(p->body);
        node_contact(air.body, water.body, {}, air.forces, water.forces);
        power = air.solver.equalise(b, air.forces.press.data(), air.forces.near.data(), dt);
        given += power * dt;
        air.solver.kick(b, dt, &none, &none, &none);
        b.rho_now = b.rho;
        b.e_now = b.e;
    }
    EXPECT_NEAR(b.pressure[0], around, 0.01 * around);
    EXPECT_NEAR(std::log(b.pressure[0] / start) / std::log(b.rho[0] / rho_start), 1.4, 0.01);
    EXPECT_NEAR(given, b.mass[0] * (b.e[0] - air.body.material.eos->initial_energy() / air.body.material.density), 1e-9 * given);
}

TEST(Contact, AtTheEndsOfASolidTheRightFacePushes) {
    constexpr double reach = 0.15;  // of a particle of water
    const struct { double bottom, r, z; Vec3<double> push; const char* where; } probes[] = {
        {-1, 4.2, 8 + 0.5 * reach, {0, 0, 1}, "on the top"},
        {-1, 4.2, -0.5 * reach, {0, 0, -1}, "under the bottom"},
        {-1, 3.4, 8 + 0.5 * reach, {0, 0, 1}, "on the top beside the rim: not behind the wall of the hole"},
        {-1, 3.4, 8 + 3 * reach, {0, 0, 0}, "above the rim"},
        {-1, 2.0, 8 + 0.5 * reach, {0, 0, 0}, "over the hole"},
        {-1, 2.0, 7.9, {0, 0, 0}, "in the hole"},
        {-1, 3 - 0.5 * reach, 6.5, {-1, 0, 0}, "at the wall of the hole"},
        {-1, 3 - 0.5 * reach, 7.8, {-1, 0, 0}, "at the wall of the hole, near its rim"},
        {4, 1.5, 4 + 0.5 * reach, {0, 0, 1}, "on the bottom of a blind hole"},
    };
    for (const auto& probe : probes) {
        SolidPart<double> s = disc_with_hole(probe.bottom, 0.5);
        FluidPart f = disturbed_water({2 * reach, 1, 1, 1, probe.r - reach, -reach, probe.z - reach, false}, 0, 1, 0);
        wall_contact(f.body, s.surface, {}, 0, 0, f.forces);
        const Vec3<double> force{f.forces.fx[0], f.forces.fy[0], f.forces.fz[0]};
        if (norm(probe.push) == 0) {
            EXPECT_EQ(norm(force), 0) << probe.where;
            continue;
        }
        EXPECT_GT(norm(force), 0) << probe.where;
        EXPECT_GT(dot(force, probe.push), 0.9 * norm(force)) << probe.where;
        Total t;
        t.add(f.forces.fx, f.forces.fy, f.forces.fz);
        t.add(s.surface.fx, s.surface.fy, s.surface.fz);
        t.expect_none();
    }
}

TEST(Contact, AboveTheRimOfAHoleNothingPushes) {
    // layers as thick as three spacings: the wall of the hole could be taken to go on far above its end
    SolidPart<double> s = disc_with_hole(-1, 1.6);
    FluidPart f = disturbed_water({0.3, 16, 20, 8, 0, 0, 0, false}, 0, 1, 0);
    FluidBody& b = f.body;
    std::size_t n = 0;
    for (int i = 0; i < 16; ++i)
        for (int j = 0; j < 20; ++j)
            for (int k = 0; k < 8; ++k, ++n) {
                const double r = 2.9 + 0.05 * i, angle = 0.1 * j;
                b.x[0][n] = r * std::cos(angle);
                b.x[1][n] = r * std::sin(angle);
                b.x[2][n] = 8.2 + 0.2 * k;
            }
    EXPECT_EQ(wall_contact(b, s.surface, {}, 0, 0, f.forces).touching, 0);
}

TEST(Contact, ReactionEqualsActionAtAWall) {
    for (const bool periodic : {false, true})
        for (const int nz : {1, 2, 8}) {
            if (!periodic && nz == 1) continue;  // a single layer has no gradient: the guard takes it out
            SolidPart<double> s = plate(12, nz, 0.25, periodic);
            disturb(s, 0.01, 3);
            FluidPart f = disturbed_water({0.125, 6, 16, 2 * nz, -0.7, -1, 0, periodic}, 0.02, 4);
            const double period = periodic ? nz * 0.25 : 0;
            const ContactReport r = wall_contact(f.body, s.surface, rough, 0, period, f.forces);
            EXPECT_GT(r.touching, 10);
            Total t;
            t.add(f.forces.fx, f.forces.fy, f.forces.fz);
            t.add(s.surface.fx, s.surface.fy, s.surface.fz);
            t.expect_none();
        }
}

TEST(Contact, ReactionEqualsActionBetweenSolids) {
    for (const bool periodic : {false, true})
        for (const int nz : {1, 2, 8}) {
            if (!periodic && nz == 1) continue;
            SolidPart<double> wall = plate(10, nz, 0.25, periodic);
            SolidPart<double> nodes = block(library("copper_ofhc"), {}, Lattice{5, 16, 2 * nz, 0.125, 0.125, false, false, periodic, -0.62, -1, 0});
            disturb(wall, 0.01, 5);
            disturb(nodes, 0.01, 6);
            const double period = periodic ? nz * 0.25 : 0;
            const ContactReport r = surface_contact(nodes.surface, wall.surface, rough, 0, period);
            EXPECT_GT(r.touching, 5);
            Total t;
            t.add(nodes.surface.fx, nodes.surface.fy, nodes.surface.fz);
            t.add(wall.surface.fx, wall.surface.fy, wall.surface.fz);
            t.expect_none();
        }
}

TEST(Contact, ATornParticleIsNoWall) {
    SolidPart<double> s = plate(12, 8, 0.25, false);
    disturb(s, 0.01, 3);
    FluidPart f = disturbed_water({0.125, 6, 16, 16, -0.7, -1, 0, false}, 0.02, 4);
    ASSERT_GT(wall_contact(f.body, s.surface, rough, 0, 0, f.forces).touching, 10);
    for (const std::int64_t slot : s.surface.slot) s.body.live[static_cast<std::size_t>(slot)] = 0;
    follow(s.surface, s.body, s.pairs, 0);
    f.forces.begin(f.body);
    EXPECT_EQ(wall_contact(f.body, s.surface, rough, 0, 0, f.forces).touching, 0);
    for (double force : s.surface.fx) EXPECT_EQ(force, 0);
}

TEST(Contact, ClearanceIsABound) {
    Random random(7);
    for (int n = 0; n < 60; ++n) {
        const double period = n % 2 ? random.uniform(0.3, 3) : 0, gap = random.uniform(0, 2);
        std::array<std::vector<double>, 3> a, b;
        for (int i = 0; i < 40; ++i)
            for (std::size_t k = 0; k < 3; ++k) {
                const double high = k == 2 && period > 0 ? period : 2;
                a[k].push_back(random.uniform(0, high));
                b[k].push_back(random.uniform(0, high) + (k == 0 ? 2 + gap : 0));
            }
        double nearest = 1e300;
        for (std::size_t i = 0; i < 40; ++i)
            for (std::size_t j = 0; j < 40; ++j)
                for (int image = -8; image <= 8; ++image) {
                    const double dz = a[2][i] - b[2][j] - image * period;
                    nearest = std::min(nearest, std::sqrt(sq(a[0][i] - b[0][j]) + sq(a[1][i] - b[1][j]) + dz * dz));
                }
        const double range = 0.3, horizon = 0.8;
        const double found = clearance({a[0].data(), a[1].data(), a[2].data(), 40}, {b[0].data(), b[1].data(), b[2].data(), 40}, range, horizon, 0, period);
        EXPECT_LE(found, std::clamp(nearest - range, 0.0, horizon) + 1e-12);
        // told in whole cells, of which five make range + horizon, and along the axes
        EXPECT_GE(found, std::min(nearest / std::sqrt(3.0) - range - 2 * (range + horizon) / 5, horizon - 1e-12));
    }
}

TEST(Contact, ClearanceKnowsALongCoarseWall) {
    // a tube of points much farther apart than the cells that tell the distance
    std::array<std::vector<double>, 3> wall;
    for (int i = 0; i < 24; ++i)
        for (int k = 0; k < 90; ++k) {
            wall[0].push_back(3.2 * std::cos(i * 0.2618));
            wall[1].push_back(3.2 * std::sin(i * 0.2618));
            wall[2].push_back(1.6 * k);
        }
    const std::vector<double> x{1.5, -1.5, 0, 0}, y{0, 0, 1.5, -1.5}, z{20, 40, 60, 80};
    const double found = clearance({x.data(), y.data(), z.data(), 4}, {wall[0].data(), wall[1].data(), wall[2].data(), 2160}, 0.6, 0.5, 0, 0);
    EXPECT_GT(found, 0.1);
    EXPECT_LE(found, 0.5 + 1e-12);
}

// A piston of gas, fine against a coarse copper plate, hard driven: nothing may come through, and the balance closes.
TEST(Contact, AFluidPistonDoesNotLeakThroughACopperWall) {
    for (const double speed : {0.5, 3.0}) {
        World<double> w;
        w.period = 0.4;
        w.solids.push_back(plate(24, 2, 0.2, true));
        FluidPart f = fluid(library("water"), {}, {0.1, 14, 24, 4, -1.45, -1.2, 0});
        std::fill(f.body.v[0].begin(), f.body.v[0].end(), speed);
        w.fluids.push_back(std::move(f));
        w.contacts.push_back({ContactPair::fluid_solid, 0, 0});
        begin(w);
        run(w, 1.0 / speed);
        const Audit a = audit(w);
        EXPECT_LT(a.momentum_residual, 1e-13);
        EXPECT_LT(std::abs(a.residual_relative), 1e-11);
        EXPECT_LT(a.penetration, 0.1);
        const Surface& s = w.solids[0].surface;
        const FluidBody& b = w.fluids[0].body;
        int before = 0, through = 0;
        for (std::size_t i = 0; i < b.mass.size(); ++i) {
            if (std::abs(b.x[1][i]) > 2) continue;
            double nearest = 1e300, face = 0;
            for (std::size_t p = 0; p < s.size(); ++p)
                if (s.nx[p] < -0.8 && std::abs(s.y[p] - b.x[1][i]) < nearest) {
                    nearest = std::abs(s.y[p] - b.x[1][i]);
                    face = s.x[p];
                }
            (b.x[0][i] > face + 0.05 ? through : before) += 1;
        }
        EXPECT_EQ(through, 0) << "at " << speed << " km/s";
        EXPECT_GT(before, 1000);
    }
}

TEST(Contact, FrictionActsAgainstTheSlip) {
    SolidPart<double> s = plate(12, 4, 0.25, true);
    follow(s.surface, s.body, s.pairs, 0);
    for (const double friction : {0.0, 0.3}) {
        FluidPart f = fluid(library("water"), {}, {0.125, 2, 8, 8, -0.2, -0.5, 0});
        std::fill(f.body.v_now[1].begin(), f.body.v_now[1].end(), 0.2);
        f.body.rho_now = f.body.rho;
        f.body.e_now = f.body.e;
        f.solver.state(f.body, 0);
        f.forces.begin(f.body);
        wall_contact(f.body, s.surface, {1, 0, friction, 0}, 0, 1, f.forces);
        double normal = 0, along = 0;
        for (std::size_t i = 0; i < f.body.mass.size(); ++i) {
            normal += f.forces.fx[i];
            along += f.forces.fy[i];
        }
        EXPECT_LT(normal, 0);
        EXPECT_NEAR(along, friction * normal, 1e-12 * std::abs(normal));
    }
}
