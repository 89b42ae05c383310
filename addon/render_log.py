# SPDX-License-Identifier: GPL-3.0-or-later
"""What the last render of each scene said, for the panels. Written by the engine, read by the UI."""
import json
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Outcome:
    error: str = ""
    warnings: tuple[str, ...] = ()
    report: dict = field(default_factory=dict)  # the core's JSON report; empty after an error


_outcomes: dict[str, Outcome] = {}  # name of the scene ->


def of_success(report_json: str, warnings) -> Outcome:
    return Outcome(warnings=tuple(warnings), report=json.loads(report_json))


def remember(scene_name: str, outcome: Outcome):
    _outcomes[scene_name] = outcome


def last(scene_name: str) -> Outcome | None:
    return _outcomes.get(scene_name)


def clear():
    _outcomes.clear()
