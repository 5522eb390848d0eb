// Drags of a part over coarse, low-poly and technical shapes: every frame is made, watertight and
// without faces that turn over.
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "kernel/merge/loop/face_angles.h"
#include "kernel/merge/paste/paste.h"
#include "kernel/mesh/query/region_select.h"
#include "kernel/mesh/query/spatial_tree.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

constexpr int kDragFrames = 30, kFramesToMerge = 6;
// A face that turned over meets a neighbour at nearly half a turn; corners of the shapes turn by 90
// degrees, and their tips by 120.
constexpr double kTurnedOver = 150.0 * kDegree;

// A sheet with a low round bump, which looks along y.
Mesh dragged_part() {
    Mesh mesh = make_grid({.size = {2, 2}, .segments = {16, 16}});
    for (Vec3& p : mesh.edit_positions()) {
        const double r = std::hypot(p.x(), p.z()) / 0.6;
        p.y() = r < 1.0 ? 0.6 * std::pow(1.0 - r * r, 1.5) : 0.0;
    }
    return mesh;
}

// Steps that rise along x from -1 to 1, as high as deep, and 2 wide; polygons.
Mesh stairs(Index count) {
    std::vector<Vec2> outline{{1.0, -0.5}, {-1.0, -0.5}};
    const double step = 2.0 / count;
    for (Index k = 0; k < count; ++k) {
        outline.emplace_back(-1.0 + k * step, -0.5 + (k + 1) * step);
        outline.emplace_back(-1.0 + (k + 1) * step, -0.5 + (k + 1) * step);
    }
    const Index n = count_of(outline);
    std::vector<Vec3> positions;
    for (const double z : {1.0, -1.0}) {
        for (const Vec2& p : outline) positions.emplace_back(p.x(), p.y(), z);
    }
    FaceList faces;
    std::vector<Index> front, back;
    for (Index k = 0; k < n; ++k) {
        const Index next = (k + 1) % n;
        faces.add({k, next, n + next, n + k});
        front.push_back(n - 1 - k);
        back.push_back(n + k);
    }
    faces.add(front);
    faces.add(back);
    return Mesh(std::move(positions), std::move(faces));
}

struct Drag {
    std::string name;
    Mesh target;
    // The point that the part is drawn to, from 0 to 1.
    std::function<Vec3(double)> at;
    double scale = 0.3;
};

std::vector<Drag> drags() {
    std::vector<Drag> all;
    const auto across_box = [](double t) { return Vec3(2.0 * t - 0.4, 1.2, 0.9 - 0.8 * t); };
    all.push_back({"box of one face a side", make_box({{2, 2, 2}, {1, 1, 1}}), across_box});
    all.push_back({"box of uneven faces", make_box({{2, 2, 2}, {7, 2, 1}}), across_box});
    const auto over_corner = [](double t) { return Vec3(1.4 - t, 0.6 + t, 0.4 + 1.2 * t); };
    all.push_back({"corner of a box", make_box({{2, 2, 2}, {2, 2, 2}}), over_corner});
    const auto up_stairs = [](double t) { return Vec3(1.6 * t - 0.8, 1.6 * t + 0.3, 0.3 * t); };
    all.push_back({"stairs of four steps", stairs(4), up_stairs});
    const auto around = [](double t) {
        return Vec3(1.5 * std::cos(3.0 * t), 0.8 * t - 0.4, 1.5 * std::sin(3.0 * t));
    };
    const CylinderOptions six_sides{
        .radius = 1.0, .height = 2.0, .segments = 6, .rings = 1, .cap_rings = 1};
    all.push_back({"column of six sides", make_cylinder(six_sides), around});
    const auto over_rim = [](double t) { return Vec3(0.3 + t, 1.7 - 1.2 * t, 0.2); };
    all.push_back(
        {"rim of a cylinder",
         make_cylinder({.radius = 1.0, .height = 2.0, .segments = 12, .rings = 1, .cap_rings = 1}),
         over_rim});
    all.push_back({"low-poly ball", make_sphere({1.2, 2, SphereKind::triangles}), around});
    return all;
}

// The greatest angle between neighbouring faces: near half a turn where one has turned over.
double greatest_turn(const Mesh& mesh) {
    GreatestAngle angle;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const auto face = mesh.topology().face(f);
        for (std::size_t k = 0; k < face.size(); ++k) {
            add_edge_dihedral(mesh, face[k], face[(k + 1) % face.size()], angle);
        }
    }
    return angle.value();
}

bool is_told(const MergeReport& report, MergeFault fault) {
    return std::any_of(report.reasons.begin(), report.reasons.end(),
                       [&](const MergeReason& reason) { return reason.fault == fault; });
}

void check_frame(const PasteResult& made, double scale) {
    const Mesh& mesh = made.merged.mesh;
    CHECK(mesh.topology().is_closed());
    CHECK(made.report.euler_characteristic == made.report.expected_characteristic);
    CHECK(made.report.scale == doctest::Approx(scale).epsilon(0.3));
}

}  // namespace

TEST_CASE("paste: drags over coarse and technical shapes refuse no frame and turn no face over") {
    const Mesh part = dragged_part();
    const Region region = select_sphere(part, Vec3::Zero(), 0.92);
    const Region feature = select_sphere(part, Vec3::Zero(), 0.7);
    for (const Drag& drag : drags()) {
        CAPTURE(drag.name);
        REQUIRE(drag.target.topology().is_closed());
        const auto place = [&](int frame) {
            return PastePlacement{.at = drag.at(frame / (kDragFrames - 1.0)),
                                  .up = Vec3::UnitZ(),
                                  .scale = drag.scale};
        };
        Paste paste(part, drag.target, region, feature, std::nullopt, place(0));
        paste.optimize();
        for (int frame = 0; frame < kDragFrames; ++frame) {
            CAPTURE(frame);
            paste.slide(place(frame));
            const PasteResult draft = paste.merge({.draft = true});
            check_frame(draft, drag.scale);
            CHECK(greatest_turn(draft.merged.mesh) < kTurnedOver);
            if (frame % kFramesToMerge != 0) continue;
            const PasteResult made = paste.merge();
            check_frame(made, drag.scale);
            CHECK(greatest_turn(made.merged.mesh) < kTurnedOver);
            CHECK_FALSE(is_told(made.merged.report, MergeFault::crossings));
        }
    }
}
