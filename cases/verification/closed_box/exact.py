# SPDX-License-Identifier: Apache-2.0
"""Nothing is lost: mass, momentum with what the walls took, energy with what the charge gave."""

import numpy as np

from brisance.verification import scaled

A_HAIR = 0.06  # mm, a tenth of the spacing of air (expected.toml)


def measure(shot):
    a = shot.audit
    end = shot.snapshot(-1)
    released = a["burn_released"][-1]
    return {"energy": scaled(a["residual"][np.argmax(np.abs(a["residual"]))] / released, 0, 1), "momentum": scaled(a["momentum_residual"].max(), 0, 1),
            "leaked": scaled(a["leaked"].max(), 0, 1), "beyond_the_wall": scaled((np.abs(end["x"][:, :2]) > 14 + A_HAIR).any(axis=1).sum(), 0, 1),
            "steps": scaled(min(a["step"][-1] / 1e4, 1.0), 1, 1)}


def figure(shots, path):
    from brisance.style import plt, run_colour, subplots
    fig, axes = subplots(1, 2, size=(10, 4.4))
    shot = shots[-1]
    a, s = shot.audit, shot.snapshot(-1)
    for k, name in enumerate(shot.run.parts):
        p = s.part(name)
        axes[0, 0].plot(p["x"][:, 0], p["x"][:, 1], ".", ms=2, color=run_colour(k), label=name)
        axes[0, 1].plot(a["t"], a[f"internal.{name}"] - a[f"internal.{name}"][0], lw=1, color=run_colour(k))
    axes[0, 1].plot(a["t"], a["kinetic"], lw=1, color="#888888", ls="--", label="kinetic")
    axes[0, 1].plot(a["t"], a["burn_released"], lw=1, color="#222222", label="released")
    axes[0, 0].set(aspect="equal", title=f"{s.time:.0f} µs")
    axes[0, 0].legend(markerscale=4, loc="upper center", bbox_to_anchor=(0.5, -0.08), ncol=6, columnspacing=0.8, handletextpad=0.1)
    axes[0, 1].set(xlabel="t [µs]", title="gain of internal energy by part [J]; residual "f"{np.abs(a['residual_relative']).max():.1e}")
    axes[0, 1].legend()
    fig.savefig(path, dpi=110)
    plt.close(fig)
