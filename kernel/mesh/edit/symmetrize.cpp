#include "kernel/mesh/edit/symmetrize.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "kernel/mesh/cut/cut.h"
#include "kernel/mesh/derive.h"
#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/measure/short_number.h"

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

// The part on the kept side, and whether each of its vertices is on the plane.
struct Half {
    Mesh mesh;
    std::vector<char> on_plane;
};

void snap(Half& half, const MirrorPlane& plane) {
    std::vector<Vec3> positions(half.mesh.positions().begin(), half.mesh.positions().end());
    for (Index v = 0; v < half.mesh.vertex_count(); ++v) {
        if (half.on_plane[at(v)]) positions[at(v)] = plane.onto(positions[at(v)]);
    }
    half.mesh.set_positions(std::move(positions));
}

Half with_snapped_borders(Mesh mesh, const MirrorPlane& plane) {
    Half half{std::move(mesh), {}};
    for (Index v = 0; v < half.mesh.vertex_count(); ++v) {
        half.on_plane.push_back(is_welded(half.mesh, plane, v) ? 1 : 0);
    }
    snap(half, plane);
    return half;
}

// Whether an edge on the plane has the surface on both sides: four faces would meet there.
bool touches_plane(const Half& half) {
    const Topology& topology = half.mesh.topology();
    std::set<std::pair<Index, Index>> border;
    for (const std::vector<Index>& loop : topology.boundary_loops()) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            border.insert(std::minmax({loop[i], loop[(i + 1) % loop.size()]}));
        }
    }
    for (Index e = 0; e < topology.edge_count(); ++e) {
        const auto [a, b] = topology.edge(e);
        if (half.on_plane[at(a)] && half.on_plane[at(b)] &&
            !border.contains({std::min(a, b), std::max(a, b)})) {
            return true;
        }
    }
    return false;
}

// The surface is on the kept side only; away from the plane its image would be a second piece.
void require_plane_at(const Mesh& mesh, const MirrorPlane& plane) {
    double nearest = std::numeric_limits<double>::infinity();
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (!mesh.topology().is_isolated(v)) {
            nearest = std::min(nearest, plane.distance(mesh.position(v)));
        }
    }
    require(nearest <= plane.weld,
            "the plane is beside the mesh, " + short_number(nearest) +
                " away, so that the halves would not join; move the plane, or give a 'weld' above "
                "that");
}

Half kept_half(const Mesh& mesh, const MirrorPlane& plane, double slide, const Context& context) {
    Half half = with_snapped_borders(mesh, plane);
    double low = 0.0, high = 0.0;
    for (const Vec3& p : half.mesh.positions()) {
        low = std::min(low, plane.distance(p));
        high = std::max(high, plane.distance(p));
    }
    const double rounding = kPlaneRounding * (high - low + plane.point.norm());
    require(high > rounding,
            "nothing of the mesh lies on the side of the plane that is kept; turn its normal");
    if (low >= -rounding) {
        require_plane_at(half.mesh, plane);
        return half;
    }
    const CutPlane by{.point = plane.point, .normal = plane.normal};
    Cut made = cut(half.mesh, by, {.loops = CutLoops::all, .slide = slide}, context);
    half = with_snapped_borders(std::move(made.kept.mesh), plane);
    // Vertices that could not slide onto the line without a fold are beside the plane.
    for (const CutLine& line : made.lines) {
        for (const Index v : line.kept.vertices()) half.on_plane[at(v)] = 1;
    }
    snap(half, plane);
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
    Half half = kept_half(mesh, plane, CutOptions{}.slide, context);
    if (touches_plane(half)) half = kept_half(mesh, plane, 0.0, context);
    require(!touches_plane(half),
            "the surface goes on to both sides of an edge on the plane; move the plane a little",
            ErrorCode::boundary_conflict);
    progress.step(0.5);
    Mesh both = half.mesh, image = half.mesh;
    transform(image, plane.reflection(), context);
    append(both, image, context);
    return welded(both, half.mesh.vertex_count(), half.on_plane, context);
}

}  // namespace lissom
