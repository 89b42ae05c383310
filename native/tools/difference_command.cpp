// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/difference_command.h"

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "display/difference.h"
#include "tools/picture_file.h"
#include "tools/picture_flag.h"

namespace antiradiance {

namespace {

struct DifferenceCommand {
    std::string first, second;  // files
    std::string picture;
};

PictureView view_of(const Texture& texture) {
    return {texture.width, texture.height, texture.pixels};
}

void run(const DifferenceCommand& command) {
    const Texture first = read_texture(command.first);
    const Texture second = read_texture(command.second);
    const Difference difference = luminance_difference(view_of(first), view_of(second));
    if (!command.picture.empty()) PictureFile(command.picture).write(difference.picture);
    const nlohmann::ordered_json figures = {{"mean_first", difference.mean_first},
                                            {"mean_second", difference.mean_second},
                                            {"relative_rms", difference.relative_rms},
                                            {"largest", difference.largest}};
    std::puts(figures.dump(2).c_str());
}

}  // namespace

void add_difference_command(CLI::App& app) {
    CLI::App* sub = app.add_subcommand("difference", "Show where two pictures differ in luminance");
    auto command = std::make_shared<DifferenceCommand>();
    sub->add_option("FIRST", command->first, "The picture to compare with")->required();
    sub->add_option("SECOND", command->second,
                    "Red where it is darker than FIRST, green where "
                    "it is brighter, at four times the difference")
        ->required();
    add_picture_flag(*sub, command->picture, "without it there are figures only");
    sub->footer(
        "Figures go to standard output as JSON, of linear luminance: both means, the RMS of the "
        "difference over the mean of FIRST (null where that is black), the largest difference.");
    sub->callback([command] { run(*command); });
}

}  // namespace antiradiance
