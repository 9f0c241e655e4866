# SPDX-License-Identifier: Apache-2.0
"""A liquid at rest under an even tension stays as it is: P = K (rho/rho_0 - 1), and no two particles draw together."""

import numpy as np
from scipy.spatial import cKDTree

from brisance.verification import relative, scaled

P = 2.2 * (0.97 - 1)   # GPa


def nearest(snapshot, spacing):
    """Distance of every particle to its nearest neighbour over the spacing."""
    return cKDTree(snapshot["x"]).query(snapshot["x"], k=2)[0][:, 1] / spacing


def measure(shot):
    s = shot.snapshot(-1)
    d = nearest(s, shot.spacing)
    if shot.name == "without":
        return {"tension_without": scaled(s["pressure"].mean(), 0, P), "neighbours_without": scaled(d.mean(), 0.87, 1)}
    return {"tension": relative(s["pressure"].mean(), P), "least_distance": scaled(d.min(), 1, 1), "momentum": scaled(shot.audit["momentum_residual"].max(), 0, 1),
            "energy": scaled(shot.audit["residual_relative"][-1], 0, 1)}


def figure(shots, path):
    from brisance.style import plt, subplots
    shown = [s for s in shots if s.name in ("middle", "without")]
    fig, axes = subplots(1, len(shown), size=(4.4 * len(shown), 4.2))
    for ax, shot in zip(axes[0], shown):
        s = shot.snapshot(-1)
        layer = s.where(abs(s["x"][:, 2]) < shot.spacing)
        dots = ax.scatter(layer["x"][:, 0], layer["x"][:, 1], c=1e3 * layer["pressure"], s=14, vmin=-100, vmax=20, cmap="viridis", lw=0)
        ax.set(aspect="equal", title=f"{'with' if shot.name != 'without' else 'without'} artificial stress, {s.time:g} µs; pressure, MPa")
        fig.colorbar(dots, ax=ax)
    fig.savefig(path, dpi=110)
    plt.close(fig)
