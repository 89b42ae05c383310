// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/evaluate_command.h"

#include <cstdio>
#include <map>
#include <memory>
#include <string>

#include "tools/obj_scene.h"
#include "tools/option_flags.h"
#include "tools/pruning_table_text.h"
#include "tools/terminal.h"

namespace antiradiance {

namespace {

using Format = std::string (*)(const PruningTable&);

const std::map<std::string, Format> kFormats{
    {"TEXT", &to_text}, {"CSV", &to_csv}, {"JSON", &to_json}};

struct EvaluateCommand {
    std::string scene;
    float scale = 1;  // metres a unit
    std::string format = "TEXT";
    EvaluationRays rays;
    Options options;
};

void run(const EvaluateCommand& command) {
    Scene scene = read_obj(command.scene, command.scale);
    PruningTable table;
    {
        Terminal terminal;
        table =
            evaluate_rules(std::move(scene), command.options, command.rays, terminal.progress());
    }
    std::fputs(kFormats.at(command.format)(table).c_str(), stdout);
}

}  // namespace

void add_evaluate_command(CLI::App& app) {
    CLI::App* sub = app.add_subcommand(
        "evaluate", "Compare what the pruning rules remove of a scene's links with rays");
    auto command = std::make_shared<EvaluateCommand>();
    sub->add_option("SCENE.obj", command->scene, "Wavefront OBJ with MTL, as for render")
        ->required();
    sub->add_option("--scale", command->scale,
                    "Metres a unit of the file; OBJ files do not say what theirs is")
        ->check(CLI::Range(1e-6, 1e6))
        ->capture_default_str();
    sub->add_option("--format", command->format, "Of the table on standard output")
        ->transform(CLI::IsMember({"TEXT", "CSV", "JSON"}, CLI::ignore_case))
        ->capture_default_str();
    sub->add_option("--rays", command->rays.truth, "Rays that say whether a link is blocked")
        ->check(CLI::Range(1, 4096))
        ->capture_default_str();
    add_option_flags(*sub, command->options);
    sub->footer(
        "\"explicit\" counts the links that no ray gets through; \"incorrect\" those that a rule "
        "removes although one does, \"not_removed\" those that it leaves. Error, bias and largest "
        "leak are those of the solution over the links that are left, against one whose links are "
        "tested with rays, relative to its mean irradiance.");
    sub->callback([command] { run(*command); });
}

}  // namespace antiradiance
