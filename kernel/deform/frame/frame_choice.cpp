// A refinement is taken back as far as it runs the surface through itself, which without it does
// not.
#include <algorithm>
#include <array>
#include <utility>

#include "kernel/deform/frame/frame_steps.h"
#include "kernel/mesh/query/self_intersections.h"

namespace lissom {
namespace {

// With quads as such, which count as the mesh's do.
FaceList faces_of(const WeightedTriangles& triangles) {
    FaceList faces;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const Triangle& c = triangles.triangle[t];
        if (triangles.weight[t] == 1.0) {
            faces.add(c);
        } else if (t % 4 == 0) {
            faces.add(std::array{c[0], c[1], c[2], triangles.triangle[t + 1][2]});
        }
    }
    return faces;
}

std::shared_ptr<const Topology> surface_of(const Patch& patch) {
    std::vector<Vec3> rest(patch.rest.begin(), patch.rest.begin() + patch.real_count);
    return Mesh(std::move(rest), faces_of(patch.triangles)).shared_topology();
}

std::vector<Index> moving_faces(const Topology& surface, const KnownMask& known) {
    std::vector<Index> moving;
    for (Index f = 0; f < surface.face_count(); ++f) {
        const std::span<const Index> face = surface.face(f);
        if (std::any_of(face.begin(), face.end(), [&](Index v) { return !known.position[at(v)]; }))
            moving.push_back(f);
    }
    return moving;
}

void between(const Deviation& first, const Deviation& last, double share, Deviation& result) {
    for (std::size_t v = 0; v < first.size(); ++v) {
        result[v] = first[v] + share * (last[v] - first[v]);
    }
}

}  // namespace

RefinementChoice::RefinementChoice(const SecondInput& input, FrameScratch::State& scratch,
                                   const Context& context)
    : input_(input), context_(context) {
    const Preparation& prepared = input.motion.prepared();
    if (scratch.surface_of.lock() != prepared.work) {
        scratch.surface = surface_of(prepared.patch());
        scratch.surface_of = prepared.work;
    }
    surface_ = scratch.surface;
    moving_ = moving_faces(*surface_, prepared.known);
}

void RefinementChoice::offer(const Deviation& result) {
    results_.push_back(result);
}

// Halving keeps a path of poses from jumping where the refined surface begins to touch itself.
void RefinementChoice::choose(Deviation& result) {
    if (results_.size() < 2) return;
    const Deviation &plain = results_.front(), &refined = results_.back();
    if (crossings(refined) == 0 || crossings(plain) > 0) return;
    constexpr int kHalvings = 5;
    double kept = 0.0, step = 0.5;
    for (int n = 0; n < kHalvings; ++n, step *= 0.5) {
        between(plain, refined, kept + step, result);
        if (crossings(result) == 0) kept += step;
    }
    between(plain, refined, kept, result);
}

Index RefinementChoice::crossings(const Deviation& result) const {
    const Motion& motion = input_.motion;
    const Patch& patch = motion.patch();
    const Vec3 shift = motion.base().topRightCorner<3, 1>();
    std::vector<Vec3> positions(at(patch.real_count));
    for (Index v = 0; v < patch.real_count; ++v) {
        positions[at(v)] =
            motion.prepared().known.position[at(v)]
                ? motion.known_position(v)
                : Vec3(input_.base_rotation * patch.rest[at(v)] + shift + result[at(v)].head<3>());
    }
    SelfIntersectionOptions options;
    options.faces = moving_;
    return count_of(self_intersections(Mesh(std::move(positions), surface_), options, context_));
}

}  // namespace lissom
