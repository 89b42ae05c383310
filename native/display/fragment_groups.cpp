// SPDX-License-Identifier: GPL-3.0-or-later
#include "display/fragment_groups.h"

#include <algorithm>
#include <numeric>

#include "links/cube_map.h"

namespace antiradiance {

namespace {

constexpr float kDepthJump = 1.15F;  // ratio of distances between which a tile is split

FragmentGroup make_group(const GBuffer& buffer, const std::vector<std::uint32_t>& order,
                         std::uint32_t begin, std::uint32_t end) {
    FragmentGroup group;
    group.begin = begin;
    group.end = end;
    for (std::uint32_t i = begin; i < end; ++i) {
        const Fragment& f = buffer.fragments[order[i]];
        group.center += f.position / static_cast<float>(end - begin);
        group.normal += f.shading_normal;
    }
    const float length = glm::length(group.normal);
    group.normal = length > 0 ? group.normal / length : vec3(0);
    group.cone_cosine = length > 0 ? 1.0F : -1.0F;
    for (std::uint32_t i = begin; i < end; ++i) {
        const Fragment& f = buffer.fragments[order[i]];
        group.radius = std::max(group.radius, glm::distance(f.position, group.center));
        group.cone_cosine = std::min(group.cone_cosine, glm::dot(f.shading_normal, group.normal));
    }
    return group;
}

// Cuts the order into groups wherever two neighbours in it are apart(i, i + 1).
template <typename Apart>
void cut_into_groups(const GBuffer& buffer, const Apart& apart, FragmentGroups& result) {
    const auto count = static_cast<std::uint32_t>(result.order.size());
    for (std::uint32_t begin = 0; begin < count;) {
        std::uint32_t end = begin + 1;
        while (end < count && !apart(end - 1, end))
            ++end;
        result.groups.push_back(make_group(buffer, result.order, begin, end));
        begin = end;
    }
}

}  // namespace

FragmentGroups tile_groups(const GBuffer& buffer, const vec3& eye, int tile_size) {
    struct Key {
        std::uint32_t tile;
        int side;
        float distance;
    };
    const auto across = static_cast<std::uint32_t>((buffer.width + tile_size - 1) / tile_size);
    const auto width = static_cast<std::uint32_t>(buffer.width);
    const auto size = static_cast<std::uint32_t>(tile_size);
    std::vector<Key> keys;
    keys.reserve(buffer.fragments.size());
    for (const Fragment& f : buffer.fragments) {
        const std::uint32_t tile = f.pixel / width / size * across + f.pixel % width / size;
        keys.push_back(
            {tile, cube_coordinate(f.shading_normal).face, glm::distance(f.position, eye)});
    }
    FragmentGroups result;
    result.order.resize(keys.size());
    std::iota(result.order.begin(), result.order.end(), 0U);
    std::sort(result.order.begin(), result.order.end(), [&](std::uint32_t i, std::uint32_t j) {
        const Key& a = keys[i];
        const Key& b = keys[j];
        if (a.tile != b.tile) return a.tile < b.tile;
        if (a.side != b.side) return a.side < b.side;
        return a.distance != b.distance ? a.distance < b.distance : i < j;
    });
    const auto apart = [&](std::uint32_t i, std::uint32_t j) {
        const Key& a = keys[result.order[i]];
        const Key& b = keys[result.order[j]];
        return a.tile != b.tile || a.side != b.side || b.distance > kDepthJump * a.distance;
    };
    cut_into_groups(buffer, apart, result);
    return result;
}

FragmentGroups receiver_groups(const GBuffer& buffer) {
    const auto leaf = [&](std::uint32_t i) { return buffer.fragments[i].leaf; };
    FragmentGroups result;
    for (std::uint32_t i = 0; i < buffer.fragments.size(); ++i) {
        if (leaf(i) != kNone) result.order.push_back(i);
    }
    std::stable_sort(result.order.begin(), result.order.end(),
                     [&](std::uint32_t i, std::uint32_t j) { return leaf(i) < leaf(j); });
    cut_into_groups(
        buffer,
        [&](std::uint32_t i, std::uint32_t j) {
            return leaf(result.order[i]) != leaf(result.order[j]);
        },
        result);
    return result;
}

}  // namespace antiradiance
