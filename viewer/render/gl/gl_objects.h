/// OpenGL objects that end with their C++ owner. All of it needs a current context, also to end.
#pragma once

#include <epoxy/gl.h>

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "kernel/core/geometry.h"

namespace lissom::gl {

/// Owns one OpenGL name; `destroy` ends it.
template <void (*destroy)(GLuint)>
class Name {
  public:
    Name() = default;
    explicit Name(GLuint id) : id_(id) {}
    Name(Name&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
    Name& operator=(Name&& other) noexcept {
        std::swap(id_, other.id_);
        return *this;
    }
    Name(const Name&) = delete;
    Name& operator=(const Name&) = delete;
    ~Name() {
        if (id_) destroy(id_);
    }

    GLuint id() const { return id_; }

  private:
    GLuint id_ = 0;
};

void destroy_buffer(GLuint id);
void destroy_vertex_array(GLuint id);
void destroy_texture(GLuint id);
void destroy_renderbuffer(GLuint id);
void destroy_framebuffer(GLuint id);
void destroy_program(GLuint id);

using Buffer = Name<destroy_buffer>;
using VertexArray = Name<destroy_vertex_array>;
using Texture = Name<destroy_texture>;
using Renderbuffer = Name<destroy_renderbuffer>;
using FramebufferName = Name<destroy_framebuffer>;

/// Returns a vertex buffer with `bytes` copied into it, bound to GL_ARRAY_BUFFER.
Buffer make_vertex_buffer(std::span<const std::byte> bytes);
VertexArray make_vertex_array();
/// Returns a texture without mipmaps that is read clamped, at its texels or (`linear`) between
/// them.
Texture make_texture(int width, int height, GLenum format, bool linear = false);
/// Returns a volume of four bytes a texel, x fastest, that is read clamped, between its texels.
Texture make_volume(const std::array<Index, 3>& counts, std::span<const std::uint8_t> texels);

/// A buffer whose entries shaders read by their numbers, with a texture of `format` for that.
struct TextureBuffer {
    Buffer buffer;
    Texture texture;
};
TextureBuffer make_texture_buffer(std::span<const std::byte> bytes, GLenum format);

/// Size in pixels.
struct Extent {
    int width = 0;
    int height = 0;

    bool operator==(const Extent&) const = default;
};

/// A framebuffer with one colour texture and no depth, or a multisampled one with both.
class Framebuffer {
  public:
    Framebuffer() = default;
    /// Errors: memory_limit if the driver has no memory for it.
    static Framebuffer texture(Extent extent, GLenum color_format, bool with_depth);
    static Framebuffer multisampled(Extent extent, GLenum color_format, int samples);

    const Extent& extent() const { return extent_; }
    /// Returns the colour texture of a framebuffer made by `texture`.
    GLuint color() const { return color_texture_.id(); }
    /// Directs drawing here, onto all of it.
    void bind() const;
    /// Copies colours to `target`, averaging samples.
    void resolve_to(const Framebuffer& target) const;
    /// Copies colours, whose rows count from the top, to a rectangle of the window of the current
    /// context: (x, y) is its lower left pixel, y from the bottom. Without samples.
    void copy_to_window(int x, int y, Extent rectangle) const;

  private:
    void attach_depth(int samples);
    void finish() const;

    Extent extent_;
    FramebufferName name_;
    Texture color_texture_;
    Renderbuffer color_buffer_, depth_buffer_;
};

/// A linked pair of shaders. Uniforms are set on the program that `use` was last called for.
class Program {
  public:
    Program() = default;
    /// Both sources follow after `common`; `name` is for messages. Errors: internal, with the
    /// driver's message.
    Program(std::string_view name, const char* common, const char* vertex, const char* fragment);

    void use() const { glUseProgram(program_.id()); }
    void set(const char* uniform, int value) const;
    void set(const char* uniform, float value) const;
    void set(const char* uniform, const Vec2& value) const;
    void set(const char* uniform, const Vec3& value) const;
    void set(const char* uniform, const Vec4& value) const;
    void set(const char* uniform, const Mat4& value) const;
    /// Binds `texture` to the unit numbered `unit` and tells the sampler.
    void set_texture(const char* uniform, int unit, GLuint texture) const;
    void set_volume(const char* uniform, int unit, GLuint texture) const;
    void set_buffer(const char* uniform, int unit, GLuint texture) const;

  private:
    GLint location(const char* uniform) const;

    Name<destroy_program> program_;
    // Locations of uniforms that were set: drivers look them up by name slowly.
    mutable std::map<std::string, GLint, std::less<>> locations_;
};

/// Throws if the driver reported an error since the last call: memory_limit if it has no memory
/// left, else internal. `doing` is for the message.
void check_errors(std::string_view doing);

}  // namespace lissom::gl
