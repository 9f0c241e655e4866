# SPDX-License-Identifier: Apache-2.0
"""The report and the view, as commands: one page that holds everything, for full, poor, and several runs."""

import ast
import base64
import contextlib
import io
import json
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from html.parser import HTMLParser
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "python"), str(Path(__file__).parent)]

import synthetic_run  # noqa: E402
from brisance import discrepancies, figures, measurements, needs  # noqa: E402

VOID = {"meta", "img", "br", "link", "input", "hr"}


class Page(HTMLParser):
    """Collects anchors, pictures, links and text, and checks that tags are closed in order."""

    def __init__(self, text):
        super().__init__()
        self.open, self.ids, self.pictures, self.links, self.text = [], [], [], [], []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.ids += [attributes["id"]] if "id" in attributes else []
        self.pictures += [attributes] if tag == "img" else []
        self.links += [attributes[a] for a in ("href", "src") if a in attributes]
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            raise AssertionError(f"</{tag}> closes nothing")

    def handle_data(self, data):
        self.text.append(data)


def command(script, *arguments, cwd=None):
    return subprocess.run([sys.executable, str(ROOT / "python" / "brisance" / script), *map(str, arguments)],
                          capture_output=True, text=True, cwd=cwd)


class Reports(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp())
        cls.air = synthetic_run.write(cls.folder / "air", spacing=2.2)
        cls.water = synthetic_run.write(cls.folder / "water", seed=2, spacing=2.2, strength=1.2, title="Water-coupled <blast> & copper",
                                        snapshots=False)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def page(self, path):
        page = Page(path.read_text(encoding="utf-8"))
        self.assertEqual(page.open, [])
        for link in page.links:
            self.assertTrue(link.startswith(("#", "data:image/png;base64,")), link[:60])
            if link.startswith("#"):
                self.assertIn(link[1:], page.ids)
        for picture in page.pictures:
            self.assertEqual(base64.b64decode(picture["src"].split(",")[1])[:4], b"\x89PNG")
            self.assertTrue(picture["alt"])
        return page, "".join(page.text)

    def test_one_run(self):
        done = command("report.py", self.air)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        page, text = self.page(self.air / "report.html")
        for anchor in ["summary", "facts", "discrepancies", "cite", "repeat", *(a for a, _, _ in figures.CATALOGUE)]:
            self.assertIn(anchor, page.ids)
        for figure in ("damage_bottom", "growth", "failure_times", "zones", "polar", "harmonics", "counts", "pressures", "gauge_wall",
                       "attenuation", "borehole", "burn_front", "energy"):
            self.assertIn(f"fig-{figure}", page.ids)
            for ending in ("png", "pdf"):
                self.assertTrue((self.air / "figures" / f"{figure}.{ending}").is_file(), f"{figure}.{ending}")
        self.assertIn("brisance run cases/blast/air.toml --out air", text)
        self.assertNotIn("nan", re.sub(r"[a-z]+nan|nan[a-z]+", "", text))
        if not measurements.read():
            self.assertIn("No measurements available", text)

    def test_a_run_with_hardly_anything(self):
        poor = synthetic_run.write(self.folder / "poor", spacing=3, gauges=False, snapshots=False, burn=False, sections=(), status="interrupted")
        for name in ("audit.csv", "history.csv", "case.toml", "log.txt"):
            (poor / name).unlink()
        (poor / "analysis" / "analysis.json").unlink()
        done = command("report.py", poor, "--no-pdf")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        page, text = self.page(poor / "report.html")
        self.assertEqual(page.pictures, [])
        for words in ("No gauges were recorded", "No energy audit", "no damage map", "No crack densities", "attenuation was not analysed",
                      "No moving detonation front", "did not reach its end: interrupted"):
            self.assertIn(words, text)

    def test_nulls_and_a_run_that_stopped_early(self):
        early = synthetic_run.write(self.folder / "early", spacing=2.5, times=[1.0, 2.0, 3.0], sections=("bottom",))
        path = early / "analysis" / "analysis.json"
        analysis = json.loads(path.read_text())
        entry = analysis["sections"][0]["times"][-1]
        for key in ("radial_coherence", "longest_crack_mm", "crushed_radius_mm", "spall_radius_mm", "spall_coverage", "harmonics", "damaged_by_cause"):
            entry[key] = None
        entry["pdf"] = [None] * 72
        entry["density_printed_mm_per_mm2"] = [None, 0.1, 0.2]
        analysis["attenuation"]["pressure"].update(exponent=None, exponent_error=None, fit_range_mm=None)
        analysis["attenuation"]["radial_stress"] = None
        analysis["borehole"] = analysis["burn_front"] = None
        path.write_text(json.dumps(analysis))
        done = command("report.py", early, "--no-pdf")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.page(early / "report.html")

    def test_several_runs(self):
        done = command("report.py", self.air, self.water, "--no-pdf", cwd=self.folder)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        page, text = self.page(self.folder / "comparison" / "report.html")
        for name in ("differences", "fig-damage", "fig-growth_1", "fig-gauges", "fig-polar"):
            self.assertIn(name, page.ids)
        for words in ("Water-coupled <blast> & copper", "1 : 1.79 : 3.78", "0.003558", "3.78"):
            self.assertIn(words, text)

    def test_a_run_next_to_one_without_anything(self):
        bare = synthetic_run.write(self.folder / "bare", spacing=3, gauges=False, snapshots=False, burn=False, sections=())
        (bare / "analysis" / "analysis.json").unlink()
        (bare / "audit.csv").unlink()
        done = command("report.py", bare, self.air, "--no-pdf", "--out", self.folder / "mixed" / "page.html")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.page(self.folder / "mixed" / "page.html")

    def test_bad_input(self):
        for arguments, words in (([self.folder / "nowhere"], "no such directory"), ([self.folder], "no provenance.json"),
                                 ([self.air, self.air], "given twice"), ([self.air, "--out", "x.txt"], "must be named"), ([], "RUN")):
            done = command("report.py", *arguments)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertIn(words, done.stderr)
            self.assertNotIn("Traceback", done.stderr)

    def test_view(self):
        done = command("view.py", self.air)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        script = (self.air / "paraview_view.py").read_text()
        ast.parse(script)
        self.assertNotRegex(script, r"@[A-Z]+@")
        self.assertIn("'bottom': (25.0, 2.2)", script)
        self.assertEqual(command("view.py", self.water).returncode, 2)
        self.assertEqual(command("view.py", self.folder / "nowhere").returncode, 2)


class Parts(unittest.TestCase):
    def test_missing_modules_are_named(self):
        self.assertEqual(needs.missing(("json", "no_such_module")), ["no_such_module"])
        with self.assertRaises(SystemExit) as left, contextlib.redirect_stderr(io.StringIO()) as said:
            needs.require(("no_such_module",))
        self.assertEqual(left.exception.code, needs.EXIT_RESOURCES)
        self.assertIn("has no module no_such_module", said.getvalue())

    def test_discrepancies_are_whole_and_their_page_is_current(self):
        self.assertEqual([r[0] for r in discrepancies.rows()], [str(n) for n in range(1, 18)])
        self.assertTrue(all(all(cell for cell in row) for row in discrepancies.rows()))
        check = subprocess.run([sys.executable, str(ROOT / "tools" / "write_discrepancies.py"), "--check"], capture_output=True, text=True)
        self.assertEqual(check.returncode, 0, check.stdout)

    def test_measurements_with_and_without_rows(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = Path(folder)
            (folder / "measured_empty.csv").write_text("r [mm],pressure [GPa]\n")
            self.assertEqual(measurements.read(folder), [])
            (folder / "measured_p.csv").write_text("# source\ncoupling [-],r [mm],pressure [MPa]\nair,10,500\nwater,10,700\n")
            r, p = measurements.against_radius("pressure", "air", folder)
            self.assertEqual((r.tolist(), p.tolist()), ([10.0], [0.5]))
            (folder / "measured_d.csv").write_text("section [-],zone [-],density [mm/mm2]\nbottom,1,0.4\n")
            self.assertEqual(measurements.densities("bottom", "air", folder), {1: 0.4})


if __name__ == "__main__":
    unittest.main()
