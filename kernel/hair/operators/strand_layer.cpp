#include "kernel/hair/operators/strand_layer.h"

#include <algorithm>
#include <cmath>

#include "kernel/core/error.h"
#include "kernel/hair/strands/strand_random.h"

namespace lissom {
namespace {

constexpr double kLayerCell = 4.0 * kDegree;
// Heights are counted in bins of a millimetre.
constexpr double kBin = 0.001;
constexpr Index kBins = 128;
constexpr float kHighPart = 0.9f;
constexpr std::uint64_t kLiftStream = 31;
constexpr double kLiftSlack = 1e-5;
constexpr int kLiftRounds = 5, kLiftSteps = 3, kLiftSmoothings = 2;

// Elevation, and turn about the second axis as a part of a whole one, 0 to 1.
struct LayerAngles {
    double rise, turn;
};

LayerAngles angles_of(const Vec3& p) {
    const double turn = std::atan2(p.x(), p.z()) / (2.0 * kPi);
    return {std::atan2(p.y(), std::hypot(p.x(), p.z())), turn < 0.0 ? turn + 1.0 : turn};
}

// Height below which a part of the counted points lies.
double height_of(const float* bins) {
    float sum = 0.0f;
    for (Index b = 0; b < kBins; ++b) sum += bins[b];
    if (sum == 0.0f) return 0.0;
    float below = 0.0f;
    for (Index b = 0; b < kBins; ++b) {
        if (below + bins[b] >= kHighPart * sum) {
            return kBin * (b + (kHighPart * sum - below) / bins[b]);
        }
        below += bins[b];
    }
    return kBin * kBins;
}

}  // namespace

LayerThickness::LayerThickness(const Strands& lower, const BodyDistance& distance,
                               const Vec3& center, const Context& context)
    : center_(center) {
    const auto rows = static_cast<Index>(std::lround(kPi / kLayerCell));
    Index cells = 0;
    for (Index r = 0; r < rows; ++r) {
        const double rise = (r + 0.5) * kPi / rows - kPi / 2.0;
        const auto count = std::max<Index>(3, std::lround(2.0 * kPi * std::cos(rise) / kLayerCell));
        rows_.push_back({cells, count});
        cells += count;
    }
    std::vector<float> heights(lissom::at(lower.point_count()), -1.0f);
    context.parallel_for(0, lower.size(), 64, [&](Index begin, Index end) {
        for (Index s = begin; s < end; ++s) {
            for (Index k = 1; k < lower.point_count(s); ++k) {
                const double height = distance(point_of(lower.strand(s), k));
                heights[lissom::at(lower.first_point(s) + k)] = static_cast<float>(height);
            }
        }
    });
    std::vector<float> counts(lissom::at(cells) * kBins, 0.0f);
    for (Index s = 0; s < lower.size(); ++s) {
        for (Index k = 1; k < lower.point_count(s); ++k) {
            const float height = heights[lissom::at(lower.first_point(s) + k)];
            if (!(height >= 0.0f)) continue;
            const auto bin = static_cast<Index>(std::min<double>(height / kBin, kBins - 1));
            const Vec3 p = point_of(lower.strand(s), k);
            counts[lissom::at(cell_of(p)) * kBins + lissom::at(bin)] += 1.0f;
        }
    }
    set_heights(counts);
    smooth_heights();
}

Index LayerThickness::cell_of(const Vec3& point) const {
    const LayerAngles angles = angles_of(point - center_);
    const Index count = count_of(rows_);
    const auto row = static_cast<Index>((angles.rise + kPi / 2.0) / kPi * count);
    const Row& cells = rows_[lissom::at(std::clamp<Index>(row, 0, count - 1))];
    const auto cell = static_cast<Index>(angles.turn * cells.cells);
    return cells.first + std::min(cell, cells.cells - 1);
}

void LayerThickness::set_heights(const std::vector<float>& counts) {
    heights_.resize(counts.size() / kBins);
    for (std::size_t c = 0; c < heights_.size(); ++c) heights_[c] = height_of(&counts[c * kBins]);
}

// The mean of the cells around each, a cell apart; cells without hair near none stay without.
void LayerThickness::smooth_heights() {
    std::vector<double> smoothed(heights_.size());
    const double step = kPi / count_of(rows_);
    for (Index r = 0; r < count_of(rows_); ++r) {
        const Row& row = rows_[lissom::at(r)];
        for (Index c = 0; c < row.cells; ++c) {
            double sum = 0.0;
            for (int up = -1; up <= 1; ++up) {
                for (int side = -1; side <= 1; ++side) {
                    const double rise = (r + up + 0.5) * step - kPi / 2.0;
                    sum += at_angles(rise, (c + side + 0.5) / row.cells);
                }
            }
            smoothed[lissom::at(row.first + c)] = sum / 9.0;
        }
    }
    heights_ = std::move(smoothed);
}

double LayerThickness::in_row(Index row, double turn) const {
    const Row& cells = rows_[lissom::at(row)];
    const double place = turn * cells.cells - 0.5;
    const double below = std::floor(place);
    const auto cell = [&](double i) {
        const auto wrapped = static_cast<Index>(i) % cells.cells;
        return heights_[lissom::at(cells.first + (wrapped + cells.cells) % cells.cells)];
    };
    return cell(below) + (place - below) * (cell(below + 1.0) - cell(below));
}

double LayerThickness::at_angles(double rise, double turn) const {
    const Index last = count_of(rows_) - 1;
    const double place = std::clamp((rise / kPi + 0.5) * (last + 1) - 0.5, 0.0, double(last));
    const auto below = std::min(static_cast<Index>(place), last - 1);
    const double low = in_row(below, turn), high = in_row(below + 1, turn);
    return low + (place - below) * (high - low);
}

double LayerThickness::at(const Vec3& point) const {
    const LayerAngles angles = angles_of(point - center_);
    return at_angles(angles.rise, angles.turn);
}

namespace {

// Lifts one strand.
class LayerLifter {
  public:
    LayerLifter(const LiftOverOptions& options, StrandWork& work)
        : options_(options),
          work_(work),
          extra_(options.gap +
                 0.5 * options.spread *
                     (1.0 + signed_random(mixed(options.seed, work.id(), kLiftStream)))) {}

    // Lengths that are restored take back a part of the lift: the rest follows in later rounds.
    void run() {
        for (int round = 0; round < kLiftRounds; ++round) {
            if (!lift_all()) return;
            if (options_.keep_length) work_.restore_lengths();
        }
    }

  private:
    double floor_at(Index k, const Vec3& p) const {
        const double thickness = options_.layer->at(p);
        if (!(thickness > kLiftSlack)) return 0.0;
        const double rise = smooth_step(0.0, options_.ramp, work_.arc(k));
        return (thickness + extra_) * rise * work_.weight(k);
    }

    bool lift(Index k, Vec3& move) const {
        Vec3 p = work_.point(k);
        for (int i = 0; i < kLiftSteps; ++i) {
            const double missing = floor_at(k, p) - options_.distance(p);
            if (!(missing > kLiftSlack)) break;
            p += missing * outward_at(options_.distance, p);
        }
        move = p - work_.point(k);
        return move.squaredNorm() > 0.0;
    }

    bool lift_all() {
        std::vector<Vec3> moves(at(work_.count()), Vec3::Zero());
        bool any = false;
        for (Index k = 1; k < work_.count(); ++k) any = lift(k, moves[at(k)]) || any;
        if (!any) return false;
        for (int i = 0; i < kLiftSmoothings; ++i) smooth_moves(moves);
        for (Index k = 1; k < work_.count(); ++k) {
            work_.set_point(k, work_.point(k) + moves[at(k)]);
        }
        return true;
    }

    // So that a strand that leaves the layer does not kink; roots stay.
    static void smooth_moves(std::vector<Vec3>& moves) {
        Vec3 before = moves.front();
        for (std::size_t k = 1; k < moves.size(); ++k) {
            const Vec3 after = k + 1 < moves.size() ? moves[k + 1] : moves[k];
            const Vec3 mean = 0.25 * before + 0.5 * moves[k] + 0.25 * after;
            before = moves[k];
            moves[k] = mean;
        }
    }

    const LiftOverOptions& options_;
    StrandWork& work_;
    double extra_;
};

}  // namespace

void lift_over(Strands& strands, const LiftOverOptions& options, const Context& context) {
    require(options.layer && options.distance, "lifting over hair needs its layer and a distance");
    require(is_length(options.gap) && is_length(options.spread) && is_length(options.ramp),
            "the gap, the spread and the ramp over a layer must be finite and not negative");
    Progress progress(context, "lift strands over a layer");
    const auto change = [&](StrandWork& work) { LayerLifter(options, work).run(); };
    change_strands(strands, options, change, context);
}

}  // namespace lissom
