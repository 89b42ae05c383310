# SPDX-License-Identifier: GPL-3.0-or-later
"""What a render hands back to Blender: passes against closed forms, border, film, layers, views,
frames, and the report."""

import json

import numpy as np
import pytest
from multilayer import read_multilayer
from pytest import approx

EMISSION = np.array([0.25, 0.5, 1.0])  # of the planes in inside/render_cases.py
NOTHING = 1e10  # m, Blender's depth where there is no surface
DISTANCE = 10.0  # m, of the camera from the origin

# Each pass holds the sample nearest to the pixel's centre, of 4 x 4 jittered ones.
OFF_CENTRE = 0.36  # pixels along each axis, at most


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("pictures")


@pytest.fixture(scope="module")
def cases(in_blender, folder):
    return in_blender("render_cases.py", folder)


@pytest.fixture(scope="module")
def passes(cases, folder):
    """passes(case) -> {"Combined": (h, w, 4), "Depth": (h, w), "Normal": (h, w, 3)}, row 0 on top"""
    return lambda case: read_multilayer(folder / f"{case}.exr")


def rays(camera, row_offset=0.0, column_offset=0.0):
    """(origins, directions) (h, w, 3), directions of depth 1, through each pixel's centre.
    The camera stands at (0, -10, 0) and looks along +Y with Z up."""
    width, height = camera["width"], camera["height"]
    half = camera["half_width"] if camera["type"] == "PERSP" else camera["ortho_scale"] / 2
    rows, columns = np.mgrid[0:height, 0:width]
    larger = max(width, height)
    shift_x, shift_y = camera["shift"]
    right = half * ((2 * (columns + 0.5 + column_offset) - width) / larger + 2 * shift_x)
    up = half * ((height - 2 * (rows + 0.5 + row_offset)) / larger + 2 * shift_y)
    zero, one = np.zeros_like(right), np.ones_like(right)
    if camera["type"] == "PERSP":
        return np.stack([zero, zero - DISTANCE, zero], -1), np.stack([right, one, up], -1)
    return np.stack([right, zero - DISTANCE, up], -1), np.stack([zero, one, zero], -1)


def depth_of_plane(camera, normal, **offsets):
    """Of the plane through the origin."""
    origins, directions = rays(camera, **offsets)
    return -(origins @ normal) / (directions @ normal)


@pytest.mark.parametrize("name", ["plane_ahead", "plane_ahead_orthographic"])
def test_plane_ahead(cases, passes, name):
    of = passes(name)
    assert of["Depth"] == approx(DISTANCE, rel=1e-6)
    assert of["Normal"] == approx(np.broadcast_to([0, -1, 0], of["Normal"].shape), abs=1e-6)
    assert of["Combined"][..., :3] == approx(np.broadcast_to(EMISSION, of["Normal"].shape), rel=1e-6)
    assert (of["Combined"][..., 3] == 1).all()


@pytest.mark.parametrize("name", ["plane_tilted", "plane_tilted_shifted",
                                  "plane_tilted_orthographic"])
def test_depth_and_normal_of_a_tilted_plane(cases, passes, name):
    of, camera, normal = passes(name), cases[name]["camera"], np.array(cases[name]["normal"])
    bounds = np.stack([depth_of_plane(camera, normal, row_offset=dy, column_offset=dx)
                       for dx in (-OFF_CENTRE, OFF_CENTRE) for dy in (-OFF_CENTRE, OFF_CENTRE)])
    assert (of["Depth"] >= bounds.min(axis=0) - 1e-4).all()
    assert (of["Depth"] <= bounds.max(axis=0) + 1e-4).all()
    # The jitter averages out: a frame off by a tenth of a pixel would show here.
    tenth = np.abs(depth_of_plane(camera, normal, row_offset=0.1)
                   - depth_of_plane(camera, normal)).mean()
    assert abs((of["Depth"] - depth_of_plane(camera, normal)).mean()) < tenth
    assert of["Normal"] == approx(np.broadcast_to(normal, of["Normal"].shape), abs=1e-5)


@pytest.mark.parametrize("name", ["clipped", "clipped_orthographic"])
def test_clip(cases, passes, name):
    """clip_start hides the near plane and clip_end the far one; between them is the middle one."""
    of = passes(name)
    seen = of["Depth"] < NOTHING
    assert 0.2 < seen.mean() < 0.8
    assert of["Depth"][seen] == approx(DISTANCE, rel=1e-6)
    assert of["Depth"][~seen] == approx(NOTHING)
    inner = seen & np.roll(seen, 1, axis=1) & np.roll(seen, -1, axis=1)
    outer = ~(seen | np.roll(seen, 1, axis=1) | np.roll(seen, -1, axis=1))
    assert (of["Combined"][inner] == [0, 1, 0, 1]).all()
    assert of["Combined"][outer] == approx(np.broadcast_to([0.1, 0.1, 0.1, 1], (outer.sum(), 4)))


def test_radiance_under_a_sun(passes):
    """albedo E cos(60 degrees) / pi, nothing else is there to be lit."""
    picture = passes("lit_by_sun")["Combined"][..., :3]
    wanted = np.array([0.2, 0.5, 0.8]) * 4.0 * 0.5 / np.pi
    assert picture == approx(np.broadcast_to(wanted, picture.shape), rel=1e-4)


@pytest.mark.parametrize("name", ["smooth_ball", "smooth_ball_mirrored"])
def test_normals_of_a_smooth_ball(cases, passes, name):
    """The unit sphere at the origin; interpolated normals of 2,560 triangles, also when mirrored."""
    of = passes(name)
    origins, directions = rays(cases[name]["camera"])
    towards = np.sum(directions**2, -1)
    along = -np.sum(origins * directions, -1) / towards
    off = np.sum((origins + along[..., None] * directions) ** 2, -1)
    inside = off < 0.7**2
    assert inside.sum() > 50
    hit = along - np.sqrt(np.maximum(1 - off, 0) / towards)
    wanted = origins + hit[..., None] * directions
    # Half a pixel is .08 m here, which turns the normal by .08 / sqrt(1 - .49) = .11 at the rim.
    assert np.abs(of["Normal"] - wanted)[inside].max() < 0.12
    assert np.abs((of["Normal"] - wanted)[inside].mean(axis=0)).max() < 0.005
    assert np.linalg.norm(of["Normal"][inside], axis=-1) == approx(1.0, abs=1e-5)


def test_film(cases, passes):
    """Alpha is the share of a pixel that surfaces cover; colour is premultiplied by it."""
    opaque, film = (passes(name)["Combined"] for name in ("film_opaque", "film_transparent"))
    assert (opaque[..., 3] == 1).all()
    alpha = film[..., 3]
    assert (alpha[:, 0] == 1).all() and (alpha[:, -1] == 0).all()
    partly = (alpha > 0) & (alpha < 1)
    assert partly.any()
    assert film[..., :3] == approx(alpha[..., None] * EMISSION, abs=1e-6)
    # The edge is the line x = tan(.1) z, 10 m away: exact coverage a row by its length.
    camera = cases["film_transparent"]["camera"]
    _, directions = rays(camera)
    edge = np.tan(0.1) * directions[:, 0, 2] / camera["half_width"]  # -1..1 of the width
    covered = (edge + 1) / 2 * camera["width"]
    assert alpha.sum(axis=1) == approx(covered, abs=0.25)  # a stratum of the samples
    assert alpha.sum(axis=1).mean() == approx(covered.mean(), abs=0.03)
    world = np.array([0.4, 0.8, 1.2])
    assert opaque[..., :3] == approx(film[..., :3] + (1 - alpha[..., None]) * world, abs=1e-5)


def test_world_fills_the_background_and_warns_that_it_gives_no_light(cases, passes):
    corner = passes("world_nodes")["Combined"][0, 0]
    assert corner == approx([0.2, 0.4, 0.6, 1.0])
    (warning,) = cases["world_nodes"]["report"]["warnings"]
    assert "World 'World'" in warning and "does not light" in warning


def test_border(passes):
    """The same picture in less: pixels have other jitter, so that edges may differ a little."""
    full, cropped, framed = (
        passes(name) for name in ("full_frame", "border_cropped", "border_uncropped"))
    height, width = full["Depth"].shape
    rows = slice(height - int(0.875 * height), height - height // 2)
    columns = slice(width // 4, 3 * width // 4)
    assert cropped["Depth"].shape == (rows.stop - rows.start, columns.stop - columns.start)
    for name in ("Combined", "Depth", "Normal"):
        assert (framed[name][rows, columns] == cropped[name]).all()
        close = np.isclose(full[name][rows, columns], cropped[name], rtol=0.02, atol=0.01)
        assert close.mean() > 0.9
    outside = np.ones((height, width), bool)
    outside[rows, columns] = False
    assert (framed["Combined"][outside] == 0).all()


def test_half_resolution(passes):
    """Each pixel is the mean of four of the full picture, up to their anti-aliasing noise."""
    full, half = (passes(name)["Combined"] for name in ("full_frame", "half_resolution"))
    assert half.shape == (full.shape[0] // 2, full.shape[1] // 2, 4)
    means = full.reshape(half.shape[0], 2, half.shape[1], 2, 4).mean(axis=(1, 3))
    assert np.sqrt(np.mean((half - means) ** 2)) < 0.03 * means.mean()
    assert half.mean() == approx(means.mean(), rel=0.005)


@pytest.mark.parametrize("name", ["seen_point", "seen_spot", "seen_square", "seen_ellipse"])
def test_lamps_that_the_camera_sees(cases, passes, name):
    """As Cycles shows them when their ray visibility says so, and not at all else."""
    seen, hidden, cycles = (passes(n)["Combined"][..., :3]
                            for n in (name, f"{name}_hidden", f"{name}_cycles"))
    assert not hidden.any()
    height, width, _ = seen.shape
    centre = seen[height // 2, width // 2]
    assert centre == approx(cycles[height // 2, width // 2], rel=1e-3)
    # Cycles 3.4 shows a ball of radius r as a disk of radius r, which is 1 % smaller from 10 r.
    assert seen.sum() == approx(cycles.sum(), rel=0.015)
    # Pixels on the outline are covered in part, by 16 samples here and 64 there.
    assert np.abs(seen - cycles).max() < 0.3 * centre.max()


@pytest.mark.parametrize("iterations", [0, 4])
@pytest.mark.parametrize("visibility", ["EXPLICIT", "IMPLICIT"])
def test_opengl_and_cpu_make_the_same_picture(cases, passes, visibility, iterations):
    names = [f"{visibility}_{iterations}_{solver}" for solver in ("CPU", "OPENGL")]
    solves = [cases["back_ends"][name]["solve"] for name in names]
    assert [solve["backend"] for solve in solves] == ["CPU", "OPENGL"]
    for solve in solves:
        assert solve["converged"] == (iterations == 0)
        assert iterations in (0, solve["iterations"])
    cpu, opengl = (passes(name)["Combined"] for name in names)
    assert np.abs(cpu - opengl).max() <= 1e-3 * cpu.max()
    assert cpu == approx(opengl, rel=2e-3, abs=1e-3 * float(cpu.mean()))


def test_iterations_add_light(passes):
    """4 passes are not all of it, or the two of them above would compare nothing."""
    four, all_of_it = (passes(f"EXPLICIT_{n}_CPU")["Combined"].mean() for n in (4, 0))
    assert four < 0.995 * all_of_it


def test_frames_of_an_animation(passes):
    """The lamp's power doubles and the block moves from left to right."""
    first, second = passes("animation_0001"), passes("animation_0002")
    assert first["Combined"] == approx(passes("animation_still")["Combined"])
    block = [np.argwhere((of["Depth"] < 10) & (of["Normal"][..., 1] < -0.99))
             for of in (first, second)]  # its front is at 9.75 m
    half_width = 0.5 * 36.0 / 50.0
    moved = (block[1].mean(axis=0) - block[0].mean(axis=0))[1] / first["Depth"].shape[1]
    assert moved == approx(1.0 / 9.75 / (2 * half_width), abs=0.01)
    floor = (-1, 0)  # a corner, far from the block's shadow
    assert second["Combined"][floor][0] == approx(2 * first["Combined"][floor][0], rel=0.05)


@pytest.mark.parametrize("frame", ["0001", "0002"])
def test_persistent_data_changes_nothing(passes, frame):
    fresh, kept = passes(f"animation_{frame}"), passes(f"persistent_{frame}")
    for name in ("Combined", "Depth", "Normal"):
        assert kept[name] == approx(fresh[name], rel=1e-5)


def test_view_layers(passes):
    of = passes("view_layers")
    for layer, colour in (("First", [1, 0, 0, 1]), ("Second", [0, 1, 0, 1])):
        assert (of[f"{layer}.Combined"] == colour).all()
        assert of[f"{layer}.Depth"] == approx(DISTANCE)


def test_stereo(passes):
    """The eyes stand at x = -1 and 1 and see the edge at x = 0, 10 m away."""
    of = passes("stereo")
    height, width = of["Depth.left"].shape
    half_width = 0.5 * 36.0 / 50.0
    for view, wanted in (("left", 0.1), ("right", -0.1)):
        covered = (of[f"Combined.{view}"][..., 2] / EMISSION[2]).sum(axis=1) / width
        assert covered == approx(0.5 + 0.5 * wanted / half_width, abs=0.005)


def test_passes_have_sockets_in_the_compositor(cases, passes):
    if "skipped" in cases["compositor"]:
        pytest.skip(cases["compositor"]["skipped"])
    assert {"Image", "Alpha", "Depth", "Normal"} <= set(cases["compositor"]["sockets"])
    assert passes("compositor")["Combined"][..., 0] == approx(DISTANCE, rel=1e-5)


NUMBER = (int, float)
# Other tools read these keys. `links.bytes` and `solve.reason` stand beside them.
REPORT = {
    "patches": int,
    "leaves": int,
    "links": {"radiance": int, "antiradiance": int, "total": int, "bytes": int},
    "solve": {"backend": str, "renderer": str, "iterations": int, "residual": NUMBER,
              "converged": bool, "reason": str},
    "pruning": {"method": str, "removed": int, "removed_radiance": int,
                "removed_antiradiance": int, "removed_dark": int, "seconds": NUMBER},
    "visibility": {"mode": str, "rays": int, "explicit_rows": int, "implicit_rows": int},
    "blockers": {"planes": int, "links_cut": int, "radiance_cut": int, "antiradiance_cut": int,
                 "seconds": NUMBER, "per_plane": list},
    "direct": {"shadow_maps": int, "bytes": int},
    "display": {"mode": str, "backend": str, "renderer": str},
    "stages": dict.fromkeys(["model", "pruning", "direct_light", "transport", "solve",
                             "evaluation", "display"], str),
    "timings_s": dict.fromkeys(["sync", "hierarchy", "links", "visibility", "direct", "solve",
                                "display", "total"], NUMBER),
    "peak_memory_bytes": int,
    "warnings": list,
    "error": str,
}


def check_types(value, wanted, path="report"):
    if isinstance(wanted, dict):
        assert set(value) == set(wanted), path
        for key, kind in wanted.items():
            check_types(value[key], kind, f"{path}.{key}")
    else:
        assert isinstance(value, wanted), f"{path} is {value!r}"
        assert wanted is bool or not isinstance(value, bool), f"{path} is {value!r}"


def all_reports(cases):
    reports = {name: case["report"] for name, case in cases.items() if "report" in case}
    return {**reports, **cases["back_ends"]}


def test_report_has_its_keys(cases):
    for name, report in all_reports(cases).items():
        check_types(report, REPORT, name)


def test_report_adds_up(cases):
    for name, report in all_reports(cases).items():
        links, times = report["links"], report["timings_s"]
        assert links["total"] == links["radiance"] + links["antiradiance"], name
        assert report["error"] == "" and 0 < report["leaves"] <= report["patches"], name
        parts = sum(seconds for part, seconds in times.items() if part != "total")
        assert min(times.values()) >= 0 and parts <= times["total"], name
        assert times["sync"] > 0 and times["display"] > 0, name
        assert 50e6 < report["peak_memory_bytes"] < 4e9, name  # Blender alone takes 100 MB


def test_report_of_each_visibility(cases):
    explicit, implicit = (cases["back_ends"][f"{mode}_0_CPU"] for mode in ("EXPLICIT", "IMPLICIT"))
    assert explicit["links"]["antiradiance"] == 0 < implicit["links"]["antiradiance"]
    assert explicit["timings_s"]["visibility"] > 0 == implicit["timings_s"]["visibility"]


def test_options_are_those_of_the_issue(in_blender):
    """Names, defaults and items: files and scripts of artists depend on them."""
    assert in_blender("options.py") == json.loads("""{
        "visibility": ["EXPLICIT", ["IMPLICIT", "EXPLICIT", "MIXED", "DISCRETE"]],
        "direct_light": ["EXPLICIT", ["EXPLICIT", "IMPLICIT", "SHADOW_MAPS"]],
        "direction_bins": [128, null], "iterations": [0, null], "link_threshold": [0.02, null],
        "max_patch_size": [0.0, null], "visibility_rays": [4, null],
        "pruning": ["NONE", ["NONE", "HEURISTIC_1", "HEURISTIC_2", "HEURISTIC_2_THEN_1", "CONSERVATIVE",
                             "ORACLE_1", "ORACLE_2"]],
        "pruning_directions": ["STRICT", ["STRICT", "TEXT"]], "evaluate_pruning": [false, null],
        "ray_budget": [0.25, null], "remove_dark_links": [false, null],
        "solver": ["AUTO", ["AUTO", "OPENGL", "CPU"]], "display": ["FINAL_SHOOTING", ["PATCHES", "SPLATTING", "FINAL_SHOOTING"]],
        "shooting_level": ["CUT", ["LEAVES", "PARENTS", "CUT"]],
        "shooting_visibility": ["AUTO", ["AUTO", "ANTIRADIANCE", "RAYS"]],
        "shooting_samples": [8, null], "interleave": [1, null], "bin_map_size": [256, null],
        "direct_samples": [16, null],
        "report_path": ["", null]}""")
