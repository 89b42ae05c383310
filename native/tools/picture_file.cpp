// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/picture_file.h"

#include <OpenImageIO/color.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <utility>

#include "base/error.h"

namespace antiradiance {

namespace {

namespace fs = std::filesystem;

std::string extension_of(const std::string& path) {
    std::string extension = fs::path(path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

bool is_srgb(const OIIO::ImageSpec& spec) {
    const std::string space = spec.get_string_attribute("oiio:ColorSpace");
    return space.empty() ? !spec.format.is_floating_point() : space == "sRGB";
}

// One to four channels as in the file -> linear, associated alpha.
vec4 to_linear(const float* channels, const OIIO::ImageSpec& spec, bool srgb) {
    const bool is_grey = spec.nchannels < 3;
    vec4 pixel =
        is_grey ? vec4(vec3(channels[0]), 1) : vec4(channels[0], channels[1], channels[2], 1);
    if (srgb) {
        for (int c = 0; c < 3; ++c)
            pixel[c] = OIIO::sRGB_to_linear(pixel[c]);
    }
    if (spec.alpha_channel >= 0) {
        pixel.w = channels[spec.alpha_channel];
        if (spec.get_int_attribute("oiio:UnassociatedAlpha") != 0)
            pixel = vec4(vec3(pixel) * pixel.w, pixel.w);
    }
    return pixel;
}

}  // namespace

Texture read_texture(const std::string& path) {
    OIIO::ImageSpec hints;
    hints["oiio:UnassociatedAlpha"] = 1;  // as in the file: sRGB must be decoded before it is taken
    const auto input = OIIO::ImageInput::open(path, &hints);
    if (!input) throw SceneError(OIIO::geterror());
    const OIIO::ImageSpec& spec = input->spec();
    if (spec.nchannels > 4) {
        throw SceneError(path + " has " + std::to_string(spec.nchannels) +
                         " channels, of which none is known to be the colour: save it as a plain "
                         "picture, without layers or depth");
    }
    const auto width = static_cast<std::size_t>(spec.width);
    const auto height = static_cast<std::size_t>(spec.height);
    const auto channels = static_cast<std::size_t>(spec.nchannels);
    std::vector<float> values(width * height * channels);
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values.data()))
        throw SceneError(input->geterror());

    Texture texture;
    texture.name = path;
    texture.width = spec.width;
    texture.height = spec.height;
    texture.pixels.reserve(width * height);
    const bool srgb = is_srgb(spec);
    for (std::size_t row = height; row-- > 0;) {
        for (std::size_t column = 0; column < width; ++column) {
            texture.pixels.push_back(
                to_linear(&values[(row * width + column) * channels], spec, srgb));
        }
    }
    return texture;
}

bool PictureFile::has_known_extension(const std::string& path) {
    const std::string extension = extension_of(path);
    return extension == ".exr" || extension == ".png";
}

PictureFile::PictureFile(std::string path) : path_(std::move(path)) {
    const bool existed = fs::exists(path_);
    errno = 0;
    const bool writable = std::ofstream(path_, std::ios::app).is_open();
    const int reason = errno;
    if (!writable) {
        throw SceneError("The picture can't be written to '" + path_ +
                         "': " + std::strerror(reason) + "; name another file");
    }
    if (!existed) fs::remove(path_);
}

void PictureFile::write(const Picture& picture) const {
    const bool png = extension_of(path_) == ".png";
    const auto width = static_cast<std::size_t>(picture.width);
    const auto height = static_cast<std::size_t>(picture.height);
    std::vector<vec4> rows;  // from above
    rows.reserve(width * height);
    for (std::size_t row = height; row-- > 0;) {
        for (std::size_t column = 0; column < width; ++column) {
            vec4 pixel = picture.combined[row * width + column];
            if (png) {
                for (int c = 0; c < 3; ++c)
                    pixel[c] = OIIO::linear_to_sRGB(std::max(0.0F, pixel[c]));
            }
            rows.push_back(pixel);
        }
    }
    OIIO::ImageSpec spec(picture.width, picture.height, 4,
                         png ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::HALF);
    spec.attribute("oiio:ColorSpace", png ? "sRGB" : "Linear");
    const auto output = OIIO::ImageOutput::create(path_);
    if (!output || !output->open(path_, spec) ||
        !output->write_image(OIIO::TypeDesc::FLOAT, rows.data()) || !output->close()) {
        throw std::runtime_error("The picture could not be written to '" + path_ +
                                 "': " + (output ? output->geterror() : OIIO::geterror()));
    }
}

}  // namespace antiradiance
