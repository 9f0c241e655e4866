# SPDX-License-Identifier: Apache-2.0
"""A centred simple wave of JWL products into a vacuum, and the isentrope itself."""

import numpy as np

from brisance.exact.jwl import TNT
from brisance.verification import norm

WAVE = TNT.release()   # x/t, u, P, V


def measure(shot):
    s = shot.snapshot()
    t, x = s.time, s["x"][:, 0]
    place, u, P, V = WAVE
    fan = (x > place[0] * t - 0.5) & (x < np.interp(8.0, V, place) * t)   # up to V = 8
    v = 1.63 / s["density"][fan]
    on_isentrope = np.interp(np.clip(v, 1, None), V, P)
    late = x[fan] / (t - shot.half_step(t))
    return {"isentrope": norm(np.log(np.maximum(s["pressure"][fan], 1e-9) / on_isentrope), 0, 1),
            "velocity": norm(s["velocity"][fan, 0], np.interp(late, place, u), u[np.searchsorted(V, 8.0)]),
            "pressure": norm(s["pressure"][fan], np.interp(x[fan] / t, place, P), P[0])}


def figure(shots, path):
    from brisance.style import plt, run_colour, subplots
    fig, axes = subplots(1, 3, size=(11, 3.3))
    place, u, P, V = WAVE
    t = shots[-1].snapshot().time
    for k, shot in enumerate(shots):
        s = shot.snapshot()
        axes[0, 0].loglog(1.63 / s["density"], s["pressure"], ".", ms=2, color=run_colour(k), label=f"{shot.spacing:g} mm")
        axes[0, 1].plot(s["x"][:, 0], s["velocity"][:, 0], ".", ms=2, color=run_colour(k))
        axes[0, 2].plot(s["x"][:, 0], s["pressure"], ".", ms=2, color=run_colour(k))
    axes[0, 0].loglog(V, P, color="#222222", lw=0.8, label="exact")
    axes[0, 1].plot(place * t, u, color="#222222", lw=0.8)
    axes[0, 2].plot(place * t, P, color="#222222", lw=0.8)
    axes[0, 0].set(xlabel="V = ρ$_0$/ρ", ylabel="P [GPa]", title="isentrope")
    axes[0, 1].set(xlabel="x [mm]", title=f"velocity [km/s], {t:g} µs", xlim=(-6, 9), ylim=(0, 8))
    axes[0, 2].set(xlabel="x [mm]", title="pressure [GPa]", xlim=(-6, 9))
    axes[0, 0].legend(markerscale=3)
    fig.savefig(path, dpi=110)
    plt.close(fig)
