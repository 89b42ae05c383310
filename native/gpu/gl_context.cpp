// SPDX-License-Identifier: GPL-3.0-or-later
#include "gpu/gl_context.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <utility>
#include <vector>

namespace antiradiance::gpu {
namespace {

// Set to anything: no OpenGL at all, for tests and for machines whose driver misbehaves.
constexpr const char* kDisableVariable = "ANTIRADIANCE_NO_OPENGL";
// Set to anything: a debug context, in which drivers check more and say more.
constexpr const char* kDebugVariable = "ANTIRADIANCE_GL_DEBUG";

struct Candidate {
    std::string name;  // for messages
    EGLenum platform;
    void* native_display;
};

// Extension lists are space-separated words.
bool has_extension(const char* extensions, std::string_view wanted) {
    std::string_view rest = extensions == nullptr ? "" : extensions;
    while (!rest.empty()) {
        const std::size_t end = rest.find(' ');
        if (rest.substr(0, end) == wanted) return true;
        if (end == std::string_view::npos) return false;
        rest.remove_prefix(end + 1);
    }
    return false;
}

std::string egl_error(const char* call) {
    std::array<char, 16> code{};
    std::snprintf(code.data(), code.size(), "0x%04x", eglGetError());
    return std::string(call) + " failed (EGL error " + code.data() + ")";
}

std::vector<Candidate> candidates() {
    const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    std::vector<Candidate> hardware, software;
    if (has_extension(client, "EGL_EXT_platform_device") &&
        (has_extension(client, "EGL_EXT_device_enumeration") ||
         has_extension(client, "EGL_EXT_device_base"))) {
        EGLint count = 0;
        eglQueryDevicesEXT(0, nullptr, &count);
        std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
        eglQueryDevicesEXT(count, devices.data(), &count);
        for (EGLint i = 0; i < count; ++i) {
            EGLDeviceEXT device = devices[static_cast<std::size_t>(i)];
            const bool is_software = has_extension(eglQueryDeviceStringEXT(device, EGL_EXTENSIONS),
                                                   "EGL_MESA_device_software");
            (is_software ? software : hardware)
                .push_back({"EGL device " + std::to_string(i), EGL_PLATFORM_DEVICE_EXT, device});
        }
    }
    std::vector<Candidate> all = std::move(hardware);
    if (has_extension(client, "EGL_MESA_platform_surfaceless")) {
        // EGL_DEFAULT_DISPLAY is 0 cast to a pointer, in the header's own C style.
        all.push_back({"EGL surfaceless", EGL_PLATFORM_SURFACELESS_MESA, nullptr});
    }
    all.insert(all.end(), software.begin(), software.end());
    return all;
}

bool is_software_renderer(std::string_view renderer) {
    for (const std::string_view name :
         {"llvmpipe", "softpipe", "swrast", "Software Rasterizer", "SwiftShader"}) {
        if (renderer.find(name) != std::string_view::npos) return true;
    }
    return false;
}

std::string gl_string(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text == nullptr ? "" : reinterpret_cast<const char*>(text);
}

DeviceInfo query_device() {
    DeviceInfo info;
    info.vendor = gl_string(GL_VENDOR);
    info.renderer = gl_string(GL_RENDERER);
    info.version = gl_string(GL_VERSION);
    info.is_software = is_software_renderer(info.renderer);
    GLint64 bytes = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &bytes);
    info.max_storage_block_bytes = static_cast<std::size_t>(bytes);
    glGetIntegerv(GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS, &info.max_compute_storage_blocks);
    GLint groups = 0;
    glGetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_COUNT, 0, &groups);
    info.max_work_groups = static_cast<std::size_t>(groups);
    std::array<GLint, 4> kibibytes{};
    if (epoxy_has_gl_extension("GL_NVX_gpu_memory_info")) {
        glGetIntegerv(GL_GPU_MEMORY_INFO_CURRENT_AVAILABLE_VIDMEM_NVX, kibibytes.data());
    } else if (epoxy_has_gl_extension("GL_ATI_meminfo")) {
        glGetIntegerv(GL_VBO_FREE_MEMORY_ATI, kibibytes.data());
    }
    info.free_bytes = static_cast<std::size_t>(kibibytes[0]) << 10U;
    return info;
}

void GLAPIENTRY on_message(GLenum /*source*/, GLenum type, GLuint /*id*/, GLenum severity,
                           GLsizei length, const GLchar* text, const void* messages) {
    // Performance hints and notes are no failures; undefined behaviour is one on other drivers.
    if (type != GL_DEBUG_TYPE_ERROR &&
        !(type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR && severity == GL_DEBUG_SEVERITY_HIGH)) {
        return;
    }
    const std::size_t size = length < 0 ? std::strlen(text) : static_cast<std::size_t>(length);
    // The pointer that glDebugMessageCallback was given; GL only hands it back as const.
    auto* all = static_cast<std::string*>(const_cast<void*>(messages));
    all->append(text, size).append("\n");
}

}  // namespace

struct GlContext::Egl {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;

    Egl() = default;
    Egl(const Egl&) = delete;
    Egl& operator=(const Egl&) = delete;
    ~Egl() {
        if (context == EGL_NO_CONTEXT) return;
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(display, context);
        // No eglTerminate: a display is one object a process, others may be using it.
    }

    // Empty when the context is current; else why not.
    std::string open(const Candidate& candidate) {
        display = eglGetPlatformDisplayEXT(candidate.platform, candidate.native_display, nullptr);
        if (display == EGL_NO_DISPLAY) return egl_error("eglGetPlatformDisplay");
        if (eglInitialize(display, nullptr, nullptr) != EGL_TRUE) return egl_error("eglInitialize");
        const char* extensions = eglQueryString(display, EGL_EXTENSIONS);
        if (!has_extension(extensions, "EGL_KHR_surfaceless_context")) {
            return "no EGL_KHR_surfaceless_context";
        }
        if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) return egl_error("eglBindAPI");

        EGLConfig config = EGL_NO_CONFIG_KHR;
        if (!has_extension(extensions, "EGL_KHR_no_config_context")) {
            const std::array<EGLint, 5> wanted{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                               EGL_SURFACE_TYPE, 0, EGL_NONE};
            EGLint count = 0;
            if (eglChooseConfig(display, wanted.data(), &config, 1, &count) != EGL_TRUE ||
                count == 0) {
                return egl_error("eglChooseConfig");
            }
        }
        const bool debug = std::getenv(kDebugVariable) != nullptr;
        const std::array<EGLint, 9> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                               4,
                                               EGL_CONTEXT_MINOR_VERSION,
                                               5,
                                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                               EGL_CONTEXT_OPENGL_DEBUG,
                                               debug ? EGL_TRUE : EGL_FALSE,
                                               EGL_NONE};
        EGLContext made = eglCreateContext(display, config, EGL_NO_CONTEXT, attributes.data());
        if (made == EGL_NO_CONTEXT) return egl_error("eglCreateContext for OpenGL 4.5 core");
        if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, made) != EGL_TRUE) {
            const std::string reason = egl_error("eglMakeCurrent");
            eglDestroyContext(display, made);
            return reason;
        }
        context = made;
        return {};
    }
};

GlContext::GlContext() : egl_(std::make_unique<Egl>()) {
    if (std::getenv(kDisableVariable) != nullptr) {
        throw GlError(std::string("OpenGL is switched off by ") + kDisableVariable);
    }
    if (!epoxy_has_egl()) throw GlError("libEGL is not installed");
    std::string failures;
    for (const Candidate& candidate : candidates()) {
        const std::string reason = egl_->open(candidate);
        if (reason.empty()) {
            device_ = query_device();
            listen_to_driver();
            return;
        }
        failures += (failures.empty() ? "" : "; ") + candidate.name + ": " + reason;
    }
    throw GlError(
        "no OpenGL 4.5 device (" +
        (failures.empty() ? "EGL offers no device and no surfaceless platform" : failures) + ")");
}

GlContext::~GlContext() {
    if (egl_->context != EGL_NO_CONTEXT) glDebugMessageCallback(nullptr, nullptr);
}

void GlContext::listen_to_driver() {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);  // on_message() must run on this thread
    glDebugMessageCallback(on_message, &messages_);
}

std::string GlContext::take_errors() {
    // A context that is not a debug one may send no messages, so the error flag counts as well.
    std::string errors;
    for (int i = 0; i < 16; ++i) {  // a lost context can return errors for ever
        const GLenum code = glGetError();
        if (code == GL_NO_ERROR) break;
        errors += code == GL_OUT_OF_MEMORY  ? "out of device memory "
                  : code == GL_CONTEXT_LOST ? "context lost "
                                            : "GL error " + std::to_string(code) + " ";
    }
    return errors + std::exchange(messages_, {});
}

void GlContext::check(const std::string& what) {
    const std::string errors = take_errors();
    if (!errors.empty()) throw GlError(what + ": " + errors);
}

void GlContext::finish() {
    glFinish();
}

void GlContext::forget_errors() {
    (void)take_errors();
}

}  // namespace antiradiance::gpu
