#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <string>

#include "bindings/engine/lissom_basis.h"
#include "kernel/deform/deformer.h"
#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/query/region_select.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/c/host.h"

namespace lissom::test {
namespace {

lissom_region region_of(const Host& host, lissom_mesh mesh, const Region& region) {
    const auto& ids = region.vertices();
    const lissom_input list{ids.data(), ids.size(), 0, LISSOM_INT32};
    lissom_region made{};
    REQUIRE(lissom_region_of_vertices(host, mesh, &list, &made) == LISSOM_OK);
    return made;
}

struct Bend {
    explicit Bend(const Host& host, const Mesh& shape) : mesh(host.add(shape)) {
        lissom_region all{};
        REQUIRE(lissom_region_all(host, mesh, &all) == LISSOM_OK);
        REQUIRE(lissom_deformer_create(host, mesh, all, nullptr, &deformer) == LISSOM_OK);
        const Region* ends[] = {shape.find_region("bottom"), shape.find_region("top")};
        std::int32_t* handles[] = {&bottom, &top};
        for (int i = 0; i < 2; ++i) {
            const lissom_region end = region_of(host, mesh, *ends[i]);
            REQUIRE(lissom_deformer_add_handle(host, deformer, end, nullptr, handles[i]) ==
                    LISSOM_OK);
        }
    }

    lissom_mesh mesh{};
    lissom_deformer deformer{};
    std::int32_t bottom = -1, top = -1;
};

}  // namespace

TEST_CASE("a deformation is that of the kernel, to the bit") {
    const Mesh bar = make_bar({});
    const Host host;
    const Bend bend(host, bar);
    double center[3];
    REQUIRE(lissom_deformer_handle_center(host, bend.deformer, bend.top, center) == LISSOM_OK);
    const Affine map = rotation(Vec3::UnitZ(), 1.0, Vec3(center[0], center[1], center[2]));
    const lissom_transform transform = transform_of(map);
    REQUIRE(lissom_deformer_set_transform(host, bend.deformer, bend.top, &transform) == LISSOM_OK);
    REQUIRE(lissom_deformer_solve(host, bend.deformer, LISSOM_FULL) == LISSOM_OK);

    Deformer edit(bar, Region::all(bar.shared_topology()));
    edit.add_handle(*bar.find_region("bottom"));
    edit.set_transform(edit.add_handle(*bar.find_region("top")), map);
    const std::vector<Vec3>& expected = edit.solve();

    std::vector<Vec3> rows(at(lissom_deformer_row_count(host, bend.deformer)));
    const lissom_output out{rows.data(), rows.size(), 0, LISSOM_FLOAT64};
    REQUIRE(lissom_deformer_read_positions(host, bend.deformer, &out) == LISSOM_OK);
    CHECK(rows == expected);
    REQUIRE(lissom_deformer_apply(host, bend.deformer, bend.mesh) == LISSOM_OK);
    CHECK(host.positions(bend.mesh) == expected);

    // As floats into the middle of an engine's vertices.
    struct Vertex {
        float uv[2], position[3];
    };
    std::vector<Vertex> vertices(rows.size());
    const lissom_output floats{vertices[0].position, vertices.size(), sizeof(Vertex),
                               LISSOM_FLOAT32};
    REQUIRE(lissom_deformer_read_positions(host, bend.deformer, &floats) == LISSOM_OK);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        CHECK(vertices[i].position[1] == static_cast<float>(rows[i].y()));
        CHECK(vertices[i].uv[0] == 0.0f);
    }
}

TEST_CASE("a deformer without a region deforms all of the mesh, and a pin holds") {
    const Mesh bar = make_bar({});
    const Host host;
    const lissom_mesh mesh = host.add(bar);
    const lissom_region bottom = region_of(host, mesh, *bar.find_region("bottom"));
    const lissom_region top = region_of(host, mesh, *bar.find_region("top"));
    lissom_deformer deformer{};
    REQUIRE(lissom_deformer_create(host, mesh, {0}, nullptr, &deformer) == LISSOM_OK);
    CHECK(lissom_deformer_row_count(host, deformer) == bar.vertex_count());
    REQUIRE(lissom_deformer_pin(host, deformer, bottom) == LISSOM_OK);
    CHECK(lissom_deformer_pin(host, deformer, bottom) == LISSOM_HANDLE_OVERLAP);
    std::int32_t handle = -1;
    REQUIRE(lissom_deformer_add_handle(host, deformer, top, nullptr, &handle) == LISSOM_OK);
    const lissom_transform up = transform_of(translation({0.0, 1.0, 0.0}));
    REQUIRE(lissom_deformer_set_transform(host, deformer, handle, &up) == LISSOM_OK);
    REQUIRE(lissom_deformer_solve(host, deformer, LISSOM_FULL) == LISSOM_OK);
    REQUIRE(lissom_deformer_apply(host, deformer, mesh) == LISSOM_OK);
    const std::vector<Vec3> moved = host.positions(mesh);
    for (const Index v : bar.find_region("bottom")->vertices())
        CHECK(moved[at(v)] == bar.position(v));
    CHECK(moved != std::vector<Vec3>(bar.positions().begin(), bar.positions().end()));
}

TEST_CASE("normals of a deformation's rows are those of the mesh that it is applied to") {
    const Mesh bar = make_bar({});
    const Host host;
    const Bend bend(host, bar);
    const lissom_transform transform = transform_of(rotation(Vec3::UnitZ(), 1.0, Vec3(0, 3, 0)));
    REQUIRE(lissom_deformer_set_transform(host, bend.deformer, bend.top, &transform) == LISSOM_OK);
    REQUIRE(lissom_deformer_solve(host, bend.deformer, LISSOM_DRAFT) == LISSOM_OK);
    std::vector<Vec3> rows(at(lissom_deformer_row_count(host, bend.deformer))), whole = rows;
    const lissom_output of_rows{rows.data(), rows.size(), 0, LISSOM_FLOAT64};
    const lissom_output of_mesh{whole.data(), whole.size(), 0, LISSOM_FLOAT64};
    REQUIRE(lissom_deformer_read_normals(host, bend.deformer, &of_rows) == LISSOM_OK);
    REQUIRE(lissom_deformer_apply(host, bend.deformer, bend.mesh) == LISSOM_OK);
    REQUIRE(lissom_mesh_read_normals(host, bend.mesh, &of_mesh) == LISSOM_OK);
    for (std::size_t i = 0; i < rows.size(); ++i) CHECK((rows[i] - whole[i]).norm() < 1e-13);

    const lissom_output short_list{rows.data(), 3, 0, LISSOM_FLOAT64};
    CHECK(lissom_deformer_read_normals(host, bend.deformer, &short_list) == LISSOM_OUT_OF_RANGE);
    CHECK(lissom_deformer_read_normals(host, bend.deformer, nullptr) == LISSOM_INVALID_ARGUMENT);
}

TEST_CASE("errors of a deformation leave it as it was") {
    const Mesh bar = make_bar({});
    const Host host;
    const Bend bend(host, bar);
    const lissom_transform flat{};
    CHECK(lissom_deformer_set_transform(host, bend.deformer, bend.top, &flat) ==
          LISSOM_SINGULAR_TRANSFORM);
    CHECK(lissom_deformer_set_transform(host, bend.deformer, 99, &flat) == LISSOM_HANDLE_REMOVED);
    lissom_region all{};
    REQUIRE(lissom_region_all(host, bend.mesh, &all) == LISSOM_OK);
    std::int32_t handle = -1;
    CHECK(lissom_deformer_add_handle(host, bend.deformer, all, nullptr, &handle) ==
          LISSOM_HANDLE_OVERLAP);
    CHECK(lissom_last_error(host)->element == LISSOM_VERTEX);
    CHECK(lissom_last_error(host)->id_count > 0);
    CHECK(handle == -1);
    CHECK(lissom_deformer_solve(host, bend.deformer, static_cast<lissom_quality>(3)) ==
          LISSOM_INVALID_ARGUMENT);
    REQUIRE(lissom_deformer_solve(host, bend.deformer, LISSOM_FULL) == LISSOM_OK);
    std::vector<Vec3> rows(bar.positions().size());
    const lissom_output out{rows.data(), rows.size(), 0, LISSOM_FLOAT64};
    REQUIRE(lissom_deformer_read_positions(host, bend.deformer, &out) == LISSOM_OK);
    CHECK(std::equal(rows.begin(), rows.end(), bar.positions().begin()));
}

TEST_CASE("the mesh of a deformer may be released") {
    const Host host;
    const Bend bend(host, make_bar({}));
    REQUIRE(lissom_mesh_release(host, bend.mesh) == LISSOM_OK);
    CHECK(lissom_deformer_solve(host, bend.deformer, LISSOM_DRAFT) == LISSOM_OK);
    lissom_bytes basis{};
    REQUIRE(lissom_deformer_encode_basis(host, bend.deformer, &basis) == LISSOM_OK);
    CHECK(std::string(static_cast<const char*>(basis.data), 8) == "LSMBASIS");
}

TEST_CASE("a basis with key poses gives frames of full solutions in the host's space, z up too") {
    for (const bool z_up : {false, true}) {
        CAPTURE(z_up);
        lissom_context_options options = lissom_default_context_options();
        options.space.z_up = z_up;
        const Host host(options);
        const Bend bend(host, make_bar({}));
        double center[3];
        REQUIRE(lissom_deformer_handle_center(host, bend.deformer, bend.top, center) == LISSOM_OK);
        std::vector<lissom_transform> keys;
        for (const double angle : {-1.5, 0.8, 1.6}) {
            keys.push_back(lissom_identity());
            keys.push_back(transform_of(
                rotation(Vec3(0.2, 0.4, 1), angle, Vec3(center[0], center[1], center[2]))));
        }
        const std::vector<Vec3> before = host.positions(bend.mesh);
        lissom_bytes bytes{};
        REQUIRE(lissom_deformer_encode_keyed_basis(host, bend.deformer, keys.data(), keys.size(), 3,
                                                   &bytes) == LISSOM_OK);
        const std::string file(static_cast<const char*>(bytes.data), bytes.size);
        lissom_basis basis;
        REQUIRE(lissom_basis_open(&basis, file.data(), file.size()) == LISSOM_BASIS_OK);
        CHECK(basis.key_count == 3);
        std::vector<float> local(24), points(3 * std::size_t{basis.vertex_count});
        std::vector<Vec3> rows(basis.vertex_count);
        for (std::size_t k = 0; k < 3; ++k) {
            for (std::size_t h = 0; h < 2; ++h) {
                lissom_basis_local(&basis, keys[2 * k + h].m, &local[12 * h]);
            }
            lissom_basis_evaluate(&basis, local.data(), 0, basis.vertex_count, points.data(), 12);
            REQUIRE(lissom_deformer_set_transform(host, bend.deformer, bend.top,
                                                  &keys[2 * k + 1]) == LISSOM_OK);
            REQUIRE(lissom_deformer_solve(host, bend.deformer, LISSOM_FULL) == LISSOM_OK);
            const lissom_output out{rows.data(), rows.size(), 0, LISSOM_FLOAT64};
            REQUIRE(lissom_deformer_read_positions(host, bend.deformer, &out) == LISSOM_OK);
            double worst = 0.0;
            for (std::size_t i = 0; i < rows.size(); ++i) {
                const Vec3 p(points[3 * i], points[3 * i + 1], points[3 * i + 2]);
                const Vec3 o(basis.origin[0], basis.origin[1], basis.origin[2]);
                worst = std::max(worst, (p + o - rows[i]).norm());
            }
            CHECK(worst < 1e-4);
        }
        CHECK(lissom_deformer_encode_keyed_basis(host, bend.deformer, keys.data(), 5, 3, &bytes) ==
              LISSOM_INVALID_ARGUMENT);
        CHECK(lissom_deformer_encode_keyed_basis(host, bend.deformer, nullptr, 6, 3, &bytes) ==
              LISSOM_INVALID_ARGUMENT);
    }
}

TEST_CASE("a report names the harm that a deformation did, and keeps to the host's struct") {
    const Mesh bar = make_bar({});
    const Host host;
    const Bend bend(host, bar);
    double center[3];
    REQUIRE(lissom_deformer_handle_center(host, bend.deformer, bend.top, center) == LISSOM_OK);
    const auto reported = [&](double angle, bool crossings) {
        const lissom_transform transform =
            transform_of(rotation(Vec3::UnitZ(), angle, Vec3(center[0], center[1], center[2])) *
                         translation(Vec3(angle > 2.0 ? -6.0 : 0.0, 0.0, 0.0)));
        REQUIRE(lissom_deformer_set_transform(host, bend.deformer, bend.top, &transform) ==
                LISSOM_OK);
        REQUIRE(lissom_deformer_solve(host, bend.deformer, LISSOM_FULL) == LISSOM_OK);
        lissom_deform_report report = lissom_default_deform_report();
        REQUIRE(lissom_deformer_report(host, bend.deformer, bend.mesh, crossings, &report) ==
                LISSOM_OK);
        return report;
    };
    const lissom_deform_report good = reported(0.5, true);
    CHECK(good.harms == 0);
    CHECK(good.warnings == std::string());
    CHECK(good.stretch > 1.0);
    CHECK(good.stretched[0] >= 0);
    CHECK(good.crossings == 0);
    CHECK(std::abs(good.volume_change) < 0.2);
    CHECK(reported(0.5, false).crossings == -1);

    const lissom_deform_report bad = reported(3.1, true);
    CHECK(bad.harms != 0);
    CHECK(((bad.harms & LISSOM_HARM_CROSSING) != 0) == (bad.crossings > 0));
    CHECK(((bad.harms & LISSOM_HARM_FOLDED) != 0) == (bad.flipped > 0));
    const std::string warnings = bad.warnings;
    CHECK(std::count(warnings.begin(), warnings.end(), '\n') == std::popcount(bad.harms));

    lissom_deform_report small = lissom_default_deform_report();
    small.struct_size = offsetof(lissom_deform_report, flipped);
    small.flipped = 77;
    REQUIRE(lissom_deformer_report(host, bend.deformer, bend.mesh, false, &small) == LISSOM_OK);
    CHECK(small.stretch == bad.stretch);
    CHECK(small.flipped == 77);
    CHECK(lissom_deformer_report(host, bend.deformer, host.add(make_bar({1.0, 2.0, 3, 4})), false,
                                 &small) == LISSOM_TOPOLOGY_MISMATCH);
    CHECK(lissom_deformer_report(host, bend.deformer, bend.mesh, false, nullptr) ==
          LISSOM_INVALID_ARGUMENT);
}

TEST_CASE("contacts are found, stop a drag, or are pushed apart") {
    const Host host;
    const Mesh bar = make_bar({.width = 1.0, .length = 8.0, .across = 8, .along = 64});
    const Bend bend(host, bar);
    const lissom_deformer deformer = bend.deformer;
    const lissom_mesh mesh = bend.mesh;
    const Vec3 top(0.0, bounds(bar).max.y(), 0.0);
    // Bends the upper end over, and lays it into the lower one.
    const auto pose = [&](double share) {
        Affine map = rotation(Vec3::UnitZ(), 3.1 * share, top);
        map.translation += share * Vec3(-0.4, -7.2, 0.0);
        const lissom_transform transform = transform_of(map);
        REQUIRE(lissom_deformer_set_transform(host, deformer, bend.top, &transform) == LISSOM_OK);
    };
    lissom_contacts contacts{};
    for (const double share : {0.5, 1.0}) {
        pose(share);
        REQUIRE(lissom_deformer_solve(host, deformer, LISSOM_FULL) == LISSOM_OK);
    }
    REQUIRE(lissom_deformer_find_contacts(host, deformer, mesh, &contacts) == LISSOM_OK);
    REQUIRE(contacts.count > 10);
    for (std::size_t i = 0; i < contacts.count; ++i) {
        CHECK(contacts.faces[2 * i] < contacts.faces[2 * i + 1]);
    }
    const auto through = static_cast<int32_t>(contacts.count);
    int32_t before = -1;
    REQUIRE(lissom_deformer_solve_avoiding_contacts(host, deformer, mesh, &before, &contacts) ==
            LISSOM_OK);
    CHECK(before == through);
    CHECK(contacts.count < static_cast<std::size_t>(through) / 2);

    pose(0.5);
    REQUIRE(lissom_deformer_solve(host, deformer, LISSOM_FULL) == LISSOM_OK);
    pose(1.0);
    double share = -1.0;
    REQUIRE(lissom_deformer_solve_until_contact(host, deformer, mesh, &share, &contacts) ==
            LISSOM_OK);
    CHECK(share > 0.0);
    CHECK(share < 1.0);
    CHECK(contacts.count > 0);
    REQUIRE(lissom_deformer_find_contacts(host, deformer, mesh, &contacts) == LISSOM_OK);
    CHECK(contacts.count == 0);

    const lissom_mesh other = host.add(make_bar({1.0, 2.0, 3, 4}));
    CHECK(lissom_deformer_find_contacts(host, deformer, other, &contacts) ==
          LISSOM_TOPOLOGY_MISMATCH);
    CHECK(lissom_deformer_find_contacts(host, deformer, mesh, nullptr) == LISSOM_INVALID_ARGUMENT);
    CHECK(lissom_deformer_solve_until_contact(host, deformer, mesh, nullptr, nullptr) ==
          LISSOM_INVALID_ARGUMENT);
}

TEST_CASE("parts that nothing holds are an error, stay or follow, as the options say") {
    const Mesh bar = make_bar({});
    Mesh both = bar;
    Mesh button = make_box({.size = Vec3::Constant(0.1)});
    const Vec3 beside = bar.position(bar.find_region("top")->vertices()[0]) + Vec3(0.5, -0.1, 0.0);
    for (Vec3& p : button.edit_positions()) p += beside;
    append(both, button);
    const Index first = bar.vertex_count();
    const Host host;
    const lissom_mesh mesh = host.add(both);
    const std::vector<Vec3> rest = host.positions(mesh);
    const auto solved = [&](lissom_deformer_options options, std::vector<Vec3>& moved) {
        lissom_deformer deformer{};
        std::int32_t top = -1;
        REQUIRE(lissom_deformer_create(host, mesh, {0}, &options, &deformer) == LISSOM_OK);
        REQUIRE(lissom_deformer_pin(host, deformer,
                                    region_of(host, mesh, *bar.find_region("bottom"))) ==
                LISSOM_OK);
        REQUIRE(lissom_deformer_add_handle(host, deformer,
                                           region_of(host, mesh, *bar.find_region("top")), nullptr,
                                           &top) == LISSOM_OK);
        lissom_transform map = lissom_identity();
        map.m[3] = 0.3;
        REQUIRE(lissom_deformer_set_transform(host, deformer, top, &map) == LISSOM_OK);
        const lissom_status status = lissom_deformer_solve(host, deformer, LISSOM_FULL);
        moved = rest;
        const lissom_output out{moved.data(), moved.size(), sizeof(Vec3), LISSOM_FLOAT64};
        if (status == LISSOM_OK) {
            REQUIRE(lissom_deformer_read_positions(host, deformer, &out) == LISSOM_OK);
        }
        return status;
    };
    std::vector<Vec3> moved;
    auto options = lissom_default_deformer_options();
    CHECK(solved(options, moved) == LISSOM_UNCONSTRAINED);
    options.loose = LISSOM_LOOSE_STAY;
    CHECK(solved(options, moved) == LISSOM_OK);
    CHECK(moved[at(first)] == rest[at(first)]);
    options.loose = LISSOM_LOOSE_FOLLOW;
    CHECK(solved(options, moved) == LISSOM_OK);
    CHECK((moved[at(first)] - rest[at(first)]).norm() > 0.1);

    // A program whose header knows neither: its struct ends in padding.
    options.struct_size = offsetof(lissom_deformer_options, free_rings);
    CHECK(solved(options, moved) == LISSOM_UNCONSTRAINED);

    options = lissom_default_deformer_options();
    lissom_deformer refused{};
    options.loose = static_cast<lissom_loose_parts>(7);
    CHECK(lissom_deformer_create(host, mesh, {0}, &options, &refused) == LISSOM_INVALID_ARGUMENT);
    options.loose = LISSOM_LOOSE_ERROR;
    options.level_vertices = 50;
    CHECK(lissom_deformer_create(host, mesh, {0}, &options, &refused) == LISSOM_INVALID_ARGUMENT);
    options.level_vertices = 0;
    for (const std::int32_t rings : {-1, 11}) {
        options.free_rings = rings;
        CHECK(lissom_deformer_create(host, mesh, {0}, &options, &refused) ==
              LISSOM_INVALID_ARGUMENT);
    }
}

}  // namespace lissom::test
