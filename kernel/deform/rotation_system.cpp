#include "kernel/deform/rotation_system.h"

#include <algorithm>
#include <cmath>

#include "kernel/deform/firm_factor.h"
#include "kernel/deform/row_accumulator.h"

namespace lissom {
namespace {

// Few chunks in assembly, as each needs a scratch row of the full width.
Index grain_of(Index size) {
    return std::max<Index>(1024, (size + 15) / 16);
}

constexpr Index kFrameGrain = 4096;

// A factor in single precision serves where one correction leaves less than this of the error;
// corrections go on to this precision.
constexpr double kLargestContraction = 0.02;
constexpr double kPrecision = 1e-10;

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
        laplacian_.weight[i] *= laplacian_factor_ * work.stiffness_between(i, i);
        weighted_delta_[i] = laplacian_.weight[i] * laplacian_.apply(rings_, rest_, i);
        for (Index e = rings_.begin[i]; e < rings_.begin[i + 1]; ++e) {
            edge_weight_[e] *= work.stiffness_between(i, rings_.neighbor[e]);
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
    vertex_count_ = work.patch.vertex_count;
    ties_ = TieRows(work.ties, row_of, tie_unit_, [](Index v) { return SparseRow{{v, 1.0}}; });
    ties_.add_to(matrix_);
    tie_bytes_ = TieRows::response_bytes(work.ties, static_cast<Index>(free_.size()));
}

void RotationSystem::assemble(const std::vector<char>& position_known, const Context& context) {
    std::vector<Index> row_of(rest_.size(), kNoIndex);
    for (std::size_t r = 0; r < free_.size(); ++r) row_of[free_[r]] = static_cast<Index>(r);

    const auto count = static_cast<Index>(free_.size());
    const Index grain = grain_of(count);
    std::vector<SymmetricMatrix> parts(static_cast<std::size_t>((count + grain - 1) / grain));
    context.parallel_for(0, count, grain, [&](Index begin, Index end) {
        SymmetricMatrix& rows = parts[static_cast<std::size_t>(begin / grain)];
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
                if (position_known[k] || row_of[k] < r) return;
                rows.row.push_back(row_of[k]);
                rows.value.push_back(value);
            });
            rows.begin.push_back(static_cast<Index>(rows.row.size()));
        }
    });
    for (const SymmetricMatrix& part : parts) {
        append_rows(matrix_.begin, matrix_.row, matrix_.value, part.begin, part.row, part.value);
    }
}

void RotationSystem::factor(const Context& context) {
    factor_firmly(system_, matrix_, context);
    stats_ = system_.stats();
    matrix_ = {};
    ties_charge_ = context.charge(tie_bytes_, "points that are held");
    ties_.prepare(static_cast<Index>(free_.size()),
                  [&](std::span<const double> b, std::span<double> x, Index columns) {
                      system_.solve(b, x, columns);
                  });
    single_ = system_.single_factor(context);
    const double contraction = measure_contraction(context);
    if (contraction > kLargestContraction) {
        single_ = {};
        corrections_ = 1;
        return;
    }
    system_ = {};
    stats_.factor_bytes /= 2;
    corrections_ =
        static_cast<int>(std::ceil(std::log(kPrecision) / std::log(std::max(contraction, 1e-6))));
}

// The factor by which one correction in single precision shortens the error, the worst of a smooth
// solution and of two waves over the numbers of the vertices.
double RotationSystem::measure_contraction(const Context& context) {
    std::vector<Vec3> x(static_cast<std::size_t>(vertex_count_), Vec3::Zero());
    double size = 0.0;
    for (const Index v : free_) size = std::max(size, rest_[v].cwiseAbs().maxCoeff());
    for (const Index v : free_) {
        x[v] = {rest_[v].sum() / size, std::cos(0.01 * v), std::cos(1.0 * v)};
    }
    right_.assign(free_.size(), Vec3::Zero());
    find_residual(x, context);
    find_correction(context);
    Vec3 error = Vec3::Zero(), whole = Vec3::Zero();
    for (std::size_t r = 0; r < free_.size(); ++r) {
        error += (correction_[r] + x[free_[r]]).cwiseAbs2();
        whole += x[free_[r]].cwiseAbs2();
    }
    return std::sqrt((error.array() / whole.array().max(1e-300)).maxCoeff());
}

void RotationSystem::set_transforms(std::span<const Mat3> transforms, const Context& context) {
    std::vector<Vec3>& target = by_vertex_;
    target.resize(rest_.size());
    context.parallel_for(0, rings_.size(), kFrameGrain, [&](Index begin, Index end) {
        for (Index i = begin; i < end; ++i) target[i] = transforms[i] * weighted_delta_[i];
    });
    right_.resize(free_.size());
    const auto count = static_cast<Index>(free_.size());
    context.parallel_for(0, count, kFrameGrain, [&](Index begin, Index end) {
        for (Index r = begin; r < end; ++r) {
            const Index i = free_[r];
            Vec3 sum = laplacian_.self[i] * target[i] + transforms[i] * edge_sum_[i];
            for (Index e = rings_.begin[i]; e < rings_.begin[i + 1]; ++e) {
                const Index j = rings_.neighbor[e];
                sum += transposed_[e] * target[j];
                sum += transforms[j] * (0.5 * edge_weight_[e] * (rest_[i] - rest_[j]));
            }
            right_[r] = sum;
        }
    });
}

void RotationSystem::solve(std::span<Vec3> positions, bool draft, const Context& context) {
    const int corrections = draft ? 1 : corrections_;
    for (int pass = 0; pass < corrections; ++pass) {
        find_residual(positions, context);
        find_correction(context);
        for (std::size_t r = 0; r < free_.size(); ++r) positions[free_[r]] += correction_[r];
    }
    if (ties_.has_hard()) enforce_ties(positions);
}

void RotationSystem::enforce_ties(std::span<Vec3> positions) {
    columns_.resize(free_.size());
    for (int d = 0; d < 3; ++d) {
        for (std::size_t r = 0; r < free_.size(); ++r) columns_[r] = positions[free_[r]][d];
        ties_.enforce([&](Index v) { return positions[v][d]; }, columns_);
        for (std::size_t r = 0; r < free_.size(); ++r) positions[free_[r]][d] = columns_[r];
    }
}

// Right-hand side less what the matrix makes of `positions`, without forming the matrix.
void RotationSystem::find_residual(std::span<const Vec3> positions, const Context& context) {
    std::vector<Vec3>& scaled = by_vertex_;
    scaled.resize(rest_.size());
    const bool has_laplacian = laplacian_factor_ > 0.0;
    if (has_laplacian) {
        context.parallel_for(0, rings_.size(), kFrameGrain, [&](Index begin, Index end) {
            for (Index i = begin; i < end; ++i) {
                scaled[i] = laplacian_.weight[i] * laplacian_.apply(rings_, positions, i);
            }
        });
    }
    residual_.resize(free_.size());
    const auto count = static_cast<Index>(free_.size());
    context.parallel_for(0, count, kFrameGrain, [&](Index begin, Index end) {
        for (Index r = begin; r < end; ++r) {
            const Index i = free_[r];
            Vec3 sum = right_[r];
            if (has_laplacian) sum -= laplacian_.self[i] * scaled[i];
            for (Index e = rings_.begin[i]; e < rings_.begin[i + 1]; ++e) {
                const Index j = rings_.neighbor[e];
                sum -= edge_weight_[e] * (positions[i] - positions[j]);
                if (has_laplacian) sum -= transposed_[e] * scaled[j];
            }
            residual_[r] = sum;
        }
    });
    ties_.subtract_from(positions, free_, residual_);
}

void RotationSystem::find_correction(const Context& context) {
    correction_.resize(free_.size());
    if (single_.size() > 0) {
        single_.solve(residual_, correction_, scratch_, context);
        return;
    }
    const std::size_t rows = free_.size();
    columns_.resize(3 * rows);
    for (std::size_t r = 0; r < rows; ++r) {
        for (std::size_t d = 0; d < 3; ++d) columns_[d * rows + r] = residual_[r][d];
    }
    system_.solve(columns_, columns_, 3);
    for (std::size_t r = 0; r < rows; ++r) {
        correction_[r] = {columns_[r], columns_[rows + r], columns_[2 * rows + r]};
    }
}

}  // namespace lissom
