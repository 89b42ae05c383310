// SPDX-License-Identifier: GPL-3.0-or-later
#include "display/shooting.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.h"
#include "links/form_factor.h"

namespace antiradiance {

namespace {

// Distances in radii of a light: beyond kFar its centre stands for it, within kClose its form
// factor is exact, between them a few of its points do.
constexpr float kFar = 8;
constexpr float kClose = 4;
constexpr int kMiddleSamples = 4;
// Height above a light's plane, in radii of the light, that counts as in it for fragments that face
// the same way.
constexpr float kFlatHeight = 0.03F;
constexpr float kFlatCosine = 0.95F;

struct Receiver {
    vec3 position;
    vec3 normal;        // unit, of the geometry: sets the horizon
    vec3 shading;       // unit, sets the cosine
    SurfaceId surface;  // kNone: on a side that no link reaches
    vec3 irradiance;    // W/m2, the result
};

// Lights receivers by one source after the other.
class Shooter {
public:
    explicit Shooter(const ShootingInput& input) : in_(input) {}

    void light(NodeId source, std::span<Receiver> receivers) const {
        const PatchLight& s = in_.lights[source];
        const SurfaceId surface = in_.tree.surface[static_cast<std::size_t>(source)];
        const std::span<const vec3> blocked = in_.antiradiance.of(source);
        for (Receiver& r : receivers) {
            const vec3 d = r.position - s.center;
            const float height = glm::dot(d, s.normal);
            const float d2 = glm::dot(d, d);
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
    // cos cos / d^2 between a point of the source and the receiver; d: from source to receiver.
    static float transfer(const Receiver& r, const vec3& source_normal, const vec3& d, float d2) {
        const float cos_r = -glm::dot(d, r.shading);
        if (cos_r <= 0 || glm::dot(d, r.normal) >= 0) return 0;
        return std::abs(glm::dot(d, source_normal)) * cos_r / (d2 * d2);
    }

    // A fragment does not see the plane that it lies in, although rounding, or a quad that is not
    // quite flat, may put it a little before or behind its neighbours, where it would be lit or
    // shadowed by them from all around.
    [[nodiscard]] bool in_one_plane(const Receiver& r, const PatchLight& s, float height) const {
        if (std::abs(height) < in_.epsilon) return true;
        return std::abs(height) < kFlatHeight * s.radius &&
               glm::dot(r.normal, s.normal) > kFlatCosine;
    }

    [[nodiscard]] vec3 seen(std::span<const vec3> blocked, const vec3& d) const {
        return in_.bins.interpolate(blocked, d);
    }

    // A light that is no point from here: by its form factor where it is close, which a sum over a
    // few of its points only shares out to directions, else by the points alone.
    [[nodiscard]] vec3 near(NodeId source, const PatchLight& s, std::span<const vec3> blocked,
                            const Receiver& r, bool in_front, bool close) const {
        float exact = 0;
        if (close) {
            const std::array<vec3, 4> corners = in_.tree.patch_corners(source);
            const auto count = static_cast<std::size_t>(in_.tree.corner_count(source));
            exact =
                kPi * std::abs(point_form_factor(r.position, r.shading, {corners.data(), count}));
            if (in_front) return exact * s.radiance;
        }
        std::span<const vec3> points = in_.lights.points(source);
        if (!close) points = points.first(std::min<std::size_t>(points.size(), kMiddleSamples));
        float sum = 0;
        vec3 light(0);
        for (const vec3& point : points) {
            const vec3 d = r.position - point;
            const float w = transfer(r, s.normal, d, glm::dot(d, d));
            if (w <= 0) continue;
            sum += w;
            light += w * (in_front ? s.radiance : -seen(blocked, d));
        }
        if (sum <= 0) return vec3(0);
        return light * (close ? exact / sum : s.area / static_cast<float>(points.size()));
    }

    const ShootingInput& in_;
};

// Fragments of a group by the subset of sources that interleaving gives them.
class Subsets {
public:
    Subsets(const ShootingInput& input, const FragmentGroup& group)
        : n_(static_cast<std::uint32_t>(input.interleave)), begin_(n_ * n_ + 1, 0) {
        const auto width = static_cast<std::uint32_t>(input.buffer.width);
        std::vector<std::uint32_t> subset;
        for (std::uint32_t i = group.begin; i < group.end; ++i) {
            const std::uint32_t pixel = input.buffer.fragments[input.groups.order[i]].pixel;
            subset.push_back(pixel / width % n_ * n_ + pixel % width % n_);
            ++begin_[subset.back() + 1];
        }
        for (std::size_t k = 0; k + 1 < begin_.size(); ++k)
            begin_[k + 1] += begin_[k];
        std::vector<std::uint32_t> fill(begin_.begin(), begin_.end() - 1);
        fragments.resize(subset.size());
        for (std::uint32_t i = group.begin; i < group.end; ++i)
            fragments[fill[subset[i - group.begin]]++] = input.groups.order[i];
    }
    // Fragments of subset k: fragments[first(k)] ... fragments[first(k + 1) - 1].
    [[nodiscard]] std::uint32_t first(std::size_t k) const { return begin_[k]; }
    [[nodiscard]] std::size_t count() const { return begin_.size() - 1; }
    std::vector<std::uint32_t> fragments;  // into GBuffer::fragments

private:
    std::uint32_t n_;
    std::vector<std::uint32_t> begin_;
};

void shoot_group(const ShootingInput& input, std::size_t g, Progress& progress,
                 std::vector<vec3>& irradiance) {
    const Subsets subsets(input, input.groups.groups[g]);
    std::vector<Receiver> receivers;
    receivers.reserve(subsets.fragments.size());
    for (const std::uint32_t i : subsets.fragments) {
        const Fragment& f = input.buffer.fragments[i];
        const SurfaceId surface =
            f.leaf == kNone ? kNone : input.tree.surface[static_cast<std::size_t>(f.leaf)];
        receivers.push_back({f.position, f.normal, f.shading_normal, surface, vec3(0)});
    }
    const Shooter shooter(input);
    const std::span<const NodeId> sources = input.sources.of(g);
    for (std::size_t s = 0; s < sources.size(); ++s) {
        if (s % 256 == 0) progress.check();
        const std::size_t k = s % subsets.count();
        const std::uint32_t begin = subsets.first(k);
        const std::uint32_t end = subsets.first(k + 1);
        if (begin < end) shooter.light(sources[s], {receivers.data() + begin, end - begin});
    }
    const auto scale = static_cast<float>(subsets.count());
    for (std::size_t i = 0; i < receivers.size(); ++i)
        irradiance[subsets.fragments[i]] = scale * receivers[i].irradiance;
}

}  // namespace

std::vector<vec3> shoot(const ShootingInput& input, Progress& progress, ProgressSpan span) {
    std::vector<vec3> irradiance(input.buffer.fragments.size(), vec3(0));
    parallel_for(
        input.groups.groups.size(), progress,
        [&](std::size_t g) { shoot_group(input, g, progress, irradiance); }, span);
    return irradiance;
}

}  // namespace antiradiance
