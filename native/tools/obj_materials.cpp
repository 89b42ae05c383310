// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/obj_materials.h"

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "base/error.h"
#include "tools/obj_text.h"
#include "tools/picture_file.h"

namespace antiradiance {

namespace {

constexpr NumericStatement kNumbers[] = {{"Kd", 3}, {"Ke", 3}};

vec3 to_vec3(const tinyobj::real_t (&rgb)[3]) {
    return {rgb[0], rgb[1], rgb[2]};
}

bool is_moved(const tinyobj::texture_option_t& o) {
    return to_vec3(o.origin_offset) != vec3(0) || to_vec3(o.scale) != vec3(1);
}

}  // namespace

void ObjMaterials::read_file(const std::string& path) {
    const ObjText file(path);
    const std::vector<std::string> bad = file.bad_numbers(kNumbers);
    scene_.problems.insert(scene_.problems.end(), bad.begin(), bad.end());

    std::map<std::string, int> numbers;
    std::vector<tinyobj::material_t> materials;
    std::string warning;
    std::string error;
    std::istringstream stream(file.text());
    tinyobj::LoadMtl(&numbers, &materials, &stream, &warning, &error);
    for (tinyobj::material_t& m : materials) {
        if (m.name.empty()) continue;  // what tinyobjloader makes of a file without materials
        const std::string name = m.name;
        entries_.try_emplace(name, Entry{std::move(m), path, kNone});
    }
}

std::int32_t ObjMaterials::find(const std::string& name) {
    const auto found = entries_.find(name);
    if (found == entries_.end()) return kNone;
    Entry& entry = found->second;
    if (entry.number == kNone) entry.number = add(entry);
    return entry.number;
}

std::int32_t ObjMaterials::add(Entry& entry) {
    const tinyobj::material_t& m = entry.material;
    if (m.dissolve < 1 || !m.alpha_texname.empty()) {
        scene_.warnings.push_back("Material '" + m.name +
                                  "': it is transparent (d or map_d) and was taken for opaque");
    }
    Material material{.name = m.name,
                      .albedo = to_vec3(m.diffuse),
                      .emission = to_vec3(m.emission),
                      .albedo_texture = texture_of(entry, m.diffuse_texname, m.diffuse_texopt),
                      .emission_texture = texture_of(entry, m.emissive_texname, m.emissive_texopt)};
    if (material.emission_texture != kNone && material.emission == vec3(0))
        material.emission = vec3(1);
    scene_.materials.push_back(std::move(material));
    return static_cast<std::int32_t>(scene_.materials.size()) - 1;
}

int ObjMaterials::texture_of(const Entry& entry, const std::string& name,
                             const tinyobj::texture_option_t& options) {
    if (name.empty()) return kNone;
    const std::string& material = entry.material.name;
    if (is_moved(options)) {
        scene_.warnings.push_back("Material '" + material + "': the texture '" + name +
                                  "' is placed without its options -o and -s");
    }
    std::string relative = name;
    std::replace(relative.begin(), relative.end(), '\\', '/');
    const std::string path =
        (std::filesystem::path(entry.file).parent_path() / relative).lexically_normal().string();
    const auto [known, is_new] = textures_.try_emplace(path, kNone);
    if (!is_new) return known->second;
    try {
        scene_.textures.push_back(read_texture(path));
        known->second = static_cast<int>(scene_.textures.size()) - 1;
    } catch (const SceneError& error) {
        scene_.problems.push_back("Material '" + material + "' of '" + entry.file +
                                  "': the texture '" + path + "' can't be read: " + error.what());
    }
    return known->second;
}

}  // namespace antiradiance
