# SPDX-License-Identifier: Apache-2.0
"""Selberg's solution for the load of the case."""

import numpy as np

from brisance.exact.cavity import Cavity
from brisance.verification import norm, scaled

A, RHO, K, G, P0 = 3.225, 2.66, 25.7, 21.9, 0.1
CAVITY = Cavity(A, RHO, K - 2 * G / 3, G, [0, 1, 3, 6, 9], [0, 0.1, 0.06, 0.03, 0.02])


def polar(s):
    """r (reference), u_r, sigma_r, sigma_theta of all particles."""
    x, y = s["X"][:, 0], s["X"][:, 1]
    r = np.hypot(x, y)
    c, n = x / r, y / r
    xx, yy, _, xy, _, _ = s["stress"].T
    u = s["displacement"]
    return r, u[:, 0] * c + u[:, 1] * n, xx * c * c + yy * n * n + 2 * xy * c * n, xx * n * n + yy * c * c - 2 * xy * c * n


def profile(r, t):
    """The exact fields at radii r and one time: by interpolation on a fine grid of radii."""
    grid = np.linspace(A, 40, 600)
    exact = np.array([CAVITY(x, [t])[:, 0] for x in grid])
    return [np.interp(r, grid, exact[:, k]) for k in range(3)]


def measure(shot):
    found = {}
    for t in (5, 8):
        s = shot.at(t)
        r, *have = polar(s)
        inside = r < 36
        want = profile(r[inside], s.time)
        for name, h, w, size in zip(("displacement", "radial_stress", "hoop_stress"), have, want, (P0 * A / (2 * G), P0, P0)):
            found[f"{name}_{t:.0f}_us"] = norm(h[inside], w, size)
    # largest hoop tension at two radii of the hole, over all directions
    s = shot.at(5)
    r, _, _, hoop = polar(s)
    ring = abs(r - 2 * A) < 0.5
    found["hoop_at_2a"] = scaled(hoop[ring].mean(), profile(r[ring], s.time)[2].mean(), P0)
    found["scatter_at_2a"] = scaled((hoop[ring] - profile(r[ring], s.time)[2]).std(), 0, P0)
    return found


def figure(shots, path):
    from brisance.style import plt, run_colour, subplots
    fig, axes = subplots(1, 3, size=(12, 3.6))
    grid = np.linspace(A, 40, 400)
    for ax, which, name, factor in zip(axes[0], range(3), ("u$_r$ [µm]", "σ$_r$ [MPa]", "σ$_θ$ [MPa]"), (1e3, 1e3, 1e3)):
        for t in shots[-1].times:
            s = shots[-1].at(t)
            r, *have = polar(s)
            some = np.argsort(r)[:: max(1, len(r) // 4000)]
            ax.plot(r[some], factor * have[which][some], ".", ms=1.5, color=run_colour(shots[-1].times.index(t)), label=f"{t:.0f} µs")
            ax.plot(grid, factor * profile(grid, s.time)[which], color="#222222", lw=0.8)
        ax.set_title(f"{name}, spacing {shots[-1].spacing:g} mm at the wall; line: exact")
        ax.set_xlabel("r [mm]")
    axes[0, 0].legend(markerscale=5)
    fig.savefig(path, dpi=110)
    plt.close(fig)
