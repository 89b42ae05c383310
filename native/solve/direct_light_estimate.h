// SPDX-License-Identifier: GPL-3.0-or-later
// The running estimate of the mean direct irradiance over a few points of one surface.
//
// Each emitter's estimate is the ratio: exact unshadowed irradiance x (sum of the samples' light
// that arrives) / (sum of the samples' light without occluders), pooled over all points (Heitz,
// Hill and McGuire, "Combining Analytic Direct Illumination and Stochastic Shadows", 2018). Where
// nothing is in the way it has no noise; in a penumbra its bias is O(1 / rays), far below its noise
// there.
//
// The emitters of a tree are sampled in two ways, which the balance heuristic combines (Veach and
// Guibas, "Optimally Combining Sampling Techniques for Monte Carlo Rendering", 1995): emitters
// chosen by the light they can bring, and directions by their cosine. The second wins close to
// large meshes, where bounds tell little of a triangle's light.
#pragma once

#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include "solve/direct_light.h"
#include "solve/direct_light_emitter.h"
#include "solve/direct_light_tree.h"
#include "solve/sample_batch.h"

namespace antiradiance {

// With no more emitters than this, each gets its own rays.
inline constexpr std::size_t kMostEmittersEach = 16;
// What brings less than this share of the light, if nothing is in the way, gets only so many rays
// at first.
inline constexpr float kWeak = 0.08F;
inline constexpr std::size_t kWeakRays = 4;
// From this many radii of the receivers on, one closed form stands for all of them: E falls with
// the distance squared, so that its mean over them is .3 % more than E of their mean at most.
inline constexpr float kFar = 16;
// An emitter that would be chosen this often in one pass gets its own rays too.
inline constexpr double kOwnRays = 4;
// Choices among many emitters in one pass, divided over the points.
inline constexpr std::uint32_t kChoices = 64;
// Rays over the hemisphere beside them, as long as any of them meets an emitter.
inline constexpr std::uint32_t kHemisphereRays = 8;

class MappedLight;

struct DirectLight::Impl {
    const RayScene& rays;
    std::vector<EmitterPtr> emitters{};
    std::vector<LightSource> lights{};
    std::vector<std::int32_t> light_of{};  // into lights  // #emitters
    std::vector<std::int32_t> always{};    // into emitters: each gets its own rays
    std::vector<std::int32_t> in_tree{};   // into emitters: the tree's indices
    EmitterTree tree{};
    // The tree's emitter that has the whole triangle, or kNone.  // #triangles; none without tree
    std::vector<std::int32_t> of_triangle{};
    std::unique_ptr<MappedLight> mapped{};  // in mode kShadowMaps, if there is an emitter
};

class IrradianceEstimate {
public:
    // `points`: where the receivers lie; the later ones of add() may be others close by.
    IrradianceEstimate(const DirectLight::Impl& light, std::span<const SurfacePoint> points,
                       std::uint32_t seed, std::uint32_t hemisphere_rays = kHemisphereRays);

    // One shadow ray to each emitter that is still active from each point.
    void add(std::span<const SurfacePoint> points);
    // As add(), but weak emitters are looked at from the first `few` points only.
    void add_by_share(std::span<const SurfacePoint> points, std::size_t few);

    // Leaves active only those emitters whose standard error is above `allowed` (luminance, W/m2);
    // false: none is. An emitter none of whose light has arrived says nothing of its error: it
    // gets up to `shadow_rays`.
    bool refine(float allowed, int shadow_rays);

    [[nodiscard]] vec3 mean() const;  // W/m2
    // The part of each light in it: sets shares[light], of as many as DirectLight::Impl has.
    void split(std::span<vec3> shares) const;

private:
    struct Sum {
        std::int32_t emitter = kNone;
        bool active = true;
        bool far = false;  // `of_centre` stands for unshadowed() of all receivers
        float of_centre = 0;
        std::uint32_t rays = 0;
        double unshadowed = 0;   // sum over rays
        double unshadowed2 = 0;  // sum of squares
        double weight = 0;       // sum
        double open = 0;         // sum of weight x luminance, arriving or not
        vec3 arrived{0};         // sum of weight x radiance that arrives
        // Sums for the ratio's error: y = weight x luminance that arrives, w = weight.
        double yy = 0, yw = 0, ww = 0;
    };

    // Samples of a mean.
    struct SampleSum {
        vec3 sum{0};           // W/m2
        double y = 0, yy = 0;  // sums of the luminance and its square
        void add(const vec3& e) {
            sum += e;
            const double l = luminance(e);
            y += l;
            yy += l * l;
        }
        // Of the mean of `count` samples.
        [[nodiscard]] double variance(double count) const {
            return std::max(0.0, yy / count - y * y / (count * count)) / count;
        }
    };

    void add_sum(std::int32_t emitter);
    void add_own(Sum& sum, std::span<const SurfacePoint> points);
    void add_chosen(std::span<const SurfacePoint> points);
    void sample_choices(std::span<const SurfacePoint> points, std::uint32_t pass,
                        SampleSum& samples);
    void sample_hemisphere(std::span<const SurfacePoint> points, std::uint32_t pass,
                           SampleSum& samples);
    struct Arriving {
        std::int32_t light = kNone;  // kNone: nothing arrives
        vec3 irradiance{0};          // W/m2
    };
    [[nodiscard]] Arriving arriving_from(const SurfacePoint& point, const vec3& direction) const;
    // Of a sample of one of the tree's lights, W/m2, of `count` in its pass.
    void add_chosen_sample(std::int32_t light, const vec3& irradiance, std::uint32_t count);
    [[nodiscard]] float share_of_choice(const SurfacePoint& point, const vec3& direction,
                                        double probability, float density) const;
    [[nodiscard]] static vec3 mean_of(const Sum& sum);
    [[nodiscard]] static double open_of(const Sum& sum);
    [[nodiscard]] static double error_of(const Sum& sum);

    const DirectLight::Impl& light_;
    std::uint32_t seed_;
    std::vector<Sum> sums_;
    ReceiverBounds receivers_;
    bool flat_;  // the receivers' normals are alike
    // Emitters chosen at random, per pass over kChoices samples.
    bool chosen_active_ = false;
    std::uint32_t hemisphere_rays_;  // of the next pass
    std::uint32_t chosen_passes_ = 0;
    std::vector<vec3> chosen_;  // sum over passes, W/m2  // #lights; empty without a tree
    double chosen_var_ = 0;     // sum over passes of the variance of a pass's mean
    std::vector<EmitterChoice> choices_;
    SampleBatch batch_;  // of the emitter at hand
};

}  // namespace antiradiance
