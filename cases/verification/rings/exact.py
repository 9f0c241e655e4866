# SPDX-License-Identifier: Apache-2.0
"""Two equal rings that meet head on bounce: symmetry, conservation, and no particle leaves its neighbours."""

import numpy as np
from scipy.spatial import cKDTree

from brisance.verification import scaled

V0 = 0.059


def least_gap(s, spacing):
    """Smallest distance between particles of one body over the spacing, in the section."""
    near = cKDTree(s["x"]).query(s["x"], k=2)[0][:, 1]
    return near.min() / spacing


def measure(shot):
    end = shot.snapshot(-1)
    a, b = end.part("left"), end.part("right")
    start = shot.snapshot(0).part("left")
    vl, vr = (np.average(p["velocity"][:, 0], weights=p["size"] ** 2) for p in (a, b))
    gap = (b["x"][:, 0].min() - a["x"][:, 0].max()) / shot.spacing
    # strain energy and swing take what the bounce does not give back: velocity after it between nothing and V0
    return {"symmetry": scaled(vl + vr, 0, V0),
            "bounce": scaled(min(vr, -vl) / V0, 1.0, 1),
            "torn": scaled(shot.audit["torn"][-1], 0, 1),
            "least_neighbour_distance": scaled(min(least_gap(p, shot.spacing) / least_gap(start, shot.spacing) for p in (a, b)), 1.0, 1),
            "energy": scaled(shot.audit["residual_relative"][-1], 0, 1),
            "momentum": scaled(shot.audit["momentum_residual"][-1], 0, 1),
            "apart": scaled(min(gap, 1.0), 1.0, 1)}


def figure(shots, path):
    from brisance.style import plt, run_colour, subplots
    fig, axes = subplots(1, 5, size=(13, 2.6))
    for ax, k in zip(axes[0], range(5)):
        s = shots[-1].snapshot(k)
        for n, name in enumerate(("left", "right")):
            p = s.part(name)
            ax.plot(p["x"][:, 0], p["x"][:, 1], ".", ms=0.8, color=run_colour(n))
        ax.set(aspect="equal", title=f"{s.time:.0f} µs", xlim=(-11, 11), ylim=(-6, 6))
    fig.savefig(path, dpi=110)
    plt.close(fig)
