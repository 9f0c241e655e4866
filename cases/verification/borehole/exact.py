# SPDX-License-Identifier: Apache-2.0
"""Cylindrical shells in plane strain, by an independent staggered Lagrangian scheme (python/brisance/exact/borehole.py)."""

import numpy as np

from brisance.exact.borehole import Shells, edges, of_case, peaks
from brisance.verification import relative, scaled

RADII = (5.2, 6.5, 9.6)   # mm
_known = {}


def reference(shot):
    """Middles of the cells of the rock and the largest radial stress that each has borne, GPa."""
    if "rock" not in _known:
        shells = of_case(shot.case, 1)
        shells[-1].edges = edges(shells[-1].edges[0], 16, 0.2)
        model = Shells(shells)
        _, radial, _ = peaks(model, 3)
        edge = shells[-1].edges
        _known["rock"] = (edge[1:] + edge[:-1]) / 2, radial[model.slices[-1]]
    return _known["rock"]


def measure(shot):
    stress = shot.run.attenuation("radial_stress")
    r, want = reference(shot)
    found = {f"radial_stress_{str(x).replace('.', '_')}_mm": relative(np.interp(x, stress["r_mm"], stress["median_GPa"]), np.interp(x, r, want)) for x in RADII}
    audit = shot.audit
    found["leaked"] = scaled(audit["leaked"][-1], 0, 1)
    found["momentum"] = scaled(audit["momentum_residual"][-1], 0, 1)
    found["energy"] = scaled(audit["residual_relative"][-1], 0, 1)
    return found


def figure(shots, path):
    from brisance.style import plt, run_colour, subplots
    fig, axes = subplots(1, 1, size=(6.5, 4))
    ax = axes[0, 0]
    for k, shot in enumerate(shots):
        stress = shot.run.attenuation("radial_stress")
        ax.loglog(stress["r_mm"], stress["median_GPa"], "o", ms=3, color=run_colour(k), label=f"brisance, {shot.name}")
    r, want = reference(shots[-1])
    ax.loglog(r, want, color="#222222", lw=0.8, label="one-dimensional")
    ax.set(xlabel="r [mm]", ylabel="largest radial stress [GPa]", xlim=(3.2, 13))
    ax.legend()
    fig.savefig(path, dpi=110)
    plt.close(fig)
