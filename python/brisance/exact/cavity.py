# SPDX-License-Identifier: Apache-2.0
"""A pressurised cylindrical cavity in an unbounded elastic solid, plane strain (Selberg 1952): Laplace transforms, inverted numerically.

    phi = A K0(s r/c_p),  A = -p/[rho s^2 K0(s a/c_p) + (2 mu s/(c_p a)) K1(s a/c_p)],  u = -A (s/c_p) K1(s r/c_p)
    sigma_r = rho s^2 phi - 2 mu u/r,  sigma_theta = lambda/(lambda + 2 mu) rho s^2 phi + 2 mu u/r

The load is linear between its points, so a response is a sum of responses to ramps, which are smooth enough for Talbot's contour.
"""

import numpy as np
from scipy.special import kve


def talbot(transform, t, terms=32):
    """Inverse Laplace transform at times t > 0 (Abate & Valko 2004, fixed Talbot); `transform` takes complex arrays."""
    t = np.atleast_1d(np.asarray(t, dtype=float))
    theta = np.arange(1, terms) * np.pi / terms
    cot = 1 / np.tan(theta)
    delta = np.concatenate([[2 * terms / 5], 2 * np.pi * np.arange(1, terms) / 5 * (cot + 1j)])
    gamma = np.concatenate([[0.5 * np.exp(delta[0])], (1 + 1j * theta * (1 + cot**2) - 1j * cot) * np.exp(delta[1:])])
    return 0.4 / t * np.real((gamma * transform(delta[None, :] / t[:, None])).sum(axis=1))


class Cavity:
    """Radius a [mm], rho [g/cm3], lambda and mu [GPa]; a load by times [us] and values [GPa], linear between, zero before."""

    def __init__(self, a, rho, lam, mu, times, values):
        self.a, self.rho, self.lam, self.mu = a, rho, lam, mu
        self.c = np.sqrt((lam + 2 * mu) / rho)
        self.times, self.values = np.asarray(times, float), np.asarray(values, float)

    def _ramp(self, r, t):
        """u, sigma_r, sigma_theta, du/dt at r for a load that grows by 1 GPa/us from t = 0. Times from the arrival of the wave on."""
        c, a, rho, mu, lam = self.c, self.a, self.rho, self.mu, self.lam
        late = t - (r - a) / c
        here = late > 1e-9

        def parts(s):
            scale = 1 / s**2  # the ramp; exp(-s (r-a)/c) is the delay, taken out of the Bessel functions by kve
            bottom = rho * s**2 * kve(0, s * a / c) + 2 * mu * s / (c * a) * kve(1, s * a / c)
            amplitude = -scale / bottom
            u = -amplitude * s / c * kve(1, s * r / c)
            phi = amplitude * kve(0, s * r / c)
            return u, rho * s**2 * phi - 2 * mu * u / r, lam / (lam + 2 * mu) * rho * s**2 * phi + 2 * mu * u / r, s * u

        out = np.zeros((4, len(t)))
        if here.any():
            for k in range(4):
                out[k, here] = talbot(lambda s, k=k: parts(s)[k], late[here])
        return out

    def __call__(self, r, t):
        """u [mm], sigma_r, sigma_theta [GPa], v [km/s] at radius r and times t."""
        t = np.atleast_1d(np.asarray(t, float))
        slopes = np.concatenate([[0], np.diff(self.values) / np.diff(self.times), [0]])
        total = np.zeros((4, len(t)))
        for time, change in zip(self.times, np.diff(slopes)):
            total += change * self._ramp(r, t - time)
        return total
