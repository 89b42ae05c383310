// SPDX-License-Identifier: GPL-3.0-or-later
// TransportProblem -> the arrays of shaders/README.md. Plain memory, no OpenGL calls.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "solve/solver.h"
#include "solve/transport_layout_gl.h"

namespace antiradiance {

struct ItemRange {
    std::uint32_t begin = 0, end = 0;
    [[nodiscard]] std::uint32_t size() const { return end - begin; }
};

struct NodeTables {
    std::vector<glsl::Node> nodes;
    std::vector<std::int32_t> levels;       // inner patches and clusters, by the ranges below
    std::vector<ItemRange> patch_levels;    // of inner patches, deepest first
    std::vector<ItemRange> cluster_levels;  // deepest first
    std::vector<glsl::Leaf> leaves;
    std::vector<glsl::SurfaceNode> surfaces;
    std::vector<vec4> axes;  // #bins
    std::size_t cluster_count = 0;
    std::vector<vec4> radiance;  // #nodes: the source, pulled up through the patches
    glsl::PassState state;       // of that radiance
};

[[nodiscard]] NodeTables make_node_tables(const TransportProblem& problem);

// True if a link starts or ends at a cluster.
[[nodiscard]] bool uses_clusters(const PatchTree& tree, const LinkSet& links);

// How much goes into one buffer and one dispatch.
struct ChunkLimits {
    std::size_t block_bytes;       // of one buffer
    std::uint32_t bins_per_batch;  // whose antiradiance exists at a time
    std::uint32_t links_per_step;  // of one dispatch
    std::uint32_t long_segment;    // links from which a segment gets a work group of its own
};

// Bins with their segments in the order in which they are gathered: the short ones, in blocks
// sorted by length so that neighbouring invocations end together, then the long ones.
struct Batch {
    std::uint32_t first_bin = 0, bin_count = 0;
    ItemRange segments;                  // of the chunk
    std::vector<ItemRange> short_steps;  // of at most links_per_step links (or one segment)
    std::vector<ItemRange> long_steps;
};

// Whole bins whose links, segments and flux fit into one buffer each.
struct Chunk {
    std::uint32_t first_bin = 0, end_bin = 0;
    ItemRange links;  // of LinkSet::links
    std::vector<glsl::Segment> segments;
    std::vector<std::uint32_t> receivers;  // #nodes + 1 offsets, then segments by receiver
    std::vector<Batch> batches;
};

// Throws GlError where one bin alone is larger than a buffer.
[[nodiscard]] std::vector<Chunk> make_chunks(const LinkSet& links, std::size_t node_count,
                                             const ChunkLimits& limits, const Progress& progress);

}  // namespace antiradiance
