#include "textured.h"

#include <epoxy/gl.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace engine {
namespace {

namespace api = lissom::api;

// 48 bytes, as the shader below reads them.
struct Vertex {
    float position[3];
    std::int16_t normal[4];
    float uv[2];
    float tangent[4];
    float unused;
};
static_assert(sizeof(Vertex) == 48);

constexpr int kAround = 48, kAlong = 96;
constexpr double kHeight = 1.6;

constexpr const char* kPlace = R"(#version 330 core
layout(location = 0) in vec3 place;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
layout(location = 3) in vec4 tangent;
uniform mat4 to_clip;
out vec3 n, t, b;
out vec2 at;
void main() {
    n = normal;
    t = tangent.xyz;
    b = tangent.w * cross(normal, tangent.xyz);
    at = uv;
    gl_Position = to_clip * vec4(place, 1.0);
})";

// Bricks: their colour by the texture coordinates, their edges as a normal map in tangent space.
constexpr const char* kColor = R"(#version 330 core
in vec3 n, t, b;
in vec2 at;
out vec4 pixel;
void main() {
    vec2 brick = at * vec2(12.0, 24.0);
    brick.x += 0.5 * mod(floor(brick.y), 2.0);
    vec2 inside = fract(brick) - 0.5;
    vec2 edge = smoothstep(0.38, 0.5, abs(inside)) * sign(inside);
    vec3 normal = normalize(n + 0.9 * edge.x * t + 0.9 * edge.y * b);
    float shade = fract(sin(dot(mod(floor(brick), vec2(12.0, 24.0)), vec2(12.9, 78.2))) * 437.5);
    vec3 color = mix(vec3(0.62, 0.27, 0.18), vec3(0.78, 0.42, 0.28), shade);
    color = mix(color, vec3(0.75, 0.72, 0.66), step(0.44, max(abs(inside.x), abs(inside.y))));
    float light = 0.3 + 0.7 * max(0.0, dot(normal, normalize(vec3(-0.4, 0.5, 0.8))));
    pixel = vec4(color * light, 1.0);
})";

// The first and the last column lie at one place: the seam of the texture.
std::vector<Vertex> tube_vertices() {
    std::vector<Vertex> vertices;
    for (int j = 0; j <= kAlong; ++j) {
        for (int i = 0; i <= kAround; ++i) {
            Vertex vertex{};
            const double angle = 6.283185307179586 * (i % kAround) / kAround;
            vertex.position[0] = static_cast<float>(0.18 * std::cos(angle));
            vertex.position[1] = static_cast<float>(kHeight * j / kAlong);
            vertex.position[2] = static_cast<float>(0.18 * std::sin(angle));
            vertex.uv[0] = static_cast<float>(i) / kAround;
            vertex.uv[1] = static_cast<float>(j) / kAlong;
            vertices.push_back(vertex);
        }
    }
    return vertices;
}

std::vector<std::uint16_t> tube_indices() {
    std::vector<std::uint16_t> indices;
    for (int j = 0; j < kAlong; ++j) {
        for (int i = 0; i < kAround; ++i) {
            const int a = j * (kAround + 1) + i, b = a + kAround + 1;
            for (const int corner : {a, b + 1, a + 1, a, b, b + 1}) {
                indices.push_back(static_cast<std::uint16_t>(corner));
            }
        }
    }
    return indices;
}

void describe(GLuint location, int width, GLenum type, std::size_t offset) {
    glEnableVertexAttribArray(location);
    glVertexAttribPointer(location, width, type, type == GL_SHORT, sizeof(Vertex),
                          reinterpret_cast<const void*>(offset));
}

template <typename Item>
void upload(GLenum target, const std::vector<Item>& items) {
    glBufferData(target, static_cast<GLsizeiptr>(items.size() * sizeof(Item)), items.data(),
                 GL_DYNAMIC_DRAW);
}

lissom_region ring(lissom_context* context, lissom_mesh mesh, double least, double greatest) {
    const double from[] = {-1, least, -1}, to[] = {1, greatest, 1};
    lissom_region region{};
    api::check(context, lissom_region_box(context, mesh, from, to, &region));
    return region;
}

}  // namespace

Textured::Textured(const api::Context& context) : context_(context.get()) {
    const std::vector<Vertex> vertices = tube_vertices();
    const std::vector<std::uint16_t> indices = tube_indices();
    count_ = vertices.size();
    corners_ = static_cast<int>(indices.size());

    lissom_buffer given = lissom_default_buffer();
    given.positions = api::input(vertices[0].position, count_, sizeof(Vertex));
    given.uvs = api::input(vertices[0].uv, count_, sizeof(Vertex));
    given.corners = {indices.data(), indices.size(), 0, LISSOM_UINT16};
    lissom_job making{};
    lissom_job_outcome made = lissom_default_job_outcome();
    api::check(context_, lissom_mesh_begin_create(context_, &given, &making));
    api::check(context_, lissom_job_finish_with(context_, making, &made));
    mesh_ = {made.objects[0]};
    map_ = {made.objects[1]};
    api::check(context_, lissom_deformer_create(context_, mesh_, {0}, nullptr, &deformer_));
    api::check(context_,
               lissom_deformer_pin(context_, deformer_, ring(context_, mesh_, -0.1, 0.1)));
    api::check(context_, lissom_deformer_add_handle(
                             context_, deformer_,
                             ring(context_, mesh_, kHeight - 0.1, kHeight + 0.1), nullptr, &top_));

    program_ = make_program(kPlace, kColor);
    glGenVertexArrays(1, &array_);
    glBindVertexArray(array_);
    glGenBuffers(1, &buffer_);
    glBindBuffer(GL_ARRAY_BUFFER, buffer_);
    upload(GL_ARRAY_BUFFER, vertices);
    describe(0, 3, GL_FLOAT, offsetof(Vertex, position));
    describe(1, 3, GL_SHORT, offsetof(Vertex, normal));
    describe(2, 2, GL_FLOAT, offsetof(Vertex, uv));
    describe(3, 4, GL_FLOAT, offsetof(Vertex, tangent));
    GLuint corners = 0;
    glGenBuffers(1, &corners);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, corners);
    upload(GL_ELEMENT_ARRAY_BUFFER, indices);
    read_frame();
}

Textured::~Textured() {
    if (solving_.id != 0) lissom_job_finish(context_, solving_, nullptr);
    lissom_deformer_release(context_, deformer_);
    lissom_render_map_release(context_, map_);
    lissom_mesh_release(context_, mesh_);
}

void Textured::bend(double angle) {
    if (solving_.id != 0) {
        lissom_job_state state = LISSOM_JOB_RUNNING;
        api::check(context_, lissom_job_poll(context_, solving_, &state));
        if (state != LISSOM_JOB_DONE) return;
        finish();
    }
    begin(angle);
}

void Textured::settle() {
    if (solving_.id != 0) finish();
}

// The upper end goes along an arc of this angle, as long as the tube.
void Textured::begin(double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    const double radius = std::abs(angle) > 1e-6 ? kHeight / angle : 0.0;
    const double x = radius * (1.0 - c), y = radius != 0.0 ? radius * s : kHeight;
    const lissom_transform map{{c, s, 0, x - s * kHeight, -s, c, 0, y - c * kHeight, 0, 0, 1, 0}};
    api::check(context_, lissom_deformer_set_transform(context_, deformer_, top_, &map));
    api::check(context_, lissom_deformer_begin_solve(context_, deformer_, LISSOM_FULL, &solving_));
}

void Textured::finish() {
    const lissom_job job = solving_;
    solving_ = {};
    api::check(context_, lissom_job_finish(context_, job, nullptr));
    api::check(context_, lissom_deformer_apply(context_, deformer_, mesh_));
    read_frame();
    ++frames_;
}

// Into the memory of the card: places, normals and tangents beside texture coordinates that stay.
void Textured::read_frame() const {
    glBindBuffer(GL_ARRAY_BUFFER, buffer_);
    auto* vertices = static_cast<Vertex*>(glMapBuffer(GL_ARRAY_BUFFER, GL_WRITE_ONLY));
    if (!vertices) throw std::runtime_error("the vertex buffer cannot be mapped");
    const lissom_output positions{vertices->position, count_, sizeof(Vertex), LISSOM_FLOAT32};
    const lissom_output normals{vertices->normal, count_, sizeof(Vertex), LISSOM_SNORM16};
    const lissom_output tangents{vertices->tangent, count_, sizeof(Vertex), LISSOM_FLOAT32};
    lissom_status status = lissom_render_map_read_positions(context_, map_, mesh_, &positions);
    if (status == LISSOM_OK)
        status = lissom_render_map_read_normals(context_, map_, mesh_, &normals);
    if (status == LISSOM_OK)
        status = lissom_render_map_read_tangents(context_, map_, mesh_, nullptr, &tangents);
    glUnmapBuffer(GL_ARRAY_BUFFER);
    api::check(context_, status);
}

void Textured::draw(const Matrix& to_clip) const {
    glUseProgram(program_);
    glUniformMatrix4fv(glGetUniformLocation(program_, "to_clip"), 1, GL_FALSE, to_clip.data());
    glBindVertexArray(array_);
    glDrawElements(GL_TRIANGLES, corners_, GL_UNSIGNED_SHORT, nullptr);
}

}  // namespace engine
