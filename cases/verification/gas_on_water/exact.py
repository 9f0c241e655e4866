# SPDX-License-Identifier: Apache-2.0
"""A Riemann problem of two materials: a rarefaction into the gas, a weak shock into the water, one pressure and velocity between."""

import numpy as np

from brisance.exact.hugoniot import Gas, Linear, impact
from brisance.verification import front, relative, scaled

GAS, WATER = Gas(0.001, 0.1, 1.4), Linear(1.0, 1.483, 1.75)
P, U = impact(GAS, WATER, 0.0)


def measure(shot):
    late = shot.snapshot(-1)
    w, g, t = late.part("water"), late.part("gas"), late.time
    X = w["X"][:, 0]
    behind = (X > 0.4) & (X < 0.75 * WATER.speed(U) * t)
    near = g["X"][:, 0] > -4
    return {"pressure_in_water": relative(w["pressure"][behind].mean(), P), "velocity_in_water": relative(w["velocity"][behind, 0].mean(), U),
            "pressure_in_gas": relative(g["pressure"][near].mean(), P),
            "shock_in_water": scaled(front(X, w["pressure"], 0.5 * P), WATER.speed(U) * t, WATER.speed(U) * t),
            "gap": scaled((w["x"][:, 0].min() - g["x"][:, 0].max()) / shot.spacing, 1.0, 1.0),
            "energy": scaled(shot.audit["residual"][-1], 0, 0.25 * 10 * 0.16)}


def figure(shots, path):
    from brisance.style import plt, run_colour, subplots
    fig, axes = subplots(1, 2, size=(9.5, 3.4))
    s = shots[-1].snapshot(-1)
    for k, name in enumerate(("gas", "water")):
        p = s.part(name)
        axes[0, 0].plot(p["x"][:, 0], 1e3 * p["pressure"], ".", ms=2, color=run_colour(k), label=name)
        axes[0, 1].plot(p["x"][:, 0], 1e3 * p["velocity"][:, 0], ".", ms=2, color=run_colour(k))
    x = WATER.speed(U) * s.time
    axes[0, 0].plot([-10, x, x, 4], [1e3 * P, 1e3 * P, 0, 0], color="#222222", lw=0.8, label="exact")
    axes[0, 1].plot([0, x, x, 4], [1e3 * U, 1e3 * U, 0, 0], color="#222222", lw=0.8)
    axes[0, 0].set(xlabel="x [mm]", title=f"pressure [MPa], {s.time:g} µs")
    axes[0, 1].set(xlabel="x [mm]", title="velocity [m/s]", ylim=(-20, 150))
    axes[0, 0].legend(markerscale=3)
    fig.savefig(path, dpi=110)
    plt.close(fig)
