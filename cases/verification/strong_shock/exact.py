# SPDX-License-Identifier: Apache-2.0
"""The exact solution of the Riemann problem."""

import numpy as np

from brisance.exact.riemann import Riemann
from brisance.verification import front, norm, relative, scaled

GAS = Riemann((1.0, 0.0, 100.0), (1.0, 0.0, 0.001), 1.4)


def measure(shot):
    s = shot.snapshot()
    t, x = s.time, s["x"][:, 0]
    inside = np.abs(x) < 4.5
    u = GAS(x[inside] / (t - shot.half_step(t)))[1]
    behind = (x > 0.5) & (x < GAS.u * t - 0.4)
    shocked = (x > GAS.u * t + 0.1) & (x < GAS.shock(1) * t - 0.15)
    return {"velocity": norm(s["velocity"][inside, 0], u, GAS.u),
            "plateau_pressure": relative(s["pressure"][behind].mean(), GAS.p),
            "plateau_velocity": relative(s["velocity"][behind, 0].mean(), GAS.u),
            "density_behind_shock": relative(s["density"][shocked].mean(), GAS.rho_right),
            "shock_position": scaled(front(x[x > 2], s["velocity"][x > 2, 0], 0.5 * GAS.u), GAS.shock(1) * (t - shot.half_step(t)), 5)}


def figure(shots, path):
    from brisance.style import plt, run_colour, subplots
    fig, axes = subplots(1, 3, size=(11, 3.3))
    t = shots[-1].snapshot().time
    fine = np.linspace(-5, 5, 2000)
    exact = GAS(fine / t)
    for ax, name, which in zip(axes[0], ("density", "velocity", "pressure"), range(3)):
        for k, shot in enumerate(shots):
            s = shot.snapshot()
            y = s[name] if which != 1 else s["velocity"][:, 0]
            ax.plot(s["x"][:, 0], y, ".", ms=2, color=run_colour(k), label=f"{shot.spacing:g} mm")
        ax.plot(fine, exact[which], color="#222222", lw=0.8, label="exact")
        ax.set_title(f"{name} [{('g/cm³', 'km/s', 'GPa')[which]}], {t:g} µs")
        ax.set_xlabel("x [mm]")
    axes[0, 0].legend()
    fig.savefig(path, dpi=110)
    plt.close(fig)
