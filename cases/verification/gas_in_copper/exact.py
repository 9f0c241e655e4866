# SPDX-License-Identifier: Apache-2.0
"""Nothing leaks, momentum and energy stay, and at the end the gas is at rest in the tube with the temperature of all the energy it had."""

import numpy as np

from brisance.verification import relative, scaled


def measure(shot):
    a = shot.audit
    start, end = shot.snapshot(0), shot.snapshot(-1)
    gas = end.part("gas")
    tube = end.part("tube")
    centre = tube["x"][:, :2].mean(axis=0)
    r = np.hypot(*(gas["x"][:, :2] - centre).T)
    late = a["t"] > 0.9 * a["t"][-1]
    scale = a["kinetic"][0] + a["internal.gas"][0]
    # pressure of a uniform gas: (gamma - 1) e over the room it has, which is that of the tube
    pressure = 0.4 * a["internal.gas"][-1] / (np.pi * 16 * 4 * 0.5)
    return {"leaked": scaled(a["leaked"].max(), 0, 1), "outside": scaled((r > 4.5).sum(), 0, 1), "momentum": scaled(a["momentum_residual"].max(), 0, 1),
            "energy": scaled(np.abs(a["residual"]).max() / scale, 0, 1), "steps": scaled(min(a["step"][-1] / 1e5, 1.0), 1, 1),
            "pressure": relative(gas["pressure"].mean(), pressure)}


def figure(shots, path):
    from brisance.style import plt, run_colour, subplots
    fig, axes = subplots(1, 2, size=(9.5, 3.8))
    shot = shots[-1]
    a = shot.audit
    axes[0, 0].plot(a["t"], a["kinetic"] / a["kinetic"][0], lw=0.7, color=run_colour(0))
    axes[0, 0].set(xlabel="t [µs]", title="kinetic energy over its start")
    s = shot.snapshot(-1)
    for k, name in enumerate(("tube", "gas")):
        p = s.part(name)
        axes[0, 1].plot(p["x"][:, 0], p["x"][:, 1], ".", ms=2, color=run_colour(k))
    axes[0, 1].set(aspect="equal", title=f"{s.time:.0f} µs, step {a['step'][-1]:.0f}")
    fig.savefig(path, dpi=110)
    plt.close(fig)
