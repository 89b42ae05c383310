// SPDX-License-Identifier: GPL-3.0-or-later
// GLSL files with #include, which OpenGL itself does not offer everywhere.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace antiradiance::gpu {

// A preprocessor definition that selects a variant of a shader.
struct Definition {
    std::string name;
    std::string value = "1";
};

struct ShaderSource {
    std::string text;                // one translation unit, with #line before each part of a file
    std::vector<std::string> files;  // names under the shader folder

    // Line n of files[i] is called line i * kLinesPerFile + n: of #line's own number for the file,
    // Mesa 22 keeps no trace in half of its messages.
    static constexpr std::size_t kLinesPerFile = 100000;

    // A compiler's log with the file's name and line in place of the joint number.
    [[nodiscard]] std::string name_files(const std::string& log) const;
};

// shaders/ as it was staged beside the module or executable, else the source tree's that this was
// built from; the environment's ANTIRADIANCE_SHADERS before both. Throws GlError.
[[nodiscard]] std::filesystem::path shader_folder();

// The file `name` under `folder`. A line `#include "NAME"` is replaced by that file, NAME also
// being under `folder`, unless it was included before. The definitions follow the first line, which
// must be the file's #version. Throws GlError when a file can't be read, naming who includes it.
[[nodiscard]] ShaderSource load_shader(const std::filesystem::path& folder, const std::string& name,
                                       std::span<const Definition> definitions = {});

}  // namespace antiradiance::gpu
