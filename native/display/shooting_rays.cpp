// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <vector>

#include "display/display_layout_gl.h"
#include "display/patch_shooter.h"
#include "links/form_factor.h"

namespace antiradiance {

namespace {

using glsl::kClose;

constexpr std::size_t kBatch = 128;  // rays that are traced together
// Share of a fragment's light that is worth a ray.
constexpr float kWorthRay = 0.004F;

// Shadow rays by the share of the fragment's light that a patch can bring: many weak patches add
// up smoothly with one each, a strong one shows the edges of single rays' shadows.
std::size_t ray_count(float share, std::size_t most) {
    constexpr float kStrong = 0.01F;
    constexpr float kStrongest = 0.05F;
    return share < kStrong ? 1 : share < kStrongest ? std::min<std::size_t>(4, most) : most;
}

class RayShooter final : public PatchShooter {
public:
    RayShooter(const PatchTree& tree, const PatchLights& lights, std::span<const Moments> clusters,
               const RayScene& rays)
        : tree_(tree), lights_(lights), clusters_(clusters), scene_(rays) {}

    void light(NodeId source, std::span<Receiver> receivers) override;
    void finish() override;

private:
    // W/m2 without occluders; d: from the light's centre to the receiver.
    [[nodiscard]] vec3 unoccluded(NodeId source, const Receiver& r, const vec3& d) const;
    static bool is_worth_ray(Receiver& r, vec3& light);
    void add_rays(NodeId source, Receiver& r, const vec3& light);

    // What a ray brings if nothing blocks it.
    struct Share {
        Receiver* receiver;
        float weight;
        vec3 light;  // W/m2
    };

    const PatchTree& tree_;
    const PatchLights& lights_;
    std::span<const Moments> clusters_;
    const RayScene& scene_;
    // Of patches whose rays are still to be traced, one share for each ray.
    std::vector<Share> shares_;
    std::vector<ShadowRay> rays_;
    std::vector<std::uint8_t> blocked_;
};

// A group of few fragments would leave most of a packet empty: rays of several patches go together.
void RayShooter::light(NodeId source, std::span<Receiver> receivers) {
    for (Receiver& r : receivers) {
        vec3 light = unoccluded(source, r, r.position - lights_[source].center);
        if (max_component(light) > 0 && is_worth_ray(r, light)) add_rays(source, r, light);
    }
    if (rays_.size() >= kBatch) finish();
}

void RayShooter::finish() {
    blocked_.resize(rays_.size());
    scene_.occluded(rays_, blocked_);
    for (std::size_t i = 0; i < rays_.size(); ++i) {
        if (!blocked_[i]) shares_[i].receiver->irradiance += shares_[i].light;
    }
    shares_.clear();
    rays_.clear();
}

vec3 RayShooter::unoccluded(NodeId source, const Receiver& r, const vec3& d) const {
    const PatchLight& s = lights_[source];
    const float d2 = glm::dot(d, d);
    if (s.is_cluster()) {
        const float w = transfer_from_point(r, d, d2);
        if (w <= 0) return vec3(0);
        return w * clusters_[static_cast<std::size_t>(source)].clamped_cosine(d / std::sqrt(d2));
    }
    if (glm::dot(d, s.normal) < scene_.epsilon()) return vec3(0);
    if (d2 > kClose * kClose * s.radius * s.radius)
        return transfer(r, s.normal, d, d2) * s.area * s.radiance;
    const std::array<vec3, 4> corners = tree_.patch_corners(source);
    const auto count = static_cast<std::size_t>(tree_.corner_count(source));
    return kPi * std::max(0.0F, point_form_factor(r.position, r.shading, {corners.data(), count})) *
           s.radiance;
}

// Of weak patches one in so many gets a ray, in proportion to its light, which then stands for
// theirs: systematic sampling along the list, where neighbours are neighbours in the scene.
bool RayShooter::is_worth_ray(Receiver& r, vec3& light) {
    const float rays = luminance(light) / (kWorthRay * r.expected);
    if (!(rays < 1)) return true;  // nor where nothing is expected
    r.rays_owed += rays;
    if (r.rays_owed < 1) return false;
    r.rays_owed -= 1;
    light /= rays;
    return true;
}

// The light is shared out among the points by what each can bring, so that it has no noise where
// nothing is in the way.
void RayShooter::add_rays(NodeId source, Receiver& r, const vec3& light) {
    const std::span<const LightPoint> points = lights_.points(source);
    const std::size_t count = ray_count(luminance(light) / r.expected, points.size());
    const vec3 origin = r.position + r.normal * scene_.epsilon();
    const std::size_t first = shares_.size();
    float sum = 0;
    for (std::size_t i = 0; i < points.size() && shares_.size() < first + count; ++i) {
        const LightPoint& point = points[(r.turn + i) % points.size()];
        const vec3 d = r.position - point.position;
        if (glm::dot(d, point.normal) <= 0) continue;  // its back
        const float w = transfer(r, point.normal, d, glm::dot(d, d));
        if (w <= 0) continue;  // below the horizon
        sum += w;
        shares_.push_back({&r, w, light});
        rays_.push_back({origin, point.position + point.normal * scene_.epsilon()});
    }
    for (std::size_t i = first; i < shares_.size(); ++i)
        shares_[i].light *= shares_[i].weight / sum;
}

}  // namespace

std::unique_ptr<PatchShooter> make_ray_shooter(const PatchTree& tree, const PatchLights& lights,
                                               std::span<const Moments> clusters,
                                               const RayScene& rays) {
    return std::make_unique<RayShooter>(tree, lights, clusters, rays);
}

}  // namespace antiradiance
