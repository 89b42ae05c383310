// SPDX-License-Identifier: GPL-3.0-or-later
// Two ways to sample the triangles of emissive meshes, combined: no bias, and less noise for as
// many rays close to a large mesh.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iostream>
#include <numeric>

#include "solve/direct_light_estimate.h"
#include "solve/direct_light_geometry.h"
#include "solve/direct_light_maps.h"
#include "support/scene_builder.h"

namespace antiradiance {
namespace {

const vec3 kUp(0, 0, 1);

struct MeshLight {
    explicit MeshLight(const Scene& s) : scene(s), rays(scene), light{rays} {
        MeshEmitters mesh = make_mesh_emitters(scene, rays.epsilon());
        std::vector<EmitterBounds> bounds;
        for (const EmitterPtr& emitter : mesh.emitters)
            bounds.push_back(emitter->bounds());
        light.lights.emplace_back();
        light.light_of.assign(bounds.size(), 0);
        light.emitters = std::move(mesh.emitters);
        light.of_triangle = std::move(mesh.of_triangle);
        light.in_tree.resize(bounds.size());
        std::iota(light.in_tree.begin(), light.in_tree.end(), 0);
        light.tree = EmitterTree(bounds);
    }
    [[nodiscard]] double estimate(const vec3& p, std::uint32_t seed, std::uint32_t hemisphere_rays,
                                  int passes) const {
        const SurfacePoint point{p, kUp, kUp};
        IrradianceEstimate e(light, {&point, 1}, seed, hemisphere_rays);
        for (int i = 0; i < passes; ++i)
            e.add({&point, 1});
        return e.mean().x;
    }
    Scene scene;
    RayScene rays;
    DirectLight::Impl light;
};

struct Spread {
    double mean = 0, deviation = 0;
};
// Of estimates with 576 rays each, by choice alone or with rays over the hemisphere among them.
Spread spread(const MeshLight& light, const vec3& p, std::uint32_t hemisphere_rays) {
    constexpr int kEstimates = 400;
    const int passes = hemisphere_rays == 0 ? 9 : 8;
    Spread s;
    double squares = 0;
    for (std::uint32_t seed = 0; seed < kEstimates; ++seed) {
        const double e = light.estimate(p, seed, hemisphere_rays, passes);
        s.mean += e / kEstimates;
        squares += e * e / kEstimates;
    }
    s.deviation = std::sqrt(std::max(0.0, squares / (s.mean * s.mean) - 1));
    return s;
}

TEST(MultipleImportanceSampling, a_panel_of_many_quads_gives_the_light_of_the_whole) {
    Scene scene;
    const int glow = test::add_material(scene, vec3(0), vec3(3));
    constexpr int kQuads = 32;
    constexpr float kStep = 2.0F / kQuads;
    for (int i = 0; i < kQuads; ++i) {
        for (int j = 0; j < kQuads; ++j) {
            const vec3 corner(-1 + kStep * static_cast<float>(i),
                              -1 + kStep * static_cast<float>(j), 0.2F);
            test::add_quad(scene, "panel", corner, vec3(kStep, 0, 0), vec3(0, kStep, 0), glow);
        }
    }
    const MeshLight light(scene);
    for (const vec3& p : {vec3(0), vec3(0.3F, 0.2F, 0), vec3(1.5F, 0.2F, 0)}) {
        const std::array<vec3, 4> whole{vec3(-1, -1, 0.2F) - p, vec3(1, -1, 0.2F) - p,
                                        vec3(1, 1, 0.2F) - p, vec3(-1, 1, 0.2F) - p};
        const double expected = 3 * double{polygon_irradiance(whole, kUp)};
        for (const std::uint32_t rays : {0U, kHemisphereRays}) {
            const Spread s = spread(light, p, rays);
            // Four standard errors of the mean of 400.
            EXPECT_NEAR(s.mean / expected, 1, 4 * s.deviation / 20 + 1e-4) << p.x << ", " << rays;
        }
    }
}

// Half of the hemisphere's light comes from triangles whose bounds touch the receiver's.
TEST(MultipleImportanceSampling, beside_a_large_mesh_there_is_less_noise_for_as_many_rays) {
    Scene scene;
    const int glow = test::add_material(scene, vec3(0), vec3(3));
    test::add_quad(scene, "floor", vec3(-3, -3, 0), vec3(6, 0, 0), vec3(0, 6, 0), kNone);
    test::add_ball(scene, "ball", vec3(0, 0, 1.05F), 1, 16, glow);
    const MeshLight light(scene);
    const auto compare = [&](const vec3& p) {
        const Spread one = spread(light, p, 0);
        const Spread both = spread(light, p, kHemisphereRays);
        std::cout << "at " << p.x << ": noise " << one.deviation << " by choice, " << both.deviation
                  << " with the hemisphere\n";
        // Unbiased: they differ by no more than four standard errors.
        EXPECT_NEAR(both.mean / one.mean, 1, 4 * std::hypot(one.deviation, both.deviation) / 20);
        return both.deviation / one.deviation;
    };
    EXPECT_LT(compare({0.3F, 0.2F, 0}), 0.7);   // measured .5: a quarter of the variance
    EXPECT_LT(compare({1.5F, 0.2F, 0}), 1.25);  // farther off, some rays for nothing
}

}  // namespace
}  // namespace antiradiance
