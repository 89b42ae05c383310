// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "bind/bindings.h"

PYBIND11_MODULE(_antiradiance, module) {
    module.doc() = "Radiosity with antiradiance: the native core of the Blender add-on";
    pybind11::register_exception<antiradiance::SceneError>(module, "SceneError",
                                                           PyExc_RuntimeError);
    antiradiance::bind_schema(module);
    antiradiance::bind_scene(module);
    antiradiance::bind_session(module);
    antiradiance::bind_live(module);
    antiradiance::bind_blockers(module);
    antiradiance::bind_difference(module);
    antiradiance::bind_inspect(module);
}
