# SPDX-License-Identifier: Apache-2.0
"""Acoustic plate impact: waves of speed c_p between the faces of a flyer (2 mm) and a plate (6 mm) of the same material."""

import numpy as np

from brisance.verification import relative, scaled

RHO, K, G, V = 2.66, 25.7, 21.9, 0.012
C = np.sqrt((K + 4 * G / 3) / RHO)
STRESS = RHO * C * V / 2                      # 72.5 MPa
STRENGTH = 0.05
PLACE, TIME = 4.0, 8 / C                      # first tension: 2 mm under the free face, when both rarefactions meet


def measure(shot):
    g = shot.gauge("face")
    t, v = g["t"], g["v_x"]
    m = shot.gauge("middle")
    s = shot.snapshot().part("plate")
    broken = s["failure_time"] >= 0
    first = s["failure_time"][broken].min() if broken.any() else np.nan
    early = broken & (s["failure_time"] < first + 2 * shot.spacing / C)
    plateau = (t > 6 / C + 0.25) & (t < 10 / C - 0.25)
    inside = (m["t"] > 2 / C + 0.25) & (m["t"] < 6 / C - 0.25)
    layer, rest = s["X"][:, 0] > PLACE + 4 * shot.spacing, s["X"][:, 0] < PLACE - 4 * shot.spacing
    return {"stress": relative(-m["sigma_3"][inside].mean(), STRESS),
            "face_velocity": relative(v[plateau].mean(), V),
            "arrival": scaled(np.interp(V / 2, v[t < 8 / C], t[t < 8 / C]), 6 / C, 6 / C),
            "spall_place": scaled(s["X"][early, 0].mean() if broken.any() else np.nan, PLACE, PLACE),
            "spall_time": scaled(first, TIME, TIME),
            "spall_velocity": relative(s["velocity"][layer, 0].mean(), V),
            "velocity_of_the_rest": scaled(s["velocity"][rest, 0].mean(), 0, V)}


def figure(shots, path):
    from brisance.style import plt, run_colour, subplots
    fig, axes = subplots(1, 2, size=(10, 3.5))
    for k, shot in enumerate(shots):
        g = shot.gauge("face")
        axes[0, 0].plot(g["t"], 1e3 * g["v_x"], color=run_colour(k), label=f"{shot.spacing:g} mm")
        s = shot.snapshot().part("plate")
        broken = s["failure_time"] >= 0
        axes[0, 1].plot(s["X"][broken, 0], s["failure_time"][broken], ".", ms=3, color=run_colour(k))
    axes[0, 0].plot([0, 6 / C, 6 / C, 3], [0, 0, 1e3 * V, 1e3 * V], color="#222222", lw=0.8, label="exact")
    axes[0, 0].set(xlabel="t [µs]", title="velocity of the free face [m/s]")
    axes[0, 1].plot(PLACE, TIME, "+", ms=12, color="#222222")
    axes[0, 1].set(xlabel="x [mm]", ylabel="t [µs]", title="failed particles; cross: exact", xlim=(0, 6))
    axes[0, 0].legend()
    fig.savefig(path, dpi=110)
    plt.close(fig)
