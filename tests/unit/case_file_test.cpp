// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "io/case_file.h"
#include "io/config.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <set>
#include <sstream>

#include <unistd.h>

using namespace brisance;
namespace fs = std::filesystem;

namespace {

const fs::path data = fs::path(BRISANCE_SOURCE_DIR) / "tests/unit/data";
const std::string good_file = (data / "case.toml").string();

std::string content(const fs::path& file) {
    std::ifstream in(file);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

class CaseFile : public testing::Test {
protected:
    void SetUp() override {
        setenv("BRISANCE_MATERIALS", (data / "materials").c_str(), 1);
        const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
        folder_ = fs::temp_directory_path() / ("brisance_" + test + "_" + std::to_string(getpid()));
        fs::create_directories(folder_);
    }
    void TearDown() override {
        unsetenv("BRISANCE_MATERIALS");
        fs::remove_all(folder_);
    }
    std::string write(const std::string& name, const std::string& text) const {
        fs::create_directories((folder_ / name).parent_path());
        std::ofstream(folder_ / name) << text;
        return (folder_ / name).string();
    }
    fs::path folder_;
};

std::string message_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

std::string message_of(const std::string& file, const std::string& preset, const std::vector<std::string>& settings) {
    return message_of([&] { read_case(file, preset, settings); });
}

void expect_says(const std::string& message, const std::string& fragment, const std::string& about) {
    EXPECT_NE(message.find(fragment), std::string::npos) << about << "\n  wanted: " << fragment << "\n  said:   " << message;
}

const PartData& part(const Case& c, const std::string& name) {
    return *std::find_if(c.parts.begin(), c.parts.end(), [&](const PartData& p) { return p.name == name; });
}

}  // namespace

TEST_F(CaseFile, ReadsEveryKindOfValue) {
    const Case c = read_case(good_file, "", {});
    EXPECT_EQ(c.title, "Unit test");
    EXPECT_EQ(c.file, good_file);
    EXPECT_DOUBLE_EQ(c.until, 10);
    EXPECT_EQ(c.seed, 1u);
    EXPECT_EQ(c.precision, Precision::double_);
    ASSERT_EQ(c.parts.size(), 2u);

    const PartData& rock = c.parts[0];
    EXPECT_EQ(rock.name, "rock");
    EXPECT_TRUE(rock.where.ends_with("case.toml:9:7")) << rock.where;
    EXPECT_EQ(rock.formulation, Formulation::total_lagrangian);
    EXPECT_EQ(rock.arrangement, Arrangement::relaxed);
    EXPECT_DOUBLE_EQ(rock.angle, std::numbers::pi / 8);
    EXPECT_DOUBLE_EQ(rock.spacing, 0.5);
    EXPECT_DOUBLE_EQ(rock.spacing_far, 1);
    EXPECT_DOUBLE_EQ(rock.spacing_z, 0.5);
    EXPECT_DOUBLE_EQ(rock.grading_radius, 5);
    EXPECT_DOUBLE_EQ(rock.grading_growth, 0.03);
    EXPECT_DOUBLE_EQ(rock.smoothing, 1.3);
    EXPECT_DOUBLE_EQ(rock.velocity.x, 1e-3);
    EXPECT_DOUBLE_EQ(rock.velocity.z, -2e-3);
    EXPECT_FALSE(rock.viscosity.pairwise);
    EXPECT_DOUBLE_EQ(rock.viscosity.linear, 0.06);
    EXPECT_DOUBLE_EQ(rock.viscosity.quadratic, 1.5);
    EXPECT_DOUBLE_EQ(rock.zero_energy, 0.05);
    EXPECT_EQ(rock.failure.mode, OnFailure::all_zero);
    EXPECT_DOUBLE_EQ(rock.failure.tensile_strength.value(), 0.1);
    EXPECT_FALSE(rock.failure.shear_strength);
    EXPECT_DOUBLE_EQ(rock.heterogeneity.weibull_modulus, 10);
    EXPECT_EQ(rock.heterogeneity.seed, 7u);
    EXPECT_TRUE(rock.shape->contains({19, 0, 25}));
    EXPECT_FALSE(rock.shape->contains({21, 0, 25}));

    const PartData& charge = c.parts[1];
    EXPECT_EQ(charge.formulation, Formulation::updated_lagrangian);
    EXPECT_TRUE(charge.viscosity.pairwise);
    EXPECT_DOUBLE_EQ(charge.viscosity.beta, 2);
    EXPECT_TRUE(charge.artificial_stress);
    EXPECT_DOUBLE_EQ(charge.artificial_stress_n, 4);
    EXPECT_DOUBLE_EQ(charge.zero_energy, 0);
    EXPECT_TRUE(charge.shape->contains({2, 0, 25}));
    EXPECT_FALSE(charge.shape->contains({0.5, 0.5, 25}));

    ASSERT_EQ(c.detonations.size(), 1u);
    EXPECT_EQ(c.detonations[0].kind, DetonationKind::line);
    EXPECT_DOUBLE_EQ(c.detonations[0].to.z, 50);
    EXPECT_DOUBLE_EQ(c.detonations[0].time, 1.5);
    ASSERT_EQ(c.boundaries.size(), 2u);
    EXPECT_EQ(c.boundaries[0].kind, BoundaryKind::fix);
    EXPECT_TRUE(c.boundaries[0].fix_z && !c.boundaries[0].fix_x && !c.boundaries[0].fix_y);
    EXPECT_DOUBLE_EQ(c.boundaries[0].normal.z, -1);  // of length one
    EXPECT_EQ(c.boundaries[1].part, "*");
    EXPECT_EQ(c.boundaries[1].values, (std::vector<double>{0, 0.5}));
    ASSERT_TRUE(c.boundaries[1].on);
    EXPECT_FALSE(c.contact.all);
    EXPECT_EQ(c.contact.pairs, (std::vector<std::pair<std::string, std::string>>{{"rock", "charge"}}));
    ASSERT_EQ(c.gauges.size(), 1u);
    EXPECT_DOUBLE_EQ(c.gauges[0].at.x, 10);
    EXPECT_EQ(c.analysis.zone_radii, (std::vector<double>{0, 10, 20}));
    EXPECT_EQ(c.analysis.sectors, 72);
    EXPECT_EQ(c.analysis.sections[1].name, "top");
    EXPECT_DOUBLE_EQ(c.analysis.shear_strength, 0.265);
    EXPECT_EQ(c.output.snapshot_times, (std::vector<double>{0, 2.5, 5, 7.5, 10}));
    EXPECT_DOUBLE_EQ(c.output.history_interval, 0.01);
    EXPECT_DOUBLE_EQ(c.step.growth, 1.1);
    EXPECT_FALSE(c.slice);
}

TEST_F(CaseFile, AVariantChangesWhatItNamesAndKeepsTheRest) {
    const MaterialData rock = read_case(good_file, "", {}).parts[0].material;
    EXPECT_EQ(rock.name, "soft_rock");
    const ParameterValue& T = rock.strength->parameters.at("T");
    EXPECT_DOUBLE_EQ(T.value, 0.051);
    EXPECT_EQ(T.source, "case file");
    EXPECT_EQ(T.confidence, "user");
    EXPECT_TRUE(T.where.ends_with("case.toml:35:13")) << T.where;
    EXPECT_DOUBLE_EQ(rock.strength->parameters.at("A").value, 1.248);
    EXPECT_DOUBLE_EQ(rock.density.value, 2.66);

    const MaterialData other = read_case(good_file, "", {"material.soft_rock.strength={law=\"elastic\", G=\"20 GPa\"}", "material.soft_rock.density=2.5 g/cm3"}).parts[0].material;
    EXPECT_EQ(other.strength->law, "elastic");
    EXPECT_EQ(other.strength->parameters.size(), 1u);  // another law drops the parameters of the first
    EXPECT_DOUBLE_EQ(other.density.value, 2.5);
}

TEST_F(CaseFile, PresetsAndSettingsOverrideInOrder) {
    const Case thin = read_case(good_file, "thin", {});
    EXPECT_DOUBLE_EQ(part(thin, "rock").spacing, 0.6);
    ASSERT_TRUE(thin.slice);
    EXPECT_EQ(thin.slice->layers, 8);
    EXPECT_EQ(thin.slice->reference, "rock");
    EXPECT_DOUBLE_EQ(thin.until, 10);

    const Case thinner = read_case(good_file, "thinner", {"run.until=7 us", "rock.spacing_z = 0.7 mm", "boundary.1.values=[\"0 GPa\", \"1 GPa\"]", "charge.artificial_stress=false"});
    EXPECT_EQ(thinner.preset, "thinner");
    EXPECT_DOUBLE_EQ(thinner.until, 7);
    EXPECT_DOUBLE_EQ(part(thinner, "rock").spacing, 0.6);
    EXPECT_DOUBLE_EQ(part(thinner, "rock").spacing_z, 0.7);
    EXPECT_DOUBLE_EQ(thinner.boundaries[1].values[1], 1);
    EXPECT_FALSE(part(thinner, "charge").artificial_stress);
    EXPECT_DOUBLE_EQ(part(thinner, "rock").shape->bounds().max.x, 15);  // the other shape replaced the cylinder

    const Case pairwise = read_case(good_file, "", {"rock.viscosity.pairwise.alpha=0.25"});
    EXPECT_TRUE(part(pairwise, "rock").viscosity.pairwise);
    EXPECT_DOUBLE_EQ(part(pairwise, "rock").viscosity.alpha, 0.25);
    EXPECT_DOUBLE_EQ(part(pairwise, "rock").viscosity.linear, 0.06);  // the two kinds may act together
}

TEST_F(CaseFile, IncludesComeFirstAndTheIncludingFileWins) {
    write("base/common.toml", content(good_file));
    write("base/middle.toml", "include = [\"common.toml\"]\n[part.rock]\nspacing = \"0.7 mm\"\nsmoothing = 1.5\n");
    const std::string top = write("top.toml", "include = [\"base/middle.toml\"]\n[part.rock]\nspacing = \"0.8 mm\"\n");
    const Case c = read_case(top, "", {});
    EXPECT_DOUBLE_EQ(part(c, "rock").spacing, 0.8);
    EXPECT_DOUBLE_EQ(part(c, "rock").smoothing, 1.5);
    EXPECT_EQ(c.title, "Unit test");
    expect_says(c.resolved, "base/middle.toml:4:1", "the origin of a value from an include");

    const std::string circle = write("circle.toml", "include = [\"back.toml\"]\n");
    write("back.toml", "include = [\"circle.toml\"]\n");
    expect_says(message_of(circle, "", {}), "include each other in a circle", "circle");
    expect_says(message_of(circle, "", {}), "back.toml:1:12", "circle");
    const std::string missing = write("missing.toml", "\ninclude = [\"nothing.toml\"]\n");
    const std::string message = message_of(missing, "", {});
    EXPECT_EQ(message.find(missing + ":2:12: "), 0u) << message;
    expect_says(message, "nothing.toml: no such file", "missing include");
}

TEST_F(CaseFile, APartMayStayOutWithItsBoundaries) {
    const Case c = read_case(good_file, "", {"parts=[\"rock\"]", "detonation=[]", "contact.pairs=all", "boundary.0.part=charge"});
    EXPECT_EQ(c.parts.size(), 1u);
    EXPECT_EQ(c.boundaries.size(), 1u);
    EXPECT_EQ(c.resolved.find("part.charge"), std::string::npos);
}

TEST_F(CaseFile, TheResolvedCaseReadsBackAsTheSameCase) {
    for (const std::string preset : {"", "thin", "thinner"}) {
        const Case first = read_case(good_file, preset, {"rock.angle=0.1 rad", "title=\"with \\\"quotes\\\"\\nand a break\""});
        const Case second = read_case(write("again.toml", first.resolved), "", {});
        EXPECT_EQ(second.title, first.title);
        EXPECT_EQ(second.until, first.until);
        EXPECT_EQ(second.output.snapshot_times, first.output.snapshot_times);
        EXPECT_EQ(second.slice.has_value(), first.slice.has_value());
        EXPECT_EQ(second.boundaries.size(), first.boundaries.size());
        ASSERT_EQ(second.parts.size(), first.parts.size());
        for (std::size_t i = 0; i < first.parts.size(); ++i) {
            const PartData &a = first.parts[i], &b = second.parts[i];
            EXPECT_EQ(a.name, b.name);
            EXPECT_EQ(a.spacing_z, b.spacing_z);
            EXPECT_EQ(a.angle, b.angle);
            EXPECT_EQ(a.zero_energy, b.zero_energy);
            EXPECT_EQ(a.artificial_stress, b.artificial_stress);
            EXPECT_EQ(a.material.eos.parameters.size(), b.material.eos.parameters.size());
            for (const Point p : {Point{2, 0, 25}, Point{0.5, 0.5, 0.5}, Point{14, 0, 25}, Point{40, 0, 0}}) EXPECT_EQ(a.shape->distance(p), b.shape->distance(p));
        }
        // Third time round even the text repeats, but for the origins.
        const auto values = [](const std::string& text) {
            std::istringstream lines(text);
            std::string all;
            for (std::string line; std::getline(lines, line);)
                if (!line.starts_with('#')) all += line.substr(0, line.find("  #")) + "\n";
            return all;
        };
        const Case third = read_case(write("once_more.toml", second.resolved), "", {});
        EXPECT_EQ(values(second.resolved), values(third.resolved));
    }
}

TEST_F(CaseFile, TheResolvedCaseNeedsNoLibrary) {
    const Case first = read_case(good_file, "", {});
    const std::string file = write("run/case.toml", first.resolved);
    setenv("BRISANCE_MATERIALS", folder_.c_str(), 1);  // where there are none
    const Case second = read_case(file, "", {});
    ASSERT_EQ(second.parts.size(), first.parts.size());
    const auto expect_same = [](const LawData& a, const LawData& b) {
        EXPECT_EQ(a.law, b.law);
        ASSERT_EQ(a.parameters.size(), b.parameters.size());
        for (const auto& [name, value] : a.parameters) {
            EXPECT_EQ(value.value, b.parameters.at(name).value) << name;  // to the bit
            EXPECT_EQ(value.dimension, b.parameters.at(name).dimension) << name;
            EXPECT_EQ(value.source, b.parameters.at(name).source) << name;
            EXPECT_EQ(value.confidence, b.parameters.at(name).confidence) << name;
        }
    };
    for (std::size_t i = 0; i < first.parts.size(); ++i) {
        const MaterialData &a = first.parts[i].material, &b = second.parts[i].material;
        EXPECT_EQ(a.name, b.name);
        EXPECT_EQ(a.title, b.title);
        EXPECT_EQ(a.source, b.source);
        EXPECT_EQ(a.notes, b.notes);
        EXPECT_EQ(a.density.value, b.density.value);
        expect_same(a.eos, b.eos);
        ASSERT_EQ(a.strength.has_value(), b.strength.has_value());
        if (a.strength) expect_same(*a.strength, *b.strength);
        ASSERT_EQ(a.burn.has_value(), b.burn.has_value());
        if (a.burn) expect_same(*a.burn, *b.burn);
    }
}

TEST_F(CaseFile, TheResolvedCaseNamesOrigins) {
    const std::string resolved = read_case(good_file, "thin", {"rock.smoothing=1.4"}).resolved;
    for (const std::string& fragment :
         {good_file + ":7:1", good_file + ":81:11 (preset thin)", std::string("# --set rock.smoothing=1.4"), std::string("# default"), std::string("# default: until / 1000"),
          std::string("T = {value = \"51 MPa\", source = \"case file\", confidence = \"user\"}  # "), std::string("K1 = {value = \"25.7 GPa\", source = \"invented")})
        expect_says(resolved, fragment, "resolved");
}

TEST_F(CaseFile, WrongCasesSayWhereWhatAndWhatIsAllowed) {
    // In each row the first `from` of the good case is replaced by `to`; '@' marks the line and column that the message has to begin
    // with. All fragments have to be in the message.
    struct Row {
        std::string from, to;
        std::vector<std::string> fragments;
    };
    const std::string rock_shape = "{cylinder = {from = [\"0 mm\", \"0 mm\", \"0 mm\"], to = [\"0 mm\", \"0 mm\", \"50 mm\"], radius = \"2 cm\"}}";
    const std::vector<Row> rows{
        // names
        {"title =", "@titel =", {"unknown key 'titel'", "did you mean 'title'?", "allowed in the case: title, include, parts"}},
        {"until =", "@untill =", {"run.untill = \"10 us\"", "unknown key 'untill'", "did you mean 'until'?", "allowed in [run]: until, seed, precision"}},
        {"spacing = \"0.5 mm\"", "@spacng = \"0.5 mm\"", {"part.rock.spacng = \"0.5 mm\"", "did you mean 'spacing'?"}},
        {"linear = 0.06", "@lineer = 0.06", {"part.rock.viscosity.bulk.lineer", "did you mean 'linear'?", "linear, quadratic"}},
        {"growth = 1.1", "@grwth = 1.1", {"step.grwth", "did you mean 'growth'?"}},
        {"name = \"bottom\"", "@nam = \"bottom\"", {"analysis.sections[0].nam", "did you mean 'name'?", "name, z"}},
        {"cylinder =", "@cylindre =", {"part.rock.shape.cylindre", "did you mean 'cylinder'?", "cylinder, annulus, box, sphere, half_space, union, intersection, difference"}},
        {"strength = {T", "@strenght = {T", {"material.soft_rock.strenght", "did you mean 'strength'?"}},
        {"part.rock.spacing = \"0.6 mm\"", "part.rock.@spacig = \"0.6 mm\"", {"preset.thin.part.rock.spacig", "did you mean 'spacing'?"}},
        {"part.rock.spacing = \"0.6 mm\"", "part.@rok.spacing = \"0.6 mm\"", {"no part 'rok'", "did you mean 'rock'?", "there are: rock, charge"}},
        {"extends = \"thin\"", "@extends = \"thinn\"", {"no preset 'thinn'", "did you mean 'thin'?", "thin, thinner"}},
        // units and types
        {"until = \"10 us\"", "@until = 10", {"run.until = 10", "a bare number for a time", "needs its unit", "\"150 us\""}},
        {"spacing = \"0.5 mm\"", "@spacing = 0.5", {"part.rock.spacing = 0.5", "a bare number for a length", "\"0.15 mm\""}},
        {"spacing = \"0.5 mm\"", "@spacing = \"0.5\"", {"has no unit"}},
        {"spacing = \"0.5 mm\"", "@spacing = \"0.5 GPa\"", {"part.rock.spacing = \"0.5 GPa\"", "is a pressure", "wanted is a length"}},
        {"spacing = \"0.5 mm\"", "@spacing = \"0.5 mn\"", {"unknown unit 'mn'"}},
        {"spacing = \"0.5 mm\"", "@spacing = [\"0.5 mm\"]", {"wrong form", "allowed: length such as"}},
        {"spacing = \"0.5 mm\"", "spacing =@ 0.5 mm", {"not valid TOML", "spacing = 0.5 mm", "in quotes"}},
        {"angle = \"22.5 deg\"", "@angle = 22.5", {"an angle needs its unit", "22.5 deg"}},
        {"angle = \"22.5 deg\"", "@angle = \"22.5 mm\"", {"no angle", "deg or rad"}},
        {"velocity = [\"1 m/s\", ", "@velocity = [", {"wrong form", "a list of three: velocity"}},
        {"velocity = [\"1 m/s\", ", "velocity = [@\"1 mm\", ", {"part.rock.velocity[0] = \"1 mm\"", "is a length; wanted is a velocity"}},
        {"radius = \"2 cm\"", "@radius = true", {"part.rock.shape.cylinder.radius = true", "wrong form"}},
        {"weibull_modulus = 10", "@weibull_modulus = \"10\"", {"has to be a number without unit and quotes"}},
        {"seed = 7", "@seed = 7.5", {"part.rock.heterogeneity.seed = 7.5", "a whole number"}},
        {"seed = 7", "@seed = -7", {"out of range", ">= 0"}},
        {"artificial_stress = true", "@artificial_stress = \"yes\"", {"this has to be a table", "epsilon, n"}},
        {"title = \"Unit test\"", "@title = 1979-05-27", {"dates"}},
        {"growth = 1.1", "@growth = inf", {"infinite numbers"}},
        {"pairs = [[\"rock\", \"charge\"]]", "@pairs = [\"rock\", \"charge\"]", {"wrong form", "\"all\" | [[\"rock\", \"copper\"], ...]"}},
        {"pairs = [[\"rock\", \"charge\"]]", "pairs = [@[\"rock\", \"rock\"]]", {"two different parts"}},
        {"pairs = [[\"rock\", \"charge\"]]", "pairs = [[\"rock\", @\"chrge\"]]", {"no part 'chrge'", "did you mean 'charge'?", "rock, charge"}},
        // choices
        {"\"total_lagrangian\"", "\"total_lagrange\"", {"part.rock.formulation = \"total_lagrange\"", "did you mean 'total_lagrangian'?"}},
        {"mode = \"all_zero\"", "@mode = \"allzero\"", {"part.rock.failure.mode = \"allzero\"", "\"jh2\" | \"no_tension_no_shear\" | \"all_zero\"", "did you mean 'all_zero'?"}},
        {"kind = \"line\"", "@kind = \"lin\"", {"\"point\" | \"line\" | \"instant\"", "did you mean 'line'?"}},
        {"fix = [\"z\"]", "fix = [@\"w\"]", {"boundary[0].fix[0] = \"w\"", "\"x\" | \"y\" | \"z\""}},
        // what is missing
        {"[run]\nuntil = \"10 us\"", "[@run]", {"the key 'until' is missing", "end of the run", "\"150 us\""}},
        {"formulation = \"total_lagrangian\"", "", {"part.rock: the key 'formulation' is missing", "total_lagrangian"}},
        {"spacing = \"0.5 mm\"", "", {"part.rock: the key 'spacing' is missing"}},
        {"grading_growth = 0.03", "", {"the key 'grading_growth' is missing", "spacing_far above spacing"}},
        {", correlation_length = \"1.5 mm\"", "", {"part.rock.heterogeneity: the key 'correlation_length' is missing"}},
        {"kind = \"line\"", "kind = \"point\"", {"detonation[0]: the key 'at' is missing", "kind = \"point\""}},
        {"fix = [\"z\"]", "", {"boundary[0]: the key 'fix' is missing", "kind = \"fix\""}},
        {"values = [\"0 GPa\", \"500 MPa\"]", "", {"boundary[1]: the key 'values' is missing"}},
        {"tensile_strength = \"100 MPa\"\nshear", "shear", {"analysis: the key 'tensile_strength' is missing", "labels a failure"}},
        // what has no effect
        {"kind = \"line\"", "kind = \"instant\"", {"the key 'from' has no effect here"}},
        {"artificial_stress = true", "@zero_energy = 0.1", {"part.charge.zero_energy = 0.1", "has no effect here"}},
        {"fix = [\"z\"]", "fix = [\"z\"]\n@times = [\"0 us\"]", {"boundary[0].times", "has no effect here"}},
        // parts and materials
        {"parts = [\"rock\", \"charge\"]", "@parts = []", {"no parts", "there are: rock, charge"}},
        {"parts = [\"rock\", \"charge\"]", "parts = [\"rock\", \"charge\", @\"rock\"]", {"the part 'rock' is listed twice"}},
        {"parts = [\"rock\", \"charge\"]", "parts = [\"rock\", @\"chrage\"]", {"no part 'chrage'", "did you mean 'charge'?", "there are: rock, charge"}},
        {"[material.soft_rock]", "[part.@rockk]\nspacing = \"1 mm\"\n[material.soft_rock]", {"the part 'rockk' is not listed", "did you mean 'rock'?"}},
        {"[material.soft_rock]", "[part.@step]\nmaterial = \"x\"\nshape = {}\n[material.soft_rock]", {"'step' is a key of the case and can not name a part"}},
        {"material = \"soft_rock\"", "@material = \"sof_rock\"", {"no material 'sof_rock'", "did you mean 'soft_rock'?", "test_explosive, test_rock, soft_rock"}},
        {"base = \"test_rock\"", "@base = \"test_rok\"", {"no material 'test_rok'", "did you mean 'test_rock'?"}},
        {"T = \"51 MPa\"", "@T = \"51 mm\"", {"material.soft_rock.strength.T = \"51 mm\"", "the base gives 57 MPa, a pressure; this is a length"}},
        {"T = \"51 MPa\"", "T = {value = \"51 MPa\", @confidence = \"sure\"}", {"not a confidence", "b-M"}},
        {"base = \"test_rock\"\n", "", {"material.soft_rock: the key 'density' is missing"}},
        {"part = \"charge\"\nkind = \"line\"", "@part = \"rock\"\nkind = \"line\"", {"no burn law", "parts that can: charge"}},
        {"part = \"rock\"\nat = [\"10 mm\"", "@part = \"charge\"\nat = [\"10 mm\"", {"gauges move with a solid", "updated_lagrangian"}},
        {"part = \"rock\"\nat = [\"10 mm\"", "@part = \"rick\"\nat = [\"10 mm\"", {"gauge[0].part = \"rick\"", "did you mean 'rock'?"}},
        // geometry and numbers that can not be
        {"spacing = \"0.5 mm\"", "@spacing = \"0 mm\"", {"out of range", "> 0"}},
        {"spacing = \"0.5 mm\"", "@spacing = \"-0.5 mm\"", {"out of range", "> 0"}},
        {"spacing_far = \"1 mm\"", "@spacing_far = \"0.4 mm\"", {"at least as large as spacing = \"0.5 mm\""}},
        {"radius = \"2 cm\"", "@radius = \"0 mm\"", {"part.rock.shape.cylinder.radius = \"0 mm\"", "> 0"}},
        {"inner_radius = \"1 mm\"", "@inner_radius = \"3 mm\"", {"the inner radius has to be smaller than the outer one, \"3 mm\""}},
        {"to = [\"0 mm\", \"0 mm\", \"50 mm\"], radius", "@to = [\"0 mm\", \"0 mm\", \"0 cm\"], radius", {"the two ends are the same point"}},
        {"max = [\"1 mm\", \"1 mm\", \"1 mm\"]", "@max = [\"1 mm\", \"0 mm\", \"1 mm\"]", {"shape.difference[1].box.max", "larger than that of min"}},
        {rock_shape, "{@union = []}", {"an empty list of shapes"}},
        {rock_shape, "{@difference = [{sphere = {centre = [\"0 mm\", \"0 mm\", \"0 mm\"], radius = \"1 mm\"}}]}", {"at least two shapes"}},
        {rock_shape, "{}", {"exactly one of the keys", "not 0"}},
        {"normal = [0.0, 0.0, -2.0]", "@normal = [0, 0, 0]", {"length zero"}},
        {"to = [\"0 mm\", \"0 mm\", \"50 mm\"]\ntime", "@to = [\"0 mm\", \"0 mm\", \"0 mm\"]\ntime", {"detonation[0].to", "the same point"}},
        {"time = \"1.5 us\"", "@time = \"-1.5 us\"", {"detonation[0].time = \"-1.5 us\"", "out of range", ">= 0"}},
        {"times = [\"0 us\", \"1 us\"]", "@times = [\"1 us\", \"0 us\"]", {"the values have to ascend", "\"0 us\" follows \"1 us\""}},
        {"times = [\"0 us\", \"1 us\"]", "times = [@\"-1 us\", \"1 us\"]", {"out of range"}},
        {"values = [\"0 GPa\", \"500 MPa\"]", "@values = [\"0 GPa\"]", {"as many values as times", "1 values and 2 times"}},
        {"at = [\"10 mm\", \"0 mm\", \"25 mm\"]", "@at = [\"30 mm\", \"0 mm\", \"25 mm\"]", {"gauge[0].at", "outside the part 'rock', by 10 mm"}},
        {"zones = [\"0 mm\", \"10 mm\", \"20 mm\"]", "@zones = [\"0 mm\", \"20 mm\", \"10 mm\"]", {"have to ascend", "\"10 mm\" follows \"20 mm\""}},
        {"zones = [\"0 mm\", \"10 mm\", \"20 mm\"]", "@zones = [\"0 mm\"]", {"at least two radii"}},
        {"z = \"40 mm\"", "@z = \"60 mm\"", {"analysis.sections[1].z = \"60 mm\"", "outside the part 'rock', which reaches from z = 0 mm to 50 mm"}},
        {"name = \"top\"", "@name = \"bottom\"", {"two sections have the same name"}},
        {"snapshots = \"2.5 us\"", "@snapshots = \"0 us\"", {"the interval has to be > 0"}},
        {"snapshots = \"2.5 us\"", "@snapshots = \"1e-9 us\"", {"more than a million"}},
        {"snapshots = \"2.5 us\"", "@snapshots = [\"2 us\", \"1 us\"]", {"have to ascend"}},
        {"growth = 1.1", "@growth = 0.9", {"step.growth = 0.9", ">= 1"}},
        {"growth = 1.1", "@courant_solid = 1.5", {"> 0 and <= 1"}},
        // the file itself
        {"[step]", "[run]", {"not valid TOML", "redefine"}},
        {"title = \"Unit test\"", "include = [@3]", {"include has to be a list of file names in quotes"}},
    };
    ASSERT_GE(rows.size(), 40u);
    const std::string good = content(good_file);
    for (const Row& row : rows) {
        std::string text = good;
        const std::size_t at = text.find(row.from);
        ASSERT_NE(at, std::string::npos) << row.from;
        text.replace(at, row.from.size(), row.to);
        std::string place = (folder_ / "wrong.toml").string() + ":";
        const std::size_t mark = text.find('@');
        if (mark != std::string::npos) {
            const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<long>(mark), '\n');
            place += std::to_string(line) + ":";
            // A parser's own errors name the character at which it stumbled.
            if (row.fragments[0] != "not valid TOML") place += std::to_string(mark - text.rfind('\n', mark)) + ": ";
        }
        std::erase(text, '@');
        const std::string message = message_of(write("wrong.toml", text), "", {});
        EXPECT_EQ(message.find(place), 0u) << row.to << "\n  wanted: " << place << "\n  said:   " << message;
        for (const std::string& fragment : row.fragments) expect_says(message, fragment, row.to);
    }
}

TEST_F(CaseFile, WrongSettingsAndPresetsSayWhereTheyCameFrom) {
    struct Row {
        std::string setting;
        std::vector<std::string> fragments;
    };
    const std::vector<Row> rows{
        {"rock.spacing=0.5", {"part.rock.spacing = 0.5", "a bare number for a length"}},
        {"rock.spacing=-1 mm", {"part.rock.spacing = \"-1 mm\"", "> 0"}},
        {"rock.spacng=1 mm", {"unknown key 'spacng'", "did you mean 'spacing'?"}},
        {"rok.spacing=1 mm", {"unknown key or part 'rok'", "did you mean 'rock'?"}},
        {"run.until", {"key.path=value"}},
        {"run..until=1 us", {"a name in the path is empty"}},
        {"=1", {"a name in the path is empty"}},
        {"run.until=", {"the value is missing"}},
        {"rock.velocity=[1", {"not a valid TOML value"}},
        {"boundary.2.part=rock", {"'2' is no element of the list boundary", "0 to 1"}},
        {"boundary.x.part=rock", {"'x' is no element of the list boundary"}},
        {"preset.thin.run.until=1 us", {"can not be set"}},
        {"include=[\"x.toml\"]", {"can not be set"}},
        {"parts=[\"rock\", \"chrge\"]", {"no part 'chrge'", "did you mean 'charge'?"}},
        {"step.growth=1.1\nseed = 3", {"step.growth"}},
        {"run.until.value=1 us", {"run.until", "wrong form"}},
    };
    for (const Row& row : rows) {
        const std::string message = message_of(good_file, "", {row.setting});
        EXPECT_EQ(message.find("--set " + row.setting.substr(0, row.setting.find('\n'))), 0u) << message;
        EXPECT_EQ(message.find(".toml:"), std::string::npos) << message;
        for (const std::string& fragment : row.fragments) expect_says(message, fragment, row.setting);
    }
    const std::string preset = message_of(good_file, "thinn", {});
    EXPECT_EQ(preset.find("--preset thinn: no preset 'thinn'; did you mean 'thin'?; there are: thin, thinner"), 0u) << preset;
    const std::string circle = message_of(write("circle.toml", content(good_file) + "\n[preset.a]\nextends = \"b\"\n[preset.b]\nextends = \"a\"\n"), "a", {});
    expect_says(circle, "presets extend each other in a circle: a -> b -> a", "presets");
    expect_says(message_of(write("x.toml", content(good_file) + "[preset.bad]\nrun.until = \"0 us\"\n"), "bad", {}), "preset.bad.run.until", "preset");
    expect_says(message_of(write("y.toml", content(good_file) + "[material.a]\nbase = \"b\"\n[material.b]\nbase = \"a\"\n"), "", {}), "based on each other in a circle", "materials");
    expect_says(message_of((folder_ / "none.toml").string(), "", {}), "none.toml: no such file", "no file");
    expect_says(message_of(folder_.string(), "", {}), "is a folder", "a folder");
}

TEST_F(CaseFile, TheReferenceNamesEveryKey) {
    const std::string page = case_file_reference();
    for (const config::Group& group : case_schema().groups) {
        expect_says(page, group.heading, "heading");
        if (group.name == "preset") continue;
        for (const config::Key& key : group.keys) {
            expect_says(page, "| `" + key.name + "` |", group.name);
            EXPECT_FALSE(key.meaning.empty()) << group.name << "." << key.name;
        }
    }
    expect_says(page, "| `until` | time such as \"150 us\", > 0 | **must be given** | end of the run |", "a row");
    expect_says(page, "\"point\" \\| \"line\" \\| \"instant\"", "choices in a Markdown table");
}

TEST_F(CaseFile, TheBlastCasesReadWithAllTheirPresets) {
    unsetenv("BRISANCE_MATERIALS");
    const fs::path blast = fs::path(BRISANCE_SOURCE_DIR) / "cases/blast";
    for (const char* name : {"air_copper", "water_copper", "air", "water", "mesh_family"}) {
        const std::string file = (blast / (std::string(name) + ".toml")).string();
        std::vector<std::string> presets{"", "quick", "slice", "slice-fine", "full-coarse", "full", "literal"};
        if (name == std::string("mesh_family")) presets = {"", "d0.60", "d0.40", "d0.25", "d0.20", "d0.15", "d0.10"};
        for (const std::string& preset : presets) {
            Case c;
            ASSERT_NO_THROW(c = read_case(file, preset, {})) << name << " " << preset;
            const bool copper = std::any_of(c.parts.begin(), c.parts.end(), [](const PartData& p) { return p.name == "copper"; });
            EXPECT_EQ(copper, name != std::string("air") && name != std::string("water"));
            EXPECT_EQ(c.boundaries.size(), copper ? 6u : 5u);
            EXPECT_EQ(c.detonations.at(0).kind, c.slice ? DetonationKind::instant : DetonationKind::point);
            // The borehole is full: from its wall inwards every radius belongs to some part besides the rock.
            for (double r = 0.01; r < 3.225; r += 0.05) {
                const bool filled = std::any_of(c.parts.begin() + 1, c.parts.end(), [&](const PartData& p) { return p.shape->distance({r, 0, 75}) <= 0; });
                EXPECT_TRUE(filled) << name << " r = " << r;
            }
            if (c.slice) {
                // A slab holds whole layers of every part.
                const double thickness = c.slice->layers * part(c, c.slice->reference).spacing_z;
                for (const PartData& p : c.parts) {
                    const double layers = thickness / p.spacing_z;
                    EXPECT_NEAR(layers, std::round(layers), 1e-9) << name << " " << preset << " " << p.name;
                }
            }
        }
    }
}
