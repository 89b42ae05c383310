# SPDX-License-Identifier: GPL-3.0-or-later
"""What of Blender's scene reaches the core: objects, world positions, materials of triangles."""

import numpy as np
import pytest
from pytest import approx


@pytest.fixture(scope="module")
def cases(in_blender, tmp_path_factory):
    return in_blender("sync_cases.py", tmp_path_factory.mktemp("library"))


@pytest.fixture
def of(cases):
    """of(case) -> {object name: [mesh, ...]}"""

    def meshes(case):
        named = {}
        for mesh in cases[case]["meshes"]:
            named.setdefault(mesh["name"], []).append(mesh)
        return named

    return meshes


def one(meshes, name):
    (mesh,) = meshes[name]
    return mesh


def test_cube(of):
    (mesh,) = of("plain_cube")["Cube"]
    assert mesh["triangles"] == 12 and mesh["polygons"] == 6
    assert mesh["low"] == approx([2, -1, -1]) and mesh["high"] == approx([4, 1, 1])


def test_n_gon_stays_one_polygon(of):
    mesh = one(of("n_gon"), "Pentagon")
    assert mesh["triangles"] == 3 and mesh["polygons"] == 1
    assert mesh["area"] == approx(2.5 * np.sin(2 * np.pi / 5), rel=1e-5)


def test_negative_scale(of):
    mesh = one(of("negative_scale"), "Cube")
    assert mesh["low"] == approx([4, -1, -1]) and mesh["high"] == approx([6, 3, 1])
    assert mesh["determinant"] == approx(-2)


def test_sheared_matrix_arrives_whole(cases):
    case = cases["sheared_by_parents"]
    assert np.array(case["matrix"]) == approx(np.array(case["expected"]), abs=1e-6)


def test_modifiers(of):
    meshes = of("modifiers")
    assert one(meshes, "Subdivided")["triangles"] == 6 * 16 * 2
    row = one(meshes, "Row")
    assert row["triangles"] == 36
    assert row["low"] == approx([-1, -1, -1]) and row["high"] == approx([7, 1, 1])
    assert one(meshes, "Off")["triangles"] == 12


@pytest.mark.parametrize("name", ["Text", "Pipe", "Ball"])
def test_curves_text_and_metaballs_arrive_once(cases, of, name):
    """Blender hands them out twice, as themselves and as a mesh."""
    mesh = one(of("text_curve_metaball"), name)
    expected = cases["text_curve_metaball"]["expected"][name]
    assert mesh["triangles"] == expected["triangles"] > 0
    assert mesh["area"] == approx(expected["area"], rel=1e-4)


def test_pipe_stands_where_its_curve_does(of):
    pipe = one(of("text_curve_metaball"), "Pipe")
    assert pipe["low"] == approx([-0.25, -0.25, 0], abs=1e-3)
    assert pipe["high"] == approx([0.25, 0.25, 2], abs=1e-3)


def test_curves_without_surface_and_other_metaballs_add_nothing(of):
    assert set(of("text_curve_metaball")) == {"Text", "Pipe", "Ball"}


def test_collection_instances(of):
    meshes = of("collection_instances")
    assert set(meshes) == {"Chair (instanced by Row A)", "Chair (instanced by Row B)"}
    for name, x in (("Chair (instanced by Row A)", 10), ("Chair (instanced by Row B)", 20)):
        mesh = one(meshes, name)
        assert mesh["low"] == approx([x - 0.5, -0.5, 0]) and mesh["high"] == approx([x + 0.5, 0.5, 1])


@pytest.mark.parametrize("case", ["collection_instances", "linked_duplicates"])
def test_shared_mesh_is_read_once(cases, case):
    first, second = cases[case]["meshes"]
    assert first["array"] == second["array"]


def test_vertex_instances(of):
    meshes = of("vertex_instances")
    assert "Carrier" not in meshes  # hidden as an instancer
    small = meshes["Small (instanced by Carrier)"]
    centres = sorted(tuple(np.round((np.array(m["low"]) + m["high"]) / 2, 5)) for m in small)
    assert centres == [(-1, -1, 0), (-1, 1, 0), (1, -1, 0), (1, 1, 0)]
    assert "Small" not in meshes  # it shows through its parent only


def test_particle_instances(cases, of):
    meshes = of("particle_instances")
    assert len(meshes["Nail (instanced by Board)"]) == 7
    assert all(m["high"][2] < 1 for m in meshes["Nail (instanced by Board)"])  # on the board
    assert one(meshes, "Nail")["low"][2] == approx(49.95)
    warnings = cases["particle_instances"]["warnings"]
    assert warnings == ["Object 'Fur': its hair particles are not rendered"]


def test_geometry_nodes_instances(cases):
    meshes = cases["geometry_nodes"]["meshes"]
    centres = sorted(tuple(np.round((np.array(m["low"]) + m["high"]) / 2, 5)) for m in meshes)
    assert centres == [(-1, -1, 0), (-1, 1, 0), (1, -1, 0), (1, 1, 0)]
    assert all(m["area"] == approx(6 * 0.04, rel=1e-4) for m in meshes)


def test_what_is_hidden_from_renders_stays_out(of):
    assert set(of("hidden")) == {"Shown", "Hidden in viewport only"}


def test_material_slots(of):
    meshes = of("materials_of_slots")
    two = one(meshes, "Two slots")
    assert two["materials"] == ["Red", "Blue"] and two["slots"] == [0, 1]
    past = one(meshes, "Index past the slots")
    assert past["materials"] == ["Red"] and past["slots"] == [0]
    assert one(meshes, "Bare")["materials"] == ["(no material)"]


def test_material_override_of_the_view_layer(of):
    assert one(of("material_override"), "Any")["materials"] == ["Override"]


def test_normals_only_where_shading_is_smooth(of):
    meshes = of("shading")
    assert one(meshes, "Smooth")["smooth"] and not one(meshes, "Flat")["smooth"]


def test_what_has_no_surface_is_left_out_and_named(cases, of):
    assert set(of("not_surfaces")) == {"Holdout", "Unseen"}
    warnings = "\n".join(cases["not_surfaces"]["warnings"])
    assert "'Smoke': volumes are not rendered" in warnings
    assert "'Holdout'" in warnings and "'Unseen'" in warnings
    assert "Wire" not in warnings and "Lattice" not in warnings and "Empty" not in warnings


def planes(cases, case):
    """{name: blocking planes of that name}, and that none of them is rendered"""
    named = {}
    for plane in cases[case]["blockers"]:
        named.setdefault(plane["name"], []).append(plane)
    assert named.keys().isdisjoint(mesh["name"] for mesh in cases[case]["meshes"])
    return named


def test_blocking_planes(cases, of):
    named = planes(cases, "blockers")
    assert set(named) == {"Turned", "Subdivided", "Bare"}
    turned = one(named, "Turned")
    assert turned["low"] == approx([9, 0, -3], abs=1e-6)
    assert turned["high"] == approx([11, 0, 3], abs=1e-6)
    assert one(named, "Subdivided")["triangles"] == 16 * 2
    assert set(of("blockers")) == {"Wall"}
    assert "ray visibility" not in "\n".join(cases["blockers"]["warnings"])


@pytest.mark.parametrize("case, part, objects", [
    ("muted_blocker", {"Open"}, {"Muted", "Open"}),
    ("solo_blocker", {"Alone"}, {"Open", "Alone", "Alone but muted"}),
    ("solo_in_another_scene", {"Open"}, {"Open"}),
])
def test_mute_and_solo(cases, of, case, part, objects):
    assert set(planes(cases, case)) == part
    assert objects.isdisjoint(of(case)), "those that take no part are not rendered either"


def test_animated_blocking_plane(cases):
    plane = one(planes(cases, "animated_blocker"), "Moving")
    assert plane["low"] == approx([3, -1, 0])


def test_instanced_blocking_planes(cases, of):
    named = planes(cases, "instanced_blockers")
    assert set(named) == {"Inside (instanced by Row)", "Small (instanced by Carrier)"}
    assert one(named, "Inside (instanced by Row)")["low"] == approx([9, -1, 0])
    centres = sorted(tuple(np.round((np.array(p["low"]) + p["high"]) / 2, 5))
                     for p in named["Small (instanced by Carrier)"])
    assert centres == [(-1, -1, 0), (-1, 1, 0), (1, -1, 0), (1, 1, 0)]
    assert not of("instanced_blockers")


def test_linked_blocking_planes(cases, of):
    """The instance's plane takes part, that of the override is muted."""
    named = planes(cases, "linked_blockers")
    assert set(named) == {"Linked plane (instanced by Instance)"}
    assert one(named, "Linked plane (instanced by Instance)")["low"] == approx([9, -1, 0])
    assert set(of("linked_blockers")) == {"Linked wall (instanced by Instance)", "Linked wall"}
