// SPDX-License-Identifier: GPL-3.0-or-later
// Largest values over leaves.
#include "shared/transport_layout.glsl"

const PassState kNothing = PassState(vec3(0.0), 0.0, vec3(0.0), 0.0);

PassState largest(PassState a, PassState b) {
    return PassState(max(a.max_radiance, b.max_radiance), max(a.max_change, b.max_change),
                     max(a.max_gained, b.max_gained), 0.0);
}
