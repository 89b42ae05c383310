// SPDX-License-Identifier: GPL-3.0-or-later
#include "display/shared_receivers.h"

#include <algorithm>

namespace antiradiance {

namespace {

constexpr float kMostOfPixel = 0.5F;
constexpr float kAlike = 0.99F;  // cosine between shading normals: 8 degrees
constexpr std::uint32_t kNothing = 0xffffffffU;

class Neighbours {
public:
    Neighbours(const PatchTree& tree, const GBuffer& buffer)
        : tree_(tree), buffer_(buffer), first_(pixel_starts(buffer)) {}

    // The nearest fragment whose light `f` may show; kNothing: none.
    [[nodiscard]] std::uint32_t stand_in(const Fragment& f) const {
        const int x = static_cast<int>(f.pixel) % buffer_.width;
        const int y = static_cast<int>(f.pixel) / buffer_.width;
        std::uint32_t best = kNothing;
        float least = tree_.radius[static_cast<std::size_t>(f.leaf)];
        for (int v = std::max(0, y - 1); v <= std::min(buffer_.height - 1, y + 1); ++v) {
            for (int u = std::max(0, x - 1); u <= std::min(buffer_.width - 1, x + 1); ++u) {
                const auto pixel = static_cast<std::size_t>(v * buffer_.width + u);
                for (std::uint32_t i = first_[pixel]; i < first_[pixel + 1]; ++i) {
                    const Fragment& g = buffer_.fragments[i];
                    const float distance = glm::distance(f.position, g.position);
                    if (distance > least || !is_alike(f, g)) continue;
                    least = distance;
                    best = i;
                }
            }
        }
        return best;
    }

private:
    [[nodiscard]] bool is_alike(const Fragment& f, const Fragment& g) const {
        return g.coverage >= kMostOfPixel && g.leaf != kNone &&
               tree_.surface[static_cast<std::size_t>(f.leaf)] ==
                   tree_.surface[static_cast<std::size_t>(g.leaf)] &&
               glm::dot(f.shading_normal, g.shading_normal) >= kAlike;
    }

    const PatchTree& tree_;
    const GBuffer& buffer_;
    std::vector<std::uint32_t> first_;
};

}  // namespace

std::vector<vec3> SharedReceivers::spread(std::span<const vec3> values) const {
    std::vector<vec3> all;
    all.reserve(of.size());
    for (const std::uint32_t receiver : of)
        all.push_back(values[receiver]);
    return all;
}

SharedReceivers share_receivers(const PatchTree& tree, const GBuffer& buffer) {
    const Neighbours neighbours(tree, buffer);
    SharedReceivers shared;
    shared.receivers.width = buffer.width;
    shared.receivers.height = buffer.height;
    const std::size_t count = buffer.fragments.size();
    std::vector<std::uint32_t> stand_in(count, kNothing);
    shared.of.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const Fragment& f = buffer.fragments[i];
        if (f.coverage < kMostOfPixel && f.leaf != kNone) stand_in[i] = neighbours.stand_in(f);
        if (stand_in[i] != kNothing) continue;
        shared.of[i] = static_cast<std::uint32_t>(shared.receivers.fragments.size());
        shared.receivers.fragments.push_back(f);
    }
    for (std::size_t i = 0; i < count; ++i) {
        if (stand_in[i] != kNothing) shared.of[i] = shared.of[stand_in[i]];
    }
    return shared;
}

}  // namespace antiradiance
