// SPDX-License-Identifier: Apache-2.0
#include "analysis/section_report.h"

#include "analysis/crack_density.h"
#include "analysis/crack_lines.h"
#include "analysis/failure_cause.h"
#include "analysis/json.h"

#include <algorithm>
#include <string>

namespace brisance::analysis {

namespace {

void count_causes(const SectionPoints& points, double threshold, SectionReport& report) {
    for (std::size_t i = 0; i < points.count(); ++i) {
        if (!points.cracked(i, threshold)) continue;
        ++report.damaged;
        switch (static_cast<Cause>(points.cause[i])) {
            case Cause::tensile: ++report.tensile; break;
            case Cause::shear: ++report.shear; break;
            case Cause::mixed: ++report.mixed; break;
            case Cause::none: break;
        }
    }
}

void write(JsonWriter& json, const SectionReport& r) {
    json.begin_object().member("t_us", r.time).member("damaged", r.damaged);
    json.key("damaged_by_cause").begin_object();
    json.member("tensile", r.tensile).member("shear", r.shear).member("mixed", r.mixed).end_object();
    json.member("density_printed_mm_per_mm2", r.density_printed);
    json.member("density_skeleton_mm_per_mm2", r.density_lines);
    json.member("damaged_per_zone", r.damaged_per_zone);
    json.member("pdf", r.pdf).member("pdf_normalised", r.pdf_normalised);
    json.key("harmonics").begin_object();
    for (std::size_t m = 0; m < r.harmonics.size(); ++m) json.member(std::to_string(m + 1), r.harmonics[m]);
    json.end_object();
    json.member("radial_coherence", r.radial_coherence);
    json.member("long_radial_cracks", r.radial.sustained_arms).member("longest_crack_mm", r.radial.longest);
    json.member("crushed_radius_mm", r.crushed_radius);
    json.member("spall_radius_mm", r.spall.radius).member("spall_coverage", r.spall.coverage);
    json.end_object();
}

void write(JsonWriter& json, const SectionHistory& section) {
    json.begin_object().member("name", section.name).member("z_mm", section.z).member("particles", section.particles);
    json.key("times").begin_array();
    for (const SectionReport& r : section.times) write(json, r);
    json.end_array().end_object();
}

void write(JsonWriter& json, const Attenuation& a) {
    json.begin_object().member("r_mm", a.bins.r);
    json.member("median_GPa", a.bins.median).member("p10_GPa", a.bins.p10).member("p90_GPa", a.bins.p90);
    json.member("exponent", a.law.exponent).member("exponent_error", a.law.exponent_error);
    json.member("fit_range_mm", std::vector<double>{a.law.r_min, a.law.r_max}).end_object();
}

void write(JsonWriter& json, const TimeSeries& series, const char* value) {
    json.begin_object().member("t_us", series.time).member(value, series.value).end_object();
}

}  // namespace

SectionReport analyse_section(const SectionPoints& points, double time, const SectionOptions& options) {
    const double threshold = options.threshold;
    const DamageRaster raster = rasterise(points, {.threshold = threshold});
    const auto lines = crack_lines(points, raster, raster.damaged);
    SectionReport r;
    r.time = time;
    count_causes(points, threshold, r);
    r.density_printed = density_as_printed(points, options.zone_edges, threshold);
    r.density_lines = density_of_lines(lines, options.zone_edges);
    r.damaged_per_zone = damaged_per_zone(points, options.zone_edges, threshold);
    r.pdf = direction_pdf(points, threshold, options.sectors);
    r.pdf_normalised = direction_pdf_normalised(points, threshold, options.sectors);
    r.harmonics = direction_harmonics(points, threshold);
    r.radial_coherence = radial_coherence(points, threshold);
    r.radial = radial_cracks(points, raster, threshold, options.specimen);
    r.crushed_radius = crushed_radius(points, threshold);
    r.isotropy = isotropy_test(points, threshold, options.sectors, std::max(r.crushed_radius, 3 * options.specimen.hole_radius));
    r.spall = find_spall(points, threshold, options.specimen);
    return r;
}

std::string to_json(const FractureReport& report) {
    JsonWriter json;
    json.begin_object().member("schema", 1).member("threshold", report.threshold);
    json.key("zones").begin_object().member("edges_mm", report.zone_edges).member("areas_mm2", zone_areas(report.zone_edges)).end_object();
    json.key("sections").begin_array();
    for (const SectionHistory& section : report.sections) write(json, section);
    json.end_array();
    json.key("attenuation").begin_object();
    json.key("pressure");
    write(json, report.pressure);
    json.key("radial_stress");
    write(json, report.radial_stress);
    json.end_object();
    json.key("borehole");
    write(json, report.borehole, "mean_radius_mm");
    json.key("burn_front");
    write(json, report.burn_front, "z_mm");
    json.end_object();
    return json.text() + "\n";
}

}  // namespace brisance::analysis
