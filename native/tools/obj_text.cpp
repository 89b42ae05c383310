// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/obj_text.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <utility>

#include "base/error.h"

namespace antiradiance {

namespace {

constexpr std::string_view kSpace = " \t\r";
constexpr std::size_t kMostProblems = 10;  // of one file; the first say it all

std::string read_file(const std::string& path) {
    const auto fail = [&](const std::string& why) {
        throw SceneError("'" + path + "' can't be read: " + why);
    };
    if (std::filesystem::is_directory(path)) fail("it is a folder");
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    if (!file) fail(std::strerror(errno));
    std::ostringstream text;
    if (file.peek() != std::ifstream::traits_type::eof()) text << file.rdbuf();
    if (file.bad() || !text) fail("reading stopped in the middle of it");
    return std::move(text).str();
}

// A comment may end in a backslash (a Windows path) and continues nothing.
std::string join_continued_lines(std::string_view text) {
    std::string joined;
    joined.reserve(text.size());
    std::size_t owed = 0;  // newlines
    bool at_start = true;  // of a line, but for white space
    bool comment = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const std::string_view ahead = text.substr(i + 1, 2);
        if (text[i] == '\\' && !comment && (ahead.starts_with('\n') || ahead == "\r\n")) {
            joined += ' ';
            i += ahead.starts_with('\n') ? 1 : 2;
            ++owed;
            continue;
        }
        joined += text[i];
        if (text[i] == '\n') {
            joined.append(std::exchange(owed, 0), '\n');
            at_start = true;
            comment = false;
        } else if (at_start && kSpace.find(text[i]) == kSpace.npos) {
            at_start = false;
            comment = text[i] == '#';
        }
    }
    return joined;
}

std::string_view trimmed(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(kSpace), text.size()));
    return text.substr(0, text.find_last_not_of(kSpace) + 1);
}

// Cuts the first word off.
std::string_view take_word(std::string_view& text) {
    const std::string_view word = text.substr(0, text.find_first_of(kSpace));
    text = trimmed(text.substr(word.size()));
    return word;
}

bool is_finite_number(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return error == std::errc() && end == word.data() + word.size() &&
           std::abs(value) <= std::numeric_limits<float>::max();  // false for NaN
}

}  // namespace

ObjText::ObjText(const std::string& path)
    : path_(path), text_(join_continued_lines(read_file(path))) {}

std::vector<ObjText::Line> ObjText::lines() const {
    std::vector<Line> lines;
    std::string_view rest(text_);
    for (int number = 1; !rest.empty(); ++number) {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        std::string_view line = trimmed(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
        if (line.empty() || line.front() == '#') continue;
        const std::string_view keyword = take_word(line);
        lines.push_back({number, keyword, line});
    }
    return lines;
}

std::vector<std::string> ObjText::bad_numbers(std::span<const NumericStatement> statements) const {
    std::vector<std::string> problems;
    for (const Line& line : lines()) {
        const auto statement =
            std::find_if(statements.begin(), statements.end(),
                         [&](const NumericStatement& s) { return s.keyword == line.keyword; });
        if (statement == statements.end()) continue;
        std::string_view rest = line.rest;
        for (int i = 0; i < statement->count; ++i) {
            const std::string_view word = take_word(rest);
            if (is_finite_number(word)) continue;
            problems.push_back("'" + path_ + "', line " + std::to_string(line.number) + ": '" +
                               std::string(line.keyword) + "' needs " +
                               std::to_string(statement->count) + " finite numbers, but has '" +
                               std::string(line.rest) + "'");
            break;
        }
    }
    if (problems.size() > kMostProblems) {
        const std::size_t more = problems.size() - kMostProblems;
        problems.resize(kMostProblems);
        problems.push_back("'" + path_ + "': and " + std::to_string(more) + " more such lines");
    }
    return problems;
}

}  // namespace antiradiance
