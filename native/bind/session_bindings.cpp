// SPDX-License-Identifier: GPL-3.0-or-later
#include "bind/arrays.h"
#include "bind/bindings.h"
#include "bind/callbacks.h"
#include "pipeline/compare_visibility.h"
#include "pipeline/session.h"

#include <pybind11/stl.h>

namespace py = pybind11;
using namespace py::literals;

namespace antiradiance {
namespace {

py::dict to_dict(const RenderResult& result) {
    const Picture& picture = result.picture;
    return py::dict("cancelled"_a = false,
                    "combined"_a = image(picture.combined, picture.width, picture.height),
                    "depth"_a = image(picture.depth, picture.width, picture.height),
                    "normal"_a = image(picture.normal, picture.width, picture.height),
                    "report"_a = result.report.to_json(), "warnings"_a = result.report.warnings);
}

py::dict render(Session& session, const Scene& scene, const py::dict& option_values,
                py::object progress_callback, py::object cancelled, double sync_seconds,
                bool film_transparent) {
    const Options options = to_options(option_values);
    RenderResult result;
    const bool done = run_with_callbacks(
        std::move(progress_callback), std::move(cancelled), [&](Progress& progress) {
            result = session.render(scene, options, film_transparent, sync_seconds, progress);
        });
    return done ? to_dict(result) : py::dict("cancelled"_a = true);
}

py::dict to_dict(const VisibilityError& error) {
    return py::dict("relative_rms"_a = error.relative_rms, "bias"_a = error.bias,
                    "largest_leak"_a = error.largest_leak, "converged"_a = error.converged,
                    "least_radiance"_a = error.least_radiance, "leaves"_a = error.leaves,
                    "links"_a = error.links, "rays"_a = error.rays, "seconds"_a = error.seconds);
}

py::list visibility_errors(const Scene& scene, const std::vector<py::dict>& option_values,
                           int reference_rays, bool graded, bool normalised) {
    std::vector<Options> ways;
    for (const py::dict& values : option_values) {
        ways.push_back(to_options(values));
    }
    std::vector<VisibilityError> errors;
    {
        const py::gil_scoped_release no_gil;
        Progress progress;
        errors = compare_visibility(
            scene, ways, {{.per_pair = reference_rays, .graded = graded}, normalised}, progress);
    }
    py::list result;
    for (const VisibilityError& error : errors) {
        result.append(to_dict(error));
    }
    return result;
}

}  // namespace

void bind_session(py::module_& module) {
    py::class_<Session>(module, "Session",
                        "Renders scenes; keeps from one render to the next what does not change")
        .def(py::init<>())
        .def("render", &render, "scene"_a, "options"_a, "progress"_a = py::none(),
             "cancelled"_a = py::none(), "sync_seconds"_a = 0.0, "film_transparent"_a = false,
             "progress(fraction, stage) is called by this thread, cancelled() -> bool by another. "
             "Returns a dict: cancelled; unless it is true also combined (h,w,4) f32 linear "
             "Rec.709, premultiplied, row 0 below; depth (h,w) f32, m; normal (h,w,3) f32, world "
             "space; report, JSON; warnings, list of str. Raises SceneError");
    module.def("compare_visibility", &visibility_errors, "scene"_a, "options"_a,
               "reference_rays"_a = 16, "graded"_a = false, "normalised"_a = false,
               "Solutions that differ in `visibility` and its rays, options being a list of dicts, "
               "against ray-tested links on the same link mesh: a list of dicts of relative_rms, "
               "bias, largest_leak (irradiance over all leaves), converged, least_radiance, "
               "leaves, links, rays, seconds (visibility and solution)");
    module.def("write_failure_report", &write_failure_report, "path"_a, "error"_a, "warnings"_a,
               "sync_seconds"_a,
               "Writes the JSON report of a render that failed before the core saw it");
}

}  // namespace antiradiance
