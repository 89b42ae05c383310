// SPDX-License-Identifier: GPL-3.0-or-later
// The rendered viewport. No thread of the core calls Python, and nothing here waits for one but the
// ends of a solver and a view.
#include <string>

#include "bind/arrays.h"
#include "bind/bindings.h"
#include "bind/camera_binding.h"
#include "live/live_view.h"

namespace py = pybind11;
using namespace py::literals;

namespace antiradiance {
namespace {

void post(LiveSolver& solver, const Scene& scene, const py::dict& option_values,
          bool film_transparent, double sync_seconds) {
    StageInput input{scene, to_options(option_values), film_transparent};
    const py::gil_scoped_release no_gil;
    solver.post(std::move(input), sync_seconds);
}

py::dict state_of_solver(const LiveSolver& solver) {
    const LiveSolver::State state = solver.state();
    const auto newest = solver.newest();
    return py::dict("working"_a = state.working, "paused"_a = state.paused, "stage"_a = state.stage,
                    "fraction"_a = state.fraction, "error"_a = state.error, "edits"_a = state.edits,
                    "solutions"_a = newest ? newest->number : 0,
                    "preliminary"_a = newest && newest->preliminary,
                    "report"_a = newest ? newest->report_json : std::string(),
                    "warnings"_a = newest ? newest->report.warnings : std::vector<std::string>());
}

// A copy, which shares all: null before the first.
std::shared_ptr<SolvedScene> solution_of(const LiveSolver& solver) {
    const auto newest = solver.newest_whole();
    return newest ? std::make_shared<SolvedScene>(newest->scene) : nullptr;
}

void set_inspection(LiveView& view, const std::string& mode, int level, int bin) {
    view.set_inspection({to_inspect_mode(mode), level, bin});
}

// (h, w, 4), without a copy: a picture of a large viewport takes its time.
py::array_t<float> pixels_of(std::shared_ptr<const LivePicture> shown) {
    const Picture& picture = shown->picture;
    const Shape shape{picture.height, picture.width, 4};
    const auto* first = reinterpret_cast<const float*>(picture.combined.data());
    auto* owner = new std::shared_ptr<const LivePicture>(std::move(shown));
    const py::capsule keep(
        owner, [](void* kept) { delete static_cast<std::shared_ptr<const LivePicture>*>(kept); });
    py::array_t<float> pixels(shape, first, keep);
    pixels.attr("flags").attr("writeable") = false;
    return pixels;
}

py::object newest_picture(const LiveView& view, std::uint64_t known) {
    const auto newest = view.newest();
    if (!newest || newest->number == known) return py::none();
    const Camera& camera = newest->camera;
    return py::dict("number"_a = newest->number, "solution"_a = newest->solution,
                    "combined"_a = pixels_of(newest),
                    "border"_a = py::make_tuple(camera.x0, camera.y0, camera.x1, camera.y1),
                    "quality"_a = std::string(name_of(newest->level)),
                    "seconds"_a = newest->seconds);
}

py::dict state_of_view(const LiveView& view) {
    const LiveView::State state = view.state();
    return py::dict("making"_a = state.making ? std::string(name_of(*state.making)) : "",
                    "error"_a = state.error, "navigation_pictures"_a = state.navigation_pictures);
}

}  // namespace

void bind_live(py::module_& module) {
    py::class_<LiveSolver, std::shared_ptr<LiveSolver>>(
        module, "LiveSolver",
        "Keeps the solution of a scene that is being edited up to date, on a thread of its own. "
        "When it is let go, it is stopped, which takes some 50 ms")
        .def(py::init<>())
        .def("post", &post, "scene"_a, "options"_a, "film_transparent"_a = false,
             "sync_seconds"_a = 0.0,
             "The newest edit. Cancels running work that solves for something else; nothing "
             "happens when no picture would differ. What is wrong with the scene shows in state()")
        .def("pause", &LiveSolver::pause, "paused"_a, "While paused, edits wait")
        .def("solution", &solution_of, "The SolvedScene of the newest whole solution, or None")
        .def("stop", &LiveSolver::stop, py::call_guard<py::gil_scoped_release>(),
             "Cancels the work and waits for its end; edits are then left alone")
        .def("state", &state_of_solver,
             "A dict: working, there are edits without their whole solution; paused; stage and "
             "fraction, 0..1, of the running work; error, why the newest edit has no solution, or "
             "empty; edits, posts so far that changed something; solutions, made so far; and of "
             "the newest solution preliminary, the whole one follows; report, JSON; warnings, list "
             "of str");
    py::class_<LiveView> view(module, "LiveView",
                              "Keeps the picture of one viewport up to date, on a thread of its "
                              "own: quick ones while its camera moves, better ones when it rests");
    view.def(py::init<std::shared_ptr<LiveSolver>>(), "solver"_a);
    def_set_camera(view, [](LiveView& self, const Camera& camera) { self.set_camera(camera); });
    view.def("set_inspection", &set_inspection, "mode"_a, "level"_a = 0, "bin"_a = 0,
             "mode: one of inspect_modes(), OFF for the picture; level: steps above the leaves, of "
             "HIERARCHY; bin: of INCOMING_BIN")
        .def(
            "picture", &newest_picture, "known"_a,
            "None when the newest picture is number `known` or there is none, else a dict: number; "
            "combined (h,w,4) f32, read-only, linear Rec.709, premultiplied, no more than half "
            "floats "
            "hold, row 0 below, to be stretched over "
            "border (x0, y0, x1, y1), pixels of the camera's frame; quality, NAVIGATION, QUICK, "
            "INTERLEAVED or FINAL; solution, its number; seconds that it took")
        .def("stop", &LiveView::stop, py::call_guard<py::gil_scoped_release>(),
             "Cancels the picture under way and waits for its end; no other one comes")
        .def("state", &state_of_view,
             "A dict: making, the quality of the picture under way, or empty; error, why there is "
             "no better picture, or empty; navigation_pictures so far");
}

}  // namespace antiradiance
