#include "kernel/hair/cards/hair_cards.h"

#include "kernel/hair/cards/card_light.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/hair/cards/card_slots.h"
#include "kernel/hair/guides/strand_clusters.h"
#include "kernel/hair/strands/strand_measures.h"
#include "kernel/hair/strands/strand_resample.h"

namespace lissom {
namespace {

constexpr Index kCardPoints = 48;
constexpr double kLeastHalfWidth = 0.001;
// Radians that a card's plane may turn from the surface of the head, and from one section to the
// next.
constexpr double kMostTilt = 0.7, kMostTurn = 0.35;

constexpr Index kMaxSections = 64, kMaxCardTriangles = 2 * (kMaxSections - 1);

void require_cards(const CardOptions& options) {
    require(options.count >= 1 && options.count <= kMaxCards, "ask for 1 to 100000 cards");
    require(options.sections >= 2 && options.sections <= kMaxSections,
            "cards have 2 to 64 sections");
    require(options.triangles == 0 || options.triangles >= 2 * options.count,
            "each card needs two triangles: give fewer cards or more triangles");
    require(options.triangles <= kMaxCardTriangles * options.count,
            "a card has at most 126 triangles: give more cards or fewer triangles");
    require(options.slots >= 1 && options.slots <= 256, "there are 1 to 256 slots");
    require(options.coverage > 0.0 && options.coverage <= 1.0, "coverage is above 0, at most 1");
    require(options.bend >= 0.0 && options.bend <= 1.0, "bend is 0 to 1");
    require(std::isfinite(options.clearance) && options.clearance >= 0.0,
            "the clearance must be finite and not negative");
}

Index sections_of(const CardOptions& options, Index cards) {
    if (options.triangles == 0) return options.sections;
    return std::clamp(options.triangles / (2 * cards) + 1, 2, kMaxSections);
}

StrandClusters clusters_for(const Strands& strands, const CardOptions& options,
                            const Context& context) {
    const std::vector<std::uint32_t>& ids = strands.guides().ids;
    const std::set<std::uint32_t> guides(ids.begin(), ids.end());
    ClusterOptions clusters;
    clusters.count = options.count;
    const Index locks = count_of(guides);
    if (locks > 1 && locks <= 2 * options.count) {
        clusters.unit = locks <= options.count ? ClusterUnit::within_lock : ClusterUnit::lock;
    }
    return cluster_strands(strands, clusters, context);
}

// Metres.
constexpr double kAwayStep = 1e-3;

// The smallest number that at least `part` of the values do not exceed.
double quantile(std::vector<double>& values, double part) {
    if (values.empty()) return 0.0;
    const auto place = static_cast<std::size_t>(part * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(place), values.end());
    return values[place];
}

// The course of the cluster: means of its points, smoothed over the length of a section, so that
// curls lie on their card and not along it.
std::vector<Vec3> smoothed_course(std::vector<Vec3> points, Index sections) {
    const auto n = count_of(points);
    const Index reach = std::max<Index>(1, n / (2 * std::max<Index>(sections - 1, 1)));
    for (int pass = 0; pass < 2; ++pass) {
        const std::vector<Vec3> old = points;
        for (Index k = 0; k < n; ++k) {
            const Index r = std::min({reach, k, n - 1 - k});
            Vec3 sum = Vec3::Zero();
            for (Index i = k - r; i <= k + r; ++i) sum += old[at(i)];
            points[at(k)] = sum / (2 * r + 1);
        }
    }
    return points;
}

std::vector<Vec3> evenly(const std::vector<Vec3>& points, Index count) {
    std::vector<double> arcs{0.0};
    for (std::size_t k = 1; k < points.size(); ++k) {
        arcs.push_back(arcs.back() + (points[k] - points[k - 1]).norm());
    }
    std::vector<Vec3> result;
    std::size_t below = 0;
    for (Index i = 0; i < count; ++i) {
        const double arc = arcs.back() * i / (count - 1);
        while (below + 2 < points.size() && arcs[below + 1] < arc) ++below;
        const double step = arcs[below + 1] - arcs[below];
        const double u = step > 0.0 ? std::clamp((arc - arcs[below]) / step, 0.0, 1.0) : 0.0;
        result.push_back(points[below] + u * (points[below + 1] - points[below]));
    }
    return result;
}

Vec3 card_direction(const std::vector<CardSection>& sections, Index k) {
    const Index last = count_of(sections) - 1;
    const Vec3 along =
        sections[at(std::min(k + 1, last))].center - sections[at(std::max(k - 1, 0))].center;
    return along.norm() > 0.0 ? Vec3(along.normalized()) : Vec3(-Vec3::UnitY());
}

// Makes one card of the strands of a cluster.
class CardMaker {
  public:
    CardMaker(const Strands& even, const CardOptions& options, Index sections, const Vec3& middle)
        : even_(even), options_(options), count_(sections), middle_(middle) {}

    Card make(std::vector<Index> strands, Index medoid) {
        card_ = Card();
        card_.strands = std::move(strands);
        card_.medoid = medoid;
        run_along();
        reach_ends();
        face_out();
        widen();
        push_out();
        return std::move(card_);
    }

  private:
    void set_centers(const std::vector<Vec3>& points) {
        const std::vector<Vec3> centers = evenly(points, count_);
        card_.sections.resize(at(count_));
        for (Index k = 0; k < count_; ++k) card_.sections[at(k)].center = centers[at(k)];
    }

    std::vector<Vec3> centers() const {
        std::vector<Vec3> list;
        for (const CardSection& section : card_.sections) list.push_back(section.center);
        return list;
    }

    void run_along() {
        std::vector<Vec3> mean(at(kCardPoints), Vec3::Zero());
        for (const Index s : card_.strands) {
            const StrandView strand = even_.strand(s);
            for (Index k = 0; k < kCardPoints; ++k) mean[at(k)] += point_of(strand, k);
        }
        for (Vec3& p : mean) p /= static_cast<double>(card_.strands.size());
        set_centers(smoothed_course(std::move(mean), count_));
    }

    // Lets the card begin and end with nearly all of its strands.
    void reach_ends() {
        std::vector<double> before, behind;
        const Index last = count_ - 1;
        const Vec3 first = card_direction(card_.sections, 0),
                   end = card_direction(card_.sections, last);
        for (const Index s : card_.strands) {
            const StrandView strand = even_.strand(s);
            const Vec3 root = point_of(strand, 0), tip = point_of(strand, kCardPoints - 1);
            before.push_back((card_.sections.front().center - root).dot(first));
            behind.push_back((tip - card_.sections.back().center).dot(end));
        }
        const double length = card_.length();
        const double add_before = std::clamp(quantile(before, 0.9), 0.0, 0.3 * length);
        const double add_behind = std::clamp(quantile(behind, 0.95), 0.0, 0.5 * length);
        std::vector<Vec3> points = centers();
        points.insert(points.begin(), points.front() - add_before * first);
        points.push_back(points.back() + add_behind * end);
        set_centers(points);
    }

    // Turns the card's plane about its course to that of most spread, near the surface.
    void face_out() {
        std::vector<Mat3> spread(at(count_), Mat3::Zero());
        for (const Index s : card_.strands) {
            const StrandView strand = even_.strand(s);
            for (Index k = 0; k < kCardPoints; ++k) {
                const Vec3 p = point_of(strand, k);
                const Index section = nearest_section(p);
                const Vec3 d = p - card_.sections[at(section)].center;
                spread[at(section)] += d * d.transpose();
            }
        }
        double before = 0.0;
        for (Index k = 0; k < count_; ++k) {
            CardSection& section = card_.sections[at(k)];
            const Vec3 along = card_direction(card_.sections, k);
            const Vec3 up = away_from_head(options_.distance, middle_, section.center, kAwayStep);
            Vec3 across = along.cross(up);
            if (across.norm() < 1e-6) across = along.unitOrthogonal();
            across.normalize();
            const Vec3 out = across.cross(along);
            double turn = tilt(spread[at(k)], across, out);
            if (k > 0) turn = std::clamp(turn, before - kMostTurn, before + kMostTurn);
            before = turn;
            section.across = std::cos(turn) * across + std::sin(turn) * out;
            section.out = section.across.cross(along).normalized();
        }
    }

    // Angle of the axis of most spread, as far as the spread has a direction.
    static double tilt(const Mat3& spread, const Vec3& across, const Vec3& out) {
        const double a = across.dot(spread * across), b = out.dot(spread * out),
                     c = across.dot(spread * out);
        const double size = std::hypot(a - b, 2.0 * c);
        if (!(a + b > 0.0)) return 0.0;
        const double angle = 0.5 * std::atan2(2.0 * c, a - b);
        return std::clamp(angle, -kMostTilt, kMostTilt) * size / (a + b);
    }

    Index nearest_section(const Vec3& p) const {
        Index best = 0;
        double least = std::numeric_limits<double>::infinity();
        for (Index k = 0; k < count_; ++k) {
            const double d = (card_.sections[at(k)].center - p).squaredNorm();
            if (d >= least) continue;
            least = d;
            best = k;
        }
        return best;
    }

    void widen() {
        std::vector<std::vector<double>> sides(at(count_));
        for (const Index s : card_.strands) {
            const StrandView strand = even_.strand(s);
            for (Index k = 0; k < kCardPoints; ++k) {
                const Vec3 p = point_of(strand, k);
                const Index section = nearest_section(p);
                const CardSection& near = card_.sections[at(section)];
                sides[at(section)].push_back((p - near.center).dot(near.across));
            }
        }
        std::vector<double> widths;
        for (Index k = 0; k < count_; ++k) {
            std::vector<double>& list = sides[at(k)];
            const double low = quantile(list, 0.5 - 0.5 * options_.coverage);
            const double high = quantile(list, 0.5 + 0.5 * options_.coverage);
            CardSection& section = card_.sections[at(k)];
            if (!list.empty()) section.center += 0.5 * (low + high) * section.across;
            widths.push_back(list.empty() && k > 0 ? widths.back() : 0.5 * (high - low));
        }
        for (Index k = 0; k < count_; ++k) {
            const double near = 0.25 * widths[at(std::max(k - 1, 0))] +
                                0.25 * widths[at(std::min(k + 1, count_ - 1))];
            card_.sections[at(k)].half_width =
                std::max(kLeastHalfWidth, 0.5 * widths[at(k)] + near);
        }
    }

    // Moves sections out until their centre and edges, and those halfway to the next, are clear.
    void push_out() {
        if (!options_.distance) return;
        for (int pass = 0; pass < 4; ++pass) {
            bool clear = true;
            for (Index k = 0; k < count_; ++k) clear = push_section(k) && clear;
            if (clear) return;
        }
    }

    bool push_section(Index k) {
        CardSection& section = card_.sections[at(k)];
        const CardSection& next = card_.sections[at(std::min(k + 1, count_ - 1))];
        double deepest = 0.0;
        for (const double u : {-1.0, 0.0, 1.0}) {
            for (const double part : {0.0, 0.5}) {
                const Vec3 a = section.center + u * section.half_width * section.across;
                const Vec3 b = next.center + u * next.half_width * next.across;
                const double depth = options_.clearance - options_.distance(a + part * (b - a));
                if (std::isfinite(depth)) deepest = std::max(deepest, depth);
            }
        }
        if (deepest <= 1e-6) return true;
        section.center +=
            deepest * away_from_head(options_.distance, middle_, section.center, kAwayStep);
        return false;
    }

    const Strands& even_;
    const CardOptions& options_;
    Index count_;
    Vec3 middle_;
    Card card_;
};

void measure_cards(const Strands& even, HairCards& cards) {
    double inside = 0.0, all = 0.0, squares = 0.0;
    for (const Card& card : cards.cards) {
        for (const Index s : card.strands) {
            for (Index k = 0; k < kCardPoints; k += 3) {
                const CardPoint p = place_on_card(card, point_of(even.strand(s), k));
                inside += std::abs(p.u) <= 1.0 ? 1.0 : 0.0;
                squares += p.out * p.out;
                all += 1.0;
            }
        }
    }
    cards.covered = inside / std::max(all, 1.0);
    cards.rms = std::sqrt(squares / std::max(all, 1.0));
}

}  // namespace

double Card::length() const {
    double sum = 0.0;
    for (std::size_t k = 1; k < sections.size(); ++k) {
        sum += (sections[k].center - sections[k - 1].center).norm();
    }
    return sum;
}

CardPoint place_on_card(const Card& card, const Vec3& point) {
    CardPoint best;
    double least = std::numeric_limits<double>::infinity();
    const auto last = count_of(card.sections) - 1;
    for (Index k = 0; k < last; ++k) {
        const CardSection &a = card.sections[at(k)], &b = card.sections[at(k + 1)];
        const Vec3 along = b.center - a.center;
        const double square = along.squaredNorm();
        double part = square > 0.0 ? (point - a.center).dot(along) / square : 0.0;
        part = std::clamp(part, k == 0 ? -0.5 : 0.0, k + 1 == last ? 1.5 : 1.0);
        const Vec3 d = point - (a.center + part * along);
        if (d.squaredNorm() >= least) continue;
        least = d.squaredNorm();
        const double u = std::clamp(part, 0.0, 1.0);
        const Vec3 across = (a.across + u * (b.across - a.across)).normalized();
        const Vec3 out = (a.out + u * (b.out - a.out)).normalized();
        const double width = a.half_width + u * (b.half_width - a.half_width);
        best = {d.dot(across) / width, (k + part) / last, d.dot(out)};
    }
    return best;
}

HairCards make_cards(const Strands& strands, const CardOptions& options, const Context& context) {
    require_cards(options);
    Progress progress(context, "make cards");
    const StrandClusters clusters = clusters_for(strands, options, context);
    const Strands even = resample(strands, {.count = kCardPoints}, context);
    std::vector<std::vector<Index>> members(clusters.medoids.size());
    Vec3 middle = Vec3::Zero();
    double counted = 0.0;
    for (Index s = 0; s < strands.size(); ++s) {
        const Index c = clusters.of_strand[at(s)];
        if (c == kNoIndex) continue;
        members[at(c)].push_back(s);
        middle += strands.root(s).cast<double>();
        counted += 1.0;
    }
    middle /= counted;
    HairCards result;
    result.cards.resize(members.size());
    const Index sections = sections_of(options, count_of(members));
    context.parallel_for(0, count_of(members), 4, [&](Index begin, Index end) {
        CardMaker maker(even, options, sections, middle);
        for (Index c = begin; c < end; ++c) {
            result.cards[at(c)] = maker.make(std::move(members[at(c)]), clusters.medoids[at(c)]);
        }
    });
    share_slots(even, options.slots, result);
    measure_cards(even, result);
    return result;
}

}  // namespace lissom
