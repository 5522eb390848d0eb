#include "kernel/deform/levels/thinned_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
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
// Slivers: passes of flips, angles beyond half a turn that count, and the cosine of the turn from
// the faces of an edge to those of its other diagonal, at most.
constexpr int kFlipPasses = 6;
constexpr double kFlipMargin = 1e-3;
constexpr double kFlatCosine = 0.9;
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

    // Turns edges of slivers over: operators of slivers are poor.
    void flip_slivers(const Context& context) {
        bool changed = true;
        for (int pass = 0; pass < kFlipPasses && changed; ++pass) {
            changed = false;
            for (std::size_t f = 0; f < editor_.faces().size(); ++f) {
                context.checkpoint();
                for (std::size_t k = 0; k < 3 && editor_.faces()[f].alive(); ++k) {
                    const Triangle& corners = editor_.faces()[f].vertices;
                    const Index a = corners[k], b = corners[(k + 1) % 3];
                    if (a > b) continue;
                    const TriangleEditor::Edge edge = editor_.edge(a, b);
                    if (!editor_.can_flip(edge) || !is_better_flipped(edge)) continue;
                    editor_.flip(edge);
                    changed = true;
                }
            }
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

    // Whether the two angles opposite of an edge are more than half a turn together (Delaunay), on
    // a surface that is nearly flat there and stays so.
    bool is_better_flipped(const TriangleEditor::Edge& edge) const {
        const Vec3 a = editor_.position(edge.a), b = editor_.position(edge.b);
        const Vec3 c = editor_.position(editor_.opposite(edge.left, edge));
        const Vec3 d = editor_.position(editor_.opposite(edge.right, edge));
        if (part_[at(edge.a)] != part_[at(edge.b)]) return false;
        if (angle_at(c, a, b) + angle_at(d, a, b) <= kPi + kFlipMargin) return false;
        const Vec3 before = (b - a).cross(c - a).normalized() + (d - a).cross(b - a).normalized();
        const Vec3 first = (d - c).cross(b - c), second = (c - d).cross(a - d);
        const double least = kFlatCosine * before.norm();
        return first.dot(before) > least * first.norm() &&
               second.dot(before) > least * second.norm();
    }

    static double angle_at(const Vec3& corner, const Vec3& p, const Vec3& q) {
        const Vec3 to_p = p - corner, to_q = q - corner;
        return std::atan2(to_p.cross(to_q).norm(), to_p.dot(to_q));
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
    thinning.flip_slivers(context);
    return thinning.result(context);
}

}  // namespace lissom
