# SPDX-License-Identifier: Apache-2.0
"""Paints the particles of a section at their true size.

A particle is a disc that has the area of its cell, d = (2 / sqrt(pi)) size, in data units. Where there are so many that a
disc is smaller than a pixel, every pixel takes the colour of the particle it lies in instead: same picture, quicker.
"""

import math
from functools import cached_property

import numpy as np
from matplotlib.collections import EllipseCollection
from scipy.spatial import cKDTree

from brisance import style
from brisance.run import CAUSES

DISC = 2 / math.sqrt(math.pi)
MANY = 60_000  # particles from which on pixels are coloured instead of discs
PIXELS = 1100  # across the specimen


def damage_colours(damage, cause, threshold):
    """RGB of every particle: grey rock; pale shades below the threshold; the cause's colour from the threshold on."""
    colours = np.empty((len(damage), 3))
    share = np.clip(damage / threshold, 0, 1)[:, None]
    for code, name in enumerate(CAUSES):
        mask = cause == code
        full = style.CAUSE.get(name, style.PARTIAL)
        pale = np.array(style.blend(style.ROCK, full, 0.45 if code else 0.8))
        rock = np.array(style.blend(style.ROCK, style.ROCK, 0))
        colours[mask] = rock + (pale - rock) * np.sqrt(share[mask])
        colours[mask & (damage >= threshold)] = style.blend(style.ROCK, style.CAUSE.get(name, style.UNNAMED), 1)
    return colours


class Painter:
    """Draws one section many times with different colours. Positions are relative to the borehole axis, mm."""

    def __init__(self, section_map):
        self.map = section_map
        self.x, self.y = section_map.x - section_map.centre[0], section_map.y - section_map.centre[1]
        self.diameter = DISC * section_map.size
        self.reach = section_map.outer

    @cached_property
    def _pixels(self):
        """The particle of every pixel, -1 where there is none."""
        edge = np.linspace(-self.reach, self.reach, PIXELS + 1)
        middle = (edge[1:] + edge[:-1]) / 2
        grid = np.column_stack([a.ravel() for a in np.meshgrid(middle, middle)])
        distance, index = cKDTree(np.column_stack([self.x, self.y])).query(grid, workers=-1)
        index[distance > 0.75 * self.map.size[index]] = -1
        return index.reshape(PIXELS, PIXELS)

    def draw(self, axes, colours, order=None):
        """Paint with an (N, 3) array of colours; `order`: importance, the largest drawn on top."""
        if len(self.x) > MANY:
            table = np.vstack([colours, [1, 1, 1]])  # the index -1 finds the white at the end
            axes.imshow(table[self._pixels], origin="lower", extent=[-self.reach, self.reach] * 2,
                        interpolation="nearest", zorder=1)
        else:
            k = np.argsort(order, kind="stable") if order is not None else slice(None)
            axes.add_collection(EllipseCollection(
                self.diameter[k], self.diameter[k], np.zeros(len(self.x)), units="x", facecolors=np.asarray(colours)[k],
                offsets=np.column_stack([self.x, self.y])[k], transOffset=axes.transData, linewidths=0,
                rasterized=True, zorder=1))
        room = 1.02 * self.reach
        axes.set(xlim=(-room, room), ylim=(-room, room), aspect="equal")
        axes.axis("off")

    def damage(self, axes, damage, cause, threshold):
        self.draw(axes, damage_colours(damage, cause, threshold), order=damage)
