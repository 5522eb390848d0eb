#include "kernel/hair/strands/strand_resample.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/core/large_pages.h"
#include "kernel/hair/strands/strand_measures.h"

namespace lissom {
namespace {

constexpr Index kResampleGrain = 256;
constexpr double kMaxResampled = std::numeric_limits<Index>::max();

[[noreturn]] void refuse_points() {
    throw Error(ErrorCode::invalid_argument,
                "there would be more points than can be numbered; take fewer points or a longer "
                "step");
}

// Places on a run of strands, one strand after the other.
struct Run {
    std::vector<StrandPlace> places;
    std::vector<Index> counts;
};

using Find = std::function<void(Index, std::vector<StrandPlace>&)>;

std::vector<Run> find_runs(const Strands& strands, const Find& find, const Context& context) {
    std::vector<Run> runs(at((strands.size() + kResampleGrain - 1) / kResampleGrain));
    context.parallel_for(0, strands.size(), kResampleGrain, [&](Index begin, Index end) {
        Run& run = runs[at(begin / kResampleGrain)];
        std::vector<StrandPlace> places;
        for (Index s = begin; s < end; ++s) {
            places.clear();
            find(s, places);
            run.places.insert(run.places.end(), places.begin(), places.end());
            run.counts.push_back(count_of(places));
        }
    });
    return runs;
}

std::vector<Index> offsets_of(const std::vector<Run>& runs) {
    std::vector<Index> offsets = {0};
    std::int64_t total = 0;
    for (const Run& run : runs) {
        for (const Index count : run.counts) {
            total += count;
            if (total > std::numeric_limits<Index>::max()) {
                refuse_points();
            }
            offsets.push_back(index_of(total));
        }
    }
    return offsets;
}

// Values of points at the places; `old` and `made` hold `width` numbers a point.
void interpolate(const float* old, Index width, const Strands& strands,
                 const std::vector<Index>& offsets, const std::vector<Run>& runs,
                 const Context& context, float* made) {
    context.parallel_for(0, strands.size(), kResampleGrain, [&](Index begin, Index end) {
        const StrandPlace* place = runs[at(begin / kResampleGrain)].places.data();
        for (Index s = begin; s < end; ++s) {
            const Index last = strands.point_count(s) - 1;
            for (Index k = offsets[at(s)]; k < offsets[at(s) + 1]; ++k, ++place) {
                const Index next = std::min(place->below + 1, last);
                const float* const a = old + at(strands.first_point(s) + place->below) * at(width);
                const float* const b = old + at(strands.first_point(s) + next) * at(width);
                for (std::size_t c = 0; c < at(width); ++c) {
                    const double u = place->u;
                    const double between = u == 0.0 ? a[c] : a[c] + u * (double(b[c]) - a[c]);
                    made[at(k) * at(width) + c] = static_cast<float>(between);
                }
            }
        }
    });
}

// Copies all but the points; values of points are those at the places.
template <typename Move>
void copy_data(const Strands& strands, const Move& move, Strands& result) {
    StrandWidths widths = strands.widths();
    move(widths);
    result.set_widths(std::move(widths));
    StrandValues<float> transparency = strands.transparency();
    move(transparency);
    result.set_transparency(std::move(transparency));
    if (strands.colors()) {
        StrandValues<Eigen::Vector3f> colors = *strands.colors();
        move(colors);
        result.set_colors(std::move(colors));
    }
    result.set_roots(strands.roots());
    result.set_groups(strands.groups(), strands.group_names());
    result.set_ids(strands.ids());
    result.set_comment(strands.comment());
}

// Guide arcs up to the last place of each strand, if that is no longer its tip.
StrandGuides shortened_guides(const Strands& strands, const std::vector<Run>& runs) {
    StrandGuides guides = strands.guides();
    if (guides.arcs.empty()) return guides;
    std::vector<double> fractions;
    Index s = 0;
    for (const Run& run : runs) {
        std::size_t end = 0;
        for (const Index count : run.counts) {
            end += at(count);
            const StrandPlace& last = run.places[end - 1];
            const Index points = strands.point_count(s);
            if (last.below + 1 < points) {
                arc_fractions(strands.strand(s), fractions);
                const double a = fractions[at(last.below)], b = fractions[at(last.below) + 1];
                guides.arcs[at(s)] *= static_cast<float>(a + last.u * (b - a));
            }
            ++s;
        }
    }
    return guides;
}

float* numbers(std::vector<float>& values) {
    return values.data();
}
float* numbers(std::vector<Eigen::Vector3f>& values) {
    return values.empty() ? nullptr : values.front().data();
}

void require_resample(const ResampleOptions& options) {
    const bool by_count = options.count >= 2 && options.step == 0.0;
    const bool by_step = options.count == 0 && options.step > 0.0 && std::isfinite(options.step);
    if (by_count || by_step) return;
    throw Error(ErrorCode::invalid_argument,
                "resampling needs either a count of at least 2 points or a positive step");
}

// Segments of a strand of this length; one if it is not finite.
double segments_for(double length, const ResampleOptions& options) {
    if (options.count > 0) return options.count - 1;
    const double segments = std::round(length / options.step);
    return std::isfinite(segments) ? std::max(1.0, segments) : 1.0;
}

// Segments of each strand, once it is known that their points can be numbered.
std::vector<Index> all_segments(const Strands& strands, const ResampleOptions& options) {
    std::vector<Index> segments;
    double points = 0.0;
    for (Index s = 0; s < strands.size(); ++s) {
        const bool is_root = strands.point_count(s) == 1;
        const double count = is_root ? 0.0 : segments_for(length(strands.strand(s)), options);
        points += count + 1.0;
        if (points > kMaxResampled) refuse_points();
        segments.push_back(static_cast<Index>(count));
    }
    return segments;
}

// The last place of each strand, the part of its length up to there, and the offsets of the points
// that are left: those before the place, and one there.
struct Ends {
    std::vector<StrandPlace> places;
    std::vector<float> parts;
    std::vector<Index> offsets;
};

// Fractions of the points of a strand, and its length.
double measure_strand(const StrandView& strand, std::vector<double>& fractions) {
    const std::size_t count = at(index_of(strand.cols()));
    fractions.assign(count, 0.0);
    const float* p = strand.data();
    for (std::size_t k = 1; k < count; ++k, p += 3) {
        const double x = double(p[3]) - p[0], y = double(p[4]) - p[1], z = double(p[5]) - p[2];
        fractions[k] = fractions[k - 1] + std::sqrt(x * x + y * y + z * z);
    }
    const double whole = fractions.back(), part = 1.0 / whole;
    for (std::size_t k = 1; k < count; ++k) {
        fractions[k] = whole > 0.0 ? fractions[k] * part : double(k) / double(count - 1);
    }
    return whole;
}

Ends find_ends(const Strands& strands, const KeptPart& part, const Context& context) {
    Ends ends{std::vector<StrandPlace>(at(strands.size())),
              std::vector<float>(at(strands.size()), 1.0f),
              {0}};
    context.parallel_for(0, strands.size(), kResampleGrain, [&](Index begin, Index end) {
        std::vector<double> fractions;
        for (Index s = begin; s < end; ++s) {
            const Index last = strands.point_count(s) - 1;
            ends.places[at(s)] = {last, 0.0f};
            if (last == 0) continue;
            const double whole = measure_strand(strands.strand(s), fractions);
            const double kept = part(s, fractions, whole);
            if (!(kept < 1.0)) continue;
            const StrandPlace place = place_at(fractions, kept);
            ends.places[at(s)] = place;
            const double a = fractions[at(place.below)], b = fractions[at(place.below) + 1];
            ends.parts[at(s)] = static_cast<float>(a + place.u * (b - a));
        }
    });
    ends.offsets.reserve(at(strands.size()) + 1);
    for (const StrandPlace& place : ends.places) {
        const Index between = place.u > 0.0f ? 1 : 0;
        ends.offsets.push_back(ends.offsets.back() + std::max(1, place.below + 1 + between));
    }
    return ends;
}

// Copies values of points, `width` numbers each, up to the ends.
void copy_up_to(const Strands& strands, const Ends& ends, std::size_t width, const float* old,
                const Context& context, float* made) {
    context.parallel_for(0, strands.size(), kResampleGrain, [&](Index begin, Index end) {
        for (Index s = begin; s < end; ++s) {
            const StrandPlace& place = ends.places[at(s)];
            const std::size_t whole = width * (at(place.below) + 1);
            const float* const from = old + width * at(strands.first_point(s));
            float* const to = made + width * at(ends.offsets[at(s)]);
            std::copy(from, from + whole, to);
            if (place.u == 0.0f) continue;
            for (std::size_t c = 0; c < width; ++c) {
                const double a = from[whole - width + c], b = from[whole + c];
                to[whole + c] = static_cast<float>(a + place.u * (b - a));
            }
        }
    });
}

std::vector<float> points_up_to(const Strands& strands, const Ends& ends, const Context& context) {
    const std::size_t count = 3 * at(ends.offsets.back());
    const MemoryCharge charge = context.charge(sizeof(float) * count, "points of strands");
    std::vector<float> points;
    points.reserve(count);
    prefer_large_pages(points);
    points.resize(count);
    copy_up_to(strands, ends, 3, strands.points().data(), context, points.data());
    return points;
}

template <typename Value>
void keep_up_to(const Strands& strands, const Ends& ends, StrandValues<Value>& values,
                const Context& context) {
    if (values.domain != StrandDomain::point) return;
    auto old = std::move(values.values);
    values.values.assign(at(ends.offsets.back()), values.common);
    copy_up_to(strands, ends, sizeof(Value) / sizeof(float), numbers(old), context,
               numbers(values.values));
}

// A strand follows a guide that was shortened no farther than to its end.
void end_with_guides(const Strands& strands, const std::vector<float>& parts,
                     StrandGuides& guides) {
    std::unordered_map<std::uint32_t, float> ends;
    for (std::size_t s = 0; s < guides.ids.size(); ++s) {
        const auto strand = index_of(s);
        if (parts[s] < 1.0f && guides.ids[s] == strands.id(strand)) {
            ends[guides.ids[s]] = static_cast<float>(length(strands.strand(strand)));
        }
    }
    for (std::size_t s = 0; s < guides.ids.size() && !ends.empty(); ++s) {
        const auto end = ends.find(guides.ids[s]);
        if (end != ends.end()) guides.arcs[s] = std::min(guides.arcs[s], end->second);
    }
}

}  // namespace

Strands at_places(const Strands& strands, const Find& find, const Context& context) {
    const std::vector<Run> runs = find_runs(strands, find, context);
    std::vector<Index> offsets = offsets_of(runs);
    MemoryCharge charge =
        context.charge(3 * sizeof(float) * at(offsets.back()), "points of strands");
    std::vector<float> points(3 * at(offsets.back()));
    interpolate(strands.points().data(), 3, strands, offsets, runs, context, points.data());
    charge = {};
    Strands result(std::move(points), offsets, context.memory());
    copy_data(
        strands,
        [&](auto& values) {
            if (values.domain != StrandDomain::point) return;
            auto old = std::move(values.values);
            values.values.resize(at(offsets.back()), values.common);
            constexpr Index kWidth = sizeof(values.common) / sizeof(float);
            interpolate(numbers(old), kWidth, strands, offsets, runs, context,
                        numbers(values.values));
        },
        result);
    result.set_guides(shortened_guides(strands, runs));
    return result;
}

StrandPlace place_at(const std::vector<double>& fractions, double t) {
    const auto above = std::upper_bound(fractions.begin() + 1, fractions.end() - 1, t);
    const auto k = at(above - fractions.begin()) - 1;
    const double size = fractions[k + 1] - fractions[k];
    const double u = size > 0.0 ? std::clamp((t - fractions[k]) / size, 0.0, 1.0) : 0.0;
    return {index_of(k), static_cast<float>(u)};
}

Strands shortened(const Strands& strands, const KeptPart& part, const Context& context) {
    const Ends ends = find_ends(strands, part, context);
    Strands result(points_up_to(strands, ends, context), ends.offsets, context.memory());
    copy_data(
        strands, [&](auto& values) { keep_up_to(strands, ends, values, context); }, result);
    StrandGuides guides = strands.guides();
    for (std::size_t s = 0; s < guides.arcs.size(); ++s) guides.arcs[s] *= ends.parts[s];
    end_with_guides(result, ends.parts, guides);
    result.set_guides(std::move(guides));
    return result;
}

Strands resample(const Strands& strands, const ResampleOptions& options, const Context& context) {
    require_resample(options);
    Progress progress(context, "resample strands");
    const std::vector<Index> segments = all_segments(strands, options);
    const std::int64_t points = std::accumulate(segments.begin(), segments.end(), std::int64_t{0});
    const MemoryCharge charge = context.charge(sizeof(StrandPlace) * points, "places on strands");
    const auto find = [&](Index s, std::vector<StrandPlace>& places) {
        const StrandView strand = strands.strand(s);
        const Index count = segments[at(s)];
        places.push_back({0, 0.0f});
        if (count == 0) return;
        std::vector<double> fractions;
        arc_fractions(strand, fractions);
        for (Index k = 1; k < count; ++k) places.push_back(place_at(fractions, double(k) / count));
        places.push_back({index_of(strand.cols()) - 1, 0.0f});
    };
    return at_places(strands, find, context);
}

Strands with_point_counts(const Strands& strands, const std::vector<Index>& counts,
                          const Context& context) {
    const auto find = [&](Index s, std::vector<StrandPlace>& places) {
        const Index count = counts[at(s)], last = strands.point_count(s) - 1;
        if (count == last + 1) {
            for (Index k = 0; k <= last; ++k) places.push_back({k, 0.0f});
            return;
        }
        std::vector<double> fractions;
        arc_fractions(strands.strand(s), fractions);
        places.push_back({0, 0.0f});
        for (Index k = 1; k + 1 < count; ++k) {
            places.push_back(place_at(fractions, double(k) / (count - 1)));
        }
        places.push_back({last, 0.0f});
    };
    return at_places(strands, find, context);
}

}  // namespace lissom
