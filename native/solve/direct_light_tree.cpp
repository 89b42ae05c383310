// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/direct_light_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace antiradiance {

namespace {

float angle_of(float cosine) {
    return std::acos(std::clamp(cosine, -1.0F, 1.0F));
}

}  // namespace

EmitterTree::EmitterTree(std::span<const EmitterBounds> bounds) {
    if (bounds.empty()) return;
    std::vector<std::int32_t> members(bounds.size());
    std::iota(members.begin(), members.end(), 0);
    nodes_.reserve(2 * bounds.size());
    build(bounds, members);
    leaf_.resize(bounds.size());
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
        if (nodes_[n].emitter != kNone)
            leaf_[static_cast<std::size_t>(nodes_[n].emitter)] = static_cast<std::int32_t>(n);
    }
}

EmitterTree::Node EmitterTree::merge(std::span<const EmitterBounds> bounds,
                                     std::span<const std::int32_t> members) {
    const auto at = [&](std::size_t i) -> const EmitterBounds& {
        return bounds[static_cast<std::size_t>(members[i])];
    };
    Node node;
    vec3 low(1e30F);
    vec3 high(-1e30F);
    vec3 axis(0);
    const vec3 first_axis = at(0).axis;
    for (std::size_t i = 0; i < members.size(); ++i) {
        const EmitterBounds& b = at(i);
        low = glm::min(low, b.center - b.radius);
        high = glm::max(high, b.center + b.radius);
        node.power += b.power;
        node.two_sided = node.two_sided || b.two_sided;
        node.cosine = node.cosine && b.cosine;
        const bool flip = b.two_sided && glm::dot(b.axis, first_axis) < 0;
        axis += (flip ? -b.axis : b.axis) * b.power;
    }
    node.center = (low + high) / 2.0F;
    const float length = glm::length(axis);
    node.axis = length > 0 ? axis / length : first_axis;
    for (std::size_t i = 0; i < members.size(); ++i) {
        const EmitterBounds& b = at(i);
        node.radius = std::max(node.radius, glm::distance(b.center, node.center) + b.radius);
        const float cosine = glm::dot(b.axis, node.axis);
        const float tilt = angle_of(b.two_sided ? std::abs(cosine) : cosine);
        node.spread = std::max(node.spread, tilt + angle_of(b.cos_spread));
        node.reach = std::max(node.reach, b.cosine ? kPi / 2 : 0.0F);
    }
    node.spread = std::min(node.spread, kPi);
    return node;
}

std::int32_t EmitterTree::build(std::span<const EmitterBounds> bounds,
                                std::span<std::int32_t> members) {
    const auto index = static_cast<std::int32_t>(nodes_.size());
    nodes_.push_back(merge(bounds, members));
    if (members.size() == 1) {
        nodes_.back().emitter = members[0];
        return index;
    }
    vec3 low(1e30F);
    vec3 high(-1e30F);
    for (const std::int32_t m : members) {
        low = glm::min(low, bounds[static_cast<std::size_t>(m)].center);
        high = glm::max(high, bounds[static_cast<std::size_t>(m)].center);
    }
    const vec3 extent = high - low;
    int axis = extent.x > extent.y ? 0 : 1;
    axis = extent.z > extent[axis] ? 2 : axis;
    const auto middle = members.begin() + static_cast<std::ptrdiff_t>(members.size() / 2);
    std::nth_element(members.begin(), middle, members.end(), [&](std::int32_t a, std::int32_t b) {
        const float ca = bounds[static_cast<std::size_t>(a)].center[axis];
        const float cb = bounds[static_cast<std::size_t>(b)].center[axis];
        return ca != cb ? ca < cb : a < b;
    });
    const std::size_t half = members.size() / 2;
    build(bounds, members.first(half));
    const std::int32_t second = build(bounds, members.subspan(half));
    nodes_[static_cast<std::size_t>(index)].second = second;
    return index;
}

double EmitterTree::importance(const Node& node, const ReceiverBounds& receivers) {
    const vec3 to = node.center - receivers.center;
    const float d = glm::length(to);
    const float radius = node.radius + receivers.radius;
    if (d <= radius)
        return static_cast<double>(node.power) / std::max(0.25F * radius * radius, 1e-12F);
    const float sigma = std::asin(radius / d);
    const float at_receiver = angle_of(glm::dot(to, receivers.normal) / d) - sigma;
    if (at_receiver >= kPi / 2) return 0;
    const float towards = -glm::dot(to, node.axis) / d;
    const float at_emitter =
        angle_of(node.two_sided ? std::abs(towards) : towards) - node.spread - sigma;
    if (at_emitter >= node.reach && at_emitter > 0) return 0;
    const float cos_receiver = std::cos(std::max(0.0F, at_receiver));
    const float cos_emitter = node.cosine ? std::cos(std::max(0.0F, at_emitter)) : 1.0F;
    return static_cast<double>(node.power) * cos_receiver * cos_emitter / (d * d);
}

void EmitterTree::choose(const ReceiverBounds& receivers, std::uint32_t count, float offset,
                         std::vector<EmitterChoice>& choices) const {
    choices.clear();
    if (nodes_.empty()) return;
    // A node holds the stretch [from, to) of the unit interval, and the samples in it.
    struct Stretch {
        std::int32_t node;
        double from, to;
        std::uint32_t begin, end;
    };
    std::vector<Stretch> stack{{0, 0.0, 1.0, 0, count}};
    while (!stack.empty()) {
        const Stretch s = stack.back();
        stack.pop_back();
        const Node& node = nodes_[static_cast<std::size_t>(s.node)];
        if (node.emitter != kNone) {
            choices.push_back({node.emitter, s.begin, s.end, s.to - s.from});
            continue;
        }
        const double first = importance(nodes_[static_cast<std::size_t>(s.node + 1)], receivers);
        const double second = importance(nodes_[static_cast<std::size_t>(node.second)], receivers);
        if (first + second <= 0) continue;
        const double cut = s.from + (s.to - s.from) * (first / (first + second));
        // The first sample at or beyond the cut.
        const double position = std::ceil(cut * count - static_cast<double>(offset));
        const auto middle = static_cast<std::uint32_t>(
            std::clamp(position, static_cast<double>(s.begin), static_cast<double>(s.end)));
        if (second > 0 && middle < s.end) stack.push_back({node.second, cut, s.to, middle, s.end});
        if (first > 0 && s.begin < middle) {
            stack.push_back({s.node + 1, s.from, cut, s.begin, middle});
        }
    }
}

double EmitterTree::probability(const ReceiverBounds& receivers, std::int32_t emitter) const {
    const std::int32_t leaf = leaf_[static_cast<std::size_t>(emitter)];
    double probability = 1;
    for (std::int32_t n = 0; n != leaf;) {
        const std::int32_t second = nodes_[static_cast<std::size_t>(n)].second;
        const double a = importance(nodes_[static_cast<std::size_t>(n + 1)], receivers);
        const double b = importance(nodes_[static_cast<std::size_t>(second)], receivers);
        if (a + b <= 0) return 0;
        probability *= (leaf < second ? a : b) / (a + b);
        n = leaf < second ? n + 1 : second;
    }
    return probability;
}

std::vector<std::int32_t> EmitterTree::emitters() const {
    std::vector<std::int32_t> emitters;
    for (const Node& node : nodes_) {
        if (node.emitter != kNone) emitters.push_back(node.emitter);
    }
    return emitters;
}

}  // namespace antiradiance
