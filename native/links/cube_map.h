// SPDX-License-Identifier: GPL-3.0-or-later
// The cube map that tables over directions use.
#pragma once

#include <algorithm>

#include "base/types.h"

namespace antiradiance {

// Faces 2 * axis + (negative ? 1 : 0); coordinates in [-1, 1].
struct CubeCoordinate {
    int face;
    float x, y;
};

inline CubeCoordinate cube_coordinate(const vec3& direction) {
    const vec3 a = glm::abs(direction);
    const int axis = a.x >= a.y ? (a.x >= a.z ? 0 : 2) : (a.y >= a.z ? 1 : 2);
    const float inverse = 1 / a[axis];
    return {2 * axis + (direction[axis] < 0 ? 1 : 0), direction[(axis + 1) % 3] * inverse,
            direction[(axis + 2) % 3] * inverse};
}

// The point of the cube at a coordinate; not of unit length.
inline vec3 cube_direction(const CubeCoordinate& c) {
    const int axis = c.face / 2;
    vec3 d;
    d[axis] = c.face % 2 ? -1.0F : 1.0F;
    d[(axis + 1) % 3] = c.x;
    d[(axis + 2) % 3] = c.y;
    return d;
}

// The centre of texel (x, y) of a face of size x size texels.
inline vec3 cube_texel_direction(int face, int x, int y, int size) {
    const auto center = [size](int i) {
        return (2 * static_cast<float>(i) + 1) / static_cast<float>(size) - 1;
    };
    return cube_direction({face, center(x), center(y)});
}

// Number of the texel that a direction meets: (face * size + y) * size + x.
inline std::size_t cube_texel(const vec3& direction, int size) {
    const CubeCoordinate c = cube_coordinate(direction);
    const auto texel = [size](float t) {
        return std::clamp(static_cast<int>((t + 1) * (0.5F * static_cast<float>(size))), 0,
                          size - 1);
    };
    return static_cast<std::size_t>((c.face * size + texel(c.y)) * size + texel(c.x));
}

}  // namespace antiradiance
