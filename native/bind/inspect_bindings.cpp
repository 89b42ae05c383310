// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <string>

#include "bind/arrays.h"
#include "bind/bindings.h"
#include "inspect/inspect.h"
#include "inspect/leaf_values.h"
#include "inspect/patch_links.h"
#include "pipeline/stages.h"
#include "scene/validate.h"

namespace py = pybind11;
using namespace py::literals;

namespace antiradiance {
namespace {

py::array_t<float> array_of(const vec3& v) {
    return py::array_t<float>(3, &v.x);
}

std::shared_ptr<SolvedScene> solve(const Scene& scene, const py::dict& option_values) {
    StageInput input{.scene = scene, .options = to_options(option_values)};
    const py::gil_scoped_release no_gil;
    validate(input.scene);
    Progress progress;
    Report report;
    return std::make_shared<SolvedScene>(Stages().run(std::move(input), progress, report));
}

py::object pick_leaf(const SolvedScene& solved, const py::object& origin,
                     const py::object& direction) {
    const vec3 towards = to_vec3(direction, "direction");
    if (!(glm::length(towards) > 0)) {
        throw py::value_error("direction must not be 0");
    }
    const NodeId leaf = pick(solved, to_vec3(origin, "origin"), towards);
    return leaf == kNone ? py::object(py::none()) : py::cast(leaf);
}

void check_leaf(const PatchTree& tree, NodeId leaf) {
    if (leaf < 0 || static_cast<std::size_t>(leaf) >= tree.size() || !tree.is_leaf(leaf)) {
        throw py::index_error("the solution has no leaf " + std::to_string(leaf) +
                              ": pick one in it again");
    }
}

py::dict links_dict(const SolvedScene& solved, NodeId leaf, std::size_t most) {
    const PatchTree& tree = solved.model->tree;
    check_leaf(tree, leaf);
    PatchLinks found;
    {
        const py::gil_scoped_release no_gil;
        found = links_of(solved, leaf, most);
    }
    const auto count = static_cast<py::ssize_t>(found.links.size());
    py::array_t<float> from({count, py::ssize_t{3}});
    py::array_t<float> to({count, py::ssize_t{3}});
    py::array_t<std::uint8_t> kind(count);
    py::array_t<float> form_factor(count);
    py::array_t<std::int32_t> bin(count);
    for (py::ssize_t i = 0; i < count; ++i) {
        const PatchLink& link = found.links[static_cast<std::size_t>(i)];
        for (int axis = 0; axis < 3; ++axis) {
            from.mutable_at(i, axis) = tree.center[static_cast<std::size_t>(link.source)][axis];
            to.mutable_at(i, axis) = tree.center[static_cast<std::size_t>(link.receiver)][axis];
        }
        kind.mutable_at(i) = static_cast<std::uint8_t>(link.kind);
        form_factor.mutable_at(i) = link.form_factor;
        bin.mutable_at(i) = link.bin;
    }
    const auto n = static_cast<std::size_t>(leaf);
    const std::array<vec3, 4> corners = tree.patch_corners(leaf);
    const py::array_t<float> outline({py::ssize_t{tree.corner_count(leaf)}, py::ssize_t{3}},
                                     &corners[0].x);
    return py::dict("from"_a = from, "to"_a = to, "kind"_a = kind, "form_factor"_a = form_factor,
                    "bin"_a = bin, "total"_a = found.total, "leaf"_a = leaf,
                    "center"_a = array_of(tree.center[n]), "normal"_a = array_of(tree.normal[n]),
                    "corners"_a = outline, "area"_a = tree.area[n]);
}

py::array_t<float> bin_axis(const SolvedScene& solved, int bin) {
    const DirectionBins& bins = solved.links().bins;
    return array_of(bins.axis(std::clamp(bin, 0, bins.count() - 1)));
}

py::list legend_of(const std::string& mode) {
    py::list result;
    for (const LegendEntry& entry : legend(to_inspect_mode(mode)))
        result.append(py::make_tuple(array_of(entry.colour), entry.meaning));
    return result;
}

py::list tuples(std::span<const EnumItem> items) {
    py::list result;
    for (const EnumItem& item : items) {
        result.append(py::make_tuple(item.id, item.label, item.tooltip));
    }
    return result;
}

}  // namespace

InspectMode to_inspect_mode(const std::string& id) {
    const std::span<const EnumItem> modes = inspect_modes();
    const auto item = std::ranges::find(modes, id, &EnumItem::id);
    if (item == modes.end()) throw py::value_error("there is no inspection '" + id + "'");
    return static_cast<InspectMode>(item - modes.begin());
}

void bind_inspect(py::module_& module) {
    py::class_<SolvedScene, std::shared_ptr<SolvedScene>>(
        module, "SolvedScene", "A scene and its light; nothing in it changes")
        .def_property_readonly(
            "level_count",
            [](const SolvedScene& solved) { return level_count(solved.model->tree); },
            "Levels of the hierarchy, from the leaves to the one node above all")
        .def_property_readonly(
            "bin_count", [](const SolvedScene& solved) { return solved.links().bins.count(); },
            "Directions that its links are sorted by")
        .def("bin_axis", &bin_axis, "bin"_a,
             "(3,) f32, unit: which way the light of a bin travels, world space; of the last for "
             "a bin that there is not");
    module.def("solve", &solve, "scene"_a, "options"_a,
               "The SolvedScene of a scene. Raises SceneError");
    module.def("pick", &pick_leaf, "solved"_a, "origin"_a, "direction"_a,
               "The leaf, an int, on the side of the surface that the ray meets first; origin in "
               "m, world space. None: nothing there, or a side that no light reaches");
    module.def("links_of", &links_dict, "solved"_a, "leaf"_a, "most"_a,
               "The links that end at a leaf or one of its ancestors, the `most` of them with the "
               "largest transfer, largest first: a dict of from, to (n,3) f32, centres of both "
               "ends, m, world space; kind (n,) u8, an index into link_kinds(); form_factor (n,) "
               "f32, antiradiance below 0; bin (n,) i32; total, how many there are; leaf; and of "
               "the leaf center, normal (3,) f32; corners (3 or 4,3) f32; area, m2. Raises "
               "IndexError for a leaf of another solution");
    module.def(
        "inspect_modes", [] { return tuples(inspect_modes()); },
        "What the viewport can show of a solution beside its picture: (id, label, tooltip) each");
    module.def(
        "inspect_legend", &legend_of, "mode"_a,
        "What the colours of a mode mean: (colour (3,) f32 linear Rec.709, text) each; empty "
        "where they stand for no numbers");
    module.def(
        "link_kinds", [] { return tuples(link_kinds()); },
        "By the kind of a link: (id, label, tooltip) each");
}

}  // namespace antiradiance
