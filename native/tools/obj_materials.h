// SPDX-License-Identifier: GPL-3.0-or-later
// Wavefront MTL -> Scene's materials and textures.
#pragma once

#include <tiny_obj_loader.h>

#include <map>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace antiradiance {

// Kd is the albedo and Ke the emitted radiance; map_Kd and map_Ke multiply them. A map_Ke whose Ke
// is missing or 0 is the radiance itself. All else that an MTL file may say is no part of diffuse
// transport; transparency, which changes what is seen most, gets a warning.
class ObjMaterials {
public:
    // `scene` takes the materials, and problems and warnings about them.
    explicit ObjMaterials(Scene& scene) : scene_(scene) {}

    void read_file(const std::string& path);

    // Number of a material in the scene, to which it is added when it is first asked for, with its
    // textures: what no face shows may be missing. kNone: no file has it.
    std::int32_t find(const std::string& name);

private:
    struct Entry {
        tinyobj::material_t material;
        std::string file;
        std::int32_t number = kNone;  // into Scene::materials
    };
    std::int32_t add(Entry& entry);
    int texture_of(const Entry& entry, const std::string& name,
                   const tinyobj::texture_option_t& options);

    Scene& scene_;
    std::map<std::string, Entry> entries_;
    std::map<std::string, int> textures_;  // path -> Scene::textures
};

}  // namespace antiradiance
