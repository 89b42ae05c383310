// SPDX-License-Identifier: GPL-3.0-or-later
#include "gpu/gl_objects.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>

namespace antiradiance::gpu {
namespace {

std::string compile_log(GLuint shader) {
    GLint length = 0;
    glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
    glGetShaderInfoLog(shader, length, &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    return log;
}

std::string link_log(GLuint program) {
    GLint length = 0;
    glGetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
    glGetProgramInfoLog(program, length, &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    return log;
}

void delete_shader(std::uint32_t name) {
    glDeleteShader(name);
}

struct Stage {
    GLenum type;
    const ShaderSource* source;
};

Name<delete_shader> compile(const Stage& stage) {
    Name<delete_shader> shader(glCreateShader(stage.type));
    const char* text = stage.source->text.c_str();
    glShaderSource(shader.get(), 1, &text, nullptr);
    glCompileShader(shader.get());
    GLint ok = GL_FALSE;
    glGetShaderiv(shader.get(), GL_COMPILE_STATUS, &ok);
    if (ok != GL_TRUE) {
        throw GlError("shader " + stage.source->files.front() + " does not compile:\n" +
                      stage.source->name_files(compile_log(shader.get())));
    }
    return shader;
}

Name<delete_program> build(std::span<const Stage> stages) {
    Name<delete_program> program(glCreateProgram());
    std::vector<Name<delete_shader>> shaders;
    for (const Stage& stage : stages) {
        shaders.push_back(compile(stage));
        glAttachShader(program.get(), shaders.back().get());
    }
    glLinkProgram(program.get());
    GLint ok = GL_FALSE;
    glGetProgramiv(program.get(), GL_LINK_STATUS, &ok);
    if (ok != GL_TRUE) {
        const ShaderSource& first = *stages.front().source;
        throw GlError("shader " + first.files.front() + " does not link:\n" +
                      first.name_files(link_log(program.get())));
    }
    for (const Name<delete_shader>& shader : shaders)
        glDetachShader(program.get(), shader.get());
    return program;
}

}  // namespace

void delete_buffer(std::uint32_t name) {
    glDeleteBuffers(1, &name);
}

void delete_program(std::uint32_t name) {
    glDeleteProgram(name);
}

void delete_query(std::uint32_t name) {
    glDeleteQueries(1, &name);
}

RawBuffer::RawBuffer(std::size_t bytes, const void* data) {
    GLuint name = 0;
    glCreateBuffers(1, &name);
    name_ = Name<delete_buffer>(name);
    // OpenGL has no buffers of no bytes, and a shader may declare what it never reads.
    const std::size_t size = std::max<std::size_t>(bytes, 16);
    const bool full = data != nullptr && size == bytes;
    glNamedBufferStorage(name, static_cast<GLsizeiptr>(size), full ? data : nullptr,
                         GL_DYNAMIC_STORAGE_BIT);
    if (glGetError() != GL_NO_ERROR) {
        throw GlError("no room for a buffer of " + std::to_string(bytes >> 20U) +
                      " MiB on the OpenGL device");
    }
    if (!full) {
        clear();
        if (data != nullptr && bytes > 0) write(0, bytes, data);
    }
}

void RawBuffer::write(std::size_t offset, std::size_t bytes, const void* data) {
    glNamedBufferSubData(name_.get(), static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes),
                         data);
}

void RawBuffer::read(std::size_t offset, std::size_t bytes, void* data) const {
    if (bytes == 0) return;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(name_.get(), static_cast<GLintptr>(offset),
                            static_cast<GLsizeiptr>(bytes), data);
}

void RawBuffer::clear() {
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glClearNamedBufferData(name_.get(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
}

void RawBuffer::bind(int binding) const {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, static_cast<GLuint>(binding), name_.get());
}

void RawBuffer::bind_uniform(int binding, std::size_t offset, std::size_t bytes) const {
    glBindBufferRange(GL_UNIFORM_BUFFER, static_cast<GLuint>(binding), name_.get(),
                      static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes));
}

Program Program::compute(const ShaderSource& source) {
    const std::array<Stage, 1> stages{Stage{GL_COMPUTE_SHADER, &source}};
    Program program;
    program.name_ = build(stages);
    return program;
}

Program Program::raster(const ShaderSource& vertex, const ShaderSource& fragment) {
    const std::array<Stage, 2> stages{Stage{GL_VERTEX_SHADER, &vertex},
                                      Stage{GL_FRAGMENT_SHADER, &fragment}};
    Program program;
    program.name_ = build(stages);
    return program;
}

void Program::use() const {
    glUseProgram(name_.get());
}

void Program::dispatch(std::size_t groups_x, std::size_t groups_y) const {
    use();
    glDispatchCompute(static_cast<GLuint>(groups_x), static_cast<GLuint>(groups_y), 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void Program::set(int location, std::uint32_t value) const {
    glProgramUniform1ui(name_.get(), location, value);
}

void Program::set(int location, float value) const {
    glProgramUniform1f(name_.get(), location, value);
}

TimerQuery::TimerQuery() {
    GLuint name = 0;
    glCreateQueries(GL_TIME_ELAPSED, 1, &name);
    name_ = Name<delete_query>(name);
}

void TimerQuery::begin() const {
    glBeginQuery(GL_TIME_ELAPSED, name_.get());
}

void TimerQuery::end() const {
    glEndQuery(GL_TIME_ELAPSED);
}

std::uint64_t TimerQuery::nanoseconds() const {
    GLuint64 value = 0;
    glGetQueryObjectui64v(name_.get(), GL_QUERY_RESULT, &value);
    return value;
}

}  // namespace antiradiance::gpu
