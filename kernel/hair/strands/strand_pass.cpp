#include "kernel/hair/strands/strand_pass.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstring>
#include <memory>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/core/large_pages.h"
#include "kernel/hair/strands/strand_frames.h"

namespace lissom {
namespace {

constexpr Index kPassGrain = 128;
// Steps of a profile that is a power of the place: enough for any exponent to look smooth.
constexpr std::size_t kPowerSteps = 128;
// A segment that would have to grow by more has no direction.
constexpr float kLongest = 1e12f;

bool is_part(double x) {
    return x >= 0.0 && x <= 1.0;
}

bool all_finite(const float* values, std::size_t count) {
    const Eigen::Map<const Eigen::ArrayXf> all(values, index_of(count));
    return (all * 0.0f).sum() == 0.0f;
}

// Lengths of segments, of each that before the point; 0 for the root.
void segment_lengths(const float* points, Index count, std::vector<float>& lengths) {
    lengths.resize(at(count));
    lengths[0] = 0.0f;
    const float* p = points;
    for (Index k = 1; k < count; ++k, p += 3) {
        const float x = p[3] - p[0], y = p[4] - p[1], z = p[5] - p[2];
        lengths[at(k)] = x * x + y * y + z * z;
    }
    Eigen::Map<Eigen::ArrayXf> all(lengths.data(), count);
    all = all.sqrt();
    if (all_finite(lengths.data(), at(count))) return;
    // Squares of lengths from 1e19 on exceed 32-bit numbers.
    const Eigen::Map<const Eigen::Matrix3Xf> columns(points, 3, count);
    for (Index k = 1; k < count; ++k) {
        const Vec3 segment = columns.col(k).cast<double>() - columns.col(k - 1).cast<double>();
        lengths[at(k)] = static_cast<float>(segment.norm());
    }
}

// The points as they were, kept strand by strand before each changes.
class Backup {
  public:
    explicit Backup(Strands& strands)
        : strands_(strands),
          old_(large_array<float>(strands.points().size())),
          kept_(at(strands.size() / kPassGrain + 1)) {}

    // Keeps the strands of a chunk and returns their old points.
    const float* keep(Index begin, Index end) {
        const auto [from, count] = range(begin, end);
        if (count > 0) std::memcpy(&old_[from], &strands_.points()[from], count * sizeof(float));
        kept_[at(begin / kPassGrain)] = 1;
        return old_.get();
    }

    void restore() {
        for (std::size_t i = 0; i < kept_.size(); ++i) {
            if (!kept_[i]) continue;
            const Index begin = index_of(i) * kPassGrain;
            const auto [from, count] = range(begin, std::min(begin + kPassGrain, strands_.size()));
            if (count == 0) continue;
            std::memcpy(&strands_.edit_points()[from], &old_[from], count * sizeof(float));
        }
    }

  private:
    std::pair<std::size_t, std::size_t> range(Index begin, Index end) const {
        const std::size_t from = 3 * at(strands_.offsets()[at(begin)]);
        return {from, 3 * at(strands_.offsets()[at(end)]) - from};
    }

    Strands& strands_;
    std::unique_ptr<float[]> old_;
    std::vector<char> kept_;
};

void require_finite_strands(const std::vector<std::vector<Index>>& lists) {
    Elements bad{ElementKind::strand, 0, {}};
    for (const std::vector<Index>& list : lists) {
        for (const Index s : list) bad.add(s);
    }
    if (bad.count == 0) return;
    const std::string names = describe(bad);
    throw Error(ErrorCode::not_finite, names + " would exceed the range of 32-bit numbers",
                std::move(bad));
}

}  // namespace

void require_operator(const Strands& strands, const StrandOperatorOptions& options) {
    require(is_part(options.factor), "the factor of an operator must be from 0 to 1");
    require(options.shape >= 0.0 && std::isfinite(options.shape),
            "the shape of an operator must be 0 or more");
    require(std::all_of(options.profile.begin(), options.profile.end(), is_part),
            "the numbers of a profile must be from 0 to 1");
    require(std::all_of(options.mask.begin(), options.mask.end(), is_part),
            "the numbers of a mask must be from 0 to 1");
    require(options.mask.empty() || count_of(options.mask) == strands.size(),
            "the mask has " + std::to_string(options.mask.size()) + " numbers for " +
                std::to_string(strands.size()) + " strands; give one for each strand");
}

StrandWork::StrandWork(const Strands& strands, const StrandOperatorOptions& options)
    : strands_(strands), options_(options), profile_(options.profile) {
    if (!profile_.empty() || options.shape == 0.0) return;
    const std::size_t steps = options.shape == 1.0 ? 1 : kPowerSteps;
    for (std::size_t i = 0; i <= steps; ++i) {
        profile_.push_back(std::pow(double(i) / double(steps), options.shape));
    }
}

bool StrandWork::take(Index strand, const float* old, float* made) {
    strand_ = strand;
    count_ = strands_.point_count(strand);
    mask_ = options_.factor * (options_.mask.empty() ? 1.0 : options_.mask[at(strand)]);
    old_ = old;
    made_ = made;
    if (count_ < 2 || mask_ == 0.0) return false;
    arcs_.resize(at(count_));
    segment_lengths(old_, count_, segments_);
    double sum = 0.0;
    for (std::size_t k = 0; k < at(count_); ++k) arcs_[k] = sum += segments_[k];
    part_of_length_ = 1.0 / sum;
    return sum > 0.0 && std::isfinite(sum);
}

double StrandWork::profiled_weight(double t) const {
    const std::size_t last = profile_.size() - 1;
    if (last == 1 && t >= 0.0 && t <= 1.0) {
        return mask_ * (profile_[0] + t * (profile_[1] - profile_[0]));
    }
    const double place = std::clamp(t, 0.0, 1.0) * double(last);
    const auto below = std::min(static_cast<std::size_t>(place), last);
    const double u = place - double(below), a = profile_[below];
    return mask_ * (a + u * (profile_[std::min(below + 1, last)] - a));
}

Vec3 StrandWork::old_at(double arc, Index& below) const {
    while (below + 2 < count_ && arcs_[at(below + 1)] < arc) ++below;
    const double from = arcs_[at(below)], size = arcs_[at(below + 1)] - from;
    const double u = size > 0.0 ? std::clamp((arc - from) / size, 0.0, 1.0) : 0.0;
    const Vec3 a = old_point(below);
    return a + u * (old_point(below + 1) - a);
}

void StrandWork::make_frames(const Vec3& first) {
    tangents_.resize(at(count_));
    normals_.resize(at(count_));
    Vec3 tangent = Vec3::UnitY();
    for (Index k = 0; k < count_; ++k) {
        const Vec3 along = old_point(std::min(k + 1, count_ - 1)) - old_point(std::max(k - 1, 0));
        const double size = along.norm();
        if (size > 0.0) tangent = along / size;
        tangents_[at(k)] = tangent;
    }
    Vec3 normal = first;
    for (Index k = 0; k < count_; ++k) {
        const Vec3& now = tangents_[at(k)];
        if (k > 0) {
            normal =
                carried_normal(normal, old_point(k) - old_point(k - 1), tangents_[at(k - 1)], now);
        }
        normal -= normal.dot(now) * now;
        const double size = normal.norm();
        normal = size > 1e-6 ? Vec3(normal / size) : Vec3(now.unitOrthogonal());
        normals_[at(k)] = normal;
    }
}

void StrandWork::blend() {
    if (is_partial()) {
        for (Index k = 1; k < count_; ++k) {
            const Vec3 old = old_point(k);
            set_point(k, old + weight(k) * (point(k) - old));
        }
    }
    if (options_.keep_length) restore_lengths();
}

// Sums the segments anew, each of the length that is given for it: offsets from the root, so that
// few digits are lost far from the origin.
void StrandWork::scale_segments(const float* lengths) {
    segment_lengths(made_, count_, scales_);
    Eigen::Map<Eigen::ArrayXf> scales(scales_.data(), count_);
    scales = Eigen::Map<const Eigen::ArrayXf>(lengths, count_) / scales;
    std::array<float, 3> before{old_[0], old_[1], old_[2]}, end{};
    float* p = made_ + 3;
    for (Index k = 1; k < count_; ++k, p += 3) {
        const float scale = scales_[at(k)];
        const float* const old = old_ + 3 * at(k);
        const float* const last = old - 3;
        // A segment without direction takes the old one.
        if (!(scale < kLongest)) {
            const float old_scale = segments_[at(k)] > 0.0f ? lengths[k] / segments_[at(k)] : 0.0f;
            for (std::size_t i = 0; i < 3; ++i) {
                before[i] = p[i];
                end[i] += old_scale * (old[i] - last[i]);
                p[i] = old_[i] + end[i];
            }
            continue;
        }
        for (std::size_t i = 0; i < 3; ++i) {
            const float segment = p[i] - before[i];
            before[i] = p[i];
            end[i] += scale * segment;
            p[i] = old_[i] + end[i];
        }
    }
}

void StrandWork::restore_lengths(double factor) {
    if (factor == 1.0) return scale_segments(segments_.data());
    std::vector<float> lengths = segments_;
    for (float& length : lengths) length *= static_cast<float>(factor);
    scale_segments(lengths.data());
}

void StrandWork::space_evenly(double length) {
    const std::vector<float> lengths(at(count_), static_cast<float>(length / (count_ - 1)));
    scale_segments(lengths.data());
}

namespace {

// Room of the threads for the strand that each changes, which matters if one has most points.
std::size_t bytes_of_work(const Strands& strands, const Context& context) {
    constexpr std::size_t kBytesOfPoint = 320;
    Index longest = 0;
    for (Index s = 0; s < strands.size(); ++s) longest = std::max(longest, strands.point_count(s));
    return kBytesOfPoint * at(longest) * at(std::min(context.threads(), strands.size()));
}

}  // namespace

void change_strands(Strands& strands, const StrandOperatorOptions& options,
                    const std::function<void(StrandWork& work)>& change, const Context& context) {
    const auto make = [&]() -> std::function<void(StrandWork&)> { return std::ref(change); };
    change_strand_runs(strands, options, make, context);
}

void change_strand_runs(Strands& strands, const StrandOperatorOptions& options,
                        const std::function<std::function<void(StrandWork& work)>()>& make,
                        const Context& context) {
    require_operator(strands, options);
    if (options.factor == 0.0 || strands.empty()) return;
    const MemoryCharge charge = context.charge(
        strands.points().size_bytes() + bytes_of_work(strands, context), "changing strands");
    Backup backup(strands);
    std::vector<std::vector<Index>> bad(at(strands.size() / kPassGrain + 1));
    float* const points = strands.edit_points().data();
    try {
        context.parallel_for(0, strands.size(), kPassGrain, [&](Index begin, Index end) {
            const float* const old = backup.keep(begin, end);
            StrandWork work(strands, options);
            const std::function<void(StrandWork&)> change = make();
            for (Index s = begin; s < end; ++s) {
                const std::size_t first = 3 * at(strands.first_point(s));
                if (!work.take(s, old + first, points + first)) continue;
                change(work);
                std::memcpy(points + first, old + first, 3 * sizeof(float));
                if (!all_finite(points + first, 3 * at(work.count()))) {
                    bad[at(begin / kPassGrain)].push_back(s);
                }
            }
        });
        require_finite_strands(bad);
    } catch (...) {
        backup.restore();
        throw;
    }
}

}  // namespace lissom
