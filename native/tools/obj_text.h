// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace antiradiance {

// A statement that takes numbers: `Kd 0.8 0.8 0.8`.
struct NumericStatement {
    std::string_view keyword;
    int count;  // numbers that it needs; more may follow
};

// A text file of Wavefront's kind, OBJ or MTL: one statement a line, `#` starts a comment, a
// backslash at the end of a line continues it on the next.
class ObjText {
public:
    // Throws SceneError that says why the file can't be read.
    explicit ObjText(const std::string& path);

    // With continued lines joined; blank ones take their place, so that line numbers stay.
    [[nodiscard]] const std::string& text() const { return text_; }

    struct Line {
        int number;  // from 1
        std::string_view keyword;
        std::string_view rest;  // without the white space around it
    };
    [[nodiscard]] std::vector<Line> lines() const;  // those with a statement

    // One line a number that is missing, not a number or not finite. tinyobjloader takes 0 instead
    // and says nothing.
    [[nodiscard]] std::vector<std::string> bad_numbers(
        std::span<const NumericStatement> statements) const;

private:
    std::string path_;
    std::string text_;
};

}  // namespace antiradiance
