# SPDX-License-Identifier: Apache-2.0
"""One step of an even velocity gradient: the strain is the same everywhere, and Hooke's stress with it."""

import numpy as np

from brisance.verification import norm, scaled

L = 1e-4 * np.array([[1.0, 0.3, -0.2], [0.5, -0.7, 0.4], [0.1, -0.6, 0.8]])   # 1/us
K, G = 25.7, 21.9


def measure(shot):
    s = shot.snapshot(-1)
    strain = 0.5 * (L + L.T) * s.time
    want = 2 * G * strain + (K - 2 * G / 3) * np.trace(strain) * np.eye(3)
    have = s["stress"]   # xx yy zz xy yz xz
    want = np.array([want[0, 0], want[1, 1], want[2, 2], want[0, 1], want[1, 2], want[0, 2]])
    size = np.abs(want).max()
    error = np.abs(have - want).max(axis=1) / size
    X = s["X"]
    free = (np.hypot(X[:, 0], X[:, 1]) > 8) | (X[:, 2] < 0.8) | (X[:, 2] > 6.2) | (np.linalg.norm(X - [4, 0, 3], axis=1) < 3.2)
    return {"stress_inside": scaled(error[~free].max(), 0, 1), "stress_at_free_faces": scaled(error[free].max(), 0, 1),
            "displacement": norm(s["displacement"], X @ L.T * s.time, np.abs(X @ L.T).max() * s.time)}


def figure(shots, path):
    from brisance.style import plt, run_colour, subplots
    fig, axes = subplots(1, 2, size=(9.5, 4.2))
    s = shots[-1].snapshot(-1)
    layer = abs(s["X"][:, 2] - 3) < 0.36
    dots = axes[0, 0].scatter(s["X"][layer, 0], s["X"][layer, 1], c=1e6 * s["stress"][layer, 0], s=12, lw=0)
    axes[0, 0].set(aspect="equal", title="σ$_{xx}$ [kPa] in the layer of the cavity")
    fig.colorbar(dots, ax=axes[0, 0])
    for k, name in enumerate(("xx", "yy", "zz", "xy", "yz", "xz")):
        axes[0, 1].plot(s["stress"][:, k] / s["stress"][:, k].mean() - 1, ".", ms=1, color=run_colour(k % 4), label=name)
    axes[0, 1].set(title="each component over its mean, less 1", xlabel="particle")
    axes[0, 1].legend(markerscale=8)
    fig.savefig(path, dpi=110)
    plt.close(fig)
