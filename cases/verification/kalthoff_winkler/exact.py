# SPDX-License-Identifier: Apache-2.0
"""Angle, speed and start of the crack that leaves the tip of the notch."""

import numpy as np

from brisance.verification import scaled

RAYLEIGH = 2.803   # km/s: E = 190 GPa, nu = 0.3, 8 g/cm3
TIP_X = 50.0


def crack(snapshot, spacing):
    """Particles that failed beyond the tip of the notch, in its own layer: x, y from the tip, time of failure."""
    tip_y = 25 + 1.2 * spacing
    p = snapshot.where(snapshot["damage"] >= 1)
    x, y = p["X"][:, 0] - TIP_X, p["X"][:, 1] - tip_y
    r = np.hypot(x, y)
    mine = (r > 3) & (r < 60) & (y > 0.7 * abs(x))  # later a second crack comes from the far side, and stops 12 mm beside the tip
    return x[mine], y[mine], p["failure_time"][mine]


def measure(shot):
    x, y, t = crack(shot.snapshot(-1), shot.spacing)
    r = np.hypot(x, y)
    # angle of the line from the tip that fits best, over the length that is there; at least 20 mm
    length = r.max() if r.size else 0.0
    angle = np.degrees(np.arctan2((r * y).sum(), (r * x).sum())) if length > 20 else float("nan")
    # the front: the latest place reached, every millimetre
    edges = np.arange(5, min(length, 55), 1.0)
    arrival = np.array([t[abs(r - e) < 1.5].min() if (abs(r - e) < 1.5).any() else np.nan for e in edges])
    good = np.isfinite(arrival)
    speed = np.polyfit(arrival[good], edges[good], 1)[0] if good.sum() > 5 else float("nan")
    start = t[r < 6].min() if (r < 6).any() else float("nan")
    return {"angle": scaled(angle, 67.5, 1.0), "speed": scaled(speed / RAYLEIGH, 0.5, 1.0), "start": scaled(start, 25.0, 1.0)}


def figure(shots, path):
    from brisance.style import plt, subplots
    fig, axes = subplots(1, len(shots), size=(4.4 * len(shots), 4.2))
    for ax, shot in zip(axes[0], shots):
        s = shot.snapshot(-1)
        layer = s.where(s["X"][:, 2] > s["X"][:, 2].max() - shot.spacing)
        ax.scatter(layer["X"][:, 0], layer["X"][:, 1], c=np.where(layer["damage"] >= 1, "#0072b2", np.where(layer["damage"] > 0, "#e69f00", "#dcdad4")), s=(1.4 * shot.spacing) ** 2, lw=0)
        for a in (60, 75):
            ax.plot([TIP_X, TIP_X + 70 * np.cos(np.radians(a))], [26, 26 + 70 * np.sin(np.radians(a))], color="#222222", lw=0.7, ls="--")
        ax.set(aspect="equal", xlim=(-5, 101), title=f"{shot.name}, {shot.spacing:g} mm, {s.time:.0f} µs; dashed: 60°, 75°")
    fig.savefig(path, dpi=110)
    plt.close(fig)
