# SPDX-License-Identifier: Apache-2.0
"""Maps of the sections: damage with its cause in colour (the paper's Figs 3 and 5), its growth, and the times of failure."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, Patch

from brisance import snapshots, style
from brisance.painter import Painter
from brisance.plates import Absent, Plate
from brisance.run import PAPER_TIMES, choose_times, labels, number

EARLY = 10.0  # us, shown before the paper's times: the crushed zone


def painters(run):
    """Painter by section, made once per run: they are costly where there are many particles."""
    if not hasattr(run, "_painters"):
        run._painters = {name: Painter(m) for name, m in run.maps.items()}
    return run._painters


def frame(axes, section_map, zone_edges=(), text=True, scale=20):
    """Outlines of specimen and borehole, zone circles, and a scale bar of `scale` mm."""
    reach = section_map.outer
    axes.add_patch(Circle((0, 0), reach, fill=False, lw=0.6, ec=style.FAINT, zorder=2))
    if section_map.hole:
        axes.add_patch(Circle((0, 0), section_map.hole, fill=False, lw=0.7, ec=style.INK, zorder=3))
    for r in zone_edges:
        if 0 < r < 0.99 * reach:
            axes.add_patch(Circle((0, 0), r, fill=False, lw=0.6, ls=(0, (4, 4)), ec="#444444", zorder=3))
            if text:
                axes.text(r * 0.7071, -r * 0.7071, f"{r:g} mm", fontsize=6.5, ha="center", va="center", rotation=45, zorder=4,
                          bbox=dict(boxstyle="round,pad=0.15", fc="white", ec="none", alpha=0.75))
    bar_y = -1.0 * reach
    axes.plot([-reach, -reach + scale], [bar_y, bar_y], color=style.INK, lw=1.6, solid_capstyle="butt", zorder=4)
    axes.text(-reach + scale / 2, bar_y + 0.025 * reach, f"{scale} mm", fontsize=6.5 if text else 5.5, ha="center")


def stars(axes, run, names=True):
    """The gauges, as the paper's green stars."""
    for gauge in run.gauges:
        x, y, _ = (p - c for p, c in zip(gauge.position, (*run.centre, 0.0)))
        axes.plot(x, y, marker="*", ms=9 if names else 5, mfc="#37b34a", mec="white", mew=0.6, ls="none", zorder=6)
        if names and len(run.gauges) <= 12:
            axes.annotate(gauge.name, (x, y), xytext=(5, 4), textcoords="offset points", fontsize=7, zorder=6,
                          bbox=dict(boxstyle="round,pad=0.1", fc="white", ec="none", alpha=0.7))


def cause_legend(run=None, counts=None, gauges=False):
    """Handles for the colours; `counts`: damaged particles by cause."""
    handles = [Patch(fc=style.ROCK, label="rock"),
               Patch(fc=style.blend(style.ROCK, style.PARTIAL, 0.8), label="partly damaged (pale)")]
    for name, colour in style.CAUSE.items():
        share = f" {counts[name]}" if counts and counts.get(name) is not None else ""
        handles.append(Patch(fc=colour, label=name + share))
    if gauges:
        handles.append(Line2D([], [], marker="*", ls="none", mfc="#37b34a", mec="white", ms=9, label="gauge"))
    return handles


def _counts(section_map, threshold):
    broken = section_map.damage >= threshold
    return {name: int(np.sum(broken & (section_map.cause == k + 1))) for k, name in enumerate(style.CAUSE)}


def _name(run, name):
    z = run.section(name).get("z_mm")
    return name if z is None else f"{name}, z = {z:g} mm"


def damage(runs):
    """Final damage: one large map per section of a single run; sections by runs for several."""
    if not any(r.maps for r in runs):
        raise Absent("No section was recorded, so there is no damage map.")
    if len(runs) == 1:
        run = runs[0]
        for name, section_map in run.maps.items():
            figure, axes = plt.subplots(figsize=(6.6, 6.9))
            painters(run)[name].damage(axes, section_map.damage, section_map.cause, run.threshold)
            frame(axes, section_map, run.zone_edges)
            stars(axes, run)
            counts = _counts(section_map, run.threshold)
            axes.set_title(f"{_name(run, name)}   ·   t = {run.end:.4g} µs   ·   "
                           f"{int(np.sum(section_map.damage >= run.threshold))} damaged of {len(section_map.x)} particles")
            style.small_legend(figure, cause_legend(counts=counts, gauges=bool(run.gauges)))
            yield Plate(f"damage_{name}", f"Section {_name(run, name)}: damage in the reference configuration at the end of "
                        f"the run, with the cause of failure in colour where D ≥ {run.threshold:g}. Each particle is drawn "
                        "at its own size. Dashed circles bound the zones of the crack density."
                        + (" Stars mark the gauges, whatever their height." if run.gauges else ""), figure)
        return
    names = _shared(runs)
    figure, axes = style.subplots(len(names), len(runs), size=(3.2 * len(runs) + 0.3, 3.25 * len(names) + 0.4))
    for row, name in zip(axes, names):
        for ax, run, label in zip(row, runs, labels(runs)):
            ax.axis("off")
            if name in run.maps:
                painters(run)[name].damage(ax, run.maps[name].damage, run.maps[name].cause, run.threshold)
                frame(ax, run.maps[name], run.zone_edges, text=False)
            ax.set_title(f"{label}\n{_name(run, name)}, t = {run.end:.4g} µs", fontsize=8)
    style.small_legend(figure, cause_legend())
    yield Plate("damage", "Final damage of the sections (rows) in the runs (columns), with the cause of failure in colour.", figure)


def _shared(runs):
    """Names of all sections of all runs, in order."""
    return list(dict.fromkeys(name for r in runs for name in r.maps))


def growth(runs):
    """Damage at several times, from snapshots where they hold the sections, else from the failure times."""
    if not any(r.maps for r in runs):
        raise Absent("No section was recorded.")
    for k, run in enumerate(runs):
        if run.maps:
            yield _growth(run, f"growth_{k + 1}" if len(runs) > 1 else "growth", labels(runs)[k] if len(runs) > 1 else "")


def _growth(run, key, title):
    available = snapshots.series(run)
    states, source = _from_snapshots(run, available) if available else ({}, "")
    if not states:
        times = sorted({t for t in (EARLY, *PAPER_TIMES) if t < run.end} | {run.end})[:4]
        if len(times) < 3:
            times = [run.end * k / 3 for k in (1, 2, 3)]
        states = {(n, t): snapshots.state_from_failure_time(m, t) for n, m in run.maps.items() for t in times}
        source = "told from the failure time of each particle (the snapshots do not hold the sections)"
    times = sorted({t for _, t in states})
    figure, axes = style.subplots(len(run.maps), len(times), size=(2.1 * len(times) + 0.2, 2.25 * len(run.maps) + 0.3))
    for row, (name, section_map) in zip(axes, run.maps.items()):
        for ax, t in zip(row, times):
            ax.axis("off")
            if (name, t) in states:
                painters(run)[name].damage(ax, *states[name, t], run.threshold)
                frame(ax, section_map, run.zone_edges, text=False)
            ax.set_title(f"{name}, {t:.4g} µs", fontsize=8)
    style.small_legend(figure, cause_legend())
    return Plate(key, (f"{title}: growth" if title else "Growth") + f" of the damage, {source}.", figure)


def _from_snapshots(run, available):
    """{(section, time): (damage, cause)} of about four times."""
    times = choose_times([t for t, _ in available if t > 0], (EARLY, *PAPER_TIMES))
    paths = dict(available)
    states = {}
    for name, section_map in run.maps.items():
        z = number(run.section(name).get("z_mm"))
        if np.isnan(z):
            continue
        finder = snapshots.SectionFinder(section_map, z)
        for t in times:
            state = finder.state(paths[t])
            if state is not None:
                states[name, t] = state
    return states, "from the snapshots"


def failure_times(runs):
    """When each particle failed: the fronts of crushing, of the radial cracks and of the spall."""
    maps = [(r, n, m) for r in runs for n, m in r.maps.items() if np.isfinite(m.failure_time).any()]
    if not maps:
        raise Absent("No particle of a recorded section failed, so there is no map of failure times.")
    end = max(float(np.nanmax(m.failure_time)) for _, _, m in maps)
    names = list(dict.fromkeys(n for _, n, _ in maps))
    shape = (1, len(names)) if len(runs) == 1 else (len(names), len(runs))
    figure, axes = style.subplots(*shape, size=(3.0 * shape[1] + 0.3, 3.15 * shape[0] + 0.6))
    for ax in axes.flat:
        ax.axis("off")
    colour = ScalarMappable(Normalize(0, end), "viridis_r")
    titles = dict(zip(map(id, runs), labels(runs)))
    for run, name, m in maps:
        ax = axes[0, names.index(name)] if len(runs) == 1 else axes[names.index(name), runs.index(run)]
        colours = np.tile(style.blend("#f3f2ee", style.ROCK, 0.3), (len(m.x), 1))
        failed = np.isfinite(m.failure_time) & (m.damage >= run.threshold)
        colours[failed] = colour.to_rgba(m.failure_time[failed])[:, :3]
        painters(run)[name].draw(ax, colours, order=failed)
        frame(ax, m, (), text=False)
        ax.set_title(name if len(runs) == 1 else f"{titles[id(run)]}\n{name}", fontsize=8)
    bar = figure.colorbar(colour, ax=axes, orientation="horizontal", fraction=0.035, pad=0.02, aspect=50)
    bar.set_label("time of failure [µs]")
    bar.outline.set_linewidth(0.4)
    yield Plate("failure_times", "When each damaged particle failed.", figure)
