// SPDX-License-Identifier: Apache-2.0
// Strength laws: what a point of a solid bears. A law is a struct with
//   static constexpr const char* name, *meaning;
//   static std::vector<ParameterInfo> parameters();
//   static std::vector<StateInfo> state();          columns kept per particle, in this order in SolidPoint::state
//   Law(const ParameterSet&, const Eos&, double density);
//   double shear_modulus() const;
//   template <class V> void update(SolidPoint<V>&) const;   scalar code on V, without branches
// and its name in the list of laws/laws.h. A law knows no neighbour and no formulation.
#pragma once

#include "laws/eos.h"
#include "math/vec.h"

namespace brisance {

/// A column of state: initial value, and what it means.
struct StateInfo {
    std::string name, unit, meaning;
    double initial = 0;
    bool kept = true;  ///< false: nothing depends on it. The driver of a single point follows it; a body does not keep it
};

inline constexpr int max_law_state = 6;

/// One point of a solid during one step, as a strength law sees it. V is a number or a pack of them.
template <class V>
struct SolidPoint {
    Sym3<V> d;         ///< strain increment of the step, in the current frame
    Sym3<V> s;         ///< in: deviatoric stress, already rotated (GPa); out: the new one
    V mu;              ///< rho/rho_0 - 1
    V pressure;        ///< in: from the equation of state (GPa); out: with what the law adds or cuts
    V energy;          ///< internal energy per initial volume, GPa
    V dt;              ///< us
    V scale;           ///< strength scale of the place (Weibull), mean 1
    V state[max_law_state];
    // out
    V yield;           ///< GPa, the strength that was in force
    V shear_stiffness; ///< 4/3 G, for the stable step, GPa
    V integrity;       ///< 1: whole; 0: bears no tension. Softens the zero-energy control
};

/// The deviator of d, added to s elastically with modulus G; returns the trial deviator.
template <class V> BRISANCE_HD inline Sym3<V> elastic_trial(const SolidPoint<V>& p, ScalarOf<V> two_g) {
    const V mean = trace(p.d) * (ScalarOf<V>(1) / ScalarOf<V>(3));
    return {p.s.xx + two_g * (p.d.xx - mean), p.s.yy + two_g * (p.d.yy - mean), p.s.zz + two_g * (p.d.zz - mean),
            p.s.xy + two_g * p.d.xy, p.s.xz + two_g * p.d.xz, p.s.yz + two_g * p.d.yz};
}
/// von Mises stress of a deviator.
template <class V> BRISANCE_HD inline V mises(const Sym3<V>& s) { return vsqrt(ScalarOf<V>(1.5) * ddot(s, s)); }
/// Equivalent total strain rate sqrt(2/3 e:e)/dt, e the deviator of d; 1/us.
template <class V> BRISANCE_HD inline V equivalent_rate(const SolidPoint<V>& p) {
    using R = ScalarOf<V>;
    const V t = trace(p.d);
    return vsqrt(vmax(R(2.0 / 3.0) * (ddot(p.d, p.d) - t * t * R(1.0 / 3.0)), V{})) / p.dt;
}
template <class V> BRISANCE_HD inline Sym3<V> scaled(const Sym3<V>& s, V f) {
    return {s.xx * f, s.yy * f, s.zz * f, s.xy * f, s.xz * f, s.yz * f};
}

/// A law with its parameters, its type erased once per batch.
class Strength {
public:
    virtual ~Strength() = default;
    virtual void update(SolidPoint<double>&) const = 0;
    virtual void update_pack(SolidPoint<Pack<double>>&) const = 0;
    virtual void update_pack(SolidPoint<Pack<float>>&) const = 0;
    virtual double shear_modulus() const = 0;
    virtual std::vector<StateInfo> state() const = 0;
    virtual std::string law() const = 0;
    virtual const void* object() const = 0;  ///< the law itself, of the type that law() names (laws/laws.h)
    /// Remarks on the consistency of the parameters, for the loader.
    virtual std::vector<std::string> remarks() const = 0;
};

using StrengthPtr = std::shared_ptr<const Strength>;

struct StrengthEntry {
    std::string name, meaning;
    std::vector<ParameterInfo> parameters;
    std::vector<StateInfo> state;
    std::function<StrengthPtr(const ParameterSet&, const Eos&, double density)> make;
};

namespace detail {
template <class Law>
class StrengthOf final : public Strength {
public:
    StrengthOf(const ParameterSet& p, const Eos& eos, double density) : law_(p, eos, density) {}
    void update(SolidPoint<double>& p) const override { law_.update(p); }
    void update_pack(SolidPoint<Pack<double>>& p) const override { law_.update(p); }
    void update_pack(SolidPoint<Pack<float>>& p) const override { law_.update(p); }
    double shear_modulus() const override { return law_.shear_modulus(); }
    std::vector<StateInfo> state() const override { return Law::state(); }
    std::string law() const override { return Law::name; }
    const void* object() const override { return &law_; }
    std::vector<std::string> remarks() const override {
        if constexpr (requires { law_.remarks(); }) return law_.remarks();
        return {};
    }

private:
    Law law_;
};
}  // namespace detail

/// A law's entry, by which it is found in material files.
template <class Law> StrengthEntry strength_entry() {
    return {Law::name, Law::meaning, Law::parameters(), Law::state(), [](const ParameterSet& p, const Eos& eos, double density) -> StrengthPtr {
                return std::allocate_shared<detail::StrengthOf<Law>>(ConstantAllocator<detail::StrengthOf<Law>>(), p, eos, density);
            }};
}

}  // namespace brisance
