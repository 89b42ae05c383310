// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/progress.h"

#include <algorithm>
#include <chrono>

#include "base/error.h"

namespace antiradiance {

namespace {

constexpr std::chrono::milliseconds kPollInterval{20};

}  // namespace

void Progress::begin_stage(std::string stage, float begin, float end) {
    stage_ = std::move(stage);
    begin_ = begin;
    end_ = end;
    report(0);
}

void Progress::poll() {
    if (is_cancelled_ && is_cancelled_()) cancel();
    check();
}

void Progress::report(float fraction) {
    poll();
    if (report_) report_(begin_ + (end_ - begin_) * std::clamp(fraction, 0.0F, 1.0F), stage_);
    while (paused()) {
        gate_->wait(kPollInterval);
        poll();
    }
}

void Progress::wait_while_paused() const {
    check();
    while (paused()) {
        gate_->wait(kPollInterval);
        check();
    }
}

void Progress::check() const {
    if (cancelled()) throw Cancelled();
}

}  // namespace antiradiance
