# SPDX-License-Identifier: GPL-3.0-or-later
"""One material per case, and what the core is told about it."""

import pathlib
import sys
import tempfile

import bpy
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import recorder  # noqa: E402

CASES = {}
VIEWPORT = (0.1, 0.2, 0.3, 1.0)


def case(build):
    CASES[build.__name__] = build
    return build


class Graph:
    """Nodes of one material, without the ones that Blender puts into a new one."""

    def __init__(self, tree):
        self.tree = tree
        tree.nodes.clear()

    def node(self, kind, **values):
        """Attributes by name; inputs as `in_NAME` or `in_INDEX`: a value, or a socket to link."""
        node = self.tree.nodes.new(kind)
        for name, value in values.items():
            if not name.startswith("in_"):
                setattr(node, name, value)
        for name, value in values.items():
            if name.startswith("in_"):
                key = name[3:].replace("_", " ")
                self.put(node.inputs[int(key) if key.isdigit() else key], value)
        return node

    def put(self, socket, value):
        if isinstance(value, bpy.types.NodeSocket):
            self.tree.links.new(value, socket)
        else:
            socket.default_value = value

    def output(self, shader):
        out = self.node("ShaderNodeOutputMaterial")
        self.tree.links.new(shader.outputs[0], out.inputs["Surface"])

    def diffuse(self, colour, **values):
        return self.node("ShaderNodeBsdfDiffuse", in_Color=colour, **values)

    def emission(self, colour, strength):
        return self.node("ShaderNodeEmission", in_Color=colour, in_Strength=strength)

    def image(self, image, **values):
        return self.node("ShaderNodeTexImage", image=image, **values)


RED, GREEN, BLUE = ((1, 0, 0, 1), (0, 1, 0, 1), (0, 0, 1, 1))
GREY = (0.5, 0.5, 0.5, 1)


def first(node, *names):
    return next(node.inputs[name] for name in names if name in node.inputs)


def checker(name="Checker", is_data=False, is_float=False):
    """2 x 2 pixels: red, green below; blue, half grey above."""
    image = bpy.data.images.new(name, 2, 2, alpha=True, float_buffer=is_float, is_data=is_data)
    image.pixels[:] = [1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 1, 1, 0.5, 0.5, 0.5, 1]
    return image


def saved_checker(folder, name, extension="png"):
    image = checker(name)
    image.filepath_raw = str(folder / f"{name}.{extension}")
    image.file_format = "PNG"
    image.save()
    bpy.data.images.remove(image)
    return bpy.data.images.load(str(folder / f"{name}.{extension}"))


@case
def no_material(graph):
    return None


@case
def without_nodes(graph):
    graph.tree.id_data  # kept: the nodes are there, but switched off
    return "off"


@case
def principled(graph):
    node = graph.node("ShaderNodeBsdfPrincipled", in_Base_Color=(0.2, 0.4, 0.6, 1))
    graph.output(node)


@case
def principled_emission(graph):
    node = graph.node("ShaderNodeBsdfPrincipled", in_Base_Color=GREY, in_Emission_Strength=3.0)
    first(node, "Emission Color", "Emission").default_value = (1, 0.5, 0, 1)
    graph.output(node)


@case
def diffuse(graph):
    graph.output(graph.diffuse((0.7, 0.6, 0.5, 1)))


@case
def emission(graph):
    graph.output(graph.emission((1, 0.5, 0.25, 1), 8.0))


@case
def mix(graph):
    graph.output(graph.node("ShaderNodeMixShader", in_0=0.25, in_1=graph.diffuse(RED).outputs[0],
                            in_2=graph.diffuse(BLUE).outputs[0]))


@case
def mix_with_linked_factor(graph):
    factor = graph.node("ShaderNodeValue")
    factor.outputs[0].default_value = 0.5
    graph.output(graph.node("ShaderNodeMixShader", in_0=factor.outputs[0],
                            in_1=graph.diffuse(RED).outputs[0],
                            in_2=graph.emission(BLUE, 4.0).outputs[0]))


@case
def mix_of_which_one_side_shows(graph):
    glass = graph.node("ShaderNodeBsdfGlass")
    graph.output(graph.node("ShaderNodeMixShader", in_0=0.0, in_1=graph.diffuse(GREY).outputs[0],
                            in_2=glass.outputs[0]))


@case
def add(graph):
    graph.output(graph.node("ShaderNodeAddShader", in_0=graph.diffuse(GREY).outputs[0],
                            in_1=graph.emission(GREEN, 2.0).outputs[0]))


@case
def nested(graph):
    inner = graph.node("ShaderNodeMixShader", in_0=0.5, in_1=graph.diffuse(RED).outputs[0],
                       in_2=graph.diffuse(GREEN).outputs[0])
    outer = graph.node("ShaderNodeAddShader", in_0=inner.outputs[0],
                       in_1=graph.emission(BLUE, 1.0).outputs[0])
    graph.output(graph.node("ShaderNodeMixShader", in_0=0.5, in_1=outer.outputs[0],
                            in_2=graph.diffuse((1, 1, 1, 1)).outputs[0]))


@case
def through_reroutes(graph):
    colour = graph.node("ShaderNodeRGB")
    colour.outputs[0].default_value = (0.3, 0.2, 0.1, 1)
    first_bend, second_bend = graph.node("NodeReroute"), graph.node("NodeReroute")
    graph.put(first_bend.inputs[0], colour.outputs[0])
    graph.put(second_bend.inputs[0], first_bend.outputs[0])
    graph.output(graph.diffuse(second_bend.outputs[0]))


@case
def through_a_group(graph):
    inner_tree = bpy.data.node_groups.new("Paint", "ShaderNodeTree")
    if hasattr(inner_tree, "interface"):
        inner_tree.interface.new_socket("Tint", in_out="INPUT", socket_type="NodeSocketColor")
        inner_tree.interface.new_socket("Shader", in_out="OUTPUT", socket_type="NodeSocketShader")
    else:
        inner_tree.inputs.new("NodeSocketColor", "Tint")
        inner_tree.outputs.new("NodeSocketShader", "Shader")
    inner = Graph(inner_tree)
    inlet, outlet = inner.node("NodeGroupInput"), inner.node("NodeGroupOutput")
    inner.put(outlet.inputs[0], inner.diffuse(inlet.outputs[0]).outputs[0])
    colour = graph.node("ShaderNodeRGB")
    colour.outputs[0].default_value = (0.6, 0.5, 0.4, 1)
    group = graph.node("ShaderNodeGroup", node_tree=inner_tree)
    graph.put(group.inputs[0], colour.outputs[0])
    graph.output(group)


@case
def muted_node_passes_on(graph):
    gamma = graph.node("ShaderNodeGamma", in_Color=(0.25, 0.25, 0.25, 1), in_Gamma=2.0, mute=True)
    graph.output(graph.diffuse(gamma.outputs[0]))


@case
def colour_arithmetic(graph):
    product = graph.node("ShaderNodeMixRGB", blend_type="MULTIPLY", in_0=1.0,
                         in_1=(0.5, 0.5, 0.5, 1), in_2=(1.0, 0.5, 0.0, 1))
    power = graph.node("ShaderNodeMath", operation="MULTIPLY", in_0=2.0, in_1=3.0)
    graph.output(graph.node("ShaderNodeAddShader", in_0=graph.diffuse(product.outputs[0]).outputs[0],
                            in_1=graph.emission(RED, power.outputs[0]).outputs[0]))


@case
def new_mix_node(graph):
    if not hasattr(bpy.types, "ShaderNodeMix"):
        return None
    mixed = graph.node("ShaderNodeMix", data_type="RGBA", blend_type="MIX")
    factor, a, b = (socket for socket in mixed.inputs if socket.enabled)
    factor.default_value, a.default_value, b.default_value = 0.5, RED, GREEN
    result = next(socket for socket in mixed.outputs if socket.enabled)
    graph.output(graph.diffuse(result))


@case
def metallic(graph):
    graph.output(graph.node("ShaderNodeBsdfPrincipled", in_Base_Color=RED, in_Metallic=1.0))


@case
def transmission(graph):
    node = graph.node("ShaderNodeBsdfPrincipled", in_Base_Color=RED)
    first(node, "Transmission Weight", "Transmission").default_value = 1.0
    graph.output(node)


@case
def transparent_alpha(graph):
    graph.output(graph.node("ShaderNodeBsdfPrincipled", in_Base_Color=GREY, in_Alpha=0.5))


@case
def glass(graph):
    graph.output(graph.node("ShaderNodeBsdfGlass"))


@case
def procedural_texture(graph):
    graph.output(graph.diffuse(graph.node("ShaderNodeTexNoise").outputs["Color"]))


@case
def linked_metallic(graph):
    value = graph.node("ShaderNodeValue")
    graph.output(graph.node("ShaderNodeBsdfPrincipled", in_Metallic=value.outputs[0]))


@case
def nothing_on_the_output(graph):
    graph.node("ShaderNodeOutputMaterial")


@case
def no_output(graph):
    graph.diffuse(RED)


@case
def bump(graph):
    bump_node = graph.node("ShaderNodeBump")
    graph.output(graph.diffuse(GREY, in_Normal=bump_node.outputs[0]))


@case
def texture_srgb(graph):
    graph.output(graph.diffuse(graph.image(checker()).outputs["Color"]))


@case
def texture_non_color(graph):
    graph.output(graph.diffuse(graph.image(checker(is_data=True)).outputs["Color"]))


@case
def texture_float(graph):
    graph.output(graph.diffuse(graph.image(checker(is_float=True)).outputs["Color"]))


@case
def texture_file(graph, folder):
    graph.output(graph.diffuse(graph.image(saved_checker(folder, "File")).outputs["Color"]))


@case
def texture_packed(graph, folder):
    image = saved_checker(folder, "Packed")
    image.pack()
    (folder / "Packed.png").unlink()
    graph.output(graph.diffuse(graph.image(image).outputs["Color"]))


@case
def texture_missing(graph, folder):
    image = saved_checker(folder, "Gone")
    image.filepath = str(folder / "moved" / "Gone.png")
    image.reload()
    graph.output(graph.diffuse(graph.image(image).outputs["Color"]))


@case
def texture_without_image(graph):
    graph.output(graph.diffuse(graph.image(None).outputs["Color"]))


@case
def texture_times_constant(graph):
    product = graph.node("ShaderNodeMixRGB", blend_type="MULTIPLY", in_0=1.0,
                         in_1=graph.image(checker(is_data=True)).outputs["Color"],
                         in_2=(0.5, 0.25, 1.0, 1))
    graph.output(graph.diffuse(product.outputs[0]))


@case
def texture_mixed_with_constant(graph):
    graph.output(graph.node(
        "ShaderNodeMixShader", in_0=0.5, in_2=graph.diffuse((1, 1, 1, 1)).outputs[0],
        in_1=graph.diffuse(graph.image(checker(is_data=True)).outputs["Color"]).outputs[0]))


@case
def texture_as_mix_factor(graph):
    graph.output(graph.node(
        "ShaderNodeMixShader", in_0=graph.image(checker(is_data=True)).outputs["Color"],
        in_1=graph.diffuse((0, 0, 0, 1)).outputs[0], in_2=graph.emission((1, 1, 1, 1), 2.0).outputs[0]))


@case
def texture_as_emission(graph):
    graph.output(graph.emission(graph.image(checker(is_data=True)).outputs["Color"], 5.0))


@case
def texture_with_alpha(graph):
    image = checker(is_data=True)
    image.pixels[:] = [1, 1, 1, 0.5] * 4
    graph.output(graph.diffuse(graph.image(image).outputs["Color"]))


@case
def texture_of_second_uv_map(graph):
    uv = graph.node("ShaderNodeUVMap", uv_map="Second")
    graph.output(graph.diffuse(graph.image(checker(), in_Vector=uv.outputs[0]).outputs["Color"]))


@case
def texture_of_unknown_uv_map(graph):
    uv = graph.node("ShaderNodeUVMap", uv_map="Lost")
    graph.output(graph.diffuse(graph.image(checker(), in_Vector=uv.outputs[0]).outputs["Color"]))


@case
def texture_through_mapping(graph):
    coordinates = graph.node("ShaderNodeTexCoord")
    place = graph.node("ShaderNodeMapping", in_Vector=coordinates.outputs["UV"],
                       in_Location=(0.5, 0.25, 0.0), in_Rotation=(0.0, 0.0, np.pi / 2),
                       in_Scale=(2.0, 3.0, 1.0))
    graph.output(graph.diffuse(graph.image(checker(), in_Vector=place.outputs[0]).outputs["Color"]))


@case
def texture_of_generated_coordinates(graph):
    coordinates = graph.node("ShaderNodeTexCoord")
    graph.output(graph.diffuse(
        graph.image(checker(), in_Vector=coordinates.outputs["Generated"]).outputs["Color"]))


@case
def emission_with_other_coordinates(graph):
    uv = graph.node("ShaderNodeUVMap", uv_map="Second")
    image = checker(is_data=True)
    graph.output(graph.node(
        "ShaderNodeAddShader", in_0=graph.diffuse(graph.image(image).outputs["Color"]).outputs[0],
        in_1=graph.emission(
            graph.image(image, in_Vector=uv.outputs[0]).outputs["Color"], 1.0).outputs[0]))


def run(build):
    recorder.empty_scene()
    quad = recorder.quad()
    second = quad.data.uv_layers.new(name="Second")
    for loop in second.data:
        loop.uv = (0.125, 0.25)
    quad.data.uv_layers["UVMap"].active_render = True
    material = bpy.data.materials.new(build.__name__)
    material.use_nodes = True
    material.diffuse_color = VIEWPORT
    graph = Graph(material.node_tree)
    with tempfile.TemporaryDirectory() as folder:
        takes_folder = "folder" in build.__code__.co_varnames[: build.__code__.co_argcount]
        told = build(graph, pathlib.Path(folder)) if takes_folder else build(graph)
        if told == "off":
            material.use_nodes = False
        if build is not no_material:
            quad.data.materials.append(material)
        scene, warnings = recorder.sync()
    (entry,) = scene.materials
    textures = [t for t in scene.textures]
    return {**entry, "textures": textures, "warnings": warnings, "uv": scene.meshes[0]["uv"]}


def shared_image():
    """Two materials that use one image."""
    recorder.empty_scene()
    image = checker()
    for name in ("A", "B"):
        material = bpy.data.materials.new(name)
        material.use_nodes = True
        graph = Graph(material.node_tree)
        graph.output(graph.diffuse(graph.image(image).outputs["Color"]))
        recorder.quad(name).data.materials.append(material)
    scene, _ = recorder.sync()
    return {"textures": len(scene.textures), "materials": len(scene.materials)}


recorder.finish({**{name: run(build) for name, build in CASES.items()}, "shared": shared_image()})
