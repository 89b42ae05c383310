// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace antiradiance {

enum class DirectLightMode {
    kExplicit,    // lamps and emissive meshes by shadow rays; links carry the indirect light
    kImplicit,    // emissive meshes and area lamps emit along links; other lamps by shadow rays
    kShadowMaps,  // as kExplicit, by shadow maps in OpenGL
};

enum class SolverChoice { kAuto, kOpenGL, kCpu };

}  // namespace antiradiance
