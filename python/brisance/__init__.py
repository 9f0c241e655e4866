# SPDX-License-Identifier: Apache-2.0
"""The Python side of brisance: reads a run directory, draws its figures and writes its report.

    read(path)  the run as an object: tables, gauges, analysis, snapshots (docs/output.md)
    report.py   one self-contained HTML page (figures also as PNG and PDF) of one run or of several side by side
    view.py     a ParaView script that shows damage on cuts

Units are those of the run directory: mm, us, GPa, km/s, J. Stresses are positive in tension, pressure in compression.
"""


def read(path):
    """A run directory (brisance.run.Run). Raises brisance.run.BadRun where it is none, or of a schema that is not known."""
    from brisance.run import Run
    return Run(path)
