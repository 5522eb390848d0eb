#include "kernel/mesh/edit/symmetrize.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "kernel/mesh/cut/cut.h"
#include "kernel/mesh/derive.h"
#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/measure/measures.h"

namespace lissom {
namespace {

constexpr double kWeldPart = 0.01;
// Part of the distances from the plane that rounding explains.
constexpr double kPlaneRounding = 1e-12;

struct MirrorPlane {
    Vec3 point, normal;
    double weld = 0.0;

    double distance(const Vec3& p) const { return normal.dot(p - point); }
    Vec3 onto(const Vec3& p) const { return p - distance(p) * normal; }
    Affine reflection() const {
        const Mat3 linear = Mat3::Identity() - 2.0 * normal * normal.transpose();
        return {linear, 2.0 * normal.dot(point) * normal};
    }
};

MirrorPlane mirror_plane(const Mesh& mesh, const SymmetrizeOptions& options) {
    require(mesh.face_count() > 0, "the mesh has no faces", ErrorCode::mesh_empty);
    require(options.point.allFinite() && options.normal.allFinite(),
            "the plane's point or normal is NaN or infinite", ErrorCode::not_finite);
    require(options.normal.stableNorm() > 0.0,
            "the normal of the plane must have a length above 0");
    const double weld = options.weld.value_or(kWeldPart * mean_edge_length(mesh));
    require(weld >= 0.0 && std::isfinite(weld), "the distance of welding must be at least 0");
    return {options.point, options.normal.stableNormalized(), weld};
}

bool is_welded(const Mesh& mesh, const MirrorPlane& plane, Index v) {
    return mesh.topology().is_boundary(v) &&
           std::abs(plane.distance(mesh.position(v))) <= plane.weld;
}

void snap_borders(Mesh& mesh, const MirrorPlane& plane) {
    std::vector<Vec3> positions(mesh.positions().begin(), mesh.positions().end());
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (is_welded(mesh, plane, v)) positions[at(v)] = plane.onto(positions[at(v)]);
    }
    mesh.set_positions(std::move(positions));
}

// The part on the kept side, with its border on the plane.
Mesh kept_half(const Mesh& mesh, const MirrorPlane& plane, const Context& context) {
    Mesh half = mesh;
    snap_borders(half, plane);
    double low = 0.0, high = 0.0;
    for (const Vec3& p : half.positions()) {
        low = std::min(low, plane.distance(p));
        high = std::max(high, plane.distance(p));
    }
    const double rounding = kPlaneRounding * (high - low + plane.point.norm());
    require(high > rounding,
            "nothing of the mesh lies on the side of the plane that is kept; turn its normal");
    if (low >= -rounding) return half;
    const CutPlane by{.point = plane.point, .normal = plane.normal};
    half = cut(half, by, {.loops = CutLoops::all}, context).kept.mesh;
    snap_borders(half, plane);
    return half;
}

// The two copies of each vertex on the plane become one.
Symmetrized welded(const Mesh& both, Index half, const std::vector<char>& on_plane,
                   const Context& context) {
    std::vector<Index> new_id;
    MeshMap map;
    std::vector<Vec3> positions;
    Symmetrized result;
    for (Index v = 0; v < both.vertex_count(); ++v) {
        const Index original = v < half ? v : v - half;
        if (v >= half && on_plane[at(original)]) {
            new_id.push_back(original);
            continue;
        }
        new_id.push_back(count_of(positions));
        positions.push_back(both.position(v));
        if (on_plane[at(original)]) {
            map.vertices.add_mean(std::array{v, v + half});
        } else {
            map.vertices.add_copy(v);
        }
    }
    FaceList faces = both.topology().faces();
    for (Index& v : faces.vertices) v = new_id[at(v)];
    map.corners = ElementMap::identity(both.topology().corner_count());
    map.faces = ElementMap::identity(both.face_count());
    result.mirror.resize(positions.size());
    for (Index v = 0; v < half; ++v) {
        result.mirror[at(v)] = new_id[at(v + half)];
        result.mirror[at(new_id[at(v + half)])] = v;
    }
    result.mesh = derive(both, std::move(positions), std::move(faces), map, context);
    return result;
}

}  // namespace

Symmetrized symmetrize(const Mesh& mesh, const SymmetrizeOptions& options, const Context& context) {
    const MirrorPlane plane = mirror_plane(mesh, options);
    Progress progress(context, "symmetrize");
    progress.step(0.5);
    Mesh both = kept_half(mesh, plane, context);
    const Index half = both.vertex_count();
    std::vector<char> on_plane;
    for (Index v = 0; v < half; ++v) on_plane.push_back(is_welded(both, plane, v) ? 1 : 0);
    progress.step(0.5);
    Mesh image = both;
    transform(image, plane.reflection(), context);
    append(both, image, context);
    return welded(both, half, on_plane, context);
}

}  // namespace lissom
