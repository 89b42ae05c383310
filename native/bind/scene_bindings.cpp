// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <optional>
#include <string>

#include "bind/arrays.h"
#include "bind/bindings.h"
#include "bind/by_name.h"
#include "bind/camera_binding.h"
#include "scene/scene.h"

#include <pybind11/stl.h>

namespace py = pybind11;
using namespace py::literals;

namespace antiradiance {
namespace {

static_assert(sizeof(vec2) == 2 * sizeof(float) && sizeof(vec3) == 3 * sizeof(float) &&
                  sizeof(vec4) == 4 * sizeof(float) && sizeof(uvec3) == 3 * sizeof(std::int32_t),
              "numpy arrays are borrowed as arrays of these");

void check_index(std::int32_t index, std::size_t count, const std::string& what) {
    if (index != kNone && (index < 0 || static_cast<std::size_t>(index) >= count)) {
        throw py::index_error(what + " " + std::to_string(index) + " was not added to the scene");
    }
}

void check_range(const std::int32_t* values, std::size_t size, std::size_t count,
                 const std::string& what) {
    const auto [low, high] = std::minmax_element(values, values + size);
    if (size > 0 && (*low < 0 || static_cast<std::size_t>(*high) >= count)) {
        throw py::index_error(what + " must lie in 0.." + std::to_string(count) +
                              " (exclusive), found " + std::to_string(*low) + ".." +
                              std::to_string(*high));
    }
}

int add_texture(Scene& scene, const std::string& name, const py::array& pixels) {
    const auto* data =
        borrow<float>(pixels, {kAny, kAny, 4}, "pixels of the texture '" + name + "'");
    Texture texture;
    texture.name = name;
    texture.height = static_cast<int>(pixels.shape(0));
    texture.width = static_cast<int>(pixels.shape(1));
    if (texture.width == 0 || texture.height == 0) {
        throw py::value_error("the texture '" + name + "' has no pixels");
    }
    const auto* first = reinterpret_cast<const vec4*>(data);
    texture.pixels.assign(first, first + pixels.shape(0) * pixels.shape(1));
    scene.textures.push_back(std::move(texture));
    return static_cast<int>(scene.textures.size()) - 1;
}

int add_missing_texture(Scene& scene, const std::string& name, const std::string& path) {
    Texture texture;
    texture.name = name;
    texture.missing_path = path;
    scene.textures.push_back(std::move(texture));
    return static_cast<int>(scene.textures.size()) - 1;
}

int add_material(Scene& scene, const std::string& name, const py::object& albedo,
                 const py::object& emission, int albedo_texture, int emission_texture) {
    check_index(albedo_texture, scene.textures.size(), "albedo_texture");
    check_index(emission_texture, scene.textures.size(), "emission_texture");
    scene.materials.push_back({.name = name,
                               .albedo = to_vec3(albedo, "albedo"),
                               .emission = to_vec3(emission, "emission"),
                               .albedo_texture = albedo_texture,
                               .emission_texture = emission_texture});
    return static_cast<int>(scene.materials.size()) - 1;
}

// named(what): for messages.
template <typename Named>
void read_geometry(const py::array& positions, const py::object& matrix, const py::array& triangles,
                   const Named& named, MeshInput& mesh) {
    mesh.to_world = to_matrix(matrix, named("matrix"));
    mesh.positions =
        reinterpret_cast<const vec3*>(borrow<float>(positions, {kAny, 3}, named("positions")));
    mesh.position_count = static_cast<std::size_t>(positions.shape(0));
    const auto* corners = borrow<std::int32_t>(triangles, {kAny, 3}, named("triangles"));
    mesh.triangles = reinterpret_cast<const uvec3*>(corners);
    mesh.triangle_count = static_cast<std::size_t>(triangles.shape(0));
    check_range(corners, 3 * mesh.triangle_count, mesh.position_count, named("triangles"));
}

int add_mesh_arrays(Scene& scene, const std::string& object_name, const py::array& positions,
                    const py::object& matrix, const py::array& triangles,
                    const py::array& triangle_polygon, const py::array& triangle_material,
                    std::vector<std::int32_t> slot_materials, const std::optional<py::array>& uv,
                    const std::optional<py::array>& corner_normals) {
    const auto named = [&](const char* what) {
        return std::string(what) + " of the mesh '" + object_name + "'";
    };
    MeshInput mesh;
    mesh.object_name = object_name;
    read_geometry(positions, matrix, triangles, named, mesh);
    const py::ssize_t count = triangles.shape(0);
    mesh.triangle_polygon =
        borrow<std::int32_t>(triangle_polygon, {count}, named("triangle_polygon"));
    mesh.triangle_material =
        borrow<std::int32_t>(triangle_material, {count}, named("triangle_material"));
    check_range(mesh.triangle_material, mesh.triangle_count, slot_materials.size(),
                named("triangle_material"));
    for (const std::int32_t material : slot_materials) {
        check_range(&material, 1, scene.materials.size(), named("slot_materials"));
    }
    mesh.slot_materials = std::move(slot_materials);
    if (uv) {
        mesh.uv = reinterpret_cast<const std::array<vec2, 3>*>(
            borrow<float>(*uv, {count, 3, 2}, named("uv")));
    }
    if (corner_normals) {
        mesh.normals = reinterpret_cast<const std::array<vec3, 3>*>(
            borrow<float>(*corner_normals, {count, 3, 3}, named("corner_normals")));
    }
    add_mesh(scene, mesh);
    return static_cast<int>(scene.objects.size()) - 1;
}

int add_blocker_arrays(Scene& scene, const std::string& name, const py::array& positions,
                       const py::object& matrix, const py::array& triangles) {
    const auto named = [&](const char* what) {
        return std::string(what) + " of the blocker '" + name + "'";
    };
    MeshInput mesh;
    mesh.object_name = name;
    read_geometry(positions, matrix, triangles, named, mesh);
    add_blocker(scene, mesh);
    return static_cast<int>(scene.blockers.size()) - 1;
}

int add_lamp(Scene& scene, const std::string& name, const std::string& type,
             const py::object& matrix, const py::object& color, float radius, float spot_angle,
             float spot_blend, bool spot_cosine, float sun_angle, const std::string& shape,
             float size_x, float size_y, bool visible_to_camera, float spread) {
    Lamp lamp;
    lamp.name = name;
    lamp.type = by_name<LampType>(type, "type of the lamp '" + name + "'",
                                  {{"POINT", LampType::kPoint},
                                   {"SPOT", LampType::kSpot},
                                   {"SUN", LampType::kSun},
                                   {"AREA", LampType::kArea}});
    lamp.to_world = to_matrix(matrix, "matrix of the lamp '" + name + "'");
    lamp.power = to_vec3(color, "color of the lamp '" + name + "'");
    lamp.radius = radius;
    lamp.spot_angle = spot_angle;
    lamp.spot_blend = spot_blend;
    lamp.spot_cosine = spot_cosine;
    lamp.sun_angle = sun_angle;
    lamp.shape = by_name<AreaShape>(
        shape, "shape of the lamp '" + name + "'",
        {{"RECTANGLE", AreaShape::kRectangle}, {"ELLIPSE", AreaShape::kEllipse}});
    lamp.size = {size_x, size_y};
    lamp.spread = spread;
    lamp.visible_to_camera = visible_to_camera;
    scene.lamps.push_back(std::move(lamp));
    return static_cast<int>(scene.lamps.size()) - 1;
}

}  // namespace

void bind_scene(py::module_& module) {
    py::class_<Scene> scene_class(
        module, "Scene",
        "Plain arrays on their way to the core: metres, W/(m2 sr), linear Rec.709. "
        "Each add_ returns an index that later calls refer to");
    def_set_camera(scene_class, [](Scene& scene, const Camera& camera) {
        scene.camera = camera;
        scene.has_camera = true;
    });
    scene_class.def(py::init<>())
        .def("add_texture", &add_texture, "name"_a, "pixels"_a,
             "pixels: (h, w, 4) float32, linear Rec.709, row 0 at v = 0")
        .def("add_missing_texture", &add_missing_texture, "name"_a, "path"_a,
             "An image that could not be read; the render then fails with a message about it")
        .def("add_material", &add_material, "name"_a, py::kw_only(),
             "albedo"_a = py::make_tuple(.8F, .8F, .8F), "emission"_a = py::make_tuple(0, 0, 0),
             "albedo_texture"_a = kNone, "emission_texture"_a = kNone,
             "emission: radiance, W/(m2 sr); a texture multiplies its constant")
        .def("add_mesh", &add_mesh_arrays, "object_name"_a, py::kw_only(), "positions"_a,
             "matrix"_a, "triangles"_a, "triangle_polygon"_a, "triangle_material"_a,
             "slot_materials"_a, "uv"_a = py::none(), "corner_normals"_a = py::none(),
             "positions (n,3) f32, object space; matrix (4,4) object to world, row-major; "
             "triangles (t,3) i32; triangle_polygon (t,) i32; triangle_material (t,) i32, slots; "
             "slot_materials: material of each slot; uv (t,3,2) f32; corner_normals (t,3,3) f32, "
             "object space")
        .def("add_blocker", &add_blocker_arrays, "name"_a, py::kw_only(), "positions"_a, "matrix"_a,
             "triangles"_a,
             "A mesh that is not rendered and cuts every link between patches that crosses it; "
             "arrays as in add_mesh")
        .def("add_lamp", &add_lamp, "name"_a, py::kw_only(), "type"_a, "matrix"_a, "color"_a,
             "radius"_a = 0.0F, "spot_angle"_a = 0.0F, "spot_blend"_a = 0.0F,
             "spot_cosine"_a = false, "sun_angle"_a = 0.0F, "shape"_a = "RECTANGLE",
             "size_x"_a = 1.0F, "size_y"_a = 1.0F, "visible_to_camera"_a = false, "spread"_a = kPi,
             "type: POINT, SPOT, SUN or AREA; color: colour x W (SUN: W/m2); lengths in m, full "
             "angles in rad; shape: RECTANGLE or ELLIPSE")
        .def(
            "set_background",
            [](Scene& scene, const py::object& radiance) {
                scene.background = to_vec3(radiance, "background");
            },
            "radiance"_a, "Radiance, W/(m2 sr), where the camera sees no surface")
        .def(
            "add_warning",
            [](Scene& scene, std::string text) { scene.warnings.push_back(std::move(text)); },
            "text"_a, "For the report, beside the core's own warnings")
        .def_property_readonly("triangle_count",
                               [](const Scene& scene) { return scene.triangles.size(); });
}

}  // namespace antiradiance
