// SPDX-License-Identifier: Apache-2.0
#include "app/recorder.h"

#include "analysis/failure_cause.h"
#include "app/fracture.h"
#include "app/leaks.h"
#include "base/error.h"
#include "math/eigen.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace brisance {

namespace {

template <class R>
std::vector<CsvColumn> audit_columns(const World<R>& w) {
    std::vector<CsvColumn> c{{"step", "-"}, {"t", "us"}, {"dt", "us"}, {"limiter", ""}, {"kinetic", "J"}};
    for (const auto& s : w.solids) c.push_back({"internal." + s.body.name, "J"});
    for (const auto& f : w.fluids) c.push_back({"internal." + f.body.name, "J"});
    for (const char* name : {"burn_released", "viscous", "zero_energy", "zero_energy_dissipated", "contact_stored", "contact_dissipated", "boundary_work",
                             "artificial_stress", "residual"})
        c.push_back({name, "J"});
    c.push_back({"residual_relative", "-"});
    for (const char* name : {"momentum_x", "momentum_y", "momentum_z"}) c.push_back({name, "mg km/s"});
    c.push_back({"momentum_residual", "-"});
    c.push_back({"max_penetration", "mm"});
    c.push_back({"penetrating_pair", ""});
    for (const char* name : {"leaked", "torn", "damaged"}) c.push_back({name, "-"});
    return c;
}

/// The layer of a column nearest to a height.
int nearest_layer(const Columns& layout, const Column& c, double z) {
    return std::clamp(static_cast<int>(std::lround((z - c.z0) / layout.dz)), 0, c.layers - 1);
}

/// Why a particle failed: from the largest stresses before its failure, over the strength of its place.
template <class R>
std::uint8_t cause_of(const SolidBody<R>& b, std::size_t i, const AnalysisData& a) {
    if (b.failure_time[i] < 0) return 0;
    const double scale = b.strength_scale(i);
    return static_cast<std::uint8_t>(analysis::cause_of_failure(b.sigma_1[i] / scale, b.tau_max[i] / scale, a.tensile_strength, a.shear_strength));
}

}  // namespace

template <class R>
Recorder<R>::Recorder(const Case& c, const World<R>& w, const RunDirectory& run, bool go_on)
    : case_(c), run_(run), audit_(run.file("audit.csv"), audit_columns(w), go_on), history_([&] {
          std::vector<CsvColumn> columns{{"t", "us"}};
          for (const SectionData& s : sections_of(c)) columns.push_back({"damaged." + s.name, "-"});
          columns.push_back({"damaged.all", "-"});
          return CsvFile(run.file("history.csv"), columns, go_on);
      }()), snapshots_(run.snapshots()) {
    for (std::size_t i = 0; i < w.solids.size(); ++i)
        if (w.solids[i].body.name == c.analysis.part && c.analysis.zone_radii.size() > 1) {
            analysed_ = i;
            has_analysed_ = true;
        }
    if (has_analysed_) {
        const SolidBody<R>& b = w.solids[analysed_].body;
        double inner = 1e300, outer = 0;
        for (const Column& column : b.layout.columns) {
            const double r = std::hypot(column.x - b.axis_x, column.y - b.axis_y);
            const bool looks_inward = column.wall_normal_x * (column.x - b.axis_x) + column.wall_normal_y * (column.y - b.axis_y) < 0;
            if (column.wall_layer == 0 && looks_inward) inner = std::min(inner, r - column.wall_distance);
            outer = std::max(outer, r + (column.wall_layer == 0 ? column.wall_distance : 0));
        }
        options_ = section_options(c);
        options_.specimen = {inner < outer ? std::max(inner, 0.0) : 0.0, outer};
        if (3 * options_.specimen.hole_radius >= 0.8 * outer)
            throw InputError(fmt::format("analysis.part = \"{}\": radial cracks are counted between 3 hole radii and 0.8 of the outer radius; here the radii are "
                                         "{:g} and {:g} mm. Leave the table [analysis] out for so small a body", c.analysis.part, inner, outer));
        for (const SectionData& s : sections_of(c)) {
            Section section{s, {}, {}};
            for (std::size_t i = 0; i < b.layout.columns.size(); ++i) {
                const Column& column = b.layout.columns[i];
                const int k = nearest_layer(b.layout, column, s.z);
                if (!(b.layout.flags[static_cast<std::size_t>(column.start + k)] & slot_own)) continue;
                section.slots.push_back(column.start + k);
                section.columns.push_back(i);
            }
            sections_.push_back(std::move(section));
            reports_.push_back({s.name, s.z, sections_.back().slots.size(), {}});
        }
    }
    static const std::vector<CsvColumn> gauge_columns = {
        {"t", "us"},       {"x", "mm"},        {"y", "mm"},      {"z", "mm"},      {"pressure", "GPa"}, {"sigma_1", "GPa"}, {"sigma_2", "GPa"}, {"sigma_3", "GPa"},
        {"tau_max", "GPa"}, {"mises", "GPa"}, {"yield", "GPa"}, {"damage", "-"}, {"v_x", "km/s"}, {"v_y", "km/s"}, {"v_z", "km/s"}, {"cause", "-"}};
    for (const GaugeData& g : c.gauges)
        for (std::size_t s = 0; s < w.solids.size(); ++s) {
            const SolidBody<R>& b = w.solids[s].body;
            if (b.name != g.part) continue;
            double best = 1e300;
            Gauge gauge{g.name, s, 0, 0, CsvFile(run.gauges() / (g.name + ".csv"), gauge_columns, go_on)};
            const double z = c.slice ? c.slice->z : g.at.z;
            for (const Column& column : b.layout.columns) {
                const int k = nearest_layer(b.layout, column, z);
                const double dx = column.x - g.at.x, dy = column.y - g.at.y, dz = column.z0 + k * b.layout.dz - z;
                const double d = dx * dx + dy * dy + dz * dz;
                if (d < best && (b.layout.flags[static_cast<std::size_t>(column.start + k)] & slot_own)) {
                    best = d;
                    gauge.slot = column.start + k;
                }
            }
            while (b.layout.tiles[gauge.tile].base + b.layout.width <= gauge.slot) ++gauge.tile;
            gauges_.push_back(std::move(gauge));
        }
}

template <class R>
double Recorder<R>::next_due() const {
    double t = next_history_;
    if (next_snapshot_ < case_.output.snapshot_times.size()) t = std::min(t, case_.output.snapshot_times[next_snapshot_]);
    return t;
}

template <class R>
std::optional<Audit> Recorder<R>::record(const World<R>& w) {
    const double slack = 1e-9;
    std::optional<Audit> row;
    const bool snapshot_due = next_snapshot_ < case_.output.snapshot_times.size() && w.time >= case_.output.snapshot_times[next_snapshot_] - slack;
    if (w.time >= next_history_ - slack || snapshot_due) {
        while (next_history_ <= w.time + slack) next_history_ += case_.output.history_interval;
        const Audit a = audit(w);
        leaks_ = find_leaks(w);
        write_audit(a);
        write_gauges(w);
        std::vector<double> damaged{w.time};
        for (const Section& s : sections_) {
            const SolidBody<R>& b = w.solids[analysed_].body;
            damaged.push_back(static_cast<double>(std::count_if(s.slots.begin(), s.slots.end(), [&](std::int64_t slot) {
                return b.damage(static_cast<std::size_t>(slot)) > options_.threshold;
            })));
        }
        if (!has_analysed_) damaged.resize(1 + sections_of(case_).size(), 0);
        damaged.push_back(static_cast<double>(a.damaged));
        history_.row(damaged);
        if (has_analysed_) {
            const Surface& s = w.solids[analysed_].surface;
            const SolidBody<R>& b = w.solids[analysed_].body;
            double sum = 0, n = 0;
            for (std::size_t i = 0; i < s.sides; ++i) {
                const Column& c = b.layout.columns[static_cast<std::size_t>(s.column[i])];
                if (std::hypot(c.x - b.axis_x, c.y - b.axis_y) > options_.specimen.hole_radius + 1.5 * c.spacing) continue;
                sum += std::hypot(s.x[i] - b.axis_x, s.y[i] - b.axis_y);
                n += 1;
            }
            if (n > 0) {
                borehole_.time.push_back(w.time);
                borehole_.value.push_back(sum / n);
            }
        }
        for (const FluidPart& f : w.fluids) {
            if (!f.body.material.burn) continue;
            double low = std::numeric_limits<double>::infinity();
            bool whole = true;
            for (std::size_t i = 0; i < f.body.mass.size(); ++i)
                if (f.body.burnt[i] > 0.5) low = std::min(low, f.body.reference[2][i]);
                else whole = false;
            if (std::isfinite(low) && !(whole && w.period > 0)) {
                front_.time.push_back(w.time);
                front_.value.push_back(low);
            }
        }
        row = a;
    }
    if (snapshot_due) {
        ++next_snapshot_;
        write_snapshot(w);
        analyse(w);
        if (has_analysed_) run_.write_text("analysis/analysis.json", analysis::to_json(fracture_report(w)));
    }
    return row;
}

template <class R>
void Recorder<R>::analyse(const World<R>& w) {
    taken_.time.push_back(w.time);
    for (std::size_t i = 0; i < sections_.size(); ++i) {
        const analysis::SectionPoints points = sample(w, sections_[i]);
        taken_.damage.insert(taken_.damage.end(), points.damage.begin(), points.damage.end());
        taken_.cause.insert(taken_.cause.end(), points.cause.begin(), points.cause.end());
        reports_[i].times.push_back(analysis::analyse_section(points, w.time, options_));
    }
}

template <class R>
std::vector<CsvFile*> Recorder<R>::files() {
    std::vector<CsvFile*> all{&audit_, &history_};
    for (Gauge& g : gauges_) all.push_back(&g.file);
    return all;
}

template <class R>
std::vector<std::int64_t>& Recorder<R>::file_lengths() {
    lengths_.clear();
    for (const CsvFile* f : files()) {
        f->sync();  // a checkpoint counts on these rows
        lengths_.push_back(f->length());
    }
    return lengths_;
}

template <class R>
void Recorder<R>::go_on(const World<R>& w) {
    const std::vector<CsvFile*> all = files();
    for (std::size_t i = 0; i < all.size(); ++i) all[i]->cut(lengths_.at(i));
    std::size_t at = 0;
    for (const double time : taken_.time)
        for (std::size_t i = 0; i < sections_.size(); ++i) {
            analysis::SectionPoints points = sample(w, sections_[i]);  // places stay, damage is that of the time
            for (std::size_t k = 0; k < points.count(); ++k, ++at) {
                points.damage[k] = taken_.damage.at(at);
                points.cause[k] = taken_.cause.at(at);
            }
            reports_[i].times.push_back(analysis::analyse_section(points, time, options_));
        }
}

template <class R>
void Recorder<R>::finish(const World<R>& w) {
    if (!sections_.empty() && (reports_[0].times.empty() || reports_[0].times.back().time < w.time)) analyse(w);
    for (std::size_t i = 0; i < sections_.size(); ++i) {
        const SolidBody<R>& b = w.solids[analysed_].body;
        CsvFile file(run_.analysis() / ("section_" + sections_[i].data.name + ".csv"),
                     {{"x", "mm"}, {"y", "mm"}, {"size", "mm"}, {"damage", "-"}, {"cause", "-"}, {"failure_time", "us"}});
        const analysis::SectionPoints p = sample(w, sections_[i]);
        for (std::size_t k = 0; k < p.count(); ++k)
            file.row({p.x[k], p.y[k], p.size[k], p.damage[k], static_cast<int>(p.cause[k]),
                      static_cast<double>(b.failure_time[static_cast<std::size_t>(sections_[i].slots[k])])});
        file.close();
    }
    if (has_analysed_) run_.write_text("analysis/analysis.json", analysis::to_json(fracture_report(w)));
}

template <class R>
analysis::SectionPoints Recorder<R>::sample(const World<R>& w, const Section& s) const {
    const SolidBody<R>& b = w.solids[analysed_].body;
    analysis::SectionPoints p;
    for (std::size_t k = 0; k < s.slots.size(); ++k) {
        const Column& c = b.layout.columns[s.columns[k]];
        const auto i = static_cast<std::size_t>(s.slots[k]);
        p.x.push_back(c.x - b.axis_x);
        p.y.push_back(c.y - b.axis_y);
        p.size.push_back(std::sqrt(c.area));
        p.damage.push_back(b.damage(i));
        p.cause.push_back(cause_of(b, i, case_.analysis));
    }
    return p;
}

template <class R>
analysis::FractureReport Recorder<R>::fracture_report(const World<R>& w) const {
    analysis::FractureReport r;
    r.threshold = options_.threshold;
    r.zone_edges = options_.zone_edges;
    r.sections = reports_;
    r.borehole = borehole_;
    r.burn_front = front_;
    if (!has_analysed_) return r;
    const SolidBody<R>& b = w.solids[analysed_].body;
    std::vector<double> radius, pressure, radial;
    for (const Column& c : b.layout.columns)
        for (int k = 0; k < c.layers; ++k) {
            const auto i = static_cast<std::size_t>(c.start + k);
            if (!(b.layout.flags[i] & slot_own)) continue;
            radius.push_back(std::hypot(c.x - b.axis_x, c.y - b.axis_y));
            pressure.push_back(static_cast<double>(b.peak_pressure[i]));
            radial.push_back(static_cast<double>(b.peak_radial[i]));
        }
    r.pressure = attenuation_of(radius, pressure, options_.specimen);
    r.radial_stress = attenuation_of(radius, radial, options_.specimen);
    return r;
}

template <class R>
void Recorder<R>::write_gauges(const World<R>& w) {
    for (Gauge& g : gauges_) {
        const SolidBody<R>& b = w.solids[g.solid].body;
        const auto i = static_cast<std::size_t>(g.slot);
        const Tile& tile = b.layout.tiles[g.tile];
        const Column& c = b.layout.columns[static_cast<std::size_t>(tile.column)];
        std::vector<Sym3<double>> of_tile(static_cast<std::size_t>(b.layout.width));
        deviators(b, w.solids[g.solid].pairs, tile, of_tile.data());
        const Sym3<double>& s = of_tile[static_cast<std::size_t>(g.slot - tile.base)];
        const Principal<double> p = principal(s);
        const double pressure = static_cast<double>(b.pressure[i]);
        const double k = static_cast<double>(g.slot - c.start);
        g.file.row({w.time, c.x + static_cast<double>(b.u[0][i]), c.y + static_cast<double>(b.u[1][i]), c.z0 + k * b.layout.dz + static_cast<double>(b.u[2][i]),
                    pressure, p.one - pressure, p.two - pressure, p.three - pressure, 0.5 * (p.one - p.three), mises(s), static_cast<double>(b.yield[i]),
                    b.damage(i), static_cast<double>(b.v[0][i]), static_cast<double>(b.v[1][i]),
                    static_cast<double>(b.v[2][i]), static_cast<int>(cause_of(b, i, case_.analysis))});
    }
}

template <class R>
void Recorder<R>::write_audit(const Audit& a) {
    std::vector<CsvCell> row{a.step, a.time, a.dt, a.limiter, a.kinetic};
    for (double e : a.internal) row.emplace_back(e);
    for (double e : {a.burn_released, a.viscous, a.zero_energy, a.zero_energy_dissipated, a.contact_stored, a.contact_dissipated, a.boundary_work, a.artificial,
                     a.residual, a.residual_relative, a.momentum[0], a.momentum[1], a.momentum[2], a.momentum_residual, a.penetration})
        row.emplace_back(e);
    row.emplace_back(a.penetration_where);
    row.emplace_back(leaks_.count);
    row.emplace_back(a.torn);
    row.emplace_back(a.damaged);
    audit_.row(row);
}

template <class R>
void Recorder<R>::write_snapshot(const World<R>& w) {
    std::vector<float> points;
    SnapshotField part{"part", "-", 1, std::vector<std::uint8_t>()}, column{"column", "-", 1, std::vector<std::int32_t>()},
        damage{"damage", "-", 1, std::vector<float>()}, pressure{"pressure", "GPa", 1, std::vector<float>()},
        velocity{"velocity", "km/s", 3, std::vector<float>()}, displacement{"displacement", "mm", 3, std::vector<float>()},
        cause{"cause", "-", 1, std::vector<std::uint8_t>()}, failure_time{"failure_time", "us", 1, std::vector<float>()},
        size{"size", "mm", 1, std::vector<float>()}, peak{"peak_pressure", "GPa", 1, std::vector<float>()},
        radial{"peak_radial_stress", "GPa", 1, std::vector<float>()}, stress{"stress", "GPa", 6, std::vector<float>()},
        density{"density", "g/cm3", 1, std::vector<float>()}, energy{"internal_energy", "kJ/g", 1, std::vector<float>()};
    const auto f = [](SnapshotField& field) -> std::vector<float>& { return std::get<std::vector<float>>(field.values); };
    const auto put = [&](SnapshotField& field, auto... v) { (f(field).push_back(static_cast<float>(v)), ...); };
    std::uint8_t number = 0;
    for (const auto& s : w.solids) {
        const SolidBody<R>& b = s.body;
        std::vector<Sym3<double>> deviator(static_cast<std::size_t>(b.layout.width));
        for (const Tile& tile : b.layout.tiles) {
            const Column& c = b.layout.columns[static_cast<std::size_t>(tile.column)];
            deviators(b, s.pairs, tile, deviator.data());
            for (std::size_t l = 0; l < deviator.size(); ++l) {
                const auto i = static_cast<std::size_t>(tile.base) + l;
                if (!(b.layout.flags[i] & slot_own)) continue;
                const Sym3<double>& d = deviator[l];
                const double k = static_cast<double>(static_cast<std::int64_t>(i) - c.start), p = static_cast<double>(b.pressure[i]);
                points.push_back(static_cast<float>(c.x + static_cast<double>(b.u[0][i])));
                points.push_back(static_cast<float>(c.y + static_cast<double>(b.u[1][i])));
                points.push_back(static_cast<float>(c.z0 + k * b.layout.dz + static_cast<double>(b.u[2][i])));
                std::get<std::vector<std::uint8_t>>(part.values).push_back(number);
                std::get<std::vector<std::int32_t>>(column.values).push_back(tile.column);
                std::get<std::vector<std::uint8_t>>(cause.values).push_back(cause_of(b, i, case_.analysis));
                put(damage, b.damage(i));
                put(pressure, p);
                put(velocity, b.v[0][i], b.v[1][i], b.v[2][i]);
                put(displacement, b.u[0][i], b.u[1][i], b.u[2][i]);
                put(failure_time, b.failure_time[i]);
                put(size, std::sqrt(c.area));
                put(peak, b.peak_pressure[i]);
                put(radial, b.peak_radial[i]);
                put(stress, d.xx - p, d.yy - p, d.zz - p, d.xy, d.xz, d.yz);
                put(density, b.material.density);
                put(energy, static_cast<double>(b.energy[i]) / b.material.density);
            }
        }
        ++number;
    }
    for (const FluidPart& fluid : w.fluids) {
        const FluidBody& b = fluid.body;
        for (std::size_t i = 0; i < b.mass.size(); ++i) {
            for (std::size_t a = 0; a < 3; ++a) points.push_back(static_cast<float>(b.x[a][i]));
            std::get<std::vector<std::uint8_t>>(part.values).push_back(number);
            std::get<std::vector<std::int32_t>>(column.values).push_back(-1);
            std::get<std::vector<std::uint8_t>>(cause.values).push_back(0);
            put(damage, 0);
            put(pressure, b.pressure[i]);
            put(velocity, b.v[0][i], b.v[1][i], b.v[2][i]);
            put(displacement, b.x[0][i] - b.reference[0][i], b.x[1][i] - b.reference[1][i], b.x[2][i] - b.reference[2][i]);
            put(failure_time, -1);
            put(size, b.current_spacing(i));
            put(peak, b.peak_pressure[i]);
            put(radial, 0);
            put(stress, -b.pressure[i], -b.pressure[i], -b.pressure[i], 0, 0, 0);
            put(density, b.rho_now[i]);
            put(energy, b.e_now[i]);
        }
        ++number;
    }
    const std::vector<SnapshotField> fields{part, column, damage, pressure, velocity, displacement, cause, failure_time, size, peak, radial, stress, density, energy};
    snapshots_.write(w.time, std::span<const float>(points), fields);
}

template class Recorder<double>;
template class Recorder<float>;

}  // namespace brisance
