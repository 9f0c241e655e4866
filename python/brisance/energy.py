# SPDX-License-Identifier: Apache-2.0
"""The audit: where the energy went, and what is left over."""

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from brisance import style
from brisance.plates import Absent, Plate
from brisance.run import labels

# What energy is kept in, and what brings it. The other columns of the audit (viscous, artificial_stress) are work that
# ends in one of these, and are drawn as lines of their own.
STORES = ("kinetic", "internal.*", "zero_energy", "zero_energy_dissipated", "contact_stored", "contact_dissipated")
SUPPLIES = ("burn_released", "boundary_work")
WORKS = ("viscous", "zero_energy", "zero_energy_dissipated", "artificial_stress", "contact_dissipated", "contact_stored")
COLOURS = {"kinetic": "#d9902f", "zero_energy": "#b8a9c9", "zero_energy_dissipated": "#8a78a8", "contact_stored": "#8fb8a8", "contact_dissipated": "#4f7f6d",
           "viscous": "#23527c", "artificial_stress": "#a3262a"}
PARTS = ("#8c8778", "#b5651d", "#c9a66b", "#5f8aa8", "#a8c3d1", "#6b5b7a", "#c0b283", "#4d5a4a")


def columns(audit, names):
    """Columns of the audit that match the names; `internal.*` stands for one per part."""
    found = []
    for name in names:
        if name.endswith("*"):
            found += [c for c in audit.columns if c.startswith(name[:-1])]
        elif name in audit:
            found.append(name)
    return found


def change(audit, name):
    """Change of a column since the first row, J."""
    return audit[name] - audit[name][0]


def worst_residual(run):
    """Largest |residual| of the energy balance relative to its reference, NaN where there is no audit."""
    audit = run.audit
    if audit is None or "residual_relative" not in audit:
        return np.nan
    values = audit["residual_relative"]
    return float(np.nanmax(np.abs(values))) if np.isfinite(values).any() else np.nan


def word(name):
    return name.replace("internal.", "internal, ").replace("_", " ")


def audit(runs):
    """Stacked energies with the residual below (one run); energies at the end and residuals (several runs)."""
    with_audit = [r for r in runs if r.audit is not None and len(r.audit) > 1]
    if not with_audit:
        raise Absent("No energy audit was recorded.")
    yield _stack(with_audit[0]) if len(runs) == 1 else _compare(runs)


def _colour(name, parts):
    return PARTS[parts.index(name) % len(PARTS)] if name in parts else COLOURS.get(name, style.FAINT)


def _residual(ax, table, colour):
    ax.plot(table["t"], 100 * table.get("residual_relative"), color=colour, lw=1)


def _residual_axes(ax, tables):
    values = np.concatenate([100 * np.abs(t.get("residual_relative")) for t in tables])
    worst = float(np.nanmax(values)) if np.isfinite(values).any() else 0.0
    ax.axhspan(-1, 1, color="#e8f0e6", lw=0, zorder=0)
    ax.annotate("± 1 %", (1.01, 0.5), xycoords="axes fraction", fontsize=8, color="#4f7f4d", va="center")
    limit = max(1.25, 1.15 * worst)
    ax.set(ylim=(-limit, limit), ylabel="residual [%]", xlabel="time [µs]")
    ax.axhline(0, color=style.FAINT, lw=0.5)


def _stack(run):
    table = run.audit
    t, names = table["t"], columns(table, STORES)
    parts = [n for n in names if n.startswith("internal.")]
    figure, axes = style.subplots(3, 1, size=(7.2, 6.2), sharex=True, gridspec_kw={"height_ratios": [3.4, 1.5, 1.2]})
    top, work, residual = axes[:, 0]
    up, down = np.zeros(len(t)), np.zeros(len(t))
    ends = []
    for name in names:  # gains stack upwards, losses downwards
        value = np.nan_to_num(change(table, name))
        gain, loss = np.maximum(value, 0), np.minimum(value, 0)
        colour = _colour(name, parts)
        top.fill_between(t, up, up + gain, color=colour, lw=0)
        top.fill_between(t, down, down + loss, color=colour, lw=0)
        ends.append((t[-1], (up[-1] + gain[-1] / 2) if value[-1] >= 0 else down[-1] + loss[-1] / 2, word(name), colour, abs(value[-1])))
        up, down = up + gain, down + loss
    supply = sum((np.nan_to_num(change(table, n)) for n in columns(table, SUPPLIES)), np.zeros(len(t)))
    top.plot(t, supply, color=style.INK, lw=1.1, ls=(0, (4, 2)))
    top.set(ylabel="energy [J]", title="where the energy is (change since the start)", xlim=(t[0], t[-1]))
    if columns(table, SUPPLIES):
        top.legend(handles=[Line2D([], [], color=style.INK, lw=1.1, ls=(0, (4, 2)),
                                   label="supplied: " + " + ".join(word(n) for n in columns(table, SUPPLIES)))], loc="upper left")
        top.set_ylim(top=1.16 * max(up.max(), supply.max(), 1e-30))
    style.label_ends(top, [e[:4] for e in ends if e[4] > 0.01 * max(up.max(), 1e-30)], gap=0.05)
    lines = [n for n in columns(table, WORKS) if np.nanmax(np.abs(table[n])) > 0]
    for name in lines:
        work.plot(t, table[name], color=_colour(name, parts), lw=1.1)
    work.set(ylabel="energy [J]", title="viscosity, zero-energy control, artificial stress, contact" if lines else "no numerical work recorded")
    style.light_grid(work)
    style.label_ends(work, [(t[-1], table[n][-1], word(n), _colour(n, parts)) for n in lines], gap=0.12)
    _residual(residual, table, style.INK)
    _residual_axes(residual, [table])
    return Plate("energy", "Energy audit. Top: change of every store since the start, stacked, against what the burn and the "
                 "boundaries supplied (dashed). Middle: energy handled by the numerical terms. Bottom: what the balance leaves "
                 "over, relative to its reference.", figure)


def _compare(runs):
    figure, axes = style.subplots(1, 2, size=(7.6, 3.0), gridspec_kw={"width_ratios": [1.2, 1]})
    bars, residual = axes[0]
    names = list(dict.fromkeys(n for r in runs if r.audit for n in columns(r.audit, STORES)))
    parts = [n for n in names if n.startswith("internal.")]
    for k, run in enumerate(runs):
        if run.audit is None:
            continue
        up = down = 0.0
        for name in names:
            value = float(change(run.audit, name)[-1]) if name in run.audit else 0.0
            bars.barh(k, value, left=up if value >= 0 else down, color=_colour(name, parts), height=0.62)
            up, down = up + max(value, 0), down + min(value, 0)
        _residual(residual, run.audit, style.run_colour(k))
    bars.set_yticks(range(len(runs)), labels(runs))
    bars.invert_yaxis()
    bars.set(xlabel="energy at the end, change since the start [J]")
    bars.tick_params(axis="y", length=0)
    _residual_axes(residual, [r.audit for r in runs if r.audit is not None])
    style.small_legend(figure, [Patch(fc=_colour(n, parts), label=word(n)) for n in names]
                       + [Line2D([], [], color=style.run_colour(k), label=f"residual: {l}") for k, l in enumerate(labels(runs))], columns=4)
    return Plate("energy", "Where the energy is at the end of each run, and what the balance leaves over in time.", figure)
