// Pastes on and beside sharp edges, at corners and beside borders of generated shapes.
#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "kernel/merge/paste/paste.h"
#include "kernel/mesh/edit/triangulate.h"
#include "kernel/mesh/query/spatial_tree.h"
#include "tests/unit/merge/paste/paste_shapes.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

Mesh cube_of(Index segments) {
    return make_box({{2, 2, 2}, {segments, segments, segments}});
}

// A sheet with a steep round bump in its middle, which looks along y.
Mesh bump_on_sheet() {
    Mesh mesh = make_grid({.size = {2, 2}, .segments = {28, 28}});
    for (Vec3& p : mesh.edit_positions()) {
        const double r = std::hypot(p.x(), p.z()) / 0.55;
        p.y() = r < 1.0 ? 0.7 * std::sqrt(1.0 - r * r) : 0.0;
    }
    return mesh;
}

struct PastedOnCube {
    PasteResult result;
    Vec3 middle = Vec3::Zero();
    double radius = 0.0;
};

PastedOnCube pasted(const Mesh& part, const Region& region, const Mesh& cube, const Vec3& at,
                    const Vec3& up, double scale) {
    Paste paste(part, cube, region, std::nullopt, std::nullopt,
                {.at = at, .up = up, .angle = 0.0, .scale = scale});
    paste.optimize();
    PastedOnCube made{paste.merge({.find_intersections = true}), {}, 0.0};
    const Mesh& mesh = made.result.merged.mesh;
    const std::vector<Index>& seam = made.result.merged.seams[0];
    for (const Index v : seam) made.middle += mesh.position(v) / static_cast<double>(seam.size());
    for (const Index v : seam) {
        made.radius = std::max(made.radius, (mesh.position(v) - made.middle).norm());
    }
    return made;
}

// How far points of the edges of the cube from -1 to 1 that lie beyond a ball are from a mesh, at
// most.
double edges_off(const Mesh& mesh, const Vec3& middle, double radius) {
    const SpatialTree tree(mesh);
    constexpr int kSteps = 100;
    double off = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        for (int side = 0; side < 4; ++side) {
            for (int k = 0; k <= kSteps; ++k) {
                Vec3 point;
                point[axis] = -1.0 + 2.0 * k / kSteps;
                point[(axis + 1) % 3] = side % 2 == 0 ? -1.0 : 1.0;
                point[(axis + 2) % 3] = side / 2 == 0 ? -1.0 : 1.0;
                if ((point - middle).norm() < radius) continue;
                off = std::max(off, tree.nearest(point).distance);
            }
        }
    }
    return off;
}

bool tells(const MergeReport& report, MergeFault fault) {
    return std::any_of(report.reasons.begin(), report.reasons.end(),
                       [&](const MergeReason& reason) { return reason.fault == fault; });
}

// How far points lie from the surface of the cube from -1 to 1, at most.
double off_cube(std::span<const Vec3> points) {
    double off = 0.0;
    for (const Vec3& p : points) {
        off = std::max(off, std::abs(p.cwiseAbs().maxCoeff() - 1.0));
    }
    return off;
}

std::vector<Vec3> seam_points(const PasteResult& result) {
    std::vector<Vec3> points;
    for (const Index v : result.merged.seams[0]) {
        points.push_back(result.merged.mesh.position(v));
    }
    return points;
}

// How far the vertices of a mesh lie above the cube, at most.
double height_over_cube(const Mesh& mesh) {
    double height = 0.0;
    for (const Vec3& p : mesh.positions()) {
        const Vec3 beyond = (p.cwiseAbs() - Vec3::Ones()).cwiseMax(0.0);
        height = std::max(height, beyond.norm());
    }
    return height;
}

// The bump alone.
Region bump_of(const Mesh& sheet) {
    return select_sphere(sheet, Vec3::Zero(), 0.72);
}

const Vec3 kOnCube[] = {{1, 1, 0.1}, {1, 0.8, 0}, {1, 0.9, 0.3}, {0.4, 1, 1}};

}  // namespace

TEST_CASE("paste: edges of a box stay beyond a part that stands on them, and it bites none") {
    const Mesh bump = bump_on_sheet();
    const Region region = select_sphere(bump, Vec3::Zero(), 0.92);
    for (const Index segments : {1, 12}) {
        for (const Vec3& at : kOnCube) {
            CAPTURE(segments);
            CAPTURE(at.transpose());
            const auto made = pasted(bump, region, cube_of(segments), at, Vec3::UnitZ(), 0.35);
            const MergeReport& report = made.result.merged.report;
            CHECK(made.result.merged.mesh.topology().is_closed());
            const Mesh& mesh = made.result.merged.mesh;
            CHECK(edges_off(mesh, made.middle, 1.02 * made.radius) < 0.02 * made.radius);
            CHECK(edges_off(mesh, made.middle, 2.0 * made.radius) < 1e-6);
            CHECK_FALSE(tells(report, MergeFault::bite));
            CHECK(report.intersections.empty());
        }
    }
}

TEST_CASE("paste: a part on an edge or a corner of a box keeps its shape and stands on all sides") {
    const Mesh bump = bump_on_sheet();
    const Region region = select_sphere(bump, Vec3::Zero(), 0.92);
    const Vec3 places[] = {{1, 1, 0},      {1, 0.97, 0.4}, {0.93, 1, 0.3},  {0.3, 1, 1},
                           {1, 0.3, 0.98}, {1, 1, 1},      {0.95, 0.97, 1}, {1, 1, 0.9}};
    for (const Index segments : {1, 12}) {
        const Mesh cube = cube_of(segments);
        for (const Vec3& at : places) {
            CAPTURE(segments);
            CAPTURE(at.transpose());
            Paste paste(bump, cube, region, bump_of(bump), std::nullopt,
                        {.at = at, .up = Vec3::UnitZ(), .angle = 0.0, .scale = 0.35});
            paste.optimize();
            const PasteResult made = paste.merge();
            CHECK(made.report.draped);
            CHECK(made.merged.mesh.topology().is_closed());
            // The seam lies beside the wall of the bump, into which smoothing draws it a little.
            CHECK(off_cube(seam_points(made)) < 0.03 * 0.35);
            CHECK(height_over_cube(made.merged.mesh) > 0.75 * 0.35 * 0.7);
            CHECK_FALSE(tells(made.merged.report, MergeFault::bite));
            CHECK_FALSE(tells(made.merged.report, MergeFault::crossings));
            CHECK_FALSE(tells(made.merged.report, MergeFault::folds));
        }
    }
}

TEST_CASE("paste: edges under the flat surface around a part stay, as far as it lies beside them") {
    const Mesh bump = bump_on_sheet();
    const Region region = select_sphere(bump, Vec3::Zero(), 0.92);
    constexpr double kScale = 0.45, kFootRadius = 0.55 * kScale;
    for (const Mesh& cube : {cube_of(1), cube_of(9), make_box({{2, 2, 2}, {7, 2, 1}})}) {
        for (const double beside : {0.05, 0.1, 0.15}) {
            CAPTURE(cube.face_count());
            CAPTURE(beside);
            Paste paste(bump, cube, region, bump_of(bump), std::nullopt,
                        {.at = {1.0 - kFootRadius - beside, 1.2, 0.15},
                         .up = Vec3::UnitZ(),
                         .scale = kScale});
            paste.optimize();
            const PasteResult made = paste.merge({.find_intersections = true});
            // The foot is a face wider than the bump, and the seam is smoothed a face beyond that.
            const double limit = beside < 0.1 ? 0.04 * kScale : 1e-6;
            CHECK(edges_off(made.merged.mesh, Vec3::Zero(), 0.0) < limit);
            CHECK(made.merged.report.ok);
            CHECK(height_over_cube(made.merged.mesh) > 0.9 * 0.7 * kScale);
        }
    }
}

TEST_CASE("paste: on edges, a part that was moved is that of a paste that begins there") {
    const Mesh bump = bump_on_sheet(), cube = cube_of(9);
    const Region region = select_sphere(bump, Vec3::Zero(), 0.92);
    const auto at = [](double x, double scale) {
        return PastePlacement{
            .at = {x, 1.2, 0.15}, .up = Vec3::UnitZ(), .angle = 0.0, .scale = scale};
    };
    Paste used(bump, cube, region, bump_of(bump), std::nullopt, at(0.95, 0.45));
    used.merge({.draft = true});
    used.move(at(0.8, 0.3));
    used.merge({.draft = true});
    used.move(at(0.9, 0.4));
    Paste fresh(bump, cube, region, bump_of(bump), std::nullopt, at(0.9, 0.4));
    CHECK(hash(used.merge().merged.mesh) == hash(fresh.merge().merged.mesh));
}

TEST_CASE("paste: a drag across an edge and a corner of a box refuses no frame") {
    const Mesh bump = bump_on_sheet(), cube = cube_of(4);
    const Region region = select_sphere(bump, Vec3::Zero(), 0.92);
    const auto at = [](int frame) {
        const double t = frame / 29.0;
        return Vec3(std::min(1.0, 1.5 - t), std::min(1.0, 0.5 + t), 0.9 * t);
    };
    Paste paste(bump, cube, region, bump_of(bump), std::nullopt,
                {.at = at(0), .up = Vec3::UnitZ(), .scale = 0.3});
    paste.optimize();
    int on_edges = 0;
    for (int frame = 0; frame < 30; ++frame) {
        CAPTURE(frame);
        paste.slide({.at = at(frame), .up = Vec3::UnitZ(), .scale = 0.3});
        const PasteDraft draft = paste.draft();
        std::vector<Vec3> rim;
        for (const Index v : draft.rim) rim.push_back(draft.part.position(v));
        CHECK(off_cube(rim) < 5e-3);
        if (frame % 3 != 0) continue;
        const PasteResult made = paste.merge();
        CHECK_FALSE(tells(made.merged.report, MergeFault::bite));
        CHECK_FALSE(tells(made.merged.report, MergeFault::crossings));
        if (made.report.draped) ++on_edges;
    }
    CHECK(on_edges >= 4);
}

TEST_CASE("paste: a part is as large as was asked for, however near edges and corners are") {
    const Mesh bump = bump_on_sheet(), horn = horned_ball(16);
    const Mesh cube = cube_of(12);
    for (const double scale : {0.2, 0.35}) {
        for (const Vec3& at : {Vec3(1, 0, 0), Vec3(1, 0.8, 0), Vec3(1, 1, 0), Vec3(1, 1, 1)}) {
            CAPTURE(scale);
            CAPTURE(at.transpose());
            const auto flat = pasted(bump, select_sphere(bump, Vec3::Zero(), 0.92), cube, at,
                                     Vec3::UnitZ(), scale);
            CHECK(flat.result.report.scale == doctest::Approx(scale).epsilon(0.2));
            const auto round = pasted(horn, around_horn(horn), cube, at, Vec3::UnitZ(), scale);
            CHECK(round.result.report.scale == doctest::Approx(scale).epsilon(0.35));
        }
    }
}

TEST_CASE("paste: where there is no room the error names the place and a way out") {
    const Mesh bump = bump_on_sheet();
    const Region region = select_sphere(bump, Vec3::Zero(), 0.92);
    const Mesh ball = make_sphere({1.0, 24, SphereKind::triangles});
    const Mesh sheet = make_grid({.size = {2, 2}, .segments = {20, 20}});
    const auto refused = [&](const Mesh& target, const PastePlacement& placement) {
        try {
            const Paste paste(bump, target, region, std::nullopt, std::nullopt, placement);
        } catch (const Error& error) {
            CHECK(error.code() == ErrorCode::boundary_conflict);
            CHECK(error.elements().kind == ElementKind::face);
            CHECK(error.elements().count == 1);
            return std::string(error.what());
        }
        return std::string();
    };
    for (const std::string& message : {refused(ball, {.at = {1, 0, 0}, .scale = 30.0}),
                                       refused(sheet, {.at = {1, 0, 0}, .scale = 0.3}),
                                       refused(sheet, {.at = {0.95, 0, 0}, .scale = 0.3})}) {
        CAPTURE(message);
        CHECK(message.find("no room for the part") != std::string::npos);
        CHECK(message.find("smaller") != std::string::npos);
        CHECK(message.find("region") == std::string::npos);
    }
    CHECK(refused(sheet, {.at = {0.5, 0, 0}, .scale = 0.3}).empty());
}

TEST_CASE("paste: all frames of a drag over coarse, sharp and smooth targets are made") {
    const Mesh bump = bump_on_sheet();
    const Region region = select_sphere(bump, Vec3::Zero(), 0.92);
    const Mesh targets[] = {cube_of(1), cube_of(5), make_sphere({1.2, 8, SphereKind::triangles}),
                            make_sphere({1.2, 12, SphereKind::quads}),
                            make_sphere({1.2, 30, SphereKind::triangles})};
    for (const Mesh& target : targets) {
        CAPTURE(target.face_count());
        const auto at = [](int frame) {
            const double a = 0.05 * frame;
            return Vec3(1.5 * std::cos(a), 1.5 * std::sin(a), 0.3 + 0.02 * frame);
        };
        Paste paste(bump, target, region, std::nullopt, std::nullopt,
                    {.at = at(0), .up = Vec3::UnitZ(), .scale = 0.25});
        paste.optimize();
        for (int frame = 0; frame < 30; ++frame) {
            CAPTURE(frame);
            paste.slide({.at = at(frame), .up = Vec3::UnitZ(), .scale = 0.25});
            const PasteDraft draft = paste.draft();
            CHECK(draft.scale == doctest::Approx(0.25).epsilon(0.25));
            CHECK(draft.part.topology().boundary_loops().size() == 1);
        }
    }
}

namespace {

// A cone on level ground, with a sharp foot.
Mesh cone_on_ground(double foot) {
    Mesh ground = make_grid({.size = {4, 4}, .segments = {30, 30}});
    triangulate(ground);
    for (Vec3& p : ground.edit_positions()) {
        p.y() = std::max(0.0, 1.2 * (foot - std::hypot(p.x(), p.z())));
    }
    return ground;
}

}  // namespace

TEST_CASE("paste: edges of a feature that is cleared end at the part, which does not bite them") {
    const Mesh horn = horned_ball(12);
    for (const double foot : {0.25, 0.3, 0.35, 0.4, 0.5}) {
        CAPTURE(foot);
        PasteOptions options;
        options.clear = true;
        Paste paste(horn, cone_on_ground(foot), around_horn(horn), std::nullopt, std::nullopt,
                    {.at = {0, 1, 0}, .scale = 0.6}, options);
        paste.optimize();
        const PasteResult result = paste.merge();
        REQUIRE(result.report.clearing);
        CHECK(result.merged.report.bite.length < 0.1);
        CHECK(result.merged.report.ok);
    }
}
