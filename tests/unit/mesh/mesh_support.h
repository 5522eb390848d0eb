/// Meshes and checks shared by the tests of kernel/mesh.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <fstream>
#include <limits>
#include <optional>
#include <random>
#include <string>

#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/mesh.h"
#include "tests/unit/shapes.h"
#include "tests/unit/support.h"

namespace lissom::test {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A real mesh in OFF with plain text; nothing, with a message, where the data is absent.
inline std::optional<Mesh> load_off(const std::string& name) {
    const auto path = data_file("models/" + name);
    if (!path) return std::nullopt;
    std::ifstream file(*path);
    std::string magic;
    Index vertices = 0, count = 0, edges = 0;
    file >> magic >> vertices >> count >> edges;
    std::vector<Vec3> positions(static_cast<std::size_t>(vertices));
    for (Vec3& p : positions) file >> p.x() >> p.y() >> p.z();
    FaceList faces;
    std::vector<Index> face;
    for (Index f = 0; f < count; ++f) {
        std::size_t size = 0;
        file >> size;
        face.resize(size);
        for (Index& v : face) file >> v;
        faces.add(face);
    }
    REQUIRE(file);
    return Mesh(std::move(positions), std::move(faces));
}

inline Mesh tetrahedron() {
    FaceList faces;
    faces.add({0, 2, 1});
    faces.add({0, 1, 3});
    faces.add({1, 2, 3});
    faces.add({2, 0, 3});
    return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, std::move(faces)};
}

/// Two triangles and a quad in a row: 0 1 2 | 0 2 3 | 2 1 4 5, open, in the xy plane.
inline Mesh patch() {
    FaceList faces;
    faces.add({0, 1, 2});
    faces.add({0, 2, 3});
    faces.add({2, 1, 4, 5});
    return {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}}, std::move(faces)};
}

/// Random numbers that are the same on every platform.
class Random {
  public:
    explicit Random(std::uint32_t seed) : engine_(seed) {}
    double uniform(double low, double high) {
        return low + (high - low) * (engine_() / 4294967296.0);
    }
    Index index(Index count) { return static_cast<Index>(uniform(0.0, count)); }
    Vec3 in_box(const Box& box) {
        return {uniform(box.min.x(), box.max.x()), uniform(box.min.y(), box.max.y()),
                uniform(box.min.z(), box.max.z())};
    }
    Vec3 direction() {
        const double z = uniform(-1.0, 1.0), angle = uniform(0.0, 2.0 * kPi);
        const double r = std::sqrt(1.0 - z * z);
        return {r * std::cos(angle), r * std::sin(angle), z};
    }

  private:
    std::mt19937 engine_;
};

/// A rotation, then a uniform scaling by `scale`, then a shift.
inline Affine similarity(Random& random, double scale) {
    const Affine turn = rotation(random.direction(), random.uniform(0.0, 2.0 * kPi), Vec3::Zero());
    return translation(3.0 * random.direction()) * scaling(Vec3::Constant(scale), Vec3::Zero()) *
           turn;
}

/// Gives a mesh one attribute on each domain, labels, a region and a material library, all of which
/// can be told apart by value: a vertex carries its x, a corner 100 f + k, a face 10 f.
inline Mesh decorated(Mesh mesh) {
    const Topology& topology = mesh.topology();
    Attribute at_vertex{"x", Domain::vertex, 1, ScalarType::float64, {}};
    for (const Vec3& p : mesh.positions()) at_vertex.values.push_back(p.x());
    Attribute at_corner{"uv", Domain::corner, 2, ScalarType::float32, {}};
    Attribute at_face{"part", Domain::face, 1, ScalarType::int32, {}};
    FaceLabels groups{{"even", "odd"}, {}};
    for (Index f = 0; f < topology.face_count(); ++f) {
        for (std::size_t k = 0; k < topology.face(f).size(); ++k) {
            at_corner.values.push_back(100.0 * f + static_cast<double>(k));
            at_corner.values.push_back(-1.0 * f);
        }
        at_face.values.push_back(10.0 * f);
        groups.of_face.push_back(f % 2);
    }
    mesh.attributes().add(std::move(at_vertex));
    mesh.attributes().add(std::move(at_corner));
    mesh.attributes().add(std::move(at_face));
    mesh.attributes().labels()["group"] = std::move(groups);
    std::vector<Index> half;
    for (Index v = 0; v < mesh.vertex_count(); v += 2) half.push_back(v);
    mesh.set_region("half", Region(mesh.shared_topology(), half));
    mesh.material_libraries() = {"stone.mtl"};
    return mesh;
}

/// True where everything that `decorated` adds is there, one value an element.
inline bool is_decorated(const Mesh& mesh) {
    require_complete_attributes(mesh);
    return mesh.attributes().all().size() == 3 && mesh.attributes().find("x") &&
           mesh.attributes().find("uv") && mesh.attributes().find("part") &&
           mesh.attributes().labels().contains("group") && mesh.find_region("half") &&
           mesh.material_libraries() == std::vector<std::string>{"stone.mtl"};
}

/// Sorted labels and attributes aside, equal to the bit.
inline bool same_shape(const Mesh& a, const Mesh& b) {
    return std::equal(a.positions().begin(), a.positions().end(), b.positions().begin(),
                      b.positions().end()) &&
           a.topology().faces().offsets == b.topology().faces().offsets &&
           a.topology().faces().vertices == b.topology().faces().vertices;
}

}  // namespace lissom::test
