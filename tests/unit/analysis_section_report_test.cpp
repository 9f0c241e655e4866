// SPDX-License-Identifier: Apache-2.0
#include "analysis/crack_density.h"
#include "analysis/json.h"
#include "analysis/section_report.h"
#include "analysis/synthetic_section.h"

#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>

using namespace brisance::analysis;

namespace {

/// Just enough of a JSON reader to hold the writer to the standard: every value with its path, as text.
class Reader {
public:
    explicit Reader(const std::string& text) : text_(text) {
        value("");
        blanks();
        if (at_ != text_.size()) fail("text after the end");
    }
    const std::string& operator[](const std::string& path) const { return values_.at(path); }
    double number(const std::string& path) const { return std::stod(values_.at(path)); }
    std::size_t size(const std::string& path) const { return static_cast<std::size_t>(std::stoul(values_.at(path + "#"))); }
    bool has(const std::string& path) const { return values_.count(path) > 0; }

private:
    void fail(const std::string& what) const { throw std::runtime_error(what + " at " + std::to_string(at_)); }
    void blanks() {
        while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
    }
    char peek() {
        blanks();
        if (at_ >= text_.size()) fail("end");
        return text_[at_];
    }
    void expect(char c) {
        if (peek() != c) fail(std::string("no ") + c);
        ++at_;
    }
    std::string quoted() {
        expect('"');
        std::string s;
        while (text_.at(at_) != '"') {
            if (static_cast<unsigned char>(text_[at_]) < 0x20) fail("control character");
            if (text_[at_] == '\\') s += text_[at_++];
            s += text_.at(at_++);
        }
        ++at_;
        return s;
    }
    void value(const std::string& path) {
        const char c = peek();
        if (c == '{' || c == '[') {
            const char end = c == '{' ? '}' : ']';
            ++at_;
            std::size_t n = 0;
            while (peek() != end) {
                if (n > 0) expect(',');
                std::string name = std::to_string(n++);
                if (c == '{') {
                    name = quoted();
                    expect(':');
                }
                value(path + "/" + name);
            }
            ++at_;
            values_[path + "#"] = std::to_string(n);
        } else if (c == '"') {
            values_[path] = quoted();
        } else if (text_.compare(at_, 4, "null") == 0) {
            at_ += 4;
            values_[path] = "null";
        } else {
            char* end = nullptr;
            if (c != '-' && !std::isdigit(static_cast<unsigned char>(c))) fail("no number");
            std::strtod(text_.c_str() + at_, &end);
            values_[path] = text_.substr(at_, static_cast<std::size_t>(end - text_.c_str()) - at_);
            at_ += values_[path].size();
        }
    }

    std::string text_;
    std::size_t at_ = 0;
    std::map<std::string, std::string> values_;
};

SectionPoints blasted() {
    auto points = synthetic::lattice(3.225, 72, 0.8, 0.2, 0.2);
    for (int k = 0; k < 7; ++k) {
        const double a = 0.2 + 2 * std::numbers::pi * k / 7;
        synthetic::draw_line(points, 3 * std::cos(a), 3 * std::sin(a), 50 * std::cos(a), 50 * std::sin(a), 1.6);
    }
    synthetic::damage_where(points, [&](std::size_t i) { return points.radius(i) < 8; }, 1, Cause::shear);
    synthetic::damage_where(points, [&](std::size_t i) { return std::abs(points.radius(i) - 66) < 0.8 && points.y[i] > 0; }, 0.9, Cause::mixed);
    return points;
}

SectionOptions options() {
    SectionOptions o;
    o.zone_edges = {0, 24, 48, 72};
    o.specimen = {3.225, 72};
    return o;
}

}  // namespace

TEST(SectionReport, HoldsTheNumbersOfAKnownPattern) {
    const auto points = blasted();
    const SectionReport r = analyse_section(points, 69, options());
    EXPECT_EQ(r.damaged, r.tensile + r.shear + r.mixed);
    EXPECT_EQ(r.damaged, r.damaged_per_zone[0] + r.damaged_per_zone[1] + r.damaged_per_zone[2]);
    EXPECT_EQ(r.radial.sustained_arms, 7);
    EXPECT_NEAR(r.radial.longest, 50 - 3.225, 1.5);
    EXPECT_NEAR(r.spall.radius, 66, 0.3);
    EXPECT_NEAR(r.spall.coverage, 0.5, 0.05);
    EXPECT_GT(r.harmonics[6], 0.3);
    EXPECT_GT(r.crushed_radius, 8);
    const auto area = zone_areas(std::vector<double>{0, 24, 48, 72});
    EXPECT_NEAR(r.density_lines[1] * area[1], 7 * 24, 7 * 24 * 0.07);                                    // seven arms
    EXPECT_NEAR(r.density_lines[2] * area[2], 7 * 2 + 66 * std::numbers::pi, 0.07 * 66 * std::numbers::pi);  // their ends, and half a ring
}

TEST(SectionReport, AnIntactSectionIsAllZeroAndNull) {
    FractureReport report;
    report.zone_edges = {0, 24, 48, 72};
    report.sections.push_back({"top", 125, 10, {analyse_section(synthetic::lattice(3.225, 72, 2), 0, options())}});
    const Reader json(to_json(report));
    const std::string t = "/sections/0/times/0/";
    EXPECT_EQ(json.number(t + "damaged"), 0);
    EXPECT_EQ(json.number(t + "longest_crack_mm"), 0);
    EXPECT_EQ(json[t + "spall_radius_mm"], "null");
    EXPECT_EQ(json.number(t + "pdf/71"), 0);
    EXPECT_EQ(json["/attenuation/pressure/exponent"], "null");
    EXPECT_EQ(json.size("/attenuation/pressure/r_mm"), 0u);
}

TEST(SectionReport, TheFileFollowsSchemaOne) {
    FractureReport report;
    report.zone_edges = {0, 24, 48, 72};
    const auto points = blasted();
    report.sections.push_back({"bottom", 25, points.count(), {analyse_section(points, 23, options()), analyse_section(points, 144.88, options())}});
    const std::vector<double> r{4, 8, 16, 32}, p{2, 1, 0.5, 0.25};
    report.pressure = {bin_peaks(r, p, std::vector<double>{3, 6, 12, 24, 48}), fit_power_law(r, p, 4, 32)};
    report.borehole = {{0, 1}, {3.225, 3.3}};
    report.burn_front = {{0, 1, 2}, {150, 143.31, std::numeric_limits<double>::infinity()}};
    const Reader json(to_json(report));

    EXPECT_EQ(json["/schema"], "1");
    EXPECT_EQ(json["/threshold"], "0.8");
    EXPECT_EQ(json.number("/zones/edges_mm/3"), 72);
    EXPECT_NEAR(json.number("/zones/areas_mm2/0"), 576 * std::numbers::pi, 1e-9);
    EXPECT_EQ(json["/sections/0/name"], "bottom");
    EXPECT_EQ(json.number("/sections/0/z_mm"), 25);
    EXPECT_EQ(json.number("/sections/0/particles"), static_cast<double>(points.count()));
    EXPECT_EQ(json.size("/sections/0/times"), 2u);
    const std::string t = "/sections/0/times/1/";
    const SectionReport& expected = report.sections[0].times[1];
    EXPECT_EQ(json.number(t + "t_us"), 144.88);
    EXPECT_EQ(json.number(t + "damaged"), expected.damaged);
    EXPECT_EQ(json.number(t + "damaged_by_cause/shear"), expected.shear);
    EXPECT_EQ(json.number(t + "damaged_by_cause/tensile"), expected.tensile);
    EXPECT_EQ(json.number(t + "damaged_by_cause/mixed"), expected.mixed);
    for (const char* per_zone : {"density_printed_mm_per_mm2", "density_skeleton_mm_per_mm2", "damaged_per_zone"}) EXPECT_EQ(json.size(t + per_zone), 3u);
    EXPECT_EQ(json.number(t + "density_skeleton_mm_per_mm2/1"), expected.density_lines[1]);
    EXPECT_EQ(json.size(t + "pdf"), 72u);
    EXPECT_EQ(json.size(t + "pdf_normalised"), 72u);
    EXPECT_EQ(json.number(t + "pdf/10"), expected.pdf[10]);
    EXPECT_EQ(json.size(t + "harmonics"), 12u);
    EXPECT_EQ(json.number(t + "harmonics/1"), expected.harmonics[0]);
    EXPECT_EQ(json.number(t + "harmonics/12"), expected.harmonics[11]);
    for (const char* key : {"radial_coherence", "long_radial_cracks", "longest_crack_mm", "crushed_radius_mm", "spall_radius_mm", "spall_coverage"})
        EXPECT_TRUE(json.has(t + key)) << key;
    EXPECT_EQ(json.size("/sections/0/times/1"), 15u);
    EXPECT_NEAR(json.number("/attenuation/pressure/exponent"), 1, 1e-12);
    EXPECT_EQ(json.size("/attenuation/pressure/p90_GPa"), 4u);
    EXPECT_EQ(json.number("/attenuation/pressure/fit_range_mm/1"), 32);
    EXPECT_EQ(json["/attenuation/radial_stress/fit_range_mm/0"], "null");
    EXPECT_EQ(json.number("/borehole/mean_radius_mm/1"), 3.3);
    EXPECT_EQ(json["/burn_front/z_mm/2"], "null");
}

TEST(Json, NumbersKeepTheirDigitsAndNamesAreEscaped) {
    JsonWriter json;
    json.begin_object().member("a \"b\"\n\\", 0.1 + 0.2).key("n").begin_array();
    json.value(std::nan("")).value(-std::numeric_limits<double>::infinity()).value(-3).value("x").end_array().end_object();
    EXPECT_EQ(json.text(), "{\"a \\\"b\\\"\\u000a\\\\\":0.30000000000000004,\"n\":[null,null,-3,\"x\"]}");
    EXPECT_EQ(Reader(json.text())["/n/2"], "-3");
}
