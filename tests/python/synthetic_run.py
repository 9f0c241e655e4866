# SPDX-License-Identifier: Apache-2.0
"""Makes a run directory with invented numbers, for tests of the Python side ONLY. Nothing here is physics or a result.

It follows schema 1 and looks plausible: a crushed zone, radial cracks, a spall crack, a stress wave that decays.
"""

import json
import math
from pathlib import Path

import h5py
import numpy as np

ROCK_RADIUS, HOLE, Z = 72.0, 3.225, {"bottom": 25.0, "middle": 75.0, "top": 125.0}
TIMES = [5.0, 10.0, 23.0, 46.0, 69.0, 100.0, 144.88]
C_P = 4.5  # km/s


def write(folder, seed=1, spacing=1.6, strength=1.0, title="Air-coupled blast with copper", case="cases/blast/air.toml",
          sections=("bottom", "middle", "top"), gauges=True, snapshots=True, burn=True, status="finished", times=TIMES):
    """Write the run into a folder. strength: how far the cracks reach; spacing: of the rock, mm."""
    folder, rng = Path(folder), np.random.default_rng(seed)
    (folder / "analysis").mkdir(parents=True, exist_ok=True)
    states = {name: _section(rng, spacing, strength * (1.15 - Z[name] / 250), times[-1]) for name in sections}
    for name, s in states.items():
        _csv(folder / "analysis" / f"section_{name}.csv", ("x [mm]", "y [mm]", "size [mm]", "damage [-]", "cause [-]", "failure_time [us]"),
             [s[k] for k in ("x", "y", "size", "damage", "cause", "time")])
    (folder / "case.toml").write_text(f'# resolved case\ntitle = "{title}"\n[analysis]\naxis = ["0 mm", "0 mm"]\n')
    (folder / "log.txt").write_text("invented for a test\n")
    count = sum(len(s["x"]) for s in states.values())
    _json(folder / "provenance.json", {
        "schema": 1, "version": "0.1.0", "commit": "0123456789abcdef", "command": f"brisance run {case} --out {folder.name}",
        "started": "2025-01-01T08:00:00Z", "finished": "2025-01-01T09:12:00Z", "title": title, "case_file": case, "preset": "quick",
        "machine": {"cpu": "a test machine", "threads": 2, "host": "nowhere"}, "settings": ["run.seed=3"], "status": status,
        "wall_seconds": 4320.0, "steps": 18432, "particles": {"copper": 900, "petn": 300, "rock": count},
        "rates": {"rock": 4.1e6, "copper": 3.3e6, "petn": 0.8e6}, "slice": None})
    _json(folder / "analysis" / "analysis.json", {
        "schema": 1, "threshold": 0.8, "zones": {"edges_mm": [0, 24, 48, 72], "areas_mm2": [1777, 5429, 9048]},
        "sections": [_analysis(name, s, times, rng) for name, s in states.items()], "attenuation": _attenuation(strength),
        "borehole": {"t_us": (t := np.linspace(0, times[-1], 60)).tolist(), "mean_radius_mm": (HOLE + 0.9 * strength * (1 - np.exp(-t / 12))).tolist()},
        "burn_front": {"t_us": [*np.linspace(0, 22.4, 30), 40.0], "z_mm": [*(150 - 6.69 * np.linspace(0, 22.4, 30)), 0.14]} if burn else {}})
    _history(folder, states, times)
    _audit(folder, times[-1], strength)
    if gauges:
        (folder / "gauges").mkdir(exist_ok=True)
        for name, x, y, fails in (("wall", 8.54, 4.43, "shear"), ("radial", 31.75, 28.62, "tensile"), ("spall", 52.95, -45.0, "tensile")):
            _gauge(folder / "gauges" / f"{name}.csv", x, y, fails, times[-1], strength)
    if snapshots:
        _snapshots(folder, states, times)
    return folder


def _json(path, value):
    path.write_text(json.dumps(value, allow_nan=False))


def _csv(path, head, columns):
    rows = zip(*columns)
    path.write_text(",".join(head) + "\n" + "".join(",".join("" if v != v else f"{v:.6g}" for v in r) + "\n" for r in rows))


def _section(rng, spacing, reach, end):
    """A jittered cloud of points with invented damage."""
    n = int(ROCK_RADIUS / spacing) + 1
    grid = np.stack(np.meshgrid(*[np.arange(-n, n + 1) * spacing] * 2), -1).reshape(-1, 2) + rng.uniform(-0.2, 0.2, ((2 * n + 1) ** 2, 2)) * spacing
    r = np.hypot(*grid.T)
    grid = grid[(r > HOLE + spacing / 2) & (r < ROCK_RADIUS - spacing / 2)]
    x, y = grid.T
    r, a = np.hypot(x, y), np.arctan2(y, x)
    damage, cause, time = 0.5 * np.exp(-((r - 8) / 12) ** 2) * rng.uniform(0, 1, len(r)), np.zeros(len(r)), np.full(len(r), np.nan)
    cracks = [(rng.uniform(0, 2 * np.pi), reach * rng.uniform(18, 62), rng.uniform(-0.08, 0.08)) for _ in range(26)]
    for angle, length, bend in cracks:
        off = np.abs(np.angle(np.exp(1j * (a - angle - bend * np.sin(r / 9))))) * r
        on = (off < 0.75 * spacing) & (r < length)
        damage[on], cause[on], time[on] = 1.0, 1, 4 + r[on] / 0.55
        near = (off < 2 * spacing) & (r < length) & ~on
        damage[near] = np.maximum(damage[near], 0.4 * rng.uniform(0, 1, near.sum()))
    spall = (np.abs(r - 68 - 1.5 * np.sin(3 * a)) < 0.7 * spacing) & (np.sin(2 * a + seed_phase(reach)) > -0.3)
    damage[spall], cause[spall], time[spall] = 1.0, 1, 25 + 6 * rng.uniform(0, 1, spall.sum())
    crushed, ring = r < 9 * reach, (r >= 9 * reach) & (r < 11.5 * reach)
    damage[crushed], cause[crushed], time[crushed] = 1.0, 2, 1 + r[crushed] / C_P
    damage[ring], cause[ring], time[ring] = 1.0, 3, 2 + r[ring] / C_P
    late = time > end
    damage[late], cause[late], time[late] = 0.3, 0, np.nan
    return dict(x=x, y=y, size=np.full(len(x), spacing), damage=damage, cause=cause, time=time)


def seed_phase(reach):
    return 7 * reach


def _analysis(name, s, times, rng):
    r, a = np.hypot(s["x"], s["y"]), np.degrees(np.arctan2(s["y"], s["x"])) % 360
    entries = []
    for t in times:
        broken = (s["damage"] >= 0.8) & (s["time"] <= t)
        zone = np.digitize(r, (24, 48))
        per_zone = [int(np.sum(broken & (zone == k))) for k in range(3)]
        printed = [n * s["size"][0] / area for n, area in zip(per_zone, (1777, 5429, 9048))]
        counts = np.histogram(a[broken], 72, (0, 360))[0]
        pdf = (72 * counts / max(1, counts.sum())).tolist()
        spectrum = np.abs(np.fft.rfft(pdf))[1:13] / 72
        entries.append({
            "t_us": t, "damaged": int(broken.sum()), "damaged_by_cause": {c: int(np.sum(broken & (s["cause"] == k))) for k, c in ((1, "tensile"), (2, "shear"), (3, "mixed"))},
            "density_printed_mm_per_mm2": printed, "density_skeleton_mm_per_mm2": [0.55 * p for p in printed], "damaged_per_zone": per_zone,
            "pdf": pdf, "pdf_normalised": (counts / len(r)).tolist(), "harmonics": {str(k + 1): float(v) for k, v in enumerate(spectrum)},
            "radial_coherence": 0.81, "long_radial_cracks": int(rng.integers(5, 12)), "longest_crack_mm": float(np.max(r[broken], initial=0) - HOLE),
            "crushed_radius_mm": 9.7, "spall_radius_mm": 68.2 if t > 30 else None, "spall_coverage": 0.55 if t > 30 else 0.0})
    return {"name": name, "z_mm": Z[name], "particles": len(r), "times": entries}


def _attenuation(strength):
    r = np.geomspace(4, 70, 24)
    def part(factor, n):
        median = factor * strength * (r / HOLE) ** -n
        return {"r_mm": r.tolist(), "median_GPa": median.tolist(), "p10_GPa": (0.8 * median).tolist(), "p90_GPa": (1.25 * median).tolist(),
                "exponent": n, "exponent_error": 0.04, "fit_range_mm": [8, 50]}
    return {"pressure": part(1.7, 0.92), "radial_stress": part(2.0, 0.78)}


def _history(folder, states, times):
    t = np.linspace(0, times[-1], 300)
    columns = [[np.sum((s["damage"] >= 0.8) & (s["time"] <= x)) for x in t] for s in states.values()]
    _csv(folder / "history.csv", ("t [us]", *(f"damaged.{n} [-]" for n in states)), [t, *columns])


def _audit(folder, end, strength):
    t = np.linspace(0, end, 400)
    burn = 1800 * np.clip(t / 22.4, 0, 1)
    shares = {"kinetic": 0.12 * np.exp(-t / 60), "internal.rock": 0.30 * (1 - np.exp(-t / 15)), "internal.copper": 0.1 * (1 - np.exp(-t / 9)),
              "internal.polyethylene": np.full(400, 0.06), "zero_energy": np.full(400, 0.01), "contact_stored": 0.01 * np.exp(-t / 30), "contact_dissipated": 0.02 * (1 - np.exp(-t / 30))}
    shares["internal.petn"] = 1 - sum(shares.values())
    head = ["step", "t [us]", "dt [us]", "limiter", *(f"{n} [J]" for n in shares), "burn_released [J]", "viscous [J]", "boundary_work [J]",
            "artificial_stress [J]", "residual [J]", "residual_relative [-]", "max_penetration [mm]", "leaked [-]", "damaged [-]"]
    residual = 0.004 * np.sin(t / 20) * strength
    rows = np.column_stack([np.arange(400), t, np.full(400, 0.008), *(burn * s for s in shares.values()), burn, 0.04 * burn, 0 * t, 0.001 * burn,
                            residual * 1800, residual, 0.03 + 0 * t, 0 * t, 10 * t])
    with open(folder / "audit.csv", "w") as file:
        file.write(",".join(head) + "\n")
        for row in rows:
            cells = [f"{v:.8g}" for v in row]
            file.write(",".join(cells[:3] + ["courant rock"] + cells[3:]) + "\n")


def _gauge(path, x, y, fails, end, strength):
    r, t = math.hypot(x, y), np.arange(0, end, 0.1)
    arrival, peak = 7.5 + (r - HOLE) / C_P, 1.6 * strength * (r / HOLE) ** -0.95
    s = np.clip(t - arrival, 0, None)
    pulse = np.where(s > 0, (s / 0.6) * np.exp(1 - s / 0.6), 0) * peak
    ring = -0.25 * peak * np.exp(-s / 9) * np.sin(s / 1.8) * (s > 1.5)
    fail = arrival + (1.2 if fails == "shear" else 5.0)
    after = 0.5 - 0.5 * np.tanh((t - fail - 0.3) / 0.3)
    p = (pulse + ring) * np.maximum(after, 0.04)
    s1, s2, s3 = -0.25 * pulse - 0.6 * ring, -0.9 * pulse, -1.9 * pulse - 0.4 * np.abs(ring)
    s1, s2, s3 = (np.where(t > fail, 0.05, 1.0) * v for v in (s1, s2, s3))
    tau, mises = (s1 - s3) / 2, np.abs(s1 - s3) * 0.92
    strength_y = (0.218 + 0.9 * np.maximum(p, 0)) * (0.12 + 0.88 * after)
    damage = np.clip((t - fail + 0.6) / 0.8, 0, 1)
    cause = np.where(t >= fail, 2 if fails == "shear" else 1, 0)
    one = np.ones_like(t)
    _csv(path, ("t [us]", "x [mm]", "y [mm]", "z [mm]", "pressure [GPa]", "sigma_1 [GPa]", "sigma_2 [GPa]", "sigma_3 [GPa]", "tau_max [GPa]",
                "mises [GPa]", "yield [GPa]", "damage [-]", "v_x [km/s]", "v_y [km/s]", "v_z [km/s]", "cause [-]"),
         [t, x * one, y * one, 100 * one, p, s1, s2, s3, tau, mises, strength_y, damage, pulse / 12, 0 * t, 0 * t, cause])


def _snapshots(folder, states, times):
    """Three layers of particles per section, the middle one being the section, plus gas that drifts through it."""
    (folder / "snapshots").mkdir(exist_ok=True)
    reference, column = [], []
    for name, s in states.items():
        reference.append(np.column_stack([s["x"], s["y"], np.full(len(s["x"]), Z[name])]))
        column.append(s)
    rock = np.concatenate(reference)
    fields = {k: np.concatenate([s[k] for s in column]) for k in ("damage", "cause", "time")}
    files = []
    for n, t in enumerate([0.0, *times]):
        failed = fields["time"] <= t
        u = 0.002 * t * rock * np.exp(-np.hypot(rock[:, 0], rock[:, 1]) / 20)[:, None] * [1, 1, 0]
        gas = np.random.default_rng(n).normal(0, 3, (200, 3)) + [0, 0, 25]
        points = np.concatenate([rock + u, gas])
        data = {"part": np.r_[np.full(len(rock), 4), np.zeros(200)].astype(np.int32), "pressure": np.zeros(len(points)),
                "damage": np.r_[np.where(failed, fields["damage"], np.minimum(fields["damage"], 0.4)), np.zeros(200)],
                "cause": np.r_[np.where(failed, fields["cause"], 0), np.zeros(200)].astype(np.int32),
                "displacement": np.concatenate([u, np.zeros((200, 3))]), "velocity": np.zeros((len(points), 3))}
        name = f"fields_{n:04d}.vtkhdf"
        files.append({"name": name, "time": t})
        with h5py.File(folder / "snapshots" / name, "w") as file:
            group = file.create_group("VTKHDF")
            group.attrs["Version"] = [1, 0]
            group.attrs.create("Type", b"UnstructuredGrid", dtype="S16")
            for key, value in {"NumberOfPoints": [len(points)], "NumberOfCells": [1], "NumberOfConnectivityIds": [len(points)],
                               "Connectivity": np.arange(len(points)), "Offsets": [0, len(points)]}.items():
                group[key] = np.asarray(value, dtype=np.int64)
            group["Types"], group["Points"] = np.array([2], dtype=np.uint8), points.astype(np.float32)
            for key, value in data.items():
                group.create_dataset(f"PointData/{key}", data=value)
    _json(folder / "snapshots" / "fields.vtkhdf.series", {"file-series-version": "1.0", "files": files})


if __name__ == "__main__":
    import sys
    print(write(sys.argv[1], spacing=float(sys.argv[2]) if len(sys.argv) > 2 else 1.6))
