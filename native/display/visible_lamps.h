// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "display/camera_rays.h"
#include "scene/scene.h"

namespace antiradiance {

// The lamps that the camera sees, which is none unless the artist says so: spheres (point, spot),
// rectangles and ellipses (area, from where they shine) and disks in the sky (sun).
class VisibleLamps {
public:
    explicit VisibleLamps(std::span<const Lamp> lamps);

    [[nodiscard]] bool any() const { return !lamps_.empty(); }

    // The radiance of the nearest lamp before `far` (m); 0 where there is none. Suns only show
    // where `far` is RayScene::kInfinity.
    [[nodiscard]] vec3 radiance(const CameraRay& ray, float far) const;

private:
    std::vector<Lamp> lamps_;
};

}  // namespace antiradiance
