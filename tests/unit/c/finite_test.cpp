// Numbers of a host that are not finite, through every function that takes one.
#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <regex>
#include <set>

#include "tests/unit/c/world.h"

namespace lissom::test {
namespace {

struct Given {
    const char* function;
    /// How many numbers of the call can be bad.
    int numbers;
    /// Calls with `bad` as the number `i` of its numbers.
    std::function<lissom_status(World&, int i, double bad)> call;
};

// Numbers of a call, one of which is bad.
template <std::size_t Count>
std::array<double, Count> with_bad(std::array<double, Count> numbers, int i, double bad) {
    numbers[at(i)] = bad;
    return numbers;
}

lissom_transform bad_transform(int i, double bad) {
    lissom_transform transform = lissom_identity();
    transform.m[i] = bad;
    return transform;
}

lissom_placement bad_placement(int i, double bad) {
    auto placement = lissom_default_placement();
    placement.at[0] = 2.0;
    double* const lists[] = {placement.at, placement.toward, placement.up};
    if (i < 9) {
        lists[i / 3][i % 3] = bad;
    } else if (i == 9) {
        placement.scale = bad;
    } else {
        // NAN is the best fit.
        placement.angle = std::isnan(bad) ? std::numeric_limits<double>::infinity() : bad;
    }
    return placement;
}

lissom_hairstyle_options bad_style(int i, double bad) {
    auto options = lissom_default_hairstyle_options();
    options.resolution = 1000;
    double* const numbers[] = {&options.unit,     &options.up[0],    &options.up[1],
                               &options.up[2],    &options.front[0], &options.front[1],
                               &options.front[2], &options.gravity};
    *numbers[i] = bad;
    return options;
}

lissom_grow_options bad_growth(int i, double bad) {
    auto options = lissom_default_grow_options();
    options.count = 10;
    (i == 0 ? options.length : options.variation) = bad;
    return options;
}

// The status of a job that was begun.
lissom_status finished(World& world, lissom_status begun) {
    if (begun != LISSOM_OK) return begun;
    return lissom_job_finish(world, std::exchange(world.made_job, {}), nullptr);
}

const std::array<double, 9> kTriangle{0, 0, 0, 1, 0, 0, 0, 1, 0};
const char kObj[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

using AddCurve = lissom_status(lissom_context*, lissom_hairstyle, const lissom_input*,
                               std::int32_t*);

Given curve_case(const char* name, AddCurve* add) {
    return {name, 6, [add](World& world, int i, double bad) {
                double points[6];
                for (int k = 0; k < 2; ++k) {
                    lissom_hairstyle_at(world, world.style, 1.3, 1.0 - k, 0.02, points + 3 * k);
                }
                points[i] = bad;
                const lissom_input list = triples(points, 2);
                std::int32_t curve = -1;
                return add(world, world.style, &list, &curve);
            }};
}

lissom_join bad_join(std::array<double, 6>& keys, int i, double bad) {
    keys = with_bad(keys, i, bad);
    lissom_join join{};
    join.source_keys = keys.data();
    join.target_keys = keys.data() + 3;
    join.key_count = 1;
    return join;
}

std::vector<Given> mesh_cases() {
    return {
        {"lissom_mesh_create", 9,
         [](World& world, int i, double bad) {
             const auto points = with_bad(kTriangle, i, bad);
             const std::int32_t corners[] = {0, 1, 2};
             const lissom_input p = triples(points.data(), 3), c{corners, 3, 0, LISSOM_INT32};
             return lissom_mesh_create(world, &p, &c, nullptr, &world.made_mesh);
         }},
        {"lissom_mesh_load", 1,
         [](World& world, int, double bad) {
             auto options = lissom_default_mesh_load_options();
             options.unit = bad;
             return lissom_mesh_load(world, "any.obj", &options, &world.made_mesh);
         }},
        {"lissom_mesh_decode", 1,
         [](World& world, int, double bad) {
             auto options = lissom_default_mesh_load_options();
             options.unit = bad;
             return lissom_mesh_decode(world, kObj, sizeof kObj - 1, "obj", &options,
                                       &world.made_mesh);
         }},
        {"lissom_mesh_save", 1,
         [](World& world, int, double bad) {
             auto options = lissom_default_mesh_save_options();
             options.unit = bad;
             return lissom_mesh_save(world, world.bar, "any.obj", &options);
         }},
        {"lissom_mesh_encode", 1,
         [](World& world, int, double bad) {
             auto options = lissom_default_mesh_save_options();
             options.unit = bad;
             return lissom_mesh_encode(world, world.bar, "obj", &options, &world.bytes);
         }},
        {"lissom_mesh_set_positions", 3,
         [](World& world, int i, double bad) {
             std::vector<double> points(3 * at(lissom_mesh_vertex_count(world, world.bar)));
             const lissom_output out{points.data(), points.size() / 3, 0, LISSOM_FLOAT64};
             lissom_mesh_read_positions(world, world.bar, &out);
             points[at(i)] = bad;
             const lissom_input list = triples(points.data(), points.size() / 3);
             return lissom_mesh_set_positions(world, world.bar, &list);
         }},
        {"lissom_mesh_create_welded", 9 + 9 + 6,
         [](World& world, int i, double bad) {
             std::array<double, 24> n{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1,
                                      0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
             n = with_bad(n, i, bad);
             const std::int32_t corners[] = {0, 1, 2};
             lissom_buffer buffer = lissom_default_buffer();
             buffer.positions = triples(n.data(), 3);
             buffer.normals = triples(n.data() + 9, 3);
             buffer.uvs = {n.data() + 18, 3, 0, LISSOM_FLOAT64};
             buffer.corners = {corners, 3, 0, LISSOM_INT32};
             lissom_render_map map{};
             return lissom_mesh_create_welded(world, &buffer, &world.made_mesh, &map);
         }},
        {"lissom_mesh_begin_create", 9,
         [](World& world, int i, double bad) {
             const auto points = with_bad(kTriangle, i, bad);
             const std::int32_t corners[] = {0, 1, 2};
             lissom_buffer buffer = lissom_default_buffer();
             buffer.positions = triples(points.data(), 3);
             buffer.corners = {corners, 3, 0, LISSOM_INT32};
             return finished(world, lissom_mesh_begin_create(world, &buffer, &world.made_job));
         }},
        {"lissom_mesh_begin_load", 1,
         [](World& world, int, double bad) {
             auto options = lissom_default_mesh_load_options();
             options.unit = bad;
             return finished(world,
                             lissom_mesh_begin_load(world, "any.obj", &options, &world.made_job));
         }},
        {"lissom_mesh_begin_save", 1,
         [](World& world, int, double bad) {
             auto options = lissom_default_mesh_save_options();
             options.unit = bad;
             return finished(world, lissom_mesh_begin_save(world, world.bar, "any.obj", &options,
                                                           &world.made_job));
         }},
        {"lissom_mesh_write_attribute", 2,
         [](World& world, int i, double bad) {
             std::vector<double> values(2 * at(lissom_mesh_vertex_count(world, world.bar)));
             values[at(i)] = bad;
             const lissom_input list{values.data(), values.size() / 2, 0, LISSOM_FLOAT64};
             return lissom_mesh_write_attribute(world, world.bar, "uv", LISSOM_ON_VERTICES, 2,
                                                &list);
         }},
        {"lissom_mesh_transform", 12,
         [](World& world, int i, double bad) {
             const lissom_transform map = bad_transform(i, bad);
             return lissom_mesh_transform(world, world.bar, &map);
         }},
    };
}

std::vector<Given> region_cases() {
    return {
        {"lissom_region_sphere", 4,
         [](World& world, int i, double bad) {
             const auto n = with_bad<4>({0, 0, 0, 1}, i, bad);
             return lissom_region_sphere(world, world.bar, n.data(), n[3], &world.made_region);
         }},
        {"lissom_region_box", 6,
         [](World& world, int i, double bad) {
             const auto n = with_bad<6>({-1, -1, -1, 1, 1, 1}, i, bad);
             return lissom_region_box(world, world.bar, n.data(), n.data() + 3, &world.made_region);
         }},
        {"lissom_region_plane", 6,
         [](World& world, int i, double bad) {
             const auto n = with_bad<6>({0, 0, 0, 0, 1, 0}, i, bad);
             return lissom_region_plane(world, world.bar, n.data(), n.data() + 3,
                                        &world.made_region);
         }},
        {"lissom_region_geodesic", 4,
         [](World& world, int i, double bad) {
             const auto n = with_bad<4>({0, 0, 0, 1}, i, bad);
             return lissom_region_geodesic(world, world.bar, n.data(), n[3], &world.made_region);
         }},
    };
}

std::vector<Given> deform_cases() {
    return {
        {"lissom_deformer_solve_with_pins", 7,
         [](World& world, int i, double bad) {
             const auto n = with_bad<7>({0, 0, 0, 0, 1, 0, 1}, i, bad);
             const lissom_sliding_pin pin{10,
                                          i == 6 ? LISSOM_PIN_SPHERE : LISSOM_PIN_PLANE,
                                          {n[0], n[1], n[2]},
                                          {n[3], n[4], n[5]},
                                          n[6]};
             double distance = 0.0;
             return lissom_deformer_solve_with_pins(world, world.boned, &pin, 1, &distance);
         }},
        {"lissom_deformer_follow_with_bones", 7,
         [](World& world, int i, double bad) {
             const auto n = with_bad<7>({0, -2, 0, 1, 2, 0, 0.5}, i, bad);
             const lissom_input points = triples(n.data(), 2);
             return lissom_deformer_follow_with_bones(world, world.boned, world.bones, &points,
                                                      false, n[6]);
         }},
        {"lissom_deformer_carry_handle", 9,
         [](World& world, int i, double bad) {
             const auto n = with_bad<9>({0, -2, 0, 1, 2, 0, 0.1, 0.5, 0.2}, i, bad);
             const lissom_input points = triples(n.data(), 2);
             return lissom_deformer_carry_handle(world, world.boned, world.bones, &points, n[6],
                                                 n[7], n[8]);
         }},
        {"lissom_deformer_add_bones", 13,
         [](World& world, int i, double bad) {
             const auto n = with_bad<13>({0, -2, 0, 0, 0.1, 0, 0, 2, 0, 1, 1, 0.3, 0}, i, bad);
             const lissom_input joints = triples(n.data(), 3);
             auto options = lissom_default_bones_options();
             options.limits = {n.data() + 9, 2, 0, LISSOM_FLOAT64};
             options.share = n[11];
             options.radius = n[12];
             std::int32_t bones = -1;
             return lissom_deformer_add_bones(world, world.boned, world.bar, &joints, &options,
                                              &bones);
         }},
        {"lissom_deformer_turn_bone", 4,
         [](World& world, int i, double bad) {
             const auto n = with_bad<4>({0, 0, 1, 0.5}, i, bad);
             return lissom_deformer_turn_bone(world, world.boned, world.bones, 1, n.data(), n[3]);
         }},
        {"lissom_deformer_reach_with_bones", 6,
         [](World& world, int i, double bad) {
             const auto n = with_bad<6>({1, 1, 0, 0, 0, 1}, i, bad);
             double distance = 0.0;
             return lissom_deformer_reach_with_bones(world, world.boned, world.bones, n.data(),
                                                     n.data() + 3, &distance);
         }},
        {"lissom_deformer_move_bones", 3,
         [](World& world, int i, double bad) {
             const auto n = with_bad<3>({0, -1, 0}, i, bad);
             return lissom_deformer_move_bones(world, world.boned, world.bones, n.data());
         }},
        {"lissom_deformer_create", 1,
         [](World& world, int, double bad) {
             auto options = lissom_default_deformer_options();
             options.transition = bad;
             return lissom_deformer_create(world, world.bar, {0}, &options, &world.made_deformer);
         }},
        {"lissom_deformer_add_handle", 2,
         [](World& world, int i, double bad) {
             auto options = lissom_default_handle_options();
             (i == 0 ? options.weight : options.falloff) = bad;
             std::int32_t handle = -1;
             return lissom_deformer_add_handle(world, world.deformer, world.top, &options, &handle);
         }},
        {"lissom_deformer_set_transform", 12,
         [](World& world, int i, double bad) {
             const lissom_transform map = bad_transform(i, bad);
             return lissom_deformer_set_transform(world, world.deformer, world.handle, &map);
         }},
        {"lissom_deformer_encode_keyed_basis", 12,
         [](World& world, int i, double bad) {
             const lissom_transform map = bad_transform(i, bad);
             lissom_bytes bytes{};
             return lissom_deformer_encode_keyed_basis(world, world.deformer, &map, 1, 1, &bytes);
         }},
        {"lissom_deformer_constrain", 4,
         [](World& world, int i, double bad) {
             const auto n = with_bad<4>({0, 0, 0, 1}, i, bad);
             const std::int32_t vertex = lissom_mesh_vertex_count(world, world.bar) / 2;
             return lissom_deformer_constrain(world, world.deformer, vertex, n.data(), n[3]);
         }},
    };
}

std::vector<Given> pose_cases() {
    return {
        {"lissom_pose_blend", 1,
         [](World& world, int, double bad) {
             return lissom_pose_blend(world, world.pose, world.pose, bad, &world.made_pose);
         }},
        {"lissom_deformer_set_blended_pose", 1,
         [](World& world, int, double bad) {
             return lissom_deformer_set_blended_pose(world, world.deformer, world.pose, world.pose,
                                                     bad);
         }},
        {"lissom_pose_space_read_positions", 1,
         [](World& world, int, double bad) {
             std::vector<double> room(3 * at(lissom_mesh_vertex_count(world, world.bar)));
             const lissom_input weights{&bad, 1, 0, LISSOM_FLOAT64};
             const lissom_output out{room.data(), room.size() / 3, 0, LISSOM_FLOAT64};
             return lissom_pose_space_read_positions(world, world.space, &weights, &out);
         }},
        {"lissom_pose_space_blend", 1,
         [](World& world, int, double bad) {
             const lissom_input weights{&bad, 1, 0, LISSOM_FLOAT64};
             return lissom_pose_space_blend(world, world.space, &weights, &world.made_mesh);
         }},
        {"lissom_pose_space_targets", 1,
         [](World& world, int, double bad) {
             const lissom_input at{&bad, 1, 0, LISSOM_FLOAT64};
             return lissom_pose_space_targets(world, world.space, &at, &world.made_mesh, nullptr);
         }},
    };
}

std::vector<Given> merge_cases() {
    return {
        {"lissom_cut_by_plane", 7,
         [](World& world, int i, double bad) {
             const auto n = with_bad<7>({0, 0, 0, 0, 1, 0, 0.1}, i, bad);
             auto options = lissom_default_cut_options();
             options.slide = n[6];
             return lissom_cut_by_plane(world, world.bar, n.data(), n.data() + 3, &options,
                                        &world.made_mesh, nullptr);
         }},
        {"lissom_cut_by_region", 1,
         [](World& world, int, double bad) {
             auto options = lissom_default_cut_options();
             options.slide = bad;
             return lissom_cut_by_region(world, world.bar, world.top, &options, &world.made_mesh,
                                         nullptr);
         }},
        {"lissom_cut_begin_by_plane", 7,
         [](World& world, int i, double bad) {
             const auto n = with_bad<7>({0, 0, 0, 0, 1, 0, 0.1}, i, bad);
             auto options = lissom_default_cut_options();
             options.slide = n[6];
             return finished(world,
                             lissom_cut_begin_by_plane(world, world.bar, n.data(), n.data() + 3,
                                                       &options, &world.made_job));
         }},
        {"lissom_cut_begin_by_region", 1,
         [](World& world, int, double bad) {
             auto options = lissom_default_cut_options();
             options.slide = bad;
             return finished(world, lissom_cut_begin_by_region(world, world.bar, world.top,
                                                               &options, &world.made_job));
         }},
        {"lissom_begin_merge", 6,
         [](World& world, int i, double bad) {
             std::array<double, 6> keys{};
             const lissom_join join = bad_join(keys, i, bad);
             return finished(world, lissom_begin_merge(world, world.half, world.other_half, &join,
                                                       1, nullptr, &world.made_job));
         }},
        {"lissom_paste_begin_create", 11,
         [](World& world, int i, double bad) {
             const lissom_placement placement = bad_placement(i, bad);
             return finished(
                 world, lissom_paste_begin_create(world, world.bump, world.ball, world.bump_region,
                                                  {0}, {0}, &placement, &world.made_job));
         }},
        {"lissom_merge", 6,
         [](World& world, int i, double bad) {
             std::array<double, 6> keys{};
             const lissom_join join = bad_join(keys, i, bad);
             return lissom_merge(world, world.half, world.other_half, &join, 1, nullptr,
                                 &world.made_mesh, nullptr);
         }},
        {"lissom_merger_create", 6,
         [](World& world, int i, double bad) {
             std::array<double, 6> keys{};
             const lissom_join join = bad_join(keys, i, bad);
             return lissom_merger_create(world, world.half, &world.other_half, 1, &join, 1, nullptr,
                                         &world.made_merger);
         }},
        {"lissom_merger_set_keys", 6,
         [](World& world, int i, double bad) {
             const auto n = with_bad<6>({}, i, bad);
             return lissom_merger_set_keys(world, world.merger, 0, n.data(), n.data() + 3, 1);
         }},
        {"lissom_paste_create", 11,
         [](World& world, int i, double bad) {
             const lissom_placement placement = bad_placement(i, bad);
             return lissom_paste_create(world, world.bump, world.ball, world.bump_region, {0}, {0},
                                        &placement, &world.made_paste);
         }},
        {"lissom_paste_move", 11,
         [](World& world, int i, double bad) {
             const lissom_placement placement = bad_placement(i, bad);
             return lissom_paste_move(world, world.paste, &placement);
         }},
    };
}

std::vector<Given> hair_cases() {
    return {
        {"lissom_hairstyle_create", 8,
         [](World& world, int i, double bad) {
             const auto options = bad_style(i, bad);
             return lissom_hairstyle_create(world, world.head, &options, &world.made_style);
         }},
        {"lissom_hairstyle_decode", 7,
         [](World& world, int i, double bad) {
             const auto options = bad_style(i, bad);
             lissom_hairstyle_encode(world, world.style, &world.bytes);
             const std::string text(static_cast<const char*>(world.bytes.data), world.bytes.size);
             return lissom_hairstyle_decode(world, text.data(), text.size(), world.head, &options,
                                            &world.made_style);
         }},
        {"lissom_hairstyle_at", 3,
         [](World& world, int i, double bad) {
             const auto n = with_bad<3>({1, 1, 0.1}, i, bad);
             double point[3];
             return lissom_hairstyle_at(world, world.style, n[0], n[1], n[2], point);
         }},
        {"lissom_hairstyle_normal_at", 2,
         [](World& world, int i, double bad) {
             const auto n = with_bad<2>({1, 1}, i, bad);
             double normal[3];
             return lissom_hairstyle_normal_at(world, world.style, n[0], n[1], normal);
         }},
        curve_case("lissom_hairstyle_add_stream", lissom_hairstyle_add_stream),
        curve_case("lissom_hairstyle_add_dividing", lissom_hairstyle_add_dividing),
        {"lissom_hairstyle_add_ponytail", 7,
         [](World& world, int i, double bad) {
             double n[7];
             for (int k = 0; k < 2; ++k) {
                 lissom_hairstyle_at(world, world.style, 3.1, 1.0 - k, 0.02, n + 3 * k);
             }
             n[6] = 0.02;
             n[i] = bad;
             const lissom_input list = triples(n, 2);
             std::int32_t curve = -1;
             return lissom_hairstyle_add_ponytail(world, world.style, &list, n[6], &curve);
         }},
        {"lissom_curve_set_points", 6,
         [](World& world, int i, double bad) {
             const auto n = with_bad<6>({0, 0, 0, 0, 0.1, 0}, i, bad);
             const lissom_input list = triples(n.data(), 2);
             return lissom_curve_set_points(world, world.style, world.curve, &list);
         }},
        {"lissom_hairstyle_field", 3,
         [](World& world, int i, double bad) {
             const auto n = with_bad<3>({0, 0, 0}, i, bad);
             double direction[3];
             return lissom_hairstyle_field(world, world.style, n.data(), direction);
         }},
        {"lissom_hairstyle_grow", 2,
         [](World& world, int i, double bad) {
             const auto options = bad_growth(i, bad);
             return lissom_hairstyle_grow(world, world.style, &options, &world.made_strands);
         }},
        {"lissom_hairstyle_begin_grow", 2,
         [](World& world, int i, double bad) {
             const auto options = bad_growth(i, bad);
             const lissom_status begun =
                 lissom_hairstyle_begin_grow(world, world.style, &options, &world.made_job);
             if (begun != LISSOM_OK) return begun;
             const lissom_job job = std::exchange(world.made_job, {});
             return lissom_job_finish(world, job, &world.made_strands.id);
         }},
        {"lissom_strands_set_points", 15,
         [](World& world, int i, double bad) {
             const auto n = with_bad(std::array<double, 15>{}, i, bad);
             const lissom_input list = triples(n.data(), 5);
             return lissom_strands_set_points(world, world.strands, &list);
         }},
        {"lissom_strands_write", 2,
         [](World& world, int i, double bad) {
             const auto n = with_bad(std::array<double, 2>{}, i, bad);
             const lissom_input list{n.data(), 2, 0, LISSOM_FLOAT64};
             return lissom_strands_write(world, world.strands, LISSOM_STRAND_WIDTH, &list);
         }},
        {"lissom_strands_write_at_points", 5,
         [](World& world, int i, double bad) {
             const auto n = with_bad(std::array<double, 5>{}, i, bad);
             const lissom_input list{n.data(), 5, 0, LISSOM_FLOAT64};
             return lissom_strands_write_at_points(world, world.strands, LISSOM_STRAND_WIDTH,
                                                   &list);
         }},
        {"lissom_strands_create", 6,
         [](World& world, int i, double bad) {
             const auto n = with_bad<6>({0, 0, 0, 0, 1, 0}, i, bad);
             const std::int32_t offsets[] = {0, 2};
             const lissom_input list = triples(n.data(), 2), starts{offsets, 2, 0, LISSOM_INT32};
             return lissom_strands_create(world, &list, &starts, &world.made_strands);
         }},
    };
}

std::vector<Given> script_cases() {
    if (!lissom_has_scripts()) return {};
    return {{"lissom_sandbox_scripts", 1,
             [](World& world, int, double bad) {
                 auto options = lissom_default_sandbox_options();
                 options.seconds = bad;
                 return lissom_sandbox_scripts(world, &options);
             }},
            {"lissom_numbers_create", 4, [](World& world, int i, double bad) {
                 const auto n = with_bad(std::array<double, 4>{}, i, bad);
                 const lissom_input list{n.data(), 2, 0, LISSOM_FLOAT64};
                 lissom_object made{};
                 return lissom_numbers_create(world, &list, 2, &made);
             }}};
}

std::vector<Given> all_cases() {
    std::vector<Given> all;
    for (auto* cases : {mesh_cases, region_cases, deform_cases, pose_cases, merge_cases, hair_cases,
                        script_cases}) {
        for (Given& given : cases()) all.push_back(std::move(given));
    }
    return all;
}

bool read_triangle(void*, const char*, lissom_sink* sink, void* argument) {
    sink(argument, kObj, sizeof kObj - 1);
    return true;
}

bool refuses_argument(lissom_status status) {
    return status == LISSOM_NOT_FINITE || status == LISSOM_INVALID_ARGUMENT ||
           status == LISSOM_OUT_OF_RANGE || status == LISSOM_SINGULAR_TRANSFORM;
}

// Whether a declaration takes numbers of the host that may be not finite, itself or in options.
bool takes_numbers(const std::string& parameters) {
    static const std::regex numbers(
        R"((const double\b|, double \w+[,)]|const lissom_transform\*|const lissom_placement\*|)"
        R"(const lissom_join\*|const lissom_sliding_pin\*|const lissom_(mesh_load|mesh_save|deformer|handle|cut|hairstyle|)"
        R"(grow|sandbox)_options\*|const lissom_buffer\*|)"
        R"(lissom_input\* (points|positions|spine|values|weights|correctives|joints)))");
    return std::regex_search(parameters, numbers);
}

std::set<std::string> functions_with_numbers() {
    std::ifstream file(LISSOM_C_HEADER);
    REQUIRE(file);
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    static const std::regex declaration(R"(LISSOM_API\s+[\w\s\*]*?(lissom_\w+)\(([^;]*\));)");
    std::set<std::string> names;
    for (std::sregex_iterator at(text.begin(), text.end(), declaration), end; at != end; ++at) {
        const std::string parameters =
            std::regex_replace((*at)[2].str(), std::regex(R"(\s+)"), " ");
        if (takes_numbers(parameters)) names.insert((*at)[1]);
    }
    return names;
}

}  // namespace

TEST_CASE("no function takes a number that is not finite, and nothing changes by one") {
    auto options = lissom_default_context_options();
    options.read_file = read_triangle;
    options.write_file = [](void*, const char*, const void*, std::size_t) { return true; };
    World world(options);
    world.make_deformer();
    world.make_bones();
    world.make_poses();
    world.make_halves();
    world.make_paste();
    world.make_style();
    world.make_strands();
    REQUIRE(lissom_hairstyle_solve(world, world.style) == LISSOM_OK);
    const std::string before = world.content();
    const double infinity = std::numeric_limits<double>::infinity();
    for (const Given& given : all_cases()) {
        CAPTURE(std::string(given.function));
        for (int i = 0; i < given.numbers; ++i) {
            for (const double bad : {std::nan(""), infinity, -infinity}) {
                CAPTURE(i);
                CAPTURE(bad);
                const lissom_status status = given.call(world, i, bad);
                CHECK_MESSAGE(refuses_argument(status), std::string(lissom_status_name(status)));
                CHECK(lissom_last_error(world)->status == status);
                world.drop();
            }
        }
        CHECK(world.content() == before);
    }
}

TEST_CASE("that test has every function of the header that takes numbers") {
    std::set<std::string> tested;
    for (const Given& given : all_cases()) tested.insert(given.function);
    const std::set<std::string> wanted = functions_with_numbers();
    CHECK(wanted.size() > 30);
    for (const std::string& name : wanted) {
        const bool is_script = name == "lissom_sandbox_scripts" || name == "lissom_numbers_create";
        if (!lissom_has_scripts() && is_script) continue;
        CHECK_MESSAGE(tested.count(name) == 1, name);
    }
    for (const std::string& name : tested) CHECK_MESSAGE(wanted.count(name) == 1, name);
}

}  // namespace lissom::test
