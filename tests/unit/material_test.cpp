// SPDX-License-Identifier: Apache-2.0
// From data to a material: every file of the library becomes one, its remarks say what is known of it, and wrong data is refused with its place.
#include "law_helpers.h"

using namespace brisance;
using namespace brisance::law_test;

namespace {

bool remarks(const Material& m, const std::string& fragment) {
    for (const std::string& r : m.remarks)
        if (says(r, fragment)) return true;
    return false;
}
void expect_refusal(const MaterialData& data, const std::string& place, const std::string& fragment) {
    const std::string message = refusal(data);
    EXPECT_EQ(message.find(place), 0u) << message;
    EXPECT_TRUE(says(message, fragment)) << message;
}

}  // namespace

TEST(Material, EveryFileOfTheLibraryBecomesOne) {
    EXPECT_GE(library_data().size(), 50u);
    for (const MaterialData& data : library_data()) {
        SCOPED_TRACE(data.name);
        Material m;
        ASSERT_NO_THROW(m = make_material(data));
        EXPECT_EQ(m.name, data.name);
        EXPECT_GT(m.density, 0);
        EXPECT_GT(m.sound_speed(), 0.1);
        EXPECT_LT(m.sound_speed(), 20);
        EXPECT_EQ(m.eos->law(), data.eos.law);
        EXPECT_EQ(m.strength != nullptr, data.strength.has_value());
        EXPECT_EQ(m.burn != nullptr, data.burn.has_value());
        if (m.strength) {
            EXPECT_EQ(m.strength->law(), data.strength->law);
            EXPECT_NEAR(m.longitudinal_modulus(), m.bulk_modulus() + 4.0 / 3 * m.strength->shear_modulus(), 1e-12 * m.longitudinal_modulus());
            const double nu = (3 * m.bulk_modulus() - 2 * m.strength->shear_modulus()) / (6 * m.bulk_modulus() + 2 * m.strength->shear_modulus());
            EXPECT_GT(nu, 0);
            EXPECT_LT(nu, 0.5);
        }
    }
}

TEST(Material, ExplosivesMeetTheirChapmanJouguetStateAsComputedIndependently) {
    struct Row {
        const char* name;
        double speed_off, pressure_off;  // per cent
    };
    const Row rows[] = {{"petn_880", -1.8, -0.3},  {"petn_1260", -0.25, 0.0}, {"petn_1320", 0.75, -2.2}, {"petn_1500", 0.05, 0.0}, {"petn_1770", 0.0, 0.0},
                        {"tnt", 0.0, 0.0},         {"tnt_autodyn", 0.0, 0.0}, {"comp_b", 0.0, 0.0},      {"c4", 0.0, 0.0},         {"hmx", -1.3, -4.9},
                        {"pbx_9404", 0.0, 0.0},    {"lx_14", 0.0, 0.0},       {"octol", 0.07, 0.1},      {"cyclotol", 0.0, 0.0},   {"pentolite_1700", 0.0, 0.0},
                        {"pentolite_1650", 0.0, 0.0}, {"nitromethane", -0.3, 0.0}, {"anfo", -0.02, 0.0}, {"emulsion_1310", 0.0, 0.1},
                        {"petn_1320_cj", 0.0, 0.0}, {"petn_1320_cj_1565", 0.0, 0.0}};
    for (const Row& row : rows) {
        SCOPED_TRACE(row.name);
        const Material m = library(row.name);
        const CjState cj = chapman_jouguet(*m.eos, m.density);
        EXPECT_NEAR(100 * (cj.speed / m.burn->speed - 1), row.speed_off, 0.08);
        EXPECT_NEAR(100 * (cj.pressure / m.burn->cj_pressure - 1), row.pressure_off, 0.12);
        const bool misses = std::abs(row.speed_off) > 1 || std::abs(row.pressure_off) > 3;
        EXPECT_EQ(remarks(m, "warning: the products miss the stated CJ state"), misses);
        EXPECT_TRUE(remarks(m, "CJ state of the products: D = "));
    }
    struct Computed {
        const char* name;
        double speed, pressure;
    };
    for (const Computed& row : {Computed{"comp_b_uintah", 7.980, 29.50}, {"qm_100", 5.899, 10.17}, {"emulsion_1180", 5.654, 9.60}}) {
        SCOPED_TRACE(row.name);
        const Material m = library(row.name);
        const CjState cj = chapman_jouguet(*m.eos, m.density);
        EXPECT_NEAR(cj.speed, row.speed, 1e-3);
        EXPECT_NEAR(cj.pressure, row.pressure, 1e-2);
    }
}

TEST(Material, BurnLawTakesItsVolumeFromTheStatedState) {
    const Material m = library("petn_1320");
    EXPECT_DOUBLE_EQ(m.burn->speed, 6.69);
    EXPECT_DOUBLE_EQ(m.burn->cj_pressure, 16);
    EXPECT_NEAR(m.burn->cj_volume, 0.7292, 5e-5);  // gamma = 2.692
    EXPECT_NEAR(m.burn->cj_volume, 1 - 16 / (1.32 * 6.69 * 6.69), 1e-15);
    MaterialData data = read_material("petn_1320");
    set(*data.burn, {{"P_CJ", 60}});
    expect_refusal(data, data.burn->parameters.at("P_CJ").where, "which no explosive has");
    data = read_material("petn_1320");
    data.burn->law = "programed";
    expect_refusal(data, data.burn->where, "allowed: programmed");
    data = read_material("petn_1320");
    data.burn->parameters.erase("D");
    expect_refusal(data, data.burn->where, "needs D");
}

TEST(Material, HelOfTheSetsAsComputedIndependently) {
    struct Row {
        const char* name;
        double quoted, computed;
    };
    for (const Row& row : {Row{"alumina", 1.46, 1.462}, {"aluminium_nitride", 5.0, 5.006}, {"boron_carbide", 8.71, 8.707}, {"silicon_carbide", 5.9, 6.765},
                           {"float_glass", 2.92, 2.920}, {"granite_ai_ahrens", 2.73, 2.760}, {"sandstone_baranowski", 1.374, 1.365}}) {
        SCOPED_TRACE(row.name);
        const MaterialData data = read_material(row.name);
        EXPECT_DOUBLE_EQ(data.strength->parameters.at("PHEL").value, row.quoted);
        MaterialData derived = data;
        set(*derived.strength, {{"PHEL", 0}});
        const Material m = make_material(derived);
        std::string text;
        for (const std::string& r : m.remarks)
            if (says(r, "strength at P = 0")) text = r;
        ASSERT_EQ(text.find("PHEL = "), 0u) << text;
        EXPECT_NEAR(std::strtod(text.c_str() + 7, nullptr), row.computed, 6e-4);
        EXPECT_EQ(remarks(make_material(data), "off the"), std::abs(row.quoted / row.computed - 1) > 0.01);
    }
}

TEST(Material, SoundSpeedsOfTheGranites) {
    EXPECT_NEAR(1e3 * library("barre_granite").sound_speed(), 4543, 0.5);
    EXPECT_NEAR(1e3 * library("barre_granite_286").sound_speed(), 4868, 0.5);
    EXPECT_NEAR(1e3 * library("granite_ai_ahrens").sound_speed(), 5998, 0.5);
    EXPECT_NEAR(1e3 * library("sandstone_baranowski").sound_speed(), 1765, 0.5);
    EXPECT_NEAR(1e3 * varied("copper_ofhc", {}, {}, 8.96).sound_speed(), 1e3 * std::sqrt(3.94 * 3.94 + 4 * 46 / (3 * 8.96)), 1e-9);
}

TEST(Material, APressureLawThatTurnsIsRemarkedOrRefused) {
    EXPECT_TRUE(remarks(library("concrete_jh2"), "has c^2 <= 0 at mu = 0.288"));  // 16.667 + 146.38 mu - 708.6 mu^2 = 0 at 0.2882
    EXPECT_FALSE(remarks(library("barre_granite"), "c^2"));
    EXPECT_FALSE(remarks(library("hard_rock_ma_an"), "c^2"));
    MaterialData data = read_material("barre_granite");
    set(data.eos, {{"K2", -1500}});  // 25.7 - 3000 mu + 38400 mu^2 < 0 from mu = 0.0098
    expect_refusal(data, data.eos.where, "c^2 <= 0 at mu = 0.010");
}

TEST(Material, NoSoundAnywhereInTheWorkingRangeIsRefusedWithItsSource) {
    // tension: -K Gamma mu of the energy term outgrows K: c^2 = K (1 + mu Gamma/(1+mu)^2) / rho_0 < 0 before a tenth of the density is lost
    MaterialData water = read_material("water");
    set(water.eos, {{"Gamma0", 9.5}, {"pressure_cutoff", -1e4}});
    expect_refusal(water, water.eos.where, "c^2 <= 0 at mu = -0.0");
    EXPECT_TRUE(says(refusal(water), water.source)) << refusal(water);
    // products far out: B < 0 pulls the pressure back in while they still expand
    MaterialData petn = read_material("petn_1320");
    set(petn.eos, {{"B", -21.6}});
    expect_refusal(petn, petn.eos.where, "c^2 <= 0");
    EXPECT_TRUE(says(refusal(petn), petn.source));
    EXPECT_EQ(refusal(read_material("air")), "no error");
}

TEST(Material, WarningsCarryTheSourceOfTheRow) {
    for (const char* name : {"hmx", "petn_880", "concrete_jh2", "silicon_carbide"}) {
        const MaterialData data = read_material(name);
        int warnings = 0;
        for (const std::string& r : make_material(data).remarks)
            if (says(r, "warning")) {
                ++warnings;
                EXPECT_TRUE(says(r, "source: " + data.source)) << r;
            }
        EXPECT_GE(warnings, 1) << name;
    }
    MaterialData hard = read_material("barre_granite");
    set(*hard.strength, {{"G", 40}, {"HEL", 6}});
    EXPECT_TRUE(remarks(make_material(hard), "Poisson's ratio"));  // (3 K - 2 G) < 0
}

TEST(Material, AnHelBelowItsPressureIsRefusedWithItsSource) {
    MaterialData data = read_material("alumina");
    set(*data.strength, {{"PHEL", 3}});
    expect_refusal(data, data.strength->parameters.at("PHEL").where, "is not below HEL");
    EXPECT_TRUE(says(refusal(data), data.strength->parameters.at("HEL").source));
}

TEST(Material, UnknownLawsNameTheOnesThereAre) {
    MaterialData data = read_material("barre_granite");
    data.strength->law = "jh3";
    std::string message = refusal(data);
    EXPECT_EQ(message.find(data.strength->where), 0u) << message;
    for (const StrengthEntry& e : strength_entries()) EXPECT_TRUE(says(message, e.name)) << message;
    data = read_material("barre_granite");
    data.eos.law = "";
    message = refusal(data);
    EXPECT_EQ(message.find(data.eos.where), 0u) << message;
    for (const EosEntry& e : eos_entries()) EXPECT_TRUE(says(message, e.name)) << message;
}

TEST(Material, DensityHasToBeOne) {
    for (const double value : {0.0, -1.0, std::nan("")}) {
        MaterialData data = read_material("barre_granite");
        data.density.value = value;
        expect_refusal(data, data.density.where, "density");
    }
    MaterialData data = read_material("barre_granite");
    data.density.dimension = dimension::pressure;
    expect_refusal(data, data.density.where, "2660 kg/m3");
}

TEST(Material, LawsTakeTheDensityOfTheMaterial) {
    // rho_0 C^2 of Mie-Grueneisen follows the material's density.
    const double k = library("water").bulk_modulus();
    EXPECT_NEAR(varied("water", {}, {}, 0.998).bulk_modulus(), 0.998 * k, 1e-12 * k);
}

TEST(Material, SortedListingsWithoutDoubles) {
    for (std::size_t i = 1; i < eos_entries().size(); ++i) EXPECT_LT(eos_entries()[i - 1].name, eos_entries()[i].name);
    for (std::size_t i = 1; i < strength_entries().size(); ++i) EXPECT_LT(strength_entries()[i - 1].name, strength_entries()[i].name);
    EXPECT_FALSE(eos_entries().empty());
    EXPECT_FALSE(strength_entries().empty());
}
