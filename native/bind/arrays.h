// SPDX-License-Identifier: GPL-3.0-or-later
// numpy arrays in and out. Large arrays are borrowed, so their type and layout must be exact.
#pragma once

#include <pybind11/numpy.h>

#include <string>
#include <vector>

#include "base/types.h"

namespace antiradiance {

using Shape = std::vector<pybind11::ssize_t>;
inline constexpr pybind11::ssize_t kAny = -1;  // any extent along this axis

// Throws TypeError or ValueError that names `what`, unless the array has this element type and
// shape and is C-contiguous.
void check_array(const pybind11::array& array, const pybind11::dtype& type, const Shape& shape,
                 const std::string& what);

// The elements of a checked array, without a copy: valid as long as the array lives.
template <typename Element>
const Element* borrow(const pybind11::array& array, const Shape& shape, const std::string& what) {
    check_array(array, pybind11::dtype::of<Element>(), shape, what);
    return static_cast<const Element*>(array.data());
}

// (height, width[, channels]) of an image's elements, copied. Row 0 stays first.
template <typename Element>
pybind11::array_t<float> image(const std::vector<Element>& pixels, int width, int height) {
    constexpr pybind11::ssize_t kChannels = sizeof(Element) / sizeof(float);
    Shape shape{height, width};
    if (kChannels > 1) shape.push_back(kChannels);
    return pybind11::array_t<float>(shape, reinterpret_cast<const float*>(pixels.data()));
}

// A row-major 4x4 of any number type.
mat4 to_matrix(const pybind11::handle& rows, const std::string& what);

// A sequence of three numbers.
vec3 to_vec3(const pybind11::handle& sequence, const std::string& what);

}  // namespace antiradiance
