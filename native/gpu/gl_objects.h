// SPDX-License-Identifier: GPL-3.0-or-later
// OpenGL objects that free themselves. Make, use and destroy them on the context's thread only:
// on another one libepoxy aborts, as it finds no context.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "gpu/gl_context.h"
#include "gpu/shader_source.h"

namespace antiradiance::gpu {

// The name (a number, 0: none) of an OpenGL object, freed by Delete.
template <void (*Delete)(std::uint32_t)>
class Name {
public:
    Name() = default;
    explicit Name(std::uint32_t name) : name_(name) {}
    ~Name() {
        if (name_ != 0) Delete(name_);
    }
    Name(Name&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
    Name& operator=(Name&& other) noexcept {
        std::swap(name_, other.name_);
        return *this;
    }
    [[nodiscard]] std::uint32_t get() const { return name_; }

private:
    std::uint32_t name_ = 0;
};

void delete_buffer(std::uint32_t name);
void delete_program(std::uint32_t name);
void delete_query(std::uint32_t name);

// Bytes on the device, of a fixed size.
class RawBuffer {
public:
    RawBuffer() = default;
    // Zeros, or the bytes at `data`. Throws GlError when the device has no room.
    RawBuffer(std::size_t bytes, const void* data);

    void write(std::size_t offset, std::size_t bytes, const void* data);
    void read(std::size_t offset, std::size_t bytes, void* data) const;
    void clear();                  // to zeros
    void bind(int binding) const;  // as an SSBO
    void bind_uniform(int binding, std::size_t offset, std::size_t bytes) const;

private:
    Name<delete_buffer> name_;
};

// An array of T on the device. T has the same layout in GLSL (std430).
template <class T>
class Buffer {
    static_assert(std::is_trivially_copyable_v<T>);

public:
    Buffer() = default;
    explicit Buffer(std::size_t size) : size_(size), raw_(size * sizeof(T), nullptr) {}  // zeros
    explicit Buffer(std::span<const T> values)
        : size_(values.size()), raw_(values.size_bytes(), values.data()) {}

    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] std::size_t bytes() const { return size_ * sizeof(T); }

    void write(std::span<const T> values, std::size_t first = 0) {
        raw_.write(first * sizeof(T), values.size_bytes(), values.data());
    }
    [[nodiscard]] std::vector<T> read() const { return read(0, size_); }
    [[nodiscard]] std::vector<T> read(std::size_t first, std::size_t count) const {
        std::vector<T> values(count);
        raw_.read(first * sizeof(T), count * sizeof(T), values.data());
        return values;
    }
    void clear() { raw_.clear(); }
    void bind(int binding) const { raw_.bind(binding); }
    // One value as a uniform buffer; sizeof(T) is a multiple of 256, which any device aligns to.
    void bind_uniform(int binding, std::size_t index) const {
        static_assert(sizeof(T) % 256 == 0);
        raw_.bind_uniform(binding, index * sizeof(T), sizeof(T));
    }

private:
    std::size_t size_ = 0;
    RawBuffer raw_;
};

class Program {
public:
    Program() = default;
    // Throws GlError with the compiler's messages, which name the files of the source.
    static Program compute(const ShaderSource& source);
    static Program raster(const ShaderSource& vertex, const ShaderSource& fragment);

    void use() const;
    // Runs that many work groups; what they wrote is seen by later dispatches and reads.
    void dispatch(std::size_t groups_x, std::size_t groups_y = 1) const;
    // Uniforms by their explicit location.
    void set(int location, std::uint32_t value) const;
    void set(int location, float value) const;

private:
    Name<delete_program> name_;
};

// Nanoseconds of device time between begin() and end().
class TimerQuery {
public:
    TimerQuery();
    void begin() const;
    void end() const;
    [[nodiscard]] std::uint64_t nanoseconds() const;  // waits for the device

private:
    Name<delete_query> name_;
};

}  // namespace antiradiance::gpu
