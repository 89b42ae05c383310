// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/lit_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hierarchy/patch_materials.h"
#include "scene/validate.h"
#include "solve/direct_light.h"

namespace antiradiance::test {

namespace {

Scene validated(Scene scene) {
    validate(scene);
    return scene;
}

Model modelled(const Scene& scene, const Options& options) {
    Progress progress;
    return build_model(scene, options, progress);
}

}  // namespace

LitScene::LitScene(const Scene& made, const Options& options)
    : scene(validated(made)), model(modelled(scene, options)) {
    Progress progress;
    direct = DirectLight(scene, model.rays, options.direct_light, progress)
                 .leaf_irradiance(model.tree, progress);
    input = make_transport_input(scene, model.tree, direct, options.direct_light);
}

std::vector<vec3> LitScene::total_irradiance(const Solution& solution) const {
    std::vector<vec3> total(model.tree.size(), vec3(0));
    for (const NodeId leaf : model.tree.leaves) {
        const auto n = static_cast<std::size_t>(leaf);
        total[n] = direct[n] + solution.irradiance[n];
    }
    return total;
}

std::vector<vec3> LitScene::radiance(const Solution& solution) const {
    const PatchMaterials materials = average_materials(scene, model.tree);
    std::vector<vec3> sent = total_irradiance(solution);
    for (std::size_t n = 0; n < sent.size(); ++n)
        sent[n] = materials.emission[n] + materials.albedo[n] * kInvPi * sent[n];
    return sent;
}

Statistics statistics(const PatchTree& tree, const std::vector<NodeId>& leaves,
                      const std::vector<vec3>& values) {
    Statistics s{.least = std::numeric_limits<double>::max(),
                 .most = std::numeric_limits<double>::lowest()};
    double area = 0;
    double squares = 0;
    for (const NodeId leaf : leaves) {
        const auto n = static_cast<std::size_t>(leaf);
        const double weight = static_cast<double>(tree.area[n]) * tree.exposed[n];
        if (weight <= 0) continue;
        const double value = values[n].x;
        area += weight;
        s.mean += weight * value;
        squares += weight * value * value;
        s.least = std::min(s.least, value);
        s.most = std::max(s.most, value);
    }
    s.mean /= area;
    s.deviation = std::sqrt(std::max(0.0, squares / area / (s.mean * s.mean) - 1));
    return s;
}

void expect_light(const std::vector<vec3>& values) {
    for (const vec3& v : values) {
        ASSERT_TRUE(std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z));
        ASSERT_GE(std::min({v.x, v.y, v.z}), 0);
    }
}

}  // namespace antiradiance::test
