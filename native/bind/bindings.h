// SPDX-License-Identifier: GPL-3.0-or-later
// The Python module `_antiradiance`, piece by piece. This folder alone includes pybind11.
#pragma once

#include <pybind11/pybind11.h>

#include <string>

#include "inspect/inspect.h"
#include "pipeline/options.h"

namespace antiradiance {

void bind_schema(pybind11::module_& module);      // options_schema, active_options, presets
void bind_scene(pybind11::module_& module);       // Scene
void bind_session(pybind11::module_& module);     // Session, compare_visibility, ...
void bind_live(pybind11::module_& module);        // LiveSolver, LiveView
void bind_blockers(pybind11::module_& module);    // evaluate_blockers, lit_sides
void bind_difference(pybind11::module_& module);  // luminance_difference
void bind_inspect(pybind11::module_& module);     // SolvedScene, links_of, inspect_modes, ...

// values: name -> value; options that it lacks are at their defaults. Throws SceneError.
Options to_options(const pybind11::dict& values);

// The mode with this id; throws ValueError when there is none.
InspectMode to_inspect_mode(const std::string& id);

}  // namespace antiradiance
