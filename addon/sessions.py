# SPDX-License-Identifier: GPL-3.0-or-later
"""The core's sessions, which keep the solution from one frame to the next.

Without Persistent Data, Blender makes a new engine for every frame of an animation. So whoever
renders keeps its sessions here for as long as the job runs, from its first frame to its last. An
engine holds on to its own sessions as well: with Persistent Data it outlives the job, and so do
they, until Blender lets go of the engine (other engine, other file, setting off, add-on off).
"""
import bpy
from bpy.app.handlers import persistent

from . import core

# (scene, view layer) -> session, of the job that runs; None between jobs. View layers show other
# collections: one session would solve again for each of them in turn.
_of_job = None


def session_of(own: dict, depsgraph):
    """The session for what `depsgraph` shows; `own`: the engine's, (scene, view layer) -> session"""
    key = depsgraph.scene.name, depsgraph.view_layer.name
    job = {} if _of_job is None else _of_job
    if key not in own:
        own[key] = job.get(key) or core.native.Session()
    job[key] = own[key]
    return own[key]


@persistent
def _begin_job(*_scene_and_depsgraph):
    global _of_job
    _of_job = {}


@persistent
def _end_job(*_scene_and_depsgraph):
    global _of_job
    _of_job = None


HANDLERS = (("render_init", _begin_job), ("render_complete", _end_job), ("render_cancel", _end_job))


def register():
    for event, handler in HANDLERS:
        getattr(bpy.app.handlers, event).append(handler)


def unregister():
    for event, handler in HANDLERS:
        getattr(bpy.app.handlers, event).remove(handler)
    _end_job()
