// The example shader rebuilds hair as the header does.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "bindings/engine/lissom_hair.h"
#include "kernel/hair/guides/guide_set.h"
#include "kernel/io/hair/guide_file.h"
#include "tests/unit/support.h"
#include "viewer/render/gl/gl_objects.h"
#include "viewer/render/gl/platform.h"

using namespace lissom;
using namespace lissom::test;

namespace {

std::unique_ptr<Platform> hair_platform() {
    try {
        return make_egl_platform();
    } catch (const Error& error) {
        if (error.code() != ErrorCode::no_display) throw;
        skip("LISSOM_REQUIRE_GL", error.message());
        return nullptr;
    }
}

GLuint hair_stage(GLenum kind, const std::string& source) {
    const GLuint shader = glCreateShader(kind);
    const char* text = source.c_str();
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    GLint done = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &done);
    char log[1000] = {};
    glGetShaderInfoLog(shader, sizeof log, nullptr, log);
    REQUIRE_MESSAGE(done, log);
    return shader;
}

using HairProgram = gl::Name<gl::destroy_program>;

HairProgram hair_program(const std::string& version) {
    std::ifstream file(LISSOM_HAIR_SHADER, std::ios::binary);
    REQUIRE(file);
    const std::string source(std::istreambuf_iterator<char>(file), {});
    HairProgram program(glCreateProgram());
    const GLuint vertex = hair_stage(GL_VERTEX_SHADER, version + "#define HAS_DETAILS\n" + source);
    const GLuint fragment = hair_stage(
        GL_FRAGMENT_SHADER, version +
                                "precision highp float;\nin vec3 hair_position;\nout vec4 color;\n"
                                "void main() { color = vec4(hair_position, 1.0); }\n");
    glAttachShader(program.id(), vertex);
    glAttachShader(program.id(), fragment);
    const char* varying = "hair_position";
    glTransformFeedbackVaryings(program.id(), 1, &varying, GL_INTERLEAVED_ATTRIBS);
    glLinkProgram(program.id());
    GLint done = 0;
    glGetProgramiv(program.id(), GL_LINK_STATUS, &done);
    REQUIRE(done);
    glDeleteShader(vertex);
    glDeleteShader(fragment);
    return program;
}

gl::Texture hair_texture(GLint format, GLenum layout, GLenum type, std::uint32_t width,
                         std::uint32_t height, const void* texels) {
    GLuint id = 0;
    glGenTextures(1, &id);
    glBindTexture(GL_TEXTURE_2D, id);
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER}) {
        glTexParameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
    }
    glPixelStorei(GL_UNPACK_ALIGNMENT, 2);
    glTexImage2D(GL_TEXTURE_2D, 0, format, static_cast<GLsizei>(width),
                 static_cast<GLsizei>(height), 0, layout, type, texels);
    return gl::Texture(id);
}

// The attributes of strands, one an instance.
gl::Buffer strand_attributes(const lissom_hair& hair) {
    const std::span strands(hair.strands, hair.strand_count);
    gl::Buffer buffer = gl::make_vertex_buffer(std::as_bytes(strands));
    const auto offset = [](std::size_t bytes) { return reinterpret_cast<const void*>(bytes); };
    glVertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, 48, offset(0));
    glVertexAttribIPointer(1, 4, GL_UNSIGNED_INT, 48, offset(16));
    glVertexAttribPointer(2, 4, GL_FLOAT, GL_FALSE, 48, offset(32));
    for (GLuint i = 0; i < 3; ++i) {
        glEnableVertexAttribArray(i);
        glVertexAttribDivisor(i, 1);
    }
    return buffer;
}

std::vector<float> run_hair_shader(const std::string& version, const lissom_hair& hair,
                                   const std::vector<float>& moved) {
    const HairProgram program = hair_program(version);
    const gl::VertexArray array = gl::make_vertex_array();
    glBindVertexArray(array.id());
    const gl::Buffer strands = strand_attributes(hair);
    const std::uint32_t n = hair.point_count;
    const gl::Texture textures[] = {
        hair_texture(GL_RGB32F, GL_RGB, GL_FLOAT, n, hair.guide_count, hair.guides),
        hair_texture(GL_RGB32F, GL_RGB, GL_FLOAT, n, hair.guide_count, moved.data()),
        hair_texture(GL_RGB16I, GL_RGB_INTEGER, GL_SHORT, n, hair.strand_count, hair.details)};
    glUseProgram(program.id());
    const char* const names[] = {"rest_guides", "moved_guides", "details"};
    for (int i = 0; i < 3; ++i) {
        glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(i));
        glBindTexture(GL_TEXTURE_2D, textures[i].id());
        glUniform1i(glGetUniformLocation(program.id(), names[i]), i);
    }
    glActiveTexture(GL_TEXTURE0);
    glUniform1i(glGetUniformLocation(program.id(), "point_count"), static_cast<GLint>(n));
    glUniform1f(glGetUniformLocation(program.id(), "detail_step"), hair.detail_step);
    std::vector<float> out(3 * std::size_t{n} * hair.strand_count);
    GLuint id = 0;
    glGenBuffers(1, &id);
    const gl::Buffer result(id);
    const auto bytes = static_cast<GLsizeiptr>(out.size() * sizeof(float));
    glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, id);
    glBufferData(GL_TRANSFORM_FEEDBACK_BUFFER, bytes, nullptr, GL_STATIC_READ);
    glEnable(GL_RASTERIZER_DISCARD);
    glBeginTransformFeedback(GL_POINTS);
    glDrawArraysInstanced(GL_POINTS, 0, static_cast<GLsizei>(n),
                          static_cast<GLsizei>(hair.strand_count));
    glEndTransformFeedback();
    glDisable(GL_RASTERIZER_DISCARD);
    glGetBufferSubData(GL_TRANSFORM_FEEDBACK_BUFFER, 0, bytes, out.data());
    gl::check_errors("running the example shader");
    return out;
}

}  // namespace

TEST_CASE("hair shader: rebuilds what the header rebuilds") {
    const std::unique_ptr<Platform> platform = hair_platform();
    if (!platform) return;
    const PlatformScope scope(*platform);
    // Drawing needs somewhere to draw to, although nothing is.
    const gl::Framebuffer canvas = gl::Framebuffer::texture({4, 4}, GL_RGBA8, false);
    canvas.bind();
    std::vector<float> points;
    std::vector<Index> offsets = {0};
    for (Index s = 0; s < 57; ++s) {
        for (int k = 0; k < 8; ++k) {
            const float a = 0.01f * static_cast<float>(k), x = std::fmod(0.618034f * s, 1.0f);
            points.insert(points.end(), {0.1f * x + a * x, 1.6f - 5.0f * a * a, a * (1.0f - x)});
        }
        offsets.push_back(offsets.back() + 8);
    }
    const GuideSet set = make_guide_set({points, offsets}, {.count = 5, .points = 8});
    const std::string file = encode_guides(set);
    std::vector<std::uint32_t> memory((file.size() + 3) / 4);
    std::memcpy(memory.data(), file.data(), file.size());
    lissom_hair hair;
    REQUIRE(lissom_hair_open(&hair, memory.data(), file.size()) == LISSOM_HAIR_OK);
    std::vector<float> moved(hair.guides, hair.guides + 3 * set.curves.size());
    for (std::size_t i = 0; i < moved.size(); ++i) moved[i] += 0.003f * static_cast<float>(i % 24);
    std::vector<float> expected(3 * std::size_t{hair.point_count} * hair.strand_count);
    lissom_hair_rebuild(&hair, moved.data(), nullptr, 0, hair.strand_count, expected.data());
    for (const std::string version : {"#version 330 core\n", "#version 300 es\n"}) {
        const bool is_es = version.find("es") != std::string::npos;
        if (is_es && !epoxy_has_gl_extension("GL_ARB_ES3_compatibility")) continue;
        const std::vector<float> made = run_hair_shader(version, hair, moved);
        for (std::size_t i = 0; i < made.size(); ++i) {
            REQUIRE(std::abs(made[i] - expected[i]) < 1e-5f);
        }
    }
}
