// SPDX-License-Identifier: GPL-3.0-or-later
// Light transport over the link mesh, Eq. 3 and 4: L = E + K U (L - A), A = J U (L - A).
//
//   auto solver = make_solver(choice, ...);   // CPU or OpenGL
//   Solution s = solver->solve(problem, options, progress);
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/progress.h"
#include "hierarchy/patch_tree.h"
#include "links/link_set.h"
#include "solve/solve_options.h"

namespace antiradiance {

struct TransportProblem {
    const PatchTree& tree;
    const LinkSet& links;
    // Radiance that enters the links from outside of them, W/(m2 sr): emission and reflected direct
    // light of leaves (of the exposed part); other nodes are filled by the pull.
    std::span<const vec3> source;  // #nodes; read at leaves
    // Reflectance of a leaf times its exposed share; 0 for surfaces that only emit.
    std::span<const vec3> albedo;  // #nodes; read at leaves
    // Row normalisation: every leaf's gathered irradiance is multiplied by this (1: none).
    std::span<const float> row_scale;  // #nodes; read at leaves
};

struct SolveOptions {
    // 0: until the residual is below `tolerance`. Else that many passes of the paper's Jacobi
    // scheme (L and A together), the same on every back end.
    int iterations = 0;
    float tolerance = 1e-4F;   // of the residual
    int max_iterations = 200;  // of the converging scheme
};

struct Solution {
    std::vector<vec3> irradiance;  // #nodes: W/m2 gathered over links by leaves (0 elsewhere)
    std::vector<vec3> radiance;    // #nodes: W/(m2 sr), L of Eq. 3, area average of the leaves
    int iterations = 0;            // full passes over the links
    float residual = 0;            // max |L' - L| / max |L' - source| of the last pass
    bool converged = false;        // residual below tolerance; a fixed count reports it too
    double seconds = 0;            // iterations only
    std::string backend;           // "CPU" or "OPENGL"
    std::string renderer;          // of OpenGL, or the CPU's description
};

class Solver {
public:
    virtual ~Solver() = default;
    // Throws Cancelled; std::runtime_error when the device fails.
    [[nodiscard]] virtual Solution solve(const TransportProblem& problem,
                                         const SolveOptions& options, Progress& progress) = 0;
};

[[nodiscard]] std::unique_ptr<Solver> make_cpu_solver();
// Null, with the reason in `why_not`, where OpenGL 4.5 can't be had.
[[nodiscard]] std::unique_ptr<Solver> make_gl_solver(std::string& why_not);

}  // namespace antiradiance
