// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/shadow_maps_gl.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/random.h"
#include "gpu/gl_raster.h"
#include "gpu/gl_thread.h"
#include "gpu/shader_source.h"
#include "solve/shadow_layout_gl.h"

namespace antiradiance {
namespace {

using gpu::Buffer;
using gpu::GlContext;
using gpu::GlThread;
using gpu::Program;

// Texels along a side: within these limits as many as fit into this memory.
constexpr std::size_t kMapBytes = std::size_t{128} << 20U;
constexpr int kLeastSize = 64;
constexpr int kMostSize = 2048;
// A cone this wide (rad, half of it) is seen in one image; wider ones take the faces of a cube.
constexpr float kWidestImage = 1.1F;
// Device time between two looks at the caller.
constexpr double kSliceSeconds = 0.05;
// Of one batch; about as long on two cores in llvmpipe.
constexpr std::size_t kLookUps = 1U << 19U;

struct Bounds {
    vec3 center;   // m
    float radius;  // m
};

Bounds bounds_of(const Scene& scene) {
    vec3 low(1e30F);
    vec3 high(-1e30F);
    for (const vec3& p : scene.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    return {(low + high) / 2.0F, glm::distance(low, high) / 2};
}

// The images of some points of lights, all of one size.
struct Views {
    std::vector<glsl::ShadowLight> lights;
    std::int32_t images = 0;

    void add(const EmitterPoint& point, const Bounds& bounds, float near_end) {
        glsl::ShadowLight light{};
        light.first_image = images;
        if (point.is_sun()) {
            add_face(light, parallel(point.axis, bounds));
        } else if (point.reach < kWidestImage) {
            const float scale = 1 / std::tan(point.reach);
            add_face(light, perspective(point.position, Frame(point.axis), scale, near_end));
        } else {
            const Frame f(point.axis);
            for (const vec3& z : {f.n, f.t, -f.t, f.s, -f.s})
                add_face(light, perspective(point.position, Frame(z), 1, near_end));
            if (point.reach > kPi / 2)
                add_face(light, perspective(point.position, Frame(-f.n), 1, near_end));
        }
        images += light.face_count;
        lights.push_back(light);
    }

private:
    static glsl::ShadowView parallel(const vec3& axis, const Bounds& bounds) {
        const Frame f(axis);
        const float radius = 1.001F * bounds.radius;
        return {f.t, 1 / radius, f.s, 0, axis, 2 * radius, bounds.center - axis * radius, 0};
    }
    static glsl::ShadowView perspective(const vec3& origin, const Frame& f, float scale,
                                        float near_end) {
        return {f.t, scale, f.s, near_end, f.n, 0, origin, 0};
    }
    static void add_face(glsl::ShadowLight& light, const glsl::ShadowView& view) {
        light.faces[light.face_count++] = view;
    }
};

int size_for(std::int32_t images) {
    const double texels = static_cast<double>(kMapBytes / sizeof(float)) / images;
    return std::clamp(static_cast<int>(std::sqrt(texels)), kLeastSize, kMostSize);
}

// Maps of points of one kind on the device.
class MapSet {
public:
    explicit MapSet(Views views)
        : lights_(std::move(views.lights)), images_(size_for(views.images), views.images) {
        for (glsl::ShadowLight& light : lights_) {
            // A rim of one texel lets comparisons at the edge of a cube's face stay within it.
            for (glsl::ShadowView& face : light.faces)
                face.scale *= 1 - 2 / static_cast<float>(images_.size());
        }
        buffer_ = Buffer<glsl::ShadowLight>(std::span<const glsl::ShadowLight>(lights_));
    }

    [[nodiscard]] std::size_t light_count() const { return lights_.size(); }
    [[nodiscard]] std::size_t image_count() const {
        return static_cast<std::size_t>(lights_.back().first_image + lights_.back().face_count);
    }
    [[nodiscard]] std::size_t bytes() const { return images_.bytes(); }

    // All images of a light.
    void draw(std::size_t light, const Program& program, std::size_t vertices) const {
        buffer_.bind_uniform(glsl::kLightBinding, light);
        program.set(glsl::kImageSizeLocation, static_cast<float>(images_.size()));
        for (int face = 0; face < lights_[light].face_count; ++face) {
            program.set(glsl::kFaceLocation, static_cast<std::uint32_t>(face));
            images_.draw(lights_[light].first_image + face, program, vertices);
        }
    }

    // Into columns [first, first + light_count()) of rows as long as all lights.
    void look_up(const Program& program, std::size_t receivers, std::size_t first) const {
        images_.bind(glsl::kMapsUnit);
        program.set(glsl::kPointCountLocation, static_cast<std::uint32_t>(receivers));
        for (std::size_t light = 0; light < lights_.size(); ++light) {
            buffer_.bind_uniform(glsl::kLightBinding, light);
            program.set(glsl::kColumnLocation, static_cast<std::uint32_t>(first + light));
            program.dispatch((receivers + glsl::kShadowGroupSize - 1) / glsl::kShadowGroupSize);
        }
    }

private:
    std::vector<glsl::ShadowLight> lights_;
    gpu::DepthImages images_;
    Buffer<glsl::ShadowLight> buffer_;
};

std::vector<float> corners_of(const Scene& scene) {
    std::vector<float> corners;
    corners.reserve(9 * scene.triangles.size());
    for (TriangleId t = 0; t < static_cast<TriangleId>(scene.triangles.size()); ++t) {
        for (const vec3& c : scene.corners(t))
            corners.insert(corners.end(), {c.x, c.y, c.z});
    }
    return corners;
}

// All that lives on the device.
struct Device {
    Program draw, look_up;
    Buffer<float> corners;
    Buffer<glsl::LitPoint> receivers;
    Buffer<float> visibility;
    std::vector<MapSet> sets;  // in the order of the emitter points
};

Device make_device(const GlContext& context, const std::vector<float>& corners,
                   std::vector<Views> views, std::size_t batch, std::size_t points, float bias) {
    if (corners.size() * sizeof(float) > context.device().max_storage_block_bytes) {
        throw gpu::GlError("the scene's triangles do not fit into one buffer");
    }
    const std::filesystem::path folder = gpu::shader_folder();
    Device device;
    device.draw = Program::raster(gpu::load_shader(folder, "shadow/draw_shadow_map.vert"),
                                  gpu::load_shader(folder, "shadow/draw_shadow_map.frag"));
    device.look_up = Program::compute(gpu::load_shader(folder, "shadow/look_up_shadow_maps.comp"));
    device.look_up.set(glsl::kBiasLocation, bias);
    device.look_up.set(glsl::kRowLengthLocation, static_cast<std::uint32_t>(points));
    device.corners = Buffer<float>(std::span<const float>(corners));
    device.receivers = Buffer<glsl::LitPoint>(batch);
    device.visibility = Buffer<float>(batch * points);
    for (Views& v : views) {
        if (!v.lights.empty()) device.sets.emplace_back(std::move(v));
    }
    return device;
}

// Runs work(), whose failures become errors that say what an artist can do.
template <class Work>
auto with_cure(Work&& work) {
    try {
        return work();
    } catch (const gpu::GlError& failure) {
        throw SceneError(std::string("Direct Light is Shadow Maps, which needs OpenGL: ") +
                         failure.what() + "; set Direct Light to Explicit");
    }
}

std::shared_ptr<GlThread> opengl() {
    std::string why_not;
    std::shared_ptr<GlThread> thread = GlThread::shared(why_not);
    if (!thread) throw gpu::GlError(why_not);
    return thread;
}

}  // namespace

struct ShadowMaps::Impl {
    std::size_t point_count = 0;
    std::size_t batch_size = 0;
    std::size_t image_count = 0;
    std::size_t bytes = 0;
    gpu::OnGlThread<Device> device;

    void draw(std::size_t vertices, Progress& progress);
};

// In slices, after each of which the caller may stop us: callbacks must come from this thread.
void ShadowMaps::Impl::draw(std::size_t vertices, Progress& progress) {
    using Clock = std::chrono::steady_clock;
    std::size_t set = 0;
    std::size_t light = 0;
    for (std::size_t drawn = 0; drawn < point_count;) {
        device.run([&](Device& d, GlContext& context) {
            const auto end = Clock::now() + std::chrono::duration<double>(kSliceSeconds);
            d.corners.bind(glsl::kTrianglesBinding);
            do {
                if (light == d.sets[set].light_count()) {
                    light = 0;
                    ++set;
                }
                d.sets[set].draw(light++, d.draw, vertices);
                context.finish();
                ++drawn;
            } while (drawn < point_count && Clock::now() < end);
        });
        progress.report(static_cast<float>(drawn) / static_cast<float>(point_count));
    }
}

ShadowMaps::ShadowMaps(const Scene& scene, std::span<const EmitterPoint> points, float epsilon,
                       Progress& progress) {
    std::vector<Views> views(2);  // of points, of suns
    const Bounds bounds = bounds_of(scene);
    for (const EmitterPoint& point : points)
        views[point.is_sun() ? 1 : 0].add(point, bounds, epsilon);
    const std::size_t batch = std::max<std::size_t>(1, kLookUps / points.size());
    const std::vector<float> corners = corners_of(scene);
    with_cure([&] {
        impl_ =
            std::make_unique<Impl>(Impl{.point_count = points.size(),
                                        .batch_size = batch,
                                        .device = {opengl(), [&](GlContext& context) {
                                                       return std::make_unique<Device>(make_device(
                                                           context, corners, std::move(views),
                                                           batch, points.size(), 2 * epsilon));
                                                   }}});
        impl_->device.run([&](Device& d, GlContext&) {
            for (const MapSet& set : d.sets) {
                impl_->image_count += set.image_count();
                impl_->bytes += set.bytes();
            }
        });
        impl_->draw(3 * scene.triangles.size(), progress);
    });
}

ShadowMaps::~ShadowMaps() = default;
ShadowMaps::ShadowMaps(ShadowMaps&&) noexcept = default;
ShadowMaps& ShadowMaps::operator=(ShadowMaps&&) noexcept = default;

std::size_t ShadowMaps::image_count() const {
    return impl_->image_count;
}

std::size_t ShadowMaps::bytes() const {
    return impl_->bytes;
}

std::size_t ShadowMaps::batch_size() const {
    return impl_->batch_size;
}

void ShadowMaps::look_up(std::span<const SurfacePoint> receivers,
                         std::span<float> visibility) const {
    std::vector<glsl::LitPoint> points;
    points.reserve(receivers.size());
    for (const SurfacePoint& r : receivers)
        points.push_back({r.position, 0, r.normal, 0});
    const std::vector<float> found = with_cure([&] {
        return impl_->device.run([&](Device& d, GlContext&) {
            d.receivers.write(points);
            d.receivers.bind(glsl::kLitPointsBinding);
            d.visibility.bind(glsl::kVisibilityBinding);
            std::size_t first = 0;
            for (const MapSet& set : d.sets) {
                set.look_up(d.look_up, points.size(), first);
                first += set.light_count();
            }
            return d.visibility.read(0, points.size() * impl_->point_count);
        });
    });
    std::copy(found.begin(), found.end(), visibility.begin());
}

}  // namespace antiradiance
