# SPDX-License-Identifier: Apache-2.0
"""The laws of the library for arrays of cells, written once more from their equations. Units: GPa, g/cm3, mm, us, K, g mm2/us2 = kJ.

An equation of state gives P = a(mu) + b(mu) e and its sound speed; e is the internal energy per initial volume. A strength turns the
elastic trial deviator (r, theta, z) of a cell into the stress it bears.
"""

import re
import tomllib
from pathlib import Path

import numpy as np

LIBRARY = Path(__file__).resolve().parents[3] / "materials"
UNITS = {"": 1.0, "GPa": 1.0, "MPa": 1e-3, "kPa": 1e-6, "kg/m3": 1e-3, "g/cm3": 1.0, "m/s": 1e-3, "km/s": 1.0, "1/s": 1e-6, "K": 1.0,
         "J/kg/K": 1e-6, "mm": 1.0, "us": 1.0}


def number(entry):
    """A value of a material or case file in the units of this module: a bare number, "4.5 GPa", or {value = ...}."""
    if isinstance(entry, dict):
        entry = entry["value"]
    if not isinstance(entry, str):
        return float(entry)
    match = re.fullmatch(r"\s*(\S+)\s*(.*?)\s*", entry)
    return float(match[1]) * UNITS[match[2]]


class Linear:
    """Shared by all: sound speed from the slopes of a and b, c2 rho0 = dP/dmu at constant entropy, de/dmu = P/(1+mu)^2."""

    def sound_speed(self, mu, e, pressure):
        d = 1e-5
        a0, b0 = self.terms(mu - d)
        a1, b1 = self.terms(mu + d)
        slope = ((a1 - a0) + (b1 - b0) * e) / (2 * d) + self.terms(mu)[1] * pressure / (1 + mu) ** 2
        return np.sqrt(np.maximum(slope, 1e-12) / self.density)


class Polynomial(Linear):
    def __init__(self, p, density):
        self.density, self.k, self.e0, self.cutoff = density, [number(p[f"K{i}"]) for i in (1, 2, 3)], 0.0, -np.inf

    def terms(self, mu):
        k1, k2, k3 = self.k
        return k1 * mu + np.where(mu > 0, k2 * mu**2 + k3 * mu**3, 0.0), np.zeros_like(mu)


class LinearPolynomial(Linear):
    def __init__(self, p, density):
        self.density, self.c, self.e0, self.cutoff = density, [number(p[f"C{i}"]) for i in range(7)], number(p["E0"]), -np.inf

    def terms(self, mu):
        c = self.c
        square = np.where(mu > 0, mu**2, 0.0)
        return c[0] + c[1] * mu + c[2] * square + c[3] * mu**3, c[4] + c[5] * mu + c[6] * square


class MieGruneisen(Linear):
    def __init__(self, p, density):
        self.density, self.c0, self.s, self.gamma, self.a = density, number(p["C"]), number(p["S1"]), number(p["Gamma0"]), number(p["a"])
        self.e0, self.cutoff = number(p["E0"]), number(p.get("pressure_cutoff", -np.inf))

    def terms(self, mu):
        x = np.clip(mu, 0, None)
        cold = self.density * self.c0**2 * x * (1 + (1 - self.gamma / 2) * x - self.a / 2 * x**2) / (1 - (self.s - 1) * x) ** 2
        return cold + self.density * self.c0**2 * np.minimum(mu, 0), self.gamma + self.a * mu


class Jwl(Linear):
    def __init__(self, p, density):
        self.density, self.e0, self.cutoff = density, number(p["E0"]), 0.0
        self.rows, self.omega = [(number(p["A"]), number(p["R1"])), (number(p["B"]), number(p["R2"]))], number(p["omega"])

    def terms(self, mu):
        eta = 1 + mu
        return sum(c * (1 - self.omega * eta / r) * np.exp(-r / eta) for c, r in self.rows), self.omega * eta


def mises(s):
    return np.sqrt(1.5 * (s**2).sum(axis=0))


class JohnsonCook:
    def __init__(self, p, eos, cells):
        self.shear, self.a, self.b, self.n, self.c, self.m = (number(p[k]) for k in ("G", "A", "B", "n", "C", "m"))
        self.rate0, self.span = number(p["EPS0"]), number(p["T_melt"]) - number(p["T_room"])
        self.heat = number(p["chi"]) / (eos.density * number(p["c_v"]))
        self.damage, self.plastic, self.heating = np.zeros(cells), np.zeros(cells), np.zeros(cells)

    def __call__(self, s, pressure, mu, rate):
        soft = (1 + self.c * np.log(np.maximum(rate / self.rate0, 1))) * (1 - np.clip(self.heating / self.span, 0, 1) ** self.m)
        trial = mises(s)
        low, high = np.zeros_like(trial), trial / (3 * self.shear)
        for _ in range(40):  # s_eq - 3 G de = sigma_y(eps + de), by bisection
            de = (low + high) / 2
            above = trial - 3 * self.shear * de > (self.a + self.b * (self.plastic + de) ** self.n) * soft
            low, high = np.where(above, de, low), np.where(above, high, de)
        de = np.where(trial > (self.a + self.b * self.plastic**self.n) * soft, de, 0.0)
        self.plastic, factor = self.plastic + de, 1 - 3 * self.shear * de / np.maximum(trial, 1e-30)
        self.heating = self.heating + self.heat * trial * factor * de
        return s * factor, pressure


class Jh2:
    def __init__(self, p, eos, cells):
        self.shear, self.p, self.k1 = number(p["G"]), {k: number(v) for k, v in p.items() if k != "law"}, eos.k[0]
        hel = self.p["HEL"]
        low, high = 0.0, 0.5
        for _ in range(80):  # HEL = P(mu) + 4/3 G mu/(1 + mu)
            mu = (low + high) / 2
            low, high = (mu, high) if eos.terms(np.array(mu))[0] + 4 / 3 * self.shear * mu / (1 + mu) < hel else (low, mu)
        self.phel = self.p["PHEL"] or float(eos.terms(np.array(low))[0])
        self.shel = 1.5 * (hel - self.phel)
        self.damage, self.plastic, self.bulking = np.zeros(cells), np.zeros(cells), np.zeros(cells)

    def __call__(self, s, pressure, mu, rate):
        p = self.p
        pressure = pressure + self.bulking
        pressure = np.where(mu > 0, pressure, np.maximum(pressure, -p["T"] * (1 - self.damage)))
        c = 1 + p["C"] * np.log(np.maximum(rate / p["EPS0"], 1))
        reach, star = np.maximum(pressure + p["T"], 0) / self.phel, np.maximum(pressure, 0) / self.phel
        intact = self.shel * p["A"] * reach ** p["N"] * c
        fractured = self.shel * np.minimum(p["B"] * star ** p["M"] * c, p["SFMAX"] or np.inf) * (star > 0)
        old = (1 - self.damage) * intact + self.damage * fractured
        trial = mises(s)
        plastic = np.maximum(trial - old, 0) / (3 * self.shear)
        failure = p["D1"] * reach ** p["D2"]
        grown = np.where(plastic > 0, np.minimum(self.damage + np.where(failure > 0, plastic / np.maximum(failure, 1e-30), 1), 1), self.damage)
        new = (1 - grown) * intact + grown * fractured
        lost = np.maximum(old**2 - new**2, 0) / (6 * self.shear)
        base = self.k1 * mu + self.bulking
        bulked = self.bulking + np.sqrt(np.maximum(base**2 + 2 * p["BETA"] * self.k1 * lost, 0)) - base
        self.bulking = np.where((grown > self.damage) & (mu > 0), bulked, self.bulking)
        factor = np.where(trial > old, np.where(grown > self.damage, np.minimum(old, new), old) / np.maximum(trial, 1e-30), 1)
        self.damage, self.plastic = grown, self.plastic + plastic
        return s * factor, pressure


EOS = {"polynomial": Polynomial, "linear_polynomial": LinearPolynomial, "mie_gruneisen": MieGruneisen, "jwl": Jwl}
STRENGTH = {"jh2": Jh2, "johnson_cook": JohnsonCook}


def load(name, cells):
    """(eos, strength or None) of a row of the library, for so many cells."""
    row = tomllib.loads((LIBRARY / f"{name}.toml").read_text(encoding="utf-8"))
    eos = EOS[row["eos"]["law"]](row["eos"], number(row["density"]))
    return eos, STRENGTH[row["strength"]["law"]](row["strength"], eos, cells) if "strength" in row else None
