#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Write RUN/paraview_view.py, a ParaView script that shows the damage of a run on cuts.

    view.py RUN [--threshold 0.8]

Open it with `paraview --script=RUN/paraview_view.py`, or render a picture with `pvpython RUN/paraview_view.py damage.png`.
Needs nothing but Python. Exit codes: 0 written, 2 bad input, 4 the disk refuses.
"""

import argparse
import json
import sys
from pathlib import Path

TEMPLATE = '''\
# SPDX-License-Identifier: Apache-2.0
"""Damage on cuts of a run of brisance. Written by `brisance view`.

    paraview --script=paraview_view.py        opens the view
    pvpython paraview_view.py PICTURE.png     renders the last time

Positions in mm, times in us. Change the numbers below and run it again.
"""
import json
import os
import sys

from paraview.simple import *

try:
    RUN = os.path.dirname(os.path.abspath(__file__))
except NameError:  # some ways of running a script do not tell where it lies
    RUN = @RUN@
SECTIONS = @SECTIONS@  # name: (height of the cut, thickness shown), mm
PART = @PART@  # id of the rock in the field `part`; None: all parts
THRESHOLD = @THRESHOLD@  # damage from which a particle is shown as a crack
SIZE = @SIZE@  # diameter of a particle on the picture, mm
TITLE = @TITLE@

folder = os.path.join(RUN, "snapshots")
with open(os.path.join(folder, "fields.vtkhdf.series"), encoding="utf-8") as series:
    entries = sorted(json.load(series)["files"], key=lambda e: e["time"])
reader = OpenDataFile([os.path.join(folder, e["name"]) for e in entries])
if reader is None:
    raise SystemExit("ParaView cannot read VTKHDF: version 5.10 or newer is needed")
RenameSource("snapshots", reader)
reader.UpdatePipeline()

view = GetActiveViewOrCreate("RenderView")
view.Background = [1, 1, 1]
if hasattr(view, "UseColorPaletteForBackground"):
    view.UseColorPaletteForBackground = 0
view.OrientationAxesVisibility = 1


def keep(source, field, low, high):
    """Particles whose field lies between low and high."""
    threshold = Threshold(Input=source)
    threshold.Scalars = ["POINTS", field]
    if hasattr(threshold, "LowerThreshold"):
        threshold.LowerThreshold, threshold.UpperThreshold = low, high
    else:
        threshold.ThresholdRange = [low, high]
    return threshold


def single(source):
    """One cell per particle: the snapshot holds all in one poly-vertex, which Threshold would take or leave as a whole."""
    mask = MaskPoints(Input=source)
    mask.OnRatio = 1
    if hasattr(mask, "RandomSampling"):
        mask.RandomSampling = 0
    mask.MaximumNumberofPoints = 2000000000
    mask.GenerateVertices = 1
    mask.SingleVertexPerCell = 1
    return mask


def show(source, solid=None, opacity=1.0):
    """Spheres of the particles' size, in one colour or by cause of failure."""
    display = Show(source, view)
    display.SetRepresentationType("Point Gaussian")
    display.ShaderPreset = "Sphere"
    display.GaussianRadius = SIZE / 2
    display.Opacity = opacity
    if solid:
        ColorBy(display, None)
        display.AmbientColor = display.DiffuseColor = solid
    else:
        ColorBy(display, ("POINTS", "cause"))
    return display


fields = reader.PointData.keys()
particles = single(reader)
rock = keep(particles, "part", PART - 0.5, PART + 0.5) if PART is not None and "part" in fields else particles
RenameSource("rock", rock)

if "cause" in fields:  # the colours of the report: none, tensile, shear, mixed
    colours = GetColorTransferFunction("cause")
    colours.InterpretValuesAsCategories = 1
    colours.Annotations = ["0", "none", "1", "tensile", "2", "shear", "3", "mixed"]
    colours.IndexedColors = [0.44, 0.44, 0.44, 0.0, 0.447, 0.698, 0.835, 0.369, 0.0, 0.176, 0.071, 0.212]

for name, (height, thickness) in SECTIONS.items():
    calculator = Calculator(Input=rock)
    calculator.ResultArrayName = "height"
    # the height in the reference configuration, so that a section keeps its particles
    calculator.Function = "coordsZ - displacement_Z" if "displacement" in fields else "coordsZ"
    cut = keep(calculator, "height", height - thickness / 2, height + thickness / 2)
    RenameSource("section " + name, cut)
    show(keep(cut, "damage", -1.0, THRESHOLD), solid=[0.86, 0.86, 0.84])
    cracks = keep(cut, "damage", THRESHOLD, 2.0)
    RenameSource("cracks in section " + name, cracks)
    show(cracks, solid=None if "cause" in fields else [0.64, 0.15, 0.16])

cracks = keep(rock, "damage", THRESHOLD, 2.0)  # all cracks in space, hidden at first: switch it on in the pipeline browser
RenameSource("all cracks", cracks)
if not SECTIONS:
    show(cracks, solid=None if "cause" in fields else [0.64, 0.15, 0.16])

scene = GetAnimationScene()
scene.UpdateAnimationUsingDataTimeSteps()
scene.GoToLast()
label = Text(Text=TITLE + "\\nlast snapshot: %g us" % entries[-1]["time"])
text = Show(label, view)
text.Color = [0.13, 0.13, 0.13]
text.FontSize = 14

view.ViewSize = [1400, 1000]
view.CameraFocalPoint = [0, 0, 0]
view.CameraPosition = [260, -360, 330]
view.CameraViewUp = [0, 0, 1]
ResetCamera(view)
Render(view)
if len(sys.argv) > 1 and sys.argv[-1].endswith(".png"):
    SaveScreenshot(sys.argv[-1], view)
'''


class BadRun(Exception):
    """The directory holds no run with snapshots."""


def _json(path):
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        return {}
    except ValueError as error:
        raise BadRun(f"{path}: not valid JSON: {error}") from None


def _spacing(path):
    """Largest particle size of a section file, mm; None where there is none."""
    try:
        with open(path, encoding="utf-8") as file:
            names = [c.split("[")[0].strip() for c in file.readline().split(",")]
            column = names.index("size")
            return max(float(line.split(",")[column]) for line in file if line.strip())
    except (OSError, ValueError, IndexError):
        return None


def _part_id(run, count):
    """The id in the field `part` that has this many particles; None where h5py is not there or no part matches alone."""
    try:
        import h5py
        import numpy as np
        with h5py.File(sorted((run / "snapshots").glob("fields_*.vtkhdf"))[0], "r") as file:
            ids, counts = np.unique(file["VTKHDF/PointData/part"][:], return_counts=True)
    except (ImportError, OSError, KeyError, IndexError):
        return None
    found = ids[counts == count]
    return int(found[0]) if len(found) == 1 else None


def script(run, threshold=None):
    """The text of the ParaView script of a run directory."""
    run = Path(run)
    if not run.is_dir():
        raise BadRun(f"{run}: no such directory")
    if not (run / "snapshots" / "fields.vtkhdf.series").is_file():
        raise BadRun(f"{run}: no snapshots/fields.vtkhdf.series in it, so there is nothing to view. "
                     "Ask for snapshots with output.snapshots in the case")
    analysis, provenance = _json(run / "analysis" / "analysis.json"), _json(run / "provenance.json")
    sections, sizes = {}, []
    for s in analysis.get("sections") or []:
        size = _spacing(run / "analysis" / f"section_{s.get('name')}.csv")
        sizes += [size] if size else []
        if s.get("z_mm") is not None:
            sections[s["name"]] = (float(s["z_mm"]), size or 1.0)
    rock = (provenance.get("particles") or {}).get("rock")
    values = {
        "RUN": repr(str(run.resolve())), "SECTIONS": repr(sections),
        "PART": repr(_part_id(run, rock)),
        "THRESHOLD": repr(float(threshold if threshold is not None else analysis.get("threshold") or 0.8)),
        "SIZE": repr(max(sizes, default=1.0)), "TITLE": repr(str(provenance.get("title") or run.resolve().name)),
    }
    text = TEMPLATE
    for name, value in values.items():
        text = text.replace(f"@{name}@", value)
    return text


def main(argv=None):
    parser = argparse.ArgumentParser(prog="brisance view", description="Write a ParaView script that shows damage on cuts.")
    parser.add_argument("run", metavar="RUN", help="a run directory with snapshots")
    parser.add_argument("--threshold", type=float, help="damage from which a particle is a crack (default: that of the analysis)")
    arguments = parser.parse_args(argv)
    try:
        out = Path(arguments.run) / "paraview_view.py"
        out.write_text(script(arguments.run, arguments.threshold), encoding="utf-8")
    except BadRun as error:
        print(f"brisance view: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"brisance view: {error}", file=sys.stderr)
        return 4
    print(f"{out}\nOpen it with: paraview --script={out}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
