#include "kernel/thesis/transition/thesis_transition.h"

#include "kernel/deform/deformer.h"
#include "kernel/deform/patch/working_patch.h"
#include "kernel/mesh/shapes/shapes.h"
#include "kernel/thesis/fidelity.h"
#include "tests/unit/mesh/mesh_support.h"

using namespace lissom;

namespace {

// An open tube of unit size whose lower end is held as `map` says and whose lower rows are the
// transition region, each vertex its own counterpart.
TransitionMesh tube(const Mesh& mesh, const Affine& map) {
    const auto n = static_cast<std::size_t>(mesh.vertex_count());
    TransitionMesh side{&mesh,
                        std::vector<char>(n, 0),
                        std::vector<char>(n, 0),
                        std::vector<Vec3>(n, Vec3::Zero()),
                        std::vector<Mat3>(n, Mat3::Identity()),
                        {},
                        {}};
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (mesh.position(v).y() < -0.99) {
            side.position_known[v] = side.gradient_known[v] = 1;
            side.position[v] = map(mesh.position(v));
            side.gradient[v] = map.linear;
        } else if (mesh.position(v).y() < 0.0) {
            side.region.push_back(v);
            side.counterpart.push_back({{v, v, v}, {1.0, 0.0, 0.0}});
        }
    }
    return side;
}

Mesh plain_tube(double bump) {
    Mesh mesh = make_cylinder({.segments = 16, .rings = 10, .caps = false});
    for (Vec3& p : mesh.edit_positions()) {
        const double angle = std::atan2(p.z(), p.x());
        const double r = 1.0 + bump * std::sin(3.0 * angle) * std::sin(5.0 * p.y());
        p.x() *= r;
        p.z() *= r;
    }
    return mesh;
}

// The sum of E_T by its definition, over one region.
double transition_energy(const TransitionMesh& side, const TransitionMesh& other,
                         const TransitionShape& shape, const TransitionShape& across) {
    const auto coordinates = [](const Mesh& mesh) {
        const WorkingPatch work(build_patch(mesh, Region::all(mesh.shared_topology()), 0),
                                thesis_deform_options());
        std::vector<Vec3> delta;
        for (Index i = 0; i < mesh.vertex_count(); ++i) {
            delta.push_back(work.laplacian.apply(work.rings, work.patch.rest, i));
        }
        return delta;
    };
    const std::vector<Vec3> own = coordinates(*side.mesh), theirs = coordinates(*other.mesh);
    double sum = 0.0;
    for (std::size_t r = 0; r < side.region.size(); ++r) {
        const Index v = side.region[r];
        Vec3 difference = shape.gradients[v] * own[v];
        for (std::size_t k = 0; k < 3; ++k) {
            const Index w = side.counterpart[r].vertices[k];
            difference -= side.counterpart[r].weights[k] * across.gradients[w] * theirs[w];
        }
        sum += difference.squaredNorm();
    }
    return sum;
}

}  // namespace

TEST_CASE("equal meshes with equal regions keep their shape, and follow one map") {
    test::Random random(4);
    const Mesh mesh = plain_tube(0.1);
    for (const Affine& map : {Affine{}, test::similarity(random, 1.0)}) {
        const TransitionMesh side = tube(mesh, map);
        const ThesisTransition result = thesis_transition(side, side);
        for (const TransitionShape* shape : {&result.target, &result.source}) {
            for (Index v = 0; v < mesh.vertex_count(); ++v) {
                CHECK((shape->positions[v] - map(mesh.position(v))).norm() < 1e-7);
                CHECK((shape->gradients[v] - map.linear).norm() < 1e-6);
            }
        }
    }
}

TEST_CASE("without weight it is Eq 2.8 of each mesh by itself") {
    const Mesh mesh = plain_tube(0.1);
    const Affine turn = rotation(Vec3::UnitX(), 0.6, Vec3::Zero());
    TransitionMesh side = tube(mesh, {});
    std::vector<Index> low, high;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (side.position_known[v]) low.push_back(v);
        if (mesh.position(v).y() < 0.99) continue;
        high.push_back(v);
        side.position_known[v] = side.gradient_known[v] = 1;
        side.position[v] = turn(mesh.position(v));
        side.gradient[v] = turn.linear;
    }
    const ThesisTransition result = thesis_transition(side, tube(mesh, {}), 0.0);

    DeformOptions options = thesis_deform_options();
    options.subdivide_borders = false;
    Deformer deformer(mesh, Region::all(mesh.shared_topology()), options);
    deformer.add_handle(Region(mesh.shared_topology(), low));
    const HandleId top = deformer.add_handle(Region(mesh.shared_topology(), high));
    deformer.set_transform(top, turn);
    const std::vector<Vec3> expected = deformer.solve(FrameQuality::preview);
    double greatest = 0.0;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        greatest = std::max(greatest, (result.target.positions[v] - expected[v]).norm());
        CHECK((result.source.positions[v] - mesh.position(v)).norm() < 1e-7);
    }
    CHECK(greatest < 1e-7);
}

TEST_CASE("the greater the weight, the less the regions differ, and both take part") {
    const Mesh smooth = plain_tube(0.0), bumpy = plain_tube(0.1);
    const TransitionMesh target = tube(smooth, {}), source = tube(bumpy, {});
    double last = test::kInfinity;
    for (const double weight : {0.0, 0.1, 1.0, 100.0}) {
        const ThesisTransition result = thesis_transition(target, source, weight);
        const double energy = transition_energy(target, source, result.target, result.source);
        CHECK(energy < 0.999 * last);
        last = energy;
        double target_move = 0.0, source_move = 0.0;
        for (Index v = 0; v < smooth.vertex_count(); ++v) {
            target_move += (result.target.positions[v] - smooth.position(v)).norm();
            source_move += (result.source.positions[v] - bumpy.position(v)).norm();
        }
        CHECK((target_move > 1e-3) == (weight > 0.0));
        CHECK((source_move > 1e-3) == (weight > 0.0));
    }
}

TEST_CASE("what does not fit together, and what nothing holds, are errors") {
    const Mesh mesh = plain_tube(0.1);
    const TransitionMesh good = tube(mesh, {});
    const auto code = [](const TransitionMesh& a, const TransitionMesh& b, double weight = 0.1) {
        return test::error_of([&] { thesis_transition(a, b, weight); }).code();
    };
    CHECK(code(good, good, -0.1) == ErrorCode::invalid_argument);
    CHECK(code(good, good, test::kNaN) == ErrorCode::invalid_argument);
    TransitionMesh bad = good;
    bad.counterpart.pop_back();
    CHECK(code(good, bad) == ErrorCode::invalid_argument);
    bad = good;
    bad.region[0] = 100000;
    CHECK(code(bad, good) == ErrorCode::out_of_range);
    bad = good;
    bad.counterpart[0].vertices[1] = 100000;
    CHECK(code(good, bad) == ErrorCode::out_of_range);
    bad = good;
    std::fill(bad.position_known.begin(), bad.position_known.end(), 0);
    CHECK(code(bad, good) == ErrorCode::not_positive_definite);
}
