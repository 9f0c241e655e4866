# SPDX-License-Identifier: Apache-2.0
"""The Python side of brisance: reads a run directory, draws its figures and writes its report.

    report.py   one self-contained HTML page (figures also as PNG and PDF) of one run or of several side by side
    view.py     a ParaView script that shows damage on cuts

Units are those of the run directory: mm, us, GPa, km/s, J. Stresses are positive in tension, pressure in compression.
"""
