# SPDX-License-Identifier: Apache-2.0
"""Acoustics: a pulse v in a material of impedance Z1 passes a face to Z2 as 2 Z1/(Z1 + Z2) v and comes back as (Z1 - Z2)/(Z1 + Z2) v."""

import numpy as np

from brisance.verification import relative, scaled

C1 = np.sqrt((8.96 * 3.94**2 + 4 * 46 / 3) / 8.96)
C2 = np.sqrt((25.7 + 4 * 21.9 / 3) / 2.66)
Z1, Z2 = 8.96 * C1, 2.66 * C2
THROUGH, BACK = 2 * Z1 / (Z1 + Z2), (Z1 - Z2) / (Z1 + Z2)
HALF = 0.005                          # km/s


def bump(x):
    return np.where(np.abs(x + 4) < 1.5, HALF * np.cos(np.pi * (x + 4) / 3) ** 2, 0)


def exact(gauge, x, t):
    if gauge == "behind":
        return THROUGH * bump(-(t - x / C2) * C1)
    return bump(x - C1 * t) + BACK * bump(-x - C1 * t)


def measure(shot):
    found = {}
    for name, text in (("before", "reflected"), ("behind", "transmitted")):
        g = shot.gauge(name)
        t, v, x = g["t"] - 0.5 * float(shot.audit["dt"].mean()), g["v_x"], float(g["x"][0])
        want = exact(name, x, t)
        when = t > 0.9 if name == "before" else t > 0
        k, w = np.argmax(v[when]), np.argmax(want[when])
        found[f"{text}_velocity"] = relative(v[when][k], want[when][w])
        # a second time from the mean of the pulse, which a flat top does not blur
        mean = (t[when] @ np.clip(v[when], 0, None)) / np.clip(v[when], 0, None).sum()
        wanted = (t[when] @ want[when]) / want[when].sum()
        found[f"{text}_time"] = scaled(mean, wanted, 3 / C1)
    found["momentum"] = scaled(shot.audit["momentum_residual"][-1], 0, 1)
    return found


def figure(shots, path):
    from brisance.style import plt, run_colour, subplots
    fig, axes = subplots(1, 2, size=(10, 3.4))
    for ax, name in zip(axes[0], ("before", "behind")):
        for k, shot in enumerate(shots):
            g = shot.gauge(name)
            ax.plot(g["t"], 1e3 * g["v_x"], color=run_colour(k), label=f"{shot.spacing:g} mm")
        ax.plot(g["t"], 1e3 * exact(name, float(g["x"][0]), g["t"]), color="#222222", lw=0.8, label="exact")
        ax.set(xlabel="t [µs]", title=f"velocity {name} the face [m/s]")
    axes[0, 0].legend()
    fig.savefig(path, dpi=110)
    plt.close(fig)
