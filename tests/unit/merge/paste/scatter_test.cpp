// One feature at many places of generated shapes.
#include "kernel/merge/paste/scatter.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/query/spatial_tree.h"
#include "tests/unit/deform/interrupter.h"
#include "tests/unit/merge/paste/paste_shapes.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

// Places on the unit sphere, evenly.
std::vector<PastePlacement> spiral(Index count, double scale) {
    std::vector<PastePlacement> places;
    for (Index i = 0; i < count; ++i) {
        const double y = 1.0 - (2.0 * i + 1.0) / count, angle = 2.399963 * i;
        const double r = std::sqrt(1.0 - y * y);
        places.push_back({.at = {r * std::cos(angle), y, r * std::sin(angle)}, .scale = scale});
    }
    return places;
}

Index parts_in(const ScatterResult& result) {
    std::map<Index, Index> faces;
    for (const Index place : result.place_of_face) ++faces[place];
    return index_of(faces.size()) - (faces.contains(kNoIndex) ? 1 : 0);
}

bool has_fault(const ScatterResult& result, MergeFault fault) {
    return std::any_of(result.reasons.begin(), result.reasons.end(),
                       [&](const MergeReason& reason) { return reason.fault == fault; });
}

// The part of the sharp edges of a cube from -1 to 1 that a mesh has not any more.
double cube_edges_gone(const Mesh& mesh) {
    const SpatialTree tree(mesh);
    constexpr int kSteps = 200;
    double gone = 0.0, all = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        for (int side = 0; side < 4; ++side) {
            for (int k = 0; k < kSteps; ++k) {
                Vec3 point;
                point[axis] = -1.0 + 2.0 * (k + 0.5) / kSteps;
                point[(axis + 1) % 3] = side % 2 == 0 ? -1.0 : 1.0;
                point[(axis + 2) % 3] = side / 2 == 0 ? -1.0 : 1.0;
                all += 1.0;
                gone += tree.nearest(point).distance > 0.01 ? 1.0 : 0.0;
            }
        }
    }
    return gone / all;
}

// Places on the sides of that cube, some of them beside its edges.
std::vector<PastePlacement> on_cube(double scale) {
    std::vector<PastePlacement> places;
    for (int side = 0; side < 6; ++side) {
        for (const double x : {0.93, -0.3}) {
            Vec3 point;
            point[side % 3] = side < 3 ? 1.0 : -1.0;
            point[(side + 1) % 3] = x;
            point[(side + 2) % 3] = -0.2 + 0.1 * side;
            places.push_back({.at = point, .scale = scale});
        }
    }
    return places;
}

}  // namespace

TEST_CASE(
    "scatter: parts on sharp edges of the target stand there, and the edges go on beyond them") {
    const Mesh horn = horned_ball(12);
    for (const Index segments : {1, 12}) {
        CAPTURE(segments);
        const Mesh cube = make_box({{2, 2, 2}, {segments, segments, segments}});
        REQUIRE(cube_edges_gone(cube) == 0.0);
        const auto places = on_cube(0.3);
        const ScatterResult result = scatter(horn, cube, around_horn(horn), std::nullopt, places);
        MESSAGE(result.verdict);
        CHECK(result.mesh.topology().is_closed());
        CHECK(cube_edges_gone(result.mesh) < 0.05);
        CHECK_FALSE(has_fault(result, MergeFault::bite));
        CHECK(result.placed >= 9);
        CHECK(result.placed + count_of(result.refused) == count_of(places));
        CHECK(result.placed == parts_in(result));
        // None is moved for those who want parts where they put them.
        ScatterOptions keep;
        keep.crossings = ScatterCrossings::keep;
        const ScatterResult kept =
            scatter(horn, cube, around_horn(horn), std::nullopt, places, keep);
        CHECK(kept.moved.empty());
        CHECK(kept.shrunk.empty());
        CHECK(cube_edges_gone(kept.mesh) < 0.05);
        CHECK(kept.placed == count_of(places));
    }
}

TEST_CASE("scatter: a verdict says what stands and what was left out, and why") {
    const Mesh horn = horned_ball(12), target = make_sphere({1.0, 40, SphereKind::triangles});
    const Region region = around_horn(horn);
    const ScatterResult good = scatter(horn, target, region, std::nullopt, spiral(6, 0.15));
    CHECK(good.ok);
    CHECK(good.reasons.empty());
    CHECK(good.placed == 6);
    CHECK(good.verdict.find("6 parts stand") != std::string::npos);
    auto places = spiral(6, 0.15);
    places[5] = places[4];
    const ScatterResult patchy = scatter(horn, target, region, std::nullopt, places);
    CHECK_FALSE(patchy.ok);
    REQUIRE(patchy.reasons.size() == 1);
    const MergeReason& reason = patchy.reasons.front();
    CHECK(reason.fault == MergeFault::left_out);
    CHECK(reason.value == doctest::Approx(1.0 / 6.0));
    CHECK(reason.limit == doctest::Approx(0.1));
    CHECK(!reason.remedy.empty());
    CHECK(patchy.verdict.find("is there already") != std::string::npos);
}

TEST_CASE("scatter: parts stand at all places, and the surface is closed") {
    const Mesh horn = horned_ball(12), target = make_sphere({1.0, 40, SphereKind::triangles});
    const auto places = spiral(24, 0.18);
    const ScatterResult result = scatter(horn, target, around_horn(horn), std::nullopt, places);
    for (const RefusedPlace& refused : result.refused) MESSAGE(refused.message);
    CHECK(result.refused.empty());
    CHECK(result.mesh.topology().is_closed());
    CHECK(result.mesh.topology().component_count() == 1);
    CHECK(genus(result.mesh.topology()) == 0);
    CHECK(count_of(result.place_of_face) == result.mesh.face_count());
    CHECK(parts_in(result) == 24);
    // Each part has its tip above its place.
    for (Index i = 0; i < 24; ++i) {
        double highest = 0.0;
        for (Index f = 0; f < result.mesh.face_count(); ++f) {
            if (result.place_of_face[at(f)] != i) continue;
            for (const Index v : result.mesh.topology().face(f)) {
                highest = std::max(highest, result.mesh.position(v).dot(places[at(i)].at));
            }
        }
        CHECK(highest > 1.08);
    }
}

TEST_CASE("scatter: parts of all sizes fit, on targets of all densities") {
    Mesh horn = make_sphere({1.0, 16, SphereKind::quads});
    for (Vec3& p : horn.edit_positions()) {
        if (p.y() > 0.0) p.y() += 0.8 * std::exp(-12.0 * (p.x() * p.x() + p.z() * p.z()));
    }
    for (const auto& target_kind :
         {std::pair(SphereKind::triangles, 24), std::pair(SphereKind::triangles, 80),
          std::pair(SphereKind::quads, 16), std::pair(SphereKind::quads, 24),
          std::pair(SphereKind::quads, 60)}) {
        const auto [kind, segments] = target_kind;
        const Mesh target = make_sphere({3.0, segments, kind});
        // Three sizes at a time, at a vertex, a pole and elsewhere; each size stands somewhere.
        for (int size = 0; size < 5; ++size) {
            const auto scale = [&](int place) { return 0.25 + 0.05 * ((size + 5 * place) % 13); };
            const double angle = 7.0 * scale(2);
            const std::vector<PastePlacement> places = {
                {.at = {3, 0, 0}, .scale = scale(0)},
                {.at = {0, 3, 0}, .scale = scale(1)},
                {.at = 3.0 * Vec3(std::cos(angle), -1.2, std::sin(angle)).normalized(),
                 .scale = scale(2)}};
            CAPTURE(target_kind.second);
            CAPTURE(size);
            const ScatterResult result =
                scatter(horn, target, around_horn(horn, 0.95), std::nullopt, places);
            for (const RefusedPlace& refused : result.refused) MESSAGE(refused.message);
            CHECK(result.refused.empty());
            CHECK(result.mesh.topology().is_closed());
        }
    }
}

TEST_CASE("scatter: where two meet the first stays, and the other is told") {
    const Mesh horn = horned_ball(12), target = make_sphere({1.0, 32, SphereKind::triangles});
    std::vector<PastePlacement> places = {{.at = {0, 1, 0}, .scale = 0.2},
                                          {.at = {0.02, 1, 0}, .scale = 0.2},
                                          {.at = {1, 0, 0}, .scale = 0.2}};
    const ScatterResult result = scatter(horn, target, around_horn(horn), std::nullopt, places);
    REQUIRE(result.refused.size() == 1);
    CHECK(result.refused[0].place == 1);
    CHECK(result.refused[0].code == ErrorCode::boundary_conflict);
    CHECK(result.refused[0].message.find("place 1") != std::string::npos);
    CHECK(parts_in(result) == 2);
    CHECK(result.mesh.topology().is_closed());
    // A part that is larger than its target fits nowhere.
    places = {{.at = {0, 1, 0}, .scale = 30.0}};
    const ScatterResult none = scatter(horn, target, around_horn(horn), std::nullopt, places);
    CHECK(none.refused.size() == 1);
    CHECK(none.rounds == 0);
    CHECK(hash(none.mesh) == hash(target));
}

TEST_CASE("scatter: more places do not change what was there, far vertices stay to the bit") {
    const Mesh horn = horned_ball(12);
    Mesh target = make_sphere({1.0, 32, SphereKind::triangles});
    Attribute mark{"mark", Domain::vertex, 1, ScalarType::float64, {}};
    for (Index v = 0; v < target.vertex_count(); ++v) mark.values.push_back(v);
    target.attributes().add(std::move(mark));
    auto places = spiral(12, 0.15);
    const Region region = around_horn(horn);
    const ScatterResult few =
        scatter(horn, target, region, std::nullopt, std::span(places).first(6));
    const ScatterResult many = scatter(horn, target, region, std::nullopt, places);
    CHECK(few.refused.empty());
    CHECK(many.refused.empty());
    for (const ScatterResult* result : {&few, &many}) {
        std::vector<char> found(at(target.vertex_count()), 0);
        for (Index v = 0; v < result->mesh.vertex_count(); ++v) {
            const double from = result->mesh.attributes().find("mark")->at(v)[0];
            if (!std::isfinite(from) || from != std::floor(from)) continue;
            const Index old = static_cast<Index>(from);
            if (result->mesh.position(v) == target.position(old)) found[at(old)] = 1;
        }
        Index far = 0, kept = 0;
        for (Index v = 0; v < target.vertex_count(); ++v) {
            const bool is_far = std::all_of(places.begin(), places.end(), [&](const auto& place) {
                return (target.position(v) - place.at).norm() > 0.35;
            });
            far += is_far;
            kept += is_far && found[at(v)];
        }
        CHECK(far > 50);
        CHECK(kept == far);
    }
    const auto tips = [&](const ScatterResult& result, Index place) {
        std::vector<double> values;
        for (Index f = 0; f < result.mesh.face_count(); ++f) {
            if (result.place_of_face[at(f)] != place) continue;
            for (const Index v : result.mesh.topology().face(f)) {
                values.push_back(result.mesh.position(v).x());
            }
        }
        return values;
    };
    CHECK(tips(few, 0) == tips(many, 0));
}

TEST_CASE("scatter: a place whose paste fails is refused with the reason, and the others stand") {
    const Mesh horn = horned_ball(12), target = make_sphere({1.0, 24, SphereKind::triangles});
    auto places = spiral(3, 0.18);
    places[1].up = Vec3::Zero();
    const ScatterResult result = scatter(horn, target, around_horn(horn), std::nullopt, places);
    REQUIRE(result.refused.size() == 1);
    CHECK(result.refused[0].place == 1);
    CHECK(result.refused[0].code == ErrorCode::invalid_argument);
    CHECK(!result.refused[0].message.empty());
    CHECK(parts_in(result) == 2);
    CHECK(result.mesh.topology().is_closed());
}

TEST_CASE("scatter: a cancel at any moment ends it, and refuses no place") {
    const Mesh horn = horned_ball(12), target = make_sphere({1.0, 24, SphereKind::triangles});
    const auto places = spiral(2, 0.18);
    const auto pasted = [&](const Context& context) {
        return scatter(horn, target, around_horn(horn), std::nullopt, places, {}, context);
    };
    const Interrupter whole(-1);
    CHECK(pasted(whole.context()).refused.empty());
    REQUIRE(whole.moments() > 10);
    for (int part = 0; part < 4; ++part) {
        const Interrupter host(part * (whole.moments() - 1) / 3);
        CHECK(error_of([&] { pasted(host.context()); }).code() == ErrorCode::cancelled);
    }
}

TEST_CASE("scatter: options and places that make no sense are refused") {
    const Mesh horn = horned_ball(12), target = make_sphere({1.0, 16, SphereKind::triangles});
    const Region region = around_horn(horn);
    const auto code = [&](std::vector<PastePlacement> places, ScatterOptions options) {
        return error_of([&] { scatter(horn, target, region, std::nullopt, places, options); })
            .code();
    };
    std::vector<PastePlacement> places(1);
    places[0].scale = 0.0;
    CHECK(code(places, {}) == ErrorCode::invalid_argument);
    places[0] = {};
    places[0].at.x() = NAN;
    CHECK(code(places, {}) == ErrorCode::not_finite);
    ScatterOptions clears;
    clears.paste.clear = true;
    CHECK(code({}, clears) == ErrorCode::invalid_argument);
    CHECK(error_of([&] { scatter(horn, Mesh(), region, std::nullopt, {}); }).code() ==
          ErrorCode::mesh_empty);
    CHECK(hash(scatter(horn, target, region, std::nullopt, {}).mesh) == hash(target));
}
