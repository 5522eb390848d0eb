// Seams along the target's loop, with the vertices of both loops.

#include <algorithm>
#include <optional>
#include <set>

#include "kernel/merge/sew/seam_loop.h"
#include "kernel/merge/sew/seam_work.h"

namespace lissom {
namespace {

// Lengths that differ by less than this part are equal, so that rounding does not decide.
constexpr double kRounding = 1.0 - 1e-9;

class ConformingSeam {
  public:
    ConformingSeam(SeamWork& work, const LoopPair& join, double snap_limit)
        : work_(work), join_(join), seam_(seam_loop(join)) {
        for (const Index v : join.target) points_.push_back(work.both.position(v));
        work.report.snapped += snap(seam_, points_, snap_limit);
    }

    // Collapses short edges between vertices of the source, the shortest first. Those of the target
    // all stay.
    void collapse_source(double limit) {
        double mean = 0.0;
        for (std::size_t k = 0; k < seam_.size(); ++k) mean += length(k);
        mean /= seam_.size();
        std::set<Index> firm;
        for (;;) {
            const std::optional<ShortEdge> edge = shortest(limit * mean, firm);
            if (!edge) return;
            const Index gone = source_vertex(seam_[edge->gone]);
            if (work_.patch.collapse(gone, source_vertex(seam_[edge->kept]))) {
                work_.gone.insert(gone);
                seam_.erase(seam_.begin() + edge->gone);
                ++work_.report.collapsed;
            } else {
                firm.insert(gone);
            }
        }
    }

    // Inserts the vertices of the source's loop into the target's faces.
    void split_target() {
        const std::size_t n = seam_.size();
        for (std::size_t k = 0; k < n;) {
            std::vector<Index> inserted;
            std::vector<double> fractions;
            const std::size_t from = k++;
            for (; k < n && !seam_[k].of_target; ++k) {
                inserted.push_back(source_vertex(seam_[k]));
                fractions.push_back(seam_[k].on_target.t);
            }
            if (inserted.empty()) continue;
            work_.patch.split_edge(target_vertex(seam_[from]), target_vertex(seam_[k % n]),
                                   inserted, fractions);
            work_.report.inserted_into_target += count_of(inserted);
        }
    }

    // Inserts the vertices of the target's loop into the source's faces, which see their boundary
    // the other way round.
    void split_source() {
        const std::size_t n = seam_.size();
        std::size_t first = 0;
        while (!seam_[first].of_source) ++first;
        for (std::size_t k = first; k < first + n;) {
            std::vector<Index> inserted;
            std::vector<double> fractions;
            const std::size_t from = k++;
            for (; !seam_[k % n].of_source; ++k) {
                inserted.insert(inserted.begin(), target_vertex(seam_[k % n]));
                fractions.insert(fractions.begin(), 1.0 - seam_[k % n].on_source.t);
            }
            if (inserted.empty()) continue;
            work_.patch.split_edge(source_vertex(seam_[k % n]), source_vertex(seam_[from % n]),
                                   inserted, fractions);
            work_.report.inserted_into_source += count_of(inserted);
        }
    }

    void connect() {
        std::vector<Index> vertices;
        for (const SeamVertex& v : seam_) {
            vertices.push_back(v.of_target ? target_vertex(v) : source_vertex(v));
            work_.sources[vertices.back()] = sources_of(work_, join_, v.on_target, v.on_source);
            if (!v.of_target) work_.patch.move(vertices.back(), seam_point(points_, v));
            if (!v.of_target || !v.of_source) continue;
            work_.patch.merge_vertex(source_vertex(v), vertices.back());
            work_.gone.insert(source_vertex(v));
        }
        work_.seams.push_back(std::move(vertices));
    }

  private:
    // Places in the seam.
    struct ShortEdge {
        std::size_t gone, kept;
    };

    double length(std::size_t k) const {
        return (seam_point(points_, seam_[(k + 1) % seam_.size()]) - seam_point(points_, seam_[k]))
            .norm();
    }

    // The shortest edge of the seam below `limit` that may go, the first of equals.
    std::optional<ShortEdge> shortest(double limit, const std::set<Index>& firm) const {
        const auto sources = std::count_if(seam_.begin(), seam_.end(),
                                           [](const SeamVertex& v) { return v.of_source; });
        std::optional<ShortEdge> best;
        if (sources <= 3) return best;
        for (std::size_t k = 0; k < seam_.size(); ++k) {
            std::size_t gone = (k + 1) % seam_.size(), kept = k;
            if (!(length(k) < limit * kRounding)) continue;
            if (!may_go(gone, firm)) std::swap(gone, kept);
            if (!may_go(gone, firm) || !seam_[kept].of_source) continue;
            limit = length(k);
            best = {gone, kept};
        }
        return best;
    }

    bool may_go(std::size_t k, const std::set<Index>& firm) const {
        return !seam_[k].of_target && !firm.contains(source_vertex(seam_[k]));
    }

    Index target_vertex(const SeamVertex& v) const { return join_.target[v.on_target.segment]; }
    Index source_vertex(const SeamVertex& v) const {
        return work_.first_source_vertex + join_.source[v.on_source.segment];
    }

    SeamWork& work_;
    const LoopPair& join_;
    std::vector<SeamVertex> seam_;
    std::vector<Vec3> points_;
};

}  // namespace

void sew_conforming(SeamWork& work, const LoopPair& join, double snap) {
    ConformingSeam seam(work, join, snap);
    seam.collapse_source(snap);
    seam.split_target();
    seam.split_source();
    seam.connect();
}

}  // namespace lissom
