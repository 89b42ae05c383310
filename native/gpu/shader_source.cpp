// SPDX-License-Identifier: GPL-3.0-or-later
#include "gpu/shader_source.h"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <sstream>

#include "gpu/gl_error.h"

namespace antiradiance::gpu {
namespace {

constexpr const char* kFolderVariable = "ANTIRADIANCE_SHADERS";

// Of the shared library or executable that this function is linked into.
std::filesystem::path own_folder() {
    Dl_info info{};
    if (dladdr(reinterpret_cast<const void*>(&own_folder), &info) == 0) return {};
    std::error_code ignored;
    return std::filesystem::weakly_canonical(info.dli_fname, ignored).parent_path();
}

class Expander {
public:
    Expander(const std::filesystem::path& folder, std::span<const Definition> definitions)
        : folder_(folder), definitions_(definitions) {}

    ShaderSource expand(const std::string& name) {
        append(name, "");
        return std::move(source_);
    }

private:
    void append(const std::string& name, const std::string& included_by) {
        std::ifstream file(folder_ / name);
        if (!file) {
            throw GlError("can't read the shader " + (folder_ / name).string() +
                          (included_by.empty() ? "" : ", included by " + included_by));
        }
        const std::size_t number = source_.files.size();
        source_.files.push_back(name);
        std::string line;
        std::size_t line_number = 0;
        if (number == 0) {
            std::getline(file, line);
            ++line_number;
            source_.text = line + "\n";
            for (const Definition& d : definitions_) {
                source_.text += "#define " + d.name + " " + d.value + "\n";
            }
        }
        begin_part(line_number + 1, number);
        while (std::getline(file, line)) {
            ++line_number;
            std::smatch match;
            if (!std::regex_match(line, match, include_)) {
                source_.text += line + "\n";
                continue;
            }
            const std::string target = match[1];
            if (std::ranges::find(source_.files, target) == source_.files.end()) {
                append(target, name + ":" + std::to_string(line_number));
            }
            begin_part(line_number + 1, number);
        }
    }

    void begin_part(std::size_t line, std::size_t file) {
        source_.text += "#line " + std::to_string(file * ShaderSource::kLinesPerFile + line) + "\n";
    }

    const std::filesystem::path& folder_;
    std::span<const Definition> definitions_;
    const std::regex include_{R"re(\s*#\s*include\s+"([^"]+)"\s*(//.*)?)re"};
    ShaderSource source_;
};

}  // namespace

std::filesystem::path shader_folder() {
    std::vector<std::filesystem::path> candidates;
    if (const char* chosen = std::getenv(kFolderVariable)) {
        candidates = {chosen};
    } else {
        candidates = {own_folder() / "shaders", ANTIRADIANCE_SOURCE_SHADERS};
    }
    std::string tried;
    for (const std::filesystem::path& folder : candidates) {
        if (std::filesystem::is_directory(folder)) return folder;
        tried += (tried.empty() ? "" : ", ") + folder.string();
    }
    throw GlError("the shader folder is missing; looked for " + tried);
}

ShaderSource load_shader(const std::filesystem::path& folder, const std::string& name,
                         std::span<const Definition> definitions) {
    return Expander(folder, definitions).expand(name);
}

std::string ShaderSource::name_files(const std::string& log) const {
    // "0:12(3): error" (Mesa), "0(12) : error" (NVIDIA), "ERROR: 0:12: ..." (AMD, Intel).
    static const std::regex kPlace(R"re(^((?:ERROR|WARNING): )?\d+[:(](\d+)\)?(\(\d+\))?)re");
    std::istringstream lines(log);
    std::string named, line;
    while (std::getline(lines, line)) {
        std::smatch match;
        if (std::regex_search(line, match, kPlace)) {
            const std::size_t number = std::stoul(match[2]);
            const std::size_t file = number / kLinesPerFile;
            if (file < files.size()) {
                line = match[1].str() + files[file] + ":" + std::to_string(number % kLinesPerFile) +
                       match[3].str() + match.suffix().str();
            }
        }
        named += line + "\n";
    }
    return named;
}

}  // namespace antiradiance::gpu
