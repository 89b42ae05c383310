// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scene/scene.h"

namespace antiradiance {

struct CameraRay {
    vec3 origin{0};     // m
    vec3 direction{0};  // unit
    float near = 0;     // m along the ray, of the clipping planes
    float far = 0;
    float axial = 1;  // metres along the view axis for a metre along the ray
};

class CameraRays {
public:
    explicit CameraRays(const Camera& camera);

    // position: in pixels of the full frame, (0, 0) its lower left corner.
    [[nodiscard]] CameraRay at(const vec2& position) const;

private:
    const Camera& camera_;
    vec3 right_, up_, forward_, eye_;
};

}  // namespace antiradiance
