# SPDX-License-Identifier: Apache-2.0
"""Wall velocities of the one-inch cylinder test, km/s at 6 and 19 mm of expansion of the outer radius: Livermore's tables as commonly quoted
(Dobratz & Crawford, LLNL Explosives Handbook, UCRL-52997), which were not at hand to be read again."""

import numpy as np

from brisance.verification import relative

MEASURED = {"tnt": (1.18, 1.40), "petn_1770": (1.56, 1.79)}
DETONATION = {"tnt": 6.93, "petn_1770": 8.30}  # km/s


def wall(shot):
    """Time, expansion and velocity of the outer wall, mean of four gauges, as a streak camera sees it through a slit at a fixed z. The
    picture travels with the detonation, r = f(t - z/D); along the path of a particle f' = v_r/(1 - v_z/D), which is D tan(theta)
    where the particle itself has v_r = D sin(theta) (Taylor's angle)."""
    d = DETONATION[shot.case["part"]["charge"]["material"]]
    gauges = [shot.gauge(n) for n in ("east", "north", "west", "south")]
    t = gauges[0]["t"]
    r = np.mean([np.hypot(g["x"], g["y"]) for g in gauges], axis=0)
    v = np.mean([(g["x"] * g["v_x"] + g["y"] * g["v_y"]) / np.hypot(g["x"], g["y"]) / (1 - g["v_z"] / d) for g in gauges], axis=0)
    return t, r - r[0], v


def measure(shot):
    at6, at19 = MEASURED[shot.case["part"]["charge"]["material"]]
    _, r, v = wall(shot)
    tag = shot.name
    return {f"{tag}_6_mm": relative(np.interp(6, r, v) if r.max() > 6 else np.nan, at6), f"{tag}_19_mm": relative(np.interp(19, r, v) if r.max() > 19 else np.nan, at19)}


def figure(shots, path):
    from brisance.style import plt, run_colour, subplots
    fig, axes = subplots(1, 2, size=(10, 3.8))
    for k, shot in enumerate(shots):
        t, r, v = wall(shot)
        axes[0, 0].plot(r, v, color=run_colour(k), label=shot.name)
        axes[0, 0].plot((6, 19), MEASURED[shot.case["part"]["charge"]["material"]], "o", ms=5, mfc="none", color=run_colour(k))
    axes[0, 0].set(xlabel="expansion of the outer wall [mm]", title="its velocity [km/s]; circles: measured")
    axes[0, 0].legend()
    s = shots[0].snapshot()
    for k, name in enumerate(("tube", "charge")):
        p = s.part(name)
        cut = np.abs(p["x"][:, 1]) < 0.6
        axes[0, 1].plot(p["x"][cut, 0], p["x"][cut, 2], ".", ms=1, color=run_colour(k))
    axes[0, 1].set(aspect="equal", title=f"{shots[0].name}, {s.time:.0f} µs", xlim=(-45, 45))
    fig.savefig(path, dpi=110)
    plt.close(fig)
