#include "kernel/deform/constraint_edits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "kernel/deform/holds/mirror.h"
#include "kernel/deform/holds/mirror_surface.h"

namespace lissom {
namespace {

// Beyond these a bent cactus changes by less than a millionth of its size; from 1e6 its systems
// lose so many digits that it shows.
constexpr double kMinStiffness = 1e-4, kMaxStiffness = 1e5;

// In radii of the surface: a part farther from its mirror image has none, and one nearer is the
// same place.
constexpr double kNoMirrorImage = 0.25, kSameMirrorPlace = 1e-3;

// Throws `code` about those of `vertices` for which `bad` holds, if there are any.
template <typename Bad>
void refuse_vertices(const std::vector<Index>& vertices, ErrorCode code, const std::string& message,
                     const Bad& bad) {
    Elements elements{ElementKind::vertex, 0, {}};
    for (const Index v : vertices) {
        if (bad(v)) elements.add(v);
    }
    if (elements.count == 0) return;
    const std::string names = describe(elements);
    throw Error(code, message + names, std::move(elements));
}

void require_topology(const Region& region, const Region& vertices) {
    if (vertices.topology() == region.topology()) return;
    throw Error(ErrorCode::topology_mismatch,
                "the region given belongs to another mesh or to an older version of this one");
}

void require_weight(const std::optional<double>& weight) {
    if (!weight || (*weight > 0.0 && std::isfinite(*weight))) return;
    throw Error(ErrorCode::invalid_argument,
                "a weight must be above 0; leave it out for an exact constraint");
}

void require_handle_options(const HandleOptions& options) {
    if (!options.position && !options.gradient) {
        throw Error(ErrorCode::invalid_argument,
                    "a handle must prescribe positions, gradients or both");
    }
    require_weight(options.weight);
    if (!(options.falloff >= 0.0 && std::isfinite(options.falloff))) {
        throw Error(ErrorCode::invalid_argument, "a falloff must be a distance of 0 or more");
    }
}

void require_finite(const PointConstraint& constraint) {
    if ((!constraint.position || constraint.position->allFinite()) &&
        (!constraint.gradient || constraint.gradient->allFinite())) {
        return;
    }
    Elements vertices{ElementKind::vertex, 0, {}};
    for (const Index v : constraint.point.vertices) vertices.add(v);
    const std::string names = describe(vertices);
    throw Error(ErrorCode::not_finite, names + " cannot be constrained to NaN or infinity",
                std::move(vertices));
}

// Errors: handle_outside_region if no vertex of the point may move.
void require_inside(const Region& region, const MeshPoint& point) {
    const bool inside = std::any_of(point.vertices.begin(), point.vertices.end(),
                                    [&](Index v) { return region.contains(v); });
    if (inside) return;
    refuse_vertices(point.vertices, ErrorCode::handle_outside_region,
                    "a point lies outside the region, between ", [](Index) { return true; });
}

// "handle 2 (12 vertices)": handles count from 1 in the order in which they were made.
std::string handle_text(std::size_t number, std::size_t vertices) {
    return "handle " + std::to_string(number + 1) + " (" + std::to_string(vertices) +
           (vertices == 1 ? " vertex)" : " vertices)");
}

// Errors: handle_overlap if handles but `except`, or targets, hold some of `vertices`, which `who`
// is to hold.
void require_unheld(const RestShape& rest, const ConstraintSet& constraints,
                    const std::vector<Index>& vertices, const std::string& who,
                    std::span<const Index> except = {}) {
    std::vector<char> held(rest.patch().vertex_count, 0);
    for (const auto& target : constraints.targets) {
        if (target->row.size() == 1) held[target->row.front().first] = 1;
    }
    const bool by_target = std::any_of(vertices.begin(), vertices.end(),
                                       [&](Index v) { return held[rest.local_vertex(v)] != 0; });
    std::string holders = by_target ? "a constraint" : "";
    std::vector<char> wanted(held.size(), 0);
    for (const Index v : vertices) wanted[rest.local_vertex(v)] = 1;
    for (std::size_t h = 0; h < constraints.handles.size(); ++h) {
        const bool left_out = std::find(except.begin(), except.end(), index_of(h)) != except.end();
        if (left_out || !constraints.handles[h]) continue;
        const Handle& handle = *constraints.handles[h];
        for (const Index v : handle.local) held[v] = 1;
        const bool meets = std::any_of(handle.local.begin(), handle.local.end(),
                                       [&](Index v) { return wanted[v] != 0; });
        if (!meets) continue;
        holders += (holders.empty() ? "" : ", ") + handle_text(h, handle.region.size());
    }
    refuse_vertices(vertices, ErrorCode::handle_overlap,
                    who + " overlaps " + holders + "; leave out of one of them ",
                    [&](Index v) { return held[rest.local_vertex(v)] != 0; });
}

SparseRow local_row(const RestShape& rest, const MeshPoint& point) {
    SparseRow row;
    for (std::size_t i = 0; i < point.vertices.size(); ++i) {
        row.emplace_back(rest.local_vertex(point.vertices[i]), point.weights[i]);
    }
    return row;
}

bool before(const Target& a, const Target& b) {
    if (a.is_hard_vertex() != b.is_hard_vertex()) return a.is_hard_vertex();
    return a.row < b.row;
}

}  // namespace

HandleId ConstraintEdit::add(Handle handle, const HandlePose& pose) {
    handle.center = rest.center_of(handle);
    constraints.handles.push_back(std::make_shared<const Handle>(std::move(handle)));
    poses.handles.push_back(pose);
    return {count_of(constraints.handles) - 1};
}

// Errors: as add_handle, beside the handles with numbers in `except`.
void ConstraintEdit::require_handle_region(const Region& vertices,
                                           std::span<const Index> except) const {
    require_topology(rest.region(), vertices);
    if (vertices.empty()) throw Error(ErrorCode::region_empty, "the handle has no vertices");
    refuse_vertices(vertices.vertices(), ErrorCode::handle_outside_region,
                    "the handle reaches outside the region at ",
                    [&](Index v) { return !rest.region().contains(v); });
    const std::size_t number = except.empty() ? constraints.handles.size() : at(except.front());
    require_unheld(rest, constraints, vertices.vertices(), handle_text(number, vertices.size()),
                   except);
}

HandleId ConstraintEdit::add_handle(const Region& vertices, const HandleOptions& options) {
    require_handle_options(options);
    require_handle_region(vertices);
    Handle handle{vertices, options};
    for (const Index v : vertices.vertices()) handle.local.push_back(rest.local_vertex(v));
    return add(std::move(handle), {});
}

HandleId ConstraintEdit::add_handle(std::span<const MeshPoint> points,
                                    const HandleOptions& options) {
    if (points.empty()) throw Error(ErrorCode::region_empty, "the handle has no points");
    require_handle_options(options);
    const auto& topology = rest.region().topology();
    std::vector<Index> held, around;
    std::vector<SparseRow> rows;
    for (const MeshPoint& given : points) {
        const MeshPoint point = checked_point(*topology, given);
        require_inside(rest.region(), point);
        around.insert(around.end(), point.vertices.begin(), point.vertices.end());
        if (point.vertices.size() == 1) {
            held.push_back(point.vertices.front());
        } else {
            rows.push_back(local_row(rest, point));
        }
    }
    require_unheld(rest, constraints, held, handle_text(constraints.handles.size(), held.size()));
    Handle handle{Region(topology, around), options};
    const Region held_region(topology, held);
    for (const Index v : held_region.vertices()) handle.local.push_back(rest.local_vertex(v));
    handle.points = std::move(rows);
    return add(std::move(handle), {});
}

void ConstraintEdit::set_handle_region(HandleId id, const Region& vertices) {
    Handle changed = handle_of(constraints, id);
    const Index partner = changed.partner;
    require_handle_region(vertices, std::array{id.value, partner});
    changed.region = vertices;
    changed.points.clear();
    changed.local.clear();
    for (const Index v : vertices.vertices()) changed.local.push_back(rest.local_vertex(v));
    changed.center = rest.center_of(changed);
    if (partner != kNoIndex) {
        constraints.handles[partner] =
            std::make_shared<const Handle>(mirror_image(id.value, changed, changed.mirror));
        poses.handles[partner] = reflected(rest, changed.mirror, poses.handles[id.value]);
    }
    constraints.handles[id.value] = std::make_shared<const Handle>(std::move(changed));
}

// Vertices that the image holds. Errors: invalid_argument if most of it lies beside the region, or
// the plane leaves no surface near it.
std::vector<Index> ConstraintEdit::mirrored_vertices(const MirrorSurface& surface,
                                                     const Handle& handle) const {
    if (handle.local.empty()) return {};
    const Patch& patch = rest.patch();
    MirroredVertices found = surface.mirrored(handle.local);
    const double farthest = kNoMirrorImage * rest.work->radius;
    std::vector<Index> alone;
    for (std::size_t i = 0; i < handle.local.size(); ++i) {
        const bool is_outside = std::find(found.outside.begin(), found.outside.end(),
                                          handle.local[i]) != found.outside.end();
        if (is_outside || found.distances[i] > farthest) {
            alone.push_back(patch.mesh_vertex[at(handle.local[i])]);
        }
    }
    if (2 * alone.size() < handle.local.size()) return std::move(found.vertices);
    refuse_vertices(
        alone, ErrorCode::invalid_argument,
        "the region has no surface at the mirror image; let the plane go through the "
        "middle of the shape, and the region reach both sides of it: without image are ",
        [](Index) { return true; });
    return {};
}

// The mirror image of a point in a face: of the same weights if its vertices have counterparts.
SparseRow ConstraintEdit::mirrored_point(const MirrorSurface& surface, const SparseRow& row,
                                         const MirrorPlane& plane) const {
    const Patch& patch = rest.patch();
    std::vector<Index> around;
    for (const auto& [v, c] : row) around.push_back(v);
    const Affine mirror = reflection({plane.point - patch.origin, plane.normal, 0.0});
    const std::vector<Index> across = counterparts(patch.rest, around, patch.of_region, mirror,
                                                   kSameMirrorPlace * rest.work->radius);
    SparseRow image;
    if (std::find(across.begin(), across.end(), kNoIndex) == across.end()) {
        for (std::size_t i = 0; i < row.size(); ++i) image.emplace_back(across[i], row[i].second);
    } else {
        const MirrorFoot foot = surface.foot_of(rest.position_of(row));
        for (int i = 0; i < 3; ++i) {
            if (foot.barycentric[i] > 0.0) {
                image.emplace_back(foot.corners[at(i)], foot.barycentric[i]);
            }
        }
    }
    std::sort(image.begin(), image.end());
    return image;
}

// Vertices shared by a handle and its image go to the handle, unless it reaches its plane.
// Errors: handle_overlap then.
void ConstraintEdit::part_from_image(const Handle& handle, Handle& image) const {
    const Patch& patch = rest.patch();
    const Vec3 normal = image.mirror.normal.normalized();
    const auto height = [&](const Vec3& p) { return normal.dot(p - image.mirror.point); };
    const double side = height(handle.center) < 0.0 ? -1.0 : 1.0;
    std::vector<Index> shared;
    bool reaches = false;
    const auto share = [&](Index v) {
        if (!handle.region.contains(patch.mesh_vertex[at(v)])) return;
        shared.push_back(patch.mesh_vertex[at(v)]);
        const double above = side * height(patch.rest[at(v)] + patch.origin);
        reaches = reaches || above <= kSameMirrorPlace * rest.work->radius;
    };
    for (const Index v : image.local) share(v);
    for (const SparseRow& row : image.points) {
        for (const auto& [v, c] : row) share(v);
    }
    if (reaches || (!shared.empty() && shared.size() == image.local.size())) {
        refuse_vertices(
            shared, ErrorCode::handle_overlap,
            "the handle overlaps its mirror image; leave out the part near the plane, as ",
            [](Index) { return true; });
    }
    std::erase_if(image.local,
                  [&](Index v) { return handle.region.contains(patch.mesh_vertex[at(v)]); });
}

// The rim of an image found on another tessellation yields vertices that others hold, unless that
// takes most of it; vertices that are exact counterparts do not.
void ConstraintEdit::yield_to_others(const Handle& handle, Index number, Handle& image) const {
    const Patch& patch = rest.patch();
    const Affine mirror = reflection({image.mirror.point - patch.origin, image.mirror.normal, 0.0});
    std::vector<char> fixed(patch.rest.size(), 0), held(patch.rest.size(), 0);
    for (const Index v : counterparts(patch.rest, handle.local, patch.of_region, mirror,
                                      kSameMirrorPlace * rest.work->radius)) {
        if (v != kNoIndex) fixed[at(v)] = 1;
    }
    for (std::size_t h = 0; h < constraints.handles.size(); ++h) {
        const bool is_own = index_of(h) == number || index_of(h) == handle.partner;
        if (is_own || !constraints.handles[h]) continue;
        for (const Index v : constraints.handles[h]->local) held[at(v)] = 1;
    }
    for (const auto& target : constraints.targets) {
        if (target->row.size() == 1) held[at(target->row.front().first)] = 1;
    }
    std::vector<Index> left = image.local;
    std::erase_if(left, [&](Index v) { return held[at(v)] && !fixed[at(v)]; });
    if (2 * left.size() > image.local.size()) image.local = std::move(left);
}

// The mirror image of a handle, which keeps clear of that handle and of all others but its present
// image.
Handle ConstraintEdit::mirror_image(Index number, const Handle& handle,
                                    const MirrorPlane& plane) const {
    const Patch& patch = rest.patch();
    const MirrorSurface surface(patch, reflection({plane.point - patch.origin, plane.normal, 0.0}));
    Handle image = handle;
    image.mirror = plane;
    image.local = mirrored_vertices(surface, handle);
    for (SparseRow& row : image.points) row = mirrored_point(surface, row, plane);
    part_from_image(handle, image);
    yield_to_others(handle, number, image);
    std::vector<Index> vertices, held;
    for (const Index v : image.local) held.push_back(patch.mesh_vertex[at(v)]);
    vertices = held;
    for (const SparseRow& row : image.points) {
        for (const auto& [v, c] : row) vertices.push_back(patch.mesh_vertex[at(v)]);
    }
    require_unheld(rest, constraints, held,
                   "the mirror image of " + handle_text(at(number), handle.region.size()),
                   std::array{number, handle.partner});
    image.partner = number;
    image.region = Region(rest.region().topology(), vertices);
    image.center = rest.center_of(image);
    return image;
}

HandleId ConstraintEdit::mirror_handle(HandleId id, const MirrorPlane& plane) {
    Handle handle = handle_of(constraints, id);
    if (handle.partner != kNoIndex) {
        throw Error(ErrorCode::invalid_argument, "the handle has a mirror image already");
    }
    const HandleId added =
        add(mirror_image(id.value, handle, plane), reflected(rest, plane, poses.handles[id.value]));
    handle.partner = added.value;
    handle.mirror = plane;
    constraints.handles[id.value] = std::make_shared<const Handle>(std::move(handle));
    return added;
}

void ConstraintEdit::remove_handle(HandleId id) {
    const Index partner = handle_of(constraints, id).partner;
    constraints.handles[id.value] = nullptr;
    poses.handles[id.value] = {};
    std::erase_if(constraints.bones, [&](const auto& bones) {
        return std::find(bones->handles.begin(), bones->handles.end(), id) != bones->handles.end();
    });
    if (partner == kNoIndex) return;
    Handle alone = *constraints.handles[partner];
    alone.partner = kNoIndex;
    constraints.handles[partner] = std::make_shared<const Handle>(std::move(alone));
}

void ConstraintEdit::add_bones(Bones bones) {
    const std::size_t count = bones.handles.size();
    require(count > 0 && bones.joints.size() == count + 1 &&
                (bones.limits.empty() || bones.limits.size() == count),
            "bones have one joint more than handles, and one limit for each of these or none");
    for (std::size_t i = 0; i <= count; ++i) {
        require(bones.joints[i].allFinite(), "a joint is not finite", ErrorCode::not_finite);
        require(i == 0 || bones.joints[i] != bones.joints[i - 1],
                "bone " + std::to_string(i) + " has no length");
    }
    for (const double limit : bones.limits) {
        require(limit >= 0.0 && limit <= kPi + 1e-9, "limits are angles from 0 to 180 degrees");
    }
    for (auto handle = bones.handles.begin(); handle != bones.handles.end(); ++handle) {
        (void)handle_of(constraints, *handle);
        bool is_taken = std::find(bones.handles.begin(), handle, *handle) != handle;
        for (const auto& other : constraints.bones) {
            const auto& taken = other->handles;
            is_taken = is_taken || std::find(taken.begin(), taken.end(), *handle) != taken.end();
        }
        require(!is_taken, "a handle belongs to one bone at most");
    }
    constraints.bones.push_back(std::make_shared<const Bones>(std::move(bones)));
}

void ConstraintEdit::set_stiffness(const Region& vertices, double factor) {
    require_topology(rest.region(), vertices);
    if (!(factor >= kMinStiffness && factor <= kMaxStiffness)) {
        throw Error(ErrorCode::invalid_argument,
                    "a stiffness must be from 1e-4, without resistance, to 1e5, rigid; 1 is as "
                    "usual");
    }
    refuse_vertices(vertices.vertices(), ErrorCode::handle_outside_region,
                    "outside the region there is nothing to make stiff, at ",
                    [&](Index v) { return !rest.region().contains(v); });
    auto stiffness = constraints.stiffness
                         ? std::make_shared<std::vector<double>>(*constraints.stiffness)
                         : std::make_shared<std::vector<double>>(at(rest.patch().real_count), 1.0);
    for (const Index v : vertices.vertices()) (*stiffness)[rest.local_vertex(v)] = factor;
    constraints.stiffness = std::move(stiffness);
}

void ConstraintEdit::set_target(Target target, const TargetPose& pose) {
    if (const TargetPlace old = find_target(constraints, target); old.found) {
        const auto place = static_cast<std::ptrdiff_t>(old.at);
        constraints.targets.erase(constraints.targets.begin() + place);
        poses.targets.erase(poses.targets.begin() + place);
    }
    if (!target.position && !target.gradient) return;
    const auto place = static_cast<std::ptrdiff_t>(find_target(constraints, target).at);
    constraints.targets.insert(constraints.targets.begin() + place,
                               std::make_shared<const Target>(std::move(target)));
    poses.targets.insert(poses.targets.begin() + place, pose);
}

Target checked_target(const RestShape& rest, const ConstraintSet& constraints,
                      const PointConstraint& given) {
    require_weight(given.weight);
    PointConstraint asked = given;
    asked.point = checked_point(*rest.region().topology(), given.point);
    require_inside(rest.region(), asked.point);
    require_finite(asked);
    Target target{asked.point, local_row(rest, asked.point), asked.position.has_value(),
                  asked.gradient.has_value(), asked.weight};
    if (target.row.size() > 1) return target;
    for (const auto& handle : constraints.handles) {
        if (!handle) continue;
        const bool held = std::find(handle->local.begin(), handle->local.end(),
                                    target.row.front().first) != handle->local.end();
        if (held) require_unheld(rest, constraints, asked.point.vertices, "a constraint");
    }
    return target;
}

// A point may have been asked for as a hard vertex before, and softly now.
TargetPlace find_target(const ConstraintSet& constraints, const Target& target) {
    const auto place_of = [&](const Target& of) -> TargetPlace {
        const auto place =
            std::lower_bound(constraints.targets.begin(), constraints.targets.end(), of,
                             [](const auto& a, const Target& b) { return before(*a, b); });
        return {at(place - constraints.targets.begin()),
                place != constraints.targets.end() && !before(of, **place)};
    };
    const TargetPlace place = place_of(target);
    if (place.found || target.row.size() > 1) return place;
    Target other = target;
    other.weight = target.weight ? std::nullopt : std::optional(1.0);
    const TargetPlace elsewhere = place_of(other);
    return elsewhere.found ? elsewhere : place;
}

Poses resting_poses(const RestShape& rest, const ConstraintSet& constraints) {
    Poses poses{std::vector<HandlePose>(constraints.handles.size()), {}};
    for (const auto& target : constraints.targets) {
        const Vec3 at = target->is_hard_vertex()
                            ? rest.positions[rest.region_row[target->row.front().first]]
                            : Vec3(rest.position_of(target->row) + rest.origin());
        poses.targets.push_back({at, Mat3::Identity()});
    }
    return poses;
}

ConstraintSet moved_to(const RestShape& rest, const ConstraintSet& constraints,
                       const Poses& poses) {
    ConstraintSet moved = constraints;
    for (auto& bones : moved.bones) {
        Bones next = *bones;
        const auto map = [&](std::size_t i) -> const Affine& {
            return poses.handles[at(next.handles[i].value)].transform;
        };
        const std::size_t count = next.handles.size();
        for (std::size_t i = 0; i < count; ++i) next.joints[i] = map(i)(next.joints[i]);
        next.joints[count] = map(count - 1)(next.joints[count]);
        bones = std::make_shared<const Bones>(std::move(next));
    }
    for (auto& handle : moved.handles) {
        if (!handle) continue;
        Handle next = *handle;
        next.center = rest.center_of(next);
        handle = std::make_shared<const Handle>(std::move(next));
    }
    return moved;
}

}  // namespace lissom
