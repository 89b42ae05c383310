// SPDX-License-Identifier: GPL-3.0-or-later
// What a session runs again after an edit, and that the picture is the one a new session makes.
#include <gtest/gtest.h>

#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "base/error.h"
#include "pipeline/session.h"
#include "support/scene_builder.h"
#include "support/scenes.h"

namespace antiradiance {
namespace {

constexpr int kWood = 2;   // material of the office's desks
constexpr int kPanel = 1;  // its luminous panel's
constexpr int kPaper = 3;  // textured

constexpr std::size_t kPointLamp = 0;  // into Scene::lamps
constexpr std::size_t kAreaLamp = 1;

Texture checker(float bright) {
    return {.name = "checker",
            .width = 2,
            .height = 2,
            .pixels = {vec4(bright), vec4(0.1F), vec4(0.1F), vec4(bright)},
            .missing_path = ""};
}

// The office with a lamp that shadow rays serve, one that may emit along links, and a textured
// sheet on a wall.
Scene base_scene() {
    Scene scene = test::office();
    scene.textures = {checker(0.9F), checker(0.5F)};
    scene.materials.push_back({.name = "paper", .albedo = vec3(1), .albedo_texture = 0});
    test::add_polygon(scene, "Sheet", {{0.01F, 1, 1}, {0.01F, 2, 1}, {0.01F, 2, 2}, {0.01F, 1, 2}},
                      kPaper, {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
    test::add_point_lamp(scene, vec3(1, 2, 2), vec3(20));
    Lamp area;
    area.name = "area";
    area.type = LampType::kArea;
    area.to_world = glm::translate(mat4(1), vec3(1.5F, 3, 2.1F));
    area.power = vec3(30, 20, 10);
    scene.lamps.push_back(area);
    test::add_office_camera(scene, 24, 18);
    scene.camera.clip_end = 5.7F;  // m, just before the far wall: there is background to see
    return scene;
}

Options base_options() {
    Options options;
    options.max_patch_size = 2;
    options.link_threshold = 0.1F;
    options.solver = SolverChoice::kCpu;
    return options;
}

struct Input {
    Scene scene = base_scene();
    Options options = base_options();
    bool film_transparent = false;
};

RenderResult render(Session& session, const Input& input) {
    Progress progress;
    return session.render(input.scene, input.options, input.film_transparent, 0, progress);
}

// The stages that ran, in a row.
std::string ran(const Report& report) {
    std::string names;
    for (const auto& [name, what] : report.stages) {
        if (what == "run") names += (names.empty() ? "" : " ") + name;
    }
    return names;
}

const char* const kAll = "model pruning direct_light transport solve evaluation display";
const char* const kFromPruning = "pruning direct_light transport solve evaluation display";
const char* const kFromDirectLight = "direct_light transport solve evaluation display";
const char* const kFromTransport = "transport solve evaluation display";
const char* const kFromSolve = "solve evaluation display";
const char* const kDisplay = "display";

void expect_equal(const Picture& a, const Picture& b) {
    EXPECT_EQ(a.combined, b.combined);
    EXPECT_EQ(a.depth, b.depth);
    EXPECT_EQ(a.normal, b.normal);
}

// All that does not depend on the clock or the process.
void expect_equal(const Report& a, const Report& b) {
    EXPECT_EQ(a.patches, b.patches);
    EXPECT_EQ(a.leaves, b.leaves);
    EXPECT_EQ(a.links.total, b.links.total);
    EXPECT_EQ(a.links.bytes, b.links.bytes);
    EXPECT_EQ(a.solve.backend, b.solve.backend);
    EXPECT_EQ(a.solve.iterations, b.solve.iterations);
    EXPECT_EQ(a.solve.residual, b.solve.residual);
    EXPECT_EQ(a.warnings, b.warnings);
}

struct Edit {
    std::string name;
    std::string runs_explicit, runs_implicit;  // by option `direct_light`
    std::function<void(Input&)> make;
};

std::vector<Edit> edits() {
    return {
        {"nothing", kDisplay, kDisplay, [](Input&) {}},
        {"camera moved", kDisplay, kDisplay,
         [](Input& i) { i.scene.camera.to_world[3] += vec4(-0.3F, 0.2F, 0, 0); }},
        {"resolution", kDisplay, kDisplay,
         [](Input& i) { i.scene.camera.width = i.scene.camera.x1 = 30; }},
        {"film", kDisplay, kDisplay, [](Input& i) { i.film_transparent = true; }},
        {"background", kDisplay, kDisplay, [](Input& i) { i.scene.background = vec3(1); }},
        {"shading normals", kDisplay, kDisplay,
         [](Input& i) { i.scene.normals[0][0] = glm::normalize(vec3(0.1F, 0, 1)); }},
        {"lamp seen by the camera", kDisplay, kDisplay,
         [](Input& i) { i.scene.lamps[kAreaLamp].visible_to_camera = true; }},
        {"display mode", kDisplay, kDisplay,
         [](Input& i) { i.options.display = DisplayMode::kSplatting; }},
        {"interleave", kDisplay, kDisplay, [](Input& i) { i.options.interleave = 2; }},

        {"albedo", kFromTransport, kFromTransport,
         [](Input& i) { i.scene.materials[kWood].albedo = vec3(0.2F, 0.3F, 0.4F); }},
        {"pixels of a texture", kFromTransport, kFromTransport,
         [](Input& i) { i.scene.textures[0] = checker(0.4F); }},
        {"another texture", kFromTransport, kFromTransport,
         [](Input& i) { i.scene.materials[kPaper].albedo_texture = 1; }},
        {"uv", kFromTransport, kFromTransport, [](Input& i) { i.scene.uv.back()[0] = vec2(0.3F); }},
        {"iterations", kFromSolve, kFromSolve, [](Input& i) { i.options.iterations = 2; }},

        {"strength of a point lamp", kFromDirectLight, kFromDirectLight,
         [](Input& i) { i.scene.lamps[kPointLamp].power *= 2; }},
        {"radius of a point lamp", kFromDirectLight, kFromDirectLight,
         [](Input& i) { i.scene.lamps[kPointLamp].radius = 0.1F; }},
        {"strength of an area lamp", kFromDirectLight, kFromTransport,
         [](Input& i) { i.scene.lamps[kAreaLamp].power *= 2; }},
        {"emission", kFromDirectLight, kFromTransport,
         [](Input& i) { i.scene.materials[kPanel].emission *= 0.5F; }},

        {"place of a lamp", kAll, kAll,
         [](Input& i) { i.scene.lamps[kPointLamp].to_world[3].x += 0.5F; }},
        {"lamp switched off", kAll, kAll,
         [](Input& i) { i.scene.lamps[kPointLamp].power = vec3(0); }},
        {"new lamp", kAll, kAll,
         [](Input& i) { test::add_point_lamp(i.scene, vec3(2, 2, 2), vec3(5)); }},
        {"material that begins to shine", kAll, kAll,
         [](Input& i) { i.scene.materials[kWood].emission = vec3(0.1F); }},
        {"vertex moved", kAll, kAll,
         [](Input& i) { i.scene.positions.back() += vec3(0, 0, 0.1F); }},
        {"object added", kAll, kAll,
         [](Input& i) {
             test::add_box(i.scene, "Box", vec3(2.6F, 1, 0), vec3(3, 1.4F, 0.5F), kWood);
         }},
        {"other material on a face", kAll, kAll,
         [](Input& i) { i.scene.triangle_material.back() = kWood; }},
        {"visibility", kAll, kAll, [](Input& i) { i.options.visibility = Visibility::kImplicit; }},
        {"max_patch_size", kAll, kAll, [](Input& i) { i.options.max_patch_size = 1.5F; }},
        {"link_threshold", kAll, kAll, [](Input& i) { i.options.link_threshold = 0.05F; }},
        {"direction_bins", kAll, kAll, [](Input& i) { i.options.direction_bins = 64; }},
        {"visibility_rays", kAll, kAll, [](Input& i) { i.options.visibility_rays = 2; }},
        {"shooting of antiradiance, which asks for links by direction", kAll, kAll,
         [](Input& i) { i.options.shooting_visibility = ShootingVisibility::kAntiradiance; }},
        {"direct_light", kAll, kAll,
         [](Input& i) {
             const bool is_explicit = i.options.direct_light == DirectLightMode::kExplicit;
             i.options.direct_light =
                 is_explicit ? DirectLightMode::kImplicit : DirectLightMode::kExplicit;
         }},
    };
}

// From the base to each edit and back again, in one session.
class Edits : public testing::TestWithParam<DirectLightMode> {
protected:
    Edits() {
        base_.options.direct_light = GetParam();
        base_result_ = render(session_, base_);
    }

    void check(const Edit& edit) {
        SCOPED_TRACE(edit.name);
        const bool is_explicit = GetParam() == DirectLightMode::kExplicit;
        const std::string wanted = is_explicit ? edit.runs_explicit : edit.runs_implicit;
        Input edited = base_;
        edit.make(edited);
        Session fresh;
        const RenderResult made = render(fresh, edited);
        const bool differs = made.picture.combined != base_result_.picture.combined;
        EXPECT_EQ(differs, edit.name != "nothing") << "an edit that changes nothing tests nothing";

        expect_result(edited, wanted, made);
        expect_result(base_, wanted, base_result_);
    }

private:
    void expect_result(const Input& input, const std::string& stages, const RenderResult& wanted) {
        const RenderResult kept = render(session_, input);
        EXPECT_EQ(ran(kept.report), stages);
        expect_equal(kept.picture, wanted.picture);
        expect_equal(kept.report, wanted.report);
    }

    Session session_;
    Input base_;
    RenderResult base_result_;
};

INSTANTIATE_TEST_SUITE_P(DirectLight, Edits,
                         testing::Values(DirectLightMode::kExplicit, DirectLightMode::kImplicit),
                         [](const auto& test_case) {
                             return test_case.param == DirectLightMode::kExplicit ? "Explicit"
                                                                                  : "Implicit";
                         });

TEST_P(Edits, RunWhatReadsThem) {
    for (const Edit& edit : edits())
        check(edit);
}

TEST(Stages, PruningKeepsTheLinkMeshThatItPrunes) {
    Input input;
    input.options.visibility = Visibility::kImplicit;
    Session session;
    const RenderResult whole = render(session, input);
    EXPECT_EQ(whole.report.pruning.method, "NONE");
    for (const PruneMethod method : {PruneMethod::kHeuristic2, PruneMethod::kConservative}) {
        input.options.pruning = method;
        const RenderResult pruned = render(session, input);
        EXPECT_EQ(ran(pruned.report), kFromPruning);
        const Report::Pruning& p = pruned.report.pruning;
        EXPECT_GT(p.removed_antiradiance, 0U);
        EXPECT_EQ(pruned.report.links.radiance + p.removed_radiance, whole.report.links.radiance);
        EXPECT_EQ(pruned.report.links.antiradiance + p.removed_antiradiance,
                  whole.report.links.antiradiance);
        EXPECT_NE(pruned.picture.combined, whole.picture.combined);
        EXPECT_EQ(ran(render(session, input).report), kDisplay);
    }
    input.options.pruning = PruneMethod::kNone;
    const RenderResult again = render(session, input);
    EXPECT_EQ(ran(again.report), kFromPruning);
    expect_equal(again.picture, whole.picture);
}

TEST(Stages, EvaluatingPruningSolvesNothingAgainForThePicture) {
    Input input;
    input.options.max_patch_size = 1;
    Session session;
    const RenderResult plain = render(session, input);
    EXPECT_TRUE(plain.report.pruning.table.rules.empty());
    input.options.evaluate_pruning = true;
    const RenderResult evaluated = render(session, input);
    EXPECT_EQ(ran(evaluated.report), "evaluation display");
    expect_equal(evaluated.picture, plain.picture);
    std::size_t without_rays = 0;
    for (const PruneRule& rule : prune_rules())
        without_rays += rule.traces_rays ? 0 : 1;
    const PruningTable& table = evaluated.report.pruning.table;
    EXPECT_GT(table.unpruned.relative_rms, 0);
    const auto json = nlohmann::json::parse(evaluated.report.to_json())["pruning"];
    EXPECT_EQ(json["links"], table.links);
    EXPECT_EQ(json["unpruned"]["relative_rms"], table.unpruned.relative_rms);
    EXPECT_EQ(json["evaluation"].size(), without_rays);
    ASSERT_EQ(table.rules.size(), without_rays);
    for (const RuleEvaluation& rule : table.rules) {
        const PruneEvaluation& c = rule.counts;
        EXPECT_GT(c.removed, 0U) << rule.method;
        EXPECT_EQ(c.removed - c.incorrect, c.explicit_test - c.not_removed) << rule.method;
        EXPECT_TRUE(rule.error.converged) << rule.method;
        EXPECT_GT(rule.error.relative_rms, 0) << rule.method;
        // What the shaft finds blocked, rays do not get through: at most 5 % may seem wrong, of
        // links that graze an edge.
        if (rule.method == "CONSERVATIVE") {
            EXPECT_LE(20 * c.incorrect, c.removed);
        }
    }
    EXPECT_EQ(ran(render(session, input).report), kDisplay);
}

TEST(Stages, PruningOfExplicitLinksIsLeftOutWithAWarning) {
    Input input;
    Session session;
    const RenderResult plain = render(session, input);
    input.options.pruning = PruneMethod::kConservative;
    const RenderResult asked = render(session, input);
    EXPECT_EQ(ran(asked.report), kDisplay);
    EXPECT_EQ(asked.report.pruning.method, "NONE");
    ASSERT_EQ(asked.report.warnings.size(), plain.report.warnings.size() + 1);
    EXPECT_NE(asked.report.warnings.back().find("Pruning"), std::string::npos);
    expect_equal(asked.picture, plain.picture);
}

TEST(Stages, ImplicitVisibilityKeepsItsLinksForFinalShooting) {
    Input input;
    input.options.visibility = Visibility::kImplicit;
    input.options.display = DisplayMode::kPatches;
    Session session;
    render(session, input);
    input.options.display = DisplayMode::kFinalShooting;
    EXPECT_EQ(ran(render(session, input).report), kDisplay);
}

TEST(Stages, KeptOnesTakeNoTimeAndSayWhatTheyMade) {
    Session session;
    const Report first = render(session, {}).report;
    const Report second = render(session, {}).report;
    EXPECT_GT(first.timings_s.links, 0);
    EXPECT_GT(first.timings_s.direct, 0);
    for (const double seconds :
         {second.timings_s.hierarchy, second.timings_s.links, second.timings_s.visibility,
          second.timings_s.direct, second.timings_s.solve})
        EXPECT_EQ(seconds, 0);
    EXPECT_GT(second.timings_s.display, 0);
    expect_equal(second, first);
}

TEST(Stages, SessionsKeepNothingOfEachOther) {
    Session first;
    Session second;
    render(first, {});
    EXPECT_EQ(ran(render(second, {}).report), kAll);
}

// Cancels where a stage begins, for every stage: the next render makes the right picture, and runs
// no stage again that was done.
TEST(Stages, ThatWereDoneOutliveACancelledRender) {
    struct Case {
        std::string cancelled_in;
        const char* next;
    };
    const Case cases[] = {{"Linking patches", kAll},
                          {"Direct light", kFromDirectLight},
                          {"Solving", kFromSolve},
                          {"Display", kDisplay}};
    Session fresh;
    const RenderResult wanted = render(fresh, {});
    for (const Case& c : cases) {
        SCOPED_TRACE(c.cancelled_in);
        Session session;
        Input other;  // what the session holds before differs in every stage
        other.options.max_patch_size = 1.5F;
        render(session, other);
        Progress* self = nullptr;
        Progress cancelling(
            [&](float, const std::string& stage) {
                if (stage == c.cancelled_in) self->cancel();
            },
            {});
        self = &cancelling;
        const Input input;
        EXPECT_THROW(session.render(input.scene, input.options, false, 0, cancelling), Cancelled);
        const RenderResult next = render(session, input);
        EXPECT_EQ(ran(next.report), c.next);
        expect_equal(next.picture, wanted.picture);
    }
}

TEST(Stages, OutliveASceneThatCannotBeRendered) {
    Session session;
    render(session, {});
    Input broken;
    broken.scene.materials[kPaper].albedo_texture = 0;
    broken.scene.textures[0] = {.name = "gone", .pixels = {}, .missing_path = "gone.png"};
    EXPECT_THROW(render(session, broken), SceneError);
    EXPECT_EQ(ran(render(session, {}).report), kDisplay);
}

TEST(Stages, AModelThatDoesNotFitIsNoModel) {
    Session session;
    render(session, {});
    Input huge;
    huge.options.max_patch_size = 1e-5F;
    EXPECT_THROW(render(session, huge), SceneError);
    EXPECT_EQ(ran(render(session, {}).report), kAll) << "the old model made room for the new one";
}

TEST(Stages, WithoutACameraSolveForALaterOne) {
    Session session;
    Input input;
    input.scene.has_camera = false;
    EXPECT_TRUE(render(session, input).picture.combined.empty());
    const RenderResult seen = render(session, {});
    EXPECT_EQ(ran(seen.report), kDisplay);
    Session fresh;
    expect_equal(seen.picture, render(fresh, {}).picture);
}

}  // namespace
}  // namespace antiradiance
