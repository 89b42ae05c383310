# SPDX-License-Identifier: GPL-3.0-or-later
"""Proposed blocking planes: where they lie in hand-made walls, and what the operator makes of them
in scenes."""

import math

import numpy as np
import pytest
from pytest import approx

GRID = 1e-4  # m, to which the planes' edges are rounded

WALL_AREA = 4 * 2.6
DOOR = ((1, -1, 0), (1.9, 1, 2.05))
WINDOW = ((2.5, -1, 0.9), (3.5, 1, 2.1))
SLOT = ((1, -1, 0.5), (1.3, 1, 2.0))  # narrower than walls may be thick
OPENINGS_AREA = WALL_AREA - 0.9 * 2.05 - 1.0 * 1.2


@pytest.fixture(scope="module")
def cases(in_blender):
    return in_blender("propose_cases.py")


def triangles_of(plane):
    return np.array(plane["triangles"])


def area(triangles):
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    return 0.5 * np.linalg.norm(normals, axis=1).sum()


def box(plane):
    triangles = triangles_of(plane)
    return triangles.min(axis=(0, 1)), triangles.max(axis=(0, 1))


def assert_rectangle(plane, low, high):
    """It is all of that rectangle, in one polygon."""
    assert box(plane) == (approx(np.array(low, float), abs=GRID),
                          approx(np.array(high, float), abs=GRID))
    sides = np.subtract(high, low)
    assert plane["area"] == approx(np.prod(sides[sides > 0]), rel=1e-3)
    assert plane["polygons"] == 1


def share_within(points, low, high, margin=0.002):
    points = np.asarray(points)
    inside = (points > np.add(low, margin)) & (points < np.subtract(high, margin))
    return inside.all(axis=1).mean()


def samples(triangles, count=20_000):
    """(count, 3) Points all over the triangles."""
    random = np.random.default_rng(0)
    corners = np.asarray(triangles)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    weights = np.linalg.norm(normals, axis=1)
    chosen = corners[random.choice(len(corners), count, p=weights / weights.sum())]
    a, b = np.sqrt(random.random((count, 1))), random.random((count, 1))
    return chosen[:, 0] * (1 - a) + chosen[:, 1] * a * (1 - b) + chosen[:, 2] * a * b


def test_every_plane_is_what_its_polygons_are(cases):
    """Blender's triangles, the core's and the figures agree; so no polygon spans a hole."""
    planes = [plane for name, case in cases.items() if name != "random_blocks" for entry in case
              for plane in (entry if isinstance(entry, list) else [entry])]
    assert len(planes) > 30
    for plane in planes:
        triangles = triangles_of(plane)
        assert area(triangles) == approx(plane["area"], rel=1e-3)
        assert area(np.array(plane["own_triangles"])) == approx(plane["area"], rel=1e-3)
        normal, centre = np.array(plane["normal"]), np.array(plane["centre"])
        assert np.linalg.norm(normal) == approx(1)
        assert np.abs((triangles - centre) @ normal).max() < GRID
        assert np.abs((np.array(plane["points"]) - centre) @ normal).max() < GRID
        assert centre == approx(samples(triangles).mean(axis=0), abs=0.05)


@pytest.mark.parametrize("case", ["box_wall", "finely_triangulated", "flipped"])
def test_wall(cases, case):
    (plane,) = cases[case]
    assert_rectangle(plane, (0, 0.1, 0), (4, 0.1, 2.6))


def test_wall_that_is_lit_from_one_side_needs_none(cases):
    assert cases["lit_from_one_side"] == []


def test_door_and_window_stay_open(cases):
    (plane,) = cases["openings"]
    assert plane["area"] == approx(OPENINGS_AREA, rel=1e-3)
    assert plane["polygons"] <= 4
    for opening in (DOOR, WINDOW):
        assert share_within(samples(plane["triangles"]), *opening) == 0


def test_tilted_wall(cases):
    (plane,) = cases["tilted"]
    assert plane["area"] == approx(OPENINGS_AREA, rel=1e-3)
    corners = triangles_of(plane).reshape(-1, 3)
    distances = np.linalg.norm(corners[:, None] - corners, axis=-1)
    assert distances.max() == approx(math.hypot(4, 2.6), abs=GRID)


def assert_open(plane, low, high):
    """It is a rectangle but for that part."""
    lowest, highest = box(plane)
    whole = np.prod((highest - lowest)[[0, 2]])
    assert plane["area"] == approx(whole - (high[0] - low[0]) * (high[2] - low[2]), rel=1e-3)
    assert share_within(samples(plane["triangles"]), low, high) == 0


@pytest.mark.parametrize("case, opening", [
    ("slot", SLOT), ("slot_in_a_sheet", SLOT), ("niche", ((1, -1, 0.5), (2, 1, 1.5)))])
def test_small_openings_stay_open(cases, case, opening):
    (plane,) = cases[case]
    assert_open(plane, *opening)


@pytest.mark.parametrize("edge_in_the_middle", [0, 1])
def test_lit_reveals_alone_keep_a_slot_open(cases, edge_in_the_middle):
    (plane,) = cases["slots_that_see_dark_sides"][edge_in_the_middle]
    assert_open(plane, *SLOT)


def test_panel_on_a_wall_makes_no_wall_of_its_own(cases):
    (plane,) = cases["panel_on_a_wall"]
    assert_rectangle(plane, (0, 0.1, 0), (4, 0.1, 2.6))


def test_wall_goes_on_behind_a_pilaster(cases):
    wall, pilaster = cases["pilaster"]
    assert_rectangle(wall, (0, 0.1, 0), (4, 0.1, 2.6))
    assert_rectangle(pilaster, (1.8, 0.12, 0), (2.2, 0.12, 2.6))


def test_sheet_that_is_lit_from_both_sides(cases):
    (plane,) = cases["sheet"]
    assert_rectangle(plane, (0, 0, 0), (3, 0, 2))


def test_back_to_back_sheets(cases):
    for (plane,) in cases["back_to_back_sheets"]:
        assert plane["area"] == approx(6)
        assert np.abs(triangles_of(plane)[..., 1]).max() <= 0.002


def test_a_plane_in_either_wall_and_none_in_the_gap(cases):
    places = sorted(plane["centre"][1] for plane in cases["air_gap"])
    assert places == approx([0.05, 0.35])


def test_dark_gap_is_part_of_the_wall(cases):
    (plane,) = cases["dark_air_gap"]
    assert_rectangle(plane, (0, 0.2, 0), (4, 0.2, 2.6))


def test_limits(cases):
    thinner, as_thick = cases["thickness"]
    assert thinner == [] and len(as_thick) == 1
    larger, smaller = cases["smallest_area"]  # of a table's top
    assert larger == []
    assert_rectangle(smaller[0], (0, 0, 0.72), (1, 0.5, 0.72))


def test_floor_between_storeys(cases):
    (plane,) = cases["storeys"]
    assert_rectangle(plane, (0, 0, 2.75), (5, 4, 2.75))


def test_l_shape_is_closed_at_its_corner(cases):
    long, short = cases["l_shape"]
    assert_rectangle(long, (0.1, 0.1, 0), (4, 0.1, 2.6))
    assert_rectangle(short, (0.1, 0.1, 0), (0.1, 3, 2.6))


@pytest.mark.parametrize("case", ["t_junction", "t_junction_between_slabs"])
def test_wall_is_closed_where_a_partition_meets_it(cases, case):
    wall, partition = cases[case]
    assert_rectangle(wall, (0, 2.1, 0), (6, 2.1, 2.6))
    assert_rectangle(partition, (2.98, 2.1, 0), (2.98, 5, 2.6))


def test_walls_are_closed_where_they_cross(cases):
    one, other = sorted(cases["crossing"], key=lambda plane: np.ptp(box(plane), axis=0)[1])
    assert_rectangle(one, (0, 2.1, 0), (6, 2.1, 2.6))
    assert_rectangle(other, (2.98, -1, 0), (2.98, 5, 2.6))


def test_doors_beside_a_junction_stay_open(cases):
    wall, _partition = cases["doors_beside_a_junction"]
    doors = ((2.45, 1.9, 0), (2.85, 2.3, 2.05)), ((3.11, 1.9, 0), (3.5, 2.3, 2.05))
    assert wall["area"] == approx(6 * 2.6 - 0.4 * 2.05 - 0.39 * 2.05, rel=1e-3)
    for plane in cases["doors_beside_a_junction"]:
        for door in doors:
            assert share_within(samples(plane["triangles"]), *door) == 0


def test_planes_do_not_drift_from_neighbour_to_neighbour(cases):
    planes = cases["drift"]
    assert sum(plane["area"] for plane in planes) == approx(12, rel=1e-3)
    assert len(planes) > 1


def test_planes_lie_within_matter_however_blocks_are_heaped(cases):
    planes, points, sticking_out = np.array(cases["random_blocks"]).T
    assert planes.min() > 1 and planes.sum() > 250
    assert points.sum() > 50_000 and sticking_out.sum() == 0


def test_no_lit_sides_and_triangles_without_area(cases):
    assert cases["nothing"] == [[], []]


@pytest.fixture(scope="module")
def operator(in_blender, root):
    return in_blender("propose_operator_cases.py", root / "blend_scenes")


# The share of the links that planes cut. Measured .167, .474, .506, .351.
LEAST_SHARE = {"two_rooms": 0.14, "corridor": 0.4, "desks": 0.45, "office": 0.3}


@pytest.mark.parametrize("name", LEAST_SHARE)
def test_planes_of_a_scene(operator, name):
    case = operator["scenes"][name]
    planes, share = case["planes"], case["links_cut"] / case["links"]
    print(f"{name}: {len(planes)} planes cut {case['links_cut']:,} of {case['links']:,} links, "
          f"{share:.3f}; {case['seconds']:.1f} s")
    assert 0 < len(planes) <= 32
    assert case["made"] == [len(planes), len(planes), 1]  # objects, meshes, collection
    assert LEAST_SHARE[name] < share < 1
    for plane in planes:
        assert plane["collections"] == ["Blocking Planes"]
        assert plane["blocker"] and plane["display"] == "WIRE"
        assert plane["links_cut"] > 0
        low, high = box(plane)
        assert (low - GRID <= plane["origin"]).all() and (plane["origin"] <= high + GRID).all()


def points_of(case):
    return np.concatenate([samples(plane["triangles"], 4000) for plane in case["planes"]])


def across(case, axis, place):
    """The one plane at that coordinate."""
    (plane,) = (plane for plane in case["planes"]
                if np.abs(triangles_of(plane)[..., axis] - place).max() < 0.002)
    return plane


def test_doors_of_the_corridor_stay_open(operator):
    case = operator["scenes"]["corridor"]
    points = points_of(case)
    for i in range(5):
        for u, y in ((3.4 * i + 1.9, 1.0), (3.4 * i + 0.9, -1.16)):
            assert share_within(points, (u, y, 0), (u + 0.95, y + 0.16, 2.05)) == 0, (i, y)
    # Each wall along the corridor is one plane, in spite of the partitions between the rooms.
    for y in (1.08, -1.08):
        wall = across(case, 1, y)
        assert area(triangles_of(wall)) == approx(16.84 * 2.6 - 5 * 0.95 * 2.05, rel=0.01)


def errors(found):
    return [found[which]["relative_rms"] for which in ("without_planes", "with_planes")]


def test_planes_of_the_corridor_stand_for_its_walls(operator):
    """What the specification asks for: 45 % of all links, 90 % of the occluded links of light, and
    no more error against ray-tested links than without planes. Measured 47 %, 90.1 % with 32 of
    the planes, .054 -> .036."""
    found = operator["light"]["corridor"]
    assert found["links_cut"] >= 0.45 * found["links"]
    assert found["occluded_radiance_cut"] >= 0.9 * found["occluded_radiance"]
    without, with_planes = errors(found)
    assert with_planes < without
    assert found["wrongly_cut"] < 0.001 * found["radiance_cut"]


def test_helpful_planes_bring_the_light_nearer(operator):
    """All 32 planes of the office, shelves and table tops among them, took its error from .066 to
    .116, those that help to .058."""
    light = operator["light"]
    without, with_all = errors(light["office"])
    assert with_all > without, "else there is nothing to choose"
    without, with_helpful = errors(light["office, helpful"])
    assert with_helpful < without
    assert len(light["office, helpful"]["per_plane"]) >= 5


def test_doorway_of_the_two_rooms_stays_open(operator):
    case = operator["scenes"]["two_rooms"]
    assert share_within(points_of(case), (4.0, 1.5, 0), (4.2, 3.1, 2.15)) == 0
    assert area(triangles_of(across(case, 0, 4.1))) == approx(4.6 * 2.7 - 1.6 * 2.15, rel=0.01)


def test_windows_of_the_office_stay_open(operator):
    wall = across(operator["scenes"]["office"], 1, 5.4)
    for u in (0.75, 3.75):
        window = (u, 5.3, 0.88), (u + 2.1, 5.5, 2.4)
        assert share_within(samples(wall["triangles"]), *window) == 0


def test_nothing_is_proposed_twice(operator):
    case = operator["again"]
    assert case["first"] == 6
    for change in ("all_there", "muted", "moved"):
        assert case[change] == case["first"], change
    assert case["removed"] == case["first"], "the one that was removed is back"
    assert case["collections"] == ["Blocking Planes"]


def test_settings_of_the_operator(operator):
    case = operator["settings"]
    assert len(case["limit"]) == 2
    assert area(triangles_of(case["limit"][0])) == approx(4.6 * 2.7 - 1.6 * 2.15, rel=0.01), (
        "the wall cuts the most links")
    assert len(case["min_area"]) == 3
    assert min(area(triangles_of(plane)) for plane in case["min_area"]) > 1.5
    assert len(case["thickness"]) == 5, "all but the wall, which is 0.2 m thick"


def test_undo(operator):
    after, undone, collection = operator["undone"]
    assert after == 6 and undone == 0 and not collection


def test_refusals_say_why(operator):
    case = operator["refused"]
    assert "render engine" in case["other_engine"]
    assert "Object Mode" in case["edit_mode"]
    assert "The scene has no faces to render" in case["nothing_there"]
    assert case["planes"] == 0 and not case["collection"]


def test_reasons_for_no_planes(operator):
    case = operator["why_nothing"]
    assert "both sides of no wall" in case["no_wall"]
    assert "have some already" in case["there"]
    assert "no other links" in case["no_links"]
    assert case["ended"] == ["FINISHED"]


def test_failure_leaves_nothing_behind(operator):
    case = operator["half_made"]
    assert case["error"] and case["after"] == case["before"]


def test_collection_is_the_scenes_own(operator):
    assert operator["of_another_scene"] == {"other": 0, "here": 1}


def test_summary(operator):
    (kind_of_one, one), (_, two), (kind_of_solo, solo) = operator["said"]
    assert kind_of_one == ["INFO"]
    assert one == "Added a blocking plane, which cuts 45.7 % of the links"
    assert two == "Added 2 blocking planes, which cut 45.7 % of the links"
    assert kind_of_solo == ["WARNING"] and "'Old' is solo" in solo


def test_links_are_counted_anew_when_planes_are_given_up(operator):
    case = operator["chosen"]
    # One plane cuts nothing. Of the other twelve, half go at a time.
    assert case["30"]["asked"] == [13] and len(case["30"]["sizes"]) == 12
    assert case["30"]["share"] == approx(0.56)
    assert case["2"]["asked"] == [13, 6, 2] and case["1"]["asked"] == [13, 6, 2, 1]
    # The first two that are left had 20 and 19 links of their own before, and cut 40 together.
    assert case["2"] == {**case["2"], "sizes": [20, 40], "share": approx(0.4)}
    assert case["1"]["share"] == approx(0.2)
