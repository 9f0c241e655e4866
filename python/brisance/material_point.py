#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws the curves of one material point: the table that `brisance material --csv` writes.

  brisance material NAME --path PRESET --plot FILE.png     calls this
"""

import argparse
import csv
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from brisance import style  # noqa: E402


def read_curves(path):
    """The paths of a table, in order: {name: {column: numbers}}; units are dropped from the heads."""
    with open(path, newline="", encoding="utf-8") as f:
        rows = list(csv.reader(f))
    heads = [h.split(" [")[0] for h in rows[0]]
    curves = {}
    for row in rows[1:]:
        curves.setdefault(row[0], []).append([float(x) for x in row[1:]])
    return {name: dict(zip(heads[1:], np.array(values).T)) for name, values in curves.items()}


def axis_of_motion(curve):
    """What moves on this path: shear, axial strain or volume."""
    if np.any(curve["shear"] != 0):
        return "shear", "shear γ"
    if np.ptp(curve["volume"]) > 0.5:
        return "volume", "V/V₀"
    if np.allclose(curve["strain_x"], curve["strain_z"]):
        return "volume", "V/V₀"
    return "strain_z", "axial strain"


def draw(curves, title, out):
    first = next(iter(curves.values()))
    key, name = axis_of_motion(first)
    solid = np.any(first["mises"] > 0)
    explosive = np.ptp(first["volume"]) > 0.5
    figure, axes = style.subplots(2, 2, size=(9.2, 6.4))
    top, side, left, right = axes.ravel()
    for k, (label, c) in enumerate(curves.items()):
        if explosive:  # from the CJ state on
            c = {name: column[1:] for name, column in c.items()}
        colour = style.run_colour(k)
        many = len(curves) > 1
        x = c[key] if key in ("shear", "volume") or np.max(c[key]) > -np.min(c[key]) else -c[key]
        sign = 1 if np.max(c["stress_z"]) > -np.min(c["stress_z"]) else -1
        top.plot(x, c["pressure"], color=colour if many else style.STRESS["pressure"], ls="--" if solid and many else "-",
                 label=None if many else "pressure")
        if solid:
            shown = c["stress_xy"] if key == "shear" else sign * c["stress_z"]
            top.plot(x, shown, color=colour if many else style.STRESS["sigma_3"], label=label if many else
                     ("shear stress" if key == "shear" else "axial stress" + (" (compression)" if sign < 0 else "")))
            side.plot(c["pressure"], c["mises"], color=colour, label=label if many else "Mises stress")
            if not many:
                side.plot(c["pressure"][1:], c["yield"][1:], color=style.STRESS["yield"], lw=0.8, ls=":", label="strength in force")
        elif explosive:
            side.plot(c["volume"], c["specific_energy"], color=colour)
        else:
            side.plot(c["particle_velocity"][c["particle_velocity"] > 0], c["shock_speed"][c["particle_velocity"] > 0], color=colour)
        if "damage" in c:
            left.plot(x, c["damage"], color=colour if many else style.STRESS["damage"], label=None if many else "damage")
        else:
            left.plot(x, c["density"], color=colour)
        if not many and "bulking" in c and np.any(c["bulking"]):
            left.plot(x, c["bulking"], color=style.STRESS["sigma_1"], label="bulking pressure, GPa")
        right.plot(x, c["sound_speed"], color=colour)
    top.set(xlabel=name if sum(first[key]) >= 0 else name + " (compression)", ylabel="GPa")
    if explosive:
        side.set(xlabel=name, ylabel="energy, MJ/kg")
    else:
        side.set(xlabel="pressure, GPa" if solid else "particle velocity, km/s", ylabel="GPa" if solid else "shock speed, km/s")
    left.set(xlabel=name, ylabel="damage" if "damage" in first else "density, g/cm³")
    right.set(xlabel=name, ylabel="sound speed, km/s")
    if explosive:
        for a in (top, left):
            a.set_yscale("log")
        for a in axes.ravel():
            a.set_xscale("log")
    for a in axes.ravel():
        style.light_grid(a, "both")
        if a.get_legend_handles_labels()[0]:
            a.legend(loc="best")
    figure.suptitle(title, x=0.01, ha="left")
    figure.savefig(out, dpi=140)


def main():
    parser = argparse.ArgumentParser(description="Draws the table that `brisance material --csv` writes.")
    parser.add_argument("table")
    parser.add_argument("--out", required=True)
    parser.add_argument("--title", default="")
    arguments = parser.parse_args()
    curves = read_curves(arguments.table)
    draw(curves, f"{arguments.title}: {', '.join(curves)}" if len(curves) == 1 else arguments.title, arguments.out)
    return 0


if __name__ == "__main__":
    sys.exit(main())
