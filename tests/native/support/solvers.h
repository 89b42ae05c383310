// SPDX-License-Identifier: GPL-3.0-or-later
// One test body over both back ends.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "solve/solver.h"

namespace antiradiance::test {

// Parameter: kCpu or kOpenGL. Skipped with the reason where the back end can't be had.
class OnEachSolver : public testing::TestWithParam<SolverChoice> {
protected:
    void SetUp() override {
        std::string why_not;
        solver = GetParam() == SolverChoice::kCpu ? make_cpu_solver() : make_gl_solver(why_not);
        if (!solver) GTEST_SKIP() << why_not;
    }
    std::unique_ptr<Solver> solver;
    Progress progress;
};

inline std::string solver_name(const testing::TestParamInfo<SolverChoice>& info) {
    return info.param == SolverChoice::kCpu ? "Cpu" : "OpenGL";
}

inline auto each_solver() {
    return testing::Values(SolverChoice::kCpu, SolverChoice::kOpenGL);
}

}  // namespace antiradiance::test
