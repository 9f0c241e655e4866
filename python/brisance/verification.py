# SPDX-License-Identifier: Apache-2.0
"""What the verification cases share: their description, the runs as arrays, measures of error, orders of convergence.

A case is a folder in cases/verification with README.md, case.toml, expected.toml and exact.py. Units are those of the program: mm, us, mg.
"""

import importlib.util
import sys
import tomllib
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

import numpy as np

from brisance.run import BadRun, Run
from brisance.snapshots import Snapshot, series

ROOT = Path(__file__).resolve().parents[2]
CASES = ROOT / "cases" / "verification"
FIELDS = {"solids": "Solids", "fluids": "Fluids and burn", "coupled": "Together"}


class BadCase(Exception):
    """A case's folder is not as it has to be. The message names file, key and what is allowed."""


@dataclass
class Result:
    """One measured quantity: the computed and the exact value and the error that the bound is held against."""
    have: float
    want: float
    error: float


def relative(have, want):
    """error = have/want - 1"""
    return Result(float(have), float(want), float(have / want - 1))


def scaled(have, want, scale):
    """error = (have - want)/scale"""
    return Result(float(have), float(want), float((have - want) / scale))


def norm(have, want, scale, power=1):
    """L1 (or with power 2 the root of the mean square) distance of two arrays over `scale`; there is no single exact value."""
    difference = np.abs(np.asarray(have) - np.asarray(want)) / scale
    return Result(float((difference**power).mean() ** (1 / power)), 0.0, float((difference**power).mean() ** (1 / power)))


def front(x, f, level, falling=True):
    """Where f passes `level`, seen from the largest x: linear between the two points about it. NaN where it never does."""
    order = np.argsort(x)
    x, f = np.asarray(x)[order], np.asarray(f)[order]
    above = np.flatnonzero(f >= level) if falling else np.flatnonzero(f <= level)
    if not above.size or above[-1] + 1 >= len(x):
        return float("nan")
    k = above[-1]
    return float(x[k] + (x[k + 1] - x[k]) * (f[k] - level) / (f[k] - f[k + 1]))


def bins(x, edges, *fields):
    """Means of fields over bins of x: middles of the bins that hold something, and an array for each field."""
    where = np.digitize(x, edges) - 1
    inside = (where >= 0) & (where < len(edges) - 1)
    count = np.bincount(where[inside], minlength=len(edges) - 1)
    used = count > 0
    middle = (np.asarray(edges)[1:] + np.asarray(edges)[:-1]) / 2
    return (middle[used], *(np.bincount(where[inside], np.asarray(f)[inside], len(edges) - 1)[used] / count[used] for f in fields))


def order(spacings, errors):
    """Slope of log |error| over log spacing, by least squares."""
    return float(np.polyfit(np.log(spacings), np.log(np.maximum(np.abs(errors), 1e-300)), 1)[0])


def number(text):
    """A resolved quantity of case.toml as a float in the program's units, from "0.15 mm", "2 us", "1 km/s", "3 GPa" alone."""
    value, *unit = str(text).split()
    factor = {"": 1, "mm": 1, "us": 1, "km/s": 1, "GPa": 1, "m/s": 1e-3, "MPa": 1e-3, "cm": 10, "m": 1e3, "ns": 1e-3, "ms": 1e3, "g/cm3": 1}
    return float(value) * factor[unit[0] if unit else ""]


@dataclass
class Shot:
    """One run of a case."""
    name: str
    path: Path
    seconds: float = 0.0

    @cached_property
    def run(self):
        return Run(self.path)

    @cached_property
    def case(self):
        return tomllib.loads((self.path / "case.toml").read_text(encoding="utf-8"))

    @property
    def spacing(self):
        """mm, of the first part."""
        return number(self.case["part"][self.case["parts"][0]]["spacing"])

    @cached_property
    def times(self):
        return [t for t, _ in series(self.run)]

    def snapshot(self, k=-1):
        return Snapshot(series(self.run)[k][1], self.run.parts)

    def at(self, time):
        """The snapshot nearest to a time."""
        return self.snapshot(int(np.argmin(np.abs(np.array(self.times) - time))))

    def gauge(self, name):
        """The table of a gauge."""
        for gauge in self.run.gauges:
            if gauge.name == name:
                return gauge.table
        raise BadCase(f"exact.py asks for the gauge '{name}'; the run has: {', '.join(g.name for g in self.run.gauges)}")

    @property
    def audit(self):
        return self.run.audit

    def half_step(self, time):
        """us: velocities stand half a step before the time of a snapshot."""
        return 0.5 * float(np.interp(time, self.audit["t"], self.audit["dt"]))


@dataclass
class Expected:
    """What expected.toml says of one quantity."""
    name: str
    unit: str
    bound: object          # a number, or {run: number}
    reason: str
    order: float = None
    miss: str = ""

    def bound_of(self, run):
        return self.bound.get(run) if isinstance(self.bound, dict) else self.bound


@dataclass
class CaseFolder:
    """A folder of cases/verification."""
    path: Path
    title: str
    field: str
    runs: list             # of dictionaries: name, preset, set, lane
    quantities: dict = field(default_factory=dict)

    @property
    def name(self):
        return self.path.name

    def of_lane(self, lane):
        return [r for r in self.runs if lane == "full" or r["lane"] == "quick"]

    @cached_property
    def exact(self):
        """The module exact.py."""
        spec = importlib.util.spec_from_file_location(f"exact_{self.name}", self.path / "exact.py")
        module = importlib.util.module_from_spec(spec)
        sys.modules[spec.name] = module  # dataclasses ask for it
        spec.loader.exec_module(module)
        return module


def _need(table, key, kind, where):
    value = table.get(key)
    if not isinstance(value, kind):
        raise BadCase(f"{where}: the key '{key}' is missing or of another type; wanted is a {getattr(kind, '__name__', 'number')}")
    return value


def read_case(path):
    """The description of a case's folder. Raises BadCase."""
    for name in ("README.md", "case.toml", "expected.toml", "exact.py"):
        if not (path / name).is_file():
            raise BadCase(f"{path}: no {name} in it")
    file = path / "expected.toml"
    try:
        data = tomllib.loads(file.read_text(encoding="utf-8"))
    except tomllib.TOMLDecodeError as error:
        raise BadCase(f"{file}: {error}") from None
    unknown = set(data) - {"title", "field", "run", "quantity"}
    if unknown:
        raise BadCase(f"{file}: unknown key '{sorted(unknown)[0]}'; allowed: title, field, run, quantity")
    if data.get("field") not in FIELDS:
        raise BadCase(f"{file}: field = {data.get('field')!r}; allowed: {', '.join(FIELDS)}")
    runs = []
    for entry in _need(data, "run", list, file):
        unknown = set(entry) - {"name", "preset", "set", "lane"}
        if unknown:
            raise BadCase(f"{file}: run: unknown key '{sorted(unknown)[0]}'; allowed: name, preset, set, lane")
        if entry.get("lane") not in ("quick", "full"):
            raise BadCase(f"{file}: run: lane = {entry.get('lane')!r}; allowed: quick, full")
        preset = entry.get("preset", "")
        runs.append({"name": entry.get("name", preset or "run"), "preset": preset, "set": entry.get("set", []), "lane": entry["lane"]})
    names = [r["name"] for r in runs]
    if len(set(names)) < len(names):
        raise BadCase(f"{file}: two runs have the same name")
    case = CaseFolder(path, _need(data, "title", str, file), data["field"], runs)
    for name, entry in _need(data, "quantity", dict, file).items():
        where = f"{file}: quantity.{name}"
        unknown = set(entry) - {"unit", "bound", "order", "reason", "miss"}
        if unknown:
            raise BadCase(f"{where}: unknown key '{sorted(unknown)[0]}'; allowed: unit, bound, order, reason, miss")
        bound = _need(entry, "bound", (int, float, dict), where)
        if isinstance(bound, dict) and set(bound) - set(names):
            raise BadCase(f"{where}: bound names the run '{sorted(set(bound) - set(names))[0]}'; there are: {', '.join(names)}")
        if isinstance(bound, dict) and set(bound) != set(names) and "order" not in entry:
            pass  # runs without a bound of their own are shown, not judged
        case.quantities[name] = Expected(name, entry.get("unit", ""), bound, _need(entry, "reason", str, where), entry.get("order"), entry.get("miss", ""))
    return case


def all_cases():
    """The folders of cases/verification by name."""
    return {p.name: read_case(p) for p in sorted(CASES.iterdir()) if (p / "exact.py").is_file()}


__all__ = ["BadCase", "BadRun", "CASES", "CaseFolder", "Expected", "FIELDS", "ROOT", "Result", "Shot", "Snapshot", "all_cases", "bins", "front",
           "norm", "number", "order", "read_case", "relative", "scaled"]
