// SPDX-License-Identifier: GPL-3.0-or-later
#include "links/build_link_set.h"

#include <gtest/gtest.h>

#include <map>
#include <tuple>

#include "support/linked_scene.h"
#include "support/scenes.h"

namespace antiradiance {
namespace {

using Key = std::tuple<NodeId, NodeId, int>;  // receiver, source, bin

struct Fixture {
    test::LinkedScene scene{test::office(), 1.5F, {.link_threshold = 0.1F, .least_edge = 1}, 64};
    LinkSet set = scene.sorted();
};

TEST(BuildLinkSet, HoldsEveryLinkInItsSegment) {
    const Fixture f;
    std::map<Key, std::vector<float>> raw;
    for (const RawLink& l : f.scene.refined.links)
        raw[{l.receiver, l.source, l.bin}].push_back(l.form_factor);

    ASSERT_EQ(f.set.bin_segments.size(), 65U);
    EXPECT_EQ(f.set.bin_segments.back(), f.set.segments.size());
    std::uint32_t next = 0;
    std::size_t plus = 0;
    for (int bin = 0; bin < 64; ++bin) {
        const auto b = static_cast<std::size_t>(bin);
        const vec3 axis = f.scene.bins.axis(bin);
        float along = -1e9F;
        for (std::uint32_t i = f.set.bin_segments[b]; i < f.set.bin_segments[b + 1]; ++i) {
            const Segment& s = f.set.segments[i];
            ASSERT_EQ(s.begin, next) << "segments leave gaps";
            ASSERT_LT(s.begin, s.end);
            next = s.end;
            const float now =
                glm::dot(f.scene.tree.center[static_cast<std::size_t>(s.receiver)], axis);
            ASSERT_LE(along, now) << "receivers run front to back along the bin's axis";
            along = now;
            for (std::uint32_t l = s.begin; l < s.end; ++l) {
                const Link& link = f.set.links[l];
                if (l > s.begin) {
                    ASSERT_LE(f.set.links[l - 1].source, link.source);
                }
                plus += link.form_factor > 0 ? 1 : 0;
                auto& left = raw.at({s.receiver, link.source, bin});
                const auto it = std::find(left.begin(), left.end(), link.form_factor);
                ASSERT_NE(it, left.end());
                left.erase(it);
            }
        }
    }
    EXPECT_EQ(next, f.set.links.size());
    EXPECT_EQ(f.set.links.size(), f.scene.refined.links.size());
    EXPECT_EQ(f.set.radiance_count, plus);
    EXPECT_EQ(f.set.antiradiance_count, f.set.links.size() - plus);
    EXPECT_GT(f.set.antiradiance_count, 1000U);
}

TEST(BuildLinkSet, AtMost16BytesALink) {
    const Fixture f;
    EXPECT_EQ(f.set.bytes(), f.set.links.size() * 8 + f.set.segments.size() * 16 + 65 * 4);
    EXPECT_LE(f.set.bytes(), 16 * f.set.links.size());
}

TEST(BuildLinkSet, SegmentsKnowTheirProjectedSolidAngle) {
    const Fixture f;
    for (int bin = 0; bin < 64; ++bin) {
        const auto b = static_cast<std::size_t>(bin);
        for (std::uint32_t i = f.set.bin_segments[b]; i < f.set.bin_segments[b + 1]; ++i) {
            const Segment& s = f.set.segments[i];
            const vec3 n = f.scene.tree.normal[static_cast<std::size_t>(s.receiver)];
            ASSERT_FLOAT_EQ(s.inv_c, 1 / f.scene.bins.projected_solid_angles(n)[b]);
        }
    }
}

TEST(BuildLinkSet, OccludedLinksAreDropped) {
    Fixture f;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < f.scene.refined.links.size(); ++i) {
        if (i % 3 == 0) {
            f.scene.refined.links[i].form_factor = 0;
        } else {
            ++kept;
        }
    }
    EXPECT_EQ(f.scene.sorted().links.size(), kept);
    for (RawLink& l : f.scene.refined.links)
        l.form_factor = 0;
    const LinkSet none = f.scene.sorted();
    EXPECT_TRUE(none.links.empty());
    EXPECT_TRUE(none.segments.empty());
    EXPECT_EQ(none.bin_segments, std::vector<std::uint32_t>(65, 0));
}

}  // namespace
}  // namespace antiradiance
