// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/pruning_json.h"

#include <nlohmann/json.hpp>

namespace antiradiance {

namespace {

nlohmann::ordered_json json_of(const SolutionError& error) {
    return {{"relative_rms", error.relative_rms},
            {"bias", error.bias},
            {"largest_leak", error.largest_leak},
            {"converged", error.converged}};
}

nlohmann::ordered_json json_of(const std::vector<RuleEvaluation>& rules) {
    auto json = nlohmann::ordered_json::object();
    for (const RuleEvaluation& rule : rules) {
        const PruneEvaluation& counts = rule.counts;
        json[rule.method] = {
            {"explicit", counts.explicit_test},  {"removed", counts.removed},
            {"incorrect", counts.incorrect},     {"incorrect_radiance", counts.incorrect_radiance},
            {"not_removed", counts.not_removed}, {"seconds", counts.seconds},
            {"solution", json_of(rule.error)}};
    }
    return json;
}

}  // namespace

nlohmann::ordered_json json_of(const PruningTable& table) {
    return {{"patches", table.patches},
            {"links", table.links},
            {"explicit", table.explicit_test},
            {"explicit_seconds", table.explicit_seconds},
            {"unpruned", json_of(table.unpruned)},
            {"evaluation", json_of(table.rules)}};
}

}  // namespace antiradiance
