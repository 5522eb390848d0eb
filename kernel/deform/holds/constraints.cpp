#include "kernel/deform/holds/constraints.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "kernel/deform/holds/boundary_refinement.h"

namespace lissom {
namespace {

// Positions flatter than this, by their covariance, count as one plane.
constexpr double kFlat = 1e-10;

constexpr const char* kLooseRemedy =
    "; loose = 'stay' leaves such parts in place, loose = 'follow' takes them along";

// Constraints of one connected part of the patch.
struct Part {
    /// Local vertices, and those of the mesh that are free.
    std::vector<Index> members, free;
    bool has_gradient = false;
    double positions = 0.0;
    Vec3 sum = Vec3::Zero();
    Mat3 products = Mat3::Zero();

    bool spans_space() const {
        if (positions < 4.0) return false;
        const Mat3 covariance =
            products / positions - sum * sum.transpose() / (positions * positions);
        const Vec3 values =
            Eigen::SelfAdjointEigenSolver<Mat3>(covariance, Eigen::EigenvaluesOnly).eigenvalues();
        return values[0] > kFlat * values[2];
    }
};

// Which anchors each vertex is tied to, each counted at one vertex, and whether its gradient is.
struct TiesOfVertices {
    std::multimap<Index, Index> anchors;
    std::set<Index> turned;

    explicit TiesOfVertices(const WorkingPatch& work) {
        for (Index t = 0; t < work.ties.size(); ++t) {
            anchors.emplace(work.ties.row[t].front().first, work.ties.anchor[t]);
        }
        for (const GradientTie& tie : work.gradient_ties) turned.insert(tie.vertex);
    }
};

void add_position(const Vec3& at, Part& part) {
    part.positions += 1.0;
    part.sum += at;
    part.products += at * at.transpose();
}

void add_vertex(const Patch& patch, const TiesOfVertices& ties, const KnownMask& known, Index v,
                Part& part) {
    if (v >= patch.first_normal_point()) return;
    part.has_gradient = part.has_gradient || known.gradient[v] || ties.turned.count(v) > 0;
    if (known.position[v]) {
        add_position(patch.rest[v], part);
    } else if (v < patch.mesh_count()) {
        part.free.push_back(patch.mesh_vertex[v]);
    }
    const auto [first, last] = ties.anchors.equal_range(v);
    for (auto tie = first; tie != last; ++tie) add_position(patch.rest[tie->second], part);
}

Part collect_part(const WorkingPatch& work, const TiesOfVertices& ties, const KnownMask& known,
                  Index start, std::vector<char>& seen) {
    Part part;
    std::vector<Index> stack{start};
    seen[start] = 1;
    while (!stack.empty()) {
        const Index v = stack.back();
        stack.pop_back();
        part.members.push_back(v);
        add_vertex(work.patch, ties, known, v, part);
        for (const Index n : work.rings.ring(v)) {
            if (!std::exchange(seen[n], 1)) stack.push_back(n);
        }
    }
    return part;
}

bool is_loose(const Part& part) {
    return !part.free.empty() && part.positions == 0.0 && !part.has_gradient;
}

bool is_held(const Part& part) {
    if (part.free.empty()) return true;
    return part.positions > 0.0 && (part.has_gradient || part.spans_space());
}

[[noreturn]] void refuse_part(Part part) {
    std::sort(part.free.begin(), part.free.end());
    Elements vertices{ElementKind::vertex, 0, {}};
    for (const Index v : part.free) vertices.add(v);
    const std::string names = describe(vertices);
    const std::string remedy =
        part.positions == 0.0
            ? "no position is prescribed; add a handle there, let the region of one hold a vertex "
              "of it, or leave a part out of the region"
            : "its positions alone do not say how it turns; prescribe a gradient, or four "
              "positions "
              "that are not in one plane";
    throw Error(ErrorCode::unconstrained,
                "nothing holds the connected part of " + names + ": " + remedy +
                    (part.positions == 0.0 ? kLooseRemedy : ""),
                std::move(vertices));
}

// One vertex of each part.
[[noreturn]] void refuse_parts(const std::vector<Part>& parts) {
    Elements vertices{ElementKind::vertex, 0, {}};
    for (const Part& part : parts) {
        vertices.add(*std::min_element(part.free.begin(), part.free.end()));
    }
    const std::string names = describe(vertices);
    throw Error(ErrorCode::unconstrained,
                "nothing holds " + std::to_string(parts.size()) + " connected parts, those of " +
                    names +
                    ": each needs a handle; let the region of one hold a vertex of each part that "
                    "is to move along, or leave parts out of the region" +
                    kLooseRemedy,
                std::move(vertices));
}

HolderMap pin_outside_region(const WorkingPatch& work) {
    const std::size_t n = work.patch.vertex_count;
    const std::vector<char> none(n, 0);
    HolderMap holding{std::vector<Index>(n, kFree), {none, none, none}, {}};
    for (Index i = 0; i < work.patch.surface_count; ++i) {
        if (work.patch.in_region[i] && work.rings.count(i) > 0) continue;
        holding.owner[i] = kPinned;
        holding.known.position[i] = holding.known.gradient[i] = 1;
    }
    return holding;
}

// Vertices without faces follow a soft handle as they follow a hard one.
void hold_handle(const WorkingPatch& work, const Handle& handle, Index h, HolderMap& holding) {
    for (const Index v : handle.local) {
        const bool isolated = work.rings.count(v) == 0;
        if (handle.soft() && !isolated) continue;
        holding.owner[v] = h;
        holding.known.position[v] = handle.options.position || isolated;
        holding.known.gradient[v] = handle.options.gradient;
    }
}

// Vertices of a refinement between vertices of one holder are its own.
void hold_inserted(const Patch& patch, HolderMap& holding) {
    for (Index v = patch.mesh_count(); v < patch.real_count; ++v) {
        const SparseRow& row = patch.inserted[v - patch.mesh_count()];
        const Index holder = common_holder(row, holding), first = row.front().first;
        if (holder == kFree) continue;
        holding.owner[v] = holder;
        holding.known.position[v] = 1;
        holding.known.gradient[v] = holding.known.gradient[first];
    }
}

// Gives free vertices around a point its gradient.
void turn_around(const SparseRow& row, Index owner, Index point, HolderMap& holding) {
    for (const auto& [v, c] : row) {
        if (holding.owner[v] != kFree) continue;
        holding.owner[v] = owner;
        holding.known.gradient[v] = 1;
        if (point != kNoIndex) holding.asked.emplace_back(v, point);
    }
}

// A normal point is free as long as its vertex needs a gradient: nothing else asks for it.
void hold_normal_points(const Patch& patch, HolderMap& holding) {
    for (std::size_t k = 0; k < patch.normal_points.size(); ++k) {
        const Index point = patch.first_normal_point() + index_of(k), v = patch.normal_points[k];
        const bool free = holding.known.gradient_wanted[at(v)] != 0;
        // Demands on a constrained vertex are not demands on its point.
        const Index owner = holding.owner[at(v)] == kConstrained ? kPinned : holding.owner[at(v)];
        holding.owner[at(point)] = free ? kFree : owner;
        holding.known.position[at(point)] = !free;
        holding.known.gradient[at(point)] = holding.known.gradient_wanted[at(point)] = 0;
    }
}

void hold_anchors(const WorkingPatch& work, HolderMap& holding) {
    for (Index v = work.patch.surface_count; v < work.patch.vertex_count; ++v) {
        const Index anchor = v - work.patch.surface_count;
        holding.owner[v] = work.anchor_owner[anchor];
        holding.known.position[v] = holding.known.gradient[v] = 1;
        const Index point = work.anchor_point[anchor];
        if (point != kNoIndex) holding.asked.emplace_back(v, point);
    }
}

}  // namespace

bool changes_patch(const ConstraintSet& constraints, double transition) {
    return constraints.stiffness || transition > 0.0 ||
           std::any_of(constraints.targets.begin(), constraints.targets.end(),
                       [](const auto& target) { return !target->is_hard_vertex(); }) ||
           std::any_of(constraints.handles.begin(), constraints.handles.end(), [](const auto& h) {
               return h && (h->soft() || !h->points.empty() || h->options.falloff > 0.0);
           });
}

HolderMap find_holding(const WorkingPatch& work, const ConstraintSet& constraints) {
    HolderMap holding = pin_outside_region(work);
    for (std::size_t h = 0; h < constraints.handles.size(); ++h) {
        if (constraints.handles[h])
            hold_handle(work, *constraints.handles[h], index_of(h), holding);
    }
    for (const auto& target : constraints.targets) {
        if (!target->is_hard_vertex()) continue;
        const Index v = target->row.front().first;
        holding.owner[v] = kConstrained;
        holding.known.position[v] = target->position || work.rings.count(v) == 0;
        holding.known.gradient[v] = target->gradient;
    }
    hold_inserted(work.patch, holding);
    // Points come last: vertices that are held keep their holder.
    for (std::size_t h = 0; h < constraints.handles.size(); ++h) {
        const Handle* handle = constraints.handles[h].get();
        if (!handle || handle->soft() || !handle->options.gradient) continue;
        for (const SparseRow& row : handle->points) {
            turn_around(row, index_of(h), kNoIndex, holding);
        }
    }
    for (std::size_t t = 0; t < constraints.targets.size(); ++t) {
        const Target& target = *constraints.targets[t];
        if (target.is_hard_vertex() || target.weight || !target.gradient) continue;
        turn_around(target.row, kConstrained, index_of(t), holding);
    }
    for (Index i = 0; i < work.patch.surface_count; ++i) {
        holding.known.gradient_wanted[i] = !holding.known.gradient[i] && work.rings.count(i) > 0;
    }
    hold_normal_points(work.patch, holding);
    hold_anchors(work, holding);
    return holding;
}

std::vector<std::vector<Index>> loose_parts(const WorkingPatch& work, const KnownMask& known) {
    const TiesOfVertices ties(work);
    std::vector<char> seen(work.patch.surface_count, 0);
    std::vector<std::vector<Index>> loose;
    for (Index v = 0; v < work.patch.surface_count; ++v) {
        if (seen[v]) continue;
        Part part = collect_part(work, ties, known, v, seen);
        if (!is_loose(part)) continue;
        std::sort(part.members.begin(), part.members.end());
        loose.push_back(std::move(part.members));
    }
    return loose;
}

void require_constraints(const WorkingPatch& work, const KnownMask& known) {
    const TiesOfVertices ties(work);
    std::vector<char> seen(work.patch.surface_count, 0);
    std::vector<Part> loose;
    for (Index v = 0; v < work.patch.surface_count; ++v) {
        if (seen[v]) continue;
        Part part = collect_part(work, ties, known, v, seen);
        if (!is_held(part)) loose.push_back(std::move(part));
    }
    if (loose.size() == 1) refuse_part(std::move(loose.front()));
    if (!loose.empty()) refuse_parts(loose);
}

}  // namespace lissom
