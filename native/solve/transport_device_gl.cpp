// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/transport_device_gl.h"

#include <algorithm>
#include <string>

#include "gpu/shader_source.h"

namespace antiradiance {
namespace {

using gpu::Buffer;
using gpu::Definition;
using gpu::Program;

static_assert(sizeof(Link) == sizeof(glsl::Link) &&
              offsetof(Link, form_factor) == offsetof(glsl::Link, form_factor));

template <class T>
Buffer<T> buffer_of(const std::vector<T>& values) {
    return Buffer<T>(std::span<const T>(values));
}

std::uint32_t divide_up(std::size_t a, std::size_t b) {
    return static_cast<std::uint32_t>((a + b - 1) / b);
}

std::uint32_t u32(std::size_t i) {
    return static_cast<std::uint32_t>(i);
}

// Throws where an array of the problem is larger than what a shader can see at once.
void check_block(const gpu::DeviceInfo& info, std::size_t bytes, const char* what) {
    if (bytes <= info.max_storage_block_bytes) return;
    throw gpu::GlError(std::string("the ") + what + " of this scene need " +
                       std::to_string(bytes >> 20U) + " MiB in one buffer, the OpenGL device has " +
                       std::to_string(info.max_storage_block_bytes >> 20U) +
                       " MiB; use larger patches or the CPU solver");
}

}  // namespace

TransportPrograms::TransportPrograms(bool antiradiance, bool clusters) {
    std::vector<Definition> definitions;
    if (antiradiance) definitions.push_back({"HAS_ANTIRADIANCE"});
    if (clusters) definitions.push_back({"HAS_CLUSTERS"});
    const std::filesystem::path folder = gpu::shader_folder();
    const auto load = [&](const char* name) {
        return Program::compute(gpu::load_shader(folder, name, definitions));
    };
    scatter_antiradiance = load("solve/scatter_antiradiance.comp");
    pull_antiradiance = load("solve/pull_antiradiance.comp");
    push_antiradiance = load("solve/push_antiradiance.comp");
    gather = load("solve/gather.comp");
    gather_long = load("solve/gather_long.comp");
    collect = load("solve/collect.comp");
    light_surfaces = load("solve/light_surfaces.comp");
    reflect = load("solve/reflect.comp");
    reduce_state = load("solve/reduce_state.comp");
    pull_radiance = load("solve/pull_radiance.comp");
    pull_moments = load("solve/pull_moments.comp");
}

TransportDevice::TransportDevice(const gpu::DeviceInfo& info, const Config& config,
                                 const TransportPrograms& programs, const LinkSet& links,
                                 const NodeTables& tables, const std::vector<Chunk>& chunks)
    : config_(config),
      programs_(programs),
      links_(links),
      tables_(tables),
      chunks_(chunks),
      max_work_groups_(info.max_work_groups),
      node_count_(tables.nodes.size()) {
    std::size_t batch_bins = 0;
    for (const Chunk& chunk : chunks) {
        for (const Batch& batch : chunk.batches) {
            batch_bins = std::max<std::size_t>(batch_bins, batch.bin_count);
        }
    }
    const std::size_t moments = config.clusters ? glsl::kMomentCount * tables.cluster_count : 0;
    check_block(info, node_count_ * sizeof(vec4), "patches");
    check_block(info, moments * sizeof(vec4), "clusters");
    if (config.antiradiance) {
        check_block(info, batch_bins * node_count_ * sizeof(vec4), "patches' antiradiance");
        own_antiradiance_ = Buffer<vec4>(batch_bins * node_count_);
        antiradiance_ = Buffer<vec4>(batch_bins * node_count_);
    }
    nodes_ = buffer_of(tables.nodes);
    levels_ = buffer_of(tables.levels);
    leaves_ = buffer_of(tables.leaves);
    surfaces_ = buffer_of(tables.surfaces);
    axes_ = buffer_of(tables.axes);
    radiance_ = buffer_of(tables.radiance);
    irradiance_ = Buffer<vec4>(node_count_);
    sent_moments_ = Buffer<vec4>(moments);
    received_moments_ = Buffer<vec4>(moments);
    state_ = Buffer<glsl::PassState>(1 + divide_up(tables.leaves.size(), glsl::kWorkGroupSize));
    send_chunks(config.resident_bytes);

    bind_nodes();
    bind_chunk(0);
    warm_up();
    state_.write(std::span(&tables.state, 1));
    if (config_.clusters) {
        for (const ItemRange& level : tables_.cluster_levels) {
            run_items(programs_.pull_moments, level);
        }
    }
}

std::span<const Link> TransportDevice::chunk_links(const Chunk& chunk) const {
    return std::span(links_.links).subspan(chunk.links.begin, chunk.links.size());
}

void TransportDevice::send_chunks(std::size_t resident_bytes) {
    std::size_t used = 0, streamed_links = 0, streamed_segments = 0;
    for (const Chunk& chunk : chunks_) {
        ChunkBuffers& buffers = chunk_buffers_.emplace_back();
        buffers.flux = Buffer<float>(3 * chunk.segments.size());
        buffers.receivers = buffer_of(chunk.receivers);
        const std::size_t bytes =
            chunk.links.size() * sizeof(Link) + chunk.segments.size() * sizeof(glsl::Segment);
        if (used + bytes <= resident_bytes) {
            used += bytes;
            buffers.links = Buffer<Link>(chunk_links(chunk));
            buffers.segments = buffer_of(chunk.segments);
        } else {
            streamed_links = std::max<std::size_t>(streamed_links, chunk.links.size());
            streamed_segments = std::max(streamed_segments, chunk.segments.size());
        }
    }
    streamed_links_ = Buffer<Link>(streamed_links);
    streamed_segments_ = Buffer<glsl::Segment>(streamed_segments);
}

void TransportDevice::bind_nodes() const {
    nodes_.bind(glsl::kNodesBinding);
    levels_.bind(glsl::kLevelsBinding);
    leaves_.bind(glsl::kLeavesBinding);
    surfaces_.bind(glsl::kSurfacesBinding);
    axes_.bind(glsl::kAxesBinding);
    radiance_.bind(glsl::kRadianceBinding);
    own_antiradiance_.bind(glsl::kOwnAntiradianceBinding);
    antiradiance_.bind(glsl::kAntiradianceBinding);
    irradiance_.bind(glsl::kIrradianceBinding);
    sent_moments_.bind(glsl::kSentMomentsBinding);
    received_moments_.bind(glsl::kReceivedMomentsBinding);
    state_.bind(glsl::kStateBinding);
}

void TransportDevice::bind_chunk(std::size_t c) {
    ChunkBuffers& buffers = chunk_buffers_[c];
    const Chunk& chunk = chunks_[c];
    const bool resident = buffers.segments.size() == chunk.segments.size();
    if (!resident) {
        streamed_links_.write(chunk_links(chunk));
        streamed_segments_.write(chunk.segments);
    }
    (resident ? buffers.links : streamed_links_).bind(glsl::kLinksBinding);
    (resident ? buffers.segments : streamed_segments_).bind(glsl::kSegmentsBinding);
    buffers.flux.bind(glsl::kFluxBinding);
    buffers.receivers.bind(glsl::kReceiversBinding);
}

// Drivers finish compiling a shader when it first runs; it does so here, over no items, because
// that is no part of an iteration's time.
void TransportDevice::warm_up() {
    const TransportPrograms& p = programs_;
    for (const Program* program : {&p.scatter_antiradiance, &p.pull_antiradiance,
                                   &p.push_antiradiance, &p.gather, &p.gather_long, &p.collect}) {
        program->set(glsl::kNodeCountLocation, u32(node_count_));
    }
    for (const Program* program :
         {&p.scatter_antiradiance, &p.pull_antiradiance, &p.push_antiradiance, &p.gather,
          &p.gather_long, &p.collect, &p.light_surfaces, &p.reflect, &p.reduce_state,
          &p.pull_radiance, &p.pull_moments}) {
        program->set(glsl::kFirstLocation, 0U);
        program->set(glsl::kCountLocation, 0U);
        program->dispatch(1);
    }
    set_relaxation(1);
}

void TransportDevice::set_relaxation(float relaxation) {
    for (const Program* program : {&programs_.gather, &programs_.gather_long, &programs_.reflect}) {
        program->set(glsl::kRelaxationLocation, relaxation);
    }
}

void TransportDevice::run_items(const Program& program, ItemRange items, std::size_t rows) const {
    const std::size_t most = max_work_groups_ * glsl::kWorkGroupSize;
    for (std::size_t begin = items.begin; begin < items.end; begin += most) {
        const std::size_t count = std::min<std::size_t>(most, items.end - begin);
        program.set(glsl::kFirstLocation, u32(begin));
        program.set(glsl::kCountLocation, u32(count));
        program.dispatch(divide_up(count, glsl::kWorkGroupSize), rows);
    }
}

void TransportDevice::add_antiradiance_steps(const Batch& batch, std::vector<Step>& steps) {
    const std::size_t rows = batch.bin_count;
    steps.push_back({[this, &batch] {
                         own_antiradiance_.clear();
                         programs_.scatter_antiradiance.set(glsl::kFirstBinLocation,
                                                            batch.first_bin);
                         run_items(programs_.scatter_antiradiance, batch.segments);
                     },
                     static_cast<double>(node_count_ * rows)});
    for (const ItemRange& level : tables_.patch_levels) {
        steps.push_back(
            {[this, level, rows] { run_items(programs_.pull_antiradiance, level, rows); },
             static_cast<double>(4 * rows * level.size())});
    }
    steps.push_back({[this, rows] {
                         run_items(programs_.push_antiradiance, {0, u32(node_count_)}, rows);
                     },
                     static_cast<double>(4 * rows * node_count_)});
}

void TransportDevice::add_chunk_steps(std::size_t c, std::vector<Step>& steps) {
    const Chunk& chunk = chunks_[c];
    const auto links_of = [](ItemRange range, const std::vector<glsl::Segment>& segments) {
        double links = 0;
        for (std::uint32_t s = range.begin; s < range.end; ++s) {
            links += segments[s].bin_and_count & ((1U << glsl::kSegmentCountBits) - 1U);
        }
        return links;
    };
    steps.push_back({[this, c] { bind_chunk(c); }, 0});
    for (const Batch& batch : chunk.batches) {
        if (config_.antiradiance) add_antiradiance_steps(batch, steps);
        for (const ItemRange& range : batch.short_steps) {
            steps.push_back({[this, &batch, range] {
                                 programs_.gather.set(glsl::kFirstBinLocation, batch.first_bin);
                                 run_items(programs_.gather, range);
                             },
                             links_of(range, chunk.segments)});
        }
        for (const ItemRange& range : batch.long_steps) {
            steps.push_back({[this, &batch, range] {
                                 const Program& program = programs_.gather_long;
                                 program.set(glsl::kFirstBinLocation, batch.first_bin);
                                 for (std::size_t begin = range.begin; begin < range.end;
                                      begin += max_work_groups_) {
                                     const std::size_t count =
                                         std::min<std::size_t>(max_work_groups_, range.end - begin);
                                     program.set(glsl::kFirstLocation, u32(begin));
                                     program.set(glsl::kCountLocation, u32(count));
                                     program.dispatch(count);
                                 }
                             },
                             links_of(range, chunk.segments)});
        }
    }
    steps.push_back({[this, c] {
                         programs_.collect.set(glsl::kAddLocation, c == 0 ? 0U : 1U);
                         run_items(programs_.collect, {0, u32(node_count_)});
                     },
                     static_cast<double>(chunk.segments.size() + node_count_)});
}

void TransportDevice::add_node_steps(std::vector<Step>& steps) {
    if (config_.clusters) {
        steps.push_back({[this] {
                             run_items(programs_.light_surfaces, {0, u32(surfaces_.size())});
                         },
                         static_cast<double>(100 * surfaces_.size())});
    }
    steps.push_back({[this] {
                         run_items(programs_.reflect, {0, u32(leaves_.size())});
                         programs_.reduce_state.set(glsl::kFirstLocation, 1U);
                         programs_.reduce_state.set(glsl::kCountLocation, u32(state_.size() - 1));
                         programs_.reduce_state.dispatch(1);
                     },
                     static_cast<double>(4 * leaves_.size())});
    for (const ItemRange& level : tables_.patch_levels) {
        steps.push_back({[this, level] { run_items(programs_.pull_radiance, level); },
                         static_cast<double>(4 * level.size())});
    }
    if (!config_.clusters) return;
    for (const ItemRange& level : tables_.cluster_levels) {
        steps.push_back({[this, level] { run_items(programs_.pull_moments, level); },
                         static_cast<double>(20 * level.size())});
    }
}

std::vector<Step> TransportDevice::pass() {
    std::vector<Step> steps;
    for (std::size_t c = 0; c < chunks_.size(); ++c)
        add_chunk_steps(c, steps);
    add_node_steps(steps);
    return steps;
}

glsl::PassState TransportDevice::state() const {
    return state_.read(0, 1).front();
}

std::vector<vec4> TransportDevice::radiance() const {
    return radiance_.read();
}

std::vector<vec4> TransportDevice::irradiance() const {
    return irradiance_.read();
}

}  // namespace antiradiance
