# SPDX-License-Identifier: Apache-2.0
"""d'Alembert's solution in a strip that is free at one end and fixed at the other."""

import numpy as np

from brisance.verification import norm, relative

RHO, K, G = 2.66, 25.7, 21.9                      # g/cm3, GPa
SPEED = {"p": np.sqrt((K + 4 * G / 3) / RHO), "s": np.sqrt(G / RHO)}
AXIS = {"p": 0, "s": 2}
START, WIDTH, HEIGHT = 20.0, 3.0, 1e-3            # mm, mm, km/s


def pulse(x):
    return HEIGHT * np.exp(-(((x - START) / WIDTH) ** 2))


def continued(x, length):
    """The initial velocity continued beyond the ends: even about 0, odd about `length`, so of period 4 length."""
    x = np.mod(x + 2 * length, 4 * length) - 2 * length
    x = np.abs(x)
    return np.where(x <= length, pulse(x), -pulse(2 * length - x))


def velocity(x, t, c, length):
    return 0.5 * (continued(x - c * t, length) + continued(x + c * t, length))


def profile(shot, part, time):
    """x, v of the strip and the time that v belongs to."""
    s = shot.at(time).part(part)
    order = np.argsort(s["X"][:, 0], kind="stable")
    return s["X"][order, 0], s["velocity"][order, AXIS[part]], s.time - shot.half_step(s.time)


def measure(shot):
    length = 40 - 0.5 * shot.spacing              # the fixed particles' own plane
    found = {}
    for part, c in SPEED.items():
        x, v, t = profile(shot, part, 2)
        right = x > START
        found[f"{part}_speed"] = relative(((x[right] @ v[right]) / v[right].sum() - START) / t, c + middle_of_half(c * t) / t)
        for name, time in (("inside", 2), ("reflected", 16)):
            x, v, t = profile(shot, part, time)
            found[f"{part}_{name}"] = norm(v, velocity(x, t, c, length), HEIGHT, 2)
    return found


def middle_of_half(way):
    """How far the middle of what lies right of the start is off the crest, since the two halves still overlap a little."""
    x = np.linspace(START, 40, 20001)
    v = 0.5 * (pulse(x - way) + pulse(x + way))
    return (x @ v) / v.sum() - START - way


def figure(shots, path):
    from brisance.style import plt, run_colour, subplots
    fig, axes = subplots(2, 2, size=(9, 5))
    for row, part in enumerate(SPEED):
        for column, time in enumerate((8, 16)):
            ax = axes[row, column]
            for k, shot in enumerate(shots):
                x, v, t = profile(shot, part, time)
                ax.plot(x, 1e3 * v, ".", ms=2.5, color=run_colour(k), label=f"{shot.spacing:g} mm")
            fine = np.linspace(0, 40, 2000)
            ax.plot(fine, 1e3 * velocity(fine, t, SPEED[part], 40 - 0.5 * shot.spacing), color="#222222", lw=0.8, label="exact")
            ax.set_title(f"{part.upper()} pulse, {time} µs")
            ax.set_xlabel("x [mm]")
            ax.set_ylabel("v [m/s]")
    axes[0, 0].legend()
    fig.savefig(path, dpi=110)
    plt.close(fig)
