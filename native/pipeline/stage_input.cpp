// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/stage_input.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>
#include <vector>

#include "pipeline/model.h"

namespace antiradiance {

namespace {

auto geometry(const Scene& scene) {
    return std::tie(scene.positions, scene.triangles, scene.triangle_polygon,
                    scene.triangle_material, scene.triangle_object);
}

// Of a lamp, what decides which surfaces its light can reach, and its own surface.
auto place(const Lamp& lamp) {
    const bool shines = max_component(lamp.power) > 0;
    return std::tuple(shines, lamp.type, lamp.to_world, lamp.spot_angle, lamp.shape, lamp.size);
}

// All that shadow rays need to know of a lamp beside its power.
auto light(const Lamp& lamp) {
    return std::tuple(lamp.type, lamp.to_world, lamp.radius, lamp.spot_angle, lamp.spot_blend,
                      lamp.spot_cosine, lamp.sun_angle, lamp.shape, lamp.size, lamp.spread);
}

template <typename Element, typename Read>
bool same(const std::vector<Element>& was, const std::vector<Element>& is, Read read) {
    return std::ranges::equal(was, is, {}, read, read);
}

bool same_texture(const Scene& was, int was_index, const Scene& is, int is_index) {
    if (was_index == kNone || is_index == kNone) return was_index == is_index;
    const Texture& a = was.textures[static_cast<std::size_t>(was_index)];
    const Texture& b = is.textures[static_cast<std::size_t>(is_index)];
    return a.width == b.width && a.height == b.height && a.pixels == b.pixels;
}

// Of all materials, with the coordinates. The stages before have compared which triangle has which
// material.
bool same_textures(const Scene& was, const Scene& is, int Material::*texture) {
    const auto same_one = [&](const Material& a, const Material& b) {
        return same_texture(was, a.*texture, is, b.*texture);
    };
    if (!std::ranges::equal(was.materials, is.materials, same_one)) return false;
    const bool has_texture = std::ranges::any_of(
        is.materials, [&](const Material& material) { return material.*texture != kNone; });
    return !has_texture || was.uv == is.uv;
}

// Of all materials: a constant, and the texture on it.
bool same_colours(const Scene& was, const Scene& is, vec3 Material::*constant,
                  int Material::*texture) {
    return std::ranges::equal(was.materials, is.materials, {}, constant, constant) &&
           same_textures(was, is, texture);
}

bool same_emission(const Scene& was, const Scene& is) {
    return same_colours(was, is, &Material::emission, &Material::emission_texture);
}

bool same_albedo(const Scene& was, const Scene& is) {
    return same_colours(was, is, &Material::albedo, &Material::albedo_texture);
}

auto model_options(const Options& o) {
    return std::tuple(o.visibility, o.direct_light, o.max_patch_size, o.link_threshold,
                      o.direction_bins, o.visibility_rays, needs_directions(o));
}

}  // namespace

bool same_model_input(const StageInput& was, const StageInput& is) {
    return was.coarseness == is.coarseness &&
           model_options(was.options) == model_options(is.options) &&
           geometry(was.scene) == geometry(is.scene) && was.scene.blockers == is.scene.blockers &&
           same(was.scene.objects, is.scene.objects, &Object::name) &&  // in warnings
           same(was.scene.materials, is.scene.materials, &Material::emits) &&
           same(was.scene.lamps, is.scene.lamps, place);
}

bool prunes(const Options& options) {
    return options.pruning != PruneMethod::kNone && options.has_antiradiance();
}

bool same_pruning_input(const StageInput& was, const StageInput& is) {
    const auto method = [](const Options& o) { return prunes(o) ? o.pruning : PruneMethod::kNone; };
    return method(was.options) == method(is.options) &&
           (method(is.options) == PruneMethod::kNone ||
            was.options.pruning_directions == is.options.pruning_directions);
}

bool same_direct_light_input(const StageInput& was, const StageInput& is) {
    // What IMPLICIT takes from shadow rays: emissive meshes and area lamps.
    const bool all = is.options.direct_light != DirectLightMode::kImplicit;
    const auto same_power = [all](const Lamp& a, const Lamp& b) {
        return (!all && b.type == LampType::kArea) || a.power == b.power;
    };
    return same_but_strength_of_lights(was, is) &&
           std::ranges::equal(was.scene.lamps, is.scene.lamps, same_power) &&
           (!all || same_emission(was.scene, is.scene));
}

bool same_lights(const StageInput& was, const StageInput& is) {
    const auto emitting = [](const Scene& scene) {
        std::vector<std::pair<std::int32_t, std::array<vec3, 3>>> triangles;
        for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
            const std::int32_t material = scene.triangle_material[t];
            if (scene.materials[static_cast<std::size_t>(material)].emits())
                triangles.emplace_back(material, scene.corners(static_cast<TriangleId>(t)));
        }
        return triangles;
    };
    return same_direct_light_input(was, is) &&
           (is.options.direct_light == DirectLightMode::kImplicit ||
            emitting(was.scene) == emitting(is.scene));
}

bool same_but_strength_of_lights(const StageInput& was, const StageInput& is) {
    const bool all = is.options.direct_light != DirectLightMode::kImplicit;
    const auto same_light = [all](const Lamp& a, const Lamp& b) {
        return (!all && b.type == LampType::kArea) || light(a) == light(b);
    };
    // Shadow maps leave out the inside of luminous meshes that reflect nothing.
    const bool maps = is.options.direct_light == DirectLightMode::kShadowMaps;
    return was.options.direct_light == is.options.direct_light &&
           (!maps || same_albedo(was.scene, is.scene)) &&
           std::ranges::equal(was.scene.lamps, is.scene.lamps, same_light) &&
           (!all || same_textures(was.scene, is.scene, &Material::emission_texture));
}

bool same_transport_input(const StageInput& was, const StageInput& is) {
    const auto choosing = [](const Options& o) {
        const bool mixed = o.visibility == Visibility::kMixed;
        return std::tuple(o.direct_light, o.remove_dark_links, mixed ? o.ray_budget : 0.0F);
    };
    return choosing(was.options) == choosing(is.options) && same_albedo(was.scene, is.scene) &&
           same_emission(was.scene, is.scene) &&
           same(was.scene.lamps, is.scene.lamps, &Lamp::power);  // area lamps that emit along links
}

bool same_solve_input(const StageInput& was, const StageInput& is) {
    const auto solving = [](const Options& o) { return std::tie(o.iterations, o.solver); };
    return solving(was.options) == solving(is.options);
}

bool same_evaluation_input(const StageInput& was, const StageInput& is) {
    return was.options.evaluate_pruning == is.options.evaluate_pruning &&
           (!is.options.evaluate_pruning ||
            was.options.pruning_directions == is.options.pruning_directions);
}

bool same_solution_input(const StageInput& was, const StageInput& is) {
    return same_model_input(was, is) && same_pruning_input(was, is) &&
           same_direct_light_input(was, is) && same_transport_input(was, is) &&
           same_solve_input(was, is) && same_evaluation_input(was, is);
}

bool same_picture_input(const StageInput& was, const StageInput& is) {
    const auto display = [](const Options& o) {
        return std::tuple(o.resolved_display(), o.display, o.solver);
    };
    return display(was.options) == display(is.options) &&
           was.film_transparent == is.film_transparent &&
           was.scene.background == is.scene.background && was.scene.uv == is.scene.uv &&
           was.scene.normals == is.scene.normals && same_albedo(was.scene, is.scene) &&
           same_emission(was.scene, is.scene) &&
           std::ranges::equal(was.scene.lamps, is.scene.lamps, [](const Lamp& a, const Lamp& b) {
               return light(a) == light(b) && a.visible_to_camera == b.visible_to_camera;
           });
}

}  // namespace antiradiance
