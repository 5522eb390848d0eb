#include "kernel/hair/operators/strand_detail.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/hair/strands/strand_frames.h"
#include "kernel/hair/strands/strand_measures.h"
#include "kernel/hair/strands/strand_random.h"
#include "kernel/hair/strands/strand_resample.h"

namespace lissom {
namespace {

constexpr std::uint64_t kExampleStream = 61, kTurnStream = 62;
// Segments count as at least so much of the mean one: bends are quotients by their lengths.
constexpr double kShortestSegment = 1e-3;
// How much firmer than all else the root is held.
constexpr double kHeldRoot = 1e9;
// A course that bends aside by less of its length has no side.
constexpr double kStraight = 0.01;
constexpr double kMaxDetailPoints = 4096.0;

using Points = std::vector<Vec3>;

void require_detail(const DetailOptions& options) {
    require(options.span > 0.0 && std::isfinite(options.span),
            "the span of details must be positive and finite");
    require(options.scale > 0.0 && std::isfinite(options.scale),
            "the scale of details must be positive and finite");
    require(options.turn >= 0.0 && options.turn <= 1.0, "the turn of details must be from 0 to 1");
}

// Lengths of the segments, none much shorter than the mean.
void segment_sizes(const Points& points, std::vector<double>& sizes) {
    sizes.resize(points.size() - 1);
    double sum = 0.0;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        sizes[i] = (points[i + 1] - points[i]).norm();
        sum += sizes[i];
    }
    const double least = kShortestSegment * sum / double(sizes.size());
    for (double& size : sizes) size = std::max(size, least);
}

// The second derivatives along a polyline, and the polyline that fits given ones and given places.
class BendSystem {
  public:
    // Weighs places so that bends longer than the span follow them.
    void set(const std::vector<double>& sizes, double span) {
        count_ = sizes.size() + 1;
        place_weight_ = std::pow(2.0 * kPi / span, 4);
        set_rows(sizes);
        assemble();
        factor();
    }

    void bends(const Points& points, Points& made) const {
        made.assign(count_, Vec3::Zero());
        for (std::size_t i = 1; i + 1 < count_; ++i) {
            made[i] = before_[i] * points[i - 1] + here_[i] * points[i] + after_[i] * points[i + 1];
        }
    }

    // `bends` may be empty for none.
    void solve(const Points& places, const Points& bends, Points& made) const {
        made.resize(count_);
        for (std::size_t i = 0; i < count_; ++i) made[i] = place_weight_ * mass_[i] * places[i];
        made[0] += held_ * places[0];
        for (std::size_t i = 1; i + 1 < count_ && !bends.empty(); ++i) {
            const Vec3 bend = mass_[i] * bends[i];
            made[i - 1] += before_[i] * bend;
            made[i] += here_[i] * bend;
            made[i + 1] += after_[i] * bend;
        }
        substitute(made);
    }

  private:
    void set_rows(const std::vector<double>& sizes) {
        mass_.assign(count_, 0.5 * sizes.front());
        mass_.back() = 0.5 * sizes.back();
        before_.assign(count_, 0.0);
        here_ = after_ = before_;
        for (std::size_t i = 1; i + 1 < count_; ++i) {
            mass_[i] = 0.5 * (sizes[i - 1] + sizes[i]);
            before_[i] = 1.0 / (mass_[i] * sizes[i - 1]);
            after_[i] = 1.0 / (mass_[i] * sizes[i]);
            here_[i] = -before_[i] - after_[i];
        }
    }

    void assemble() {
        diagonal_.resize(count_);
        for (std::size_t i = 0; i < count_; ++i) diagonal_[i] = place_weight_ * mass_[i];
        first_.assign(count_, 0.0);
        second_.assign(count_, 0.0);
        for (std::size_t i = 1; i + 1 < count_; ++i) {
            const double m = mass_[i], a = before_[i], b = here_[i], c = after_[i];
            diagonal_[i - 1] += m * a * a;
            diagonal_[i] += m * b * b;
            diagonal_[i + 1] += m * c * c;
            first_[i] += m * a * b;
            first_[i + 1] += m * b * c;
            second_[i + 1] += m * a * c;
        }
        held_ = kHeldRoot * diagonal_[0];
        diagonal_[0] += held_;
    }

    // L D L^T in place: entries left of the diagonal become those of L.
    void factor() {
        for (std::size_t i = 0; i < count_; ++i) {
            if (i >= 2) {
                first_[i] -= second_[i] * first_[i - 1];
                second_[i] /= diagonal_[i - 2];
                diagonal_[i] -= second_[i] * second_[i] * diagonal_[i - 2];
            }
            if (i >= 1) {
                const double entry = first_[i];
                first_[i] /= diagonal_[i - 1];
                diagonal_[i] -= first_[i] * entry;
            }
        }
    }

    void substitute(Points& x) const {
        for (std::size_t i = 1; i < count_; ++i) {
            x[i] -= first_[i] * x[i - 1];
            if (i >= 2) x[i] -= second_[i] * x[i - 2];
        }
        for (std::size_t i = 0; i < count_; ++i) x[i] /= diagonal_[i];
        for (std::size_t i = count_ - 1; i-- > 0;) {
            x[i] -= first_[i + 1] * x[i + 1];
            if (i + 2 < count_) x[i] -= second_[i + 2] * x[i + 2];
        }
    }

    std::size_t count_ = 0;
    double place_weight_ = 0.0, held_ = 0.0;
    // Quotients of bends, what a point stands for, and the three diagonals: own, first and second
    // to the left.
    std::vector<double> before_, here_, after_, mass_, diagonal_, first_, second_;
};

// The smooth course of a polyline, with its frames.
struct Course {
    std::vector<double> sizes, arcs;
    Points points, tangents, normals;
    BendSystem system;

    double length() const { return arcs.back(); }

    void take(const Points& strand, double span) {
        segment_sizes(strand, sizes);
        system.set(sizes, span);
        system.solve(strand, {}, points);
        measure(span);
    }

    // Sets all but the points from them.
    void measure(double span) {
        segment_sizes(points, sizes);
        system.set(sizes, span);
        arcs.assign(1, 0.0);
        for (const double size : sizes) arcs.push_back(arcs.back() + size);
        make_frames();
    }

    Vec3 to_frame(std::size_t i, const Vec3& v) const {
        return {v.dot(normals[i]), v.dot(tangents[i].cross(normals[i])), v.dot(tangents[i])};
    }
    Vec3 from_frame(std::size_t i, const Vec3& v) const {
        return v.x() * normals[i] + v.y() * tangents[i].cross(normals[i]) + v.z() * tangents[i];
    }

  private:
    void make_frames() {
        const std::size_t count = points.size();
        tangents.resize(count);
        normals.resize(count);
        Vec3 tangent = Vec3::UnitY();
        for (std::size_t i = 0; i < count; ++i) {
            const Vec3 along = points[std::min(i + 1, count - 1)] - points[i == 0 ? 0 : i - 1];
            if (along.norm() > 0.0) tangent = along.normalized();
            tangents[i] = tangent;
        }
        Vec3 normal = first_normal();
        for (std::size_t i = 0; i < count; ++i) {
            if (i > 0) {
                normal =
                    carried_normal(normal, points[i] - points[i - 1], tangents[i - 1], tangents[i]);
            }
            normal = (normal - normal.dot(tangents[i]) * tangents[i]).normalized();
            normals[i] = normal;
        }
    }

    // Across the root, towards the side that the course bends to: it turns with the strand.
    Vec3 first_normal() const {
        Vec3 middle = Vec3::Zero();
        for (const Vec3& p : points) middle += (p - points.front()) / double(points.size());
        const Vec3& along = tangents.front();
        const Vec3 side = middle - middle.dot(along) * along;
        return side.norm() > kStraight * length() ? Vec3(side.normalized())
                                                  : along.unitOrthogonal();
    }
};

void take_points(const StrandView& strand, Points& points) {
    points.resize(lissom::at(index_of(strand.cols())));
    for (std::size_t k = 0; k < points.size(); ++k) points[k] = point_of(strand, index_of(k));
}

// A detail: distance from the course in metres, and bend in 1 / metres, in the course's frame.
struct Detail {
    Vec3 away, bend;
};

// The details of one example along its course.
class Example {
  public:
    Example(const StrandView& strand, double span) {
        Points points, bends, course_bends;
        take_points(strand, points);
        Course course;
        course.take(points, span);
        course.system.bends(points, bends);
        course.system.bends(course.points, course_bends);
        for (std::size_t i = 0; i < points.size(); ++i) {
            details_.push_back({course.to_frame(i, points[i] - course.points[i]),
                                course.to_frame(i, bends[i] - course_bends[i])});
        }
        arcs_ = std::move(course.arcs);
        step_ = lissom::length(strand) / double(points.size() - 1);
        find_period(span);
    }

    double length() const { return arcs_.back(); }
    /// Mean length of its segments.
    double step() const { return step_; }

    // The detail at an arc of a strand of this length; `below` is a hint.
    Detail at(double arc, double length, std::size_t& below) const {
        if (length <= arcs_.back() * (1.0 + 1e-9)) return between(arc, below);
        if (arc > arcs_.back()) {
            arc -= std::ceil((arc - arcs_.back()) / period_) * period_;
        }
        const Detail here = between(arc, below);
        const double back = smooth_step(arcs_.back() - window_, arcs_.back(), arc);
        if (back == 0.0) return here;
        std::size_t there = 0;
        const Detail earlier = between(arc - period_, there);
        return {here.away + back * (earlier.away - here.away),
                here.bend + back * (earlier.bend - here.bend)};
    }

  private:
    Detail between(double arc, std::size_t& below) const {
        if (below + 1 >= arcs_.size() || arcs_[below] > arc) below = 0;
        // By halves: examples may have many points, and strands many lengths of them.
        const auto next = arcs_.begin() + (index_of(below) + 1);
        below += lissom::at(index_of(std::lower_bound(next, arcs_.end() - 1, arc) - next));
        const double size = arcs_[below + 1] - arcs_[below];
        const double u = std::clamp((arc - arcs_[below]) / size, 0.0, 1.0);
        const Detail &a = details_[below], &b = details_[below + 1];
        return {a.away + u * (b.away - a.away), a.bend + u * (b.bend - a.bend)};
    }

    // The arc after which the end is most like what comes before it, from half of the length on.
    void find_period(double span) {
        constexpr int kTried = 64;
        window_ = std::min(0.5 * span, 0.25 * length());
        const double shortest = 0.5 * length(), longest = length() - window_;
        double best = std::numeric_limits<double>::infinity();
        for (int i = 0; i <= kTried; ++i) {
            const double period = longest + (shortest - longest) * i / kTried;
            const double difference = difference_after(period);
            if (difference >= best) continue;
            best = difference;
            period_ = period;
        }
    }

    double difference_after(double period) const {
        constexpr int kPlaces = 16;
        double sum = 0.0;
        std::size_t below = 0, earlier = 0;
        for (int i = 0; i <= kPlaces; ++i) {
            const double arc = length() - window_ * (kPlaces - i) / kPlaces;
            sum += (between(arc, below).away - between(arc - period, earlier).away).squaredNorm();
        }
        return sum;
    }

    std::vector<double> arcs_;
    std::vector<Detail> details_;
    double step_ = 0.0, period_ = 0.0, window_ = 0.0;
};

bool shows_details(const StrandView& strand) {
    if (strand.cols() < 3 || !strand.allFinite()) return false;
    const double size = length(strand);
    return size > 0.0 && std::isfinite(size);
}

std::vector<Example> examples_of(const Strands& strands, double span) {
    std::vector<Example> list;
    for (Index s = 0; s < strands.size(); ++s) {
        if (shows_details(strands.strand(s))) list.emplace_back(strands.strand(s), span);
    }
    require(!list.empty(),
            "the examples of details have no finite strand of three points and a length; give "
            "strands that show the details");
    return list;
}

// The guide of a strand, or the strand itself.
std::uint32_t lock_of(const Strands& strands, Index s) {
    const std::vector<std::uint32_t>& guides = strands.guides().ids;
    return guides.empty() || guides[at(s)] == kNoGuide ? strands.id(s) : guides[at(s)];
}

// Gives one strand after the other its details; keeps room for them.
class DetailGiver {
  public:
    // `lengths` are those that strands keep; empty for those that they have.
    DetailGiver(const std::vector<Example>& examples, const Strands& strands,
                const DetailOptions& options, const std::vector<double>& lengths)
        : examples_(examples), strands_(strands), options_(options), lengths_(lengths) {}

    const Example& example_for(Index s) const {
        const std::uint64_t bits = mixed(options_.seed, lock_of(strands_, s), kExampleStream);
        return examples_[bits % examples_.size()];
    }

    void give(StrandWork& work) {
        take_points(work.old_points(), old_);
        course_.take(old_, options_.span);
        add(example_for(work.strand()), turn_of(work.strand()));
        course_.system.solve(places_, bends_, made_);
        mix(work);
        if (!options_.keep_length) return put(work, made_);
        const double kept = lengths_.empty() ? work.length() : lengths_[at(work.strand())];
        space_as_before(work, kept / work.length());
        work.restore_lengths(kept / work.length());
    }

  private:
    double turn_of(Index s) const {
        return options_.turn * 0.5 *
               signed_random(mixed(options_.seed, lock_of(strands_, s), kTurnStream));
    }

    // The places and bends that the course has with the details.
    void add(const Example& example, double turn) {
        const double c = cosine_of_turns(turn), s = sine_of_turns(turn), scale = options_.scale;
        const auto turned = [&](const Vec3& v) -> Vec3 {
            return {c * v.x() - s * v.y(), s * v.x() + c * v.y(), v.z()};
        };
        course_.system.bends(course_.points, bends_);
        places_ = course_.points;
        std::size_t below = 0;
        for (std::size_t i = 1; i < places_.size(); ++i) {
            const Detail one = example.at(course_.arcs[i] / scale, course_.length() / scale, below);
            places_[i] += course_.from_frame(i, scale * turned(one.away));
            bends_[i] += course_.from_frame(i, turned(one.bend) / scale);
        }
    }

    // Takes the old points as far as the factor, mask and profile leave them.
    void mix(const StrandWork& work) {
        if (!work.is_partial()) return;
        for (std::size_t i = 0; i < made_.size(); ++i) {
            made_[i] = old_[i] + work.weight(index_of(i)) * (made_[i] - old_[i]);
        }
    }

    // Lets points go along what was made as far as they were along the strand.
    void space_as_before(StrandWork& work, double factor) {
        std::size_t below = 0;
        double from = 0.0, size = (made_[1] - made_[0]).norm();
        for (Index k = 1; k < work.count(); ++k) {
            const double arc = factor * work.arc(k);
            while (below + 2 < made_.size() && from + size < arc) {
                from += size;
                ++below;
                size = (made_[below + 1] - made_[below]).norm();
            }
            const double u = size > 0.0 ? (arc - from) / size : 0.0;
            work.set_point(k, made_[below] + u * (made_[below + 1] - made_[below]));
        }
    }

    static void put(StrandWork& work, const Points& points) {
        for (Index k = 1; k < work.count(); ++k) work.set_point(k, points[at(k)]);
    }

    const std::vector<Example>& examples_;
    const Strands& strands_;
    const DetailOptions& options_;
    const std::vector<double>& lengths_;
    Course course_;
    Points old_, places_, bends_, made_;
};

// Points that a strand needs to show its example.
Index points_to_show(const Strands& strands, Index s, const DetailGiver& giver, double scale) {
    const StrandView strand = strands.strand(s);
    const auto count = index_of(strand.cols());
    if (count < 2 || !strand.allFinite()) return count;
    const double segments =
        std::ceil(length(strand) / (scale * giver.example_for(s).step()) - 0.01);
    return std::max({count, 3, static_cast<Index>(std::min(segments + 1.0, kMaxDetailPoints))});
}

Strands refined(const Strands& strands, const std::vector<Example>& examples,
                const DetailOptions& options, const Context& context) {
    const std::vector<double> lengths;
    const DetailGiver giver(examples, strands, options, lengths);
    std::vector<Index> counts(at(strands.size()));
    for (Index s = 0; s < strands.size(); ++s) {
        const bool masked = !options.mask.empty() && options.mask[at(s)] == 0.0f;
        counts[at(s)] =
            masked ? strands.point_count(s) : points_to_show(strands, s, giver, options.scale);
    }
    return with_point_counts(strands, counts, context);
}

// Strands of two points have no bends.
void give_details(Strands& strands, const std::vector<Example>& examples,
                  const DetailOptions& options, const std::vector<double>& lengths,
                  const Context& context) {
    change_strand_runs(
        strands, options,
        [&] {
            return [giver = DetailGiver(examples, strands, options, lengths)](
                       StrandWork& work) mutable {
                if (work.count() > 2) giver.give(work);
            };
        },
        context);
}

// A strand with a straight course down from its root.
void hang_straight(const StrandView& old, double span, StrandEdit& made) {
    Points points, straight;
    take_points(old, points);
    Course course, line;
    course.take(points, span);
    for (const double arc : course.arcs) straight.push_back(points.front() - arc * Vec3::UnitY());
    line.points = straight;
    line.measure(span);
    for (std::size_t i = 1; i < points.size(); ++i) {
        const Vec3 away = course.to_frame(i, points[i] - course.points[i]);
        made.col(index_of(i)) = (straight[i] + line.from_frame(i, away)).cast<float>();
    }
}

}  // namespace

Strands details(const Strands& examples, double span, const Context& context) {
    DetailOptions options;
    options.span = span;
    require_detail(options);
    Progress progress(context, "details of strands");
    Strands made = examples;
    context.parallel_for(0, made.size(), 64, [&](Index begin, Index end) {
        for (Index s = begin; s < end; ++s) {
            if (!shows_details(examples.strand(s))) continue;
            StrandEdit edit = made.edit_strand(s);
            hang_straight(examples.strand(s), span, edit);
        }
    });
    return made;
}

void add_detail(Strands& strands, const Strands& examples, const DetailOptions& options,
                const Context& context) {
    require_detail(options);
    require_operator(strands, options);
    const std::vector<Example> list = examples_of(examples, options.span);
    if (options.factor == 0.0) return;
    Progress progress(context, "give details to strands");
    if (!options.resample) return give_details(strands, list, options, {}, context);
    std::vector<double> lengths;
    for (Index s = 0; s < strands.size(); ++s) lengths.push_back(length(strands.strand(s)));
    Strands made = refined(strands, list, options, context);
    give_details(made, list, options, lengths, context);
    strands = std::move(made);
}

}  // namespace lissom
