/// Ties: soft constraints, and constraints of points other than vertices. An anchor is a point
/// beside the surface that moves like a held vertex; a tie asks a mean of vertices to lie at its
/// anchor. Private to kernel/deform.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/deform/patch/sparse_row.h"
#include "kernel/solve/sparse/sparse_matrix.h"

namespace lissom {

/// Ties of a patch. Tie t asks that the sum of its row over vertices equals the anchor's position:
/// exactly if it is hard, or else in the least squares sense, with a weight that has no unit.
struct Ties {
    std::vector<SparseRow> row;
    std::vector<Index> anchor;
    std::vector<double> weight;
    std::vector<char> hard;

    Index size() const { return count_of(row); }
    void add(SparseRow over, Index at, double w, bool exact);
};

/// Asks the deformation gradient of a vertex to be that of an anchor, with a weight without unit.
struct GradientTie {
    Index vertex = kNoIndex, anchor = kNoIndex;
    double weight = 0.0;
};

/// The ties of one linear system: their terms in its matrix and right-hand side, and the correction
/// of its solutions that makes hard ties exact.
class TieRows {
  public:
    TieRows() = default;
    /// `row_of` gives the unknown of each local vertex or kNoIndex; `final_position` the row of
    /// solved positions that add up to a vertex's final position; `unit` multiplies all weights.
    /// Ties without an unknown have no say.
    TieRows(const Ties& ties, const std::vector<Index>& row_of, double unit,
            const std::function<SparseRow(Index)>& final_position);

    bool empty() const { return ties_.empty(); }
    bool has_hard() const { return response_.cols() > 0; }

    /// Adds w c c^T of every tie.
    void add_to(SymmetricMatrix& matrix) const;

    /// Adds w c (anchor - the part of known vertices), for known coordinates `position(k)`.
    template <typename Position, typename Real>
    void add_right_hand_side(const Position& position, Real* b) const {
        for (const Tie& tie : ties_) {
            const double asked = -tie.weight * known_part(tie, position);
            for (const auto& [row, c] : tie.free) b[row] += asked * c;
        }
    }

    /// Takes w c (the tied mean - anchor) off the residual of each unknown, for positions of all
    /// local vertices; `free` are the unknowns.
    void subtract_from(std::span<const Vec4> positions, const std::vector<Index>& free,
                       std::vector<Vec3>& residual) const;

    /// Solves for the response to each hard tie: `solve(b, x, columns)` solves the system.
    void prepare(
        Index unknowns,
        const std::function<void(std::span<const double>, std::span<double>, Index)>& solve);

    /// Moves a solution onto the hard ties in the way that costs least energy.
    template <typename Position>
    void enforce(const Position& position, std::span<double> x) const {
        if (response_.cols() == 0) return;
        // The second pass takes out the rounding of the first.
        for (int pass = 0; pass < 2; ++pass) {
            Eigen::VectorXd miss(response_.cols());
            Index n = 0;
            for (const Tie& tie : ties_) {
                if (!tie.hard) continue;
                double sum = known_part(tie, position);
                for (const auto& [row, c] : tie.free) sum += c * x[at(row)];
                miss[n++] = sum;
            }
            if (miss.isZero(0.0)) return;
            take_off(miss, x);
        }
    }

    /// Bytes of the responses to `ties`' hard ties over `unknowns` unknowns.
    static std::size_t response_bytes(const Ties& ties, Index unknowns);

  private:
    struct Tie {
        SparseRow free, known;
        double weight = 0.0;
        bool hard = false;
    };

    template <typename Position>
    static double known_part(const Tie& tie, const Position& position) {
        double sum = 0.0;
        for (const auto& [vertex, c] : tie.known) sum += c * position(vertex);
        return sum;
    }

    /// Takes the error of the hard ties off `x`.
    void take_off(const Eigen::VectorXd& miss, std::span<double> x) const;

    struct Factor;

    std::vector<Tie> ties_;
    Eigen::MatrixXd response_;
    /// Matrix of the responses of hard ties to each other.
    std::shared_ptr<const Factor> schur_;
};

/// Returns the linearly dependent hard ties: their rows over unknown vertices follow from others.
std::vector<Index> dependent_ties(const Ties& ties, const std::vector<char>& position_known);

}  // namespace lissom
