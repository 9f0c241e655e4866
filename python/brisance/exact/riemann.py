# SPDX-License-Identifier: Apache-2.0
"""Exact solution of the Riemann problem of an ideal gas (Toro, Riemann Solvers and Numerical Methods for Fluid Dynamics, ch. 4)."""

import numpy as np
from scipy.optimize import brentq


class Riemann:
    """States (rho, u, P) left and right of x = 0 at t = 0. Attributes p, u: between the outer waves."""

    def __init__(self, left, right, gamma):
        self.left, self.right, self.gamma = left, right, gamma

        def speed(p, state):
            """What the wave into a state adds to the velocity."""
            rho, _, p0 = state
            if p > p0:
                return (p - p0) * np.sqrt(2 / (rho * ((gamma + 1) * p + (gamma - 1) * p0)))
            return 2 * np.sqrt(gamma * p0 / rho) / (gamma - 1) * ((p / p0) ** ((gamma - 1) / (2 * gamma)) - 1)

        difference = right[1] - left[1]
        top = 10 * max(left[2], right[2]) + 10 * max(left[0], right[0]) * difference**2
        self.p = brentq(lambda p: speed(p, left) + speed(p, right) + difference, 1e-14 * top, 100 * top, xtol=1e-16 * top, rtol=1e-14)
        self.u = 0.5 * (left[1] + right[1]) + 0.5 * (speed(self.p, right) - speed(self.p, left))
        self.rho_left, self.rho_right = self._density(left), self._density(right)

    def _density(self, state):
        rho, _, p0 = state
        g, ratio = self.gamma, self.p / p0
        if ratio > 1:
            return rho * (ratio + (g - 1) / (g + 1)) / (ratio * (g - 1) / (g + 1) + 1)
        return rho * ratio ** (1 / g)

    def shock(self, side):
        """Speed of the shock into a side (-1 left, 1 right); of the head of the rarefaction where there is none."""
        rho, u, p0 = self.left if side < 0 else self.right
        g, c = self.gamma, np.sqrt(self.gamma * p0 / rho)
        if self.p > p0:
            return u + side * c * np.sqrt((g + 1) / (2 * g) * self.p / p0 + (g - 1) / (2 * g))
        return u + side * c

    def __call__(self, s):
        """rho, u, P at s = x/t."""
        s = np.asarray(s, dtype=float)
        rho, u, p = np.empty_like(s), np.empty_like(s), np.empty_like(s)
        for side, state, inside in ((-1, self.left, self.rho_left), (1, self.right, self.rho_right)):
            here = (s - self.u) * side >= 0
            r0, u0, p0 = state
            g, c0 = self.gamma, np.sqrt(self.gamma * p0 / r0)
            xi = side * s
            if self.p > p0:
                outer = xi > side * self.shock(side)
                fan = np.zeros_like(outer)
            else:
                c = c0 * (self.p / p0) ** ((g - 1) / (2 * g))
                outer = xi > side * u0 + c0
                fan = ~outer & (xi > side * self.u + c)
            c_fan = 2 / (g + 1) * c0 + (g - 1) / (g + 1) * (xi - side * u0)
            for array, plain, wave, star in ((rho, r0, r0 * (np.maximum(c_fan, 0) / c0) ** (2 / (g - 1)), inside), (u, u0, s - side * c_fan, self.u),
                                             (p, p0, p0 * (np.maximum(c_fan, 0) / c0) ** (2 * g / (g - 1)), self.p)):
                array[here] = np.where(outer, plain, np.where(fan, wave, star))[here]
        return rho, u, p
