#include "viewer/render/gl/gpu_scene.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/hair/strands/strand_measures.h"

namespace lissom {
namespace {

// How far the origin may be from the center, as a multiple of the size: positions are floats about
// it.
constexpr double kOriginReach = 4.0;

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

Floats floats_of(const Vec3& v) {
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
        const bool is_share = field.type == GL_UNSIGNED_BYTE || field.type == GL_INT_2_10_10_10_REV;
        glVertexAttribPointer(field.location, field.parts, field.type, is_share, step, offset);
    }
}

void read_fields(const gl::Buffer& buffer, std::initializer_list<Field> fields,
                 std::size_t stride) {
    glBindBuffer(GL_ARRAY_BUFFER, buffer.id());
    for (const Field& field : fields) read_field(field, stride);
}

// Bytes of the entries at the corners of a surface, a piece for each buffer.
template <typename Entry>
std::vector<std::span<const std::byte>> pieces_of(const std::vector<Entry>& entries) {
    constexpr std::size_t kMost = 3 * kTrianglesOfBuffer;
    std::vector<std::span<const std::byte>> pieces;
    for (std::size_t begin = 0; begin < entries.size(); begin += kMost) {
        const std::size_t count = std::min(kMost, entries.size() - begin);
        pieces.push_back(std::as_bytes(std::span(entries).subspan(begin, count)));
    }
    return pieces;
}

// Makes the data of a snapshot, reusing that of the scene before.
class Upload {
  public:
    Upload(const Vec3& origin, const ValueRange& range, const Context& context,
           std::vector<QuickVertex>* quick, std::span<const PreparedSurface> prepared)
        : origin_(origin), range_(range), context_(context), quick_(quick), prepared_(prepared) {}

    const Uploads& total() const { return total_; }

    // `before` is the same object in the scene before, drawn about the same origin with `known`
    // for a range; may be null.
    std::shared_ptr<const GpuSurface> surface(const DrawnMesh& drawn,
                                              const std::shared_ptr<const GpuSurface>& before,
                                              const ValueRange& known);
    std::shared_ptr<const GpuMarks> marks(const Overlay& overlay);

  private:
    template <typename Entry>
    gl::Buffer buffer(const std::vector<Entry>& entries, std::size_t Uploads::*kind) {
        const std::span<const std::byte> bytes = std::as_bytes(std::span(entries));
        gl::Buffer result = gl::make_vertex_buffer(bytes);
        total_.*kind += bytes.size();
        ++total_.calls;
        return result;
    }
    // Returns entries at the corners of a surface; `sent` if they were sent before.
    template <typename Entry>
    std::shared_ptr<const SurfaceBuffers> buffers(
        const std::vector<Entry>& entries, std::size_t Uploads::*kind,
        const std::shared_ptr<const SurfaceBuffers>& sent = nullptr) {
        const auto pieces = pieces_of(entries);
        for (const auto& bytes : pieces) total_.*kind += bytes.size();
        if (sent) return sent;
        SurfaceBuffers made;
        for (const auto& bytes : pieces) made.push_back(gl::make_vertex_buffer(bytes));
        total_.calls += static_cast<int>(pieces.size());
        return std::make_shared<const SurfaceBuffers>(std::move(made));
    }
    template <typename Entry>
    GpuMarks::Array instances(const std::vector<Entry>& entries,
                              std::initializer_list<Field> fields);
    void fill(GpuSurface& surface, const GpuSurface* before, bool same_range);
    void fill_colors(GpuSurface& surface);
    void fill_quickly(GpuSurface& surface, const GpuSurface& before);
    std::shared_ptr<const GpuMarks> marks_of(const GpuSurface& surface);
    const PreparedSurface* prepared_vertices(const GpuSurface& surface,
                                             const NormalGroups* groups) const;
    const PreparedSurface* prepared_colors(const GpuSurface& surface) const;
    void fill_vertices(GpuSurface& surface, const GpuSurface* before);

    Vec3 origin_;
    ValueRange range_;
    const Context& context_;
    // Quick vertices of a mesh that moved; null if they are made exactly.
    std::vector<QuickVertex>* quick_;
    std::span<const PreparedSurface> prepared_;
    Uploads total_;
};

// Data that a surface shares with the one before it.
struct KeptParts {
    bool vertices = false, colors = false, marks = false;
};

// `a` and `b` have one topology.
KeptParts kept(const GpuSurface& a, const GpuSurface& b, bool same_range) {
    const bool unmoved = a.revision == b.revision;
    return {unmoved && same_vertices(a.drawn, b.drawn),
            same_colors(a.drawn, b.drawn) && (same_range || a.drawn.style.values.empty()),
            unmoved && same_marks(a.drawn, b.drawn)};
}

bool same_faces(const Mesh& a, const Mesh& b) {
    if (a.shared_topology() == b.shared_topology()) return true;
    const FaceList &f = a.topology().faces(), &g = b.topology().faces();
    return a.vertex_count() == b.vertex_count() && f.offsets == g.offsets &&
           f.vertices == g.vertices;
}

// Returns whether two styles agree in the fields that are read while a surface is drawn.
bool same_drawing(const MeshStyle& a, const MeshStyle& b) {
    return a.wire == b.wire && a.wire_width == b.wire_width && a.wire_color == b.wire_color &&
           a.opacity == b.opacity;
}

std::shared_ptr<const GpuSurface> Upload::surface(const DrawnMesh& drawn,
                                                  const std::shared_ptr<const GpuSurface>& before,
                                                  const ValueRange& known) {
    auto result = std::make_shared<GpuSurface>();
    result->drawn = drawn;
    result->revision = drawn.mesh->revision();
    const bool same_topology = before && same_faces(*before->drawn.mesh, *drawn.mesh);
    const bool same_range = known == range_;
    if (same_topology && same_drawing(before->drawn.style, drawn.style)) {
        const KeptParts keep = kept(*before, *result, same_range);
        if (keep.vertices && keep.colors && keep.marks) return before;
    }
    fill(*result, same_topology ? before.get() : nullptr, same_range);
    return result;
}

// Whether vertices that moved can be made fast from those of `before`; may be null.
bool moves_fast(const DrawnMesh& drawn, const GpuSurface* before) {
    return before && before->drawn.style.shading == drawn.style.shading &&
           before->drawn.style.crease == drawn.style.crease &&
           before->triangles.mirrored == (drawn.transform.linear.determinant() < 0.0);
}

// Returns the vertices prepared for it, quick ones with `groups`; null if there are none.
const PreparedSurface* Upload::prepared_vertices(const GpuSurface& surface,
                                                 const NormalGroups* groups) const {
    for (const PreparedSurface& one : prepared_) {
        const bool fits = one.needs.vertices && one.needs.groups.get() == groups &&
                          one.needs.origin == origin_ && one.revision == surface.revision;
        if (fits && same_vertices(one.needs.drawn, surface.drawn)) return &one;
    }
    return nullptr;
}

const PreparedSurface* Upload::prepared_colors(const GpuSurface& surface) const {
    for (const PreparedSurface& one : prepared_) {
        const bool fits = one.needs.colors && one.needs.drawn.mesh == surface.drawn.mesh &&
                          one.revision == surface.revision && one.needs.range == range_;
        if (fits && same_colors(one.needs.drawn, surface.drawn) &&
            one.triangles.same_as(surface.triangles)) {
            return &one;
        }
    }
    return nullptr;
}

void Upload::fill_colors(GpuSurface& surface) {
    if (const PreparedSurface* ready = prepared_colors(surface)) {
        surface.colors = buffers(ready->colors, &Uploads::colors, ready->sent_colors);
        return;
    }
    const auto colors = surface_colors(*surface.drawn.mesh, surface.drawn.style, range_,
                                       surface.triangles, context_);
    surface.colors = buffers(colors, &Uploads::colors);
}

// Updates a mesh that moved; `before` has its faces with their groups.
void Upload::fill_quickly(GpuSurface& surface, const GpuSurface& before) {
    surface.triangles = before.triangles;
    surface.groups = before.groups;
    surface.is_quick = true;
    if (const PreparedSurface* ready = prepared_vertices(surface, before.groups.get())) {
        surface.vertices = buffers(ready->quick, &Uploads::vertices, ready->sent_vertices);
        return;
    }
    const Affine to_picture = translation(-origin_) * surface.drawn.transform;
    quick_surface_vertices(*surface.drawn.mesh, to_picture, surface.triangles, *surface.groups,
                           *quick_);
    surface.vertices = buffers(*quick_, &Uploads::vertices);
}

// Updates a mesh that moved; `before` is the one with the same faces; may be null.
void Upload::fill_vertices(GpuSurface& surface, const GpuSurface* before) {
    const auto& [mesh, style, transform, object, regions] = surface.drawn;
    const Affine to_picture = translation(-origin_) * transform;
    const bool keeps = quick_ && moves_fast(surface.drawn, before);
    if (keeps && before->groups) return fill_quickly(surface, *before);
    if (const PreparedSurface* ready = prepared_vertices(surface, nullptr)) {
        surface.triangles = ready->triangles;
        surface.groups = ready->groups;
        surface.vertices = buffers(ready->vertices, &Uploads::vertices, ready->sent_vertices);
        return;
    }
    const std::vector<Vec3> positions = picture_positions(*mesh, to_picture);
    surface.triangles = keeps ? before->triangles
                              : surface_triangles(*mesh, positions, to_picture,
                                                  before ? &before->triangles : nullptr);
    const auto vertices = surface_vertices(*mesh, style, positions, surface.triangles, context_);
    surface.vertices = buffers(vertices, &Uploads::vertices);
    if (!keeps) return;
    surface.groups = std::make_shared<const NormalGroups>(
        normal_groups(surface.triangles, vertices, style.shading));
}

void read_vertices(const GpuSurface& surface, const gl::Buffer& buffer) {
    if (surface.is_quick) {
        return read_fields(buffer,
                           {{0, 3, GL_FLOAT, offsetof(QuickVertex, position)},
                            {1, 4, GL_INT_2_10_10_10_REV, offsetof(QuickVertex, normal)}},
                           sizeof(QuickVertex));
    }
    read_fields(buffer,
                {{0, 3, GL_FLOAT, offsetof(SurfaceVertex, position)},
                 {1, 3, GL_FLOAT, offsetof(SurfaceVertex, normal)}},
                sizeof(SurfaceVertex));
}

void Upload::fill(GpuSurface& surface, const GpuSurface* before, bool same_range) {
    const auto& [mesh, style, transform, object, regions] = surface.drawn;
    const MemoryCharge charge = context_.charge(
        3 * (sizeof(SurfaceVertex) + sizeof(SurfaceColor)) * mesh->topology().corner_count(),
        "the geometry of the picture");
    const KeptParts keep = before ? kept(*before, surface, same_range) : KeptParts{};
    if (keep.vertices) {
        surface.triangles = before->triangles;
        surface.vertices = before->vertices;
        surface.is_quick = before->is_quick;
        surface.groups = before->groups;
    } else {
        fill_vertices(surface, before);
    }
    const bool keep_colors = keep.colors && surface.triangles.same_as(before->triangles);
    if (keep_colors) {
        surface.colors = before->colors;
    } else {
        fill_colors(surface);
    }
    surface.marks = keep.marks ? before->marks : marks_of(surface);
    for (std::size_t i = 0; i < surface.vertices->size(); ++i) {
        surface.layouts.push_back(gl::make_vertex_array());
        glBindVertexArray(surface.layouts.back().id());
        read_vertices(surface, surface.vertices->at(i));
        read_fields(surface.colors->at(i),
                    {{2, 4, GL_UNSIGNED_BYTE, offsetof(SurfaceColor, color)},
                     {3, 1, GL_FLOAT, offsetof(SurfaceColor, value)},
                     {4, 1, GL_UNSIGNED_INT, offsetof(SurfaceColor, flags)}},
                    sizeof(SurfaceColor));
    }
    gl::check_errors("the geometry of the picture");
}

std::shared_ptr<const GpuMarks> Upload::marks_of(const GpuSurface& surface) {
    for (const PreparedSurface& one : prepared_) {
        const bool fits = one.needs.marks && one.revision == surface.revision;
        if (fits && one.needs.drawn.mesh == surface.drawn.mesh &&
            same_marks(one.needs.drawn, surface.drawn)) {
            return marks(one.marks);
        }
    }
    return marks(build_marks(surface.drawn));
}

template <typename Entry>
GpuMarks::Array Upload::instances(const std::vector<Entry>& entries,
                                  std::initializer_list<Field> fields) {
    GpuMarks::Array array;
    if (entries.empty()) return array;
    array.count = static_cast<GLsizei>(entries.size());
    array.layout = gl::make_vertex_array();
    glBindVertexArray(array.layout.id());
    array.buffer = buffer(entries, &Uploads::marks);
    read_fields(array.buffer, fields, sizeof(Entry));
    for (const Field& field : fields) glVertexAttribDivisor(field.location, 1);
    gl::check_errors("the lines and points of the picture");
    return array;
}

void add_segments(const DrawnLine& line, const Vec3& origin, std::vector<LineSegment>& segments) {
    const std::size_t count = line.points.size();
    for (std::size_t i = 0; i + (line.closed ? 0 : 1) < count; ++i) {
        segments.push_back({floats_of(line.points[i] - origin),
                            floats_of(line.points[(i + 1) % count] - origin), to_bytes(line.color),
                            static_cast<float>(line.width)});
    }
}

std::shared_ptr<const GpuMarks> Upload::marks(const Overlay& overlay) {
    std::vector<LineSegment> segments;
    for (const DrawnLine& line : overlay.lines) add_segments(line, origin_, segments);
    std::vector<Ball> balls;
    for (const DrawnPoint& point : overlay.points) {
        balls.push_back({floats_of(point.position - origin_), to_bytes(point.color),
                         static_cast<float>(point.radius)});
    }
    auto result = std::make_shared<GpuMarks>();
    result->on_top = overlay.on_top;
    result->lines = instances(segments, {{0, 3, GL_FLOAT, offsetof(LineSegment, begin)},
                                         {1, 3, GL_FLOAT, offsetof(LineSegment, end)},
                                         {2, 4, GL_UNSIGNED_BYTE, offsetof(LineSegment, color)},
                                         {3, 1, GL_FLOAT, offsetof(LineSegment, width)}});
    result->points = instances(balls, {{0, 3, GL_FLOAT, offsetof(Ball, position)},
                                       {1, 4, GL_UNSIGNED_BYTE, offsetof(Ball, color)},
                                       {2, 1, GL_FLOAT, offsetof(Ball, radius)}});
    return result;
}

// Returns the box around strands, in their metres; that of `before` if it shows the same.
Box strand_box(const Strands* strands, const ScenePlacement& before) {
    const auto known = before.strand_boxes.find(strands);
    return known == before.strand_boxes.end() ? bounds(*strands) : known->second;
}

// The corners of boxes around the strands: they hold all of their points that are finite.
void add_strands(const std::vector<DrawnStrands>& strands, const ScenePlacement& before,
                 ScenePlacement& result) {
    for (const DrawnStrands& drawn : strands) {
        const Box box = strand_box(drawn.strands.get(), before);
        result.strand_boxes.emplace(drawn.strands.get(), box);
        for (int i = 0; !box.empty() && i < 8; ++i) {
            const Vec3 corner(i & 1 ? box.max.x() : box.min.x(), i & 2 ? box.max.y() : box.min.y(),
                              i & 4 ? box.max.z() : box.min.z());
            result.strand_corners.push_back(drawn.transform(corner / drawn.style.unit));
        }
    }
}

// `before` is that of the snapshot before, which is still held.
ScenePlacement place(const Snapshot& snapshot, const ScenePlacement& before) {
    ScenePlacement result;
    add_strands(snapshot.strands, before, result);
    const auto for_all = [&](const auto& visit) {
        for_each_point(snapshot, visit);
        for (const Vec3& p : result.strand_corners) visit(p);
    };
    // Sums are relative to the first point, so that no digits are lost if all are far away.
    std::optional<Vec3> first;
    double count = 0.0, square = 0.0;
    Vec3 sum = Vec3::Zero();
    for_all([&](const Vec3& p) {
        if (!first) first = p;
        const Vec3 offset = p - *first;
        sum += offset;
        square += offset.squaredNorm();
        ++count;
    });
    if (count == 0.0) return result;
    require(std::isfinite(square), "a transform, line or point of the drawing is NaN or infinite",
            ErrorCode::not_finite);
    const Vec3 mean = sum / count;
    result.center = *first + mean;
    result.size = std::sqrt(std::max(square / count - mean.squaredNorm(), 0.0));
    return result;
}

// Surfaces of a scene by their objects; each is taken once, in their order.
class Known {
  public:
    explicit Known(const std::vector<std::shared_ptr<const GpuSurface>>& surfaces) {
        for (const auto& surface : surfaces) by_object_.emplace(surface->drawn.object, surface);
    }
    std::shared_ptr<const GpuSurface> take(std::uint64_t object) {
        const auto found = by_object_.lower_bound(object);
        if (found == by_object_.end() || found->first != object) return nullptr;
        const auto result = found->second;
        by_object_.erase(found);
        return result;
    }

  private:
    std::multimap<std::uint64_t, std::shared_ptr<const GpuSurface>> by_object_;
};

}  // namespace

void GpuMarks::Array::draw() const {
    if (count == 0) return;
    glBindVertexArray(layout.id());
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count);
}

void GpuSurface::draw() const {
    const std::size_t all = triangles.faces->triangles.size();
    for (std::size_t i = 0; i < layouts.size(); ++i) {
        const std::size_t count = std::min(kTrianglesOfBuffer, all - i * kTrianglesOfBuffer);
        glBindVertexArray(layouts[i].id());
        glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(3 * count));
    }
}

PreparedSurface prepare(SurfaceNeeds needs, const Context& context) {
    const auto& [mesh, style, transform, object, regions] = needs.drawn;
    const Affine to_picture = translation(-needs.origin) * transform;
    const SurfaceTriangles* known = needs.known.faces ? &needs.known : nullptr;
    PreparedSurface result;
    result.revision = mesh->revision();
    const std::vector<Vec3> positions = picture_positions(*mesh, to_picture);
    // Surfaces already on the card stay unchanged.
    result.triangles = known && (!needs.vertices || needs.groups)
                           ? *known
                           : surface_triangles(*mesh, positions, to_picture, known);
    if (needs.groups) {
        result.groups = needs.groups;
        quick_surface_vertices(*mesh, to_picture, *known, *needs.groups, result.quick);
    } else if (needs.vertices) {
        result.vertices = surface_vertices(*mesh, style, positions, result.triangles, context);
        result.groups = std::make_shared<const NormalGroups>(
            normal_groups(result.triangles, result.vertices, style.shading));
    }
    if (needs.colors) {
        result.colors = surface_colors(*mesh, style, needs.range, result.triangles, context);
    }
    if (needs.marks) result.marks = build_marks(needs.drawn);
    result.needs = std::move(needs);
    return result;
}

PieceSender::PieceSender(std::vector<PreparedSurface> surfaces) : surfaces_(std::move(surfaces)) {
    for (std::size_t i = 0; i < surfaces_.size(); ++i) {
        const PreparedSurface& one = surfaces_[i];
        const auto add = [&](const auto& entries,
                             std::shared_ptr<const SurfaceBuffers> PreparedSurface::*to) {
            if (!entries.empty()) parts_.push_back({pieces_of(entries), to, i});
        };
        add(one.vertices, &PreparedSurface::sent_vertices);
        add(one.quick, &PreparedSurface::sent_vertices);
        add(one.colors, &PreparedSurface::sent_colors);
    }
}

bool PieceSender::send() {
    if (part_ == parts_.size()) return false;
    const Part& part = parts_[part_];
    made_.push_back(gl::make_vertex_buffer(part.pieces[made_.size()]));
    gl::check_errors("the geometry of the picture");
    if (made_.size() < part.pieces.size()) return true;
    surfaces_[part.surface].*part.to =
        std::make_shared<const SurfaceBuffers>(std::exchange(made_, {}));
    ++part_;
    return true;
}

std::vector<PreparedSurface> PieceSender::give_away() {
    parts_.clear();
    part_ = 0;
    for (PreparedSurface& one : surfaces_) one.sent_vertices = one.sent_colors = nullptr;
    return std::exchange(surfaces_, {});
}

bool GpuScene::keeps_origin(const ScenePlacement& placement) const {
    const bool anything = !shown_.surfaces.empty() || !shown_.overlays.empty();
    const double apart = (placement.center - shown_.origin).norm();
    return anything && apart <= kOriginReach * placement.size;
}

Vec3 GpuScene::next_origin(const ScenePlacement& placement) const {
    return keeps_origin(placement) ? shown_.origin : placement.center;
}

std::vector<SurfaceNeeds> GpuScene::needs(const Snapshot& snapshot) const {
    const ScenePlacement placement = place(snapshot, shown_.placement);
    const Vec3 origin = next_origin(placement);
    Known known(keeps_origin(placement) ? shown_.surfaces : decltype(shown_.surfaces){});
    std::vector<SurfaceNeeds> result;
    for (const DrawnMesh& drawn : snapshot.meshes) {
        const auto found = known.take(drawn.object);
        const bool same = found && same_faces(*found->drawn.mesh, *drawn.mesh);
        const GpuSurface* const before = same ? found.get() : nullptr;
        GpuSurface next;
        next.drawn = drawn;
        next.revision = drawn.mesh->revision();
        const KeptParts keep =
            before ? kept(*before, next, shown_.snapshot.range == snapshot.range) : KeptParts{};
        SurfaceNeeds needed{drawn, !keep.vertices, !keep.colors, !keep.marks};
        needed.origin = origin;
        needed.range = snapshot.range;
        if (before) needed.known = before->triangles;
        if (needed.vertices && before && moves_fast(drawn, before)) needed.groups = before->groups;
        const bool needs_anything = needed.vertices || needed.colors || needed.marks;
        if (needs_anything) result.push_back(std::move(needed));
    }
    return result;
}

Uploads GpuScene::update_with(std::span<const PreparedSurface> prepared, const Snapshot& snapshot,
                              const Context& context, MovedVertices moved) {
    if (snapshot.revision != 0 && snapshot.revision == shown_.snapshot.revision) return {};
    Shown next{snapshot, place(snapshot, shown_.placement), {}, {}, {}};
    const bool same_origin = keeps_origin(next.placement);
    next.origin = next_origin(next.placement);

    Upload upload(next.origin, snapshot.range, context,
                  moved == MovedVertices::quick ? &scratch_ : nullptr, prepared);
    Known known(same_origin ? shown_.surfaces : decltype(shown_.surfaces){});
    for (const DrawnMesh& drawn : snapshot.meshes) {
        next.surfaces.push_back(
            upload.surface(drawn, known.take(drawn.object), shown_.snapshot.range));
    }
    std::map<const Overlay*, std::shared_ptr<const GpuMarks>> marks;
    for (std::size_t i = 0; same_origin && i < shown_.overlays.size(); ++i) {
        marks.emplace(shown_.snapshot.overlays[i].get(), shown_.overlays[i]);
    }
    for (const auto& overlay : snapshot.overlays) {
        auto& known_marks = marks[overlay.get()];
        if (!known_marks) known_marks = upload.marks(*overlay);
        next.overlays.push_back(known_marks);
    }
    shown_ = std::move(next);
    return upload.total();
}

void GpuScene::draw_surfaces() const {
    for (const auto& surface : shown_.surfaces) surface->draw();
}

void GpuScene::draw_lines(bool on_top) const {
    for (const auto& marks : shown_.overlays) {
        if (marks->on_top == on_top) marks->lines.draw();
    }
    for (const auto& surface : shown_.surfaces) {
        if (!on_top) surface->marks->lines.draw();
    }
}

void GpuScene::draw_points(bool on_top) const {
    for (const auto& marks : shown_.overlays) {
        if (marks->on_top == on_top) marks->points.draw();
    }
    for (const auto& surface : shown_.surfaces) {
        if (!on_top) surface->marks->points.draw();
    }
}

}  // namespace lissom
