// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/pruning_table_text.h"

#include <algorithm>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "pipeline/pruning_json.h"

namespace antiradiance {

namespace {

using Row = std::vector<std::string>;

const Row kColumns{
    "method",      "patches", "links", "explicit", "removed",     "incorrect", "incorrect_radiance",
    "not_removed", "seconds", "error", "bias",     "largest_leak"};

std::string number(double value, int digits) {
    std::ostringstream text;
    text << std::fixed << std::setprecision(digits) << value;
    return std::move(text).str();
}

Row make_row(const PruningTable& table, const std::string& method, const PruneEvaluation& counts,
             const SolutionError& error) {
    return {method,
            std::to_string(table.patches),
            std::to_string(table.links),
            std::to_string(table.explicit_test),
            std::to_string(counts.removed),
            std::to_string(counts.incorrect),
            std::to_string(counts.incorrect_radiance),
            std::to_string(counts.not_removed),
            number(counts.seconds, 3),
            number(error.relative_rms, 4),
            number(error.bias, 4),
            number(error.largest_leak, 3)};
}

PruneEvaluation nothing_removed(const PruningTable& table) {
    PruneEvaluation none;
    none.not_removed = table.explicit_test;
    return none;
}

std::vector<Row> make_rows(const PruningTable& table) {
    std::vector<Row> rows{kColumns,
                          make_row(table, "NONE", nothing_removed(table), table.unpruned)};
    for (const RuleEvaluation& rule : table.rules)
        rows.push_back(make_row(table, rule.method, rule.counts, rule.error));
    return rows;
}

}  // namespace

std::string to_text(const PruningTable& table) {
    const std::vector<Row> rows = make_rows(table);
    std::ostringstream text;
    for (const Row& row : rows) {
        for (std::size_t c = 0; c < row.size(); ++c) {
            std::size_t width = 0;
            for (const Row& other : rows)
                width = std::max(width, other[c].size());
            text << (c == 0 ? std::left : std::right) << std::setw(static_cast<int>(width))
                 << row[c] << (c + 1 < row.size() ? "  " : "\n");
        }
    }
    return std::move(text).str();
}

std::string to_csv(const PruningTable& table) {
    std::string text;
    for (const Row& row : make_rows(table)) {
        for (std::size_t c = 0; c < row.size(); ++c)
            text += row[c] + (c + 1 < row.size() ? "," : "\n");
    }
    return text;
}

std::string to_json(const PruningTable& table) {
    return json_of(table).dump(2) + "\n";
}

}  // namespace antiradiance
