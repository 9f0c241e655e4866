// SPDX-License-Identifier: Apache-2.0
#include "base/text.h"
#include "base/units.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

using namespace brisance;

namespace {

std::string message_of(std::string_view text, Dimension wanted) {
    try {
        parse_quantity(text, wanted);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "no error";
}

bool says(const std::string& message, const std::string& fragment) { return message.find(fragment) != std::string::npos; }

}  // namespace

TEST(Units, DecimalUnitsReadAsTheNearestDouble) {
    struct Row {
        const char* text;
        Dimension dimension;
        double value;
    };
    const Row rows[] = {
        {"0.15 mm", dimension::length, 0.15},
        {"0.15mm", dimension::length, 0.15},
        {"  72 mm ", dimension::length, 72},
        {"7.2 cm", dimension::length, 72},
        {"0.072 m", dimension::length, 72},
        {"150 um", dimension::length, 0.15},
        {"150 \u00b5m", dimension::length, 0.15},
        {"+1 mm", dimension::length, 1},
        {"-57.98 mm", dimension::length, -57.98},
        {"3 mm2", dimension::area, 3},
        {"3 mm\u00b2", dimension::area, 3},
        {"1 cm^3", dimension::volume, 1000},
        {"150 us", dimension::time, 150},
        {"0.15 ms", dimension::time, 150},
        {"1 /s", dimension::rate, 1e-6},
        {"1 1/s", dimension::rate, 1e-6},
        {"1 s^-1", dimension::rate, 1e-6},
        {"2 MHz", dimension::rate, 2},
        {"6690 m/s", dimension::velocity, 6.69},
        {"6.69 km/s", dimension::velocity, 6.69},
        {"6.69 mm/us", dimension::velocity, 6.69},
        {"2660 kg/m3", dimension::density, 2.66},
        {"2660 kg/m^3", dimension::density, 2.66},
        {"2.66 g/cm3", dimension::density, 2.66},
        {"1.2e3 kg/m\u00b3", dimension::density, 1.2},
        {"16 GPa", dimension::pressure, 16},
        {"16000 MPa", dimension::pressure, 16},
        {"1 bar", dimension::pressure, 1e-4},
        {"160 kbar", dimension::pressure, 16},
        {"7.38 kJ/cm3", dimension::pressure, 7.38},
        {"0.25 MJ/m3", dimension::pressure, 2.5e-4},
        {"1 N/mm2", dimension::pressure, 1e-3},
        {"5 J", dimension::energy, 5},
        {"5 N*m", dimension::energy, 5},
        {"5.59 MJ/kg", dimension::specific_energy, 5.59},
        {"383 J/(kg*K)", dimension::specific_heat, 3.83e-4},
        {"383 J/kg/K", dimension::specific_heat, 3.83e-4},
        {"100 J/m2", dimension::energy_per_area, 1e-4},
        {"294 K", dimension::temperature, 294},
        {"2.82 g", dimension::mass, 2820},
        {"1 t", dimension::mass, 1e9},
        {"0.5", dimension::none, 0.5},
        {"50 %", dimension::none, 0.5},
        {"180 deg", dimension::none, std::numbers::pi},
        {"1.5 rad", dimension::none, 1.5},
        {"386 W/(m*K)", Dimension{1, 1, -3, -1}, 386e-9},
    };
    for (const Row& row : rows) EXPECT_DOUBLE_EQ(parse_quantity(row.text, row.dimension), row.value) << row.text;
    // One rounding at most: these have to be equal bit by bit.
    EXPECT_EQ(parse_quantity("2660 kg/m3", dimension::density), 2.66);
    EXPECT_EQ(parse_quantity("100 MPa", dimension::pressure), 0.1);
}

TEST(Units, MessagesSayWhatIsWrongAndWhatIsWanted) {
    struct Row {
        const char* text;
        Dimension dimension;
        const char* fragment;
    };
    const Row rows[] = {
        {"0.15", dimension::length, "has no unit; wanted is a length such as \"0.15 mm\""},
        {"16 GPa", dimension::length, "is a pressure; wanted is a length"},
        {"5 J", dimension::length, "is an energy"},
        {"16 gpa", dimension::pressure, "unknown unit 'gpa'; did you mean 'GPa'?"},
        {"16 Mpa", dimension::pressure, "did you mean 'MPa'?"},
        {"3 mn", dimension::length, "unknown unit 'mn'"},
        {"1,5 mm", dimension::length, "the decimal sign is a point"},
        {"mm", dimension::length, "does not begin with a number"},
        {"", dimension::length, "does not begin with a number"},
        {"nan mm", dimension::length, "does not begin with a number"},
        {"inf mm", dimension::length, "does not begin with a number"},
        {"1e999 mm", dimension::length, "beyond the range"},
        {"1e300 Tm", dimension::length, "beyond the range"},
        {"2 kg m", dimension::length, "write products with * and /"},
        {"2 mm^", dimension::length, "power"},
        {"2 mm^0", dimension::length, "power"},
        {"2 mm12", dimension::length, "power"},
        {"2 J/(kg", dimension::length, "open bracket"},
        {"2 J/", dimension::length, "lacks a symbol"},
        {"2 ((((((((((m))))))))))", dimension::length, "too many brackets"},
    };
    for (const Row& row : rows) {
        const std::string message = message_of(row.text, row.dimension);
        EXPECT_TRUE(says(message, row.fragment)) << row.text << " -> " << message;
    }
}

TEST(Units, AQuantityKeepsItsDimensionAndUnit) {
    const Quantity quantity = read_quantity("5.59 MJ/kg");
    EXPECT_DOUBLE_EQ(quantity.value, 5.59);
    EXPECT_EQ(quantity.dimension, dimension::specific_energy);
    EXPECT_EQ(quantity.unit, "MJ/kg");
    EXPECT_EQ(read_quantity("3").unit, "");
    EXPECT_EQ(read_quantity("3").dimension, dimension::none);
}

TEST(Units, EveryNamedDimensionReadsItsOwnExampleAndUnit) {
    using namespace dimension;
    for (const Dimension d : {none, length, area, volume, dimension::time, rate, velocity, mass, density, pressure, energy, specific_energy,
                              specific_heat, energy_per_area, temperature, Dimension{1, 1, -2, 0}, Dimension{1, 2, -3, 0}}) {
        EXPECT_EQ(read_quantity(dimension_example(d)).dimension, d) << dimension_name(d);
        if (d == none) continue;
        const Quantity unit = read_quantity("1 " + internal_unit(d));
        EXPECT_EQ(unit.dimension, d) << internal_unit(d);
        EXPECT_EQ(unit.value, 1) << internal_unit(d);
    }
    const Dimension odd{2, -3, 1, -1};
    EXPECT_EQ(read_quantity("1 " + internal_unit(odd)).dimension, odd);
    EXPECT_EQ(read_quantity("1 " + internal_unit(odd)).value, 1);
}

TEST(Text, DistancesOfSpellings) {
    EXPECT_EQ(edit_distance("", "abc"), 3);
    EXPECT_EQ(edit_distance("spacing", "spacing"), 0);
    EXPECT_EQ(edit_distance("spacng", "spacing"), 1);
    EXPECT_EQ(edit_distance("spaicng", "spacing"), 1);  // a swap
    EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
    EXPECT_EQ(nearest("Spacng", {"smoothing", "spacing", "shape"}), "spacing");
    EXPECT_EQ(nearest("entirely", {"smoothing", "spacing"}), "");
    EXPECT_EQ(nearest("x", {}), "");
}

TEST(Text, QuotesAndNumbers) {
    EXPECT_EQ(in_quotes("a\"b\\c\n"), "\"a\\\"b\\\\c\\n\"");
    EXPECT_EQ(in_quotes(std::string("\x01")), "\"\\u0001\"");
    EXPECT_EQ(shortest(0.1), "0.1");
    EXPECT_EQ(std::stod(shortest(1.0 / 3)), 1.0 / 3);
    EXPECT_EQ(joined({}), "(none)");
    EXPECT_EQ(trimmed(" a b\t"), "a b");
}
