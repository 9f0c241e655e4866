// SPDX-License-Identifier: Apache-2.0
// The single-point driver against closed forms, and what a path file may not say.
#include "io/path_file.h"
#include "laws/point_path.h"
#include "law_helpers.h"

#include <filesystem>
#include <fstream>

using namespace brisance;
using namespace brisance::law_test;

namespace {

using Kind = PathLeg::Kind;

PathLeg leg(Kind kind, double target = 0, int steps = 1000) {
    PathLeg l;
    l.kind = kind;
    l.target = target;
    l.steps = steps;
    return l;
}
PathLeg strain(Vec3<double> e, double shear = 0, int steps = 1000) {
    PathLeg l = leg(Kind::strain, 0, steps);
    l.strain = e;
    l.shear = shear;
    return l;
}
PathLeg axial(double z, double lateral, int steps = 1000) {
    PathLeg l = leg(Kind::axial, 0, steps);
    l.strain.z = z;
    l.lateral = lateral;
    return l;
}
std::vector<PathPoint> go(const Material& m, std::vector<PathLeg> legs) { return drive(m, {"test", std::move(legs), 1}); }

/// Granite that neither yields nor stiffens.
Material elastic_rock() {
    MaterialData data = read_material("barre_granite");
    set(data.eos, {{"K2", 0}, {"K3", 0}});
    LawData law{"elastic", "test:1:1", {}};
    law.parameters["G"] = data.strength->parameters.at("G");
    data.strength = law;
    return make_material(data);
}

std::string reading(const std::string& toml) {
    const std::filesystem::path file = std::filesystem::temp_directory_path() / ("path_test_" + std::to_string(getpid()) + ".toml");
    std::ofstream(file) << toml;
    std::string message = "no error";
    try {
        read_path(file.string());
    } catch (const InputError& e) {
        message = e.what();
    }
    std::filesystem::remove(file);
    return message;
}

}  // namespace

TEST(PointPath, UniaxialStressGivesYoungAndPoisson) {
    const Material m = elastic_rock();
    const double K = 25.7, G = 21.9, E = 9 * K * G / (3 * K + G), nu = (3 * K - 2 * G) / (6 * K + 2 * G);
    const PathPoint r = go(m, {axial(-1e-5, 0, 10)}).back();
    EXPECT_NEAR(r.stress.zz / r.strain.z, E, 1e-4 * E);
    EXPECT_NEAR(-r.strain.x / r.strain.z, nu, 1e-4 * nu);
    EXPECT_NEAR(r.stress.xx, 0, 1e-9 * E * 1e-5);
    EXPECT_NEAR(r.energy, 0.5 * E * 1e-10, 1e-4 * 0.5 * E * 1e-10) << "what is stored is the work done";
}

TEST(PointPath, TriaxialLegHoldsTheConfinement) {
    const Material m = library("barre_granite");
    for (const double confinement : {0.01, 0.1}) {
        const std::vector<PathPoint> rows = go(m, {leg(Kind::pressure, confinement, 100), axial(-0.012, confinement, 1000)});
        for (const PathPoint& r : rows) {
            if (r.leg == 1) {
                EXPECT_NEAR(r.mises, 0, 1e-12);
            }
            if (r.leg == 2 && r.state[0] == 0) {
                EXPECT_NEAR(r.stress.xx, -confinement, 1e-10);
                EXPECT_NEAR(r.mises, std::abs(r.stress.zz - r.stress.xx), 1e-10);
            }
        }
        EXPECT_LT(rows.back().stress.zz, -confinement - 0.3);
    }
}

TEST(PointPath, SimpleShearFollowsTheJaumannRate) {
    // sigma_xy = G sin gamma, sigma_xx = G (1 - cos gamma); the error of the step is of first order in its spin
    const Material m = elastic_rock();
    double before = 0;
    for (const int n : {1000, 2000, 4000}) {
        const PathPoint r = go(m, {strain({0, 0, 0}, 2, n)}).back();
        EXPECT_NEAR(r.stress.xy, 21.9 * std::sin(2), 21.9 * 2.0 / n);
        EXPECT_NEAR(r.stress.xx, 21.9 * (1 - std::cos(2)), 21.9 * 2.0 / n);
        const double error = std::abs(r.stress.xy - 21.9 * std::sin(2));
        if (before > 0) {
            EXPECT_NEAR(error / before, 0.5, 0.02);
        }
        before = error;
    }
}

TEST(PointPath, IdealGasFollowsItsIsentrope) {
    const Material m = library("air_paper");
    const double gamma = 1.401;
    for (const double v : {0.2, 3.0}) {
        const std::vector<PathPoint> rows = go(m, {leg(Kind::volume, v, 4000)});
        EXPECT_NEAR(rows.back().pressure, rows.front().pressure * std::pow(v, -gamma), 2e-6 * rows.back().pressure);
        EXPECT_NEAR(rows.back().sound_speed, std::sqrt(gamma * rows.back().pressure / rows.back().density), 2e-6);
    }
}

TEST(PointPath, IsentropeIsThatOfJwl) {
    // P_s = A e^-R1V + B e^-R2V + C V^-(1+omega); C from the CJ state
    const Material m = library("petn_1320");
    const std::vector<PathPoint> rows = go(m, {leg(Kind::cj), leg(Kind::volume, 10, 8000)});
    const double A = 586, B = 21.6, r1 = 5.81, r2 = 1.77, w = 0.282, C = 1.228997;
    EXPECT_NEAR(rows[1].volume, 0.73899, 1e-5);
    EXPECT_NEAR(rows[1].pressure, 15.6534, 1e-4);
    EXPECT_NEAR(rows[1].shock_speed, 6.7405, 1e-4);
    EXPECT_NEAR(rows[1].particle_velocity, 1.7593, 1e-4);
    EXPECT_NEAR(rows[1].sound_speed * 1, 4.9812, 2e-4) << "the products move at D - u + c = D";
    for (const PathPoint& r : rows) {
        if (r.leg < 2) continue;
        const double v = r.volume, exact = A * std::exp(-r1 * v) + B * std::exp(-r2 * v) + C * std::pow(v, -1 - w);
        ASSERT_NEAR(r.pressure, exact, 2e-5 * exact) << v;
    }
}

TEST(PointPath, HugoniotIsTheShockFit) {
    // U_s = C + S u, P = rho U_s u; published states of copper and water
    MaterialData copper = read_material("copper_ofhc");
    copper.density.value = 8.93;
    copper.strength.reset();
    const std::vector<PathPoint> rows = go(make_material(copper), {leg(Kind::shock, 1, 4)});
    const double u[] = {0.25, 0.5, 1}, P[] = {9.627098, 20.916293, 48.480970}, rho[] = {9.479572, 9.997033, 10.946256}, e[] = {0.03125, 0.125, 0.5},
                 c[] = {4.40850, 4.83676, 5.61599};
    const std::size_t at[] = {1, 2, 4};
    for (std::size_t k = 0; k < 3; ++k) {
        const PathPoint& r = rows[at[k]];
        EXPECT_NEAR(r.particle_velocity, u[k], 1e-9);
        EXPECT_NEAR(r.shock_speed, 3.94 + 1.489 * u[k], 1e-8);
        EXPECT_NEAR(r.pressure, P[k], 1e-6 * P[k]);
        EXPECT_NEAR(r.density, rho[k], 1e-6);
        EXPECT_NEAR(r.energy / 8.93, e[k], 1e-8);
        EXPECT_NEAR(r.sound_speed, c[k], 1e-5);
    }
}

TEST(PointPath, AStrongSolidIsShockedByItsAxialStress) {
    // jump conditions hold with the stress, not with the pressure: E = sigma (1 - V)/2, and an elastic precursor runs with c_L
    const Material m = library("alumina_jh94_c");
    const std::vector<PathPoint> rows = go(m, {leg(Kind::shock, 0.05, 10)});
    for (const PathPoint& r : rows) {
        if (r.leg == 0) continue;
        ASSERT_EQ(r.state[0], 0);
        // below the HEL: sigma = K mu + 4/3 G ln(1/V)
        const double sigma = 130.95 * (1 / r.volume - 1) - 4.0 / 3 * 90.16 * std::log(r.volume);
        EXPECT_NEAR(-r.stress.zz, sigma, 1e-6 * sigma);
        EXPECT_NEAR(r.shock_speed, std::sqrt(sigma / (3.7 * (1 - r.volume))), 1e-6);
        EXPECT_NEAR(r.shock_speed, 8.239, 0.4 * r.particle_velocity);
        EXPECT_NEAR(r.energy, 0.5 * -r.stress.zz * (1 - r.volume), 1e-12);
        EXPECT_NEAR(-r.stress.zz, 3.7 * r.shock_speed * r.particle_velocity, 1e-9);
    }
}

TEST(PointPath, WhatCannotBeReachedIsSaid) {
    const auto refusal = [](const Material& m, const PathLeg& l) {
        try {
            go(m, {l});
        } catch (const InputError& e) {
            return std::string(e.what());
        }
        return std::string("no error");
    };
    EXPECT_TRUE(says(refusal(library("water"), leg(Kind::cj)), "no burn law"));
    EXPECT_TRUE(says(refusal(library("petn_1320"), leg(Kind::shock, 1)), "Chapman-Jouguet"));
    EXPECT_TRUE(says(refusal(library("air"), leg(Kind::pressure, -1)), "cannot be reached"));
    EXPECT_TRUE(says(refusal(library("barre_granite"), leg(Kind::pressure, -1)), "cannot be reached"));
}

TEST(PointPath, StartsWithTheDamageThatIsAsked) {
    // granite of the paper, failed: Y = SHEL B (P/PHEL)^M below its cap
    const Material m = library("barre_granite");
    const PathPoint r = drive(m, {"pressed", {leg(Kind::pressure, 0.1, 10)}, 1, 1}).back();
    EXPECT_EQ(r.state[0], 1);
    EXPECT_NEAR(r.yield, 2.46 * 0.68 * std::pow(0.1 / 2.86, 0.83), 1e-3 * r.yield);
    EXPECT_THROW(drive(library("water"), {"pressed", {leg(Kind::pressure, 0.1, 10)}, 1, 0.5}), InputError);
}

TEST(PathFile, IsReadWithItsUnits) {
    const std::filesystem::path file = std::filesystem::temp_directory_path() / ("path_good_" + std::to_string(getpid()) + ".toml");
    std::ofstream(file) << "title = 'there and back'\nrate = '50 1/s'\nsteps = 10\nscale = 0.5\n[[leg]]\npressure = '20 MPa'\n[[leg]]\naxial = -0.01\nlateral = '20 MPa'\nsteps = 7\n"
                           "[[leg]]\nstrain = [0.01, 0, -0.02]\nshear = 0.1\nrate = '1 1/s'\n[[leg]]\nshear = 0.3\n";
    const PointPath path = read_path(file.string());
    std::filesystem::remove(file);
    EXPECT_EQ(path.name, "there and back");
    EXPECT_EQ(path.scale, 0.5);
    ASSERT_EQ(path.legs.size(), 4u);
    EXPECT_EQ(path.legs[0].kind, Kind::pressure);
    EXPECT_DOUBLE_EQ(path.legs[0].target, 0.02);
    EXPECT_DOUBLE_EQ(path.legs[0].rate, 5e-5);
    EXPECT_EQ(path.legs[0].steps, 10);
    EXPECT_EQ(path.legs[1].kind, Kind::axial);
    EXPECT_DOUBLE_EQ(path.legs[1].lateral, 0.02);
    EXPECT_EQ(path.legs[1].steps, 7);
    EXPECT_EQ(path.legs[2].strain.z, -0.02);
    EXPECT_EQ(path.legs[2].shear, 0.1);
    EXPECT_DOUBLE_EQ(path.legs[2].rate, 1e-6);
    EXPECT_EQ(path.legs[3].strain.x, 0.01) << "a shear alone keeps the strains";
    EXPECT_EQ(path.legs[3].shear, 0.3);
}

TEST(PathFile, MistakesAreNamedWithTheirPlace) {
    for (const auto& [toml, said] : std::vector<std::pair<std::string, std::string>>{
             {"[[leg]]\nstrain = [0, 0]\n", "strain"},
             {"[[leg]]\nsteps = 5\n", "no kind"},
             {"[[leg]]\nvolume = 2\npressure = '1 GPa'\n", "several kinds"},
             {"[[leg]]\npressure = 1\n", "needs its unit"},
             {"[[leg]]\nvolum = 2\n", "did you mean 'volume'"},
             {"[[leg]]\nstrain = [0, 0, -1]\n", "out of range"},
             {"[[leg]]\nvolume = 0.9\nlateral = '1 MPa'\n", "only an `axial` leg"},
             {"[[leg]]\nvolume = 0.9\n[[leg]]\ncj = true\n", "first leg"},
             {"rate = '5 m'\n[[leg]]\nvolume = 2\n", "length"},
             {"steps = 10\n", "leg"}}) {
        const std::string message = reading(toml);
        EXPECT_TRUE(says(message, said) && names_a_place(message)) << toml << message;
    }
}
