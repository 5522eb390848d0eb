#include "kernel/deform/holds/loose_parts.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "kernel/mesh/query/spatial_tree.h"

namespace lissom {
namespace {

void make_known(const Patch& patch, const std::vector<Index>& part, HolderMap& holding) {
    for (const Index v : part) {
        holding.owner[at(v)] = kLoose;
        holding.known.position[at(v)] = 1;
        holding.known.gradient[at(v)] = v < patch.first_normal_point();
        holding.known.gradient_wanted[at(v)] = 0;
    }
}

// Vertices of the region without faces that no handle holds are parts by themselves.
std::vector<std::vector<Index>> single_vertices(const WorkingPatch& work,
                                                const HolderMap& holding) {
    std::vector<std::vector<Index>> single;
    for (const Index v : work.patch.of_region) {
        if (work.rings.count(v) == 0 && holding.owner[at(v)] == kPinned) single.push_back({v});
    }
    return single;
}

// The first local vertex of the connected part of each.
std::vector<Index> parts_of(const WorkingPatch& work) {
    std::vector<Index> part(at(work.patch.real_count), kNoIndex), stack;
    for (Index start = 0; start < work.patch.real_count; ++start) {
        if (part[at(start)] != kNoIndex) continue;
        part[at(start)] = start;
        stack.push_back(start);
        while (!stack.empty()) {
            const Index v = stack.back();
            stack.pop_back();
            for (const Index n : work.rings.ring(v)) {
                if (n >= work.patch.real_count || part[at(n)] != kNoIndex) continue;
                part[at(n)] = start;
                stack.push_back(n);
            }
        }
    }
    return part;
}

// The surface that is held as triangles apart from each other: a patch need not be a
// manifold, as two quads may have the same diagonal. A quad has the triangles of one diagonal.
struct HeldSurface {
    Mesh triangles;
    /// The vertex of the patch that each vertex stands for.
    std::vector<Index> stands_for;
};

HeldSurface held_surface(const Patch& patch, const HolderMap& holding) {
    HeldSurface result;
    std::vector<Vec3> positions;
    FaceList faces;
    for (std::size_t t = 0; t < patch.triangles.size(); ++t) {
        const Triangle& corners = patch.triangles.triangle[t];
        if (holding.owner[at(corners[0])] == kLoose) continue;
        if (patch.triangles.weight[t] != 1.0 && t % 2 != 0) continue;
        const Index first = count_of(positions);
        for (const Index v : corners) {
            positions.push_back(patch.rest[at(v)]);
            result.stands_for.push_back(v);
        }
        faces.add({first, first + 1, first + 2});
    }
    result.triangles = Mesh(std::move(positions), std::move(faces));
    return result;
}

class Binder {
  public:
    Binder(const WorkingPatch& work, const HolderMap& holding, const Context& context)
        : patch_(work.patch),
          holding_(holding),
          part_(parts_of(work)),
          surface_(held_surface(work.patch, holding)) {
        if (surface_.triangles.face_count() > 0) tree_.emplace(surface_.triangles, context);
    }

    // Without a surface to follow it stays.
    FollowingPart bind(std::vector<Index> members) const {
        FollowingPart result{std::move(members), {}, kPinned};
        if (!tree_) return result;
        std::vector<SurfacePoint> nearest;
        for (const Index v : result.members) {
            if (v < patch_.real_count) nearest.push_back(tree_->nearest(patch_.rest[at(v)]));
        }
        const auto first = std::min_element(
            nearest.begin(), nearest.end(),
            [](const SurfacePoint& a, const SurfacePoint& b) { return a.distance < b.distance; });
        const Index followed = part_[at(vertex(first->vertex))];
        for (const SurfacePoint& point : nearest) {
            if (part_[at(vertex(point.vertex))] != followed) continue;
            for (const Index v : point.triangle) result.guides.push_back(vertex(v));
        }
        std::sort(result.guides.begin(), result.guides.end());
        result.guides.erase(std::unique(result.guides.begin(), result.guides.end()),
                            result.guides.end());
        result.owner = owner_of(result.guides);
        return result;
    }

  private:
    Index vertex(Index of_triangles) const { return surface_.stands_for[at(of_triangles)]; }

    Index owner_of(const std::vector<Index>& guides) const {
        const Index owner = holding_.owner[at(guides.front())];
        const bool common = std::all_of(guides.begin(), guides.end(), [&](Index v) {
            return holding_.owner[at(v)] == owner && holding_.known.position[at(v)] &&
                   holding_.known.gradient[at(v)];
        });
        return common && owner != kConstrained ? owner : kFree;
    }

    const Patch& patch_;
    const HolderMap& holding_;
    std::vector<Index> part_;
    HeldSurface surface_;
    std::optional<SpatialTree> tree_;
};

}  // namespace

std::vector<FollowingPart> hold_loose_parts(const WorkingPatch& work, UnheldParts loose,
                                            HolderMap& holding, const Context& context) {
    if (loose == UnheldParts::error) return {};
    std::vector<std::vector<Index>> parts = loose_parts(work, holding.known);
    for (const std::vector<Index>& part : parts) make_known(work.patch, part, holding);
    if (loose == UnheldParts::stay) return {};
    for (std::vector<Index>& single : single_vertices(work, holding)) {
        make_known(work.patch, single, holding);
        parts.push_back(std::move(single));
    }
    if (parts.empty()) return {};
    const Binder binder(work, holding, context);
    std::vector<FollowingPart> following;
    for (std::vector<Index>& part : parts) following.push_back(binder.bind(std::move(part)));
    return following;
}

}  // namespace lissom
