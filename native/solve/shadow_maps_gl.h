// SPDX-License-Identifier: GPL-3.0-or-later
// Depth images of the scene as points of lights see it, and the shadows of any points in them
// (Williams, "Casting Curved Shadows on Curved Surfaces", 1978).
#pragma once

#include <memory>
#include <span>

#include "base/progress.h"
#include "scene/scene.h"
#include "solve/direct_light.h"
#include "solve/direct_light_emitter.h"

namespace antiradiance {

class ShadowMaps {
public:
    // Draws the maps. epsilon: m, RayScene::epsilon(). Throws SceneError, which names the option,
    // where OpenGL is missing or fails.
    ShadowMaps(const Scene& scene, std::span<const EmitterPoint> points, float epsilon,
               Progress& progress);
    ~ShadowMaps();
    ShadowMaps(ShadowMaps&&) noexcept;
    ShadowMaps& operator=(ShadowMaps&&) noexcept;

    [[nodiscard]] std::size_t image_count() const;
    [[nodiscard]] std::size_t bytes() const;

    // Most receivers of one call of look_up(), which takes some 50 ms.
    [[nodiscard]] std::size_t batch_size() const;
    // The share of each emitter point that each receiver sees, 0..1, any value where the point does
    // not shine. visibility: #receivers x #points, those of a receiver in a row. From one thread.
    void look_up(std::span<const SurfacePoint> receivers, std::span<float> visibility) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace antiradiance
