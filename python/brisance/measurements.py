# SPDX-License-Identifier: Apache-2.0
"""Measurements to draw next to a run: cases/validation/banadaki_mohanty/measured_*.csv.

Rows are used by the columns that the header names:
    r [mm], pressure [GPa] or radial_stress [GPa]       drawn with the attenuation
    section [-], zone [-] (1 = inner), density [mm/mm2] drawn with the zone bars
A column `coupling [-]` (air | water | bare) keeps a row to runs with that coupling. MPa are converted.
"""

from pathlib import Path

import numpy as np

from brisance.run import Table

FOLDER = Path(__file__).resolve().parents[2] / "cases" / "validation" / "banadaki_mohanty"


def read(folder=FOLDER):
    """[(file name, Table)] of the measurement files that hold rows."""
    tables = [(p.name, Table.read(p)) for p in sorted(Path(folder).glob("measured_*.csv")) if p.stat().st_size]
    return [(name, table) for name, table in tables if len(table)]


def _for(table, coupling):
    if coupling is None or "coupling" not in table:
        return np.ones(len(table), bool)
    return np.array([str(c).strip() in ("", coupling) for c in table["coupling"]])


def against_radius(name, coupling=None, folder=FOLDER):
    """(r [mm], value [GPa]) of all measured `pressure` or `radial_stress`."""
    r, values = [], []
    for _, table in read(folder):
        if "r" in table and name in table:
            keep = _for(table, coupling)
            r += table["r"][keep].tolist()
            values += (table[name][keep] * (1e-3 if table.units[name] == "MPa" else 1.0)).tolist()
    return np.array(r), np.array(values)


def densities(section, coupling=None, folder=FOLDER):
    """{zone (1 = inner): density in mm/mm2} measured on a section."""
    found = {}
    for _, table in read(folder):
        if {"section", "zone", "density"} <= set(table.columns):
            for s, zone, d, keep in zip(table["section"], table["zone"], table["density"], _for(table, coupling)):
                if keep and str(s).strip() == section:
                    found[int(zone)] = float(d)
    return found
