// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/transport_tables_gl.h"

#include <algorithm>
#include <string>

#include "gpu/gl_error.h"
#include "solve/moments.h"

namespace antiradiance {
namespace {

// Segments are sorted by length within blocks of this many, which follow each other along the bin's
// axis: enough for equal lengths in a work group, few enough that neighbours in space stay
// together.
constexpr std::size_t kSortBlock = 1024;

std::size_t index(std::int32_t i) {
    return static_cast<std::size_t>(i);
}

std::vector<float> leaf_area_sums(const PatchTree& tree) {
    std::vector<float> area(tree.size(), 0);
    for (std::size_t n = tree.size(); n-- > 0;) {
        if (tree.is_leaf(static_cast<NodeId>(n))) area[n] = tree.area[n];
        if (tree.parent[n] != kNone) area[index(tree.parent[n])] += area[n];
    }
    return area;
}

// Appends the nodes grouped by their value in `level`, the highest first; -1 leaves a node out.
std::vector<ItemRange> append_levels(const std::vector<int>& level,
                                     std::vector<std::int32_t>& items) {
    int highest = -1;
    for (const int l : level)
        highest = std::max(highest, l);
    std::vector<std::vector<std::int32_t>> by_level(static_cast<std::size_t>(highest + 1));
    for (std::size_t n = 0; n < level.size(); ++n) {
        if (level[n] >= 0) by_level[index(level[n])].push_back(static_cast<std::int32_t>(n));
    }
    std::vector<ItemRange> ranges;
    for (auto nodes = by_level.rbegin(); nodes != by_level.rend(); ++nodes) {
        if (nodes->empty()) continue;
        const auto begin = static_cast<std::uint32_t>(items.size());
        items.insert(items.end(), nodes->begin(), nodes->end());
        ranges.push_back({begin, static_cast<std::uint32_t>(items.size())});
    }
    return ranges;
}

void fill_nodes(const PatchTree& tree, NodeTables& tables) {
    const std::vector<float> area = leaf_area_sums(tree);
    tables.nodes.resize(tree.size());
    std::vector<int> patch_level(tree.size(), -1), cluster_level(tree.size(), -1);
    for (std::size_t n = 0; n < tree.size(); ++n) {
        const auto id = static_cast<NodeId>(n);
        tables.nodes[n] = {tree.parent[n], tree.subtree_end[n], area[n], -1};
        if (tree.is_cluster(id)) {
            tables.nodes[n].cluster = static_cast<std::int32_t>(tables.cluster_count++);
            cluster_level[n] = tree.depth[n];
        } else if (!tree.is_leaf(id)) {
            patch_level[n] =
                tree.depth[n] - tree.depth[index(tree.surface_node[index(tree.surface[n])])];
        }
    }
    for (std::size_t s = 0; s < tree.surface_node.size(); ++s) {
        if (tree.surfaces[s].lamp != kNone) continue;  // lamps link by themselves
        const NodeId node = tree.surface_node[s];
        tables.nodes[index(node)].cluster = -2 - static_cast<std::int32_t>(tables.surfaces.size());
        tables.surfaces.push_back({tree.normal[index(node)], node});
    }
    tables.patch_levels = append_levels(patch_level, tables.levels);
    tables.cluster_levels = append_levels(cluster_level, tables.levels);
}

void fill_radiance(const TransportProblem& problem, NodeTables& tables) {
    tables.radiance.assign(tables.nodes.size(), vec4(0));
    tables.state = {vec3(0), 0, vec3(0), 0};
    for (const NodeId leaf : problem.tree.leaves) {
        const std::size_t n = index(leaf);
        tables.leaves.push_back(
            {problem.source[n], leaf, problem.albedo[n] * kInvPi, problem.row_scale[n]});
        const vec3 start = glm::max(problem.source[n], vec3(0));
        tables.radiance[n] = vec4(start, 0);
        tables.state.max_radiance = glm::max(tables.state.max_radiance, start);
    }
    for (std::size_t n = tables.nodes.size(); n-- > 0;) {
        const glsl::Node& node = tables.nodes[n];
        if (node.cluster >= 0) {
            const bool narrow = problem.tree.cone_cosine[n] > kNarrowCone;
            const auto number = static_cast<float>(node.cluster + 1);
            tables.radiance[n] = vec4(0, 0, 0, narrow ? -number : number);
            continue;
        }
        if (!problem.tree.is_leaf(static_cast<NodeId>(n))) {
            tables.radiance[n] /= std::max(node.area, 1e-30F);
        }
        if (node.parent != kNone && !problem.tree.is_cluster(node.parent)) {
            tables.radiance[index(node.parent)] += node.area * tables.radiance[n];
        }
    }
}

std::size_t chunk_bytes(std::size_t links, std::size_t segments, std::size_t node_count) {
    return std::max({links * sizeof(glsl::Link), segments * sizeof(glsl::Segment),
                     (node_count + 1 + segments) * sizeof(std::uint32_t)});
}

std::uint32_t link_count(const glsl::Segment& segment) {
    return segment.bin_and_count & ((1U << glsl::kSegmentCountBits) - 1U);
}

// Cuts `range` where a step would exceed its links.
std::vector<ItemRange> cut_steps(const std::vector<glsl::Segment>& segments, ItemRange range,
                                 std::uint32_t links_per_step) {
    std::vector<ItemRange> steps;
    std::uint64_t links = 0;
    for (std::uint32_t s = range.begin; s < range.end; ++s) {
        links += link_count(segments[s]);
        if (steps.empty() || links > links_per_step) {
            steps.push_back({s, s});
            links = link_count(segments[s]);
        }
        steps.back().end = s + 1;
    }
    return steps;
}

void append_batch(const LinkSet& set, const ChunkLimits& limits, std::uint32_t first_bin,
                  std::uint32_t end_bin, Chunk& chunk) {
    Batch batch{first_bin, end_bin - first_bin, {}, {}, {}};
    std::vector<glsl::Segment>& all = chunk.segments;
    const std::size_t begin = all.size();
    for (std::uint32_t bin = first_bin; bin < end_bin; ++bin) {
        for (std::uint32_t s = set.bin_segments[bin]; s < set.bin_segments[bin + 1]; ++s) {
            const Segment& from = set.segments[s];
            const std::uint32_t count = from.end - from.begin;
            if (count >> glsl::kSegmentCountBits != 0) {
                throw gpu::GlError(
                    "a patch has more links in one direction than the OpenGL "
                    "solver can count; use more direction bins");
            }
            all.push_back({from.receiver, from.begin - chunk.links.begin,
                           bin << glsl::kSegmentCountBits | count, from.inv_c});
        }
    }
    const auto first_long = std::stable_partition(
        all.begin() + static_cast<std::ptrdiff_t>(begin), all.end(),
        [&](const glsl::Segment& s) { return link_count(s) < limits.long_segment; });
    const auto long_begin = static_cast<std::size_t>(first_long - all.begin());
    for (std::size_t block = begin; block < long_begin; block += kSortBlock) {
        const std::size_t end = std::min(block + kSortBlock, long_begin);
        std::stable_sort(all.begin() + static_cast<std::ptrdiff_t>(block),
                         all.begin() + static_cast<std::ptrdiff_t>(end),
                         [](const glsl::Segment& a, const glsl::Segment& b) {
                             return link_count(a) < link_count(b);
                         });
    }
    const auto u = [](std::size_t i) { return static_cast<std::uint32_t>(i); };
    batch.segments = {u(begin), u(all.size())};
    batch.short_steps = cut_steps(all, {u(begin), u(long_begin)}, limits.links_per_step);
    batch.long_steps = cut_steps(all, {u(long_begin), u(all.size())}, limits.links_per_step);
    chunk.batches.push_back(std::move(batch));
}

std::vector<std::uint32_t> index_by_receiver(const std::vector<glsl::Segment>& segments,
                                             std::size_t node_count) {
    const std::size_t list = node_count + 1;
    std::vector<std::uint32_t> table(list + segments.size(), 0);
    for (const glsl::Segment& s : segments)
        ++table[index(s.receiver) + 1];
    for (std::size_t n = 0; n < node_count; ++n)
        table[n + 1] += table[n];
    std::vector<std::uint32_t> next(table.begin(),
                                    table.begin() + static_cast<std::ptrdiff_t>(node_count));
    for (std::size_t s = 0; s < segments.size(); ++s) {
        table[list + next[index(segments[s].receiver)]++] = static_cast<std::uint32_t>(s);
    }
    return table;
}

ItemRange bin_links(const LinkSet& set, std::uint32_t bin) {
    const std::uint32_t first = set.bin_segments[bin], end = set.bin_segments[bin + 1];
    if (first == end) return {};
    return {set.segments[first].begin, set.segments[end - 1].end};
}

}  // namespace

NodeTables make_node_tables(const TransportProblem& problem) {
    NodeTables tables;
    fill_nodes(problem.tree, tables);
    fill_radiance(problem, tables);
    for (int b = 0; b < problem.links.bins.count(); ++b) {
        tables.axes.emplace_back(problem.links.bins.axis(b), 0.0F);
    }
    return tables;
}

bool uses_clusters(const PatchTree& tree, const LinkSet& links) {
    return std::ranges::any_of(links.segments,
                               [&](const Segment& s) { return tree.is_cluster(s.receiver); }) ||
           std::ranges::any_of(links.links,
                               [&](const Link& l) { return tree.is_cluster(l.source); });
}

std::vector<Chunk> make_chunks(const LinkSet& set, std::size_t node_count,
                               const ChunkLimits& limits, const Progress& progress) {
    std::vector<Chunk> chunks;
    const auto bin_count = static_cast<std::uint32_t>(set.bins.count());
    for (std::uint32_t bin = 0; bin < bin_count; ++bin) {
        const ItemRange links = bin_links(set, bin);
        const std::uint32_t segment_end = set.bin_segments[bin + 1];
        if (links.size() == 0) {
            if (!chunks.empty()) chunks.back().end_bin = bin + 1;
            continue;
        }
        const bool fits =
            !chunks.empty() && chunk_bytes(links.end - chunks.back().links.begin,
                                           segment_end - set.bin_segments[chunks.back().first_bin],
                                           node_count) <= limits.block_bytes;
        if (!fits) {
            if (chunk_bytes(links.size(), segment_end - set.bin_segments[bin], node_count) >
                limits.block_bytes) {
                throw gpu::GlError(
                    "the links of one direction are more than a buffer of this OpenGL device "
                    "holds (" +
                    std::to_string(limits.block_bytes >> 20U) + " MiB); use more direction bins");
            }
            chunks.push_back({bin, bin, {links.begin, links.begin}, {}, {}, {}});
        }
        chunks.back().end_bin = bin + 1;
        chunks.back().links.end = links.end;
    }
    // Without links there is still one chunk, whose receivers get nothing.
    if (chunks.empty()) chunks.push_back({0, bin_count, {}, {}, {}, {}});
    for (Chunk& chunk : chunks) {
        for (std::uint32_t bin = chunk.first_bin; bin < chunk.end_bin;) {
            progress.check();
            const std::uint32_t end = std::min(bin + limits.bins_per_batch, chunk.end_bin);
            append_batch(set, limits, bin, end, chunk);
            bin = end;
        }
        chunk.receivers = index_by_receiver(chunk.segments, node_count);
    }
    return chunks;
}

}  // namespace antiradiance
