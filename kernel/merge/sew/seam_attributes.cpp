#include "kernel/merge/sew/seam_attributes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "kernel/core/rotation.h"
#include "kernel/merge/loop/face_angles.h"
#include "kernel/mesh/measure/morph_maps.h"

namespace lissom {
namespace {

// Corner of face `f` at vertex `v`.
Index corner_at(const Topology& topology, Index f, Index v) {
    const std::span<const Index> face = topology.face(f);
    return topology.first_corner(f) +
           index_of(std::find(face.begin(), face.end(), v) - face.begin());
}

// Unit normals of the faces around `v`, weighted by their angles there.
Vec3 normal_at(const Mesh& mesh, Index v) {
    const Topology& topology = mesh.topology();
    Vec3 sum = Vec3::Zero();
    for (const Index f : topology.faces_around(v)) {
        const std::span<const Index> face = topology.face(f);
        const std::size_t n = face.size();
        const std::size_t k = corner_at(topology, f, v) - topology.first_corner(f);
        const Vec3 u = mesh.position(face[(k + 1) % n]) - mesh.position(v);
        const Vec3 w = mesh.position(face[(k + n - 1) % n]) - mesh.position(v);
        const Vec3 area = area_vector(mesh, f);
        if (area.squaredNorm() > 0.0) {
            sum += std::atan2(u.cross(w).norm(), u.dot(w)) * area.normalized();
        }
    }
    const double length = sum.norm();
    return length > 0.0 ? Vec3(sum / length) : sum;
}

// Calls change(value) for each value that an attribute has at a vertex.
template <typename Change>
void change_at(const Topology& topology, Attribute& attribute, Index v, const Change& change) {
    const auto change_one = [&](Index element) {
        Eigen::Map<Vec3> value(attribute.at(element).data());
        if (value.allFinite()) change(value);
    };
    if (attribute.domain == Domain::vertex) {
        change_one(v);
        return;
    }
    for (const Index f : topology.faces_around(v)) change_one(corner_at(topology, f, v));
}

// The corners of one side at a vertex of a seam, and the mean of the displacements that they have.
struct SideCorners {
    std::vector<Index> corners;
    Vec3 sum = Vec3::Zero();
    double count = 0.0;

    void add(Index corner, const Attribute& attribute) {
        corners.push_back(corner);
        const Eigen::Map<const Vec3> value(attribute.at(corner).data());
        if (!value.allFinite()) return;
        sum += value;
        count += 1.0;
    }
    Vec3 mean() const { return sum / count; }
    // Those without a value get the new mean.
    void move_mean(const Vec3& to, Attribute& attribute) const {
        for (const Index corner : corners) {
            Eigen::Map<Vec3> value(attribute.at(corner).data());
            value = value.allFinite() ? Vec3(value + (to - mean())) : to;
        }
    }
};

void close_morph(std::span<const SeamSide> side_of_face, Index v, const Topology& topology,
                 Attribute& attribute) {
    SideCorners target, source;
    for (const Index f : topology.faces_around(v)) {
        SideCorners& side = side_of_face[at(f)] == SeamSide::target ? target : source;
        side.add(corner_at(topology, f, v), attribute);
    }
    if (target.count + source.count == 0.0) return;
    const Vec3 to = target.count == 0.0   ? source.mean()
                    : source.count == 0.0 ? target.mean()
                                          : Vec3(0.5 * (target.mean() + source.mean()));
    target.move_mean(to, attribute);
    source.move_mean(to, attribute);
}

}  // namespace

void close_morphs(std::span<const std::vector<Index>> seams, std::span<const SeamSide> side_of_face,
                  Mesh& mesh) {
    for (Attribute& attribute : mesh.attributes().all()) {
        if (!is_morph_position(attribute) || attribute.domain != Domain::corner) continue;
        for (const std::vector<Index>& seam : seams) {
            for (const Index v : seam) close_morph(side_of_face, v, mesh.topology(), attribute);
        }
    }
}

std::vector<ElementMap::Source> SeamSources::blend() const {
    std::vector<ElementMap::Source> all;
    for (const auto* side : {&target, &source}) {
        for (const ElementMap::Source& s : *side) all.push_back({s.element, 0.5 * s.weight});
    }
    return all;
}

void carry_seam_regions(const Mesh& old, const std::unordered_map<Index, SeamSources>& sources,
                        std::span<const Index> new_number, Mesh& mesh) {
    for (const auto& [name, region] : old.regions()) {
        const std::vector<char> in = region.mask();
        const auto holds = [&](const std::vector<ElementMap::Source>& side) {
            return std::all_of(side.begin(), side.end(),
                               [&](const auto& s) { return in[s.element] != 0; });
        };
        std::vector<Index> vertices = mesh.find_region(name)->vertices();
        for (const auto& [v, of] : sources) {
            if (holds(of.target) || holds(of.source)) vertices.push_back(new_number[v]);
        }
        mesh.set_region(name, Region(mesh.shared_topology(), std::move(vertices)));
    }
}

SeamNormals::SeamNormals(Mesh& mesh, std::vector<Index> moving) : mesh_(mesh) {
    normals_ = mesh.attributes().find("normal");
    const bool sound =
        normals_ && role_of(*normals_) == AttributeRole::normal && normals_->domain != Domain::face;
    if (!sound) normals_ = nullptr;
    if (!normals_) return;
    moving_ = std::move(moving);
    for (const Index v : moving_) before_.push_back(normal_at(mesh, v));
}

void SeamNormals::follow(std::span<const std::vector<Index>> seams) {
    if (!normals_) return;
    for (std::size_t i = 0; i < moving_.size(); ++i) {
        const auto turn = min_rotation(before_[i], normal_at(mesh_, moving_[i]));
        change_at(mesh_.topology(), *normals_, moving_[i],
                  [&](Eigen::Map<Vec3>& value) { value = (turn * value).normalized(); });
    }
    for (const std::vector<Index>& seam : seams) {
        for (const Index v : seam) {
            change_at(mesh_.topology(), *normals_, v,
                      [&](Eigen::Map<Vec3>& value) { value = normal_at(mesh_, v); });
        }
    }
}

}  // namespace lissom
