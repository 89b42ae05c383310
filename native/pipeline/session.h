// SPDX-License-Identifier: GPL-3.0-or-later
// The whole way from a scene to a picture and a report.
//
//   Session session;
//   session.render(scene, options, ...);    // all stages
//   session.render(moved_camera, ...);      // the display alone: the solution is kept
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/progress.h"
#include "display/display.h"
#include "pipeline/options.h"
#include "pipeline/report.h"
#include "scene/scene.h"

namespace antiradiance {

struct RenderResult {
    Picture picture;
    Report report;
};

// Keeps what the stages of its last render made, for the next one (pipeline/stages.h).
class Session {
public:
    Session();
    ~Session();

    // Solves, as far as something has changed since the last call, and displays; after an exception
    // the session is as good as before. A report is written to options.report_path on success and
    // on failure. Throws SceneError (bad input), Cancelled, std::runtime_error. sync_seconds: what
    // the caller spent on filling `scene`; for the report.
    RenderResult render(Scene scene, const Options& options, bool film_transparent,
                        double sync_seconds, Progress& progress);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// For a caller that failed before there was a scene.
void write_failure_report(const std::string& path, const std::string& error,
                          const std::vector<std::string>& warnings, double sync_seconds);

}  // namespace antiradiance
