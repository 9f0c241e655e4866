# SPDX-License-Identifier: Apache-2.0
"""First frequency of a free Timoshenko beam in plane strain, by finite elements with as many nodes as it takes (independent of the C++)."""

import numpy as np
from scipy.linalg import eigh

from brisance.verification import relative, scaled

L, H, RHO, K, G = 60.0, 6.0, 2.66, 25.7, 21.9
E, NU = 9 * K * G / (3 * K + G), (3 * K - 2 * G) / (2 * (3 * K + G))


def timoshenko(elements=300):
    """1/us. Plane strain: E/(1 - nu^2), and Cowper's shear factor with nu/(1 - nu)."""
    e, n = E / (1 - NU**2), NU / (1 - NU)
    shear = 10 * (1 + n) / (12 + 11 * n) * G * H
    area, inertia, h = H, H**3 / 12, L / elements
    size = 2 * (elements + 1)
    stiff, mass = np.zeros((size, size)), np.zeros((size, size))
    bend = e * inertia / h * np.array([[0, 0, 0, 0], [0, 1, 0, -1], [0, 0, 0, 0], [0, -1, 0, 1]])
    g = np.array([-1 / h, -0.5, 1 / h, -0.5])          # shear strain in the middle: reduced integration
    k = bend + shear * h * np.outer(g, g)
    m = np.zeros((4, 4))
    m[0::2, 0::2] = RHO * area * h / 6 * np.array([[2, 1], [1, 2]])
    m[1::2, 1::2] = RHO * inertia * h / 6 * np.array([[2, 1], [1, 2]])
    for i in range(elements):
        at = slice(2 * i, 2 * i + 4)
        stiff[at, at] += k
        mass[at, at] += m
    values = eigh(stiff, mass, eigvals_only=True, subset_by_index=(0, 3))
    return np.sqrt(values[2]) / (2 * np.pi)            # the first two are rigid


FREQUENCY = timoshenko()
EULER = (4.7300407 / L) ** 2 / (2 * np.pi) * np.sqrt(E / (1 - NU**2) / RHO) * H / np.sqrt(12)


def fit(shot):
    """Frequency, and the amplitude over the first and the last period, by least squares of the middle's velocity."""
    g = shot.gauge("middle")
    t, v = g["t"] - 0.5 * float(shot.audit["dt"].mean()), g["v_y"]

    def residual(f, t, v):
        a = np.column_stack([np.cos(2 * np.pi * f * t), np.sin(2 * np.pi * f * t), np.ones_like(t)])
        c, *_ = np.linalg.lstsq(a, v, rcond=None)
        return np.sum((a @ c - v) ** 2), np.hypot(c[0], c[1])

    f = np.linspace(0.7, 1.2, 2001) * FREQUENCY
    best = f[np.argmin([residual(x, t, v)[0] for x in f])]
    half = 1 / best
    return best, residual(best, t[t < half], v[t < half])[1], residual(best, t[t > t[-1] - half], v[t > t[-1] - half])[1]


def measure(shot):
    f, first, last = fit(shot)
    audit = shot.audit
    return {"frequency": relative(f, FREQUENCY), "decay": scaled(last, first, first),
            "energy": scaled(audit["residual_relative"][-1], 0, 1)}


def figure(shots, path):
    from brisance.style import plt, run_colour, subplots
    fig, axes = subplots(1, 2, size=(10, 3.4))
    for k, shot in enumerate(shots):
        g = shot.gauge("middle")
        axes[0, 0].plot(g["t"], 1e3 * g["v_y"], color=run_colour(k), label=f"{shot.spacing:g} mm")
        axes[0, 1].plot(H / shot.spacing, fit(shot)[0] / FREQUENCY, "o", color=run_colour(k))
    t = g["t"]
    axes[0, 0].plot(t, 1e3 * g["v_y"][0] * np.cos(2 * np.pi * FREQUENCY * t), color="#222222", lw=0.8, label="exact")
    axes[0, 0].legend()
    axes[0, 0].set(xlabel="t [µs]", title="velocity of the middle [m/s]")
    axes[0, 1].axhline(1, color="#222222", lw=0.8)
    axes[0, 1].axhline(EULER / FREQUENCY, color="#777777", lw=0.8, ls=":")
    axes[0, 1].set(xlabel="particles over the height", title="frequency over Timoshenko's (dotted: Euler)")
    fig.savefig(path, dpi=110)
    plt.close(fig)
