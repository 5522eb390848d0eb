// A step that is cancelled, has too little memory or cannot be done leaves what is shown and what
// was asked as they were, wherever it stops; the same step afterwards gives what it would have
// given.
#include <string>
#include <vector>

#include "kernel/deform/deformed_surface.h"
#include "kernel/deform/deformer_state.h"
#include "kernel/deform/first_solution.h"
#include "kernel/deform/handle_basis.h"
#include "kernel/deform/handle_changes.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/deform/interrupter.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/failing_memory.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

DeformSnapshot asked_of(const Deformer& d) {
    const auto& state = DeformerAccess::state(d);
    return {state.rest, state.constraints, state.poses, nullptr};
}

// What was asked of a deformer and what it shows, but for gradients, which are found when asked
// for.
struct State {
    DeformSnapshot setup;
    std::vector<Vec3> positions, rest;
    std::vector<Affine> transforms;
    std::vector<Vec3> turns;
    std::uint64_t mesh;

    State(const Deformer& d, Mesh shown)
        : setup(asked_of(d)), positions(d.positions()), rest(rest_positions_of(d)) {
        for (const HandleId h : d.handles()) {
            transforms.push_back(d.pose(h).transform);
            turns.push_back(d.pose(h).turn);
        }
        d.apply_to(shown);
        mesh = hash(shown);
    }
    bool operator==(const State& other) const {
        return setup.rest == other.setup.rest && setup.constraints == other.setup.constraints &&
               setup.poses.targets == other.setup.poses.targets && positions == other.positions &&
               rest == other.rest && transforms == other.transforms && turns == other.turns &&
               mesh == other.mesh;
    }
};

// What calls are given: made before memory runs out.
struct Given {
    const Scene scene = make_scene(make_bar({1.0, 3.0, 2, 6}));
    const Index vertex = scene.between(3);
    const Region one = scene.region({vertex}), corner = scene.region({scene.low.front()});
    const std::vector<MeshPoint> points{vertex_point(vertex)};
    HandleId low, middle;
};

struct Call {
    std::string name;
    void (*run)(Deformer&, const Given&, const Context&);
    bool takes_context = true;
};

const Call kCalls[] = {
    {"prepare", [](Deformer& d, const Given&, const Context& c) { d.prepare(c); }},
    {"preview",
     [](Deformer& d, const Given&, const Context& c) { d.solve(FrameQuality::preview, c); }},
    {"solve", [](Deformer& d, const Given&, const Context& c) { d.solve(FrameQuality::full, c); }},
    {"solve_draft",
     [](Deformer& d, const Given&, const Context& c) { d.solve(FrameQuality::draft, c); }},
    {"solve_first_directly",
     [](Deformer& d, const Given&, const Context& c) { solve_first_directly(d, c); }},
    {"basis", [](Deformer& d, const Given&, const Context& c) { basis_of(d, c); }},
    {"refined_mesh",
     [](Deformer& d, const Given& g, const Context& c) { subdivided_mesh(d, g.scene.mesh, c); }},
    {"gradients", [](Deformer& d, const Given&, const Context&) { gradients_of(d); }, false},
    {"snapshot", [](Deformer& d, const Given&, const Context&) { d.snapshot(); }, false},
    {"rebase", [](Deformer& d, const Given&, const Context&) { d.rebase(); }, false},
    {"reset", [](Deformer& d, const Given&, const Context&) { d.reset(); }, false},
    {"add_handle", [](Deformer& d, const Given& g, const Context&) { d.add_handle(g.one); }, false},
    {"add_handle of points",
     [](Deformer& d, const Given& g, const Context&) { d.add_handle(g.points); }, false},
    {"constrain",
     [](Deformer& d, const Given& g, const Context&) {
         d.constrain(VertexConstraint{g.vertex, Vec3(1, 0, 0), {}, {}});
     },
     false},
    {"set_stiffness",
     [](Deformer& d, const Given& g, const Context&) { set_stiffness(d, g.one, 9.0); }, false},
    {"set_handle_region",
     [](Deformer& d, const Given& g, const Context&) { set_handle_region(d, g.low, g.corner); },
     false},
    {"remove_handle",
     [](Deformer& d, const Given& g, const Context&) { d.remove_handle(g.middle); }, false}};

// A deformer that shows one solve while another, which needs a preparation of its own, is asked
// for.
class Fixture {
  public:
    Fixture() : edit_(make_edit(given.scene)) {
        const Scene& scene = given.scene;
        Deformer& d = edit_.deformer;
        d.set_transform(edit_.high, bend(scene, d.handle(edit_.high).center, 0.4));
        shown_ = d.snapshot();
        given.low = edit_.low;
        given.middle = d.add_handle(scene.region({scene.between(0)}));
        d.set_transform(given.middle, translation({0.2, 0, 0}));
        d.constrain(VertexConstraint{scene.between(7), Vec3(0.8, 0, 0), {}, 3.0});
        d.set_transform(edit_.high, bend(scene, d.handle(edit_.high).center, 4.0), Vec3::Zero(),
                        4.0 * scene.across);
        asked_ = d.snapshot();
    }

    Deformer& start() {
        edit_.deformer.restore(shown_);
        edit_.deformer.solve();
        auto& state = DeformerAccess::state(edit_.deformer);
        state.constraints = asked_.constraints;
        state.poses = asked_.poses;
        return edit_.deformer;
    }
    // Runs the call where it fails as `code`, and checks what is left; false where it passes.
    template <typename Run>
    bool fails(ErrorCode code, const Run& run) {
        Deformer& d = edit_.deformer;
        const State before(d, given.scene.mesh);
        try {
            run(d);
            return false;
        } catch (const Error& error) {
            allocations_left = -1;
            CHECK(error.code() == code);
            CHECK(State(d, given.scene.mesh) == before);
            return true;
        }
    }

    Given given;

  private:
    Edit edit_;
    DeformSnapshot shown_, asked_;
};

}  // namespace

TEST_CASE("failures: a cancel at every moment of every call leaves what was shown and asked") {
    Fixture fixture;
    for (const Call& call : kCalls) {
        if (!call.takes_context) continue;
        CAPTURE(call.name);
        int cut = 0;
        for (int stop = 0;; ++stop) {
            CAPTURE(stop);
            fixture.start();
            const Interrupter interrupter(stop);
            const bool failed = fixture.fails(ErrorCode::cancelled, [&](Deformer& d) {
                call.run(d, fixture.given, interrupter.context());
            });
            if (!failed) break;
            ++cut;
        }
        // The refined mesh is made of what is shown already.
        CHECK((cut >= 8 || call.name == "refined_mesh"));
    }
}

TEST_CASE("failures: a memory limit that any step exceeds leaves what was shown and asked") {
    Fixture fixture;
    for (const Call& call : kCalls) {
        if (!call.takes_context) continue;
        CAPTURE(call.name);
        int cut = 0;
        for (std::size_t limit = 64;; limit += limit / 3) {
            CAPTURE(limit);
            fixture.start();
            ContextOptions options;
            options.memory_limit = limit;
            const Context context(options);
            const bool failed = fixture.fails(
                ErrorCode::memory_limit, [&](Deformer& d) { call.run(d, fixture.given, context); });
            if (!failed) break;
            ++cut;
        }
        CHECK((cut >= 8 || call.name == "refined_mesh"));
    }
}

TEST_CASE(
    "failures: memory that runs out anywhere is an error of the kernel, and changes nothing") {
    Fixture fixture;
    for (const Call& call : kCalls) {
        CAPTURE(call.name);
        int cut = 0;
        for (long allowed = 0;; allowed += 1 + allowed / 6) {
            CAPTURE(allowed);
            fixture.start();
            const Context context;
            const bool failed = fixture.fails(ErrorCode::memory_limit, [&](Deformer& d) {
                allocations_left = allowed;
                call.run(d, fixture.given, context);
                allocations_left = -1;
            });
            allocations_left = -1;
            if (!failed) break;
            ++cut;
        }
        CHECK(cut >= 1);
    }
}

TEST_CASE("failures: what cannot be determined leaves what was shown and asked") {
    Fixture fixture;
    Deformer& d = fixture.start();
    for (const HandleId h : d.handles()) d.remove_handle(h);
    for (const Call& call : kCalls) {
        if (!call.takes_context || call.name == "refined_mesh") continue;
        CAPTURE(call.name);
        CHECK(fixture.fails(ErrorCode::unconstrained,
                            [&](Deformer& e) { call.run(e, fixture.given, Context()); }));
    }
}

TEST_CASE("normals: a vertex without faces keeps its own when the handle that turned it is gone") {
    Mesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}}, [] {
        FaceList faces;
        faces.add({0, 1, 2});
        return faces;
    }());
    mesh.attributes().add(
        {"normal", Domain::vertex, 3, ScalarType::float32, {0, 0, 1, 0, 0, 1, 0, 0, 1, 1, 0, 0}});
    const auto topology = mesh.shared_topology();
    using Between = void (*)(Deformer&, HandleId);
    for (const Between ask : {+[](Deformer&d, HandleId h) { d.remove_handle(h); },
                              +[](Deformer&d, HandleId h) {
                                  set_handle_region(d, h, Region(d.region().topology(), {0}));
                              }}) {
        Deformer d(mesh, Region::all(topology));
        d.add_handle(Region(topology, {1, 2}));
        const HandleId loose = d.add_handle(Region(topology, {0, 3}));
        d.set_transform(loose, rotation(Vec3::UnitZ(), 0.5 * kPi, Vec3::Zero()));
        d.solve();
        Mesh wanted = mesh, shown = mesh;
        d.apply_to(wanted);
        ask(d, loose);
        d.apply_to(shown);
        CHECK(hash(shown) == hash(wanted));
        CHECK((Vec3(shown.attributes().find("normal")->at(3).data()) - Vec3::UnitY()).norm() <
              1e-12);
    }
}

TEST_CASE("vertices without faces: at rest where a constraint says how they turn alone") {
    const Mesh box = make_box();
    std::vector<Vec3> positions(box.positions().begin(), box.positions().end());
    positions.emplace_back(9, 9, 9);
    const Mesh mesh(positions, box.topology().faces());
    const auto topology = mesh.shared_topology();
    Deformer d(mesh, Region::all(topology));
    d.add_handle(Region(topology, {0, 1}));
    const HandleId other = d.add_handle(Region(topology, {7}));
    d.constrain(VertexConstraint{
        box.vertex_count(), {}, Mat3(rotation(Vec3::UnitX(), 1.0, Vec3::Zero()).linear), {}});
    d.set_transform(other, translation({1, 0, 0}));
    CHECK(d.solve().back() == Vec3(9, 9, 9));
    CHECK(d.solve(FrameQuality::preview).back() == Vec3(9, 9, 9));
}

TEST_CASE("a point that lies partly outside the region is held where it is asked to lie") {
    const Scene scene = make_scene(make_bar({1.0, 5.0, 4, 20}));
    std::vector<Index> upper;
    for (Index v = 0; v < scene.mesh.vertex_count(); ++v) {
        if (scene.mesh.position(v).y() > -0.6) upper.push_back(v);
    }
    const Region region = scene.region(upper);
    Index inside = kNoIndex, outside = kNoIndex;
    for (const Index v : upper) {
        for (const Index n : scene.mesh.topology().neighbors(v)) {
            if (region.contains(n)) continue;
            inside = v;
            outside = n;
        }
    }
    REQUIRE(inside != kNoIndex);
    Deformer d(scene.mesh, region);
    d.add_handle(scene.region(scene.high));
    const MeshPoint point = edge_point(inside, outside, 0.25);
    const Vec3 wanted = point.position(scene.mesh) + Vec3(0.1, 0.0, 0.05);
    d.constrain({point, wanted, {}, {}});
    Mesh mesh = scene.mesh;
    d.solve();
    d.apply_to(mesh);
    CHECK((point.position(mesh) - wanted).norm() < 1e-9);
}
