// SPDX-License-Identifier: GPL-3.0-or-later
#include "display/shooting.h"

#include "base/parallel.h"
#include "base/random.h"
#include "display/interleave.h"

namespace antiradiance {

namespace {

// Fragments of a group by the subset of sources that interleaving gives them.
class Subsets {
public:
    Subsets(const ShootingInput& input, const FragmentGroup& group)
        : begin_(static_cast<std::size_t>(input.interleave * input.interleave) + 1, 0) {
        std::vector<std::uint32_t> subset;
        for (std::uint32_t i = group.begin; i < group.end; ++i) {
            const Fragment& f = input.buffer.fragments[input.groups.order[i]];
            subset.push_back(interleave_subset(f.pixel, input.buffer.width, input.interleave));
            ++begin_[subset.back() + 1];
        }
        for (std::size_t k = 0; k + 1 < begin_.size(); ++k)
            begin_[k + 1] += begin_[k];
        std::vector<std::uint32_t> fill(begin_.begin(), begin_.end() - 1);
        fragments.resize(subset.size());
        for (std::uint32_t i = group.begin; i < group.end; ++i)
            fragments[fill[subset[i - group.begin]]++] = input.groups.order[i];
    }
    // Fragments of subset k: fragments[first(k)] ... fragments[first(k + 1) - 1].
    [[nodiscard]] std::uint32_t first(std::size_t k) const { return begin_[k]; }
    [[nodiscard]] std::size_t count() const { return begin_.size() - 1; }
    std::vector<std::uint32_t> fragments;  // into GBuffer::fragments

private:
    std::vector<std::uint32_t> begin_;
};

std::vector<Receiver> make_receivers(const ShootingInput& input,
                                     std::span<const std::uint32_t> fragments) {
    std::vector<Receiver> receivers;
    receivers.reserve(fragments.size());
    for (const std::uint32_t i : fragments) {
        const Fragment& f = input.buffer.fragments[i];
        const std::uint32_t hash = hash_u32(f.pixel);
        Receiver r{
            f.position, f.normal, f.shading_normal, kNone, hash, 0, to_unit_float(hash_u32(hash))};
        if (f.leaf != kNone) {
            const auto leaf = static_cast<std::size_t>(f.leaf);
            r.surface = input.tree.surface[leaf];
            // Interleaving multiplies the result by n^2.
            const auto n = static_cast<float>(input.interleave);
            r.expected = luminance(input.leaf_light[leaf]) / (n * n);
        }
        receivers.push_back(r);
    }
    return receivers;
}

void shoot_group(const ShootingInput& input, std::size_t g, PatchShooter& shooter,
                 Progress& progress, std::vector<vec3>& irradiance) {
    const Subsets subsets(input, input.groups.groups[g]);
    std::vector<Receiver> receivers = make_receivers(input, subsets.fragments);
    const std::span<const NodeId> sources = input.sources.of(g);
    for (std::size_t s = 0; s < sources.size(); ++s) {
        if (s % 256 == 0) progress.check();
        const std::size_t k = s % subsets.count();
        const std::uint32_t begin = subsets.first(k);
        const std::uint32_t end = subsets.first(k + 1);
        if (begin < end) shooter.light(sources[s], {receivers.data() + begin, end - begin});
    }
    shooter.finish();
    const auto scale = static_cast<float>(subsets.count());
    for (std::size_t i = 0; i < receivers.size(); ++i)
        irradiance[subsets.fragments[i]] = scale * receivers[i].irradiance;
}

}  // namespace

std::vector<vec3> shoot(const ShootingInput& input, const MakeShooter& make_shooter,
                        Progress& progress, ProgressSpan span) {
    std::vector<vec3> irradiance(input.buffer.fragments.size(), vec3(0));
    parallel_for(
        input.groups.groups.size(), progress,
        [&](std::size_t g) { shoot_group(input, g, *make_shooter(), progress, irradiance); }, span);
    return irradiance;
}

std::vector<vec3> shoot(const AntiradianceShooting& input, Progress& progress, ProgressSpan span) {
    return shoot(
        input.shooting,
        [&] {
            return make_antiradiance_shooter(input.shooting.tree, input.lights, input.antiradiance,
                                             input.bins, input.epsilon);
        },
        progress, span);
}

}  // namespace antiradiance
