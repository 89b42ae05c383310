// SPDX-License-Identifier: GPL-3.0-or-later
// What a render did, as JSON. Other tools read these keys: do not rename them.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "links/refine.h"
#include "pipeline/evaluate_rules.h"

namespace antiradiance {

struct Report {
    std::size_t patches = 0;  // nodes of the hierarchy that are patches, leaves and inner ones
    std::size_t leaves = 0;
    struct Links {
        std::size_t radiance = 0, antiradiance = 0, total = 0;  // directed links solved, pruned
        std::size_t bytes = 0;                                  // of the sorted link mesh
    } links;
    struct Pruning {
        std::string method;  // the option's item; NONE where it took no part
        std::size_t removed_radiance = 0, removed_antiradiance = 0;  // links
        std::size_t removed_dark = 0;  // after that, that carry nothing in this light
        double seconds = 0;
        PruningTable table;  // of all of IMPLICIT's links; no rules: not asked for
    } pruning;
    struct VisibilityTest {
        std::string mode;                                  // the option's item
        std::size_t rays = 0;                              // between patches that links join
        std::size_t explicit_rows = 0, implicit_rows = 0;  // links of a receiver in a bin
    } visibility;
    struct Blockers {
        struct Plane {
            std::string name;
            LinkCount cut;  // links for which it is the first plane on their way
        };
        std::vector<Plane> per_plane;
        double seconds = 0;  // see BlockerCuts
    } blockers;
    struct Direct {
        std::size_t shadow_maps = 0;  // images; 0: shadow rays
        std::size_t bytes = 0;        // of the images
    } direct;
    struct Solve {
        std::string backend;  // OPENGL or CPU
        std::string renderer;
        std::string reason;  // why this back end
        int iterations = 0;  // full passes over the links
        double residual = 0;
        bool converged = false;
    } solve;
    struct Display {
        std::string mode;     // the option's item: PATCHES, SPLATTING or FINAL_SHOOTING
        std::string backend;  // OPENGL or CPU; empty without a camera
        std::string renderer;
    } display;
    struct Timings {
        double sync = 0, hierarchy = 0, links = 0, visibility = 0, direct = 0, solve = 0,
               display = 0, total = 0;
    } timings_s;                                              // 0: of a stage that was kept
    std::vector<std::pair<std::string, std::string>> stages;  // name -> "run" or "kept"
    std::uint64_t peak_memory_bytes = 0;                      // of the process
    std::vector<std::string> warnings;
    std::string error;  // empty: success

    [[nodiscard]] std::string to_json() const;
};

}  // namespace antiradiance
