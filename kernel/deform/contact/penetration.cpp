#include "kernel/deform/contact/penetration.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <optional>
#include <utility>

namespace lissom {
namespace {

// Rays lean by this from the normal, so that they do not run along edges of regular meshes.
const Vec3 kLean{0.0123, 0.0071, -0.0047};

// The least cosine between the way out and the surface that is left, or the normal that is left
// behind: at less the way is not one out of the overlap.
constexpr double kLeastSlope = 0.2;

bool has_corner(const Triangle& triangle, Index v) {
    return std::find(triangle.begin(), triangle.end(), v) != triangle.end();
}

// Unit normals of vertices, by the area of their triangles; zero without any.
class VertexNormals {
  public:
    VertexNormals(const Topology& topology, std::span<const Vec3> positions)
        : topology_(topology), positions_(positions) {}

    Vec3 at(Index v) const {
        Vec3 sum = Vec3::Zero();
        for (const Index f : topology_.faces_around(v)) sum += area_normal(f);
        const double length = sum.norm();
        return length > 0.0 ? Vec3(sum / length) : Vec3(Vec3::Zero());
    }

  private:
    Vec3 area_normal(Index f) const {
        const auto corners = topology_.face(f);
        const Vec3& first = positions_[lissom::at(corners[0])];
        Vec3 sum = Vec3::Zero();
        for (std::size_t k = 2; k < corners.size(); ++k) {
            sum += (positions_[lissom::at(corners[k - 1])] - first)
                       .cross(positions_[lissom::at(corners[k])] - first);
        }
        return sum;
    }

    const Topology& topology_;
    std::span<const Vec3> positions_;
};

// Number of parts that the outer side of a vertex lies in.
int parts_around(const SpatialTree& tree, const VertexNormals& normals, Index v) {
    const Vec3 normal = normals.at(v);
    if (normal.isZero(0.0)) return 0;
    const Vec3 towards = (normal + kLean).normalized();
    int parts = 0;
    for (const SurfacePoint& hit : tree.pick_all(tree.positions()[at(v)], towards)) {
        if (has_corner(hit.triangle, v)) continue;
        parts += hit.normal.dot(towards) > 0.0 ? 1 : -1;
    }
    return parts;
}

class PenetrationSearch {
  public:
    PenetrationSearch(const Mesh& shape, const SpatialTree& rest,
                      std::span<const FacePair> contacts, const Context& context)
        : topology_(shape.topology()),
          rest_(rest),
          contacts_(contacts),
          context_(context),
          tree_(shape, context),
          normals_(topology_, tree_.positions()),
          rest_normals_(topology_, rest.positions()),
          overlap_of_(at(topology_.vertex_count()), kUnseen),
          contacts_of_(partners()) {}

    std::vector<Penetration> find() {
        std::vector<Penetration> overlaps;
        for (const FacePair& pair : contacts_) {
            for (const Index f : {pair.first, pair.second}) {
                for (const Index v : topology_.face(f)) {
                    const std::vector<Index> inside = flood(v);
                    if (inside.empty()) continue;
                    Penetration found = points_of(inside);
                    if (!found.empty()) overlaps.push_back(std::move(found));
                }
            }
        }
        return overlaps;
    }

  private:
    static constexpr Index kUnseen = -1, kOutside = -2;

    // Pairs both ways, ascending.
    std::vector<FacePair> partners() const {
        std::vector<FacePair> both(contacts_.begin(), contacts_.end());
        for (const FacePair& pair : contacts_) both.push_back({pair.second, pair.first});
        std::sort(both.begin(), both.end());
        return both;
    }

    bool is_inside(Index v) const {
        const int parts = parts_around(tree_, normals_, v);
        return parts > 0 && parts > parts_around(rest_, rest_normals_, v);
    }

    // The vertices inside that hang together with v, by edges and by contacts of their faces.
    std::vector<Index> flood(Index v) {
        std::vector<Index> inside;
        enter(v, inside);
        for (std::size_t next = 0; next < inside.size(); ++next) {
            if (next % 256 == 0) context_.checkpoint();
            const Index from = inside[next];
            for (const Index w : topology_.neighbors(from)) enter(w, inside);
            for (const Index f : topology_.faces_around(from)) enter_contacts(f, inside);
        }
        if (!inside.empty()) ++overlap_count_;
        return inside;
    }

    void enter(Index v, std::vector<Index>& inside) {
        Index& overlap = overlap_of_[at(v)];
        if (overlap != kUnseen) return;
        overlap = is_inside(v) ? overlap_count_ : kOutside;
        if (overlap != kOutside) inside.push_back(v);
    }

    void enter_contacts(Index f, std::vector<Index>& inside) {
        auto pair = std::lower_bound(contacts_of_.begin(), contacts_of_.end(), FacePair{f, -1});
        for (; pair != contacts_of_.end() && pair->first == f; ++pair) {
            for (const Index v : topology_.face(pair->second)) enter(v, inside);
        }
    }

    // The line along which the normals of both sides lie, as far as they do.
    Vec3 axis_of(std::span<const Vec3> normals) const {
        Mat3 sum = Mat3::Zero();
        for (const Vec3& normal : normals) sum += normal * normal.transpose();
        return Eigen::SelfAdjointEigenSolver<Mat3>(sum).eigenvectors().col(2);
    }

    Penetration points_of(std::span<const Index> inside) const {
        std::vector<Vec3> normals;
        for (const Index v : inside) normals.push_back(normals_.at(v));
        const Vec3 axis = axis_of(normals);
        Penetration points;
        for (std::size_t i = 0; i < inside.size(); ++i) {
            const double side = normals[i].dot(axis);
            if (std::abs(side) < kLeastSlope) continue;
            const Vec3 way = side > 0.0 ? Vec3(-axis) : axis;
            if (const auto point = way_out(inside[i], way)) points.push_back(*point);
        }
        return points;
    }

    // Whether a face is part of the overlap, or of its rim.
    bool is_part(const SurfacePoint& hit, Index overlap) const {
        const auto corners = topology_.face(hit.face);
        return std::any_of(corners.begin(), corners.end(),
                           [&](Index v) { return overlap_of_[at(v)] == overlap; }) ||
               std::binary_search(contacts_of_.begin(), contacts_of_.end(), FacePair{hit.face, 0},
                                  [](auto& a, auto& b) { return a.first < b.first; });
    }

    std::optional<PenetrationPoint> way_out(Index v, const Vec3& way) const {
        const Vec3& place = tree_.positions()[at(v)];
        for (const SurfacePoint& hit : tree_.pick_all(place, way)) {
            if (has_corner(hit.triangle, v) || hit.normal.dot(way) < kLeastSlope) continue;
            if (!is_part(hit, overlap_of_[at(v)])) continue;
            return PenetrationPoint{v, place, hit.triangle, hit.barycentric, way, hit.distance};
        }
        return std::nullopt;
    }

    const Topology& topology_;
    const SpatialTree& rest_;
    std::span<const FacePair> contacts_;
    const Context& context_;
    SpatialTree tree_;
    VertexNormals normals_, rest_normals_;
    std::vector<Index> overlap_of_;
    Index overlap_count_ = 0;
    std::vector<FacePair> contacts_of_;
};

}  // namespace

std::vector<Penetration> find_penetrations(const Mesh& shape, const SpatialTree& rest,
                                           std::span<const FacePair> contacts,
                                           const Context& context) {
    return PenetrationSearch(shape, rest, contacts, context).find();
}

}  // namespace lissom
