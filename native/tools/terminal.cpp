// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/terminal.h"

#include <unistd.h>

#include <csignal>
#include <cstdio>

namespace antiradiance {

namespace {

volatile std::sig_atomic_t interrupted = 0;

void on_interrupt(int signal) {
    interrupted = 1;
    std::signal(signal, SIG_DFL);
}

}  // namespace

Terminal::Terminal()
    : is_terminal_(isatty(STDERR_FILENO) != 0),
      progress_([this](float fraction, const std::string& stage) { show(fraction, stage); },
                [] { return interrupted != 0; }) {
    interrupted = 0;
    std::signal(SIGINT, on_interrupt);
}

Terminal::~Terminal() {
    std::signal(SIGINT, SIG_DFL);
    if (!shown_.empty()) std::fputs("\r\x1b[K", stderr);
}

void Terminal::show(float fraction, const std::string& stage) {
    if (!is_terminal_) return;
    const std::string text = std::to_string(static_cast<int>(100 * fraction)) + " % " + stage;
    if (text == shown_) return;
    std::fprintf(stderr, "\r%s\x1b[K", text.c_str());
    shown_ = text;
}

}  // namespace antiradiance
