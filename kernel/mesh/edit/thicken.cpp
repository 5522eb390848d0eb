#include "kernel/mesh/edit/thicken.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "kernel/mesh/derive.h"
#include "kernel/mesh/edit/corner_twins.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/measure/directions.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/measure/short_number.h"

namespace lissom {
namespace {

// Sharp edges and tips move by at most so many distances.
constexpr double kLongestOffset = 3.0;
// Draws displacements to the mean normal where the planes leave them open.
constexpr double kNormalPart = 1e-3;
// Lengths beyond so many diagonals of a mesh were meant in other units.
constexpr double kFarthestOffset = 10.0;

double angle_at(const Mesh& mesh, std::span<const Index> face, std::size_t k) {
    const std::size_t n = face.size();
    const Vec3& here = mesh.position(face[k]);
    const Vec3 before = mesh.position(face[(k + n - 1) % n]) - here,
               after = mesh.position(face[(k + 1) % n]) - here;
    const double angle = std::atan2(before.cross(after).norm(), before.dot(after));
    return std::isfinite(angle) ? angle : 0.0;
}

// Least squares of n . d = 1 over the faces, and a little of d = mean normal.
Vec3 offset_direction(const Mat3& planes, const Vec3& sum) {
    const double weight = planes.trace();
    if (!(weight > 0.0) || !(sum.norm() > 0.0)) return Vec3::Zero();
    const Vec3 mean = sum.normalized();
    const double pull = kNormalPart * weight;
    const Vec3 d = (planes + pull * Mat3::Identity()).ldlt().solve(Vec3(sum + pull * mean));
    if (!d.allFinite()) return mean;
    return d.norm() > kLongestOffset ? Vec3(kLongestOffset * d.normalized()) : d;
}

Box surface_bounds(const Mesh& mesh) {
    Box box;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (!mesh.topology().is_isolated(v)) box.extend(mesh.position(v));
    }
    return box;
}

// Beyond the shortest side of its box, the inner side of a body comes out on the other side.
void require_room_for_offset(const Mesh& mesh, double inside, double outside) {
    if (mesh.face_count() == 0) return;
    const Box box = surface_bounds(mesh);
    const double most = kFarthestOffset * box.diagonal();
    const double farthest = std::max(inside, outside);
    require(farthest <= most, "a length of " + short_number(farthest) + " is more than " +
                                  short_number(kFarthestOffset) + " times the mesh's size (" +
                                  short_number(box.diagonal()) +
                                  "); lengths are in the units of the mesh");
    const double depth = (box.max - box.min).minCoeff();
    require(!mesh.topology().is_closed() || inside <= depth,
            "the closed surface is " + short_number(depth) + " thick; moved inwards by " +
                short_number(inside) +
                " it would come out on the other side: use less than half of its thickness");
}

std::vector<Vec3> moved(const Mesh& mesh, const std::vector<Vec3>& directions, double distance) {
    std::vector<Vec3> positions;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        positions.push_back(mesh.position(v) + distance * directions[at(v)]);
    }
    return positions;
}

// The second side of the shell, and its rims.
class ShellBuilder {
  public:
    explicit ShellBuilder(const Mesh& mesh) : mesh_(mesh), topology_(mesh.topology()) {}

    Mesh build(const ThickenOptions& options, const Context& context) {
        add_outside();
        add_inside();
        add_rims();
        const std::vector<Vec3> directions = offset_directions(mesh_);
        std::vector<Vec3> positions = moved(mesh_, directions, options.outside * options.thickness);
        const std::vector<Vec3> inside =
            moved(mesh_, directions, (options.outside - 1.0) * options.thickness);
        positions.insert(positions.end(), inside.begin(), inside.end());
        for (int side = 0; side < 2; ++side) {
            for (Index v = 0; v < mesh_.vertex_count(); ++v) map_.vertices.add_copy(v);
        }
        return derive(mesh_, std::move(positions), std::move(faces_), map_, context);
    }

  private:
    void add_outside() {
        for (Index f = 0; f < topology_.face_count(); ++f) {
            faces_.add(topology_.face(f));
            map_.faces.add_copy(f);
        }
        for (Index c = 0; c < topology_.corner_count(); ++c) map_.corners.add_copy(c);
    }

    void add_inside() {
        std::vector<Index> face;
        for (Index f = 0; f < topology_.face_count(); ++f) {
            const std::span<const Index> old = topology_.face(f);
            const Index n = count_of(old);
            face.clear();
            for (Index k = 0; k < n; ++k) {
                const Index from = (n - k) % n;
                face.push_back(old[at(from)] + mesh_.vertex_count());
                map_.corners.add_copy(topology_.first_corner(f) + from);
            }
            faces_.add(face);
            map_.faces.add_copy(f);
        }
    }

    // A quad for each open edge a b: b, a on the outer side, then a, b on the inner one.
    void add_rims() {
        const std::vector<Index> twin = corner_twins(topology_);
        const Index n = mesh_.vertex_count();
        for (Index f = 0; f < topology_.face_count(); ++f) {
            const Index first = topology_.first_corner(f), end = topology_.first_corner(f + 1);
            for (Index c = first; c < end; ++c) {
                if (twin[at(c)] != kNoIndex) continue;
                const Index d = c + 1 < end ? c + 1 : first;
                const Index a = topology_.face(f)[at(c - first)],
                            b = topology_.face(f)[at(d - first)];
                faces_.add({b, a, a + n, b + n});
                map_.faces.add_copy(f);
                for (const Index corner : {d, c, c, d}) map_.corners.add_copy(corner);
            }
        }
    }

    const Mesh& mesh_;
    const Topology& topology_;
    FaceList faces_;
    MeshMap map_;
};

// Rims are flat: elements of the attribute after those of both sides take the faces' normals.
void set_rim_normals(const Mesh& shell, const Mesh& surface, Attribute& attribute) {
    if (attribute.domain == Domain::vertex) return;
    const std::vector<Vec3> normals = face_normals(shell);
    const Index each = attribute.domain == Domain::corner ? 4 : 1;
    Index element = 2 * element_count(surface.topology(), attribute.domain);
    for (Index f = 2 * surface.face_count(); f < shell.face_count(); ++f) {
        for (Index k = 0; k < each; ++k, ++element) {
            const Vec3& normal = normals[at(f)];
            std::copy(normal.begin(), normal.end(), attribute.at(element).begin());
        }
    }
}

// Normals of the inner side look the other way.
void turn_inner_normals(Mesh& shell, const Mesh& surface) {
    for (Attribute& attribute : shell.attributes().all()) {
        const AttributeRole role = role_of(attribute);
        if (role != AttributeRole::normal && role != AttributeRole::morph_normal) continue;
        const Index begin = element_count(surface.topology(), attribute.domain);
        for (Index i = begin; i < 2 * begin; ++i) {
            for (double& x : attribute.at(i)) x = -x;
        }
        if (role == AttributeRole::normal) set_rim_normals(shell, surface, attribute);
    }
}

// Pairs of `found` whose faces were no pair of the surface as given.
std::vector<FacePair> new_pairs(const std::vector<FacePair>& found,
                                const std::vector<FacePair>& old, Index faces) {
    std::vector<FacePair> result;
    for (const FacePair& pair : found) {
        const bool sides = pair.second < 2 * faces;
        FacePair source{pair.first % faces, pair.second % faces};
        if (source.second < source.first) std::swap(source.first, source.second);
        const bool known = sides && std::binary_search(old.begin(), old.end(), source);
        if (!known) result.push_back(pair);
    }
    return result;
}

}  // namespace

std::vector<Vec3> offset_directions(const Mesh& mesh) {
    const std::vector<Vec3> normals = face_normals(mesh);
    std::vector<Mat3> planes(at(mesh.vertex_count()), Mat3::Zero());
    std::vector<Vec3> sums(at(mesh.vertex_count()), Vec3::Zero());
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const std::span<const Index> face = mesh.topology().face(f);
        const Vec3& n = normals[at(f)];
        for (std::size_t k = 0; k < face.size(); ++k) {
            const double angle = angle_at(mesh, face, k);
            planes[at(face[k])] += angle * n * n.transpose();
            sums[at(face[k])] += angle * n;
        }
    }
    std::vector<Vec3> directions;
    for (std::size_t v = 0; v < sums.size(); ++v) {
        directions.push_back(offset_direction(planes[v], sums[v]));
    }
    return directions;
}

std::vector<FacePair> offset(Mesh& mesh, double distance, bool check, const Context& context) {
    require(std::isfinite(distance), "the distance of the offset must be a finite number");
    require_room_for_offset(mesh, -distance, distance);
    Mesh result = mesh;
    result.set_positions(moved(mesh, offset_directions(mesh), distance));
    std::vector<FacePair> crossings;
    if (check) {
        crossings = new_pairs(self_intersections(result, {}, context),
                              self_intersections(mesh, {}, context), mesh.face_count());
    }
    const DirectionCarrier directions(mesh);
    mesh.set_positions({result.positions().begin(), result.positions().end()});
    directions.follow(mesh);
    return crossings;
}

Shell thicken(const Mesh& mesh, const ThickenOptions& options, const Context& context) {
    require(mesh.face_count() > 0, "the mesh has no faces", ErrorCode::mesh_empty);
    require(options.thickness > 0.0 && std::isfinite(options.thickness),
            "the thickness must be a length above 0");
    require(options.outside >= 0.0 && options.outside <= 1.0,
            "the part of the thickness outside must be from 0 to 1");
    require(mesh.topology().corner_count() < std::numeric_limits<Index>::max() / 6,
            "the shell would have more elements than can be numbered", ErrorCode::out_of_range);
    require_room_for_offset(mesh, (1.0 - options.outside) * options.thickness,
                            options.outside * options.thickness);
    Progress progress(context, "thicken");
    progress.step(0.3);
    Shell shell{ShellBuilder(mesh).build(options, context), {}};
    turn_inner_normals(shell.mesh, mesh);
    progress.step(0.7);
    if (options.check) {
        shell.crossings = new_pairs(self_intersections(shell.mesh, {}, context),
                                    self_intersections(mesh, {}, context), mesh.face_count());
    }
    return shell;
}

}  // namespace lissom
