#include "kernel/mesh/resample/feature_lines.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "kernel/mesh/edit/corner_twins.h"

namespace lissom {
namespace {

// Corner normals are parallel enough to count as one.
const double kSmoothCosine = std::cos(30.0 * kDegree);
// Part of the range of an attribute's values that rounding may make of equal ones.
constexpr double kSameValue = 1e-6;

double value_range(const Attribute& attribute) {
    double low = 0.0, high = 0.0;
    for (const double x : attribute.values) {
        if (std::isnan(x)) continue;
        low = std::min(low, x);
        high = std::max(high, x);
    }
    return high - low;
}

bool same_direction(std::span<const double> a, std::span<const double> b) {
    const Vec3 u(a[0], a[1], a[2]), v(b[0], b[1], b[2]);
    if (!u.allFinite() || !v.allFinite()) return u.allFinite() == v.allFinite();
    return u.dot(v) >= kSmoothCosine * u.norm() * v.norm();
}

// Compares values of one attribute on both sides of edges.
class CornerValues {
  public:
    explicit CornerValues(const Attribute& attribute)
        : attribute_(attribute), tolerance_(kSameValue * value_range(attribute)) {
        const AttributeRole role = role_of(attribute);
        is_direction_ = role == AttributeRole::normal || role == AttributeRole::tangent;
    }

    bool same(Index a, Index b) const {
        const std::span<const double> x = attribute_.at(a), y = attribute_.at(b);
        if (is_direction_) return same_direction(x, y);
        for (std::size_t k = 0; k < x.size(); ++k) {
            if (std::isnan(x[k]) != std::isnan(y[k])) return false;
            if (std::abs(x[k] - y[k]) > tolerance_) return false;
        }
        return true;
    }

  private:
    const Attribute& attribute_;
    double tolerance_;
    bool is_direction_ = false;
};

// Marks the edges whose sides differ in something.
class LineMarker {
  public:
    explicit LineMarker(const Mesh& mesh)
        : topology_(mesh.topology()),
          twin_(corner_twins(topology_)),
          lines_(twin_.size(), 0),
          face_of_(twin_.size(), kNoIndex) {
        for (Index f = 0; f < topology_.face_count(); ++f) {
            for (Index c = topology_.first_corner(f); c < topology_.first_corner(f + 1); ++c) {
                face_of_[at(c)] = f;
                lines_[at(c)] = twin_[at(c)] == kNoIndex ? 1 : 0;
            }
        }
    }

    // `differ(f, g)` of the faces of an edge.
    template <typename Differ>
    void mark_faces(const Differ& differ) {
        for (std::size_t c = 0; c < lines_.size(); ++c) {
            if (!lines_[c] && differ(face_of_[c], face_of_[at(twin_[c])])) lines_[c] = 1;
        }
    }

    void mark_corners(const Attribute& attribute) {
        const CornerValues values(attribute);
        for (std::size_t c = 0; c < lines_.size(); ++c) {
            if (lines_[c]) continue;
            const Index here = index_of(c), twin = twin_[c];
            if (!values.same(here, next(twin)) || !values.same(next(here), twin)) lines_[c] = 1;
        }
    }

    std::vector<char> take() { return std::move(lines_); }

  private:
    Index next(Index corner) const {
        const Index f = face_of_[at(corner)];
        return corner + 1 < topology_.first_corner(f + 1) ? corner + 1 : topology_.first_corner(f);
    }

    const Topology& topology_;
    std::vector<Index> twin_;
    std::vector<char> lines_;
    std::vector<Index> face_of_;
};

void mark_region(LineMarker& marker, const Topology& topology, const Region& region) {
    std::vector<char> inside(at(topology.face_count()), 0);
    for (const Index f : region.faces()) inside[at(f)] = 1;
    marker.mark_faces([&](Index f, Index g) { return inside[at(f)] != inside[at(g)]; });
}

void mark_creases(LineMarker& marker, const Mesh& mesh, double crease) {
    std::vector<Vec3> normals;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const std::span<const Index> v = mesh.topology().face(f);
        const Vec3& a = mesh.position(v[0]);
        normals.push_back((mesh.position(v[1]) - a).cross(mesh.position(v[2]) - a).normalized());
    }
    const double cosine = std::cos(crease);
    marker.mark_faces(
        [&](Index f, Index g) { return normals[at(f)].dot(normals[at(g)]) < cosine; });
}

}  // namespace

std::vector<char> feature_lines(const Mesh& mesh, double crease) {
    LineMarker marker(mesh);
    for (const Attribute& attribute : mesh.attributes().all()) {
        if (attribute.domain == Domain::corner) marker.mark_corners(attribute);
    }
    for (const auto& [kind, labels] : mesh.attributes().labels()) {
        const std::vector<Index>& of = labels.of_face;
        marker.mark_faces([&](Index f, Index g) { return of[at(f)] != of[at(g)]; });
    }
    for (const auto& [name, region] : mesh.regions()) mark_region(marker, mesh.topology(), region);
    if (crease < kPi) mark_creases(marker, mesh, crease);
    return marker.take();
}

}  // namespace lissom
