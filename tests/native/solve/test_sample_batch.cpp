// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/sample_batch.h"

#include <gtest/gtest.h>

#include "support/scene_builder.h"

namespace antiradiance {
namespace {

constexpr vec3 kUp(0, 0, 1);

SurfacePoint floor_point(float x) {
    return {vec3(x, 0.5F, 0), kUp, kUp};
}

LightSample sample_towards(const SurfacePoint& from, const vec3& target) {
    LightSample s;
    const vec3 to = target - from.position;
    s.distance = glm::length(to);
    s.direction = to / s.distance;
    s.target = target;
    s.weight = 1;
    s.radiance = vec3(1, 2, 3);
    return s;
}

LightSample sun(const vec3& direction) {
    LightSample s;
    s.distance = RayScene::kInfinity;
    s.direction = glm::normalize(direction);
    s.weight = 1;
    s.radiance = vec3(1, 2, 3);
    return s;
}

// A floor [0, 20] x [0, 1], and a roof over its first metre.
class Batch : public testing::Test {
protected:
    Batch() {
        const int white = test::add_material(scene_, vec3(0.5F));
        test::add_quad(scene_, "floor", vec3(0), vec3(20, 0, 0), vec3(0, 1, 0), white);
        test::add_quad(scene_, "roof", vec3(0, 0, 1), vec3(1, 0, 0), vec3(0, 1, 0), white);
    }
    Scene scene_;
};

TEST_F(Batch, each_sample_is_tested_by_its_own_ray) {
    const RayScene rays(scene_);
    SampleBatch batch(rays);
    // More than fill a packet, with untested ones between them.
    for (int i = 0; i < 20; ++i) {
        const SurfacePoint point = floor_point(static_cast<float>(i) + 0.5F);
        batch.add(point, sample_towards(point, point.position + vec3(0, 0, 2)));
        batch.add(point, sample_towards(point, point.position + vec3(0, 0, 0.5F)));
        batch.add(point, sample_towards(point, point.position - kUp));
        batch.add(point, sun(kUp));
        batch.add(point, sun(vec3(1, 0, 0.01F)));
    }
    batch.trace();
    ASSERT_EQ(batch.samples().size(), 100U);
    const vec3 arrives(1, 2, 3);
    for (std::size_t i = 0; i < 20; ++i) {
        const auto of_point = batch.samples().subspan(5 * i, 5);
        const vec3 past_roof = i == 0 ? vec3(0) : arrives;
        EXPECT_EQ(of_point[0].radiance, past_roof) << i;
        EXPECT_EQ(of_point[1].radiance, arrives) << i;
        EXPECT_EQ(of_point[2].radiance, vec3(0)) << i;  // below the horizon
        EXPECT_EQ(of_point[3].radiance, past_roof) << i;
        EXPECT_EQ(of_point[4].radiance, arrives) << i;
    }
}

TEST_F(Batch, clear_begins_anew) {
    const RayScene rays(scene_);
    SampleBatch batch(rays);
    const SurfacePoint hidden = floor_point(0.5F);
    batch.add(hidden, sun(kUp));
    batch.trace();
    batch.clear();
    const SurfacePoint open = floor_point(5);
    batch.add(open, sun(kUp));
    batch.trace();
    ASSERT_EQ(batch.samples().size(), 1U);
    EXPECT_EQ(batch.samples()[0].radiance, vec3(1, 2, 3));
}

}  // namespace
}  // namespace antiradiance
