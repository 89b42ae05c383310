// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "gpu/gl_thread.h"

namespace antiradiance::gpu {

// A test that needs OpenGL 4.5; elsewhere it is skipped with the reason.
class GlTest : public testing::Test {
protected:
    void SetUp() override {
        std::string why_not;
        gl = GlThread::shared(why_not);
        if (!gl) GTEST_SKIP() << why_not;
    }
    std::shared_ptr<GlThread> gl;
};

}  // namespace antiradiance::gpu
