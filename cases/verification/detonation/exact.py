# SPDX-License-Identifier: Apache-2.0
"""CJ state of the JWL law by the least detonation speed, and the Taylor wave behind a front from a rigid wall."""

import numpy as np

from brisance.exact.jwl import TNT
from brisance.verification import bins, front, norm, relative, scaled

V_CJ, P_CJ, D, U_CJ, C_CJ = TNT.chapman_jouguet()
D_LIT = 6.93                   # km/s, what the material file lights with
PLACE, U, P, V = TNT.taylor_wave()


def pressure(s):
    """GPa at s = x/t"""
    order = np.argsort(PLACE)
    return np.interp(s, PLACE[order], P[order], right=0.0)


def measure(shot):
    early, late = shot.snapshot(0), shot.snapshot(-1)
    place = [front(s["x"][:, 0], s["pressure"], 0.5 * P_CJ) for s in (early, late)]
    t, x = late.time, late["x"][:, 0]
    wave = (x > 0.5) & (x < D * t - 1.5)
    plateau = (x > 1) & (x < 0.45 * D * t)
    return {"front_speed": relative((place[1] - place[0]) / (t - early.time), D_LIT),
            "front_position": scaled(place[1], D_LIT * t, D_LIT * t),
            "peak_pressure": relative(late["pressure"].max(), P_CJ),
            "plateau_pressure": relative(late["pressure"][plateau].mean(), P[-1]),
            "plateau_velocity": scaled(late["velocity"][plateau, 0].mean(), 0, U_CJ),
            "taylor_wave": norm(late["pressure"][wave], pressure(x[wave] / t), P_CJ),
            "released_energy": relative(shot.audit["burn_released"][-1], released(shot, t))}


def released(shot, t):
    """J: E0 of what the front has passed, complete 1.5 spacings behind it, linear between; per section of the channel."""
    section = 4 * shot.spacing * 4 * shot.spacing
    return 7.0 * section * (D_LIT * t - 0.75 * shot.spacing)


def figure(shots, path):
    from brisance.style import plt, run_colour, subplots
    fig, axes = subplots(1, 2, size=(10, 3.5))
    fine = np.linspace(0, 20, 2000)
    for k, shot in enumerate(shots):
        s = shot.snapshot()
        axes[0, 0].plot(s["x"][:, 0], s["pressure"], ".", ms=2, color=run_colour(k), label=f"{shot.spacing:g} mm")
        axes[0, 1].plot(s["x"][:, 0], s["velocity"][:, 0], ".", ms=2, color=run_colour(k))
    t = shots[-1].snapshot().time
    order = np.argsort(PLACE)
    axes[0, 0].plot(fine, pressure(fine / t), color="#222222", lw=0.8, label="exact")
    axes[0, 1].plot(fine, np.interp(fine / t, PLACE[order], U[order], right=0), color="#222222", lw=0.8)
    axes[0, 0].set(xlabel="x [mm]", title=f"pressure [GPa], {t:g} µs")
    axes[0, 1].set(xlabel="x [mm]", title="velocity [km/s]")
    axes[0, 0].legend(markerscale=3)
    fig.savefig(path, dpi=110)
    plt.close(fig)
