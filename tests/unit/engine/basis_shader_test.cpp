// The example shader moves vertices to where the kernel puts them.
#include <fstream>
#include <iterator>
#include <memory>

#include "tests/unit/engine/basis_scene.h"
#include "viewer/render/gl/gl_objects.h"
#include "viewer/render/gl/platform.h"

using namespace lissom;
using namespace lissom::test;

namespace {

constexpr double kShaderTolerance = 1e-6;
// Narrower than the weights of any scene here, so that they take several rows.
constexpr GLsizei kTextureWidth = 256;

// A context, or null where this machine has none: the test then says so and returns.
std::unique_ptr<Platform> make_platform() {
    try {
        return make_egl_platform();
    } catch (const Error& error) {
        if (error.code() != ErrorCode::no_display) throw;
        skip("LISSOM_REQUIRE_GL", error.message());
        return nullptr;
    }
}

std::string example_source() {
    std::ifstream file(LISSOM_BASIS_SHADER, std::ios::binary);
    REQUIRE(file);
    return {std::istreambuf_iterator<char>(file), {}};
}

void destroy_shader(GLuint id) {
    glDeleteShader(id);
}
using Shader = gl::Name<destroy_shader>;

Shader compiled(GLenum kind, const std::string& source) {
    Shader shader(glCreateShader(kind));
    const char* text = source.c_str();
    glShaderSource(shader.id(), 1, &text, nullptr);
    glCompileShader(shader.id());
    GLint done = 0;
    glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &done);
    char log[1000] = {};
    glGetShaderInfoLog(shader.id(), sizeof log, nullptr, log);
    REQUIRE_MESSAGE(done, log);
    return shader;
}

using ProgramName = gl::Name<gl::destroy_program>;

// The example with `version` before it; gives back `surface_position`.
ProgramName linked(const std::string& version) {
    ProgramName program(glCreateProgram());
    const Shader vertex = compiled(GL_VERTEX_SHADER, version + example_source());
    const Shader fragment =
        compiled(GL_FRAGMENT_SHADER, version +
                                         "precision highp float;\nin vec3 surface_position;\n"
                                         "out vec4 color;\n"
                                         "void main() { color = vec4(surface_position, 1.0); }\n");
    glAttachShader(program.id(), vertex.id());
    glAttachShader(program.id(), fragment.id());
    const char* varying = "surface_position";
    glTransformFeedbackVaryings(program.id(), 1, &varying, GL_INTERLEAVED_ATTRIBS);
    glLinkProgram(program.id());
    GLint done = 0;
    glGetProgramiv(program.id(), GL_LINK_STATUS, &done);
    REQUIRE(done);
    return program;
}

// The basis's weights as they stand in the file.
gl::Texture weights_texture(const lissom_basis& basis) {
    const auto texels = static_cast<GLsizei>(basis.handle_count * basis.vertex_count);
    const GLsizei rows = texels / kTextureWidth, rest = texels % kTextureWidth;
    GLuint id = 0;
    glGenTextures(1, &id);
    glBindTexture(GL_TEXTURE_2D, id);
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER}) {
        glTexParameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
    }
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, kTextureWidth, rows + 1, 0, GL_RGBA, GL_FLOAT,
                 nullptr);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, kTextureWidth, rows, GL_RGBA, GL_FLOAT, basis.weights);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, rows, rest, 1, GL_RGBA, GL_FLOAT,
                    basis.weights + 4 * std::size_t(rows) * kTextureWidth);
    return gl::Texture(id);
}

template <typename T>
gl::Buffer attribute(GLuint location, GLint width, const std::vector<T>& values) {
    gl::Buffer buffer = gl::make_vertex_buffer(std::as_bytes(std::span(values)));
    glVertexAttribPointer(location, width, GL_FLOAT, GL_FALSE, 0, nullptr);
    glEnableVertexAttribArray(location);
    return buffer;
}

void set_uniforms(const ProgramName& program, const lissom_basis& basis,
                  const std::vector<float>& transforms) {
    const auto place = [&](const char* name) { return glGetUniformLocation(program.id(), name); };
    constexpr float kIdentity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    glUniform1i(place("weights"), 0);
    glUniform1i(place("vertex_count"), static_cast<GLint>(basis.vertex_count));
    glUniform1i(place("handle_count"), static_cast<GLint>(basis.handle_count));
    glUniform4fv(place("transforms"), static_cast<GLsizei>(transforms.size() / 4),
                 transforms.data());
    glUniformMatrix4fv(place("to_clip"), 1, GL_FALSE, kIdentity);
}

// Positions of the rows, and then of the vertices at rest whose row is -1.
std::vector<float> run_shader(const std::string& version, const lissom_basis& basis,
                              const std::vector<float>& transforms) {
    const std::size_t n = basis.vertex_count;
    std::vector<float> rest(basis.rest, basis.rest + 3 * n), rows(2 * n, -1.0f);
    rest.insert(rest.end(), basis.rest, basis.rest + 3 * n);
    for (std::size_t i = 0; i < n; ++i) rows[i] = static_cast<float>(i);

    const ProgramName program = linked(version);
    const gl::VertexArray array = gl::make_vertex_array();
    glBindVertexArray(array.id());
    const gl::Buffer rest_buffer = attribute(0, 3, rest), row_buffer = attribute(1, 1, rows);
    const gl::Texture weights = weights_texture(basis);
    glUseProgram(program.id());
    set_uniforms(program, basis, transforms);

    GLuint id = 0;
    glGenBuffers(1, &id);
    const gl::Buffer result(id);
    const auto bytes = static_cast<GLsizeiptr>(rest.size() * sizeof(float));
    glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, id);
    glBufferData(GL_TRANSFORM_FEEDBACK_BUFFER, bytes, nullptr, GL_STATIC_READ);
    glEnable(GL_RASTERIZER_DISCARD);
    glBeginTransformFeedback(GL_POINTS);
    glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(2 * n));
    glEndTransformFeedback();
    std::vector<float> out(rest.size());
    glGetBufferSubData(GL_TRANSFORM_FEEDBACK_BUFFER, 0, bytes, out.data());
    gl::check_errors("running the example shader");
    return out;
}

}  // namespace

TEST_CASE("the example shader gives the kernel's preview, as GLSL 3.30 and GLSL ES 3.00") {
    const std::unique_ptr<Platform> platform = make_platform();
    if (!platform) return;
    const PlatformScope scope(*platform);
    // Drawing needs somewhere to draw to, although nothing is.
    const gl::Framebuffer canvas = gl::Framebuffer::texture({4, 4}, GL_RGBA8, false);
    canvas.bind();
    for (const int handles : {1, 2, 6}) {
        BasisScene scene = make_basis_scene(make_cactus({.vertices = 2000}), handles, true);
        const std::string bytes = encode_basis(make_engine_basis(scene.deformer));
        lissom_basis basis;
        REQUIRE(lissom_basis_open(&basis, bytes.data(), bytes.size()) == LISSOM_BASIS_OK);
        const std::vector<float> transforms = local_rows(basis, scene.transforms);
        const std::vector<Vec3> wanted = scene.deformer.solve(FrameQuality::preview);
        for (const std::string version : {"#version 330 core\n", "#version 300 es\n"}) {
            const bool is_es = version.find("es") != std::string::npos;
            if (is_es && !epoxy_has_gl_extension("GL_ARB_ES3_compatibility")) continue;
            CAPTURE(version);
            CAPTURE(handles);
            const std::vector<float> out = run_shader(version, basis, transforms);
            CHECK(max_distance(out, basis.origin, wanted) < kShaderTolerance * scene.size);
            const std::size_t half = out.size() / 2;
            CHECK(
                std::equal(out.begin() + static_cast<std::ptrdiff_t>(half), out.end(), basis.rest));
        }
    }
}
