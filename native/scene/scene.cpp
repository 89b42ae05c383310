// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace antiradiance {

namespace {

constexpr const char* kGreyMaterial = "(no material)";

template <class T>
T interpolate(const std::array<T, 3>& corners, const vec2& barycentric) {
    return corners[0] * (1.0F - barycentric.x - barycentric.y) + corners[1] * barycentric.x +
           corners[2] * barycentric.y;
}

bool is_finite(const mat4& m) {
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            if (!std::isfinite(m[column][row])) return false;
        }
    }
    return true;
}

// Volume of the unit cube's image over the product of its edge lengths: 1 for any scale without
// shear, 0 for a matrix that flattens. Independent of the units, unlike the determinant.
double relative_determinant(const glm::dmat3& m) {
    const double edges = glm::length(m[0]) * glm::length(m[1]) * glm::length(m[2]);
    return edges > 0 ? glm::determinant(m) / edges : 0.0;
}

std::int32_t grey_material(Scene& scene) {
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        if (scene.materials[i].name == kGreyMaterial) return static_cast<std::int32_t>(i);
    }
    scene.materials.push_back({.name = kGreyMaterial});
    return static_cast<std::int32_t>(scene.materials.size()) - 1;
}

// Slot number -> Scene::materials.
class SlotTable {
public:
    SlotTable(Scene& scene, const MeshInput& mesh) : materials_(mesh.slot_materials) {
        const auto count = static_cast<std::int32_t>(scene.materials.size());
        if (materials_.empty()) materials_.push_back(kNone);
        for (std::int32_t& material : materials_) {
            if (material < 0 || material >= count) material = grey_material(scene);
        }
    }
    [[nodiscard]] std::int32_t operator[](std::int32_t slot) const {
        const auto last = static_cast<std::int32_t>(materials_.size()) - 1;
        return materials_[static_cast<std::size_t>(std::clamp(slot, 0, last))];
    }

private:
    std::vector<std::int32_t> materials_;
};

// Unit normals of the corners in world space; the flat normal where there is none to use.
std::array<vec3, 3> world_normals(const std::array<vec3, 3>* object_space,
                                  const glm::mat3& normal_matrix,
                                  const std::array<vec3, 3>& corners) {
    vec3 flat = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const float length = glm::length(flat);
    flat = length > 0 ? flat / length : vec3(0, 0, 1);
    std::array<vec3, 3> normals{flat, flat, flat};
    if (object_space == nullptr) return normals;
    for (std::size_t i = 0; i < 3; ++i) {
        const vec3 n = normal_matrix * (*object_space)[i];
        const float n_length = glm::length(n);
        if (std::isfinite(n_length) && n_length > 0) normals[i] = n / n_length;
    }
    return normals;
}

std::string infinite_matrix(const MeshInput& mesh) {
    return "Object '" + mesh.object_name +
           "': its matrix holds NaN or infinite numbers; reset its location, rotation and scale "
           "(Object > Clear), and check its constraints and drivers";
}

std::string broken_mesh(const MeshInput& mesh, std::size_t triangles) {
    return "Object '" + mesh.object_name + "': " + std::to_string(triangles) +
           " triangles name vertices that do not exist; the mesh is broken, run mesh.validate() on "
           "it or rebuild it";
}

}  // namespace

vec4 Texture::sample(const vec2& uv) const {
    if (pixels.empty() || !std::isfinite(uv.x) || !std::isfinite(uv.y)) return vec4(0, 0, 0, 1);
    const float x = (uv.x - std::floor(uv.x)) * static_cast<float>(width) - 0.5F;
    const float y = (uv.y - std::floor(uv.y)) * static_cast<float>(height) - 0.5F;
    const float fx = std::floor(x);
    const float fy = std::floor(y);
    const auto wrap = [](int i, int n) { return i < 0 ? i + n : (i >= n ? i - n : i); };
    const int x0 = wrap(static_cast<int>(fx), width);
    const int y0 = wrap(static_cast<int>(fy), height);
    const int x1 = wrap(x0 + 1, width);
    const int y1 = wrap(y0 + 1, height);
    const auto pixel = [this](int i, int j) {
        return pixels[static_cast<std::size_t>(j) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(i)];
    };
    const vec4 below = glm::mix(pixel(x0, y0), pixel(x1, y0), x - fx);
    const vec4 above = glm::mix(pixel(x0, y1), pixel(x1, y1), x - fx);
    return glm::mix(below, above, y - fy);
}

vec3 Scene::albedo_at(TriangleId t, const vec2& barycentric) const {
    const auto i = static_cast<std::size_t>(t);
    const Material& material = materials[static_cast<std::size_t>(triangle_material[i])];
    if (material.albedo_texture == kNone) return material.albedo;
    const Texture& texture = textures[static_cast<std::size_t>(material.albedo_texture)];
    const vec3 colour(texture.sample(interpolate(uv[i], barycentric)));
    return glm::clamp(material.albedo * colour, vec3(0), vec3(1));
}

vec3 Scene::emission_at(TriangleId t, const vec2& barycentric) const {
    const auto i = static_cast<std::size_t>(t);
    const Material& material = materials[static_cast<std::size_t>(triangle_material[i])];
    if (material.emission_texture == kNone) return material.emission;
    const Texture& texture = textures[static_cast<std::size_t>(material.emission_texture)];
    const vec3 colour(texture.sample(interpolate(uv[i], barycentric)));
    return glm::max(material.emission * colour, vec3(0));
}

vec3 Scene::shading_normal_at(TriangleId t, const vec2& barycentric) const {
    const std::array<vec3, 3>& n = normals[static_cast<std::size_t>(t)];
    const vec3 sum = interpolate(n, barycentric);
    const float length = glm::length(sum);
    return length > 1e-6F ? sum / length : n[0];
}

float largest_extent(const Scene& scene) {
    if (scene.triangles.empty()) return 1;
    vec3 low(std::numeric_limits<float>::max());
    vec3 high(std::numeric_limits<float>::lowest());
    for (const uvec3& triangle : scene.triangles) {
        for (int i = 0; i < 3; ++i) {
            low = glm::min(low, scene.positions[triangle[i]]);
            high = glm::max(high, scene.positions[triangle[i]]);
        }
    }
    const float offset = max_component(glm::max(glm::abs(low), glm::abs(high)));
    return std::max(max_component(high - low), 0.05F * offset);
}

void add_mesh(Scene& scene, const MeshInput& mesh) {
    const auto object = static_cast<std::int32_t>(scene.objects.size());
    scene.objects.push_back({mesh.object_name, static_cast<TriangleId>(scene.triangles.size()), 0});

    const glm::dmat3 linear(mesh.to_world);
    const double volume = is_finite(mesh.to_world) ? relative_determinant(linear) : 0.0;
    if (!is_finite(mesh.to_world)) {
        scene.problems.push_back(infinite_matrix(mesh));
        return;
    }
    if (std::abs(volume) < 1e-9) {
        scene.problems.push_back("Object '" + mesh.object_name +
                                 "': its matrix can't be inverted, because a scale is 0 along an "
                                 "axis; set every scale of it and of its parents to another value");
        return;
    }
    const bool mirrored = volume < 0;
    const glm::mat3 normal_matrix(glm::transpose(glm::inverse(linear)));

    const auto first_vertex = static_cast<std::uint32_t>(scene.positions.size());
    scene.positions.reserve(scene.positions.size() + mesh.position_count);
    for (std::size_t i = 0; i < mesh.position_count; ++i) {
        scene.positions.emplace_back(mesh.to_world * vec4(mesh.positions[i], 1));
    }

    const SlotTable slots(scene, mesh);
    std::size_t outside = 0;
    std::int32_t polygon_end = 0;
    for (std::size_t t = 0; t < mesh.triangle_count; ++t) {
        const uvec3 local = mesh.triangles[t];
        if (std::max({local.x, local.y, local.z}) >= mesh.position_count) {
            ++outside;
            continue;
        }
        std::array<std::uint32_t, 3> corner{0, 1, 2};
        if (mirrored) std::swap(corner[1], corner[2]);
        uvec3 indices;
        std::array<vec2, 3> uv{vec2(0), vec2(0), vec2(0)};
        std::array<vec3, 3> corners;
        std::array<vec3, 3> object_normals{vec3(0), vec3(0), vec3(0)};
        for (int i = 0; i < 3; ++i) {
            const auto from = corner[static_cast<std::size_t>(i)];
            const auto to = static_cast<std::size_t>(i);
            indices[i] = first_vertex + local[static_cast<int>(from)];
            corners[to] = scene.positions[indices[i]];
            if (mesh.uv != nullptr) uv[to] = mesh.uv[t][from];
            if (mesh.normals != nullptr) object_normals[to] = mesh.normals[t][from];
        }
        const auto own = static_cast<std::int32_t>(t);
        const std::int32_t polygon = mesh.triangle_polygon ? mesh.triangle_polygon[t] : own;
        polygon_end = std::max(polygon_end, polygon + 1);
        scene.triangles.push_back(indices);
        scene.triangle_polygon.push_back(scene.polygon_count + polygon);
        scene.triangle_material.push_back(
            slots[mesh.triangle_material ? mesh.triangle_material[t] : 0]);
        scene.triangle_object.push_back(object);
        scene.uv.push_back(uv);
        scene.normals.push_back(
            world_normals(mesh.normals ? &object_normals : nullptr, normal_matrix, corners));
    }
    scene.polygon_count += polygon_end;
    Object& added = scene.objects.back();
    added.triangle_count = static_cast<TriangleId>(scene.triangles.size()) - added.first_triangle;
    if (outside > 0) scene.problems.push_back(broken_mesh(mesh, outside));
}

void add_blocker(Scene& scene, const MeshInput& mesh) {
    Blocker& blocker = scene.blockers.emplace_back();
    blocker.name = mesh.object_name;
    if (!is_finite(mesh.to_world)) {
        scene.problems.push_back(infinite_matrix(mesh));
        return;
    }
    for (std::size_t i = 0; i < mesh.position_count; ++i)
        blocker.positions.emplace_back(mesh.to_world * vec4(mesh.positions[i], 1));
    std::copy_if(mesh.triangles, mesh.triangles + mesh.triangle_count,
                 std::back_inserter(blocker.triangles), [&](const uvec3& t) {
                     return std::max({t.x, t.y, t.z}) < mesh.position_count;
                 });
    const std::size_t outside = mesh.triangle_count - blocker.triangles.size();
    if (outside > 0) scene.problems.push_back(broken_mesh(mesh, outside));
}

}  // namespace antiradiance
