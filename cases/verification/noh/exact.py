# SPDX-License-Identifier: Apache-2.0
"""Noh (1987), cylindrical, gamma = 5/3: a shock at r = t/3; behind it rho = 16, P = 16/3, e = 1/2, at rest; before it rho = 1 + t/r."""

import numpy as np

from brisance.verification import bins, front, norm, relative, scaled


def density(r, t):
    return np.where(r < t / 3, 16.0, 1 + t / np.maximum(r, 1e-9))


def measure(shot):
    s = shot.snapshot()
    t = s.time
    r = np.hypot(s["x"][:, 0], s["x"][:, 1])
    inside = (r > 0.6) & (r < t / 3 - 0.5)     # off the heated axis and the shock
    before = (r > t / 3 + 0.6) & (r < 3.6)
    middle, v = bins(r, np.arange(0, 4, 0.15), np.hypot(s["velocity"][:, 0], s["velocity"][:, 1]))
    return {"density_behind": relative(s["density"][inside].mean(), 16), "pressure_behind": relative(s["pressure"][inside].mean(), 16 / 3),
            "density_before": norm(s["density"][before] / density(r[before], t), 1, 1),
            "shock_radius": scaled(front(middle, v, 0.5, falling=False), t / 3, t / 3),
            "energy": scaled(shot.audit["residual_relative"][-1], 0, 1)}


def figure(shots, path):
    from brisance.style import plt, run_colour, subplots
    fig, axes = subplots(1, 3, size=(11, 3.4))
    fine = np.linspace(0.01, 4, 800)
    for k, shot in enumerate(shots):
        s = shot.snapshot()
        r = np.hypot(s["x"][:, 0], s["x"][:, 1])
        axes[0, 0].plot(r, s["density"], ".", ms=1.5, color=run_colour(k), label=f"{shot.spacing:g} mm")
        axes[0, 1].plot(r, np.hypot(s["velocity"][:, 0], s["velocity"][:, 1]), ".", ms=1.5, color=run_colour(k))
    axes[0, 0].plot(fine, density(fine, s.time), color="#222222", lw=0.8, label="exact")
    axes[0, 1].plot(fine, fine > s.time / 3, color="#222222", lw=0.8)
    axes[0, 0].set(xlabel="r [mm]", title=f"density [g/cm³], {s.time:g} µs", xlim=(0, 4.5), ylim=(0, 24))
    axes[0, 1].set(xlabel="r [mm]", title="speed [km/s]", xlim=(0, 4.5))
    axes[0, 0].legend(markerscale=4)
    dots = axes[0, 2].scatter(s["x"][:, 0], s["x"][:, 1], c=s["density"], s=1.5, cmap="viridis")
    fig.colorbar(dots, ax=axes[0, 2])
    axes[0, 2].set(aspect="equal", title="density")
    fig.savefig(path, dpi=110)
    plt.close(fig)
