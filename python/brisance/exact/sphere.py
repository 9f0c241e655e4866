# SPDX-License-Identifier: Apache-2.0
"""A spherical cavity in an elastic body: radial waves, by the potential.

    u = d/dr (psi/r),  psi = F(t - (r - a)/c) + G(t + (r - a)/c),  c^2 = (K + 4G/3)/rho
    sigma_r = rho psi_tt/r + 4 mu (psi/r^3 - psi_r/r^2)

G is the wave that comes in. What goes out follows from sigma_r(a) = -p(t), an ordinary differential equation for F (Sharpe, Geophysics 7
(1942) 144; Blake, J. Acoust. Soc. Am. 24 (1952) 211, for G = 0), integrated here to 1e-10. Units: mm, us, GPa, g/cm3.
"""

import numpy as np
from scipy.integrate import solve_ivp


class SphericalCavity:
    def __init__(self, a, rho, K, G, pressure=lambda t: 0.0, incoming=None, outgoing=None):
        """incoming: function of time that returns G, G', G''; outgoing: the same of F before t = 0, what runs outwards at the start. None: nothing."""
        self.a, self.rho, self.mu, self.lame = a, rho, G, K - 2 * G / 3
        self.c = np.sqrt((self.lame + 2 * G) / rho)
        self.pressure = pressure
        nothing = lambda t: (0 * t, 0 * t, 0 * t)  # noqa: E731
        self.incoming, self.before = incoming or nothing, outgoing or nothing

    def solve(self, until):
        """F from rest up to a time."""
        a, mu, rho, c = self.a, self.mu, self.rho, self.c
        k1, k0 = 4 * mu / (rho * a * c), 4 * mu / (rho * a * a)

        def rates(t, f):
            g, g1, g2 = self.incoming(t)
            return [f[1], -k1 * f[1] - k0 * f[0] - (g2 - k1 * g1 + k0 * g) - a * self.pressure(t) / rho]

        self._f = solve_ivp(rates, (0, until), list(self.before(0.0)[:2]), rtol=1e-10, atol=1e-14, dense_output=True, max_step=0.01 * a / c).sol
        self._rates = rates
        return self

    def outgoing(self, t):
        """F, F', F'' at times."""
        t = np.asarray(t, dtype=float)
        later = np.maximum(t, 0)
        f = self._f(later.ravel()).reshape(2, *t.shape)
        return [np.where(t > 0, x, y) for x, y in zip((f[0], f[1], self._rates(later, f)[1]), self.before(np.minimum(t, 0)))]

    def __call__(self, r, t):
        """u mm, sigma_r, sigma_theta GPa at radii and one time (after `solve`)."""
        r = np.asarray(r, dtype=float)
        f, f1, f2 = self.outgoing(t - (r - self.a) / self.c)
        g, g1, g2 = self.incoming(t + (r - self.a) / self.c)
        psi, psi_r, psi_tt = f + g, (g1 - f1) / self.c, f2 + g2
        u = psi_r / r - psi / r**2
        radial = self.rho * psi_tt / r + 4 * self.mu * (psi / r**3 - psi_r / r**2)
        strain = (radial - 2 * self.lame * u / r) / (self.lame + 2 * self.mu)
        return u, radial, self.lame * strain + 2 * (self.lame + self.mu) * u / r
