// SPDX-License-Identifier: Apache-2.0
// Quantities with units. Inside brisance everything is mm, us, mg (so GPa, g/cm3, km/s, J) and K: numbers near one.
#pragma once

#include <string>
#include <string_view>

namespace brisance {

/// Exponents of mass, length, time and temperature.
struct Dimension {
    int mass = 0, length = 0, time = 0, temperature = 0;
    friend constexpr bool operator==(const Dimension&, const Dimension&) = default;
};

namespace dimension {
inline constexpr Dimension none{};
inline constexpr Dimension length{0, 1, 0, 0};
inline constexpr Dimension area{0, 2, 0, 0};
inline constexpr Dimension volume{0, 3, 0, 0};
inline constexpr Dimension time{0, 0, 1, 0};
inline constexpr Dimension rate{0, 0, -1, 0};
inline constexpr Dimension velocity{0, 1, -1, 0};
inline constexpr Dimension mass{1, 0, 0, 0};
inline constexpr Dimension density{1, -3, 0, 0};
inline constexpr Dimension pressure{1, -1, -2, 0};         ///< also energy per volume
inline constexpr Dimension energy{1, 2, -2, 0};
inline constexpr Dimension specific_energy{0, 2, -2, 0};
inline constexpr Dimension specific_heat{0, 2, -2, -1};
inline constexpr Dimension energy_per_area{1, 0, -2, 0};
inline constexpr Dimension temperature{0, 0, 0, 1};
}  // namespace dimension

/// A number in internal units, its dimension, and its unit as written ("" for a bare number).
struct Quantity {
    double value = 0;
    Dimension dimension;
    std::string unit;
};

/// Reads any quantity. Units are products and quotients of SI symbols with decimal prefixes: "kg/m^3", "J/(kg*K)", "mm2", "1/s".
/// Throws std::invalid_argument, with a text for the user, on what is no number or no unit (nearest spelling named).
Quantity read_quantity(std::string_view text);

/// Reads "0.15 mm", "16 GPa", "1.2e3 kg/m^3", "5.59 MJ/kg", "45 deg" into internal units.
/// Throws std::invalid_argument, with a text for the user, on a missing unit, an unknown one (nearest spelling named), or another dimension.
double parse_quantity(std::string_view text, Dimension wanted);

/// The name of a dimension for messages: "pressure", "length", ... and an example of how to write it: "16 GPa".
std::string dimension_name(Dimension d);
std::string dimension_example(Dimension d);

/// The internal unit in which columns of this dimension are written: "GPa", "mm", "us", "-" for none.
std::string internal_unit(Dimension d);

}  // namespace brisance
