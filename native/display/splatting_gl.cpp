// SPDX-License-Identifier: GPL-3.0-or-later
#include "display/splatting_gl.h"

namespace antiradiance {

namespace {

using gpu::Buffer;
using gpu::Program;

// The leaves' disks, of the nodes that are there at a time.
class DiskTable final : public WorkTables {
public:
    DiskTable(const SplattingInput& input, const Program& program)
        : in_(input), program_(program) {}

    void send(NodeRange range) override {
        const PatchTree& tree = in_.tree;
        std::vector<glsl::Disk> disks;
        disks.reserve(range.count);
        for (std::size_t n = range.begin; n < range.begin + range.count; ++n) {
            disks.push_back({tree.center[n], glsl::kFootprint * tree.radius[n], tree.normal[n],
                             tree.exposed[n], in_.irradiance[n], 0});
        }
        disks_ = Buffer<glsl::Disk>(std::span<const glsl::Disk>(disks));
    }
    void bind() const override { disks_.bind(glsl::kLightsBinding); }
    [[nodiscard]] const Program& program() const override { return program_; }

private:
    const SplattingInput& in_;
    const Program& program_;
    Buffer<glsl::Disk> disks_;
};

glsl::Receiver receiver_of(const Fragment& f) {
    return {f.position, kNone, f.normal, 0, f.shading_normal, 0};
}

}  // namespace

GlSplatting::GlSplatting(WorkRunner& runner)
    : runner_(runner), program_(runner.compile("display/splat.comp")) {}

std::vector<vec3> GlSplatting::splat(const SplattingInput& input, Progress& progress,
                                     ProgressSpan span) {
    gpu::OnGlThread<WorkTables> tables = runner_.make_tables(program_, [&](const Program& program) {
        return std::make_unique<DiskTable>(input, program);
    });
    const std::vector<vec4> sums = runner_.run({input.buffer, input.groups, input.disks,
                                                receiver_of, input.tree.size(), sizeof(glsl::Disk)},
                                               tables, progress, span);
    std::vector<vec3> irradiance(sums.size(), vec3(0));
    for (const std::uint32_t f : input.groups.order)
        irradiance[f] = splatted_mean(input, input.buffer.fragments[f], vec3(sums[f]), sums[f].w);
    return irradiance;
}

}  // namespace antiradiance
