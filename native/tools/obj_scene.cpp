// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/obj_scene.h"

#include <tiny_obj_loader.h>

#include <algorithm>
#include <filesystem>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <set>
#include <span>
#include <sstream>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "base/error.h"
#include "tools/obj_materials.h"
#include "tools/obj_text.h"
#include "tools/triangulate.h"

namespace antiradiance {

namespace {

namespace fs = std::filesystem;

constexpr NumericStatement kNumbers[] = {{"v", 3}, {"vn", 3}, {"vt", 1}};

// Numbers of names, in the order in which they appear.
class Names {
public:
    std::int32_t number_of(const std::string& name) {
        const auto [at, is_new] =
            numbers_.try_emplace(name, static_cast<std::int32_t>(list_.size()));
        if (is_new) list_.push_back(name);
        return at->second;
    }
    [[nodiscard]] const std::vector<std::string>& list() const { return list_; }

private:
    std::vector<std::string> list_;
    std::unordered_map<std::string, std::int32_t> numbers_;
};

// Numbers count from 0; kNone: the face gives none; others may lie beyond what the file holds.
struct Corner {
    std::int64_t position = kNone;
    std::int64_t uv = kNone;
    std::int64_t normal = kNone;
};

struct Face {
    std::size_t begin, end;  // into ObjFile::corners
    std::int32_t object;     // into ObjFile::objects
    std::int32_t material;   // into ObjFile::materials; kNone: none
};

// The statements of a file that matter here, filled by tinyobjloader's callbacks: these keep
// polygons of any size whole, where its arrays hold triangles, or polygons of up to 255 corners.
struct ObjFile {
    std::vector<vec3> positions;
    std::vector<vec2> uvs;
    std::vector<vec3> normals;
    std::vector<Corner> corners;
    std::vector<Face> faces;
    Names objects;
    Names materials;

    explicit ObjFile(const std::string& text, std::string unnamed) : unnamed_(std::move(unnamed)) {
        tinyobj::callback_t callbacks;
        callbacks.vertex_cb = [](void* self, float x, float y, float z, float) {
            of(self).positions.emplace_back(x, y, z);
        };
        callbacks.texcoord_cb = [](void* self, float x, float y, float) {
            of(self).uvs.emplace_back(x, y);
        };
        callbacks.normal_cb = [](void* self, float x, float y, float z) {
            of(self).normals.emplace_back(x, y, z);
        };
        callbacks.index_cb = [](void* self, tinyobj::index_t* indices, int count) {
            of(self).add_face({indices, static_cast<std::size_t>(count)});
        };
        callbacks.usemtl_cb = [](void* self, const char* name, int) {
            of(self).material_ = trimmed(name);
        };
        callbacks.object_cb = [](void* self, const char* name) {
            of(self).object_ = trimmed(name);
            of(self).group_.clear();
        };
        callbacks.group_cb = [](void* self, const char** names, int count) {
            of(self).group_.clear();
            for (int i = 0; i < count; ++i)
                of(self).group_.append(i > 0 ? " " : "").append(names[i]);
        };
        std::istringstream stream(text);
        std::string warning;
        std::string error;
        tinyobj::LoadObjWithCallback(stream, callbacks, this, nullptr, &warning, &error);
    }

private:
    static ObjFile& of(void* self) { return *static_cast<ObjFile*>(self); }

    static std::string trimmed(const char* name) {
        std::string text(name);
        text.erase(text.find_last_not_of(" \t") + 1);
        return text;
    }

    // OBJ counts from 1, and backwards from the last one so far with negative numbers. 0 is what
    // tinyobjloader hands over for one that is left out, and never valid for a position.
    static std::int64_t absolute(int index, std::size_t count) {
        if (index == 0) return kNone;
        const std::int64_t zero_based =
            index > 0 ? index - 1LL : static_cast<std::int64_t>(count) + index;
        return zero_based < 0 ? std::numeric_limits<std::int64_t>::max() : zero_based;
    }

    void add_face(std::span<const tinyobj::index_t> indices) {
        const std::size_t begin = corners.size();
        for (const tinyobj::index_t& i : indices) {
            corners.push_back({absolute(i.vertex_index, positions.size()),
                               absolute(i.texcoord_index, uvs.size()),
                               absolute(i.normal_index, normals.size())});
        }
        const std::string separator = object_.empty() || group_.empty() ? "" : "/";
        const std::string name = object_ + separator + group_;
        faces.push_back({begin, corners.size(), objects.number_of(name.empty() ? unnamed_ : name),
                         material_.empty() ? kNone : materials.number_of(material_)});
    }

    std::string unnamed_;  // what faces before any `o` or `g` belong to
    // What the statements `o`, `g` and `usemtl` said last:
    std::string object_;
    std::string group_;
    std::string material_;
};

// One object's triangles on their way into a scene.
struct ObjectMesh {
    std::vector<vec3> positions;
    std::vector<uvec3> triangles;
    std::vector<std::int32_t> polygons;
    std::vector<std::int32_t> slots;
    std::vector<std::array<vec2, 3>> uvs;
    std::vector<std::array<vec3, 3>> normals;
    std::int32_t polygon_count = 0;
    std::size_t broken = 0;  // faces that name what the file does not hold
    std::size_t thin = 0;    // faces with less than three corners
};

class SceneBuilder {
public:
    SceneBuilder(const ObjFile& file, Scene& scene)
        : file_(file), scene_(scene), meshes_(file.objects.list().size()) {}

    void add_objects(const std::vector<std::int32_t>& slot_materials, float scale) {
        for (const Face& face : file_.faces)
            add_face(face);
        for (std::size_t o = 0; o < meshes_.size(); ++o)
            add_object(file_.objects.list()[o], meshes_[o], slot_materials, scale);
    }

private:
    [[nodiscard]] bool is_broken(const Corner& c) const {
        const auto holds = [](const auto& array, std::int64_t i) {
            return i < static_cast<std::int64_t>(array.size());
        };
        return c.position == kNone || !holds(file_.positions, c.position) ||
               !holds(file_.uvs, c.uv) || !holds(file_.normals, c.normal);
    }

    void add_face(const Face& face) {
        ObjectMesh& mesh = meshes_[static_cast<std::size_t>(face.object)];
        const std::span<const Corner> corners(file_.corners.data() + face.begin,
                                              face.end - face.begin);
        if (std::any_of(corners.begin(), corners.end(),
                        [this](const Corner& c) { return is_broken(c); })) {
            ++mesh.broken;
            return;
        }
        if (corners.size() < 3) {
            ++mesh.thin;
            return;
        }
        std::vector<vec3> positions;
        for (const Corner& c : corners)
            positions.push_back(file_.positions[static_cast<std::size_t>(c.position)]);
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), positions.begin(), positions.end());
        for (const uvec3& t : triangulate(positions)) {
            mesh.triangles.push_back(t + first);
            mesh.polygons.push_back(mesh.polygon_count);
            // One slot beyond the named ones is for faces without a material.
            mesh.slots.push_back(face.material == kNone
                                     ? static_cast<std::int32_t>(file_.materials.list().size())
                                     : face.material);
            mesh.uvs.emplace_back();
            mesh.normals.emplace_back();
            for (int i = 0; i < 3; ++i) {
                const Corner& c = corners[t[i]];
                const auto k = static_cast<std::size_t>(i);
                if (c.uv != kNone) mesh.uvs.back()[k] = file_.uvs[static_cast<std::size_t>(c.uv)];
                mesh.normals.back()[k] =
                    c.normal == kNone ? vec3(0) : file_.normals[static_cast<std::size_t>(c.normal)];
            }
        }
        ++mesh.polygon_count;
    }

    void add_object(const std::string& name, const ObjectMesh& mesh,
                    const std::vector<std::int32_t>& slot_materials, float scale) {
        const auto faces = [](std::size_t n) {
            return std::to_string(n) + (n == 1 ? " face has " : " faces have ");
        };
        if (mesh.broken > 0) {
            scene_.problems.push_back(
                "Object '" + name + "': " + faces(mesh.broken) +
                "corners that name vertices, texture coordinates or normals which the file does "
                "not hold; export it again");
        }
        if (mesh.thin > 0) {
            scene_.warnings.push_back("Object '" + name + "': " + faces(mesh.thin) +
                                      "less than three corners and no part in the picture");
        }
        if (mesh.triangles.empty()) return;
        MeshInput input;
        input.object_name = name;
        input.positions = mesh.positions.data();
        input.position_count = mesh.positions.size();
        input.to_world = glm::scale(mat4(1), vec3(scale));
        input.triangles = mesh.triangles.data();
        input.triangle_count = mesh.triangles.size();
        input.triangle_polygon = mesh.polygons.data();
        input.triangle_material = mesh.slots.data();
        input.slot_materials = slot_materials;
        input.uv = mesh.uvs.data();
        input.normals = mesh.normals.data();
        add_mesh(scene_, input);
    }

    const ObjFile& file_;
    Scene& scene_;
    std::vector<ObjectMesh> meshes_;  // #objects of the file
};

// mtllib takes several names; one with spaces in it is common all the same.
std::vector<std::string> material_files(const std::string& folder, std::string_view names) {
    const auto inside = [&](const std::string& name) { return (fs::path(folder) / name).string(); };
    if (fs::exists(inside(std::string(names)))) return {inside(std::string(names))};
    std::vector<std::string> files;
    std::istringstream words{std::string(names)};
    for (std::string word; words >> word;)
        files.push_back(inside(word));
    return files;
}

// False, with the problems left in the scene, when some could not be read.
bool read_materials(const ObjText& text, const std::string& path, ObjMaterials& materials,
                    Scene& scene) {
    bool complete = true;
    std::set<std::string> read;
    for (const ObjText::Line& line : text.lines()) {
        if (line.keyword != "mtllib") continue;
        for (const std::string& file :
             material_files(fs::path(path).parent_path().string(), line.rest)) {
            if (!read.insert(file).second) continue;
            try {
                materials.read_file(file);
            } catch (const SceneError& error) {
                complete = false;
                scene.problems.push_back("'" + path + "', line " + std::to_string(line.number) +
                                         ": the material file " + error.what());
            }
        }
    }
    return complete;
}

}  // namespace

Scene read_obj(const std::string& path, float scale) {
    const ObjText text(path);
    Scene scene;
    scene.problems = text.bad_numbers(kNumbers);
    ObjMaterials materials(scene);
    const bool complete = read_materials(text, path, materials, scene);

    const ObjFile file(text.text(), fs::path(path).stem().string());
    std::vector<std::int32_t> slot_materials;
    for (const std::string& name : file.materials.list()) {
        slot_materials.push_back(materials.find(name));
        if (slot_materials.back() == kNone && complete) {
            scene.problems.push_back("The material '" + name + "' is in none of the material " +
                                     "files (mtllib) that '" + path + "' names");
        }
    }
    if (std::any_of(file.faces.begin(), file.faces.end(),
                    [](const Face& f) { return f.material == kNone; }))
        slot_materials.push_back(kNone);

    SceneBuilder(file, scene).add_objects(slot_materials, scale);
    if (file.faces.empty())
        scene.problems.push_back("'" + path + "' holds no faces: there is nothing to render");
    return scene;
}

}  // namespace antiradiance
