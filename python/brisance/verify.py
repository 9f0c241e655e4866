#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Run verification cases, hold them against their exact solutions, write a page for each.

    verify.py [CASE ...] [--lane quick|full] [--out DIR] [--json] [--list] [--docs]

Exit codes: 0 all bounds are met (known misses aside), 1 a bound is missed or a run failed, 2 bad input, 4 a module is missing or the disk refuses.
"""

import sys
from pathlib import Path

if not __package__:  # run as a script: let `brisance` be found, and none of its modules hide one of the standard library
    sys.path[0] = str(Path(__file__).resolve().parents[1])

from brisance import needs  # noqa: E402

EXIT_OK, EXIT_MISSED, EXIT_BAD_INPUT, EXIT_RESOURCES = 0, 1, 2, needs.EXIT_RESOURCES
NOT_MET = ("MISSED", "FAILED")


def _arguments(argv):
    import argparse
    parser = argparse.ArgumentParser(prog="brisance verify", description="Run verification cases and hold them against their exact solutions.")
    parser.add_argument("cases", metavar="CASE", nargs="*", help="folders of cases/verification (default: all of the lane)")
    parser.add_argument("--lane", choices=("quick", "full"), default="quick")
    parser.add_argument("--out", type=Path, default=Path("runs/verify"), help="where runs, pages and verify.json go")
    parser.add_argument("--json", action="store_true", help="print the results as JSON")
    parser.add_argument("--list", action="store_true", help="name the cases, run nothing")
    parser.add_argument("--docs", action="store_true", help="write the pages of docs/verification too")
    return parser.parse_args(argv)


def run_one(program, case, entry, folder, threads):
    """Runs one entry of a case; the seconds it took and what went wrong ("" where nothing did)."""
    import subprocess
    import time
    command = [program, "run", str(case.path / "case.toml"), "--out", str(folder), "--overwrite", "--no-report", "--quiet", "--threads", str(threads)]
    if entry["preset"]:
        command += ["--preset", entry["preset"]]
    for setting in entry["set"]:
        command += ["--set", setting]
    start = time.monotonic()
    done = subprocess.run(command, capture_output=True, text=True)
    said = done.stderr.strip().splitlines()
    problem = next((line.removeprefix("error: ") for line in said if line.startswith("error: ")), said[-1] if said else f"exit code {done.returncode}")
    return time.monotonic() - start, "" if done.returncode == 0 else problem


def judge(case, lane, shots, problems):
    """The results of a case as a dictionary, from its finished runs. Evaluated by its exact.py, judged by its expected.toml."""
    from brisance.verification import BadCase, order
    rows, found, broken = [], {}, []
    for shot in shots:
        if problems.get(shot.name):
            broken.append({"run": shot.name, "problem": problems[shot.name]})
            continue
        try:
            measured = case.exact.measure(shot)
        except (ArithmeticError, IndexError, ValueError) as error:  # a run so wrong that it cannot be measured
            broken.append({"run": shot.name, "problem": f"cannot be measured: {error}"})
            continue
        for name, result in measured.items():
            found.setdefault(name, []).append((shot, result))
    if hasattr(case.exact, "compare") and not broken:
        for name, result in case.exact.compare(shots).items():
            found.setdefault(name, []).append((None, result))
    for name, expected in case.quantities.items():
        for shot, result in found.get(name, []):
            bound = expected.bound_of(shot.name) if shot else expected.bound
            verdict = "" if bound is None else "ok" if abs(result.error) <= bound else "known miss" if expected.miss else "MISSED"
            rows.append({"quantity": name, "unit": expected.unit, "run": shot.name if shot else "all", "spacing_mm": shot.spacing if shot else None,
                         "have": result.have, "want": result.want, "error": result.error, "bound": bound, "verdict": verdict})
    stray = set(found) - set(case.quantities)
    if stray:
        raise BadCase(f"{case.path / 'exact.py'}: the quantity '{sorted(stray)[0]}' is not in expected.toml; there are: {', '.join(case.quantities)}")
    if not broken:
        for name in case.quantities:
            judged = [r for r in rows if r["quantity"] == name and r["verdict"]]
            whole = lane == "full" or all(r["lane"] == "quick" for r in case.runs)
            if whole and not judged:
                raise BadCase(f"{case.path}: the quantity '{name}' is measured by no run that has a bound")
    orders = []
    for name, expected in case.quantities.items():
        pairs = [(s.spacing, r.error) for s, r in found.get(name, []) if s]
        if expected.order is None or len({h for h, _ in pairs}) < 3:
            continue
        have = order(*zip(*pairs))
        orders.append({"quantity": name, "order": have, "claimed": expected.order,
                       "verdict": "ok" if have >= expected.order else "known miss" if expected.miss else "MISSED"})
    return {"name": case.name, "title": case.title, "field": case.field, "lane": lane, "seconds": sum(s.seconds for s in shots),
            "runs": [{"run": s.name, "spacing_mm": None if problems.get(s.name) else s.spacing, "seconds": s.seconds} for s in shots],
            "rows": rows, "orders": orders, "failed": broken}


def verdicts(result):
    return [r["verdict"] for r in result["rows"] + result["orders"] if r["verdict"]] + ["FAILED"] * len(result["failed"])


def short(value, digits=4):
    return "" if value is None else f"{value:.{digits}g}"


def table(results):
    """The results as text for a terminal."""
    lines = [f"{'case':<22} {'quantity':<26} {'run':<10} {'computed':>11} {'exact':>11} {'error':>9} {'bound':>8} {'order':>6} {'s':>6}"]
    for result in results:
        orders = {o["quantity"]: o for o in result["orders"]}
        seconds = {r["run"]: r["seconds"] for r in result["runs"]}
        for row in result["rows"]:
            mine = orders.get(row["quantity"])
            lines.append(f"{result['name']:<22} {row['quantity']:<26} {row['run']:<10} {short(row['have'], 5):>11} {short(row['want'], 5):>11} {row['error']:>9.2g} "
                         f"{short(row['bound'], 3):>8} {mine['order'] if mine else float('nan'):>6.2f} {seconds.get(row['run'], result['seconds']):>6.1f}  {row['verdict']}".replace("   nan", "      "))
        for o in result["orders"]:
            if o["verdict"] != "ok":
                lines.append(f"{result['name']:<22} {o['quantity']:<26} order {o['order']:.2f}, claimed {o['claimed']:g}  {o['verdict']}")
        for problem in result["failed"]:
            lines.append(f"{result['name']:<22} {problem['run']}: FAILED: {problem['problem']}")
    return "\n".join(lines)


def summary(results, seconds):
    every = [v for r in results for v in verdicts(r)]
    bad = sum(v in NOT_MET for v in every)
    return (f"{len(results)} cases, {len(every)} bounds: {every.count('ok')} met, {every.count('known miss')} known misses, {bad} missed; {seconds:.0f} s")


def evaluate(cases, lane, out, program, say=print):
    """Runs the cases of a lane and judges them: their results, with figures in out/NAME.png."""
    import os
    from concurrent.futures import ThreadPoolExecutor
    from brisance.verification import Shot
    cores = len(os.sched_getaffinity(0))
    workers = min(cores, 4)
    with ThreadPoolExecutor(workers) as pool:
        futures = {(case.name, entry["name"]): pool.submit(run_one, program, case, entry, out / case.name / entry["name"], max(1, cores // workers))
                   for case in cases for entry in case.of_lane(lane)}
        results = []
        for case in cases:
            shots, problems = [], {}
            for entry in case.of_lane(lane):
                seconds, problem = futures[case.name, entry["name"]].result()
                shots.append(Shot(entry["name"], out / case.name / entry["name"], seconds))
                problems[entry["name"]] = problem
            result = judge(case, lane, shots, problems)
            bad = {p["run"] for p in result["failed"]}
            good = [s for s in shots if s.name not in bad]
            if good:
                case.exact.figure(good, out / f"{case.name}.png")
            results.append(result)
            say(table([result]).split("\n", 1)[1] if result["rows"] or result["failed"] else f"{case.name}: nothing measured")
    return results


def main(argv=None):
    arguments = _arguments(sys.argv[1:] if argv is None else argv)
    needs.require()
    import json
    import os
    import time
    from brisance import gallery
    from brisance.verification import ROOT, BadCase, BadRun, all_cases
    try:
        known = all_cases()
        for name in arguments.cases:
            if name not in known:
                raise BadCase(f"no verification case '{name}'; there are: {', '.join(known)}")
        chosen = [known[n] for n in arguments.cases or known if known[n].of_lane(arguments.lane)]
        lacking = [n for n in arguments.cases if not known[n].of_lane(arguments.lane)]
        if lacking:
            raise BadCase(f"the case '{lacking[0]}' has no run in the lane {arguments.lane}; add --lane full")
        if arguments.list:
            for case in chosen:
                print(f"{case.name:<24} {case.field:<8} {case.title}")
            return EXIT_OK
        start = time.monotonic()
        arguments.out.mkdir(parents=True, exist_ok=True)
        say = (lambda text: None) if arguments.json else (lambda text: print(text, flush=True))
        say(table([]))
        results = evaluate(chosen, arguments.lane, arguments.out, os.environ.get("BRISANCE", str(ROOT / "brisance")), say)
        record = {"schema": 1, "lane": arguments.lane, "cases": results}
        (arguments.out / "verify.json").write_text(json.dumps(record, indent=1) + "\n", encoding="utf-8")
        gallery.write(arguments.out, {r["name"]: r for r in results}, known, arguments.out)
        if arguments.docs:
            gallery.update_docs(results, known, arguments.out)
    except (BadCase, BadRun) as error:
        print(f"brisance verify: {error}", file=sys.stderr)
        return EXIT_BAD_INPUT
    except OSError as error:
        print(f"brisance verify: {error}", file=sys.stderr)
        return EXIT_RESOURCES
    if arguments.json:
        print(json.dumps(record, indent=1))
    say(summary(results, time.monotonic() - start))
    return EXIT_MISSED if any(v in NOT_MET for r in results for v in verdicts(r)) else EXIT_OK


if __name__ == "__main__":
    sys.exit(main())
