// SPDX-License-Identifier: GPL-3.0-or-later
// One source of direct light as seen from a point.
#pragma once

#include <memory>
#include <vector>

#include "base/box.h"
#include "base/types.h"
#include "scene/scene.h"
#include "solve/direct_light.h"

namespace antiradiance {

// Where light may come from, for choosing among many.
struct EmitterBounds {
    vec3 center{0};        // m
    float radius = 0;      // m, of a sphere around the emitter
    float power = 0;       // relative to its irradiance on a facing surface at 1 m: W/sr, luminance
    vec3 axis{0};          // unit, of the directions of emission
    float cos_spread = 1;  // normals (or a spot's rays) lie within this angle of the axis
    bool two_sided = false;
    bool cosine = true;  // emits with the cosine to the axis; false: alike in the whole spread
};

// A point of an emitter.
struct LightSample {
    vec3 direction{0};   // unit, from the receiver
    float distance = 0;  // m; RayScene::kInfinity for a sun
    vec3 target{0};      // m, on the emitter; unused for a sun
    // Unbiased estimate of unshadowed(): this sample's share of it over its probability density.
    float weight = 0;
    vec3 radiance{0};            // in the unit that multiplies unshadowed()
    std::int32_t light = kNone;  // set by who has samples of several lights: DirectLight::Impl's
};

// A point of an emitter that a shadow map looks from, fixed for all receivers.
struct EmitterPoint {
    vec3 position{0};    // m; unused of a sun
    vec3 axis{0, 0, 1};  // unit, of the directions that it shines into
    float reach = kPi;   // rad, about the axis; 0: a sun
    [[nodiscard]] bool is_sun() const { return reach == 0; }
};

class Emitter {
public:
    virtual ~Emitter() = default;
    // Irradiance at a receiver, without occluders, if radiance were 1 over the whole emitter:
    // exact, with the shading normal, cut off at its horizon. The unit is the emitter's own (1 sr
    // for surfaces, 1/m2 for point lamps, 1 for a sun). 0 means that no sample can bring light.
    [[nodiscard]] virtual float unshadowed(const SurfacePoint& receiver) const = 0;
    // Called where unshadowed() > 0.
    [[nodiscard]] virtual LightSample sample(const SurfacePoint& receiver, const vec2& u) const = 0;
    // Density, 1/sr, with which sample() takes a direction to a point of the emitter; 0: not known.
    [[nodiscard]] virtual float density(const SurfacePoint& /*receiver*/,
                                        const vec3& /*direction*/) const {
        return 0;
    }
    // Of emitters at infinity, which are never chosen among others, the axis and the spread alone.
    [[nodiscard]] virtual EmitterBounds bounds() const = 0;
    [[nodiscard]] virtual bool at_infinity() const { return false; }
    // Around all its points, if it is not at infinity.
    [[nodiscard]] virtual Box box() const;

    // What shadow maps need.
    // Irradiance, W/m2, without occluders: exact where radiance is the same over the whole emitter,
    // else by a fixed set of samples.
    [[nodiscard]] vec3 unshadowed_light(const SurfacePoint& receiver) const;
    // Point `index` of points that are spread over the emitter.
    [[nodiscard]] virtual EmitterPoint point(std::uint32_t index) const = 0;
    // Relative light that such a point brings without occluders. 0: it does not shine there.
    [[nodiscard]] virtual float weight(const SurfacePoint& receiver,
                                       const EmitterPoint& point) const = 0;
    // Whether one point is the whole emitter.
    [[nodiscard]] virtual bool is_point() const { return false; }
    // The limit of unshadowed() for emitters of any size.
    [[nodiscard]] virtual float most_unshadowed() const { return kPi; }

protected:
    // Whether sample() finds another radiance in other directions.
    [[nodiscard]] virtual bool is_coloured() const { return false; }
};

// Of the sequences that point() takes.
inline constexpr std::uint32_t kPointSeed = 0x2545f491U;

using EmitterPtr = std::unique_ptr<Emitter>;

// epsilon: RayScene::epsilon(). Null for a lamp without power.
[[nodiscard]] EmitterPtr make_lamp_emitter(const Lamp& lamp, float epsilon);

// An area lamp whose spread is below pi, and one of an ellipse with the full spread.
[[nodiscard]] EmitterPtr make_spread_emitter(const Lamp& lamp, float epsilon);
[[nodiscard]] EmitterPtr make_ellipse_emitter(const Lamp& lamp, float epsilon);

// All emissive polygons. Textured ones are cut until a piece is of nearly one colour.
struct MeshEmitters {
    std::vector<EmitterPtr> emitters;
    std::vector<std::int32_t> material;  // of the scene  // #emitters
    // Into emitters: the one that has the whole triangle; kNone: dark or cut into pieces.
    // #triangles
    std::vector<std::int32_t> of_triangle;
};
[[nodiscard]] MeshEmitters make_mesh_emitters(const Scene& scene, float epsilon);

// A flat convex polygon of constant radiance, emitting from one or both sides.
class PolygonEmitter final : public Emitter {
public:
    // 3 or 4 corners; one-sided ones emit towards cross(c1 - c0, c2 - c0).
    PolygonEmitter(const std::array<vec3, 4>& corners, std::size_t count, const vec3& radiance,
                   bool two_sided, float epsilon);
    [[nodiscard]] float unshadowed(const SurfacePoint& receiver) const override;
    [[nodiscard]] LightSample sample(const SurfacePoint& receiver, const vec2& u) const override;
    [[nodiscard]] float density(const SurfacePoint& receiver, const vec3& direction) const override;
    [[nodiscard]] EmitterBounds bounds() const override;
    [[nodiscard]] Box box() const override;
    [[nodiscard]] EmitterPoint point(std::uint32_t index) const override;
    [[nodiscard]] float weight(const SurfacePoint& receiver,
                               const EmitterPoint& point) const override;

private:
    [[nodiscard]] vec3 point_of_area(const vec2& u) const;
    [[nodiscard]] LightSample sample_area(const SurfacePoint& receiver, const vec2& u) const;

    std::array<vec3, 4> corners_;
    std::size_t count_;
    vec3 radiance_;
    vec3 normal_;
    vec3 center_;
    float area_;
    float first_share_;  // of the area in triangle 0 1 2
    float epsilon_;
    bool two_sided_;
};

}  // namespace antiradiance
