#include "kernel/mesh/edit/transform.h"

#include <Eigen/LU>
#include <utility>

#include "kernel/mesh/derive.h"
#include "kernel/mesh/measure/directions.h"

namespace lissom {
namespace {

Mesh with_reversed_faces(const Mesh& mesh, std::vector<Vec3> positions, const Context& context) {
    const MemoryCharge working = context.charge(mesh.memory_bytes(), "turning the faces of a mesh");
    const Topology& topology = mesh.topology();
    FaceList faces;
    std::vector<Index> corners, face;
    for (Index f = 0; f < topology.face_count(); ++f) {
        const std::span<const Index> old = topology.face(f);
        const auto n = count_of(old);
        face.clear();
        for (Index k = 0; k < n; ++k) {
            const Index from = (n - k) % n;
            face.push_back(old[from]);
            corners.push_back(topology.first_corner(f) + from);
        }
        faces.add(face);
    }
    const MeshMap map{ElementMap::identity(mesh.vertex_count()), ElementMap::copies(corners),
                      ElementMap::identity(mesh.face_count())};
    return derive(mesh, std::move(positions), std::move(faces), map, context);
}

// The determinant's sign, with the scale taken out so that small maps do not underflow.
double handedness(const Affine& map) {
    const double scale = map.linear.cwiseAbs().maxCoeff();
    const double determinant = scale > 0.0 ? (map.linear / scale).determinant() : 0.0;
    if (map.is_finite() && determinant != 0.0) return determinant;
    throw Error(
        ErrorCode::singular_transform,
        "the transform flattens the mesh or is not finite; scale by factors other than zero");
}

}  // namespace

void transform(Mesh& mesh, const Affine& map, const Context& context) {
    const double sign = handedness(map);
    context.checkpoint();
    const MemoryCharge working =
        context.charge(mesh.positions().size_bytes(), "transforming a mesh");
    std::vector<Vec3> positions;
    positions.reserve(mesh.vertex_count());
    for (const Vec3& p : mesh.positions()) positions.push_back(map(p));
    if (sign < 0.0) {
        mesh.replace_by(with_reversed_faces(mesh, std::move(positions), context));
    } else {
        mesh.set_positions(std::move(positions));
    }
    map_directions(mesh.attributes(), map.linear);
}

void flip(Mesh& mesh, const Context& context) {
    Progress progress(context, "flip");
    mesh.replace_by(
        with_reversed_faces(mesh, {mesh.positions().begin(), mesh.positions().end()}, context));
    negate_normals(mesh.attributes());
}

}  // namespace lissom
