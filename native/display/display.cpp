// SPDX-License-Identifier: GPL-3.0-or-later
#include "display/display.h"

#include <stdexcept>

#include "display/gbuffer.h"

namespace antiradiance {

namespace {

// The part of the display's progress that the G-buffer and direct light take.
constexpr float kGBufferShare = 0.9F;

// Indirect irradiance of every fragment, W/m2.
using IndirectLight = std::vector<vec3> (*)(const DisplayInput&, const GBuffer&, Progress&);

// "No interpolation" in the paper's Fig. 9.
std::vector<vec3> patch_irradiance(const DisplayInput& input, const GBuffer& buffer, Progress&) {
    std::vector<vec3> irradiance(buffer.fragments.size(), vec3(0));
    for (std::size_t i = 0; i < irradiance.size(); ++i) {
        const NodeId leaf = buffer.fragments[i].leaf;
        if (leaf != kNone) irradiance[i] = input.irradiance[static_cast<std::size_t>(leaf)];
    }
    return irradiance;
}

struct Mode {
    DisplayMode mode;
    IndirectLight indirect;
};
constexpr Mode kModes[] = {
    {DisplayMode::kPatches, &patch_irradiance},
};

IndirectLight indirect_light_of(DisplayMode mode) {
    for (const Mode& m : kModes) {
        if (m.mode == mode) return m.indirect;
    }
    throw std::logic_error("a display mode without a row in kModes");
}

}  // namespace

Picture make_picture(const DisplayInput& input, DisplayMode mode, Progress& progress) {
    GBuffer buffer = make_gbuffer({input.scene, input.rays, input.tree, input.direct,
                                   input.film_transparent, input.samples_per_axis},
                                  progress, {0, kGBufferShare});
    const std::vector<vec3> indirect = indirect_light_of(mode)(input, buffer, progress);
    Picture picture;
    picture.width = buffer.width;
    picture.height = buffer.height;
    picture.combined = std::move(buffer.background);
    picture.depth = std::move(buffer.depth);
    picture.normal = std::move(buffer.normal);
    for (std::size_t i = 0; i < buffer.fragments.size(); ++i) {
        const Fragment& f = buffer.fragments[i];
        const vec3 radiance = f.light + f.albedo * kInvPi * indirect[i];
        picture.combined[f.pixel] += f.coverage * vec4(radiance, 1);
    }
    progress.report(1);
    return picture;
}

}  // namespace antiradiance
