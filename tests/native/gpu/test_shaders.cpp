// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <filesystem>
#include <fstream>
#include <numeric>

#include "gpu/gl_objects.h"
#include "gpu/gl_test.h"
#include "gpu/shader_source.h"

namespace antiradiance::gpu {
namespace {

namespace fs = std::filesystem;

// A folder of shader files that goes with the test.
class ShaderFolder {
public:
    explicit ShaderFolder(const std::string& name)
        : path_(fs::path(ANTIRADIANCE_BINARY_DIR) / "test-shaders" / name) {
        fs::remove_all(path_);
        fs::create_directories(path_ / "shared");
    }
    ~ShaderFolder() { fs::remove_all(path_); }
    ShaderFolder(const ShaderFolder&) = delete;
    ShaderFolder& operator=(const ShaderFolder&) = delete;

    void write(const std::string& name, const std::string& text) const {
        std::ofstream(path_ / name) << text;
    }
    [[nodiscard]] const fs::path& path() const { return path_; }

private:
    fs::path path_;
};

TEST(ShaderSource, IncludesOnceAndKeepsLineNumbers) {
    const ShaderFolder folder("include");
    folder.write("shared/a.glsl", "#include \"shared/b.glsl\"\nint a;\n");
    folder.write("shared/b.glsl", "int b;\n");
    folder.write("main.comp",
                 "#version 450 core\n#include \"shared/a.glsl\"\n"
                 "#include \"shared/b.glsl\"\nvoid main() {}\n");
    const std::array<Definition, 2> definitions{Definition{"USE_A"}, Definition{"COUNT", "3"}};
    const ShaderSource source = load_shader(folder.path(), "main.comp", definitions);
    EXPECT_EQ(source.text,
              "#version 450 core\n#define USE_A 1\n#define COUNT 3\n#line 2\n"
              "#line 100001\n#line 200001\nint b;\n#line 100002\nint a;\n"
              "#line 3\n#line 4\nvoid main() {}\n");
    EXPECT_EQ(source.files,
              (std::vector<std::string>{"main.comp", "shared/a.glsl", "shared/b.glsl"}));
}

TEST(ShaderSource, MissingIncludeNamesWhoWantsIt) {
    const ShaderFolder folder("missing");
    folder.write("main.comp", "#version 450 core\n\n#include \"shared/none.glsl\"\n");
    try {
        (void)load_shader(folder.path(), "main.comp");
        FAIL() << "loaded a file that is not there";
    } catch (const GlError& error) {
        EXPECT_NE(std::string(error.what()).find("shared/none.glsl, included by main.comp:3"),
                  std::string::npos)
            << error.what();
    }
}

TEST(ShaderSource, NamesFilesInEveryDriversLog) {
    const ShaderSource source{"", {"main.comp", "shared/a.glsl"}};
    EXPECT_EQ(source.name_files("0:100012(3): error: x\n0(7) : error C1: y\n"
                                "ERROR: 0:100002: z\n0:900001(1): w\n"),
              "shared/a.glsl:12(3): error: x\nmain.comp:7 : error C1: y\n"
              "ERROR: shared/a.glsl:2: z\n0:900001(1): w\n");
}

class ShaderTest : public GlTest {};

TEST_F(ShaderTest, CompileErrorNamesFileAndLine) {
    const ShaderFolder folder("error");
    folder.write("shared/a.glsl", "float fine;\n\nfloat broken = nothing;\n");
    folder.write("main.comp", "#version 450 core\n#include \"shared/a.glsl\"\nvoid main() {}\n");
    try {
        gl->run(
            [&](GlContext&) { (void)Program::compute(load_shader(folder.path(), "main.comp")); });
        FAIL() << "compiled an undeclared name";
    } catch (const GlError& error) {
        EXPECT_NE(std::string(error.what()).find("shared/a.glsl:3("), std::string::npos)
            << error.what();
    }
}

TEST_F(ShaderTest, ComputesOnABuffer) {
    const ShaderFolder folder("compute");
    folder.write("main.comp",
                 "#version 450 core\n"
                 "layout(local_size_x = 64) in;\n"
                 "layout(std430, binding = 1) buffer Values { float values[]; };\n"
                 "layout(location = 0) uniform uint count;\n"
                 "layout(location = 1) uniform float factor;\n"
                 "void main() {\n"
                 "    uint i = gl_GlobalInvocationID.x;\n"
                 "    if (i < count) values[i] *= factor;\n"
                 "}\n");
    std::vector<float> values(1000);
    std::iota(values.begin(), values.end(), 0.0F);
    const std::vector<float> result = gl->run([&](GlContext&) {
        const Program program = Program::compute(load_shader(folder.path(), "main.comp"));
        const Buffer<float> buffer{std::span<const float>(values)};
        buffer.bind(1);
        program.set(0, 999U);
        program.set(1, 3.0F);
        const TimerQuery timer;
        timer.begin();
        program.dispatch(16);
        timer.end();
        EXPECT_GT(timer.nanoseconds(), 0U);
        return buffer.read();
    });
    for (std::size_t i = 0; i < 999; ++i)
        EXPECT_EQ(result[i], 3.0F * values[i]);
    EXPECT_EQ(result[999], 999.0F);
}

// Every compute shader of the repository, as it stands; the solver's own tests compile its
// variants, those of shadow maps what they draw with.
TEST_F(ShaderTest, AllComputeShadersCompile) {
    int count = 0;
    const fs::path folder = shader_folder();
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.path().extension() != ".comp") continue;
        const std::string name = fs::relative(entry.path(), folder).generic_string();
        EXPECT_NO_THROW(gl->run([&](GlContext&) {
            (void)Program::compute(load_shader(folder, name));
        })) << name;
        ++count;
    }
    EXPECT_GT(count, 0) << "no shaders under " << folder;
}

}  // namespace
}  // namespace antiradiance::gpu
