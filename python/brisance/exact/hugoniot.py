# SPDX-License-Identifier: Apache-2.0
"""Plane shocks and expansions of condensed materials with U_s = C + S u_p, of elastic solids and of gases: velocities and pressures where two of them meet.

A material here is something with `pressure(u)`: the pressure [GPa] on its face when that face is pushed into it at u [km/s] faster than it moves.
"""

import numpy as np
from scipy.optimize import brentq


class Linear:
    """Density [g/cm3], C [km/s], S: the Hugoniot P = rho0 (C + S u) u; S = 0 is an elastic solid or an acoustic fluid, and gives tension too."""

    def __init__(self, density, c, s):
        self.density, self.c, self.s = density, c, s

    def speed(self, u):
        return self.c + self.s * u

    def pressure(self, u):
        return self.density * self.speed(max(u, 0)) * u

    def density_behind(self, u):
        return self.density * self.speed(u) / (self.speed(u) - u)


class Gas:
    """An ideal gas at rest with a pressure of its own: shock when pushed, isentropic expansion when it follows."""

    def __init__(self, density, p0, gamma):
        self.density, self.p0, self.gamma = density, p0, gamma
        self.c = np.sqrt(gamma * p0 / density)

    def pressure(self, u):
        g = self.gamma
        if u < 0:
            return self.p0 * max(1 + (g - 1) / 2 * u / self.c, 0) ** (2 * g / (g - 1))
        b = (g + 1) / 4 * u / self.c
        return self.p0 * (1 + g * u / self.c * (b + np.sqrt(b * b + 1)))


def impact(left, right, v):
    """Pressure and velocity of the interface after `left`, moving at v, has met `right`, at rest."""
    u = brentq(lambda u: left.pressure(v - u) - right.pressure(u), -50, 50, xtol=1e-13)
    return right.pressure(u), u
