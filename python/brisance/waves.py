# SPDX-License-Identifier: Apache-2.0
"""Waves: gauges (the paper's Figs 4 and 6-8), attenuation, expansion of the borehole, and the burn front."""

import math

import numpy as np
from matplotlib.lines import Line2D

from brisance import measurements, style
from brisance.plates import Absent, Plate
from brisance.run import labels, number

PANELS = 9  # gauges drawn one by one; the table of peaks holds them all


def chosen_gauges(gauges, most=PANELS):
    """At most `most` gauges, spread over the distances."""
    if len(gauges) <= most:
        return list(gauges)
    return [gauges[k] for k in sorted({round(i) for i in np.linspace(0, len(gauges) - 1, most)})]


def _window(gauge):
    """(from, to) in us around the passage of the wave and the failure."""
    first = gauge.arrival
    if math.isnan(first):
        return float(gauge.t[0]), float(gauge.t[-1])
    peak = gauge.t[int(np.argmax(gauge.strongest))]
    events = [peak] + ([gauge.failure_time] if gauge.failure_time < first + 25 else [])
    length = max(4.0, 2.2 * (max(events) - first))
    return max(float(gauge.t[0]), first - 0.12 * length), min(float(gauge.t[-1]), first + length)


def gauge_panels(runs):
    """Stresses, strengths and damage of each gauge; several runs overlaid."""
    if not any(r.gauges for r in runs):
        raise Absent("No gauges were recorded.")
    if len(runs) == 1:
        for gauge in chosen_gauges(runs[0].gauges):
            yield _panels_of(gauge)
    else:
        yield from _gauges_overlaid(runs)


def _panels_of(gauge):
    rows = (("pressure", "sigma_1", "sigma_2", "sigma_3"), ("tau_max", "mises", "yield"), ("damage",))
    figure, axes = style.subplots(3, 2, size=(7.4, 5.6), gridspec_kw={"height_ratios": [3, 3, 1.5], "width_ratios": [1, 1.45]},
                                  sharex="col")
    low, high = _window(gauge)
    shown = (gauge.t >= low) & (gauge.t <= high)
    for row, names in zip(axes, rows):
        for ax, near in zip(row, (False, True)):
            keep = shown if near else slice(None)
            for name in names:
                if name in gauge.table:
                    ax.plot(gauge.t[keep], gauge.table[name][keep], color=style.STRESS[name], lw=1.2 if near else 0.8)
            if gauge.failure_time == gauge.failure_time:
                ax.axvline(gauge.failure_time, color=style.FAINT, lw=0.8, ls=(0, (4, 3)))
            style.light_grid(ax)
            if near:
                ax.set_xlim(low, high)
                style.label_ends(ax, [(high, gauge.table[n][keep][-1], style.NAMES[n], style.STRESS[n]) for n in names
                                      if n in gauge.table and np.any(shown)], gap=0.09 if len(names) > 1 else 0.05)
            else:
                ax.axvspan(low, high, color="#f3efe2", lw=0, zorder=0)
    axes[0, 0].set(ylabel="stress [GPa]", title="whole run")
    axes[1, 0].set_ylabel("stress [GPa]")
    axes[2, 0].set_ylabel("damage [–]")
    for ax in axes[2]:
        ax.set(xlabel="time [µs]", ylim=(-0.04, 1.08))
    x, y, z = gauge.position
    cause = f"; fails at {gauge.failure_time:.4g} µs" if gauge.failure_time == gauge.failure_time else "; does not fail"
    cause += f" ({gauge.failure_cause})" if gauge.failure_cause else ""
    axes[0, 1].set_title("passage of the wave")
    figure.suptitle(f"{gauge.name}  (x = {x:.2f}, y = {y:.2f}, z = {z:.4g} mm; r = {gauge.radius:.1f} mm){cause}",
                    fontsize=9.5, x=0.01, ha="left")
    return Plate(f"gauge_{gauge.name}", f"Gauge {gauge.name}: pressure (positive in compression), principal stresses (positive in "
                 "tension), largest shear, Mises and yield stress, and damage. The dashed line marks the failure; the shaded "
                 "span on the left is enlarged on the right.", figure)


def _gauges_overlaid(runs):
    names = chosen_gauges(sorted({g.name: g for r in runs for g in r.gauges}.values(), key=lambda g: (g.radius, g.name)), 6)
    quantities = [q for q in ("pressure", "sigma_1", "tau_max", "mises", "damage")
                  if any(q in g.table for r in runs for g in r.gauges)]
    figure, axes = style.subplots(len(quantities), len(names), size=(2.3 * len(names) + 0.8, 1.55 * len(quantities) + 0.5), sharex="col")
    for column, reference in zip(axes.T, names):
        windows = []
        for k, run in enumerate(runs):
            gauge = next((g for g in run.gauges if g.name == reference.name), None)
            if gauge is None:
                continue
            windows.append(_window(gauge))
            for ax, q in zip(column, quantities):
                if q in gauge.table:
                    ax.plot(gauge.t, gauge.table[q], color=style.run_colour(k), lw=1)
                if gauge.failure_time == gauge.failure_time:
                    ax.axvline(gauge.failure_time, color=style.run_colour(k), lw=0.6, ls=(0, (3, 3)))
        low, high = min(w[0] for w in windows), max(w[1] for w in windows)
        for ax, q in zip(column, quantities):
            _fit_height(ax, low, high)
            style.light_grid(ax)
        column[0].set_title(f"{reference.name}, r = {reference.radius:.1f} mm", fontsize=8.5)
        column[-1].set_xlabel("time [µs]")
    for ax, q in zip(axes[:, 0], quantities):
        ax.set_ylabel(f"{style.NAMES[q]}\n" + ("[–]" if q == "damage" else "[GPa]"))
    style.small_legend(figure, [Line2D([], [], color=style.run_colour(k), label=l) for k, l in enumerate(labels(runs))],
                       columns=min(4, len(runs)))
    yield Plate("gauges", "The same gauges in all runs, around the passage of the wave. Dashed lines mark failures.", figure)


def _fit_height(ax, low, high):
    """Set the x range, and the y range to what the lines do inside it."""
    ax.set_xlim(low, high)
    values = [l.get_ydata()[(l.get_xdata() >= low) & (l.get_xdata() <= high)] for l in ax.lines if len(l.get_xdata()) > 2]
    values = np.concatenate(values) if values else np.empty(0)
    values = values[np.isfinite(values)]
    if values.size and values.max() > values.min():
        room = 0.06 * (values.max() - values.min())
        ax.set_ylim(values.min() - room, values.max() + room)


def pressures(runs):
    """Pressure histories at all gauges, by distance (Fig. 4)."""
    if not any(r.gauges for r in runs):
        raise Absent("No gauges were recorded, so there are no pressure histories.")
    figure, axes = style.subplots(len(runs), 1, size=(7.2, 2.5 * len(runs) + 0.3), sharex=True, sharey=True)
    for ax, run, label in zip(axes[:, 0], runs, labels(runs)):
        gauges, last_time = chosen_gauges(run.gauges), 0.0
        for k, gauge in enumerate(gauges):
            colour = _ramp(k, len(gauges))
            ax.plot(gauge.t, gauge.table.get("pressure"), color=colour, label=f"r = {gauge.radius:.1f} mm  ({gauge.name})")
            last_time = max(last_time, _window(gauge)[1])
        if last_time > 0:
            ax.set_xlim(0, last_time)
        ax.set(ylabel="pressure [GPa]", title=label if len(runs) > 1 else "")
        style.light_grid(ax)
        if gauges:
            ax.legend(loc="upper right", fontsize=7)
        else:
            ax.annotate("no gauges", (0.5, 0.5), xycoords="axes fraction", ha="center", color=style.FAINT)
    axes[-1, 0].set_xlabel("time [µs]")
    yield Plate("pressures", "Pressure against time at the gauges, from the borehole outwards.", figure)


def _ramp(k, n):
    """Colours from dark (near the borehole) to light."""
    return style.blend("#5b1a18", "#e3a857", k / max(1, n - 1))


def attenuation(runs):
    """Peak pressure and peak radial stress against distance, with the fitted power law."""
    parts = {"pressure": "peak pressure [GPa]", "radial_stress": "peak radial stress [GPa]"}
    found = {p: t for p, t in parts.items() if any(r.attenuation(p).get("r_mm") for r in runs)}
    if not found:
        raise Absent("The attenuation was not analysed.")
    figure, axes = style.subplots(1, len(found), size=(3.7 * len(found) + 0.2, 3.3))
    measured_any = False
    for ax, (part, title) in zip(axes[0], found.items()):
        notes = []
        for k, run in enumerate(runs):
            data = run.attenuation(part)
            if not data.get("r_mm"):
                continue
            colour = style.run_colour(k)
            r, median, low, high = ([number(v) for v in data.get(c) or [None] * len(data["r_mm"])]
                                    for c in ("r_mm", "median_GPa", "p10_GPa", "p90_GPa"))
            ax.fill_between(r, low, high, color=colour, alpha=0.18, lw=0)
            ax.plot(r, median, color=colour)
            notes.append((_fit(ax, data, r, median, colour), colour))
            if part == "pressure":
                for gauge in run.gauges:
                    ax.plot(gauge.radius, gauge.peak("pressure")[0], "*", ms=8, mfc=colour, mec="white", mew=0.5)
            measured = measurements.against_radius(part, run.coupling)
            if measured[0].size:
                ax.plot(*measured, "D", ms=4, mfc="white", mec=colour)
                measured_any = True
        ax.set(xscale="log", yscale="log", xlabel="distance from the axis [mm]", ylabel=title)
        ax.xaxis.set_major_formatter("{x:g}")
        ax.yaxis.set_major_formatter("{x:g}")
        ax.xaxis.set_minor_formatter(lambda v, _: f"{v:g}" if f"{v:e}"[0] in "25" else "")
        ax.yaxis.set_minor_formatter(lambda v, _: f"{v:g}" if f"{v:e}"[0] in "25" else "")
        ax.tick_params(which="minor", labelsize=7)
        ax.grid(True, which="major")
        for k, (note, colour) in enumerate(n for n in notes if n[0]):
            ax.annotate(note, (0.98, 0.97 - 0.075 * k), xycoords="axes fraction", ha="right", va="top", color=colour)
    if len(runs) > 1:
        style.small_legend(figure, [Line2D([], [], color=style.run_colour(k), label=l) for k, l in enumerate(labels(runs))],
                           columns=min(4, len(runs)))
    yield Plate("attenuation", "Peaks against distance from the borehole axis: median over the angle, band from the 10th to the "
                "90th percentile, power law fitted over the range of the dashed line"
                + ("; stars are the gauges." if any(r.gauges for r in runs) else ".")
                + ("" if measured_any else " No measurements are available."), figure)


def _fit(ax, data, r, values, colour):
    """Draw the power law through the data in the range of the fit; its words."""
    exponent, error = number(data.get("exponent")), number(data.get("exponent_error"))
    span = [number(v) for v in data.get("fit_range_mm") or []]
    if math.isnan(exponent) or len(span) != 2:
        return ""
    r, values = np.array(r), np.array(values)
    inside = (r >= span[0]) & (r <= span[1]) & (values > 0)
    if inside.any():
        factor = np.exp(np.mean(np.log(values[inside]) + abs(exponent) * np.log(r[inside])))
        ax.plot(span, factor * np.array(span) ** -abs(exponent), color=style.INK, lw=0.9, ls=(0, (5, 3)))
    return f"r$^{{-{abs(exponent):.2f}}}$" + (f" (± {error:.2g})" if math.isfinite(error) else "")


def _curve(run, part, value):
    data = run.analysis.get(part) or {}
    t, v = data.get("t_us") or [], data.get(value) or []
    return np.array([number(x) for x in t]), np.array([number(x) for x in v])


def borehole(runs):
    """Mean radius of the borehole against time."""
    curves = [(k, *_curve(r, "borehole", "mean_radius_mm")) for k, r in enumerate(runs)]
    curves = [c for c in curves if c[1].size]
    if not curves:
        raise Absent("The expansion of the borehole was not recorded.")
    figure, axes = style.subplots(1, 1, size=(4.6, 2.7))
    ax = axes[0, 0]
    for k, t, radius in curves:
        ax.plot(t, radius, color=style.run_colour(k), label=labels(runs)[k])
    ax.set(xlabel="time [µs]", ylabel="mean radius [mm]", xlim=(0, None))
    style.light_grid(ax)
    if len(curves) > 1:
        ax.legend()
    else:
        radius = curves[0][2]
        ax.annotate(f"{radius[0]:.3f} → {radius[-1]:.3f} mm", (0.97, 0.06), xycoords="axes fraction", ha="right")
    yield Plate("borehole", "Expansion of the borehole: mean radius of its wall.", figure)


def burn_speed(run):
    """Speed of the detonation front, km/s: slope of the straight line through the middle 90 % of its way; NaN without a burn."""
    t, z = _curve(run, "burn_front", "z_mm")
    keep = np.isfinite(t) & np.isfinite(z)
    t, z = t[keep], z[keep]
    if z.size < 3 or np.ptp(z) <= 0:
        return math.nan
    share = (z - z.min()) / np.ptp(z)
    moving = (share > 0.05) & (share < 0.95)  # neither the start nor the rest after the end
    return abs(float(np.polyfit(t[moving], z[moving], 1)[0])) if moving.sum() > 2 else math.nan


def burn_front(runs):
    """Height of the detonation front against time."""
    curves = [(k, *_curve(r, "burn_front", "z_mm")) for k, r in enumerate(runs)]
    curves = [c for c in curves if np.isfinite(c[2]).sum() > 1]
    if not curves:
        raise Absent("No moving detonation front was recorded (a slice burns all at once, and some cases have no explosive).")
    figure, axes = style.subplots(1, 1, size=(4.6, 2.7))
    ax = axes[0, 0]
    for k, t, z in curves:
        speed = burn_speed(runs[k])
        name = labels(runs)[k] + ": " if len(runs) > 1 else ""
        ax.plot(t, z, color=style.run_colour(k), label=name + (f"{speed:.2f} km/s" if math.isfinite(speed) else ""))
    ax.set(xlabel="time [µs]", ylabel="height of the front [mm]")
    style.light_grid(ax)
    ax.legend()
    yield Plate("burn_front", "Detonation front along the borehole; the speed is the slope of a straight line through it.", figure)
