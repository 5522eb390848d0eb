// Memory that runs out at any allocation of any call: a status, nothing leaked, all objects as
// before.
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <random>
#include <regex>
#include <set>

#include "tests/unit/c/memory/failing_malloc.h"
#include "tests/unit/c/world.h"

namespace lissom::test {
namespace {

// Allocations of a call that fail in turn; a quarter as many random ones of those beyond fail too.
long every_allocation() {
    const char* given = std::getenv("LISSOM_TRIALS");
    return given ? std::atol(given) : 60;
}

struct MemoryCase {
    const char* function;
    /// Makes the objects of a trial anew.
    std::function<void(World&)> prepare;
    std::function<lissom_status(World&)> call;
};

// The status of a function that returns a number.
lissom_status status_of_count(const World& world, std::int32_t count) {
    return count >= 0 ? LISSOM_OK : lissom_last_error(world)->status;
}

const char kObj[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
const double kPoints[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
const double kUp[] = {0, 1, 0};
double room[30000];
std::int32_t integers[30000];

lissom_output doubles_out() {
    return {room, std::size(room) / 3, 0, LISSOM_FLOAT64};
}
lissom_output integers_out() {
    return {integers, std::size(integers) / 3, 0, LISSOM_INT32};
}

void nothing(World&) {}
void fresh_deformer(World& world) {
    world.make_deformer();
}
void posed_deformer(World& world) {
    world.make_deformer();
    std::int32_t handle = -1;
    REQUIRE(lissom_deformer_add_handle(world, world.deformer, world.top, nullptr, &handle) ==
            LISSOM_OK);
    lissom_transform map = lissom_identity();
    map.m[3] = 0.5;
    REQUIRE(lissom_deformer_set_transform(world, world.deformer, handle, &map) == LISSOM_OK);
}
void solved_deformer(World& world) {
    posed_deformer(world);
    REQUIRE(lissom_deformer_solve(world, world.deformer, LISSOM_FULL) == LISSOM_OK);
}
void fresh_halves(World& world) {
    world.make_halves();
}
void fresh_paste(World& world) {
    world.make_paste();
}
void fresh_style(World& world) {
    world.make_style();
}
void solved_style(World& world) {
    if (world.style.id == 0) world.make_style();
    REQUIRE(lissom_hairstyle_solve(world, world.style) == LISSOM_OK);
}
void one_style(World& world) {
    if (world.style.id == 0) world.make_style();
}
void some_strands(World& world) {
    if (world.strands.id == 0) world.make_strands();
}

void add_mesh_cases(std::vector<MemoryCase>& all) {
    const auto add = [&](const char* name, std::function<lissom_status(World&)> call) {
        all.push_back({name, nothing, std::move(call)});
    };
    add("lissom_mesh_create", [](World& world) {
        static const std::int32_t kCorners[] = {0, 1, 2};
        const lissom_input p = triples(kPoints, 3), c{kCorners, 3, 0, LISSOM_INT32};
        return lissom_mesh_create(world, &p, &c, nullptr, &world.made_mesh);
    });
    add("lissom_mesh_load",
        [](World& world) { return lissom_mesh_load(world, "any.obj", nullptr, &world.made_mesh); });
    for (const char* extension : {"obj", "ply", "off", "stl", "glb"}) {
        add("lissom_mesh_encode", [extension](World& world) {
            return lissom_mesh_encode(world, world.bar, extension, nullptr, &world.bytes);
        });
        all.push_back({"lissom_mesh_decode",
                       [extension](World& world) {
                           REQUIRE(lissom_mesh_encode(world, world.bar, extension, nullptr,
                                                      &world.bytes) == LISSOM_OK);
                       },
                       [extension](World& world) {
                           static char copy[200000];
                           const std::size_t size = world.bytes.size;
                           if (size > 0) std::memcpy(copy, world.bytes.data, size);
                           const lissom_status status = lissom_mesh_decode(
                               world, copy, size, extension, nullptr, &world.made_mesh);
                           return status;
                       }});
    }
    add("lissom_mesh_save",
        [](World& world) { return lissom_mesh_save(world, world.bar, "any.obj", nullptr); });
    add("lissom_mesh_copy",
        [](World& world) { return lissom_mesh_copy(world, world.bar, &world.made_mesh); });
    add("lissom_mesh_vertex_count", [](World& world) {
        return status_of_count(world, lissom_mesh_vertex_count(world, world.bar));
    });
    add("lissom_mesh_face_count", [](World& world) {
        return status_of_count(world, lissom_mesh_face_count(world, world.bar));
    });
    add("lissom_mesh_corner_count", [](World& world) {
        return status_of_count(world, lissom_mesh_corner_count(world, world.bar));
    });
    add("lissom_mesh_triangle_count", [](World& world) {
        return status_of_count(world, lissom_mesh_triangle_count(world, world.bar));
    });
    add("lissom_mesh_boundary_count", [](World& world) {
        return status_of_count(world, lissom_mesh_boundary_count(world, world.bar));
    });
    add("lissom_mesh_read_positions", [](World& world) {
        const lissom_output out = doubles_out();
        return lissom_mesh_read_positions(world, world.bar, &out);
    });
    add("lissom_mesh_read_normals", [](World& world) {
        const lissom_output out = doubles_out();
        return lissom_mesh_read_normals(world, world.bar, &out);
    });
    add("lissom_mesh_read_triangles", [](World& world) {
        const lissom_output out = integers_out();
        return lissom_mesh_read_triangles(world, world.bar, &out);
    });
    add("lissom_mesh_read_faces", [](World& world) {
        const lissom_output out = integers_out();
        return lissom_mesh_read_faces(world, world.bar, &out, nullptr);
    });
    all.push_back({"lissom_mesh_read_boundary", fresh_halves, [](World& world) {
                       const lissom_output out = integers_out();
                       std::int32_t count = 0;
                       return lissom_mesh_read_boundary(world, world.half, 0, &out, &count);
                   }});
    add("lissom_mesh_set_positions", [](World& world) {
        const lissom_output out = doubles_out();
        const std::int32_t count = lissom_mesh_vertex_count(world, world.bar);
        if (count < 0) return lissom_last_error(world)->status;
        const lissom_status status = lissom_mesh_read_positions(world, world.bar, &out);
        if (status != LISSOM_OK) return status;
        const lissom_input in = triples(room, at(count));
        return lissom_mesh_set_positions(world, world.bar, &in);
    });
    add("lissom_mesh_transform", [](World& world) {
        const lissom_transform map = lissom_identity();
        return lissom_mesh_transform(world, world.bar, &map);
    });
    add("lissom_mesh_bounds",
        [](World& world) { return lissom_mesh_bounds(world, world.bar, room, room + 3); });
    add("lissom_mesh_hash", [](World& world) {
        std::uint64_t hash = 0;
        return lissom_mesh_hash(world, world.bar, &hash);
    });
    add("lissom_mesh_release", [](World& world) {
        const lissom_status status = lissom_mesh_release(world, {77});
        return status == LISSOM_INVALID_HANDLE ? LISSOM_OK : status;
    });
}

void mapped(World& world) {
    world.make_map();
}

void add_buffer_cases(std::vector<MemoryCase>& all) {
    const auto add = [&](const char* name, std::function<lissom_status(World&)> call) {
        all.push_back({name, mapped, std::move(call)});
    };
    const auto numbers_out = [] {
        return lissom_output{room, std::size(room) / 4, 0, LISSOM_FLOAT64};
    };
    add("lissom_mesh_create_welded", [](World& world) {
        static const std::uint16_t kCorners[] = {0, 1, 2};
        lissom_buffer buffer = lissom_default_buffer();
        buffer.positions = triples(kPoints, 3);
        buffer.normals = triples(kPoints, 3);
        buffer.uvs = {kPoints, 3, 0, LISSOM_FLOAT64};
        buffer.corners = {kCorners, 3, 0, LISSOM_UINT16};
        return lissom_mesh_create_welded(world, &buffer, &world.made_mesh, &world.made_map);
    });
    add("lissom_render_map_create",
        [](World& world) { return lissom_render_map_create(world, world.bar, &world.made_map); });
    add("lissom_render_map_size", [](World& world) {
        return status_of_count(world, lissom_render_map_size(world, world.map));
    });
    add("lissom_render_map_triangle_count", [](World& world) {
        return status_of_count(world, lissom_render_map_triangle_count(world, world.map));
    });
    add("lissom_render_map_read_vertices", [](World& world) {
        const lissom_output out = integers_out();
        return lissom_render_map_read_vertices(world, world.map, &out);
    });
    add("lissom_render_map_read_triangles", [](World& world) {
        const lissom_output out = integers_out();
        return lissom_render_map_read_triangles(world, world.map, world.bar, &out);
    });
    add("lissom_render_map_read_positions", [=](World& world) {
        const lissom_output out = numbers_out();
        return lissom_render_map_read_positions(world, world.map, world.bar, &out);
    });
    add("lissom_render_map_read_normals", [=](World& world) {
        const lissom_output out = numbers_out();
        return lissom_render_map_read_normals(world, world.map, world.bar, &out);
    });
    add("lissom_render_map_read_tangents", [=](World& world) {
        const lissom_output out = numbers_out();
        return lissom_render_map_read_tangents(world, world.map, world.bar, nullptr, &out);
    });
    add("lissom_render_map_read_attribute", [=](World& world) {
        const lissom_output out = numbers_out();
        return lissom_render_map_read_attribute(world, world.map, world.bar, "uv", &out);
    });
    add("lissom_mesh_attribute_count", [](World& world) {
        return status_of_count(world, lissom_mesh_attribute_count(world, world.bar));
    });
    add("lissom_mesh_attribute", [](World& world) {
        lissom_attribute attribute = lissom_default_attribute();
        return lissom_mesh_attribute(world, world.bar, 0, &attribute);
    });
    add("lissom_mesh_find_attribute", [](World& world) {
        lissom_attribute attribute = lissom_default_attribute();
        return lissom_mesh_find_attribute(world, world.bar, "uv", &attribute);
    });
    add("lissom_mesh_read_attribute", [=](World& world) {
        const lissom_output out = numbers_out();
        return lissom_mesh_read_attribute(world, world.bar, "uv", &out);
    });
    add("lissom_mesh_write_attribute", [](World& world) {
        const std::int32_t count = lissom_mesh_vertex_count(world, world.bar);
        if (count < 0) return lissom_last_error(world)->status;
        std::memset(room, 0, sizeof room);
        const lissom_input in{room, at(count), 0, LISSOM_FLOAT64};
        return lissom_mesh_write_attribute(world, world.bar, "heat", LISSOM_ON_VERTICES, 1, &in);
    });
    add("lissom_mesh_remove_attribute",
        [](World& world) { return lissom_mesh_remove_attribute(world, world.bar, "heat"); });
    all.back().prepare = [](World& world) {
        mapped(world);
        std::memset(room, 0, sizeof room);
        const lissom_input in{room, at(lissom_mesh_vertex_count(world, world.bar)), 0,
                              LISSOM_FLOAT64};
        REQUIRE(lissom_mesh_write_attribute(world, world.bar, "heat", LISSOM_ON_VERTICES, 1, &in) ==
                LISSOM_OK);
    };
    add("lissom_mesh_label_count", [](World& world) {
        return status_of_count(world, lissom_mesh_label_count(world, world.bar, "material"));
    });
    add("lissom_mesh_label_name", [](World& world) {
        const char* name = nullptr;
        return lissom_mesh_label_name(world, world.bar, "material", 0, &name);
    });
    add("lissom_mesh_read_labels", [](World& world) {
        const lissom_output out{integers, std::size(integers), 0, LISSOM_INT32};
        return lissom_mesh_read_labels(world, world.bar, "material", &out);
    });
    add("lissom_mesh_write_labels", [](World& world) {
        const std::int32_t count = lissom_mesh_face_count(world, world.bar);
        if (count < 0) return lissom_last_error(world)->status;
        std::memset(integers, 0, sizeof integers);
        const lissom_input in{integers, at(count), 0, LISSOM_INT32};
        const char* names[] = {"wood"};
        return lissom_mesh_write_labels(world, world.bar, "material", names, 1, &in);
    });
    const auto merged = [](World& world) {
        world.make_halves();
        REQUIRE(lissom_merger_solve(world, world.merger, &world.made_mesh, nullptr) == LISSOM_OK);
    };
    add("lissom_mesh_read_vertex_origins", [](World& world) {
        const lissom_output out{integers, std::size(integers), 0, LISSOM_INT32};
        return lissom_mesh_read_vertex_origins(world, world.made_mesh, &out, &out);
    });
    all.back().prepare = merged;
    add("lissom_mesh_read_face_origins", [](World& world) {
        const lissom_output out{integers, std::size(integers), 0, LISSOM_INT32};
        return lissom_mesh_read_face_origins(world, world.made_mesh, &out, &out);
    });
    all.back().prepare = merged;
}

void add_job_cases(std::vector<MemoryCase>& all) {
    const auto add = [&](const char* name, void (*prepare)(World&),
                         std::function<lissom_status(World&)> call) {
        all.push_back({name, prepare, std::move(call)});
    };
    static const double kPlace[] = {0, 0.13, 0};
    add("lissom_mesh_begin_create", nothing, [](World& world) {
        static const std::uint16_t kCorners[] = {0, 1, 2};
        lissom_buffer buffer = lissom_default_buffer();
        buffer.positions = triples(kPoints, 3);
        buffer.corners = {kCorners, 3, 0, LISSOM_UINT16};
        return lissom_mesh_begin_create(world, &buffer, &world.made_job);
    });
    add("lissom_mesh_begin_load", nothing, [](World& world) {
        return lissom_mesh_begin_load(world, "any.obj", nullptr, &world.made_job);
    });
    add("lissom_mesh_begin_save", nothing, [](World& world) {
        return lissom_mesh_begin_save(world, world.bar, "any.obj", nullptr, &world.made_job);
    });
    add("lissom_cut_begin_by_plane", nothing, [](World& world) {
        return lissom_cut_begin_by_plane(world, world.bar, kPlace, kUp, nullptr, &world.made_job);
    });
    add("lissom_cut_begin_by_region", fresh_halves, [](World& world) {
        return lissom_cut_begin_by_region(world, world.bar, world.top, nullptr, &world.made_job);
    });
    add("lissom_begin_merge", fresh_halves, [](World& world) {
        return lissom_begin_merge(world, world.half, world.other_half, nullptr, 0, nullptr,
                                  &world.made_job);
    });
    add("lissom_paste_begin_create", fresh_paste, [](World& world) {
        auto placement = lissom_default_placement();
        placement.at[0] = 2.0;
        return lissom_paste_begin_create(world, world.bump, world.ball, world.bump_region, {0}, {0},
                                         &placement, &world.made_job);
    });
    add("lissom_paste_begin_optimize", fresh_paste, [](World& world) {
        return lissom_paste_begin_optimize(world, world.paste, 1, &world.made_job);
    });
    add("lissom_paste_begin_merge", fresh_paste,
        [](World& world) { return lissom_paste_begin_merge(world, world.paste, &world.made_job); });
    add("lissom_erase", fresh_paste, [](World& world) {
        return lissom_erase(world, world.bump, world.bump_region, &world.made_mesh);
    });
    add("lissom_begin_erase", fresh_paste, [](World& world) {
        return lissom_begin_erase(world, world.bump, world.bump_region, &world.made_job);
    });
    add("lissom_hairstyle_begin_solve", fresh_style, [](World& world) {
        return lissom_hairstyle_begin_solve(world, world.style, &world.made_job);
    });
    add("lissom_strands_begin_load", some_strands,
        [](World& world) { return lissom_strands_begin_load(world, "any.usda", &world.made_job); });
    add("lissom_strands_begin_save", some_strands, [](World& world) {
        return lissom_strands_begin_save(world, world.strands, "any.hair", &world.made_job);
    });
    add("lissom_job_progress", nothing, [](World& world) {
        double fraction = 0.0;
        const lissom_status status = lissom_job_progress(world, {77}, &fraction, nullptr, 0);
        return status == LISSOM_INVALID_HANDLE ? LISSOM_OK : status;
    });
    add("lissom_job_finish_with", posed_deformer, [](World& world) {
        lissom_job job{};
        lissom_job_outcome outcome = lissom_default_job_outcome();
        const lissom_status status =
            lissom_deformer_begin_solve(world, world.deformer, LISSOM_FULL, &job);
        return status == LISSOM_OK ? lissom_job_finish_with(world, job, &outcome) : status;
    });
    add("lissom_move", nothing, [](World& world) {
        std::uint64_t moved = 0;
        const lissom_status status = lissom_move(world, 77, world, &moved);
        return status == LISSOM_INVALID_ARGUMENT ? LISSOM_OK : status;
    });
}

void add_region_cases(std::vector<MemoryCase>& all) {
    const auto add = [&](const char* name, std::function<lissom_status(World&)> call) {
        all.push_back({name, nothing, std::move(call)});
    };
    add("lissom_region_all",
        [](World& world) { return lissom_region_all(world, world.bar, &world.made_region); });
    add("lissom_region_of_vertices", [](World& world) {
        static const std::int32_t kIds[] = {3, 1, 2};
        const lissom_input list{kIds, 3, 0, LISSOM_INT32};
        return lissom_region_of_vertices(world, world.bar, &list, &world.made_region);
    });
    add("lissom_region_sphere", [](World& world) {
        return lissom_region_sphere(world, world.bar, kPoints, 1.0, &world.made_region);
    });
    add("lissom_region_box", [](World& world) {
        return lissom_region_box(world, world.bar, kPoints, kUp, &world.made_region);
    });
    add("lissom_region_plane", [](World& world) {
        return lissom_region_plane(world, world.bar, kPoints, kUp, &world.made_region);
    });
    add("lissom_region_geodesic", [](World& world) {
        return lissom_region_geodesic(world, world.bar, kPoints, 1.0, &world.made_region);
    });
    add("lissom_mesh_set_region",
        [](World& world) { return lissom_mesh_set_region(world, world.bar, "tip", world.top); });
    add("lissom_region_named", [](World& world) {
        return lissom_region_named(world, world.bar, "tip", &world.made_region);
    });
    all.back().prepare = [](World& world) {
        REQUIRE(lissom_mesh_set_region(world, world.bar, "tip", world.top) == LISSOM_OK);
    };
    add("lissom_region_combine", [](World& world) {
        return lissom_region_combine(world, world.top, world.bottom, LISSOM_UNION,
                                     &world.made_region);
    });
    add("lissom_region_invert",
        [](World& world) { return lissom_region_invert(world, world.top, &world.made_region); });
    add("lissom_region_grow",
        [](World& world) { return lissom_region_grow(world, world.top, 1, &world.made_region); });
    add("lissom_region_size",
        [](World& world) { return status_of_count(world, lissom_region_size(world, world.top)); });
    add("lissom_region_read_vertices", [](World& world) {
        const lissom_output out = integers_out();
        return lissom_region_read_vertices(world, world.top, &out);
    });
}

void add_deform_cases(std::vector<MemoryCase>& all) {
    all.push_back({"lissom_deformer_create", nothing, [](World& world) {
                       return lissom_deformer_create(world, world.bar, {0}, nullptr,
                                                     &world.made_deformer);
                   }});
    const auto add = [&](const char* name, void (*prepare)(World&),
                         std::function<lissom_status(World&)> call) {
        all.push_back({name, prepare, std::move(call)});
    };
    add("lissom_deformer_add_handle", fresh_deformer, [](World& world) {
        std::int32_t handle = -1;
        return lissom_deformer_add_handle(world, world.deformer, world.top, nullptr, &handle);
    });
    add("lissom_deformer_pin", fresh_deformer,
        [](World& world) { return lissom_deformer_pin(world, world.deformer, world.top); });
    add("lissom_deformer_remove_handle", posed_deformer, [](World& world) {
        return lissom_deformer_remove_handle(world, world.deformer, world.handle + 1);
    });
    add("lissom_deformer_handle_center", fresh_deformer, [](World& world) {
        return lissom_deformer_handle_center(world, world.deformer, world.handle, room);
    });
    add("lissom_deformer_set_transform", fresh_deformer, [](World& world) {
        lissom_transform map = lissom_identity();
        map.m[3] = 0.5;
        return lissom_deformer_set_transform(world, world.deformer, world.handle, &map);
    });
    add("lissom_deformer_get_transform", fresh_deformer, [](World& world) {
        lissom_transform map{};
        return lissom_deformer_get_transform(world, world.deformer, world.handle, &map);
    });
    add("lissom_deformer_constrain", fresh_deformer, [](World& world) {
        return lissom_deformer_constrain(world, world.deformer, 40, kUp, 0.0);
    });
    add("lissom_deformer_free", fresh_deformer,
        [](World& world) { return lissom_deformer_free(world, world.deformer, 40); });
    add("lissom_deformer_prepare", posed_deformer,
        [](World& world) { return lissom_deformer_prepare(world, world.deformer); });
    add("lissom_deformer_begin_prepare", posed_deformer, [](World& world) {
        return lissom_deformer_begin_prepare(world, world.deformer, &world.made_job);
    });
    for (const lissom_quality quality : {LISSOM_PREVIEW, LISSOM_DRAFT, LISSOM_FULL}) {
        add("lissom_deformer_solve", posed_deformer, [quality](World& world) {
            return lissom_deformer_solve(world, world.deformer, quality);
        });
    }
    add("lissom_deformer_begin_solve", posed_deformer, [](World& world) {
        return lissom_deformer_begin_solve(world, world.deformer, LISSOM_FULL, &world.made_job);
    });
    add("lissom_job_finish", posed_deformer, [](World& world) {
        lissom_job job{};
        const lissom_status status =
            lissom_deformer_begin_solve(world, world.deformer, LISSOM_FULL, &job);
        return status == LISSOM_OK ? lissom_job_finish(world, job, nullptr) : status;
    });
    add("lissom_job_poll", nothing, [](World& world) {
        lissom_job_state state{};
        const lissom_status status = lissom_job_poll(world, {77}, &state);
        return status == LISSOM_INVALID_HANDLE ? LISSOM_OK : status;
    });
    add("lissom_job_cancel", nothing, [](World& world) {
        const lissom_status status = lissom_job_cancel(world, {77});
        return status == LISSOM_INVALID_HANDLE ? LISSOM_OK : status;
    });
    add("lissom_deformer_row_count", fresh_deformer, [](World& world) {
        return status_of_count(world, lissom_deformer_row_count(world, world.deformer));
    });
    add("lissom_deformer_read_rows", fresh_deformer, [](World& world) {
        const lissom_output out = integers_out();
        return lissom_deformer_read_rows(world, world.deformer, &out);
    });
    add("lissom_deformer_read_positions", solved_deformer, [](World& world) {
        const lissom_output out = doubles_out();
        return lissom_deformer_read_positions(world, world.deformer, &out);
    });
    add("lissom_deformer_read_normals", solved_deformer, [](World& world) {
        const lissom_output out = doubles_out();
        return lissom_deformer_read_normals(world, world.deformer, &out);
    });
    add("lissom_deformer_apply", solved_deformer, [](World& world) {
        if (world.made_mesh.id == 0) return LISSOM_OK;
        return lissom_deformer_apply(world, world.deformer, world.made_mesh);
    });
    all.back().prepare = [](World& world) {
        solved_deformer(world);
        if (world.made_mesh.id == 0) {
            REQUIRE(lissom_mesh_copy(world, world.bar, &world.made_mesh) == LISSOM_OK);
        }
    };
    add("lissom_deformer_report", solved_deformer, [](World& world) {
        auto report = lissom_default_deform_report();
        return lissom_deformer_report(world, world.deformer, world.bar, true, &report);
    });
    add("lissom_deformer_find_contacts", solved_deformer, [](World& world) {
        lissom_contacts contacts{};
        return lissom_deformer_find_contacts(world, world.deformer, world.bar, &contacts);
    });
    add("lissom_deformer_solve_until_contact", posed_deformer, [](World& world) {
        double share = 0.0;
        return lissom_deformer_solve_until_contact(world, world.deformer, world.bar, &share,
                                                   nullptr);
    });
    add("lissom_deformer_solve_avoiding_contacts", posed_deformer, [](World& world) {
        lissom_contacts left{};
        return lissom_deformer_solve_avoiding_contacts(world, world.deformer, world.bar, nullptr,
                                                       &left);
    });
    add("lissom_deformer_reset", solved_deformer,
        [](World& world) { return lissom_deformer_reset(world, world.deformer); });
    add("lissom_deformer_rebase", solved_deformer,
        [](World& world) { return lissom_deformer_rebase(world, world.deformer); });
    add("lissom_deformer_solve_with_pins", posed_deformer, [](World& world) {
        static const lissom_sliding_pin kPin{20, LISSOM_PIN_PLANE, {0, 0, 0}, {1, 0, 0}, 0};
        double distance = 0.0;
        return lissom_deformer_solve_with_pins(world, world.deformer, &kPin, 1, &distance);
    });
    add("lissom_deformer_encode_basis", posed_deformer, [](World& world) {
        return lissom_deformer_encode_basis(world, world.deformer, &world.bytes);
    });
    add("lissom_deformer_encode_keyed_basis", posed_deformer, [](World& world) {
        static const lissom_transform kKey[] = {lissom_identity(),
                                                {{1, 0, 0, 0.2, 0, 0, -1, 0, 0, 1, 0, 0}}};
        return lissom_deformer_encode_keyed_basis(world, world.deformer, kKey, 2, 1, &world.bytes);
    });
}

void fresh_bones(World& world) {
    world.make_bones();
}

void add_bone_cases(std::vector<MemoryCase>& all) {
    const auto add = [&](const char* name, std::function<lissom_status(World&)> call) {
        all.push_back({name, fresh_bones, std::move(call)});
    };
    static const double kTarget[] = {1, 1, 0}, kAxis[] = {0, 0, 1};
    all.push_back({"lissom_deformer_add_bones", fresh_deformer, [](World& world) {
                       const double joints[] = {0, -1, 0, 0, 0.1, 0, 0, 2, 0};
                       const lissom_input list{joints, 3, 0, LISSOM_FLOAT64};
                       std::int32_t bones = -1;
                       return lissom_deformer_add_bones(world, world.deformer, world.bar, &list,
                                                        nullptr, &bones);
                   }});
    add("lissom_deformer_remove_bones",
        [](World& world) { return lissom_deformer_remove_bones(world, world.boned, world.bones); });
    add("lissom_deformer_turn_bone", [](World& world) {
        return lissom_deformer_turn_bone(world, world.boned, world.bones, 1, kAxis, 0.5);
    });
    add("lissom_deformer_reach_with_bones", [](World& world) {
        double distance = 0.0;
        return lissom_deformer_reach_with_bones(world, world.boned, world.bones, kTarget, kAxis,
                                                &distance);
    });
    static const double kCurve[] = {0, -2, 0, 1, 2, 0};
    static const lissom_input kCurvePoints{kCurve, 2, 0, LISSOM_FLOAT64};
    add("lissom_deformer_follow_with_bones", [](World& world) {
        return lissom_deformer_follow_with_bones(world, world.boned, world.bones, &kCurvePoints,
                                                 false, 0.5);
    });
    add("lissom_deformer_carry_handle", [](World& world) {
        return lissom_deformer_carry_handle(world, world.boned, world.bones, &kCurvePoints, -1.0,
                                            0.5, 0.0);
    });
    add("lissom_deformer_move_bones", [](World& world) {
        return lissom_deformer_move_bones(world, world.boned, world.bones, kTarget);
    });
    add("lissom_deformer_reset_bones",
        [](World& world) { return lissom_deformer_reset_bones(world, world.boned, world.bones); });
    add("lissom_deformer_joint_count", [](World& world) {
        return status_of_count(world, lissom_deformer_joint_count(world, world.boned, world.bones));
    });
    add("lissom_deformer_read_joints", [](World& world) {
        const lissom_output out = doubles_out();
        return lissom_deformer_read_joints(world, world.boned, world.bones, &out);
    });
}

void fresh_poses(World& world) {
    world.make_poses();
}

void add_pose_cases(std::vector<MemoryCase>& all) {
    const auto add = [&](const char* name, std::function<lissom_status(World&)> call) {
        all.push_back({name, fresh_poses, std::move(call)});
    };
    static const double kHalf = 0.5;
    static const lissom_input kWeights{&kHalf, 1, 0, LISSOM_FLOAT64};
    add("lissom_deformer_get_pose", [](World& world) {
        return lissom_deformer_get_pose(world, world.deformer, &world.made_pose);
    });
    add("lissom_deformer_set_pose",
        [](World& world) { return lissom_deformer_set_pose(world, world.deformer, world.pose); });
    add("lissom_deformer_set_blended_pose", [](World& world) {
        return lissom_deformer_set_blended_pose(world, world.deformer, world.pose, world.pose, 0.5);
    });
    add("lissom_pose_blend", [](World& world) {
        return lissom_pose_blend(world, world.pose, world.pose, 0.5, &world.made_pose);
    });
    add("lissom_pose_space_create", [](World& world) {
        const lissom_named_pose pose{"same", &world.bar, 1};
        return lissom_pose_space_create(world, world.bar, &pose, 1, &world.made_space);
    });
    add("lissom_pose_space_begin_create", [](World& world) {
        const lissom_named_pose pose{"same", &world.bar, 1};
        return lissom_pose_space_begin_create(world, world.bar, &pose, 1, &world.made_job);
    });
    add("lissom_pose_space_pose_count", [](World& world) {
        return status_of_count(world, lissom_pose_space_pose_count(world, world.space));
    });
    add("lissom_pose_space_vertex_count", [](World& world) {
        return status_of_count(world, lissom_pose_space_vertex_count(world, world.space));
    });
    add("lissom_pose_space_pose_name", [](World& world) {
        const char* name = nullptr;
        return lissom_pose_space_pose_name(world, world.space, 0, &name);
    });
    add("lissom_pose_space_read_positions", [](World& world) {
        const lissom_output out = doubles_out();
        return lissom_pose_space_read_positions(world, world.space, &kWeights, &out);
    });
    add("lissom_pose_space_blend", [](World& world) {
        return lissom_pose_space_blend(world, world.space, &kWeights, &world.made_mesh);
    });
    add("lissom_pose_space_targets", [](World& world) {
        return lissom_pose_space_targets(world, world.space, &kWeights, &world.made_mesh, nullptr);
    });
}

void add_merge_cases(std::vector<MemoryCase>& all) {
    const auto add = [&](const char* name, void (*prepare)(World&),
                         std::function<lissom_status(World&)> call) {
        all.push_back({name, prepare, std::move(call)});
    };
    add("lissom_cut_by_plane", nothing, [](World& world) {
        static const double kPlace[] = {0, 0.13, 0};
        return lissom_cut_by_plane(world, world.bar, kPlace, kUp, nullptr, &world.made_mesh,
                                   &world.made_rest);
    });
    add("lissom_cut_by_region", fresh_halves, [](World& world) {
        return lissom_cut_by_region(world, world.half, world.made_region, nullptr, &world.made_mesh,
                                    &world.made_rest);
    });
    all.back().prepare = [](World& world) {
        fresh_halves(world);
        const double pole[] = {0, 1, 0};
        REQUIRE(lissom_region_sphere(world, world.half, pole, 0.6, &world.made_region) ==
                LISSOM_OK);
    };
    add("lissom_merger_create", fresh_halves, [](World& world) {
        const lissom_join join{};
        return lissom_merger_create(world, world.half, &world.other_half, 1, &join, 1, nullptr,
                                    &world.made_merger);
    });
    add("lissom_merger_set_keys", fresh_halves, [](World& world) {
        return lissom_merger_set_keys(world, world.merger, 0, nullptr, nullptr, 0);
    });
    add("lissom_merger_solve", fresh_halves, [](World& world) {
        auto report = lissom_default_merge_report();
        return lissom_merger_solve(world, world.merger, &world.made_mesh, &report);
    });
    add("lissom_merger_begin_solve", fresh_halves, [](World& world) {
        return lissom_merger_begin_solve(world, world.merger, &world.made_job);
    });
    add("lissom_merge", fresh_halves, [](World& world) {
        auto report = lissom_default_merge_report();
        return lissom_merge(world, world.half, world.other_half, nullptr, 0, nullptr,
                            &world.made_mesh, &report);
    });
    add("lissom_paste_create", fresh_paste, [](World& world) {
        auto placement = lissom_default_placement();
        placement.at[0] = 2.0;
        return lissom_paste_create(world, world.bump, world.ball, world.bump_region, {0}, {0},
                                   &placement, &world.made_paste);
    });
    add("lissom_paste_optimize", fresh_paste,
        [](World& world) { return lissom_paste_optimize(world, world.paste, 2); });
    add("lissom_paste_move", fresh_paste, [](World& world) {
        auto placement = lissom_default_placement();
        placement.at[0] = 1.9;
        placement.at[1] = 0.2;
        return lissom_paste_move(world, world.paste, &placement);
    });
    add("lissom_paste_merge", fresh_paste, [](World& world) {
        auto report = lissom_default_merge_report();
        return lissom_paste_merge(world, world.paste, &world.made_mesh, &report);
    });
}

lissom_status create_style(World& world) {
    auto options = lissom_default_hairstyle_options();
    options.resolution = 1000;
    return lissom_hairstyle_create(world, world.head, &options, &world.made_style);
}

lissom_grow_options few_hairs() {
    auto options = lissom_default_grow_options();
    options.count = 20;
    return options;
}

double style_points[9];

void add_hair_cases(std::vector<MemoryCase>& all) {
    const auto add = [&](const char* name, void (*prepare)(World&),
                         std::function<lissom_status(World&)> call) {
        all.push_back({name, prepare, std::move(call)});
    };
    add("lissom_hairstyle_create", one_style, create_style);
    add("lissom_hairstyle_encode", one_style,
        [](World& world) { return lissom_hairstyle_encode(world, world.style, &world.bytes); });
    add("lissom_hairstyle_decode", one_style, [](World& world) {
        auto options = lissom_default_hairstyle_options();
        options.resolution = 1000;
        static const std::string kText = [&] {
            lissom_bytes bytes{};
            REQUIRE(lissom_hairstyle_encode(world, world.style, &bytes) == LISSOM_OK);
            return std::string(static_cast<const char*>(bytes.data), bytes.size);
        }();
        return lissom_hairstyle_decode(world, kText.data(), kText.size(), world.head, &options,
                                       &world.made_style);
    });
    add("lissom_hairstyle_at", one_style, [](World& world) {
        return lissom_hairstyle_at(world, world.style, 1.0, 0.5, 0.02, style_points);
    });
    add("lissom_hairstyle_normal_at", one_style, [](World& world) {
        return lissom_hairstyle_normal_at(world, world.style, 1.0, 0.5, room);
    });
    // A style that a failed call has left as before is used again.
    const auto curve_points = [](World& world) {
        if (world.style.id == 0 || lissom_hairstyle_curve_count(world, world.style) != 1) {
            world.make_style();
        }
        for (int i = 0; i < 3; ++i) {
            REQUIRE(lissom_hairstyle_at(world, world.style, -1.3, 1.0 - 0.5 * i, 0.02,
                                        style_points + 3 * i) == LISSOM_OK);
        }
    };
    add("lissom_hairstyle_add_stream", curve_points, [](World& world) {
        const lissom_input list = triples(style_points, 3);
        std::int32_t curve = -1;
        return lissom_hairstyle_add_stream(world, world.style, &list, &curve);
    });
    add("lissom_hairstyle_add_dividing", curve_points, [](World& world) {
        const lissom_input list = triples(style_points, 3);
        std::int32_t curve = -1;
        return lissom_hairstyle_add_dividing(world, world.style, &list, &curve);
    });
    add("lissom_hairstyle_add_ponytail", curve_points, [](World& world) {
        const lissom_input list = triples(style_points, 3);
        std::int32_t curve = -1;
        return lissom_hairstyle_add_ponytail(world, world.style, &list, 0.0, &curve);
    });
    add("lissom_curve_set_points", curve_points, [](World& world) {
        const lissom_input list = triples(style_points, 3);
        return lissom_curve_set_points(world, world.style, world.curve, &list);
    });
    add("lissom_curve_enable", fresh_style,
        [](World& world) { return lissom_curve_enable(world, world.style, world.curve, false); });
    add("lissom_curve_remove", fresh_style,
        [](World& world) { return lissom_curve_remove(world, world.style, world.curve); });
    add("lissom_hairstyle_curve_count", one_style, [](World& world) {
        return status_of_count(world, lissom_hairstyle_curve_count(world, world.style));
    });
    add("lissom_hairstyle_read_curves", one_style, [](World& world) {
        const lissom_output out = integers_out();
        return lissom_hairstyle_read_curves(world, world.style, &out);
    });
    add("lissom_hairstyle_solve", fresh_style,
        [](World& world) { return lissom_hairstyle_solve(world, world.style); });
    add("lissom_hairstyle_field", solved_style,
        [](World& world) { return lissom_hairstyle_field(world, world.style, kPoints, room); });
    add("lissom_hairstyle_grow", solved_style, [](World& world) {
        const auto options = few_hairs();
        return lissom_hairstyle_grow(world, world.style, &options, &world.made_strands);
    });
    add("lissom_hairstyle_grow", fresh_style, [](World& world) {
        const auto options = few_hairs();
        return lissom_hairstyle_grow(world, world.style, &options, &world.made_strands);
    });
    add("lissom_hairstyle_begin_grow", solved_style, [](World& world) {
        const auto options = few_hairs();
        return lissom_hairstyle_begin_grow(world, world.style, &options, &world.made_job);
    });
    add("lissom_strands_create", nothing, [](World& world) {
        static const std::int32_t kOffsets[] = {0, 3};
        const lissom_input list = triples(kPoints, 3), starts{kOffsets, 2, 0, LISSOM_INT32};
        return lissom_strands_create(world, &list, &starts, &world.made_strands);
    });
    add("lissom_hairstyle_unit", one_style,
        [](World& world) { return lissom_hairstyle_unit(world, world.style, room, room + 1); });
    add("lissom_strands_has", some_strands, [](World& world) {
        return status_of_count(world,
                               lissom_strands_has(world, world.strands, LISSOM_STRAND_WIDTH));
    });
    const auto plain_out = [] { return lissom_output{room, 100, 0, LISSOM_FLOAT64}; };
    const auto plain_in = [](std::size_t count) {
        std::memset(room, 0, sizeof room);
        return lissom_input{room, count, 0, LISSOM_FLOAT64};
    };
    add("lissom_strands_read", some_strands, [=](World& world) {
        const lissom_output out = plain_out();
        return lissom_strands_read(world, world.strands, LISSOM_STRAND_WIDTH, &out);
    });
    add("lissom_strands_read_at_points", some_strands, [=](World& world) {
        const lissom_output out = plain_out();
        return lissom_strands_read_at_points(world, world.strands, LISSOM_STRAND_WIDTH, &out);
    });
    add("lissom_strands_write", some_strands, [=](World& world) {
        const lissom_input in = plain_in(2);
        return lissom_strands_write(world, world.strands, LISSOM_STRAND_COLOR, &in);
    });
    add("lissom_strands_write_at_points", some_strands, [=](World& world) {
        const lissom_input in = plain_in(5);
        return lissom_strands_write_at_points(world, world.strands, LISSOM_STRAND_WIDTH, &in);
    });
    add("lissom_strands_set_points", some_strands, [=](World& world) {
        const lissom_input in = plain_in(5);
        return lissom_strands_set_points(world, world.strands, &in);
    });
    add("lissom_strands_set_groups", some_strands, [](World& world) {
        const char* names[] = {"fringe"};
        return lissom_strands_set_groups(world, world.strands, names, 1);
    });
    add("lissom_strands_group_count", some_strands, [](World& world) {
        return status_of_count(world, lissom_strands_group_count(world, world.strands));
    });
    add("lissom_strands_group_name", some_strands, [](World& world) {
        const char* name = nullptr;
        return lissom_strands_group_name(world, world.strands, 0, &name);
    });
    all.back().prepare = [](World& world) {
        some_strands(world);
        const char* names[] = {"fringe"};
        REQUIRE(lissom_strands_set_groups(world, world.strands, names, 1) == LISSOM_OK);
    };
    for (const char* path : {"any.hair", "any.usda", "any.glb", "any.obj", "any.rib"}) {
        add("lissom_strands_save", some_strands,
            [path](World& world) { return lissom_strands_save(world, world.strands, path); });
    }
    add("lissom_strands_load", some_strands,
        [](World& world) { return lissom_strands_load(world, "any.usda", &world.made_strands); });
    add("lissom_strands_size", some_strands, [](World& world) {
        return status_of_count(world, lissom_strands_size(world, world.strands));
    });
    add("lissom_strands_point_count", some_strands, [](World& world) {
        return status_of_count(world, lissom_strands_point_count(world, world.strands));
    });
    add("lissom_strands_read_points", some_strands, [](World& world) {
        const lissom_output out = doubles_out();
        return lissom_strands_read_points(world, world.strands, &out);
    });
    add("lissom_strands_read_offsets", some_strands, [](World& world) {
        const lissom_output out = integers_out();
        return lissom_strands_read_offsets(world, world.strands, &out);
    });
}

const char kScript[] =
    "local p = require('lissom').params{ size = { type = 'number', default = 2, help = 'Edge.' } "
    "}\n"
    "local box = require('lissom').shapes.box{ size = p.size }\n"
    "return box, { name = 'box', list = {1, 2, 3} }, ...";

void load_script(World& world) {
    if (world.script.id == 0) {
        REQUIRE(lissom_script_load(world, kScript, sizeof kScript - 1, "tool.lua", &world.script) ==
                LISSOM_OK);
    }
}

// Releases the mesh that stands first among results.
void take_first_mesh(World& world) {
    const std::string text(static_cast<const char*>(world.bytes.data), world.bytes.size);
    const std::size_t place = text.find("{\"object\":");
    if (place != std::string::npos) world.made_mesh.id = std::stoull(text.substr(place + 10));
}

void add_script_cases(std::vector<MemoryCase>& all) {
    if (!lissom_has_scripts()) return;
    const auto add = [&](const char* name, std::function<lissom_status(World&)> call) {
        all.push_back({name, load_script, std::move(call)});
    };
    add("lissom_script_load", [](World& world) {
        return lissom_script_load(world, kScript, sizeof kScript - 1, "tool.lua",
                                  &world.made_script);
    });
    add("lissom_script_parameters",
        [](World& world) { return lissom_script_parameters(world, world.script, &world.bytes); });
    add("lissom_script_set",
        [](World& world) { return lissom_script_set(world, world.script, "size", "3"); });
    add("lissom_script_run", [](World& world) {
        return lissom_script_run(world, world.script, "[1, {\"a\": [true, \"b\"]}]", &world.bytes);
    });
    add("lissom_script_begin_run", [](World& world) {
        return lissom_script_begin_run(world, world.script, "[1]", &world.made_job);
    });
    add("lissom_begin_call",
        [](World& world) { return lissom_begin_call(world, "shapes.box", "[]", &world.made_job); });
    add("lissom_numbers_create", [](World& world) {
        const lissom_input list = triples(kPoints, 3);
        lissom_object made{};
        const lissom_status status = lissom_numbers_create(world, &list, 3, &made);
        if (status == LISSOM_OK) lissom_object_release(world, made);
        return status;
    });
    add("lissom_numbers_size", [](World& world) {
        lissom_numbers_size(world, {77});
        const lissom_status status = lissom_last_error(world)->status;
        return status == LISSOM_INVALID_HANDLE ? LISSOM_OK : status;
    });
    add("lissom_numbers_width", [](World& world) {
        lissom_numbers_width(world, {77});
        const lissom_status status = lissom_last_error(world)->status;
        return status == LISSOM_INVALID_HANDLE ? LISSOM_OK : status;
    });
    add("lissom_numbers_read", [](World& world) {
        const lissom_output out = doubles_out();
        const lissom_status status = lissom_numbers_read(world, {77}, &out);
        return status == LISSOM_INVALID_HANDLE ? LISSOM_OK : status;
    });
    add("lissom_call", [](World& world) {
        return lissom_call(world, "shapes.box", "[{\"size\": 2}]", &world.bytes);
    });
}

// ---- What a call may do

bool read_tetrahedron(void*, const char* path, lissom_sink* sink, void* argument) {
    static const char kUsda[] =
        "#usda 1.0\ndef BasisCurves \"hair\"\n{\n    uniform token type = \"linear\"\n"
        "    int[] curveVertexCounts = [3]\n"
        "    point3f[] points = [(0, 0, 0), (0, 1, 0), (0, 2, 0)]\n}\n";
    const bool hair = std::strstr(path, ".usda") != nullptr;
    if (hair) {
        sink(argument, kUsda, sizeof kUsda - 1);
    } else {
        sink(argument, kObj, sizeof kObj - 1);
    }
    return true;
}

lissom_context_options host_options(int threads) {
    auto options = lissom_default_context_options();
    options.read_file = read_tetrahedron;
    options.write_file = [](void*, const char*, const void*, std::size_t) { return true; };
    options.threads = threads;
    return options;
}

void undo(World& world, bool done) {
    if (done && world.made_mesh.id == 0 && world.bytes.size > 0) take_first_mesh(world);
    world.bytes = {};
    world.drop();
}

// Lets allocation `n` fail; false once the call has none.
bool fail_once(World& world, const MemoryCase& one, long n, bool all) {
    one.prepare(world);
    const std::string before = world.content();
    fail_at(n, all);
    const lissom_status status = one.call(world);
    const bool failed = stop_failing();
    CAPTURE(n);
    CAPTURE(all);
    const lissom_error& error = *lissom_last_error(world);
    if (!failed || status != LISSOM_OK) {
        const bool right = status == (failed ? LISSOM_MEMORY_LIMIT : LISSOM_OK);
        CHECK_MESSAGE(right, std::string(lissom_status_name(status)), ": ",
                      std::string(error.message));
    }
    if (status != LISSOM_OK) {
        CHECK(error.status == status);
        CHECK(std::string(error.message) != "");
        CHECK(world.content() == before);
    }
    undo(world, status == LISSOM_OK);
    return failed;
}

// Allocations of a call that succeeds, which is undone.
long allocations_of(World& world, const MemoryCase& one) {
    one.prepare(world);
    const long before = allocations();
    CHECK(one.call(world) == LISSOM_OK);
    const long taken = allocations() - before;
    undo(world, true);
    return taken;
}

void fail_everywhere(World& world, const MemoryCase& one) {
    CAPTURE(std::string(one.function));
    const long count = allocations_of(world, one), first = every_allocation();
    if (std::getenv("LISSOM_SHOW_MEMORY")) {
        MESSAGE(std::string(one.function), ": ", count, " allocations");
    }
    for (long n = 0; n < first && fail_once(world, one, n, false); ++n) continue;
    std::mt19937 random(7);
    for (long i = 0; i < first / 4 && first < count; ++i) {
        fail_once(world, one, first + static_cast<long>(random() % at(index_of(count - first))),
                  false);
    }
    for (long all = 0; all < 5; ++all) fail_once(world, one, all, true);
    // And then it works.
    allocations_of(world, one);
}

// Blocks that a process keeps: messages and tables that are made when they are first needed.
constexpr long kKeptBlocks = 3;

using Add = void(std::vector<MemoryCase>&);

// All that a context had is freed with it: a second turn leaves as much as the first.
void check_cases(Add* add, int threads) {
    std::vector<MemoryCase> all;
    add(all);
    for (const MemoryCase& one : all) {
        CAPTURE(std::string(one.function));
        const auto turn = [&](bool failing) {
            World world(host_options(threads));
            one.prepare(world);
            CHECK(one.call(world) == LISSOM_OK);
            undo(world, true);
            if (failing) fail_everywhere(world, one);
        };
        turn(false);
        const long before = live_blocks();
        turn(true);
        CHECK(live_blocks() - before <= kKeptBlocks);
    }
}

}  // namespace

TEST_CASE("memory that runs out in calls of meshes is a status") {
    check_cases(add_mesh_cases, 1);
}
TEST_CASE("memory that runs out with buffers and attributes is a status") {
    check_cases(add_buffer_cases, 1);
}
TEST_CASE("memory that runs out while a job begins is a status") {
    check_cases(add_job_cases, 1);
}
TEST_CASE("memory that runs out in calls of regions is a status") {
    check_cases(add_region_cases, 1);
}
TEST_CASE("memory that runs out in deformations is a status") {
    check_cases(add_deform_cases, 1);
}
TEST_CASE("memory that runs out in bones is a status") {
    check_cases(add_bone_cases, 1);
}
TEST_CASE("memory that runs out in poses is a status") {
    check_cases(add_pose_cases, 1);
}
TEST_CASE("memory that runs out in cuts, merges and pastes is a status") {
    check_cases(add_merge_cases, 1);
}
TEST_CASE("memory that runs out in hair is a status") {
    check_cases(add_hair_cases, 1);
}
TEST_CASE("memory that runs out in scripts and calls by name is a status") {
    check_cases(add_script_cases, 1);
}
TEST_CASE("memory that runs out while a context is made is a status") {
    for (const bool all : {false, true}) {
        bool failed = true;
        for (long n = 0; failed && n < every_allocation(); ++n) {
            CAPTURE(n);
            const long before = live_blocks();
            lissom_context* context = nullptr;
            fail_at(n, all);
            const lissom_status status = lissom_context_create(nullptr, &context);
            failed = stop_failing();
            CHECK(status == (failed ? LISSOM_MEMORY_LIMIT : LISSOM_OK));
            CHECK((context == nullptr) == failed);
            lissom_context_destroy(context);
            CHECK(live_blocks() == before);
        }
        CHECK_FALSE(failed);
    }
}

namespace {

// Calls `use` in a new context, whose memory ends for good at allocation `n`; false once that is
// beyond the last one.
bool first_use(lissom_status (*use)(lissom_context*), long n) {
    CAPTURE(n);
    const long before = live_blocks();
    lissom_context* context = nullptr;
    REQUIRE(lissom_context_create(nullptr, &context) == LISSOM_OK);
    fail_at(n, true);
    const lissom_status status = use(context);
    const bool failed = stop_failing();
    CHECK(status == (failed ? LISSOM_MEMORY_LIMIT : LISSOM_OK));
    lissom_context_destroy(context);
    CHECK(live_blocks() == before);
    return failed;
}

}  // namespace

TEST_CASE("a state of scripts that finds no more memory while it is made leaves nothing") {
    if (!lissom_has_scripts()) return;
    lissom_status (*const uses[])(lissom_context*) = {
        [](lissom_context* context) {
            lissom_bytes json{};
            return lissom_call(context, "shapes.box", "[]", &json);
        },
        [](lissom_context* context) {
            lissom_script script{};
            return lissom_script_load(context, "return 1", 8, "tool.lua", &script);
        },
        [](lissom_context* context) { return lissom_sandbox_scripts(context, nullptr); }};
    for (const auto use : uses) {
        // What the process keeps is made by the first.
        lissom_context* context = nullptr;
        REQUIRE(lissom_context_create(nullptr, &context) == LISSOM_OK);
        REQUIRE(use(context) == LISSOM_OK);
        lissom_context_destroy(context);
        int failures = 0;
        for (long n = 0; first_use(use, n); n += 1 + n / 16) ++failures;
        CHECK(failures > 50);
    }
}

TEST_CASE("the static library uses the program's own memory: it takes no allocator, and says so") {
    lissom_memory_options options = lissom_default_memory_options();
    CHECK(lissom_set_memory(&options) == LISSOM_OK);
    options.large_pages = LISSOM_LARGE_PAGES_ALWAYS;
    CHECK(lissom_set_memory(&options) == LISSOM_UNSUPPORTED);
    options.large_pages = LISSOM_LARGE_PAGES_NEVER;
    CHECK(lissom_set_memory(&options) == LISSOM_OK);
    options.allocate = [](void*, std::size_t, std::size_t) -> void* { return nullptr; };
    options.release = [](void*, void*, std::size_t, std::size_t) {};
    CHECK(lissom_set_memory(&options) == LISSOM_UNSUPPORTED);
    CHECK(lissom_set_memory(nullptr) == LISSOM_OK);
}

TEST_CASE("those tests have every function of the header that may take memory") {
    std::ifstream file(LISSOM_C_HEADER);
    REQUIRE(file);
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    std::vector<MemoryCase> all;
    for (Add* add :
         {add_mesh_cases, add_buffer_cases, add_job_cases, add_region_cases, add_deform_cases,
          add_bone_cases, add_pose_cases, add_merge_cases, add_hair_cases, add_script_cases}) {
        add(all);
    }
    std::set<std::string> tested{"lissom_context_create", "lissom_sandbox_scripts",
                                 "lissom_set_memory"};
    for (const MemoryCase& one : all) tested.insert(one.function);
    static const std::regex declaration(R"((lissom_status|int32_t)\s+(lissom_\w+)\()");
    static const std::regex free_of_memory(R"(lissom_\w+_release|lissom_version)");
    int count = 0;
    for (std::sregex_iterator at(text.begin(), text.end(), declaration), end; at != end; ++at) {
        const std::string name = (*at)[2];
        if (std::regex_match(name, free_of_memory)) continue;
        const bool is_script = name.find("script") != std::string::npos ||
                               name.find("numbers") != std::string::npos ||
                               name.find("call") != std::string::npos;
        if (!lissom_has_scripts() && is_script) continue;
        ++count;
        CHECK_MESSAGE(tested.count(name) == 1, name);
    }
    CHECK(count > 80);
}

}  // namespace lissom::test
