// SPDX-License-Identifier: Apache-2.0
#include "app/assembly.h"

#include "app/crack_band.h"
#include "base/error.h"
#include "base/random.h"
#include "geometry/placement.h"
#include "geometry/strength_field.h"
#include "integrate/step_size.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace brisance {

namespace {

std::uint64_t arrangement_seed(const Case& c, const PartData& p) {
    if (p.seed != 0) return p.seed;
    std::uint64_t h = c.seed;
    for (char ch : p.name) h = random_bits(h, 3, static_cast<std::uint64_t>(static_cast<unsigned char>(ch)));
    return h;
}

const PartData& part_named(const Case& c, const std::string& name) {
    for (const PartData& p : c.parts)
        if (p.name == name) return p;
    throw InputError("no part is named " + name);
}

std::vector<ShapePtr> later_shapes(const Case& c, const PartData& part) {
    std::vector<ShapePtr> later;
    bool after = false;
    for (const PartData& p : c.parts) {
        if (after) later.push_back(p.shape);
        if (&p == &part) after = true;
    }
    return later;
}

PlacementOptions placement_options(const Case& c, const PartData& p, const Extent& extent) {
    PlacementOptions o;
    o.arrangement = p.arrangement;
    o.angle = p.angle;
    o.seed = arrangement_seed(c, p);
    o.spacing = p.spacing;
    o.spacing_far = p.spacing_far;
    o.grading_radius = p.grading_radius;
    o.grading_growth = p.grading_growth;
    o.spacing_z = p.spacing_z;
    o.z_phase = p.z_phase;
    o.smoothing = p.smoothing;
    o.axis_x = c.analysis.axis.x;
    o.axis_y = c.analysis.axis.y;
    o.slice = extent.periodic;
    o.z_low = extent.low;
    o.z_high = extent.high;
    return o;
}

Point initial_velocity(const PartData& p, Point at) {
    if (p.velocity_field.empty()) return p.velocity;
    const Point v = p.velocity + Point{p.velocity_field[0](at.x, at.y, at.z), p.velocity_field[1](at.x, at.y, at.z), p.velocity_field[2](at.x, at.y, at.z)};
    if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z))
        throw InputError(fmt::format("{}: initial.velocity of part {}: it is no finite number at ({:g}, {:g}, {:g}) mm", p.where, p.name, at.x, at.y, at.z));
    return v;
}

template <class R>
SolidPart<R> make_solid(const Case& c, const PartData& p, const Placement& placement, const Extent& extent) {
    SolidPart<R> s;
    SolidBody<R>& b = s.body;
    b.name = p.name;
    b.material = make_material(p.material);
    if (!b.material.strength)
        throw InputError(fmt::format("{}: part {} is total_lagrangian, but {} has no strength law; use updated_lagrangian for fluids", p.where, p.name,
                                     p.material.name));
    b.options.smoothing = p.smoothing;
    b.options.zero_energy = p.zero_energy;
    b.options.pairwise = p.viscosity.pairwise;
    b.options.alpha = p.viscosity.alpha;
    b.options.beta = p.viscosity.beta;
    b.options.linear = p.viscosity.linear;
    b.options.quadratic = p.viscosity.quadratic;
    b.options.yield = std::any_of(c.gauges.begin(), c.gauges.end(), [&](const GaugeData& g) { return g.part == p.name; });
    FailureRule& f = b.options.failure;
    f.mode = static_cast<int>(p.failure.mode);
    f.tensile = p.failure.tensile_strength.value_or(0);
    f.shear = p.failure.shear_strength.value_or(0);
    f.fracture_energy = p.failure.fracture_energy.value_or(0);
    f.notice = 0.3 * c.analysis.tensile_strength;
    f.threshold = c.analysis.damage_threshold;
    b.axis_x = c.analysis.axis.x;
    b.axis_y = c.analysis.axis.y;

    b.layout.columns.assign(placement.columns.begin(), placement.columns.end());
    b.layout.dz = placement.dz;
    b.layout.z_low = placement.z_low;
    b.layout.periodic = extent.periodic;
    b.layout.width = tile_width<R>;
    b.layout.pad = largest_offset(p.smoothing);
    const std::vector<ShapePtr> later = later_shapes(c, p);
    lay_out(b.layout, [&](const Column& column, int k) {
        if (extent.periodic) return true;
        const Point at{column.x, column.y, placement.z_low + (k + 0.5) * placement.dz};
        if (!p.shape->contains(at)) return false;
        return std::none_of(later.begin(), later.end(), [&](const ShapePtr& l) { return l->contains(at); });
    });
    allocate(b);
    complete(b);
    s.pairs = find_column_pairs<R>(b.layout, p.smoothing);

    if (p.heterogeneity.weibull_modulus > 0) {
        const StrengthField field(p.heterogeneity.weibull_modulus, p.heterogeneity.correlation_length, p.heterogeneity.seed,
                                  extent.periodic ? extent.high - extent.low : 0);
        b.scale.assign(b.energy.size(), R(1));
        exec::for_each(static_cast<std::int64_t>(b.layout.columns.size()), [&](std::int64_t n) {
            const Column& column = b.layout.columns[static_cast<std::size_t>(n)];
            for (int k = 0; k < column.layers; ++k) {
                const auto i = static_cast<std::size_t>(column.start + k);
                b.scale[i] = static_cast<R>(field({column.x, column.y, column.z0 + k * b.layout.dz}));
            }
        });
    }
    for (const Column& column : b.layout.columns)  // one after the other: a formula may object
        for (int k = 0; k < column.layers; ++k) {
            const auto i = static_cast<std::size_t>(column.start + k);
            const Point v = initial_velocity(p, {column.x, column.y, column.z0 + k * b.layout.dz});
            b.v[0][i] = static_cast<R>(v.x);
            b.v[1][i] = static_cast<R>(v.y);
            b.v[2][i] = static_cast<R>(v.z);
        }
    if (p.failure.fracture_energy) check_crack_band(b, p.failure);
    s.surface = make_surface(b);
    return s;
}

std::vector<Detonator> detonators_of(const Case& c, const PartData& p) {
    std::vector<Detonator> all;
    for (const DetonationData& d : c.detonations)
        if (d.part == p.name) all.push_back({static_cast<int>(d.kind), {d.from.x, d.from.y, d.from.z}, {d.to.x, d.to.y, d.to.z}, d.time});
    return all;
}

FluidPart make_fluid(const Case& c, const PartData& p, const Placement& placement, const Extent& extent) {
    FluidPart f;
    FluidBody& b = f.body;
    b.name = p.name;
    b.material = make_material(p.material);
    if (b.material.strength)
        throw InputError(fmt::format("{}: part {} is updated_lagrangian, which knows fluids only, but {} has the strength law {}; use total_lagrangian", p.where, p.name,
                                     p.material.name, b.material.strength->law()));
    b.options.smoothing = p.smoothing;
    b.options.alpha = p.viscosity.alpha;
    b.options.beta = p.viscosity.beta;
    b.options.linear = p.viscosity.linear;
    b.options.quadratic = p.viscosity.quadratic;
    b.options.artificial_stress = p.artificial_stress;
    b.options.epsilon = p.artificial_stress_epsilon;
    b.options.n = p.artificial_stress_n;
    b.spacing = std::cbrt(p.spacing * p.spacing * placement.dz);
    b.z_low = extent.low;
    b.period = extent.periodic ? extent.high - extent.low : 0;

    const std::vector<ShapePtr> later = later_shapes(c, p);
    std::vector<Point> at;
    std::vector<double> volume;
    for (const Column& column : placement.columns)
        for (int k = 0; k < column.layers; ++k) {
            const Point place{column.x, column.y, placement.z_low + (k + 0.5) * placement.dz};
            if (!extent.periodic && (!p.shape->contains(place) || std::any_of(later.begin(), later.end(), [&](const ShapePtr& l) { return l->contains(place); })))
                continue;
            at.push_back({column.x, column.y, column.z0 + k * placement.dz});
            volume.push_back(column.area * placement.dz);
        }
    resize(b, at.size());
    const double e0 = b.material.eos->initial_energy() / b.material.density;
    for (std::size_t i = 0; i < at.size(); ++i) {
        b.x[0][i] = b.reference[0][i] = at[i].x;
        b.x[1][i] = b.reference[1][i] = at[i].y;
        b.x[2][i] = b.reference[2][i] = at[i].z;
        b.rho[i] = p.density_field ? (*p.density_field)(at[i].x, at[i].y, at[i].z) : b.material.density;
        b.mass[i] = b.rho[i] * volume[i];
        b.e[i] = p.energy_field ? (*p.energy_field)(at[i].x, at[i].y, at[i].z) : e0;
        if (!(b.rho[i] > 0) || !std::isfinite(b.rho[i]) || !std::isfinite(b.e[i]))
            throw InputError(fmt::format("{}: initial fields of part {}: at ({:g}, {:g}, {:g}) mm the density is {:g} g/cm3 and the energy {:g} kJ/g; allowed are a density above 0 and finite numbers",
                                         p.where, p.name, at[i].x, at[i].y, at[i].z, b.rho[i], b.e[i]));
        const Point v = initial_velocity(p, at[i]);
        b.v[0][i] = v.x;
        b.v[1][i] = v.y;
        b.v[2][i] = v.z;
    }
    if (p.density_field) b.rho_start = b.rho;
    if (b.period > 0)
        for (double& z : b.x[2]) z -= b.period * std::floor((z - b.z_low) / b.period);
    if (b.material.burn) light(b, detonators_of(c, p));
    return f;
}

bool in_contact(const Case& c, const std::string& a, const std::string& b) {
    if (c.contact.all) return true;
    return std::any_of(c.contact.pairs.begin(), c.contact.pairs.end(),
                       [&](const auto& p) { return (p.first == a && p.second == b) || (p.first == b && p.second == a); });
}

double mean_spacing(const Surface& s) {
    double sum = 0;
    for (std::size_t i = 0; i < s.sides; ++i) sum += s.spacing[i] + s.dz[i];
    return s.sides ? sum / static_cast<double>(s.sides) : 0;
}

}  // namespace

Extent slice_extent(const Case& c) {
    if (!c.slice) return {};
    const double thickness = c.slice->layers * part_named(c, c.slice->reference).spacing_z;
    return {c.slice->z - 0.5 * thickness, c.slice->z + 0.5 * thickness, true};
}

Estimate estimate(const Case& c) {
    Estimate e;
    const Extent extent = slice_extent(c);
    for (const PartData& p : c.parts) {
        const std::vector<ShapePtr> later = later_shapes(c, p);
        const Box box = p.shape->bounds();
        const double low = extent.periodic ? extent.low : box.min.z, high = extent.periodic ? extent.high : box.max.z, middle = 0.5 * (low + high);
        // density of columns integrated over the section on a fine raster, by area of each pixel inside
        const int n = 1200;
        const double dx = (box.max.x - box.min.x) / n, dy = (box.max.y - box.min.y) / n;
        std::vector<double> counts(static_cast<std::size_t>(n), 0), areas(static_cast<std::size_t>(n), 0);
        exec::for_each(n, [&](std::int64_t j) {
            for (int i = 0; i < n; ++i) {
                const Point at{box.min.x + (i + 0.5) * dx, box.min.y + (static_cast<double>(j) + 0.5) * dy, middle};
                double d = p.shape->distance(at);
                for (const ShapePtr& l : later) d = std::max(d, -l->distance(at));
                // the fraction of the pixel that lies inside, from the distance
                const double inside = std::clamp(0.5 - d / (0.5 * (dx + dy)), 0.0, 1.0);
                if (inside == 0) continue;
                const double r = std::hypot(at.x - c.analysis.axis.x, at.y - c.analysis.axis.y);
                const double s = std::min(std::max(p.spacing_far, p.spacing), p.spacing + p.grading_growth * std::max(0.0, r - p.grading_radius));
                counts[static_cast<std::size_t>(j)] += inside * dx * dy / (s * s);
                areas[static_cast<std::size_t>(j)] += inside * dx * dy;
            }
        }, 8);
        double columns = 0, area = 0;
        for (int j = 0; j < n; ++j) {
            columns += counts[static_cast<std::size_t>(j)];
            area += areas[static_cast<std::size_t>(j)];
        }
        const Material m = make_material(p.material);
        Estimate::Part part;
        part.name = p.name;
        part.material = p.material.name;
        const bool solid = p.formulation == Formulation::total_lagrangian;
        part.formulation = solid ? "total_lagrangian" : "updated_lagrangian";
        part.spacing = p.spacing;
        part.spacing_far = std::max(p.spacing_far, p.spacing);
        part.spacing_z = p.spacing_z;
        part.mass = area * (high - low) * m.density;
        const double layers = std::max(1.0, std::round((high - low) / p.spacing_z));
        part.particles = columns * layers;
        const bool single = c.precision == Precision::single;
        const double real = single ? 4 : 8, width = single ? tile_width<float> : tile_width<double>;
        const double pad = largest_offset(p.smoothing);
        part.lanes = solid ? columns * std::ceil(layers / width) * width : part.particles;
        const double slots = !solid ? part.particles : columns * width * (extent.periodic ? std::ceil(layers / width) + std::ceil(2 * pad / width) : std::ceil((layers + pad) / width));
        double reals = 27 + (p.viscosity.pairwise ? 9 : 0) + (p.failure.fracture_energy ? 1 : 0) + (p.heterogeneity.weibull_modulus > 0 ? 1 : 0);  // particles/solid_body.h
        if (m.strength)
            for (const StateInfo& column : m.strength->state()) reals += column.kept;
        constexpr double fluid_bytes = 1300;  // with lists of 70 neighbours: bench water, docs/performance.md
        const double per_slot = solid ? real * reals + 7 * sizeof(float) + 1 : fluid_bytes;
        part.bytes = slots * per_slot + (solid ? columns * (60 * real + 25 * 48 + 200) : 0);
        part.dt = solid ? c.step.courant_solid * stencil_tau(p.smoothing, p.zero_energy) * std::min(p.spacing, p.spacing_z) / m.sound_speed()
                        : c.step.courant_fluid * p.smoothing * p.spacing /
                              (std::max(m.sound_speed(), m.burn ? m.burn->speed : 0.0) * (1 + 0.6 * p.viscosity.alpha));
        part.burns = m.burn != nullptr;
        if (part.burns) {
            const std::vector<Detonator> detonators = detonators_of(c, p);
            for (int corner = 0; corner < 8; ++corner)
                e.burn = std::max(e.burn, lighting_time({corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y, corner & 4 ? high : low}, detonators, m.burn->speed));
        }
        e.parts.push_back(part);
        e.particles += part.particles;
        e.bytes += part.bytes;
        e.dt = e.dt == 0 ? part.dt : std::min(e.dt, part.dt);
    }
    // While a charge burns it holds the step, at three fifths of its step at rest since it is compressed; then the next part does.
    const double while_burning = 0.6 * e.dt, burning = std::min(e.burn, c.until);
    double after = 1e300;
    for (const Estimate::Part& p : e.parts)
        if (!p.burns || e.parts.size() == 1) after = std::min(after, p.dt);
    e.steps = burning / while_burning + (c.until - burning) / after;
    for (const Estimate::Part& p : e.parts) {
        const auto long_steps = [&](double time, double fast) { return time / std::clamp(p.dt, fast, most_short_steps * fast); };
        if (p.formulation == "total_lagrangian") e.solid_steps += p.lanes * (long_steps(burning, while_burning) + long_steps(c.until - burning, after));
        else e.fluid_steps += p.particles * e.steps;
    }
    return e;
}

template <class R>
World<R> assemble(const Case& c, const std::function<void(const std::string&)>& say) {
    World<R> w;
    const Extent extent = slice_extent(c);
    w.z_low = extent.low;
    w.period = extent.periodic ? extent.high - extent.low : 0;
    w.contact = {c.contact.stiffness, c.contact.damping, c.contact.friction};
    w.options = {c.step.courant_solid, c.step.courant_fluid, c.step.growth, c.step.minimum,
                 c.step.energy_residual_limit, c.step.velocity_limit, c.step.torn_limit, c.step.leak_limit};

    for (const PartData& p : c.parts) {
        const Placement placement = [&] {
            try {
                return place(*p.shape, later_shapes(c, p), placement_options(c, p, extent));
            } catch (const InputError& e) {
                throw InputError(fmt::format("{}: part {}, spacing {:g} mm: {}", p.where, p.name, p.spacing, e.what()));
            }
        }();
        if (p.formulation == Formulation::total_lagrangian) {
            w.solids.push_back(make_solid<R>(c, p, placement, extent));
            const SolidBody<R>& b = w.solids.back().body;
            say(fmt::format("{}: {} particles in {} columns, {:.0f} bonds each, spacing {:g} ... {:g} mm, {:g} mm along z", b.name, b.layout.particles,
                            b.layout.columns.size(), w.solids.back().pairs.bonds_per_particle, p.spacing, std::max(p.spacing, p.spacing_far), placement.dz));
            for (const std::string& r : b.material.remarks) say("  " + b.material.name + ": " + r);
        } else {
            w.fluids.push_back(make_fluid(c, p, placement, extent));
            const FluidBody& b = w.fluids.back().body;
            say(fmt::format("{}: {} particles, spacing {:g} mm", b.name, b.size(), b.spacing));
            for (const std::string& r : b.material.remarks) say("  " + b.material.name + ": " + r);
        }
    }

    for (std::size_t i = 0; i < w.fluids.size(); ++i)
        for (std::size_t j = i + 1; j < w.fluids.size(); ++j)
            if (in_contact(c, w.fluids[i].body.name, w.fluids[j].body.name)) w.contacts.push_back({ContactPair::fluid_fluid, i, j});
    for (std::size_t i = 0; i < w.fluids.size(); ++i)
        for (std::size_t j = 0; j < w.solids.size(); ++j)
            if (in_contact(c, w.fluids[i].body.name, w.solids[j].body.name)) w.contacts.push_back({ContactPair::fluid_solid, i, j});
    for (std::size_t i = 0; i < w.solids.size(); ++i)
        for (std::size_t j = i + 1; j < w.solids.size(); ++j) {
            if (!in_contact(c, w.solids[i].body.name, w.solids[j].body.name)) continue;
            // the finer one gives the nodes, the coarser one the smooth wall; of equal ones, whatever rounding says, the later gives the nodes
            const bool i_finer = mean_spacing(w.solids[i].surface) < (1 - 1e-9) * mean_spacing(w.solids[j].surface);
            w.contacts.push_back({ContactPair::solid_solid, i_finer ? i : j, i_finer ? j : i});
        }

    for (const BoundaryData& b : c.boundaries) {
        for (SolidPart<R>& s : w.solids) {
            if (b.part != "*" && b.part != s.body.name) continue;
            if (b.kind == BoundaryKind::fix) {
                const bool axis[3] = {b.fix_x, b.fix_y, b.fix_z};
                if (b.on) {
                    s.fixed.push_back(make_fixed_region(s.body, *b.on, axis));
                    if (s.fixed.back().slots.empty()) throw InputError(fmt::format("boundary fix on part {}: no particle of the part lies inside its shape", s.body.name));
                    continue;
                }
                // in a slice nothing ends at a plane across z
                if (extent.periodic && std::abs(b.normal.z) > 0.7 * norm(b.normal)) continue;
                s.fixed.push_back(make_fixed_plane(s.body, b.point, b.normal, axis));
            } else if (b.kind == BoundaryKind::platen) {
                if (extent.periodic && std::abs(b.normal.z) > 0.7 * norm(b.normal)) continue;
                s.platens.push_back(make_solid_platen(s.body, Platen{b.point, b.normal}));
            } else if (b.kind == BoundaryKind::pressure) {
                s.loads.push_back(make_wall_pressure(s.body, s.surface, *b.on, b.times, b.values));
                if (s.loads.back().points.empty())
                    throw InputError(fmt::format("{}: no wall of the part {} lies inside the shape of the pressure", b.where, s.body.name));
            }
        }
        for (FluidPart& f : w.fluids) {
            if ((b.kind != BoundaryKind::platen && b.kind != BoundaryKind::mirror) || (b.part != "*" && b.part != f.body.name)) continue;
            if (extent.periodic && std::abs(b.normal.z) > 0.7 * norm(b.normal)) continue;
            if (b.kind == BoundaryKind::platen) f.platens.push_back(Platen{b.point, b.normal});
            else if (std::abs(b.normal.x) > 0.7) f.body.mirrors.push_back({0, b.point.x});
            else if (std::abs(b.normal.y) > 0.7) f.body.mirrors.push_back({1, b.point.y});
            else f.body.mirrors.push_back({2, b.point.z});
        }
    }
    return w;
}

template World<double> assemble(const Case&, const std::function<void(const std::string&)>&);
template World<float> assemble(const Case&, const std::function<void(const std::string&)>&);

}  // namespace brisance
