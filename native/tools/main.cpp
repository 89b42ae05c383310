// SPDX-License-Identifier: GPL-3.0-or-later
// The engine without Blender. Exit codes: 0 done, 1 failed, 2 wrong usage, 130 cancelled.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "base/error.h"
#include "tools/difference_command.h"
#include "tools/evaluate_command.h"
#include "tools/render_command.h"

namespace {

constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;
constexpr int kCancelled = 130;  // what a shell says of a process that Ctrl-C ended

// Parsing runs the command.
int run(int argc, char** argv) {
    CLI::App app{"Radiosity with antiradiance, without Blender", "antiradiance"};
    app.require_subcommand(1);
    antiradiance::add_render_command(app);
    antiradiance::add_difference_command(app);
    antiradiance::add_evaluate_command(app);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : kWrongUsage;  // asking for help is no error
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const antiradiance::Cancelled&) {
        std::fputs("cancelled\n", stderr);
        return kCancelled;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "error: %s\n", error.what());
        return kFailed;
    }
}
