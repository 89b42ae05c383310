// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/validate.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numeric>
#include <optional>
#include <set>

#include "base/error.h"
#include "base/random.h"

namespace antiradiance {

namespace {

// Beyond this, squared areas leave the range of float.
constexpr float kLargestCoordinate = 1e8F;  // m
// A triangle whose height is below this share of its longest edge has no usable normal in float.
constexpr double kThinnestTriangle = 1e-6;

std::string count_of(std::size_t n, const char* singular, const char* plural) {
    return std::to_string(n) + " " + (n == 1 ? singular : plural);
}

std::string quoted(const std::string& name) {
    return "'" + name + "'";
}

bool is_finite(const vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool is_finite(const mat4& m) {
    for (int column = 0; column < 4; ++column) {
        if (!is_finite(vec3(m[column])) || !std::isfinite(m[column].w)) return false;
    }
    return true;
}

// The triangle's corners in an order that does not depend on how it is written down.
using CornerKey = std::array<std::uint32_t, 9>;

CornerKey corner_key(const std::array<vec3, 3>& corners) {
    std::array<std::array<std::uint32_t, 3>, 3> bits;
    for (std::size_t i = 0; i < 3; ++i) {
        const vec3 p = corners[i] + 0.0F;  // -0 becomes +0
        bits[i] = {std::bit_cast<std::uint32_t>(p.x), std::bit_cast<std::uint32_t>(p.y),
                   std::bit_cast<std::uint32_t>(p.z)};
    }
    std::sort(bits.begin(), bits.end());
    CornerKey key;
    for (std::size_t i = 0; i < 9; ++i)
        key[i] = bits[i / 3][i % 3];
    return key;
}

std::uint64_t hash_of(const CornerKey& key) {
    std::uint32_t a = 1;
    std::uint32_t b = 2;
    for (const std::uint32_t word : key) {
        a = hash_combine(a, word);
        b = hash_combine(b, word ^ 0x5bd1e995U);
    }
    return (static_cast<std::uint64_t>(a) << 32U) | b;
}

bool is_degenerate(const std::array<vec3, 3>& corners) {
    const glm::dvec3 a(corners[0]);
    const glm::dvec3 b(corners[1]);
    const glm::dvec3 c(corners[2]);
    const double longest = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
    return glm::length(glm::cross(b - a, c - a)) <= kThinnestTriangle * longest * longest ||
           longest < 1e-15;
}

class Validator {
public:
    explicit Validator(Scene& scene) : scene_(scene), keep_(scene.triangles.size(), 1) {}

    std::vector<std::string> run() {
        errors_ = scene_.problems;
        check_coordinates();
        check_textures();
        check_materials();
        check_lamps();
        check_blockers();
        check_camera();
        const bool finite = errors_.empty();
        if (finite) {
            drop_degenerate();
            drop_duplicates();
            compact();
        }
        // Objects that failed are no reason to say that there is nothing to see.
        if (finite && scene_.triangles.empty()) {
            errors_.push_back(
                scene_.blockers.empty()
                    ? "The scene has no faces to render; add a mesh, or make one visible in "
                      "renders (camera icon in the Outliner)"
                    : "The scene has no faces to render besides those of the blocking plane " +
                          quoted(scene_.blockers.front().name) +
                          ", which is not rendered; add a mesh, or clear Blocking Plane of it");
        }
        if (!errors_.empty()) throw SceneError(errors_);
        std::vector<std::string> all = scene_.warnings;
        all.insert(all.end(), warnings_.begin(), warnings_.end());
        return all;
    }

private:
    // Counts per object, in the order of the objects.
    using Counts = std::vector<std::size_t>;

    template <class Text>
    void per_object(const Counts& counts, std::vector<std::string>& out, const Text& text) const {
        for (std::size_t i = 0; i < counts.size(); ++i) {
            if (counts[i] > 0) {
                out.push_back("Object " + quoted(scene_.objects[i].name) + ": " + text(counts[i]));
            }
        }
    }

    void check_coordinates() {
        Counts bad(scene_.objects.size(), 0);
        Counts far(scene_.objects.size(), 0);
        for (std::size_t t = 0; t < scene_.triangles.size(); ++t) {
            const auto object = static_cast<std::size_t>(scene_.triangle_object[t]);
            float largest = 0;
            bool finite = true;
            for (const vec3& p : scene_.corners(static_cast<TriangleId>(t))) {
                finite = finite && is_finite(p);
                largest = std::max(largest, max_component(glm::abs(p)));
            }
            if (!finite) {
                ++bad[object];
            } else if (largest > kLargestCoordinate) {
                ++far[object];
            }
        }
        per_object(bad, errors_, [](std::size_t n) {
            return count_of(n, "triangle has", "triangles have") +
                   " NaN or infinite coordinates; delete these vertices or disable the modifier "
                   "that makes them";
        });
        per_object(far, errors_, [](std::size_t n) {
            return count_of(n, "triangle lies", "triangles lie") +
                   " more than 1e8 m from the origin; scale the object down or move it closer";
        });
    }

    // Objects that show a material, for messages: at most three names.
    [[nodiscard]] std::string users_of(std::size_t material) const {
        std::set<std::int32_t> objects;
        for (std::size_t t = 0; t < scene_.triangles.size(); ++t) {
            if (static_cast<std::size_t>(scene_.triangle_material[t]) == material) {
                objects.insert(scene_.triangle_object[t]);
            }
        }
        std::string text;
        std::size_t listed = 0;
        for (const std::int32_t object : objects) {
            if (listed == 3) return text + " and others";
            text += (listed++ == 0 ? "" : ", ") +
                    quoted(scene_.objects[static_cast<std::size_t>(object)].name);
        }
        return text;
    }

    void check_textures() {
        for (std::size_t m = 0; m < scene_.materials.size(); ++m) {
            const Material& material = scene_.materials[m];
            std::set<int> reported;
            for (const int texture : {material.albedo_texture, material.emission_texture}) {
                if (texture == kNone || !reported.insert(texture).second) continue;
                const std::string users = users_of(m);
                const Texture& image = scene_.textures[static_cast<std::size_t>(texture)];
                if (users.empty() || (image.missing_path.empty() && !image.pixels.empty()))
                    continue;
                errors_.push_back("Object " + users + ": the image " + quoted(image.name) +
                                  " of material " + quoted(material.name) +
                                  " can't be read from '" + image.missing_path +
                                  "'; use File > External Data > Find Missing Files, or remove the "
                                  "texture from the material");
            }
        }
        for (Texture& texture : scene_.textures)
            repair_pixels(texture);
    }

    void repair_pixels(Texture& texture) {
        std::size_t repaired = 0;
        for (vec4& pixel : texture.pixels) {
            if (is_finite(vec3(pixel)) && glm::all(glm::greaterThanEqual(vec3(pixel), vec3(0)))) {
                continue;
            }
            for (int c = 0; c < 3; ++c) {
                if (!std::isfinite(pixel[c]) || pixel[c] < 0) pixel[c] = 0;
            }
            ++repaired;
        }
        if (repaired > 0) {
            warnings_.push_back("Image " + quoted(texture.name) + ": " +
                                count_of(repaired, "pixel was", "pixels were") +
                                " negative, NaN or infinite and became 0; repair the file");
        }
    }

    [[nodiscard]] float largest_texture_value(int texture) const {
        if (texture == kNone) return 1;
        float largest = 0;
        for (const vec4& p : scene_.textures[static_cast<std::size_t>(texture)].pixels) {
            largest = std::max(largest, max_component(vec3(p)));
        }
        return largest;
    }

    void check_materials() {
        for (std::size_t m = 0; m < scene_.materials.size(); ++m) {
            Material& material = scene_.materials[m];
            const std::string who = "Material " + quoted(material.name);
            if (!is_finite(material.albedo) || !is_finite(material.emission)) {
                errors_.push_back(who +
                                  ": its colour or emission is NaN or infinite; check its "
                                  "drivers and type the values again");
                continue;
            }
            if (glm::any(glm::lessThan(glm::min(material.albedo, material.emission), vec3(0)))) {
                warnings_.push_back(who + ": a negative colour or emission became 0");
                material.albedo = glm::max(material.albedo, vec3(0));
                material.emission = glm::max(material.emission, vec3(0));
            }
            const float largest = max_component(material.albedo);
            const float textured = largest * largest_texture_value(material.albedo_texture);
            // The margin forgives rounding of a texture's conversion to linear.
            if (textured > 1.0F + 1e-4F) {
                const std::string users = users_of(m);
                if (!users.empty()) {
                    warnings_.push_back(who + " (object " + users +
                                        "): its colour goes above 1, which would create light, and "
                                        "was cut to 1; make the colour darker");
                }
            }
            material.albedo = material.albedo_texture == kNone
                                  ? glm::min(material.albedo, vec3(1))
                                  : material.albedo;  // albedo_at() cuts the product
        }
    }

    void check_lamps() {
        for (Lamp& lamp : scene_.lamps) {
            const std::string who = "Light " + quoted(lamp.name);
            const bool finite = is_finite(lamp.power) && is_finite(lamp.to_world) &&
                                is_finite(vec3(lamp.radius, lamp.spot_angle, lamp.spot_blend)) &&
                                is_finite(vec3(lamp.size, lamp.spread)) &&
                                std::isfinite(lamp.sun_angle);
            if (!finite) {
                errors_.push_back(who +
                                  ": its strength, size or matrix is NaN or infinite; reset "
                                  "them and check its drivers");
                continue;
            }
            if (glm::any(glm::lessThan(lamp.power, vec3(0)))) {
                warnings_.push_back(who + ": negative strength became 0");
                lamp.power = glm::max(lamp.power, vec3(0));
            }
            check_lamp_matrix(lamp, who);
        }
    }

    void check_lamp_matrix(Lamp& lamp, const std::string& who) {
        if (lamp.type == LampType::kPoint || max_component(lamp.power) == 0) return;
        const vec3 x(lamp.to_world[0]);
        const vec3 y(lamp.to_world[1]);
        const vec3 z(lamp.to_world[2]);
        const bool aims = glm::length(z) > 0;
        const bool spans = lamp.type != LampType::kArea || glm::length(glm::cross(x, y)) > 0;
        if (!aims || !spans) {
            errors_.push_back(who +
                              ": its matrix can't be inverted, because a scale is 0 along an "
                              "axis; set every scale of it and of its parents to another value");
        } else if (lamp.type == LampType::kArea && lamp.size.x * lamp.size.y <= 0) {
            warnings_.push_back(who + ": its size is 0, so it gives no light; set a size above 0");
            lamp.power = vec3(0);
        }
    }

    void check_blockers() {
        for (Blocker& blocker : scene_.blockers) {
            const std::string who = "Blocking plane " + quoted(blocker.name);
            const auto corners = [&](const uvec3& t) {
                return std::array{blocker.positions[t.x], blocker.positions[t.y],
                                  blocker.positions[t.z]};
            };
            const bool finite = std::ranges::all_of(blocker.triangles, [&](const uvec3& t) {
                return std::ranges::all_of(corners(t), [](const vec3& p) {
                    return is_finite(p) && max_component(glm::abs(p)) <= kLargestCoordinate;
                });
            });
            if (!finite) {
                errors_.push_back(who +
                                  ": its coordinates are NaN, infinite or more than 1e8 m from the "
                                  "origin; check its modifiers and its location");
                continue;
            }
            if (blocker.triangles.empty()) {
                warnings_.push_back(who +
                                    ": it has no faces and cuts nothing; give it a face, or delete "
                                    "it");
                continue;
            }
            std::erase_if(blocker.triangles,
                          [&](const uvec3& t) { return is_degenerate(corners(t)); });
            if (blocker.triangles.empty()) {
                warnings_.push_back(who +
                                    ": its faces have no area and cut nothing; set every scale of "
                                    "it and of its parents to another value than 0");
            }
        }
    }

    void check_camera() {
        if (!scene_.has_camera) return;
        const Camera& c = scene_.camera;
        const bool finite = is_finite(c.to_world) && is_finite(vec3(c.left, c.right, c.bottom)) &&
                            is_finite(vec3(c.top, c.clip_start, c.clip_end));
        if (!finite || c.right == c.left || c.top == c.bottom) {
            errors_.emplace_back(
                "The camera's matrix or lens is NaN, infinite or empty; reset its location, "
                "rotation, focal length and shift");
        }
        if (is_finite(scene_.background)) return;
        errors_.emplace_back("The world's colour is NaN or infinite; type it again");
    }

    void drop_degenerate() {
        Counts dropped(scene_.objects.size(), 0);
        for (std::size_t t = 0; t < scene_.triangles.size(); ++t) {
            if (!is_degenerate(scene_.corners(static_cast<TriangleId>(t)))) continue;
            keep_[t] = 0;
            ++dropped[static_cast<std::size_t>(scene_.triangle_object[t])];
        }
        per_object(dropped, warnings_, [](std::size_t n) {
            return count_of(n, "zero-area triangle was", "zero-area triangles were") +
                   " left out; Mesh > Clean Up > Degenerate Dissolve removes them";
        });
    }

    // Surfaces at one place fight over every ray, so only the first is kept, across objects too.
    void drop_duplicates() {
        std::vector<std::pair<std::uint64_t, TriangleId>> order;
        order.reserve(scene_.triangles.size());
        for (std::size_t t = 0; t < scene_.triangles.size(); ++t) {
            const auto id = static_cast<TriangleId>(t);
            if (keep_[t]) order.emplace_back(hash_of(corner_key(scene_.corners(id))), id);
        }
        std::sort(order.begin(), order.end());

        Counts own(scene_.objects.size(), 0);
        Counts foreign(scene_.objects.size(), 0);
        std::vector<std::int32_t> partner(scene_.objects.size(), kNone);
        for (std::size_t i = 0; i < order.size(); ++i) {
            const auto first = static_cast<std::size_t>(order[i].second);
            if (!keep_[first]) continue;
            const CornerKey key = corner_key(scene_.corners(order[i].second));
            for (std::size_t j = i + 1; j < order.size() && order[j].first == order[i].first; ++j) {
                const auto other = static_cast<std::size_t>(order[j].second);
                if (!keep_[other] || corner_key(scene_.corners(order[j].second)) != key) continue;
                keep_[other] = 0;
                const auto object = static_cast<std::size_t>(scene_.triangle_object[other]);
                if (scene_.triangle_object[first] == scene_.triangle_object[other]) {
                    ++own[object];
                } else {
                    ++foreign[object];
                    partner[object] = scene_.triangle_object[first];
                }
            }
        }
        per_object(own, warnings_, [](std::size_t n) {
            return count_of(n, "duplicate triangle was", "duplicate triangles were") +
                   " left out; Mesh > Clean Up > Merge by Distance removes them";
        });
        for (std::size_t i = 0; i < foreign.size(); ++i) {
            if (foreign[i] == 0) continue;
            warnings_.push_back("Object " + quoted(scene_.objects[i].name) + ": " +
                                count_of(foreign[i], "triangle lies", "triangles lie") +
                                " exactly on another object's (" +
                                quoted(scene_.objects[static_cast<std::size_t>(partner[i])].name) +
                                ") and was left out; move or delete one of the two");
        }
    }

    template <class T>
    void keep_marked(std::vector<T>& values) const {
        std::size_t end = 0;
        for (std::size_t i = 0; i < keep_.size(); ++i) {
            if (keep_[i]) values[end++] = values[i];
        }
        values.resize(end);
    }

    void compact() {
        if (std::find(keep_.begin(), keep_.end(), 0) == keep_.end()) return;
        keep_marked(scene_.triangles);
        keep_marked(scene_.triangle_polygon);
        keep_marked(scene_.triangle_material);
        keep_marked(scene_.triangle_object);
        keep_marked(scene_.uv);
        keep_marked(scene_.normals);
        for (Object& object : scene_.objects)
            object.triangle_count = 0;
        for (const std::int32_t object : scene_.triangle_object) {
            ++scene_.objects[static_cast<std::size_t>(object)].triangle_count;
        }
        TriangleId next = 0;
        for (Object& object : scene_.objects) {
            object.first_triangle = next;
            next += object.triangle_count;
        }
    }

    Scene& scene_;
    std::vector<char> keep_;  // #triangles as they came in
    std::vector<std::string> errors_;
    std::vector<std::string> warnings_;
};

}  // namespace

std::vector<std::string> validate(Scene& scene) {
    return Validator(scene).run();
}

}  // namespace antiradiance
