// SPDX-License-Identifier: GPL-3.0-or-later
#include "prune/ray_visibility.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.h"
#include "base/random.h"
#include "links/visibility.h"

namespace antiradiance {

namespace {

constexpr std::size_t kBlock = 16;         // segments of the set that a thread takes at once
constexpr std::uint32_t kFacingTries = 4;  // to find points that face each other
constexpr int kMostHits = 64;              // sides that a segment passes through

// How far points stay off their patch's outline, of the rays' epsilon. On the outline itself
// rounding would decide on which side of a wall that stands there they lie.
constexpr float kInset = 0.25F;
// And off its plane: twice the spacing of floats.
constexpr float kLift = 0.02F;

class Tracer {
public:
    Tracer(const Scene& scene, const PatchTree& tree, const RayScene& rays,
           const TraceOptions& options)
        : scene_(scene),
          tree_(tree),
          rays_(rays),
          sampler_(tree),
          count_(static_cast<std::uint32_t>(options.rays_per_link)),
          facing_(options.blocking_sides == BlockingSides::kFacing) {}

    [[nodiscard]] LinkVisibility trace(const Link& link, NodeId receiver) const {
        const bool minus = link.form_factor < 0;
        const bool facing = minus && facing_;
        const std::vector<Sample> samples = sample_segments(link.source, receiver, minus);
        std::vector<std::uint8_t> blocked = facing ? meet_lit_sides(samples) : meet_any(samples);
        // Some of the free ones just step over the foot of what blocks them, where a wall stands on
        // the floor; one that does not is enough.
        bool any_free = false;
        for (std::size_t i = 0; i < samples.size() && !any_free; ++i) {
            any_free = !blocked[i] && is_free(samples[i], facing);
            if (!any_free) blocked[i] = 1;
        }
        if (!any_free) return LinkVisibility::kNone;
        const bool any_blocked = std::find(blocked.begin(), blocked.end(), 1) != blocked.end();
        return any_blocked ? LinkVisibility::kPartial : LinkVisibility::kFull;
    }

private:
    struct End {
        vec3 point;
        vec3 normal;        // towards the other end
        SurfaceId surface;  // kNone: it is one of a cluster's
    };
    struct Sample {
        End from, to;
    };

    [[nodiscard]] End sample_end(NodeId n, const vec2& u) const {
        const auto i = static_cast<std::size_t>(n);
        const auto at = sampler_.sample(n, u);
        if (tree_.is_cluster(n)) return {at.point, at.normal, kNone};
        // From the outline to the centre it is about area / 4 radius, in a strip as well.
        const float inset = 4 * kInset * rays_.epsilon() * tree_.radius[i] / tree_.area[i];
        return {glm::mix(at.point, tree_.center[i], std::min(1.0F, inset)), at.normal,
                tree_.surface[i]};
    }

    [[nodiscard]] std::vector<Sample> sample_segments(NodeId source, NodeId receiver,
                                                      bool minus) const {
        std::vector<Sample> samples;
        const std::uint32_t seed =
            hash_combine(static_cast<std::uint32_t>(source), static_cast<std::uint32_t>(receiver));
        for (std::uint32_t i = 0; i < count_; ++i) {
            for (std::uint32_t attempt = 0; attempt < kFacingTries; ++attempt) {
                const std::uint32_t index = i + attempt * count_;
                End p = sample_end(source, r2_sample(index, seed));
                const End q = sample_end(receiver, r2_sample(index, seed ^ 0x5bd1e995U));
                if (minus) p.normal = -p.normal;
                const vec3 d = q.point - p.point;
                if (glm::dot(d, p.normal) <= 0 || glm::dot(d, q.normal) >= 0) continue;
                samples.push_back({p, q});
                break;
            }
        }
        return samples;
    }

    // Off the surfaces that hold its ends, by more than the ends that a ray leaves out.
    [[nodiscard]] ShadowRay ray_of(const Sample& s) const {
        const float offset = 2 * rays_.epsilon();
        return {s.from.point + s.from.normal * offset, s.to.point + s.to.normal * offset};
    }

    [[nodiscard]] std::vector<std::uint8_t> meet_any(const std::vector<Sample>& samples) const {
        std::vector<ShadowRay> segments;
        segments.reserve(samples.size());
        for (const Sample& s : samples)
            segments.push_back(ray_of(s));
        std::vector<std::uint8_t> blocked(samples.size(), 0);
        rays_.occluded(segments, blocked);
        return blocked;
    }

    [[nodiscard]] std::vector<std::uint8_t> meet_lit_sides(
        const std::vector<Sample>& samples) const {
        std::vector<std::uint8_t> blocked;
        blocked.reserve(samples.size());
        for (const Sample& s : samples)
            blocked.push_back(meets_lit_side(ray_of(s)) ? 1 : 0);
        return blocked;
    }

    [[nodiscard]] bool meets_lit_side(const ShadowRay& segment) const {
        const vec3 d = segment.to - segment.from;
        const float length = glm::length(d);
        const float far = length - rays_.epsilon();
        float near = rays_.epsilon();
        for (int i = 0; i < kMostHits && near < far; ++i) {
            const RayHit hit = rays_.intersect(segment.from, d / length, near, far);
            if (!hit.hit()) return false;
            if (is_lit(hit)) return true;
            near = hit.distance + rays_.epsilon();
        }
        return false;
    }
    [[nodiscard]] bool is_lit(const RayHit& hit) const {
        const auto& sides = tree_.triangle_surface[static_cast<std::size_t>(hit.triangle)];
        return sides[hit.back_side ? 1 : 0] != kNone;
    }

    // From point to point: nothing is left out but the surfaces that hold them.
    [[nodiscard]] bool is_free(const Sample& s, bool facing) const {
        const float lift = kLift * rays_.epsilon();
        const vec3 from = s.from.point + s.from.normal * lift;
        const vec3 d = s.to.point + s.to.normal * lift - from;
        const float length = glm::length(d);
        float near = 0;
        for (int i = 0; i < kMostHits; ++i) {
            const RayHit hit = rays_.intersect(from, d / length, near, length);
            if (!hit.hit()) return true;
            if ((!facing || is_lit(hit)) && !holds(hit.triangle, s.from) &&
                !holds(hit.triangle, s.to))
                return false;
            near = std::nextafter(hit.distance, length);
        }
        return true;
    }

    // Whether a triangle is the surface that an end lies on, or another in the same plane.
    [[nodiscard]] bool holds(TriangleId triangle, const End& end) const {
        const auto& sides = tree_.triangle_surface[static_cast<std::size_t>(triangle)];
        if (end.surface != kNone && (sides[0] == end.surface || sides[1] == end.surface))
            return true;
        const std::array<vec3, 3> corners = scene_.corners(triangle);
        return std::all_of(corners.begin(), corners.end(), [&](const vec3& p) {
            return std::abs(glm::dot(end.normal, p - end.point)) <= rays_.epsilon();
        });
    }

    const Scene& scene_;
    const PatchTree& tree_;
    const RayScene& rays_;
    SurfaceSampler sampler_;
    std::uint32_t count_;  // rays a link
    bool facing_;          // - links are blocked by the sides that face them alone
};

}  // namespace

std::vector<LinkVisibility> trace_visibility(const Scene& scene, const PatchTree& tree,
                                             const LinkSet& links, const RayScene& rays,
                                             const TraceOptions& options, Progress& progress) {
    const Tracer tracer(scene, tree, rays, options);
    std::vector<LinkVisibility> visibility(links.links.size(), LinkVisibility::kFull);
    parallel_for_blocks(links.segments.size(), kBlock, progress,
                        [&](std::size_t begin, std::size_t end) {
                            for (std::size_t s = begin; s < end; ++s) {
                                const Segment& segment = links.segments[s];
                                for (LinkId l = segment.begin; l < segment.end; ++l)
                                    visibility[l] = tracer.trace(links.links[l], segment.receiver);
                            }
                        });
    return visibility;
}

}  // namespace antiradiance
