// SPDX-License-Identifier: Apache-2.0
// Equations of state. Every one here is linear in the internal energy E per initial volume: P = a(mu) + b(mu) E, mu = rho/rho_0 - 1,
// which closes the energy step without iteration. A law is a struct with
//   static constexpr const char* name;  static std::vector<ParameterInfo> parameters();
//   explicit Law(const ParameterSet&);  template <class V> EosTerms<V> terms(V mu) const;
// and optionally  double initial_energy() const;  double pressure_floor() const;
// plus its name in the list of laws/laws.h. Sound speed: c^2 = (1/rho_0) [a' + b' E + P b / (1 + mu)^2].
#pragma once

#include "exec/memory.h"
#include "laws/parameters.h"
#include "math/pack.h"

#include <functional>
#include <limits>
#include <memory>

namespace brisance {

/// P = a + b E and the derivatives of a and b by mu. GPa; b has no dimension.
template <class V>
struct EosTerms {
    V a, b, da, db;
};

template <class V> BRISANCE_HD inline V eos_pressure(const EosTerms<V>& t, V energy) { return t.a + t.b * energy; }
/// rho_0 c^2, GPa.
template <class V> BRISANCE_HD inline V eos_stiffness(const EosTerms<V>& t, V mu, V energy, V pressure) {
    using R = ScalarOf<V>;
    return t.da + t.db * energy + pressure * t.b / sq(R(1) + mu);
}

/// A law with its parameters, its type erased once per batch of points.
class Eos {
public:
    virtual ~Eos() = default;
    virtual EosTerms<double> terms(double mu) const = 0;
    /// terms of lanes<R> points: mu, and the four terms, each an array of one pack.
    virtual void terms(const double* mu, EosTerms<Pack<double>>& out) const = 0;
    virtual void terms(const float* mu, EosTerms<Pack<float>>& out) const = 0;
    virtual double initial_energy() const = 0;  ///< GPa (per initial volume) at mu = 0
    virtual double pressure_floor() const = 0;  ///< GPa; tension cut-off, -infinity for none
    virtual std::string law() const = 0;
    virtual const void* object() const = 0;  ///< the law itself, of the type that law() names (laws/laws.h)

    double pressure(double mu, double energy) const {
        const double p = eos_pressure(terms(mu), energy);
        return p < pressure_floor() ? pressure_floor() : p;
    }
    double stiffness(double mu, double energy) const { return eos_stiffness(terms(mu), mu, energy, pressure(mu, energy)); }
    /// Bulk modulus at rest, GPa.
    double bulk_modulus() const { return stiffness(0, initial_energy()); }
};

using EosPtr = std::shared_ptr<const Eos>;

struct EosEntry {
    std::string name, meaning;
    std::vector<ParameterInfo> parameters;
    std::function<EosPtr(const ParameterSet&)> make;
};

namespace detail {
template <class Law>
class EosOf final : public Eos {
public:
    explicit EosOf(const ParameterSet& p) : law_(p) {}
    EosTerms<double> terms(double mu) const override { return law_.terms(mu); }
    void terms(const double* mu, EosTerms<Pack<double>>& out) const override { out = law_.terms(load<Pack<double>>(mu)); }
    void terms(const float* mu, EosTerms<Pack<float>>& out) const override { out = law_.terms(load<Pack<float>>(mu)); }
    double initial_energy() const override {
        if constexpr (requires { law_.initial_energy(); }) return law_.initial_energy();
        return 0;
    }
    double pressure_floor() const override {
        if constexpr (requires { law_.pressure_floor(); }) return law_.pressure_floor();
        return -std::numeric_limits<double>::infinity();
    }
    std::string law() const override { return Law::name; }
    const void* object() const override { return &law_; }

private:
    Law law_;
};
}  // namespace detail

/// A law's entry, by which it is found in material files.
template <class Law> EosEntry eos_entry() {
    return {Law::name, Law::meaning, Law::parameters(),
            [](const ParameterSet& p) -> EosPtr { return std::allocate_shared<detail::EosOf<Law>>(ConstantAllocator<detail::EosOf<Law>>(), p); }};
}

}  // namespace brisance
