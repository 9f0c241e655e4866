# SPDX-License-Identifier: Apache-2.0
"""Pages of the verification gallery: the README of each case, its figure and the table of its results.

Everything on a page comes from the case's folder and from the results of `brisance verify`; docs/verification/results.json keeps the latter.
"""

import json
import shutil

from brisance.verification import FIELDS, ROOT

DOCS = ROOT / "docs" / "verification"
SPDX = "<!-- SPDX-License-Identifier: Apache-2.0 -->\n"


def number(value, digits=5):
    if value is None:
        return "–"
    return f"{value:.{digits}g}".replace("e-0", "e-").replace("e+0", "e")


def percent(value):
    return f"{100 * value:+.2f} %" if abs(value) >= 1e-4 else f"{value:+.1e}"


def worst(result):
    """The row nearest to its bound, or farthest beyond."""
    judged = [r for r in result["rows"] if r["bound"]]
    return max(judged, key=lambda r: abs(r["error"]) / r["bound"], default=None)


def state(result):
    verdicts = [r["verdict"] for r in result["rows"] + result["orders"]]
    if result["failed"] or "MISSED" in verdicts:
        return "**missed**"
    return "known miss" if "known miss" in verdicts else "met"


def result_table(result, case):
    lines = ["| quantity | run | spacing, mm | computed | exact | error | bound | |", "|---|---|---|---|---|---|---|---|"]
    for r in result["rows"]:
        unit = f", {r['unit']}" if r["unit"] else ""
        norm = r["want"] == 0 and r["have"] == r["error"]
        lines.append(f"| {r['quantity'].replace('_', ' ')}{unit} | {r['run']} | {number(r['spacing_mm'])} | {'' if norm else number(r['have'])} | {'' if norm else number(r['want'])} | "
                     f"{percent(r['error'])} | {'' if r['bound'] is None else percent(r['bound'])[1:]} | {r['verdict']} |")
    for o in result["orders"]:
        lines.append(f"\nOrder of convergence of *{o['quantity'].replace('_', ' ')}*: {o['order']:.2f} (claimed: at least {o['claimed']:g}), {o['verdict']}.")
    for p in result["failed"]:
        lines.append(f"\nThe run {p['run']} failed: {p['problem']}")
    reasons = "\n".join(f"* *{name.replace('_', ' ')}*: {q.reason}" + (f" **Known miss:** {q.miss}" if q.miss else "") for name, q in case.quantities.items())
    return "\n".join(lines) + "\n\nWhy these bounds:\n\n" + reasons


def page(result, case, figure):
    """The page of a case as Markdown."""
    readme = (case.path / "README.md").read_text(encoding="utf-8").removeprefix(SPDX).strip()
    seconds = sum(r["seconds"] for r in result["runs"])
    lane = " --lane full" if result["lane"] == "full" else ""
    return (f"{SPDX}{readme}\n\n![{case.title}]({figure})\n\n## Results\n\n{result_table(result, case)}\n\n"
            f"`./brisance verify {case.name}{lane}`, {seconds:.0f} s. Files: `cases/verification/{case.name}/` (case, exact solution, bounds). [All cases](index.md)\n")


def question(case):
    """The first sentence of the README's paragraph **Question.**"""
    text = (case.path / "README.md").read_text(encoding="utf-8").split("**Question.**", 1)[-1].strip().split("\n\n")[0].replace("\n", " ")
    return text


def index(results, cases):
    lines = [SPDX + "# Verification", "",
             "Every mechanism against an exact answer. `./brisance verify` runs the quick lane, `./brisance verify --lane full` all of it; both write these",
             "pages from the folders in `cases/verification/`, and `./brisance verify --lane full --docs` renews the ones here. A bound is never widened to be met;",
             "what misses its bound is listed as a known miss, with the reason on its page. [A broken program is caught](mutants.md): what notices a wrong sign or factor.", ""]
    for key, title in FIELDS.items():
        mine = [r for r in results.values() if r["field"] == key]
        if not mine:
            continue
        lines += [f"## {title}", "", "| case | question | nearest to its bound | order | |", "|---|---|---|---|---|"]
        for r in mine:
            w = worst(r)
            close = f"{w['quantity'].replace('_', ' ')}: {percent(w['error'])} (bound {percent(w['bound'])[1:]})" if w else ""
            orders = ", ".join(f"{o['order']:.1f}" for o in r["orders"])
            lines.append(f"| [{cases[r['name']].title}]({r['name']}.md) | {question(cases[r['name']])} | {close} | {orders} | {state(r)} |")
        lines.append("")
    return "\n".join(lines)


def write(folder, results, cases, figures):
    """Pages and index for results {name: result} into a folder; figures are NAME.png in `figures`."""
    results = {name: results[name] for name in sorted(results)}
    for name, result in results.items():
        (folder / f"{name}.md").write_text(page(result, cases[name], f"{name}.png"), encoding="utf-8")
        source = figures / f"{name}.png"
        if source.is_file() and source.resolve() != (folder / f"{name}.png").resolve():
            shutil.copyfile(source, folder / f"{name}.png")
    (folder / "index.md").write_text(index(results, cases), encoding="utf-8")


def stored():
    """The results that docs/verification was written from."""
    file = DOCS / "results.json"
    return {r["name"]: r for r in json.loads(file.read_text(encoding="utf-8"))["cases"]} if file.is_file() else {}


def update_docs(results, cases, figures):
    """Puts new results in place of the stored ones and writes docs/verification anew."""
    DOCS.mkdir(parents=True, exist_ok=True)
    kept = {name: r for name, r in stored().items() if name in cases}
    kept.update({r["name"]: r for r in results})
    kept = {name: kept[name] for name in sorted(kept)}
    (DOCS / "results.json").write_text(json.dumps({"schema": 1, "cases": list(kept.values())}, indent=1) + "\n", encoding="utf-8")
    write(DOCS, kept, cases, figures)
