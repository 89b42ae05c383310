// SPDX-License-Identifier: GPL-3.0-or-later
#include "bind/arrays.h"
#include "bind/bindings.h"
#include "bind/callbacks.h"
#include "pipeline/evaluate_blockers.h"
#include "pipeline/lit_triangles.h"
#include "scene/validate.h"

#include <pybind11/stl.h>

namespace py = pybind11;
using namespace py::literals;

namespace antiradiance {
namespace {

py::dict to_dict(const BlockerEvaluation::Plane& plane) {
    return py::dict("name"_a = plane.name, "links_cut"_a = plane.cut.total(),
                    "radiance_cut"_a = plane.cut.radiance,
                    "occluded_cut"_a = plane.occluded_cut.total(),
                    "occluded_radiance_cut"_a = plane.occluded_cut.radiance,
                    "wrongly_cut"_a = plane.wrongly_cut, "helps"_a = plane.helps);
}

py::object to_dict(const std::optional<SolutionError>& error) {
    if (!error) return py::none();
    return py::dict("relative_rms"_a = error->relative_rms, "bias"_a = error->bias,
                    "largest_leak"_a = error->largest_leak, "converged"_a = error->converged);
}

py::dict to_dict(const BlockerEvaluation& evaluation) {
    py::list planes;
    BlockerEvaluation::Plane sum;
    for (const BlockerEvaluation::Plane& plane : evaluation.per_plane) {
        planes.append(to_dict(plane));
        sum.cut += plane.cut;
        sum.occluded_cut += plane.occluded_cut;
        sum.wrongly_cut += plane.wrongly_cut;
    }
    py::dict result = to_dict(sum);
    result.attr("pop")("name");
    result.attr("pop")("helps");
    result["cancelled"] = false;
    result["links"] = evaluation.links.total();
    result["seconds"] = evaluation.seconds;
    result["per_plane"] = planes;
    result["occluded"] = py::none();
    result["occluded_radiance"] = py::none();
    if (evaluation.occluded) {
        result["occluded"] = evaluation.occluded->total();
        result["occluded_radiance"] = evaluation.occluded->radiance;
    }
    result["without_planes"] = to_dict(evaluation.without_planes);
    result["with_planes"] = to_dict(evaluation.with_planes);
    return result;
}

py::dict evaluate(const Scene& scene, const py::dict& option_values, int rays, bool all_links,
                  bool light, py::object progress_callback, py::object cancelled) {
    const Options options = to_options(option_values);
    BlockerEvaluation evaluation;
    const bool done = run_with_callbacks(
        std::move(progress_callback), std::move(cancelled), [&](Progress& progress) {
            evaluation = evaluate_blockers(scene, options, {rays, all_links, light}, progress);
        });
    return done ? to_dict(evaluation) : py::dict("cancelled"_a = true);
}

py::array_t<float> corners_of(const Scene& scene) {
    const auto count = static_cast<py::ssize_t>(scene.triangles.size());
    py::array_t<float> corners({count, py::ssize_t{3}, py::ssize_t{3}});
    auto* out = reinterpret_cast<std::array<vec3, 3>*>(corners.mutable_data());
    for (py::ssize_t t = 0; t < count; ++t)
        out[t] = scene.corners(static_cast<TriangleId>(t));
    return corners;
}

py::dict lit_sides(Scene scene) {
    std::vector<std::array<std::uint8_t, 2>> lit;
    {
        const py::gil_scoped_release no_gil;
        Progress progress;
        validate(scene);
        lit = find_lit_triangles(scene, progress);
    }
    const auto count = static_cast<py::ssize_t>(lit.size());
    py::array_t<bool> front(count);
    py::array_t<bool> back(count);
    py::list objects;
    for (py::ssize_t t = 0; t < count; ++t) {
        front.mutable_at(t) = lit[static_cast<std::size_t>(t)][0] != 0;
        back.mutable_at(t) = lit[static_cast<std::size_t>(t)][1] != 0;
        objects.append(scene.object_name(static_cast<TriangleId>(t)));
    }
    return py::dict("corners"_a = corners_of(scene), "front"_a = front, "back"_a = back,
                    "objects"_a = objects);
}

}  // namespace

void bind_blockers(py::module_& module) {
    module.def("evaluate_blockers", &evaluate, "scene"_a, "options"_a, py::kw_only(), "rays"_a = 64,
               "all_links"_a = false, "light"_a = false, "progress"_a = py::none(),
               "cancelled"_a = py::none(),
               "What the scene's blocking planes cut of the links that IMPLICIT visibility makes "
               "without them, by `rays` rays a link that is cut (0: occlusion is not counted). A "
               "dict: cancelled; links; links_cut, radiance_cut; occluded_cut, "
               "occluded_radiance_cut, that no ray gets through; wrongly_cut, links of light whose "
               "ends see each other, centre from centre; seconds; "
               "per_plane, a list of dicts of these and a name. all_links: links that are not cut "
               "are tested as well: occluded, occluded_radiance; else None. light: the scene is "
               "solved: without_planes and with_planes, dicts of relative_rms, bias, largest_leak, "
               "converged against ray-tested links, else None; of planes, whether each helps to "
               "bring the light nearer to that. Callbacks as in Session.render. Raises SceneError");
    module.def("lit_sides", &lit_sides, "scene"_a,
               "Which sides of a scene's triangles light reaches: a dict of corners (t,3,3) f32, "
               "m, world space, counter-clockwise from the front; front, back (t,) bool; objects, "
               "their names. Raises SceneError");
}

}  // namespace antiradiance
