#include "viewer/render/draw/style_marks.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "kernel/core/error.h"
#include "kernel/hair/curve/curve.h"

namespace lissom {
namespace {

constexpr Color kStreamColor{0.0, 0.62, 0.74}, kDividingColor{0.80, 0.10, 0.10},
    kTailColor{0.50, 0.22, 0.72}, kOffColor{0.55, 0.55, 0.57};

// In the order of ConstraintKind.
constexpr Color kBlue{0.12, 0.36, 0.86}, kRed{0.86, 0.16, 0.12}, kPurple{0.50, 0.22, 0.72},
    kGreen{0.10, 0.58, 0.20}, kGrey{0.45, 0.45, 0.47};
constexpr std::array<Color, 8> kKindColors = {kBlue,   kRed,  kBlue,  kRed,
                                              kPurple, kBlue, kGreen, kGrey};

// Length of an arrow at full speed, in spacings.
constexpr double kArrowLength = 0.85;
// Length and half width of an arrow's head, as fractions of the arrow's full length.
constexpr double kHeadLength = 0.32, kHeadWidth = 0.14;
// A field shorter than this has no direction to show.
constexpr double kMinSpeed = 0.02;
constexpr double kMaxArrows = 1e6;
constexpr int kCirclePoints = 40;

double line_share(const StyleMarks& marks) {
    return marks.width / 3.0;
}

// Two unit vectors across a direction.
std::array<Vec3, 2> across(const Vec3& direction) {
    const Vec3 one = direction.unitOrthogonal();
    return {one, direction.cross(one).normalized()};
}

class MarkMaker {
  public:
    MarkMaker(const Hairstyle& style, const StyleMarks& marks) : style_(style), marks_(marks) {}

    std::vector<DrawnLine> lines() && {
        if (marks_.curves) {
            for (const CurveId id : style_.curves()) add_curve(id);
        }
        if (marks_.constraints) add_constraints();
        if (marks_.field) add_slice(*marks_.field);
        if (marks_.volume) add_volume();
        return std::move(lines_);
    }

  private:
    void add_line(const std::vector<Vec3>& points, bool closed, const Color& color, double width) {
        DrawnLine line{{}, closed, color, width};
        for (const Vec3& p : points) line.points.push_back(style_.scalp().from_metres(p));
        lines_.push_back(std::move(line));
    }

    void add_curve(CurveId id) {
        const StyleCurve& curve = style_.curve(id);
        constexpr std::array<Color, 3> kColors = {kStreamColor, kDividingColor, kTailColor};
        const Color color = curve.enabled ? kColors[curve.shape.index()] : kOffColor;
        add_line(style_.course(id), false, color, marks_.width);
        if (const auto* tail = std::get_if<Ponytail>(&curve.shape)) add_sections(*tail, color);
    }

    // The first cross section, the last, and one in between.
    void add_sections(const Ponytail& tail, const Color& color) {
        const double step = style_.layout().step;
        const PonytailShape shape =
            ponytail_shape(smooth_curve(tail.spine, 0.5 * step), step, tail.options);
        const std::size_t last = shape.sections.size() - 1;
        for (const std::size_t i : {std::size_t{0}, last / 2, last}) {
            const PonytailSection& section = shape.sections[i];
            const auto [u, v] = across(section.direction);
            std::vector<Vec3> circle;
            for (int k = 0; k < kCirclePoints; ++k) {
                const double a = 2.0 * kPi * k / kCirclePoints;
                circle.push_back(section.center +
                                 section.radius * (std::cos(a) * u + std::sin(a) * v));
            }
            add_line(circle, true, color, 0.6 * marks_.width);
        }
    }

    // From `point`, with its head in the plane of `side`.
    void add_arrow(const Vec3& point, const Vec3& vector, const Vec3& side, double full,
                   const Color& color) {
        const Vec3 tip = point + full * vector, along = vector.normalized();
        const Vec3 back = tip - kHeadLength * full * std::min(1.0, vector.norm()) * along;
        const Vec3 out = kHeadWidth * full * std::min(1.0, vector.norm()) * side;
        add_line({point, tip, back + out, tip, back - out}, false, color, line_share(marks_));
    }

    void add_constraints() {
        const double full = kArrowLength * style_.layout().step;
        for (const StyleConstraint& one : style_.constraints()) {
            if (!(one.vector.norm() > kMinSpeed)) continue;
            add_arrow(one.point, one.vector, across(one.vector.normalized())[0], full,
                      kKindColors[static_cast<std::size_t>(one.kind)]);
        }
    }

    void add_slice(const FieldSlice& slice) {
        const double spacing = slice.spacing.value_or(style_.layout().step);
        const Box box = style_.layout().box();
        const double reach = (box.max - box.min).norm();
        const bool good = slice.point.allFinite() && slice.normal.allFinite() &&
                          slice.normal.norm() > 0.0 && spacing > 0.0 && std::isfinite(spacing);
        if (!good || std::pow(2.0 * reach / spacing, 2.0) > kMaxArrows) {
            throw Error(ErrorCode::invalid_argument,
                        "a slice of the field needs a point and a normal that is not zero, and a "
                        "spacing that is at least a five hundredth of its volume");
        }
        const Vec3 normal = slice.normal.normalized(), middle = 0.5 * (box.min + box.max);
        // Rows are level if possible.
        const Vec3 level = Vec3::UnitY().cross(normal);
        const Vec3 u = level.norm() > 1e-3 ? Vec3(level.normalized()) : across(normal)[0];
        const Vec3 v = normal.cross(u);
        const Vec3 start = middle + (slice.point - middle).dot(normal) * normal;
        const int count = static_cast<int>(std::ceil(0.5 * reach / spacing));
        for (int j = -count; j <= count; ++j) {
            for (int i = -count; i <= count; ++i) {
                const Vec3 p = start + spacing * (i * u + j * v);
                if (box.contains(p)) add_field_arrow(p, normal, kArrowLength * spacing);
            }
        }
    }

    void add_field_arrow(const Vec3& point, const Vec3& normal, double full) {
        const HairField::Sample here = style_.field().sample(point);
        const Vec3 vector = here.direction / std::max(1.0, here.direction.norm());
        if (here.distance < 0.0 || !(vector.norm() > kMinSpeed)) return;
        const Vec3 side = normal.cross(vector);
        if (!(side.norm() > 1e-6)) return;
        add_arrow(point, vector, side.normalized(), full, marks_.field_color);
    }

    // The edges of the box along each axis.
    void add_volume() {
        const Box box = style_.layout().box();
        for (int axis = 0; axis < 3; ++axis) {
            for (int corner = 0; corner < 4; ++corner) {
                Vec3 from = box.min;
                if (corner & 1) from[(axis + 1) % 3] = box.max[(axis + 1) % 3];
                if (corner & 2) from[(axis + 2) % 3] = box.max[(axis + 2) % 3];
                Vec3 to = from;
                to[axis] = box.max[axis];
                add_line({from, to}, false, marks_.field_color, line_share(marks_));
            }
        }
    }

    const Hairstyle& style_;
    const StyleMarks& marks_;
    std::vector<DrawnLine> lines_;
};

struct NamedKind {
    const char* name;
    std::array<ConstraintKind, 3> kinds;
};

constexpr NamedKind kNamedKinds[] = {
    {"along curves", {ConstraintKind::stream, ConstraintKind::parting, ConstraintKind::spine}},
    {"ends, partings", {ConstraintKind::stop, ConstraintKind::separation, ConstraintKind::stop}},
    {"around tails", {ConstraintKind::section, ConstraintKind::section, ConstraintKind::section}},
    {"into the tie", {ConstraintKind::gather, ConstraintKind::gather, ConstraintKind::gather}},
    {"along the scalp", {ConstraintKind::scalp, ConstraintKind::scalp, ConstraintKind::scalp}},
};

}  // namespace

std::vector<LegendPart> style_legend(const Hairstyle& style, const StyleMarks& marks) {
    std::vector<LegendPart> parts;
    std::array<bool, kKindColors.size()> drawn{};
    if (marks.constraints) {
        for (const StyleConstraint& one : style.constraints()) {
            if (one.vector.norm() > kMinSpeed) drawn[static_cast<std::size_t>(one.kind)] = true;
        }
    }
    for (const NamedKind& named : kNamedKinds) {
        const auto is_drawn = [&](ConstraintKind kind) {
            return drawn[static_cast<std::size_t>(kind)];
        };
        if (std::none_of(named.kinds.begin(), named.kinds.end(), is_drawn)) continue;
        parts.push_back({named.name, kKindColors[static_cast<std::size_t>(named.kinds[0])]});
    }
    if (marks.field) parts.push_back({"field", marks.field_color});
    return parts;
}

NamedMarks field_marks(const Hairstyle& style) {
    StyleMarks marks{
        .curves = false, .constraints = true, .volume = true, .field_color = {0.43, 0.52, 0.68}};
    if (style.solved()) marks.field = FieldSlice{};
    return {style_lines(style, marks), style_legend(style, marks)};
}

std::vector<DrawnLine> style_lines(const Hairstyle& style, const StyleMarks& marks) {
    return MarkMaker(style, marks).lines();
}

}  // namespace lissom
