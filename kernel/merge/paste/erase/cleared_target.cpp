#include "kernel/merge/paste/erase/cleared_target.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "kernel/merge/loop/face_angles.h"
#include "kernel/merge/paste/erase/erase_feature.h"
#include "kernel/merge/paste/placement/plane_line.h"
#include "kernel/merge/paste/region/paste_regions.h"
#include "kernel/merge/provenance.h"
#include "kernel/mesh/edit/extract.h"

namespace lissom {

Region region_under(const Mesh& target, const SurfacePoint& point, double radius,
                    const Context& context) {
    context.checkpoint();
    const Topology& topology = target.topology();
    std::vector<char> seen(at(target.vertex_count()), 0);
    std::vector<Index> reached;
    const auto reach = [&](Index v) {
        if (std::exchange(seen[at(v)], 1)) return;
        reached.push_back(v);
    };
    for (const Index v : topology.face(point.face)) reach(v);
    for (std::size_t i = 0; i < reached.size(); ++i) {
        for (const Index n : topology.neighbors(reached[i])) {
            if ((target.position(n) - point.position).norm() <= radius) reach(n);
        }
    }
    return {target.shared_topology(), std::move(reached)};
}

Region region_under_line(const Mesh& target, Index face, const PasteMap& base,
                         std::span<const Vec2> line, const Context& context) {
    const Topology& topology = target.topology();
    std::vector<char> seen(at(target.vertex_count()), 0);
    std::vector<Index> front, under;
    const auto reach = [&](Index v) {
        if (!std::exchange(seen[at(v)], 1)) front.push_back(v);
    };
    for (const Index v : topology.face(face)) reach(v);
    while (!front.empty()) {
        context.checkpoint();
        const std::vector<Index> now = std::move(front);
        front.clear();
        std::vector<Vec2> places;
        for (const Index v : now) places.push_back(base.nearest(target.position(v)).uv);
        const std::vector<char> inside = lie_inside(places, line);
        for (std::size_t i = 0; i < now.size(); ++i) {
            if (!inside[i]) continue;
            under.push_back(now[i]);
            for (const Index n : topology.neighbors(now[i])) reach(n);
        }
    }
    return {target.shared_topology(), std::move(under)};
}

namespace {

// Height of the removed feature over the surface that took its place.
double max_height(const Mesh& target, const Region& gone, const Mesh& closed,
                  Index first_patch_face, const Context& context) {
    std::vector<Index> patch;
    for (Index f = first_patch_face; f < closed.face_count(); ++f) patch.push_back(f);
    if (patch.empty()) return 0.0;
    const SpatialTree surface(extract_faces(closed, patch, context).mesh, context);
    double greatest = 0.0;
    for (const Index v : gone.vertices()) {
        greatest = std::max(greatest, surface.nearest(target.position(v)).distance);
    }
    return greatest;
}

std::vector<Index> removed_faces(const Mesh& target, const MeshMap& map) {
    std::vector<char> kept(at(target.face_count()), 0);
    for (Index f = 0; f < map.faces.size(); ++f) {
        const Index from = map.faces.main_source(f);
        if (from != kNoIndex) kept[at(from)] = 1;
    }
    std::vector<Index> removed;
    for (Index f = 0; f < target.face_count(); ++f) {
        if (!kept[at(f)]) removed.push_back(f);
    }
    return removed;
}

std::optional<Region> region_after(const std::optional<Region>& onto, const Mesh& target,
                                   const ErasedFeature& erased, const Region& gone) {
    if (!onto) return std::nullopt;
    require_same_topology(target, onto->topology(), "the target's region");
    const bool meets = !onto->intersected(gone).empty();
    const std::vector<char> inside = onto->mask();
    std::vector<Index> vertices;
    for (Index v = 0; v < erased.mesh.vertex_count(); ++v) {
        const Index from = erased.map.vertices.main_source(v);
        if (from == kNoIndex ? meets : inside[at(from)] != 0) vertices.push_back(v);
    }
    return Region(erased.mesh.shared_topology(), std::move(vertices));
}

// A patch may turn by this from face to face, whatever the surface around it does.
constexpr double kEvenPatch = 30.0 * kDegree;

// A region with the hollows that it runs around, as nostrils are.
Region with_islands(const Mesh& target, const Region& region, const Context& context) {
    std::vector<Index> vertices = region.vertices();
    for (const Index f : outlined_faces(target, region, context)) {
        for (const Index v : target.topology().face(f)) vertices.push_back(v);
    }
    return {target.shared_topology(), std::move(vertices)};
}

ClearedTarget cleared_by(const Mesh& target, const std::optional<Region>& onto,
                         const Region& marked, const EraseOptions& options,
                         const Context& context) {
    ErasedFeature erased = erase_feature(target, marked, options, context);
    const std::vector<Index> faces = removed_faces(target, erased.map);
    PasteClearing found;
    found.faces = count_of(faces);
    std::vector<Index> vertices;
    for (const Index f : faces) {
        found.area += 0.5 * area_vector(target, f).norm();
        for (const Index v : target.topology().face(f)) vertices.push_back(v);
    }
    Region gone(target.shared_topology(), std::move(vertices));
    found.height = max_height(target, gone, erased.mesh, erased.report.patch.first_face, context);
    std::optional<Region> next = region_after(onto, target, erased, marked);
    const EraseReport& report = erased.report;
    const double unevenness = report.max_dihedral / std::max(kEvenPatch, report.max_around);
    return {std::move(erased.mesh),
            std::move(erased.map),
            std::move(next),
            std::move(gone),
            found,
            unevenness};
}

}  // namespace

ClearedTarget cleared_target(const Mesh& target, const std::optional<Region>& onto,
                             const Region& gone, const Context& context) {
    return cleared_by(target, onto, gone, {}, context);
}

std::optional<ClearedTarget> cleared_around(const Mesh& target, const std::optional<Region>& onto,
                                            const SurfacePoint& point, double radius,
                                            const Context& context) {
    const Region near = region_under(target, point, radius, context);
    try {
        return cleared_by(target, onto, with_islands(target, near, context), {}, context);
    } catch (const Error& error) {
        const ErrorCode code = error.code();
        if (code == ErrorCode::cancelled || code == ErrorCode::memory_limit) throw;
        return std::nullopt;
    }
}

std::optional<ClearedTarget> cleared_inside(const Mesh& target, const std::optional<Region>& onto,
                                            const Region& under, const Context& context) {
    if (under.shrunk(1).faces().empty()) return std::nullopt;
    EraseOptions options;
    options.ring = 0.0;
    return cleared_by(target, onto, with_islands(target, under, context), options, context);
}

}  // namespace lissom
