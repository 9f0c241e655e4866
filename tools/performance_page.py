#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The page docs/performance.md and its roofline from measurements of `brisance bench`.

    ./brisance bench --json > docs/performance/bench.json
    for n in 1e5 1e6 5e6 2e7; do ./brisance bench rock --particles $n --json > docs/performance/rock_$n.json; done
    ./brisance check cases/blast/air_copper.toml --preset full --json > docs/performance/full_check.json
    ./brisance check cases/blast/air_copper.toml --preset full --until "1.27 us" --json > docs/performance/full_stretch_check.json
    ./brisance run cases/blast/air_copper.toml --preset full --no-report --until "1.27 us" --out runs/full 2>&1 | grep 'set up' > docs/performance/full_log.txt      # three minutes
    cp runs/full/provenance.json docs/performance/full_run.json
    ./brisance run cases/blast/air_copper.toml --preset full --set 'slice={z = "100 mm", layers = 12, part = "rock"}' --set 'detonation=[{part = "charge", kind = "instant"}]' --until "40 us" --no-report --out runs/slice
    cp runs/slice/provenance.json docs/performance/slice_run.json       # three minutes
    ./brisance run cases/blast/air_copper.toml --preset full-coarse --no-report --out runs/coarse
    cp runs/coarse/provenance.json docs/performance/coarse_run.json     # twenty minutes
    /usr/bin/python3 tools/performance_page.py [--check]

With --check nothing is written: exit code 1 if the page does not follow from the measurements that lie beside it. The figure needs matplotlib.
"""

import argparse
import json
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
FOLDER = ROOT / "docs" / "performance"
PAGE = ROOT / "docs" / "performance.md"
FIGURE = ROOT / "docs" / "images" / "roofline.png"
LOOPS = {"rock": "rock, JH-2, double", "rock_single": "rock, JH-2, single", "copper": "copper, Johnson-Cook, double", "water": "water, double", "water_short": "water, double, 1.2 spacings"}
GOALS = {"rock": 8e6, "rock_single": 16e6, "copper": 5e6, "water_short": 3e6}
BYTES = {"rock": 320, "rock_single": 170}


def read(name):
    return json.loads((FOLDER / name).read_text(encoding="utf-8"))


def by_name(bench):
    """{name: rows, one thread first}"""
    rows = {}
    for row in bench["rows"]:
        rows.setdefault(row["name"], []).append(row)
    return rows


def million(rate):
    return f"{rate / 1e6:.3g}"


def against(goal, value, more=True):
    return "met" if (value >= goal if more else value <= goal) else "**missed**"


def loops(rows):
    lines = ["| loop | threads | 10⁶ particle-steps/s | lowest … highest | second thread | neighbours | bytes a particle | of the arithmetic | of the bandwidth |", "|---|---|---|---|---|---|---|---|---|"]
    for name, title in LOOPS.items():
        for k, r in enumerate(rows[name]):
            gain = f"{r['rate'] / rows[name][0]['rate']:.2f} ×" if k else ""
            lines.append(f"| {title if not k else ''} | {r['threads']} | {million(r['rate'])} | {million(r['lowest'])} … {million(r['highest'])} | {gain} | {r['neighbours']:.0f} | "
                         f"{r['bytes_per_particle']:.0f} | {100 * r['of_arithmetic']:.0f} % | {100 * r['of_bandwidth']:.0f} % |")
    return lines


def rest(rows):
    last = {name: r[-1] for name, r in rows.items()}
    lines = ["| what | all threads |", "|---|---|"]
    for name, title in (("law_jh2", "JH-2"), ("law_johnson_cook", "Johnson-Cook"), ("law_hjc", "HJC")):
        lines.append(f"| law alone, {title}: a third of the points elastic, yielding, failed | {million(last[name]['rate'])} · 10⁶ updates/s |")
    lines.append(f"| placement, relaxation and neighbours | {million(last['placement']['rate'])} · 10⁶ particles/s |")
    lines.append(f"| snapshots | {million(last['output']['rate'])} · 10⁶ particles/s |")
    lines.append(f"| quick blast to 12 µs, all parts | {million(last['blast']['rate'])} · 10⁶ particle-steps/s, contact {100 * last['blast']['share']:.0f} % of the time |")
    return lines


def goals(rows):
    lines = ["| what | goal | here | |", "|---|---|---|---|"]
    for name, goal in GOALS.items():
        rate = rows[name][-1]["rate"]
        lines.append(f"| {LOOPS[name]}, {rows[name][-1]['threads']} threads | {goal / 1e6:.0f} · 10⁶/s | {million(rate)} | {against(goal, rate)} |")
    for name, goal in BYTES.items():
        value = rows[name][-1]["bytes_per_particle"]
        lines.append(f"| bytes a particle, {LOOPS[name]} | {goal} | {value:.0f} | {against(goal, value, False)} |")
    gain = rows["rock"][-1]["rate"] / rows["rock"][0]["rate"]
    lines.append(f"| second thread, rock | 1.85 × | {gain:.2f} | {against(1.85, gain)} |")
    share = rows["rock"][-1]
    lines.append(f"| rock: share of arithmetic or of bandwidth | 20 % or 70 % | {100 * share['of_arithmetic']:.0f} %, {100 * share['of_bandwidth']:.0f} % | "
                 f"{against(1, max(share['of_arithmetic'] / 0.2, share['of_bandwidth'] / 0.7))} |")
    faster, smaller = rows["rock_single"][-1]["rate"] / rows["rock"][-1]["rate"], rows["rock_single"][-1]["bytes_per_particle"] / rows["rock"][-1]["bytes_per_particle"]
    lines.append(f"| single precision over double, rock: speed | 1.6 × | {faster:.2f} | {against(1.6, faster)} |")
    lines.append(f"| single precision over double, rock: memory | 55 % | {100 * smaller:.0f} % | {against(0.55, smaller, False)} |")
    rates = [r["rate"] for r in by_size()]
    spread = max(rates) / min(rates) - 1
    lines.append(f"| fastest over slowest size, 10⁵ … 2 · 10⁷ particles | + 30 % | + {100 * spread:.0f} % | {against(0.3, spread, False)} |")
    f = full()
    lines.append(f"| preset full: placement, {f['particles'] / 1e6:.2f} · 10⁶ particles | 60 s | {f['setup']:.0f} s | {against(60, f['setup'], False)} |")
    lines.append(f"| preset full: 150 µs | 1.5 h | {f['whole'] / 3600:.1f} h | {against(1.5, f['whole'] / 3600, False)} |")
    lines.append(f"| preset full: start-up, of the whole | 5 % | {100 * f['setup'] / f['whole']:.1f} % | {against(0.05, f['setup'] / f['whole'], False)} |")
    contact = rows["blast"][-1]["share"]
    lines.append(f"| contact, of the quick blast's time | 15 % | {100 * contact:.0f} % | {against(0.15, contact, False)} |")
    return lines


def by_size():
    return sorted((read(p.name)["rows"][-1] for p in FOLDER.glob("rock_*.json")), key=lambda r: r["particles"])


def sizes():
    lines = ["| particles | 10⁶ particle-steps/s | lowest … highest | bytes a particle |", "|---|---|---|---|"]
    lines += [f"| {r['particles']:,.0f} | {million(r['rate'])} | {million(r['lowest'])} … {million(r['highest'])} | {r['bytes_per_particle']:.0f} |" for r in by_size()]
    return lines


def full():
    """The measured stretch of the preset full, and what it says of the whole."""
    run, check, stretch, log = read("full_run.json"), read("full_check.json"), read("full_stretch_check.json"), (FOLDER / "full_log.txt").read_text(encoding="utf-8")
    end = float(re.search(r"until ([0-9.]+) us", log)[1])
    late = read("slice_run.json")
    late_end = float(re.search(r"run\.until=([0-9.]+) us", " ".join(late["settings"]))[1])
    measured, foretold = run["wall_seconds"], stretch["seconds"]
    proportion = check["seconds"] * measured / foretold
    as_slices = late["wall_seconds"] * 150 / late_end * run["particles"]["sheath"] / late["particles"]["sheath"]
    seconds = {part: run["particles"][part] * run["steps"] / rate for part, rate in run["rates"].items() if part != "all"}
    return {"particles": sum(run["particles"].values()), "setup": float(re.search(r"set up in ([0-9.]+) s", log)[1]), "end": end, "steps": run["steps"], "measured": measured, "short": stretch["steps"], "commit": run["commit"],
            "foretold": foretold, "proportion": proportion, "slice": late["wall_seconds"], "slice_end": late_end, "as_slices": as_slices, "whole": max(proportion, as_slices), "whole_foretold": check["seconds"], "threads": run["machine"]["threads"],
            "shares": ", ".join(f"{part} {100 * s / measured:.0f} %" for part, s in seconds.items())}


def stretch():
    f = full()
    return [f"`cases/blast/air_copper.toml --preset full` from the lighting to {f['end']:.2f} µs: {f['particles']:,} particles set up in {f['setup']:.0f} s, {f['steps']} long steps in {f['measured'] / 60:.1f} min on "
            f"{f['threads']} threads (commit {f['commit'].split('-')[0]}; `brisance check`, which measures the machine for a moment, foretells {f['short']:.0f} short steps and {f['foretold'] / 60:.1f} min). Of the time {f['shares']}; the rest is contact and output.",
            f"In the same proportion the 150 µs, which `check` puts at {f['whole_foretold'] / 3600:.1f} h, take {f['proportion'] / 3600:.1f}. The fluids decide: a million particles; for the 22 µs of the burn "
            "the sheath at the front holds the step, then the air and the sheath.",
            f"A slice of 12 layers with the same spacings, lit at once, takes {f['slice']:.0f} s for {f['slice_end']:g} µs (the command is in `tools/performance_page.py`). As often as the body is longer, and on to 150 µs, that is {f['as_slices'] / 3600:.1f} h. The goal is held against the longer of the two.",
            f"Neither knows the gas that has vented. The preset full-coarse, whole and with twice the spacing in the borehole, takes {read('coarse_run.json')['wall_seconds'] / 60:.0f} min for its 150 µs."]


def page():
    bench = read("bench.json")
    rows = by_name(bench)
    top = {name: rows[name][-1]["rate"] for name in ("bandwidth", "arithmetic", "arithmetic_single")}
    return "\n".join([
        "<!-- SPDX-License-Identifier: Apache-2.0 -->", "# Performance", "",
        f"{bench['cpu']}, {rows['rock'][-1]['threads']} threads, {bench['build']}; median of {bench['repeat']} runs, each a process of its own (commit {bench['commit'].split('-')[0]}). A virtual machine that others share: the columns *lowest … highest*",
        "tell how far to trust a number. Made by `tools/performance_page.py` from `brisance bench --json`, which measures the same on your machine.", "",
        f"The ceilings, measured too: {top['bandwidth'] / 1e9:.1f} GB/s, {top['arithmetic'] / 1e9:.0f} GFLOP/s in double, {top['arithmetic_single'] / 1e9:.0f} in single.", "",
        "## Loops", "", *loops(rows), "",
        "*Of the arithmetic* counts only what the method needs for each neighbour (`src/app/bench.cpp` says how many operations), no law, no kick. *Of the bandwidth* takes every byte of a particle in and out once a step. Water is measured twice: as the blast cases have it, and with as many neighbours as the goal counts. "
        f"Rock is a block of {rows['rock'][-1]['particles']:,.0f} particles; what a particle takes falls with the size (below).", "",
        "![Roofline](images/roofline.png)", "",
        "## What limits each loop", "",
        "* **Rock and copper** are bound by loads. A neighbour of rock costs 44 operations and 19 loads of a whole register, nearly all from the first two caches and most of them astride two cache lines, since a",
        "  neighbour's column begins anywhere in a line. Two loads a cycle, or one that straddles: that is where the time goes, not the multiply-adds. Single precision takes twice the particles in a load.",
        "* **Water** searches its neighbours anew each step: 28 % of its instructions, the two passes over the neighbours 25 and 37 % (`build/portable/loops fluid` under callgrind, as `tools/instructions.py` runs it); a record of",
        "  eight numbers is gathered for each neighbour in both passes and turned in registers.",
        "  Cells are walked in strips, so that what a strip's neighbours need stays in the second cache; with AVX-512 they are as wide as a support, since shorter rows leave packs of sixteen half empty.",
        "* **The second thread** shares with the first whatever the machine lets two threads share: compare the arithmetic of one thread with that of both before blaming the loop:",
        f"  here {rows['arithmetic'][0]['rate'] / 1e9:.0f} and {top['arithmetic'] / 1e9:.0f} GFLOP/s.",
        "* **Laws**: JH-2 is 9 % of the instructions of a loop of rock that fails (`build/portable/loops rock`). **Contact** looks only at pairs of parts that can have met since it looked last, sorts fluids by size, and asks",
        "  a map of rings of cells first where many particles look at few cells. What stands together, the particles of a cell three spacings wide, looks for its partners as one; the few that are near are read close together.",
        "* **Gas flung far out** does not widen the cells of the rest: where a grid would have sixteen cells per point it is sparse (`src/neighbours/sparse_rows.h`).",
        "* **Slices**: a pack holds particles of one column, 8 in double and 16 in single (half of that without AVX-512). Eight layers fill it; a ninth costs as much as eight, and single precision gains nothing in eight.", "",
        "## Everything else", "", *rest(rows), "",
        "## Goals", "", *goals(rows), "",
        "## The preset full", "", *stretch(), "", "## Size", "", f"Rock in double, {read('rock_1e6.json')['rows'][-1]['threads']} threads.", "", *sizes(), ""]) + "\n"


def figure():
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    import numpy as np
    rows = by_name(read("bench.json"))
    fig, axes = plt.subplots(figsize=(7.2, 4.4))
    intensity = np.logspace(-1.5, 1.7, 200)
    for k, style in ((0, "--"), (-1, "-")):
        for arithmetic, colour, word in (("arithmetic", "black", "double"), ("arithmetic_single", "tab:red", "single")):
            threads = rows[arithmetic][k]["threads"]
            axes.plot(intensity, np.minimum(rows["bandwidth"][k]["rate"] * intensity, rows[arithmetic][k]["rate"]) / 1e9, style, color=colour, lw=1.2,
                      label=f"{word}, {threads} thread{'s' if threads > 1 else ''}")
    for (name, title), marker in zip(LOOPS.items(), "osD^v"):
        for k, fill in ((0, "none"), (-1, "full")):
            r = rows[name][k]
            axes.plot(r["operations_per_second"] / (2 * r["bytes_per_particle"] * r["rate"]), r["operations_per_second"] / 1e9, marker, fillstyle=fill,
                      color="tab:red" if name == "rock_single" else "tab:blue", label=title if fill == "full" else None)
    axes.set(xscale="log", yscale="log", xlabel="operations per byte that must move once a step", ylabel="10⁹ operations/s")
    axes.legend(fontsize=8, frameon=False)
    axes.grid(alpha=0.3, which="both")
    fig.tight_layout()
    fig.savefig(FIGURE, dpi=130)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="write nothing; fail if the page is not what the measurements say")
    check = parser.parse_args().check
    if check:
        if PAGE.read_text(encoding="utf-8") != page():
            print("docs/performance.md does not follow from docs/performance/*.json: run /usr/bin/python3 tools/performance_page.py", file=sys.stderr)
            return 1
        return 0
    PAGE.write_text(page(), encoding="utf-8")
    figure()
    return 0


if __name__ == "__main__":
    sys.exit(main())
