// SPDX-License-Identifier: GPL-3.0-or-later
#include "display/work_batches_gl.h"

#include <algorithm>
#include <limits>

namespace antiradiance {

namespace {

// An item of group g before it is in a batch: places are into SourceLists::sources.
struct Piece {
    std::uint32_t begin, end;  // fragments, into FragmentGroups::order
    std::uint32_t first_place, last_place;
};

std::vector<Piece> cut_groups(const FragmentGroups& groups, const SourceLists& lists) {
    constexpr std::uint32_t kSize = glsl::kItemSize;
    std::vector<Piece> pieces;
    for (std::size_t g = 0; g < groups.groups.size(); ++g) {
        const FragmentGroup& group = groups.groups[g];
        if (lists.begin[g] == lists.end[g]) continue;
        for (std::uint32_t i = group.begin; i < group.end; i += kSize)
            pieces.push_back({i, std::min(i + kSize, group.end), lists.begin[g], lists.end[g]});
    }
    return pieces;
}

struct PlaceRange {
    std::uint32_t first = std::numeric_limits<std::uint32_t>::max();
    std::uint32_t last = 0;

    [[nodiscard]] PlaceRange with(const Piece& p) const {
        return {std::min(first, p.first_place), std::max(last, p.last_place)};
    }
};

WorkBatch make_batch(std::span<const Piece> pieces, PlaceRange places, const SourceLists& lists) {
    WorkBatch batch;
    batch.first_fragment = pieces.front().begin;
    batch.fragment_count = pieces.back().end - batch.first_fragment;
    batch.lists = std::span(lists.sources).subspan(places.first, places.last - places.first);
    for (const Piece& p : pieces) {
        const std::uint32_t count = p.last_place - p.first_place;
        batch.items.push_back(
            {p.begin - batch.first_fragment, p.end - p.begin, p.first_place - places.first, count});
        batch.longest_list = std::max(batch.longest_list, count);
    }
    return batch;
}

}  // namespace

double WorkBatch::pairs(const glsl::WorkItem& item, std::uint32_t first, std::uint32_t count) {
    if (item.place_count <= first) return 0;
    return static_cast<double>(item.receiver_count) * std::min(item.place_count - first, count);
}

double WorkBatch::pairs() const {
    double sum = 0;
    for (const glsl::WorkItem& item : items)
        sum += pairs(item, 0, item.place_count);
    return sum;
}

std::vector<WorkBatch> make_batches(const FragmentGroups& groups, const SourceLists& lists,
                                    std::size_t block_bytes) {
    const std::vector<Piece> pieces = cut_groups(groups, lists);
    std::vector<WorkBatch> batches;
    const auto bytes_until = [&](const Piece& first, const Piece& last, PlaceRange places) {
        return std::max((last.end - first.begin) * sizeof(glsl::Receiver),
                        (places.last - places.first) * sizeof(NodeId));
    };
    std::size_t begin = 0;
    PlaceRange places;
    const auto close_batch = [&](std::size_t end) {
        batches.push_back(make_batch(std::span(pieces).subspan(begin, end - begin), places, lists));
        begin = end;
        places = {};
    };
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const Piece& p = pieces[i];
        if (i > begin && bytes_until(pieces[begin], p, places.with(p)) > block_bytes)
            close_batch(i);
        places = places.with(p);
    }
    if (begin < pieces.size()) close_batch(pieces.size());
    return batches;
}

}  // namespace antiradiance
