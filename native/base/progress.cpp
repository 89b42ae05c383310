// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/progress.h"

#include <algorithm>

#include "base/error.h"

namespace antiradiance {

void Progress::begin_stage(std::string stage, float begin, float end) {
    stage_ = std::move(stage);
    begin_ = begin;
    end_ = end;
    report(0);
}

void Progress::report(float fraction) {
    if (is_cancelled_ && is_cancelled_()) cancel();
    check();
    if (report_) report_(begin_ + (end_ - begin_) * std::clamp(fraction, 0.0F, 1.0F), stage_);
}

void Progress::check() const {
    if (cancelled()) throw Cancelled();
}

}  // namespace antiradiance
