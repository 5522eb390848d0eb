#include "viewer/gl/gpu_drawing.h"

#include <cstddef>

namespace lissom {
namespace {

using Floats = std::array<float, 3>;
using Bytes = std::array<std::uint8_t, 4>;

struct LineSegment {
    Floats begin, end;
    Bytes color;
    float width;
};

struct Ball {
    Floats position;
    Bytes color;
    float radius;
};

Floats to_floats(const Vec3& v) {
    return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

// One attribute of a vertex buffer's entries.
struct Field {
    GLuint location;
    GLint parts;
    GLenum type;
    std::size_t offset;
};

void read_field(const Field& field, std::size_t stride) {
    const void* const offset = reinterpret_cast<const void*>(field.offset);
    const GLsizei step = static_cast<GLsizei>(stride);
    glEnableVertexAttribArray(field.location);
    if (field.type == GL_UNSIGNED_INT) {
        glVertexAttribIPointer(field.location, field.parts, field.type, step, offset);
    } else {
        glVertexAttribPointer(field.location, field.parts, field.type,
                              field.type == GL_UNSIGNED_BYTE, step, offset);
    }
}

// `instanced`: an entry is read once for all vertices of an instance.
template <typename Entry>
GpuArray upload_array(const std::vector<Entry>& entries, std::initializer_list<Field> fields,
                      bool instanced) {
    GpuArray array;
    array.count = static_cast<GLsizei>(entries.size());
    array.layout = gl::make_vertex_array();
    glBindVertexArray(array.layout.id());
    array.buffer = gl::make_vertex_buffer(std::as_bytes(std::span(entries)));
    for (const Field& field : fields) {
        read_field(field, sizeof(Entry));
        if (instanced) glVertexAttribDivisor(field.location, 1);
    }
    gl::check_errors("the geometry of the picture");
    return array;
}

GpuSurface upload_surface(const DrawnMesh& drawn, const Affine& to_picture, const ValueRange& range,
                          const Context& context) {
    const MemoryCharge charge =
        context.charge(3 * sizeof(SurfaceVertex) * drawn.mesh->topology().corner_count(),
                       "the geometry of the picture");
    const std::vector<SurfaceVertex> vertices =
        build_surface(*drawn.mesh, drawn.style, to_picture, range, context);
    GpuSurface surface;
    surface.triangles = upload_array(vertices,
                                     {{0, 3, GL_FLOAT, offsetof(SurfaceVertex, position)},
                                      {1, 3, GL_FLOAT, offsetof(SurfaceVertex, normal)},
                                      {2, 4, GL_UNSIGNED_BYTE, offsetof(SurfaceVertex, color)},
                                      {3, 1, GL_FLOAT, offsetof(SurfaceVertex, value)},
                                      {4, 1, GL_UNSIGNED_INT, offsetof(SurfaceVertex, flags)}},
                                     false);
    surface.wire_width = drawn.style.wire ? drawn.style.wire_width : 0.0;
    surface.wire_color = drawn.style.wire_color;
    return surface;
}

void add_segments(const DrawnLine& line, const Vec3& origin, std::vector<LineSegment>& segments) {
    const std::size_t count = line.points.size();
    for (std::size_t i = 0; i + (line.closed ? 0 : 1) < count; ++i) {
        segments.push_back({to_floats(line.points[i] - origin),
                            to_floats(line.points[(i + 1) % count] - origin), to_bytes(line.color),
                            static_cast<float>(line.width)});
    }
}

GpuArray upload_lines(const std::vector<DrawnLine>& lines, const Vec3& origin) {
    std::vector<LineSegment> segments;
    for (const DrawnLine& line : lines) add_segments(line, origin, segments);
    return upload_array(segments,
                        {{0, 3, GL_FLOAT, offsetof(LineSegment, begin)},
                         {1, 3, GL_FLOAT, offsetof(LineSegment, end)},
                         {2, 4, GL_UNSIGNED_BYTE, offsetof(LineSegment, color)},
                         {3, 1, GL_FLOAT, offsetof(LineSegment, width)}},
                        true);
}

GpuArray upload_points(const std::vector<DrawnPoint>& points, const Vec3& origin) {
    std::vector<Ball> balls;
    balls.reserve(points.size());
    for (const DrawnPoint& point : points) {
        balls.push_back({to_floats(point.position - origin), to_bytes(point.color),
                         static_cast<float>(point.radius)});
    }
    return upload_array(balls,
                        {{0, 3, GL_FLOAT, offsetof(Ball, position)},
                         {1, 4, GL_UNSIGNED_BYTE, offsetof(Ball, color)},
                         {2, 1, GL_FLOAT, offsetof(Ball, radius)}},
                        true);
}

void draw_strips(const GpuArray& array) {
    if (array.count == 0) return;
    glBindVertexArray(array.layout.id());
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, array.count);
}

}  // namespace

void GpuSurface::draw() const {
    glBindVertexArray(triangles.layout.id());
    glDrawArrays(GL_TRIANGLES, 0, triangles.count);
}

void GpuDrawing::draw_lines() const {
    draw_strips(lines);
}
void GpuDrawing::draw_points() const {
    draw_strips(points);
}

GpuDrawing upload(const Drawing& drawing, const Vec3& origin, const Context& context) {
    GpuDrawing result;
    std::vector<DrawnLine> lines = drawing.lines;
    std::vector<DrawnPoint> points = drawing.points;
    for (const DrawnMesh& drawn : drawing.meshes) {
        result.surfaces.push_back(
            upload_surface(drawn, translation(-origin) * drawn.transform, drawing.range, context));
        SurfaceMarks marks = build_marks(drawn);
        lines.insert(lines.end(), marks.lines.begin(), marks.lines.end());
        points.insert(points.end(), marks.points.begin(), marks.points.end());
    }
    result.lines = upload_lines(lines, origin);
    result.points = upload_points(points, origin);
    return result;
}

GpuHairShade upload_shade(const StrandShadow* shadow) {
    GpuHairShade shade;
    if (!shadow) {
        const std::array<std::uint8_t, 4> no_hair{255, 255, 0, 255};
        shade.volume = gl::make_volume({1, 1, 1}, no_hair);
        return shade;
    }
    const ViewGrid& grid = shadow->grid();
    shade.volume = gl::make_volume(grid.counts, shadow->on_meshes());
    shade.step = grid.step;
    for (int axis = 0; axis < 3; ++axis) {
        const Index count = grid.counts[static_cast<std::size_t>(axis)];
        shade.scale[axis] = 1.0 / (count * shade.step);
        shade.offset[axis] = 0.5 / count - grid.origin[axis] * shade.scale[axis];
    }
    shade.scalp_color = shadow->scalp_color().cast<double>();
    return shade;
}

}  // namespace lissom
