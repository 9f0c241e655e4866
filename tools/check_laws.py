#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Holds the constitutive laws of the program against closed forms, published numbers and independent computations.

Every number comes out of `brisance material`, which sends a point through the lines that particles go through; every reference is written
here by hand or computed here without code of the program.

  tools/check_laws.py             print the tables; exit status 1 where a tolerance is missed
  tools/check_laws.py --update    write docs/laws.md
  tools/check_laws.py --figures   write docs/images/law_*.png
  tools/check_laws.py --check     also: does docs/laws.md say the same

The program: BRISANCE, or build/release/brisance. Inside: GPa, g/cm3, km/s, mm, us, K, as in the program.
"""

import argparse
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = os.environ.get("BRISANCE", str(ROOT / "build" / "release" / "brisance"))
PAGE = ROOT / "docs" / "laws.md"

# ------------------------------------------------------------------------------------------------ driving


def call(*arguments):
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, cwd=ROOT)
    if done.returncode:
        raise SystemExit(f"brisance {' '.join(map(str, arguments))}: {done.stderr}")
    return done.stdout


def curves(material, *options):
    """The curves of `brisance material`: a list of {column: array} with their names."""
    data = json.loads(call("material", material, *options, "--json"))
    return [{k: (np.array(v) if isinstance(v, list) else v) for k, v in path.items()} for path in data["paths"]]


def curve(material, *options):
    return curves(material, *options)[0]


def variant(folder, name, base, changes, drop=()):
    """A material file with other numbers: {"eos.a": 0.47, "density": '"8930 kg/m3"'}."""
    lines, table = [], ""
    for line in (ROOT / "materials" / f"{base}.toml").read_text(encoding="utf-8").splitlines():
        header = re.fullmatch(r"\[(\w+)\]", line)
        table = header[1] if header else table
        if table in drop:
            continue
        key = re.match(r"(\w+)\s*=", line)
        label = key and (f"{table}.{key[1]}" if table else key[1])
        if label == "name":
            line = f'name = "{name}"'
        elif label in changes:
            line = f'{key[1]} = {{ value = {changes[label]}, source = "variant", confidence = "c" }}'
        lines.append(line)
    path = pathlib.Path(folder) / f"{name}.toml"
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def at(x, y, where):
    """y where x first passes `where` (x and y of a curve), linear between rows."""
    x, y = np.asarray(x), np.asarray(y)
    crossing = np.nonzero((x[:-1] < where) & (x[1:] >= where))[0]
    if not len(crossing):
        raise SystemExit(f"{where} is not on the path")
    i = crossing[0]
    return y[i] + (where - x[i]) / (x[i + 1] - x[i]) * (y[i + 1] - y[i])


# ------------------------------------------------------------------------------------------------ tables

COLUMNS = ["what", "value", "reference", "unit", "deviation", "tolerance"]


class Table:
    def __init__(self, title, command, reference):
        self.title, self.command, self.reference, self.rows = title, command, reference, []

    def row(self, what, value, reference, unit, relative=None, absolute=None):
        """A tolerance as a share of the reference, or in its unit."""
        limit = absolute if absolute is not None else relative * abs(reference)
        off = value - reference
        self.rows.append((what, value, reference, unit, off, limit, absolute is None))

    def failures(self):
        return [f"{self.title}: {what} is {value:.7g} {unit}, the reference is {ref:.7g}"
                for what, value, ref, unit, off, limit, _ in self.rows if not abs(off) <= limit]

    def markdown(self):
        out = [f"## {self.title}\n", f"`{self.command}`\n", f"Reference: {self.reference}\n",
               "| " + " | ".join(COLUMNS) + " |", "|" + "---|" * len(COLUMNS)]
        for what, value, ref, unit, off, limit, relative in self.rows:
            if relative:
                deviation, tolerance = f"{100 * off / abs(ref):+.1g} %", f"{100 * limit / abs(ref):.2g} %"
            else:
                deviation, tolerance = f"{off:+.1g}", f"{limit:.2g}"
            value = 0.0 if abs(value) < 1e-9 else value
            out.append(f"| {what} | {value:.6g} | {ref:.6g} | {unit} | {deviation} | {tolerance} |")
        return "\n".join(out) + "\n"


# Independent integration (1e5 increments, logarithmic strain) of cases A, B, C of Johnson & Holmquist 1994, and points digitised from their
# published curves (0.03 GPa).
JH94 = {
    "a": {"P5": 7.454447, "q5": 0.0, "bulking": 0.562342, "plastic": 0.02673, "q max": 2.0199, "published": {"bulking": 0.56, "P5": 7.459}},
    "b": {"P5": 7.60676, "q5": 0.0, "bulking": 0.71466, "plastic": 0.02190, "q max": 2.1358, "P failed": 5.8745,
          "q": {2: 2.1282, 3: 2.0078, 4: 1.5502, 5: 0.8226, 5.5: 0.3717}, "D": {2: 0.1053, 3: 0.3259, 4: 0.5579, 5: 0.7936},
          "published": {"bulking": 0.72, "P5": 7.574, "q max": 2.112, "P failed": 5.825}},
    "c": {"P5": 7.54178, "q5": 1.66060, "bulking": 0.64968, "plastic": 0.01982, "q max": 2.2565, "P failed": 6.0268,
          "q": {2: 2.1791, 3: 2.2515, 4: 2.1166, 5: 1.8404, 5.5: 1.6623}, "D": {2: 0.1226, 3: 0.3594, 4: 0.5861, 5: 0.7981},
          "published": {"bulking": 0.65, "P5": 7.555, "q5": 1.650, "q max": 2.248, "P failed": 6.03, "P turned": 6.274}},
}


def jh2_cases():
    for name, ref in JH94.items():
        c = curve(f"alumina_jh94_{name}", "--steps", 20000)
        t = Table(f"JH-2, case {name.upper()} of 1994", f"./brisance material alumina_jh94_{name} --steps 20000",
                  "independent integration with 100 000 increments; published: curves of Johnson & Holmquist 1994, digitised to 0.03 GPa")
        load, back = c["leg"] <= 1, c["leg"] == 2
        P, q, D = c["pressure"], c["mises"], c["damage"]
        first_plastic = np.nonzero(c["plastic_strain"] > 0)[0][0] - 1
        t.row("elastic limit, P", P[first_plastic], 1.475104, "GPa", 0.005)
        t.row("elastic limit, Mises stress", q[first_plastic], 2.019883, "GPa", 0.005)
        end = np.nonzero(load)[0][-1]
        have = {"P5": P[end], "q5": q[end], "bulking": P[-1], "q max": q.max(), "plastic": c["plastic_strain"][end]}
        if "P failed" in ref:
            have["P failed"] = P[load][np.nonzero(D[load] >= 1)[0][0]]
        if name == "c":
            have["P turned"] = P[back][np.argmin(q[back])]
        say = {"P5": "P at 5 %", "q5": "Mises stress at 5 %", "bulking": "bulking pressure after unloading", "q max": "largest Mises stress",
               "P failed": "P at D = 1", "P turned": "unloading: P where the Mises stress is 0", "plastic": "plastic strain at 5 %"}
        for key in ("q max", "P failed", "P5", "q5", "plastic", "bulking"):
            if key in ref:
                t.row(say[key], have[key], ref[key], "-" if key == "plastic" else "GPa", **({"relative": 0.005} if ref[key] else {"absolute": 1e-9}))
        for p, value in ref.get("q", {}).items():
            t.row(f"Mises stress at P = {p:g} GPa", at(P[load], q[load], p), value, "GPa", 0.005)
        for p, value in ref.get("D", {}).items():
            t.row(f"damage at P = {p:g} GPa", at(P[load], D[load], p), value, "-", 0.005)
        for key, value in ref["published"].items():
            t.row(f"published: {say[key]}", have[key], value, "GPa", absolute=0.01 if key == "bulking" else 0.06 if key == "P failed" else 0.04)
        yield t


def jh2_points(folder):
    t = Table("JH-2, tension, rate, wave speeds", "./brisance material alumina_jh94_c --path uniaxial_strain_tension --steps 100000; barre_granite",
              "closed forms; strengths of the granite: roots of q = Y(±q/3) and P_HEL of HEL = P + 4/3 G mu/(1 + mu), computed independently")
    c = curve("alumina_jh94_c", "--path", "uniaxial_strain_tension", "--steps", 100000)
    i = np.nonzero(c["plastic_strain"] > 0)[0][0] - 1
    t.row("case C pulled: P at yield", c["pressure"][i], -0.158777, "GPa", 0.001)
    t.row("case C pulled: Mises stress at yield", c["mises"][i], 0.218770, "GPa", 0.001)
    t.row("case C pulled: axial stress at yield", c["stress_z"][i], 0.304623, "GPa", 0.001)
    hydro = curve("alumina_jh94_c", "--path", "hydrostatic_tension", "--steps", 2000)
    t.row("case C, equal extension: cut-off at -T", hydro["pressure"].min(), -0.2, "GPa", 1e-9)
    # two thirds of the axial rate is the equivalent deviatoric rate of uniaxial strain
    fast, slow = (curve("barre_granite", "--rate", r, "--steps", 100, "--strain", 0.001) for r in ("1.5e4 1/s", "1e-3 1/s"))
    t.row("granite: rate factor at 1e4 1/s", fast["yield"][50] / slow["yield"][50], 1 + 0.0051 * math.log(1e4), "-", 1e-6)
    t.row("granite: P wave", slow["sound_speed"][0], 4.54303, "km/s", 1e-5)
    remarks = " ".join(next(m for m in json.loads(call("materials", "--json")) if m["name"] == "barre_granite")["remarks"])
    number = lambda before: float(re.search(before + r" ([-\d.]+)", remarks)[1])
    t.row("granite: P_HEL from HEL", number("PHEL ="), 2.860, "GPa", 0.0005)
    t.row("granite: sigma_HEL", number("SHEL ="), 2.460, "GPa", 0.0005)
    t.row("granite: strength at P = 0", number("at P = 0:"), 218, "MPa", absolute=0.6)
    t.row("granite: uniaxial tensile strength", number("tension"), 109, "MPa", absolute=0.6)
    t.row("granite: uniaxial compressive strength", number("compression"), 605, "MPa", absolute=0.6)
    pull = curve("barre_granite", "--path", "tension", "--steps", 4000, "--rate", "1 1/s")
    t.row("granite pulled with free sides: peak stress", 1e3 * pull["stress_z"].max(), 109, "MPa", absolute=1.0)
    press = curve("barre_granite", "--path", "compression", "--steps", 4000, "--rate", "1 1/s")
    t.row("granite pressed with free sides: peak stress", -1e3 * press["stress_z"].min(), 605, "MPa", 0.01)
    other = curve("barre_granite_286", "--path", "hydrostatic", "--steps", 10, "--rate", "1e-6 1/s")
    t.row("barre_granite_286: strength at P = 0", 1e3 * other["yield"][0], 286, "MPa", absolute=1.0)
    yield t


def johnson_cook(folder):
    cold = variant(folder, "copper_cold", "copper_ofhc", {"strength.chi": "0"})
    t = Table("Johnson-Cook, OFHC copper", "./brisance material copper_ofhc --path shear --strain 1.9 --rate \"1732.05 1/s\" --steps 8000",
              "closed form of the flow stress at constant temperature (chi = 0); adiabatic paths integrated independently. Shear gives the equivalent rate gamma'/sqrt 3")
    for strain, rate, stress in ((0.1, 1.0, 233.0154), (0.3, 1e3, 341.3052), (1.0, 1e4, 469.9588)):
        c = curve(cold, "--path", "shear", "--strain", f"{1.8 * strain + 0.05}", "--rate", f"{math.sqrt(3) * rate} 1/s", "--steps", 8000)
        t.row(f"eps_p = {strain:g}, {rate:g} 1/s, 294 K", 1e3 * at(c["plastic_strain"], c["mises"], strain), stress, "MPa", 1e-5)
    for rate, stress, temperature in ((1e3, 416.478, 386.955), (1e4, 435.220, 391.338), (1e5, 453.803, 395.704)):
        c = curve("copper_ofhc", "--path", "shear", "--strain", "1.9", "--rate", f"{math.sqrt(3) * rate} 1/s", "--steps", 8000)
        t.row(f"adiabatic to eps_p = 1 at {rate:g} 1/s: flow stress", 1e3 * at(c["plastic_strain"], c["mises"], 1.0), stress, "MPa", 0.002)
        t.row(f"adiabatic to eps_p = 1 at {rate:g} 1/s: temperature", 294 + at(c["plastic_strain"], c["heating"], 1.0), temperature, "K", 0.0005)
    yield t


# u_p: U_s km/s, P GPa, density g/cm3, e MJ/kg, c km/s
HUGONIOTS = {
    "copper": (("copper_ofhc", {"density": '"8930 kg/m3"'}, ("strength",)),
               {0.1: (4.08890, 3.651388, 9.153871, 0.005, 4.13329), 0.25: (4.31225, 9.627098, 9.479572, 0.03125, 4.40850),
                0.5: (4.68450, 20.916293, 9.997033, 0.125, 4.83676), 1.0: (5.42900, 48.480970, 10.946256, 0.5, 5.61599)}),
    "water": (("water", {}, ()),
              {0.05: (1.57050, 0.078525, 1.032884, 0.00125, 1.60733), 0.1: (1.65800, 0.165800, 1.064185, 0.005, 1.73072),
               0.5: (2.35800, 1.179000, 1.269107, 0.125, 2.72120), 1.0: (3.23300, 3.233000, 1.447828, 0.5, 4.03048)}),
    "polyethylene": (("polyethylene", {}, ()),
                     {0.1: (3.04910, 0.278993, 0.946026, 0.005, None), 0.5: (3.64150, 1.665986, 1.060631, 0.125, None),
                      1.0: (4.38200, 4.009530, 1.185550, 0.5, None), 2.0: (5.86300, 10.729290, 1.388725, 2.0, None)}),
}


def hugoniots(folder):
    for name, ((base, changes, drop), states) in HUGONIOTS.items():
        path = variant(folder, f"{name}_hugoniot", base, changes, drop)
        t = Table(f"Mie-Grüneisen, Hugoniot of {name}", f"./brisance material {base} --path shock --velocity \"{max(states):g} km/s\"",
                  "U_s = C + S u_p, jump conditions" + ("; density 8.93 g/cm3, no strength" if drop else ""))
        for u, (us, p, rho, e, sound) in states.items():
            c = curve(path, "--path", "shock", "--velocity", f"{u} km/s", "--steps", 4)
            for what, column, ref, unit in (("U_s", "shock_speed", us, "km/s"), ("P", "pressure", p, "GPa"), ("density", "density", rho, "g/cm3"),
                                            ("e", "specific_energy", e, "MJ/kg"), ("c", "sound_speed", sound, "km/s")):
                if ref is not None:
                    t.row(f"u_p = {u:g} km/s: {what}", c[column][-1], ref, unit, 1e-5)
        yield t


JWL_ISENTROPE = {1: (6.664683, 6.739106, 3.7227), 2: (1.137347, 3.939323, 2.1061), 4: (0.226013, 2.958226, 1.0943), 7: (0.101513, 2.517634, 0.8339),
                 10: (0.064203, 2.276678, 0.7897), 20: (0.026402, 1.872454, 0.7161)}
CJ = {"petn_1770": (0.72525, 33.5086, 8.3008, 2.2807, 6.0201), "petn_1500": (0.73599, 22.0004, 7.4535, 1.9678, 5.4857),
      "petn_1260": (0.73902, 13.9955, 6.5238, 1.7026, 4.8212), "petn_880": (0.72735, 6.1793, 5.0749, 1.3837, 3.6912),
      "petn_1320": (0.73899, 15.6534, 6.7405, 1.7593, 4.9812), "tnt": (0.73169, 20.9997, 6.9294, 1.8592, 5.0701),
      "comp_b": (0.73020, 29.4988, 7.9799, 2.1530, 5.8269)}


CJ_SETS = {"petn_1770": {"eos.A": '"617 GPa"'}, "tnt": {"eos.A": '"371.2 GPa"', "eos.B": '"3.231 GPa"'}, "comp_b": {"eos.A": '"524.2 GPa"'}}  # as in the reference


def jwl(folder):
    t = Table("JWL, isentrope of PETN at 1.32 g/cm3", "./brisance material petn_1320 --path release --volume 20 --steps 20000",
              "P_s = A e^(-R1 V) + B e^(-R2 V) + C V^-(1+omega) and its energy, C from the CJ state")
    c = curve("petn_1320", "--path", "release", "--volume", 20, "--steps", 20000)
    out = c["leg"] == 2
    for v, (p, e, sound) in JWL_ISENTROPE.items():
        get = lambda column: c[column][-1] if v == 20 else at(c["volume"][out], c[column][out], v)
        t.row(f"V = {v}: P", get("pressure"), p, "GPa", 2e-5)
        t.row(f"V = {v}: E", get("energy"), e, "GPa", 1e-5)
        t.row(f"V = {v}: c", get("sound_speed"), sound, "km/s", 1e-4)
    t.row("burnt at constant volume: P", c["pressure"][0], 6.8454, "GPa", 1e-5)
    t.row("burnt at constant volume: c", c["sound_speed"][0], 3.7462, "km/s", 2e-5)
    yield t
    t = Table("JWL, Chapman-Jouguet states", "./brisance material NAME --path shock", "least slope of the Rayleigh line on the Hugoniot of the products, computed independently; "
              "petn_1770, tnt and comp_b with the digits of A and B that the reference has (617; 371.2, 3.231; 524.2 GPa)")
    for name, (v, p, d, u, sound) in CJ.items():
        c = curve(variant(folder, name + "_cj", name, CJ_SETS[name]) if name in CJ_SETS else name, "--path", "shock")
        for what, column, ref, unit in (("V", "volume", v, "-"), ("P", "pressure", p, "GPa"), ("D", "shock_speed", d, "km/s"), ("u", "particle_velocity", u, "km/s"),
                                        ("c = D - u", "sound_speed", sound, "km/s")):
            t.row(f"{name}: {what}", c[column][-1], ref, unit, 3e-5)
    yield t


def gases_and_solids(folder):
    t = Table("Air, elastic rock", "./brisance material air_paper --path release ...; a path file", "P V^gamma; Hooke; for shear the closed form of the Jaumann rate, G sin gamma")
    for v in (0.2, 5.0):
        path = pathlib.Path(folder) / f"volume_{v:g}.toml"
        path.write_text(f"steps = 4000\n[[leg]]\nvolume = {v}\n", encoding="utf-8")
        c = curve("air_paper", "--path", path)
        if v < 1:
            t.row("air at rest: P", 1e6 * c["pressure"][0], 100.25, "kPa", 1e-9)
            t.row("air at rest: c", 1e3 * c["sound_speed"][0], 334.5, "m/s", absolute=0.06)
        t.row(f"air, adiabatic to V = {v:g}: P/P_0", c["pressure"][-1] / c["pressure"][0], v ** -1.401, "-", 1e-5)
    rock = pathlib.Path(folder) / "elastic_rock.toml"
    number = lambda x: f'{{ value = {x}, source = "closed form", confidence = "c" }}'
    rock.write_text(f'name = "elastic_rock"\ntitle = "t"\nsource = "granite"\nnotes = ["n"]\ndensity = {number(chr(34) + "2660 kg/m3" + chr(34))}\n[eos]\nlaw = "polynomial"\n'
                    f'K1 = {number(chr(34) + "25.7 GPa" + chr(34))}\nK2 = {number(chr(34) + "0 GPa" + chr(34))}\nK3 = {number(chr(34) + "0 GPa" + chr(34))}\n[strength]\nlaw = "elastic"\n'
                    f'G = {number(chr(34) + "21.9 GPa" + chr(34))}\n', encoding="utf-8")
    c = curve(rock, "--path", "compression", "--strain", 1e-5, "--steps", 10)
    K, G = 25.7, 21.9
    t.row("rock, sides free: E", c["stress_z"][-1] / c["strain_z"][-1], 9 * K * G / (3 * K + G), "GPa", 1e-4)
    t.row("rock, sides free: nu", -c["strain_x"][-1] / c["strain_z"][-1], (3 * K - 2 * G) / (6 * K + 2 * G), "-", 1e-4)
    c = curve(rock, "--path", "shear", "--strain", 2, "--steps", 20000)
    t.row("rock, simple shear gamma = 2: stress/G", c["stress_xy"][-1] / G, math.sin(2), "-", 1e-4)
    yield t


def dense(mu):
    """HJC: pressure without pores, GPa."""
    m = (mu - 0.1) / 1.1
    return 85 * m - 171 * m**2 + 208 * m**3 if m > 0 else 85 * m


def lock():
    """HJC: mu at which the pores are gone, where the pressure without pores is 0.8 GPa."""
    low, high = 0.1, 0.2
    for _ in range(100):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if dense(middle) < 0.8 else (low, middle)
    return low


def crush(mu):
    return 0.016 + 0.784 * (mu - 0.001) / (lock() - 0.001)


def hjc(folder):
    K1, UC, PC, FC, A, B, N = 85, 0.001, 0.016, 0.048, 0.79, 1.6, 0.61
    t = Table("HJC concrete", "./brisance material concrete_hjc --path PATH.toml", "closed forms with the constants of Holmquist, Johnson & Cook 1993")
    for mu, ref, where in ((0.0005, 0.008, "elastic"), (0.05, crush(0.05), "pores crush"), (0.15, dense(0.15), "no pores"), (0.3, dense(0.3), "no pores")):
        path = pathlib.Path(folder) / "press.toml"
        path.write_text(f"steps = 2000\n[[leg]]\nvolume = {1 / (1 + mu)!r}\n", encoding="utf-8")
        c = curve("concrete_hjc", "--path", path)
        t.row(f"P at mu = {mu:g} ({where})", c["pressure"][-1], ref, "GPa", 1e-6)
    path.write_text(f"steps = 2000\n[[leg]]\nvolume = {1 / 1.05!r}\n[[leg]]\nvolume = {1 / 1.045!r}\n", encoding="utf-8")
    c = curve("concrete_hjc", "--path", path)
    F = (0.05 - UC) / (lock() - UC)
    t.row("unloading modulus from mu = 0.05", (c["pressure"][2000] - c["pressure"][-1]) / 0.005, (1 - F) * PC / UC + F * K1, "GPa", 1e-6)
    c = curve("concrete_hjc", "--path", "hydrostatic", "--pressure", "12 MPa", "--rate", "1e-6 1/s", "--steps", 12)
    for i in (0, 4, 8, 12):
        t.row(f"strength at P = {i} MPa", 1e3 * c["yield"][i], 1e3 * FC * (A + B * (i * 1e-3 / FC) ** N), "MPa", 1e-6)
    yield t


def tables():
    out = []
    with tempfile.TemporaryDirectory() as folder:
        for group in (jh2_cases(), jh2_points(folder), johnson_cook(folder), hugoniots(folder), jwl(folder), gases_and_solids(folder), hjc(folder)):
            out.extend(group)
    return out


HEAD = """<!-- SPDX-License-Identifier: Apache-2.0 -->
<!-- written by tools/check_laws.py --update -->
# The laws against references

Every value comes out of [`brisance material`](material-point.md), the driver of one point; particles go through the same lines
(`src/laws/point.h`). `tools/check_laws.py` drives the program and holds its answers against the references, which it shares no code for;
`./test -R laws` holds this page to it. Lighting, burn fraction and energy of programmed burn need particles:
[programmed burn](theory/burn.md), `./test -R "fluid|detonation"`. What every law has to obey, whatever its name:
`./test -R "conformance|eos|vectorised"`.

"""


def page(all_tables):
    rows = sum(len(t.rows) for t in all_tables)
    return HEAD + f"{rows} numbers.\n\n" + "\n".join(t.markdown() for t in all_tables)


def same(a, b):
    """Two pages that differ in no word, and in numbers by no more than the last printed digit; deviations are not compared."""
    def cells(text):
        for line in text.splitlines():
            parts = line.split("|")
            yield "|".join(parts[:5] + parts[6:]) if len(parts) == len(COLUMNS) + 2 else line
    number = re.compile(r"[-+]?\d+\.?\d*(?:e[-+]?\d+)?")
    a, b = list(cells(a)), list(cells(b))
    if len(a) != len(b):
        return False
    for x, y in zip(a, b):
        if number.sub("#", x) != number.sub("#", y):
            return False
        for p, q in zip(number.findall(x), number.findall(y)):
            if abs(float(p) - float(q)) > 2e-5 * max(abs(float(p)), abs(float(q))):
                return False
    return True


# ------------------------------------------------------------------------------------------------ figures


def figures():
    sys.path.insert(0, str(ROOT / "python"))
    from brisance import style

    images = ROOT / "docs" / "images"
    dot = {"marker": "o", "ls": "", "ms": 3.5, "mfc": "none", "mew": 0.9, "color": "#222222"}

    figure, axes = style.subplots(1, 3, size=(10.5, 3.4))
    strength, pressure, damage = axes.ravel()
    for k, (name, ref) in enumerate(JH94.items()):
        c = curve(f"alumina_jh94_{name}", "--steps", 4000)
        colour = style.run_colour(k)
        strength.plot(c["pressure"], c["mises"], color=colour, label=f"case {name.upper()}")
        pressure.plot(-c["strain_z"], c["pressure"], color=colour)
        damage.plot(c["pressure"][c["leg"] < 2], c["damage"][c["leg"] < 2], color=colour)
        strength.plot(list(ref.get("q", {})), list(ref.get("q", {}).values()), **dot)
        damage.plot(list(ref.get("D", {})), list(ref.get("D", {}).values()), **dot)
        pressure.plot([0.05, 0], [ref["published"]["P5"], ref["published"]["bulking"]], marker="x", ls="", ms=5, color="#222222",
                      label="published" if k == 0 else None)
    strength.plot([], [], **dot, label="independent")
    strength.set(xlabel="pressure, GPa", ylabel="Mises stress, GPa", title="Johnson & Holmquist 1994, to 5 % and back")
    pressure.set(xlabel="compression 1 - V/V₀", ylabel="pressure, GPa")
    damage.set(xlabel="pressure, GPa", ylabel="damage")
    strength.legend(), pressure.legend()
    figure.savefig(images / "law_jh2_cases.png", dpi=130)

    figure, axes = style.subplots(1, 2, size=(9, 3.6))
    surface, paths = axes.ravel()
    for k, d in enumerate((0, 0.25, 0.5, 0.75, 1)):
        c = curve("barre_granite", "--path", "hydrostatic", "--pressure", "2 GPa", "--rate", "1e-6 1/s", "--damage", d, "--steps", 200)
        half = c["leg"] < 2
        surface.plot(c["pressure"][half], c["yield"][half], color=style.depth_colour(k), label=f"D = {d:g}")
        p = np.array([0.1, 0.5, 1.0, 1.5, 2.0])
        intact, broken = 2.4601 * 1.248 * ((p + 0.057) / 2.8599) ** 0.676, 2.4601 * np.minimum(0.68 * (p / 2.8599) ** 0.83, 0.16)
        surface.plot(p, (1 - d) * intact + d * broken, **dot, label="formula" if d == 1 else None)
    surface.set(xlabel="pressure, GPa", ylabel="strength, GPa", title="barre_granite: strength, rate factor 1")
    surface.legend(ncols=2)
    pressures = ["0 MPa", "10 MPa", "50 MPa", "100 MPa", "200 MPa"]
    for k, c in enumerate(curves("barre_granite", "--path", "triaxial", "--strain", "0.03", "--steps", 2000, *sum((["--confinement", p] for p in pressures), []))):
        on = c["leg"] == c["leg"].max()
        paths.plot(-c["strain_z"][on], c["mises"][on], color=style.depth_colour(k), label=pressures[k])
    paths.set(xlabel="axial compression", ylabel="Mises stress, GPa", title="triaxial compression, 1000 1/s")
    paths.legend(title="confinement")
    figure.savefig(images / "law_jh2_granite.png", dpi=130)

    with tempfile.TemporaryDirectory() as folder:
        cold = variant(folder, "copper_cold", "copper_ofhc", {"strength.chi": "0"})
        figure, axes = style.subplots(1, 2, size=(9, 3.4))
        flow, heat = axes.ravel()
        for k, rate in enumerate((1.0, 1e3, 1e4, 1e5)):
            for material, ls in ((cold, ":"), ("copper_ofhc", "-")):
                c = curve(material, "--path", "shear", "--strain", 1.9, "--rate", f"{math.sqrt(3) * rate} 1/s", "--steps", 2000)
                flow.plot(c["plastic_strain"], 1e3 * c["mises"], color=style.run_colour(k), ls=ls, label=f"{rate:g} 1/s" if ls == "-" else None)
            heat.plot(c["plastic_strain"], 294 + c["heating"], color=style.run_colour(k))
        flow.plot([0.1, 0.3, 1, 1, 1, 1], [233.0154, 341.3052, 469.9588, 416.478, 435.220, 453.803], **dot, label="reference")
        heat.plot([1, 1, 1], [386.955, 391.338, 395.704], **dot)
        flow.set(xlabel="plastic strain", ylabel="flow stress, MPa", title="OFHC copper; dotted: at 294 K")
        heat.set(xlabel="plastic strain", ylabel="temperature, K")
        flow.legend()
        figure.savefig(images / "law_johnson_cook.png", dpi=130)

        figure, axes = style.subplots(1, 3, size=(10.5, 3.4))
        shock, sound, release = axes.ravel()
        for k, (name, ((base, changes, drop), states)) in enumerate(HUGONIOTS.items()):
            c = curve(variant(folder, f"{name}_hugoniot", base, changes, drop), "--path", "shock", "--velocity", f"{max(states)} km/s", "--steps", 200)
            shock.plot(c["particle_velocity"], c["pressure"], color=style.run_colour(k), label=name)
            sound.plot(c["particle_velocity"][1:], c["shock_speed"][1:], color=style.run_colour(k))
            sound.plot(c["particle_velocity"][1:], c["sound_speed"][1:], color=style.run_colour(k), ls=":")
            shock.plot(list(states), [s[1] for s in states.values()], **dot)
            sound.plot(list(states), [s[0] for s in states.values()], **dot)
            sound.plot([u for u, s in states.items() if s[4]], [s[4] for s in states.values() if s[4]], **dot)
        shock.set(xlabel="particle velocity, km/s", ylabel="pressure, GPa", yscale="log", title="Hugoniots")
        sound.set(xlabel="particle velocity, km/s", ylabel="km/s", title="shock speed; dotted: sound")
        shock.legend()
        c = curve("petn_1320", "--path", "release", "--volume", 20, "--steps", 2000)
        on = c["leg"] > 0
        release.plot(c["volume"][on], c["pressure"][on], color=style.run_colour(0), label="pressure, GPa")
        release.plot(c["volume"][on], c["sound_speed"][on], color=style.run_colour(1), label="sound, km/s")
        release.plot(list(JWL_ISENTROPE), [s[0] for s in JWL_ISENTROPE.values()], **dot)
        release.plot(list(JWL_ISENTROPE), [s[2] for s in JWL_ISENTROPE.values()], **dot)
        release.set(xlabel="V/V₀", xscale="log", yscale="log", title="PETN, from the CJ state")
        release.legend()
        figure.savefig(images / "law_eos.png", dpi=130)

        figure, axes = style.subplots(1, 2, size=(9, 3.4))
        compaction, triaxial = axes.ravel()
        path = pathlib.Path(folder) / "cycles.toml"
        path.write_text("steps = 400\n" + "".join(f"[[leg]]\nvolume = {1 / (1 + mu)!r}\n" for mu in (0.03, 0.02, 0.07, 0.055, 0.16, 0.1, 0.2)), encoding="utf-8")
        c = curve("concrete_hjc", "--path", path)
        compaction.plot(1 / c["volume"] - 1, c["pressure"], color=style.run_colour(0))
        compaction.plot([0.05, 0.15, 0.2], [crush(0.05), dense(0.15), dense(0.2)], **dot)
        compaction.set(xlabel="μ", ylabel="pressure, GPa", title="concrete_hjc: crushing, unloading, no pores")
        compaction.set_yscale("symlog", linthresh=0.5)
        pressures = ["0 MPa", "10 MPa", "50 MPa", "100 MPa"]
        for k, c in enumerate(curves("concrete_hjc", "--path", "triaxial", "--strain", "0.03", "--rate", "1 1/s", "--steps", 2000, *sum((["--confinement", p] for p in pressures), []))):
            on = c["leg"] == c["leg"].max()
            triaxial.plot(-c["strain_z"][on], 1e3 * c["mises"][on], color=style.depth_colour(k), label=pressures[k])
        triaxial.set(xlabel="axial compression", ylabel="Mises stress, MPa", title="triaxial compression, 1 1/s")
        triaxial.legend(title="confinement")
        figure.savefig(images / "law_hjc.png", dpi=130)


def main():
    parser = argparse.ArgumentParser(description="Holds the laws of the program against references.")
    parser.add_argument("--update", action="store_true", help="write docs/laws.md")
    parser.add_argument("--check", action="store_true", help="fail where docs/laws.md says something else")
    parser.add_argument("--figures", action="store_true", help="write docs/images/law_*.png")
    arguments = parser.parse_args()
    if arguments.figures:
        figures()
        return 0
    all_tables = tables()
    text = page(all_tables)
    problems = [f for t in all_tables for f in t.failures()]
    if arguments.update:
        PAGE.write_text(text, encoding="utf-8")
    elif arguments.check:
        if not PAGE.exists() or not same(text, PAGE.read_text(encoding="utf-8")):
            problems.append("docs/laws.md is out of date: tools/check_laws.py --update")
    else:
        print(text)
    for p in problems:
        print("error:", p, file=sys.stderr)
    print(f"{sum(len(t.rows) for t in all_tables)} numbers, {len(problems)} errors", file=sys.stderr)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
