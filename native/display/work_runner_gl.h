// SPDX-License-Identifier: GPL-3.0-or-later
// Runs one of the display's programs over all fragments and their lists of nodes, in dispatches of
// some tens of milliseconds.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "display/display_backend_gl.h"
#include "display/work_batches_gl.h"
#include "gpu/gl_objects.h"
#include "gpu/gl_thread.h"

namespace antiradiance {

struct NodeRange {
    std::uint32_t begin = 0, count = 0;
    bool operator==(const NodeRange&) const = default;
};

// A program, and what it needs to know of the nodes in a range. On the OpenGL thread.
class WorkTables {
public:
    virtual ~WorkTables() = default;
    virtual void send(NodeRange range) = 0;
    virtual void bind() const = 0;  // and the uniforms that are the program's own
    [[nodiscard]] virtual const gpu::Program& program() const = 0;
};

struct FragmentWork {
    const GBuffer& buffer;
    const FragmentGroups& groups;
    const SourceLists& lists;
    std::function<glsl::Receiver(const Fragment&)> receiver;
    std::size_t node_count;
    std::size_t bytes_per_node;  // of the largest table
};

class WorkRunner {
public:
    WorkRunner(std::shared_ptr<gpu::GlThread> thread, const GlDisplayConfig& config);

    [[nodiscard]] gpu::OnGlThread<gpu::Program> compile(const std::string& shader) const;

    // make(const gpu::Program&) -> std::unique_ptr of a WorkTables
    template <typename Make>
    [[nodiscard]] gpu::OnGlThread<WorkTables> make_tables(gpu::OnGlThread<gpu::Program>& program,
                                                          const Make& make) const {
        return {thread_, [&](gpu::GlContext&) {
                    return program.run([&](gpu::Program& p, gpu::GlContext&) { return make(p); });
                }};
    }

    // The sums of all fragments (#fragments), each in the order of its list; 0 where that is empty.
    // Throws Cancelled; gpu::GlError when the device fails.
    [[nodiscard]] std::vector<vec4> run(const FragmentWork& work,
                                        gpu::OnGlThread<WorkTables>& tables, Progress& progress,
                                        ProgressSpan span);

private:
    struct BatchBuffers;
    struct Run;

    [[nodiscard]] std::vector<vec4> run_batch(Run& run, const WorkBatch& batch,
                                              std::span<const glsl::Receiver> receivers,
                                              std::span<const NodeRange> ranges);
    void run_places(Run& run, const WorkBatch& batch, std::uint32_t first_place);
    void run_slice(Run& run, std::size_t first_item, std::size_t count, std::uint32_t first_place,
                   double pairs);

    std::shared_ptr<gpu::GlThread> thread_;
    GlDisplayConfig config_;
    double pairs_per_second_ = 10e6;  // measured as we go
};

}  // namespace antiradiance
