// SPDX-License-Identifier: GPL-3.0-or-later
#include "links/refine.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <span>

#include "base/error.h"
#include "base/parallel.h"
#include "links/link_maker.h"
#include "links/refine_oracle.h"

namespace antiradiance {

namespace {

constexpr std::size_t kBlock = 256;         // pairs handed to a thread at once
constexpr std::size_t kEnoughPairs = 2048;  // to share out between threads

struct Pair {
    NodeId a, b;
};

// A pair that waits for a leaf patch to get children.
struct Waiting {
    Pair pair;
    NodeId split;
};

struct BlockResult {
    RefinedLinks made;
    std::vector<Waiting> waiting;
    std::vector<Pair> stack;
};

// The corners of a patch, or of a box around a cluster.
class NodeHull {
public:
    explicit NodeHull(const GrowingNode& node)
        : center_(node.center), count_(static_cast<std::size_t>(node.corner_count)) {
        if (!node.is_cluster()) {
            std::copy_n(node.corners.begin(), count_, corners_.begin());
            return;
        }
        count_ = corners_.size();
        for (std::size_t i = 0; i < count_; ++i) {
            corners_[i] =
                center_ + node.radius * vec3(i & 1U ? 1 : -1, i & 2U ? 1 : -1, i & 4U ? 1 : -1);
        }
    }
    [[nodiscard]] BlockingPlanes::Hull hull() const {
        return {center_, std::span(corners_).first(count_)};
    }

private:
    vec3 center_;
    std::array<vec3, 8> corners_;
    std::size_t count_;
};

class Refiner {
public:
    Refiner(const GrowingTree& tree, const DirectionBins& bins, const RefineOptions& options)
        : tree_(tree),
          oracle_(tree, bins, options),
          maker_(tree, bins, options),
          planes_(options.planes) {}

    // Handles one pair and, through `out.stack`, the pairs that come from it.
    void refine(const Pair& pair, BlockResult& out) const {
        out.stack.push_back(pair);
        while (!out.stack.empty()) {
            const Pair p = out.stack.back();
            out.stack.pop_back();
            step(p, out);
        }
    }

    void step(const Pair& p, BlockResult& out) const {
        if (p.a == p.b) {
            push_self_pairs(p.a, out);
            return;
        }
        const Verdict v = oracle_.decide(p.a, p.b);
        if (v.action == Verdict::kDrop || drop_separated(p, out)) return;
        switch (v.action) {
            case Verdict::kDrop:
                return;
            case Verdict::kLink:
                maker_.link(p.a, p.b, v, out.made);
                return;
            case Verdict::kSplitA:
                push_children(p.a, p, out);
                return;
            case Verdict::kSplitB:
                push_children(p.b, p, out);
                return;
        }
    }

    // Of a pair's links, if none of its leaves is split any more: those of the pair itself, or the
    // pairs below it.
    LinkCount count_links(const Pair& p, std::vector<Pair>& below) const {
        const Verdict v = oracle_.decide(p.a, p.b);
        if (v.action == Verdict::kDrop) return {};
        const NodeId split = v.action == Verdict::kSplitB ? p.b : p.a;
        if (v.action == Verdict::kLink || tree_.node(split).is_leaf())
            return maker_.count(p.a, p.b, v);
        push_children(split, p, below);
        return {};
    }

private:
    void push_self_pairs(NodeId n, BlockResult& out) const {
        const GrowingNode& node = tree_.node(n);
        if (!node.is_cluster()) return;  // a plane does not see itself
        for (NodeId i = 0; i < node.child_count; ++i) {
            for (NodeId j = i; j < node.child_count; ++j)
                out.stack.push_back({node.first_child + i, node.first_child + j});
        }
    }

    void push_children(NodeId split, const Pair& p, BlockResult& out) const {
        if (tree_.node(split).is_leaf()) {
            out.waiting.push_back({p, split});
        } else {
            push_children(split, p, out.stack);
        }
    }

    void push_children(NodeId split, const Pair& p, std::vector<Pair>& stack) const {
        const GrowingNode& node = tree_.node(split);
        const NodeId other = split == p.a ? p.b : p.a;
        for (NodeId i = node.child_count; i-- > 0;) {
            const NodeId child = node.first_child + i;
            stack.push_back(split == p.a ? Pair{child, other} : Pair{other, child});
        }
    }

    // Whether a plane parts all of one node from all of the other: so it does with what lies below
    // them, and none of it needs to be refined for the other's sake.
    bool drop_separated(const Pair& p, BlockResult& out) const {
        if (planes_ == nullptr || planes_->empty()) return false;
        const BlockerId plane =
            planes_->separating(NodeHull(tree_.node(p.a)).hull(), NodeHull(tree_.node(p.b)).hull());
        if (plane == kNone) return false;
        out.made.separated.push_back({p.a, p.b, plane, {}});
        return true;
    }

    const GrowingTree& tree_;
    RefineOracle oracle_;
    LinkMaker maker_;
    const BlockingPlanes* planes_;
};

// Breadth first until there is enough to share out; in order, so that results are deterministic.
std::vector<Pair> first_pairs(const Refiner& refiner, std::vector<BlockResult>& results) {
    std::vector<Pair> pairs{{GrowingTree::kRoot, GrowingTree::kRoot}};
    BlockResult& out = results.emplace_back();
    while (!pairs.empty() && pairs.size() < kEnoughPairs) {
        for (const Pair& p : pairs)
            refiner.step(p, out);
        pairs.swap(out.stack);
        out.stack.clear();
    }
    return pairs;
}

void append(RefinedLinks& all, const RefinedLinks& block) {
    const auto offset = static_cast<std::uint32_t>(all.links.size());
    all.links.insert(all.links.end(), block.links.begin(), block.links.end());
    for (LinkedPair p : block.pairs) {
        p.first += offset;
        all.pairs.push_back(p);
    }
    all.separated.insert(all.separated.end(), block.separated.begin(), block.separated.end());
}

// One pair may stand for half of all links, so those below the pairs are shared out.
void count_separated(const Refiner& refiner, std::vector<SeparatedPair>& separated,
                     Progress& progress) {
    struct Part {
        std::size_t of;  // separated pair
        Pair pair;
    };
    std::vector<Part> parts;
    for (std::size_t i = 0; i < separated.size(); ++i)
        parts.push_back({i, {separated[i].a, separated[i].b}});
    std::vector<Pair> below;
    while (!parts.empty() && parts.size() < kEnoughPairs) {
        std::vector<Part> finer;
        for (const Part& part : parts) {
            separated[part.of].links += refiner.count_links(part.pair, below);
            for (const Pair& pair : below)
                finer.push_back({part.of, pair});
            below.clear();
        }
        parts.swap(finer);
    }
    std::vector<LinkCount> counts(parts.size());
    parallel_for_blocks(parts.size(), 16, progress, [&](std::size_t begin, std::size_t end) {
        std::vector<Pair> stack;
        for (std::size_t i = begin; i < end; ++i) {
            stack.push_back(parts[i].pair);
            for (std::size_t steps = 0; !stack.empty(); ++steps) {
                if (steps % kBlock == 0) progress.check();
                const Pair pair = stack.back();
                stack.pop_back();
                counts[i] += refiner.count_links(pair, stack);
            }
        }
    });
    for (std::size_t i = 0; i < parts.size(); ++i)
        separated[parts[i].of].links += counts[i];
}

}  // namespace

void RefinedLinks::renumber(const std::vector<NodeId>& number) {
    const auto to = [&](NodeId n) { return number[static_cast<std::size_t>(n)]; };
    for (RawLink& l : links) {
        l.receiver = to(l.receiver);
        l.source = to(l.source);
    }
    const auto renumber_pair = [&](auto& p) {
        p.a = to(p.a);
        p.b = to(p.b);
    };
    std::ranges::for_each(pairs, renumber_pair);
    std::ranges::for_each(separated, renumber_pair);
}

RefinedLinks refine_links(GrowingTree& tree, const DirectionBins& bins,
                          const RefineOptions& options, Progress& progress) {
    const Refiner refiner(tree, bins, options);
    RefinedLinks all;
    std::vector<BlockResult> results;
    std::vector<Pair> pairs = first_pairs(refiner, results);
    std::vector<Waiting> waiting = std::move(results.front().waiting);
    append(all, results.front().made);

    std::atomic<std::size_t> link_count{all.links.size()};
    float done = 0;
    while (true) {
        results.clear();
        results.resize((pairs.size() + kBlock - 1) / kBlock);
        const ProgressSpan span{done, done + 0.6F * (1 - done)};
        parallel_for_blocks(
            pairs.size(), kBlock, progress,
            [&](std::size_t begin, std::size_t end) {
                BlockResult& out = results[begin / kBlock];
                for (std::size_t i = begin; i < end; ++i) {
                    const std::size_t before = out.made.links.size();
                    refiner.refine(pairs[i], out);
                    progress.check();
                    if ((link_count += out.made.links.size() - before) > options.most_links) return;
                }
            },
            span);
        if (link_count > options.most_links) {
            throw SceneError(
                "The link mesh would need more than " + std::to_string(options.most_links) +
                " links, which do not fit into this machine's memory: raise Link Threshold or "
                "Max Patch Size, or set Visibility to Explicit");
        }
        done = span.end;
        for (BlockResult& block : results) {
            waiting.insert(waiting.end(), block.waiting.begin(), block.waiting.end());
            append(all, block.made);
            block = {};
        }
        if (waiting.empty()) {
            count_separated(refiner, all.separated, progress);
            return all;
        }

        // The leaves that pairs wait for, once each; then those pairs go on.
        pairs.clear();
        for (const Waiting& w : waiting) {
            if (tree.node(w.split).is_leaf()) tree.split(w.split);
            pairs.push_back(w.pair);
        }
        waiting.clear();
    }
}

}  // namespace antiradiance
