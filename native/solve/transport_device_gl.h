// SPDX-License-Identifier: GPL-3.0-or-later
// The arrays of one problem on the device, and one pass over its links as a list of short steps.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "gpu/gl_objects.h"
#include "solve/transport_tables_gl.h"

namespace antiradiance {

// shaders/solve, compiled for links with or without antiradiance and clusters.
struct TransportPrograms {
    TransportPrograms(bool antiradiance, bool clusters);
    gpu::Program scatter_antiradiance, pull_antiradiance, push_antiradiance;
    gpu::Program gather, gather_long, collect, light_surfaces;
    gpu::Program reflect, reduce_state, pull_radiance, pull_moments;
};

// A few milliseconds of device time, so that the caller can stop in between.
struct Step {
    std::function<void()> dispatch;  // on the OpenGL thread
    double work;                     // links or array elements that it goes through
};

// Made, used and destroyed on the OpenGL thread. Borrows the links, tables and chunks.
class TransportDevice {
public:
    struct Config {
        bool antiradiance;           // some links carry it
        bool clusters;               // some links end at clusters
        std::size_t resident_bytes;  // links and segments beyond this are sent again in every pass
    };
    TransportDevice(const gpu::DeviceInfo& info, const Config& config,
                    const TransportPrograms& programs, const LinkSet& links,
                    const NodeTables& tables, const std::vector<Chunk>& chunks);

    // One pass of Jacobi: L and A of the next state from those of this one.
    [[nodiscard]] std::vector<Step> pass();

    // Of the next dispatches: share of the new value in the next state.
    void set_relaxation(float relaxation);

    [[nodiscard]] glsl::PassState state() const;
    [[nodiscard]] std::vector<vec4> radiance() const;    // #nodes; not of clusters
    [[nodiscard]] std::vector<vec4> irradiance() const;  // #nodes; of leaves

private:
    struct ChunkBuffers {
        gpu::Buffer<float> flux;               // stays: the state
        gpu::Buffer<std::uint32_t> receivers;  // stays
        gpu::Buffer<Link> links;               // empty when it does not stay
        gpu::Buffer<glsl::Segment> segments;   // likewise
    };

    void send_chunks(std::size_t resident_bytes);
    void bind_chunk(std::size_t c);
    void bind_nodes() const;
    void warm_up();
    void add_chunk_steps(std::size_t c, std::vector<Step>& steps);
    void add_antiradiance_steps(const Batch& batch, std::vector<Step>& steps);
    void add_node_steps(std::vector<Step>& steps);
    void run_items(const gpu::Program& program, ItemRange items, std::size_t rows = 1) const;
    [[nodiscard]] std::span<const Link> chunk_links(const Chunk& chunk) const;

    Config config_;
    const TransportPrograms& programs_;
    const LinkSet& links_;
    const NodeTables& tables_;
    const std::vector<Chunk>& chunks_;
    std::size_t max_work_groups_;
    std::size_t node_count_;

    gpu::Buffer<glsl::Node> nodes_;
    gpu::Buffer<std::int32_t> levels_;
    gpu::Buffer<glsl::Leaf> leaves_;
    gpu::Buffer<glsl::SurfaceNode> surfaces_;
    gpu::Buffer<vec4> axes_, radiance_, own_antiradiance_, antiradiance_, irradiance_;
    gpu::Buffer<vec4> sent_moments_, received_moments_;
    gpu::Buffer<glsl::PassState> state_;
    std::vector<ChunkBuffers> chunk_buffers_;
    gpu::Buffer<Link> streamed_links_;
    gpu::Buffer<glsl::Segment> streamed_segments_;
};

}  // namespace antiradiance
