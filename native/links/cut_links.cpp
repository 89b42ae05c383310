// SPDX-License-Identifier: GPL-3.0-or-later
#include "links/cut_links.h"

#include "base/parallel.h"

namespace antiradiance {

namespace {

constexpr std::size_t kBlock = 4096;  // links, or segments, handed to a thread at once

// Links of one pair of nodes often follow each other: one in each bin that they touch in.
class PairTest {
public:
    PairTest(const PatchTree& tree, const BlockingPlanes& planes) : tree_(tree), planes_(planes) {}

    BlockerId operator()(NodeId source, NodeId receiver) {
        if (source != source_ || receiver != receiver_) {
            source_ = source;
            receiver_ = receiver;
            crossed_ = planes_.crossed(tree_.center[static_cast<std::size_t>(source)],
                                       tree_.center[static_cast<std::size_t>(receiver)]);
        }
        return crossed_;
    }

private:
    const PatchTree& tree_;
    const BlockingPlanes& planes_;
    NodeId source_ = kNone, receiver_ = kNone;
    BlockerId crossed_ = kNone;
};

}  // namespace

std::vector<BlockerId> find_cut_links(const PatchTree& tree, std::span<const RawLink> links,
                                      const BlockingPlanes& planes, Progress& progress) {
    std::vector<BlockerId> cut(links.size(), kNone);
    if (planes.empty()) return cut;
    parallel_for_blocks(links.size(), kBlock, progress, [&](std::size_t begin, std::size_t end) {
        PairTest test(tree, planes);
        for (std::size_t l = begin; l < end; ++l)
            cut[l] = test(links[l].source, links[l].receiver);
    });
    return cut;
}

std::vector<BlockerId> find_cut_links(const PatchTree& tree, const LinkSet& links,
                                      const BlockingPlanes& planes, Progress& progress) {
    std::vector<BlockerId> cut(links.links.size(), kNone);
    if (planes.empty()) return cut;
    parallel_for_blocks(links.segments.size(), kBlock, progress,
                        [&](std::size_t begin, std::size_t end) {
                            PairTest test(tree, planes);
                            for (std::size_t i = begin; i < end; ++i) {
                                const Segment& segment = links.segments[i];
                                for (std::uint32_t l = segment.begin; l < segment.end; ++l)
                                    cut[l] = test(links.links[l].source, segment.receiver);
                            }
                        });
    return cut;
}

}  // namespace antiradiance
