// SPDX-License-Identifier: GPL-3.0-or-later
// When to stop, and when to damp: the same rules for every back end.
#pragma once

#include <vector>

#include "solve/solver.h"

namespace antiradiance {

class ConvergenceControl {
public:
    explicit ConvergenceControl(const SolveOptions& options) : options_(options) {}

    [[nodiscard]] bool done() const;
    // change: largest change of L that the pass asked for, before damping; gained: largest share of
    // an L that came over links. Against the largest L itself the change of a room lit by a small
    // bright lamp would look settled at once.
    void next_pass(float change, float gained);

    // Weight of a new value against the old one for the next pass: 1 until the residual stalls,
    // then halved. A link mesh whose antiradiance has cycles may have a spectral radius above 1.
    [[nodiscard]] float damping() const { return damping_; }
    [[nodiscard]] int passes() const { return static_cast<int>(residuals_.size()); }
    [[nodiscard]] float residual() const { return residuals_.empty() ? 0.0F : residuals_.back(); }
    [[nodiscard]] bool converged() const { return residual() < options_.tolerance; }
    [[nodiscard]] float progress() const;  // 0..1, an estimate

private:
    SolveOptions options_;
    std::vector<float> residuals_;
    float damping_ = 1;
    int passes_since_damped_ = 0;
};

}  // namespace antiradiance
