#include "kernel/hair/comb.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/core/rotation.h"
#include "kernel/hair/curve/curve.h"
#include "kernel/hair/curve/curve_foot.h"

namespace lissom {
namespace {

// Spacing of the stroke's samples, in steps of the grid.
constexpr double kStrokeStep = 0.5;
// The shortest stroke and the shortest part of a stream that is bent, in steps of the grid.
constexpr double kShortestStroke = 2.0;
// Streams that run against the stroke by more than this are not bent: it is not clear which way.
constexpr double kAgainst = 120.0 * kDegree;
// Results are alike if their angles differ by less.
constexpr double kAlike = 3.0 * kDegree;

double angle_between(const Vec3& a, const Vec3& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

// How much a comb holds at a distance from its stroke.
double hold_at(double distance, double reach) {
    const double t = std::clamp(2.0 - 2.0 * distance / reach, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

Vec3 turned_towards(const Vec3& v, const Vec3& direction, double share) {
    return Eigen::Quaterniond::Identity().slerp(share, min_rotation(v, direction)) * v;
}

// ---- How a style changes

// The angle of the field to the stroke along it, root of the mean square.
double misfit(const HairField& field, std::span<const Vec3> stroke) {
    double sum = 0.0;
    for (std::size_t i = 1; i < stroke.size(); ++i) {
        const Vec3 middle = 0.5 * (stroke[i - 1] + stroke[i]);
        const Vec3 flow = field.sample(middle).direction;
        const double angle =
            flow.norm() > 0.0 ? angle_between(flow, stroke[i] - stroke[i - 1]) : kPi;
        sum += angle * angle;
    }
    return std::sqrt(sum / static_cast<double>(stroke.size() - 1));
}

// Which grid points are outside the head and beyond the reach of the stroke.
std::vector<char> points_elsewhere(const HairField& field, std::span<const Vec3> stroke,
                                   double reach) {
    const GridLayout& layout = field.layout();
    Box near;
    for (const Vec3& p : stroke) near.extend(p);
    near.min.array() -= reach;
    near.max.array() += reach;
    std::vector<char> elsewhere(at(layout.size()), 0);
    for (Index i = 0; i < layout.size(); ++i) {
        const Vec3 p = layout.point(i);
        const bool is_near = near.contains(p) && foot_on_curve(stroke, p).distance < reach;
        elsewhere[at(i)] = !is_near && field.distances().values()[at(i)] > 0.0f;
    }
    return elsewhere;
}

double field_change(std::span<const float> before, std::span<const float> after,
                    const std::vector<char>& counts) {
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (!counts[i]) continue;
        const auto vector = [&](std::span<const float> quads) {
            return Vec3(quads[4 * i], quads[4 * i + 1], quads[4 * i + 2]);
        };
        sum += (vector(after) - vector(before)).squaredNorm();
        count += 1.0;
    }
    return std::sqrt(sum / std::max(count, 1.0));
}

std::vector<CurveId> bend_streams(Hairstyle& style, std::span<const Vec3> stroke, double reach) {
    std::vector<CurveId> bent;
    const std::vector<CurveId> ids(style.curves().begin(), style.curves().end());
    for (const CurveId id : ids) {
        const StyleCurve& curve = style.curve(id);
        if (!curve.enabled || !std::holds_alternative<StreamCurve>(curve.shape)) continue;
        auto points = combed_stream(style.course(id), stroke, reach);
        if (!points) continue;
        style.set_points(id, std::move(*points));
        bent.push_back(id);
    }
    return bent;
}

CurveId add_stream(Hairstyle& style, std::span<const Vec3> stroke) {
    auto stream = curve_with<StreamCurve>(style.options().fidelity);
    stream.points.assign(stroke.begin(), stroke.end());
    // Hair continues beyond the comb.
    stream.options.stop_length = 0.0;
    StyleCurve curve{std::move(stream)};
    curve.name = "comb";
    return style.add(std::move(curve));
}

// ---- Attempts

struct Attempt {
    CombReport report;
    StyleInputs inputs;
};

class Comb {
  public:
    Comb(Hairstyle& style, std::vector<Vec3> stroke, const CombOptions& options,
         const Context& context)
        : style_(style),
          stroke_(std::move(stroke)),
          options_(options),
          context_(context),
          inputs_(style.inputs()) {
        style_.solve(context_);
        values_.assign(style_.field().values().begin(), style_.field().values().end());
        before_ = misfit(style_.field(), stroke_);
        elsewhere_ = points_elsewhere(style_.field(), stroke_, options_.reach);
    }

    bool follows() const { return before_ <= options_.tolerance; }
    CombReport unchanged() const { return {{}, {}, before_, before_, 0.0}; }

    // Bends or adds or both, from the style as it was; nothing if no stream can be bent.
    std::optional<Attempt> attempt(bool bends, bool adds) {
        style_.restore(inputs_);
        CombReport report;
        if (bends) report.bent = bend_streams(style_, stroke_, options_.reach);
        if (bends && report.bent.empty()) return std::nullopt;
        if (adds) report.added = add_stream(style_, stroke_);
        style_.solve(context_);
        report.before = before_;
        report.after = misfit(style_.field(), stroke_);
        report.change = field_change(values_, style_.field().values(), elsewhere_);
        return Attempt{std::move(report), style_.inputs()};
    }

    Attempt least() {
        std::vector<Attempt> all;
        if (auto bent = attempt(true, false)) all.push_back(std::move(*bent));
        all.push_back(*attempt(false, true));
        const auto explains = [&](const Attempt& one) {
            return one.report.after <= options_.tolerance;
        };
        if (all.size() > 1 && std::none_of(all.begin(), all.end(), explains)) {
            all.push_back(*attempt(true, true));
        }
        double best = kPi;
        for (const Attempt& one : all) best = std::min(best, one.report.after);
        const double enough = std::max(options_.tolerance, best + kAlike);
        std::erase_if(all, [&](const Attempt& one) { return one.report.after > enough; });
        return *std::min_element(all.begin(), all.end(), [](const Attempt& a, const Attempt& b) {
            return a.report.change < b.report.change;
        });
    }

    Attempt only(CombBy by) {
        if (auto one = attempt(by == CombBy::bend, by == CombBy::add)) return std::move(*one);
        throw Error(ErrorCode::invalid_argument,
                    "no stream that runs with the stroke is beside it; comb nearer to one, or let "
                    "the comb add a stream");
    }

    CombReport take(Attempt chosen) {
        style_.restore(std::move(chosen.inputs));
        style_.solve(context_);
        return std::move(chosen.report);
    }
    void put_back() { style_.restore(inputs_); }

  private:
    Hairstyle& style_;
    std::vector<Vec3> stroke_;
    CombOptions options_;
    const Context& context_;
    StyleInputs inputs_;
    std::vector<float> values_;
    double before_ = 0.0;
    std::vector<char> elsewhere_;
};

std::vector<Vec3> fair_stroke_of(const Hairstyle& style, std::span<const Vec3> stroke) {
    const double step = style.field().layout().step;
    require_curve(stroke);
    if (curve_length(stroke) < kShortestStroke * step) {
        throw Error(ErrorCode::invalid_argument,
                    "the comb's stroke is shorter than two steps of the grid, which hair cannot "
                    "show; draw a longer one");
    }
    return resampled_curve(stroke, kStrokeStep * step);
}

}  // namespace

std::optional<std::vector<Vec3>> combed_stream(std::span<const Vec3> curve,
                                               std::span<const Vec3> stroke, double reach) {
    std::vector<Vec3> result{curve.front()};
    double held = 0.0, with = 0.0;
    for (std::size_t i = 1; i < curve.size(); ++i) {
        Vec3 side = curve[i] - curve[i - 1];
        const CurveFoot foot = foot_on_curve(stroke, 0.5 * (curve[i] + curve[i - 1]));
        const double hold = foot.beyond == 0.0 ? hold_at(foot.distance, reach) : 0.0;
        if (hold > 0.0) {
            const Vec3 way = stroke[foot.segment + 1] - stroke[foot.segment];
            held += hold * side.norm();
            if (angle_between(side, way) < kAgainst) with += hold * side.norm();
            side = turned_towards(side, way, hold);
        }
        result.push_back(result.back() + side);
    }
    const double least = 0.25 * reach;
    if (held < least || with < 0.5 * held) return std::nullopt;
    return result;
}

CombReport comb(Hairstyle& style, std::span<const Vec3> stroke, const CombOptions& options,
                const Context& context) {
    require(options.reach > 0.0 && std::isfinite(options.reach),
            "the reach of a comb must be a length above 0");
    require(options.tolerance > 0.0 && options.tolerance < kPi,
            "the tolerance of a comb must be an angle from 0 to 180 degrees");
    Comb work(style, fair_stroke_of(style, stroke), options, context);
    if (work.follows()) return work.unchanged();
    try {
        return work.take(options.by == CombBy::least ? work.least() : work.only(options.by));
    } catch (...) {
        work.put_back();
        throw;
    }
}

}  // namespace lissom
