// SPDX-License-Identifier: GPL-3.0-or-later
// Keeps the picture of one viewport up to date, on a thread of its own: quick pictures while its
// camera moves, better ones when it rests.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "live/inspector.h"
#include "live/live_solver.h"
#include "live/picture_levels.h"
#include "pipeline/choose_display.h"
#include "scene/scene.h"

namespace antiradiance {

struct LivePicture {
    std::uint64_t number = 0;    // 1, 2, ...
    std::uint64_t solution = 0;  // LiveSolver::Solution::number
    Camera camera;               // the picture fills its border, and may have fewer pixels
    LevelName level{};
    Picture picture;     // no value above 65504, the largest of a half float
    double seconds = 0;  // that it took
};

class LiveView {
public:
    struct State {
        std::optional<LevelName> making;  // none: the newest picture is all there will be
        std::string error;                // why there is no better picture; or empty
        std::uint64_t navigation_pictures = 0;
    };

    explicit LiveView(std::shared_ptr<LiveSolver> solver);
    ~LiveView() { stop(); }
    LiveView(const LiveView&) = delete;
    LiveView& operator=(const LiveView&) = delete;

    // Cancels the picture under way and waits for its end, some 50 ms. No other one comes.
    void stop();

    void set_camera(const Camera& camera);
    // What to show instead of the picture; kOff: the picture.
    void set_inspection(const InspectOptions& options);

    [[nodiscard]] State state() const;
    [[nodiscard]] std::shared_ptr<const LivePicture> newest() const;  // null before the first

private:
    // What a picture is made of.
    struct Subject {
        std::shared_ptr<const LiveSolver::Solution> solution;
        Camera camera;
        InspectOptions inspection;
        std::uint64_t request = 0;
        bool whole = false;  // no edit is being solved: the best picture is worth its time
    };

    void serve();
    [[nodiscard]] std::shared_ptr<const LiveSolver::Solution> newest_solution() const;
    [[nodiscard]] std::optional<Subject> subject() const;
    [[nodiscard]] std::optional<PictureLevel> next_level(const Subject& subject) const;
    void make(const Subject& subject, const PictureLevel& level);
    [[nodiscard]] Picture draw(const Subject& subject, const PictureLevel& level,
                               const Camera& camera, Progress& progress);
    [[nodiscard]] bool is_outdated(const Subject& subject) const;
    [[nodiscard]] double seconds_to_rest() const;

    std::shared_ptr<LiveSolver> solver_;
    Inspector inspector_;            // of the thread
    ChosenDisplay display_;          // of the thread
    NavigationPace pace_;            // of the thread
    Subject tried_;                  // the last subject, of the thread
    std::optional<LevelName> best_;  // level at which tried_ was shown, or failed

    mutable std::mutex mutex_;  // of what follows
    State state_;
    std::optional<Camera> camera_;
    InspectOptions inspection_;
    std::uint64_t request_ = 0;  // how often one of them changed
    std::chrono::steady_clock::time_point moved_at_;
    std::shared_ptr<const LivePicture> newest_;
    bool stop_ = false;

    std::thread thread_;  // last: it uses all the others
};

}  // namespace antiradiance
