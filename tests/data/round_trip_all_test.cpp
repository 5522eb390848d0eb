// Load, save, load: every real mesh comes back from every format, as far as the format can hold it.
#include <cmath>
#include <map>

#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/measure/triangulation.h"
#include "tests/data/data_files.h"

namespace lissom::test {
namespace {

Mesh again(const Mesh& mesh, const std::string& extension, const LoadOptions& options = {}) {
    return decode_mesh(encode_mesh(mesh, extension), extension, options);
}

// A text format keeps every vertex, so nothing has to be welded.
Mesh as_stored(const Mesh& mesh, const std::string& extension) {
    return again(mesh, extension, {.weld = Weld::none});
}

void check_same_surface(const Mesh& mesh, const Mesh& copy) {
    CHECK(copy.topology().faces().vertices == mesh.topology().faces().vertices);
    CHECK(copy.topology().faces().offsets == mesh.topology().faces().offsets);
    CHECK(std::equal(copy.positions().begin(), copy.positions().end(), mesh.positions().begin(),
                     mesh.positions().end()));
}

// What an attribute of vertices or corners has at a corner.
std::span<const double> at_corner(const Mesh& mesh, const Attribute& attribute, Index corner) {
    const Index v = mesh.topology().faces().vertices[corner];
    return attribute.at(attribute.domain == Domain::vertex ? v : corner);
}

bool same_number(double a, double b, double tolerance) {
    return std::isnan(a) ? std::isnan(b) : std::abs(a - b) <= tolerance * (1.0 + std::abs(a));
}

// Where they have numbers at all: what one has and the other lacks counts as different.
bool same_at_corners(const Mesh& mesh, const Mesh& copy, const std::string& name,
                     double tolerance) {
    const Attribute* one = mesh.attributes().find(name);
    const Attribute* other = copy.attributes().find(name);
    if (!one || !other || one->width != other->width) return false;
    for (Index c = 0; c < mesh.topology().corner_count(); ++c) {
        const auto a = at_corner(mesh, *one, c), b = at_corner(copy, *other, c);
        for (std::size_t k = 0; k < a.size(); ++k) {
            if (!same_number(a[k], b[k], tolerance)) return false;
        }
    }
    return true;
}

bool has_on_surface(const Mesh& mesh, const char* name, Index width) {
    const Attribute* a = mesh.attributes().find(name);
    return a && a->domain != Domain::face && a->width == width && a->size() > 0 &&
           std::any_of(a->values.begin(), a->values.end(), [](double x) { return !std::isnan(x); });
}

// Faces of every label, by kind and name.
std::map<std::string, Index> label_counts(const Mesh& mesh) {
    std::map<std::string, Index> counts;
    for (const auto& [kind, labels] : mesh.attributes().labels()) {
        for (const Index label : labels.of_face) {
            if (label != kNoIndex) ++counts[kind + "/" + labels.names[label]];
        }
    }
    return counts;
}

// Numbers of faces of the labels of each kind that `like` has, without the names, which are UTF-8
// in some formats only.
std::multimap<std::string, Index> sizes_of_labels(const Mesh& mesh, const Mesh& like) {
    std::multimap<std::string, Index> sizes;
    for (const auto& [label, count] : label_counts(mesh)) {
        const std::string kind = label.substr(0, label.find('/'));
        if (like.attributes().labels().contains(kind)) sizes.emplace(kind, count);
    }
    std::multimap<std::string, Index> sorted;
    for (const auto& [kind, labels] : like.attributes().labels()) {
        const auto [begin, end] = sizes.equal_range(kind);
        std::vector<Index> counts;
        for (auto entry = begin; entry != end; ++entry) counts.push_back(entry->second);
        std::sort(counts.begin(), counts.end());
        for (const Index count : counts) sorted.emplace(kind, count);
    }
    return sorted;
}

void check_obj(const Mesh& mesh) {
    const Mesh copy = as_stored(mesh, "obj");
    check_same_surface(mesh, copy);
    for (const auto& [name, width] : {std::pair("uv", 2), std::pair("normal", 3)}) {
        if (has_on_surface(mesh, name, width)) CHECK(same_at_corners(mesh, copy, name, 0.0));
    }
    if (const auto& labels = mesh.attributes().labels(); !labels.empty())
        CHECK(label_counts(copy) == label_counts(mesh));
}

void check_ply(const Mesh& mesh) {
    const Mesh copy = as_stored(mesh, "ply");
    check_same_surface(mesh, copy);
    for (const Attribute& attribute : mesh.attributes().all()) {
        CAPTURE(attribute.name);
        const Attribute* other = copy.attributes().find(attribute.name);
        REQUIRE(other);
        CHECK(other->domain == attribute.domain);
        CHECK(std::equal(attribute.values.begin(), attribute.values.end(), other->values.begin(),
                         other->values.end(), [](double a, double b) {
                             return a == b || (std::isnan(a) && std::isnan(b));
                         }));
    }
    CHECK(label_counts(copy) == label_counts(mesh));
    CHECK(copy.regions().size() == mesh.regions().size());
}

// What 32-bit numbers would join or flatten is refused.
bool fits(const Mesh& mesh, const std::string& extension) {
    try {
        (void)encode_mesh(mesh, extension);
        return true;
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::unsupported);
        return false;
    }
}

void check_stl(const Mesh& mesh) {
    if (!fits(mesh, "stl")) return;
    const auto count = triangulate_faces(mesh.topology(), mesh.positions()).triangles.size();
    const Mesh copy = again(mesh, "stl", {.weld = Weld::none});
    CHECK(static_cast<std::size_t>(copy.face_count()) == count);
    CHECK(area(copy) == doctest::Approx(area(mesh)).epsilon(1e-4));
}

// Positions are 32-bit numbers there, and faces stand together by object and material; from the
// second time on nothing changes.
void check_gltf(const Mesh& mesh, const std::string& extension) {
    if (!fits(mesh, extension)) return;
    const Mesh first = again(mesh, extension), second = again(first, extension);
    CHECK(first.vertex_count() == mesh.vertex_count());
    CHECK(first.face_count() == mesh.face_count());
    CHECK(first.topology().component_count() == mesh.topology().component_count());
    CHECK(first.topology().boundary_edge_count() == mesh.topology().boundary_edge_count());
    CHECK(area(first) == doctest::Approx(area(mesh)).epsilon(1e-4));
    const auto before = sizes_of_labels(mesh, mesh), after = sizes_of_labels(first, mesh);
    CHECK(std::includes(after.begin(), after.end(), before.begin(), before.end()));
    CHECK(second.topology().faces().vertices == first.topology().faces().vertices);
    const double size = bounds(first).diagonal();
    double worst = 0.0;
    for (Index v = 0; v < std::min(first.vertex_count(), second.vertex_count()); ++v)
        worst = std::max(worst, (first.position(v) - second.position(v)).norm());
    CHECK(worst <= 1e-6 * size);
    for (const Attribute& attribute : mesh.attributes().all()) {
        if (attribute.domain == Domain::face || !first.attributes().find(attribute.name)) continue;
        CAPTURE(attribute.name);
        CHECK(same_at_corners(first, second, attribute.name, 1e-5));
    }
}

bool fits_float(const Mesh& mesh) {
    return std::all_of(mesh.positions().begin(), mesh.positions().end(),
                       [](const Vec3& p) { return p.cwiseAbs().maxCoeff() < 1e38; });
}

}  // namespace

TEST_CASE("every mesh comes back from every format") {
    for_each_mesh([](const Mesh& mesh) {
        check_obj(mesh);
        check_ply(mesh);
        check_same_surface(mesh, as_stored(mesh, "off"));
        if (!fits_float(mesh)) return;
        check_stl(mesh);
        check_gltf(mesh, "glb");
        if (mesh.vertex_count() < 5000) check_gltf(mesh, "gltf");
    });
}

}  // namespace lissom::test
