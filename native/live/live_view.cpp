// SPDX-License-Identifier: GPL-3.0-or-later
#include "live/live_view.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "base/error.h"
#include "base/stopwatch.h"

namespace antiradiance {

namespace {

constexpr std::chrono::duration<double> kRest{0.12};  // without a move, for a view to rest

// Navigation pictures come before solving. Longer ones do not: a solution that is being edited
// would wait for pictures of what it was.
class StandAside {
public:
    StandAside(PauseGate& gate, bool stand_aside) : gate_(stand_aside ? &gate : nullptr) {
        if (gate_) gate_->hold();
    }
    ~StandAside() {
        if (gate_) gate_->release();
    }
    StandAside(const StandAside&) = delete;
    StandAside& operator=(const StandAside&) = delete;

private:
    PauseGate* gate_;
};

bool is_urgent(LevelName level) {
    return level == LevelName::kNavigation || level == LevelName::kQuick;
}

// Viewports keep pixels as half floats, in which more would become infinite.
void clamp_to_half(std::vector<vec4>& pixels) {
    constexpr float kLargestHalf = 65504;
    for (vec4& pixel : pixels)
        pixel = glm::min(pixel, vec4(kLargestHalf));
}

double pixels_of(const Camera& camera) {
    return static_cast<double>(camera.x1 - camera.x0) * static_cast<double>(camera.y1 - camera.y0);
}

}  // namespace

LiveView::LiveView(std::shared_ptr<LiveSolver> solver)
    : solver_(std::move(solver)), thread_([this] { serve(); }) {}

void LiveView::stop() {
    {
        const std::scoped_lock lock(mutex_);
        stop_ = true;
    }
    solver_->bell().ring();
    if (thread_.joinable()) thread_.join();
}

void LiveView::set_camera(const Camera& camera) {
    {
        const std::scoped_lock lock(mutex_);
        if (camera_ == camera) return;
        // The first one is where the view begins, not a move.
        if (camera_) moved_at_ = std::chrono::steady_clock::now();
        camera_ = camera;
        ++request_;
    }
    solver_->bell().ring();
}

void LiveView::set_inspection(const InspectOptions& options) {
    {
        const std::scoped_lock lock(mutex_);
        if (inspection_ == options) return;
        inspection_ = options;
        ++request_;
    }
    solver_->bell().ring();
}

LiveView::State LiveView::state() const {
    const std::scoped_lock lock(mutex_);
    return state_;
}

std::shared_ptr<const LivePicture> LiveView::newest() const {
    const std::scoped_lock lock(mutex_);
    return newest_;
}

// A preliminary one has other patches and links than those that are inspected.
std::shared_ptr<const LiveSolver::Solution> LiveView::newest_solution() const {
    return inspection_.mode == InspectMode::kOff ? solver_->newest() : solver_->newest_whole();
}

std::optional<LiveView::Subject> LiveView::subject() const {
    const LiveSolver::State solving = solver_->state();
    Subject result;
    // While paused, what there is is all there will be.
    result.whole = !solving.working || solving.paused;
    const std::scoped_lock lock(mutex_);
    result.solution = newest_solution();
    if (!result.solution || !camera_) return std::nullopt;
    result.camera = *camera_;
    result.inspection = inspection_;
    result.request = request_;
    return result;
}

double LiveView::seconds_to_rest() const {
    const std::scoped_lock lock(mutex_);
    return (moved_at_ + kRest - std::chrono::steady_clock::now()) / std::chrono::seconds(1);
}

std::optional<PictureLevel> LiveView::next_level(const Subject& subject) const {
    const std::vector<PictureLevel> levels =
        subject.inspection.mode == InspectMode::kOff
            ? picture_levels(subject.solution->scene.input->options)
            : inspection_levels();
    const bool is_new =
        tried_.solution != subject.solution || tried_.request != subject.request || !best_;
    const bool resting = seconds_to_rest() <= 0;
    if (is_new) return levels.front();
    if (!resting) return std::nullopt;
    const auto next = std::ranges::find_if(
        levels, [&](const PictureLevel& level) { return level.name > *best_; });
    if (next == levels.end() || (!subject.whole && !is_urgent(next->name))) return std::nullopt;
    return *next;
}

void LiveView::serve() {
    while (true) {
        const std::uint64_t heard = solver_->bell().rings();
        const std::optional<Subject> now = subject();
        const std::optional<PictureLevel> level = now ? next_level(*now) : std::nullopt;
        {
            const std::scoped_lock lock(mutex_);
            if (stop_) return;
            state_.making = level ? std::optional(level->name) : std::nullopt;
        }
        if (level) {
            make(*now, *level);
        } else if (const double rest = seconds_to_rest(); rest > 0) {
            solver_->bell().wait_for(heard, std::chrono::duration<double>(rest));
        } else {
            solver_->bell().wait(heard);
        }
    }
}

bool LiveView::is_outdated(const Subject& subject) const {
    const std::scoped_lock lock(mutex_);
    return stop_ || newest_solution() != subject.solution || request_ != subject.request;
}

Picture LiveView::draw(const Subject& subject, const PictureLevel& level, const Camera& camera,
                       Progress& progress) {
    if (subject.inspection.mode != InspectMode::kOff) {
        return inspector_.draw(subject.solution, subject.inspection, camera,
                               level.quality.samples_per_axis, progress);
    }
    return show(subject.solution->scene, camera, level.options, level.quality, display_, progress)
        .picture;
}

void LiveView::make(const Subject& subject, const PictureLevel& level) {
    const bool navigates = level.name == LevelName::kNavigation;
    // A navigation picture is finished though the view has moved on: else there would be none
    // as long as it moves.
    Progress progress({}, [&] {
        if (!navigates) return is_outdated(subject);
        const std::scoped_lock lock(mutex_);
        return stop_;
    });
    const double pixels = pixels_of(subject.camera);
    const float share = navigates ? pace_.share(pixels) : 1;
    LevelName shown = level.name;
    std::string error;
    try {
        auto picture = std::make_shared<LivePicture>();
        const StandAside urgent(solver_->gate(), navigates);
        Stopwatch watch;
        const Camera camera = share < 1 ? scaled(subject.camera, share) : subject.camera;
        picture->picture = draw(subject, level, camera, progress);
        clamp_to_half(picture->picture.combined);
        picture->seconds = watch.lap();
        picture->camera = subject.camera;
        picture->solution = subject.solution->number;
        if (navigates) pace_.add(pixels_of(camera), picture->seconds);
        // With all pixels it is as good as the next level.
        if (navigates && share == 1) shown = LevelName::kQuick;
        picture->level = shown;
        const std::scoped_lock lock(mutex_);
        picture->number = newest_ ? newest_->number + 1 : 1;
        if (navigates) ++state_.navigation_pictures;
        newest_ = std::move(picture);
    } catch (const Cancelled&) {
        return;
    } catch (const std::exception& failure) {
        error = failure.what();
        shown = LevelName::kFinal;  // the same would fail again
    }
    tried_ = subject;
    best_ = shown;
    const std::scoped_lock lock(mutex_);
    state_.error = error;
}

}  // namespace antiradiance
