#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Reads a snapshot with VTK's own reader and compares it with what the writer says it wrote.

    read_snapshot_with_vtk.py SNAPSHOT EXPECTED.json

EXPECTED.json: {"points": N, "cells": n, "coordinates": [3N numbers], "time": t,
"arrays": [{"name", "components", "values": [...]}]}. Exit code 0: equal, 1: not, 77: no VTK with an HDF reader here.
"""
import json
import sys

VTK_POLY_VERTEX = 2

try:
    from vtkmodules.vtkIOHDF import vtkHDFReader
except ImportError as error:
    print(f"skipped: no VTK module with vtkHDFReader ({error})")
    sys.exit(77)


def values_of(array):
    columns = array.GetNumberOfComponents()
    return [array.GetComponent(i, j) for i in range(array.GetNumberOfTuples()) for j in range(columns)]


def differences(grid, wanted):
    def compare(what, found, expected):
        if found != expected:
            yield f"{what}: VTK reads {found}, written was {expected}"

    yield from compare("number of points", grid.GetNumberOfPoints(), wanted["points"])
    yield from compare("number of cells", grid.GetNumberOfCells(), wanted["cells"])
    if grid.GetNumberOfCells():
        yield from compare("cell type", grid.GetCellType(0), VTK_POLY_VERTEX)
        yield from compare("points of the cell", grid.GetCell(0).GetNumberOfPoints(), wanted["points"])
        yield from compare("coordinates", values_of(grid.GetPoints().GetData()), wanted["coordinates"])
    time = grid.GetFieldData().GetArray("time")
    yield from compare("time", time and values_of(time), [wanted["time"]])

    data = grid.GetPointData()
    found = sorted(data.GetArrayName(i) for i in range(data.GetNumberOfArrays()))
    yield from compare("names of arrays", found, sorted(array["name"] for array in wanted["arrays"]))
    for array in wanted["arrays"]:
        read = data.GetArray(array["name"])
        if read is not None:
            yield from compare(array["name"] + ": components", read.GetNumberOfComponents(), array["components"])
            yield from compare(array["name"] + ": values", values_of(read), array["values"])


def main():
    snapshot, expected = sys.argv[1:]
    reader = vtkHDFReader()
    reader.SetFileName(snapshot)
    if not reader.CanReadFile(snapshot):
        sys.exit(f"{snapshot}: VTK does not take this for a VTKHDF file")
    reader.Update()
    with open(expected, encoding="utf-8") as file:
        wrong = list(differences(reader.GetOutput(), json.load(file)))
    print("\n".join(wrong) or f"VTK reads {snapshot} as it was written")
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()
