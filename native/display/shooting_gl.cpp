// SPDX-License-Identifier: GPL-3.0-or-later
#include "display/shooting_gl.h"

#include <algorithm>
#include <array>

#include "display/interleave.h"

namespace antiradiance {

namespace {

using gpu::Buffer;
using gpu::Program;

static_assert(sizeof(BinWeights::Texel) == sizeof(glsl::BinTexel) && BinWeights::kNearest == 4);

// Lights, their shapes and their antiradiance, of the nodes that are there at a time.
class ShootingTables final : public WorkTables {
public:
    ShootingTables(const AntiradianceShooting& input, const Program& program)
        : in_(input), program_(program), bin_texels_(input.bins.texels()) {}

    static std::size_t bytes_per_node(const AntiradianceShooting& input) {
        return std::max({sizeof(glsl::Light), shape_size(input) * sizeof(vec4),
                         static_cast<std::size_t>(input.antiradiance.bins) * sizeof(vec3)});
    }

    void send(NodeRange range) override {
        std::vector<glsl::Light> lights;
        std::vector<vec4> shapes;
        lights.reserve(range.count);
        shapes.reserve(range.count * shape_size(in_));
        for (std::uint32_t i = range.begin; i < range.begin + range.count; ++i) {
            const auto node = static_cast<NodeId>(i);
            const PatchLight& l = in_.lights[node];
            lights.push_back({l.center, l.radius, l.normal, l.area, l.radiance,
                              in_.shooting.tree.surface[static_cast<std::size_t>(node)]});
            append_shape(node, shapes);
        }
        // The old tables go first: both would not fit.
        lights_ = {};
        shapes_ = {};
        antiradiance_ = {};
        lights_ = Buffer<glsl::Light>(std::span<const glsl::Light>(lights));
        shapes_ = Buffer<vec4>(std::span<const vec4>(shapes));
        const auto bins = static_cast<std::size_t>(in_.antiradiance.bins);
        antiradiance_ = Buffer<vec3>(
            std::span(in_.antiradiance.values).subspan(range.begin * bins, range.count * bins));
    }

    void bind() const override {
        lights_.bind(glsl::kLightsBinding);
        shapes_.bind(glsl::kShapesBinding);
        antiradiance_.bind(glsl::kAntiradianceBinding);
        bin_texels_.bind(glsl::kBinTexelsBinding);
        const auto set = [&](int location, int value) {
            program_.set(location, static_cast<std::uint32_t>(value));
        };
        program_.set(glsl::kEpsilonLocation, in_.epsilon);
        set(glsl::kSubsetsLocation, in_.shooting.interleave * in_.shooting.interleave);
        set(glsl::kSamplesLocation, in_.lights.samples());
        set(glsl::kBinsLocation, in_.antiradiance.bins);
        set(glsl::kFaceSizeLocation, in_.bins.face_size());
    }

    [[nodiscard]] const Program& program() const override { return program_; }

private:
    static std::size_t shape_size(const AntiradianceShooting& input) {
        return static_cast<std::size_t>(glsl::kShapeCorners + input.lights.samples());
    }

    void append_shape(NodeId node, std::vector<vec4>& shapes) const {
        if (in_.shooting.tree.is_cluster(node)) {  // a point
            shapes.resize(shapes.size() + shape_size(in_));
            return;
        }
        const std::array<vec3, 4> corners = in_.shooting.tree.patch_corners(node);
        const int last = in_.shooting.tree.corner_count(node) - 1;
        for (int k = 0; k < glsl::kShapeCorners; ++k)
            shapes.emplace_back(corners[static_cast<std::size_t>(std::min(k, last))], 0);
        for (const LightPoint& point : in_.lights.points(node))
            shapes.emplace_back(point.position, 0);
    }

    const AntiradianceShooting& in_;
    const Program& program_;
    Buffer<glsl::Light> lights_;
    Buffer<vec4> shapes_;
    Buffer<vec3> antiradiance_;
    Buffer<BinWeights::Texel> bin_texels_;
};

glsl::Receiver receiver_of(const ShootingInput& input, const Fragment& f) {
    const SurfaceId surface =
        f.leaf == kNone ? kNone : input.tree.surface[static_cast<std::size_t>(f.leaf)];
    return {f.position,       surface,
            f.normal,         interleave_subset(f.pixel, input.buffer.width, input.interleave),
            f.shading_normal, 0};
}

}  // namespace

GlShooting::GlShooting(WorkRunner& runner)
    : runner_(runner), program_(runner.compile("display/shoot.comp")) {}

std::vector<vec3> GlShooting::shoot(const AntiradianceShooting& input, Progress& progress,
                                    ProgressSpan span) {
    gpu::OnGlThread<WorkTables> tables = runner_.make_tables(program_, [&](const Program& program) {
        return std::make_unique<ShootingTables>(input, program);
    });
    const ShootingInput& in = input.shooting;
    const std::vector<vec4> sums = runner_.run(
        {in.buffer, in.groups, in.sources, [&](const Fragment& f) { return receiver_of(in, f); },
         in.tree.size(), ShootingTables::bytes_per_node(input)},
        tables, progress, span);
    const auto scale = static_cast<float>(in.interleave * in.interleave);
    std::vector<vec3> irradiance(sums.size());
    for (std::size_t i = 0; i < sums.size(); ++i)
        irradiance[i] = scale * vec3(sums[i]);
    return irradiance;
}

}  // namespace antiradiance
