# SPDX-License-Identifier: GPL-3.0-or-later
"""The patch that was picked in a scene, and its links in the newest solution of each viewport.

Patches go with their solution, so what is kept is a place on a surface; the patch that is there is
picked again in each new solution. All viewports of a scene show the links of the same place.
"""
import weakref
from dataclasses import dataclass

import bpy
import numpy as np
from bpy.app.handlers import persistent

from . import core

LIFT = 1e-3        # m off the surface, from where a place is picked again
SAME_PLACE = 1e-2  # m, by which a surface may have moved to be taken for the same


@dataclass(frozen=True)
class Place:
    """A point of the lit side of a surface, in world space."""
    point: tuple[float, float, float]   # m
    normal: tuple[float, float, float]  # unit


_places: dict[str, Place] = {}         # name of the scene ->
_found = weakref.WeakKeyDictionary()   # Viewport -> (what was asked for, answer)


def place_in(scene) -> Place | None:
    """Where the artist picked, if anywhere since the file was opened."""
    return _places.get(scene.name_full)


def remember(scene, place: Place):
    _places[scene.name_full] = place


@persistent
def clear(*_load_arguments):
    _places.clear()
    _found.clear()


def solution_of(viewport):
    """The newest SolvedScene of a Viewport, or None."""
    return None if viewport is None or viewport.solver is None else viewport.solver.solution()


def pick(solved, origin, direction) -> Place | None:
    """Where a ray meets a side of a surface that light reaches; m, world space."""
    leaf = core.native.pick(solved, origin, direction)
    if leaf is None:
        return None
    patch = core.native.links_of(solved, leaf, 0)
    origin, direction, normal = (np.asarray(v, float) for v in (origin, direction, patch["normal"]))
    distance = (patch["center"] - origin) @ normal / (direction @ normal)
    return Place(tuple(origin + distance * direction), tuple(normal))


def links_at(solved, place: Place, most: int) -> dict | None:
    """links_of() of the core for the patch that is at a place; None if there is none any more."""
    point, normal = np.array(place.point), np.array(place.normal)
    leaf = core.native.pick(solved, point + LIFT * normal, -normal)
    if leaf is None:
        return None
    patch = core.native.links_of(solved, leaf, most)
    return patch if abs((patch["center"] - point) @ patch["normal"]) < SAME_PLACE else None


def links_in(viewport, scene, most: int) -> dict | None:
    """links_at() of the scene's place in the solution that the Viewport shows; looked up again
    when one of them is new."""
    place, solved = place_in(scene), solution_of(viewport)
    if place is None or solved is None or viewport.picture is None:
        return None
    asked = place, most, viewport.picture.solution
    known, answer = _found.get(viewport, (None, None))
    if known != asked:
        answer = links_at(solved, place, most)
        _found[viewport] = asked, answer
    return answer


def register():
    bpy.app.handlers.load_pre.append(clear)


def unregister():
    bpy.app.handlers.load_pre.remove(clear)
    clear()
