#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks the material library without using any code of brisance.

Reads materials/*.toml, checks the format, and recomputes what can be recomputed from the constants alone:

  JH-2        P_HEL from HEL, G and the equation of state; sound speeds; strengths of the intact surface;
              the bulking pressure of the three cases of Johnson & Holmquist 1994
  JWL         the Chapman-Jouguet state against the D and P_CJ of the burn law
  shock fits  bulk modulus, sound speeds and one Hugoniot state, computed two ways
  gases       initial pressure and sound speed

  tools/check_materials.py            report, exit status 1 on any error
  tools/check_materials.py --table    the Markdown tables only
  tools/check_materials.py --update   write the tables into docs/materials.md between its markers

Needs Python 3.11 and its standard library. Inside: GPa, g/cm3, km/s, mm, us, K.
"""

import argparse
import math
import pathlib
import re
import sys
import tomllib

ROOT = pathlib.Path(__file__).resolve().parent.parent
BEGIN, END = "<!-- tables: begin (tools/check_materials.py --update) -->", "<!-- tables: end -->"

# ------------------------------------------------------------------------------------------------ format

UNITS = {
    "kg/m3": ("density", 1e-3), "g/cm3": ("density", 1.0),
    "GPa": ("pressure", 1.0), "MPa": ("pressure", 1e-3), "kPa": ("pressure", 1e-6),
    "m/s": ("velocity", 1e-3), "km/s": ("velocity", 1.0),
    "1/s": ("rate", 1e-6), "K": ("temperature", 1.0),
    "J/kg/K": ("specific heat", 1e-6), "MJ/kg": ("specific energy", 1.0), "kJ/kg": ("specific energy", 1e-3),
}

P, V, N = "pressure", "velocity", "none"
LAWS = {
    "eos": {
        "polynomial": ({"K1": P, "K2": P, "K3": P}, {}),
        "linear_polynomial": ({"C0": P, "C1": P, "C2": P, "C3": P, "C4": N, "C5": N, "C6": N, "E0": P}, {}),
        "ideal_gas": ({"gamma": N, "E0": P}, {}),
        "mie_gruneisen": ({"C": V, "S1": N, "S2": N, "S3": N, "Gamma0": N, "a": N, "E0": P}, {"pressure_cutoff": P}),
        "jwl": ({"A": P, "B": P, "R1": N, "R2": N, "omega": N, "E0": P}, {}),
    },
    "strength": {
        "jh2": ({"G": P, "A": N, "B": N, "C": N, "M": N, "N": N, "EPS0": "rate", "T": P, "SFMAX": N, "HEL": P, "PHEL": P,
                 "BETA": N, "D1": N, "D2": N, "FS": N}, {"SHEL": P}),
        "johnson_cook": ({"G": P, "A": P, "B": P, "n": N, "C": N, "m": N, "EPS0": "rate", "T_room": "temperature",
                          "T_melt": "temperature", "c_v": "specific heat", "chi": N}, {f"D{i}": N for i in range(1, 6)} | {"damage": N}),
        "elastic": ({"G": P}, {}),
        "hjc": ({"G": P, "A": N, "B": N, "C": N, "N": N, "FC": P, "T": P, "EPS0": "rate", "EFMIN": N, "SFMAX": N, "PC": P, "UC": N, "PL": P,
                 "UL": N, "D1": N, "D2": N, "K1": P, "K2": P, "K3": P}, {}),
    },
    "burn": {"programmed": ({"D": V, "P_CJ": P}, {})},
}
CONFIDENCE = re.compile(r"(S|c|a:[A-Z0-9-]+|b-[HML](/[HML])?)")


class Material:
    """One file: name, numbers by table in internal units, and the texts behind them."""

    def __init__(self, path, complain):
        self.path, self.name = path, path.stem
        text = path.read_text(encoding="utf-8")
        self.raw = raw = tomllib.loads(text)
        say = lambda what: complain(f"{path.name}: {what}")
        if not text.isascii():
            say("not plain ASCII")
        if raw.get("name") != self.name:
            say(f'name is {raw.get("name")!r}, the file is {self.name!r}')
        for key in ("title", "source"):
            if not isinstance(raw.get(key), str) or not raw[key]:
                say(f"{key} missing")
        self.notes = raw.get("notes")
        if not isinstance(self.notes, list) or not all(isinstance(n, str) and n for n in self.notes):
            say("notes must be a list of sentences")
            self.notes = []
        unknown = set(raw) - {"name", "title", "source", "notes", "density", "eos", "strength", "burn"}
        if unknown:
            say(f"unknown keys {sorted(unknown)}")
        self.parameters = []  # (label, entry)
        self.density = self._number("density", raw.get("density"), "density", say)
        self.law, self.values = {}, {}
        for table, laws in LAWS.items():
            if table not in raw:
                if table == "eos":
                    say("no [eos]")
                continue
            entries = dict(raw[table])
            law = entries.pop("law", None)
            if law not in laws:
                say(f"[{table}] law {law!r} is not one of {sorted(laws)}")
                continue
            needed, optional = laws[law]
            for key in sorted(needed.keys() - entries.keys()):
                say(f"[{table}] {key} missing")
            for key in sorted(entries.keys() - needed.keys() - optional.keys()):
                say(f"[{table}] unknown parameter {key}")
            self.law[table] = law
            self.values[table] = {key: self._number(f"{table}.{key}", entry, {**needed, **optional}[key], say)
                                  for key, entry in entries.items() if key in needed or key in optional}
        if (self.law.get("eos") == "jwl") != ("burn" in self.law):
            say("a jwl equation of state and a burn law go together")

    def _number(self, label, entry, dimension, say):
        if not isinstance(entry, dict) or set(entry) != {"value", "source", "confidence"}:
            say(f"{label} must be {{ value, source, confidence }}")
            return math.nan
        self.parameters.append((label, entry))
        if not isinstance(entry["source"], str) or not entry["source"]:
            say(f"{label} has no source")
        if not all(CONFIDENCE.fullmatch(c) for c in str(entry["confidence"]).split(", ")):
            say(f'{label}: confidence {entry["confidence"]!r} is not S, a:KEY, b-H, b-M, b-L, b-M/H, b-L/M, c or a list of them')
        value = entry["value"]
        if dimension == N:
            if isinstance(value, bool) or not isinstance(value, (int, float)):
                say(f"{label} is dimensionless: a bare number")
                return math.nan
            return float(value)
        match = re.fullmatch(r"([-+0-9.eE]+) (\S+)", value) if isinstance(value, str) else None
        if not match or UNITS.get(match[2], (None,))[0] != dimension:
            say(f"{label} = {value!r} is not a {dimension} with a unit")
            return math.nan
        return float(match[1]) * UNITS[match[2]][1]

    def has_known_miss(self):
        return any(n.startswith("Known miss:") for n in self.notes)


# ------------------------------------------------------------------------------------------------ physics

def bisect(f, a, b, steps=200):
    fa = f(a)
    for _ in range(steps):
        m = 0.5 * (a + b)
        fm = f(m)
        if (fm > 0) == (fa > 0):
            a, fa = m, fm
        else:
            b = m
    return 0.5 * (a + b)


def first_root(f, start, step, limit):
    x = start
    while x < limit:
        if (f(x) > 0) != (f(x + step) > 0):
            return bisect(f, x, x + step)
        x += step
    return math.nan


def power(x, n):
    """x^n with the guards JH-2 needs: 0 for x <= 0."""
    return 0.0 if x <= 0 else x ** n


def jh2(m):
    """P_HEL from HEL = P(mu) + 4/3 G mu/(1+mu), wave speeds, and points of the intact strength surface."""
    e, s, rho = m.values["eos"], m.values["strength"], m.density
    pressure = lambda mu: e["K1"] * mu + e["K2"] * mu**2 + e["K3"] * mu**3
    slope = lambda mu: e["K1"] + 2 * e["K2"] * mu + 3 * e["K3"] * mu**2
    mu = first_root(lambda x: pressure(x) + 4 / 3 * s["G"] * x / (1 + x) - s["HEL"], 0.0, 1e-4, 1.0)
    r = {"mu_HEL": mu, "P_HEL calc": pressure(mu), "P_HEL given": s["PHEL"]}
    p_hel = s["PHEL"] or r["P_HEL calc"]
    shel = s.get("SHEL") or 1.5 * (s["HEL"] - p_hel)
    r |= {"P_HEL": p_hel, "sigma_HEL": shel, "miss %": 100 * (r["P_HEL calc"] / s["PHEL"] - 1) if s["PHEL"] else math.nan}
    intact = lambda p: shel * s["A"] * power((p + s["T"]) / p_hel, s["N"])
    K, G = e["K1"], s["G"]
    r |= {"c_L": math.sqrt((K + 4 / 3 * G) / rho), "c_S": math.sqrt(G / rho), "nu": (3 * K - 2 * G) / (6 * K + 2 * G), "E": 9 * K * G / (3 * K + G)}
    r["Y0"] = intact(0.0)
    r["UCS"] = bisect(lambda q: q - intact(q / 3), 1e-9, 100.0)
    r["UTS"] = bisect(lambda q: q - intact(-q / 3), 1e-9, 3 * s["T"])
    r["closure"] = s["A"] * power(1 + s["T"] / p_hel, s["N"])
    r["margin"] = min(intact(pressure(x)) / (2 * G * math.log(1 + x)) for x in (i * 1e-4 for i in range(1, 3000)))  # plane compression, logarithmic strain
    if e["K3"] > 0:
        bottom = min(max(-e["K2"] / (3 * e["K3"]), 0.0), 0.3)
    else:
        bottom = 0.3 if e["K2"] < 0 or e["K3"] < 0 else 0.0  # the least slope up to mu = 0.3 is at one end
    r |= {"slope at": bottom, "least slope": slope(bottom)}
    return r


def jh2_uniaxial(m, strain=0.05, steps=20000):
    """Uniaxial strain to V/V0 = 1 - strain and back: the bulking pressure left at V = V0 and the state at the peak."""
    e, s = m.values["eos"], m.values["strength"]
    r = jh2(m)
    p_hel, shel = r["P_HEL"], r["sigma_HEL"]
    q, dp, d = 0.0, 0.0, 0.0  # q = sigma_x - sigma_z deviator measure, signed: + in compression
    peak = None
    path = [1 - strain * i / steps for i in range(steps + 1)]
    path += path[-2::-1]
    for old, new in zip(path, path[1:]):
        q += 2 * s["G"] * math.log(old / new)
        mu = 1 / new - 1
        p = e["K1"] * mu + dp + (e["K2"] * mu**2 + e["K3"] * mu**3 if mu > 0 else 0)
        if mu <= 0:
            p = max(p, -s["T"] * (1 - d))
        x = (p + s["T"]) / p_hel
        intact = shel * s["A"] * power(x, s["N"])
        broken = shel * s["B"] * power(p / p_hel, s["M"])
        if s["SFMAX"] > 0:
            broken = min(broken, shel * s["SFMAX"])
        yield_old = (1 - d) * intact + d * broken
        if abs(q) > yield_old:
            plastic = (abs(q) - yield_old) / (3 * s["G"])
            to_fracture = s["D1"] * power(x, s["D2"]) if s["D1"] > 0 else 0.0
            grown = min(1.0, d + plastic / to_fracture) if to_fracture > 0 else 1.0
            q = math.copysign(yield_old, q)
            if grown > d:
                d = grown
                yield_new = (1 - d) * intact + d * broken
                q = math.copysign(min(abs(q), yield_new), q)
                if mu > 0:
                    released = (yield_old**2 - yield_new**2) / (6 * s["G"])
                    lifted = e["K1"] * mu + dp
                    dp = -e["K1"] * mu + math.sqrt(lifted**2 + 2 * s["BETA"] * e["K1"] * released)
        if new == 1 - strain:
            peak = (p, abs(q))
    return {"bulking": dp, "peak P": peak[0], "peak q": peak[1]}


def jwl(m):
    """Chapman-Jouguet state: the Rayleigh line from (V=1, P=0) that touches the reacted Hugoniot E = E0 + P (1-V)/2."""
    e, b, rho = m.values["eos"], m.values["burn"], m.density

    def hugoniot(v):
        cold = (e["A"] * (1 - e["omega"] / (e["R1"] * v)) * math.exp(-e["R1"] * v)
                + e["B"] * (1 - e["omega"] / (e["R2"] * v)) * math.exp(-e["R2"] * v))
        return (cold + e["omega"] * e["E0"] / v) / (1 - e["omega"] * (1 - v) / (2 * v))

    rayleigh = lambda v: hugoniot(v) / (1 - v)
    lo, hi = 0.5, 0.95  # golden section; the Rayleigh slope has one minimum here
    g = (math.sqrt(5) - 1) / 2
    for _ in range(200):
        x, y = hi - g * (hi - lo), lo + g * (hi - lo)
        if rayleigh(x) < rayleigh(y):
            hi = y
        else:
            lo = x
    v = 0.5 * (lo + hi)
    p, d = hugoniot(v), math.sqrt(rayleigh(v) / rho)
    u = p / (rho * d)
    return {"V_CJ": v, "P calc": p, "D calc": d, "gamma": rho * d * d / p - 1, "u": u,
            "D err %": 100 * (d / b["D"] - 1), "P err %": 100 * (p / b["P_CJ"] - 1), "e MJ/kg": e["E0"] / rho}


def shock_fit(m, u=0.5):
    """Bulk modulus, sound speeds, and the Hugoniot state at u km/s from the pressure law and from U_s(u_p)."""
    e, rho = m.values["eos"], m.density

    def pressure(mu, energy):
        den = 1 - (e["S1"] - 1) * mu - e["S2"] * mu**2 / (1 + mu) - e["S3"] * mu**3 / (1 + mu) ** 2
        return rho * e["C"] ** 2 * mu * (1 + (1 - e["Gamma0"] / 2) * mu - e["a"] / 2 * mu**2) / den**2 + (e["Gamma0"] + e["a"] * mu) * energy

    def on_hugoniot(mu):  # P = f + g E is linear in E, and E = P mu / (2 (1 + mu))
        f = pressure(mu, 0.0)
        return f / (1 - (pressure(mu, 1.0) - f) * mu / (2 * (1 + mu)))

    # jump conditions: u^2 = P mu / (rho (1 + mu))
    mu = first_root(lambda x: on_hugoniot(x) * x / (rho * (1 + x)) - u * u, 1e-6, 1e-4, 1.0)
    p = on_hugoniot(mu)
    eta = bisect(lambda x: e["C"] * x / (1 - e["S1"] * x - e["S2"] * x**2 - e["S3"] * x**3) - u, 1e-9, mu / (1 + mu) * 1.2)
    us = u / eta
    G = m.values.get("strength", {}).get("G", 0.0)
    return {"K": rho * e["C"] ** 2, "c_L": math.sqrt(e["C"] ** 2 + 4 / 3 * G / rho), "c_S": math.sqrt(G / rho),
            "P": p, "U_s": p / (rho * u), "U_s fit": us, "P fit": rho * us * u, "G": G}


def gas(m):
    e, rho = m.values["eos"], m.density
    p = e["C0"] + e["C4"] * e["E0"]
    return {"P0": p, "c": math.sqrt((e["C1"] + e["C5"] * e["E0"] + p * e["C4"]) / rho)}


def flow_stress(s, strain, rate, temperature):
    hot = min(max((temperature - s["T_room"]) / (s["T_melt"] - s["T_room"]), 0.0), 1.0)
    return (s["A"] + s["B"] * strain ** s["n"]) * (1 + s["C"] * math.log(max(rate / s["EPS0"], 1.0))) * (1 - hot ** s["m"])


# ------------------------------------------------------------------------------------------------ reference values
# Computed by hand-written programs independent of this one when the sets were collected, written as quoted there.
# A value agrees if it is within one unit of the last digit written.

REFERENCE = {
    "barre_granite": {"mu_HEL": "0.0595", "P_HEL calc": "2.860", "sigma_HEL": "2.460", "c_L": "4.543", "c_S": "2.869", "nu": "0.168", "E": "51.2",
                      "Y0": "0.218", "UCS": "0.605", "UTS": "0.109", "closure": "1.265", "margin": "1.021", "least slope": "21.8", "slope at": "0.0101"},
    "barre_granite_286": {"mu_HEL": "0.0563", "P_HEL calc": "2.510", "sigma_HEL": "2.986", "c_L": "4.868", "c_S": "3.244", "nu": "0.100", "E": "61.6",
                          "Y0": "0.286"},
    "granite_ai_ahrens": {"P_HEL calc": "2.760", "miss %": "1.1", "c_L": "5.998"},
    "hard_rock_ma_an": {"mu_HEL": "0.0278561", "P_HEL calc": "3.708647", "sigma_HEL": "1.187030", "least slope": "3.2", "slope at": "0.005"},
    "sandstone_baranowski": {"P_HEL calc": "1.365", "miss %": "-0.7", "c_L": "1.765", "UCS": "0.0900", "UTS": "0.0179"},
    "alumina": {"mu_HEL": "0.0111673", "P_HEL calc": "1.46236", "c_L": "8.23905"},
    "alumina_jh94_a": {"bulking": "0.5623", "peak P": "7.4544", "peak q": "0.0000"},
    "alumina_jh94_b": {"bulking": "0.7147", "peak P": "7.6068", "peak q": "0.0000"},
    "alumina_jh94_c": {"bulking": "0.6497", "peak P": "7.5418", "peak q": "1.6606"},
    "aluminium_nitride": {"P_HEL calc": "5.006"},
    "boron_carbide": {"mu_HEL": "0.0407861", "P_HEL calc": "8.70668", "closure": "0.945"},
    "silicon_carbide": {"P_HEL calc": "6.765"},
    "float_glass": {"P_HEL calc": "2.920"},
    "concrete_jh2": {"UCS": "0.012"},
    "petn_880": {"D calc": "5.0749", "P calc": "6.1793", "V_CJ": "0.72735", "u": "1.3837", "D err %": "-1.8", "P err %": "-0.3"},
    "petn_1260": {"D calc": "6.5238", "P calc": "13.9955", "V_CJ": "0.73902", "u": "1.7026", "D err %": "-0.25", "P err %": "0.0"},
    "petn_1320": {"D calc": "6.7405", "P calc": "15.6534", "V_CJ": "0.73899", "u": "1.7593", "D err %": "0.75", "P err %": "-2.2", "e MJ/kg": "5.59"},
    "petn_1320_cj": {"D calc": "6.6900", "P calc": "16.000"},
    "petn_1320_cj_1565": {"D calc": "6.6900", "P calc": "15.650"},
    "petn_1500": {"D calc": "7.4535", "P calc": "22.0004", "V_CJ": "0.73599", "u": "1.9678", "D err %": "0.05", "P err %": "0.0"},
    "petn_1770": {"D calc": "8.301", "P calc": "33.51", "V_CJ": "0.7252", "u": "2.281", "D err %": "0.0", "P err %": "0.0"},
    "tnt": {"D calc": "6.929", "P calc": "21.00", "V_CJ": "0.7317", "D err %": "0.0", "P err %": "0.0"},
    "tnt_autodyn": {"D err %": "0.0", "P err %": "0.0"},
    "comp_b": {"D calc": "7.980", "P calc": "29.50", "V_CJ": "0.7302", "D err %": "0.0", "P err %": "0.0"},
    "c4": {"D err %": "0.0", "P err %": "0.0"}, "hmx": {"D err %": "-1.3", "P err %": "-4.9"},
    "pbx_9404": {"D err %": "0.0", "P err %": "0.0"}, "lx_14": {"D err %": "0.0", "P err %": "0.0"},
    "octol": {"D err %": "0.07", "P err %": "0.1"}, "cyclotol": {"D err %": "0.0", "P err %": "0.0"},
    "pentolite_1700": {"D err %": "0.0", "P err %": "0.0"}, "pentolite_1650": {"D err %": "0.0", "P calc": "23.5"},
    "nitromethane": {"D err %": "-0.3", "P err %": "0.0"}, "anfo": {"D err %": "-0.02", "P err %": "0.0"},
    "emulsion_1310": {"D err %": "0.0", "P err %": "0.1"}, "emulsion_1180": {"D calc": "5.654", "P calc": "9.60"},
    "comp_b_uintah": {"D calc": "7.980", "P calc": "29.50"}, "qm_100": {"D calc": "5.899", "P calc": "10.17"},
    "copper_ofhc": {"U_s": "4.68450", "c_L": "4.730", "K": "139"},
    "water": {"U_s": "2.35800", "P": "1.179000"}, "polyethylene": {"U_s": "3.64150", "P": "1.665986"},
    "air_paper": {"P0": "1.0025e-4", "c": "0.3345"}, "air": {"P0": "1.01325e-4"},
}
BULK_MODULUS = {"steel_4340": 173.3, "aluminium_6061_t6": 66.4, "copper_ofhc": 129.0, "iron_armco": 173.3}  # elastic data, GPa; iron: that of 4340
FLOW = {(0.1, 1, 294): 233.0154, (0.3, 1e3, 294): 341.3052, (1.0, 1e4, 600): 348.8933}  # copper, MPa

D_TOLERANCE, P_TOLERANCE, PHEL_TOLERANCE, K_TOLERANCE = 1.0, 3.0, 1.5, 20.0  # percent


def last_place(text):
    mantissa, _, exponent = text.partition("e")
    decimals = len(mantissa.partition(".")[2])
    return 10.0 ** (int(exponent or 0) - decimals)


# ------------------------------------------------------------------------------------------------ report

def fmt(x, digits):
    if x is None or (isinstance(x, float) and math.isnan(x)):
        return "-"
    text = f"{x:.{digits}f}"
    return text[1:] if text.lstrip("-0.") == "" and text.startswith("-") else text


def table(head, rows):
    return "\n".join(["| " + " | ".join(head) + " |", "|" + "---|" * len(head)] + ["| " + " | ".join(r) + " |" for r in rows]) + "\n"


def grades(m):
    """The provenance codes of a file and how many numbers carry each, e.g. 'b-H 14, c 3'."""
    count = {}
    for _, entry in m.parameters:
        key = "choice" if entry["source"].startswith("choice:") else entry["confidence"]
        count[key] = count.get(key, 0) + 1
    return ", ".join(f"{k} {n}" for k, n in sorted(count.items(), key=lambda kv: (-kv[1], kv[0])))


def examine(materials, complain):
    """All checks; returns the results by material and the Markdown tables."""
    results, misses = {}, {}
    miss = lambda m, text: misses.setdefault(m.name, []).append(text)
    for m in materials:
        eos, strength = m.law.get("eos"), m.law.get("strength")
        r = results[m.name] = {}
        if strength == "jh2":
            r |= jh2(m)
            if abs(r["miss %"]) > PHEL_TOLERANCE:
                miss(m, f'P_HEL from HEL, G and EOS is {r["P_HEL calc"]:.3f} GPa, {r["miss %"]:+.1f} % on the given {r["P_HEL given"]:g} GPa')
            if r["least slope"] <= 0:
                miss(m, f'dP/dmu falls to {r["least slope"]:.1f} GPa at mu = {r["slope at"]:.3f}: the pressure law has a maximum below that')
            if "_jh94_" in m.name:
                r |= jh2_uniaxial(m)
        if eos == "jwl":
            r |= jwl(m)
            if abs(r["D err %"]) > D_TOLERANCE or abs(r["P err %"]) > P_TOLERANCE:
                miss(m, f'CJ state off by {r["D err %"]:+.1f} % in D and {r["P err %"]:+.1f} % in P')
        if eos == "mie_gruneisen":
            r |= shock_fit(m)
            if abs(r["P"] / r["P fit"] - 1) > 1e-9:
                complain(f"{m.path.name}: pressure law and U_s-u_p fit disagree on the Hugoniot")
            if m.name in BULK_MODULUS and abs(r["K"] / BULK_MODULUS[m.name] - 1) * 100 > K_TOLERANCE:
                miss(m, f'rho C^2 = {r["K"]:.1f} GPa against {BULK_MODULUS[m.name]} GPa in elastic data')
        if eos == "linear_polynomial":
            r |= gas(m)
        for key, text in REFERENCE.get(m.name, {}).items():
            if key not in r:
                complain(f"{m.path.name}: nothing computed for the reference value of {key}")
            elif abs(r[key] - float(text)) > 1.001 * last_place(text):
                complain(f"{m.path.name}: {key} is {r[key]:.6g}, the reference value is {text}")
        if bool(misses.get(m.name)) != m.has_known_miss():
            complain(f'{m.path.name}: ' + ("misses a check without a note 'Known miss: ...': " + "; ".join(misses[m.name]) if m.name in misses
                                           else "has a note 'Known miss: ...' but passes"))
    for name in REFERENCE.keys() - results.keys():
        complain(f"{name}.toml is missing")
    for (strain, rate, temperature), expected in FLOW.items():
        copper = next((m for m in materials if m.name == "copper_ofhc"), None)
        if copper and abs(1e3 * flow_stress(copper.values["strength"], strain, rate * 1e-6, temperature) - expected) > 1e-4:
            complain("copper_ofhc.toml: Johnson-Cook flow stress differs from the reference")

    out = ["### Rock, ceramics, glass: JH-2\n"]
    jh = [m for m in materials if m.law.get("strength") == "jh2"]
    out.append(table(["file", "rho0 kg/m3", "P_HEL given", "P_HEL from HEL, G, EOS", "miss %", "sigma_HEL GPa", "c_L m/s", "c_S m/s", "nu", "Y(P=0) MPa", "UCS MPa", "UTS MPa", "A(1+T*)^N", "codes"],
                     [[f"`{m.name}`", fmt(1e3 * m.density, 0), fmt(r["P_HEL given"], 3) if r["P_HEL given"] else "derive", fmt(r["P_HEL calc"], 3), fmt(r["miss %"], 1), fmt(r["sigma_HEL"], 3),
                       fmt(1e3 * r["c_L"], 0), fmt(1e3 * r["c_S"], 0), fmt(r["nu"], 3), fmt(1e3 * r["Y0"], 0), fmt(1e3 * r["UCS"], 1 if r["UCS"] < 0.1 else 0), fmt(1e3 * r["UTS"], 1), fmt(r["closure"], 3), grades(m)]
                      for m in jh for r in [results[m.name]]]))
    out.append("Benchmark of Johnson & Holmquist 1994 (uniaxial strain to 5 % and back), computed here with 20 000 increments each way:\n")
    published = {"a": 0.56, "b": 0.72, "c": 0.65}
    out.append(table(["file", "bulking pressure GPa", "published", "P at 5 % GPa", "equivalent stress at 5 % GPa"],
                     [[f"`{m.name}`", fmt(r["bulking"], 4), fmt(published[m.name[-1]], 2), fmt(r["peak P"], 3), fmt(r["peak q"], 3)]
                      for m in jh if "bulking" in results[m.name] for r in [results[m.name]]]))
    out.append("### Explosives: JWL\n")
    out.append(table(["file", "rho0 kg/m3", "D m/s", "D of the set", "err %", "P_CJ GPa", "P of the set", "err %", "V_CJ", "gamma", "E0/rho0 MJ/kg", "codes"],
                     [[f"`{m.name}`", fmt(1e3 * m.density, 0), fmt(1e3 * b["D"], 0), fmt(1e3 * r["D calc"], 0), fmt(r["D err %"], 2), fmt(b["P_CJ"], 2), fmt(r["P calc"], 2), fmt(r["P err %"], 2),
                       fmt(r["V_CJ"], 4), fmt(r["gamma"], 3), fmt(r["e MJ/kg"], 2), grades(m)]
                      for m in materials if m.law.get("eos") == "jwl" for r in [results[m.name]] for b in [m.values["burn"]]]))
    for title, solid in (("Metals: Mie-Gruneisen and Johnson-Cook", True), ("Fluids and polymers: Mie-Gruneisen", False)):
        out.append(f"### {title}\n")
        chosen = [m for m in materials if m.law.get("eos") == "mie_gruneisen" and ("strength" in m.law) == solid]
        out.append(table(["file", "rho0 kg/m3", "C m/s", "rho0 C^2 GPa"] + (["K elastic GPa", "c_L m/s", "c_S m/s"] if solid else []) + ["U_s m/s at u_p = 500", "P GPa there", "codes"],
                         [[f"`{m.name}`", fmt(1e3 * m.density, 0), fmt(1e3 * m.values["eos"]["C"], 0), fmt(r["K"], 2 if r["K"] < 20 else 1)]
                          + ([fmt(BULK_MODULUS.get(m.name) if m.name != "iron_armco" else None, 1), fmt(1e3 * r["c_L"], 0), fmt(1e3 * r["c_S"], 0)] if solid else [])
                          + [fmt(1e3 * r["U_s"], 1), fmt(r["P"], 3), grades(m)] for m in chosen for r in [results[m.name]]]))
    out.append("### Air and polynomial water\n")
    out.append(table(["file", "rho0 kg/m3", "P0 kPa", "c m/s", "codes"],
                     [[f"`{m.name}`", fmt(1e3 * m.density, 3), fmt(1e6 * r["P0"], 3), fmt(1e3 * r["c"], 1), grades(m)]
                      for m in materials if m.law.get("eos") == "linear_polynomial" for r in [results[m.name]]]))
    out.append("### Misses\n")
    out.append("\n".join(f"- `{name}`: " + "; ".join(texts) + "." for name, texts in sorted(misses.items())) + "\n")
    return results, "\n".join(out)


def main():
    parser = argparse.ArgumentParser(description="Checks materials/*.toml without using any code of brisance.")
    parser.add_argument("--table", action="store_true", help="print the Markdown tables only")
    parser.add_argument("--update", action="store_true", help="write the tables into docs/materials.md")
    arguments = parser.parse_args()

    problems = []
    complain = problems.append
    materials = []
    for path in sorted((ROOT / "materials").glob("*.toml")):
        try:
            materials.append(Material(path, complain))
        except tomllib.TOMLDecodeError as error:
            complain(f"{path.name}: {error}")
    if not materials:
        complain("no materials found")
    tables = ""
    if not problems:  # numbers can be trusted to be there
        _, tables = examine(materials, complain)

    page = ROOT / "docs" / "materials.md"
    text = page.read_text(encoding="utf-8") if page.exists() else ""
    if text.count(BEGIN) != 1 or text.count(END) != 1:
        complain("docs/materials.md lacks its markers")
    elif tables:
        head, rest = text.split(BEGIN)
        fresh = head + BEGIN + "\n\n" + tables + "\n" + END + rest.split(END)[1]
        if arguments.update:
            page.write_text(fresh, encoding="utf-8")
        elif fresh != text:
            complain("docs/materials.md is out of date: tools/check_materials.py --update")
        keys = {c[2:] for m in materials for _, e in m.parameters for c in e["confidence"].split(", ") if c.startswith("a:")}
        for key in sorted(keys):
            if f"| `{key}` |" not in text:
                complain(f"docs/materials.md does not name the source a:{key}")

    if tables and not arguments.update:
        print(tables)
    if not arguments.table:
        for p in problems:
            print("error:", p, file=sys.stderr)
        print(f"{len(materials)} materials, {sum(len(m.parameters) for m in materials)} numbers, {len(problems)} errors", file=sys.stderr)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
