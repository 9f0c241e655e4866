# SPDX-License-Identifier: Apache-2.0
"""The one-dimensional borehole against closed forms. The case borehole of the gallery holds brisance against it."""

import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))

import numpy as np  # noqa: E402
from brisance.exact.borehole import Shell, Shells  # noqa: E402


class TheReference(unittest.TestCase):
    """At a radius of a metre shells are planes."""

    def test_shock_of_two_slabs_of_polyethylene(self):
        model = Shells([Shell("slab", "polyethylene", np.linspace(1000, 1020, 401))])
        model.v[:] = np.where(model.r < 1010, 1.0, 0.0)  # 1 km/s on rest: u_p = 0.5, U_s = 2.901 + 1.481 u_p
        model.start = model.total_energy()
        while model.t < 1.2:
            model.step(1.2 - model.t)
        middle = (model.r[1:] + model.r[:-1]) / 2
        plateau = model.p[np.abs(middle - 1010.6) < 2].mean()
        self.assertAlmostEqual(plateau / (0.915 * (2.901 + 1.481 * 0.5) * 0.5), 1, delta=0.01)
        self.assertAlmostEqual(model.total_energy() / model.start, 1, delta=2e-3)  # kinetic energy stands half a step apart

    def test_p_wave_in_granite(self):
        model = Shells([Shell("rock", "barre_granite", np.linspace(1000, 1040, 401))])
        model.v[:] = np.where(model.r < 1020, 1e-3, 0.0)  # 1 m/s on rest: half of it goes on
        while model.t < 3:
            model.step(3 - model.t)
        ahead = model.r > 1025
        front = np.interp(-0.25e-3, -model.v[ahead], model.r[ahead])
        self.assertAlmostEqual((front - 1019.95) / 3, 4.543, delta=0.02)  # the jump starts between two nodes


if __name__ == "__main__":
    unittest.main()
