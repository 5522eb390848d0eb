#include "kernel/mesh/repair/quality.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/measure/orientation.h"

namespace lissom {
namespace {

void add_finding(Report& report, FindingKind kind, ElementKind element, std::vector<Index> ids,
                 std::string message = {}) {
    const std::size_t count = ids.size();
    if (count > 0) report.add({kind, element, false, count, std::move(ids), std::move(message)});
}

// A triangle with an angle below one degree: its smallest angle lies between its two longest sides.
bool is_sliver(const Vec3& a, const Vec3& b, const Vec3& c) {
    constexpr double kSquaredSine = 3.0458649e-4;  // of one degree
    const double squares[3] = {(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()};
    const double shortest = std::min({squares[0], squares[1], squares[2]});
    const double product = shortest == squares[0]   ? squares[1] * squares[2]
                           : shortest == squares[1] ? squares[0] * squares[2]
                                                    : squares[0] * squares[1];
    return (b - a).cross(c - a).squaredNorm() < kSquaredSine * product;
}

void flag_faces(const Mesh& mesh, Report& report) {
    std::vector<Index> without_area = zero_area_faces(mesh), slivers;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const std::span<const Index> face = mesh.topology().face(f);
        if (face.size() != 3) continue;
        if (is_sliver(mesh.position(face[0]), mesh.position(face[1]), mesh.position(face[2])))
            slivers.push_back(f);
    }
    std::vector<Index> only_slivers;
    std::set_difference(slivers.begin(), slivers.end(), without_area.begin(), without_area.end(),
                        std::back_inserter(only_slivers));
    add_finding(report, FindingKind::faces_zero_area, ElementKind::face, std::move(without_area));
    add_finding(report, FindingKind::faces_sliver, ElementKind::face, std::move(only_slivers));
}

struct Component {
    double area = 0.0, volume = 0.0;
    Box box;
    bool closed = true;
};

std::vector<Component> measure_components(const Mesh& mesh) {
    const Topology& topology = mesh.topology();
    std::vector<Component> list(topology.component_count());
    const std::vector<Index>& component = topology.components();
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        Component& c = list[component[v]];
        c.box.extend(mesh.position(v));
        c.closed = c.closed && !topology.is_boundary(v);
    }
    for (Index f = 0; f < mesh.face_count(); ++f) {
        Component& c = list[component[topology.face(f)[0]]];
        const Vec3 area = vector_area(mesh.positions(), topology.face(f));
        c.area += area.norm();
        c.volume += area.dot(mesh.position(topology.face(f)[0]) - c.box.min) / 3.0;
    }
    return list;
}

// The wall of a hollow inside a larger component faces inward, as it should.
bool is_inside_another(const std::vector<Component>& list, const Component& c) {
    return std::any_of(list.begin(), list.end(), [&](const Component& other) {
        return &other != &c && other.closed && other.volume > -c.volume &&
               other.box.contains(c.box.min) && other.box.contains(c.box.max);
    });
}

// Reported if the closed components together have a negative volume.
constexpr const char* kInsideOut = "the mesh is inside out; mesh:flip() turns it";

void flag_components(const Mesh& mesh, Report& report) {
    constexpr double kSmall = 1e-3, kFlat = 1e-9;
    // Beyond this many components, looking for hollows would take longer than it is worth.
    constexpr std::size_t kMost = 2000;
    const std::vector<Component> list = measure_components(mesh);
    double largest = 0.0, enclosed = 0.0;
    for (const Component& c : list) {
        largest = std::max(largest, c.area);
        if (c.closed) enclosed += c.volume;
    }
    std::vector<Index> small, inverted;
    for (std::size_t i = 0; i < list.size(); ++i) {
        const Component& c = list[i];
        if (c.area < kSmall * largest) small.push_back(index_of(i));
        const bool inside_out = c.closed && c.volume < -kFlat * std::pow(c.area, 1.5);
        if (inside_out && (list.size() > kMost || !is_inside_another(list, c)))
            inverted.push_back(index_of(i));
    }
    add_finding(report, FindingKind::components_small, ElementKind::component, std::move(small));
    const bool is_most = !inverted.empty() && enclosed < 0.0;
    add_finding(report, FindingKind::components_inverted, ElementKind::component,
                std::move(inverted), is_most ? kInsideOut : "");
}

}  // namespace

void flag_quality(const Mesh& mesh, Report& report) {
    if (mesh.face_count() == 0) return;
    flag_faces(mesh, report);
    flag_components(mesh, report);
}

}  // namespace lissom
