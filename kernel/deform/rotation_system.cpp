#include "kernel/deform/rotation_system.h"

#include <algorithm>

#include "kernel/deform/firm_factor.h"
#include "kernel/deform/row_accumulator.h"

namespace lissom {
namespace {

// Few chunks in assembly, as each needs a scratch row of the full width.
Index grain_of(Index size) {
    return std::max<Index>(1024, (size + 15) / 16);
}

constexpr Index kFrameGrain = 4096;

// The length below which `blend` follows Laplacian coordinates rather than edges: in radii of the
// surface and, at least, in mean edge lengths.
constexpr double kBlendRadii = 0.06;
constexpr double kBlendEdges = 3.0;

// Weight of squared lengths of a tie of weight 1 beside the edges.
constexpr double kPositionUnit = 1.0;

double laplacian_factor_of(const Patch& patch, const Rings& rings, SecondSystem second) {
    if (second == SecondSystem::laplacian) return 1.0;
    if (second == SecondSystem::poisson) return 0.0;
    const double length = std::max(kBlendRadii * surface_radius_of(patch.triangles, patch.rest),
                                   kBlendEdges * mean_edge_length_of(rings, patch.rest));
    return length * length;
}

// Edge weights of a Laplacian that has to be positive definite by itself: cotangents from zero
// upwards.
std::vector<double> edge_weights(const RingGeometry& geometry, const DeformOptions& options) {
    std::vector<double> weights = geometry.cotangent;
    for (double& w : weights) {
        w = options.weights == LaplacianWeights::uniform ? 1.0 : std::max(w, 0.0);
        if (options.second == SecondSystem::laplacian) w = 0.0;
    }
    return weights;
}

}  // namespace

RotationSystem::RotationSystem(const WorkingPatch& work, const std::vector<char>& position_known,
                               const DeformOptions& options, const Context& context)
    : rings_(build_rings(work.patch.real_count, work.patch.triangles)),
      rest_(work.patch.rest.begin(), work.patch.rest.begin() + work.patch.real_count) {
    const Patch& patch = work.patch;
    const RingGeometry geometry = ring_geometry(rings_, patch.triangles, rest_);
    const bool literal = !options.scale_free && options.second == SecondSystem::laplacian;
    laplacian_ = make_laplacian(rings_, geometry, options.weights, !literal);
    laplacian_factor_ = laplacian_factor_of(patch, rings_, options.second);
    const bool lengths = options.second != SecondSystem::laplacian;
    tie_unit_ = lengths ? kPositionUnit : work.position_unit();
    edge_weight_ = edge_weights(geometry, options);

    weighted_delta_.assign(rest_.size(), Vec3::Zero());
    edge_sum_.assign(rest_.size(), Vec3::Zero());
    for (Index i = 0; i < patch.real_count; ++i) {
        laplacian_.weight[i] *= laplacian_factor_;
        weighted_delta_[i] = laplacian_.weight[i] * laplacian_.apply(rings_, rest_, i);
        for (Index e = rings_.begin[i]; e < rings_.begin[i + 1]; ++e) {
            edge_sum_[i] += 0.5 * edge_weight_[e] * (rest_[i] - rest_[rings_.neighbor[e]]);
        }
        if (!position_known[i]) free_.push_back(i);
    }
    transposed_.resize(rings_.neighbor.size());
    for (Index i = 0; i < rings_.size(); ++i) {
        for (Index e = rings_.begin[i]; e < rings_.begin[i + 1]; ++e) {
            transposed_[e] = laplacian_.neighbor[rings_.entry(rings_.neighbor[e], i)];
        }
    }
    assemble(position_known, context);
    add_ties(work);
}

void RotationSystem::add_ties(const WorkingPatch& work) {
    std::vector<Index> row_of(static_cast<std::size_t>(work.patch.vertex_count), kNoIndex);
    for (std::size_t r = 0; r < free_.size(); ++r) row_of[free_[r]] = static_cast<Index>(r);
    ties_ = TieRows(work.ties, row_of, tie_unit_, [](Index v) { return SparseRow{{v, 1.0}}; });
    ties_.add_to(matrix_);
    tie_bytes_ = TieRows::response_bytes(work.ties, static_cast<Index>(free_.size()));
}

void RotationSystem::assemble(const std::vector<char>& position_known, const Context& context) {
    std::vector<Index> row_of(rest_.size(), kNoIndex);
    for (std::size_t r = 0; r < free_.size(); ++r) row_of[free_[r]] = static_cast<Index>(r);

    struct Rows {
        SymmetricMatrix matrix;
        RowMatrix positions;
    };
    const auto count = static_cast<Index>(free_.size());
    const Index grain = grain_of(count);
    std::vector<Rows> parts(static_cast<std::size_t>((count + grain - 1) / grain));
    context.parallel_for(0, count, grain, [&](Index begin, Index end) {
        Rows& rows = parts[static_cast<std::size_t>(begin / grain)];
        RowAccumulator<double> row(rings_.size());
        const auto add_laplacian = [&](Index a, double coefficient) {
            const double f = laplacian_.weight[a] * coefficient;
            if (f == 0.0) return;
            row.add(a, f * laplacian_.self[a]);
            for (Index e = rings_.begin[a]; e < rings_.begin[a + 1]; ++e) {
                row.add(rings_.neighbor[e], f * laplacian_.neighbor[e]);
            }
        };
        for (Index r = begin; r < end; ++r) {
            const Index i = free_[r];
            row.add(i, 0.0);
            add_laplacian(i, laplacian_.self[i]);
            for (Index e = rings_.begin[i]; e < rings_.begin[i + 1]; ++e) {
                const Index j = rings_.neighbor[e];
                add_laplacian(j, transposed_[e]);
                row.add(i, edge_weight_[e]);
                row.add(j, -edge_weight_[e]);
            }
            row.drain([&](Index k, double value) {
                if (position_known[k]) {
                    rows.positions.column.push_back(k);
                    rows.positions.value.push_back(value);
                } else if (row_of[k] >= r) {
                    rows.matrix.row.push_back(row_of[k]);
                    rows.matrix.value.push_back(value);
                }
            });
            rows.matrix.begin.push_back(static_cast<Index>(rows.matrix.row.size()));
            rows.positions.begin.push_back(static_cast<Index>(rows.positions.column.size()));
        }
    });
    positions_.columns = rings_.size();
    for (const Rows& part : parts) {
        append_rows(matrix_.begin, matrix_.row, matrix_.value, part.matrix.begin, part.matrix.row,
                    part.matrix.value);
        append_rows(positions_.begin, positions_.column, positions_.value, part.positions.begin,
                    part.positions.column, part.positions.value);
    }
}

void RotationSystem::factor(const Context& context) {
    factor_firmly(system_, matrix_, context);
    matrix_ = {};
    ties_charge_ = context.charge(tie_bytes_, "points that are held");
    ties_.prepare(static_cast<Index>(free_.size()),
                  [&](std::span<const double> b, std::span<double> x, Index columns) {
                      system_.solve(b, x, columns);
                  });
}

void RotationSystem::solve(std::span<const Mat3> transforms, std::span<Vec3> positions,
                           const Context& context) {
    const auto count = static_cast<Index>(free_.size());
    const auto rows = static_cast<std::size_t>(count);
    std::vector<Vec3>& target = target_;
    target.resize(rest_.size());
    context.parallel_for(0, rings_.size(), kFrameGrain, [&](Index begin, Index end) {
        for (Index i = begin; i < end; ++i) target[i] = transforms[i] * weighted_delta_[i];
    });
    std::vector<double>& b = right_;
    b.resize(3 * rows);
    context.parallel_for(0, count, kFrameGrain, [&](Index begin, Index end) {
        for (Index r = begin; r < end; ++r) {
            const Index i = free_[r];
            Vec3 sum = laplacian_.self[i] * target[i] + transforms[i] * edge_sum_[i];
            for (Index e = rings_.begin[i]; e < rings_.begin[i + 1]; ++e) {
                const Index j = rings_.neighbor[e];
                sum += transposed_[e] * target[j];
                sum += transforms[j] * (0.5 * edge_weight_[e] * (rest_[i] - rest_[j]));
            }
            for (Index e = positions_.begin[r]; e < positions_.begin[r + 1]; ++e) {
                sum -= positions_.value[e] * positions[positions_.column[e]];
            }
            for (int d = 0; d < 3; ++d) b[d * rows + r] = sum[d];
        }
    });
    const auto coordinate = [&](int d) { return [&, d](Index v) { return positions[v][d]; }; };
    for (int d = 0; d < 3; ++d) ties_.add_right_hand_side(coordinate(d), b.data() + d * rows);
    system_.solve(b, b, 3);
    for (int d = 0; d < 3; ++d) ties_.enforce(coordinate(d), std::span(b).subspan(d * rows, rows));
    for (std::size_t r = 0; r < rows; ++r) {
        positions[free_[r]] = {b[r], b[rows + r], b[2 * rows + r]};
    }
}

}  // namespace lissom
