# SPDX-License-Identifier: Apache-2.0
"""A wave that closes in on a free spherical cavity and comes back from it."""

import numpy as np
from scipy.special import erf

from brisance.exact.sphere import SphericalCavity
from brisance.verification import norm

A, Q0, R0, W = 3.225, 0.02, 9.0, 2.0
K, G, RHO = 25.7, 21.9, 2.66
C = np.sqrt((K + 4 * G / 3) / RHO)


def q(r):
    return Q0 * np.exp(-(((r - R0) / W) ** 2))


def dq(r):
    return -2 * (r - R0) / W**2 * q(r)


def integral(r):
    """of q from the wall."""
    return Q0 * W * np.sqrt(np.pi) / 2 * (erf((r - R0) / W) - erf((A - R0) / W))


# at rest with psi_t = q: half of it runs inwards, half outwards
CAVITY = SphericalCavity(A, RHO, K, G, incoming=lambda t: (integral(A + C * t) / (2 * C), q(A + C * t) / 2, C * dq(A + C * t) / 2),
                         outgoing=lambda t: (-integral(A - C * t) / (2 * C), q(A - C * t) / 2, -C * dq(A - C * t) / 2)).solve(4)


def radial(s):
    """r, u_r, sigma_r, mean of the two others."""
    X = s["X"]
    r = np.linalg.norm(X, axis=1)
    n = X / r[:, None]
    xx, yy, zz, xy, yz, xz = s["stress"].T
    rr = xx * n[:, 0] ** 2 + yy * n[:, 1] ** 2 + zz * n[:, 2] ** 2 + 2 * (xy * n[:, 0] * n[:, 1] + yz * n[:, 1] * n[:, 2] + xz * n[:, 0] * n[:, 2])
    return r, (s["displacement"] * n).sum(axis=1), rr, (xx + yy + zz - rr) / 2


def measure(shot):
    found = {}
    for t in (1.2, 2.2):
        s = shot.at(t)
        r, *have = radial(s)
        inside = r < 9
        want = CAVITY(r[inside], s.time)
        for name, h, w in zip(("displacement", "radial_stress", "hoop_stress"), have, want):
            found[f"{name}_{str(t).replace('.', '_')}_us"] = norm(h[inside], w, np.abs(w).max())
    return found


def figure(shots, path):
    from brisance.style import plt, run_colour, subplots
    fig, axes = subplots(1, 3, size=(12, 3.6))
    grid = np.linspace(A, 12, 300)
    shot = shots[-1]
    for k, t in enumerate((1.2, 1.7, 2.2)):
        s = shot.at(t)
        r, *have = radial(s)
        some = np.flatnonzero(r < 12)[:: max(1, (r < 12).sum() // 5000)]
        want = CAVITY(grid, s.time)
        for ax, h, w, factor, name in zip(axes[0], have, want, (1e6, 1e3, 1e3), ("u$_r$ [nm]", "σ$_r$ [MPa]", "σ$_θ$ [MPa]")):
            ax.plot(r[some], factor * h[some], ".", ms=1.2, color=run_colour(k), label=f"{t} µs")
            ax.plot(grid, factor * w, color="#222222", lw=0.8)
            ax.set(xlabel="r [mm]", title=f"{name}, spacing {shot.spacing:g} mm; line: exact")
    axes[0, 0].legend(markerscale=6)
    fig.savefig(path, dpi=110)
    plt.close(fig)
