# SPDX-License-Identifier: Apache-2.0
"""Reads snapshots (VTKHDF 1.0 UnstructuredGrid), and finds a section's particles in them.

A particle of a section is recognised by its reference position, Points - displacement. Total-Lagrangian particles keep
their order, so the search is done once and only checked afterwards.
"""

import json

import h5py
import numpy as np
from scipy.spatial import cKDTree

from brisance.run import BadRun, cause_codes


def series(run):
    """[(time in us, path)] of a run's snapshots, in order of time; empty where there are none."""
    path = run.path / "snapshots" / "fields.vtkhdf.series"
    if not path.is_file():
        return []
    try:
        entries = json.loads(path.read_text(encoding="utf-8"))["files"]
        found = [(float(e["time"]), path.parent / e["name"]) for e in entries]
    except (ValueError, KeyError, TypeError) as error:
        raise BadRun(f"{path}: not a file series: {error}") from None
    return sorted((t, p) for t, p in found if p.is_file())


class Snapshot:
    """All particles at one time, us. Fields by name, as in docs/output.md, besides `x` (current) and `X` (reference) places [mm].

    Raises BadRun where the file is no snapshot.
    """

    def __init__(self, path, parts):
        try:
            with h5py.File(path, "r") as file:
                root = file["VTKHDF"]
                self.time = float(root["FieldData/time"][0])
                self.fields = {name: np.asarray(data[:], dtype=float if data.dtype.kind == "f" else int) for name, data in root["PointData"].items()}
                self.units = {name: data.attrs["unit"].decode() for name, data in root["PointData"].items()}
                self.fields["x"] = np.asarray(root["Points"][:], dtype=float)
                self.fields["X"] = self.fields["x"] - self.fields["displacement"]
        except (OSError, KeyError) as error:
            raise BadRun(f"{path}: cannot be read as a snapshot: {error}") from None
        self.parts = parts

    def __getitem__(self, name):
        return self.fields[name]

    def part(self, name):
        """The same of one part."""
        if name not in self.parts:
            raise BadRun(f"there is no part '{name}'; the run has: {', '.join(self.parts)}")
        return self.where(self.fields["part"] == self.parts.index(name))

    def where(self, mask):
        """The same of some particles."""
        only = object.__new__(Snapshot)
        only.time, only.parts, only.units = self.time, self.parts, self.units
        only.fields = {key: value[mask] for key, value in self.fields.items()}
        return only


def load(run):
    """The snapshots of a run one after the other, in order of time."""
    for _, path in series(run):
        yield Snapshot(path, run.parts)


class SectionFinder:
    """Finds the particles of one section in the snapshots of a run."""

    def __init__(self, section_map, z):
        self.map, self.z = section_map, z
        self.index = None  # into the snapshot, one per particle of the section

    def state(self, path):
        """(damage, cause) of the section's particles in a snapshot, None where it does not hold them."""
        try:
            with h5py.File(path, "r") as file:
                group = file["VTKHDF"]
                data = group["PointData"]
                if "damage" not in data:
                    return None
                reference = self._reference(group)
                if not self._fits(reference):
                    self.index = self._search(reference, data["part"][:] if "part" in data else None)
                if self.index is None:
                    return None
                damage = np.nan_to_num(data["damage"][:][self.index])
                cause = cause_codes(data["cause"][:][self.index]) if "cause" in data else np.zeros(len(damage), int)
                return damage, cause
        except (OSError, KeyError) as error:
            raise BadRun(f"{path}: cannot be read as VTKHDF: {error}") from None

    @staticmethod
    def _reference(group):
        points = group["Points"][:].astype(float)
        if "displacement" in group["PointData"]:
            points -= np.nan_to_num(group["PointData"]["displacement"][:])
        return points

    def _fits(self, reference):
        """Whether the index found earlier still points at the same columns."""
        if self.index is None or self.index.max() >= len(reference):
            return False
        off = np.hypot(reference[self.index, 0] - self.map.x, reference[self.index, 1] - self.map.y)
        return bool(np.all(off < 0.5 * self.map.size))

    def _search(self, reference, part):
        """The particle nearest to (x, y, z of the section) for every column; None where the columns are not there."""
        slab = np.flatnonzero(abs(reference[:, 2] - self.z) < 2 * self.map.size.max())
        wanted = np.column_stack([self.map.x, self.map.y, np.full(len(self.map.x), self.z)])
        if not slab.size:
            return None
        found = slab[cKDTree(reference[slab]).query(wanted)[1]]
        if part is not None:  # gas may have drifted between the columns: keep to the part that most of them belong to
            values, counts = np.unique(part[found], return_counts=True)
            if len(values) > 1:
                slab = slab[part[slab] == values[counts.argmax()]]
                found = slab[cKDTree(reference[slab]).query(wanted)[1]]
        off = np.hypot(reference[found, 0] - self.map.x, reference[found, 1] - self.map.y)
        return found if np.mean(off < 0.5 * self.map.size) > 0.99 else None


def state_from_failure_time(section_map, t):
    """(damage, cause) at t [us] told from the failure times alone: 1 where it had failed, 0 elsewhere.

    For runs without snapshots. Partial damage is not known then.
    """
    failed = section_map.failure_time <= t  # NaN compares false
    return np.where(failed, section_map.damage, 0.0), np.where(failed, section_map.cause, 0)
