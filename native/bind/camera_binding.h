// SPDX-License-Identifier: GPL-3.0-or-later
// set_camera() of all classes that have one.
#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <string>

#include "scene/scene.h"

namespace antiradiance {

struct CameraArguments {
    pybind11::object matrix;
    std::string type;
    int width, height;
    float left, right, bottom, top;
    float clip_start, clip_end;
    std::array<int, 4> border;
};
// Throws ValueError for a border outside of the frame.
Camera to_camera(const CameraArguments& arguments);

// set(target, camera) is what it does with an instance of the class.
template <typename Target, typename... Extra, typename Set>
void def_set_camera(pybind11::class_<Target, Extra...>& cls, Set set) {
    using pybind11::operator""_a;
    cls.def(
        "set_camera",
        [set](Target& target, const pybind11::object& matrix, const std::string& type, int width,
              int height, float left, float right, float bottom, float top, float clip_start,
              float clip_end, const std::array<int, 4>& border) {
            set(target, to_camera({matrix, type, width, height, left, right, bottom, top,
                                   clip_start, clip_end, border}));
        },
        "matrix"_a, pybind11::kw_only(), "type"_a, "width"_a, "height"_a, "left"_a, "right"_a,
        "bottom"_a, "top"_a, "clip_start"_a, "clip_end"_a, "border"_a,
        "type: PERSP or ORTHO; left..top: the view frame at distance 1 (PERSP) or in metres; "
        "border: (x0, y0, x1, y1), pixels of the full frame, row 0 below");
}

}  // namespace antiradiance
