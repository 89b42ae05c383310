// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/report.h"

#include <nlohmann/json.hpp>

#include "pipeline/pruning_json.h"

namespace antiradiance {

std::string Report::to_json() const {
    auto stages_json = nlohmann::ordered_json::object();
    for (const auto& [name, what] : stages)
        stages_json[name] = what;
    nlohmann::ordered_json pruning_json = {
        {"method", pruning.method},
        {"removed", pruning.removed_radiance + pruning.removed_antiradiance},
        {"removed_radiance", pruning.removed_radiance},
        {"removed_antiradiance", pruning.removed_antiradiance},
        {"removed_dark", pruning.removed_dark},
        {"seconds", pruning.seconds}};
    if (!pruning.table.rules.empty()) pruning_json.update(json_of(pruning.table));
    LinkCount cut;
    auto planes_json = nlohmann::ordered_json::array();
    for (const Blockers::Plane& plane : blockers.per_plane) {
        cut += plane.cut;
        planes_json.push_back({{"name", plane.name},
                               {"links_cut", plane.cut.total()},
                               {"radiance_cut", plane.cut.radiance},
                               {"antiradiance_cut", plane.cut.antiradiance}});
    }
    const nlohmann::ordered_json json = {
        {"patches", patches},
        {"leaves", leaves},
        {"links",
         {{"radiance", links.radiance},
          {"antiradiance", links.antiradiance},
          {"total", links.total},
          {"bytes", links.bytes}}},
        {"pruning", pruning_json},
        {"visibility",
         {{"mode", visibility.mode},
          {"rays", visibility.rays},
          {"explicit_rows", visibility.explicit_rows},
          {"implicit_rows", visibility.implicit_rows}}},
        {"blockers",
         {{"planes", blockers.per_plane.size()},
          {"links_cut", cut.total()},
          {"radiance_cut", cut.radiance},
          {"antiradiance_cut", cut.antiradiance},
          {"seconds", blockers.seconds},
          {"per_plane", planes_json}}},
        {"direct", {{"shadow_maps", direct.shadow_maps}, {"bytes", direct.bytes}}},
        {"solve",
         {{"backend", solve.backend},
          {"renderer", solve.renderer},
          {"reason", solve.reason},
          {"iterations", solve.iterations},
          {"residual", solve.residual},
          {"converged", solve.converged}}},
        {"display",
         {{"mode", display.mode}, {"backend", display.backend}, {"renderer", display.renderer}}},
        {"stages", stages_json},
        {"timings_s",
         {{"sync", timings_s.sync},
          {"hierarchy", timings_s.hierarchy},
          {"links", timings_s.links},
          {"visibility", timings_s.visibility},
          {"direct", timings_s.direct},
          {"solve", timings_s.solve},
          {"display", timings_s.display},
          {"total", timings_s.total}}},
        {"peak_memory_bytes", peak_memory_bytes},
        {"warnings", warnings},
        {"error", error},
    };
    // Object names may hold any bytes; a report is written all the same.
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace antiradiance
