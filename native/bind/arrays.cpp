// SPDX-License-Identifier: GPL-3.0-or-later
#include "bind/arrays.h"

namespace py = pybind11;

namespace antiradiance {
namespace {

std::string describe(const py::dtype& type, const Shape& shape) {
    std::string text = py::str(static_cast<const py::object&>(type)).cast<std::string>() + " (";
    for (std::size_t axis = 0; axis < shape.size(); ++axis) {
        text += axis > 0 ? ", " : "";
        text += shape[axis] == kAny ? "n" : std::to_string(shape[axis]);
    }
    return text + ")";
}

bool fits(const py::array& array, const Shape& shape) {
    if (array.ndim() != static_cast<py::ssize_t>(shape.size())) {
        return false;
    }
    for (std::size_t axis = 0; axis < shape.size(); ++axis) {
        const py::ssize_t wanted = shape[axis];
        if (wanted != kAny && array.shape(static_cast<py::ssize_t>(axis)) != wanted) {
            return false;
        }
    }
    return true;
}

// The float array of a small argument, converted where needed.
py::array_t<float, py::array::c_style | py::array::forcecast> floats(const py::handle& value,
                                                                     const std::string& what) {
    auto array = py::array_t<float, py::array::c_style | py::array::forcecast>::ensure(value);
    if (!array) {
        PyErr_Clear();
        throw py::type_error(what + " must hold numbers, not " +
                             py::repr(value).cast<std::string>());
    }
    return array;
}

}  // namespace

void check_array(const py::array& array, const py::dtype& type, const Shape& shape,
                 const std::string& what) {
    const Shape given(array.shape(), array.shape() + array.ndim());
    const std::string sentence =
        what + " must be " + describe(type, shape) + ", not " + describe(array.dtype(), given);
    if (!array.dtype().equal(type)) {
        throw py::type_error(sentence);
    }
    if (!fits(array, shape)) {
        throw py::value_error(sentence);
    }
    if ((array.flags() & py::array::c_style) == 0) {
        throw py::value_error(what + " must be C-contiguous");
    }
}

mat4 to_matrix(const py::handle& rows, const std::string& what) {
    const auto array = floats(rows, what);
    if (!fits(array, {4, 4})) {
        throw py::value_error(what + " must be a 4x4 matrix");
    }
    mat4 matrix;
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) {
            matrix[column][row] = array.at(row, column);
        }
    }
    return matrix;
}

vec3 to_vec3(const py::handle& sequence, const std::string& what) {
    const auto array = floats(sequence, what);
    if (!fits(array, {3})) {
        throw py::value_error(what + " must hold three numbers");
    }
    return {array.at(0), array.at(1), array.at(2)};
}

}  // namespace antiradiance
