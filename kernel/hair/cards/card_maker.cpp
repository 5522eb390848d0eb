#include "kernel/hair/cards/card_maker.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "kernel/hair/cards/card_light.h"
#include "kernel/hair/strands/strand_measures.h"

namespace lissom {
namespace {

constexpr double kLeastHalfWidth = 0.001;
// Radians that a card's plane may turn from the surface of the head, and from one section to the
// next.
constexpr double kMostTilt = 0.7, kMostTurn = 0.35;
// Part of a cluster's points below its card: of a card alone nearly all, as few strands that lie
// one behind the other already close the outline of hair; of two that cross.
constexpr double kLiftAlone = 0.99, kLiftCrossed = 0.55;
// Part of the tips that the end of a card reaches.
constexpr double kTipsReached = 0.99;
constexpr int kSkinSteps = 20;
// Metres that a card may begin before the mean of its roots.
constexpr double kMostBefore = 0.015;
// Part of its length by which a card may go on behind the mean of its tips.
constexpr double kMostBehind = 0.2;
// Metres.
constexpr double kAwayStep = 1e-3, kClearEnough = 1e-6;
// Rounds in which sections move out of the head.
constexpr int kPushPasses = 6;

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

// Each number becomes half itself and half the mean of those around it.
void even_out(std::vector<double>& list) {
    const std::vector<double> old = list;
    const std::size_t last = list.size() - 1;
    for (std::size_t k = 0; k <= last; ++k) {
        list[k] = 0.5 * old[k] + 0.25 * (old[k > 0 ? k - 1 : 0] + old[std::min(k + 1, last)]);
    }
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
    CardMaker(const CardGround& ground, CardPlane plane) : ground_(ground), plane_(plane) {}

    Card make(std::vector<Index> strands, Index medoid) {
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
        const std::vector<Vec3> centers = evenly(points, ground_.sections);
        card_.sections.resize(at(ground_.sections));
        for (Index k = 0; k < ground_.sections; ++k) card_.sections[at(k)].center = centers[at(k)];
    }

    std::vector<Vec3> centers() const {
        std::vector<Vec3> list;
        for (const CardSection& section : card_.sections) list.push_back(section.center);
        return list;
    }

    void run_along() {
        std::vector<Vec3> mean(at(kCardPoints), Vec3::Zero());
        for (const Index s : card_.strands) {
            const StrandView strand = ground_.even.strand(s);
            for (Index k = 0; k < kCardPoints; ++k) mean[at(k)] += point_of(strand, k);
        }
        for (Vec3& p : mean) p /= static_cast<double>(card_.strands.size());
        set_centers(smoothed_course(std::move(mean), ground_.sections));
    }

    // Lets the card begin and end with nearly all of its strands.
    void reach_ends() {
        std::vector<double> before, behind;
        const Index last = ground_.sections - 1;
        const Vec3 first = card_direction(card_.sections, 0),
                   end = card_direction(card_.sections, last);
        for (const Index s : card_.strands) {
            const StrandView strand = ground_.even.strand(s);
            const Vec3 root = point_of(strand, 0), tip = point_of(strand, kCardPoints - 1);
            before.push_back((card_.sections.front().center - root).dot(first));
            behind.push_back((tip - card_.sections.back().center).dot(end));
        }
        const double length = card_.length();
        // Farther than that, a straight beginning would stand off the head.
        const double add_before =
            std::clamp(quantile(before, 0.9), 0.0, std::min(0.3 * length, kMostBefore));
        const double add_behind =
            std::clamp(quantile(behind, kTipsReached), 0.0, kMostBehind * length);
        std::vector<Vec3> points = centers();
        points.insert(points.begin(), points.front() - add_before * first);
        points.push_back(points.back() + add_behind * towards_tips(end));
        set_centers(points);
    }

    // The direction in which the card goes on, half turned to the mean of the tips behind it: hair
    // that lies on a head goes on around it.
    Vec3 towards_tips(const Vec3& end) const {
        if (!ground_.options.distance) return end;
        const Vec3& last = card_.sections.back().center;
        Vec3 sum = Vec3::Zero();
        for (const Index s : card_.strands) {
            const Vec3 way = point_of(ground_.even.strand(s), kCardPoints - 1) - last;
            if (way.dot(end) > 0.0) sum += way.dot(end) * way;
        }
        return sum.norm() > 0.0 ? Vec3((end + sum.normalized()).normalized()) : end;
    }

    // Turns the card's plane about its course to that of most spread, near the surface.
    void face_out() {
        std::vector<Mat3> spread(at(ground_.sections), Mat3::Zero());
        for (const Index s : card_.strands) {
            const StrandView strand = ground_.even.strand(s);
            for (Index k = 0; k < kCardPoints; ++k) {
                const Vec3 p = point_of(strand, k);
                const Index section = nearest_section(p);
                const Vec3 d = p - card_.sections[at(section)].center;
                spread[at(section)] += d * d.transpose();
            }
        }
        double before = 0.0;
        for (Index k = 0; k < ground_.sections; ++k) {
            CardSection& section = card_.sections[at(k)];
            const Vec3 along = card_direction(card_.sections, k);
            const Vec3 up =
                away_from_head(ground_.options.distance, ground_.middle, section.center, kAwayStep);
            Vec3 across = along.cross(up);
            if (across.norm() < 1e-6) across = along.unitOrthogonal();
            across.normalize();
            const Vec3 out = across.cross(along);
            double turn = tilt(spread[at(k)], across, out);
            if (k > 0) turn = std::clamp(turn, before - kMostTurn, before + kMostTurn);
            before = turn;
            section.across = std::cos(turn) * across + std::sin(turn) * out;
            if (plane_ == CardPlane::crossing) {
                section.across = std::cos(turn) * out - std::sin(turn) * across;
            }
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
        for (Index k = 0; k < ground_.sections; ++k) {
            const double d = (card_.sections[at(k)].center - p).squaredNorm();
            if (d >= least) continue;
            least = d;
            best = k;
        }
        return best;
    }

    // Puts sections in the middle of their strands from side to side, and out to where those are
    // seen that lie on others.
    void widen() {
        std::vector<std::vector<double>> sides(at(ground_.sections)), outs(at(ground_.sections));
        for (const Index s : card_.strands) {
            const StrandView strand = ground_.even.strand(s);
            for (Index k = 0; k < kCardPoints; ++k) {
                const Vec3 p = point_of(strand, k);
                const Index section = nearest_section(p);
                const CardSection& near = card_.sections[at(section)];
                sides[at(section)].push_back((p - near.center).dot(near.across));
                outs[at(section)].push_back((p - near.center).dot(near.out));
            }
        }
        std::vector<double> widths, aside, lifts;
        for (Index k = 0; k < ground_.sections; ++k) {
            std::vector<double>& list = sides[at(k)];
            const double reach = 0.5 * ground_.options.coverage;
            const double high = quantile(list, 0.5 + reach);
            const double low = over_skin(card_.sections[at(k)], quantile(list, 0.5 - reach), high);
            const double lift = plane_ == CardPlane::alone ? kLiftAlone : kLiftCrossed;
            widths.push_back(list.empty() && k > 0 ? widths.back() : 0.5 * (high - low));
            aside.push_back(list.empty() && k > 0 ? aside.back() : 0.5 * (low + high));
            lifts.push_back(list.empty() && k > 0 ? lifts.back() : quantile(outs[at(k)], lift));
        }
        for (std::vector<double>* list : {&widths, &aside, &lifts}) even_out(*list);
        for (Index k = 0; k < ground_.sections; ++k) {
            CardSection& section = card_.sections[at(k)];
            section.center += aside[at(k)] * section.across + lifts[at(k)] * section.out;
            section.half_width = std::max(kLeastHalfWidth, widths[at(k)]);
        }
    }

    // The lower edge of a card that stands on the skin.
    double over_skin(const CardSection& section, double low, double high) const {
        if (plane_ != CardPlane::crossing || !ground_.options.distance) return low;
        const double step = (high - low) / kSkinSteps;
        for (int i = 0; i < kSkinSteps; ++i, low += step) {
            const Vec3 edge = section.center + low * section.across;
            if (ground_.options.distance(edge) >= ground_.options.clearance) break;
        }
        return low;
    }

    // Moves sections out until their centre and edges, and those halfway to the next, are clear.
    void push_out() {
        if (!ground_.options.distance) return;
        for (int pass = 0; pass < kPushPasses; ++pass) {
            bool clear = true;
            for (Index k = 0; k < ground_.sections; ++k) clear = push_section(k) && clear;
            if (clear) return;
        }
    }

    // Each edge moves out by itself, so that the card lies along the skin, then all of it if its
    // middle is still too deep.
    bool push_section(Index k) {
        CardSection& section = card_.sections[at(k)];
        std::array<Vec3, 2> edges;
        bool clear = true;
        for (const int side : {0, 1}) {
            const double u = side == 0 ? -1.0 : 1.0;
            edges[at(side)] = section.center + u * section.half_width * section.across;
            const double depth = depth_at(k, u);
            if (depth <= kClearEnough) continue;
            edges[at(side)] += depth * away(edges[at(side)]);
            clear = false;
        }
        const Vec3 width = edges[1] - edges[0];
        if (!clear && width.norm() > 2.0 * kLeastHalfWidth) {
            section.center = 0.5 * (edges[0] + edges[1]);
            section.half_width = 0.5 * width.norm();
            section.across = width.normalized();
            const Vec3 out = section.out - section.out.dot(section.across) * section.across;
            section.out =
                out.norm() > 1e-6 ? Vec3(out.normalized()) : Vec3(section.across.unitOrthogonal());
        }
        const double depth = depth_at(k, 0.0);
        if (depth > kClearEnough) section.center += depth * away(section.center);
        return clear && depth <= kClearEnough;
    }

    Vec3 away(const Vec3& p) const {
        return away_from_head(ground_.options.distance, ground_.middle, p, kAwayStep);
    }

    // Metres by which a section, or the middle to the next, is too deep at `u` across.
    double depth_at(Index k, double u) const {
        const CardSection& section = card_.sections[at(k)];
        const CardSection& next = card_.sections[at(std::min(k + 1, ground_.sections - 1))];
        const Vec3 a = section.center + u * section.half_width * section.across;
        const Vec3 b = next.center + u * next.half_width * next.across;
        double deepest = 0.0;
        for (const double part : {0.0, 0.5}) {
            const double depth =
                ground_.options.clearance - ground_.options.distance(a + part * (b - a));
            if (std::isfinite(depth)) deepest = std::max(deepest, depth);
        }
        return deepest;
    }

    const CardGround& ground_;
    CardPlane plane_;
    Card card_;
};

}  // namespace

Card make_card(const CardGround& ground, CardPlane plane, std::vector<Index> strands,
               Index medoid) {
    return CardMaker(ground, plane).make(std::move(strands), medoid);
}

CardSpread spread_of(const Card& card, const Strands& even) {
    const auto last = count_of(card.sections) - 1;
    double out = 0.0, across = 0.0, count = 0.0;
    for (const Index s : card.strands) {
        for (Index k = 0; k < kCardPoints; k += 3) {
            const CardPoint p = place_on_card(card, point_of(even.strand(s), k));
            const double v = std::clamp(p.v, 0.0, 1.0) * last;
            const double side = p.u * card.sections[at(static_cast<Index>(v))].half_width;
            out += p.out * p.out;
            across += side * side;
            count += 1.0;
        }
    }
    count = std::max(count, 1.0);
    return {std::sqrt(across / count), std::sqrt(out / count)};
}

}  // namespace lissom
