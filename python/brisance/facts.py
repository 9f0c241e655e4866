# SPDX-License-Identifier: Apache-2.0
"""Words and tables of the report: summary, facts of a run, peaks at gauges, differences between runs, how to cite.

A table is (head, rows); cells are text. Missing numbers are written as a dash.
"""

import math
import shlex

import numpy as np

from brisance import energy, waves
from brisance.discrepancies import load as discrepancies
from brisance.run import PAPER_TIMES, labels, last, number, section_at

DASH = "–"
PAPER_PDF = {"air": 0.000942, "bare": 0.001682, "water": 0.003558}  # normalised, at 23 us
COUPLING = {"air": "air, copper", "water": "water, copper", "bare": "air, no copper", "water-bare": "water, no copper"}
SKELETON = "density_skeleton_mm_per_mm2"
PRINTED = "density_printed_mm_per_mm2"


def show(value, unit="", digits=4):
    """A number for readers: 4 digits, thousands apart, a dash where there is none."""
    if value is None or (isinstance(value, float) and math.isnan(value)):
        return DASH
    if isinstance(value, (int, np.integer)) or (float(value).is_integer() and abs(value) >= 1000):
        text = f"{int(value):,}".replace(",", "\u202f")
    else:
        text = f"{value:.{digits}g}"
        if "e" in text:
            mantissa, exponent = text.split("e")
            text = f"{mantissa}·10" + "".join("⁰¹²³⁴⁵⁶⁷⁸⁹"[int(c)] if c.isdigit() else "⁻" for c in str(int(exponent)))
    return f"{text} {unit}".strip()


def duration(seconds):
    """Wall time in words."""
    if seconds is None:
        return DASH
    if seconds < 120:
        return f"{seconds:.3g} s"
    if seconds < 7200:
        return f"{seconds / 60:.3g} min"
    return f"{seconds / 3600:.3g} h"


def short_commit(run):
    return str(run.provenance.get("commit") or "unknown")[:12]


def particles(run):
    """Particles of all parts, None when unknown."""
    counts = run.provenance.get("particles")
    return sum(counts.values()) if counts else None


def damaged(section, entry=None):
    entry = last(section) if entry is None else entry
    return entry.get("damaged")


def slice_words(run):
    s = run.provenance.get("slice")
    if not s:
        return ""
    return (f"plane-strain slice of {s.get('layers', '?')} layers ({show(s.get('thickness_mm'))} mm) at z = {show(s.get('z_mm'))} mm")


def summary(run):
    """The run in one paragraph of numbers."""
    p, words = run.provenance, []
    count = particles(run)
    form = slice_words(run) or "three-dimensional run"
    head = f"{form[0].upper()}{form[1:]}" + (f" with {show(count)} particles" if count else "")
    words.append(head + f", followed to {show(run.end)} µs" + (f" in {show(p.get('steps'))} steps" if p.get("steps") else "")
                 + (f" and {duration(p.get('wall_seconds'))} of wall time" if p.get("wall_seconds") else "") + ".")
    if p.get("status") not in (None, "finished"):
        words.append(f"The run did not reach its end: {p['status']}.")
    for section in run.sections:
        entry = last(section)
        if damaged(section) is None:
            continue
        causes = entry.get("damaged_by_cause") or {}
        total = max(1, damaged(section))
        shares = ", ".join(f"{100 * number(causes[c]) / total:.0f} % {c}" for c in ("tensile", "shear", "mixed") if causes.get(c))
        text = f"In the {section['name']} section {show(damaged(section))} of {show(section.get('particles'))} particles are damaged"
        text += f" ({shares})" if shares else ""
        more = [(entry.get("crushed_radius_mm"), "crushed to r = {} mm"), (entry.get("long_radial_cracks"), "{} long radial cracks"),
                (entry.get("longest_crack_mm"), "the longest crack {} mm")]
        more = [form.format(show(v, digits=3)) for v, form in more if v is not None]
        if entry.get("spall_coverage"):
            more.append(f"spall over {100 * entry['spall_coverage']:.0f} % of the circumference")
        words.append(text + ("; " + ", ".join(more) if more else "") + ".")
    fit = run.attenuation("pressure")
    if fit.get("exponent") is not None:
        words.append(f"Peak pressure falls off as r^−{abs(fit['exponent']):.2f}"
                     + (f" (± {fit['exponent_error']:.2g})" if fit.get("exponent_error") is not None else "") + ".")
    speed = waves.burn_speed(run)
    if math.isfinite(speed):
        words.append(f"The detonation ran at {speed:.2f} km/s.")
    worst = energy.worst_residual(run)
    if math.isfinite(worst):
        words.append(f"The energy balance closes to {show(100 * worst, digits=2)} %"
                     + (", outside the band of 1 %." if worst > 0.01 else "."))
    return " ".join(words)


def run_table(runs):
    """Facts of the runs, one column each."""
    def parts(run, key, form):
        return "; ".join(f"{name}: {form(v)}" for name, v in (run.provenance.get(key) or {}).items()) or DASH
    def machine(run):
        m = run.provenance.get("machine") or {}
        return ", ".join(str(v) for v in (m.get("cpu"), f"{m['threads']} threads" if m.get("threads") else None) if v) or DASH
    rows = [
        ("title", lambda r: r.title),
        ("status", lambda r: r.provenance.get("status") or DASH),
        ("case", lambda r: r.provenance.get("case_file") or DASH),
        ("preset", lambda r: r.provenance.get("preset") or DASH),
        ("settings", lambda r: ", ".join(map(str, r.provenance.get("settings") or [])) or "none"),
        ("model", lambda r: slice_words(r) or "three-dimensional"),
        ("particles", lambda r: parts(r, "particles", show)),
        ("end of the run", lambda r: show(r.end, "µs")),
        ("steps", lambda r: show(r.provenance.get("steps"))),
        ("wall time", lambda r: duration(r.provenance.get("wall_seconds"))),
        ("rates [particle-steps/s]", lambda r: parts(r, "rates", lambda v: f"{v / 1e6:.3g} M" if v >= 1e5 else show(v))),
        ("largest energy residual", lambda r: show(100 * energy.worst_residual(r), "%", 3)),
        ("largest penetration", lambda r: show(_last_of(r, "max_penetration", np.nanmax), "mm", 3)),
        ("leaked particles", lambda r: show(_last_of(r, "leaked", lambda c: c[-1]), digits=6)),
        ("machine", machine),
        ("started", lambda r: r.provenance.get("started") or DASH),
        ("finished", lambda r: r.provenance.get("finished") or DASH),
        ("brisance", lambda r: f"{r.provenance.get('version', '?')}, commit {short_commit(r)}"),
    ]
    return ["", *labels(runs)], [[name, *(f(r) for r in runs)] for name, f in rows]


def _last_of(run, column, reduce):
    if run.audit is None or column not in run.audit or np.all(np.isnan(run.audit[column])):
        return None
    return float(reduce(run.audit[column]))


def section_table(runs):
    """Measures of each section at the end of each run."""
    head = (["run"] if len(runs) > 1 else []) + ["section", "damaged", "tensile / shear / mixed", "longest crack", "long radial cracks",
            "radial coherence", "crushed to", "spall at", "spall over"]
    rows = []
    for run, label in zip(runs, labels(runs)):
        for s in run.sections:
            e, causes = last(s), last(s).get("damaged_by_cause") or {}
            cover = e.get("spall_coverage")
            rows.append(([label] if len(runs) > 1 else []) + [
                f"{s['name']} (z = {show(s.get('z_mm'))} mm)", show(e.get("damaged")),
                " / ".join(show(causes.get(c)) for c in ("tensile", "shear", "mixed")),
                show(e.get("longest_crack_mm"), "mm", 3), show(e.get("long_radial_cracks")), show(e.get("radial_coherence"), digits=3),
                show(e.get("crushed_radius_mm"), "mm", 3), show(e.get("spall_radius_mm"), "mm", 3),
                DASH if cover is None else f"{100 * cover:.0f} %"])
    return head, rows


def peak_table(runs):
    """Peaks, arrival and failure at every gauge."""
    head = (["run"] if len(runs) > 1 else []) + ["gauge", "r [mm]", "z [mm]", "arrival [µs]", "pressure [GPa]", "at [µs]", "σ₁ [GPa]",
            "τ_max [GPa]", "Mises [GPa]", "yield [GPa]", "damage", "failure [µs]", "cause"]
    rows = []
    for run, label in zip(runs, labels(runs)):
        for g in run.gauges:
            pressure, when = g.peak("pressure")
            rows.append(([label] if len(runs) > 1 else []) + [
                g.name, show(g.radius, digits=3), show(g.position[2]), show(g.arrival), show(pressure, digits=3), show(when),
                *(show(g.peak(n)[0], digits=3) for n in ("sigma_1", "tau_max", "mises", "yield")),
                show(float(g.table.get("damage")[-1]), digits=3), show(g.failure_time), g.failure_cause or DASH])
    return head, rows


def difference_table(runs):
    """Numbers of every run, with the difference from the first run in per cent."""
    rows = []

    def add(name, values, unit="", digits=4):
        values = [number(v) for v in values]
        if all(math.isnan(v) for v in values):
            return
        cells, base = [], values[0]
        for k, v in enumerate(values):
            relative = f" ({100 * (v / base - 1):+.0f} %)" if k and base and not math.isnan(v / base) else ""
            cells.append(show(v if not v.is_integer() else int(v), unit, digits) + relative if not math.isnan(v) else DASH)
        rows.append([name, *cells])

    add("end of the run", [r.end for r in runs], "µs")
    add("particles", [particles(r) for r in runs])
    for name in dict.fromkeys(s["name"] for r in runs for s in r.sections):
        ends = [last(r.section(name)) for r in runs]
        add(f"{name}: damaged", [e.get("damaged") for e in ends])
        add(f"{name}: damaged share", [number(e.get("damaged")) / number(r.section(name).get("particles") or None)
                                       for r, e in zip(runs, ends)], digits=3)
        for zone in range(max((len(e.get(PRINTED) or e.get(SKELETON) or []) for e in ends), default=0)):
            for key, words in ((PRINTED, "printed"), (SKELETON, "skeleton")):
                add(f"{name}: density, zone {zone + 1}, {words}",
                    [(e.get(key) or [None] * 9)[zone] if zone < len(e.get(key) or [None] * 9) else None for e in ends], "mm/mm²", 3)
        add(f"{name}: longest crack", [e.get("longest_crack_mm") for e in ends], "mm", 3)
        add(f"{name}: long radial cracks", [e.get("long_radial_cracks") for e in ends])
        add(f"{name}: crushed radius", [e.get("crushed_radius_mm") for e in ends], "mm", 3)
        add(f"{name}: spall coverage", [e.get("spall_coverage") for e in ends], digits=3)
    for part, words in (("pressure", "pressure"), ("radial_stress", "radial stress")):
        add(f"exponent of {words}", [r.attenuation(part).get("exponent") for r in runs], digits=3)
    for name in dict.fromkeys(g.name for r in runs for g in r.gauges):
        found = [next((g for g in r.gauges if g.name == name), None) for r in runs]
        add(f"{name}: peak pressure", [g.peak("pressure")[0] if g else None for g in found], "GPa", 3)
    add("borehole radius at the end", [((r.analysis.get("borehole") or {}).get("mean_radius_mm") or [None])[-1] for r in runs], "mm")
    add("largest energy residual", [100 * energy.worst_residual(r) for r in runs], "%", 3)
    add("wall time", [r.provenance.get("wall_seconds") for r in runs], "s")
    return ["", *labels(runs)], rows


def ratio_table(runs, t=PAPER_TIMES[0]):
    """The paper's ratios at 23 us: mean of the normalised distribution, lowest section, relative to the air-coupled run."""
    base = next((k for k, r in enumerate(runs) if r.coupling == "air"), 0)
    found = []
    for run in runs:
        entry = section_at(run.sections[0], t) if run.sections else None
        if entry is not None and abs(entry["t_us"] - t) > 5:
            entry = None
        pdf = [number(v) for v in (entry or {}).get("pdf_normalised") or []]
        found.append((entry, float(np.nanmean(pdf)) if pdf and np.isfinite(pdf).any() else math.nan, number((entry or {}).get("damaged"))))
    if all(entry is None for entry, _, _ in found):
        return None
    reference = runs[base].coupling

    def over(value, other):
        return value / other if other else math.nan

    rows = []
    for (entry, pdf, broken), run, label in zip(found, runs, labels(runs)):
        printed = PAPER_PDF.get(run.coupling)
        rows.append([label, COUPLING.get(run.coupling, DASH), show(entry["t_us"] if entry else None, "µs"),
                     show(broken if math.isnan(broken) else int(broken)), show(over(broken, found[base][2]), digits=3),
                     show(pdf), show(over(pdf, found[base][1]), digits=3),
                     f"{printed:.6f}" if printed else DASH, show(printed / PAPER_PDF[reference], digits=3) if printed and reference in PAPER_PDF else DASH])
    return ["run", "coupling", "time", "damaged", "ratio", "mean normalised PDF", "ratio", "paper", "paper's ratio"], rows


def commands(runs):
    """Shell commands that repeat the runs and this page."""
    lines = [str(r.provenance.get("command") or f"# {r.path}: the command was not recorded") for r in runs]
    return lines + ["brisance report " + " ".join(shlex.quote(str(r.path)) for r in runs)]


def citation(runs):
    """[(what, text)]"""
    versions = list(dict.fromkeys(f"version {r.provenance.get('version', 'unknown')}, commit {short_commit(r)}" for r in runs))
    return [("The program", f"brisance: smoothed particle hydrodynamics for rock blasting. Open-source software, {'; '.join(versions)}."),
            ("The paper whose experiments and simulations it repeats", f"{discrepancies()['paper']}."),
            ("The formulations", "the sources are named where each equation is used, on the theory pages of the documentation.")]
