# SPDX-License-Identifier: Apache-2.0
"""Correlation of crack patterns between arrangements of particles, rocks and frames.

Angular histograms of damaged particles (D > 0.8, weighted by area) with 14 mm < r < 42 mm, bins of 2 degrees, smoothed over 3 bins to each side; Pearson.
"""

import numpy as np

from brisance.verification import scaled

ROCKS = (1, 2, 3, 4)   # seeds of the strength field; chance alone moves one correlation by about 0.1


def measure(shot):
    return {}


def histogram(shot, turn=0.0, inner=14.0, outer=42.0):
    """Area of damage against azimuth, in the frame turned by `turn` degrees."""
    s = shot.run.maps["slice"]
    use = (s.damage > 0.8) & (s.radius > inner) & (s.radius < outer)
    angle = (np.degrees(np.arctan2(s.y, s.x))[use] - turn) % 360
    h, _ = np.histogram(angle, bins=180, range=(0, 360), weights=s.size[use] ** 2)
    return np.convolve(np.concatenate([h[-3:], h, h[:3]]), np.ones(7) / 7, "valid")


def compare(shots):
    runs = {shot.name: shot for shot in shots}
    h = {name: histogram(shot) for name, shot in runs.items()}
    own = {n: histogram(runs[f"turned-{n}"], 22.5) for n in ROCKS}

    def mean(pairs):
        return float(np.mean([np.corrcoef(a, b)[0, 1] for a, b in pairs]))

    def at_most_none(value):
        return scaled(max(value, 0.0), 0.0, 1.0)

    return {"rock_frame": scaled(mean([(h[f"rock-{n}"], h[f"turned-{n}"]) for n in ROCKS]), 1.0, 1.0),
            "arrangement_frame": at_most_none(mean([(h[f"rock-{n}"], own[n]) for n in ROCKS])),
            "other_rock": at_most_none(mean([(h[f"rock-{a}"], h[f"rock-{b}"]) for a in ROCKS for b in ROCKS if a < b])),
            "lattice_own_frame": scaled(mean([(h["lattice"], histogram(runs["lattice-turned"], 22.5))]), 1.0, 1.0)}


def figure(shots, path):
    from brisance.style import plt
    runs = {shot.name: shot for shot in shots}
    titles = {"rock-1": "rock 1", "turned-1": "rock 1, arrangement turned by 22.5°, reseeded", "rock-2": "rock 2",
              "turned-2": "rock 2, arrangement turned, reseeded", "lattice": "lattice in homogeneous rock", "lattice-turned": "lattice turned by 22.5°"}
    fig, axes = plt.subplots(2, 3, figsize=(13.5, 9.4))
    for axis, name in zip(axes.T.flat, titles):
        s = runs[name].run.maps["slice"]
        axis.scatter(s.x, s.y, s=1.2, c=np.where(s.damage > 0.8, "#1a1a1a", np.where(s.damage > 0.05, "#d9b48f", "#e4e4e0")), lw=0)
        axis.set_title(titles[name], fontsize=11)
        axis.set_aspect("equal")
        axis.axis("off")
    fig.savefig(path, dpi=80)
    plt.close(fig)
