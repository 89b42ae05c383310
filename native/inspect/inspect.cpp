// SPDX-License-Identifier: GPL-3.0-or-later
#include "inspect/inspect.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "base/random.h"
#include "display/camera_rays.h"
#include "display/gbuffer.h"
#include "inspect/leaf_values.h"

namespace antiradiance {

namespace {

constexpr float kLeastResidual = 1e-6F;  // black in the heat map
constexpr float kFullDifference = 0.5F;  // of the mean irradiance: the strongest blue and red
constexpr vec3 kDarker(0.02F, 0.08F, 0.8F);
constexpr vec3 kBrighter(0.8F, 0.03F, 0.02F);
constexpr float kGrazing = 0.5F;  // of the colour where a shaded surface is seen edge on
constexpr float kOutline = 0.3F;  // of the colour at the outline of a patch

vec3 colour_of_node(NodeId node) {
    const std::uint32_t hash = hash_u32(static_cast<std::uint32_t>(node));
    const float hue = to_unit_float(hash);
    const float lightness = 0.4F + 0.4F * to_unit_float(hash_u32(hash));
    const vec3 phase = 2 * kPi * (hue + vec3(0, 1, 2) / 3.0F);
    return lightness * (0.55F + 0.45F * glm::cos(phase));
}

vec3 colour_of_radiance(float radiance) {
    return radiance < 0 ? vec3(-radiance, 0, 0) : vec3(radiance);
}

vec3 colour_of_residual(float residual) {
    const float decades = std::log10(std::max(residual, kLeastResidual) / kLeastResidual);
    const float heat = decades / -std::log10(kLeastResidual);
    return glm::clamp(3 * heat - vec3(0, 1, 2), vec3(0), vec3(1));
}

vec3 colour_of_difference(float difference) {
    const float strength = std::min(1.0F, std::abs(difference) / kFullDifference);
    return glm::mix(vec3(1), difference < 0 ? kDarker : kBrighter, strength);
}

// One colour for the value of each leaf.
template <typename Value, typename Colour>
std::vector<vec3> colours(const PatchTree& tree, const std::vector<Value>& values,
                          const Colour& colour) {
    std::vector<vec3> result(tree.size(), vec3(0));
    for (const NodeId leaf : tree.leaves)
        result[static_cast<std::size_t>(leaf)] = colour(values[static_cast<std::size_t>(leaf)]);
    return result;
}

struct Asked {
    const SolvedScene& solved;
    const InspectOptions& options;
    const SolvedScene* explicit_solution;
};

Inspection refuse(const Asked&, Progress&) {
    throw std::invalid_argument("there is nothing to inspect when inspection is off");
}

Inspection hierarchy(const Asked& asked, Progress&) {
    const PatchTree& tree = asked.solved.model->tree;
    Inspection result;
    result.patch.assign(tree.size(), kNone);
    for (const NodeId leaf : tree.leaves)
        result.patch[static_cast<std::size_t>(leaf)] = ancestor(tree, leaf, asked.options.level);
    result.colour = colours(tree, result.patch, colour_of_node);
    result.shaded = true;
    return result;
}

Inspection incoming_bin(const Asked& asked, Progress& progress) {
    const float solid_angle = asked.solved.links().bins.mean_solid_angle();
    return {.colour = colours(asked.solved.model->tree,
                              bin_irradiance(asked.solved, asked.options.bin, progress),
                              [&](const vec3& irradiance) {
                                  return colour_of_radiance(luminance(irradiance) / solid_angle);
                              })};
}

Inspection residual(const Asked& asked, Progress& progress) {
    return {.colour = colours(asked.solved.model->tree, residuals(asked.solved, progress),
                              colour_of_residual)};
}

Inspection explicit_difference(const Asked& asked, Progress& progress) {
    if (!asked.explicit_solution)
        throw std::invalid_argument("the explicit solution to compare with is missing");
    return {
        .colour = colours(asked.solved.model->tree,
                          irradiance_differences(asked.solved, *asked.explicit_solution, progress),
                          colour_of_difference),
        .shaded = true};
}

std::vector<LegendEntry> no_legend() {
    return {};
}

std::vector<LegendEntry> legend_of_radiance() {
    return {{colour_of_radiance(1), "As much light as the picture shows white"},
            {colour_of_radiance(0.2F), "A fifth of that"},
            {colour_of_radiance(0), "None"},
            {colour_of_radiance(-0.5F), "Antiradiance takes back more than there is"}};
}

std::vector<LegendEntry> legend_of_residual() {
    return {{colour_of_residual(1), "1, the brightest patch itself"},
            {colour_of_residual(1e-2F), "0.01"},
            {colour_of_residual(1e-4F), "0.0001"},
            {colour_of_residual(1e-6F), "A millionth or less"}};
}

std::vector<LegendEntry> legend_of_difference() {
    return {{colour_of_difference(kFullDifference), "Brighter by half of the mean or more"},
            {colour_of_difference(kFullDifference / 2), "Brighter by a quarter"},
            {colour_of_difference(0), "The same"},
            {colour_of_difference(-kFullDifference / 2), "Darker by a quarter"},
            {colour_of_difference(-kFullDifference), "Darker by half of the mean or more"}};
}

struct Mode {
    EnumItem item;
    Inspection (*inspect)(const Asked&, Progress&);
    std::vector<LegendEntry> (*legend)();
};
// By InspectMode.
constexpr std::array<Mode, 5> kModes{{
    {{"OFF", "Picture", "The picture itself"}, refuse, no_legend},
    {{"HIERARCHY", "Hierarchy", "The patches of one level, each in a colour of its own"},
     hierarchy,
     no_legend},
    {{"INCOMING_BIN", "Incoming Bin",
      "Light that links bring to each patch in one direction bin, in grey; red where antiradiance "
      "takes back more than there is"},
     incoming_bin,
     legend_of_radiance},
    {{"RESIDUAL", "Residual",
      "What one more pass over the links would change: black below a millionth of the brightest "
      "patch, then red, yellow and white on a logarithmic scale"},
     residual,
     legend_of_residual},
    {{"EXPLICIT_DIFFERENCE", "Explicit Difference",
      "Indirect light beside that of Visibility Explicit: blue where it is darker, red where it is "
      "brighter, at full strength by half of the mean irradiance"},
     explicit_difference,
     legend_of_difference},
}};

constexpr std::array<EnumItem, kModes.size()> items_of_modes() {
    std::array<EnumItem, kModes.size()> items;
    std::ranges::transform(kModes, items.begin(), &Mode::item);
    return items;
}
constexpr auto kItems = items_of_modes();

// The patch that fills most of each pixel; kNone: none does.  // #pixels
std::vector<NodeId> patches_seen(const GBuffer& buffer, const std::vector<NodeId>& patch) {
    std::vector<NodeId> seen(buffer.depth.size(), kNone);
    std::vector<float> coverage(seen.size(), 0);
    for (const Fragment& f : buffer.fragments) {
        if (f.coverage <= coverage[f.pixel]) continue;
        coverage[f.pixel] = f.coverage;
        seen[f.pixel] = f.leaf == kNone ? kNone : patch[static_cast<std::size_t>(f.leaf)];
    }
    return seen;
}

// Darkens each pixel whose right or upper neighbour shows another patch.
void draw_outlines(const std::vector<NodeId>& seen, Picture& picture) {
    const auto at = [&](int x, int y) {
        return static_cast<std::size_t>(std::min(y, picture.height - 1)) *
                   static_cast<std::size_t>(picture.width) +
               static_cast<std::size_t>(std::min(x, picture.width - 1));
    };
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const NodeId own = seen[at(x, y)];
            if (seen[at(x + 1, y)] == own && seen[at(x, y + 1)] == own) continue;
            vec4& pixel = picture.combined[at(x, y)];
            pixel = vec4(kOutline * vec3(pixel), pixel.w);
        }
    }
}

// 1 where a surface faces the viewer.
float shade(const Fragment& f, const GBuffer& buffer, const Camera& camera,
            const CameraRays& rays) {
    const auto pixel = static_cast<int>(f.pixel);
    const ivec2 corner(camera.x0 + pixel % buffer.width, camera.y0 + pixel / buffer.width);
    const float cosine =
        std::abs(glm::dot(f.shading_normal, rays.at(vec2(corner) + 0.5F).direction));
    return glm::mix(kGrazing, 1.0F, cosine);
}

}  // namespace

std::span<const EnumItem> inspect_modes() {
    return kItems;
}

std::vector<LegendEntry> legend(InspectMode mode) {
    return kModes.at(static_cast<std::size_t>(mode)).legend();
}

Inspection inspect(const SolvedScene& solved, const InspectOptions& options,
                   const SolvedScene* explicit_solution, Progress& progress) {
    return kModes.at(static_cast<std::size_t>(options.mode))
        .inspect({solved, options, explicit_solution}, progress);
}

Picture draw(const SolvedScene& solved, const Inspection& inspection, const Camera& camera,
             int samples_per_axis, Progress& progress) {
    const StageInput& input = *solved.input;
    const Model& model = *solved.model;
    GBuffer buffer = make_gbuffer({.scene = input.scene,
                                   .camera = camera,
                                   .rays = model.rays,
                                   .tree = model.tree,
                                   .direct = nullptr,
                                   .leaf_direct = {},
                                   .irradiance = {},
                                   .by_leaf = true,
                                   .film_transparent = input.film_transparent,
                                   .samples_per_axis = samples_per_axis,
                                   .direct_samples = 0},
                                  progress, {});
    Picture picture;
    picture.width = buffer.width;
    picture.height = buffer.height;
    for (const vec4& beyond : buffer.background)
        picture.combined.emplace_back(0, 0, 0, beyond.w);
    const CameraRays rays(camera);
    for (const Fragment& f : buffer.fragments) {
        vec3 colour(0);
        if (f.leaf != kNone) colour = inspection.colour[static_cast<std::size_t>(f.leaf)];
        if (inspection.shaded) colour *= shade(f, buffer, camera, rays);
        picture.combined[f.pixel] += f.coverage * vec4(colour, 1);
    }
    if (!inspection.patch.empty()) draw_outlines(patches_seen(buffer, inspection.patch), picture);
    picture.depth = std::move(buffer.depth);
    picture.normal = std::move(buffer.normal);
    return picture;
}

}  // namespace antiradiance
