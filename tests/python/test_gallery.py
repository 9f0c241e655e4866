# SPDX-License-Identifier: Apache-2.0
"""The verification gallery: folders that are whole, judgements that can fail, pages that come from the results, exact solutions that are exact."""

import importlib.util
import math
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))

import numpy as np  # noqa: E402
from brisance import gallery, verify  # noqa: E402
from brisance.exact.cavity import Cavity  # noqa: E402
from brisance.exact.hugoniot import Gas, Linear, impact  # noqa: E402
from brisance.exact.jwl import PETN_1770, TNT  # noqa: E402
from brisance.exact.riemann import Riemann  # noqa: E402
from brisance.exact.sphere import SphericalCavity  # noqa: E402
from brisance.verification import CASES, BadCase, all_cases, front, order, read_case, relative  # noqa: E402


class Folders(unittest.TestCase):
    def test_every_folder_is_a_whole_case(self):
        for folder in sorted(p for p in CASES.iterdir() if p.is_dir()):
            with self.subTest(case=folder.name):
                case = read_case(folder)
                text = (folder / "README.md").read_text(encoding="utf-8")
                for heading in ("**Question.**", "**Set-up.**", "**Measure.**", "**Catches**"):
                    self.assertIn(heading, text)
                self.assertTrue("**Exact solution.**" in text or "**Reference.**" in text)
                self.assertTrue(text.split("\n# ", 1)[1], "a title")
                for name, quantity in case.quantities.items():
                    self.assertTrue(quantity.reason.strip(), name)

    def test_bad_folders_are_named(self):
        good = CASES / "plane_waves"
        for change, words in ((("field = \"solids\"", "field = \"solid\""), "allowed: solids"), (("lane = \"quick\"", "lane = \"slow\""), "allowed: quick, full"),
                              (("reason", "raison"), "unknown key 'raison'"), (("bound = 0.001", "bound = {fien = 1.0}"), "names the run 'fien'")):
            with tempfile.TemporaryDirectory() as place:
                folder = Path(place)
                for name in ("README.md", "case.toml", "exact.py", "expected.toml"):
                    text = (good / name).read_text(encoding="utf-8")
                    (folder / name).write_text(text.replace(*change) if name == "expected.toml" else text, encoding="utf-8")
                with self.assertRaises(BadCase) as caught:
                    read_case(folder)
                self.assertIn(words, str(caught.exception))


class Mutants(unittest.TestCase):
    def test_every_mutant_finds_the_text_that_it_breaks(self):
        spec = importlib.util.spec_from_file_location("mutate", ROOT / "tools" / "mutate.py")
        mutate = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(mutate)
        for name, (_, file, right, wrong, cases) in mutate.MUTANTS.items():
            self.assertEqual((ROOT / file).read_text(encoding="utf-8").count(right), 1, name)
            self.assertNotEqual(right, wrong)
            for case in cases:
                self.assertTrue(read_case(CASES / case).of_lane("quick"), f"{name}: {case}")


class FakeShot:
    def __init__(self, name, spacing, seconds=1.0):
        self.name, self.spacing, self.seconds = name, spacing, seconds


class FakeExact:
    """Errors by run."""
    def __init__(self, errors):
        self.errors = errors

    def measure(self, shot):
        return {"speed": relative(1 + self.errors[shot.name], 1)}


class Judgement(unittest.TestCase):
    RUNS = (("coarse", 0.4), ("middle", 0.2), ("fine", 0.1))

    def judged(self, errors, problems=None, miss=""):
        case = read_case(CASES / "plane_waves")
        case.quantities = {"speed": case.quantities["p_inside"]}
        case.quantities["speed"].miss = miss
        case.exact = FakeExact(dict(zip(("coarse", "middle", "fine"), errors)))
        return verify.judge(case, "quick", [FakeShot(*r) for r in self.RUNS], problems or {})

    def test_second_order_within_the_bounds(self):
        result = self.judged((0.016, 0.004, 0.001))
        self.assertEqual([r["verdict"] for r in result["rows"]], ["ok"] * 3)
        self.assertAlmostEqual(result["orders"][0]["order"], 2)
        self.assertEqual(result["orders"][0]["verdict"], "ok")

    def test_misses_are_seen(self):
        self.assertIn("MISSED", [r["verdict"] for r in self.judged((0.016, 0.004, 0.01))["rows"]])
        self.assertIn("MISSED", [r["verdict"] for r in self.judged((0.016, 0.004, math.nan))["rows"]])
        self.assertEqual(self.judged((0.0012, 0.0011, 0.001))["orders"][0]["verdict"], "MISSED")
        self.assertEqual(self.judged((0.016, 0.004, 0.01), miss="known")["rows"][2]["verdict"], "known miss")
        self.assertIn("FAILED", verify.verdicts(self.judged((0.016, 0.004, 0.001), {"fine": "error: it broke"})))

    def test_order_and_front(self):
        self.assertAlmostEqual(order([1, 0.5, 0.25], [3, 0.75, 0.1875]), 2)
        self.assertAlmostEqual(front([0, 1, 2, 3], [1, 1, 0.5, 0], 0.75), 1.5)
        self.assertTrue(math.isnan(front([0, 1], [0, 0], 0.5)))


class Pages(unittest.TestCase):
    def test_the_docs_come_from_the_results(self):
        stored, cases = gallery.stored(), all_cases()
        self.assertEqual(set(stored), set(cases), "run `./brisance verify --lane full --docs`, which writes docs/verification")
        with tempfile.TemporaryDirectory() as place:
            gallery.write(Path(place), stored, cases, gallery.DOCS)
            for name in [*(f"{n}.md" for n in cases), "index.md"]:
                self.assertEqual((Path(place) / name).read_text(encoding="utf-8"), (gallery.DOCS / name).read_text(encoding="utf-8"), name)
        for name, result in stored.items():
            self.assertTrue((gallery.DOCS / f"{name}.png").is_file(), name)
            for row in result["rows"]:
                quantity = cases[name].quantities[row["quantity"]]
                self.assertEqual(row["bound"], quantity.bound_of(row["run"]) if row["run"] != "all" else quantity.bound, f"{name}: {row['quantity']}")


class ExactSolutions(unittest.TestCase):
    """Against published or independently computed numbers."""

    def test_riemann_problems(self):  # Toro, table 4.2 and 4.3
        for left, right, p, u, inner, outer in (((1, 0, 1), (0.125, 0, 0.1), 0.30313, 0.92745, 0.42632, 0.26557), ((1, 0, 1000), (1, 0, 0.01), 460.894, 19.5975, 0.57506, 5.99924),
                                                ((1, -2, 0.4), (1, 2, 0.4), 0.00189387, 0.0, 0.0218521, 0.0218521)):
            gas = Riemann(left, right, 1.4)
            self.assertAlmostEqual(gas.p / p, 1, delta=2e-3)
            self.assertAlmostEqual(gas.u, u, delta=1e-4)
            self.assertAlmostEqual(gas.rho_left / inner, 1, delta=2e-3)
            self.assertAlmostEqual(gas.rho_right / outer, 1, delta=2e-3)

    def test_cavity_under_a_step(self):
        K, G, a = 25.7, 21.9, 3.225
        cavity = Cavity(a, 2.66, K - 2 * G / 3, G, [0, 1e-4], [0, 0.1])
        u, sr, st, _ = cavity(a, np.array([4, 400]) * a / cavity.c)
        self.assertAlmostEqual(1e3 * st[0], 120.7548, delta=0.01)
        self.assertAlmostEqual(1e3 * sr[0], -100, delta=1e-6)
        self.assertAlmostEqual(u[1], 0.1 * a / (2 * G), delta=1e-6)       # static: p a/(2 mu)
        u, sr, st, _ = cavity(4 * a, np.array([2]) * a / cavity.c + 3 * a / cavity.c)
        self.assertAlmostEqual(1e3 * st[0], 9.7962, delta=0.002)

    def test_spherical_cavity_under_a_step(self):  # radii in a, times behind the front in a/c, stresses in MPa
        cavity = SphericalCavity(3.225, 2.66, 25.7, 21.9, lambda t: 0.1).solve(12)
        for r, t, radial, hoop in ((1, 0.5, -100, 26.4713), (1, 2, -100, 66.1237), (2, 0.5, -31.4933, 3.9823), (2, 4, -11.6924, 6.0532), (4, 2, 2.3856, 2.8381)):
            _, sr, st = cavity(np.array([r * cavity.a]), (t + r - 1) * cavity.a / cavity.c)
            self.assertAlmostEqual(1e3 * sr[0], radial, delta=1e-4)
            self.assertAlmostEqual(1e3 * st[0], hoop, delta=1e-4)

    def test_detonation(self):
        V, P, D, u, c = TNT.chapman_jouguet()
        self.assertAlmostEqual(D, 6.9294, delta=2e-4)
        self.assertAlmostEqual(P, 21.0, delta=2e-3)
        self.assertAlmostEqual(u + c, D, delta=1e-9)
        place, speed, pressure, _ = TNT.taylor_wave()
        self.assertAlmostEqual(place[0], D, delta=1e-3)                   # u + c = D in the CJ state
        self.assertAlmostEqual(pressure[-1] / P, 0.2686, delta=5e-4)
        self.assertAlmostEqual(place[-1] / D, 0.5220, delta=5e-4)
        self.assertAlmostEqual(PETN_1770.chapman_jouguet()[2], 8.3008, delta=2e-4)

    def test_impedance_matching(self):
        copper, water = Linear(8.93, 3.94, 1.489), Linear(1.0, 1.483, 1.75)
        for pair, v, p, u in (((copper, copper), 0.5, 9.62710, 0.25), ((copper, water), 0.5, 1.08230, 0.469589), ((water, copper), 0.5, 1.08230, 0.030411)):
            have = impact(*pair, v)
            self.assertAlmostEqual(have[0], p, delta=1e-4)
            self.assertAlmostEqual(have[1], u, delta=1e-5)
        gas = Gas(1.0, 1.0, 1.4)                                          # a gas that is pushed by a wall at u* of Sod's problem
        left = Riemann((1, 0, 1), (0.125, 0, 0.1), 1.4)
        self.assertAlmostEqual(gas.pressure(-left.u), left.p, delta=1e-12)
        self.assertAlmostEqual(Gas(0.125, 0.1, 1.4).pressure(left.u), left.p, delta=1e-12)

    def test_timoshenko_tends_to_euler(self):
        beam = read_case(CASES / "beam").exact
        self.assertLess(beam.FREQUENCY, beam.EULER)
        self.assertAlmostEqual(beam.timoshenko(150) / beam.FREQUENCY, 1, delta=1e-3)   # converged
        thick = beam.H
        beam.H = 0.5
        try:
            self.assertAlmostEqual(beam.timoshenko() / (beam.EULER * 0.5 / thick), 1, delta=2e-3)
        finally:
            beam.H = thick


if __name__ == "__main__":
    unittest.main()
