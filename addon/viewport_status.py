# SPDX-License-Identifier: GPL-3.0-or-later
"""What a 3D viewport says of its solver and its picture: a line at the top, and errors."""
import functools
import json
from dataclasses import dataclass

QUALITIES = {"NAVIGATION": "navigation", "QUICK": "quick", "INTERLEAVED": "interleaved",
             "FINAL": "final"}


@dataclass(frozen=True)
class Status:
    line: str = ""
    error: str = ""  # why there is no newer picture, "" if there is no reason
    warnings: tuple[str, ...] = ()  # what could not be honoured


def status_of(solver: dict, view: dict, shown: str) -> Status:
    """solver, view: state() of the core's LiveSolver and LiveView. shown: the quality of the
    picture that is on the screen, "" if there is none."""
    error = solver["error"] or view["error"]
    parts = [
        "Paused" if solver["paused"] else "",
        progress(solver) or figures(solver["report"]),
        "" if error else quality(view["making"], shown),
        counted(len(solver["warnings"]), "warning"),
    ]
    return Status(" · ".join(part for part in parts if part), error, tuple(solver["warnings"]))


def progress(solver: dict) -> str:
    return f"{solver['stage']} {solver['fraction']:.0%}" if solver["working"] else ""


@functools.lru_cache(maxsize=4)  # it is asked for many times a second
def figures(report_json: str) -> str:
    """Of the newest solution; report_json: "" before the first."""
    if not report_json:
        return ""
    report = json.loads(report_json)
    return (f"{shortened(report['links']['total'])} links, {shortened(report['patches'])} patches, "
            f"{report['timings_s']['total']:.1f} s")


def quality(being_made: str, shown: str) -> str:
    if being_made:
        return f"{QUALITIES[being_made]} picture in work"
    return QUALITIES[shown] if shown else ""


def shortened(count: int) -> str:
    """Three digits or less, as 10.2 M."""
    for size, unit in ((1e9, " G"), (1e6, " M"), (1e3, " k")):
        if count >= 0.9995 * size:  # what rounds to 1000 of the next unit
            return f"{count / size:.3g}{unit}"
    return str(count)


def counted(count: int, thing: str) -> str:
    return "" if count == 0 else f"{count} {thing}{'' if count == 1 else 's'}"


def wrapped(text: str, width: float, length) -> list[str]:
    """Lines of up to `width`, broken between words where there are any; length(text): of a line."""
    lines = []
    for paragraph in text.splitlines():
        line = ""
        for word in paragraph.split():
            if line and length(f"{line} {word}") > width:
                lines.append(line)
                line = ""
            line = f"{line} {word}" if line else word
            while length(line) > width and len(line) > 1:  # paths have no spaces
                fits = next(n for n in range(len(line) - 1, 0, -1)
                            if n == 1 or length(line[:n]) <= width)
                lines.append(line[:fits])
                line = line[fits:]
        lines.append(line)
    return lines
