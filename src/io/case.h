// SPDX-License-Identifier: Apache-2.0
// A case as data: what a case file says after includes, presets and --set, in internal units. Nothing here computes.
#pragma once

#include "base/formula.h"
#include "geometry/cloud.h"
#include "geometry/shape.h"
#include "laws/parameters.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace brisance {

enum class Formulation { total_lagrangian, updated_lagrangian };
enum class OnFailure { jh2, no_tension_no_shear, all_zero };
enum class Precision { double_, single };

struct ViscosityData {
    bool pairwise = true;    ///< Monaghan's Pi_ij between pairs; else bulk viscosity in the stress
    double alpha = 0, beta = 0;          ///< pairwise: linear and quadratic coefficients
    double linear = 0, quadratic = 0;    ///< bulk: C_l and C_q
};

struct FailureData {
    OnFailure mode = OnFailure::jh2;
    std::optional<double> tensile_strength;  ///< GPa; largest principal stress that fails a particle (off when absent)
    std::optional<double> shear_strength;    ///< GPa; largest shear stress that fails a particle (off when absent)
    std::optional<double> fracture_energy;   ///< J/mm2; tensile failure softens over a crack band (at once when absent)
    std::string fracture_energy_where;
};

struct HeterogeneityData {
    double weibull_modulus = 0;      ///< 0: homogeneous
    double correlation_length = 0;   ///< mm
    std::uint64_t seed = 1;
};

struct PartData {
    std::string name, where;
    MaterialData material;
    ShapePtr shape;
    Formulation formulation = Formulation::total_lagrangian;
    Arrangement arrangement = Arrangement::relaxed;
    double angle = 0;              ///< rad
    std::uint64_t seed = 0;        ///< of the arrangement; 0: derived from run.seed and the part's name
    double spacing = 0;            ///< mm, in the section, at its finest
    double spacing_far = 0;        ///< mm, in the section, at its coarsest (equal to spacing when there is no grading)
    double grading_radius = 0;     ///< mm, distance from the axis at which the spacing begins to grow
    double grading_growth = 0;     ///< growth of the spacing per mm of distance
    double spacing_z = 0;          ///< mm
    bool z_phase = true;           ///< each column with its own phase along z
    double smoothing = 1.3;        ///< h / spacing
    ViscosityData viscosity;
    double zero_energy = 0;        ///< stiffness of the zero-energy control over the longitudinal modulus (total-Lagrangian)
    bool artificial_stress = false;  ///< updated-Lagrangian: (R_i + R_j) f_ij^n
    double artificial_stress_epsilon = 0.5, artificial_stress_n = 4;
    FailureData failure;
    HeterogeneityData heterogeneity;
    Point velocity{};              ///< initial, km/s
    std::vector<Formula> velocity_field;  ///< initial, three formulas that are added to `velocity`, or none
    std::optional<Formula> density_field, energy_field;  ///< initial, updated-Lagrangian: g/cm3, kJ/g; else those of the material
};

enum class DetonationKind { point, line, instant };
struct DetonationData {
    std::string part;
    DetonationKind kind = DetonationKind::point;
    Point from{}, to{};   ///< the point is `from`; a line runs to `to`
    double time = 0;      ///< us
};

enum class BoundaryKind { fix, platen, pressure, mirror };
struct BoundaryData {
    BoundaryKind kind = BoundaryKind::fix;
    std::string part;                 ///< a part's name, or "*" for all
    Point point{}, normal{};          ///< a plane; normal points out of the material. fix: particles within one spacing of the plane
    bool fix_x = false, fix_y = false, fix_z = false;
    ShapePtr on;                      ///< pressure: walls of the part inside this shape are loaded; fix: its particles inside it, in place of a plane
    std::vector<double> times, values;  ///< pressure history, us and GPa, linear between
    std::string where;                  ///< file, line and column of `on`
};

struct ContactData {
    bool all = true;
    std::vector<std::pair<std::string, std::string>> pairs;
    double stiffness = 1.0;   ///< factor on the material stiffness
    double damping = 0.05;    ///< fraction of critical
    double friction = 0.0;
};

struct GaugeData {
    std::string name, part;
    Point at{};
};

struct SectionData {
    std::string name;
    double z = 0;
};

struct AnalysisData {
    std::string part;                      ///< the part whose cracks are counted
    double damage_threshold = 0.8;
    std::vector<double> zone_radii;        ///< mm, ascending, starting at 0
    int sectors = 72;
    std::vector<SectionData> sections;
    Point axis{};                          ///< a point on the borehole axis (which runs along z)
    double tensile_strength = 0, shear_strength = 0;  ///< GPa, label the cause of a failure
};

struct OutputData {
    std::vector<double> snapshot_times;   ///< us
    double history_interval = 0;          ///< us, of gauges, audit and analysis rows
    double checkpoint_interval = 0;       ///< us of wall time
};

/// Plane strain: a slab of `layers` layers of spacing_z of the part `reference`, periodic in z, centred at z.
struct SliceData {
    double z = 0;
    int layers = 8;
    std::string reference;
};

struct StepData {
    double courant_solid = 0.8;   ///< fraction of the stable step of the stencil
    double courant_fluid = 0.4;
    double growth = 1.02;         ///< largest ratio of successive steps
    double minimum = 1e-6;        ///< us; the run stops when the step falls below
    double energy_residual_limit = 0.05;  ///< relative; the run stops above
    double velocity_limit = 30;   ///< km/s; likewise
    double torn_limit = 0.01, leak_limit = 0.01;  ///< fraction of a part's particles; likewise
};

struct Case {
    std::string title, file, preset;
    std::vector<std::string> settings;   ///< the --set arguments
    double until = 0;                    ///< us
    std::uint64_t seed = 1;
    Precision precision = Precision::double_;
    std::vector<PartData> parts;         ///< in order: a later part cuts into the earlier ones
    std::optional<SliceData> slice;
    std::vector<DetonationData> detonations;
    std::vector<BoundaryData> boundaries;
    ContactData contact;
    std::vector<GaugeData> gauges;
    AnalysisData analysis;
    OutputData output;
    StepData step;
    std::string resolved;                ///< the case after all merging, as TOML with comments, for the run directory
};

}  // namespace brisance
