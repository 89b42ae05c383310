// SPDX-License-Identifier: GPL-3.0-or-later
#include "display/camera_rays.h"

namespace antiradiance {

CameraRays::CameraRays(const Camera& camera)
    : camera_(camera),
      right_(camera.to_world[0]),
      up_(camera.to_world[1]),
      forward_(-vec3(camera.to_world[2])),
      eye_(camera.to_world[3]) {}

CameraRay CameraRays::at(const vec2& position) const {
    const Camera& c = camera_;
    const vec2 share = position / vec2(c.width, c.height);
    const float x = glm::mix(c.left, c.right, share.x);
    const float y = glm::mix(c.bottom, c.top, share.y);
    CameraRay ray;
    if (c.type == CameraType::kOrthographic) {
        ray.origin = eye_ + right_ * x + up_ * y;
        ray.direction = forward_;
    } else {
        const vec3 through = forward_ + right_ * x + up_ * y;
        ray.axial = 1 / glm::length(through);
        ray.origin = eye_;
        ray.direction = through * ray.axial;
    }
    ray.near = c.clip_start / ray.axial;
    ray.far = c.clip_end / ray.axial;
    return ray;
}

}  // namespace antiradiance
