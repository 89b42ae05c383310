// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/convergence.h"

#include <algorithm>
#include <cmath>

namespace antiradiance {

namespace {
constexpr int kPatience = 10;       // passes within which the residual must fall ...
constexpr float kLeastFall = 0.9F;  // ... to this share; albedo 0.98 still does
constexpr float kLeastDamping = 0.1F;
}  // namespace

bool ConvergenceControl::done() const {
    if (options_.iterations > 0) return passes() >= options_.iterations;
    if (passes() == 0) return false;
    return converged() || passes() >= options_.max_iterations;
}

void ConvergenceControl::next_pass(float change, float gained) {
    const float nothing = change > 0 ? 1.0F : 0.0F;
    const float residual = gained > 0 ? change / gained : nothing;
    residuals_.push_back(residual);
    ++passes_since_damped_;
    if (options_.iterations > 0 || passes_since_damped_ <= kPatience) return;
    const float before = residuals_[residuals_.size() - 1 - kPatience];
    if (residual > kLeastFall * before && damping_ > kLeastDamping) {
        damping_ *= 0.5F;
        passes_since_damped_ = 0;
    }
}

float ConvergenceControl::progress() const {
    if (options_.iterations > 0)
        return static_cast<float>(passes()) / static_cast<float>(options_.iterations);
    if (passes() < 1 || residual() <= 0) return 0;
    // The residual falls geometrically from about 1 to the tolerance.
    return std::clamp(std::log(residual()) / std::log(options_.tolerance), 0.0F, 1.0F);
}

}  // namespace antiradiance
