# SPDX-License-Identifier: Apache-2.0
"""Crack measures: densities in zones (Eq. 12, Fig. 9), damaged particles in time (Fig. 10), polar distribution (Eq. 13, Fig. 11)."""

import math

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.patheffects import withStroke

from brisance import measurements, style
from brisance.plates import Absent, Plate
from brisance.run import choose_times, labels, last, number, section_at

DENSITIES = {
    "density_printed_mm_per_mm2": "as printed (Eq. 12)",
    "density_skeleton_mm_per_mm2": "skeleton (thinned cracks)",
}


def section_names(runs):
    """Names of all analysed sections of all runs, from the bottom up."""
    return list(dict.fromkeys(s["name"] for r in runs for s in r.sections))


def _zones(run):
    edges = run.zone_edges
    return [f"{a:g}–{b:g} mm" for a, b in zip(edges, edges[1:])]


def zones(runs):
    """Crack density in the zones: sections as bars for one run; one panel per section and runs as bars for several."""
    with_zones = [r for r in runs if any(last(s).get(d) for s in r.sections for d in DENSITIES)]
    if not with_zones:
        raise Absent("No crack densities were analysed.")
    names, single = section_names(with_zones), len(runs) == 1
    columns = 1 if single else len(names)
    shape = (1, 2) if single else (2, columns)
    figure, axes = style.subplots(*shape, size=(7.2, 2.9) if single else (2.6 * columns + 0.6, 5.0), sharey=False if single else "row")
    axes = axes.reshape(2, columns)
    ticks = max((_zones(r) for r in with_zones), key=len)
    measured_any = False
    for first, row, (key, title) in zip((True, False), axes, DENSITIES.items()):
        for ax, group in zip(row, [names] if single else [[n] for n in names]):
            bars = [(runs[0], n, style.depth_colour(k)) for k, n in enumerate(group)] if single else \
                   [(r, group[0], style.run_colour(k)) for k, r in enumerate(runs)]
            width = 0.8 / len(bars)
            for b, (run, name, colour) in enumerate(bars):
                values = [number(v) for v in last(run.section(name)).get(key) or []]
                at = np.arange(len(values)) - 0.4 + width * (b + 0.5)
                ax.bar(at, values, 0.92 * width, color=colour)
                for x, v in zip(at, values):
                    if math.isfinite(v):
                        ax.annotate(f"{v:.2g}", (x, v), xytext=(0, 1.5), textcoords="offset points", ha="center",
                                    fontsize=6, rotation=90 if not single and len(bars) > 2 else 0)
                measured = measurements.densities(name, run.coupling)
                for zone, v in measured.items():
                    ax.plot(at[0] + zone - 1, v, "D", ms=4, mfc="white", mec=style.INK)
                    measured_any = True
            ax.set_xticks(range(len(ticks)), ticks, fontsize=7.5)
            ax.tick_params(axis="x", length=0)
            style.light_grid(ax)
            ax.set_title(title if single else group[0] if first else "")
            ax.margins(y=0.12 if single else 0.22)
        row[0].set_ylabel("crack density [mm/mm²]" if single else f"{title}\n[mm/mm²]")
    handles = [Patch(fc=style.depth_colour(k), label=n) for k, n in enumerate(names)] if single else \
              [Patch(fc=style.run_colour(k), label=l) for k, l in enumerate(labels(runs))]
    if measured_any:
        handles.append(Line2D([], [], marker="D", ls="none", mfc="white", mec=style.INK, label="measured"))
    style.small_legend(figure, handles, columns=min(4, len(handles)))
    yield Plate("zones", "Crack density in the zones at the end of the run. As printed, Σ D·Δ / A over the particles with D "
                "above the threshold, a band k particles wide counts k times; the skeleton counts its length once, as image "
                "analysis of a cut face does." + ("" if measured_any else " No measurements are available."), figure)


def _counts(run, name):
    """(t [us], damaged particles) of a section: from history.csv, else from the analysed times."""
    column = f"damaged.{name}"
    if run.history and column in run.history:
        return run.history["t"], run.history[column]
    times = [e for e in run.section(name).get("times") or [] if e.get("damaged") is not None]
    return np.array([e["t_us"] for e in times], float), np.array([e["damaged"] for e in times], float)


def counts(runs):
    """Damaged particles in each section against time."""
    names = section_names(runs) or list(dict.fromkeys(
        c.removeprefix("damaged.") for r in runs if r.history for c in r.history.columns if c.startswith("damaged.")))
    if not any(_counts(r, n)[0].size for r in runs for n in names):
        raise Absent("No history of damaged particles was recorded.")
    if len(runs) == 1:
        yield _counts_of_one(runs[0], names)
        return
    figure, axes = style.subplots(1, len(names), size=(2.7 * len(names) + 0.6, 2.8), sharey=True)
    for ax, name in zip(axes[0], names):
        for k, run in enumerate(runs):
            ax.plot(*_counts(run, name), color=style.run_colour(k))
        ax.set(title=name, xlabel="time [µs]", xlim=(0, None), ylim=(0, None))
        style.light_grid(ax)
    axes[0, 0].set_ylabel("damaged particles")
    style.small_legend(figure, _run_lines(runs), columns=min(4, len(runs)))
    yield Plate("counts", "Number of damaged particles in each section against time. Runs with another particle spacing have "
                "another number of particles: compare shapes then, not heights.", figure)


def _counts_of_one(run, names):
    by_cause = [(n, e) for n in names if (e := [t for t in run.section(n).get("times") or [] if t.get("damaged_by_cause")])]
    figure, axes = style.subplots(1, 2 if by_cause else 1, size=(7.2 if by_cause else 4.4, 2.9))
    ax, ends = axes[0, 0], []
    for k, name in enumerate(names):
        t, n = _counts(run, name)
        if t.size:
            ax.plot(t, n, color=style.depth_colour(k))
            ends.append((t[-1], n[-1], name, style.depth_colour(k)))
    ax.set(xlabel="time [µs]", ylabel="damaged particles", xlim=(0, None), ylim=(0, None), title="by section")
    style.light_grid(ax)
    style.label_ends(ax, ends, gap=0.07)
    if by_cause:
        name, entries = by_cause[0]
        ax = axes[0, 1]
        t = [e["t_us"] for e in entries]
        parts = {c: np.array([number(e["damaged_by_cause"].get(c, 0)) for e in entries]) for c in style.CAUSE}
        ax.stackplot(t, list(parts.values()), colors=list(style.CAUSE.values()), lw=0)
        top = np.cumsum([p[-1] for p in parts.values()])
        ax.set(xlabel="time [µs]", xlim=(0, max(t)), ylim=(0, None), title=f"{name} section, by cause")
        style.label_ends(ax, [(t[-1], h - p[-1] / 2, c, style.CAUSE[c]) for h, (c, p) in zip(top, parts.items()) if p[-1] > 0], 0.07)
    return Plate("counts", "Number of damaged particles in each section against time"
                 + (", and for the lowest section by cause of failure." if by_cause else "."), figure)


def _run_lines(runs):
    return [Line2D([], [], color=style.run_colour(k), label=l) for k, l in enumerate(labels(runs))]


def _petal(ax, values, colour, fill=0.25, **options):
    """A histogram over the full circle as a stepped outline."""
    edges = np.linspace(0, 2 * np.pi, len(values) + 1)
    theta, r = np.repeat(edges, 2)[1:-1], np.repeat(values, 2)
    theta, r = np.append(theta, theta[0]), np.append(r, r[0])
    ax.plot(theta, r, color=colour, lw=0.9, **options)
    if fill:
        ax.fill(theta, r, color=colour, alpha=fill, lw=0)


def polar(runs):
    """Crack distribution over 72 sectors at several times: sections as rows, times as columns."""
    names = [n for n in section_names(runs) if any(e.get("pdf") for r in runs for e in r.section(n).get("times") or [])]
    if not names:
        raise Absent("No polar distribution was analysed.")
    single = len(runs) == 1
    key = "pdf" if single else "pdf_normalised"
    found = sorted({float(e["t_us"]) for r in runs for n in names for e in r.section(n).get("times") or [] if e.get(key)})
    if not found:
        raise Absent("No normalised polar distribution was analysed.")
    times = choose_times(found)
    figure, axes = style.subplots(len(names), len(times), size=(2.35 * len(times) + 0.2, 2.5 * len(names) + 0.3),
                                  subplot_kw={"projection": "polar"})
    for k, (row, name) in enumerate(zip(axes, names)):
        for ax, t in zip(row, times):
            top = 0.0
            for j, run in enumerate(runs):
                entry = section_at(run.section(name), t)
                values = np.array([number(v) for v in (entry or {}).get(key) or []])
                if values.size and np.isfinite(values).any():
                    _petal(ax, np.nan_to_num(values), style.depth_colour(k) if single else style.run_colour(j), 0.3 if single else 0.12)
                    top = max(top, float(np.nanmax(values)))
            if single:
                ax.plot(np.linspace(0, 2 * np.pi, 200), np.ones(200), color=style.FAINT, lw=0.7, ls=(0, (3, 3)))
            if not top:
                ax.text(0.5, 0.62, "no damage", transform=ax.transAxes, ha="center", fontsize=7, color=style.FAINT)
            top = 1.08 * top or 1.0
            ax.set_ylim(0, top)
            ax.set_rticks([top / 2, top], [f"{top / 2:.2g}", f"{top:.2g}"], fontsize=6, color=style.FAINT)
            ax.set_rlabel_position(67)
            for label in ax.get_yticklabels():
                label.set_path_effects([withStroke(linewidth=2, foreground="white")])
            ax.set_xticks(np.radians([0, 90, 180, 270]), ["0°", "90°", "180°", "270°"], fontsize=6.5)
            ax.tick_params(pad=-2)
            ax.spines["polar"].set_linewidth(0.4)
            ax.set_title(f"{name}, {t:.4g} µs", fontsize=8, loc="center", pad=4)
    if not single:
        style.small_legend(figure, _run_lines(runs), columns=min(4, len(runs)))
    yield Plate("polar", ("Crack distribution over 72 sectors of 5° (Eq. 13). A uniform distribution gives 1 in every sector "
                          "(dashed circle)." if single else
                          "Crack distribution over 72 sectors of 5°, normalised for comparison between runs; "
                          "each run at its recorded time nearest to the one shown.")
                + " The radial scale differs from panel to panel.", figure)


def harmonics(runs):
    """Harmonics 1 ... 12 of the polar distribution at the end: a lattice would show in the 4th and 8th."""
    rows = [(r, s, last(s)["harmonics"]) for r in runs for s in r.sections if last(s).get("harmonics")]
    if not rows:
        raise Absent("No harmonics of the distribution were analysed.")
    single, names = len(runs) == 1, section_names(runs)
    if not single:
        rows = [row for row in rows if row[1]["name"] == rows[0][1]["name"]]
    figure, axes = style.subplots(1, 1, size=(7.2, 2.3))
    ax, width = axes[0, 0], 0.8 / len(rows)
    for n in (4, 8):
        ax.axvspan(n - 0.5, n + 0.5, color="#f3efe2", lw=0)
        ax.annotate("lattice", (n, 1.0), xycoords=("data", "axes fraction"), ha="center", va="bottom", fontsize=7, color=style.FAINT)
    for b, (run, section, values) in enumerate(rows):
        colour = style.depth_colour(names.index(section["name"])) if single else style.run_colour(runs.index(run))
        order = sorted(values, key=int)
        at = np.array([int(n) for n in order]) - 0.4 + width * (b + 0.5)
        ax.bar(at, [number(values[n]) for n in order], 0.92 * width, color=colour,
               label=section["name"] if single else labels(runs)[runs.index(run)])
    ax.set(xlabel="harmonic of the polar distribution", ylabel="amplitude [–]", xlim=(0.4, 12.6))
    ax.set_xticks(range(1, 13))
    ax.tick_params(axis="x", length=0)
    style.light_grid(ax)
    style.small_legend(figure, ax.get_legend_handles_labels()[0], columns=min(4, len(rows)))
    yield Plate("harmonics", "Harmonics of the polar distribution at the end"
                + (": " if single else f", {rows[0][1]['name']} section: ")
                + "an arrangement of particles with preferred directions shows as a peak at 4 and 8.", figure)
