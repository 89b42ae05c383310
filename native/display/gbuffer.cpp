// SPDX-License-Identifier: GPL-3.0-or-later
#include "display/gbuffer.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "display/camera_rays.h"
#include "display/visible_lamps.h"

namespace antiradiance {

namespace {

constexpr float kNoDepth = 1e10F;   // Blender's value for nothing
constexpr std::size_t kBlock = 32;  // pixels; some ms
// Pixels that are sampled before shadow maps light all their fragments; bounds the points in
// memory.
constexpr std::size_t kBand = 1U << 16U;
constexpr std::size_t kMapPoints = 4;  // of a fragment that shadow maps light

bool has_maps(const GBufferInput& input) {
    return input.direct && input.direct->has_maps();
}

// A fragment while its pixel's samples come in.
struct OpenFragment {
    std::int64_t key = 0;  // the leaf or surface, or the triangle side where there is none
    NodeId leaf = kNone;
    vec3 albedo{0};    // sum over samples
    vec3 emission{0};  // sum over samples
    std::vector<SurfacePoint> points;
};

// Fragments of some pixels, and the points of each that are to be lit by shadow maps.
struct Sampled {
    std::vector<Fragment> fragments;
    std::vector<SurfacePoint> points;
    std::vector<std::uint32_t> ends;  // of the points of each fragment; empty without shadow maps

    void append(const Sampled& other) {
        const auto before = static_cast<std::uint32_t>(points.size());
        fragments.insert(fragments.end(), other.fragments.begin(), other.fragments.end());
        points.insert(points.end(), other.points.begin(), other.points.end());
        for (const std::uint32_t end : other.ends)
            ends.push_back(before + end);
    }
};

class PixelSampler {
public:
    PixelSampler(const GBufferInput& input, GBuffer& target)
        : in_(input),
          out_(target),
          camera_(input.camera),
          rays_(input.camera),
          lamps_(input.scene.lamps),
          samples_(input.samples_per_axis * input.samples_per_axis) {}

    // Appends the fragments of a pixel and fills its place in the images.
    void sample(std::size_t pixel, Sampled& sampled) {
        open_count_ = 0;
        pixel_ = pixel;
        vec4 background(0);
        float centre_distance = 2;
        for (int s = 0; s < samples_; ++s) {
            const vec2 offset = sample_offset(s);
            const CameraRay ray = rays_.at(corner() + offset);
            const RayHit hit = in_.rays.intersect(ray.origin, ray.direction, ray.near, ray.far);
            if (hit.hit()) {
                add_surface(ray, hit);
            } else {
                background += beyond(ray);
            }
            const float from_centre = glm::distance(offset, vec2(0.5F));
            if (from_centre < centre_distance) {
                centre_distance = from_centre;
                out_.depth[pixel] = hit.hit() ? hit.distance * ray.axial : kNoDepth;
            }
        }
        out_.background[pixel] = background / static_cast<float>(samples_);
        vec3 normal(0);
        for (std::size_t i = 0; i < open_count_; ++i) {
            const Fragment& f = sampled.fragments.emplace_back(close(open_[i]));
            if (has_maps(in_)) add_points(open_[i], f, sampled);
            normal += f.shading_normal * f.coverage;
        }
        const float length = glm::length(normal);
        out_.normal[pixel] = length > 0 ? normal / length : vec3(0);
    }

private:
    // Lower left corner of the pixel in the full frame.
    [[nodiscard]] vec2 corner() const {
        const auto width = static_cast<std::size_t>(out_.width);
        return {static_cast<float>(camera_.x0) + static_cast<float>(pixel_ % width),
                static_cast<float>(camera_.y0) + static_cast<float>(pixel_ / width)};
    }

    [[nodiscard]] vec2 sample_offset(int s) const {
        const int n = in_.samples_per_axis;
        if (n == 1) return vec2(0.5F);  // jitter would fray all edges
        const vec2 jitter =
            r2_sample(static_cast<std::uint32_t>(s), static_cast<std::uint32_t>(pixel_));
        return (vec2(s % n, s / n) + jitter) / static_cast<float>(n);
    }

    // What a ray sees that meets no surface.
    [[nodiscard]] vec4 beyond(const CameraRay& ray) const {
        if (lamps_.any()) {
            const vec3 lamp = lamps_.radiance(ray, RayScene::kInfinity);
            if (max_component(lamp) > 0) return {lamp, 1};
        }
        return in_.film_transparent ? vec4(0) : vec4(in_.scene.background, 1);
    }

    void add_surface(const CameraRay& ray, const RayHit& hit) {
        const Scene& scene = in_.scene;
        const std::array<vec3, 3> c = scene.corners(hit.triangle);
        const vec3 point = c[0] * (1 - hit.barycentric.x - hit.barycentric.y) +
                           c[1] * hit.barycentric.x + c[2] * hit.barycentric.y;
        const float side = hit.back_side ? -1.0F : 1.0F;
        const vec3 normal = side * glm::normalize(glm::cross(c[1] - c[0], c[2] - c[0]));
        const NodeId leaf = in_.tree.lookup(hit.triangle, hit.back_side, point);
        OpenFragment& fragment = find(key_of(hit, leaf), leaf);
        fragment.points.push_back(
            {point, normal, side * scene.shading_normal_at(hit.triangle, hit.barycentric)});
        if (lamps_.any()) {
            const vec3 lamp = lamps_.radiance(ray, hit.distance);
            if (max_component(lamp) > 0) {  // it hides the surface
                fragment.emission += lamp;
                return;
            }
        }
        fragment.albedo += scene.albedo_at(hit.triangle, hit.barycentric);
        fragment.emission += scene.emission_at(hit.triangle, hit.barycentric);
    }

    // A small fragment needs fewer rays: its noise is but a part of the pixel's.
    [[nodiscard]] DirectSampling sampling_of(const OpenFragment& open) const {
        const float coverage =
            static_cast<float>(open.points.size()) / static_cast<float>(samples_);
        DirectSampling sampling;
        sampling.samples = std::max(
            1, static_cast<int>(std::lround(static_cast<float>(in_.direct_samples) * coverage)));
        sampling.tolerance /= std::sqrt(coverage);
        if (open.leaf != kNone) {
            const auto leaf = static_cast<std::size_t>(open.leaf);
            sampling.expected = luminance(in_.leaf_direct[leaf]);
            sampling.indirect = luminance(in_.irradiance[leaf]);
        }
        return sampling;
    }

    [[nodiscard]] std::int64_t key_of(const RayHit& hit, NodeId leaf) const {
        if (leaf == kNone) return -1 - (2 * std::int64_t{hit.triangle} + (hit.back_side ? 1 : 0));
        return in_.by_leaf ? leaf : in_.tree.surface[static_cast<std::size_t>(leaf)];
    }

    OpenFragment& find(std::int64_t key, NodeId leaf) {
        for (std::size_t i = 0; i < open_count_; ++i) {
            if (open_[i].key == key) return open_[i];
        }
        if (open_count_ == open_.size()) open_.emplace_back();
        OpenFragment& fragment = open_[open_count_++];
        fragment.key = key;
        fragment.leaf = leaf;
        fragment.albedo = fragment.emission = vec3(0);
        fragment.points.clear();
        return fragment;
    }

    static void add_points(const OpenFragment& open, const Fragment& f, Sampled& sampled) {
        if (max_component(f.albedo) > 0) {
            const auto points = spread_choice(open.points, kMapPoints);
            sampled.points.insert(sampled.points.end(), points.begin(), points.end());
        }
        sampled.ends.push_back(static_cast<std::uint32_t>(sampled.points.size()));
    }

    [[nodiscard]] vec3 direct_irradiance(const OpenFragment& open) const {
        const auto points =
            spread_choice(open.points, static_cast<std::size_t>(in_.direct_samples));
        return in_.direct->irradiance(points, sampling_of(open),
                                      hash_u32(static_cast<std::uint32_t>(pixel_)));
    }

    [[nodiscard]] Fragment close(const OpenFragment& open) const {
        const auto count = static_cast<float>(open.points.size());
        Fragment f;
        f.pixel = static_cast<std::uint32_t>(pixel_);
        f.leaf = open.leaf;
        f.coverage = count / static_cast<float>(samples_);
        f.normal = open.points.front().normal;
        for (const SurfacePoint& p : open.points) {
            f.position += p.position / count;
            f.shading_normal += p.shading_normal;
        }
        const float length = glm::length(f.shading_normal);
        f.shading_normal = length > 0 ? f.shading_normal / length : f.normal;
        f.albedo = open.albedo / count;
        f.light = open.emission / count;
        if (max_component(f.albedo) > 0 && in_.direct && !has_maps(in_))
            f.light += f.albedo * kInvPi * direct_irradiance(open);
        return f;
    }

    const GBufferInput& in_;
    GBuffer& out_;
    const Camera& camera_;
    CameraRays rays_;
    VisibleLamps lamps_;
    int samples_;
    std::size_t pixel_ = 0;
    std::vector<OpenFragment> open_;  // the first open_count_ are of this pixel
    std::size_t open_count_ = 0;
};

ProgressSpan part_of(ProgressSpan span, double begin, double end) {
    const double length = span.end - span.begin;
    return {span.begin + static_cast<float>(begin * length),
            span.begin + static_cast<float>(end * length)};
}

// Pixels [first, first + count).
Sampled sample_band(const GBufferInput& input, std::size_t first, std::size_t count,
                    GBuffer& buffer, Progress& progress, ProgressSpan span) {
    std::vector<Sampled> blocks((count + kBlock - 1) / kBlock);
    parallel_for_blocks(
        count, kBlock, progress,
        [&](std::size_t begin, std::size_t end) {
            PixelSampler sampler(input, buffer);
            for (std::size_t i = begin; i < end; ++i) {
                progress.check();
                sampler.sample(first + i, blocks[begin / kBlock]);
            }
        },
        span);
    Sampled band;
    for (Sampled& block : blocks) {
        band.append(block);
        block = {};
    }
    return band;
}

void light_by_maps(const DirectLight& direct, Sampled& band, Progress& progress,
                   ProgressSpan span) {
    const std::vector<vec3> irradiance =
        direct.mapped_irradiance(band.points, band.ends, progress, span);
    for (std::size_t i = 0; i < irradiance.size(); ++i) {
        Fragment& f = band.fragments[i];
        f.light += f.albedo * kInvPi * irradiance[i];
    }
}

}  // namespace

std::vector<std::uint32_t> pixel_starts(const GBuffer& buffer) {
    const std::size_t pixels =
        static_cast<std::size_t>(buffer.width) * static_cast<std::size_t>(buffer.height);
    std::vector<std::uint32_t> first(pixels + 1, 0);
    for (const Fragment& f : buffer.fragments)
        ++first[f.pixel + 1UL];
    for (std::size_t p = 0; p < pixels; ++p)
        first[p + 1] += first[p];
    return first;
}

GBuffer make_gbuffer(const GBufferInput& input, Progress& progress, ProgressSpan span) {
    const Camera& camera = input.camera;
    GBuffer buffer;
    buffer.width = camera.x1 - camera.x0;
    buffer.height = camera.y1 - camera.y0;
    const std::size_t pixels =
        static_cast<std::size_t>(buffer.width) * static_cast<std::size_t>(buffer.height);
    buffer.background.resize(pixels);
    buffer.depth.resize(pixels);
    buffer.normal.resize(pixels);

    const bool maps = has_maps(input);
    for (std::size_t first = 0; first < pixels; first += kBand) {
        const std::size_t count = std::min(kBand, pixels - first);
        const auto all = static_cast<double>(pixels);
        const ProgressSpan part = part_of(span, static_cast<double>(first) / all,
                                          static_cast<double>(first + count) / all);
        Sampled band =
            sample_band(input, first, count, buffer, progress, part_of(part, 0, maps ? 0.5 : 1));
        if (maps) light_by_maps(*input.direct, band, progress, part_of(part, 0.5, 1));
        buffer.fragments.insert(buffer.fragments.end(), band.fragments.begin(),
                                band.fragments.end());
    }
    return buffer;
}

}  // namespace antiradiance
