// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "base/progress.h"

namespace antiradiance {

// The progress of a command on standard error, one line that is written over, when that is a
// terminal; Ctrl-C cancels, a second one ends the process. One at a time.
class Terminal {
public:
    Terminal();
    ~Terminal();
    Terminal(const Terminal&) = delete;
    Terminal& operator=(const Terminal&) = delete;

    [[nodiscard]] Progress& progress() { return progress_; }

private:
    void show(float fraction, const std::string& stage);

    bool is_terminal_;
    std::string shown_;
    Progress progress_;
};

}  // namespace antiradiance
