#include "kernel/deform/levels/thinned_surface.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/resample/triangle_editor.h"

namespace lissom {
namespace {

// The edges that may go become longer by this from round to round.
constexpr double kLonger = 1.25;
// A step off the surface, along its normal, counts so much more than one along it, squared: edges
// and ridges thin out along themselves.
constexpr double kOffSurface = 30.0;
// Rounds in a row without a merge, after which no more can be made.
constexpr int kIdleRounds = 12;
constexpr std::size_t kBytesPerVertex = 800;

class SurfaceThinning {
  public:
    SurfaceThinning(const Mesh& mesh, std::span<const Index> part)
        : mesh_(mesh),
          part_(part),
          normals_(vertex_normals(mesh)),
          editor_(mesh, std::vector<char>(at(mesh.topology().corner_count()), 0)),
          onto_(at(mesh.vertex_count())),
          round_of_(at(mesh.vertex_count()), -1) {
        const Topology& topology = mesh.topology();
        for (Index v = 0; v < mesh.vertex_count(); ++v) {
            onto_[at(v)] = v;
            if (topology.is_isolated(v)) continue;
            ++count_;
            const auto neighbors = topology.neighbors(v);
            const bool beside = std::any_of(neighbors.begin(), neighbors.end(),
                                            [&](Index n) { return part[at(n)] != part[at(v)]; });
            if (beside || topology.is_boundary(v)) {
                editor_.hold(v);
            } else {
                free_.push_back(v);
            }
        }
    }

    void run(Index wanted, const Context& context) {
        Progress progress(context, "deform: thin out");
        const Index first = count_;
        double limit = mean_edge_length(mesh_);
        for (int round = 0, idle = 0; count_ > wanted && idle < kIdleRounds; ++round) {
            const Index before = count_;
            for (const Index v : free_) {
                context.checkpoint();
                if (count_ <= wanted) break;
                merge(v, round, limit * limit);
            }
            std::erase_if(free_, [&](Index v) { return onto_[at(v)] != v; });
            progress.update(double(first - count_) / std::max(1, first - wanted));
            idle = count_ < before ? 0 : idle + 1;
            limit *= kLonger;
        }
    }

    ThinnedSurface result(const Context& context) {
        ThinnedSurface made;
        std::vector<Index> number(onto_.size(), kNoIndex);
        std::vector<Vec3> positions;
        for (Index v = 0; v < mesh_.vertex_count(); ++v) {
            if (onto_[at(v)] != v || editor_.fan(v).empty()) continue;
            number[at(v)] = count_of(made.from);
            made.from.push_back(v);
            positions.push_back(mesh_.position(v));
        }
        FaceList faces;
        for (const TriangleEditor::Face& face : editor_.faces()) {
            if (!face.alive()) continue;
            Triangle corners;
            for (std::size_t k = 0; k < 3; ++k) corners[k] = number[at(face.vertices[k])];
            faces.add(corners);
        }
        for (Index v = 0; v < mesh_.vertex_count(); ++v) {
            made.onto.push_back(number[at(last_of(v))]);
        }
        made.mesh = Mesh(std::move(positions), std::move(faces), context);
        return made;
    }

  private:
    // Merges a vertex into the nearest neighbour that is near enough and leaves the surface as it
    // is. Neighbours of one that has gone wait for the next round, so that all places thin out
    // alike.
    void merge(Index v, int round, double limit) {
        if (round_of_[at(v)] == round) return;
        editor_.neighbors(v, ring_);
        near_.clear();
        for (const Index n : ring_) {
            const double cost = part_[at(n)] == part_[at(v)] ? cost_of(v, n) : limit;
            if (cost < limit) near_.emplace_back(cost, n);
        }
        std::sort(near_.begin(), near_.end());
        for (const auto& [cost, onto] : near_) {
            const TriangleEditor::Edge edge = editor_.edge(onto, v);
            if (!editor_.can_collapse(edge)) continue;
            if (editor_.turns_faces(v, onto, editor_.position(onto))) continue;
            editor_.collapse(edge);
            onto_[at(v)] = onto;
            --count_;
            for (const Index n : ring_) round_of_[at(n)] = round;
            return;
        }
    }

    double cost_of(Index v, Index onto) const {
        const Vec3 along = editor_.position(onto) - editor_.position(v);
        const double off = normals_[at(v)].dot(along);
        return along.squaredNorm() + kOffSurface * off * off;
    }

    Index last_of(Index v) {
        while (onto_[at(v)] != v) {
            onto_[at(v)] = onto_[at(onto_[at(v)])];
            v = onto_[at(v)];
        }
        return v;
    }

    const Mesh& mesh_;
    std::span<const Index> part_;
    std::vector<Vec3> normals_;
    TriangleEditor editor_;
    std::vector<Index> onto_;
    std::vector<int> round_of_;
    std::vector<Index> free_, ring_;
    std::vector<std::pair<double, Index>> near_;
    Index count_ = 0;
};

}  // namespace

ThinnedSurface thinned_surface(const Mesh& triangles, std::span<const Index> part, Index wanted,
                               const Context& context) {
    const auto charge = context.charge(at(triangles.vertex_count()) * kBytesPerVertex,
                                       "the thinned surface of a deformation");
    SurfaceThinning thinning(triangles, part);
    thinning.run(wanted, context);
    return thinning.result(context);
}

}  // namespace lissom
