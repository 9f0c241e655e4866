# SPDX-License-Identifier: Apache-2.0
"""Rankine-Hugoniot with U_s = C + S u_p: a wall that stops a column of water is a piston at the speed of the column."""

import numpy as np

from brisance.exact.hugoniot import Linear
from brisance.verification import front, relative, scaled

WATER = Linear(1.0, 1.483, 1.75)


def piston(shot):
    return -float(shot.case["part"]["water"]["velocity"][0].split()[0]) * (1e-3 if "km" not in shot.case["part"]["water"]["velocity"][0] else 1)


def measure(shot):
    u = piston(shot)
    P, rho, lab = WATER.pressure(u), WATER.density_behind(u), WATER.speed(u) - u
    late, early = shot.snapshot(-1), shot.snapshot(0)
    x, place = late["x"][:, 0], [front(s["x"][:, 0], s["pressure"], 0.5 * P) for s in (early, late)]
    behind = (x > 0.5) & (x < lab * late.time - 0.5)   # off the heated wall and the front
    tag = shot.name.split("-")[0]
    name = "" if tag in ("coarse", "middle", "fine") else f"_{tag}"
    return {f"pressure{name}": relative(late["pressure"][behind].mean(), P),
            f"density{name}": relative(late["density"][behind].mean(), rho),
            f"energy{name}": relative(late["internal_energy"][behind].mean(), 0.5 * u * u),
            f"shock_speed{name}": relative((place[1] - place[0]) / (late.time - early.time) + u, WATER.speed(u))}


def figure(shots, path):
    from brisance.style import plt, run_colour, subplots
    fig, axes = subplots(1, 2, size=(9, 3.4))
    u = np.linspace(0, 1.1, 100)
    axes[0, 0].plot(u, [WATER.pressure(v) for v in u], color="#222222", lw=0.8)
    for k, shot in enumerate(shots):
        m = measure(shot)
        axes[0, 0].plot(piston(shot), next(v.have for n, v in m.items() if n.startswith("pressure")), "o", ms=4, color=run_colour(k))
        if piston(shot) == 0.5:
            s = shot.snapshot()
            axes[0, 1].plot(s["x"][:, 0], s["pressure"], ".", ms=2, color=run_colour(k), label=f"{shot.spacing:g} mm")
    t = shots[0].snapshot().time
    lab = WATER.speed(0.5) - 0.5
    axes[0, 1].plot([0, lab * t, lab * t, 5], [WATER.pressure(0.5)] * 2 + [0, 0], color="#222222", lw=0.8, label="exact")
    axes[0, 1].legend()
    axes[0, 0].set(xlabel="piston [km/s]", ylabel="P [GPa]", title="Hugoniot of water")
    axes[0, 1].set(xlabel="x [mm]", ylabel="P [GPa]", title=f"0.5 km/s, {t:g} µs")
    fig.savefig(path, dpi=110)
    plt.close(fig)
