# SPDX-License-Identifier: Apache-2.0
"""The catalogue of figures, in the order of the report, and how they are saved."""

import io
import warnings
from dataclasses import dataclass
from pathlib import Path

from brisance import cracks, energy, maps, style, waves
from brisance.plates import Absent

PNG_DPI, PDF_DPI = 160, 240  # PDF: only the particles are pixels

CATALOGUE = (  # (anchor, heading, drawing functions)
    ("damage", "Damage on the sections", (maps.damage,)),
    ("growth", "How the damage grew", (maps.growth, maps.failure_times)),
    ("counts", "Damaged particles in time", (cracks.counts,)),
    ("zones", "Crack density in zones", (cracks.zones,)),
    ("polar", "Crack distribution around the borehole", (cracks.polar, cracks.harmonics)),
    ("gauges", "Gauges", (waves.pressures, waves.gauge_panels)),
    ("attenuation", "Attenuation", (waves.attenuation,)),
    ("borehole", "Borehole and burn front", (waves.borehole, waves.burn_front)),
    ("energy", "Energy audit", (energy.audit,)),
)


@dataclass
class Saved:
    """A figure on disk and as PNG bytes for the page."""
    key: str
    caption: str
    png: bytes


def save(plate, folder, pdf=True):
    """Write KEY.png and KEY.pdf into a folder and close the figure."""
    stem = "".join(c if c.isalnum() or c in "-_" else "_" for c in plate.key)
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", message=".*[Tt]ight layout|.*constrained_layout.*")
        buffer = io.BytesIO()
        plate.figure.savefig(buffer, format="png", dpi=PNG_DPI, bbox_inches="tight", pad_inches=0.08)
        (folder / f"{stem}.png").write_bytes(buffer.getvalue())
        if pdf:
            plate.figure.savefig(folder / f"{stem}.pdf", dpi=PDF_DPI, bbox_inches="tight", pad_inches=0.05)
    style.plt.close(plate.figure)
    return Saved(stem, plate.caption, buffer.getvalue())


def draw(runs, folder, pdf=True):
    """{anchor: ([Saved], [why something is missing])} of everything that the runs can show."""
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    drawn = {}
    for anchor, _, functions in CATALOGUE:
        saved, reasons = [], []
        for function in functions:
            try:
                saved += [save(plate, folder, pdf) for plate in function(runs)]
            except Absent as absent:
                reasons.append(str(absent))
        drawn[anchor] = (saved, list(dict.fromkeys(reasons)))
    return drawn
