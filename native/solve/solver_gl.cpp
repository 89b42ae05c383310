// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/solver_gl.h"

#include <algorithm>
#include <array>
#include <limits>

#include "base/stopwatch.h"
#include "gpu/gl_thread.h"
#include "solve/convergence.h"
#include "solve/transport_device_gl.h"

namespace antiradiance {
namespace {

using gpu::GlContext;
using gpu::GlThread;
using gpu::OnGlThread;

// Device time between two looks at the caller.
constexpr double kSliceSeconds = 0.05;

GlSolverConfig fill_defaults(GlSolverConfig config, const gpu::DeviceInfo& device) {
    const auto set = [](auto& value, auto standard) {
        if (value == 0) value = standard;
    };
    set(config.block_bytes, device.max_storage_block_bytes);
    // Flux and scratch need room as well. A software device's memory is ours: nothing to gain.
    constexpr std::size_t kUnknown = std::size_t{1} << 30U;
    set(config.resident_bytes, device.is_software       ? std::numeric_limits<std::size_t>::max()
                               : device.free_bytes != 0 ? device.free_bytes / 2
                                                        : kUnknown);
    set(config.batch_bytes,
        std::min<std::size_t>(device.max_storage_block_bytes,
                              std::size_t{device.is_software ? 8U : 256U} << 20U));
    set(config.links_per_step, device.is_software ? 1U << 20U : 1U << 22U);
    set(config.long_segment, 256U);
    return config;
}

class GlSolver final : public Solver {
public:
    GlSolver(std::shared_ptr<GlThread> thread, const GlSolverConfig& config)
        : thread_(std::move(thread)), config_(fill_defaults(config, thread_->device())) {}

    Solution solve(const TransportProblem& problem, const SolveOptions& options,
                   Progress& progress) override;

private:
    using Device = OnGlThread<TransportDevice>;

    OnGlThread<TransportPrograms>& programs(bool antiradiance, bool clusters);
    void run_pass(Device& device, const std::vector<Step>& steps, Progress& progress,
                  const std::function<float(float)>& fraction);
    void iterate(Device& device, const SolveOptions& options, Progress& progress,
                 Solution& solution);

    std::shared_ptr<GlThread> thread_;
    GlSolverConfig config_;
    // By what the links hold; kept between solves, since drivers take long over shaders.
    std::array<std::unique_ptr<OnGlThread<TransportPrograms>>, 4> programs_;
    double work_per_second_ = 10e6;  // measured as we go
    double seconds_ = 0;
};

OnGlThread<TransportPrograms>& GlSolver::programs(bool antiradiance, bool clusters) {
    auto& slot = programs_[(antiradiance ? 1U : 0U) + (clusters ? 2U : 0U)];
    if (!slot) {
        slot = std::make_unique<OnGlThread<TransportPrograms>>(thread_, [&](GlContext&) {
            return std::make_unique<TransportPrograms>(antiradiance, clusters);
        });
    }
    return *slot;
}

// Steps go to the device in slices, after each of which the caller may stop us: callbacks must come
// from this thread.
void GlSolver::run_pass(Device& device, const std::vector<Step>& steps, Progress& progress,
                        const std::function<float(float)>& fraction) {
    for (std::size_t next = 0; next < steps.size();) {
        Stopwatch watch;
        double work = 0;
        device.run([&](TransportDevice&, GlContext& context) {
            do {
                steps[next].dispatch();
                work += steps[next].work;
                ++next;
            } while (next < steps.size() &&
                     work + steps[next].work < kSliceSeconds * work_per_second_);
            context.finish();
        });
        const double seconds = watch.lap();
        seconds_ += seconds;
        // Slices of little work tell more about the driver's overhead than about the rate.
        if (work > 1e5) work_per_second_ = std::clamp(work / seconds, 1e6, 1e11);
        progress.report(fraction(static_cast<float>(next) / static_cast<float>(steps.size())));
    }
}

void GlSolver::iterate(Device& device, const SolveOptions& options, Progress& progress,
                       Solution& solution) {
    ConvergenceControl control(options);
    const std::vector<Step> steps =
        device.run([](TransportDevice& d, GlContext&) { return d.pass(); });
    seconds_ = 0;
    while (!control.done()) {
        run_pass(device, steps, progress, [&](float pass_share) {
            return options.iterations == 0
                       ? control.progress()
                       : control.progress() + pass_share / static_cast<float>(options.iterations);
        });
        const glsl::PassState state =
            device.run([](TransportDevice& d, GlContext&) { return d.state(); });
        control.next_pass(state.max_change, max_component(state.max_gained));
        device.run([&](TransportDevice& d, GlContext&) { d.set_relaxation(control.damping()); });
    }
    solution.iterations = control.passes();
    solution.residual = control.residual();
    solution.converged = control.converged();
    solution.seconds = seconds_;
}

// Patches as the device left them; clusters by their parts.
void read_result(const TransportProblem& problem, const NodeTables& tables,
                 OnGlThread<TransportDevice>& device, Solution& solution) {
    const auto [radiance, irradiance] = device.run([](TransportDevice& d, GlContext&) {
        return std::make_pair(d.radiance(), d.irradiance());
    });
    const std::size_t count = tables.nodes.size();
    solution.radiance.assign(count, vec3(0));
    solution.irradiance.assign(count, vec3(0));
    for (const NodeId leaf : problem.tree.leaves) {
        solution.irradiance[static_cast<std::size_t>(leaf)] =
            glm::max(vec3(irradiance[static_cast<std::size_t>(leaf)]), vec3(0));
    }
    for (std::size_t n = count; n-- > 0;) {
        const glsl::Node& node = tables.nodes[n];
        if (node.cluster < 0) {
            solution.radiance[n] = vec3(radiance[n]);
        } else if (node.area > 0) {
            solution.radiance[n] /= node.area;
        }
        if (node.parent != kNone &&
            tables.nodes[static_cast<std::size_t>(node.parent)].cluster >= 0) {
            solution.radiance[static_cast<std::size_t>(node.parent)] +=
                node.area * solution.radiance[n];
        }
    }
}

Solution GlSolver::solve(const TransportProblem& problem, const SolveOptions& options,
                         Progress& progress) {
    const NodeTables tables = make_node_tables(problem);
    const std::size_t bin_bytes = tables.nodes.size() * sizeof(vec4);
    const bool antiradiance = problem.links.antiradiance_count > 0;
    const bool clusters = uses_clusters(problem.tree, problem.links);
    // Batches exist for the antiradiance's sake.
    const std::size_t bins_per_batch =
        antiradiance
            ? std::max<std::size_t>(1, config_.batch_bytes / std::max<std::size_t>(1, bin_bytes))
            : tables.axes.size();
    const std::vector<Chunk> chunks =
        make_chunks(problem.links, tables.nodes.size(),
                    {config_.block_bytes,
                     static_cast<std::uint32_t>(std::min(bins_per_batch, tables.axes.size())),
                     config_.links_per_step, config_.long_segment},
                    progress);
    progress.report(0);
    const TransportPrograms* compiled = nullptr;
    programs(antiradiance, clusters).run([&](TransportPrograms& p, GlContext&) { compiled = &p; });
    progress.check();
    Device device(thread_, [&](GlContext& context) {
        auto made = std::make_unique<TransportDevice>(
            context.device(),
            TransportDevice::Config{antiradiance, clusters, config_.resident_bytes}, *compiled,
            problem.links, tables, chunks);
        context.finish();
        return made;
    });

    Solution solution;
    solution.backend = "OPENGL";
    solution.renderer = thread_->device().renderer;
    iterate(device, options, progress, solution);
    read_result(problem, tables, device, solution);
    progress.report(1);
    return solution;
}

}  // namespace

std::unique_ptr<Solver> make_gl_solver(const GlSolverConfig& config, std::string& why_not) {
    std::shared_ptr<GlThread> thread = GlThread::shared(why_not);
    if (!thread) return nullptr;
    return std::make_unique<GlSolver>(std::move(thread), config);
}

std::unique_ptr<Solver> make_gl_solver(std::string& why_not) {
    return make_gl_solver({}, why_not);
}

}  // namespace antiradiance
