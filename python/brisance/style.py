# SPDX-License-Identifier: Apache-2.0
"""One look for all figures: thin axes, direct labels, colours that colour-blind readers tell apart."""

import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend comes first)
from matplotlib.colors import to_rgb  # noqa: E402

INK, FAINT, GRID = "#222222", "#777777", "#e4e4e0"
ROCK, PARTIAL, UNNAMED = "#dcdbd6", "#f2c078", "#6f6f6f"
CAUSE = {"tensile": "#0072b2", "shear": "#d55e00", "mixed": "#2d1236"}  # differ in lightness as well as in hue
RUNS = ("#23527c", "#c8553d", "#2f8f6b", "#8a5a9e", "#c9971c", "#5b6770", "#4fa3c7", "#7a4b2a")
DEPTH = ("#0b3c49", "#37849a", "#8cc0c7", "#c9b26b", "#8c6d1f", "#5a4413")  # sections from the bottom up
STRESS = {"pressure": "#222222", "sigma_1": "#0072b2", "sigma_2": "#6aa84f", "sigma_3": "#d55e00",
          "tau_max": "#8a5a9e", "mises": "#23527c", "yield": "#c9971c", "damage": "#a3262a"}
NAMES = {"pressure": "pressure", "sigma_1": "σ₁ (largest)", "sigma_2": "σ₂", "sigma_3": "σ₃ (smallest)",
         "tau_max": "τ$_{max}$", "mises": "Mises stress", "yield": "yield stress", "damage": "damage"}

matplotlib.rcParams.update({
    "font.size": 9, "axes.titlesize": 9.5, "axes.labelsize": 9, "xtick.labelsize": 8, "ytick.labelsize": 8,
    "legend.fontsize": 8, "figure.titlesize": 11, "font.family": "DejaVu Sans", "mathtext.fontset": "dejavusans",
    "axes.linewidth": 0.6, "axes.edgecolor": INK, "axes.labelcolor": INK, "text.color": INK, "axes.titlelocation": "left",
    "axes.spines.top": False, "axes.spines.right": False, "axes.axisbelow": True, "axes.titlepad": 7,
    "xtick.color": INK, "ytick.color": INK, "xtick.major.width": 0.6, "ytick.major.width": 0.6,
    "xtick.major.size": 3, "ytick.major.size": 3, "xtick.minor.size": 1.6, "ytick.minor.size": 1.6,
    "xtick.direction": "out", "ytick.direction": "out", "lines.linewidth": 1.3, "lines.solid_capstyle": "round",
    "grid.color": GRID, "grid.linewidth": 0.6, "legend.frameon": False, "legend.handlelength": 1.4,
    "figure.facecolor": "white", "figure.constrained_layout.use": True, "savefig.facecolor": "white",
    "pdf.fonttype": 42, "axes.formatter.limits": (-4, 5), "axes.formatter.use_mathtext": True,
})


def run_colour(k):
    return RUNS[k % len(RUNS)]


def depth_colour(k):
    return DEPTH[k % len(DEPTH)]


def blend(base, colour, amount):
    """RGB between two colours: 0 gives the first, 1 the second."""
    return tuple(b + (c - b) * amount for b, c in zip(to_rgb(base), to_rgb(colour)))


def subplots(*shape, size, **options):
    """plt.subplots with an array of axes of two dimensions, always."""
    return plt.subplots(*shape, figsize=size, squeeze=False, **options)


def light_grid(axes, axis="y"):
    axes.grid(True, axis=axis)


def label_ends(axes, entries, gap=0.045):
    """Names written at the right end of curves, moved apart so that they do not touch.

    entries: [(x, y, text, colour)] in data units; gap: least distance as a fraction of the height of the axes.
    """
    entries = [e for e in entries if e[1] == e[1]]
    low, high = axes.get_ylim()
    scale = math.log if axes.get_yscale() == "log" else float

    def fraction(y):
        return (scale(y) - scale(low)) / (scale(high) - scale(low))

    placed = sorted(((fraction(y), x, text, colour) for x, y, text, colour in entries), key=lambda e: e[0])
    heights = [p[0] for p in placed]
    for _ in range(50):  # push neighbours apart
        for k in range(len(heights) - 1):
            overlap = gap - (heights[k + 1] - heights[k])
            if overlap > 0:
                heights[k] -= overlap / 2
                heights[k + 1] += overlap / 2
    heights = [max(h, 0.02 + gap * k) for k, h in enumerate(heights)]  # not below the axes
    for height, (_, x, text, colour) in zip(heights, placed):
        axes.annotate(text, xy=(1.015, height), xycoords="axes fraction", color=colour, fontsize=8, va="center",
                      annotation_clip=False)


def small_legend(figure, handles, columns=None):
    """A legend in one line below the figure."""
    figure.legend(handles=handles, loc="upper center", ncol=columns or len(handles), bbox_to_anchor=(0.5, 0.0))
