# SPDX-License-Identifier: Apache-2.0
"""Hondros (1959): a disc pressed by p on two arcs of half-angle alpha; along the loaded diameter, tension positive:

sigma_x, sigma_y = +-(2 p/pi) { (1 - q^2) sin 2a/(1 - 2 q^2 cos 2a + q^4) -+ atan[ (1 + q^2)/(1 - q^2) tan a ] }, q = r/R.
"""

import numpy as np

from brisance.verification import norm, relative, scaled

R, A, RATE, STRENGTH = 25.0, np.radians(10), 1e-3, 0.010   # mm, rad, GPa/us, GPa


def hondros(q, p):
    first = (1 - q**2) * np.sin(2 * A) / (1 - 2 * q**2 * np.cos(2 * A) + q**4)
    second = np.arctan((1 + q**2) / (1 - q**2) * np.tan(A))
    return 2 * p / np.pi * (first - second), -2 * p / np.pi * (first + second)


FAILS_AT = STRENGTH / hondros(0.0, 1.0)[0]   # GPa


def measure(shot):
    s = shot.at(70)
    p = RATE * s.time
    on_axis = (np.abs(s["X"][:, 0]) < 0.75 * shot.spacing) & (np.abs(s["X"][:, 1]) < 0.7 * R)
    q = np.abs(s["X"][on_axis, 1]) / R
    sx, sy = hondros(q, p)
    end = shot.snapshot(-1)
    failed = end["failure_time"] >= 0
    inside = failed & (np.hypot(end["X"][:, 0], end["X"][:, 1]) < 0.85 * R)
    first = end["failure_time"][inside].min() if inside.any() else np.nan
    early = inside & (end["failure_time"] < first + 1.0)
    return {"tension_on_the_diameter": norm(s["stress"][on_axis, 0], sx, p),
            "compression_on_the_diameter": norm(s["stress"][on_axis, 1], sy, p),
            "centre_tension": relative(s["stress"][on_axis & (np.abs(s["X"][:, 1]) < 2), 0].mean(), hondros(0.0, p)[0]),
            "indirect_strength": relative(RATE * first * hondros(0.0, 1.0)[0], STRENGTH),
            "crack_off_the_diameter": scaled(np.abs(end["X"][early, 0]).mean(), 0, R)}


def figure(shots, path):
    from brisance.style import plt, run_colour, subplots
    fig, axes = subplots(1, 2, size=(9.5, 4))
    q = np.linspace(0, 0.95, 200)
    for k, shot in enumerate(shots):
        s = shot.at(70)
        axis = np.abs(s["X"][:, 0]) < 0.75 * shot.spacing
        axes[0, 0].plot(s["X"][axis, 1] / R, 1e3 * s["stress"][axis, 0], ".", ms=3, color=run_colour(k), label=f"{shot.spacing:g} mm")
        axes[0, 0].plot(s["X"][axis, 1] / R, 1e3 * s["stress"][axis, 1], ".", ms=3, color=run_colour(k))
    for which in (0, 1):
        for sign in (1, -1):
            axes[0, 0].plot(sign * q, 1e3 * hondros(q, RATE * s.time)[which], color="#222222", lw=0.8, label="exact" if which + sign == 1 else None)
    axes[0, 0].set(xlabel="y/R", title=f"σ$_x$ (tension) and σ$_y$ [MPa] at {1e3 * RATE * s.time:.0f} MPa of load")
    axes[0, 0].legend()
    end = shots[-1].snapshot(-1)
    failed = end["failure_time"] >= 0
    axes[0, 1].plot(end["X"][~failed, 0], end["X"][~failed, 1], ".", ms=1.2, color="#dcdbd6")
    dots = axes[0, 1].scatter(end["X"][failed, 0], end["X"][failed, 1], c=end["failure_time"][failed], s=4, cmap="viridis")
    fig.colorbar(dots, ax=axes[0, 1])
    axes[0, 1].set(aspect="equal", title="failed particles, time of failure [µs]")
    fig.savefig(path, dpi=110)
    plt.close(fig)
