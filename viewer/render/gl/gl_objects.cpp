#include "viewer/render/gl/gl_objects.h"

#include <array>
#include <vector>

#include "kernel/core/error.h"

namespace lissom::gl {
namespace {

// How many errors a driver can hold back; a lost context reports one for ever.
constexpr int kMaximumErrors = 16;

void destroy_shader(GLuint id) {
    glDeleteShader(id);
}
using Shader = Name<destroy_shader>;

// The driver's message about a shader or program, read with the functions for its kind.
template <typename GetParameter, typename GetLog>
std::string info_log(GLuint id, GetParameter get_parameter, GetLog get_log) {
    GLint length = 0;
    get_parameter(id, GL_INFO_LOG_LENGTH, &length);
    std::vector<char> text(at(length) + 1, '\0');
    get_log(id, static_cast<GLsizei>(text.size()), nullptr, text.data());
    return text.data();
}

[[noreturn]] void throw_refused(std::string_view name, const std::string& log) {
    throw Error(ErrorCode::internal,
                "the OpenGL driver refuses the " + std::string(name) + " shader: " + log);
}

Shader compile(std::string_view name, GLenum kind, const char* common, const char* source) {
    Shader shader(glCreateShader(kind));
    const std::array texts{common, source};
    glShaderSource(shader.id(), static_cast<GLsizei>(texts.size()), texts.data(), nullptr);
    glCompileShader(shader.id());
    GLint compiled = 0;
    glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &compiled);
    if (!compiled) {
        throw_refused(name, info_log(shader.id(), glGetShaderiv, glGetShaderInfoLog));
    }
    return shader;
}

}  // namespace

void destroy_buffer(GLuint id) {
    glDeleteBuffers(1, &id);
}
void destroy_vertex_array(GLuint id) {
    glDeleteVertexArrays(1, &id);
}
void destroy_texture(GLuint id) {
    glDeleteTextures(1, &id);
}
void destroy_renderbuffer(GLuint id) {
    glDeleteRenderbuffers(1, &id);
}
void destroy_framebuffer(GLuint id) {
    glDeleteFramebuffers(1, &id);
}
void destroy_program(GLuint id) {
    glDeleteProgram(id);
}

Buffer make_vertex_buffer(std::span<const std::byte> bytes) {
    GLuint id = 0;
    glGenBuffers(1, &id);
    Buffer buffer(id);
    glBindBuffer(GL_ARRAY_BUFFER, id);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(bytes.size()), bytes.data(),
                 GL_STATIC_DRAW);
    return buffer;
}

VertexArray make_vertex_array() {
    GLuint id = 0;
    glGenVertexArrays(1, &id);
    return VertexArray(id);
}

Texture make_texture(int width, int height, GLenum format, bool linear) {
    GLuint id = 0;
    glGenTextures(1, &id);
    Texture texture(id);
    glBindTexture(GL_TEXTURE_2D, id);
    const GLint filter = linear ? GL_LINEAR : GL_NEAREST;
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    glTexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(format), width, height, 0, GL_RGBA, GL_FLOAT,
                 nullptr);
    return texture;
}

Texture make_volume(const std::array<Index, 3>& counts, std::span<const std::uint8_t> texels) {
    GLuint id = 0;
    glGenTextures(1, &id);
    Texture texture(id);
    glBindTexture(GL_TEXTURE_3D, id);
    glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R}) {
        glTexParameteri(GL_TEXTURE_3D, wrap, GL_CLAMP_TO_EDGE);
    }
    glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MAX_LEVEL, 0);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage3D(GL_TEXTURE_3D, 0, GL_RGBA8, counts[0], counts[1], counts[2], 0, GL_RGBA,
                 GL_UNSIGNED_BYTE, texels.data());
    return texture;
}

TextureBuffer make_texture_buffer(std::span<const std::byte> bytes, GLenum format) {
    TextureBuffer result;
    GLuint buffer = 0, texture = 0;
    glGenBuffers(1, &buffer);
    result.buffer = Buffer(buffer);
    glBindBuffer(GL_TEXTURE_BUFFER, buffer);
    glBufferData(GL_TEXTURE_BUFFER, static_cast<GLsizeiptr>(bytes.size()), bytes.data(),
                 GL_STATIC_DRAW);
    glGenTextures(1, &texture);
    result.texture = Texture(texture);
    glBindTexture(GL_TEXTURE_BUFFER, texture);
    glTexBuffer(GL_TEXTURE_BUFFER, format, buffer);
    return result;
}

Framebuffer Framebuffer::texture(Extent extent, GLenum color_format, bool with_depth) {
    Framebuffer result;
    result.extent_ = extent;
    result.color_texture_ = make_texture(extent.width, extent.height, color_format);
    GLuint id = 0;
    glGenFramebuffers(1, &id);
    result.name_ = FramebufferName(id);
    glBindFramebuffer(GL_FRAMEBUFFER, id);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
                           result.color_texture_.id(), 0);
    if (with_depth) result.attach_depth(0);
    result.finish();
    return result;
}

Framebuffer Framebuffer::multisampled(Extent extent, GLenum color_format, int samples) {
    Framebuffer result;
    result.extent_ = extent;
    GLuint id = 0;
    glGenRenderbuffers(1, &id);
    result.color_buffer_ = Renderbuffer(id);
    glBindRenderbuffer(GL_RENDERBUFFER, id);
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, color_format, extent.width,
                                     extent.height);
    GLuint framebuffer = 0;
    glGenFramebuffers(1, &framebuffer);
    result.name_ = FramebufferName(framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, id);
    result.attach_depth(samples);
    result.finish();
    return result;
}

void Framebuffer::attach_depth(int samples) {
    GLuint id = 0;
    glGenRenderbuffers(1, &id);
    depth_buffer_ = Renderbuffer(id);
    glBindRenderbuffer(GL_RENDERBUFFER, id);
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_DEPTH_COMPONENT32F, extent_.width,
                                     extent_.height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, id);
}

void Framebuffer::finish() const {
    const GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
    check_errors("making room for the picture");
    if (status == GL_FRAMEBUFFER_COMPLETE) return;
    throw Error(ErrorCode::unsupported,
                "the OpenGL driver cannot draw into the kind of picture that is needed (status " +
                    std::to_string(status) + ")");
}

void Framebuffer::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, name_.id());
    glViewport(0, 0, extent_.width, extent_.height);
}

void Framebuffer::resolve_to(const Framebuffer& target) const {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, name_.id());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target.name_.id());
    glBlitFramebuffer(0, 0, extent_.width, extent_.height, 0, 0, extent_.width, extent_.height,
                      GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void Framebuffer::copy_to_window(int x, int y, Extent rectangle) const {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, name_.id());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    glBlitFramebuffer(0, 0, extent_.width, extent_.height, x, y + rectangle.height,
                      x + rectangle.width, y, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

Program::Program(std::string_view name, const char* common, const char* vertex,
                 const char* fragment) {
    const Shader vertex_shader = compile(name, GL_VERTEX_SHADER, common, vertex);
    const Shader fragment_shader = compile(name, GL_FRAGMENT_SHADER, common, fragment);
    program_ = Name<destroy_program>(glCreateProgram());
    glAttachShader(program_.id(), vertex_shader.id());
    glAttachShader(program_.id(), fragment_shader.id());
    glLinkProgram(program_.id());
    GLint linked = 0;
    glGetProgramiv(program_.id(), GL_LINK_STATUS, &linked);
    if (!linked) throw_refused(name, info_log(program_.id(), glGetProgramiv, glGetProgramInfoLog));
}

GLint Program::location(const char* uniform) const {
    const std::string_view name = uniform;
    const auto known = locations_.find(name);
    if (known != locations_.end()) return known->second;
    return locations_.emplace(name, glGetUniformLocation(program_.id(), uniform)).first->second;
}

void Program::set(const char* uniform, int value) const {
    glUniform1i(location(uniform), value);
}

void Program::set(const char* uniform, float value) const {
    glUniform1f(location(uniform), value);
}

void Program::set(const char* uniform, const Vec2& value) const {
    glUniform2fv(location(uniform), 1, Eigen::Vector2f(value.cast<float>()).data());
}

void Program::set(const char* uniform, const Vec3& value) const {
    glUniform3fv(location(uniform), 1, Eigen::Vector3f(value.cast<float>()).data());
}

void Program::set(const char* uniform, const Vec4& value) const {
    glUniform4fv(location(uniform), 1, Eigen::Vector4f(value.cast<float>()).data());
}

void Program::set(const char* uniform, const Mat4& value) const {
    glUniformMatrix4fv(location(uniform), 1, GL_FALSE, Eigen::Matrix4f(value.cast<float>()).data());
}

void Program::set_texture(const char* uniform, int unit, GLuint texture) const {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glBindTexture(GL_TEXTURE_2D, texture);
    set(uniform, unit);
}

void Program::set_volume(const char* uniform, int unit, GLuint texture) const {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glBindTexture(GL_TEXTURE_3D, texture);
    set(uniform, unit);
}

void Program::set_buffer(const char* uniform, int unit, GLuint texture) const {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glBindTexture(GL_TEXTURE_BUFFER, texture);
    set(uniform, unit);
}

void check_errors(std::string_view doing) {
    const GLenum error = glGetError();
    if (error == GL_NO_ERROR) return;
    for (int i = 0; i < kMaximumErrors && glGetError() != GL_NO_ERROR; ++i) continue;
    if (error == GL_OUT_OF_MEMORY) {
        throw Error(ErrorCode::memory_limit, "the OpenGL driver has not enough memory for " +
                                                 std::string(doing) + "; make the picture smaller");
    }
    throw Error(ErrorCode::internal,
                "OpenGL error " + std::to_string(error) + " while " + std::string(doing));
}

}  // namespace lissom::gl
