# SPDX-License-Identifier: Apache-2.0
"""Impedance matching: the pressure and velocity that both sides share, from their Hugoniots."""

import numpy as np

from brisance.exact.hugoniot import Linear, impact
from brisance.verification import number, relative, scaled

MATERIALS = {"copper": Linear(8.96, 3.94, 1.489), "water": Linear(1.0, 1.483, 1.75), "granite": Linear(2.66, np.sqrt((25.7 + 4 * 21.9 / 3) / 2.66), 0.0)}


def sides(shot):
    part = shot.case["part"]
    return part["left"]["material"], part["right"]["material"], number(part["left"]["velocity"][0])


def stress(s):
    return -s["stress"][:, 0]


def plateau(shot, part, u):
    """Particles on the middle line behind the wave and off the face, which heats."""
    a, b, v = sides(shot)
    s = shot.snapshot().part(part)
    material, push = (MATERIALS[a], v - u) if part == "left" else (MATERIALS[b], u)
    depth = material.speed(push) * s.time           # in the material's own coordinate
    X = np.abs(s["X"][:, 0])
    return s.where((np.abs(s["X"][:, 1]) < 0.35) & (X > 0.3) & (X < max(0.7 * depth, 0.55)))


def measure(shot):
    a, b, v = sides(shot)
    P, u = impact(MATERIALS[a], MATERIALS[b], v)
    key = f"{a}_on_{b}"
    both = [plateau(shot, name, u) for name in ("left", "right")]
    have_p = np.mean([stress(s).mean() for s in both])
    have_u = np.mean([s["velocity"][:, 0].mean() for s in both])
    return {f"pressure_{key}": relative(have_p, P), f"velocity_{key}": scaled(have_u, u, v)}


def figure(shots, path):
    from brisance.style import plt, run_colour, subplots
    fig, axes = subplots(2, 3, size=(11, 5.6))
    for ax, shot in zip(axes.flat, shots):
        a, b, v = sides(shot)
        P, u = impact(MATERIALS[a], MATERIALS[b], v)
        for k, name in enumerate(("left", "right")):
            s = shot.snapshot().part(name)
            line = np.abs(s["X"][:, 1]) < 0.35
            ax.plot(s["x"][line, 0], stress(s)[line] / P, ".", ms=2, color=run_colour(k))
        t = s.time
        left, right = -MATERIALS[a].speed(v - u) * t + v * t, MATERIALS[b].speed(u) * t
        ax.plot([-4, left, left, right, right, 4], [0, 0, 1, 1, 0, 0], color="#222222", lw=0.8)
        ax.set(title=f"{a} on {b}, {1e3 * v:.0f} m/s: {1e3 * P:.4g} MPa", xlabel="x [mm]", xlim=(-3.5, 3.5))
    axes[0, 0].set_ylabel("−σ$_x$ over the exact pressure")
    fig.savefig(path, dpi=110)
    plt.close(fig)
