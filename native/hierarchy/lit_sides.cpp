// SPDX-License-Identifier: GPL-3.0-or-later
#include "hierarchy/lit_sides.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "base/parallel.h"
#include "base/random.h"

namespace antiradiance {

namespace {

constexpr int kFewestPaths = 24;       // from a side that emits or sees the sun
constexpr int kMostPaths = 384;        // from a side
constexpr int kPathsForAll = 200'000;  // shared out by area
constexpr std::size_t kFewestLampPaths = 1024;
constexpr std::size_t kMostLampPaths = 16'384;  // of a lamp
constexpr std::size_t kPathsForAllLamps = 500'000;
constexpr std::size_t kBlock = 64;  // paths or sides that a thread takes at once
constexpr std::size_t kMostBounces = 8;
// One path alone may have slipped through the seam of two walls.
constexpr std::uint32_t kPathsToLight = 2;
constexpr int kViews = 16;        // from a side that no path has met
constexpr int kViewsToLight = 4;  // of light
constexpr int kMostRounds = 4;    // in which sides get light from those of the round before

using Side = std::int32_t;  // 2 * polygon + (back ? 1 : 0)

vec2 random_point(std::uint32_t seed, std::uint32_t index) {
    return {to_unit_float(hash_combine(seed, 2 * index)),
            to_unit_float(hash_combine(seed, 2 * index + 1))};
}

class SideLight {
public:
    SideLight(const Scene& scene, const RayScene& rays, const std::vector<Polygon>& polygons)
        : scene_(scene),
          rays_(rays),
          polygons_(polygons),
          polygon_of_(scene.triangles.size()),
          paths_(polygons.size() * 2, 0) {
        for (std::size_t p = 0; p < polygons.size(); ++p) {
            for (const TriangleId t : polygons[p].triangles) {
                if (t != kNone)
                    polygon_of_[static_cast<std::size_t>(t)] = static_cast<std::int32_t>(p);
            }
            total_area_ += glm::length(polygons[p].area_vector());
        }
        has_sun_ = std::any_of(scene.lamps.begin(), scene.lamps.end(),
                               [](const Lamp& lamp) { return lamp.type == LampType::kSun; });
    }

    [[nodiscard]] std::size_t side_count() const { return paths_.size(); }
    [[nodiscard]] bool lit(std::size_t side) const { return paths_[side] >= kPathsToLight; }

    // Paths from a side that emits, and from its points that see a sun.
    void light_from(Side side) {
        const float share = glm::length(polygon(side).area_vector()) / total_area_;
        const int count =
            std::clamp(static_cast<int>(share * kPathsForAll), kFewestPaths, kMostPaths);
        const bool emitting = emits(side);
        if (!emitting && !has_sun_) return;
        if (emitting) add(side, kPathsToLight);
        const Frame frame(normal(side));
        for (int i = 0; i < count; ++i) {
            const auto index = static_cast<std::uint32_t>(i);
            const std::uint32_t seed = hash_combine(static_cast<std::uint32_t>(side), index);
            const vec3 origin = point(side, random_point(seed, 0));
            if (!emitting) {
                if (!sees_sun(origin, frame.n)) continue;
                add(side, 1);
            }
            follow(origin, frame.to_world(cosine_hemisphere(random_point(seed, 1))), seed);
        }
    }

    // Path `index` of a lamp that is no sun.
    void light_from(const Lamp& lamp, std::uint32_t lamp_index, std::uint32_t index) {
        const Frame frame(glm::normalize(-vec3(lamp.to_world[2])));
        const vec2 u = r2_sample(index, 2 * lamp_index + 1);
        vec3 origin(lamp.to_world[3]);
        vec3 direction;
        if (lamp.type == LampType::kArea) {
            const std::uint32_t seed = hash_combine(lamp_index, index);
            const vec2 s = random_point(seed, 99) - 0.5F;
            origin += vec3(lamp.to_world[0]) * (s.x * lamp.size.x) +
                      vec3(lamp.to_world[1]) * (s.y * lamp.size.y);
            direction = frame.to_world(cosine_hemisphere(u));
        } else {
            const float z = lamp.type == LampType::kSpot
                                ? 1 - u.x * (1 - std::cos(std::min(lamp.spot_angle, kPi) / 2))
                                : 1 - 2 * u.x;
            const float r = std::sqrt(std::max(0.0F, 1 - z * z));
            direction =
                frame.to_world({r * std::cos(2 * kPi * u.y), r * std::sin(2 * kPi * u.y), z});
        }
        follow(origin, direction, hash_combine(~lamp_index, index));
    }

    // For sides too small for paths to meet: whether enough of what they see is lit. The point seen
    // must itself see something lit, or the open: a floor is lit as a whole, but not below a block
    // that stands on it, from where only the block's inside sees it.
    [[nodiscard]] bool sees_light(Side side, std::uint32_t round) const {
        int views = 0;
        for (std::uint32_t i = 0; i < kViews; ++i) {
            const std::uint32_t seed =
                hash_combine(static_cast<std::uint32_t>(side), kViews * round + i);
            const Frame frame(normal(side));
            const vec3 origin = point(side, random_point(seed, 0));
            const vec3 direction = frame.to_world(cosine_hemisphere(random_point(seed, 1)));
            const RayHit seen = rays_.intersect(origin, direction);
            if (!seen.hit() || !lit(static_cast<std::size_t>(side_of(seen)))) continue;
            const Frame there(normal(side_of(seen)));
            const RayHit next =
                rays_.intersect(point_at(origin, direction, seen),
                                there.to_world(cosine_hemisphere(random_point(seed, 2))));
            if (!next.hit() || lit(static_cast<std::size_t>(side_of(next)))) ++views;
        }
        return views >= kViewsToLight;
    }
    void set_lit(Side side) { paths_[static_cast<std::size_t>(side)] = kPathsToLight; }

private:
    [[nodiscard]] const Polygon& polygon(Side side) const {
        return polygons_[static_cast<std::size_t>(side / 2)];
    }
    [[nodiscard]] Side side_of(const RayHit& hit) const {
        return 2 * polygon_of_[static_cast<std::size_t>(hit.triangle)] + (hit.back_side ? 1 : 0);
    }
    [[nodiscard]] vec3 normal(Side side) const {
        const vec3 n = glm::normalize(polygon(side).area_vector());
        return side % 2 ? -n : n;
    }
    // A little above the side.
    [[nodiscard]] vec3 point(Side side, const vec2& u) const {
        const auto& c = polygon(side).corners;
        vec3 p;
        if (polygon(side).corner_count == 4) {
            p = glm::mix(glm::mix(c[0], c[1], u.x), glm::mix(c[3], c[2], u.x), u.y);
        } else {
            const float root = std::sqrt(u.x);
            p = c[0] * (1 - root) + c[1] * (root * (1 - u.y)) + c[2] * (root * u.y);
        }
        return p + normal(side) * (2 * rays_.epsilon());
    }
    [[nodiscard]] vec3 point_at(const vec3& origin, const vec3& direction,
                                const RayHit& hit) const {
        return origin + direction * hit.distance + normal(side_of(hit)) * (2 * rays_.epsilon());
    }

    [[nodiscard]] bool emits(Side side) const {
        const auto t = static_cast<std::size_t>(polygon(side).triangles[0]);
        return scene_.materials[static_cast<std::size_t>(scene_.triangle_material[t])].emits();
    }
    [[nodiscard]] bool sees_sun(const vec3& origin, const vec3& n) const {
        return std::any_of(scene_.lamps.begin(), scene_.lamps.end(), [&](const Lamp& lamp) {
            if (lamp.type != LampType::kSun) return false;
            const vec3 to_sun = glm::normalize(vec3(lamp.to_world[2]));
            return glm::dot(to_sun, n) > 0 && rays_.escapes(origin, to_sun);
        });
    }

    void add(Side side, std::uint32_t paths) {
        std::atomic_ref(paths_[static_cast<std::size_t>(side)])
            .fetch_add(paths, std::memory_order_relaxed);
    }
    // Counts a path for every side that it meets, reflecting it as a white diffuse surface would.
    void follow(vec3 origin, vec3 direction, std::uint32_t seed) {
        std::array<Side, kMostBounces> met;
        for (std::uint32_t bounce = 0; bounce < kMostBounces; ++bounce) {
            const RayHit hit = rays_.intersect(origin, direction);
            if (!hit.hit()) return;
            const Side side = side_of(hit);
            if (std::find(met.begin(), met.begin() + bounce, side) == met.begin() + bounce)
                add(side, 1);
            met[bounce] = side;
            const Frame frame(normal(side));
            origin = point_at(origin, direction, hit);
            direction = frame.to_world(cosine_hemisphere(random_point(seed, 2 + bounce)));
        }
    }

    const Scene& scene_;
    const RayScene& rays_;
    const std::vector<Polygon>& polygons_;
    std::vector<std::int32_t> polygon_of_;  // #triangles
    std::vector<std::uint32_t> paths_;      // #sides: light paths that have met it
    float total_area_ = 0;
    bool has_sun_ = false;
};

// Sides that see light in spite of having met no path; true when there were any.
bool light_by_views(SideLight& light, std::uint32_t round, Progress& progress) {
    std::vector<char> found(light.side_count(), 0);
    parallel_for_blocks(light.side_count(), kBlock, progress,
                        [&](std::size_t begin, std::size_t end) {
                            for (std::size_t side = begin; side < end; ++side) {
                                if (!light.lit(side))
                                    found[side] = light.sees_light(static_cast<Side>(side), round);
                            }
                        });
    for (std::size_t side = 0; side < found.size(); ++side) {
        if (found[side]) light.set_lit(static_cast<Side>(side));
    }
    return std::find(found.begin(), found.end(), 1) != found.end();
}

}  // namespace

std::vector<std::array<bool, 2>> find_lit_sides(const Scene& scene, const RayScene& rays,
                                                const std::vector<Polygon>& polygons,
                                                Progress& progress) {
    SideLight light(scene, rays, polygons);
    const std::size_t lamp_paths =
        std::clamp(kPathsForAllLamps / std::max<std::size_t>(1, scene.lamps.size()),
                   kFewestLampPaths, kMostLampPaths);
    for (std::size_t i = 0; i < scene.lamps.size(); ++i) {
        const Lamp& lamp = scene.lamps[i];
        if (lamp.type == LampType::kSun || max_component(lamp.power) <= 0) continue;
        parallel_for_blocks(lamp_paths, kBlock, progress, [&](std::size_t begin, std::size_t end) {
            for (std::size_t path = begin; path < end; ++path)
                light.light_from(lamp, static_cast<std::uint32_t>(i),
                                 static_cast<std::uint32_t>(path));
        });
    }
    parallel_for_blocks(light.side_count(), kBlock, progress,
                        [&](std::size_t begin, std::size_t end) {
                            for (std::size_t side = begin; side < end; ++side)
                                light.light_from(static_cast<Side>(side));
                        });
    for (std::uint32_t round = 0; round < kMostRounds; ++round) {
        if (!light_by_views(light, round, progress)) break;
    }

    std::vector<std::array<bool, 2>> result(polygons.size());
    for (std::size_t p = 0; p < polygons.size(); ++p)
        result[p] = {light.lit(2 * p), light.lit(2 * p + 1)};
    return result;
}

}  // namespace antiradiance
