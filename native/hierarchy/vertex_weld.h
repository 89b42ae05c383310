// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <unordered_map>
#include <vector>

#include "base/types.h"

namespace antiradiance {

using VertexId = std::int32_t;

// Corners in one cell of a grid are one vertex, so that objects that touch share edges. Those that
// a border of cells parts stay two.
class VertexWeld {
public:
    explicit VertexWeld(float cell) : cell_(cell) {}  // m, its edge

    VertexId add(const vec3& p) {
        std::uint64_t key = 0;
        for (int k = 0; k < 3; ++k) {
            key =
                (key << 21U) | (static_cast<std::uint64_t>(std::llround(p[k] / cell_)) & 0x1FFFFFU);
        }
        const auto [it, added] = known_.try_emplace(key, static_cast<VertexId>(positions_.size()));
        if (added) positions_.push_back(p);
        return it->second;
    }
    [[nodiscard]] const vec3& operator[](VertexId v) const {
        return positions_[static_cast<std::size_t>(v)];
    }

private:
    float cell_;
    std::unordered_map<std::uint64_t, VertexId> known_;
    std::vector<vec3> positions_;
};

}  // namespace antiradiance
