// SPDX-License-Identifier: GPL-3.0-or-later
#include "links/build_link_set.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "base/parallel.h"

namespace antiradiance {

namespace {

// C(b) of all surfaces; surfaces that face the same way share a row.
class ProjectedSolidAngles {
public:
    ProjectedSolidAngles(const PatchTree& tree, const DirectionBins& bins) : bins_(bins.count()) {
        row_.reserve(tree.surfaces.size());
        std::unordered_map<std::uint64_t, std::size_t> known;
        for (std::size_t s = 0; s < tree.surfaces.size(); ++s) {
            const vec3 n = tree.normal[static_cast<std::size_t>(tree.surface_node[s])];
            // 0.1 % of a unit vector: far below a bin.
            std::uint64_t key = 0;
            for (int k = 0; k < 3; ++k)
                key = (key << 21U) | static_cast<std::uint64_t>(std::lround(n[k] * 1000) + 1024);
            const auto [it, added] = known.try_emplace(key, known.size());
            if (added) {
                const std::vector<float> c = bins.projected_solid_angles(n);
                table_.insert(table_.end(), c.begin(), c.end());
            }
            row_.push_back(it->second);
        }
    }

    [[nodiscard]] float operator()(SurfaceId s, int bin) const {
        return table_[row_[static_cast<std::size_t>(s)] * static_cast<std::size_t>(bins_) +
                      static_cast<std::size_t>(bin)];
    }

private:
    int bins_;
    std::vector<std::size_t> row_;  // #surfaces
    std::vector<float> table_;      // #rows x #bins
};

struct BinLink {
    NodeId receiver;
    Link link;
};

// One bin's links in their final order, with segments whose begin and end count from the bin's
// start.
struct SortedBin {
    std::vector<Link> links;
    std::vector<Segment> segments;
};

SortedBin sort_bin(const PatchTree& tree, const vec3& axis, std::span<const BinLink> links) {
    // Links of each receiver next to each other, by counting.
    std::vector<std::uint32_t> count(tree.size(), 0);
    for (const BinLink& l : links)
        ++count[static_cast<std::size_t>(l.receiver)];
    struct Row {
        float along;
        NodeId receiver;
    };
    std::vector<Row> rows;
    for (std::size_t n = 0; n < tree.size(); ++n) {
        if (count[n]) rows.push_back({glm::dot(tree.center[n], axis), static_cast<NodeId>(n)});
    }
    std::sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) {
        return a.along != b.along ? a.along < b.along : a.receiver < b.receiver;
    });

    SortedBin sorted;
    sorted.links.resize(links.size());
    std::vector<std::uint32_t> fill(tree.size(), 0);
    std::uint32_t begin = 0;
    for (const Row& row : rows) {
        const auto r = static_cast<std::size_t>(row.receiver);
        fill[r] = begin;
        sorted.segments.push_back({row.receiver, begin, begin + count[r], 0});
        begin += count[r];
    }
    for (const BinLink& l : links)
        sorted.links[fill[static_cast<std::size_t>(l.receiver)]++] = l.link;
    for (const Segment& s : sorted.segments) {
        std::sort(sorted.links.begin() + s.begin, sorted.links.begin() + s.end,
                  [](const Link& a, const Link& b) {
                      return a.source != b.source ? a.source < b.source
                                                  : a.form_factor < b.form_factor;
                  });
    }
    return sorted;
}

}  // namespace

std::size_t LinkSet::bytes() const {
    return links.size() * sizeof(Link) + segments.size() * sizeof(Segment) +
           bin_segments.size() * sizeof(std::uint32_t);
}

LinkSet build_link_set(const PatchTree& tree, const DirectionBins& bins,
                       std::span<const RawLink> raw, Progress& progress) {
    const auto bin_count = static_cast<std::size_t>(bins.count());
    std::vector<std::uint32_t> bin_begin(bin_count + 1, 0);
    for (const RawLink& l : raw) {
        if (l.form_factor != 0) ++bin_begin[l.bin + 1UL];
    }
    for (std::size_t b = 0; b < bin_count; ++b)
        bin_begin[b + 1] += bin_begin[b];
    std::vector<BinLink> by_bin(bin_begin.back());
    {
        std::vector<std::uint32_t> fill(bin_begin.begin(), bin_begin.end() - 1);
        for (const RawLink& l : raw) {
            if (l.form_factor != 0) by_bin[fill[l.bin]++] = {l.receiver, {l.source, l.form_factor}};
        }
    }
    progress.check();

    const ProjectedSolidAngles c(tree, bins);
    LinkSet set;
    set.bins = bins;
    set.links.resize(by_bin.size());
    std::vector<std::vector<Segment>> segments(bin_count);
    parallel_for(bin_count, progress, [&](std::size_t b) {
        const std::span<const BinLink> links(by_bin.data() + bin_begin[b],
                                             bin_begin[b + 1] - bin_begin[b]);
        if (links.empty()) return;
        SortedBin sorted = sort_bin(tree, bins.axis(static_cast<int>(b)), links);
        std::copy(sorted.links.begin(), sorted.links.end(), set.links.begin() + bin_begin[b]);
        for (Segment& s : sorted.segments) {
            s.begin += bin_begin[b];
            s.end += bin_begin[b];
            const SurfaceId surface = tree.surface[static_cast<std::size_t>(s.receiver)];
            if (surface != kNone) s.inv_c = 1 / c(surface, static_cast<int>(b));
        }
        segments[b] = std::move(sorted.segments);
    });

    set.bin_segments.push_back(0);
    for (const std::vector<Segment>& of_bin : segments) {
        set.segments.insert(set.segments.end(), of_bin.begin(), of_bin.end());
        set.bin_segments.push_back(static_cast<std::uint32_t>(set.segments.size()));
    }
    for (const Link& l : set.links)
        ++(l.form_factor > 0 ? set.radiance_count : set.antiradiance_count);
    return set;
}

}  // namespace antiradiance
