# SPDX-License-Identifier: Apache-2.0
"""What a drawing function hands back. Drawing functions take a list of runs and yield Plates, or raise Absent."""

from dataclasses import dataclass


class Absent(Exception):
    """There is nothing to draw; the message says why, in words for the reader of the report."""


@dataclass
class Plate:
    """A figure. key: its file name without ending; caption: plain text."""
    key: str
    caption: str
    figure: object
