#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws what visibility_modes.py found: error over time, a panel a room.

usage: /usr/bin/python3 tests/bench/plot_visibility_modes.py RESULT.json PLOT.svg   (needs
       Debian's python3-matplotlib)
"""

import json
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

MARKS = {"IMPLICIT": "s", "MIXED": "o", "EXPLICIT": "^", "DISCRETE": "x"}


def draw(axes, room, ways):
    for mode, mark in MARKS.items():
        points = [(way["seconds"], way["error"]) for label, way in ways.items()
                  if label.split()[0] == mode]
        axes.plot(*zip(*points), marker=mark, linewidth=0.8, label=mode)
    axes.set(title=room, yscale="log", xlabel="links, visibility, solution: s",
             ylabel="relative RMS against EXPLICIT, 64 rays")
    axes.grid(alpha=0.3, which="both")


def main():
    rooms = json.loads(Path(sys.argv[1]).read_text(encoding="utf-8"))
    columns = min(3, len(rooms))
    rows = -(-len(rooms) // columns)
    figure, grid = pyplot.subplots(rows, columns, figsize=(5 * columns, 4 * rows), squeeze=False,
                                   layout="constrained")
    for axes, (room, ways) in zip(grid.flat, rooms.items()):
        draw(axes, room, ways)
    for axes in grid.flat[len(rooms):]:
        axes.axis("off")
    grid[0, 0].legend()
    figure.savefig(sys.argv[2])


main()
