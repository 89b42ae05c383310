# SPDX-License-Identifier: GPL-3.0-or-later
"""What the last render of each scene said, and the last evaluation of its blocking planes, for the
panels. Written by the engine and the operator, read by the UI."""
import json
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Outcome:
    error: str = ""
    warnings: tuple[str, ...] = ()
    report: dict = field(default_factory=dict)  # the core's JSON report; empty after an error


_outcomes: dict[str, Outcome] = {}  # name of the scene ->
_evaluations: dict[str, dict] = {}  # name of the scene -> what the core's evaluate_blockers() gave


def of_success(report_json: str, warnings) -> Outcome:
    return Outcome(warnings=tuple(warnings), report=json.loads(report_json))


def remember(scene_name: str, outcome: Outcome):
    _outcomes[scene_name] = outcome


def last(scene_name: str) -> Outcome | None:
    return _outcomes.get(scene_name)


def planes_of_last(scene_name: str) -> list[dict]:
    """What each blocking plane cut in the last render."""
    outcome = last(scene_name)
    return [] if outcome is None else outcome.report.get("blockers", {}).get("per_plane", [])


def remember_evaluation(scene_name: str, evaluation: dict):
    _evaluations[scene_name] = evaluation


def last_evaluation(scene_name: str) -> dict | None:
    return _evaluations.get(scene_name)


def clear():
    _outcomes.clear()
    _evaluations.clear()
