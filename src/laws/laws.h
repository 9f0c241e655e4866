// SPDX-License-Identifier: Apache-2.0
// Every law by its type, and the laws of a material as kernels take them. The processor erases their types, once per pack; a device has no virtual
// functions, so there the strength law is a parameter of the kernel and the equation of state, which is small, is chosen where it is used.
#pragma once

#include "base/error.h"
#include "laws/eos/ideal_gas.h"
#include "laws/eos/jwl.h"
#include "laws/eos/linear_polynomial.h"
#include "laws/eos/mie_gruneisen.h"
#include "laws/eos/polynomial.h"
#include "laws/material.h"
#include "laws/strength/elastic.h"
#include "laws/strength/hjc.h"
#include "laws/strength/jh2.h"
#include "laws/strength/johnson_cook.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace brisance {

using EosLaws = std::tuple<IdealGas, Jwl, LinearPolynomial, MieGruneisen, Polynomial>;
using StrengthLaws = std::tuple<Elastic, Hjc, Jh2, JohnsonCook>;

/// One of EosLaws, by value.
class AnyEos {
public:
    explicit AnyEos(const Eos& eos) { find(eos, std::make_index_sequence<std::tuple_size_v<EosLaws>>{}); }
    template <class V> BRISANCE_HD EosTerms<V> terms(V mu) const { return terms<0>(mu); }

private:
    template <std::size_t... k> void find(const Eos& eos, std::index_sequence<k...>) {
        const bool found = (take<std::tuple_element_t<k, EosLaws>>(eos, static_cast<int>(k)) || ...);
        if (!found) throw InputError("equation of state \"" + eos.law() + "\" is not in EosLaws (laws/laws.h)");
    }
    template <class Law> bool take(const Eos& eos, int kind) {
        static_assert(sizeof(Law) <= sizeof(law_) && std::is_trivially_copyable_v<Law>, "make room in AnyEos");
        if (eos.law() != Law::name) return false;
        std::memcpy(law_, eos.object(), sizeof(Law));
        kind_ = kind;
        return true;
    }
    template <std::size_t k, class V> BRISANCE_HD EosTerms<V> terms(V mu) const {
        using Law = std::tuple_element_t<k, EosLaws>;
        if constexpr (k + 1 < std::tuple_size_v<EosLaws>)
            if (kind_ != static_cast<int>(k)) return terms<k + 1>(mu);
        return reinterpret_cast<const Law*>(law_)->terms(mu);
    }
    alignas(8) unsigned char law_[80] = {};
    int kind_ = 0;
};

/// Of the processor.
struct ErasedLaws {
    const Eos* eos;
    const Strength* strength;  ///< null: a fluid
    double floor;              ///< GPa, least pressure

    explicit ErasedLaws(const Material& m) : eos(m.eos.get()), strength(m.strength.get()), floor(std::max(m.eos->pressure_floor(), -1e6)) {}
    template <class V> EosTerms<V> terms(V mu) const {
        if constexpr (std::is_same_v<V, double>) {
            return eos->terms(mu);
        } else {
            EosTerms<V> t;
            alignas(64) ScalarOf<V> x[lanes_of<V>];
            store(x, mu);
            eos->terms(x, t);
            return t;
        }
    }
    template <class V> void update(SolidPoint<V>& p) const {
        if (!strength) return;
        if constexpr (std::is_same_v<V, double>) strength->update(p);
        else strength->update_pack(p);
    }
};

/// A fluid has none.
struct NoStrength {
    template <class V> BRISANCE_HD void update(SolidPoint<V>&) const {}
};
/// Of a device.
template <class Law>
struct TypedLaws {
    AnyEos eos;
    Law strength;
    double floor;

    TypedLaws(const Material& m, const Law& law) : eos(*m.eos), strength(law), floor(std::max(m.eos->pressure_floor(), -1e6)) {}
    template <class V> BRISANCE_HD EosTerms<V> terms(V mu) const { return eos.terms(mu); }
    template <class V> BRISANCE_HD void update(SolidPoint<V>& p) const { strength.update(p); }
};

namespace detail {
template <class Result, class F, std::size_t... k> Result with_typed_laws(const Material& m, F&& f, std::index_sequence<k...>) {
    Result result{};
    const auto take = [&](const auto* law) {
        using Law = std::remove_cvref_t<decltype(*law)>;
        if (m.strength->law() != Law::name) return false;
        result = f(TypedLaws<Law>(m, *static_cast<const Law*>(m.strength->object())));
        return true;
    };
    if (!(take(static_cast<const std::tuple_element_t<k, StrengthLaws>*>(nullptr)) || ...))
        throw InputError("strength law \"" + m.strength->law() + "\" is not in StrengthLaws (laws/laws.h)");
    return result;
}
}  // namespace detail

/// f(laws), a Result, with the laws of a solid in the form that kernels of this build take.
template <class Result, class F> Result with_laws(const Material& m, F&& f) {
    if constexpr (exec::typed) return detail::with_typed_laws<Result>(m, f, std::make_index_sequence<std::tuple_size_v<StrengthLaws>>{});
    else return f(ErasedLaws(m));
}
/// The same for a fluid, of which the equation of state is wanted.
template <class F> void with_eos(const Material& m, F&& f) {
    if constexpr (exec::typed) f(TypedLaws<NoStrength>(m, {}));
    else f(ErasedLaws(m));
}

}  // namespace brisance
