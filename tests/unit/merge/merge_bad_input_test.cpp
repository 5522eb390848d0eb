// Bad and extreme input of a merge: a typed error that names elements, or a sensible result.

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <string_view>

#include "kernel/merge/merge.h"
#include "kernel/mesh/cut/cut.h"
#include "kernel/mesh/cut/trim.h"
#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/edit/extract.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/repair/quality.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/shapes.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

Mesh triangle() {
    FaceList faces;
    faces.add({0, 1, 2});
    return {{{0, 0, 0}, {1, 0, 0}, {0.2, 1, 0}}, std::move(faces)};
}

// A tetrahedron without one face.
Mesh hat() {
    FaceList faces;
    faces.add({0, 1, 3});
    faces.add({1, 2, 3});
    faces.add({2, 0, 3});
    return {{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0.3, -1, 0.3}}, std::move(faces)};
}

Mesh half_ball(Index segments = 8, double height = 0.0) {
    return cut(make_sphere({.segments = segments}), CutPlane{{0, height, 0}, {0, 1, 0}}).kept.mesh;
}

Mesh lower_half(Index segments = 8) {
    return cut(make_sphere({.segments = segments}), CutPlane{{0, 0, 0}, {0, -1, 0}}).kept.mesh;
}

Join first_join(const Mesh& source, const Mesh& target) {
    return {boundaries(source).at(0), boundaries(target).at(0)};
}

MergeResult merged_badly(const Mesh& source, const Mesh& target, const MergeOptions& options = {}) {
    const Mesh* targets[] = {&target};
    return Merger(source, targets, {first_join(source, target)}, options).solve();
}

Error refused(const Mesh& source, const Mesh& target, std::vector<Join> joins,
              const MergeOptions& options = {}) {
    const std::uint64_t before[] = {hash(source), hash(target)};
    const Mesh* targets[] = {&target};
    const Error error =
        error_of([&] { Merger(source, targets, std::move(joins), options).solve(); });
    CHECK(hash(source) == before[0]);
    CHECK(hash(target) == before[1]);
    return error;
}

// Names elements in its text and as ids.
void check_names(const Error& error, ErrorCode code) {
    CAPTURE(error.message());
    CHECK(error.code() == code);
    CHECK(!error.elements().ids.empty());
    CHECK(error.message().find(describe(error.elements())) != std::string::npos);
}

bool finite(const Mesh& mesh) {
    return std::all_of(mesh.positions().begin(), mesh.positions().end(),
                       [](const Vec3& p) { return p.allFinite(); });
}

Path path_of(const Mesh& mesh, std::vector<Index> vertices, bool closed) {
    return Path(mesh.shared_topology(), std::move(vertices), closed);
}

}  // namespace

TEST_CASE("merge: joins must name open boundaries") {
    const Mesh source = half_ball(), target = lower_half();
    const Join sound = first_join(source, target);
    const std::vector<Index>& loop = sound.source.vertices();
    check_names(refused(source, target,
                        {{path_of(source, {loop[0], loop[1], loop[2]}, false), sound.target}}),
                ErrorCode::not_a_boundary);
    const std::span<const Index> face = source.topology().face(0);
    check_names(refused(source, target,
                        {{path_of(source, {face.begin(), face.end()}, true), sound.target}}),
                ErrorCode::not_a_boundary);
    check_names(refused(source, target, {{sound.source, path_of(target, {0, 1}, false)}}),
                ErrorCode::not_a_boundary);
    // A path of points knows no mesh.
    CHECK(refused(source, target, {{Path({{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, true), sound.target}})
              .code() == ErrorCode::not_a_boundary);
    CHECK(refused(source, target, {}).code() == ErrorCode::invalid_argument);
    CHECK(refused(source, target, {{sound.source, sound.target, 1}}).code() ==
          ErrorCode::out_of_range);
}

TEST_CASE("merge: a boundary is joined once, and not to its own mesh") {
    const Mesh source = half_ball(), target = lower_half();
    const Join sound = first_join(source, target);
    check_names(refused(source, target, {sound, sound}), ErrorCode::boundary_conflict);
    CHECK(refused(source, source, {first_join(source, source)}).code() ==
          ErrorCode::boundary_conflict);
    // Two targets, one boundary of the source.
    const Mesh other = lower_half(6);
    const Mesh* targets[] = {&target, &other};
    check_names(error_of([&] {
                    Merger(source, targets, {sound, {sound.source, boundaries(other)[0], 1}});
                }),
                ErrorCode::boundary_conflict);
    const Mesh pipe = make_cylinder({.caps = false});
    const Mesh* twice[] = {&target, &target};
    CHECK(error_of([&] {
              Merger(pipe, twice, {{boundaries(pipe)[0], sound.target}});
          }).code() == ErrorCode::boundary_conflict);
}

TEST_CASE("merge: boundaries of another mesh or topology are refused") {
    Mesh source = half_ball(), target = lower_half();
    const Join sound = first_join(source, target);
    CHECK(refused(source, target, {{boundaries(half_ball(5))[0], sound.target}}).code() ==
          ErrorCode::topology_mismatch);
    const Mesh trimmed = trim(source, sound.source).mesh;
    CHECK(refused(trimmed, target, {sound}).code() == ErrorCode::topology_mismatch);
    MergeOptions options;
    options.fixed = {Region(target.shared_topology(), {0})};
    CHECK(refused(source, target, {sound}, options).code() == ErrorCode::topology_mismatch);
}

TEST_CASE("merge: loops that cross themselves or enclose nothing") {
    const Mesh target = lower_half();
    const Mesh eight =
        tube(24, 3, [](double a, double h) { return Vec3(std::sin(a), std::sin(2.0 * a), h); });
    check_names(refused(eight, target, {first_join(eight, target)}), ErrorCode::boundary_conflict);
    check_names(refused(target, eight, {first_join(target, eight)}), ErrorCode::boundary_conflict);
    const Mesh point =
        tube(9, 4, [](double a, double h) { return Vec3(h * std::cos(a), h * std::sin(a), h); });
    check_names(refused(point, target, {first_join(point, target)}), ErrorCode::boundary_conflict);
    check_names(refused(target, point, {first_join(target, point)}), ErrorCode::boundary_conflict);
}

TEST_CASE("merge: keys off their loops") {
    const Mesh source = half_ball(), target = lower_half();
    Join join = first_join(source, target);
    const Index far = source.vertex_count() - 1;
    for (const Index v : {Index(-1), source.vertex_count(), std::numeric_limits<Index>::max()}) {
        join.keys = {{v, join.target.vertices()[0]}};
        check_names(refused(source, target, {join}), ErrorCode::key_conflict);
    }
    const auto on = [&](Index v) {
        const std::vector<Index>& loop = join.source.vertices();
        return std::find(loop.begin(), loop.end(), v) != loop.end();
    };
    join.keys = {{on(far) ? Index(0) : far, join.target.vertices()[0]}};
    check_names(refused(source, target, {join}), ErrorCode::key_conflict);
    for (const double x : {5.0, 1e300, std::numeric_limits<double>::infinity(),
                           std::numeric_limits<double>::quiet_NaN()}) {
        join.keys = {{Vec3(x, 0, 0), Vec3(1, 0, 0)}};
        CHECK(refused(source, target, {join}).code() == ErrorCode::key_conflict);
    }
}

TEST_CASE("merge: fixed features that leave the boundary nothing to move") {
    const Mesh source = half_ball(), target = lower_half();
    const Join join = first_join(source, target);
    MergeOptions options;
    options.fixed = {Region::all(source.shared_topology())};
    for (const Configuration c : {Configuration::free, Configuration::fixed}) {
        options.configuration = c;
        check_names(refused(source, target, {join}, options), ErrorCode::handle_overlap);
    }
    // All but the loop: only the loop moves.
    const Region loop(source.shared_topology(), join.source.vertices());
    options.fixed = {loop.inverted()};
    for (const Configuration c : {Configuration::free, Configuration::fixed}) {
        options.configuration = c;
        CHECK(merged_badly(source, target, options).mesh.topology().boundary_loops().empty());
    }
    // Features that share vertices cannot each move by a similarity of its own.
    options.configuration = Configuration::free;
    options.fixed = {loop.inverted(),
                     Region(source.shared_topology(), {loop.inverted().vertices()[0]})};
    CHECK(refused(source, target, {join}, options).code() == ErrorCode::handle_overlap);
}

TEST_CASE("merge: options out of range") {
    const Mesh source = half_ball(), target = lower_half();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::function<void(MergeOptions&)> wrong[] = {
        [](MergeOptions& o) { o.smooth = -1; },
        [](MergeOptions& o) { o.source_transition = -1.0; },
        [&](MergeOptions& o) { o.target_transition = nan; },
        [](MergeOptions& o) { o.max_turn = -0.1; },
        [&](MergeOptions& o) { o.max_turn = nan; },
        [](MergeOptions& o) {
            o.configuration = Configuration::fixed;
            o.reach = 0.0;
        },
        [&](MergeOptions& o) {
            o.configuration = Configuration::fixed;
            o.reach = nan;
        },
        // What only the fixed configuration has a use for.
        [](MergeOptions& o) { o.reach = 1.0; },
        [](MergeOptions& o) { o.turn_frames = false; },
    };
    for (const auto& change : wrong) {
        MergeOptions options;
        change(options);
        CHECK(refused(source, target, {first_join(source, target)}, options).code() ==
              ErrorCode::invalid_argument);
    }
    CHECK(error_of([&] {
              Merger(source, std::span<const Mesh* const>{}, {first_join(source, target)});
          }).code() == ErrorCode::invalid_argument);
}

TEST_CASE("merge: the smallest meshes") {
    const Mesh small[] = {triangle(),
                          hat(),
                          half_ball(6),
                          make_grid({.segments = {1, 1}}),
                          make_grid({.segments = {1, 6}}),
                          half_ball(20, 0.6)};
    for (const Mesh& source : small) {
        for (const Mesh& target : small) {
            if (&source == &target) continue;
            for (const Configuration c : {Configuration::free, Configuration::fixed}) {
                for (const SeamKind seam : {SeamKind::conform, SeamKind::fair}) {
                    CAPTURE(source.vertex_count());
                    CAPTURE(target.vertex_count());
                    // The large ones take long.
                    const bool large = std::max(source.vertex_count(), target.vertex_count()) > 100;
                    if (large && (c != Configuration::free || seam != SeamKind::conform)) continue;
                    MergeOptions options;
                    options.configuration = c;
                    options.seam = seam;
                    const MergeResult result = merged_badly(source, target, options);
                    CHECK(finite(result.mesh));
                    CHECK(result.mesh.topology().boundary_loops().empty());
                    CHECK(genus(result.mesh.topology()) == 0);
                }
            }
        }
    }
}

TEST_CASE("merge: features on loose parts go with them") {
    Mesh source = half_ball(8);
    const Index first = source.vertex_count();
    Mesh eye = make_sphere({.radius = 0.1, .segments = 2});
    for (Vec3& p : eye.edit_positions()) p += Vec3(0.2, 1.2, 0);
    append(source, eye);
    const Mesh target = lower_half(8);
    std::vector<Index> vertices;
    for (Index v = first; v < source.vertex_count(); ++v) vertices.push_back(v);
    MergeOptions options;
    options.fixed = {Region(source.shared_topology(), vertices)};
    for (const Configuration c : {Configuration::free, Configuration::fixed}) {
        options.configuration = c;
        const Mesh mesh = merged_badly(source, target, options).mesh;
        CHECK(mesh.topology().component_count() == 2);
        CHECK(finite(mesh));
    }
}

TEST_CASE("merge: a cancel at any report leaves everything as it was") {
    const Mesh source = half_ball(6), target = lower_half(5);
    const std::uint64_t before[] = {hash(source), hash(target)};
    const Mesh* targets[] = {&target};
    MergeOptions options;
    options.seam = SeamKind::fair;
    Merger merge(source, targets, {first_join(source, target)}, options);
    const std::uint64_t whole = hash(merge.solve().mesh);
    const auto cancelled = [](int stop, const auto& action) {
        std::optional<Context> context;
        int reports = 0;
        ContextOptions how;
        how.progress = [&](std::string_view, double) {
            if (reports++ == stop) context->cancel();
        };
        context.emplace(how);
        try {
            action(*context);
            return false;
        } catch (const Error& error) {
            CHECK(error.code() == ErrorCode::cancelled);
            return true;
        }
    };
    int prepared = 0, solved = 0;
    while (cancelled(prepared, [&](const Context& context) {
        Merger(source, targets, {first_join(source, target)}, options, context);
    })) {
        ++prepared;
    }
    while (cancelled(solved, [&](const Context& context) { merge.solve(context); })) {
        ++solved;
        REQUIRE(hash(merge.solve().mesh) == whole);
    }
    CHECK(prepared > 0);
    CHECK(solved > 0);
    CHECK(hash(source) == before[0]);
    CHECK(hash(target) == before[1]);
}

TEST_CASE("merge: a limit of memory is an error, not a crash") {
    const Mesh source = half_ball(), target = lower_half();
    const Mesh* targets[] = {&target};
    ContextOptions how;
    how.memory_limit = 1000;
    const Context context(how);
    CHECK(error_of([&] {
              Merger(source, targets, {first_join(source, target)}, {}, context);
          }).code() == ErrorCode::memory_limit);
    CHECK(context.memory()->used() == 0);
}
