#include "kernel/hair/strands/strand_measures.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "kernel/core/numbers/bits.h"
#include "kernel/hair/strands/strand_random.h"

namespace lissom {
namespace {

constexpr Index kMeasureGrain = 256;

Vec3 point(const StrandView& strand, Index k) {
    return strand.col(k).cast<double>();
}

// Angle between two vectors that have a length; accurate near 0 and pi.
double angle_between(const Vec3& a, const Vec3& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

struct Shape {
    double length = 0.0, turn = 0.0;
    bool zero_segment = false;
};

Shape shape_of(const StrandView& strand) {
    Shape shape;
    Vec3 before = Vec3::Zero();
    for (Index k = 1; k < strand.cols(); ++k) {
        const Vec3 segment = point(strand, k) - point(strand, k - 1);
        const double size = segment.norm();
        if (size == 0.0) {
            shape.zero_segment = true;
            continue;
        }
        if (shape.length > 0.0) shape.turn = std::max(shape.turn, angle_between(before, segment));
        shape.length += size;
        before = segment;
    }
    return shape;
}

// Segments are halved so often at most while they are looked at.
constexpr int kHalvings = 5;

// The end of a segment, and the distance there.
struct SegmentEnd {
    Vec3 place;
    double distance;
};

// Lowers `least` to the distance of the lowest place of a segment. A distance changes no faster
// than the place does, which rules most segments out.
void lower_along(const SegmentEnd& a, const SegmentEnd& b,
                 const std::function<double(const Vec3&)>& distance, int halvings, double& least) {
    const double apart = (b.place - a.place).norm();
    if (halvings == 0 || 0.5 * (a.distance + b.distance - apart) >= std::min(least, 0.0)) return;
    const Vec3 place = 0.5 * (a.place + b.place);
    const SegmentEnd middle{place, distance(place)};
    least = std::min(least, middle.distance);
    lower_along(a, middle, distance, halvings - 1, least);
    lower_along(middle, b, distance, halvings - 1, least);
}

// Depth of the deepest place of a strand, between its points too.
double depth_of(const StrandView& strand, const std::function<double(const Vec3&)>& distance) {
    SegmentEnd before{point(strand, 0), distance(point(strand, 0))};
    double least = before.distance;
    for (Index k = 1; k < strand.cols(); ++k) {
        const SegmentEnd here{point(strand, k), distance(point(strand, k))};
        least = std::min(least, here.distance);
        lower_along(before, here, distance, kHalvings, least);
        before = here;
    }
    return -least;
}

// The statistics of a run of strands; lengths are summed in `mean_length`.
class Collector {
  public:
    explicit Collector(const StrandStatisticsOptions& options) : options_(options) {}

    void add(Index s, const StrandView& strand) {
        StrandStatistics one;
        one.strands = 1;
        one.points = one.min_points = one.max_points = index_of(strand.cols());
        if (strand.allFinite()) {
            measure(s, strand, one);
        } else {
            one.not_finite = 1;
        }
        add(one);
    }

    void add(const StrandStatistics& b) {
        if (b.strands == 0) return;
        StrandStatistics& a = sum_;
        const bool first = a.strands == 0, first_finite = a.strands == a.not_finite;
        a.min_points = first ? b.min_points : std::min(a.min_points, b.min_points);
        a.max_points = std::max(a.max_points, b.max_points);
        if (b.strands > b.not_finite) {
            a.min_length = first_finite ? b.min_length : std::min(a.min_length, b.min_length);
            a.deepest = first_finite ? b.deepest : std::max(a.deepest, b.deepest);
        }
        a.max_length = std::max(a.max_length, b.max_length);
        if (b.max_turn > a.max_turn) {
            a.max_turn = b.max_turn;
            a.max_turn_strand = b.max_turn_strand;
        }
        a.strands += b.strands;
        a.points += b.points;
        a.mean_length += b.mean_length;
        a.sharp += b.sharp;
        a.zero_length += b.zero_length;
        a.zero_segments += b.zero_segments;
        a.not_finite += b.not_finite;
        a.penetrating += b.penetrating;
    }

    const StrandStatistics& sum() const { return sum_; }

  private:
    void measure(Index s, const StrandView& strand, StrandStatistics& one) const {
        const Shape shape = shape_of(strand);
        one.min_length = one.mean_length = one.max_length = shape.length;
        one.max_turn = shape.turn;
        one.max_turn_strand = s;
        one.sharp = shape.turn > options_.sharp_turn ? 1 : 0;
        one.zero_length = shape.length == 0.0 ? 1 : 0;
        one.zero_segments = shape.zero_segment ? 1 : 0;
        if (!options_.distance) return;
        one.deepest = depth_of(strand, options_.distance);
        one.penetrating = one.deepest > options_.depth ? 1 : 0;
    }

    const StrandStatisticsOptions& options_;
    StrandStatistics sum_;
};

class Hasher {
  public:
    void add(std::uint64_t word) { state_ = mixed(state_ ^ word); }
    void add(Index value) { add(std::uint64_t{static_cast<std::uint32_t>(value)}); }
    void add(std::uint32_t value) { add(std::uint64_t{value}); }
    // Every NaN counts as the same, since its payload differs between machines.
    void add(float value) {
        add(std::isnan(value) ? std::uint32_t{0x7fc00000} : bits_as<std::uint32_t>(value));
    }
    template <int N>
    void add(const Eigen::Matrix<float, N, 1>& vector) {
        for (const float x : vector) add(x);
    }
    void add(const Triangle& vertices) {
        for (const Index v : vertices) add(v);
    }
    void add(std::string_view text) {
        add(std::uint64_t{text.size()});
        for (const char c : text) add(std::uint64_t{static_cast<unsigned char>(c)});
    }
    void add(const std::string& text) { add(std::string_view(text)); }
    template <typename List>
    void add_list(const List& list) {
        add(std::uint64_t{list.size()});
        for (const auto& value : list) add(value);
    }
    template <typename Value>
    void add_values(const StrandValues<Value>& values) {
        add(static_cast<Index>(values.domain));
        // Unused if there are others.
        if (values.domain == StrandDomain::all) add(values.common);
        add_list(values.values);
    }
    std::uint64_t value() const { return state_; }

  private:
    std::uint64_t state_ = 0x6c6973736f6d0005ULL;
};

}  // namespace

double length(const StrandView& strand) {
    double sum = 0.0;
    for (Index k = 1; k < strand.cols(); ++k)
        sum += (point(strand, k) - point(strand, k - 1)).norm();
    return sum;
}

void arc_fractions(const StrandView& strand, std::vector<double>& t) {
    const std::size_t count = strand.cols();
    t.assign(count, 0.0);
    for (std::size_t k = 1; k < count; ++k) {
        const auto i = index_of(k);
        t[k] = t[k - 1] + (point(strand, i) - point(strand, i - 1)).norm();
    }
    const double whole = t.back();
    for (std::size_t k = 1; k < count; ++k) {
        t[k] = whole > 0.0 ? t[k] / whole : double(k) / double(count - 1);
    }
}

void widths_of(const Strands& strands, Index s, std::vector<float>& widths) {
    const StrandWidths& source = strands.widths();
    const Index first = strands.first_point(s);
    widths.resize(strands.point_count(s));
    for (std::size_t k = 0; k < widths.size(); ++k) {
        widths[k] = source.at(s, first + index_of(k));
    }
    if (source.profile.empty()) return;
    std::vector<double> t;
    arc_fractions(strands.strand(s), t);
    for (std::size_t k = 0; k < widths.size(); ++k) widths[k] *= source.factor(t[k]);
}

Box bounds(const Strands& strands) {
    Box box;
    const std::span<const float> points = strands.points();
    for (std::size_t i = 0; i < points.size(); i += 3) {
        const Vec3 p(points[i], points[i + 1], points[i + 2]);
        if (p.allFinite()) box.extend(p);
    }
    return box;
}

StrandStatistics strand_statistics(const Strands& strands, const StrandStatisticsOptions& options,
                                   const Context& context) {
    Progress progress(context, "measure strands");
    const Index count = strands.size();
    std::vector<StrandStatistics> parts((count + kMeasureGrain - 1) / kMeasureGrain);
    context.parallel_for(0, count, kMeasureGrain, [&](Index begin, Index end) {
        Collector part(options);
        for (Index s = begin; s < end; ++s) part.add(s, strands.strand(s));
        parts[begin / kMeasureGrain] = part.sum();
    });
    Collector whole(options);
    for (const StrandStatistics& part : parts) whole.add(part);
    StrandStatistics result = whole.sum();
    const Index finite = result.strands - result.not_finite;
    if (finite > 0) result.mean_length /= finite;
    return result;
}

std::uint64_t hash(const Strands& strands) {
    Hasher hasher;
    hasher.add_list(strands.offsets());
    hasher.add_list(strands.points());
    hasher.add_values(strands.widths());
    hasher.add_list(strands.widths().profile);
    hasher.add_list(strands.roots().faces);
    hasher.add_list(strands.roots().barycentrics);
    if (!strands.roots().triangles.empty()) hasher.add_list(strands.roots().triangles);
    hasher.add_list(strands.roots().uvs);
    hasher.add_list(strands.groups());
    hasher.add_list(strands.group_names());
    hasher.add_list(strands.ids());
    if (!strands.guides().ids.empty()) {
        hasher.add_list(strands.guides().ids);
        hasher.add_list(strands.guides().arcs);
    }
    hasher.add(Index{strands.colors() ? 1 : 0});
    if (strands.colors()) hasher.add_values(*strands.colors());
    hasher.add_values(strands.transparency());
    hasher.add(strands.comment());
    return hasher.value();
}

}  // namespace lissom
