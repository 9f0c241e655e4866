# SPDX-License-Identifier: Apache-2.0
"""The reader: tables by name, what is missing, what is wrong."""

import json
import math
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "python"), str(Path(__file__).parent)]

import numpy as np  # noqa: E402
import brisance  # noqa: E402
import synthetic_run  # noqa: E402
from brisance import energy, facts, snapshots, waves  # noqa: E402
from brisance.run import BadRun, Run, Table, choose_times, section_at  # noqa: E402


class Tables(unittest.TestCase):
    def read(self, text):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "table.csv"
            path.write_text(text)
            return Table.read(path)

    def test_columns_are_read_by_name_and_keep_their_unit(self):
        table = self.read("t [us],internal.rock [J],damage [-]\n0,1.5,0\n1,2.5,1\n")
        self.assertEqual(table.units, {"t": "us", "internal.rock": "J", "damage": "-"})
        np.testing.assert_array_equal(table["internal.rock"], [1.5, 2.5])

    def test_text_empty_cells_and_half_a_row(self):
        table = self.read("# note\nt [us],limiter,x [mm]\n0,courant,\n1,contact,3\n2,cour")
        self.assertEqual(list(table["limiter"]), ["courant", "contact"])
        self.assertTrue(math.isnan(table["x"][0]))

    def test_missing_column_is_nan(self):
        self.assertTrue(np.isnan(self.read("t [us]\n0\n1\n").get("yield")).all())

    def test_header_only(self):
        self.assertEqual(len(self.read("t [us],x [mm]\n")), 0)


class Times(unittest.TestCase):
    def test_times_of_the_paper_where_the_run_has_them(self):
        self.assertEqual(choose_times([0, 5, 23.1, 40, 69, 100, 144.88]), [23.1, 69, 144.88])

    def test_spread_where_the_run_ended_early(self):
        times = choose_times(np.linspace(0.5, 12, 24))
        self.assertEqual((len(times), times[-1]), (3, 12.0))


class Runs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.path = synthetic_run.write(Path(cls.temporary.name) / "run", spacing=2.0)
        cls.run_ = Run(cls.path)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def test_geometry_of_a_section(self):
        section = self.run_.maps["bottom"]
        self.assertAlmostEqual(section.hole, 3.225, delta=1.0)
        self.assertAlmostEqual(section.outer, 72.0, delta=1.0)
        self.assertEqual(list(self.run_.maps), ["bottom", "middle", "top"])

    def test_gauge_failure_and_arrival(self):
        wall = self.run_.gauges[0]
        self.assertEqual((wall.name, wall.failure_cause), ("wall", "shear"))
        self.assertAlmostEqual(wall.radius, 9.62, delta=0.01)
        arrival = 7.5 + (wall.radius - synthetic_run.HOLE) / synthetic_run.C_P
        self.assertAlmostEqual(wall.arrival, arrival, delta=0.15)
        self.assertAlmostEqual(wall.failure_time, arrival + 1.2, delta=0.11)

    def test_speed_of_the_burn(self):
        self.assertAlmostEqual(waves.burn_speed(self.run_), 6.69, places=2)

    def test_energy_stores_add_up_to_the_supply(self):
        audit = self.run_.audit
        stored = sum(energy.change(audit, n) for n in energy.columns(audit, energy.STORES))
        supplied = sum(energy.change(audit, n) for n in energy.columns(audit, energy.SUPPLIES))
        np.testing.assert_allclose(stored, supplied, atol=1e-3)

    def test_section_is_found_in_moved_snapshots_among_gas(self):
        section = self.run_.maps["bottom"]
        finder = snapshots.SectionFinder(section, 25.0)
        for t, path in snapshots.series(self.run_)[-2:]:
            damage, cause = finder.state(path)
            failed = section.failure_time <= t
            np.testing.assert_allclose(damage[failed], section.damage[failed], atol=1e-6)
            np.testing.assert_array_equal(cause[failed], section.cause[failed])

    def test_section_that_snapshots_do_not_hold(self):
        finder = snapshots.SectionFinder(self.run_.maps["bottom"], 100.0)
        self.assertIsNone(finder.state(snapshots.series(self.run_)[0][1]))

    def test_coupling_is_told_from_the_title(self):
        words = {"Air-coupled blast with copper": "air", "Water-coupled": "water", "air, without copper": "bare", "no_copper": "bare",
                 "water without copper": "water-bare", "Taylor bar": None}
        for title, coupling in words.items():
            run = Run(self.path)
            run.provenance = {**run.provenance, "title": title, "case_file": ""}
            self.assertEqual(run.coupling, coupling, title)

    def test_summary_names_the_numbers(self):
        text = facts.summary(self.run_)
        for word in ("144.9 µs", "6.69 km/s", "r^−0.92", "bottom section"):
            self.assertIn(word, text)

    def test_nearest_time(self):
        self.assertEqual(section_at(self.run_.sections[0], 25)["t_us"], 23.0)

    def test_bad_runs_say_what_is_wrong(self):
        with tempfile.TemporaryDirectory() as folder:
            with self.assertRaisesRegex(BadRun, "no provenance.json"):
                Run(folder)
            with self.assertRaisesRegex(BadRun, "no such directory"):
                Run(Path(folder) / "nowhere")
            (Path(folder) / "provenance.json").write_text(json.dumps({"schema": 7}))
            with self.assertRaisesRegex(BadRun, "schema 7"):
                Run(folder)
            (Path(folder) / "provenance.json").write_text("{")
            with self.assertRaisesRegex(BadRun, "not valid JSON"):
                Run(folder)


@unittest.skipUnless("BRISANCE" in os.environ, "BRISANCE: the program")
class ARunOfTheProgram(unittest.TestCase):
    """The files of one run say the same of the same thing."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        out = Path(cls.folder.name) / "run"
        subprocess.run([os.environ["BRISANCE"], "run", str(ROOT / "tests/wrong_cases/rock.toml"), "--until", "2 us", "--set", 'output.snapshots=["0 us", "1 us", "2 us"]', "--out", str(out), "--no-report", "--quiet"], check=True, capture_output=True)
        cls.run_ = brisance.read(out)
        cls.shots = list(cls.run_.snapshots)

    def test_times_parts_and_numbers(self):
        self.assertEqual([round(s.time, 9) for s in self.shots], [0, 1, 2])
        self.assertEqual(self.run_.parts, ["rock", "plate"])
        for part, number in self.run_.provenance["particles"].items():
            self.assertEqual(len(self.shots[-1].part(part)["x"]), number)
        with self.assertRaisesRegex(BadRun, "no part 'water'; the run has: rock, plate"):
            self.shots[0].part("water")

    def test_energy_and_momentum_of_snapshot_and_audit(self):
        end, audit = self.shots[-1], self.run_.audit
        self.assertEqual(audit.units["kinetic"], "J")
        self.assertLess(np.abs(audit["residual_relative"]).max(), 1e-12)  # also where the initial velocity runs into a plane that is held
        plate = end.part("plate")
        mass = plate["density"] * plate["size"] ** 2 * 1.2  # 10 layers in 12 mm
        self.assertAlmostEqual((mass * plate["internal_energy"]).sum() / audit["internal.plate"][-1], 1, delta=1e-4)
        self.assertGreater(audit["internal.plate"][-1], 0)

    def test_gauge_is_a_particle_of_the_snapshot(self):
        gauge, rock = self.run_.gauges[0].table, self.shots[-1].part("rock")
        nearest = np.argmin(np.linalg.norm(rock["x"] - [gauge[n][-1] for n in "xyz"], axis=1))
        self.assertLess(np.linalg.norm(rock["x"][nearest] - [gauge[n][-1] for n in "xyz"]), 1e-4)
        self.assertAlmostEqual(rock["pressure"][nearest] / gauge["pressure"][-1], 1, delta=1e-5)
        self.assertEqual((gauge.units["pressure"], rock.units["pressure"]), ("GPa", "GPa"))

    def test_damage_of_snapshot_history_and_analysis(self):
        damaged = (self.shots[-1].part("rock")["damage"] > 0.9).sum() + (self.shots[-1].part("plate")["damage"] > 0.9).sum()
        self.assertEqual(self.run_.history["damaged.all"][-1], damaged)
        self.assertEqual(self.run_.analysis["threshold"], 0.9)
        self.assertEqual(self.run_.case["analysis"]["sectors"], 36)


if __name__ == "__main__":
    unittest.main()
