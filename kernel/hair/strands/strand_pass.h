/// The options that operators on strands share, and the loop over strands that they run in.
///
/// Guarantees of all operators: roots never move; the result of a strand depends on it, its id, the
/// seed and its guide alone, so the first n of all results are the results of the first n strands
/// if these hold all guides; threads do not matter. Strands with a coordinate that is not finite,
/// of one point or without length stay as they are. An operator that throws has changed nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/hair/strands/strands.h"

namespace lissom {

/// Strength of an operator by place: its effect on a point is multiplied by the factor, by the
/// mask of the strand, and by the profile at the point's place along the strand.
struct StrandOperatorOptions {
    /// Part of the effect, 0 to 1; 0 changes nothing.
    double factor = 1.0;
    /// The profile is t^shape, t being 0 at the root and 1 at the tip; 0 or more.
    double shape = 0.0;
    /// Or, if there are any, these numbers at equal steps from the root to the tip, linear between;
    /// 0 to 1.
    std::vector<double> profile = {};
    /// Part of the effect on each strand, 0 to 1; empty for all of it.
    std::vector<float> mask = {};
    /// Segments keep their lengths. Operators whose purpose is another length do not look at it.
    bool keep_length = true;
    std::uint64_t seed = 1;
};

/// Throws invalid_argument for options out of range, or for a mask of another number of strands.
void require_operator(const Strands& strands, const StrandOperatorOptions& options);

/// One strand under an operator.
class StrandWork {
  public:
    /// `old` has `count` points, `made` begins as the same.
    StrandWork(const Strands& strands, const StrandOperatorOptions& options);

    /// Takes a strand; false if it stays as it is.
    bool take(Index strand, const float* old, float* made);

    Index strand() const { return strand_; }
    std::uint32_t id() const { return strands_.id(strand_); }
    Index count() const { return count_; }
    /// Length of the strand as it was, in its unit.
    double length() const { return arcs_.back(); }
    /// Length as it was from the root to a point, and its part of the whole.
    double arc(Index k) const { return arcs_[at(k)]; }
    const std::vector<double>& arcs() const { return arcs_; }
    double t(Index k) const { return arcs_[at(k)] * part_of_length_; }
    /// Part of the effect at a point or at a place along the strand, 0 to 1.
    double weight(Index k) const { return weight_at(t(k)); }
    double weight_at(double t) const { return profile_.empty() ? mask_ : profiled_weight(t); }
    /// The points as they were, and as they become.
    StrandView old_points() const { return {old_, 3, count_}; }
    StrandEdit points() { return {made_, 3, count_}; }
    Vec3 old_point(Index k) const {
        const float* const p = old_ + 3 * at(k);
        return {p[0], p[1], p[2]};
    }
    Vec3 point(Index k) const {
        const float* const p = made_ + 3 * at(k);
        return {p[0], p[1], p[2]};
    }
    void set_point(Index k, const Vec3& point) {
        float* const p = made_ + 3 * at(k);
        for (std::size_t i = 0; i < 3; ++i) p[i] = static_cast<float>(point[Index(i)]);
    }
    /// The old strand at an arc, from a place `below` that grows with the arc.
    Vec3 old_at(double arc, Index& below) const;
    /// Unit tangents of the old strand, and normals that turn about it as little as possible from
    /// the part of `first` across the root on.
    void make_frames(const Vec3& first);
    const Vec3& tangent(Index k) const { return tangents_[at(k)]; }
    const Vec3& normal(Index k) const { return normals_[at(k)]; }

    /// Whether any part of the effect may be below 1.
    bool is_partial() const {
        return mask_ < 1.0 || options_.shape != 0.0 || !options_.profile.empty();
    }
    /// Moves the points that were set back to where the factor, mask and profile let them go, and
    /// gives segments their old lengths if they keep these.
    void blend();
    /// Gives segments, in their directions, the lengths of the old strand times a factor.
    void restore_lengths(double factor = 1.0);
    /// The same with equal segments of a strand of this length.
    void space_evenly(double length);

  private:
    double profiled_weight(double t) const;
    void scale_segments(const float* lengths);

    const Strands& strands_;
    const StrandOperatorOptions& options_;
    // The profile at equal steps; empty for 1 everywhere.
    std::vector<double> profile_;
    Index strand_ = 0, count_ = 0;
    double mask_ = 1.0, part_of_length_ = 0.0;
    const float* old_ = nullptr;
    float* made_ = nullptr;
    std::vector<double> arcs_;
    /// Lengths of the segments before the points, as they were; and room for others.
    std::vector<float> segments_, scales_;
    std::vector<Vec3> tangents_, normals_;
};

/// Calls `change(work)` for every strand that the mask holds and that has a length, on several
/// threads, in place. Errors: as require_operator; not_finite naming strands that were finite and
/// no longer are; those of `change`; memory_limit, cancelled. After one the points are as they
/// were.
void change_strands(Strands& strands, const StrandOperatorOptions& options,
                    const std::function<void(StrandWork& work)>& change, const Context& context);

/// The same, with a change for each run of strands that one thread takes one after the other, made
/// by `make()`: it may keep room between strands, but nothing that their results depend on.
void change_strand_runs(Strands& strands, const StrandOperatorOptions& options,
                        const std::function<std::function<void(StrandWork& work)>()>& make,
                        const Context& context);

/// Sine of 2 pi x, to 1e-5; the same on every machine. Without branches, so that loops over it
/// become vector instructions.
inline double sine_of_turns(double x) {
    // To half a turn about 0, as adding 1.5 * 2^52 rounds; then to a quarter.
    constexpr double kRound = 6755399441055744.0;
    x -= (x + kRound) - kRound;
    const double folded = (x < 0.0 ? -0.5 : 0.5) - x;
    x = x * x > 0.0625 ? folded : x;
    const double y = 2.0 * kPi * x, q = y * y;
    return y * (1.0 + q * (-1.0 / 6 + q * (1.0 / 120 + q * (-1.0 / 5040 + q / 362880))));
}
inline double cosine_of_turns(double x) {
    return sine_of_turns(x + 0.25);
}

/// Level at both ends: 0 up to `low`, 1 from `high` on.
inline double smooth_step(double low, double high, double x) {
    if (x <= low) return 0.0;
    if (x >= high) return 1.0;
    const double t = (x - low) / (high - low);
    return t * t * (3.0 - 2.0 * t);
}

}  // namespace lissom
