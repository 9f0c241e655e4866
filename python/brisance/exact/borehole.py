# SPDX-License-Identifier: Apache-2.0
"""A borehole as a problem in one dimension: cylindrical shells in plane strain, a charge that burns at once.

Staggered Lagrangian scheme after Wilkins (1964), nodes with velocity between cells with stress; no particles, no kernels, no contact:
the shells share their nodes (a gap that would open in tension is closed by the cut-off of the fluid beside it). Per radian and unit
length a cell has volume V = (r2^2 - r1^2)/2, and with r = (r1 + r2)/2, v = (v1 + v2)/2 its strain rates e_r = (v2 - v1)/(r2 - r1),
e_theta = v/r satisfy dV/dt = V (e_r + e_theta) exactly; the forces are the partners of these rates, so energy closes to the order of the step.

    /usr/bin/python3 -m brisance.exact.borehole RUN      compares a run's peaks with this reference (plane-strain slices)
"""

import argparse
import sys
import tomllib
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from brisance.exact.materials import load, number


@dataclass
class Shell:
    """One part: a row of the material library between two radii, the edges of its cells in mm."""
    name: str
    material: str
    edges: np.ndarray


class Shells:
    """The state of all shells; `step` moves it on. linear, quadratic: coefficients of the artificial viscosity q."""

    def __init__(self, shells, linear=0.06, quadratic=1.5):
        self.shells, self.linear, self.quadratic = shells, linear, quadratic
        self.r = np.concatenate([s.edges[:-1] for s in shells] + [shells[-1].edges[-1:]])
        self.v = np.zeros_like(self.r)
        self.slices, self.laws, first = [], [], 0
        for s in shells:
            cells = len(s.edges) - 1
            self.slices.append(slice(first, first + cells))
            self.laws.append(load(s.material, cells))
            first += cells
        density = np.empty(first)
        self.energy = np.empty(first)  # per initial volume
        for part, (eos, _) in zip(self.slices, self.laws):
            density[part], self.energy[part] = eos.density, eos.e0
        self.rho0 = density
        self.volume0 = self.volume()
        self.s = np.zeros((3, first))  # deviator: r, theta, z
        self.p, self.q, self.c = np.zeros(first), np.zeros(first), np.ones(first)
        mass = density * self.volume0
        self.mass = np.zeros_like(self.r)
        self.mass[:-1] += mass / 2
        self.mass[1:] += mass / 2
        self.t, self.dt = 0.0, 0.0
        self._stress(np.zeros(first), np.zeros((3, first)), 1.0)
        self.start = self.total_energy()

    def volume(self):
        return np.diff(self.r**2) / 2

    def total_energy(self):
        return float(self.energy @ self.volume0 + 0.5 * self.mass @ self.v**2)

    def _stress(self, divergence, rates, dt):
        """Pressure, deviator, viscosity and sound speed at the present radii; rates: e_r, e_theta, e_z of the step before."""
        mu = self.volume0 / self.volume() - 1
        deviator = rates - divergence / 3
        effective = np.sqrt(2 / 3 * (deviator**2).sum(axis=0))
        for part, (eos, strength) in zip(self.slices, self.laws):
            a, b = eos.terms(mu[part])
            pressure = np.maximum(a + b * self.energy[part], eos.cutoff)
            shear = 0.0
            if strength:
                trial = self.s[:, part] + 2 * strength.shear * dt * deviator[:, part]
                self.s[:, part], pressure = strength(trial, pressure, mu[part], effective[part])
                shear = 4 / 3 * strength.shear / eos.density
            self.p[part] = pressure
            self.c[part] = np.sqrt(eos.sound_speed(mu[part], self.energy[part], pressure) ** 2 + shear)
        width, rho = np.diff(self.r), self.rho0 * (1 + mu)
        jump = np.maximum(-divergence * width, 0)
        self.q = rho * jump * (self.quadratic**2 * jump + self.linear * self.c)

    def step(self, limit):
        width = np.diff(self.r)
        speed = self.c + 2 * self.quadratic**2 * np.maximum(-np.diff(self.v), 0)
        dt_new = min(0.4 * float((width / speed).min()), 1.05 * self.dt if self.dt else np.inf, limit)
        radial, hoop = self.s[0] - self.p - self.q, self.s[1] - self.p - self.q
        middle = (self.r[1:] + self.r[:-1]) / 2
        force = np.zeros_like(self.r)
        force[:-1] += radial * middle - hoop * width / 2
        force[1:] -= radial * middle + hoop * width / 2
        self.v = self.v + 0.5 * (self.dt + dt_new) * force / self.mass
        self.v[0] = 0.0 if self.r[0] == 0 else self.v[0]
        dt = self.dt = dt_new
        r_old = self.r
        self.r = self.r + dt * self.v
        half = (self.r + r_old) / 2
        wide, mid = np.diff(half), (half[1:] + half[:-1]) / 2
        e_r, e_t = np.diff(self.v) / wide, (self.v[1:] + self.v[:-1]) / 2 / mid
        rates = np.array([e_r, e_t, np.zeros_like(e_r)])
        volume = wide * mid
        before = self.p.copy(), self.s.copy()
        divergence = e_r + e_t
        # work with the old stress first (predictor), then with the mean of old and new (corrector)
        def work(p, s):
            return dt * volume / self.volume0 * (s[0] * e_r + s[1] * e_t - (p + self.q) * divergence)
        energy = self.energy
        self.energy = energy + work(*before)
        self._stress(divergence, rates, dt)
        self.energy = energy + work((before[0] + self.p) / 2, (before[1] + self.s) / 2)
        self.t += dt


def peaks(model, until):
    """Runs to `until` [us]; the largest pressure and radial stress (compression positive, GPa) a cell has borne, and its energy residual."""
    pressure, radial = model.p.copy(), -model.s[0] + model.p
    steps = 0
    while model.t < until:
        model.step(until - model.t)
        np.maximum(pressure, model.p, out=pressure)
        np.maximum(radial, model.p - model.s[0], out=radial)
        steps += 1
    return pressure, radial, steps


def edges(inner, outer, spacing, far=None, start=0.0, growth=0.0):
    """Edges of cells between two radii; with `far` the width grows as the rock's spacing does in a case."""
    at = [inner]
    while at[-1] < outer - 1e-9:
        width = spacing if far is None else min(far, spacing + growth * max(0.0, at[-1] - start))
        at.append(at[-1] + width)
    count = len(at) - 1
    return inner + (np.array(at) - inner) * (outer - inner) / (at[count] - inner)


def of_case(case, refine):
    """Shells of a resolved case (the case.toml of a run): its round parts about one axis, each spacing divided by `refine`."""
    shells = []
    for name in case["parts"]:
        part = case["part"][name]
        (kind, shape), = part["shape"].items()
        if kind == "cylinder":
            inner, outer = 0.0, number(shape["radius"])
        elif kind == "annulus":
            inner, outer = number(shape["inner_radius"]), number(shape["outer_radius"])
        else:
            raise SystemExit(f"part {name}: a {kind} is no shell about an axis")
        shells.append([inner, outer, name, part])
    shells.sort(key=lambda s: s[1])
    made, reach = [], 0.0
    for _, outer, name, part in shells:  # the later part of a case has cut its room out of the earlier ones
        made.append(Shell(name, part["material"], edges(reach, outer, number(part["spacing"]) / refine, number(part["spacing_far"]) / refine,
                                                         number(part.get("grading_radius", 0)), float(part.get("grading_growth", 0)))))
        reach = outer
    return made


def main():
    parser = argparse.ArgumentParser(prog="brisance.exact.borehole", description=__doc__.split("\n")[0])
    parser.add_argument("run", type=Path, help="a run directory, or a resolved case file")
    parser.add_argument("--refine", type=float, default=4, help="cells per spacing of the run")
    parser.add_argument("--until", type=float, default=30, help="us")
    args = parser.parse_args()
    file = args.run / "case.toml" if args.run.is_dir() else args.run
    model = Shells(of_case(tomllib.loads(file.read_text(encoding="utf-8")), args.refine))
    pressure, radial, steps = peaks(model, args.until)
    rock = model.slices[-1]
    edge = model.shells[-1].edges
    middle = (edge[1:] + edge[:-1]) / 2
    print(f"{steps} steps, energy residual {abs(model.total_energy() / model.start - 1):.1e}")
    print(" r [mm]   peak P [GPa]   peak -sigma_r [GPa]   D")
    for r in (3.3, 4, 5.2, 6.5, 9.6, 13.2, 18, 23.2, 30, 42.7, 55, 63.2):
        print(f"{r:7.1f} {np.interp(r, middle, pressure[rock]):12.4f} {np.interp(r, middle, radial[rock]):16.4f} {np.interp(r, middle, model.laws[-1][1].damage):14.3f}")
    fit = (middle > 8) & (middle < 48)
    if radial[rock][fit].min() < 0.01:
        return  # the wave is not there yet
    print("exponents 8-48 mm:", *(f"{np.polyfit(np.log(middle[fit]), np.log(x[rock][fit]), 1)[0]:.2f}" for x in (pressure, radial)))


if __name__ == "__main__":
    sys.exit(main())
