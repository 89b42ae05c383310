// SPDX-License-Identifier: GPL-3.0-or-later
// Picture files through OpenImageIO: textures in, rendered pictures out.
#pragma once

#include <string>

#include "display/display.h"
#include "scene/scene.h"

namespace antiradiance {

// Every format that OpenImageIO knows; integer formats are taken for sRGB unless the file says that
// they are linear. Throws SceneError that says why the file can't be read.
Texture read_texture(const std::string& path);

// Where a rendered picture goes: linear RGBA in half floats as .exr, or sRGB in 8 bits as .png.
class PictureFile {
public:
    [[nodiscard]] static bool has_known_extension(const std::string& path);

    // Throws SceneError when nothing can be written there, before a long render finds out.
    explicit PictureFile(std::string path);
    void write(const Picture& picture) const;  // std::runtime_error when the disk is full

private:
    std::string path_;
};

}  // namespace antiradiance
