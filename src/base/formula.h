// SPDX-License-Identifier: Apache-2.0
// Formulas in a case file: "10 m/s * exp(-((x - 25 mm)/1.5 mm)^2)". Numbers carry units, and the dimensions are checked when the formula is read.
#pragma once

#include "base/units.h"

#include <string>
#include <string_view>
#include <vector>

namespace brisance {

/// A function of a place. The variables are x, y, z (lengths); pi is known; the operators are + - * / ^ and brackets; the functions
/// sqrt exp log sin cos tan atan2 sinh cosh tanh abs min max hypot besselj0 besselj1, and step(a), which is 1 where a >= 0 and 0 elsewhere.
class Formula {
public:
    /// Throws std::invalid_argument, with a text for the user, on what is no formula, or has another dimension than `wanted`.
    Formula(std::string_view text, Dimension wanted);

    /// Its value at x, y, z [mm], in internal units.
    double operator()(double x, double y, double z) const;

    struct Step {
        int what = 0;      ///< an operation on the top of the stack (formula.cpp)
        double value = 0;  ///< of a constant
    };

private:
    std::vector<Step> steps_;  ///< in the order of evaluation
};

}  // namespace brisance
