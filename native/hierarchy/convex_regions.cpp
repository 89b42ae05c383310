// SPDX-License-Identifier: GPL-3.0-or-later
#include "hierarchy/convex_regions.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "hierarchy/surfaces.h"
#include "hierarchy/vertex_weld.h"

namespace antiradiance {

namespace {

constexpr float kCoplanarCosine = 0.99985F;  // 1 degree
constexpr float kPlanar = 1e-5F;             // of the scene's extent
constexpr float kRounding = 1e-6F;           // of the scene's extent
constexpr std::size_t kMostCorners = 32;     // of a region: every edge costs time in every test
constexpr std::size_t kMostAtEdge = 8;       // polygons that are compared with one at its edge
constexpr int kMostRounds = 16;  // strips join in the second; ragged meshes gain little after it

using ShapeId = std::int32_t;

struct Shape {
    std::vector<VertexId> loop;  // counter-clockwise about the normal; empty: joined to another
    vec3 normal;                 // unit
    float area = 0;              // m2
};

struct SharedEdge {
    ShapeId a, b;
    VertexId from, to;  // as a has it; b has it the other way round
    float length;       // m
    std::uint64_t direction;
};

// Light is blocked from both sides: all polygons of a plane turn the same way, whichever way their
// fronts look. The reference lies off the planes that people build.
bool looks_away(const vec3& normal) {
    return glm::dot(normal, vec3(0.8017F, 0.3571F, 0.4788F)) < 0;
}

vec3 area_vector(std::span<const vec3> loop) {
    vec3 sum(0);
    for (std::size_t i = 2; i < loop.size(); ++i)
        sum += 0.5F * glm::cross(loop[i - 1] - loop[0], loop[i] - loop[0]);
    return sum;
}

class RegionMaker {
public:
    RegionMaker(const Scene& scene, float extent)
        : planar_(kPlanar * extent), vertices_(planar_), shape_of_(scene.triangles.size(), kNone) {
        for (const Polygon& polygon : make_polygons(scene))
            add(scene, polygon);
        for (int i = 0; i < kMostRounds; ++i) {
            if (!join_round()) break;
        }
    }

    [[nodiscard]] ConvexRegions regions(std::span<const Surface> surfaces) const {
        ConvexRegions result;
        result.tolerance = planar_ * (kRounding / kPlanar);
        std::vector<RegionId> region_of(shapes_.size(), kNone);
        for (std::size_t s = 0; s < shapes_.size(); ++s) {
            if (shapes_[s].loop.empty()) continue;
            region_of[s] = static_cast<RegionId>(result.regions.size());
            append(shapes_[s], result);
        }
        for (const Surface& surface : surfaces) {
            const TriangleId t = surface.triangles[0];
            const ShapeId shape = t == kNone ? kNone : shape_of_[static_cast<std::size_t>(t)];
            result.of_surface.push_back(
                shape == kNone ? kNone : region_of[static_cast<std::size_t>(joined(shape))]);
        }
        return result;
    }

private:
    // A quad that two triangles fold is no plane: they stay two.
    void add(const Scene& scene, const Polygon& polygon) {
        const std::span<const vec3> corners(polygon.corners.data(),
                                            static_cast<std::size_t>(polygon.corner_count));
        const vec3 normal = glm::normalize(area_vector(corners));
        const bool plane = std::all_of(corners.begin(), corners.end(), [&](const vec3& p) {
            return std::abs(glm::dot(normal, p - corners[0])) <= planar_;
        });
        if (plane) {
            const ShapeId shape = add_shape(corners);
            for (const TriangleId t : polygon.triangles) {
                if (t != kNone) shape_of_[static_cast<std::size_t>(t)] = shape;
            }
            return;
        }
        for (const TriangleId t : polygon.triangles) {
            if (t != kNone) shape_of_[static_cast<std::size_t>(t)] = add_shape(scene.corners(t));
        }
    }

    ShapeId add_shape(std::span<const vec3> corners) {
        const vec3 area = area_vector(corners);
        Shape shape;
        shape.area = glm::length(area);
        shape.normal = area / shape.area;
        for (const vec3& p : corners) {
            const VertexId v = vertices_.add(p);
            if (shape.loop.empty() || (v != shape.loop.back() && v != shape.loop.front()))
                shape.loop.push_back(v);
        }
        if (shape.loop.size() < 3 || !(shape.area > planar_ * planar_)) return kNone;
        if (looks_away(shape.normal)) {
            shape.normal = -shape.normal;
            std::reverse(shape.loop.begin(), shape.loop.end());
        }
        shapes_.push_back(std::move(shape));
        joined_to_.push_back(static_cast<ShapeId>(joined_to_.size()));
        return joined_to_.back();
    }

    [[nodiscard]] ShapeId joined(ShapeId s) const {
        while (joined_to_[static_cast<std::size_t>(s)] != s)
            s = joined_to_[static_cast<std::size_t>(s)];
        return s;
    }
    [[nodiscard]] Shape& shape(ShapeId s) { return shapes_[static_cast<std::size_t>(s)]; }

    // Joins across every edge that two shapes share as a whole; false: there was none.
    bool join_round() {
        bool any = false;
        for (const SharedEdge& e : shared_edges()) {
            const ShapeId a = joined(e.a);
            const ShapeId b = joined(e.b);
            if (a != b && join(a, b, e.from, e.to)) any = true;
        }
        return any;
    }

    // In the order in which to join across them: by direction, that with the most length first.
    [[nodiscard]] std::vector<SharedEdge> shared_edges() const {
        struct Edge {
            VertexId low, high;
            ShapeId shape;
            bool rising;
        };
        std::vector<Edge> edges;
        for (std::size_t s = 0; s < shapes_.size(); ++s) {
            const auto& loop = shapes_[s].loop;
            for (std::size_t i = 0; i < loop.size(); ++i) {
                const VertexId from = loop[i];
                const VertexId to = loop[(i + 1) % loop.size()];
                edges.push_back(
                    {std::min(from, to), std::max(from, to), static_cast<ShapeId>(s), from < to});
            }
        }
        std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
            if (a.low != b.low) return a.low < b.low;
            return a.high != b.high ? a.high < b.high : a.shape < b.shape;
        });
        std::vector<SharedEdge> shared;
        std::map<std::uint64_t, float> length_of;
        for (std::size_t i = 0; i < edges.size(); ++i) {
            const Edge& e = edges[i];
            for (std::size_t j = i + 1; j < std::min(edges.size(), i + 1 + kMostAtEdge); ++j) {
                const Edge& f = edges[j];
                if (f.low != e.low || f.high != e.high) break;
                if (e.rising == f.rising || !coplanar(e.shape, f.shape)) continue;
                const float length = glm::distance(vertices_[e.low], vertices_[e.high]);
                const std::uint64_t direction = direction_of(e.low, e.high);
                length_of[direction] += length;
                shared.push_back({e.shape, f.shape, e.rising ? e.low : e.high,
                                  e.rising ? e.high : e.low, length, direction});
            }
        }
        std::stable_sort(shared.begin(), shared.end(),
                         [&](const SharedEdge& a, const SharedEdge& b) {
                             if (a.direction != b.direction) {
                                 const float la = length_of.at(a.direction);
                                 const float lb = length_of.at(b.direction);
                                 return la != lb ? la > lb : a.direction < b.direction;
                             }
                             return a.length > b.length;
                         });
        return shared;
    }

    [[nodiscard]] std::uint64_t direction_of(VertexId from, VertexId to) const {
        vec3 d = glm::normalize(vertices_[to] - vertices_[from]);
        if (looks_away(d)) d = -d;
        std::uint64_t key = 0;
        for (int k = 0; k < 3; ++k)
            key = (key << 21U) | static_cast<std::uint64_t>(std::lround(d[k] * 1000) + 1024);
        return key;
    }

    // Against the larger one's plane: that of each neighbour in turn would follow a curve.
    [[nodiscard]] bool coplanar(ShapeId a, ShapeId b) const {
        const Shape& x = shapes_[static_cast<std::size_t>(a)];
        const Shape& y = shapes_[static_cast<std::size_t>(b)];
        const Shape& large = x.area >= y.area ? x : y;
        const Shape& small = x.area >= y.area ? y : x;
        if (glm::dot(x.normal, y.normal) < kCoplanarCosine) return false;
        const vec3& origin = vertices_[large.loop[0]];
        return std::all_of(small.loop.begin(), small.loop.end(), [&](VertexId v) {
            return std::abs(glm::dot(large.normal, vertices_[v] - origin)) <= planar_;
        });
    }

    bool join(ShapeId a, ShapeId b, VertexId from, VertexId to) {
        if (!coplanar(a, b)) return false;
        std::vector<VertexId> loop = joined_loop(shape(a), shape(b), from, to);
        if (loop.size() < 3 || loop.size() > kMostCorners) return false;
        const ShapeId kept = shape(a).area >= shape(b).area ? a : b;
        const ShapeId gone = kept == a ? b : a;
        shape(kept).area += shape(gone).area;
        shape(kept).loop = std::move(loop);
        shape(gone).loop.clear();
        joined_to_[static_cast<std::size_t>(gone)] = kept;
        return true;
    }

    // Around both; empty where they no longer share the whole edge or the union is not convex.
    [[nodiscard]] std::vector<VertexId> joined_loop(const Shape& a, const Shape& b, VertexId from,
                                                    VertexId to) const {
        const auto starts_at = [](const Shape& s, VertexId v, VertexId next) -> std::size_t {
            for (std::size_t i = 0; i < s.loop.size(); ++i) {
                if (s.loop[i] == v && s.loop[(i + 1) % s.loop.size()] == next) return i;
            }
            return s.loop.size();
        };
        const std::size_t i = starts_at(a, from, to);
        const std::size_t j = starts_at(b, to, from);
        const std::size_t n = a.loop.size();
        const std::size_t m = b.loop.size();
        if (i == n || j == m) return {};
        std::vector<VertexId> loop;  // from `to` around a to `from`, then the rest of b
        for (std::size_t k = 1; k <= n; ++k)
            loop.push_back(a.loop[(i + k) % n]);
        for (std::size_t k = 2; k < m; ++k)
            loop.push_back(b.loop[(j + k) % m]);
        // The two ends of the edge; the later place first, so that the other stays where it is.
        for (const std::size_t place : {n - 1, std::size_t{0}}) {
            const Turn turn = turn_at(loop, place, a.normal);
            if (turn == Turn::kConcave) return {};
            if (turn == Turn::kStraight)
                loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(place));
        }
        return loop;
    }

    enum class Turn { kConvex, kStraight, kConcave };
    [[nodiscard]] Turn turn_at(const std::vector<VertexId>& loop, std::size_t i,
                               const vec3& normal) const {
        const vec3& before = vertices_[loop[(i + loop.size() - 1) % loop.size()]];
        const vec3& after = vertices_[loop[(i + 1) % loop.size()]];
        const vec3 chord = after - before;
        const float out = glm::dot(glm::cross(vertices_[loop[i]] - before, chord), normal) /
                          std::max(glm::length(chord), planar_);
        const float straight = planar_ * (kRounding / kPlanar);
        if (out > straight) return Turn::kConvex;
        return out < -straight ? Turn::kConcave : Turn::kStraight;
    }

    void append(const Shape& s, ConvexRegions& result) const {
        ConvexRegion region;
        region.normal = s.normal;
        region.begin = static_cast<std::uint32_t>(result.corners.size());
        vec3 sum(0);
        for (std::size_t i = 0; i < s.loop.size(); ++i) {
            const vec3& from = vertices_[s.loop[i]];
            const vec3& to = vertices_[s.loop[(i + 1) % s.loop.size()]];
            const vec3 inwards = glm::cross(s.normal, glm::normalize(to - from));
            result.corners.push_back(from);
            result.edges.emplace_back(inwards, -glm::dot(inwards, from));
            sum += from;
        }
        region.offset = glm::dot(s.normal, sum / static_cast<float>(s.loop.size()));
        region.end = static_cast<std::uint32_t>(result.corners.size());
        result.regions.push_back(region);
    }

    float planar_;  // m
    VertexWeld vertices_;
    std::vector<Shape> shapes_;
    std::vector<ShapeId> joined_to_;  // #shapes; itself: it is there
    std::vector<ShapeId> shape_of_;   // #triangles
};

}  // namespace

ConvexRegions find_convex_regions(const Scene& scene, std::span<const Surface> surfaces,
                                  float extent) {
    return RegionMaker(scene, extent).regions(surfaces);
}

}  // namespace antiradiance
