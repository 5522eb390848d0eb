// Functions of a frame take no memory once two frames were made, however far handles turn and
// whatever changed before.
#include <cmath>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "bindings/engine/lissom_basis.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/c/host.h"
#include "tests/unit/c/memory/failing_malloc.h"

namespace lissom::test {
namespace {

// A column of so many sides, whose ends are one polygon each.
Mesh column(Index sides) {
    constexpr Index kRings = 8;
    std::vector<Vec3> positions;
    FaceList faces;
    std::vector<Index> bottom, top;
    for (Index i = 0; i < kRings * sides; ++i) {
        const double turn = 2.0 * kPi * (i % sides) / sides;
        positions.emplace_back(0.2 * std::sin(turn), 0.2 * (i / sides), 0.2 * std::cos(turn));
        if (i < sides) bottom.insert(bottom.begin(), i);
        if (i >= (kRings - 1) * sides) top.push_back(i);
        const Index next = i % sides == sides - 1 ? i + 1 - sides : i + 1;
        if (i < (kRings - 1) * sides) faces.add(std::array{i, next, next + sides, i + sides});
    }
    faces.add(bottom);
    faces.add(top);
    Mesh mesh(std::move(positions), std::move(faces));
    mesh.set_region("bottom", Region(mesh.shared_topology(), bottom));
    mesh.set_region("top", Region(mesh.shared_topology(), top));
    return mesh;
}

struct FrameCase {
    const char* name;
    Mesh shape = make_bar({.across = 4, .along = 16});
    lissom_deformer_options options = lissom_default_deformer_options();
    lissom_handle_options handle = lissom_default_handle_options();
    int threads = 1;
};

// A bar whose top is moved while its bottom stays.
class DraggedBar {
  public:
    explicit DraggedBar(const FrameCase& one) : host_(options_of(one.threads)) {
        const Mesh& bar = one.shape;
        mesh_ = host_.add(bar);
        REQUIRE(lissom_deformer_create(host_, mesh_, {0}, &one.options, &deformer_) == LISSOM_OK);
        REQUIRE(lissom_deformer_pin(host_, deformer_, region(bar, "bottom")) == LISSOM_OK);
        REQUIRE(lissom_deformer_add_handle(host_, deformer_, region(bar, "top"), &one.handle,
                                           &handle_) == LISSOM_OK);
        REQUIRE(lissom_render_map_create(host_, mesh_, &map_) == LISSOM_OK);
        room_.resize(3 * at(lissom_mesh_vertex_count(host_, mesh_)));
    }

    lissom_context* context() const { return host_; }
    lissom_deformer deformer() const { return deformer_; }

    /// Factor of the top's size.
    double size = 1.0;

    // Turns the top about the bar's axis and moves it.
    lissom_status set_transform(double turn) const {
        lissom_transform map = lissom_identity();
        map.m[0] = map.m[10] = size * std::cos(turn);
        map.m[2] = size * std::sin(turn);
        map.m[8] = -size * std::sin(turn);
        map.m[5] = size;
        map.m[3] = 0.1 * turn;
        return lissom_deformer_set_transform(host_, deformer_, handle_, &map);
    }
    // Makes a frame. Returns which of its functions took memory, and how often.
    std::string takers_of_frame(double turn, lissom_quality quality) {
        const lissom_output out{room_.data(), room_.size() / 3, 0, LISSOM_FLOAT64};
        const std::function<lissom_status()> calls[] = {
            [&] { return set_transform(turn); },
            [&] { return lissom_deformer_solve(host_, deformer_, quality); },
            [&] { return lissom_deformer_read_positions(host_, deformer_, &out); },
            [&] { return lissom_deformer_read_normals(host_, deformer_, &out); },
            [&] { return lissom_mesh_read_positions(host_, mesh_, &out); },
            [&] { return lissom_mesh_read_normals(host_, mesh_, &out); },
            [&] { return lissom_render_map_read_positions(host_, map_, mesh_, &out); },
            [&] { return lissom_render_map_read_normals(host_, map_, mesh_, &out); }};
        std::string takers;
        for (const auto& call : calls) {
            const long before = allocations();
            const lissom_status status = call();
            const long taken = allocations() - before;
            CHECK(status == LISSOM_OK);
            if (taken == 0) continue;
            takers += std::to_string(&call - calls) + ":" + std::to_string(taken) + " ";
        }
        return takers;
    }

  private:
    static lissom_context_options options_of(int threads) {
        auto options = lissom_default_context_options();
        options.threads = threads;
        return options;
    }
    lissom_region region(const Mesh& bar, const char* name) const {
        const auto& vertices = bar.find_region(name)->vertices();
        const lissom_input list{vertices.data(), vertices.size(), 0, LISSOM_INT32};
        lissom_region made{};
        REQUIRE(lissom_region_of_vertices(host_, mesh_, &list, &made) == LISSOM_OK);
        return made;
    }

    Host host_;
    lissom_mesh mesh_{};
    lissom_render_map map_{};
    lissom_deformer deformer_{};
    std::int32_t handle_ = -1;
    std::vector<double> room_;
};

constexpr lissom_quality kQualities[] = {LISSOM_PREVIEW, LISSOM_DRAFT, LISSOM_FULL};

// Frames that begin at `turn`; those after the second of each quality take nothing.
void check_frames(DraggedBar& bar, double turn, double step, int count) {
    for (const lissom_quality quality : kQualities) {
        for (int frame = 0; frame < count; ++frame) {
            CAPTURE(quality);
            CAPTURE(frame);
            const std::string takers = bar.takers_of_frame(turn + step * frame, quality);
            CAPTURE(takers);
            CHECK((frame < 2 || takers.empty()));
        }
    }
}

std::vector<FrameCase> frame_cases() {
    std::vector<FrameCase> all(10, FrameCase{"plain"});
    all[1].name = "refined";
    all[1].options.refine = 2;
    all[2].name = "scaled details";
    all[2].options.scale_details = true;
    all[3].name = "soft";
    all[3].handle.weight = 1.0;
    all[4].name = "falloff";
    all[4].handle.falloff = 0.3;
    all[5].name = "Poisson";
    all[5].options.second = LISSOM_SECOND_POISSON;
    all[6].name = "Laplacian";
    all[6].options.second = LISSOM_SECOND_LAPLACIAN;
    all[7].name = "position alone";
    all[7].handle.gradient = false;
    all[8] = {"refined polygons", column(12), all[1].options};
    all[9] = {"refined large polygons", column(40), all[1].options};
    return all;
}

}  // namespace

TEST_CASE("functions of a frame take no memory after two frames, at turns of any size") {
    for (const FrameCase& one : frame_cases()) {
        CAPTURE(std::string(one.name));
        DraggedBar bar(one);
        check_frames(bar, 0.3, 0.05, 6);
        check_frames(bar, 1.7, 0.05, 6);
        // From more than a third of a turn to three turns, and back at once.
        check_frames(bar, 2.5, 0.6, 30);
        check_frames(bar, -0.4, -0.9, 12);
    }
}

TEST_CASE("functions of a frame take no memory if a handle grows while it turns") {
    for (const FrameCase& one : frame_cases()) {
        CAPTURE(std::string(one.name));
        DraggedBar bar(one);
        bar.size = 1.2;
        check_frames(bar, 0.3, 0.05, 6);
        check_frames(bar, 2.5, 0.6, 12);
    }
}

TEST_CASE("functions of a frame take no memory two frames after handles and points have changed") {
    DraggedBar bar(frame_cases()[0]);
    check_frames(bar, 0.2, 0.1, 4);
    for (const double weight : {0.0, 1.0}) {
        CAPTURE(weight);
        for (const double x : {0.1, 0.2, 0.3}) {
            const double place[] = {x, 0.5, 0.1};
            REQUIRE(lissom_deformer_constrain(bar.context(), bar.deformer(), 60, place, weight) ==
                    LISSOM_OK);
            check_frames(bar, 0.4, 0.1, 4);
            check_frames(bar, 3.5, 0.1, 4);
        }
        REQUIRE(lissom_deformer_free(bar.context(), bar.deformer(), 60) == LISSOM_OK);
        check_frames(bar, 3.0, 0.4, 4);
    }
    REQUIRE(lissom_deformer_rebase(bar.context(), bar.deformer()) == LISSOM_OK);
    check_frames(bar, 0.3, 0.1, 4);
    check_frames(bar, 3.0, 0.4, 4);
    REQUIRE(lissom_deformer_reset(bar.context(), bar.deformer()) == LISSOM_OK);
    check_frames(bar, 3.0, 0.4, 4);
}

TEST_CASE("functions of a frame take no memory after an error of one") {
    DraggedBar bar(frame_cases()[0]);
    check_frames(bar, 3.0, 0.1, 4);
    lissom_transform flat = lissom_identity();
    flat.m[0] = 0.0;
    CHECK(lissom_deformer_set_transform(bar.context(), bar.deformer(), 1, &flat) ==
          LISSOM_SINGULAR_TRANSFORM);
    CHECK(bar.takers_of_frame(3.2, LISSOM_FULL) == "");
}

TEST_CASE("frames between two poses take no memory after two frames") {
    DraggedBar bar(frame_cases()[0]);
    lissom_pose poses[3]{};
    for (int k = 0; k < 3; ++k) {
        REQUIRE(bar.set_transform(1.9 * k) == LISSOM_OK);
        REQUIRE(lissom_deformer_get_pose(bar.context(), bar.deformer(), poses + k) == LISSOM_OK);
    }
    for (int frame = 0; frame < 40; ++frame) {
        CAPTURE(frame);
        const int key = frame / 20;
        const long before = allocations();
        const lissom_status status = lissom_deformer_set_blended_pose(
            bar.context(), bar.deformer(), poses[key], poses[key + 1], frame % 20 / 20.0);
        const long taken = allocations() - before;
        CHECK(status == LISSOM_OK);
        CHECK((frame % 20 < 2 || taken == 0));
    }
}

namespace {

// A bar that turns, one that grows, and a path of two; with loose parts that float if `floats`.
lissom_pose_space turning_space(const Host& host, bool floats) {
    const Mesh bar = make_bar({.across = 4, .along = 16});
    const auto shape = [&](double turn, double size) {
        Mesh mesh = bar;
        for (Vec3& p : mesh.edit_positions()) {
            if (!floats && p.y() < 0.0) continue;
            const double angle = floats ? turn : turn * p.y();
            p = size * Vec3(std::cos(angle) * p.x() + std::sin(angle) * p.z(), p.y(),
                            std::cos(angle) * p.z() - std::sin(angle) * p.x());
        }
        return host.add(mesh);
    };
    const lissom_mesh rest = host.add(bar);
    const lissom_mesh turned[] = {shape(0.8, 1.0), shape(1.6, 1.0)}, grown[] = {shape(0.0, 1.2)};
    const lissom_named_pose poses[] = {{"turned", turned, 2}, {"grown", grown, 1}};
    lissom_pose_space space{};
    REQUIRE(lissom_pose_space_create(host, rest, poses, 2, &space) == LISSOM_OK);
    return space;
}

}  // namespace

TEST_CASE("blends of a space of poses take no memory after two frames") {
    for (const bool floats : {false, true}) {
        CAPTURE(floats);
        const Host host;
        const lissom_pose_space space = turning_space(host, floats);
        std::vector<float> room(3 * at(lissom_pose_space_vertex_count(host, space)));
        const lissom_output out{room.data(), room.size() / 3, 0, LISSOM_FLOAT32};
        for (int frame = 0; frame < 30; ++frame) {
            CAPTURE(frame);
            const double t = 0.3 + 0.05 * frame, weights[] = {t, frame < 20 ? 0.4 : 0.0};
            const lissom_input list{weights, 2, 0, LISSOM_FLOAT64};
            const long before = allocations();
            const lissom_status status = lissom_pose_space_read_positions(host, space, &list, &out);
            const long taken = allocations() - before;
            CHECK(status == LISSOM_OK);
            CHECK((frame < 2 || taken == 0));
        }
    }
}

TEST_CASE("a basis is opened and evaluated without memory") {
    const DraggedBar bar(frame_cases()[0]);
    REQUIRE(bar.set_transform(0.2) == LISSOM_OK);
    lissom_bytes file{};
    REQUIRE(lissom_deformer_encode_basis(bar.context(), bar.deformer(), &file) == LISSOM_OK);
    // Aligned as the basis wants it.
    std::vector<double> bytes(file.size / sizeof(double) + 1);
    std::memcpy(bytes.data(), file.data, file.size);
    lissom_basis basis{};
    std::vector<float> transforms(64), out(30000);
    const std::uint32_t stride = 3 * sizeof(float);
    const long before = allocations();
    const lissom_basis_status status = lissom_basis_open(&basis, bytes.data(), file.size);
    for (std::uint32_t handle = 0; handle < basis.handle_count; ++handle) {
        lissom_basis_identity(transforms.data() + 12 * at(index_of(handle)));
    }
    const lissom_transform map = lissom_identity();
    for (int frame = 0; frame < 3 && status == LISSOM_BASIS_OK; ++frame) {
        lissom_basis_local(&basis, map.m, transforms.data());
        lissom_basis_evaluate(&basis, transforms.data(), 0, basis.vertex_count, out.data(), stride);
        lissom_basis_scatter(&basis, transforms.data(), 0, basis.vertex_count, out.data(), stride);
    }
    const long taken = allocations() - before;
    CHECK(status == LISSOM_BASIS_OK);
    CHECK(basis.vertex_count > 100);
    CHECK(taken == 0);
}

}  // namespace lissom::test
