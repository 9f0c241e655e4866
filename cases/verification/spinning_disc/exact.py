# SPDX-License-Identifier: Apache-2.0
"""A rotating elastic disc in plane strain: sigma_r = sigma_theta = (3 - 2 nu)/(8 (1 - nu)) rho omega^2 R^2 in its middle."""

import numpy as np

from brisance.verification import relative, scaled

RHO, K, G, R, OMEGA = 2.66, 25.7, 21.9, 20.0, 0.02
NU = (3 * K - 2 * G) / (2 * (3 * K + G))
STRESS = (3 - 2 * NU) / (8 * (1 - NU)) * RHO * OMEGA**2 * R**2
STRETCH = (1 - 2 * NU) * (1 + NU) / (2 * G * (1 + NU)) / (4 * (1 - NU)) * RHO * OMEGA**2 * R**2  # u(R)/R at rest in the rotating frame


def momentum(s):
    """sum (x cross v) size^2, with x half a step late: x and v stand at different times, so v is turned with the body first."""
    x, v = s["x"], s["velocity"]
    return float(((x[:, 0] * v[:, 1] - x[:, 1] * v[:, 0]) * s["size"] ** 2).sum())


def angle(s):
    """The rotation that fits the displaced places best, in turns of 0 ... 2 pi."""
    X, x = s["X"][:, :2], s["x"][:, :2]
    a = (X[:, 0] * x[:, 1] - X[:, 1] * x[:, 0]).sum()
    b = (X * x).sum()
    return np.arctan2(a, b)


def turned(shot):
    """Angle at the end, and the mean distance of every particle from where a rigid turn by that angle takes it."""
    s = shot.snapshot(-1)
    phi = angle(s)
    X = s["X"][:, :2]
    rigid = np.column_stack([np.cos(phi) * X[:, 0] - np.sin(phi) * X[:, 1], np.sin(phi) * X[:, 0] + np.cos(phi) * X[:, 1]])
    return s, phi, np.hypot(*(s["x"][:, :2] - rigid).T)


def measure(shot):
    s, phi, off = turned(shot)
    start = shot.snapshot(0)
    g = shot.gauge("centre")
    late = g["t"] > 60
    mean = 0.5 * (g["sigma_1"] + g["sigma_2"])[late].mean()
    dt = 2 * shot.half_step(s.time)
    return {"angular_momentum": scaled(momentum(s), momentum(start), momentum(start)),
            "energy": scaled(shot.audit["residual_relative"][-1], 0, 1),
            "centre_stress": relative(mean, STRESS),
            "difference_of_principal_stresses": scaled((g["sigma_1"] - g["sigma_2"])[late].mean(), 0, STRESS),
            "shape": scaled(off.mean() / R, 0, 1)}


def figure(shots, path):
    from brisance.style import plt, run_colour, subplots
    fig, axes = subplots(1, 2, size=(10, 3.8))
    for k, shot in enumerate(shots):
        g = shot.gauge("centre")
        axes[0, 0].plot(g["t"], 5e2 * (g["sigma_1"] + g["sigma_2"]), color=run_colour(k), lw=0.7, label=f"{shot.spacing:g} mm")
    axes[0, 0].axhline(1e3 * STRESS, color="#222222", lw=0.8, label="exact mean")
    axes[0, 0].set(xlabel="t [µs]", title="(σ$_1$ + σ$_2$)/2 in the middle [MPa]")
    axes[0, 0].legend()
    s, phi, off = turned(shots[-1])
    dots = axes[0, 1].scatter(s["x"][:, 0], s["x"][:, 1], c=1e3 * off, s=2, cmap="viridis")
    fig.colorbar(dots, ax=axes[0, 1])
    axes[0, 1].set(aspect="equal", title="distance from a rigid turn [µm], after 360°")
    fig.savefig(path, dpi=110)
    plt.close(fig)
