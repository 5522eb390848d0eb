// Coarse borders of what is held are refined for the solution, and not in the result.

#include "kernel/deform/holds/boundary_refinement.h"

#include <Eigen/Geometry>
#include <cmath>
#include <map>

#include "kernel/deform/deformed_surface.h"
#include "kernel/deform/first_solution.h"
#include "kernel/deform/handle_changes.h"
#include "kernel/deform/stats.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/support.h"
#ifdef LISSOM_HAS_THESIS
#include "kernel/thesis/comparison/methods.h"
#endif

using namespace lissom;
using namespace lissom::test;

namespace {

constexpr Index kSides = 48, kRings = 40;
constexpr double kLength = 5.0;

// An open tube with bumps whose ends are polygons of few corners. Its handles are the two ends.
class TubeBuilder {
  public:
    TubeBuilder(Index corners, bool quads) : corners_(corners), quads_(quads) {}

    Scene build() {
        for (Index r = 0; r < kRings; ++r) {
            for (Index k = 0; k < kSides; ++k) add_side_vertex(r, k);
        }
        Scene scene{{}, {}, {}, 0.0, Vec3::UnitX()};
        scene.low = add_end(0.0);
        scene.high = add_end(kLength);
        for (Index r = 0; r + 1 < kRings; ++r) {
            for (Index k = 0; k < kSides; ++k) add_side_faces(r, k);
        }
        join(scene.low, 0, false);
        join(scene.high, kRings - 1, true);
        scene.mesh = Mesh(positions_, faces_);
        scene.size = surface_radius(scene.mesh);
        return scene;
    }

  private:
    void add_side_vertex(Index ring, Index k) {
        const double angle = 2.0 * kPi * k / kSides;
        const double z = kLength * (ring + 1) / (kRings + 1);
        const double radius = 1.0 + 0.08 * std::sin(5.0 * angle) * std::sin(3.0 * z);
        positions_.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }

    std::vector<Index> add_end(double z) {
        std::vector<Index> loop;
        for (Index c = 0; c < corners_; ++c) {
            const double angle = 2.0 * kPi * c / corners_;
            loop.push_back(static_cast<Index>(positions_.size()));
            positions_.emplace_back(std::cos(angle), std::sin(angle), z);
        }
        return loop;
    }

    void add_side_faces(Index ring, Index k) {
        const Index a = ring * kSides + k, b = ring * kSides + (k + 1) % kSides;
        if (quads_) {
            faces_.add({a, b, b + kSides, a + kSides});
            return;
        }
        faces_.add({a, b, b + kSides});
        faces_.add({a, b + kSides, a + kSides});
    }

    void add(Index a, Index b, Index c, bool flip) {
        if (flip) std::swap(a, b);
        faces_.add({a, b, c});
    }

    // Triangles between an end and a ring, the next one where less of its circle is behind it.
    void join(const std::vector<Index>& loop, Index ring, bool flip) {
        const auto vertex = [&](Index k) { return ring * kSides + k % kSides; };
        Index c = 0, k = 0;
        while (c < corners_ || k < kSides) {
            const Index corner = loop[static_cast<std::size_t>(c % corners_)];
            const double on_loop = (c + 0.5) / corners_, on_ring = (k + 0.5) / kSides;
            if (k == kSides || (c < corners_ && on_loop < on_ring)) {
                add(corner, loop[static_cast<std::size_t>((c + 1) % corners_)], vertex(k), flip);
                ++c;
            } else {
                add(vertex(k + 1), vertex(k), corner, flip);
                ++k;
            }
        }
    }

    Index corners_;
    bool quads_;
    std::vector<Vec3> positions_;
    FaceList faces_;
};

Scene tube(Index corners, bool quads = false) {
    return TubeBuilder(corners, quads).build();
}

Affine twist(double angle = 1.0) {
    return translation({0.5, 0.8, -0.4}) * rotation({0.3, 0.2, 1.0}, angle, {0, 0, kLength});
}

struct Held {
    WorkingPatch work;
    HolderMap holding;
};

Held held_ends(const Scene& scene) {
    ConstraintSet constraints;
    for (const std::vector<Index>* end : {&scene.low, &scene.high}) {
        Handle handle{scene.region(*end), {}};
        handle.local = *end;
        constraints.handles.push_back(std::make_shared<const Handle>(std::move(handle)));
    }
    WorkingPatch work(build_patch(scene.mesh, scene.all(), 1), {});
    HolderMap holding = find_holding(work, constraints);
    return {std::move(work), std::move(holding)};
}

double min_angle(const WeightedTriangles& triangles, const std::vector<Vec3>& at) {
    double least = kPi;
    for (const Triangle& t : triangles.triangle) {
        for (int k = 0; k < 3; ++k) {
            const Vec3 a = at[t[(k + 1) % 3]] - at[t[k]], b = at[t[(k + 2) % 3]] - at[t[k]];
            least = std::min(least, std::atan2(a.cross(b).norm(), a.dot(b)));
        }
    }
    return least;
}

double area_of(const WeightedTriangles& triangles, const std::vector<Vec3>& at) {
    double sum = 0.0;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const Triangle& c = triangles.triangle[t];
        sum += 0.5 * triangles.weight[t] * (at[c[1]] - at[c[0]]).cross(at[c[2]] - at[c[0]]).norm();
    }
    return sum;
}

bool same(const Mesh& a, const Mesh& b) {
    return std::equal(a.positions().begin(), a.positions().end(), b.positions().begin(),
                      b.positions().end()) &&
           a.topology().faces().vertices == b.topology().faces().vertices;
}

DeformOptions unrefined() {
    DeformOptions options;
    options.subdivide_borders = false;
    return options;
}

// The high end moved, the low one held.
std::vector<Vec3> bent(const Scene& scene, const DeformOptions& options,
                       const Affine& move = twist(), const Context& context = {}) {
    Edit edit = make_edit(scene, options);
    edit.deformer.set_transform(edit.high, move);
    return edit.deformer.solve(FrameQuality::full, context);
}

// Root mean square distance over the first `count` vertices, in sizes.
double difference(const Scene& scene, const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    double sum = 0.0;
    const std::size_t count = kSides * kRings;
    for (std::size_t i = 0; i < count; ++i) sum += (a[i] - b[i]).squaredNorm();
    return std::sqrt(sum / static_cast<double>(count)) / scene.size;
}

// The scene on the refined mesh, its handles with the vertices inserted on the ends.
Scene refined(const Scene& scene) {
    Edit edit = make_edit(scene);
    edit.deformer.prepare();
    Scene result = scene;
    result.mesh = subdivided_mesh(edit.deformer, scene.mesh);
    for (Index v = scene.mesh.vertex_count(); v < result.mesh.vertex_count(); ++v) {
        if (result.mesh.position(v).z() < 1e-9) result.low.push_back(v);
        if (result.mesh.position(v).z() > kLength - 1e-9) result.high.push_back(v);
    }
    return result;
}

// The same of a patch refined down to a share of the usual length.
Scene refined_to(const Scene& scene, double length) {
    const Held held = held_ends(scene);
    const Patch patch = refined_at_borders(held.work.patch, held.holding, length).value();
    Scene result = scene;
    std::vector<Vec3> at;
    FaceList faces;
    for (Index v = 0; v < patch.real_count; ++v) {
        at.push_back(patch.rest[v] + patch.origin);
        if (v < patch.mesh_count() || !patch.on_boundary[v]) continue;
        (at.back().z() < 0.5 * kLength ? result.low : result.high).push_back(v);
    }
    for (const Triangle& t : patch.triangles.triangle) faces.add(t);
    result.mesh = Mesh(std::move(at), std::move(faces));
    return result;
}

}  // namespace

TEST_CASE("coarse borders: edges become as long as those that move, and the surface stays") {
    const Scene scene = tube(6);
    const Held held = held_ends(scene);
    const std::optional<Patch> patch = refined_at_borders(held.work.patch, held.holding);
    REQUIRE(patch);
    const Patch& before = held.work.patch;
    CHECK(patch->mesh_count() == before.mesh_count());
    CHECK(area_of(patch->triangles, patch->rest) ==
          doctest::Approx(area_of(before.triangles, before.rest)).epsilon(1e-12));
    CHECK(min_angle(patch->triangles, patch->rest) >
          0.49 * min_angle(before.triangles, before.rest));

    double longest = 0.0;
    std::map<std::pair<Index, Index>, int> uses;
    for (const Triangle& t : patch->triangles.triangle) {
        for (int k = 0; k < 3; ++k) ++uses[std::minmax(t[k], t[(k + 1) % 3])];
    }
    for (const auto& [edge, count] : uses) {
        const Vec3 &a = patch->rest[edge.first], &b = patch->rest[edge.second];
        CHECK(count == (std::abs(a.z() - b.z()) < 1e-12 && patch->on_boundary[edge.first] ? 1 : 2));
        if (count == 1) longest = std::max(longest, (a - b).norm());
    }
    CHECK(longest < 0.15);
}

TEST_CASE("coarse borders: what is inserted lies on the surface, and is held by both its ends") {
    const Scene scene = tube(4);
    const Held held = held_ends(scene);
    const Patch patch = refined_at_borders(held.work.patch, held.holding).value();
    int inside = 0;
    for (std::size_t k = 0; k < patch.inserted.size(); ++k) {
        Vec3 at = Vec3::Zero();
        double sum = 0.0;
        for (const auto& [v, c] : patch.inserted[k]) {
            REQUIRE(v < patch.mesh_count());
            at += c * patch.rest[v];
            sum += c;
        }
        const std::size_t v = static_cast<std::size_t>(patch.mesh_count()) + k;
        CHECK(sum == doctest::Approx(1.0));
        CHECK((at - patch.rest[v]).norm() < 1e-12);
        const Index holder = common_holder(patch.inserted[k], held.holding);
        CHECK((holder != kFree) == (patch.on_boundary[v] != 0));
        inside += holder == kFree;
    }
    CHECK(inside > 0);
}

TEST_CASE("coarse borders: nothing is inserted where they are as dense as the region") {
    const Held held = held_ends(tube(48));
    CHECK_FALSE(refined_at_borders(held.work.patch, held.holding));
    const Scene bar = make_scene(make_bar());
    Edit edit = make_edit(bar);
    edit.deformer.prepare();
    CHECK(stats_of(edit.deformer).refined_vertices == 0);
    CHECK(same(subdivided_mesh(edit.deformer, bar.mesh), bar.mesh));
}

TEST_CASE("coarse borders: the result is that of the refined mesh") {
    const Scene scene = tube(5), fine = refined(scene);
    REQUIRE(fine.mesh.vertex_count() > scene.mesh.vertex_count() + 20);
    for (const double angle : {1.0, 4.0}) {
        const std::vector<Vec3> implied = bent(scene, {}, twist(angle));
        const std::vector<Vec3> explicitly = bent(fine, unrefined(), twist(angle));
        CHECK(difference(scene, implied, explicitly) < 1e-9);
        CHECK(difference(scene, implied, bent(scene, unrefined(), twist(angle))) > 1e-3);
    }
}

TEST_CASE("coarse borders: refined ones are nearer to what refining again comes to") {
    for (const Index corners : {3, 6, 12}) {
        const Scene scene = tube(corners);
        const std::vector<Vec3> limit = bent(refined_to(scene, 0.25), unrefined());
        const double coarse = difference(scene, bent(scene, unrefined()), limit);
        const double share = corners == 3 ? 0.3 : 0.8;
        CHECK(difference(scene, bent(scene, {}), limit) < share * coarse);
    }
}

TEST_CASE("coarse borders: the refined mesh has the deformed places, and attributes between them") {
    Scene scene = tube(4);
    Attribute height;
    height.name = "height";
    for (const Vec3& p : scene.mesh.positions()) height.values.push_back(p.z());
    scene.mesh.attributes().add(height);
    Edit edit = make_edit(scene);
    edit.deformer.set_transform(edit.high, twist());
    edit.deformer.solve();
    const Mesh fine = subdivided_mesh(edit.deformer, scene.mesh);
    CHECK(fine.vertex_count() ==
          scene.mesh.vertex_count() + stats_of(edit.deformer).refined_vertices);
    CHECK(fine.topology().is_closed() == scene.mesh.topology().is_closed());
    Index moved = 0;
    for (Index v = 0; v < fine.vertex_count(); ++v) {
        const double z = fine.attributes().find("height")->values[v];
        if (v < scene.mesh.vertex_count()) {
            CHECK(fine.position(v) == edit.deformer.positions()[v]);
        } else if (z == kLength) {
            // On the high end, between its corners.
            Vec3 nearest = Vec3::Constant(10.0);
            for (std::size_t k = 0; k < 4; ++k) {
                const Vec3 a = scene.mesh.position(scene.high[k]);
                const Vec3 b = scene.mesh.position(scene.high[(k + 1) % 4]);
                for (int s = 1; s < 16; ++s) {
                    const Vec3 at = twist()(a + (b - a) * s / 16.0);
                    if ((at - fine.position(v)).norm() < nearest.norm()) {
                        nearest = at - fine.position(v);
                    }
                }
            }
            CHECK(nearest.norm() < 1e-12);
            ++moved;
        }
    }
    CHECK(moved > 20);
}

TEST_CASE("coarse borders: of quads, and with what is held softly, stiffly and at points") {
    const Scene scene = tube(4, true);
    Edit edit = make_edit(scene);
    HandleOptions soft;
    soft.weight = 2.0;
    const Index middle = kSides * kRings / 2;
    const HandleId h = edit.deformer.add_handle(scene.region({middle}), soft);
    set_stiffness(edit.deformer, scene.region({middle + 5}), 3.0);
    const Affine move = bend(scene, edit.deformer.handle(edit.high).center, 0.7);
    edit.deformer.set_transform(edit.high, move);
    edit.deformer.set_transform(h, translation({0.1, 0.1, 0.1}));
    const std::vector<Vec3> solved = edit.deformer.solve();
    REQUIRE(stats_of(edit.deformer).refined_vertices > 0);
    for (const Index v : scene.high) CHECK(solved[v] == move(scene.mesh.position(v)));
    CHECK(max_distance(edit.deformer.solve(FrameQuality::preview),
                       solve_first_directly(edit.deformer)) < 1e-9 * scene.size);
    const Mesh fine = subdivided_mesh(edit.deformer, scene.mesh);
    CHECK(fine.vertex_count() > scene.mesh.vertex_count());
    CHECK(fine.topology().is_closed() == scene.mesh.topology().is_closed());
}

TEST_CASE("coarse borders: rest, rotations and threads as without them") {
    const Scene scene = tube(4);
    Edit edit = make_edit(scene);
    edit.deformer.set_transform(edit.high, twist());
    edit.deformer.solve();
    edit.deformer.set_transform(edit.high, {});
    CHECK(edit.deformer.solve() == rest_positions_of(edit.deformer));
    CHECK(subdivided_mesh(edit.deformer, scene.mesh).vertex_count() > scene.mesh.vertex_count());

    const Affine map = rotation({1, 2, 3}, 1.3, {3, -2, 7});
    Edit both = make_edit(scene);
    both.deformer.set_transform(both.low, map);
    both.deformer.set_transform(both.high, map);
    CHECK(max_distance(both.deformer.solve(), mapped(rest_positions_of(both.deformer), map)) <
          1e-9 * scene.size);

    ContextOptions one, two;
    one.threads = 1;
    two.threads = 2;
    CHECK(bent(scene, {}, twist(), Context(one)) == bent(scene, {}, twist(), Context(two)));
}

TEST_CASE("coarse borders: the refined mesh stays that of the result while handles change") {
    const Scene scene = tube(4);
    Edit edit = make_edit(scene);
    edit.deformer.set_transform(edit.high, twist());
    edit.deformer.solve();
    const Mesh before = subdivided_mesh(edit.deformer, scene.mesh);
    edit.deformer.add_handle(scene.region({kSides * kRings / 2}));
    CHECK(same(subdivided_mesh(edit.deformer, scene.mesh), before));
    edit.deformer.rebase();
    CHECK(subdivided_mesh(edit.deformer, scene.mesh).position(0) == before.position(0));
}

#ifdef LISSOM_HAS_THESIS
TEST_CASE("coarse borders: comparison methods leave them as they are") {
    DeformOptions options = compared_by(DeformMethod::harmonic);
    const Scene scene = tube(4);
    Edit edit = make_edit(scene, options);
    edit.deformer.prepare();
    CHECK(stats_of(edit.deformer).refined_vertices == 0);
    options.subdivide_borders = false;
    CHECK(error_of([&] { Deformer(scene.mesh, scene.all(), options); }).code() ==
          ErrorCode::invalid_argument);
}
#endif
