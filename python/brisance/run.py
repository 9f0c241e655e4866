# SPDX-License-Identifier: Apache-2.0
"""Reads a run directory (schema 1). Nothing here draws.

A part that a run does not have (no gauges, no burn, no snapshots) reads as None or empty; only what makes a directory no
run at all, or a file that cannot be understood, raises BadRun.
"""

import csv
import json
import math
import re
import tomllib
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

SCHEMA = 1
CAUSES = ("none", "tensile", "shear", "mixed")  # the codes 0 ... 3 of every cause column
PAPER_TIMES = (23.0, 69.0, 144.88)  # us, of the paper's Fig. 11


class BadRun(Exception):
    """The directory is no run, or a file in it cannot be understood. The message names the path and what is wrong."""


class Table:
    """A CSV file with a header of `name [unit]`, lines from # on ignored.

    Columns are read by name: `table["kinetic"]`, `table.units["kinetic"]`.
    """

    def __init__(self, columns, units):
        self.columns, self.units = columns, units

    @classmethod
    def read(cls, path):
        try:
            lines = [l for l in path.read_text(encoding="utf-8").splitlines() if l.strip() and not l.startswith("#")]
        except (OSError, UnicodeDecodeError) as error:
            raise BadRun(f"{path}: cannot be read: {error}") from None
        if not lines:
            raise BadRun(f"{path}: the header row is missing")
        names, units = [], {}
        for cell in next(csv.reader(lines[:1])):
            match = re.fullmatch(r"\s*(.*?)\s*(?:\[(.*)\])?\s*", cell)
            names.append(match[1])
            units[match[1]] = match[2] or ""
        if len(lines) == 1:
            return cls({n: np.empty(0) for n in names}, units)
        try:  # the quick path: nothing but numbers
            data = np.loadtxt(lines[1:], delimiter=",", ndmin=2, comments=None)
            if data.shape[1] != len(names):
                raise ValueError
            columns = {n: data[:, k] for k, n in enumerate(names)}
        except ValueError:
            rows = [r for r in csv.reader(lines[1:]) if len(r) == len(names)]  # a run cut off may end in half a row
            columns = {n: _numbers([r[k] for r in rows]) for k, n in enumerate(names)}
        return cls(columns, units)

    def __contains__(self, name):
        return name in self.columns

    def __getitem__(self, name):
        return self.columns[name]

    def __len__(self):
        return len(next(iter(self.columns.values()), ()))

    def get(self, name):
        """The column, or NaN in every row where the file does not have it."""
        return self.columns.get(name, np.full(len(self), np.nan))


def _numbers(cells):
    """Cells as floats (an empty cell is NaN); as text where one of them is no number."""
    try:
        return np.array([float(c) if c.strip() else math.nan for c in cells])
    except ValueError:
        return np.array(cells)


def cause_codes(column):
    """A cause column, written as codes or as words, as integers 0 ... 3."""
    column = np.asarray(column)
    if column.dtype.kind in "US":
        return np.array([CAUSES.index(c.strip()) if c.strip() in CAUSES else 0 for c in column], dtype=int)
    codes = np.nan_to_num(column.astype(float)).astype(int)
    return np.where((codes >= 0) & (codes < len(CAUSES)), codes, 0)


def number(value):
    """A number of a JSON file, NaN where it is null or absent."""
    return math.nan if value is None else float(value)


@dataclass
class Gauge:
    """The history at one point. t [us]; the reference position [mm] is that of the first row."""
    name: str
    table: Table
    centre: tuple = (0.0, 0.0)

    @property
    def t(self):
        return self.table["t"]

    @property
    def position(self):
        return tuple(float(self.table.get(c)[0]) if len(self.table) else math.nan for c in "xyz")

    @property
    def radius(self):
        """Distance from the borehole axis, mm."""
        x, y, _ = self.position
        return math.hypot(x - self.centre[0], y - self.centre[1])

    @cached_property
    def cause(self):
        return cause_codes(self.table.get("cause"))

    @cached_property
    def failure_time(self):
        """us at which a cause was first written, or else at which damage reached 1; NaN when it never failed."""
        if np.any(self.cause > 0):
            return float(self.t[np.argmax(self.cause > 0)])
        broken = np.nan_to_num(self.table.get("damage")) >= 0.999
        return float(self.t[np.argmax(broken)]) if broken.any() else math.nan

    @cached_property
    def failure_cause(self):
        """Word for the cause of failure: that of the first row that names one."""
        return CAUSES[self.cause[np.argmax(self.cause > 0)]] if np.any(self.cause > 0) else ""

    @cached_property
    def strongest(self):
        """Largest magnitude of pressure and principal stresses in every row, GPa."""
        names = [n for n in ("pressure", "sigma_1", "sigma_3") if n in self.table]
        if not names:
            return np.zeros(len(self.table))
        return np.nan_to_num(np.max(np.abs([self.table[n] for n in names]), axis=0))

    @cached_property
    def arrival(self):
        """us at which the stress first passes 2 % of its largest magnitude."""
        if not len(self.table) or self.strongest.max() <= 0:
            return math.nan
        return float(self.t[np.argmax(self.strongest > 0.02 * self.strongest.max())])

    def peak(self, name, sign=1):
        """(value, time in us) of the largest (sign 1) or smallest (sign -1) entry of a column; NaN where there is none."""
        column = self.table.get(name)
        if not len(column) or np.all(np.isnan(column)):
            return math.nan, math.nan
        k = int(np.nanargmax(sign * column))
        return float(column[k]), float(self.t[k])


@dataclass
class SectionMap:
    """The particles of one section in the reference configuration. x, y, size [mm]; failure_time [us], NaN: never."""
    name: str
    x: np.ndarray
    y: np.ndarray
    size: np.ndarray
    damage: np.ndarray
    cause: np.ndarray
    failure_time: np.ndarray
    centre: tuple = (0.0, 0.0)

    @cached_property
    def radius(self):
        return np.hypot(self.x - self.centre[0], self.y - self.centre[1])

    @cached_property
    def hole(self):
        """Radius of the borehole in this section, mm: where the innermost particles end (0 where there is no hole)."""
        inner = self.radius.min() - self.size[self.radius.argmin()] / 2
        return max(0.0, float(inner)) if inner > 0.25 * self.size.min() else 0.0

    @cached_property
    def outer(self):
        return float(np.max(self.radius + self.size / 2))


class Run:
    """A run directory. Attributes are read when first asked for and kept."""

    def __init__(self, path):
        self.path = Path(path)
        if not self.path.is_dir():
            raise BadRun(f"{self.path}: no such directory. A run directory is written by `brisance run CASE --out DIR`")
        if not (self.path / "provenance.json").is_file():
            raise BadRun(f"{self.path}: no provenance.json in it, so it is not a run directory of brisance")
        schema = self.provenance.get("schema")
        if schema != SCHEMA:
            raise BadRun(f"{self.path}: provenance.json has schema {schema!r}; this program reads schema {SCHEMA}")

    def _json(self, name):
        path = self.path / name
        if not path.is_file():
            return {}
        try:
            value = json.loads(path.read_text(encoding="utf-8"))
        except ValueError as error:
            raise BadRun(f"{path}: not valid JSON: {error}") from None
        if not isinstance(value, dict):
            raise BadRun(f"{path}: expected a JSON object")
        return value

    def _table(self, path):
        if not path.is_file():
            return None
        table = Table.read(path)
        return table if len(table) else None

    @cached_property
    def provenance(self):
        return self._json("provenance.json")

    @cached_property
    def analysis(self):
        return self._json("analysis/analysis.json")

    @cached_property
    def case(self):
        """The resolved case as a dictionary; empty where it cannot be read."""
        try:
            return tomllib.loads((self.path / "case.toml").read_text(encoding="utf-8"))
        except (OSError, tomllib.TOMLDecodeError):
            return {}

    @cached_property
    def parts(self):
        """Names in the order of the snapshots' `part`: solids first."""
        names, data = self.case.get("parts", []), self.case.get("part", {})
        return sorted(names, key=lambda n: data[n]["formulation"] != "total_lagrangian")

    @property
    def snapshots(self):
        """The snapshots one after the other (brisance.snapshots.Snapshot); needs h5py."""
        from brisance.snapshots import load
        return load(self)

    @cached_property
    def centre(self):
        """x, y of the borehole axis, mm (analysis.axis of the case; 0, 0 when absent)."""
        axis = self.case.get("analysis", {}).get("axis")
        try:
            return tuple(float(str(v).split()[0]) for v in axis[:2])
        except (TypeError, ValueError, IndexError):
            return (0.0, 0.0)

    @property
    def title(self):
        return self.provenance.get("title") or self.path.resolve().name

    @cached_property
    def audit(self):
        return self._table(self.path / "audit.csv")

    @cached_property
    def history(self):
        return self._table(self.path / "history.csv")

    @cached_property
    def gauges(self):
        """Gauges by distance from the axis."""
        found = [Gauge(p.stem, t, self.centre) for p in sorted(self.path.glob("gauges/*.csv"))
                 if (t := self._table(p)) and "t" in t]
        return sorted(found, key=lambda g: (g.radius, g.name))

    @cached_property
    def sections(self):
        """The section entries of analysis.json, from the bottom up."""
        entries = [s for s in self.analysis.get("sections") or [] if s.get("name")]
        return sorted(entries, key=lambda s: number(s.get("z_mm")))

    @cached_property
    def maps(self):
        """SectionMap by name, in the order of `sections`."""
        order = {s["name"]: k for k, s in enumerate(self.sections)}
        found = {}
        for path in self.path.glob("analysis/section_*.csv"):
            table = self._table(path)
            if table is None:
                continue
            lacking = [n for n in ("x", "y", "size", "damage") if n not in table]
            if lacking:
                raise BadRun(f"{path}: no column {', '.join(lacking)}")
            time = np.array(table.get("failure_time"), dtype=float)
            time[~np.isfinite(time) | (time < 0)] = np.nan
            name = path.stem.removeprefix("section_")
            found[name] = SectionMap(name, table["x"], table["y"], table["size"], np.nan_to_num(table["damage"]),
                                     cause_codes(table.get("cause")), time, self.centre)
        return dict(sorted(found.items(), key=lambda item: (order.get(item[0], len(order)), item[0])))

    def section(self, name):
        """The analysis entry of a section, an empty dictionary where there is none."""
        return next((s for s in self.sections if s["name"] == name), {})

    @property
    def threshold(self):
        return number(self.analysis.get("threshold") or 0.8)

    @property
    def zone_edges(self):
        """mm"""
        return [number(e) for e in (self.analysis.get("zones") or {}).get("edges_mm") or []]

    def attenuation(self, part):
        """The attenuation of `pressure` or `radial_stress`, an empty dictionary where it was not analysed."""
        return (self.analysis.get("attenuation") or {}).get(part) or {}

    @cached_property
    def end(self):
        """us, the last time that the run reached."""
        ends = [t["t"][-1] for t in (self.audit, self.history) if t and "t" in t]
        ends += [g.t[-1] for g in self.gauges]
        ends += [number(entry.get("t_us")) for s in self.sections for entry in (s.get("times") or [])[-1:]]
        return float(max(ends, default=math.nan))

    @property
    def coupling(self):
        """air | water | bare (no copper) | water-bare, told from the title, the case file and its parts; None if untold."""
        words = f"{self.title} {self.provenance.get('case_file', '')} {self.provenance.get('preset', '')}".lower()
        words = re.sub(r"[_\-/]+", " ", words)
        bare = bool(re.search(r"(without|no|bare|un) ?(copper|lin)", words))
        if "water" in words:
            return "water-bare" if bare else "water"
        return "bare" if bare else "air" if re.search(r"\bair\b", words) else None


def section_at(section, t):
    """The entry of a section's `times` nearest to t [us]; None where there is none."""
    times = [e for e in section.get("times") or [] if e.get("t_us") is not None]
    return min(times, key=lambda e: abs(e["t_us"] - t), default=None)


def last(section):
    """The last entry of a section's `times`, an empty dictionary where there is none."""
    return (section.get("times") or [{}])[-1]


def choose_times(available, wanted=PAPER_TIMES):
    """Of the available times [us], those nearest to the wanted ones; evenly spread ones where the run ended too early.

    A wanted time counts as met when an available one lies within 10 % or 1 us of it.
    """
    available = np.unique(np.asarray(available, dtype=float))
    if available.size <= len(wanted):
        return available.tolist()
    met = []
    for t in wanted:
        nearest = float(available[np.argmin(abs(available - t))])
        if abs(nearest - t) <= max(1.0, 0.1 * t) and nearest not in met:
            met.append(nearest)
    if len(met) < len(wanted):
        met.append(float(available[-1]))
        for t in available[-1] * np.arange(1, len(wanted)) / len(wanted):
            if len(set(met)) < len(wanted):
                met.append(float(available[np.argmin(abs(available - t))]))
    return sorted(set(met))


def labels(runs):
    """A short name for each run: its title where there is one run, else its folder, which fits beside others (titles where folders repeat)."""
    folders = [r.path.resolve().name for r in runs]
    return folders if len(runs) > 1 and len(set(folders)) == len(runs) else [r.title for r in runs]
