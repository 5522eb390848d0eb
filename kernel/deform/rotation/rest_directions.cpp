#include "kernel/deform/rotation/rest_directions.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "kernel/core/roots.h"
#include "kernel/deform/rotation/polar.h"
#include "kernel/mesh/measure/directions.h"
#include "kernel/mesh/measure/measures.h"

namespace lissom {
namespace {

// Custom normals of two corners that differ by less than this are the same: the rounding of a
// smooth surface by 8-bit files.
constexpr double kSameNormal = 0.02;

bool is_carried(const Attribute& attribute) {
    return is_direction(attribute) && attribute.domain != Domain::face;
}

Vec3 direction_at(const Attribute& attribute, Index element) {
    const std::span<const double> n = attribute.at(element);
    return {n[0], n[1], n[2]};
}

// Rows are two tangents and the unit normal, a right-handed frame.
Mat3 frame_about(const Vec3& normal) {
    Index least = 0;
    normal.cwiseAbs().minCoeff(&least);
    const Vec3 tangent = normal.cross(Vec3::Unit(least)).normalized();
    Mat3 frame;
    frame << tangent.transpose(), normal.cross(tangent).transpose(), normal.transpose();
    return frame;
}

// The rotation about the unit vector `axis` by the angle of (cosine, sine), of any length.
Mat3 rotation_about(const Vec3& axis, double cosine, double sine) {
    const double length = hypotenuse(cosine, sine);
    if (!(length > 0.0)) return Mat3::Identity();
    return Eigen::AngleAxisd(std::atan2(sine, cosine), axis).toRotationMatrix();
}

// Cuts of the fan of a vertex: flags of wedges whose custom normal differs from that of the wedge
// before.
std::vector<char> cuts_of(const Topology& topology, Index v, std::span<const Index> corners,
                          const Attribute& normals) {
    std::vector<char> cut(corners.size(), 0);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::size_t before = (i + corners.size() - 1) % corners.size();
        const Vec3 step =
            direction_at(normals, corners[i]) - direction_at(normals, corners[before]);
        cut[i] = step.norm() > kSameNormal;
    }
    if (topology.is_boundary(v)) cut.front() = 1;
    return cut;
}

}  // namespace

RestDirections::RestDirections(const Mesh& mesh, const Region& region) {
    const std::vector<Attribute>& all = mesh.attributes().all();
    if (std::none_of(all.begin(), all.end(), is_carried)) return;
    const Region around = region.grown(1);
    collect_faces(mesh, around);
    const Attribute* normals = mesh.attributes().find("normal");
    const bool by_corner = normals && normals->domain == Domain::corner && normals->width == 3;
    std::vector<Place> places;
    for (const Index v : around.vertices()) {
        places.push_back(collect_sectors(mesh, v, by_corner ? normals : nullptr));
        if (!mesh.topology().is_isolated(v)) continue;
        sectors_.back().alone = count_of(without_faces_);
        const std::vector<Index>& rows = region.vertices();
        const auto row = std::lower_bound(rows.begin(), rows.end(), v) - rows.begin();
        without_faces_.push_back(index_of(row));
    }
    for (const Attribute& attribute : all) {
        if (is_carried(attribute)) collect_values(attribute, places);
    }
    take_rest(std::move(rest_));
}

void RestDirections::collect_faces(const Mesh& mesh, const Region& around) {
    const Topology& topology = mesh.topology();
    std::vector<Index> faces;
    for (const Index v : around.vertices()) {
        const std::span<const Index> fan = topology.faces_around(v);
        faces.insert(faces.end(), fan.begin(), fan.end());
    }
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    for (const Index f : faces) {
        vertices_.insert(vertices_.end(), topology.face(f).begin(), topology.face(f).end());
    }
    std::sort(vertices_.begin(), vertices_.end());
    vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
    for (const Index v : vertices_) rest_.push_back(mesh.position(v));
    std::vector<Index> face;
    for (const Index f : faces) {
        face.clear();
        for (const Index v : topology.face(f)) face.push_back(local_vertex(v));
        faces_.add(face);
    }
    face_ids_ = std::move(faces);
}

Index RestDirections::local_vertex(Index vertex) const {
    const auto at = std::lower_bound(vertices_.begin(), vertices_.end(), vertex);
    return index_of(at - vertices_.begin());
}

Index RestDirections::add_sector(std::span<const Wedge> wedges) {
    const auto begin = count_of(wedges_);
    wedges_.insert(wedges_.end(), wedges.begin(), wedges.end());
    sectors_.push_back({begin, count_of(wedges_), kNoIndex, Vec3::Zero()});
    return count_of(sectors_) - 1;
}

// The fan is cut between corners with different `normals`; without normals it is whole.
RestDirections::Place RestDirections::collect_sectors(const Mesh& mesh, Index v,
                                                      const Attribute* normals) {
    const Topology& topology = mesh.topology();
    std::vector<Wedge> fan;
    std::vector<Index> corners;
    for (const Index f : topology.faces_around(v)) {
        const std::span<const Index> face = topology.face(f);
        const auto corner = std::find(face.begin(), face.end(), v) - face.begin();
        const auto id = std::lower_bound(face_ids_.begin(), face_ids_.end(), f);
        const auto local = index_of(id - face_ids_.begin());
        const std::span<const Index> of_local = faces_[local];
        const std::size_t n = face.size(), k = corner;
        fan.push_back({local, of_local[(k + n - 1) % n], of_local[k], of_local[(k + 1) % n]});
        corners.push_back(topology.first_corner(f) + index_of(corner));
    }
    Place place{v, add_sector(fan), {}};
    std::vector<char> cut(fan.size(), 0);
    if (normals && !fan.empty()) cut = cuts_of(topology, v, corners, *normals);
    const auto pieces = std::count(cut.begin(), cut.end(), 1);
    Index sector = place.whole;
    const std::size_t first = std::find(cut.begin(), cut.end(), 1) - cut.begin();
    for (std::size_t i = 0; i < fan.size(); ++i) {
        const std::size_t k = (first + i) % fan.size();
        if (pieces > 1 && cut[k]) {
            std::vector<Wedge> piece{fan[k]};
            for (std::size_t j = (k + 1) % fan.size(); !cut[j]; j = (j + 1) % fan.size()) {
                piece.push_back(fan[j]);
            }
            sector = add_sector(piece);
        }
        place.corners.emplace_back(corners[k], sector);
    }
    return place;
}

void RestDirections::collect_values(const Attribute& attribute, std::span<const Place> places) {
    Values values{attribute.name, attribute.domain, attribute.width, {}, {}, {}};
    const auto add = [&](Index element, Index sector) {
        values.element.push_back(element);
        values.sector.push_back(sector);
        values.value.push_back(direction_at(attribute, element));
    };
    for (const Place& place : places) {
        if (attribute.domain == Domain::vertex) {
            add(place.vertex, place.whole);
        } else {
            for (const auto& [corner, sector] : place.corners) add(corner, sector);
        }
    }
    attributes_.push_back(std::move(values));
}

RestDirections::Shape RestDirections::shape_of(std::vector<Vec3> at) const {
    Shape shape{std::move(at), {}, {}};
    std::vector<Vec3> corners;
    for (Index f = 0; f < faces_.size(); ++f) {
        corners.clear();
        char moved = 0;
        for (const Index v : faces_[f]) {
            corners.push_back(shape.at[v]);
            moved |= static_cast<char>(shape.at[v] != rest_[v]);
        }
        shape.normal.push_back(polygon_normal(corners));
        shape.moved.push_back(moved);
    }
    return shape;
}

// Same as vertex_normals; zero if there is none.
Vec3 RestDirections::normal_of(const Sector& sector, const Shape& shape) const {
    Vec3 sum = Vec3::Zero();
    for (const Wedge& wedge : wedges(sector)) {
        const Vec3& normal = shape.normal[wedge.face];
        sum += corner_angle(shape.at[wedge.before], shape.at[wedge.corner], shape.at[wedge.after],
                            normal) *
               normal;
    }
    const double length = sum.norm();
    return length > 0.0 ? Vec3(sum / length) : Vec3(Vec3::Zero());
}

void RestDirections::take_rest(std::vector<Vec3> at) {
    rest_ = std::move(at);
    const Shape shape = shape_of(rest_);
    for (Sector& sector : sectors_) sector.normal = normal_of(sector, shape);
}

// Calls use(at rest, now) for the directions of the edges on both sides of each wedge.
template <typename Use>
void RestDirections::for_each_edge(const Sector& sector, const Shape& shape, const Use& use) const {
    for (const Wedge& wedge : wedges(sector)) {
        for (const Index other : {wedge.after, wedge.before}) {
            const Vec3 before = rest_[other] - rest_[wedge.corner];
            const Vec3 now = shape.at[other] - shape.at[wedge.corner];
            const double size = before.norm() * now.norm();
            if (size > 0.0) use(before / before.norm(), now / now.norm());
        }
    }
}

Mat3 RestDirections::rotation_of(const Sector& sector, const Shape& shape) const {
    const std::span<const Wedge> around = wedges(sector);
    const bool moved = std::any_of(around.begin(), around.end(),
                                   [&](const Wedge& w) { return shape.moved[w.face] != 0; });
    if (!moved) return Mat3::Identity();
    const Vec3 normal = normal_of(sector, shape);
    if (normal.isZero(0.0) || sector.normal.isZero(0.0)) {
        Mat3 sum = Mat3::Zero();
        for_each_edge(sector, shape, [&](const Vec3& before, const Vec3& now) {
            sum += now * before.transpose();
        });
        return nearest_rotation(sum);
    }
    const Mat3 onto = frame_about(normal).transpose() * frame_about(sector.normal);
    double cosine = 0.0, sine = 0.0;
    for_each_edge(sector, shape, [&](const Vec3& before, const Vec3& now) {
        const Vec3 there = onto * before;
        sine += normal.dot(there.cross(now));
        cosine += there.dot(now) - there.dot(normal) * now.dot(normal);
    });
    return rotation_about(normal, cosine, sine) * onto;
}

std::vector<Mat3> RestDirections::rotations(std::vector<Vec3> at,
                                            std::span<const Mat3> alone) const {
    const Shape shape = shape_of(std::move(at));
    std::vector<Mat3> result;
    result.reserve(sectors_.size());
    for (const Sector& sector : sectors_) {
        result.push_back(sector.alone == kNoIndex ? rotation_of(sector, shape)
                                                  : alone[sector.alone]);
    }
    return result;
}

void RestDirections::apply_to(Mesh& mesh, std::span<const Mat3> alone) const {
    if (empty()) return;
    std::vector<Vec3> at;
    at.reserve(vertices_.size());
    for (const Index v : vertices_) at.push_back(mesh.position(v));
    const std::vector<Mat3> rotation = rotations(std::move(at), alone);
    for (const Values& values : attributes_) {
        Attribute* target = mesh.attributes().find(values.name);
        if (!target || target->domain != values.domain || target->width != values.width) continue;
        for (std::size_t i = 0; i < values.value.size(); ++i) {
            const Vec3 turned = rotation[values.sector[i]] * values.value[i];
            std::copy_n(turned.data(), 3, target->at(values.element[i]).begin());
        }
    }
}

void RestDirections::rebase(const Region& region, std::span<const Vec3> positions,
                            std::span<const Mat3> alone) {
    if (empty()) return;
    std::vector<Vec3> at = rest_;
    for (Index row = 0; row < region.size(); ++row) {
        const Index v = region.vertices()[row], local = local_vertex(v);
        const bool has_faces = local < count_of(vertices_) && vertices_[local] == v;
        if (has_faces) at[local] = positions[row];
    }
    const std::vector<Mat3> rotation = rotations(at, alone);
    for (Values& values : attributes_) {
        for (std::size_t i = 0; i < values.value.size(); ++i) {
            values.value[i] = rotation[values.sector[i]] * values.value[i];
        }
    }
    take_rest(std::move(at));
}

}  // namespace lissom
