// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/picture_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/error.h"

namespace antiradiance {
namespace {

namespace fs = std::filesystem;

std::string path_of(const std::string& name) {
    const fs::path folder = fs::path(ANTIRADIANCE_BINARY_DIR) / "test-files" / "picture_file";
    fs::create_directories(folder);
    return (folder / name).string();
}

Picture gradient() {
    Picture picture;
    picture.width = 3;
    picture.height = 2;
    for (int i = 0; i < 6; ++i) {
        const float v = 0.2F * static_cast<float>(i);
        picture.combined.emplace_back(v, v * v, 1 - v, 1);
    }
    return picture;
}

void expect_round_trip(const std::string& name, float tolerance) {
    const Picture picture = gradient();
    const std::string path = path_of(name);
    PictureFile(path).write(picture);
    const Texture read = read_texture(path);
    ASSERT_EQ(read.width, 3);
    ASSERT_EQ(read.height, 2);
    for (std::size_t i = 0; i < 6; ++i) {
        for (int c = 0; c < 4; ++c)
            EXPECT_NEAR(read.pixels[i][c], picture.combined[i][c], tolerance) << i << ", " << c;
    }
}

TEST(picture_file, exr_keeps_half_floats) {
    expect_round_trip("gradient.exr", 1e-3F);
}

TEST(picture_file, png_keeps_8_bits_of_srgb) {
    expect_round_trip("gradient.PNG", 5e-3F);
}

TEST(picture_file, exr_keeps_what_is_brighter_than_white) {
    Picture picture = gradient();
    picture.combined[4] = vec4(100, 0, -1, 1);
    const std::string path = path_of("bright.exr");
    PictureFile(path).write(picture);
    EXPECT_EQ(read_texture(path).pixels[4], vec4(100, 0, -1, 1));
}

TEST(picture_file, knows_its_extensions) {
    EXPECT_TRUE(PictureFile::has_known_extension("a/b.exr"));
    EXPECT_TRUE(PictureFile::has_known_extension("B.PNG"));
    EXPECT_FALSE(PictureFile::has_known_extension("b.jpg"));
    EXPECT_FALSE(PictureFile::has_known_extension("png"));
}

TEST(picture_file, says_at_once_that_a_path_cannot_be_written) {
    try {
        PictureFile(path_of("no/such/folder/a.png"));
        FAIL() << "no error";
    } catch (const SceneError& error) {
        EXPECT_NE(std::string(error.what()).find("No such file or directory"), std::string::npos)
            << error.what();
    }
}

TEST(picture_file, leaves_nothing_and_harms_nothing_before_it_writes) {
    const std::string fresh = path_of("fresh.png");
    fs::remove(fresh);
    const PictureFile to_fresh(fresh);
    EXPECT_FALSE(fs::exists(fresh));

    const std::string old = path_of("old.png");
    std::ofstream(old) << "old";
    const PictureFile to_old(old);
    EXPECT_EQ(fs::file_size(old), 3U);
}

}  // namespace
}  // namespace antiradiance
