// SPDX-License-Identifier: GPL-3.0-or-later
#include "display/work_runner_gl.h"

#include <algorithm>

#include "base/stopwatch.h"
#include "gpu/shader_source.h"

namespace antiradiance {

namespace {

// Device time between two looks at the caller.
constexpr double kSliceSeconds = 0.03;
// By how much a slice may change the measured rate: a driver's first run of a shader and a rest of
// little work tell nothing about it.
constexpr double kRateStep = 4;

GlDisplayConfig fill_defaults(GlDisplayConfig config, const gpu::DeviceInfo& device) {
    // Of unknown memory, or a quarter of what is free: three tables and a batch are there at once.
    constexpr std::size_t kUnknown = std::size_t{1} << 29U;
    if (config.block_bytes == 0) {
        config.block_bytes = std::min(device.max_storage_block_bytes,
                                      device.free_bytes != 0 ? device.free_bytes / 4 : kUnknown);
    }
    if (config.places_per_dispatch == 0) config.places_per_dispatch = 1024;
    return config;
}

std::vector<NodeRange> cut_nodes(std::size_t node_count, std::size_t per_range) {
    std::vector<NodeRange> ranges;
    for (std::size_t begin = 0; begin < node_count; begin += per_range) {
        ranges.push_back({static_cast<std::uint32_t>(begin),
                          static_cast<std::uint32_t>(std::min(per_range, node_count - begin))});
    }
    return ranges;
}

}  // namespace

// One batch on the device.
struct WorkRunner::BatchBuffers {
    BatchBuffers(const WorkBatch& batch, std::span<const glsl::Receiver> fragments)
        : receivers(fragments),
          items(std::span(batch.items)),
          lists(batch.lists),
          sums(batch.fragment_count) {}

    void bind() const {
        receivers.bind(glsl::kReceiversBinding);
        items.bind(glsl::kItemsBinding);
        lists.bind(glsl::kListsBinding);
        sums.bind(glsl::kSumsBinding);
    }

    gpu::Buffer<glsl::Receiver> receivers;
    gpu::Buffer<glsl::WorkItem> items;
    gpu::Buffer<NodeId> lists;
    gpu::Buffer<vec4> sums;
};

// Where a run is.
struct WorkRunner::Run {
    gpu::OnGlThread<WorkTables>& tables;
    Progress& progress;
    ProgressSpan span;
    double all_pairs = 0;
    double done_pairs = 0;
    NodeRange nodes{};
    gpu::OnGlThread<BatchBuffers>* batch = nullptr;
};

WorkRunner::WorkRunner(std::shared_ptr<gpu::GlThread> thread, const GlDisplayConfig& config)
    : thread_(std::move(thread)), config_(fill_defaults(config, thread_->device())) {}

gpu::OnGlThread<gpu::Program> WorkRunner::compile(const std::string& shader) const {
    return {thread_, [&](gpu::GlContext&) {
                return std::make_unique<gpu::Program>(
                    gpu::Program::compute(gpu::load_shader(gpu::shader_folder(), shader)));
            }};
}

// Bindings and uniforms are set each time: the context is others' as well between two slices.
void WorkRunner::run_slice(Run& run, std::size_t first_item, std::size_t count,
                           std::uint32_t first_place, double pairs) {
    Stopwatch watch;
    run.tables.run([&](WorkTables& tables, gpu::GlContext& context) {
        const gpu::Program& program = tables.program();
        tables.bind();
        run.batch->run([](BatchBuffers& buffers, gpu::GlContext&) { buffers.bind(); });
        program.set(glsl::kFirstItemLocation, static_cast<std::uint32_t>(first_item));
        program.set(glsl::kFirstPlaceLocation, first_place);
        program.set(glsl::kPlaceCountLocation, config_.places_per_dispatch);
        program.set(glsl::kFirstNodeLocation, run.nodes.begin);
        program.set(glsl::kNodeCountLocation, run.nodes.count);
        program.dispatch(count);
        context.finish();
    });
    pairs_per_second_ = std::clamp(pairs / watch.lap(), pairs_per_second_ / kRateStep,
                                   pairs_per_second_ * kRateStep);
    run.done_pairs += pairs;
    run.progress.report(run.span.begin + (run.span.end - run.span.begin) *
                                             static_cast<float>(run.done_pairs / run.all_pairs));
}

// Slices of as many items as the device does in time, one at least.
void WorkRunner::run_places(Run& run, const WorkBatch& batch, std::uint32_t first_place) {
    const std::size_t most = thread_->device().max_work_groups;
    for (std::size_t begin = 0; begin < batch.items.size();) {
        double pairs = 0;
        std::size_t end = begin;
        while (end < batch.items.size() && end - begin < most &&
               pairs < kSliceSeconds * pairs_per_second_) {
            pairs += WorkBatch::pairs(batch.items[end++], first_place, config_.places_per_dispatch);
        }
        if (pairs > 0) run_slice(run, begin, end - begin, first_place, pairs);
        begin = end;
    }
}

std::vector<vec4> WorkRunner::run_batch(Run& run, const WorkBatch& batch,
                                        std::span<const glsl::Receiver> receivers,
                                        std::span<const NodeRange> ranges) {
    gpu::OnGlThread<BatchBuffers> buffers(
        thread_, [&](gpu::GlContext&) { return std::make_unique<BatchBuffers>(batch, receivers); });
    run.batch = &buffers;
    for (const NodeRange& range : ranges) {
        if (run.nodes != range) {
            run.tables.run([&](WorkTables& tables, gpu::GlContext&) { tables.send(range); });
            run.nodes = range;
        }
        for (std::uint32_t place = 0; place < batch.longest_list;
             place += config_.places_per_dispatch)
            run_places(run, batch, place);
    }
    return buffers.run([](BatchBuffers& b, gpu::GlContext&) { return b.sums.read(); });
}

std::vector<vec4> WorkRunner::run(const FragmentWork& work, gpu::OnGlThread<WorkTables>& tables,
                                  Progress& progress, ProgressSpan span) {
    const std::vector<WorkBatch> batches =
        make_batches(work.groups, work.lists, config_.block_bytes);
    const std::vector<NodeRange> ranges = cut_nodes(
        work.node_count, std::max<std::size_t>(1, config_.block_bytes / work.bytes_per_node));
    Run run{tables, progress, span};
    for (const WorkBatch& batch : batches)
        run.all_pairs += batch.pairs() * static_cast<double>(ranges.size());

    std::vector<vec4> sums(work.buffer.fragments.size(), vec4(0));
    for (const WorkBatch& batch : batches) {
        const auto order =
            std::span(work.groups.order).subspan(batch.first_fragment, batch.fragment_count);
        std::vector<glsl::Receiver> receivers;
        receivers.reserve(order.size());
        for (const std::uint32_t i : order)
            receivers.push_back(work.receiver(work.buffer.fragments[i]));
        const std::vector<vec4> result = run_batch(run, batch, receivers, ranges);
        for (std::size_t i = 0; i < order.size(); ++i)
            sums[order[i]] = result[i];
    }
    return sums;
}

}  // namespace antiradiance
