#include "viewer/render/draw/style_marks.h"

#include <algorithm>

#include "kernel/mesh/shapes/head.h"
#include "tests/unit/support.h"

using namespace lissom;

namespace {

Hairstyle styled(const Mesh& head) {
    HairstyleOptions options;
    options.resolution = 6000;
    Hairstyle style(head, std::make_shared<const Scalp>(head), options);
    const auto at = [&](double azimuth, double elevation, double lift) {
        const ScalpPoint on = style.scalp().at({azimuth * kDegree, elevation * kDegree}, lift);
        return style.scalp().to_metres(on.position);
    };
    style.add({StreamCurve{{at(20, 50, 0.01), at(70, 25, 0.02), at(85, -15, 0.02)}}});
    style.add({DividingCurve{{at(0, 45, 0), at(0, 65, 0), at(0, 85, 0)}}});
    const Vec3 tie = at(180, 25, 0.02);
    style.add({Ponytail{{tie, tie + Vec3(0, -0.01, -0.04), tie + Vec3(0, -0.12, -0.06)}}});
    style.solve();
    return style;
}

StyleMarks only(bool curves, bool constraints) {
    StyleMarks marks;
    marks.curves = curves;
    marks.constraints = constraints;
    return marks;
}

}  // namespace

TEST_CASE("style marks: curves are drawn each in the colour of its kind, ties as circles") {
    const Mesh head = make_head({.vertices = 3000});
    Hairstyle style = styled(head);
    const std::vector<DrawnLine> lines = style_lines(style);
    // Three curves and three cross sections.
    REQUIRE(lines.size() == 6);
    CHECK(lines[0].color.g > 0.5);
    CHECK(lines[1].color.r > 0.7);
    CHECK(lines[2].color == lines[3].color);
    CHECK(lines[3].closed);
    CHECK(lines[0].points.size() == style.course(style.curves()[0]).size());
    style.enable(style.curves()[0], false);
    CHECK_FALSE(style_lines(style)[0].color == lines[0].color);
}

TEST_CASE("style marks: an arrow for every constraint, at its point, in the figures' colours") {
    const Mesh head = make_head({.vertices = 3000});
    const Hairstyle style = styled(head);
    std::vector<StyleConstraint> all = style.constraints();
    std::erase_if(all, [](const StyleConstraint& one) { return !(one.vector.norm() > 0.02); });
    const std::vector<DrawnLine> arrows = style_lines(style, only(false, true));
    REQUIRE(arrows.size() == all.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
        CHECK((style.scalp().to_metres(arrows[i].points[0]) - all[i].point).norm() < 1e-9);
        const Vec3 along = arrows[i].points[1] - arrows[i].points[0];
        CHECK(along.normalized().dot(style.scalp().frame().axes * all[i].vector.normalized()) >
              0.999);
        const Color& c = arrows[i].color;
        if (all[i].kind == ConstraintKind::stream) CHECK(c.b > 0.8);
        if (all[i].kind == ConstraintKind::separation) CHECK(c.r > 0.8);
        if (all[i].kind == ConstraintKind::gather) CHECK(c.g > 0.5);
    }
}

TEST_CASE("style marks: the field is drawn on its plane, outside the head") {
    const Mesh head = make_head({.vertices = 3000});
    const Hairstyle style = styled(head);
    StyleMarks marks = only(false, false);
    marks.field = FieldSlice{Vec3(0.03, 0, 0), Vec3(2, 0, 0)};
    const std::vector<DrawnLine> arrows = style_lines(style, marks);
    CHECK(arrows.size() > 100);
    for (const DrawnLine& arrow : arrows) {
        const Vec3 from = style.scalp().to_metres(arrow.points[0]);
        CHECK(from.x() == doctest::Approx(0.03));
        CHECK(style.field().sample(from).distance >= 0.0);
        CHECK((arrow.points[1] - arrow.points[0]).norm() <
              1.01 * style.layout().step * style.scalp().scale());
    }
    marks.field->normal = Vec3::Zero();
    CHECK(test::error_of([&] { style_lines(style, marks); }).code() == ErrorCode::invalid_argument);
    marks.field = FieldSlice{Vec3::Zero(), Vec3::UnitX(), 1e-6};
    CHECK(test::error_of([&] { style_lines(style, marks); }).code() == ErrorCode::invalid_argument);
}

TEST_CASE("style marks: a legend names the colours that are drawn, and no others") {
    const Mesh head = make_head({.vertices = 3000});
    Hairstyle style = styled(head);
    const auto names = [&](const StyleMarks& marks) {
        std::string text;
        for (const LegendPart& part : style_legend(style, marks)) text += part.name + "; ";
        return text;
    };
    CHECK(names(only(true, false)).empty());
    CHECK(names(only(false, true)) == "along curves; ends, partings; around tails; into the tie; ");
    NamedMarks marks = field_marks(style);
    CHECK(marks.names.back().name == "field");
    const auto is_field = [&](const DrawnLine& line) {
        return line.color == marks.names.back().color;
    };
    CHECK(std::count_if(marks.lines.begin(), marks.lines.end(), is_field) > 100);
    const Box box = style.layout().box();
    const auto is_edge = [&](const DrawnLine& line) {
        const auto corner = [&](const Vec3& point) {
            const Vec3 p = style.scalp().to_metres(point);
            return (p - box.min).cwiseAbs().cwiseMin((box.max - p).cwiseAbs()).maxCoeff() < 1e-9;
        };
        return line.points.size() == 2 && corner(line.points[0]) && corner(line.points[1]);
    };
    CHECK(std::count_if(marks.lines.begin(), marks.lines.end(), is_edge) == 12);
    // A field that is behind its curves is not shown.
    style.remove(style.curves()[2]);
    marks = field_marks(style);
    REQUIRE(marks.names.size() == 2);
    CHECK(marks.names.back().name == "ends, partings");
}
