// SPDX-License-Identifier: GPL-3.0-or-later
#include "gpu/gl_raster.h"

#include <epoxy/gl.h>

namespace antiradiance::gpu {

void delete_texture(std::uint32_t name) {
    glDeleteTextures(1, &name);
}

void delete_framebuffer(std::uint32_t name) {
    glDeleteFramebuffers(1, &name);
}

void delete_vertex_array(std::uint32_t name) {
    glDeleteVertexArrays(1, &name);
}

DepthImages::DepthImages(int size, int layers) : size_(size), layers_(layers) {
    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &name);
    texture_ = Name<delete_texture>(name);
    glTextureStorage3D(name, 1, GL_DEPTH_COMPONENT32F, size, size, layers);
    if (glGetError() != GL_NO_ERROR) {
        throw GlError("no room for " + std::to_string(layers) + " depth images of " +
                      std::to_string(size) + " pixels squared on the OpenGL device");
    }
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_NEAREST);

    glCreateFramebuffers(1, &name);
    framebuffer_ = Name<delete_framebuffer>(name);
    glNamedFramebufferDrawBuffer(name, GL_NONE);
    glCreateVertexArrays(1, &name);
    vertex_array_ = Name<delete_vertex_array>(name);
}

std::size_t DepthImages::bytes() const {
    const auto side = static_cast<std::size_t>(size_);
    return side * side * static_cast<std::size_t>(layers_) * sizeof(float);
}

void DepthImages::draw(int layer, const Program& program, std::size_t vertices) const {
    glNamedFramebufferTextureLayer(framebuffer_.get(), GL_DEPTH_ATTACHMENT, texture_.get(), 0,
                                   layer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
    glViewport(0, 0, size_, size_);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    const float nothing = 0;
    glClearNamedFramebufferfv(framebuffer_.get(), GL_DEPTH, 0, &nothing);
    program.use();
    glBindVertexArray(vertex_array_.get());
    glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(vertices));
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

void DepthImages::bind(int unit) const {
    glBindTextureUnit(static_cast<GLuint>(unit), texture_.get());
}

}  // namespace antiradiance::gpu
