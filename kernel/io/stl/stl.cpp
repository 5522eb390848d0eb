#include "kernel/io/stl/stl.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "kernel/io/record/float_loss.h"
#include "kernel/io/record/label_reader.h"
#include "kernel/io/stream/byte_reader.h"
#include "kernel/io/stream/text_reader.h"
#include "kernel/io/stream/text_writer.h"
#include "kernel/io/stream/ticker.h"
#include "kernel/mesh/measure/triangulation.h"

namespace lissom {
namespace {

constexpr std::size_t kStlHeaderBytes = 80;
constexpr std::size_t kTriangleBytes = 50;

using Corners = std::array<Vec3, 3>;

// Collects triangles that share no vertices, as they are in the file.
class TriangleList {
  public:
    TriangleList() { mesh_.faces_are_separate = true; }

    void reserve(std::size_t count) {
        mesh_.positions.reserve(3 * count);
        mesh_.faces.vertices.reserve(3 * count);
        mesh_.faces.offsets.reserve(count + 1);
    }
    void add(const Corners& corners) {
        constexpr std::size_t kMaximumCorners = std::numeric_limits<Index>::max();
        if (mesh_.positions.size() > kMaximumCorners - 3) {
            refuse(ErrorCode::file_too_large, "the file has more triangles than can be numbered");
        }
        const auto first = count_of(mesh_.positions);
        mesh_.positions.insert(mesh_.positions.end(), corners.begin(), corners.end());
        mesh_.faces.add({first, first + 1, first + 2});
    }

    Index face_count() const { return mesh_.faces.size(); }
    MeshData take() { return std::move(mesh_); }

  private:
    MeshData mesh_;
};

std::string lower_case(std::string_view word) {
    std::string result(word);
    for (char& c : result) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return result;
}

class StlTextReader {
  public:
    StlTextReader(std::string_view bytes, const Context& context)
        : context_(context), text_(bytes, {}) {}

    MeshData read() {
        Progress progress(context_, "read STL");
        Ticker ticker(progress);
        text_.tally.elements = "triangles";
        while (!text_.at_end()) {
            expect("solid");
            objects_.set(text_.rest_of_line(), triangles_.face_count());
            while (!next_is("endsolid")) {
                ticker.tick([&] { return text_.fraction(); });
                read_triangle();
            }
            text_.skip_line();
        }
        const Index face_count = triangles_.face_count();
        MeshData mesh = triangles_.take();
        objects_.finish(mesh.attributes, "object", face_count);
        return mesh;
    }

  private:
    // facet normal x y z / outer loop / vertex x y z (three times) / endloop / endfacet
    void read_triangle() {
        expect("facet");
        expect("normal");
        for (int k = 0; k < 3; ++k) text_.next_number();
        expect("outer");
        expect("loop");
        Corners corners;
        for (Vec3& corner : corners) {
            expect("vertex");
            for (double& coordinate : corner) coordinate = text_.next_number();
        }
        expect("endloop");
        expect("endfacet");
        triangles_.add(corners);
        ++text_.tally.found;
    }

    bool next_is(std::string_view keyword) {
        TextReader ahead = text_;
        if (lower_case(ahead.next_word()) != keyword) return false;
        text_ = ahead;
        return true;
    }

    void expect(std::string_view keyword) {
        const std::string_view word = text_.next_word();
        if (lower_case(word) == keyword) return;
        refuse(ErrorCode::file_syntax,
               "expected '" + std::string(keyword) + "', found " + in_quotes(word), text_.place());
    }

    const Context& context_;
    TextReader text_;
    TriangleList triangles_;
    LabelReader objects_;
};

// The number of triangles in the rest of the data. Programs that write as they go put 0 or the
// largest number in its place; the triangles tell it then.
std::size_t triangle_count(ByteReader& data, std::size_t file_bytes, const Context& context) {
    constexpr auto kUnknown = std::numeric_limits<std::uint32_t>::max();
    const auto announced = data.read<std::uint32_t>();
    const std::size_t there = data.remaining() / kTriangleBytes;
    const bool is_stand_in = announced == 0 || announced == kUnknown;
    if (!is_stand_in || there == 0 || data.remaining() % kTriangleBytes != 0) {
        return checked_count(announced, file_bytes, "triangles", {});
    }
    context.log(LogLevel::warning, "the header announces " + std::to_string(announced) +
                                       " triangles, and " + std::to_string(there) +
                                       " follow; these were read");
    return checked_count(static_cast<std::int64_t>(there), file_bytes, "triangles", {});
}

MeshData read_binary(std::string_view bytes, const Context& context) {
    Progress progress(context, "read STL");
    Ticker ticker(progress);
    ByteReader data(bytes, Endianness::little);
    data.tally.elements = "triangles";
    data.skip(kStlHeaderBytes);
    const std::size_t count = triangle_count(data, bytes.size(), context);
    data.tally.announced = count;
    TriangleList triangles;
    triangles.reserve(std::min(count, data.remaining() / kTriangleBytes));
    for (; data.tally.found < count; ++data.tally.found) {
        ticker.tick([&] { return data.fraction(); });
        data.skip(3 * sizeof(float));
        Corners corners;
        for (Vec3& corner : corners) {
            for (double& coordinate : corner) coordinate = data.read<float>();
        }
        data.skip(sizeof(std::uint16_t));
        triangles.add(corners);
    }
    return triangles.take();
}

// Text has no zero bytes; in binary data the number of triangles has one, unless there are
// millions.
bool is_text(std::string_view bytes) {
    const std::string_view beginning = bytes.substr(0, kStlHeaderBytes + 4);
    return !is_binary_stl(bytes) && beginning.find('\0') == std::string_view::npos;
}

// ---- writing ----

struct FlatTriangle {
    Vec3 normal;
    std::array<Vec3, 3> corners;
};

FlatTriangle flat_triangle(std::span<const Vec3> positions, const Triangle& t) {
    FlatTriangle flat{Vec3::Zero(), {positions[t[0]], positions[t[1]], positions[t[2]]}};
    const Vec3 a = flat.corners[1] - flat.corners[0], b = flat.corners[2] - flat.corners[0];
    // Scaled first, so that neither large nor small triangles leave the range of double.
    const double scale = std::max(a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff());
    const bool has_size = scale > 0.0 && std::isfinite(scale);
    if (has_size) flat.normal = (a / scale).cross(b / scale).normalized();
    return flat;
}

void append_floats(std::string& bytes, const Vec3& v) {
    for (const double x : v) append_number(bytes, static_cast<float>(x), Endianness::little);
}

void require_float_range(const Mesh& mesh) {
    constexpr double kLargest = std::numeric_limits<float>::max();
    Elements beyond{ElementKind::vertex, 0, {}};
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (mesh.position(v).cwiseAbs().maxCoeff() > kLargest) beyond.add(v);
    }
    if (beyond.count == 0) return;
    const std::string names = describe(beyond);
    throw Error(
        ErrorCode::not_finite,
        names + " lie beyond the range of the 32-bit numbers of binary STL; save it as text",
        std::move(beyond));
}

// STL joins vertices by their places.
void require_float_precision(const Mesh& mesh, bool origin_moves, const Context& context) {
    require_distinct_floats(mesh.positions(), mesh.topology().faces().vertices, "binary STL",
                            origin_moves);
    FloatLoss loss;
    std::vector<Vec3> points;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        points.clear();
        for (const Index v : mesh.topology().face(f)) points.push_back(mesh.position(v));
        loss.look_at(f, points);
    }
    loss.require_small("binary STL", origin_moves, context);
}

void write_binary(const Mesh& mesh, const Triangulation& triangulation, std::string& bytes,
                  const Context& context) {
    require_float_range(mesh);
    Progress progress(context, "write STL");
    Ticker ticker(progress);
    const std::size_t count = triangulation.triangles.size();
    bytes.reserve(kStlHeaderBytes + 4 + kTriangleBytes * count);
    bytes += "Written by Lissom";
    bytes.resize(kStlHeaderBytes, ' ');
    append_number(bytes, static_cast<std::uint32_t>(count), Endianness::little);
    for (const Triangle& t : triangulation.triangles) {
        ticker.tick([&] { return double(bytes.size()) / double(bytes.capacity()); });
        const FlatTriangle flat = flat_triangle(mesh.positions(), t);
        append_floats(bytes, flat.normal);
        for (const Vec3& corner : flat.corners) append_floats(bytes, corner);
        bytes.append(2, '\0');
    }
}

// STL has no other elements.
void require_triangles(const Mesh& mesh, const Context& context) {
    if (mesh.face_count() == 0 && mesh.vertex_count() > 0) {
        throw Error(ErrorCode::unsupported, "STL holds triangles, and the mesh has only " +
                                                std::to_string(mesh.vertex_count()) +
                                                " points; save it as .ply");
    }
    std::size_t alone = 0;
    for (Index v = 0; v < mesh.vertex_count(); ++v) alone += mesh.topology().is_isolated(v);
    if (alone == 0) return;
    context.log(
        LogLevel::warning,
        std::to_string(alone) + " vertices without faces were not saved: STL holds triangles");
}

void append_facet(std::string& text, const FlatTriangle& flat) {
    text += "facet normal";
    append_numbers(text, flat.normal);
    text += "\n outer loop\n";
    for (const Vec3& corner : flat.corners) {
        text += "  vertex";
        append_numbers(text, corner);
        text += '\n';
    }
    text += " endloop\nendfacet\n";
}

std::string solid_name(const FaceLabels* objects, Index face) {
    const Index label = objects ? objects->of_face[face] : kNoIndex;
    return label == kNoIndex ? "" : " " + one_line(objects->names[label]);
}

void write_text(const Mesh& mesh, const Triangulation& triangulation, const FaceLabels* objects,
                std::string& text, const Context& context) {
    Progress progress(context, "write STL");
    Ticker ticker(progress);
    const std::size_t count = triangulation.triangles.size();
    std::string open_name = count > 0 ? solid_name(objects, triangulation.face[0]) : "";
    text += "solid" + open_name + "\n";
    for (std::size_t t = 0; t < count; ++t) {
        ticker.tick([&] { return double(t) / double(count); });
        std::string name = solid_name(objects, triangulation.face[t]);
        if (name != open_name) {
            text += "endsolid" + open_name + "\nsolid" + name + "\n";
            open_name = std::move(name);
        }
        append_facet(text, flat_triangle(mesh.positions(), triangulation.triangles[t]));
    }
    text += "endsolid" + open_name + "\n";
}

}  // namespace

bool is_binary_stl(std::string_view bytes) {
    if (bytes.size() < kStlHeaderBytes + 4) return false;
    const auto count =
        ByteReader(bytes.substr(kStlHeaderBytes), Endianness::little).read<std::uint32_t>();
    return bytes.size() == kStlHeaderBytes + 4 + kTriangleBytes * count;
}

MeshData read_stl(std::string_view bytes, const Context& context) {
    return is_text(bytes) ? StlTextReader(bytes, context).read() : read_binary(bytes, context);
}

void write_stl(SavedParts& parts, const SaveOptions& options, std::string& bytes,
               const Context& context) {
    const Mesh& mesh = parts.mesh();
    require_triangles(mesh, context);
    const Triangulation triangulation = triangulate_faces(mesh.topology(), mesh.positions());
    if (options.binary) {
        require_float_precision(mesh, options.origin == FileOrigin::keep, context);
        return write_binary(mesh, triangulation, bytes, context);
    }
    write_text(mesh, triangulation, parts.take_labels("object"), bytes, context);
}

}  // namespace lissom
