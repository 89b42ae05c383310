// SPDX-License-Identifier: GPL-3.0-or-later
#include "hierarchy/lit_sides.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/random.h"

namespace antiradiance {

namespace {

constexpr int kFewestRays = 24;        // per side
constexpr int kMostRays = 384;         // per side
constexpr int kRaysForAll = 400'000;   // shared out by area
constexpr int kLampRays = 16'384;      // per lamp
constexpr int kFewestLampRays = 1024;  // where many lamps share
constexpr int kRaysForAllLamps = 500'000;
constexpr int kSunPoints = 8;  // per side and sun
// One ray alone may have slipped through the seam of two walls.
constexpr int kConnectionsToLight = 2;

using Side = std::int32_t;  // 2 * polygon + (back ? 1 : 0)

struct Connection {
    Side from, to;
    auto operator<=>(const Connection&) const = default;
};

class SideGraph {
public:
    SideGraph(const Scene& scene, const RayScene& rays, const std::vector<Polygon>& polygons)
        : scene_(scene), rays_(rays), polygons_(polygons), polygon_of_(scene.triangles.size()) {
        for (std::size_t p = 0; p < polygons.size(); ++p) {
            for (const TriangleId t : polygons[p].triangles) {
                if (t != kNone)
                    polygon_of_[static_cast<std::size_t>(t)] = static_cast<std::int32_t>(p);
            }
            total_area_ += glm::length(polygons[p].area_vector());
        }
    }

    [[nodiscard]] Side side_of(const RayHit& hit) const {
        return 2 * polygon_of_[static_cast<std::size_t>(hit.triangle)] + (hit.back_side ? 1 : 0);
    }

    [[nodiscard]] vec3 normal(Side side) const {
        const vec3 n = glm::normalize(polygon(side).area_vector());
        return side % 2 ? -n : n;
    }

    [[nodiscard]] vec3 point(Side side, const vec2& u) const {
        const auto& c = polygon(side).corners;
        vec3 p;
        if (polygon(side).corner_count == 4) {
            p = glm::mix(glm::mix(c[0], c[1], u.x), glm::mix(c[3], c[2], u.x), u.y);
        } else {
            const float root = std::sqrt(u.x);
            p = c[0] * (1 - root) + c[1] * (root * (1 - u.y)) + c[2] * (root * u.y);
        }
        return p + normal(side) * rays_.epsilon();
    }

    // What a side sees: appended to `out`, both ways.
    void look_around(Side side, std::vector<Connection>& out) const {
        const float share = glm::length(polygon(side).area_vector()) / total_area_;
        const int count =
            std::clamp(static_cast<int>(share * kRaysForAll / 2), kFewestRays, kMostRays);
        const Frame frame(normal(side));
        const auto seed = static_cast<std::uint32_t>(side);
        for (int i = 0; i < count; ++i) {
            const auto index = static_cast<std::uint32_t>(i);
            const vec3 direction = frame.to_world(cosine_hemisphere(r2_sample(index, 2 * seed)));
            const RayHit hit =
                rays_.intersect(point(side, r2_sample(index, 2 * seed + 1)), direction);
            if (!hit.hit()) continue;
            out.push_back({side, side_of(hit)});
            out.push_back({side_of(hit), side});
        }
    }

    [[nodiscard]] bool emits(Side side) const {
        const TriangleId t = polygon(side).triangles[0];
        return scene_
            .materials[static_cast<std::size_t>(
                scene_.triangle_material[static_cast<std::size_t>(t)])]
            .emits();
    }

    [[nodiscard]] bool sees_any_sun(Side side) const {
        return std::any_of(scene_.lamps.begin(), scene_.lamps.end(), [&](const Lamp& lamp) {
            return lamp.type == LampType::kSun && sees_sun(side, lamp);
        });
    }

    // Sides that a lamp's rays end on; in a room full of lamps each needs fewer of them, since what
    // one misses another finds, or the light that spreads from side to side.
    void shine(const Lamp& lamp, std::uint32_t index, std::vector<Side>& out) const {
        const Frame frame(glm::normalize(-vec3(lamp.to_world[2])));
        const vec3 x(lamp.to_world[0]);
        const vec3 y(lamp.to_world[1]);
        const auto lamps = static_cast<int>(scene_.lamps.size());
        const auto count = static_cast<std::uint32_t>(
            std::clamp(kRaysForAllLamps / lamps, kFewestLampRays, kLampRays));
        for (std::uint32_t i = 0; i < count; ++i) {
            const vec2 u = r2_sample(i, 2 * index + 1);
            vec3 origin(lamp.to_world[3]);
            vec3 direction;
            if (lamp.type == LampType::kArea) {
                const vec2 s = r2_sample(i, 2 * index) - 0.5F;
                origin += x * (s.x * lamp.size.x) + y * (s.y * lamp.size.y);
                direction = frame.to_world(cosine_hemisphere(u));
            } else {
                const float z = lamp.type == LampType::kSpot
                                    ? 1 - u.x * (1 - std::cos(std::min(lamp.spot_angle, kPi) / 2))
                                    : 1 - 2 * u.x;
                const float r = std::sqrt(std::max(0.0F, 1 - z * z));
                direction =
                    frame.to_world({r * std::cos(2 * kPi * u.y), r * std::sin(2 * kPi * u.y), z});
            }
            const RayHit hit = rays_.intersect(origin, direction);
            if (hit.hit()) out.push_back(side_of(hit));
        }
    }

private:
    [[nodiscard]] bool sees_sun(Side side, const Lamp& sun) const {
        const vec3 to_sun = glm::normalize(vec3(sun.to_world[2]));
        if (glm::dot(to_sun, normal(side)) <= 0) return false;
        for (std::uint32_t i = 0; i < kSunPoints; ++i) {
            const vec3 p = point(side, r2_sample(i, static_cast<std::uint32_t>(side)));
            if (rays_.escapes(p, to_sun)) return true;
        }
        return false;
    }

    [[nodiscard]] const Polygon& polygon(Side side) const {
        return polygons_[static_cast<std::size_t>(side / 2)];
    }

    const Scene& scene_;
    const RayScene& rays_;
    const std::vector<Polygon>& polygons_;
    std::vector<std::int32_t> polygon_of_;  // #triangles
    float total_area_ = 0;
};

// Lights sides from `seeds` along the connections (sorted by `from`).
std::vector<char> spread(std::size_t side_count, const std::vector<Connection>& connections,
                         const std::vector<Side>& seeds) {
    std::vector<char> lit(side_count, 0);
    std::vector<int> received(side_count, 0);
    std::vector<Side> work;
    const auto light = [&](Side side) {
        if (lit[static_cast<std::size_t>(side)]) return;
        lit[static_cast<std::size_t>(side)] = 1;
        work.push_back(side);
    };
    for (const Side s : seeds)
        light(s);
    while (!work.empty()) {
        const Side from = work.back();
        work.pop_back();
        auto c = std::lower_bound(connections.begin(), connections.end(), Connection{from, 0});
        for (; c != connections.end() && c->from == from; ++c) {
            if (++received[static_cast<std::size_t>(c->to)] >= kConnectionsToLight) light(c->to);
        }
    }
    return lit;
}

}  // namespace

std::vector<std::array<bool, 2>> find_lit_sides(const Scene& scene, const RayScene& rays,
                                                const std::vector<Polygon>& polygons,
                                                Progress& progress) {
    const SideGraph graph(scene, rays, polygons);
    const std::size_t side_count = polygons.size() * 2;

    constexpr std::size_t kBlock = 64;
    std::vector<std::vector<Connection>> found((side_count + kBlock - 1) / kBlock);
    parallel_for_blocks(side_count, kBlock, progress, [&](std::size_t begin, std::size_t end) {
        for (std::size_t side = begin; side < end; ++side)
            graph.look_around(static_cast<Side>(side), found[begin / kBlock]);
    });
    std::vector<Connection> connections;
    for (auto& block : found) {
        connections.insert(connections.end(), block.begin(), block.end());
        block = {};
    }
    std::sort(connections.begin(), connections.end());

    std::vector<std::vector<Side>> lit_by(scene.lamps.size());
    parallel_for(scene.lamps.size(), progress, [&](std::size_t i) {
        if (scene.lamps[i].type != LampType::kSun)
            graph.shine(scene.lamps[i], static_cast<std::uint32_t>(i), lit_by[i]);
    });
    std::vector<Side> seeds;
    for (const std::vector<Side>& sides : lit_by)
        seeds.insert(seeds.end(), sides.begin(), sides.end());
    std::vector<char> shines(side_count, 0);
    parallel_for_blocks(side_count, kBlock, progress, [&](std::size_t begin, std::size_t end) {
        for (std::size_t side = begin; side < end; ++side)
            shines[side] =
                graph.emits(static_cast<Side>(side)) || graph.sees_any_sun(static_cast<Side>(side));
    });
    for (std::size_t side = 0; side < side_count; ++side) {
        if (shines[side]) seeds.push_back(static_cast<Side>(side));
    }

    const std::vector<char> lit = spread(side_count, connections, seeds);
    std::vector<std::array<bool, 2>> result(polygons.size());
    for (std::size_t p = 0; p < polygons.size(); ++p)
        result[p] = {lit[2 * p] != 0, lit[2 * p + 1] != 0};
    return result;
}

}  // namespace antiradiance
