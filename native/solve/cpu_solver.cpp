// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cpu_solver.h"

#include <algorithm>
#include <cmath>
#include <thread>

#include "base/stopwatch.h"
#include "hierarchy/push_pull.h"
#include "solve/convergence.h"
#include "solve/transport.h"

namespace antiradiance {

namespace {

class CpuSolver final : public Solver {
public:
    Solution solve(const TransportProblem& problem, const SolveOptions& options,
                   Progress& progress) override {
        const PatchTree& tree = problem.tree;
        Transport transport(tree, problem.links);
        Solution solution;
        solution.backend = "CPU";
        solution.renderer =
            "CPU, " + std::to_string(std::thread::hardware_concurrency()) + " threads";
        solution.radiance.assign(problem.source.begin(), problem.source.end());
        solution.irradiance.assign(tree.size(), vec3(0));
        pull_area_average<vec3>(tree, solution.radiance);

        Stopwatch watch;
        const Sweep sweep = options.iterations > 0 ? Sweep::kJacobi : Sweep::kFrontToBack;
        ConvergenceControl control(options);
        while (!control.done()) {
            progress.report(control.progress());
            transport.gather(solution.radiance, sweep, control.damping(), progress);
            solution.irradiance = transport.leaf_irradiance();
            const Update update = update_radiance(problem, control.damping(), solution);
            control.next_pass(update.change, update.gained);
        }
        solution.iterations = control.passes();
        solution.residual = control.residual();
        solution.converged = control.converged();
        solution.seconds = watch.lap();
        for (vec3& e : solution.irradiance)
            e = glm::max(e, vec3(0));
        return solution;
    }

private:
    struct Update {
        float change = 0;  // largest of L
        float gained = 0;  // largest difference of L from its source
    };
    // K of Eq. 3 for diffuse surfaces, and the pull.
    static Update update_radiance(const TransportProblem& problem, float damping,
                                  Solution& solution) {
        Update update;
        for (const NodeId leaf : problem.tree.leaves) {
            const auto n = static_cast<std::size_t>(leaf);
            solution.irradiance[n] *= problem.row_scale[n];
            const vec3 reflected = problem.albedo[n] * kInvPi * solution.irradiance[n];
            const vec3 next = glm::max(vec3(0), problem.source[n] + reflected);
            const vec3 difference = next - solution.radiance[n];
            update.change = std::max(update.change, max_component(glm::abs(difference)));
            update.gained =
                std::max(update.gained, max_component(glm::abs(next - problem.source[n])));
            solution.radiance[n] += damping * difference;
        }
        pull_area_average<vec3>(problem.tree, solution.radiance);
        return update;
    }
};

}  // namespace

std::unique_ptr<Solver> make_cpu_solver() {
    return std::make_unique<CpuSolver>();
}

std::vector<vec3> gather_once(const PatchTree& tree, const LinkSet& links,
                              std::span<const vec3> radiance, std::span<const std::uint8_t> rows,
                              Progress& progress) {
    std::vector<vec3> pulled(radiance.begin(), radiance.end());
    pull_area_average<vec3>(tree, pulled);
    Transport transport(tree, links);
    transport.gather(pulled, Sweep::kJacobi, 1, progress);
    return transport.leaf_irradiance(rows);
}

}  // namespace antiradiance
