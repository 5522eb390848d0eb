#include "kernel/thesis/transition/thesis_merge.h"

#include <map>

#include "kernel/merge/merge.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/thesis/fidelity.h"
#include "tests/unit/merge/blend/fairing_scenes.h"
#include "tests/unit/merge/real_pairs.h"
#include "tests/unit/merge/sew/seam_scenes.h"
#include "tests/unit/mesh/mesh_support.h"
#include "tests/unit/mesh/morph_support.h"

using namespace lissom;
using doctest::Approx;

namespace {

constexpr double kWidth = 0.99;

// A plain tube below and one above with bumps of the given height, which meets it at its radius.
struct Tubes {
    explicit Tubes(double bump, double scale = 1.0)
        : target(test::make_tube(32, -2.0, 2.0, 1.0, 16)),
          source(test::make_tube(32, 0.0, 2.0, 1.0, 16)) {
        for (Vec3& p : source.edit_positions()) {
            const double angle = std::atan2(p.z(), p.x());
            const double r = 1.0 + bump * std::sin(3.0 * angle) * std::sin(3.0 * p.y());
            p.x() *= r;
            p.z() *= r;
        }
        join = {boundaries(source)[test::boundary_towards(source, -1.0)],
                boundaries(target)[test::boundary_towards(target, 1.0)]};
        join.keys = {{test::farthest(source, join.source, Vec3::UnitX()),
                      test::farthest(target, join.target, Vec3::UnitX())}};
        options.thesis = &thesis_formulas();
        options.smooth = 0;
        options.target_transition = kWidth;
        options.source_transition = kWidth * scale;
        // The source where a similarity takes it.
        const Affine turn = rotation(Vec3(2.0, 1.0, 3.0).normalized(), 2.4, Vec3::Zero());
        for (Vec3& p : source.edit_positions()) {
            if (scale != 1.0) p = scale * (turn(p) + Vec3(3.0, -2.0, 7.0));
        }
    }

    MergeResult merged() const {
        const Mesh* targets[] = {&target};
        return Merger(source, targets, {join}, options).solve();
    }

    Mesh target, source;
    Join join{boundaries(target)[0], boundaries(target)[0]};
    MergeOptions options;
};

// RMS deviation of the radius within rows of the tubes, of rows between two heights.
double roughness(const Tubes& tubes, const MergeResult& result, double low, double high) {
    std::map<long, std::vector<double>> rows;
    for (Index v = 0; v < result.mesh.vertex_count(); ++v) {
        const Index from = result.provenance.vertices.main_source(v);
        const Index own = from - tubes.target.vertex_count();
        const double y = (own < 0 ? tubes.target.position(from) : tubes.source.position(own)).y();
        if (y < low || y > high) continue;
        const Vec3& p = result.mesh.position(v);
        rows[std::lround(16.0 * y)].push_back(std::hypot(p.x(), p.z()));
    }
    double sum = 0.0;
    for (const auto& row : rows) {
        const std::vector<double>& radii = row.second;
        double mean = 0.0, square = 0.0;
        for (const double r : radii) mean += r / static_cast<double>(radii.size());
        for (const double r : radii) square += (r - mean) * (r - mean);
        sum += square / static_cast<double>(radii.size() * rows.size());
    }
    return std::sqrt(sum);
}

}  // namespace

TEST_CASE("two tubes that are one tube stay as they are") {
    const MergeResult result = Tubes(0.0).merged();
    for (const auto& side : {result.report.transition.target, result.report.transition.source}) {
        CHECK(side[0].width == Approx(kWidth));
        CHECK(side[0].vertices == 7 * 32);
        CHECK(side[0].unmapped == 0);
        CHECK(side[0].flipped == 0);
    }
    double highest = -1.0;
    for (const Vec3& p : result.mesh.positions()) {
        CHECK(std::hypot(p.x(), p.z()) == Approx(1.0).epsilon(1e-6));
        highest = std::max(highest, p.y());
    }
    // The source begins where the target's region ends.
    CHECK(highest == Approx(2.0 - 0.875).epsilon(1e-6));
}

TEST_CASE("regions overlap: the source's is kept, and its details fade into the target's") {
    Tubes tubes(0.1);
    const MergeResult result = tubes.merged();
    tubes.options.source_transition = tubes.options.target_transition = 0.0;
    const MergeResult without = tubes.merged();
    CHECK(result.mesh.topology().boundary_loops().size() == 2);
    CHECK(result.mesh.topology().component_count() == 1);
    CHECK(result.mesh.face_count() == without.mesh.face_count() - 7 * 32);
    CHECK(result.report.transition.moved.size() == 7 * 32);
    // The plain surface at the seam, ever more of the bumps towards the region's other end.
    double last = 0.0;
    for (const double y : {0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875}) {
        const double share = roughness(tubes, result, y - 0.05, y + 0.05) /
                             roughness(tubes, without, y - 0.05, y + 0.05);
        CAPTURE(y);
        CHECK(share > last - 0.02);
        last = share;
    }
    CHECK(roughness(tubes, result, 0.05, 0.2) < 0.6 * roughness(tubes, without, 0.05, 0.2));
    CHECK(last > 0.7);
    // The target stays to the bit.
    Index kept = 0;
    for (Index v = 0; v < result.mesh.vertex_count(); ++v) {
        const Index from = result.provenance.vertices.main_source(v);
        if (from >= tubes.target.vertex_count()) continue;
        CHECK(tubes.target.position(from).y() < -0.87);
        if (tubes.target.position(from).y() > -0.9) continue;
        CHECK(result.mesh.position(v) == tubes.target.position(from));
        ++kept;
    }
    CHECK(kept == 9 * 32);
}

TEST_CASE("what a morph target adds fades over the regions as the positions do") {
    // Plain tubes; the source's target adds bumps, the target's adds nothing.
    Tubes tubes(0.0);
    const Tubes bumpy(0.1);
    const auto add_morph = [](Mesh& mesh, const Mesh& moved) {
        Attribute morph{"morph.1.position", Domain::vertex, 3, ScalarType::float64, {}};
        for (Index v = 0; v < mesh.vertex_count(); ++v) {
            const Vec3 d = moved.position(v) - mesh.position(v);
            morph.values.insert(morph.values.end(), {d.x(), d.y(), d.z()});
        }
        mesh.attributes().add(std::move(morph));
    };
    add_morph(tubes.source, bumpy.source);
    add_morph(tubes.target, tubes.target);
    MergeResult faded = tubes.merged();
    tubes.options.source_transition = tubes.options.target_transition = 0.0;
    MergeResult whole = tubes.merged();
    for (MergeResult* result : {&faded, &whole})
        result->mesh = test::moved_by_target(result->mesh, 1);
    double last = 0.0;
    for (const double y : {0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875}) {
        const double share = roughness(tubes, faded, y - 0.05, y + 0.05) /
                             roughness(tubes, whole, y - 0.05, y + 0.05);
        CAPTURE(y);
        CHECK(share > last - 0.02);
        last = share;
    }
    CHECK(roughness(tubes, faded, 0.05, 0.2) < 0.6 * roughness(tubes, whole, 0.05, 0.2));
    CHECK(last > 0.7);
}

TEST_CASE("keys on the target's boundary go to the far end along the cut, whatever they are") {
    Tubes tubes(0.1);
    const Mesh plain = tubes.merged().mesh;
    const KeyPair given = tubes.join.keys[0];
    const Vec3 place = tubes.target.position(std::get<Index>(given.target));
    tubes.join.keys = {{given.source, place}};
    CHECK(test::max_move(tubes.merged().mesh, plain) < 1e-9);
    // A quarter of a turn on turns the source.
    const Index quarter = test::farthest(tubes.target, tubes.join.target, Vec3::UnitZ());
    tubes.join.keys = {{given.source, quarter}};
    const MergeResult turned = tubes.merged();
    const Index first = tubes.target.vertex_count() + std::get<Index>(given.source);
    for (Index v = 0; v < turned.mesh.vertex_count(); ++v) {
        for (const auto& from : turned.provenance.vertices[v]) {
            if (from.element != first) continue;
            CHECK((turned.mesh.position(v) - Vec3(0.0, -0.875, 1.0)).norm() < 1e-6);
        }
    }
}

TEST_CASE("the weight counts") {
    Tubes tubes(0.1);
    tubes.options.transition_weight = 0.0;
    const Mesh none = tubes.merged().mesh;
    double last = 1e-3;
    for (const double weight : {0.1, 10.0}) {
        tubes.options.transition_weight = weight;
        const double move = test::max_move(tubes.merged().mesh, none);
        CHECK(move > last);
        last = move;
    }
}

TEST_CASE("the result does not depend on where the source lies and how large it is") {
    const Mesh plain = Tubes(0.1).merged().mesh;
    for (const double scale : {0.01, 50.0}) {
        CHECK(test::max_move(Tubes(0.1, scale).merged().mesh, plain) < 1e-8);
    }
}

TEST_CASE("a target that is moved takes the result with it") {
    const Mesh plain = Tubes(0.1).merged().mesh;
    Tubes tubes(0.1);
    const Affine map{rotation(Vec3::UnitZ(), 0.7, Vec3::Zero()).linear, Vec3(5.0, 6.0, -7.0)};
    for (Vec3& p : tubes.target.edit_positions()) p = map(p);
    CHECK(test::max_move(tubes.merged().mesh, test::moved(plain, map)) < 1e-8);
}

TEST_CASE("in the fixed configuration what is held stays") {
    Tubes tubes(0.1);
    tubes.options.configuration = Configuration::fixed;
    tubes.options.reach = 1.3;
    const MergeResult result = tubes.merged();
    Index held = 0;
    for (Index v = 0; v < result.mesh.vertex_count(); ++v) {
        const Index from = result.provenance.vertices.main_source(v) - tubes.target.vertex_count();
        if (from < 0 || tubes.source.position(from).y() < 1.6) continue;
        CHECK(result.mesh.position(v) == tubes.source.position(from));
        ++held;
    }
    CHECK(held == 4 * 32);
    CHECK(roughness(tubes, result, 0.3, 0.9) > 1e-3);
}

TEST_CASE("a source between two targets has a region at either end, and they must not meet") {
    const Tubes below(0.1);
    Mesh above = below.target;
    for (Vec3& p : above.edit_positions()) p.y() += 5.0;
    const auto end = [](const Mesh& mesh, double sign) {
        return boundaries(mesh)[test::boundary_towards(mesh, sign)];
    };
    Join top{end(below.source, 1.0), end(above, -1.0), 1};
    top.keys = {{test::farthest(below.source, top.source, Vec3::UnitX()),
                 test::farthest(above, top.target, Vec3::UnitX())}};
    const Mesh* targets[] = {&below.target, &above};
    const auto merged = [&](double width) {
        MergeOptions options = below.options;
        options.source_transition = width;
        return Merger(below.source, targets, {below.join, top}, options).solve();
    };
    const MergeResult result = merged(0.9);
    CHECK(result.mesh.topology().component_count() == 1);
    CHECK(result.report.transition.source[1].vertices == 7 * 32);
    CHECK(result.report.transition.target[1].vertices == 7 * 32);
    for (const Vec3& p : result.mesh.positions()) CHECK(p.head<1>().norm() < 1.5);
    CHECK(test::error_of([&] { merged(1.3); }).code() == ErrorCode::invalid_argument);
}

TEST_CASE("it is another transition than the robust one, and needs regions that are bands") {
    Tubes tubes(0.1);
    const Index thesis = tubes.merged().mesh.face_count();
    tubes.options.thesis = nullptr;
    CHECK(tubes.merged().mesh.face_count() > thesis);
    tubes.options.thesis = &thesis_formulas();
    const auto refuses = [&](double source, double target) {
        tubes.options.source_transition = source;
        tubes.options.target_transition = target;
        return test::error_of([&] { tubes.merged(); }).code() == ErrorCode::invalid_argument;
    };
    CHECK(refuses(0.0, kWidth));
    CHECK(refuses(kWidth, 0.0));
    CHECK(refuses(0.01, kWidth));
    tubes.options.transition_weight = -1.0;
    CHECK(refuses(kWidth, kWidth));
}

TEST_CASE(
    "real pairs: the thesis's transition hides the seam, and every vertex has a counterpart") {
    Index pairs = 0;
    for (const test::RealPair& pair : test::real_pairs()) {
        const auto source = test::load_part(pair.source), target = test::load_part(pair.target);
        if (!source || !target) return;
        CAPTURE(pair.name);
        const Mesh* targets[] = {&target->mesh};
        MergeOptions options;
        options.thesis = &thesis_formulas();
        const Join join = test::join_of(pair, *source, *target);
        const MergeResult before = Merger(source->mesh, targets, {join}, options).solve();
        double radius = 0.0;
        const std::vector<Index>& seam = before.seams[0];
        Vec3 center = Vec3::Zero();
        for (const Index v : seam) center += before.mesh.position(v) / double(seam.size());
        for (const Index v : seam) {
            radius += (before.mesh.position(v) - center).norm() / double(seam.size());
        }
        options.target_transition = 0.9 * radius;
        options.source_transition = 0.9 * radius / before.report.joins[0].scale;
        const MergeResult result = Merger(source->mesh, targets, {join}, options).solve();
        CHECK(result.mesh.face_count() < before.mesh.face_count());
        CHECK(result.mesh.topology().boundary_loops().size() ==
              before.mesh.topology().boundary_loops().size());
        CHECK(result.report.seam.after.max_dihedral < (pair.dihedral + 2.0) * kPi / 180.0);
        CHECK(result.report.seam.after.max_near <
              before.report.seam.after.max_near + 7.0 * kPi / 180.0);
        CHECK(result.report.transition.target[0].unmapped == 0);
        CHECK(result.report.transition.source[0].unmapped == 0);
        ++pairs;
        if (pairs == 3) return;
    }
}
