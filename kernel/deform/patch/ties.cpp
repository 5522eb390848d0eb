#include "kernel/deform/patch/ties.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <map>

namespace lissom {
namespace {

// Rows whose squared length, outside the span of those before them, is below this share of the
// whole are dependent.
constexpr double kDependent = 1e-9;

SparseRow merged(const SparseRow& row) {
    std::map<Index, double> sums;
    for (const auto& [index, c] : row) sums[index] += c;
    return {sums.begin(), sums.end()};
}

double dot(const SparseRow& a, const SparseRow& b) {
    double sum = 0.0;
    for (const auto& [i, c] : a) {
        for (const auto& [j, d] : b) sum += i == j ? c * d : 0.0;
    }
    return sum;
}

// Adds to entries that exist; returns those that do not.
std::vector<Triplet> add_existing(SymmetricMatrix& matrix, const std::vector<Triplet>& entries) {
    std::vector<Triplet> missing;
    for (const Triplet& e : entries) {
        const auto first = matrix.row.begin() + matrix.begin[e.column];
        const auto last = matrix.row.begin() + matrix.begin[e.column + 1];
        const auto at = std::lower_bound(first, last, e.row);
        if (at == last || *at != e.row) {
            missing.push_back(e);
        } else {
            matrix.value[at - matrix.row.begin()] += e.value;
        }
    }
    return missing;
}

void add_missing(SymmetricMatrix& matrix, const std::vector<Triplet>& entries) {
    const SymmetricMatrix extra = symmetric_from_triplets(matrix.size(), entries);
    SymmetricMatrix sum;
    sum.row.reserve(matrix.nonzeros() + entries.size());
    sum.value.reserve(matrix.nonzeros() + entries.size());
    for (Index j = 0; j < matrix.size(); ++j) {
        Index a = matrix.begin[j], b = extra.begin[j] + 1;  // its diagonal is zero
        while (a < matrix.begin[j + 1] || b < extra.begin[j + 1]) {
            const bool take_extra = a == matrix.begin[j + 1] ||
                                    (b < extra.begin[j + 1] && extra.row[b] < matrix.row[a]);
            sum.row.push_back(take_extra ? extra.row[b] : matrix.row[a]);
            sum.value.push_back(take_extra ? extra.value[b++] : matrix.value[a++]);
        }
        sum.begin.push_back(count_of(sum.row));
    }
    matrix = std::move(sum);
}

}  // namespace

void Ties::add(SparseRow over, Index at, double w, bool exact) {
    row.push_back(std::move(over));
    anchor.push_back(at);
    weight.push_back(w);
    hard.push_back(exact);
}

TieRows::TieRows(const Ties& ties, const std::vector<Index>& row_of, double unit,
                 const std::function<SparseRow(Index)>& final_position) {
    for (Index t = 0; t < ties.size(); ++t) {
        SparseRow solved;
        for (const auto& [v, c] : ties.row[t]) {
            for (const auto& [k, d] : final_position(v)) solved.emplace_back(k, c * d);
        }
        Tie tie{{}, {{ties.anchor[t], -1.0}}, unit * ties.weight[t], ties.hard[t] != 0};
        for (const auto& [k, c] : merged(solved)) {
            if (row_of[k] == kNoIndex) {
                tie.known.emplace_back(k, c);
            } else {
                tie.free.emplace_back(row_of[k], c);
            }
        }
        if (!tie.free.empty()) ties_.push_back(std::move(tie));
    }
}

void TieRows::add_to(SymmetricMatrix& matrix) const {
    std::vector<Triplet> entries;
    for (const Tie& tie : ties_) {
        for (const auto& [i, c] : tie.free) {
            for (const auto& [j, d] : tie.free) {
                if (i >= j) entries.push_back({i, j, tie.weight * c * d});
            }
        }
    }
    const std::vector<Triplet> missing = add_existing(matrix, entries);
    if (!missing.empty()) add_missing(matrix, missing);
}

void TieRows::subtract_from(std::span<const Vec4> positions, const std::vector<Index>& free,
                            std::vector<Vec3>& residual) const {
    for (const Tie& tie : ties_) {
        Vec3 miss = Vec3::Zero();
        for (const auto& [vertex, c] : tie.known) miss += c * positions[vertex].head<3>();
        for (const auto& [row, c] : tie.free) miss += c * positions[free[row]].head<3>();
        for (const auto& [row, c] : tie.free) residual[row] -= tie.weight * c * miss;
    }
}

struct TieRows::Factor {
    Eigen::LDLT<Eigen::MatrixXd> of;
};

void TieRows::prepare(
    Index unknowns,
    const std::function<void(std::span<const double>, std::span<double>, Index)>& solve) {
    std::vector<const Tie*> hard;
    for (const Tie& tie : ties_) {
        if (tie.hard) hard.push_back(&tie);
    }
    const auto count = count_of(hard);
    response_.setZero(unknowns, count);
    if (count == 0) return;
    for (Index n = 0; n < count; ++n) {
        for (const auto& [row, c] : hard[n]->free) response_(row, n) = c;
    }
    const std::size_t size = response_.size();
    solve({response_.data(), size}, {response_.data(), size}, count);
    Eigen::MatrixXd schur = Eigen::MatrixXd::Zero(count, count);
    for (Index n = 0; n < count; ++n) {
        for (const auto& [row, c] : hard[n]->free) schur.row(n) += c * response_.row(row);
    }
    schur_ = std::make_shared<const Factor>(Factor{Eigen::LDLT<Eigen::MatrixXd>(schur)});
}

void TieRows::take_off(const Eigen::VectorXd& miss, std::span<double> x) const {
    Eigen::Map<Eigen::VectorXd>(x.data(), response_.rows()).noalias() -=
        response_ * schur_->of.solve(miss);
}

std::size_t TieRows::response_bytes(const Ties& ties, Index unknowns) {
    const auto count = std::count(ties.hard.begin(), ties.hard.end(), char{1});
    return at(count) * unknowns * sizeof(double);
}

std::vector<Index> dependent_ties(const Ties& ties, const std::vector<char>& position_known) {
    std::vector<SparseRow> basis;
    std::vector<Index> dependent;
    for (Index t = 0; t < ties.size(); ++t) {
        if (!ties.hard[t]) continue;
        SparseRow row;
        for (const auto& [v, c] : ties.row[t]) {
            if (!position_known[v]) row.emplace_back(v, c);
        }
        const double whole = dot(row, row);
        for (const SparseRow& before : basis) {
            const double along = dot(row, before);
            if (along == 0.0) continue;
            for (const auto& [v, c] : before) row.emplace_back(v, -along * c);
            row = merged(row);
        }
        const double length = dot(row, row);
        if (!(length > kDependent * whole)) {
            dependent.push_back(t);
            continue;
        }
        for (auto& entry : row) entry.second /= std::sqrt(length);
        basis.push_back(std::move(row));
    }
    return dependent;
}

}  // namespace lissom
