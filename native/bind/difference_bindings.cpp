// SPDX-License-Identifier: GPL-3.0-or-later
#include "bind/arrays.h"
#include "bind/bindings.h"
#include "display/difference.h"

namespace py = pybind11;
using namespace py::literals;

namespace antiradiance {
namespace {

PictureView view_of(const py::array& pixels, const char* what) {
    const auto* first = reinterpret_cast<const vec4*>(borrow<float>(pixels, {kAny, kAny, 4}, what));
    const auto count = static_cast<std::size_t>(pixels.shape(0) * pixels.shape(1));
    return {static_cast<int>(pixels.shape(1)), static_cast<int>(pixels.shape(0)), {first, count}};
}

py::dict difference_of(const py::array& first, const py::array& second) {
    const Difference d = luminance_difference(view_of(first, "first"), view_of(second, "second"));
    return py::dict("pixels"_a = image(d.picture.combined, d.picture.width, d.picture.height),
                    "mean_first"_a = d.mean_first, "mean_second"_a = d.mean_second,
                    "relative_rms"_a = d.relative_rms, "largest"_a = d.largest);
}

}  // namespace

void bind_difference(py::module_& module) {
    module.def("luminance_difference", &difference_of, "first"_a, "second"_a,
               "Of two pictures, (h, w, 4) f32 linear Rec.709, premultiplied, row 0 below: a dict "
               "of pixels, (h, w, 4) f32 linear, red where the second is darker and green where it "
               "is brighter; mean_first, mean_second, relative_rms, largest, of linear luminance. "
               "Raises SceneError");
}

}  // namespace antiradiance
