// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/picture_flag.h"

#include "tools/picture_file.h"

namespace antiradiance {

void add_picture_flag(CLI::App& command, std::string& path, const std::string& otherwise) {
    const auto check = [](const std::string& given) {
        return PictureFile::has_known_extension(given) ? std::string()
                                                       : given + " must end in .exr or .png";
    };
    command
        .add_option("-o,--output", path,
                    "Picture to write, .exr (linear) or .png (sRGB); " + otherwise)
        ->type_name("PICTURE")
        ->check(CLI::Validator(check, ""));
}

}  // namespace antiradiance
