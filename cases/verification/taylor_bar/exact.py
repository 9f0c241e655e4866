# SPDX-License-Identifier: Apache-2.0
"""Measured shapes of three copper bars after impact.

Zelepugin, Cherepanov & Pakhnutova, Materials 16 (2023) 5452, doi 10.3390/ma16155452 (CC BY 4.0); shot 1 is Wilkins & Guinan 1973. Outlines digitised in
github.com/qilinli/StructBench, src/structbench/validation/references/taylor_copper.json (commit 32086124). Lengths in mm, speed in m/s.
"""

import numpy as np

from brisance.verification import number, relative

SHOTS = {210: {"length": 14.7964, "radius": 8.3965, "widths": (5.3473, 5.1916, 4.9291, 4.4005, 4.1113), "start": 23.47},
         162: {"length": 26.3132, "radius": 6.633, "widths": (4.7134, 4.5963, 4.4054, 4.0032, 3.903), "start": 34.5},
         225: {"length": 22.2527, "radius": 8.0197, "widths": (5.1278, 4.9338, 4.6344, 4.0805, 3.9313), "start": 34.5}}
FRACTIONS = (0.2, 0.25, 0.333333, 0.5, 0.666667)     # of the final length, where the radius is given


def shot_of(shot):
    return SHOTS[round(-1e3 * number(shot.case["part"]["bar"]["velocity"][2]))]


def outline(shot):
    """Height above the wall and outer radius, of the particles on the side of the bar, and the final length; half a spacing beyond the particles."""
    s = shot.snapshot()
    half = 0.5 * shot.spacing
    x, y, z = s["x"].T
    R = np.hypot(s["X"][:, 0], s["X"][:, 1])
    skin = R > R.max() - 0.6 * shot.spacing
    low = z.min()
    length = z.max() - low + 0.5 * shot.spacing * (1 + 0.8)   # the foot's half layer is pressed flat
    order = np.argsort(z[skin])
    r = np.hypot(x, y)[skin][order]
    # a skin particle stands half its own width inside the surface; radially that width shrinks as the length of the bar does not
    return z[skin][order] - low, r * (1 + half / (R[skin][order])), length


def radius_at(z, r, height, window):
    near = np.abs(z - height) < window
    return r[near].mean() if near.any() else np.nan


def measure(shot):
    want = shot_of(shot)
    z, r, length = outline(shot)
    tag = "" if want is SHOTS[210] else f"_{'3' if want is SHOTS[162] else '5'}"
    found = {f"length{tag}": relative(length, want["length"]), f"foot_radius{tag}": relative(r[z < 0.08 * length].max(), want["radius"])}
    widths = [radius_at(z, r, f * length, 0.6 * shot.spacing) for f in FRACTIONS]
    found[f"widths{tag}"] = relative(np.mean(widths), np.mean(want["widths"]))
    return found


def figure(shots, path):
    from brisance.style import plt, run_colour, subplots
    fig, axes = subplots(1, 3, size=(10, 4))
    for ax, (speed, want) in zip(axes[0], SHOTS.items()):
        for k, shot in enumerate(s for s in shots if shot_of(s) is want):
            z, r, length = outline(shot)
            ax.plot(np.concatenate([r, -r]), np.concatenate([z, z]), ".", ms=1.5, color=run_colour(k), label=f"{shot.spacing:g} mm")
        for sign in (1, -1):
            ax.plot(sign * np.array([want["radius"], *want["widths"]]), [0, *(f * want["length"] for f in FRACTIONS)], "+", color="#222222", ms=8,
                    label="measured" if sign > 0 else None)
        ax.axhline(want["length"], color="#222222", lw=0.8)
        ax.set(aspect="equal", title=f"{speed} m/s", xlabel="r [mm]")
    axes[0, 0].set_ylabel("height above the wall [mm]; line: measured length")
    axes[0, 0].legend(markerscale=3)
    fig.savefig(path, dpi=110)
    plt.close(fig)
