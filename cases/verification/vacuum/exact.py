# SPDX-License-Identifier: Apache-2.0
"""A centred rarefaction into a vacuum: u = 2/(gamma + 1) (c0 + x/t), c = c0 - (gamma - 1)/2 u, rho = rho0 (c/c0)^(2/(gamma - 1))."""

import numpy as np

from brisance.verification import norm, scaled

G, C0 = 1.4, 1.0


def flow(s):
    """u, rho at s = x/t"""
    s = np.clip(s, -C0, 2 * C0 / (G - 1))
    u = 2 / (G + 1) * (C0 + s)
    return u, np.maximum(1 - (G - 1) / 2 * u / C0, 0) ** (2 / (G - 1))


def mass_ahead(s):
    """The mass per area and time beyond s = x/t."""
    fine = np.linspace(s, 2 * C0 / (G - 1), 2000)
    return np.trapz(flow(fine)[1], fine)


def measure(shot):
    s = shot.snapshot()
    t, x = s.time, s["x"][:, 0]
    fan = (x > -C0 * t - 0.5) & (x < 1.5 * C0 * t)   # beyond, the exact density is below 0.002 of the first
    u = flow(x[fan] / (t - shot.half_step(t)))[0]
    _, rho = flow(x[fan] / t)
    def beyond(place):
        """Mass per area and time: the channel is 8 spacings high and deep, a particle holds one spacing cubed."""
        return (x > place * t).sum() * shot.spacing / 64 / t
    entropy = s["pressure"][fan] / s["density"][fan] ** G * G
    return {"velocity": norm(s["velocity"][fan, 0], u, C0), "density": norm(s["density"][fan], rho, 1),
            "mass_beyond_the_start": scaled(beyond(0), mass_ahead(0), mass_ahead(0)),
            "mass_beyond_twice_c": scaled(beyond(1.0), mass_ahead(1.0), mass_ahead(0)),
            "entropy": norm(entropy, 1, 1)}


def figure(shots, path):
    from brisance.style import plt, run_colour, subplots
    fig, axes = subplots(1, 3, size=(11, 3.3))
    t = shots[-1].snapshot().time
    fine = np.linspace(-6, 14, 2000)
    u, rho = flow(fine / t)
    for k, shot in enumerate(shots):
        s = shot.snapshot()
        x = s["x"][:, 0]
        for ax, y in zip(axes[0], (s["density"], s["velocity"][:, 0], s["pressure"] / s["density"] ** G * G)):
            ax.plot(x, y, ".", ms=2, color=run_colour(k), label=f"{shot.spacing:g} mm")
    for ax, y, name in zip(axes[0], (rho, u, np.ones_like(u)), ("density [g/cm³]", "velocity [km/s]", "P/ρ$^γ$ over its start")):
        ax.plot(fine, y, color="#222222", lw=0.8, label="exact")
        ax.set(title=f"{name}, {t:g} µs", xlabel="x [mm]")
    axes[0, 0].legend()
    fig.savefig(path, dpi=110)
    plt.close(fig)
