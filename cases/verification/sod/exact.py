# SPDX-License-Identifier: Apache-2.0
"""The exact solution of the Riemann problem."""

import numpy as np

from brisance.exact.riemann import Riemann
from brisance.verification import front, norm, relative, scaled

GAS = Riemann((1.0, 0.0, 1.0), (0.125, 0.0, 0.1), 1.4)


def measure(shot):
    s = shot.snapshot()
    t, x = s.time, s["x"][:, 0]
    inside = np.abs(x) < 4.5
    rho, u, p = GAS(x[inside] / t)
    u_exact = GAS(x[inside] / (t - shot.half_step(t)))[1]
    found = {"density": norm(s["density"][inside], rho, 1), "velocity": norm(s["velocity"][inside, 0], u_exact, 1),
             "pressure": norm(s["pressure"][inside], p, 1)}
    edge = 0.3  # mm, off the ends of a plateau
    left = (x > -0.07 * t + edge) & (x < GAS.u * t - edge)
    right = (x > GAS.u * t + edge) & (x < GAS.shock(1) * t - edge)
    found["density_left"] = relative(s["density"][left].mean(), GAS.rho_left)
    found["density_right"] = relative(s["density"][right].mean(), GAS.rho_right)
    found["plateau_pressure"] = relative(s["pressure"][left | right].mean(), GAS.p)
    found["plateau_velocity"] = relative(s["velocity"][left | right, 0].mean(), GAS.u)
    beyond = x > GAS.u * t + edge
    found["shock_position"] = scaled(front(x[beyond], s["pressure"][beyond], 0.5 * (GAS.p + 0.1)), GAS.shock(1) * t, 5)
    return found


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
