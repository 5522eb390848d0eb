// A cancel at any moment leaves the deformer as it was, and the same call afterwards gives the same
// result.

#include "kernel/deform/deformed_surface.h"
#include "kernel/deform/pipeline.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/deform/interrupter.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

// What can be seen of a deformer.
struct Seen {
    std::vector<Vec3> positions;
    std::vector<Mat3> gradients;
    std::vector<Affine> transforms;
    Mesh mesh;

    Seen(Deformer& deformer, const Mesh& rest) : mesh(rest) {
        positions = deformer.positions();
        gradients = gradients_of(deformer);
        for (const HandleId h : deformer.handles())
            transforms.push_back(deformer.pose(h).transform);
        deformer.apply_to(mesh);
    }
    bool operator==(const Seen& other) const {
        return positions == other.positions && gradients == other.gradients &&
               transforms == other.transforms && hash(mesh) == hash(other.mesh);
    }
};

Scene large_bar() {
    Scene scene = make_scene(make_bar({1.0, 5.0, 24, 110}));
    Attribute normals{"normal", Domain::vertex, 3, ScalarType::float32, {}};
    for (Index v = 0; v < scene.mesh.vertex_count(); ++v) {
        normals.values.insert(normals.values.end(), {0.0, 0.6, 0.8});
    }
    scene.mesh.attributes().add(normals);
    return scene;
}

// Cancels call(deformer, context) at every moment in turn. `start` makes a deformer that shows
// something already; `call` must throw or give what it gives without a cancel. Returns how many
// calls were cut short.
template <typename Start, typename Call>
int interrupt_everywhere(const Mesh& rest, const Start& start, const Call& call) {
    Deformer whole = start();
    Interrupter counter(-1);
    call(whole, counter.context());
    const Seen expected(whole, rest);
    int cut = 0;
    Deformer deformer = start();
    const Seen before(deformer, rest);
    for (int stop = 0; stop < counter.moments(); ++stop) {
        CAPTURE(stop);
        const Interrupter interrupter(stop);
        try {
            call(deformer, interrupter.context());
            CHECK(Seen(deformer, rest) == expected);
            deformer = start();
        } catch (const Error& error) {
            REQUIRE(error.code() == ErrorCode::cancelled);
            CHECK(Seen(deformer, rest) == before);
            ++cut;
        }
    }
    call(deformer, Context());
    CHECK(Seen(deformer, rest) == expected);
    return cut;
}

}  // namespace

TEST_CASE("cancel: a rest shape asks the host, too") {
    const Scene scene = make_scene(make_bar({1.0, 5.0, 4, 20}));
    Context context;
    context.cancel();
    CHECK(error_of([&] { make_rest_shape(scene.mesh, scene.all(), {}, context); }).code() ==
          ErrorCode::cancelled);
}

TEST_CASE("cancel: at every moment of a frame, of either kind") {
    const Scene scene = large_bar();
    Edit edit = make_edit(scene);
    Deformer& d = edit.deformer;
    const Affine shown = bend(scene, d.handle(edit.high).center, 0.4);
    const Affine wanted = bend(scene, d.handle(edit.high).center, 1.1);
    const auto check = [&](const auto& frame) {
        d.set_transform(edit.high, wanted);
        d.reset();
        d.set_transform(edit.high, wanted);
        frame(d, Context());
        const Seen expected(d, scene.mesh);
        d.set_transform(edit.high, shown);
        d.solve(FrameQuality::preview);
        d.set_transform(edit.high, wanted);
        const Seen before(d, scene.mesh);
        int cut = 0;
        for (int stop = 0;; ++stop) {
            CAPTURE(stop);
            const Interrupter interrupter(stop);
            try {
                frame(d, interrupter.context());
            } catch (const Error& error) {
                REQUIRE(error.code() == ErrorCode::cancelled);
                CHECK(Seen(d, scene.mesh) == before);
                ++cut;
                continue;
            }
            if (interrupter.moments() <= stop) break;
        }
        CHECK(Seen(d, scene.mesh) == expected);
        return cut;
    };
    CHECK(check([](Deformer& deformer, const Context& c) {
              deformer.solve(FrameQuality::preview, c);
          }) >= 3);
    CHECK(check([](Deformer& deformer, const Context& c) {
              deformer.solve(FrameQuality::draft, c);
          }) >= 10);
    CHECK(check([](Deformer& deformer, const Context& c) {
              deformer.solve(FrameQuality::full, c);
          }) >= 20);
}

TEST_CASE("cancel: at every moment of the preparation that a new handle needs") {
    const Scene scene = make_scene(make_bar({1.0, 5.0, 5, 25}));
    const Index middle = scene.mesh.vertex_count() / 2;
    const auto start = [&] {
        Edit edit = make_edit(scene);
        edit.deformer.set_transform(edit.high,
                                    bend(scene, edit.deformer.handle(edit.high).center, 0.4));
        edit.deformer.solve();
        edit.deformer.set_transform(edit.deformer.add_handle(scene.region({middle, middle + 1})),
                                    translation({0.3, 0.0, 0.0}));
        return std::move(edit.deformer);
    };
    const auto interrupted = [&](const auto& call) {
        return interrupt_everywhere(scene.mesh, start, call);
    };
    CHECK(interrupted([](Deformer& d, const Context& c) { d.prepare(c); }) >= 8);
    CHECK(interrupted([](Deformer& d, const Context& c) { d.solve(FrameQuality::preview, c); }) >=
          8);
    CHECK(interrupted([](Deformer& d, const Context& c) { d.solve(FrameQuality::full, c); }) >= 8);
}

TEST_CASE("cancel: the one-shot function leaves the mesh as it was") {
    const Scene scene = make_scene(make_bar({1.0, 5.0, 4, 20}));
    Edit edit = make_edit(scene);
    const std::vector<HandleMove> moves{
        {scene.region(scene.low), {}, {}},
        {scene.region(scene.high), bend(scene, edit.deformer.handle(edit.high).center), {}}};
    const auto before = hash(scene.mesh);
    Mesh mesh = scene.mesh;
    int cut = 0;
    for (int stop = 0;; ++stop) {
        const Interrupter interrupter(stop);
        try {
            deform(mesh, scene.all(), moves, {}, interrupter.context());
        } catch (const Error& error) {
            REQUIRE(error.code() == ErrorCode::cancelled);
            CHECK(hash(mesh) == before);
            ++cut;
            continue;
        }
        if (interrupter.moments() <= stop) break;
        mesh = scene.mesh;
    }
    CHECK(cut >= 8);
    Mesh whole = scene.mesh;
    deform(whole, scene.all(), moves);
    CHECK(hash(mesh) == hash(whole));
}

TEST_CASE("gradients: those of the shape that is shown, whatever has been asked for since") {
    const Scene scene = make_scene(make_bar({1.0, 5.0, 4, 20}));
    Edit reference = make_edit(scene), edit = make_edit(scene);
    const Affine shown = bend(scene, reference.deformer.handle(reference.high).center, 0.7);
    reference.deformer.set_transform(reference.high, shown);
    reference.deformer.solve(FrameQuality::preview);
    const std::vector<Mat3> expected = gradients_of(reference.deformer);
    const auto show = [&] {
        edit.deformer.set_transform(edit.high, shown);
        edit.deformer.solve(FrameQuality::preview);
    };
    show();
    edit.deformer.set_transform(edit.high, translation({1, 0, 0}));
    CHECK(gradients_of(edit.deformer) == expected);
    show();
    const HandleId added = edit.deformer.add_handle(scene.region({scene.mesh.vertex_count() / 2}));
    CHECK(gradients_of(edit.deformer) == expected);
    edit.deformer.remove_handle(added);
    show();
    edit.deformer.constrain(VertexConstraint{scene.mesh.vertex_count() / 2, Vec3(1, 2, 3), {}, {}});
    CHECK(gradients_of(edit.deformer) == expected);
    edit.deformer.constrain(VertexConstraint{scene.mesh.vertex_count() / 2, {}, {}, {}});
    edit.deformer.set_transform(edit.high, shown);
    edit.deformer.solve();
    edit.deformer.remove_handle(edit.low);
    CHECK(gradients_of(edit.deformer) == expected);
}

TEST_CASE("vertices without faces: at rest again when the handle that took them along is gone") {
    const Mesh box = make_box();
    std::vector<Vec3> positions(box.positions().begin(), box.positions().end());
    positions.emplace_back(9, 9, 9);
    const Mesh mesh(positions, box.topology().faces());
    const auto region = [&](std::vector<Index> v) { return Region(mesh.shared_topology(), v); };
    Deformer d(mesh, Region::all(mesh.shared_topology()));
    d.add_handle(region({0, 1}));
    const HandleId other = d.add_handle(region({7}));
    const HandleId loose = d.add_handle(region({box.vertex_count()}));
    d.set_transform(other, translation({1, 0, 0}));
    d.set_transform(loose, translation({1, 0, 0}));
    CHECK(d.solve().back() == Vec3(10, 9, 9));
    d.remove_handle(loose);
    CHECK(d.solve().back() == Vec3(9, 9, 9));
    CHECK(d.solve(FrameQuality::preview).back() == Vec3(9, 9, 9));
}
