// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/ray_scene.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <cstring>
#include <new>
#include <stdexcept>
#include <string>

namespace antiradiance {

namespace {

struct DeviceDeleter {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneDeleter {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using DevicePtr = std::unique_ptr<RTCDeviceTy, DeviceDeleter>;
using ScenePtr = std::unique_ptr<RTCSceneTy, SceneDeleter>;

void throw_on_error(RTCDevice device) {
    const RTCError error = rtcGetDeviceError(device);
    if (error == RTC_ERROR_NONE) return;
    if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
    throw std::runtime_error("Embree failed with error " + std::to_string(error));
}

void intersect_first(RTCScene scene, RTCRayHit& ray) {
#if RTC_VERSION_MAJOR >= 4
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.flags = RTC_RAY_QUERY_FLAG_INCOHERENT;
    rtcIntersect1(scene, &ray, &arguments);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &ray);
#endif
}

bool blocked(RTCScene scene, RTCRay& ray) {
#if RTC_VERSION_MAJOR >= 4
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.flags = RTC_RAY_QUERY_FLAG_INCOHERENT;
    rtcOccluded1(scene, &ray, &arguments);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene, &context, &ray);
#endif
    return ray.tfar < 0;
}

constexpr std::size_t kPacket = 8;

// valid: -1 for each ray that counts. Sets tfar < 0 where a ray is blocked.
void blocked(RTCScene scene, const int* valid, RTCRay8& rays) {
#if RTC_VERSION_MAJOR >= 4
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    rtcOccluded8(valid, scene, &rays, &arguments);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcOccluded8(valid, scene, &context, &rays);
#endif
}

RTCRay make_ray(const vec3& origin, const vec3& direction, float near, float far) {
    RTCRay ray{};
    ray.org_x = origin.x;
    ray.org_y = origin.y;
    ray.org_z = origin.z;
    ray.dir_x = direction.x;
    ray.dir_y = direction.y;
    ray.dir_z = direction.z;
    ray.tnear = near;
    ray.tfar = far;
    ray.mask = ~0U;
    return ray;
}

}  // namespace

struct RayScene::Impl {
    DevicePtr device;
    ScenePtr scene;
};

RayScene::RayScene(const Scene& scene)
    : impl_(std::make_unique<Impl>()), epsilon_(kEpsilonShare * largest_extent(scene)) {
    impl_->device.reset(rtcNewDevice(nullptr));
    if (!impl_->device) throw_on_error(nullptr);
    const RTCDevice device = impl_->device.get();
    impl_->scene.reset(rtcNewScene(device));
    // Without it, rays slip through shared edges: a light leak in a closed room.
    rtcSetSceneFlags(impl_->scene.get(), RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(impl_->scene.get(), RTC_BUILD_QUALITY_MEDIUM);

    if (!scene.triangles.empty()) {
        const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        // Embree allocates these and pads them by the 16 bytes it may read beyond the last vertex.
        void* vertices =
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                    sizeof(vec3), scene.positions.size());
        void* indices =
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                    sizeof(uvec3), scene.triangles.size());
        if (vertices == nullptr || indices == nullptr) {
            rtcReleaseGeometry(geometry);
            throw_on_error(device);
            throw std::bad_alloc();
        }
        std::memcpy(vertices, scene.positions.data(), scene.positions.size() * sizeof(vec3));
        std::memcpy(indices, scene.triangles.data(), scene.triangles.size() * sizeof(uvec3));
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(impl_->scene.get(), geometry, 0);
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(impl_->scene.get());
    throw_on_error(device);
}

RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

RayHit RayScene::intersect(const vec3& origin, const vec3& direction, float near, float far) const {
    RTCRayHit query{};
    query.ray = make_ray(origin, direction, near, far);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    intersect_first(impl_->scene.get(), query);
    RayHit hit;
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return hit;
    hit.triangle = static_cast<TriangleId>(query.hit.primID);
    hit.barycentric = {query.hit.u, query.hit.v};
    hit.distance = query.ray.tfar;
    const vec3 normal(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z);
    hit.back_side = glm::dot(normal, direction) > 0;
    return hit;
}

bool RayScene::occluded(const vec3& a, const vec3& b) const {
    const vec3 d = b - a;
    const float length = glm::length(d);
    if (length <= 2 * epsilon_) return false;
    RTCRay ray = make_ray(a, d / length, epsilon_, length - epsilon_);
    return blocked(impl_->scene.get(), ray);
}

void RayScene::occluded(std::span<const ShadowRay> rays, std::span<std::uint8_t> blocked_by) const {
    for (std::size_t first = 0; first < rays.size(); first += kPacket) {
        const std::size_t count = std::min(kPacket, rays.size() - first);
        alignas(32) int valid[kPacket] = {};
        RTCRay8 packet{};
        for (std::size_t i = 0; i < count; ++i) {
            const vec3 d = rays[first + i].to - rays[first + i].from;
            const float length = glm::length(d);
            if (length <= 2 * epsilon_) continue;
            valid[i] = -1;
            packet.org_x[i] = rays[first + i].from.x;
            packet.org_y[i] = rays[first + i].from.y;
            packet.org_z[i] = rays[first + i].from.z;
            packet.dir_x[i] = d.x / length;
            packet.dir_y[i] = d.y / length;
            packet.dir_z[i] = d.z / length;
            packet.tnear[i] = epsilon_;
            packet.tfar[i] = length - epsilon_;
            packet.mask[i] = ~0U;
        }
        blocked(impl_->scene.get(), valid, packet);
        for (std::size_t i = 0; i < count; ++i)
            blocked_by[first + i] = valid[i] != 0 && packet.tfar[i] < 0 ? 1 : 0;
    }
}

bool RayScene::escapes(const vec3& origin, const vec3& direction) const {
    RTCRay ray = make_ray(origin, direction, epsilon_, kInfinity);
    return !blocked(impl_->scene.get(), ray);
}

}  // namespace antiradiance
