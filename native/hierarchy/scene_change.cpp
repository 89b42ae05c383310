// SPDX-License-Identifier: GPL-3.0-or-later
#include "hierarchy/scene_change.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <string>
#include <tuple>
#include <unordered_map>

#include "base/random.h"

namespace antiradiance {

namespace {

// More boxes than these are taken as one: each is looked at for each line of sight.
constexpr std::size_t kMostBoxes = 16;
// Wider cones of sky are taken to be crossed.
constexpr float kWidestSky = 1;  // rad
// Of the largest coordinate, around what changed: surfaces that touch it count as changed.
constexpr float kMargin = 1e-4F;

// Cuts [begin, end] down to the t at which from + t (to - from) <= limit; false: nothing is left.
bool clip(float from, float to, float limit, float& begin, float& end) {
    const float slope = to - from;
    if (slope == 0) return from <= limit;
    const float t = (limit - from) / slope;
    (slope > 0 ? end : begin) = slope > 0 ? std::min(end, t) : std::max(begin, t);
    return begin <= end;
}

Box box_of(const Scene& scene, const Object& object) {
    Box box;
    for (TriangleId t = object.first_triangle; t < object.first_triangle + object.triangle_count;
         ++t) {
        for (const vec3& corner : scene.corners(t))
            box.add(corner);
    }
    if (object.triangle_count == 0) return box;
    const vec3 most = glm::max(glm::abs(box.low), glm::abs(box.high));
    box.low -= kMargin * max_component(most);
    box.high += kMargin * max_component(most);
    return box;
}

bool same_object(const Scene& a, const Object& in_a, const Scene& b, const Object& in_b) {
    if (in_a.triangle_count != in_b.triangle_count) return false;
    for (TriangleId t = 0; t < in_a.triangle_count; ++t) {
        if (a.corners(in_a.first_triangle + t) != b.corners(in_b.first_triangle + t)) return false;
    }
    return true;
}

std::map<std::string, std::vector<const Object*>> by_name(const Scene& scene) {
    std::map<std::string, std::vector<const Object*>> objects;
    for (const Object& object : scene.objects)
        objects[object.name].push_back(&object);
    return objects;
}

std::vector<Box> changed_boxes(const Scene& earlier, const Scene& now) {
    std::vector<Box> boxes;
    auto before = by_name(earlier);
    for (const auto& [name, objects] : by_name(now)) {
        std::vector<const Object*>& twins = before[name];
        for (std::size_t i = 0; i < objects.size(); ++i) {
            const Object* twin = i < twins.size() ? twins[i] : nullptr;
            if (twin && same_object(earlier, *twin, now, *objects[i])) {
                twins[i] = nullptr;
            } else {
                boxes.push_back(box_of(now, *objects[i]));
            }
        }
    }
    for (const auto& [name, objects] : before) {
        for (const Object* object : objects) {
            if (object) boxes.push_back(box_of(earlier, *object));
        }
    }
    return boxes;
}

// Node boxes, from the leaves up.
std::vector<Box> node_boxes(const PatchTree& tree) {
    std::vector<Box> boxes(tree.size());
    for (std::size_t n = tree.size(); n-- > 0;) {
        const auto id = static_cast<NodeId>(n);
        if (!tree.is_cluster(id)) {
            const auto corners = tree.patch_corners(id);
            for (int c = 0; c < tree.corner_count(id); ++c)
                boxes[n].add(corners[static_cast<std::size_t>(c)]);
        }
        if (tree.parent[n] != kNone) boxes[static_cast<std::size_t>(tree.parent[n])].add(boxes[n]);
    }
    return boxes;
}

auto shape(const PatchTree& tree, std::size_t n) {
    const vec3& c = tree.center[n];
    const vec3& d = tree.normal[n];
    return std::tuple(c.x, c.y, c.z, d.x, d.y, d.z, tree.area[n], tree.radius[n], tree.exposed[n],
                      tree.exposed_mask[n], tree.emits_only(static_cast<NodeId>(n)),
                      tree.is_cluster(static_cast<NodeId>(n)));
}

std::uint32_t hash_of(const PatchTree& tree, std::size_t n) {
    std::uint32_t hash = std::bit_cast<std::uint32_t>(tree.area[n]);
    for (int k = 0; k < 3; ++k) {
        hash = hash_combine(hash, std::bit_cast<std::uint32_t>(tree.center[n][k]));
        // Positive zero: -0 is the same normal.
        hash = hash_combine(hash, std::bit_cast<std::uint32_t>(tree.normal[n][k] + 0.0F));
    }
    return hash;
}

}  // namespace

bool may_cross(const Box& from, const Box& to, const Box& obstacle) {
    // At t of the way the hull lies between bounds that are linear in t, on each axis.
    float begin = 0;
    float end = 1;
    for (int k = 0; k < 3; ++k) {
        if (!clip(from.low[k], to.low[k], obstacle.high[k], begin, end) ||
            !clip(-from.high[k], -to.high[k], -obstacle.low[k], begin, end))
            return false;
    }
    return true;
}

SceneChange::SceneChange(const Scene& earlier, const PatchTree& earlier_tree, const Scene& now,
                         const PatchTree& now_tree)
    : changed_(changed_boxes(earlier, now)),
      earlier_(now_tree.size(), kNone),
      boxes_(node_boxes(now_tree)) {
    for (const Box& box : changed_)
        all_changed_.add(box);
    if (changed_.size() > kMostBoxes) changed_ = {all_changed_};

    std::unordered_map<std::uint32_t, NodeId> known;
    known.reserve(earlier_tree.size());
    for (std::size_t n = 0; n < earlier_tree.size(); ++n)
        known.emplace(hash_of(earlier_tree, n), static_cast<NodeId>(n));
    for (std::size_t n = 0; n < now_tree.size(); ++n) {
        const auto twin = known.find(hash_of(now_tree, n));
        if (twin != known.end() &&
            shape(earlier_tree, static_cast<std::size_t>(twin->second)) == shape(now_tree, n))
            earlier_[n] = twin->second;
    }
}

bool SceneChange::may_be_between(const Box& from, const Box& to) const {
    return std::ranges::any_of(changed_, [&](const Box& box) { return may_cross(from, to, box); });
}

bool SceneChange::may_be_before_sky(const Box& from, const vec3& direction, float angle) const {
    if (changed_.empty()) return false;
    if (angle > kWidestSky) return true;
    Box reach = from;
    reach.add(all_changed_);
    // Beyond all that changed.
    const float distance = 2 * glm::length(reach.high - reach.low) / std::cos(angle);
    Box sky = from;
    sky.low += direction * distance - distance * std::tan(angle);
    sky.high += direction * distance + distance * std::tan(angle);
    return may_be_between(from, sky);
}

}  // namespace antiradiance
