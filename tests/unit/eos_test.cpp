// SPDX-License-Identifier: Apache-2.0
// Equations of state. First what every registered law has to obey, whatever its name; then closed forms and tables of single laws.
#include "laws/point_path.h"
#include "law_helpers.h"

using namespace brisance;
using namespace brisance::law_test;

namespace {

template <class F> void for_every_eos(const F& f) {
    for (const EosEntry& entry : eos_entries())
        for (const MaterialData& data : users_of(entry)) {
            SCOPED_TRACE(entry.name + " of " + data.name);
            f(make_material(data));
        }
}

double pressure_without_floor(const Eos& eos, double mu, double energy) { return eos_pressure(eos.terms(mu), energy); }
double stiffness_without_floor(const Eos& eos, double mu, double energy) {
    const EosTerms<double> t = eos.terms(mu);
    return eos_stiffness(t, mu, energy, eos_pressure(t, energy));
}
/// Energy on the adiabat dE = -P dV, V = 1/(1+mu), from (mu, energy) to another mu: Runge-Kutta of fourth order.
double along_adiabat(const Eos& eos, double mu, double energy, double to, int n) {
    const auto slope = [&](double m, double e) { return pressure_without_floor(eos, m, e) / ((1 + m) * (1 + m)); };
    const double h = (to - mu) / n;
    for (int i = 0; i < n; ++i) {
        const double m = mu + h * i;
        const double k1 = slope(m, energy), k2 = slope(m + h / 2, energy + h / 2 * k1), k3 = slope(m + h / 2, energy + h / 2 * k2),
                     k4 = slope(m + h, energy + h * k3);
        energy += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    return energy;
}

Material gruneisen(double density, double C, double S1, double Gamma0, double a, double S2 = 0, double S3 = 0) {
    return varied("copper_ofhc", {{"C", C}, {"S1", S1}, {"S2", S2}, {"S3", S3}, {"Gamma0", Gamma0}, {"a", a}}, {}, density);
}
struct JwlSet {
    const char* name;
    double A, B, R1, R2, omega, E0, density;
};
Material products(const JwlSet& s) {
    return varied("petn_1320", {{"A", s.A}, {"B", s.B}, {"R1", s.R1}, {"R2", s.R2}, {"omega", s.omega}, {"E0", s.E0}}, {}, s.density);
}
const JwlSet petn_1320{"PETN 1.32", 586, 21.6, 5.81, 1.77, 0.282, 7.38, 1.32};

}  // namespace

TEST(EveryEos, HugoniotKeepsMassMomentumAndEnergy) {
    // u^2 = (P - P_0)(V_0 - V), U = (P - P_0)/(rho_0 u), E - E_0 = (P + P_0)(V_0 - V)/2, the weak end runs with the sound speed; and where the
    // law is a fit U = C + S1 u, that line
    for (const EosEntry& entry : eos_entries())
        for (const MaterialData& data : users_of(entry)) {
            SCOPED_TRACE(entry.name + " of " + data.name);
            MaterialData fluid = data;
            fluid.strength.reset();
            const Material m = make_material(fluid);
            if (m.burn) continue;
            const double c = m.sound_speed(), u = 0.1 * c;
            PathLeg shock;
            shock.kind = PathLeg::Kind::shock;
            shock.target = u;
            shock.steps = 100;
            const std::vector<PathPoint> rows = drive(m, {"shock", {shock}, 1});
            const double P0 = rows[0].pressure, E0 = m.eos->initial_energy();
            for (const PathPoint& r : rows) {
                if (r.leg == 0) continue;
                const double swept = 1 - r.volume;
                ASSERT_NEAR(r.pressure, m.eos->pressure(1 / r.volume - 1, r.energy), 1e-12 * r.pressure);
                ASSERT_NEAR(r.energy - E0, 0.5 * (r.pressure + P0) * swept, 1e-11 * r.pressure);
                ASSERT_NEAR(r.pressure - P0, m.density * r.shock_speed * r.particle_velocity, 1e-11 * r.pressure);
                ASSERT_NEAR(r.particle_velocity, r.shock_speed * swept, 1e-11 * u);
                ASSERT_GT(r.sound_speed * r.sound_speed, 0);
                const auto& p = data.eos.parameters;
                if (p.count("S1") && p.at("S2").value == 0 && p.at("S3").value == 0) {
                    ASSERT_NEAR(r.shock_speed, p.at("C").value + p.at("S1").value * r.particle_velocity, 1e-8 * c);
                }
            }
            shock.target = 1e-5 * c;
            shock.steps = 1;
            EXPECT_NEAR(drive(m, {"weak shock", {shock}, 1}).back().shock_speed, c, 0.002 * c);
        }
}

// ---- every law

TEST(EveryEos, StartsAtAFiniteStateAndASolidUnstressed) {
    for_every_eos([](const Material& m) {
        const double e0 = m.eos->initial_energy(), p0 = m.eos->pressure(0, e0);
        EXPECT_TRUE(std::isfinite(p0));
        EXPECT_GE(p0, 0);
        EXPECT_DOUBLE_EQ(p0, pressure_without_floor(*m.eos, 0, e0)) << "the cut-off must not act at rest";
        EXPECT_GT(m.bulk_modulus(), 0);
        EXPECT_DOUBLE_EQ(m.bulk_modulus(), stiffness_without_floor(*m.eos, 0, e0));
        if (m.strength) {
            EXPECT_NEAR(p0, 0, 1e-12 * m.bulk_modulus());
        }
    });
}

TEST(EveryEos, StiffnessIsTheSlopeOfTheAdiabat) {
    // rho_0 c^2 = dP/dmu at constant entropy, against central differences of P along dE = -P dV.
    for_every_eos([](const Material& m) {
        const Eos& eos = *m.eos;
        for (const double mu : {-0.7, -0.4, -0.1, -0.011, 0.0151, 0.021, 0.1003, 0.2, 0.3, 0.5, 1.0, 3.0, 8.0})
            for (const double more : {0.0, 0.01, 1.0}) {
                const double e = eos.initial_energy() + more * m.bulk_modulus();
                const double h = 1e-4 * (1 + mu);
                const auto at = [&](double m) { return pressure_without_floor(eos, m, along_adiabat(eos, mu, e, m, 4)); };
                const double slope = (8 * (at(mu + h) - at(mu - h)) - (at(mu + 2 * h) - at(mu - 2 * h))) / (12 * h);  // fourth order
                const EosTerms<double> t = eos.terms(mu);
                const double p = eos_pressure(t, e);
                const double size = std::abs(t.da) + std::abs(t.db * e) + std::abs(p * t.b) / ((1 + mu) * (1 + mu)) + std::abs(p) / (1 + mu);
                EXPECT_NEAR(eos_stiffness(t, mu, e, p), slope, 1e-6 * size) << "mu = " << mu << ", E = " << e;
            }
    });
}

TEST(EveryEos, EnergyStepClosesAtSecondOrderAndConservesOverACycle) {
    // The implicit step that P = a + b E allows: E1 = (E - (P + a1) dV/2)/(1 + b1 dV/2), the trapezoid of dE = -P dV without iteration.
    for_every_eos([](const Material& m) {
        const Eos& eos = *m.eos;
        const auto march = [&](double from, double energy, double to, int n) {
            double p = pressure_without_floor(eos, from, energy);
            for (int i = 1; i <= n; ++i) {
                const double mu0 = from + (to - from) * (i - 1) / n, mu = from + (to - from) * i / n;
                const double dv = 1 / (1 + mu) - 1 / (1 + mu0);
                const EosTerms<double> t = eos.terms(mu);
                const double next = (energy - 0.5 * dv * (p + t.a)) / (1 + 0.5 * dv * t.b);
                const double p_next = eos_pressure(t, next);
                EXPECT_NEAR(next - energy, -0.5 * dv * (p + p_next), 1e-13 * (std::abs(next) + std::abs(dv * (p + p_next))));
                energy = next;
                p = p_next;
            }
            return energy;
        };
        const double e0 = eos.initial_energy();
        for (const double to : {0.2, -0.2}) {
            const double exact = along_adiabat(eos, 0, e0, to, 4000);
            EXPECT_NEAR(along_adiabat(eos, 0, e0, to, 2000), exact, 1e-8 * std::abs(exact - e0));
            const double coarse = march(0, e0, to, 50) - exact, fine = march(0, e0, to, 100) - exact;
            EXPECT_LT(std::abs(fine), 1e-3 * std::abs(exact - e0));
            if (std::abs(fine) > 1e-9 * std::abs(exact - e0)) {
                EXPECT_NEAR(coarse / fine, 4, 0.3);
            }
            EXPECT_NEAR(march(to, march(0, e0, to, 50), 0, 50), e0, 1e-12 * (std::abs(exact) + e0)) << "there and back";
        }
    });
}

TEST(EveryEos, TensionIsCutOffAtTheFloorAndNowhereElse) {
    for_every_eos([](const Material& m) {
        const Eos& eos = *m.eos;
        EXPECT_LE(eos.pressure_floor(), 0);
        for (double mu = -0.95; mu < 1; mu += 0.01) {
            const double free = pressure_without_floor(eos, mu, eos.initial_energy()), p = eos.pressure(mu, eos.initial_energy());
            EXPECT_EQ(p, std::max(free, eos.pressure_floor())) << mu;
        }
    });
}

TEST(EveryEos, PressureRisesFromTensionThroughRest) {
    for_every_eos([](const Material& m) {
        const double e0 = m.eos->initial_energy();
        double last = -1e300, limit = 0.3;
        for (const std::string& remark : m.remarks)
            if (says(remark, "has c^2 <= 0")) limit = 1.0 / 9;
        for (double mu = -0.05; mu <= limit; mu += 0.001) {
            const double p = pressure_without_floor(*m.eos, mu, along_adiabat(*m.eos, 0, e0, mu, 20));
            EXPECT_GT(p, last) << mu;
            last = p;
        }
    });
}

TEST(EveryEos, NoNanFromVacuumToCollapse) {
    for_every_eos([](const Material& m) {
        std::vector<double> mus;
        for (const double near_vacuum : {1e-9, 1e-6, 1e-3, 0.1}) mus.push_back(near_vacuum - 1);
        for (double mu = -0.8; mu < 20; mu += 0.037) mus.push_back(mu);
        for (const double mu : {50.0, 1e3, 1e4}) mus.push_back(mu);
        for (const double mu : mus)
            for (const double e : {0.0, m.eos->initial_energy(), 100.0}) {
                const EosTerms<double> t = m.eos->terms(mu);
                for (const double x : {t.a, t.b, t.da, t.db, m.eos->pressure(mu, e), m.eos->stiffness(mu, e)}) EXPECT_TRUE(std::isfinite(x)) << mu << ' ' << e;
                EosTerms<Pack<float>> f;
                float many[lanes<float>];
                for (float& x : many) x = static_cast<float>(std::min(mu, 1e3));
                if (mu < -0.9999999) continue;
                m.eos->terms(many, f);
                for (const float x : {lane(f.a, 0), lane(f.b, 0), lane(f.da, 0), lane(f.db, 0)}) EXPECT_TRUE(std::isfinite(x)) << mu;
            }
    });
}

TEST(EveryEos, BatchGivesTheBitsOfThePoint) {
    for_every_eos([](const Material& m) {
        Random random(7);
        for (int i = 0; i < 500; ++i) {
            double mu[lanes<double>];
            float mu_f[lanes<float>];
            for (double& x : mu) x = i % 3 ? random.uniform(-0.5, 1) : random.decades(1e-6, 20) - 0.999;
            for (int l = 0; l < lanes<float>; ++l) mu_f[l] = static_cast<float>(random.uniform(-0.5, 1));
            EosTerms<Pack<double>> batch;
            m.eos->terms(mu, batch);
            for (int l = 0; l < lanes<double>; ++l) {
                const EosTerms<double> one = m.eos->terms(mu[l]);
                ASSERT_TRUE(same_bits(lane(batch.a, l), one.a)) << mu[l] << ": " << lane(batch.a, l) - one.a;
                ASSERT_TRUE(same_bits(lane(batch.b, l), one.b)) << mu[l] << ": " << lane(batch.b, l) - one.b;
                ASSERT_TRUE(same_bits(lane(batch.da, l), one.da)) << mu[l] << ": " << lane(batch.da, l) - one.da;
                ASSERT_TRUE(same_bits(lane(batch.db, l), one.db)) << mu[l] << ": " << lane(batch.db, l) - one.db;
            }
            EosTerms<Pack<float>> single;
            m.eos->terms(mu_f, single);
            for (int l = 0; l < lanes<float>; ++l) {
                const EosTerms<double> one = m.eos->terms(static_cast<double>(mu_f[l]));
                const double size = m.bulk_modulus() + std::abs(one.a) + std::abs(one.da);
                ASSERT_NEAR(lane(single.a, l), one.a, 1e-5 * size) << mu_f[l];
                ASSERT_NEAR(lane(single.b, l), one.b, 1e-6 * (1 + std::abs(one.b))) << mu_f[l];
                ASSERT_NEAR(lane(single.da, l), one.da, 2e-5 * size) << mu_f[l];
            }
        }
    });
}

// ---- Mie-Grueneisen

TEST(MieGruneisen, ReproducesHugoniotTables) {
    struct State {
        double u, speed, pressure, density, energy, sound;  // m/s, m/s, GPa, kg/m3, kJ/kg, m/s (0: not tabulated)
    };
    struct Table {
        const char* name;
        double density, C, S, gamma, a;
        std::vector<State> states;
    };
    const Table tables[] = {
        {"copper", 8.93, 3.94, 1.489, 2.02, 0.47,
         {{100, 4088.90, 3.651388, 9153.871, 5, 4133.29}, {250, 4312.25, 9.627098, 9479.572, 31.25, 4408.50},
          {500, 4684.50, 20.916293, 9997.033, 125, 4836.76}, {1000, 5429.00, 48.480970, 10946.256, 500, 5615.99}}},
        {"water", 1.0, 1.483, 1.75, 0.28, 0,
         {{50, 1570.50, 0.078525, 1032.884, 1.25, 1607.33}, {100, 1658.00, 0.165800, 1064.185, 5, 1730.72},
          {500, 2358.00, 1.179000, 1269.107, 125, 2721.20}, {1000, 3233.00, 3.233000, 1447.828, 500, 4030.48}}},
        {"polyethylene", 0.915, 2.901, 1.481, 1.644, 0,
         {{100, 3049.10, 0.278993, 946.026, 5, 0}, {500, 3641.50, 1.665986, 1060.631, 125, 0}, {1000, 4382.00, 4.009530, 1185.550, 500, 0},
          {2000, 5863.00, 10.729290, 1388.725, 2000, 0}}},
    };
    for (const Table& t : tables) {
        const Material m = gruneisen(t.density, t.C, t.S, t.gamma, t.a);
        for (const State& s : t.states) {
            SCOPED_TRACE(std::string(t.name) + " at u = " + std::to_string(s.u));
            const double u = 1e-3 * s.u, speed = t.C + t.S * u;
            const double mu = u / (speed - u), energy = t.density * u * u / 2;
            EXPECT_NEAR(1e3 * speed, s.speed, 0.006);
            EXPECT_NEAR(1e3 * t.density * (1 + mu), s.density, 6e-4);
            EXPECT_NEAR(energy / t.density * 1e3, s.energy, 1e-9);
            const double p = m.eos->pressure(mu, energy);
            EXPECT_NEAR(p, t.density * speed * u, 1e-12 * p) << "the Hugoniot itself";
            EXPECT_NEAR(p, s.pressure, 6e-7);
            if (s.sound > 0) {
                EXPECT_NEAR(1e3 * std::sqrt(m.eos->stiffness(mu, energy) / t.density), s.sound, 0.006);
            }
        }
    }
}

TEST(MieGruneisen, SteinbergsCubicHugoniotIsMetExactly) {
    // U_s = C + (S1 + S2 y + S3 y^2) u_p with y = u_p/U_s, so U_s = C/(1 - y (S1 + S2 y + S3 y^2)); water after Steinberg.
    const Material m = gruneisen(1.0, 1.48, 2.56, 0.5, 1.1, -1.986, 0.2268);
    for (double y = 0.01; y < 0.45; y += 0.01) {
        const double speed = 1.48 / (1 - y * (2.56 + y * (-1.986 + y * 0.2268))), u = y * speed;
        const double p = speed * u;
        EXPECT_NEAR(m.eos->pressure(y / (1 - y), u * u / 2), p, 1e-12 * p) << y;
    }
}

TEST(MieGruneisen, TensionIsLinearAndTheCutOffHolds) {
    const Material copper = library("copper_ofhc");
    const double k = 8.96 * 3.94 * 3.94;
    for (double mu = -0.3; mu < 0; mu += 0.01) {
        EXPECT_NEAR(copper.eos->pressure(mu, 0.3), k * mu + (2.02 + 0.47 * mu) * 0.3, 1e-12 * k);
        EXPECT_NEAR(library("water").eos->pressure(mu, 0), -1e-4, 1e-16);
    }
}

TEST(MieGruneisen, APressureOfVapourFallsWithItsDensity) {
    // twice the heat that pulls all of it apart, C^2/Gamma_0, in 1/10 and 1/1000 of the density
    const Material m = gruneisen(0.915, 2.901, 1.481, 1.64, 0);
    const double heat = 2 * 2.901 * 2.901 / 1.64 * 0.915, cold = 0.915 * 2.901 * 2.901;
    for (const double thin : {0.1, 0.001}) EXPECT_NEAR(m.eos->pressure(thin - 1, heat), -cold * (1 - thin) + 1.64 * 2 * thin * heat, 1e-9);
    EXPECT_NEAR(m.eos->pressure(-0.5 - 1e-9, heat), m.eos->pressure(-0.5 + 1e-9, heat), 1e-6);
}

TEST(MieGruneisen, BeyondThePoleItGoesOnAlongTheTangent) {
    // Water: the denominator vanishes at mu = 1/(S - 1) = 1.333; METHOD: stay below 0.95 of it.
    const Material water = library("water");
    const Eos& eos = *water.eos;
    double last = 0;
    for (double mu = 0; mu < 50; mu += 0.01) {
        const double p = eos.pressure(mu, 0);
        EXPECT_GE(p, last);
        EXPECT_GE(eos.terms(mu).da, 0) << mu;
        last = p;
    }
    const double slope = eos.terms(10).da;
    EXPECT_DOUBLE_EQ(slope, eos.terms(2).da);
    EXPECT_NEAR(eos.terms(10).a - eos.terms(2).a, 8 * slope, 1e-9 * slope);
}

// ---- polynomials and gases

TEST(Polynomial, CubicInCompressionLinearInTension) {
    const Material m = library("barre_granite");
    for (double mu = -0.2; mu < 0.3; mu += 0.01) {
        const double x = std::max(mu, 0.0);
        EXPECT_NEAR(m.eos->pressure(mu, 5), 25.7 * mu - 386 * x * x + 12800 * x * x * x, 1e-11);
    }
    EXPECT_NEAR(m.sound_speed(), 4.54303, 1e-5);                                            // c_p = 4543.03 m/s
    EXPECT_NEAR(std::sqrt(m.strength->shear_modulus() / m.density), 2.86933, 1e-5);         // c_s = 2869.33 m/s
    double least = 1e9, where = 0;
    for (double mu = 0; mu < 0.05; mu += 1e-5)
        if (m.eos->terms(mu).da < least) {
            least = m.eos->terms(mu).da;
            where = mu;
        }
    EXPECT_NEAR(least, 21.8, 0.05);
    EXPECT_NEAR(where, 0.0101, 1e-4);
}

TEST(LinearPolynomial, AirOfThePaper) {
    const Material air = library("air_paper");
    EXPECT_NEAR(1e6 * air.eos->pressure(0, air.eos->initial_energy()), 100.25, 1e-9);  // kPa
    EXPECT_NEAR(1e3 * air.sound_speed(), 334.5, 0.05);
    EXPECT_NEAR(1e3 * air.sound_speed(), 1e3 * std::sqrt(1.401 * 1.0025e-4 / 1.255e-3), 1e-9);
    // P V^gamma on the adiabat, gamma = 1.401
    for (const double mu : {-0.9, -0.5, 1.0, 5.0}) {
        const double e = along_adiabat(*air.eos, 0, air.eos->initial_energy(), mu, 4000);
        EXPECT_NEAR(air.eos->pressure(mu, e), 1.0025e-4 * std::pow(1 + mu, 1.401), 1e-9 * air.eos->pressure(mu, e));
    }
}

TEST(LinearPolynomial, EveryCoefficientInItsPlaceAndC2C6OnlyInCompression) {
    MaterialData data = read_material("air_paper");
    set(data.eos, {{"C0", 0.1}, {"C1", 2}, {"C2", 3}, {"C3", 5}, {"C4", 0.7}, {"C5", 1.1}, {"C6", 1.3}, {"E0", 0.2}});
    const Material m = make_material(data);
    for (const double mu : {-0.3, -0.1, 0.1, 0.4})
        for (const double e : {0.0, 0.5, 2.0}) {
            const double c2 = mu > 0 ? 3 : 0, c6 = mu > 0 ? 1.3 : 0;
            EXPECT_NEAR(m.eos->pressure(mu, e), 0.1 + 2 * mu + c2 * mu * mu + 5 * mu * mu * mu + (0.7 + 1.1 * mu + c6 * mu * mu) * e, 1e-14);
        }
}

TEST(IdealGas, IsTheLinearPolynomialOfAGas) {
    MaterialData data = read_material("air_paper");
    const Material polynomial = make_material(data);
    data.eos.law = "ideal_gas";
    const ParameterValue e0 = data.eos.parameters.at("E0");
    data.eos.parameters = {{"E0", e0}, {"gamma", {1.401, dimension::none, "1.401", "test", "c", "x.toml:1:1"}}};
    const Material gas = make_material(data);
    for (const double mu : {-0.99, -0.3, 0.0, 0.5, 9.0})
        for (const double e : {1e-4, 2.5e-4, 1.0}) {
            EXPECT_NEAR(gas.eos->pressure(mu, e), 0.401 * (1 + mu) * e, 1e-13 * (1 + mu) * e);
            EXPECT_NEAR(gas.eos->stiffness(mu, e), polynomial.eos->stiffness(mu, e), 1e-12 * (1 + e));
            EXPECT_NEAR(gas.eos->stiffness(mu, e), 1.401 * gas.eos->pressure(mu, e) / (1 + mu), 1e-12 * (1 + e)) << "c^2 = gamma P/rho";
        }
}

// ---- Jones-Wilkins-Lee

TEST(Jwl, IsentropeIdentityAndTable) {
    struct State {
        double v, pressure, energy, sound;
    };
    const State table[] = {{1, 6.664683, 6.739106, 3.7227}, {2, 1.137347, 3.939323, 2.1061}, {4, 0.226013, 2.958226, 1.0943},
                           {7, 0.101513, 2.517634, 0.8339}, {10, 0.064203, 2.276678, 0.7897}, {20, 0.026402, 1.872454, 0.7161}};
    const Material m = products(petn_1320);
    const JwlSet& s = petn_1320;
    const double C = 1.228997;
    const auto pressure = [&](double v) { return s.A * std::exp(-s.R1 * v) + s.B * std::exp(-s.R2 * v) + C * std::pow(v, -1 - s.omega); };
    const auto energy = [&](double v) { return s.A / s.R1 * std::exp(-s.R1 * v) + s.B / s.R2 * std::exp(-s.R2 * v) + C / s.omega * std::pow(v, -s.omega); };
    for (double v = 0.6; v < 30; v *= 1.1) EXPECT_NEAR(m.eos->pressure(1 / v - 1, energy(v)), pressure(v), 1e-12 * pressure(v)) << v;
    for (const State& t : table) {
        const double mu = 1 / t.v - 1, e = energy(t.v);
        EXPECT_NEAR(e, t.energy, 2e-6);
        EXPECT_NEAR(m.eos->pressure(mu, e), t.pressure, 2e-6);
        EXPECT_NEAR(std::sqrt(m.eos->stiffness(mu, e) / s.density), t.sound, 1e-4);
        // and the adiabat of this code, integrated from V = 1, stays on it
        EXPECT_NEAR(along_adiabat(*m.eos, 0, energy(1), mu, 20000), e, 1e-8 * e);
    }
    EXPECT_NEAR(m.eos->pressure(0, s.E0), 6.8454, 1e-4);  // constant-volume burn
    EXPECT_NEAR(std::sqrt(m.eos->stiffness(0, s.E0) / s.density), 3.7462, 1e-4);
}

TEST(Jwl, ChapmanJouguetStates) {
    struct Cj {
        JwlSet set;
        double volume, pressure, speed, particle, sound, C;
    };
    const Cj table[] = {
        {{"PETN 1.77", 617, 16.926, 4.4, 1.2, 0.25, 10.1, 1.77}, 0.72525, 33.5086, 8.3008, 2.2807, 6.0201, 0.6987},
        {{"PETN 1.50", 625.3, 23.29, 5.25, 1.6, 0.28, 8.56, 1.50}, 0.73599, 22.0004, 7.4535, 1.9678, 5.4857, 1.1515},
        {{"PETN 1.26", 573.1, 20.16, 6.0, 1.8, 0.28, 7.19, 1.26}, 0.73902, 13.9955, 6.5238, 1.7026, 4.8212, 1.2661},
        {{"PETN 0.88", 348.62, 11.288, 7, 2, 0.24, 5.025, 0.88}, 0.72735, 6.1793, 5.0749, 1.3837, 3.6912, 0.9435},
        {petn_1320, 0.73899, 15.6534, 6.7405, 1.7593, 4.9812, 1.228997},
        {{"TNT", 371.2, 3.231, 4.15, 0.95, 0.30, 7.0, 1.63}, 0.73169, 20.9997, 6.9294, 1.8592, 5.0701, 1.0452},
        {{"Comp B", 524.2, 7.678, 4.2, 1.1, 0.34, 8.5, 1.717}, 0.73020, 29.4988, 7.9799, 2.1530, 5.8269, 1.0819},
    };
    for (const Cj& row : table) {
        SCOPED_TRACE(row.set.name);
        const JwlSet& s = row.set;
        const Material m = products(s);
        const CjState cj = chapman_jouguet(*m.eos, s.density);
        const double u = cj.pressure / (s.density * cj.speed), mu = 1 / cj.volume - 1;
        const double energy = s.E0 + 0.5 * cj.pressure * (1 - cj.volume);
        EXPECT_NEAR(cj.volume, row.volume, 1e-5);
        EXPECT_NEAR(cj.pressure, row.pressure, 1e-4);
        EXPECT_NEAR(cj.speed, row.speed, 1e-4);
        EXPECT_NEAR(u, row.particle, 1e-4);
        EXPECT_NEAR(m.eos->pressure(mu, energy), cj.pressure, 1e-12 * cj.pressure) << "on the Hugoniot";
        const double sound = std::sqrt(m.eos->stiffness(mu, energy) / s.density);
        EXPECT_NEAR(sound, row.sound, 1e-4);
        EXPECT_NEAR(sound, cj.speed - u, 1e-6) << "sonic: c = D - u";
        const double v = cj.volume;
        EXPECT_NEAR((cj.pressure - s.A * std::exp(-s.R1 * v) - s.B * std::exp(-s.R2 * v)) * std::pow(v, 1 + s.omega), row.C, 1e-4);
    }
}

TEST(Jwl, AGammaLawGasHasTheClosedFormCjState) {
    // P = (gamma - 1) rho e, e = D^2/(2 (gamma^2 - 1)): rho = 1.6, D = 7, gamma = 3 give P = 19.6 GPa, V = gamma/(gamma + 1).
    MaterialData data = read_material("air_paper");
    data.density.value = 1.6;
    set(data.eos, {{"C4", 2}, {"C5", 2}, {"E0", 1.6 * 49.0 / 16}});
    const CjState cj = chapman_jouguet(*make_material(data).eos, 1.6);
    EXPECT_NEAR(cj.speed, 7, 1e-9);
    EXPECT_NEAR(cj.pressure, 19.6, 1e-5);
    EXPECT_NEAR(cj.volume, 0.75, 1e-6);
}
