#include "kernel/merge/loop/curve_fit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kernel/deform/rotation/polar.h"
#include "kernel/merge/loop/face_angles.h"

namespace lissom {
namespace {

// Points of one curve lie this close to each other, in its lengths: files hold six digits.
constexpr double kOneCurve = 1e-5;
// Vertices closer than this part of the spacing on either loop are one, if they are that close.
constexpr double kOneVertex = 0.3;
// Keys meet that are this close, in loop lengths: a hand is no better.
constexpr double kKeyReach = 0.02;
// The tolerance of keys, in spacings, if several fits leave a choice.
constexpr double kKeyShare = 0.1;
// Chords that are compared before a fit is made.
constexpr Index kChords = 8;

// How far apart two fractions of a loop are, at most a half.
double gap(double a, double b) {
    const double d = std::abs(a - b) - std::floor(std::abs(a - b));
    return std::min(d, 1.0 - d);
}

// A loop by its own arc length, in fractions of it.
class Curve {
  public:
    explicit Curve(const Loop& loop) : loop_(loop) {
        const std::vector<Vec3>& points = loop.points();
        double sum = 0.0;
        for (std::size_t k = 0; k < points.size(); ++k) {
            at_.push_back(sum / loop.length());
            sum += (points[(k + 1) % points.size()] - points[k]).norm();
        }
    }

    Index size() const { return loop_.size(); }
    double length() const { return loop_.length(); }
    const Vec3& point(Index k) const { return loop_.points()[at(k % size())]; }
    const std::vector<Vec3>& points() const { return loop_.points(); }
    double fraction(Index k) const { return at_[at(k)]; }
    // Arc length from vertex `start` to the `n`th vertex after it.
    double ahead(Index start, Index n) const {
        if (n == size()) return 1.0;
        const Index k = start + n;
        return k < size() ? at_[at(k)] - at_[at(start)]
                          : at_[at(k - size())] + 1.0 - at_[at(start)];
    }
    double spacing(Index start, Index n) const {
        const double before =
            n > 0 ? ahead(start, n) - ahead(start, n - 1) : 1.0 - ahead(start, size() - 1);
        return std::min(before, ahead(start, n + 1) - ahead(start, n));
    }
    double fraction_of(double parameter) const {
        const LoopPoint place = loop_.place_at(parameter);
        const double from = at_[at(place.segment)];
        return from + place.t * (ahead(place.segment, 1));
    }
    // The vertex that the loop turns most at, the first of equals.
    Index sharpest() const {
        Index best = 0;
        double most = -1.0;
        for (Index k = 0; k < size(); ++k) {
            const Vec3 before = point(k) - point(k + size() - 1);
            const double turn = angle_between(before, point(k + 1) - point(k));
            if (!(turn > most + kOneCurve)) continue;
            best = k;
            most = turn;
        }
        return best;
    }

  private:
    const Loop& loop_;
    std::vector<double> at_;
};

// Places of both loops' vertices if vertex `i0` of the source meets `j0` of the target.
class SideBySide {
  public:
    SideBySide(const Curve& source, const Curve& target, Index i0, Index j0)
        : source_(source), target_(target), i0_(i0), j0_(j0) {
        on_target.resize(at(source.size()));
        on_source.resize(at(target.size()));
        Index i = 0, j = 0;
        while (i < source.size() || j < target.size()) {
            const double s = source.ahead(i0, i), t = target.ahead(j0, j);
            if (i < source.size() && j < target.size() && is_one(i, j)) {
                on_target[place(source, i0, i)] = {vertex(target, j0, j++), 0.0};
                on_source[place(target, j0, j - 1)] = {vertex(source, i0, i++), 0.0};
            } else if (s < t) {
                on_target[place(source, i0, i++)] = between(target, j0, j - 1, s);
            } else {
                on_source[place(target, j0, j++)] = between(source, i0, i - 1, t);
            }
        }
    }

    std::vector<LoopPoint> on_target, on_source;

  private:
    static Index vertex(const Curve& curve, Index start, Index n) {
        return (start + n) % curve.size();
    }
    static std::size_t place(const Curve& curve, Index start, Index n) {
        return at(vertex(curve, start, n));
    }
    static LoopPoint between(const Curve& curve, Index start, Index n, double fraction) {
        const double from = curve.ahead(start, n), to = curve.ahead(start, n + 1);
        return {vertex(curve, start, n), (fraction - from) / (to - from)};
    }
    bool is_one(Index i, Index j) const {
        if (i == 0 || j == 0) return i == j;
        const double apart = std::abs(source_.ahead(i0_, i) - target_.ahead(j0_, j));
        return apart <= kOneCurve &&
               apart <= kOneVertex * std::min(source_.spacing(i0_, i), target_.spacing(j0_, j));
    }

    const Curve& source_;
    const Curve& target_;
    Index i0_, j0_;
};

// Points of both loops that meet: at every vertex of either.
struct Meetings {
    std::vector<Vec3> from, to;

    Meetings(const Curve& source, const Curve& target, const SideBySide& places) {
        from = source.points();
        for (const LoopPoint& place : places.on_target) {
            to.push_back(point_of(target.points(), place));
        }
        for (const LoopPoint& place : places.on_source) {
            from.push_back(point_of(source.points(), place));
        }
        to.insert(to.end(), target.points().begin(), target.points().end());
    }

    bool agree(const CurveFit& fit, double reach) const {
        for (std::size_t k = 0; k < from.size(); ++k) {
            if (!((fit(from[k]) - to[k]).norm() <= reach)) return false;
        }
        return true;
    }

    SimilarityMap similarity() const {
        const auto count = static_cast<double>(from.size());
        Vec3 a = Vec3::Zero(), b = Vec3::Zero();
        for (const Vec3& p : from) a += (p - from[0]) / count;
        for (const Vec3& p : to) b += (p - to[0]) / count;
        return similarity_about(from, to, from[0] + a, to[0] + b);
    }
};

std::optional<CurveFit> fit_at(const Loop& source, const Loop& target, const Curve& from,
                               const Curve& to, Index i, Index j, bool moves) {
    SideBySide places(from, to, i, j);
    const Meetings meetings(from, to, places);
    CurveFit fit;
    if (moves) {
        fit.map = meetings.similarity();
        fit.stays = false;
    }
    if (!meetings.agree(fit, kOneCurve * to.length())) return std::nullopt;
    fit.pair = {source.vertices(), target.vertices(), std::move(places.on_target),
                std::move(places.on_source)};
    return fit;
}

// Whether a few chords from vertices that would meet are as long on both curves.
bool chords_agree(const Curve& source, const Curve& target, Index i, Index j) {
    const double ratio = target.length() / source.length();
    Index after = 0;
    for (Index c = 1; c < kChords; ++c) {
        const Index n = c * source.size() / kChords;
        const double fraction = source.ahead(i, n);
        while (after < target.size() && target.ahead(j, after + 1) <= fraction) ++after;
        const double from = target.ahead(j, after), step = target.ahead(j, after + 1) - from;
        const Vec3 place =
            target.point(j + after) +
            (fraction - from) / step * (target.point(j + after + 1) - target.point(j + after));
        const double chord = ratio * (source.point(i + n) - source.point(i)).norm();
        const double other = (place - target.point(j)).norm();
        if (!(std::abs(chord - other) <= 4.0 * kOneCurve * target.length())) return false;
    }
    return true;
}

double median(std::vector<double> values) {
    if (values.empty()) return 0.0;
    const auto middle = values.begin() + std::ssize(values) / 2;
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace

std::optional<CurveFit> fit_in_place(const Loop& source, const Loop& target) {
    if (!((source.center() - target.center()).norm() <= kOneCurve * target.length())) {
        return std::nullopt;
    }
    const Curve from(source), to(target);
    const Index i = from.sharpest();
    for (Index j = 0; j < to.size(); ++j) {
        if (!((from.point(i) - to.point(j)).norm() <= kOneCurve * to.length())) continue;
        if (auto fit = fit_at(source, target, from, to, i, j, false)) return fit;
    }
    return std::nullopt;
}

std::vector<CurveFit> curve_fits(const Loop& source, const Loop& target, std::size_t most) {
    const Curve from(source), to(target);
    const Index i = from.sharpest();
    std::vector<CurveFit> fits;
    for (Index j = 0; j < to.size() && fits.size() < most; ++j) {
        if (!chords_agree(from, to, i, j)) continue;
        if (auto fit = fit_at(source, target, from, to, i, j, true)) fits.push_back(*fit);
    }
    return fits;
}

std::optional<CurveFit> fit_near(const Loop& source, const Loop& target, const ParameterPair& key) {
    const Curve from(source), to(target);
    const Index i = from.sharpest();
    const double wanted =
        to.fraction_of(key.target) + from.fraction(i) - from.fraction_of(key.source);
    std::vector<std::pair<double, Index>> near;
    for (Index j = 0; j < to.size(); ++j) {
        const double off = gap(to.fraction(j), wanted);
        if (off <= kKeyReach) near.emplace_back(off, j);
    }
    std::sort(near.begin(), near.end());
    for (const auto& [off, j] : near) {
        if (!chords_agree(from, to, i, j)) continue;
        auto fit = fit_at(source, target, from, to, i, j, true);
        if (!fit) continue;
        // On a curve that repeats itself, a key beside a vertex is taken literally.
        const double firm = kKeyShare * std::min(from.spacing(i, 0), to.spacing(j, 0));
        if (off > firm && curve_fits(source, target, 2).size() > 1) return std::nullopt;
        return fit;
    }
    return std::nullopt;
}

bool meets(const CurveFit& fit, const Loop& source, const Loop& target,
           std::span<const ParameterPair> keys) {
    if (keys.empty()) return true;
    const Curve from(source), to(target);
    // Arc length agrees, so that one vertex tells how far the loops are turned.
    const double turn = to.fraction(fit.pair.on_target[0].segment) +
                        fit.pair.on_target[0].t * to.ahead(fit.pair.on_target[0].segment, 1);
    return std::all_of(keys.begin(), keys.end(), [&](const ParameterPair& key) {
        return gap(from.fraction_of(key.source) + turn, to.fraction_of(key.target)) <= kKeyReach;
    });
}

double median_turn(const CurveFit& fit, const Mesh& source, const Mesh& target) {
    const LoopPair& pair = fit.pair;
    const auto n = count_of(pair.source), m = count_of(pair.target);
    std::vector<double> turns;
    const auto add = [&](Index i, Index j) {
        const Index a =
            face_left_of(source.topology(), pair.source[at((i + 1) % n)], pair.source[at(i)]);
        const Index b =
            face_left_of(target.topology(), pair.target[at(j)], pair.target[at((j + 1) % m)]);
        if (a == kNoIndex || b == kNoIndex) return;
        const Vec3 p = clear_area_vector(source, a), q = clear_area_vector(target, b);
        if (p.isZero(0.0) || q.isZero(0.0)) return;
        turns.push_back(angle_between(fit.map.rotation * p, q));
    };
    for (Index i = 0; i < n; ++i) add(i, pair.on_target[at(i)].segment);
    for (Index j = 0; j < m; ++j) add(pair.on_source[at(j)].segment, j);
    return median(std::move(turns));
}

}  // namespace lissom
