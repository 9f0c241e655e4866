# SPDX-License-Identifier: Apache-2.0
"""Sedov (1959), cylindrical, gamma = 1.4: R = (E t^2/(alpha rho))^(1/4) with alpha = 0.984074; behind the shock rho = 6, u = R'/1.2, P = rho R'^2/1.2."""

import numpy as np

from brisance.verification import bins, relative, scaled

ALPHA, E, RHO, GAMMA = 0.984074, 1.0, 1.0, 1.4


def radius(t):
    return (E * t**2 / (ALPHA * RHO)) ** 0.25


def profile(s):
    r = np.hypot(s["x"][:, 0], s["x"][:, 1])
    return bins(r, np.arange(0, 8, 0.1), s["density"], s["pressure"])


def shock(s):
    """Where the density, means over rings, passes half its peak above 1 from outside."""
    r, rho, _ = profile(s)
    level = 1 + 0.5 * (rho.max() - 1)
    k = np.flatnonzero(rho > level)[-1]
    return r[k] + (r[k + 1] - r[k]) * (rho[k] - level) / (rho[k] - rho[k + 1]), rho.max()


def measure(shot):
    early, late = shot.snapshot(0), shot.snapshot(-1)
    (r1, _), (r2, peak) = shock(early), shock(late)
    r = np.hypot(late["x"][:, 0], late["x"][:, 1])
    return {"shock_radius_16": scaled(r1, radius(early.time), radius(early.time)), "shock_radius_36": scaled(r2, radius(late.time), radius(late.time)),
            "peak_density": relative(peak, (GAMMA + 1) / (GAMMA - 1)),
            "energy": scaled(shot.audit["residual"][-1], 0, 0.25 * E * 4 * shot.spacing)}


def figure(shots, path):
    from brisance.style import plt, run_colour, subplots
    fig, axes = subplots(1, 2, size=(9.5, 3.6))
    for k, shot in enumerate(shots):
        s = shot.snapshot(-1)
        r, rho, p = profile(s)
        axes[0, 0].plot(r, rho, ".-", ms=3, lw=0.6, color=run_colour(k), label=f"{shot.spacing:g} mm")
    axes[0, 0].axvline(radius(s.time), color="#222222", lw=0.8, label="exact radius")
    axes[0, 0].axhline(6, color="#777777", lw=0.8, ls=":")
    axes[0, 0].legend()
    axes[0, 0].set(xlabel="r [mm]", title=f"density [g/cm³], {s.time:g} µs (dotted: exact peak)")
    dots = axes[0, 1].scatter(s["x"][:, 0], s["x"][:, 1], c=s["density"], s=2, cmap="viridis")
    fig.colorbar(dots, ax=axes[0, 1])
    axes[0, 1].set(aspect="equal", title="density")
    fig.savefig(path, dpi=110)
    plt.close(fig)
