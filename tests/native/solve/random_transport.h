// SPDX-License-Identifier: GPL-3.0-or-later
// Made-up trees and link meshes on which a solver's arithmetic can be compared: nothing about them
// is geometry, and light may well grow on them.
#pragma once

#include <random>
#include <vector>

#include "solve/solver.h"

namespace antiradiance::test {

struct RandomTransportOptions {
    unsigned seed = 1;
    int surfaces = 12;
    int levels = 3;  // of 4-splits below a surface, at most
    int bins = 32;
    int segments_per_bin = 60;
    int links_per_segment = 6;        // on average
    int long_segments = 2;            // per bin, of 20 times as many links
    float antiradiance_share = 0.4F;  // of the links
    float cluster_share = 0;          // of the ends of links
    // About the share of light that one patch's own links bring back in one bounce; the links of
    // the patches above it add to that.
    float gain = 0.3F;
};

struct RandomTransport {
    PatchTree tree;
    LinkSet links;
    std::vector<vec3> source, albedo;
    std::vector<float> row_scale;

    explicit RandomTransport(const RandomTransportOptions& options);
    [[nodiscard]] TransportProblem problem() const {
        return {tree, links, source, albedo, row_scale};
    }
};

}  // namespace antiradiance::test
