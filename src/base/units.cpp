// SPDX-License-Identifier: Apache-2.0
// Every unit known here but "deg" is a power of ten of the internal ones, so factors are kept as exponents: "0.15 mm" is the
// double 0.15 and "2660 kg/m3" the double 2.66, with no rounding beyond that of one division.
#include "base/units.h"

#include "base/text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace brisance {
namespace {

struct Unit {
    const char* symbol;
    Dimension dimension;
    int exponent;        ///< of ten, to internal units
    bool takes_prefix;
    double factor = 1;   ///< beyond the power of ten
};

// Internal: mg, mm, us, K. 1 g = 10^3 mg, 1 m = 10^3 mm, 1 s = 10^6 us; Pa = kg/(m s2) = 10^6 / (10^3 10^12) = 10^-9.
const std::array<Unit, 14> units{{
    {"m", dimension::length, 3, true},
    {"g", dimension::mass, 3, true},
    {"s", dimension::time, 6, true},
    {"K", dimension::temperature, 0, true},
    {"Pa", dimension::pressure, -9, true},
    {"bar", dimension::pressure, -4, true},
    {"J", dimension::energy, 0, true},
    {"N", {1, 1, -2, 0}, -3, true},
    {"W", {1, 2, -3, 0}, -6, true},
    {"Hz", dimension::rate, -6, true},
    {"t", dimension::mass, 9, false},
    {"%", dimension::none, -2, false},
    {"rad", dimension::none, 0, false},
    {"deg", dimension::none, 0, false, std::numbers::pi / 180},
}};

const std::array<std::pair<char, int>, 9> prefixes{{
    {'T', 12}, {'G', 9}, {'M', 6}, {'k', 3}, {'c', -2}, {'m', -3}, {'u', -6}, {'n', -9}, {'p', -12}}};

const std::vector<std::string> common_symbols{
    "m", "cm", "mm", "um", "km", "g", "kg", "mg", "t", "s", "ms", "us", "ns", "K", "Pa", "kPa", "MPa", "GPa", "bar", "kbar",
    "Mbar", "J", "kJ", "MJ", "mJ", "N", "kN", "W", "kW", "Hz", "kHz", "MHz", "deg", "rad", "%"};

struct Name {
    Dimension dimension;
    const char *name, *example, *unit;
};

const std::array<Name, 17> names{{
    {dimension::none, "dimensionless number", "0.5", "-"},
    {dimension::length, "length", "0.15 mm", "mm"},
    {dimension::area, "area", "12 mm2", "mm2"},
    {dimension::volume, "volume", "12 mm3", "mm3"},
    {dimension::time, "time", "150 us", "us"},
    {dimension::rate, "rate", "1 /s", "1/us"},
    {dimension::velocity, "velocity", "6690 m/s", "km/s"},
    {dimension::mass, "mass", "2.8 g", "mg"},
    {dimension::density, "density", "2660 kg/m3", "g/cm3"},
    {dimension::pressure, "pressure", "16 GPa", "GPa"},
    {dimension::energy, "energy", "5 J", "J"},
    {dimension::specific_energy, "specific energy", "5.59 MJ/kg", "MJ/kg"},
    {dimension::specific_heat, "specific heat", "383 J/(kg*K)", "MJ/(kg*K)"},
    {dimension::energy_per_area, "energy per area", "100 J/m2", "J/mm2"},
    {dimension::temperature, "temperature", "294 K", "K"},
    {{1, 1, -2, 0}, "force", "5 N", "kN"},
    {{1, 2, -3, 0}, "power", "5 W", "MW"},
}};

const Name* find_name(Dimension d) {
    for (const Name& name : names)
        if (name.dimension == d) return &name;
    return nullptr;
}

[[noreturn]] void fail(const std::string& problem) { throw std::invalid_argument(problem); }

/// Greek mu, superscripts and the dot in plain letters.
std::string plain(std::string_view text) {
    static const std::array<std::pair<std::string_view, std::string_view>, 8> replacements{{
        {"\u00b5", "u"}, {"\u03bc", "u"}, {"\u00b2", "2"}, {"\u00b3", "3"}, {"\u00b7", "*"}, {"\u00b9", "1"},
        {"\u207b", "-"}, {"\u00b0", "deg"}}};
    std::string result;
    for (std::size_t i = 0; i < text.size();) {
        bool replaced = false;
        for (const auto& [from, to] : replacements)
            if (text.substr(i).starts_with(from)) {
                result += to;
                i += from.size();
                replaced = true;
                break;
            }
        if (!replaced) result += text[i++];
    }
    return result;
}

struct Scale {
    Dimension dimension;
    int exponent = 0;
    double factor = 1;

    void multiply(const Unit& unit, int prefix, int power) {
        dimension.mass += power * unit.dimension.mass;
        dimension.length += power * unit.dimension.length;
        dimension.time += power * unit.dimension.time;
        dimension.temperature += power * unit.dimension.temperature;
        exponent += power * (unit.exponent + prefix);
        factor *= std::pow(unit.factor, power);
    }
};

/// Recursive descent over  unit := [factor] (('*' | '/') factor)*,  factor := symbol ['^'] [integer] | '1' | '(' unit ')'.
class UnitParser {
public:
    explicit UnitParser(std::string_view text) : text_(text) {}

    Scale parse() {
        product(1);
        if (at_ < text_.size()) fail("in the unit '" + std::string(text_) + "' '" + std::string(text_.substr(at_)) + "' is not understood; write products with * and /, such as J/(kg*K)");
        return scale_;
    }

private:
    char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
    static bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '%' || (c & 0x80) != 0; }
    static bool is_digit(char c) { return c >= '0' && c <= '9'; }

    void product(int sign) {
        int next = sign;
        if (peek() != '/') factor(next);
        while (peek() == '*' || peek() == '/') {
            next = text_[at_++] == '*' ? sign : -sign;
            factor(next);
        }
    }

    void factor(int sign) {
        if (peek() == '(') {
            ++at_;
            if (++depth_ > 8) fail("the unit '" + std::string(text_) + "' has too many brackets");
            product(sign);
            if (peek() != ')') fail("the unit '" + std::string(text_) + "' has an open bracket");
            ++at_;
            --depth_;
            return;
        }
        if (peek() == '1') {
            ++at_;
            return;
        }
        const std::size_t begin = at_;
        while (is_letter(peek())) ++at_;
        const std::string_view symbol = text_.substr(begin, at_ - begin);
        if (symbol.empty()) fail("the unit '" + std::string(text_) + "' lacks a symbol; write it like kg/m3 or J/(kg*K)");
        multiply(symbol, sign * power());
    }

    int power() {
        const bool caret = peek() == '^';
        if (caret) ++at_;
        const bool minus = peek() == '-';
        if (minus) ++at_;
        const bool has_digit = is_digit(peek());
        int value = has_digit ? text_[at_++] - '0' : 1;
        if (((caret || minus) && !has_digit) || is_digit(peek()) || value == 0)
            fail("the unit '" + std::string(text_) + "' has a power that is no whole number from 1 to 9");
        return minus ? -value : value;
    }

    void multiply(std::string_view symbol, int power) {
        for (const Unit& unit : units)
            if (symbol == unit.symbol) return scale_.multiply(unit, 0, power);
        for (const auto& [letter, exponent] : prefixes)
            for (const Unit& unit : units)
                if (unit.takes_prefix && symbol.front() == letter && symbol.substr(1) == unit.symbol)
                    return scale_.multiply(unit, exponent, power);
        fail("unknown unit '" + std::string(symbol) + "'" + did_you_mean(symbol, common_symbols));
    }

    std::string_view text_;
    std::size_t at_ = 0;
    int depth_ = 0;
    Scale scale_;
};

std::string with_article(const std::string& noun) {
    return (std::string_view("aeiou").find(noun.front()) == std::string_view::npos ? "a " : "an ") + noun;
}

double power_of_ten(double value, int exponent) {
    // Powers up to 10^22 are exact doubles: one rounding for one multiplication or division.
    const double power = std::pow(10.0, std::abs(exponent));
    return exponent < 0 ? value / power : value * power;
}

}  // namespace

Quantity read_quantity(std::string_view text) {
    const std::string all = trimmed(plain(text));
    std::string_view rest = all;
    if (rest.starts_with('+') && !rest.starts_with("+-")) rest.remove_prefix(1);
    double number = 0;
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
    if (error == std::errc::result_out_of_range) fail(in_quotes(text) + " is beyond the range of a double");
    if (error != std::errc() || !std::isfinite(number)) fail(in_quotes(text) + " does not begin with a number; write for example \"0.15 mm\"");
    rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
    if (rest.starts_with(',')) fail(in_quotes(text) + " has a comma; the decimal sign is a point");
    const std::string unit = trimmed(rest);
    if (unit.empty()) return {number, dimension::none, ""};
    const Scale scale = UnitParser(unit).parse();
    const double value = power_of_ten(number * scale.factor, scale.exponent);
    if (!std::isfinite(value)) fail(in_quotes(text) + " is beyond the range of a double");
    return {value, scale.dimension, unit};
}

double parse_quantity(std::string_view text, Dimension wanted) {
    const Quantity quantity = read_quantity(text);
    if (quantity.dimension == wanted) return quantity.value;
    const std::string should = "wanted is " + with_article(dimension_name(wanted)) + " such as \"" + dimension_example(wanted) + "\"";
    if (quantity.unit.empty()) fail(in_quotes(text) + " has no unit; " + should);
    fail(in_quotes(text) + " is " + with_article(dimension_name(quantity.dimension)) + "; " + should);
}

std::string dimension_name(Dimension d) {
    const Name* known = find_name(d);
    return known ? known->name : "quantity in " + internal_unit(d);
}

std::string dimension_example(Dimension d) {
    const Name* known = find_name(d);
    return known ? known->example : "1 " + internal_unit(d);
}

std::string internal_unit(Dimension d) {
    if (const Name* known = find_name(d)) return known->unit;
    std::string unit;
    for (const auto& [symbol, power] : {std::pair{"mg", d.mass}, {"mm", d.length}, {"us", d.time}, {"K", d.temperature}}) {
        if (power == 0) continue;
        if (!unit.empty()) unit += '*';
        unit += symbol;
        if (power != 1) unit.append("^").append(std::to_string(power));
    }
    return unit;
}

}  // namespace brisance
