// SPDX-License-Identifier: GPL-3.0-or-later
#include "bind/camera_binding.h"

#include "bind/arrays.h"
#include "bind/by_name.h"

namespace py = pybind11;

namespace antiradiance {

Camera to_camera(const CameraArguments& a) {
    const auto [x0, y0, x1, y1] = a.border;
    if (!(0 <= x0 && x0 < x1 && x1 <= a.width && 0 <= y0 && y0 < y1 && y1 <= a.height)) {
        throw py::value_error("border must lie inside the frame of " + std::to_string(a.width) +
                              " x " + std::to_string(a.height) + " pixels and hold at least one");
    }
    return {.to_world = to_matrix(a.matrix, "matrix of the camera"),
            .type = by_name<CameraType>(
                a.type, "type of the camera",
                {{"PERSP", CameraType::kPerspective}, {"ORTHO", CameraType::kOrthographic}}),
            .left = a.left,
            .right = a.right,
            .bottom = a.bottom,
            .top = a.top,
            .clip_start = a.clip_start,
            .clip_end = a.clip_end,
            .width = a.width,
            .height = a.height,
            .x0 = x0,
            .y0 = y0,
            .x1 = x1,
            .y1 = y1};
}

}  // namespace antiradiance
