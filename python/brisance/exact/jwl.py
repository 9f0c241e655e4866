# SPDX-License-Identifier: Apache-2.0
"""Detonation products after Jones, Wilkins and Lee: isentropes, the CJ state, plane simple waves. Units GPa, g/cm3, km/s; V = rho0/rho."""

from dataclasses import dataclass

import numpy as np
from scipy.integrate import cumulative_trapezoid, solve_ivp
from scipy.optimize import minimize_scalar


@dataclass
class Jwl:
    A: float
    B: float
    R1: float
    R2: float
    omega: float
    E0: float       # GPa, per initial volume
    density: float

    def pressure(self, V, E):
        return (self.A * (1 - self.omega / (self.R1 * V)) * np.exp(-self.R1 * V) + self.B * (1 - self.omega / (self.R2 * V)) * np.exp(-self.R2 * V)
                + self.omega * E / V)

    def isentrope(self, V0, E0, V):
        """P and E along the isentrope through (V0, E0), by integration of dE = -P dV. V ascending or descending from V0."""
        line = solve_ivp(lambda v, e: -self.pressure(v, e), (V0, V[-1]), [E0], t_eval=V, rtol=1e-10, atol=1e-12)
        return self.pressure(V, line.y[0]), line.y[0]

    def hugoniot(self, V):
        """P of complete reaction from the unreacted state at P = 0: E = E0 + P (1 - V)/2."""
        a = self.pressure(V, 0.0)
        k = self.omega / V
        return (a + k * self.E0) / (1 - 0.5 * k * (1 - V))

    def chapman_jouguet(self):
        """V, P, D, u, c where the Rayleigh line touches the Hugoniot: the least D."""
        V = minimize_scalar(lambda v: self.hugoniot(v) / (1 - v), bounds=(0.5, 0.95), method="bounded", options={"xatol": 1e-12}).x
        P = self.hugoniot(V)
        D = np.sqrt(P / (self.density * (1 - V)))
        return V, P, D, D * (1 - V), D * V

    def taylor_wave(self, points=4000):
        """x/t, u, P, V behind a plane front from a rigid wall, from the CJ state down to rest: u + c = x/t, du = c d ln rho on the isentrope."""
        V0, P0, D, u0, _ = self.chapman_jouguet()
        V = V0 * np.exp(np.linspace(0, 1.5, points))
        P, E = self.isentrope(V0, self.E0 + 0.5 * P0 * (1 - V0), V)
        c = np.sqrt(np.maximum(-np.gradient(P, V, edge_order=2) * V**2 / self.density, 1e-12))
        u = u0 - cumulative_trapezoid(c, np.log(V), initial=0)
        keep = u >= 0
        last = int(np.argmin(keep)) + 1 if not keep.all() else points
        return (u + c)[:last], u[:last], P[:last], V[:last]

    def release(self, points=4000, largest=60):
        """x/t, u, P, V of products at rest with V = 1, E = E0 that expand into a vacuum at x > 0: u - c = x/t."""
        V = np.exp(np.linspace(0, np.log(largest), points))
        P, E = self.isentrope(1.0, self.E0, V)
        c = np.sqrt(np.maximum(-np.gradient(P, V, edge_order=2) * V**2 / self.density, 1e-12))
        u = cumulative_trapezoid(c, np.log(V), initial=0)
        return u - c, u, P, V


TNT = Jwl(371.21, 3.2306, 4.15, 0.95, 0.30, 7.0, 1.63)
PETN_1770 = Jwl(617, 16.926, 4.4, 1.2, 0.25, 10.1, 1.77)
