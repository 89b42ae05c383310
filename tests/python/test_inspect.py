# SPDX-License-Identifier: GPL-3.0-or-later
"""The links of a patch through the Python module: arrays, names and refusals."""

import importlib

import numpy
import pytest

OPTIONS = {"visibility": "IMPLICIT", "max_patch_size": 1.0, "solver": "CPU"}


@pytest.fixture
def core(addon_folder, monkeypatch):
    monkeypatch.syspath_prepend(str(addon_folder))
    return importlib.import_module("_antiradiance")


@pytest.fixture
def solved(core):
    """Two plates, one above the other, with a lamp between them."""
    scene = core.Scene()
    grey = scene.add_material("grey")
    corners = numpy.array([(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0)], numpy.float32)
    for height in 0, 2:
        matrix = numpy.identity(4)
        matrix[2, 3] = height
        scene.add_mesh(
            f"Plate {height}",
            positions=corners,
            matrix=matrix,
            triangles=numpy.array([(0, 1, 2), (0, 2, 3)], numpy.int32),
            triangle_polygon=numpy.zeros(2, numpy.int32),
            triangle_material=numpy.zeros(2, numpy.int32),
            slot_materials=[grey],
        )
    lamp = numpy.identity(4)
    lamp[:3, 3] = 1, 1, 1
    scene.add_lamp("Lamp", type="POINT", matrix=lamp, color=(10, 10, 10))
    return core.solve(scene, OPTIONS)


def test_links_end_at_the_picked_leaf(core, solved):
    leaf = core.pick(solved, (0.3, 0.4, 1), (0, 0, -1))
    links = core.links_of(solved, leaf, most=1000)
    count = links["total"]
    assert count > 0
    assert links["from"].shape == links["to"].shape == (count, 3)
    assert links["from"].dtype == links["form_factor"].dtype == numpy.float32
    assert links["kind"].dtype == numpy.uint8
    assert links["bin"].dtype == numpy.int32
    assert links["leaf"] == leaf
    assert links["normal"] == pytest.approx([0, 0, 1])
    assert links["center"][2] == pytest.approx(0)
    corners = links["corners"]
    assert corners.mean(axis=0) == pytest.approx(links["center"]), "a rectangle"
    assert numpy.prod(numpy.ptp(corners, axis=0)[:2]) == pytest.approx(links["area"])
    assert links["to"][:, 2] == pytest.approx(numpy.zeros(count))
    assert links["from"][:, 2] == pytest.approx(numpy.full(count, 2)), "all light comes from above"
    needed = [kind for kind, *_ in core.link_kinds()].index("NEEDED")
    assert (links["kind"] == needed).all(), "there is nothing between the plates"
    assert ((0 <= links["bin"]) & (links["bin"] < solved.bin_count)).all()


def test_fewer_links_than_there_are(core, solved):
    leaf = core.pick(solved, (0.3, 0.4, 1), (0, 0, -1))
    everything = core.links_of(solved, leaf, most=1000)
    one = core.links_of(solved, leaf, most=1)
    assert one["total"] == everything["total"] > 1
    assert one["form_factor"] == everything["form_factor"][:1]


def test_a_ray_that_meets_nothing_picks_nothing(core, solved):
    assert core.pick(solved, (5, 5, 1), (0, 0, -1)) is None
    with pytest.raises(ValueError, match="direction"):
        core.pick(solved, (0, 0, 1), (0, 0, 0))


@pytest.mark.parametrize("leaf", [-1, 0, 10**6], ids=["negative", "root", "too large"])
def test_what_is_no_leaf_has_no_links(core, solved, leaf):
    with pytest.raises(IndexError, match="pick one"):
        core.links_of(solved, leaf, most=10)


def test_modes_are_items_of_an_enum(core, solved):
    modes = core.inspect_modes()
    assert [mode for mode, *_ in modes] == [
        "OFF", "HIERARCHY", "INCOMING_BIN", "RESIDUAL", "EXPLICIT_DIFFERENCE",
    ]
    for _, label, tooltip in modes + core.link_kinds():
        assert label and tooltip and not tooltip.endswith(".")
    assert solved.level_count > 2, "leaves, surfaces and a node above both"


def test_legends_name_the_colours_of_numbers(core):
    assert core.inspect_legend("OFF") == core.inspect_legend("HIERARCHY") == []
    largest, *_, least = core.inspect_legend("RESIDUAL")
    assert largest[0] == pytest.approx([1, 1, 1]) and least[0] == pytest.approx([0, 0, 0])
    brighter, _, same, _, darker = core.inspect_legend("EXPLICIT_DIFFERENCE")
    assert brighter[0].argmax() == 0 and darker[0].argmax() == 2
    assert same[0] == pytest.approx([1, 1, 1])
    with pytest.raises(ValueError, match="'HEAT'"):
        core.inspect_legend("HEAT")


def test_bins_have_directions(core, solved):
    """Light from the plate above arrives downwards."""
    links = core.links_of(solved, core.pick(solved, (0.3, 0.4, 1), (0, 0, -1)), most=1)
    axis = solved.bin_axis(links["bin"][0])
    assert numpy.linalg.norm(axis) == pytest.approx(1)
    along = (links["to"] - links["from"])[0]
    # A bin of 32 or more is narrower than 45 degrees to either side.
    assert axis @ along / numpy.linalg.norm(along) > 0.7
    assert solved.bin_axis(10**6) == pytest.approx(solved.bin_axis(solved.bin_count - 1))
