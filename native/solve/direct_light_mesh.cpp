// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <optional>

#include "solve/direct_light_emitter.h"

namespace antiradiance {

namespace {

// A textured triangle is cut into at most 4^kDeepest pieces, all together into about kMostPieces.
constexpr int kDeepest = 4;
constexpr std::size_t kMostPieces = 1U << 17U;
// A piece may hold this share of the triangle's brightest colour as contrast.
constexpr float kContrast = 0.2F;

using Barycentric = std::array<vec2, 3>;

// Two triangles that form a flat convex quad: its corners in order.
std::optional<std::array<vec3, 4>> join_to_quad(const Scene& scene, TriangleId first,
                                                TriangleId second) {
    const uvec3 a = scene.triangles[static_cast<std::size_t>(first)];
    const uvec3 b = scene.triangles[static_cast<std::size_t>(second)];
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            // The shared edge runs in opposite directions.
            if (a[i] != b[(j + 1) % 3] || a[(i + 1) % 3] != b[j]) continue;
            const std::array<vec3, 4> quad{scene.positions[a[(i + 1) % 3]],
                                           scene.positions[a[(i + 2) % 3]], scene.positions[a[i]],
                                           scene.positions[b[(j + 2) % 3]]};
            const vec3 n = glm::normalize(glm::cross(quad[1] - quad[0], quad[2] - quad[0]));
            const float size = glm::distance(quad[0], quad[2]);
            if (std::abs(glm::dot(quad[3] - quad[0], n)) > 1e-4F * size) return std::nullopt;
            for (std::size_t k = 0; k < 4; ++k) {
                const vec3 turn =
                    glm::cross(quad[(k + 1) % 4] - quad[k], quad[(k + 2) % 4] - quad[(k + 1) % 4]);
                if (glm::dot(turn, n) <= 0) return std::nullopt;
            }
            return quad;
        }
    }
    return std::nullopt;
}

struct ColourRange {
    vec3 mean{0};
    float low = 0, high = 0;  // of the luminance
};

// Emission over a piece of a triangle, at the centres of n^2 equal cells.
ColourRange sample_emission(const Scene& scene, TriangleId t, const Barycentric& piece, int n) {
    ColourRange range;
    range.low = 1e30F;
    const float step = 1 / static_cast<float>(n);
    const auto add = [&](float u, float v) {
        const vec2 at = piece[0] * (1 - u - v) + piece[1] * u + piece[2] * v;
        const vec3 colour = scene.emission_at(t, at);
        range.mean += colour / static_cast<float>(n * n);
        range.low = std::min(range.low, luminance(colour));
        range.high = std::max(range.high, luminance(colour));
    };
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j + i < n; ++j) {
            const float u = static_cast<float>(i) * step;
            const float v = static_cast<float>(j) * step;
            add(u + step / 3, v + step / 3);
            if (i + j + 1 < n) add(u + 2 * step / 3, v + 2 * step / 3);
        }
    }
    return range;
}

class EmitterMaker {
public:
    EmitterMaker(const Scene& scene, float epsilon) : scene_(scene), epsilon_(epsilon) {}

    MeshEmitters make() {
        find_depth();
        of_triangle_.assign(scene_.triangles.size(), kNone);
        const auto count = static_cast<TriangleId>(scene_.triangles.size());
        for (TriangleId t = 0; t < count; ++t) {
            const Material& material = material_of(t);
            if (!material.emits()) continue;
            if (material.emission_texture != kNone) {
                add_textured(t);
                continue;
            }
            // Polygons of two triangles only: of larger ones, the triangles stay apart.
            const bool pair = t + 1 < count && same_polygon(t, t + 1) &&
                              (t == 0 || !same_polygon(t, t - 1)) &&
                              (t + 2 >= count || !same_polygon(t, t + 2));
            const auto quad = pair ? join_to_quad(scene_, t, t + 1) : std::nullopt;
            const auto number = static_cast<std::int32_t>(emitters_.size());
            of_triangle_[static_cast<std::size_t>(t)] = number;
            if (quad) {
                of_triangle_[static_cast<std::size_t>(t + 1)] = number;
                add_emitter(t, *quad, 4, material.emission);
                ++t;
            } else {
                add_piece(t, {vec2(0, 0), vec2(1, 0), vec2(0, 1)}, material.emission);
            }
        }
        return {std::move(emitters_), std::move(materials_), std::move(of_triangle_)};
    }

private:
    [[nodiscard]] const Material& material_of(TriangleId t) const {
        const auto m = scene_.triangle_material[static_cast<std::size_t>(t)];
        return scene_.materials[static_cast<std::size_t>(m)];
    }
    [[nodiscard]] bool same_polygon(TriangleId a, TriangleId b) const {
        const auto i = static_cast<std::size_t>(a);
        const auto j = static_cast<std::size_t>(b);
        return scene_.triangle_polygon[i] == scene_.triangle_polygon[j] &&
               scene_.triangle_material[i] == scene_.triangle_material[j];
    }

    void find_depth() {
        std::size_t textured = 0;
        for (std::size_t t = 0; t < scene_.triangles.size(); ++t) {
            const Material& m = material_of(static_cast<TriangleId>(t));
            textured += m.emits() && m.emission_texture != kNone ? 1 : 0;
        }
        depth_ = kDeepest;
        while (depth_ > 0 && (textured << (2U * static_cast<unsigned>(depth_))) > kMostPieces) {
            --depth_;
        }
    }

    void add_piece(TriangleId t, const Barycentric& piece, const vec3& radiance) {
        const auto c = scene_.corners(t);
        std::array<vec3, 4> corners{};
        for (std::size_t i = 0; i < 3; ++i) {
            corners[i] =
                c[0] * (1 - piece[i].x - piece[i].y) + c[1] * piece[i].x + c[2] * piece[i].y;
        }
        add_emitter(t, corners, 3, radiance);
    }

    void add_emitter(TriangleId t, const std::array<vec3, 4>& corners, std::size_t count,
                     const vec3& radiance) {
        emitters_.push_back(
            std::make_unique<PolygonEmitter>(corners, count, radiance, true, epsilon_));
        materials_.push_back(scene_.triangle_material[static_cast<std::size_t>(t)]);
    }

    void add_textured(TriangleId t) {
        const Barycentric whole{vec2(0, 0), vec2(1, 0), vec2(0, 1)};
        const ColourRange range = sample_emission(scene_, t, whole, 32);
        if (range.high <= 0) return;
        allowed_ = kContrast * range.high;
        if (range.high - range.low <= allowed_) {
            add_piece(t, whole, range.mean);
        } else {
            cut(t, whole, depth_);
        }
    }

    void cut(TriangleId t, const Barycentric& piece, int depth) {
        const ColourRange range = sample_emission(scene_, t, piece, depth > 2 ? 16 : 8);
        if (range.high <= 0) return;
        if (depth == 0 || range.high - range.low <= allowed_) {
            add_piece(t, piece, range.mean);
            return;
        }
        const vec2 ab = (piece[0] + piece[1]) / 2.0F;
        const vec2 bc = (piece[1] + piece[2]) / 2.0F;
        const vec2 ca = (piece[2] + piece[0]) / 2.0F;
        cut(t, {piece[0], ab, ca}, depth - 1);
        cut(t, {ab, piece[1], bc}, depth - 1);
        cut(t, {ca, bc, piece[2]}, depth - 1);
        cut(t, {ab, bc, ca}, depth - 1);
    }

    const Scene& scene_;
    float epsilon_;
    int depth_ = kDeepest;
    float allowed_ = 0;  // luminance, W/(m2 sr)
    std::vector<EmitterPtr> emitters_;
    std::vector<std::int32_t> materials_;  // #emitters
    std::vector<std::int32_t> of_triangle_;
};

}  // namespace

MeshEmitters make_mesh_emitters(const Scene& scene, float epsilon) {
    return EmitterMaker(scene, epsilon).make();
}

}  // namespace antiradiance
