// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>

#include "display/display_layout_gl.h"
#include "display/patch_shooter.h"
#include "links/form_factor.h"

namespace antiradiance {

namespace {

using glsl::kClose;
using glsl::kFar;
using glsl::kFlatCosine;
using glsl::kFlatHeight;
using glsl::kMiddleSamples;

class AntiradianceShooter final : public PatchShooter {
public:
    AntiradianceShooter(const PatchTree& tree, const PatchLights& lights,
                        const AntiradianceTable& antiradiance, const BinWeights& bins,
                        float epsilon)
        : tree_(tree),
          lights_(lights),
          antiradiance_(antiradiance),
          bins_(bins),
          epsilon_(epsilon) {}

    void light(NodeId source, std::span<Receiver> receivers) override {
        const PatchLight& s = lights_[source];
        const SurfaceId surface = tree_.surface[static_cast<std::size_t>(source)];
        const std::span<const vec3> blocked = antiradiance_.of(source);
        for (Receiver& r : receivers) {
            const vec3 d = r.position - s.center;
            const float d2 = glm::dot(d, d);
            if (s.is_cluster()) {
                const float w = transfer_from_point(r, d, d2);
                if (w > 0) r.irradiance -= w * seen(blocked, d);
                continue;
            }
            const float height = glm::dot(d, s.normal);
            const float r2 = s.radius * s.radius;
            if (r.surface == surface || in_one_plane(r, s, height)) continue;
            if (d2 > kFar * kFar * r2) {
                const float w = transfer(r, s.normal, d, d2) * s.area;
                if (w > 0) r.irradiance += w * (height > 0 ? s.radiance : -seen(blocked, d));
            } else {
                r.irradiance += near(source, s, blocked, r, height > 0, d2 < kClose * kClose * r2);
            }
        }
    }

private:
    // A fragment does not see the plane that it lies in, although rounding, or a quad that is not
    // quite flat, may put it a little before or behind its neighbours, where it would be lit or
    // shadowed by them from all around.
    [[nodiscard]] bool in_one_plane(const Receiver& r, const PatchLight& s, float height) const {
        if (std::abs(height) < epsilon_) return true;
        return std::abs(height) < kFlatHeight * s.radius &&
               glm::dot(r.normal, s.normal) > kFlatCosine;
    }

    [[nodiscard]] vec3 seen(std::span<const vec3> blocked, const vec3& d) const {
        return bins_.interpolate(blocked, d);
    }

    // A light that is no point from here: by its form factor where it is close, which a sum over a
    // few of its points only shares out to directions, else by the points alone.
    [[nodiscard]] vec3 near(NodeId source, const PatchLight& s, std::span<const vec3> blocked,
                            const Receiver& r, bool in_front, bool close) const {
        float exact = 0;
        if (close) {
            const std::array<vec3, 4> corners = tree_.patch_corners(source);
            const auto count = static_cast<std::size_t>(tree_.corner_count(source));
            exact =
                kPi * std::abs(point_form_factor(r.position, r.shading, {corners.data(), count}));
            if (in_front) return exact * s.radiance;
        }
        std::span<const LightPoint> points = lights_.points(source);
        if (!close) points = points.first(std::min<std::size_t>(points.size(), kMiddleSamples));
        float sum = 0;
        vec3 light(0);
        for (const LightPoint& point : points) {
            const vec3 d = r.position - point.position;
            const float w = transfer(r, s.normal, d, glm::dot(d, d));
            if (w <= 0) continue;
            sum += w;
            light += w * (in_front ? s.radiance : -seen(blocked, d));
        }
        if (sum <= 0) return vec3(0);
        return light * (close ? exact / sum : s.area / static_cast<float>(points.size()));
    }

    const PatchTree& tree_;
    const PatchLights& lights_;
    const AntiradianceTable& antiradiance_;
    const BinWeights& bins_;
    float epsilon_;
};

}  // namespace

std::unique_ptr<PatchShooter> make_antiradiance_shooter(const PatchTree& tree,
                                                        const PatchLights& lights,
                                                        const AntiradianceTable& antiradiance,
                                                        const BinWeights& bins, float epsilon) {
    return std::make_unique<AntiradianceShooter>(tree, lights, antiradiance, bins, epsilon);
}

}  // namespace antiradiance
