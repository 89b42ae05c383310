// SPDX-License-Identifier: GPL-3.0-or-later
// Chooses among many emitters by the light that each can bring (Conty Estevez and Kulla,
// "Importance Sampling of Many Lights with Adaptive Tree Splitting", 2018).
#pragma once

#include <span>
#include <vector>

#include "solve/direct_light_emitter.h"

namespace antiradiance {

// Receivers that share one choice of emitters.
struct ReceiverBounds {
    vec3 center{0};    // m
    float radius = 0;  // m
    vec3 normal{0};    // unit
};

// Samples [begin, end) of the stratified sequence fell on one emitter.
struct EmitterChoice {
    std::int32_t emitter = kNone;
    std::uint32_t begin = 0, end = 0;
    double probability = 0;  // of the emitter, per sample
};

class EmitterTree {
public:
    EmitterTree() = default;
    // Indices in choices are those of `bounds`.
    explicit EmitterTree(std::span<const EmitterBounds> bounds);

    // Distributes the samples (i + offset) / count, i < count, over the emitters that can light the
    // receivers; samples that would go to none are left out. offset: 0..1.
    void choose(const ReceiverBounds& receivers, std::uint32_t count, float offset,
                std::vector<EmitterChoice>& choices) const;

    // Of an emitter, as choose() takes it.
    [[nodiscard]] double probability(const ReceiverBounds& receivers, std::int32_t emitter) const;

    // All emitters, neighbours one after the other.
    [[nodiscard]] std::vector<std::int32_t> emitters() const;

private:
    struct Node {
        vec3 center{0};
        float radius = 0;    // m
        float power = 0;     // W/sr, sum
        vec3 axis{0};        // unit
        float spread = 0;    // rad, normals lie within it about the axis
        float reach = 0;     // rad, beyond a normal, that still gets light
        bool cosine = true;  // every member emits with the cosine
        bool two_sided = false;
        std::int32_t emitter = kNone;  // leaf
        std::int32_t second = kNone;   // inner node: second child; the first is the next node
    };

    std::int32_t build(std::span<const EmitterBounds> bounds, std::span<std::int32_t> members);
    static Node merge(std::span<const EmitterBounds> bounds, std::span<const std::int32_t> members);
    static double importance(const Node& node, const ReceiverBounds& receivers);

    std::vector<Node> nodes_;         // preorder
    std::vector<std::int32_t> leaf_;  // of each emitter, into nodes_
};

}  // namespace antiradiance
