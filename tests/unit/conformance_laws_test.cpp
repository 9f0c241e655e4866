// SPDX-License-Identifier: Apache-2.0
// What every registered strength law has to obey, whatever its name, with every material of the library that uses it; and what the
// parameter table of every law, strength and equation of state, has to say and to refuse.
#include "io/archive.h"
#include "law_helpers.h"

#include <rapidcheck.h>

#include <filesystem>
#include <set>
#include <unistd.h>

using namespace brisance;
using namespace brisance::law_test;

namespace {

constexpr double slow = 1e12;  ///< us; so long a step that no rate term acts

template <class F> void for_every_strength(const F& f) {
    for (const StrengthEntry& entry : strength_entries())
        for (const MaterialData& data : users_of(entry)) {
            SCOPED_TRACE(entry.name + " of " + data.name);
            f(make_material(data));
        }
}
/// All materials with a strength law, for the random tests.
const std::vector<Material>& solids() {
    static const std::vector<Material> all = [] {
        std::vector<Material> v;
        for (const StrengthEntry& entry : strength_entries())
            for (const Material& m : materials_of(users_of(entry))) v.push_back(m);
        return v;
    }();
    return all;
}

/// A random state that a run can reach: strained from rest in a few steps.
SolidPoint<double> reached(const Material& m, Random& random, double size, double dt) {
    SolidPoint<double> p = at_rest(m, dt);
    Sym total{};
    for (int i = 0; i < 4; ++i) {
        const Sym d = random.sym(size);
        total = total + d;
        step(m, p, d, std::exp(-trace(total)) - 1);
    }
    return p;
}
std::vector<double> everything(const Material& m, const SolidPoint<double>& p) {
    std::vector<double> v{p.pressure, p.yield, p.shear_stiffness, p.integrity};
    for (const double x : components(p.s)) v.push_back(x);
    for (std::size_t i = 0; i < m.strength->state().size(); ++i) v.push_back(p.state[i]);
    return v;
}

template <class V> void set_lane(V& v, int l, double x) {
    const auto r = static_cast<ScalarOf<V>>(x);
    std::memcpy(reinterpret_cast<char*>(&v) + static_cast<std::size_t>(l) * sizeof(r), &r, sizeof(r));
}
template <class V, class F> void for_each_field(SolidPoint<V>& p, const F& f) {
    for (V* x : {&p.d.xx, &p.d.yy, &p.d.zz, &p.d.xy, &p.d.xz, &p.d.yz, &p.s.xx, &p.s.yy, &p.s.zz, &p.s.xy, &p.s.xz, &p.s.yz, &p.mu, &p.pressure, &p.energy,
                 &p.dt, &p.scale, &p.yield, &p.shear_stiffness, &p.integrity})
        f(*x);
    for (V& x : p.state) f(x);
}
template <class V> SolidPoint<V> packed(const std::vector<SolidPoint<double>>& points) {
    SolidPoint<V> out{};
    for (int l = 0; l < lanes_of<V>; ++l) {
        SolidPoint<double> one = points[static_cast<std::size_t>(l) % points.size()];
        std::vector<double> values;
        for_each_field(one, [&](double& x) { values.push_back(x); });
        std::size_t i = 0;
        for_each_field(out, [&](V& v) { set_lane(v, l, values[i++]); });
    }
    return out;
}
template <class V> std::vector<double> lane_values(SolidPoint<V>& p, int l) {
    std::vector<double> values;
    for_each_field(p, [&](V& v) { values.push_back(static_cast<double>(lane(v, l))); });
    return values;
}

/// Generators for rapidcheck, made of whole numbers so that a failing path shrinks: fewer increments, smaller ones.
Sym any_sym(double size) {
    const auto c = [size] { return size * 1e-3 * *rc::gen::inRange(-1000, 1001); };
    return {c(), c(), c(), c(), c(), c()};
}
std::vector<Sym> any_path(int most, double size) {
    std::vector<Sym> path;
    const int n = *rc::gen::inRange(1, most + 1);
    for (int i = 0; i < n; ++i) path.push_back(any_sym(size));
    return path;
}
const Material& any_solid() { return solids()[*rc::gen::inRange<std::size_t>(0, solids().size())]; }
/// From low to high in 100 steps of the logarithm; shrinks to low.
double any_size(double low, double high) { return low * std::pow(high / low, 0.01 * *rc::gen::inRange(0, 101)); }

}  // namespace

// ---- tables

namespace {
template <class Entry> void check_table(const Entry& entry) {
    SCOPED_TRACE(entry.name);
    EXPECT_TRUE(std::regex_match(entry.name, std::regex("[a-z][a-z0-9_]*")));
    EXPECT_FALSE(entry.meaning.empty());
    EXPECT_FALSE(entry.parameters.empty());
    std::set<std::string> names;
    for (const ParameterInfo& row : entry.parameters) {
        EXPECT_TRUE(std::regex_match(row.name, std::regex("[A-Za-z][A-Za-z0-9_]*"))) << row.name;
        EXPECT_TRUE(names.insert(row.name).second) << row.name << " stands there twice";
        EXPECT_FALSE(row.meaning.empty()) << row.name;
        EXPECT_FALSE(dimension_name(row.dimension).empty()) << row.name;
        EXPECT_FALSE(dimension_example(row.dimension).empty()) << row.name;
        EXPECT_TRUE(std::isfinite(row.min) && std::isfinite(row.max)) << row.name << " has no range";
        EXPECT_LE(row.min, row.max) << row.name;
        if (row.fallback) {
            EXPECT_TRUE(*row.fallback >= row.min && *row.fallback <= row.max) << row.name;
        }
    }
}
}  // namespace

TEST(LawTables, SayNameDimensionMeaningAndRange) {
    for (const EosEntry& entry : eos_entries()) check_table(entry);
    for (const StrengthEntry& entry : strength_entries()) {
        check_table(entry);
        SCOPED_TRACE(entry.name);
        EXPECT_LE(entry.state.size(), static_cast<std::size_t>(max_law_state));
        std::set<std::string> names;
        for (const StateInfo& row : entry.state) {
            EXPECT_TRUE(names.insert(row.name).second) << row.name;
            EXPECT_FALSE(row.name.empty() || row.unit.empty() || row.meaning.empty()) << row.name;
            EXPECT_TRUE(std::isfinite(row.initial));
        }
        // the passes over a body read damage in the first column
        const int damage = column(entry.state, "damage");
        EXPECT_TRUE(damage <= 0) << "damage stands first";
        EXPECT_TRUE(entry.state.empty() || entry.state[0].kept);
    }
    EXPECT_FALSE(burn_parameters().empty());
}

namespace {
template <class Entry, class Part> void check_refusals(const Entry& entry, const Part& part) {
    SCOPED_TRACE(entry.name);
    const MaterialData good = users_of(entry).front();
    ASSERT_EQ(refusal(good), "no error");
    for (const ParameterInfo& row : entry.parameters) {
        if (row.name == "density") continue;  // the material's
        SCOPED_TRACE(row.name);
        MaterialData data = good;
        part(data).parameters.erase(row.name);
        if (!row.fallback) {
            const std::string message = refusal(data);
            EXPECT_EQ(message.find(part(good).where), 0u) << message;
            EXPECT_TRUE(names_a_place(message) && says(message, row.name) && says(message, row.meaning)) << message;
        } else {
            EXPECT_EQ(refusal(data), "no error");
        }
        const auto with = [&](double value, Dimension dimension) {
            MaterialData bad = good;
            bad.name = "bad";
            part(bad).parameters[row.name] = {value, dimension, "<as written>", "test", "c", "bad.toml:42:7"};
            return refusal(bad);
        };
        for (const double value : {row.max + 1 + 0.01 * std::abs(row.max), row.min - 1 - 0.01 * std::abs(row.min), std::nan("")}) {
            const std::string message = with(value, row.dimension);
            EXPECT_EQ(message.find("bad.toml:42:7"), 0u) << message;
            EXPECT_TRUE(says(message, row.name) && says(message, "<as written>") && says(message, "outside of")) << message;
        }
        const double inside = 0.5 * (std::max(row.min, -1e3) + std::min(row.max, 1e3));
        const std::string message = with(inside, row.dimension == dimension::mass ? dimension::length : dimension::mass);
        EXPECT_EQ(message.find("bad.toml:42:7"), 0u) << message;
        EXPECT_TRUE(says(message, row.name) && says(message, dimension_name(row.dimension)) && says(message, dimension_example(row.dimension))) << message;
    }
    MaterialData data = good;
    part(data).parameters["no_such"] = {1, dimension::none, "1", "test", "c", "bad.toml:43:1"};
    const std::string message = refusal(data);
    EXPECT_EQ(message.find("bad.toml:43:1"), 0u) << message;
    EXPECT_TRUE(says(message, "no_such") && says(message, entry.parameters.back().name)) << message;
}
}  // namespace

TEST(LawTables, RefuseMissingUnknownAndOutOfRangeWithTheirPlace) {
    for (const EosEntry& entry : eos_entries()) check_refusals(entry, [](auto& data) -> auto& { return data.eos; });
    for (const StrengthEntry& entry : strength_entries()) check_refusals(entry, [](auto& data) -> auto& { return *data.strength; });
}

// ---- behaviour

TEST(EveryStrength, SmallStrainGivesHooke) {
    for_every_strength([](const Material& m) {
        Random random(1);
        const double G = m.strength->shear_modulus();
        EXPECT_GT(G, 0);
        for (int i = 0; i < 20; ++i) {
            const Sym d = random.sym(1e-6);
            SolidPoint<double> p = at_rest(m, slow);
            const SolidPoint<double> before = p;
            step(m, p, d, std::exp(-trace(d)) - 1);
            EXPECT_LT(norm(p.s - (2 * G) * deviator(d)), 1e-14 * 2 * G * 1e-6);
            EXPECT_DOUBLE_EQ(p.shear_stiffness, 4.0 / 3 * G);
            EXPECT_EQ(p.pressure, m.eos->pressure(p.mu, p.energy));
            EXPECT_GT(p.yield, mises(p.s));
            EXPECT_EQ(p.integrity, 1);
            for (std::size_t k = 0; k < m.strength->state().size(); ++k) EXPECT_EQ(p.state[k], before.state[k]);
        }
    });
}

TEST(EveryStrength, StressStaysADeviatorAndGrowsOnlyByStrain) {
    for_every_strength([](const Material& m) {
        Random random(2);
        for (int i = 0; i < 300; ++i) {
            SolidPoint<double> p = reached(m, random, random.decades(1e-5, 1e-2), 1);
            EXPECT_NEAR(trace(p.s), 0, 1e-12 * (norm(p.s) + 1e-3));
            const double borne = mises(p.s);
            step(m, p, {}, p.mu);
            EXPECT_LE(mises(p.s), borne * (1 + 1e-12)) << "without strain nothing is added";
        }
    });
}

TEST(EveryStrength, RotatedInputGivesRotatedOutput) {
    for_every_strength([](const Material& m) {
        Random random(3);
        for (int i = 0; i < 200; ++i) {
            const double size = random.decades(1e-5, 3e-2);
            SolidPoint<double> p = reached(m, random, size, 1), r = p;
            const Mat3<double> q = random.rotation();
            const Sym d = random.sym(size);
            r.s = rotated(q, p.s);
            const double mu = random.uniform(-0.005, 0.05);
            step(m, p, d, mu);
            step(m, r, rotated(q, d), mu);
            const double scale = norm(p.s) + 2 * m.strength->shear_modulus() * size;
            EXPECT_LT(norm(r.s - rotated(q, p.s)), 1e-11 * scale);
            EXPECT_NEAR(r.pressure, p.pressure, 1e-13 * m.bulk_modulus());
            EXPECT_NEAR(r.yield, p.yield, 1e-11 * p.yield);
            for (std::size_t k = 0; k < m.strength->state().size(); ++k) EXPECT_NEAR(r.state[k], p.state[k], 1e-9 * (1 + std::abs(p.state[k])));
        }
    });
}

TEST(EveryStrength, YieldingTwiceChangesNothing) {
    // Slow steps: no rate term. Only the heat of a step, which acts from the next one on, may soften a little more; it grows as theta^m, m > 1/2.
    for_every_strength([](const Material& m) {
        Random random(4);
        for (int i = 0; i < 200; ++i) {
            const double size = random.decades(1e-5, 3e-3);
            SolidPoint<double> p = reached(m, random, size, slow);
            const SolidPoint<double> once = p;
            step(m, p, {}, p.mu);
            const bool heats = column(m.strength->state(), "heating") >= 0;
            const double left = heats ? 0.1 * std::sqrt(size) : 1e-12;
            EXPECT_LE(norm(p.s - once.s), left * norm(once.s)) << size;
            const int plastic = column(m.strength->state(), "plastic_strain"), damage = column(m.strength->state(), "damage");
            if (plastic >= 0) {  // the stress that was given up is plastic strain
                const double given_up = (mises(once.s) - mises(p.s)) / (3 * m.strength->shear_modulus());
                EXPECT_NEAR(p.state[plastic] - once.state[plastic], given_up, 1e-13 + 1e-9 * given_up);
            }
            if (damage >= 0) {
                EXPECT_NEAR(p.state[damage], once.state[damage], heats ? left : 1e-9);
            }
            // and what is left dies out
            for (int k = 0; k < 3; ++k) step(m, p, {}, p.mu);
            const SolidPoint<double> settled = p;
            step(m, p, {}, p.mu);
            EXPECT_LE(norm(p.s - settled.s), 1e-9 * norm(once.s));
        }
    });
}

TEST(EveryStrength, DamageIsAFractionAndNeverFalls) {
    EXPECT_TRUE(rc::check("0 <= damage <= 1, never falling, along random paths", [] {
        const Material& m = any_solid();
        const int damage = column(m.strength->state(), "damage"), plastic = column(m.strength->state(), "plastic_strain");
        SolidPoint<double> p = at_rest(m, any_size(1e-3, 1e6));
        p.scale = any_size(0.3, 2);
        Sym total{};
        for (const Sym& d : any_path(100, any_size(1e-5, 2e-2))) {
            total = total + d;
            const SolidPoint<double> before = p;
            step(m, p, d, std::exp(-trace(total)) - 1);
            if (damage >= 0) RC_ASSERT(p.state[damage] >= before.state[damage] && p.state[damage] >= 0 && p.state[damage] <= 1);
            if (plastic >= 0) RC_ASSERT(p.state[plastic] >= before.state[plastic]);
            RC_ASSERT(p.integrity >= 0 && p.integrity <= 1);
            RC_ASSERT(p.yield >= 0);
            for (const double x : everything(m, p)) RC_ASSERT(std::isfinite(x));
        }
    }));
}

TEST(EveryStrength, AClosedCycleOfStrainCostsWork) {
    // Work of the stress deviator over a cycle that starts without stress is what is stored at its end plus what was dissipated: never
    // negative. Neither is the total work per initial volume, pressure included (constant energy, so that the equation of state gives back
    // what it took), up to what a hypoelastic law gains from volume changes under shear: about the volume strain times the largest work.
    EXPECT_TRUE(rc::check("work over closed cycles is not negative", [] {
        const Material& m = any_solid();
        SolidPoint<double> p = at_rest(m, slow);
        const double size = any_size(1e-4, 3e-2), swelling = 0.01 * *rc::gen::inRange(0, 51) * size;
        std::vector<Sym> path{{}};  // a polygon of strains from rest back to rest
        const int corners = *rc::gen::inRange(1, 5);
        for (int i = 0; i < corners; ++i) {
            const double v = swelling * 1e-3 * *rc::gen::inRange(-1000, 1001) / 3;
            path.push_back(deviator(any_sym(size)) + Sym{v, v, v, 0, 0, 0});
        }
        path.push_back({});
        const int n = 200;
        double shear_work = 0, work = 0, largest_shear = 0, largest = 0;
        for (int repeat = 0; repeat < 2; ++repeat)
            for (std::size_t leg = 1; leg < path.size(); ++leg)
                for (int i = 1; i <= n; ++i) {
                    const Sym d = (1.0 / n) * (path[leg] - path[leg - 1]);
                    const double strain = trace(path[leg - 1]) + trace(path[leg] - path[leg - 1]) * i / n;
                    const SolidPoint<double> before = p;
                    step(m, p, d, std::exp(-strain) - 1);
                    const double v = 1 / (1 + p.mu), v_before = 1 / (1 + before.mu);
                    const double dw = 0.5 * ddot(p.s + before.s, deviator(d));
                    shear_work += dw;
                    work += 0.5 * (v + v_before) * dw - 0.5 * (p.pressure + before.pressure) * (v - v_before);
                    largest_shear = std::max(largest_shear, std::abs(shear_work));
                    largest = std::max(largest, std::abs(work));
                }
        RC_ASSERT(shear_work >= -1e-12 * largest_shear);
        RC_ASSERT(work >= -size * largest);
    }));
}

TEST(EveryStrength, RemembersNothingButItsColumns) {
    // A point that goes through a file half way, with stress, columns, energy and nothing else, ends with the same bits. What the law is to
    // return is poisoned on the way, and so are columns that a body does not keep, so that it cannot lean on them.
    const std::filesystem::path file = std::filesystem::temp_directory_path() / ("law_state_" + std::to_string(getpid()) + ".h5");
    for_every_strength([&](const Material& m) {
        Random random(8);
        const std::vector<StateInfo> rows = m.strength->state();
        const std::size_t columns = rows.size();
        for (int i = 0; i < 5; ++i) {
            const double size = random.decades(1e-5, 1e-2);
            SolidPoint<double> p = reached(m, random, size, 1);
            SolidPoint<double> q = p;
            std::vector<double> kept;
            for (const double x : components(p.s)) kept.push_back(x);
            kept.insert(kept.end(), p.state, p.state + columns);
            kept.insert(kept.end(), {p.energy, p.scale, p.dt});
            {
                ArchiveWriter out(file);
                out("kept", kept);
                out.close();
            }
            std::vector<double> back;
            ArchiveReader in(file);
            in("kept", back);
            in.finish();
            ASSERT_EQ(back.size(), kept.size());
            q = {};
            for (std::size_t k = 0; k < 6; ++k) component(q.s, k) = back[k];
            for (std::size_t k = 0; k < static_cast<std::size_t>(max_law_state); ++k) q.state[k] = k < columns ? back[6 + k] : std::nan("");
            q.energy = back[6 + columns];
            q.scale = back[7 + columns];
            q.dt = back[8 + columns];
            q.yield = q.shear_stiffness = q.integrity = std::nan("");
            for (int n = 0; n < 3; ++n) {
                const Sym d = random.sym(size);
                const double mu = random.uniform(-0.005, 0.05);
                for (std::size_t k = 0; k < columns; ++k)
                    if (!rows[k].kept) q.state[k] = std::nan("");
                step(m, p, d, mu);
                step(m, q, d, mu);
                for (std::size_t k = 0; k < columns; ++k)
                    if (!rows[k].kept) q.state[k] = p.state[k];
                const std::vector<double> want = everything(m, p), got = everything(m, q);
                for (std::size_t k = 0; k < want.size(); ++k) ASSERT_TRUE(same_bits(got[k], want[k])) << k;
            }
        }
    });
    std::filesystem::remove(file);
}

TEST(EveryStrength, SoundSpeedIsTheSlopeOfTheAxialStress) {
    // c_L^2 = d sigma_x / d rho at rest, and the declared speed is that of the material; shear waves: c_S^2 = G/rho
    for_every_strength([](const Material& m) {
        const double e = 3e-8;
        double axial[2], shear[2];
        for (const int k : {0, 1}) {
            const double strain = k == 0 ? -e : e;
            SolidPoint<double> p = at_rest(m, slow);
            step(m, p, {strain, 0, 0, 0, 0, 0}, std::exp(-strain) - 1);
            axial[k] = p.s.xx - p.pressure;
            p = at_rest(m, slow);
            step(m, p, {0, 0, 0, strain, 0, 0}, 0);
            shear[k] = p.s.xy;
        }
        const double c_l = std::sqrt((axial[1] - axial[0]) / (2 * e) / m.density), c_s = std::sqrt((shear[1] - shear[0]) / (4 * e) / m.density);
        EXPECT_NEAR(m.sound_speed(), c_l, 1e-5 * c_l);
        EXPECT_NEAR(std::sqrt(m.strength->shear_modulus() / m.density), c_s, 1e-7 * c_s);
    });
}

TEST(EveryStrength, NoNanForHugeIncrements) {
    for_every_strength([](const Material& m) {
        Random random(5);
        for (int i = 0; i < 400; ++i) {
            std::vector<SolidPoint<double>> points;
            for (int l = 0; l < lanes<float>; ++l) {
                SolidPoint<double> p = at_rest(m, random.decades(1e-6, 1e6));
                p.scale = random.uniform(0.1, 3);
                const double size = random.decades(1e-3, 1e3);
                p.s = deviator(random.sym(random.decades(1e-6, 1e3)));
                p.d = random.sym(size);
                p.mu = random.decades(1e-3, 20) - 0.95;
                p.pressure = m.eos->pressure(p.mu, p.energy);
                const int damage = column(m.strength->state(), "damage"), plastic = column(m.strength->state(), "plastic_strain");
                if (damage >= 0) p.state[damage] = i % 3 ? random.uniform(0, 1) : i % 2;
                if (plastic >= 0) p.state[plastic] = i % 2 ? 0 : random.decades(1e-12, 1e2);
                points.push_back(p);
            }
            SolidPoint<Pack<float>> f = packed<Pack<float>>(points);
            m.strength->update_pack(f);
            for (int l = 0; l < lanes<float>; ++l)
                for (const double x : lane_values(f, l)) ASSERT_TRUE(std::isfinite(x));
            for (SolidPoint<double>& p : points) {
                m.strength->update(p);
                for (const double x : everything(m, p)) ASSERT_TRUE(std::isfinite(x));
                const int damage = column(m.strength->state(), "damage");
                if (damage >= 0) {
                    ASSERT_TRUE(p.state[damage] >= 0 && p.state[damage] <= 1);
                }
            }
        }
    });
}

TEST(EveryStrength, PackGivesTheBitsOfThePoint) {
    for_every_strength([](const Material& m) {
        Random random(6);
        for (int i = 0; i < 200; ++i) {
            std::vector<SolidPoint<double>> points;
            for (int l = 0; l < lanes<double>; ++l) {
                const double size = random.decades(1e-6, 3e-2);
                SolidPoint<double> p = reached(m, random, size, random.decades(1e-3, 1e3));
                p.scale = random.uniform(0.5, 1.5);
                p.d = random.sym(size);
                p.mu = random.uniform(-0.01, 0.05);
                p.pressure = m.eos->pressure(p.mu, p.energy);
                points.push_back(p);
            }
            SolidPoint<Pack<double>> batch = packed<Pack<double>>(points);
            m.strength->update_pack(batch);
            for (int l = 0; l < lanes<double>; ++l) {
                SolidPoint<double>& p = points[static_cast<std::size_t>(l)];
                m.strength->update(p);
                const std::vector<double> got = lane_values(batch, l);
                std::vector<double> want;
                for_each_field(p, [&](double& x) { want.push_back(x); });
                for (std::size_t k = 0; k < want.size(); ++k)
                    ASSERT_TRUE(same_bits(got[k], want[k])) << "field " << k << ": " << got[k] << " - " << want[k] << " = " << got[k] - want[k];
            }
        }
    });
}

TEST(EveryStrength, SinglePrecisionFollowsDoubleInEveryLane) {
    for_every_strength([](const Material& m) {
        Random random(7);
        const double G = m.strength->shear_modulus();
        for (int i = 0; i < 100; ++i) {
            const double size = random.decades(1e-5, 1e-2);
            SolidPoint<double> p = at_rest(m, 1);
            p.d = random.sym(size);
            p.mu = random.uniform(0.002, 0.03);
            p.pressure = m.eos->pressure(p.mu, p.energy);
            SolidPoint<Pack<float>> f = packed<Pack<float>>({p});
            m.strength->update_pack(f);
            m.strength->update(p);
            const std::vector<double> first = lane_values(f, 0);
            for (int l = 1; l < lanes<float>; ++l) EXPECT_EQ(lane_values(f, l), first) << "lanes do not know each other";
            EXPECT_NEAR(first[6], p.s.xx, 1e-5 * (2 * G * size + mises(p.s)));
            EXPECT_NEAR(first[9], p.s.xy, 1e-5 * (2 * G * size + mises(p.s)));
            EXPECT_NEAR(first[13], p.pressure, 1e-5 * m.bulk_modulus());
        }
    });
}
