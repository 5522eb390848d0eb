#include "kernel/deform/volume/volume_springs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "kernel/deform/rotation/polar.h"
#include "kernel/deform/rotation/winding.h"
#include "kernel/deform/system/frame_blocks.h"
#include "kernel/deform/volume/pair_patches.h"

namespace lissom {
namespace {

// More do not change the result: thickness changes slowly along a surface.
constexpr Index kMaxPatches = 60;

// Stiffness beside the edges' at share 1. Bars and torsos keep their volume to a few parts in a
// hundred; at ten times as much they get thicker.
constexpr double kStiffness = 30.0;

// Thickness counts as at least so many mean edge lengths: of a thin wall the springs would be
// stiffer than the surface.
constexpr double kThinnest = 2.0;

// Where handles ask for a stretch whose logarithm is this, springs have no say.
constexpr double kStretch = 0.05;

// Corners without weight do not count: a point on an edge may be found in either triangle.
bool is_free(const ThicknessPair& pair, const std::vector<char>& known) {
    constexpr double kNoWeight = 1e-6;
    bool any = !known[at(pair.vertex)];
    for (int c = 0; c < 3; ++c) {
        any = any || (!known[at(pair.opposite[at(c)])] && pair.weight[c] > kNoWeight);
    }
    return any;
}

}  // namespace

VolumeSprings::VolumeSprings(const Thickness& thickness, const WorkingPatch& work,
                             const KnownMask& known, const RotationSystem& second,
                             const Context& context)
    : free_(second.free_vertices()) {
    for (const ThicknessPair& pair : thickness.pairs) {
        if (is_free(pair, known.position)) pairs_.push_back(pair);
    }
    gather_rows(work);
    if (empty()) return;
    charge_ = context.charge(free_.size() * rows_.size() * sizeof(float), "the volume of a solid");
    find_responses(work.patch.vertex_count, second, context);
}

void VolumeSprings::gather_rows(const WorkingPatch& work) {
    const double thinnest = kThinnest * mean_edge_length_of(work.rings, work.patch.rest);
    for (const PairPatch& patch : spread_patches(pairs_, work, kMaxPatches)) {
        Row row;
        double whole = 0.0;
        for (const auto& [p, share] : patch) {
            const ThicknessPair& pair = pairs_[at(p)];
            const double thickness = std::max(pair.across.norm(), thinnest);
            whole += share * pair.area;
            row.stiffness += share * pair.area / (thickness * thickness);
            row.pairs.emplace_back(p, share * pair.area);
        }
        if (!(whole > 0.0)) continue;
        for (auto& entry : row.pairs) entry.second /= whole;
        rows_.push_back(std::move(row));
    }
}

// Three columns at a time, as coordinates.
void VolumeSprings::find_responses(Index vertices, const RotationSystem& second,
                                   const Context& context) {
    const std::size_t rows = rows_.size();
    std::vector<Index> row_of(at(vertices), kNoIndex);
    for (std::size_t r = 0; r < free_.size(); ++r) row_of[at(free_[r])] = index_of(r);
    response_.assign(free_.size() * rows, 0.0F);
    compliance_.resize(count_of(rows_), count_of(rows_));
    RotationSystem::Scratch scratch;
    std::vector<Vec4> x;
    for (std::size_t first = 0; first < rows; first += 3) {
        context.checkpoint();
        const std::size_t columns = std::min<std::size_t>(3, rows - first);
        std::vector<Vec3> force(free_.size(), Vec3::Zero());
        const auto push = [&](Index v, std::size_t column, double by) {
            if (row_of[at(v)] != kNoIndex) force[at(row_of[at(v)])][index_of(column)] += by;
        };
        for (std::size_t k = 0; k < columns; ++k) {
            for (const auto& [p, share] : rows_[first + k].pairs) {
                const ThicknessPair& pair = pairs_[at(p)];
                push(pair.vertex, k, share);
                for (int c = 0; c < 3; ++c) push(pair.opposite[at(c)], k, -share * pair.weight[c]);
            }
        }
        x.assign(at(vertices), Vec4::Zero());
        second.answer(force, x, scratch, context);
        for (std::size_t r = 0; r < free_.size(); ++r) {
            for (std::size_t k = 0; k < columns; ++k) {
                response_[r * rows + first + k] = static_cast<float>(x[at(free_[r])][index_of(k)]);
            }
        }
        for (std::size_t s = 0; s < rows; ++s) {
            const Vec3 mean = mean_across(rows_[s], x);
            for (std::size_t k = 0; k < columns; ++k) {
                compliance_(index_of(s), index_of(first + k)) = mean[index_of(k)];
            }
        }
    }
    compliance_ = (0.5 * (compliance_ + compliance_.transpose())).eval();
}

Vec3 VolumeSprings::across(const ThicknessPair& pair, std::span<const Vec4> x) {
    Vec4 difference = x[at(pair.vertex)];
    for (int c = 0; c < 3; ++c) difference -= pair.weight[c] * x[at(pair.opposite[at(c)])];
    return difference.head<3>();
}

Vec3 VolumeSprings::mean_across(const Row& row, std::span<const Vec4> x) const {
    Vec3 mean = Vec3::Zero();
    for (const auto& [p, share] : row.pairs) mean += share * across(pairs_[at(p)], x);
    return mean;
}

// How much of a pair's error counts.
double VolumeSprings::say_of(const ThicknessPair& pair, std::span<const Vec4> strain) {
    if (strain.empty()) return 1.0;
    double most = std::abs(strain[at(pair.vertex)][3]);
    for (const Index v : pair.opposite) most = std::max(most, std::abs(strain[at(v)][3]));
    return 1.0 - smooth_step(most / kStretch);
}

// The vector that each pair lacks: its own at rest, turned by the rotation nearest to those of both
// ends, less the present one.
void VolumeSprings::find_errors(const Shape& shape, std::span<const Vec4> x,
                                std::vector<Vec4>& error, const Context& context) const {
    error.resize(pairs_.size());
    for_each_block(context, count_of(pairs_), [&](Index begin, Index end) {
        std::array<Mat3, kFrameBlock> turn;
        const std::size_t count = at(end - begin);
        for (std::size_t i = 0; i < count; ++i) {
            const ThicknessPair& pair = pairs_[at(begin) + i];
            turn[i] = 2.0 * shape.base + shape.rotations[at(pair.vertex)].topRows<3>();
            for (int c = 0; c < 3; ++c) {
                turn[i] += pair.weight[c] * shape.rotations[at(pair.opposite[at(c)])].topRows<3>();
            }
        }
        nearest_rotations({turn.data(), count}, {turn.data(), count});
        for (std::size_t i = 0; i < count; ++i) {
            const ThicknessPair& pair = pairs_[at(begin) + i];
            const Vec3 asked = (turn[i] - shape.base) * pair.across;
            const Vec3 lack = asked - across(pair, x);
            error[at(begin) + i] = padded(Vec3(say_of(pair, shape.strain) * lack));
        }
    });
}

void VolumeSprings::factor(double share, Scratch& scratch) const {
    if (scratch.factored_for == share) return;
    Eigen::MatrixXd matrix = compliance_;
    for (std::size_t r = 0; r < rows_.size(); ++r) {
        const double stiffness = share * kStiffness * rows_[r].stiffness;
        matrix(index_of(r), index_of(r)) += 1.0 / stiffness;
    }
    scratch.factor.compute(matrix);
    scratch.factored_for = share;
}

void VolumeSprings::correct(const Shape& shape, double share, std::span<Vec4> x, Scratch& scratch,
                            const Context& context) const {
    factor(share, scratch);
    find_errors(shape, x, scratch.error, context);
    const std::size_t rows = rows_.size();
    scratch.answer.resize(count_of(rows_), 3);
    context.parallel_for(0, count_of(rows_), 1, [&](Index begin, Index end) {
        for (Index r = begin; r < end; ++r) {
            Vec4 sum = Vec4::Zero();
            for (const auto& [p, part] : rows_[at(r)].pairs) sum += part * scratch.error[at(p)];
            scratch.answer.row(r) = sum.head<3>().transpose();
        }
    });
    scratch.factor.solveInPlace(scratch.answer);
    for_each_block(context, count_of(free_), [&](Index begin, Index end) {
        for (Index row = begin; row < end; ++row) {
            const float* response = &response_[at(row) * rows];
            Vec3 move = Vec3::Zero();
            for (std::size_t r = 0; r < rows; ++r) {
                move +=
                    static_cast<double>(response[r]) * scratch.answer.row(index_of(r)).transpose();
            }
            x[at(free_[at(row)])].head<3>() += move;
        }
    });
}

}  // namespace lissom
