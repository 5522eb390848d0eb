#include "drawing.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstddef>
#include <stdexcept>

namespace engine {
namespace {

constexpr const char* kSurfaceColor = R"(#version 330 core
in vec3 surface_position;
uniform vec3 color;
out vec4 pixel;
void main() {
    vec3 normal = normalize(cross(dFdx(surface_position), dFdy(surface_position)));
    float light = 0.35 + 0.65 * abs(dot(normal, normalize(vec3(0.4, 0.6, 0.7))));
    pixel = vec4(color * light, 1.0);
})";

constexpr const char* kStrandPlace = R"(#version 330 core
layout(location = 0) in vec3 place;
layout(location = 1) in vec3 tangent;
uniform mat4 to_clip;
out vec3 along;
void main() {
    along = tangent;
    gl_Position = to_clip * vec4(place, 1.0);
})";

// Light on a thin cylinder (Kajiya and Kay).
constexpr const char* kStrandColor = R"(#version 330 core
in vec3 along;
uniform vec3 color;
out vec4 pixel;
void main() {
    float c = dot(normalize(along), normalize(vec3(0.4, 0.6, 0.7)));
    float s = sqrt(max(0.0, 1.0 - c * c));
    pixel = vec4(color * (0.3 + 0.6 * s) + 0.25 * pow(s, 40.0), 1.0);
})";

GLuint compile(GLenum kind, const std::string& text) {
    const GLuint shader = glCreateShader(kind);
    const char* const source = text.c_str();
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    GLint good = GL_FALSE;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
    if (good) return shader;
    char log[1000] = {};
    glGetShaderInfoLog(shader, sizeof log, nullptr, log);
    throw std::runtime_error(log);
}

}  // namespace

unsigned make_program(const std::string& vertex, const std::string& fragment) {
    const GLuint program = glCreateProgram();
    glAttachShader(program, compile(GL_VERTEX_SHADER, vertex));
    glAttachShader(program, compile(GL_FRAGMENT_SHADER, fragment));
    glLinkProgram(program);
    return program;
}

namespace {

// A buffer of the vertex array that is bound: `width` floats a vertex.
void add_attribute(GLuint location, int width, const std::vector<float>& values) {
    GLuint buffer = 0;
    glGenBuffers(1, &buffer);
    glBindBuffer(GL_ARRAY_BUFFER, buffer);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(values.size() * sizeof(float)),
                 values.data(), GL_STATIC_DRAW);
    glEnableVertexAttribArray(location);
    glVertexAttribPointer(location, width, GL_FLOAT, GL_FALSE, 0, nullptr);
}

GLuint make_array() {
    GLuint array = 0;
    glGenVertexArrays(1, &array);
    glBindVertexArray(array);
    return array;
}

// The weights of a basis as a texture: 16 bytes a texel, row after row.
GLuint upload_weights(const lissom_basis& basis) {
    const GLsizei width = 1024;
    const std::size_t texels = std::size_t{basis.vertex_count} * basis.handle_count;
    const auto height = static_cast<GLsizei>((texels + width - 1) / width);
    std::vector<float> padded(std::size_t{4} * width * static_cast<std::size_t>(height));
    std::copy(basis.weights, basis.weights + 4 * texels, padded.begin());
    GLuint texture = 0;
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, width, height, 0, GL_RGBA, GL_FLOAT, padded.data());
    return texture;
}

void set_common(GLuint program, const Matrix& to_clip, const Color& color) {
    glUseProgram(program);
    glUniformMatrix4fv(glGetUniformLocation(program, "to_clip"), 1, GL_FALSE, to_clip.data());
    glUniform3fv(glGetUniformLocation(program, "color"), 1, color.data());
}

// From each point to the next one of its strand, from the last as before it.
std::vector<float> tangents_of(const std::vector<float>& points,
                               const std::vector<std::uint32_t>& offsets) {
    std::vector<float> tangents(points.size());
    for (std::size_t s = 0; s + 1 < offsets.size(); ++s) {
        for (std::size_t i = offsets[s]; i < offsets[s + 1]; ++i) {
            const std::size_t from =
                i + 1 < offsets[s + 1] ? i : std::max<std::size_t>(i, offsets[s] + 1) - 1;
            for (std::size_t k = 0; k < 3; ++k)
                tangents[3 * i + k] = points[3 * (from + 1) + k] - points[3 * from + k];
        }
    }
    return tangents;
}

}  // namespace

Surface::Surface(const lissom::api::Mesh& mesh, const std::string& vertex_shader,
                 const lissom_basis* basis)
    : program_(make_program("#version 330 core\n" + vertex_shader, kSurfaceColor)),
      array_(make_array()) {
    const auto vertices = static_cast<std::size_t>(mesh.vertex_count());
    std::vector<float> places(3 * vertices), rows(vertices, -1.0f);
    mesh.read_positions(lissom::api::output(places.data(), vertices));
    if (basis) {
        weights_ = upload_weights(*basis);
        row_count_ = static_cast<int>(basis->vertex_count);
        handle_count_ = static_cast<int>(basis->handle_count);
        for (std::size_t i = 0; i < places.size(); ++i)
            places[i] -= static_cast<float>(basis->origin[i % 3]);
        for (std::uint32_t row = 0; row < basis->vertex_count; ++row) {
            rows[basis->vertices[row]] = static_cast<float>(row);
            std::copy_n(basis->rest + 3 * std::size_t{row}, 3,
                        &places[3 * std::size_t{basis->vertices[row]}]);
        }
    }
    add_attribute(0, 3, places);
    add_attribute(1, 1, rows);
    std::vector<std::uint32_t> corners(3 * static_cast<std::size_t>(mesh.triangle_count()));
    mesh.read_triangles(lissom::api::output(corners.data(), corners.size() / 3));
    GLuint buffer = 0;
    glGenBuffers(1, &buffer);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(4 * corners.size()),
                 corners.data(), GL_STATIC_DRAW);
    corner_count_ = static_cast<int>(corners.size());
}

void Surface::draw(const Matrix& to_clip, const Color& color, const float* transforms) const {
    set_common(program_, to_clip, color);
    glUniform1i(glGetUniformLocation(program_, "vertex_count"), row_count_);
    glUniform1i(glGetUniformLocation(program_, "handle_count"), handle_count_);
    if (transforms)
        glUniform4fv(glGetUniformLocation(program_, "transforms"), 3 * handle_count_, transforms);
    glBindTexture(GL_TEXTURE_2D, weights_);
    glBindVertexArray(array_);
    glDrawElements(GL_TRIANGLES, corner_count_, GL_UNSIGNED_INT, nullptr);
}

Hair::Hair(const lissom::api::Strands& strands)
    : program_(make_program(kStrandPlace, kStrandColor)), array_(make_array()) {
    std::vector<float> points(3 * static_cast<std::size_t>(strands.point_count()));
    std::vector<std::uint32_t> offsets(static_cast<std::size_t>(strands.size()) + 1);
    strands.read_points(lissom::api::output(points.data(), points.size() / 3));
    strands.read_offsets(lissom::api::output(offsets.data(), offsets.size()));
    add_attribute(0, 3, points);
    add_attribute(1, 3, tangents_of(points, offsets));
    for (std::size_t s = 0; s + 1 < offsets.size(); ++s) {
        firsts_.push_back(static_cast<int>(offsets[s]));
        counts_.push_back(static_cast<int>(offsets[s + 1] - offsets[s]));
    }
}

void Hair::draw(const Matrix& to_clip, const Color& color) const {
    set_common(program_, to_clip, color);
    glBindVertexArray(array_);
    glMultiDrawArrays(GL_LINE_STRIP, firsts_.data(), counts_.data(),
                      static_cast<GLsizei>(counts_.size()));
}

void clear_picture() {
    glViewport(0, 0, 1280, 720);
    glEnable(GL_DEPTH_TEST);
    glClearColor(0.62f, 0.65f, 0.7f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

}  // namespace engine
