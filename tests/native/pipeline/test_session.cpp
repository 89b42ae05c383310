// SPDX-License-Identifier: GPL-3.0-or-later
// Whole renders: pictures of known radiance, the report, scenes with little in them, errors.
#include "pipeline/session.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/gtc/matrix_transform.hpp>
#include <iostream>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "base/error.h"
#include "gpu/gl_thread.h"
#include "support/scene_builder.h"
#include "support/scenes.h"

namespace antiradiance {
namespace {

// From inside the office or a box as large, along -x and a little down.
void add_camera(Scene& scene, int width, int height) {
    scene.has_camera = true;
    Camera& c = scene.camera;
    c.to_world = glm::inverse(glm::lookAt(vec3(5.5F, 2, 1.5F), vec3(0, 2, 0.8F), vec3(0, 0, 1)));
    c.width = c.x1 = width;
    c.height = c.y1 = height;
}

Scene furnace() {
    Scene scene;
    test::add_box(scene, "Room", vec3(0), vec3(6, 4, 2.7F),
                  test::add_material(scene, vec3(0.5F), vec3(1, 2, 3)), test::Facing::kInward);
    add_camera(scene, 24, 16);
    return scene;
}

Options quick() {
    Options options;
    options.max_patch_size = 1;
    return options;
}

RenderResult render(const Scene& scene, const Options& options) {
    Progress progress;
    return Session().render(scene, options, false, 0.25, progress);
}

// A file that goes when the test ends.
struct ReportPath {
    std::string path = std::string(ANTIRADIANCE_BINARY_DIR) + "/report_" +
                       testing::UnitTest::GetInstance()->current_test_info()->name() + ".json";
    ReportPath() { std::filesystem::remove(path); }
    ReportPath(const ReportPath&) = delete;
    ReportPath& operator=(const ReportPath&) = delete;
    ~ReportPath() { std::filesystem::remove(path); }
    [[nodiscard]] nlohmann::json read() const {
        std::ifstream file(path);
        return nlohmann::json::parse(file);
    }
};

std::set<std::string> keys(const nlohmann::json& json) {
    std::set<std::string> names;
    for (const auto& item : json.items())
        names.insert(item.key());
    return names;
}

bool contains(const std::vector<std::string>& warnings, const std::string& text) {
    for (const std::string& w : warnings) {
        if (w.find(text) != std::string::npos) return true;
    }
    return false;
}

void expect_black(const Picture& picture) {
    ASSERT_EQ(picture.combined.size(),
              static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
    for (const vec4& p : picture.combined)
        ASSERT_EQ(p, vec4(0, 0, 0, 1));
}

TEST(Session, AFurnaceFillsThePicture) {
    for (const Visibility visibility : {Visibility::kExplicit, Visibility::kImplicit}) {
        for (const DirectLightMode direct :
             {DirectLightMode::kExplicit, DirectLightMode::kImplicit}) {
            Options options = quick();
            options.visibility = visibility;
            options.direct_light = direct;
            const RenderResult result = render(furnace(), options);
            ASSERT_EQ(result.picture.combined.size(), 24U * 16U);
            vec3 mean(0);
            for (const vec4& p : result.picture.combined) {
                EXPECT_EQ(p.w, 1);
                mean += vec3(p) / (24.0F * 16.0F);
            }
            // L = E / (1 - 0.5). A picture weighs a few patches more than the others.
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(mean[c] / (2 * static_cast<float>(c + 1)), 1, 0.02F);
            EXPECT_TRUE(result.report.solve.converged);
            EXPECT_TRUE(result.report.warnings.empty()) << result.report.warnings.front();
        }
    }
}

TEST(Session, ReportHasTheKeysThatOtherToolsRead) {
    const ReportPath file;
    Options options = quick();
    options.report_path = file.path;
    options.visibility = Visibility::kImplicit;
    const RenderResult result = render(test::office(), options);
    const nlohmann::json json = file.read();
    EXPECT_EQ(keys(json),
              std::set<std::string>({"patches", "leaves", "links", "pruning", "visibility",
                                     "blockers", "direct", "solve", "display", "stages",
                                     "timings_s", "peak_memory_bytes", "warnings", "error"}));
    EXPECT_EQ(json["stages"], nlohmann::json({{"model", "run"},
                                              {"pruning", "run"},
                                              {"direct_light", "run"},
                                              {"transport", "run"},
                                              {"solve", "run"},
                                              {"evaluation", "run"},
                                              {"display", "run"}}));
    // direct, bytes and reason come on top of what was agreed on.
    EXPECT_EQ(keys(json["links"]),
              std::set<std::string>({"radiance", "antiradiance", "total", "bytes"}));
    EXPECT_EQ(keys(json["solve"]), std::set<std::string>({"backend", "renderer", "reason",
                                                          "iterations", "residual", "converged"}));
    EXPECT_EQ(keys(json["display"]), std::set<std::string>({"mode", "backend", "renderer"}));
    EXPECT_EQ(keys(json["timings_s"]),
              std::set<std::string>({"sync", "hierarchy", "links", "visibility", "direct", "solve",
                                     "display", "total"}));

    EXPECT_GT(json["leaves"].get<int>(), 100);
    EXPECT_GT(json["patches"].get<int>(), json["leaves"].get<int>());
    EXPECT_GT(json["links"]["radiance"].get<int>(), 1000);
    EXPECT_GT(json["links"]["antiradiance"].get<int>(), 1000);
    EXPECT_EQ(json["links"]["total"].get<int>(),
              json["links"]["radiance"].get<int>() + json["links"]["antiradiance"].get<int>());
    EXPECT_LE(json["links"]["bytes"].get<double>(), 16 * json["links"]["total"].get<double>());
    EXPECT_GE(json["solve"]["iterations"].get<int>(), 3);
    EXPECT_LT(json["solve"]["residual"].get<double>(), 1e-4);
    EXPECT_TRUE(json["solve"]["converged"].get<bool>());
    EXPECT_TRUE(json["solve"]["backend"] == "CPU" || json["solve"]["backend"] == "OPENGL");
    EXPECT_EQ(json["display"]["mode"], "FINAL_SHOOTING");
    EXPECT_EQ(json["display"]["backend"], "") << "the scene has no camera";
    EXPECT_EQ(json["timings_s"]["sync"].get<double>(), 0.25);
    double sum = 0;
    for (const auto& [stage, seconds] : json["timings_s"].items()) {
        EXPECT_GE(seconds.get<double>(), 0) << stage;
        if (stage != "total") sum += seconds.get<double>();
    }
    EXPECT_LE(sum, json["timings_s"]["total"].get<double>() * 1.001);
    EXPECT_GT(json["peak_memory_bytes"].get<double>(), 1e6);
    EXPECT_EQ(json["error"], "");
    EXPECT_EQ(json["warnings"].size(), result.report.warnings.size());
}

TEST(Session, ExplicitHasNoAntiradianceLinks) {
    const RenderResult result = render(test::office(), quick());
    EXPECT_GT(result.report.links.radiance, 1000U);
    EXPECT_EQ(result.report.links.antiradiance, 0U);
    EXPECT_GT(result.report.timings_s.visibility, 0);
}

TEST(Session, AFailureIsReportedToo) {
    const ReportPath file;
    Options options = quick();
    options.report_path = file.path;
    Scene scene = furnace();
    scene.positions[0].x = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THROW(render(scene, options), SceneError);
    EXPECT_NE(file.read()["error"].get<std::string>().find("Room"), std::string::npos);
}

TEST(Session, ReportsNamesOfAnyBytes) {
    const ReportPath file;
    Options options = quick();
    options.report_path = file.path;
    Scene scene = furnace();
    scene.warnings.emplace_back("object '\xff\xfe' is odd");
    EXPECT_NO_THROW(render(scene, options));
    EXPECT_EQ(file.read()["warnings"].size(), 1U);
}

TEST(Session, AReportThatCannotBeWrittenIsToldAtOnce) {
    Options options = quick();
    options.report_path = "/nonexistent folder/report.json";
    try {
        render(furnace(), options);
        FAIL();
    } catch (const SceneError& e) {
        EXPECT_NE(std::string(e.what()).find("/nonexistent folder/report.json"), std::string::npos)
            << e.what();
    }
}

TEST(Session, AReportOfACallerThatHadNoScene) {
    const ReportPath file;
    write_failure_report(file.path, "no camera", {"a warning"}, 1.5);
    const nlohmann::json json = file.read();
    EXPECT_EQ(json["error"], "no camera");
    EXPECT_EQ(json["warnings"], nlohmann::json({"a warning"}));
    EXPECT_EQ(json["timings_s"]["sync"].get<double>(), 1.5);
}

// As above, in final shooting: with explicit direct light the walls shoot what they reflect, and
// the shadow rays bring what they emit. Either of them twice would add half of the light.
TEST(Session, AFurnaceFillsThePictureInFinalShooting) {
    for (const Visibility visibility : {Visibility::kExplicit, Visibility::kImplicit}) {
        for (const DirectLightMode direct :
             {DirectLightMode::kExplicit, DirectLightMode::kImplicit}) {
            Options options = quick();
            options.display = DisplayMode::kFinalShooting;
            options.visibility = visibility;
            options.direct_light = direct;
            const RenderResult result = render(furnace(), options);
            ASSERT_EQ(result.picture.combined.size(), 24U * 16U);
            double mean = 0;
            for (const vec4& p : result.picture.combined)
                mean += p.x / (24.0 * 16.0);
            std::cout << "mean of the picture: " << mean / 2 << " of the answer\n";
            EXPECT_NEAR(mean / 2, 1, 0.002);  // measured .0002
        }
    }
}

TEST(Session, ShadowMapsLightAFurnaceAndAreReported) {
    Options options = quick();
    options.direct_light = DirectLightMode::kShadowMaps;
    std::string why_not;
    if (!gpu::GlThread::shared(why_not)) GTEST_SKIP() << why_not;
    const RenderResult result = render(furnace(), options);
    double mean = 0;
    for (const vec4& p : result.picture.combined)
        mean += p.x / (24.0 * 16.0);
    // The walls' light on each other by some dozens of points a wall, in the corners by few.
    EXPECT_NEAR(mean / 2, 1, 0.02);
    EXPECT_GT(result.report.direct.shadow_maps, 100U);
    EXPECT_GT(result.report.direct.bytes, 1U << 20U);
    EXPECT_EQ(render(furnace(), quick()).report.direct.shadow_maps, 0U);
}

TEST(Session, ShadowMapsWithoutOpenGlSayWhatToDo) {
    testing::GTEST_FLAG(death_test_style) = "threadsafe";  // a fresh process, without a context
    const auto render_without = [] {
        setenv("ANTIRADIANCE_NO_OPENGL", "1", 1);
        Options options = quick();
        options.direct_light = DirectLightMode::kShadowMaps;
        try {
            render(furnace(), options);
        } catch (const SceneError& e) {
            std::cerr << e.what();
            std::exit(0);
        }
        std::exit(1);
    };
    EXPECT_EXIT(render_without(), testing::ExitedWithCode(0),
                "Direct Light is Shadow Maps.*switched off.*set Direct Light to Explicit");
}

TEST(Session, ASceneWithoutLightIsBlackWithAWarning) {
    Scene scene;
    test::add_box(scene, "Room", vec3(0), vec3(6, 4, 2.7F), test::add_material(scene, vec3(0.5F)),
                  test::Facing::kInward);
    add_camera(scene, 8, 8);
    for (const Visibility visibility : {Visibility::kExplicit, Visibility::kImplicit}) {
        Options options = quick();
        options.visibility = visibility;
        const RenderResult result = render(scene, options);
        expect_black(result.picture);
        EXPECT_TRUE(contains(result.report.warnings, "no light"));
        EXPECT_EQ(result.report.leaves, 0U);
    }
}

TEST(Session, ASceneWhoseLampLightsNothingIsBlack) {
    Scene scene;
    test::add_box(scene, "Room", vec3(0), vec3(6, 4, 2.7F), test::add_material(scene, vec3(0.5F)),
                  test::Facing::kInward);
    add_camera(scene, 8, 8);
    Lamp spot;
    spot.name = "spot";
    spot.type = LampType::kSpot;
    spot.power = vec3(100);
    spot.spot_angle = 0.5F;
    spot.to_world = glm::translate(mat4(1), vec3(0, 0, -5));  // below the room, shines down
    scene.lamps.push_back(spot);
    const RenderResult result = render(scene, quick());
    expect_black(result.picture);
    EXPECT_EQ(result.report.error, "");
}

TEST(Session, WithoutACameraThereIsAReportAndNoPicture) {
    Scene scene = furnace();
    scene.has_camera = false;
    const RenderResult result = render(scene, quick());
    EXPECT_TRUE(result.picture.combined.empty());
    EXPECT_GT(result.report.links.total, 0U);
}

TEST(Session, MoreThanFitsIntoMemoryNamesTheObject) {
    Options options = quick();
    options.max_patch_size = 1e-5F;
    Scene scene = furnace();
    test::add_box(scene, "Small box", vec3(1), vec3(1.2F), 0);
    try {
        render(scene, options);
        FAIL();
    } catch (const SceneError& e) {
        const std::string error = e.what();
        EXPECT_NE(error.find("'Room'"), std::string::npos) << error;
        EXPECT_NE(error.find("Max Patch Size"), std::string::npos) << error;
        EXPECT_NE(error.find("GiB"), std::string::npos) << error;
    }
}

TEST(Session, ThatDidNotConvergeSaysSo) {
    Options options = quick();
    options.iterations = 1;
    const RenderResult one = render(furnace(), options);
    EXPECT_EQ(one.report.solve.iterations, 1);
    EXPECT_FALSE(one.report.solve.converged);
    EXPECT_GT(one.report.solve.residual, 0.01);
    EXPECT_FALSE(contains(one.report.warnings, "converge")) << "it was asked for";
}

}  // namespace
}  // namespace antiradiance
