# SPDX-License-Identifier: GPL-3.0-or-later
"""What the blocking planes do to the light, judged with rays, and the words for it."""
import bpy

from . import blockers, core, render_log
from .properties import option_values
from .sync import SceneWriter


class ANTIRADIANCE_OT_evaluate_blocking_planes(bpy.types.Operator):
    """Judge with rays the links that the planes cut, in the scene as the viewports show it: which
    are blocked by surfaces anyway, and which carry light that is lost"""
    bl_idname = "antiradiance.evaluate_blocking_planes"
    bl_label = "Evaluate Blocking Planes"
    bl_options = {"REGISTER"}

    @classmethod
    def poll(cls, context):
        if context.mode != "OBJECT":
            cls.poll_message_set("Blocking planes are evaluated in Object Mode")
            return False
        return True

    def execute(self, context):
        manager = context.window_manager
        manager.progress_begin(0, 100)
        try:
            evaluation = core.native.evaluate_blockers(
                read_scene(context.evaluated_depsgraph_get()),
                option_values(context.scene.antiradiance),
                progress=lambda fraction, _stage: manager.progress_update(100 * fraction))
        except core.native.SceneError as failure:
            self.report({"ERROR"}, str(failure))
            return {"CANCELLED"}
        finally:
            manager.progress_end()
        render_log.remember_evaluation(context.scene.name, evaluation)
        self.report({"WARNING" if guilty(evaluation) else "INFO"}, totals(evaluation))
        return {"FINISHED"}


def read_scene(depsgraph):
    """The core's scene, blocking planes included."""
    scene = core.native.Scene()
    SceneWriter(scene, scene.add_warning).write(depsgraph)
    return scene


def totals(evaluation: dict) -> str:
    return ("{links_cut:,} of {links:,} links cut: {occluded_cut:,} that surfaces block anyway, "
            "{wrongly_cut:,} wrongly").format_map(evaluation)


def guilty(evaluation: dict) -> list[str]:
    """Names of the planes that take away light that should be there."""
    return [plane["name"] for plane in evaluation["per_plane"] if blockers.darkens(plane)]


def verdict(evaluation: dict) -> str:
    """What the figures mean, and what to do."""
    if not evaluation["links_cut"]:
        return "No link is cut. A plane has to lie between the surfaces that it is to part"
    names = guilty(evaluation)
    if not names:
        return "The planes take no light away: surfaces stop it where they are"
    return ("No surface lies between the ends of wrongly cut links, whose light is lost now. Keep "
            "these planes inside of their walls, away from edges and openings: "
            + ", ".join(names))


CLASSES = (ANTIRADIANCE_OT_evaluate_blocking_planes,)
