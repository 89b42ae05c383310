// SPDX-License-Identifier: GPL-3.0-or-later
#include "hierarchy/growing_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "hierarchy/surfaces.h"

namespace antiradiance {

namespace {

// How much a spread of normals (0..2 along an axis) weighs against a spread of positions, in units
// of the cluster's size: surfaces that face different ways part before far ones do.
constexpr float kNormalWeight = 0.35F;

vec2 mid(const vec2& a, const vec2& b) {
    return 0.5F * (a + b);
}

float edge_length(const GrowingNode& n, int i) {
    const auto a = static_cast<std::size_t>(i);
    const auto b = static_cast<std::size_t>((i + 1) % n.corner_count);
    return glm::distance(n.corners[a], n.corners[b]);
}

// The children's regions: 4 alike, or 2 where the patch is elongated.
std::vector<PatchRegion> child_regions(const GrowingNode& n) {
    const auto& c = n.region.corners;
    if (n.corner_count == 4) {
        const float u = 0.5F * (edge_length(n, 0) + edge_length(n, 2));
        const float v = 0.5F * (edge_length(n, 1) + edge_length(n, 3));
        const vec2 low = c[0];
        const vec2 high = c[2];
        const vec2 m = mid(low, high);
        const auto rectangle = [](vec2 a, vec2 b) {
            return PatchRegion{{a, vec2(b.x, a.y), b, vec2(a.x, b.y)}};
        };
        if (u > GrowingTree::kElongated * v)
            return {rectangle(low, {m.x, high.y}), rectangle({m.x, low.y}, high)};
        if (v > GrowingTree::kElongated * u)
            return {rectangle(low, {high.x, m.y}), rectangle({low.x, m.y}, high)};
        return {rectangle(low, m), rectangle({m.x, low.y}, {high.x, m.y}),
                rectangle({low.x, m.y}, {m.x, high.y}), rectangle(m, high)};
    }

    int longest = 0;
    for (int i = 1; i < 3; ++i) {
        if (edge_length(n, i) > edge_length(n, longest)) longest = i;
    }
    const float length = edge_length(n, longest);
    const float height = 2 * n.area / std::max(length, std::numeric_limits<float>::min());
    const auto triangle = [](vec2 a, vec2 b, vec2 d) { return PatchRegion{{a, b, d, d}}; };
    if (length > 2 * GrowingTree::kElongated * height) {
        const vec2 a = c[static_cast<std::size_t>(longest)];
        const vec2 b = c[static_cast<std::size_t>((longest + 1) % 3)];
        const vec2 d = c[static_cast<std::size_t>((longest + 2) % 3)];
        return {triangle(a, mid(a, b), d), triangle(mid(a, b), b, d)};
    }
    const vec2 ab = mid(c[0], c[1]);
    const vec2 bc = mid(c[1], c[2]);
    const vec2 ca = mid(c[2], c[0]);
    return {triangle(c[0], ab, ca), triangle(ab, c[1], bc), triangle(ca, bc, c[2]),
            triangle(bc, ca, ab)};
}

vec3 point_on(const Surface& s, const vec2& uv) {
    if (s.corner_count == 4) {
        return glm::mix(glm::mix(s.corners[0], s.corners[1], uv.x),
                        glm::mix(s.corners[3], s.corners[2], uv.x), uv.y);
    }
    return s.corners[0] * (1 - uv.x - uv.y) + s.corners[1] * uv.x + s.corners[2] * uv.y;
}

// Position and normal as one point whose widest axis a cluster is split along.
struct ClusterKey {
    std::array<float, 6> k;
};

ClusterKey cluster_key(const Surface& s, float normal_scale) {
    const vec3 c = surface_center(s);
    const vec3 n = glm::normalize(surface_area_vector(s)) * normal_scale;
    return {{c.x, c.y, c.z, n.x, n.y, n.z}};
}

}  // namespace

GrowingTree::GrowingTree(std::vector<Surface> surfaces) : surfaces_(std::move(surfaces)) {
    nodes_.reserve(surfaces_.size() * 4);
    std::vector<SurfaceId> members(surfaces_.size());
    std::iota(members.begin(), members.end(), 0);
    nodes_.emplace_back();
    build_cluster(kRoot, members, 0, members.size());
}

void GrowingTree::build_cluster(NodeId cluster, std::vector<SurfaceId>& members, std::size_t begin,
                                std::size_t end) {
    // The root stays a cluster even above one surface, so that self pairs always start at one.
    if (end - begin == 1 && cluster != kRoot) {
        make_surface_node(cluster, members[begin]);
        return;
    }
    vec3 low(std::numeric_limits<float>::max());
    vec3 high(-low);
    vec3 weighted_center(0);
    vec3 area_vector(0);
    float area = 0;
    for (std::size_t i = begin; i < end; ++i) {
        const Surface& s = surfaces_[static_cast<std::size_t>(members[i])];
        const vec3 a = surface_area_vector(s);
        const vec3 c = surface_center(s);
        low = glm::min(low, c);
        high = glm::max(high, c);
        area += glm::length(a);
        area_vector += a;
        weighted_center += glm::length(a) * c;
    }
    GrowingNode& n = nodes_[static_cast<std::size_t>(cluster)];
    n.center = weighted_center / area;
    n.area = area;
    const float mean_length = glm::length(area_vector);
    n.normal = mean_length > 1e-4F * area ? area_vector / mean_length : vec3(0);
    n.cone_cosine = n.normal == vec3(0) ? -1.0F : 1.0F;
    for (std::size_t i = begin; i < end; ++i) {
        const Surface& s = surfaces_[static_cast<std::size_t>(members[i])];
        n.cone_cosine =
            std::min(n.cone_cosine, glm::dot(n.normal, glm::normalize(surface_area_vector(s))));
        for (int k = 0; k < s.corner_count; ++k)
            n.radius =
                std::max(n.radius, glm::distance(n.center, s.corners[static_cast<std::size_t>(k)]));
    }

    if (end - begin == 1) {
        const auto child = static_cast<NodeId>(nodes_.size());
        n.first_child = child;
        n.child_count = 1;
        nodes_.emplace_back().parent = cluster;
        make_surface_node(child, members[begin]);
        return;
    }

    const float normal_scale = kNormalWeight * max_component(high - low);
    std::array<float, 6> key_low, key_high;
    key_low.fill(std::numeric_limits<float>::max());
    key_high.fill(std::numeric_limits<float>::lowest());
    for (std::size_t i = begin; i < end; ++i) {
        const ClusterKey key =
            cluster_key(surfaces_[static_cast<std::size_t>(members[i])], normal_scale);
        for (std::size_t a = 0; a < 6; ++a) {
            key_low[a] = std::min(key_low[a], key.k[a]);
            key_high[a] = std::max(key_high[a], key.k[a]);
        }
    }
    std::size_t axis = 0;
    for (std::size_t a = 1; a < 6; ++a) {
        if (key_high[a] - key_low[a] > key_high[axis] - key_low[axis]) axis = a;
    }
    const float border = 0.5F * (key_low[axis] + key_high[axis]);
    const auto first = members.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last = members.begin() + static_cast<std::ptrdiff_t>(end);
    const auto axis_key = [&](SurfaceId s) {
        return cluster_key(surfaces_[static_cast<std::size_t>(s)], normal_scale).k[axis];
    };
    auto middle =
        std::stable_partition(first, last, [&](SurfaceId s) { return axis_key(s) < border; });
    if (middle == first || middle == last) middle = first + (last - first) / 2;

    const auto child = static_cast<NodeId>(nodes_.size());
    nodes_[static_cast<std::size_t>(cluster)].first_child = child;
    nodes_[static_cast<std::size_t>(cluster)].child_count = 2;
    nodes_.emplace_back().parent = cluster;
    nodes_.emplace_back().parent = cluster;
    const auto split = static_cast<std::size_t>(middle - members.begin());
    build_cluster(child, members, begin, split);
    build_cluster(child + 1, members, split, end);
}

void GrowingTree::make_surface_node(NodeId id, SurfaceId surface) {
    GrowingNode& n = nodes_[static_cast<std::size_t>(id)];
    const Surface& s = surfaces_[static_cast<std::size_t>(surface)];
    n.surface = surface;
    n.corner_count = s.corner_count;
    n.normal = glm::normalize(surface_area_vector(s));
    n.emits_only = s.lamp != kNone;
    if (s.corner_count == 4) {
        n.region.corners = {vec2(0, 0), vec2(1, 0), vec2(1, 1), vec2(0, 1)};
    } else {
        n.region.corners = {vec2(0, 0), vec2(1, 0), vec2(0, 1), vec2(0, 1)};
    }
    set_patch_geometry(n);
}

void GrowingTree::set_patch_geometry(GrowingNode& n) const {
    const Surface& s = surfaces_[static_cast<std::size_t>(n.surface)];
    vec3 sum(0);
    for (int i = 0; i < n.corner_count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        n.corners[k] = point_on(s, n.region.corners[k]);
        sum += n.corners[k];
    }
    n.center = sum / static_cast<float>(n.corner_count);
    for (int i = 0; i < n.corner_count; ++i) {
        n.radius =
            std::max(n.radius, glm::distance(n.center, n.corners[static_cast<std::size_t>(i)]));
        n.longest_edge = std::max(n.longest_edge, edge_length(n, i));
    }
    const vec3 area_vector =
        n.corner_count == 4
            ? 0.5F * glm::cross(n.corners[2] - n.corners[0], n.corners[3] - n.corners[1])
            : 0.5F * glm::cross(n.corners[1] - n.corners[0], n.corners[2] - n.corners[0]);
    n.area = glm::length(area_vector);
}

void GrowingTree::split(NodeId leaf) {
    const std::vector<PatchRegion> regions = child_regions(node(leaf));
    const auto first = static_cast<NodeId>(nodes_.size());
    const GrowingNode parent = node(leaf);
    for (const PatchRegion& region : regions) {
        GrowingNode& child = nodes_.emplace_back();
        child.region = region;
        child.corner_count = parent.corner_count;
        child.surface = parent.surface;
        child.parent = leaf;
        child.normal = parent.normal;
        child.emits_only = parent.emits_only;
        set_patch_geometry(child);
    }
    GrowingNode& n = nodes_[static_cast<std::size_t>(leaf)];
    n.first_child = first;
    n.child_count = static_cast<std::int32_t>(regions.size());
}

void GrowingTree::split_to(float max_edge) {
    for (NodeId n = 0; n < static_cast<NodeId>(nodes_.size()); ++n) {  // nodes_ grows as we go
        if (node(n).is_leaf() && node(n).longest_edge > max_edge) split(n);
    }
}

GrowingTree::Estimate GrowingTree::estimate_patches(std::span<const Surface> surfaces,
                                                    float max_edge) {
    Estimate estimate;
    std::map<std::int32_t, double> of_object;
    for (const Surface& s : surfaces) {
        double longest = 0;
        for (int i = 0; i < s.corner_count; ++i) {
            longest = std::max(longest,
                               static_cast<double>(glm::distance(
                                   s.corners[static_cast<std::size_t>(i)],
                                   s.corners[static_cast<std::size_t>((i + 1) % s.corner_count)])));
        }
        // Halvings until the longest edge fits; elongated shapes need fewer leaves than a square's.
        const double halvings = std::max(0.0, std::ceil(std::log2(longest / max_edge)));
        const double width =
            (s.corner_count == 4 ? 1.0 : 2.0) * static_cast<double>(surface_area(s)) / longest;
        const double across = std::max(0.0, std::ceil(std::log2(width / max_edge)));
        const double leaves = std::exp2(halvings + std::min(halvings, across));
        const double patches = leaves * 4 / 3 + 1;
        estimate.patches += patches;
        of_object[s.object] += patches;
    }
    for (const auto& [object, patches] : of_object) {
        if (patches > estimate.largest_object_patches) {
            estimate.largest_object = object;
            estimate.largest_object_patches = patches;
        }
    }
    return estimate;
}

}  // namespace antiradiance
