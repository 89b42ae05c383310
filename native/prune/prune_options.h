// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace antiradiance {

// HEURISTIC_1 before HEURISTIC_2 does not exist: it removes the links in which the second one would
// see what blocks the others.
enum class PruneMethod {
    kNone,             // keeps all links
    kHeuristic1,       // algorithm 1: sender, occluder and receiver in a line
    kHeuristic2,       // algorithms 2 and 3, reading "H2-b"
    kHeuristic2Then1,  // one after the other
    kConservative,     // algorithm 2 with a shaft in place of a pyramid
    kOracle1,          // algorithm 1 with rays in place of its test of solid angles
    kOracle2,          // algorithm 3 after rays in place of algorithm 2
};

// Heuristic 1 wants the links between sender S, occluder O and receiver R in one direction bin.
enum class PruneDirections {
    kStrict,  // all three, as algorithm 1 prints it with one set of bins
    kText,    // S -> R and O -> R, as section 4.2 says; S -> O in that bin or one that touches it
};

}  // namespace antiradiance
