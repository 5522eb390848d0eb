#include "kernel/deform/system/rotation_system.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "kernel/core/large_pages.h"
#include "kernel/deform/patch/patch_distance.h"
#include "kernel/deform/patch/row_accumulator.h"
#include "kernel/deform/system/frame_blocks.h"

namespace lissom {
namespace {

// A factor in single precision serves if one correction leaves less than this of the error;
// corrections go on to this precision.
constexpr double kLargestContraction = 0.02;
constexpr double kPrecision = 1e-10;

// The length below which `blend` follows Laplacian coordinates rather than edges: in radii of the
// surface and, at least, in mean edge lengths.
constexpr double kBlendRadii = 0.06;
constexpr double kBlendEdges = 3.0;

// That length is for the neighbourhood of held vertices, at which edges alone would leave a crease.
// It fades to a share of itself over this distance, in radii of the surface, as inside a part it
// would resist twisting.
constexpr double kInnerShare = 0.08;
constexpr double kFadeRadii = 0.06;

// Weight of squared lengths of a tie of weight 1 beside the edges.
constexpr double kTieUnit = 1.0;

std::vector<double> ring_sums(const Rings& rings, const std::vector<double>& values,
                              std::size_t count) {
    std::vector<double> sums(count, 0.0);
    for (Index i = 0; i < rings.size(); ++i) {
        for (Index e = rings.begin[i]; e < rings.begin[i + 1]; ++e) sums[i] += values[e];
    }
    return sums;
}

void append_parts(SymmetricMatrix& matrix, const std::vector<SymmetricMatrix>& parts) {
    std::size_t entries = 0;
    for (const SymmetricMatrix& part : parts) entries += part.row.size();
    matrix.row.reserve(entries);
    matrix.value.reserve(entries);
    prefer_large_pages(matrix.row);
    prefer_large_pages(matrix.value);
    for (const SymmetricMatrix& part : parts) {
        append_rows(matrix.begin, matrix.row, matrix.value, part.begin, part.row, part.value);
    }
}

// Whether the rings of the first system, with virtual vertices, are those of the second.
bool is_real(const Patch& patch) {
    return patch.vertex_count == patch.real_count;
}

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

// G of K = W + C G C for the rows of make_laplacian; C has cotangents or ones.
std::vector<double> row_weights(const Rings& rings, const RingGeometry& geometry,
                                const DeformOptions& options, double factor) {
    const bool uniform = options.weights == LaplacianWeights::uniform;
    const bool literal = !options.scale_free && options.second == SecondSystem::laplacian;
    const Laplacian laplacian = make_laplacian(rings, geometry, options.weights, !literal);
    std::vector<double> weights(laplacian.weight);
    for (Index i = 0; i < rings.size(); ++i) {
        if (weights[i] == 0.0) continue;
        const double scale =
            uniform ? 1.0 / rings.count(i) : (literal ? 2.0 : 1.0) / geometry.area[i];
        weights[i] *= factor * scale * scale;
    }
    return weights;
}

}  // namespace

RotationSystem::RotationSystem(const WorkingPatch& work, const std::vector<char>& position_known,
                               const DeformOptions& options, const Context& context)
    : vertex_count_(work.patch.vertex_count) {
    const Patch& patch = work.patch;
    std::optional<SurfaceRings> own;
    if (!is_real(patch)) own = work.surface_rings();
    rings_ = own ? own->rings : work.rings;
    const Index reach = options.second == SecondSystem::poisson ? 1 : 2;
    order_ = RegionOrder::of(work, rings_, patch.real_count, reach);
    const RingGeometry& geometry = own ? own->geometry : work.geometry;
    const std::span<const Vec3> rest(patch.rest.data(), rings_.begin.size() - 1);
    const double factor = laplacian_factor_of(patch, rings_, options.second);
    row_weight_ = row_weights(rings_, geometry, options, factor);
    if (options.second == SecondSystem::blend) fade_laplacian(patch, position_known);
    edge_weight_ = edge_weights(geometry, options);
    coefficient_ = geometry.cotangent;
    if (options.weights == LaplacianWeights::uniform) {
        std::fill(coefficient_.begin(), coefficient_.end(), 1.0);
    }
    const bool lengths = options.second != SecondSystem::laplacian;
    tie_unit_ = lengths ? kTieUnit : work.position_unit();

    laplacian_.assign(rest.size(), Vec4::Zero());
    edge_sum_.assign(rest.size(), Vec4::Zero());
    for (Index i = 0; i < patch.real_count; ++i) {
        rest_.push_back(padded(rest[i]));
        row_weight_[i] *= work.stiffness_between(i, i);
        for (Index e = rings_.begin[i]; e < rings_.begin[i + 1]; ++e) {
            const Vec4 edge = padded(rest[i] - rest[rings_.neighbor[e]]);
            edge_weight_[e] *= work.stiffness_between(i, rings_.neighbor[e]);
            laplacian_[i] += coefficient_[e] * edge;
            edge_sum_[i] += 0.5 * edge_weight_[e] * edge;
        }
        if (!position_known[i]) free_.push_back(i);
    }
    assemble(position_known, context);
    add_ties(work);
}

void RotationSystem::fade_laplacian(const Patch& patch, const std::vector<char>& position_known) {
    const double reach = kFadeRadii * surface_radius_of(patch.triangles, patch.rest);
    std::vector<std::pair<Index, double>> held;
    for (Index i = 0; i < patch.real_count; ++i) {
        if (position_known[i]) held.emplace_back(i, 0.0);
    }
    const std::vector<double> distance = patch_distances(patch, held, 3.0 * reach);
    for (Index i = 0; i < patch.real_count; ++i) {
        const double near = std::exp(-std::pow(distance[i] / reach, 2.0));
        const double share = kInnerShare + (1.0 - kInnerShare) * near;
        row_weight_[i] *= share * share;
    }
}

void RotationSystem::add_ties(const WorkingPatch& work) {
    std::vector<Index> row_of(vertex_count_, kNoIndex);
    for (std::size_t r = 0; r < free_.size(); ++r) row_of[free_[r]] = index_of(r);
    ties_ = TieRows(work.ties, row_of, tie_unit_, [](Index v) { return SparseRow{{v, 1.0}}; });
    ties_.add_to(matrix_);
    tie_bytes_ = TieRows::response_bytes(work.ties, count_of(free_));
}

void RotationSystem::assemble(const std::vector<char>& position_known, const Context& context) {
    std::vector<Index> row_of(rest_.size(), kNoIndex);
    for (std::size_t r = 0; r < free_.size(); ++r) row_of[free_[r]] = index_of(r);
    const std::vector<double> coefficient_sum = ring_sums(rings_, coefficient_, rest_.size());
    const auto count = count_of(free_);
    const Index grain = assembly_grain(count);
    std::vector<SymmetricMatrix> parts((count + grain - 1) / grain);
    context.parallel_for(0, count, grain, [&](Index begin, Index end) {
        SymmetricMatrix& rows = parts[begin / grain];
        RowAccumulator<double> row(rings_.size());
        // The row of a in C, times g_a and the coefficient of i in it. Below the diagonal the
        // matrix is known from its upper part.
        const auto add_laplacian = [&](Index a, double coefficient, Index i) {
            const double f = row_weight_[a] * coefficient;
            if (f == 0.0) return;
            if (a >= i) row.add(a, f * coefficient_sum[a]);
            for (Index e = rings_.begin[a]; e < rings_.begin[a + 1]; ++e) {
                const Index k = rings_.neighbor[e];
                if (k >= i) row.add(k, -f * coefficient_[e]);
            }
        };
        for (Index r = begin; r < end; ++r) {
            context.checkpoint();
            const Index i = free_[r];
            row.add(i, 0.0);
            add_laplacian(i, coefficient_sum[i], i);
            for (Index e = rings_.begin[i]; e < rings_.begin[i + 1]; ++e) {
                const Index j = rings_.neighbor[e];
                add_laplacian(j, -coefficient_[e], i);
                row.add(i, edge_weight_[e]);
                if (j > i) row.add(j, -edge_weight_[e]);
            }
            row.drain([&](Index k, double value) {
                if (position_known[k]) return;
                rows.row.push_back(row_of[k]);
                rows.value.push_back(value);
            });
            rows.begin.push_back(count_of(rows.row));
        }
    });
    append_parts(matrix_, parts);
}

void RotationSystem::factor(const Context& context, OrderedSystem former) {
    system_ = std::move(former);
    system_.factor(matrix_, free_, std::exchange(order_, {}), context);
    matrix_ = {};
    stats_ = system_.stats();
}

void RotationSystem::finish(const Context& context) {
    ties_charge_ = context.charge(tie_bytes_, "points that are held");
    ties_.prepare(count_of(free_), [&](std::span<const double> b, std::span<double> x,
                                       Index columns) { system_.system().solve(b, x, columns); });
    single_ = system_.system().single_factor(context);
    const double contraction = measure_contraction(context);
    if (!(contraction <= kLargestContraction)) {
        single_ = {};
        corrections_ = 1;
        return;
    }
    if (!system_.is_ordered()) {
        system_ = {};
        stats_.factor_bytes /= 2;
    } else {
        stats_.factor_bytes += stats_.factor_nonzeros * sizeof(float);
    }
    corrections_ =
        static_cast<int>(std::ceil(std::log(kPrecision) / std::log(std::max(contraction, 1e-6))));
}

EnergyLoop RotationSystem::energy() const {
    return {rings_.begin.data(), rings_.neighbor.data(), coefficient_.data(), edge_weight_.data(),
            row_weight_.data(),  rest_.data(),           laplacian_.data(),   edge_sum_.data()};
}

// The factor by which one correction in single precision shortens the error, the worst of a smooth
// solution and of two waves over the numbers of the vertices.
double RotationSystem::measure_contraction(const Context& context) const {
    Scratch scratch;
    std::vector<Vec4> x(vertex_count_, Vec4::Zero());
    // A lone free vertex may rest at the origin.
    double size = 1e-300;
    for (const Index v : free_) size = std::max(size, rest_[v].cwiseAbs().maxCoeff());
    for (const Index v : free_) {
        x[v] = {rest_[v].sum() / size, std::cos(0.01 * v), std::cos(1.0 * v), 0.0};
    }
    find_residual(nullptr, x, scratch.residual, scratch, context);
    find_correction(scratch, context);
    Vec3 error = Vec3::Zero(), whole = Vec3::Zero();
    for (std::size_t r = 0; r < free_.size(); ++r) {
        error += (scratch.correction[r] + x[free_[r]].head<3>()).cwiseAbs2();
        whole += x[free_[r]].head<3>().cwiseAbs2();
    }
    return std::sqrt((error.array() / whole.array().max(1e-300)).maxCoeff());
}

void RotationSystem::solve(std::span<const PaddedMat3> transforms, std::span<Vec4> x, bool draft,
                           Scratch& scratch, const Context& context) const {
    find_residual(transforms.data(), x, scratch.residual, scratch, context);
    find_correction(scratch, context);
    add_correction(scratch, x, context);
    if (!draft) correct_further(x, scratch, context);
    if (ties_.has_hard()) enforce_ties(x, scratch.columns);
}

void RotationSystem::finish_draft(std::span<Vec4> x, Scratch& scratch,
                                  const Context& context) const {
    correct_further(x, scratch, context);
}

void RotationSystem::answer(std::span<const Vec3> force, std::span<Vec4> x, Scratch& scratch,
                            const Context& context) const {
    scratch.residual.assign(force.begin(), force.end());
    find_correction(scratch, context);
    add_correction(scratch, x, context);
    correct_further(x, scratch, context);
    if (ties_.has_hard()) enforce_ties(x, scratch.columns);
}

void RotationSystem::correct_further(std::span<Vec4> x, Scratch& scratch,
                                     const Context& context) const {
    if (corrections_ > 1) scratch.step.assign(vertex_count_, Vec4::Zero());
    const auto count = count_of(free_);
    for (int pass = 1; pass < corrections_; ++pass) {
        for_each_block(context, count, [&](Index begin, Index end) {
            for (Index r = begin; r < end; ++r)
                scratch.step[free_[r]] = padded(scratch.correction[r]);
        });
        // Residual after the last correction.
        find_residual(nullptr, scratch.step, scratch.change, scratch, context);
        for_each_block(context, count, [&](Index begin, Index end) {
            for (Index r = begin; r < end; ++r) scratch.residual[r] += scratch.change[r];
        });
        find_correction(scratch, context);
        add_correction(scratch, x, context);
    }
}

void RotationSystem::add_correction(const Scratch& scratch, std::span<Vec4> x,
                                    const Context& context) const {
    for_each_block(context, count_of(free_), [&](Index begin, Index end) {
        for (Index r = begin; r < end; ++r) x[free_[r]].head<3>() += scratch.correction[r];
    });
}

void RotationSystem::bend(const PaddedMat3* transforms, std::span<const Vec4> x,
                          std::vector<Vec4>& bending, const Context& context) const {
    const EnergyLoop loop = energy();
    bending.resize(rest_.size());
    for_each_part(context, rings_.size(), [&](Index begin, Index end) {
        loop.bend(transforms, x.data(), bending.data(), begin, end);
    });
}

Vec3 RotationSystem::force(const PaddedMat3* transforms, std::span<const Vec4> x,
                           std::span<const Index> vertices, Scratch& scratch,
                           const Context& context) const {
    bend(transforms, x, scratch.bending, context);
    return bent_force(transforms, x, vertices, scratch);
}

std::vector<Vec3> RotationSystem::forces(const PaddedMat3* transforms, std::span<const Vec4> x,
                                         std::span<const std::span<const Index>> groups,
                                         Scratch& scratch, const Context& context) const {
    bend(transforms, x, scratch.bending, context);
    std::vector<Vec3> sums;
    for (const auto& vertices : groups) {
        sums.push_back(bent_force(transforms, x, vertices, scratch));
    }
    return sums;
}

// The force by the bending in `scratch`.
Vec3 RotationSystem::bent_force(const PaddedMat3* transforms, std::span<const Vec4> x,
                                std::span<const Index> vertices, Scratch& scratch) const {
    std::vector<Vec3>& parts = scratch.forces;
    parts.assign(vertices.size(), Vec3::Zero());
    energy().descend(transforms, x.data(), scratch.bending.data(), vertices.data(), parts.data(), 0,
                     count_of(vertices));
    Vec3 sum = Vec3::Zero();
    for (const Vec3& part : parts) sum += part;
    return sum;
}

// By their answers a the force is the sum over all vertices of a_i (B S - K x)_i. The part of S_i
// in that is the one that fits it at positions a; and K a, of which K x takes the known part, is
// nothing at free vertices.
std::vector<RotationSystem::Response> RotationSystem::responses(std::span<const Vec4> x,
                                                                Index count, Scratch& scratch,
                                                                const Context& context) const {
    const Index real = rings_.size();
    std::vector<Index> all(at(real));
    std::iota(all.begin(), all.end(), 0);
    std::vector<Mat3> levers(at(real));
    std::vector<Vec3> pulls(at(real));
    std::vector<char> is_free(at(real), 0);
    for (const Index v : free_) is_free[v] = 1;
    bend(nullptr, x, scratch.bending, context);
    const EnergyLoop loop = energy();
    loop.fit(x.data(), all.data(), levers.data(), 0, real);
    loop.descend(nullptr, x.data(), scratch.bending.data(), all.data(), pulls.data(), 0, real);
    std::vector<Response> result(at(count));
    for (Index k = 0; k < count; ++k) {
        Response& response = result[k];
        for (const Vec4& row : x) response.answer.push_back(row[k]);
        for (Index i = 0; i < real; ++i) {
            response.lever.push_back(padded(levers[i].row(k).transpose()));
            if (!is_free[i] && pulls[i][k] != 0.0) response.pull.emplace_back(i, pulls[i][k]);
        }
    }
    return result;
}

Vec3 RotationSystem::solved_force(const PaddedMat3* transforms, std::span<const Vec4> x,
                                  const Response& response, Scratch& scratch,
                                  const Context& context) const {
    const auto count = count_of(response.lever);
    std::vector<Vec4>& parts = scratch.parts;
    parts.assign(at((count + kFrameGrain - 1) / kFrameGrain), Vec4::Zero());
    for_each_part(context, count, [&](Index begin, Index end) {
        Vec4 sum = Vec4::Zero();
        for (Index i = begin; i < end; ++i) sum += transforms[i] * response.lever[i].head<3>();
        parts[begin / kFrameGrain] = sum;
    });
    Vec4 force = Vec4::Zero();
    for (const Vec4& part : parts) force += part;
    for (const auto& [v, pull] : response.pull) force += pull * x[v];
    return force.head<3>();
}

// Right-hand side less the matrix times x, without forming the matrix.
void RotationSystem::find_residual(const PaddedMat3* transforms, std::span<const Vec4> x,
                                   std::vector<Vec3>& residual, Scratch& scratch,
                                   const Context& context) const {
    bend(transforms, x, scratch.bending, context);
    const EnergyLoop loop = energy();
    residual.resize(free_.size());
    for_each_part(context, count_of(free_), [&](Index begin, Index end) {
        loop.descend(transforms, x.data(), scratch.bending.data(), free_.data(), residual.data(),
                     begin, end);
    });
    ties_.subtract_from(x, free_, residual);
}

void RotationSystem::find_correction(Scratch& scratch, const Context& context) const {
    scratch.correction.resize(free_.size());
    if (single_.size() > 0) {
        single_.solve(scratch.residual, scratch.correction, scratch.single, context);
        return;
    }
    const std::size_t rows = free_.size();
    std::vector<double>& columns = scratch.columns;
    columns.resize(3 * rows);
    for (std::size_t r = 0; r < rows; ++r) {
        for (std::size_t d = 0; d < 3; ++d) columns[d * rows + r] = scratch.residual[r][d];
    }
    system_.system().solve(columns, columns, 3);
    for (std::size_t r = 0; r < rows; ++r) {
        scratch.correction[r] = {columns[r], columns[rows + r], columns[2 * rows + r]};
    }
}

void RotationSystem::enforce_ties(std::span<Vec4> x, std::vector<double>& columns) const {
    columns.resize(free_.size());
    for (int d = 0; d < 3; ++d) {
        for (std::size_t r = 0; r < free_.size(); ++r) columns[r] = x[free_[r]][d];
        ties_.enforce([&](Index v) { return x[v][d]; }, columns);
        for (std::size_t r = 0; r < free_.size(); ++r) x[free_[r]][d] = columns[r];
    }
}

}  // namespace lissom
