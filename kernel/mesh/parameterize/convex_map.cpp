#include "kernel/mesh/parameterize/convex_map.h"

#include <algorithm>
#include <cmath>

#include "kernel/solve/sparse/sparse_system.h"

namespace lissom {
namespace {

constexpr double kMinTutteWeight = 0.05, kMaxTutteWeight = 20.0;
// Edges of the outline are at least this long beside their mean, so that none becomes a point.
constexpr double kMinArc = 1e-3;

void require_one_loop(const Chart& chart) {
    if (chart.open_loops.size() == 1) return;
    Elements elements{ElementKind::vertex, 0, {}};
    for (std::size_t i = 1; i < chart.open_loops.size(); ++i) {
        elements.add(chart.vertex[chart.open_loops[i][0]]);
    }
    throw Error(ErrorCode::not_a_disk,
                "a map onto a disk needs a surface without holes; there are some at " +
                    describe(elements) + "; set close_holes",
                elements);
}

void put_on_circle(const Chart& chart, std::span<const Index> loop, std::vector<Vec2>& uv) {
    const double least = kMinArc * loop_length(chart, loop) / static_cast<double>(loop.size());
    std::vector<double> end{0.0};
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Index next = loop[(i + 1) % loop.size()];
        const double length = (chart.positions[next] - chart.positions[loop[i]]).norm();
        end.push_back(end.back() + std::max(length, least));
    }
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const double angle = 2.0 * kPi * end[i] / end.back();
        uv[loop[i]] = {std::cos(angle), std::sin(angle)};
    }
}

// The system over the vertices inside, with the outline on its right side.
class TutteSystem {
  public:
    TutteSystem(const SymmetricMatrix& laplacian, std::span<const Index> loop)
        : unknown_(at(laplacian.size()), 0) {
        for (const Index v : loop) unknown_[v] = kNoIndex;
        for (Index& v : unknown_) {
            if (v != kNoIndex) v = count_++;
        }
    }

    void solve(const SymmetricMatrix& laplacian, std::vector<Vec2>& uv, const Context& context) {
        if (count_ == 0) return;
        right_.assign(2 * at(count_), 0.0);
        for (Index v = 0; v < laplacian.size(); ++v) {
            for (Index e = laplacian.begin[v] + 1; e < laplacian.begin[v + 1]; ++e) {
                const double w = std::clamp(-laplacian.value[e], kMinTutteWeight, kMaxTutteWeight);
                add_edge(v, laplacian.row[e], w, uv);
                add_edge(laplacian.row[e], v, w, uv);
            }
        }
        const SymmetricMatrix matrix = symmetric_from_triplets(count_, entries_);
        SparseSystem system;
        system.analyze(matrix, context);
        system.factor(matrix, context);
        system.solve(right_, right_, 2);
        for (std::size_t v = 0; v < uv.size(); ++v) {
            if (const Index i = unknown_[v]; i != kNoIndex)
                uv[v] = {right_[i], right_[at(count_) + i]};
        }
    }

  private:
    void add_edge(Index v, Index w, double weight, std::span<const Vec2> uv) {
        const Index row = unknown_[v], column = unknown_[w];
        if (row == kNoIndex) return;
        entries_.push_back({row, row, weight});
        if (column != kNoIndex) {
            if (column < row) entries_.push_back({row, column, -weight});
            return;
        }
        right_[row] += weight * uv[w].x();
        right_[at(count_) + row] += weight * uv[w].y();
    }

    // The number of each vertex inside; kNoIndex on the outline.
    std::vector<Index> unknown_;
    Index count_ = 0;
    std::vector<Triplet> entries_;
    std::vector<double> right_;
};

}  // namespace

std::vector<Vec2> convex_map(const Chart& chart, const std::vector<TriangleShape>& shapes,
                             const Context& context) {
    require_one_loop(chart);
    const std::vector<Index>& loop = chart.open_loops.front();
    const SymmetricMatrix laplacian = chart_laplacian(chart, shapes);
    std::vector<Vec2> uv(chart.positions.size(), Vec2::Zero());
    put_on_circle(chart, loop, uv);
    TutteSystem(laplacian, loop).solve(laplacian, uv, context);
    return uv;
}

}  // namespace lissom
