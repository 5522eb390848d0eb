// The properties of a merge on pairs of real models: watertight, the genus that is expected,
// nothing changed away from the seam, a seam that is hidden, and the same result wherever the
// source lies.
#include "tests/unit/merge/real_pairs.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <random>
#include <set>

#include "kernel/deform/rotation/polar.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/query/self_intersections.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

constexpr double kDegrees = 180.0 / kPi;

struct LoadedPair {
    const RealPair* pair = nullptr;
    LoadedPart source, target;

    MergeResult merged(const MergeOptions& options) const {
        const Mesh* targets[] = {&target.mesh};
        return Merger(source.mesh, targets, {join_of(*pair, source, target)}, options).solve();
    }
    // By default; made once.
    const MergeResult& merged() const {
        if (!plain) plain = std::make_shared<const MergeResult>(merged(MergeOptions()));
        return *plain;
    }

    mutable std::shared_ptr<const MergeResult> plain;
};

// Every pair, loaded once; empty without the test data.
const std::vector<LoadedPair>& loaded_pairs() {
    static const std::vector<LoadedPair> loaded = [] {
        std::vector<LoadedPair> result;
        for (const RealPair& pair : real_pairs()) {
            auto source = load_part(pair.source), target = load_part(pair.target);
            if (!source || !target) break;
            result.push_back({&pair, std::move(*source), std::move(*target), nullptr});
        }
        return result;
    }();
    return loaded;
}

Index open_boundaries(const Mesh& mesh) {
    return static_cast<Index>(mesh.topology().boundary_loops().size());
}

// Faces of a merged mesh that run through one another and did not in the mesh they come from.
int new_intersections(const LoadedPair& pair, const MergeResult& result) {
    const auto own = [](const Mesh& mesh, Index shift, std::set<std::pair<Index, Index>>& known) {
        for (const auto& [a, b] : self_intersections(mesh)) known.emplace(a + shift, b + shift);
    };
    std::set<std::pair<Index, Index>> known;
    own(pair.target.mesh, 0, known);
    own(pair.source.mesh, pair.target.mesh.face_count(), known);
    int count = 0;
    for (const auto& [a, b] : self_intersections(result.mesh)) {
        const Index from_a = result.provenance.faces.main_source(a);
        const Index from_b = result.provenance.faces.main_source(b);
        count += known.count(std::minmax(from_a, from_b)) == 0;
    }
    return count;
}

// How often a test with random input is repeated.
int trials() {
    const char* asked = std::getenv("LISSOM_TRIALS");
    return asked ? std::atoi(asked) : 1;
}

// RMS distance of points, as they are and after the similarity that brings them nearest.
std::pair<double, double> differences(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    const auto n = static_cast<double>(a.size());
    Vec3 from = Vec3::Zero(), to = Vec3::Zero();
    for (std::size_t i = 0; i < a.size(); ++i) {
        from += a[i] / n;
        to += b[i] / n;
    }
    Mat3 products = Mat3::Zero();
    double from_squares = 0.0, to_squares = 0.0, place = 0.0, shape = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        products += (b[i] - to) * (a[i] - from).transpose();
        from_squares += (a[i] - from).squaredNorm();
        to_squares += (b[i] - to).squaredNorm();
    }
    const Mat3 turn = nearest_rotation(products / std::sqrt(from_squares * to_squares));
    const double scale = std::sqrt(to_squares / from_squares);
    for (std::size_t i = 0; i < a.size(); ++i) {
        place += (b[i] - a[i]).squaredNorm() / n;
        shape += (b[i] - to - scale * (turn * (a[i] - from))).squaredNorm() / n;
    }
    return {std::sqrt(place), std::sqrt(shape)};
}

double max_difference(const Mesh& a, const Mesh& b) {
    double greatest = 0.0;
    for (Index v = 0; v < a.vertex_count(); ++v) {
        greatest = std::max(greatest, (a.position(v) - b.position(v)).norm());
    }
    return greatest;
}

}  // namespace

TEST_CASE("pairs of real models become one watertight surface whose seam is hidden") {
    for (const LoadedPair& pair : loaded_pairs()) {
        CAPTURE(pair.pair->name);
        const MergeResult& result = pair.merged();
        const Mesh &s = pair.source.mesh, &t = pair.target.mesh, &m = result.mesh;
        CHECK(open_boundaries(m) == open_boundaries(s) + open_boundaries(t) - 2);
        CHECK(euler_characteristic(m.topology()) ==
              euler_characteristic(s.topology()) + euler_characteristic(t.topology()));
        CHECK(m.topology().component_count() ==
              s.topology().component_count() + t.topology().component_count() - 1);
        CHECK(kDegrees * result.report.seam.after.max_dihedral < pair.pair->dihedral);
        CHECK(kDegrees * result.report.seam.after.low_angle > 8.0);
        CHECK(zero_area_faces(m).size() <= zero_area_faces(s).size() + zero_area_faces(t).size());
        CHECK(new_intersections(pair, result) == 0);
    }
}

TEST_CASE("without smoothing and collars the target stays as it is, to the bit and in its order") {
    for (const LoadedPair& pair : loaded_pairs()) {
        CAPTURE(pair.pair->name);
        MergeOptions options;
        options.smooth = 0;
        options.trim = false;
        options.collar = false;
        const MergeResult result = pair.merged(options);
        Index last = -1, kept = 0;
        for (Index v = 0; v < result.mesh.vertex_count(); ++v) {
            const auto sources = result.provenance.vertices[v];
            const Index from = sources.front().element;
            if (from >= pair.target.mesh.vertex_count()) break;
            if (sources.size() > 1) continue;
            CHECK(from > last);
            CHECK(result.mesh.position(v) == pair.target.mesh.position(from));
            last = from;
            ++kept;
        }
        CHECK(kept + result.report.joins[0].target_size >= pair.target.mesh.vertex_count());
    }
}

TEST_CASE("the result does not depend on where the source lies, how it is turned and how large") {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (const LoadedPair& pair : loaded_pairs()) {
        CAPTURE(pair.pair->name);
        const Mesh& expected = pair.merged().mesh;
        const double size = surface_radius(expected);
        for (int trial = 0; trial < trials(); ++trial) {
            Affine map = rotation(Vec3(unit(random), unit(random), unit(random)),
                                  3.0 * unit(random), Vec3::Zero());
            const double scale = std::pow(10.0, 3.0 * unit(random));
            map.linear *= scale;
            map.translation = 10.0 * scale * surface_radius(pair.source.mesh) *
                              Vec3(unit(random), unit(random), unit(random));
            LoadedPair moved = pair;
            transform(moved.source.mesh, map);
            // Keys go along as vertices, so that they do not depend on the frame.
            Join join = join_of(*pair.pair, pair.source, pair.target);
            join.source = moved.source.boundary;
            const Mesh* targets[] = {&moved.target.mesh};
            const Mesh result = Merger(moved.source.mesh, targets, {join}).solve().mesh;
            REQUIRE(result.vertex_count() == expected.vertex_count());
            CHECK(result.topology().faces().vertices == expected.topology().faces().vertices);
            CHECK(max_difference(result, expected) < 1e-9 * size);
        }
    }
}

TEST_CASE("a transition region hides the seam further, and moves nothing beyond it") {
    for (const LoadedPair& pair : loaded_pairs()) {
        CAPTURE(pair.pair->name);
        const MergeResult& plain = pair.merged();
        MergeOptions options;
        const double length = pair.target.boundary.length(pair.target.mesh);
        const double radius = length / (2.0 * kPi);
        options.target_transition = 0.9 * radius;
        options.source_transition = 0.9 * radius / plain.report.joins[0].scale;
        const MergeResult result = pair.merged(options);
        REQUIRE(result.mesh.vertex_count() == plain.mesh.vertex_count());
        Index moved = 0;
        for (Index v = 0; v < result.mesh.vertex_count(); ++v) {
            moved += result.mesh.position(v) != plain.mesh.position(v);
        }
        CHECK(moved <= static_cast<Index>(result.report.transition.moved.size()));
        // Where the seam shows less than the details that would fade across it, nothing moves.
        CHECK((moved > 0) == (result.report.transition.kept > 0.0));
        MESSAGE(pair.pair->name << ": " << kDegrees * plain.report.seam.after.max_dihedral << " -> "
                                << kDegrees * result.report.seam.after.max_dihedral << " near "
                                << kDegrees * plain.report.seam.after.max_near << " -> "
                                << kDegrees * result.report.seam.after.max_near);
        const SeamQuality &before = plain.report.seam.after, &after = result.report.seam.after;
        CHECK(after.max_near < before.max_near + 1.0 / kDegrees);
        for (const auto& bands :
             {result.report.transition.target, result.report.transition.source}) {
            for (const TransitionBand& band : bands) CHECK(band.unmapped == 0);
        }
    }
}

TEST_CASE("neither fairing nor a transition crumples the band that it was to smooth") {
    // The dense penguin stands on the rim of a coarse torso, which is steep between its halves.
    const RealPair penguin{"penguin on Venus",
                           {"penguin.obj", 0, Vec3(0, .2234, 0), Vec3(0, 1, 0), Vec3(0, 1, 0)},
                           {"venus_torso_711.off", 1},
                           {{Vec3(0, 0, 1), Vec3(0, 0, 1)}}};
    std::vector<LoadedPair> pairs = loaded_pairs();
    auto source = load_part(penguin.source), target = load_part(penguin.target);
    if (source && target)
        pairs.push_back({&penguin, std::move(*source), std::move(*target), nullptr});
    for (const LoadedPair& pair : pairs) {
        CAPTURE(pair.pair->name);
        const double plain = pair.merged().report.joins[0].band.roughness;
        MergeOptions fair, transition;
        fair.seam = SeamKind::fair;
        transition.auto_transition = true;
        for (const MergeOptions& options : {fair, transition}) {
            const MergeReport report = pair.merged(options).report;
            CHECK(report.joins[0].band.roughness < 1.05 * plain);
            for (const MergeReason& reason : report.reasons) {
                CHECK(reason.fault != MergeFault::roughness);
                CHECK(reason.fault != MergeFault::folds);
            }
        }
    }
}

TEST_CASE("a part that was cut off and moved comes back where it was") {
    const RealPair* const necks[] = {&real_pairs()[2], &real_pairs()[7]};
    for (const RealPair* neck : necks) {
        const auto body = load_part(neck->target);
        ModelPart above = neck->target;
        above.normal = -above.normal;
        above.seed = *above.point - 0.3 * neck->target.normal.normalized();
        const auto head = load_part(above);
        if (!body || !head) return;
        CAPTURE(neck->name);
        Mesh moved = head->mesh;
        Affine map = rotation(Vec3(1, 2, 3), 2.0, Vec3(5, 0, 1));
        map.linear *= 7.0;
        transform(moved, map);
        const Path boundary(moved.shared_topology(), head->boundary.vertices(), true);
        const Mesh* targets[] = {&body->mesh};
        MergeOptions options;
        options.smooth = 0;
        options.trim = false;
        options.place = Place::shape;
        Merger merge(moved, targets, {Join{boundary, body->boundary}}, options);
        const MergeResult result = merge.solve();
        CHECK(result.report.joins[0].guessed);
        CHECK(7.0 * result.report.joins[0].scale == doctest::Approx(1.0).epsilon(0.02));
        const double size = surface_radius(result.mesh);
        std::vector<Vec3> expected, found;
        for (Index v = 0; v < result.mesh.vertex_count(); ++v) {
            const auto sources = result.provenance.vertices[v];
            const Index from = sources.front().element - body->mesh.vertex_count();
            if (sources.size() > 1 || from < 0) continue;
            expected.push_back(head->mesh.position(from));
            found.push_back(result.mesh.position(v));
        }
        const auto [place, shape] = differences(expected, found);
        MESSAGE("place off by " << place / size << " of the size, shape by " << shape / size);
        CHECK(place < 0.02 * size);
        CHECK(shape < 0.01 * size);
    }
}
