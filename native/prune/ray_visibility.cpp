// SPDX-License-Identifier: GPL-3.0-or-later
#include "prune/ray_visibility.h"

#include "base/parallel.h"
#include "base/random.h"
#include "links/visibility.h"

namespace antiradiance {

namespace {

constexpr std::size_t kBlock = 16;         // segments of the set that a thread takes at once
constexpr std::uint32_t kFacingTries = 4;  // to find points that face each other
constexpr int kMostHits = 64;              // sides that a - link leaves solids through

class Tracer {
public:
    Tracer(const PatchTree& tree, const RayScene& rays, const TraceOptions& options)
        : tree_(tree),
          rays_(rays),
          sampler_(tree),
          count_(static_cast<std::uint32_t>(options.rays_per_link)),
          facing_(options.blocking_sides == BlockingSides::kFacing) {}

    [[nodiscard]] LinkVisibility trace(const Link& link, NodeId receiver) const {
        const bool minus = link.form_factor < 0;
        std::vector<ShadowRay> segments;
        sample_segments(link.source, receiver, minus, segments);
        if (segments.empty()) return LinkVisibility::kNone;
        const std::size_t blocked =
            minus && facing_ ? count_facing(segments) : count_blocked(segments);
        if (blocked == segments.size()) return LinkVisibility::kNone;
        return blocked == 0 ? LinkVisibility::kFull : LinkVisibility::kPartial;
    }

private:
    void sample_segments(NodeId source, NodeId receiver, bool minus,
                         std::vector<ShadowRay>& segments) const {
        const std::uint32_t seed =
            hash_combine(static_cast<std::uint32_t>(source), static_cast<std::uint32_t>(receiver));
        const float offset = 2 * rays_.epsilon();
        for (std::uint32_t i = 0; i < count_; ++i) {
            for (std::uint32_t attempt = 0; attempt < kFacingTries; ++attempt) {
                const std::uint32_t index = i + attempt * count_;
                const auto p = sampler_.sample(source, r2_sample(index, seed));
                const auto q = sampler_.sample(receiver, r2_sample(index, seed ^ 0x5bd1e995U));
                const vec3 leaving = minus ? -p.normal : p.normal;
                const vec3 d = q.point - p.point;
                if (glm::dot(d, leaving) <= 0 || glm::dot(d, q.normal) >= 0) continue;
                segments.push_back({p.point + leaving * offset, q.point + q.normal * offset});
                break;
            }
        }
    }

    [[nodiscard]] std::size_t count_blocked(const std::vector<ShadowRay>& segments) const {
        std::vector<std::uint8_t> blocked(segments.size(), 0);
        rays_.occluded(segments, blocked);
        std::size_t count = 0;
        for (const std::uint8_t b : blocked)
            count += b ? 1 : 0;
        return count;
    }

    [[nodiscard]] std::size_t count_facing(const std::vector<ShadowRay>& segments) const {
        std::size_t count = 0;
        for (const ShadowRay& s : segments)
            count += meets_lit_side(s) ? 1 : 0;
        return count;
    }

    [[nodiscard]] bool meets_lit_side(const ShadowRay& segment) const {
        const vec3 d = segment.to - segment.from;
        const float far = glm::length(d) - rays_.epsilon();
        float near = rays_.epsilon();
        for (int i = 0; i < kMostHits && near < far; ++i) {
            const RayHit hit =
                rays_.intersect(segment.from, d / (far + rays_.epsilon()), near, far);
            if (!hit.hit()) return false;
            const auto& sides = tree_.triangle_surface[static_cast<std::size_t>(hit.triangle)];
            if (sides[hit.back_side ? 1 : 0] != kNone) return true;
            near = hit.distance + rays_.epsilon();
        }
        return false;
    }

    const PatchTree& tree_;
    const RayScene& rays_;
    SurfaceSampler sampler_;
    std::uint32_t count_;  // rays a link
    bool facing_;          // - links are blocked by the sides that face them alone
};

}  // namespace

std::vector<LinkVisibility> trace_visibility(const PatchTree& tree, const LinkSet& links,
                                             const RayScene& rays, const TraceOptions& options,
                                             Progress& progress) {
    const Tracer tracer(tree, rays, options);
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
