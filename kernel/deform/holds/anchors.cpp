// The anchors and ties of soft constraints and of points (ties.h).
#include <algorithm>
#include <string>

#include "kernel/deform/holds/constraints.h"
#include "kernel/deform/patch/patch_distance.h"

namespace lissom {
namespace {

// Weight of hard ties within the matrix. Their exactness does not depend on it; it only keeps the
// matrix definite if nothing else holds the surface.
constexpr double kHardWeight = 10.0;

// Weight of a fading constraint at its start, for each squared radius of area.
constexpr double kFading = 100.0;

class AnchorBuilder {
  public:
    AnchorBuilder(const WorkingPatch& rest, const ConstraintSet& constraints, double transition)
        : work_(rest), holds_(constraints), transition_(transition) {}

    WorkingPatch build() {
        if (holds_.stiffness) stiffen(*holds_.stiffness);
        for (std::size_t h = 0; h < holds_.handles.size(); ++h) {
            if (holds_.handles[h]) add_handle(*holds_.handles[h], index_of(h));
        }
        for (std::size_t t = 0; t < holds_.targets.size(); ++t) {
            const Target& target = *holds_.targets[t];
            if (target.is_hard_vertex()) continue;
            add_point(target.row, kConstrained, index_of(t), target.weight, target.position,
                      target.gradient);
        }
        if (transition_ > 0.0) add_transition();
        return std::move(work_);
    }

  private:
    // Virtual vertices are as stiff as the vertices around them, and normal points as their vertex.
    void stiffen(const std::vector<double>& given) {
        const Patch& patch = work_.patch;
        work_.stiffness = given;
        for (const SparseRow& row : patch.inserted) {
            double sum = 0.0;
            for (const auto& [v, c] : row) sum += c * given[v];
            work_.stiffness.push_back(sum);
        }
        for (Index v = patch.real_count; v < patch.first_normal_point(); ++v) {
            // The ends of the edge that it splits are among them.
            double sum = 0.0;
            int count = 0;
            for (const Index n : work_.rings.ring(v)) {
                if (n >= patch.real_count) continue;
                sum += work_.stiffness[n];
                ++count;
            }
            work_.stiffness.push_back(sum / count);
        }
        for (const Index v : patch.normal_points) {
            work_.stiffness.push_back(work_.stiffness[at(v)]);
        }
        for (Index v = 0; v < patch.surface_count; ++v) {
            work_.laplacian.weight[v] *= work_.stiffness[v];
        }
    }

    Index add_anchor(const SparseRow& row, Index owner, Index point) {
        Patch& patch = work_.patch;
        Vec3 at = Vec3::Zero();
        for (const auto& [v, c] : row) at += c * patch.rest[v];
        patch.rest.push_back(at);
        patch.in_region.push_back(0);
        patch.on_boundary.push_back(0);
        work_.anchor_owner.push_back(owner);
        work_.anchor_point.push_back(point);
        return patch.vertex_count++;
    }

    // Draws vertices within `reach` of the sources to their places under `owner`: by density, so
    // that neither handle nor triangles matter.
    void add_fading(const std::vector<std::pair<Index, double>>& sources, double reach, Index owner,
                    double strength, bool position, bool gradient) {
        const std::vector<double> distance = patch_distances(work_.patch, sources, reach);
        const double area = work_.radius * work_.radius;
        for (Index v = 0; v < work_.patch.real_count; ++v) {
            if (!(distance[v] > 0.0 && distance[v] < reach)) continue;
            const double t = distance[v] / reach;
            const double weight = strength * (1.0 - t * t) * (1.0 - t * t);
            add_point({{v, 1.0}}, owner, kNoIndex, weight * work_.geometry.area[v] / area, position,
                      gradient);
        }
    }

    void add_falloff(const Handle& handle, Index h) {
        std::vector<std::pair<Index, double>> sources;
        for (const Index v : handle.local) sources.emplace_back(v, 0.0);
        for (const SparseRow& row : handle.points) {
            Vec3 at = Vec3::Zero();
            for (const auto& [v, c] : row) at += c * work_.patch.rest[v];
            for (const auto& [v, c] : row)
                sources.emplace_back(v, (work_.patch.rest[v] - at).norm());
        }
        add_fading(sources, handle.options.falloff, h, handle.options.weight.value_or(kFading),
                   handle.options.position, handle.options.gradient);
    }

    void add_transition() {
        std::vector<std::pair<Index, double>> sources;
        for (Index v = 0; v < work_.patch.real_count; ++v) {
            if (!work_.patch.in_region[v]) sources.emplace_back(v, 0.0);
        }
        add_fading(sources, transition_, kPinned, kFading, true, true);
    }

    // A soft handle is as strong as its weight says, however many vertices it has: each counts by
    // its share of their area.
    void add_handle(const Handle& handle, Index h) {
        const HandleOptions& options = handle.options;
        const double points = handle.points.size() + handle.local.size();
        if (handle.soft()) {
            double area = 0.0;
            for (const Index v : handle.local) area += work_.geometry.area[v];
            const bool by_area = handle.points.empty() && area > 0.0;
            for (const Index v : handle.local) {
                const double share = by_area ? work_.geometry.area[v] / area : 1.0 / points;
                if (work_.rings.count(v) == 0) continue;
                add_point({{v, 1.0}}, h, kNoIndex, share * *options.weight, options.position,
                          options.gradient);
            }
        }
        for (const SparseRow& row : handle.points) {
            std::optional<double> weight = options.weight;
            if (weight) *weight /= points;
            add_point(row, h, kNoIndex, weight, options.position, options.gradient);
        }
        if (options.falloff > 0.0) add_falloff(handle, h);
    }

    void add_point(const SparseRow& row, Index owner, Index point, std::optional<double> weight,
                   bool position, bool gradient) {
        const Index anchor = add_anchor(row, owner, point);
        if (position) work_.ties.add(row, anchor, weight.value_or(kHardWeight), !weight);
        if (!gradient || !weight) return;
        for (const auto& [v, c] : row) work_.gradient_ties.push_back({v, anchor, *weight * c});
    }

    WorkingPatch work_;
    const ConstraintSet& holds_;
    double transition_;
};

// Appends empty entries for each anchor to arrays by vertex.
void add_empty_anchors(WorkingPatch& work) {
    const std::size_t n = work.patch.vertex_count;
    work.rings.begin.resize(n + 1, work.rings.begin.back());
    work.geometry.area.resize(n, 0.0);
    work.geometry.normal.resize(n, Vec3::Zero());
    work.laplacian.self.resize(n, 0.0);
    work.laplacian.weight.resize(n, 0.0);
    if (!work.stiffness.empty()) work.stiffness.resize(n, 1.0);
}

Ties without(const Ties& ties, const std::vector<Index>& dropped) {
    Ties kept;
    for (Index t = 0; t < ties.size(); ++t) {
        if (std::binary_search(dropped.begin(), dropped.end(), t)) continue;
        kept.add(ties.row[t], ties.anchor[t], ties.weight[t], ties.hard[t] != 0);
    }
    return kept;
}

[[noreturn]] void refuse_tie(const WorkingPatch& work, const SparseRow& row) {
    Elements vertices{ElementKind::vertex, 0, {}};
    for (const auto& [v, c] : row) vertices.add(work.patch.mesh_vertex[v]);
    const std::string names = describe(vertices);
    throw Error(ErrorCode::handle_overlap,
                "a point between " + names +
                    " cannot be held: other handles or constraints fix its position already; "
                    "remove one of them, or give it a weight",
                std::move(vertices));
}

// Points of one handle may determine each other, as one transform moves them all.
void drop_repeated(WorkingPatch& work, const HolderMap& holding) {
    const auto owner = [&](Index t) {
        return work.anchor_owner[work.ties.anchor[t] - work.patch.surface_count];
    };
    std::vector<Index> repeated;
    Ties of_one;
    std::vector<Index> number;
    const auto finish = [&] {
        for (const Index t : dependent_ties(of_one, holding.known.position)) {
            const bool held_by_others =
                std::any_of(of_one.row[t].begin(), of_one.row[t].end(), [&](const auto& entry) {
                    return holding.known.position[entry.first] &&
                           holding.owner[entry.first] != owner(number[t]);
                });
            if (!held_by_others) repeated.push_back(number[t]);
        }
        of_one = {};
        number.clear();
    };
    for (Index t = 0; t < work.ties.size(); ++t) {
        if (t > 0 && owner(t) != owner(t - 1)) finish();
        if (owner(t) < 0) break;
        of_one.add(work.ties.row[t], work.ties.anchor[t], 0.0, work.ties.hard[t] != 0);
        number.push_back(t);
    }
    finish();
    work.ties = without(work.ties, repeated);
}

}  // namespace

std::shared_ptr<const WorkingPatch> anchored(const WorkingPatch& rest,
                                             const ConstraintSet& constraints, double transition) {
    auto work =
        std::make_shared<WorkingPatch>(AnchorBuilder(rest, constraints, transition).build());
    add_empty_anchors(*work);
    const HolderMap holding = find_holding(*work, constraints);
    drop_repeated(*work, holding);
    const std::vector<Index> dependent = dependent_ties(work->ties, holding.known.position);
    if (!dependent.empty()) refuse_tie(*work, work->ties.row[dependent.front()]);
    return work;
}

}  // namespace lissom
