#include "tests/unit/c/world.h"

#include <cmath>

#include "kernel/mesh/shapes/head.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/c/host.h"

namespace lissom::test {
namespace {

lissom_region add_region(lissom_context* context, lissom_mesh mesh,
                         const std::vector<Index>& vertices) {
    const lissom_input list{vertices.data(), vertices.size(), 0, LISSOM_INT32};
    lissom_region region{};
    REQUIRE(lissom_region_of_vertices(context, mesh, &list, &region) == LISSOM_OK);
    return region;
}

Mesh bumpy_ball() {
    Mesh ball = make_sphere({.segments = 10});
    for (Index v = 0; v < ball.vertex_count(); ++v) {
        Vec3 p = ball.position(v);
        if (p.y() > 0) p.y() += 0.8 * std::exp(-12 * (p.x() * p.x() + p.z() * p.z()));
        ball.set_position(v, p);
    }
    return ball;
}

lissom_mesh open_half(lissom_context* context, double radius, double up) {
    const lissom_mesh ball = add_mesh(context, make_sphere({.radius = radius, .segments = 4}));
    const double origin[] = {0, 0.1, 0}, normal[] = {0, up, 0};
    lissom_mesh half{};
    REQUIRE(lissom_cut_by_plane(context, ball, origin, normal, nullptr, &half, nullptr) ==
            LISSOM_OK);
    REQUIRE(lissom_mesh_release(context, ball) == LISSOM_OK);
    return half;
}

template <typename Handle, typename Release>
void drop_one(lissom_context* context, Handle& handle, const Release& release) {
    if (handle.id != 0) REQUIRE(release(context, handle) == LISSOM_OK);
    handle = {};
}

std::string hash_of(lissom_context* context, lissom_mesh mesh) {
    std::uint64_t hash = 0;
    if (mesh.id != 0) REQUIRE(lissom_mesh_hash(context, mesh, &hash) == LISSOM_OK);
    return std::to_string(hash) + " ";
}

}  // namespace

World::World(const lissom_context_options& options) {
    REQUIRE(lissom_context_create(&options, &context) == LISSOM_OK);
    const Mesh own = make_bar({.across = 2, .along = 5});
    bar = add_mesh(context, own);
    bottom = add_region(context, bar, own.find_region("bottom")->vertices());
    top = add_region(context, bar, own.find_region("top")->vertices());
    REQUIRE(lissom_region_all(context, bar, &all) == LISSOM_OK);
}

void World::make_deformer() {
    drop_one(context, deformer, lissom_deformer_release);
    REQUIRE(lissom_deformer_create(context, bar, {0}, nullptr, &deformer) == LISSOM_OK);
    REQUIRE(lissom_deformer_add_handle(context, deformer, bottom, nullptr, &handle) == LISSOM_OK);
}

void World::make_bones() {
    drop_one(context, boned, lissom_deformer_release);
    REQUIRE(lissom_deformer_create(context, bar, {0}, nullptr, &boned) == LISSOM_OK);
    const double joints[] = {0, -2, 0, 0, 0.1, 0, 0, 2, 0};
    const lissom_input list = triples(joints, 3);
    REQUIRE(lissom_deformer_add_bones(context, boned, bar, &list, nullptr, &bones) == LISSOM_OK);
}

void World::make_poses() {
    drop_one(context, pose, lissom_pose_release);
    drop_one(context, space, lissom_pose_space_release);
    if (deformer.id == 0) make_deformer();
    REQUIRE(lissom_deformer_get_pose(context, deformer, &pose) == LISSOM_OK);
    lissom_mesh longer{};
    REQUIRE(lissom_mesh_copy(context, bar, &longer) == LISSOM_OK);
    lissom_transform stretch = lissom_identity();
    stretch.m[5] = 1.5;
    REQUIRE(lissom_mesh_transform(context, longer, &stretch) == LISSOM_OK);
    const lissom_named_pose longer_pose{"longer", &longer, 1};
    REQUIRE(lissom_pose_space_create(context, bar, &longer_pose, 1, &space) == LISSOM_OK);
    REQUIRE(lissom_mesh_release(context, longer) == LISSOM_OK);
}

void World::make_halves() {
    if (half.id == 0) half = open_half(context, 1.0, 1.0);
    if (other_half.id == 0) other_half = open_half(context, 1.5, -1.0);
    drop_one(context, merger, lissom_merger_release);
    const lissom_join join{};
    REQUIRE(lissom_merger_create(context, half, &other_half, 1, &join, 1, nullptr, &merger) ==
            LISSOM_OK);
}

void World::make_paste() {
    if (bump.id == 0) {
        bump = add_mesh(context, bumpy_ball());
        ball = add_mesh(context, make_sphere({.radius = 2.0, .segments = 8}));
        const double center[] = {0, 1.3, 0};
        REQUIRE(lissom_region_sphere(context, bump, center, 0.95, &bump_region) == LISSOM_OK);
    }
    drop_one(context, paste, lissom_paste_release);
    auto placement = lissom_default_placement();
    placement.at[0] = 2.0;
    REQUIRE(lissom_paste_create(context, bump, ball, bump_region, {0}, {0}, &placement, &paste) ==
            LISSOM_OK);
}

void World::make_style() {
    if (head.id == 0) head = add_mesh(context, make_head({.vertices = 3000}));
    drop_one(context, style, lissom_hairstyle_release);
    auto options = lissom_default_hairstyle_options();
    options.resolution = 1000;
    REQUIRE(lissom_hairstyle_create(context, head, &options, &style) == LISSOM_OK);
    double points[9];
    for (int i = 0; i < 3; ++i) {
        REQUIRE(lissom_hairstyle_at(context, style, 1.3, 1.0 - 0.5 * i, 0.02, points + 3 * i) ==
                LISSOM_OK);
    }
    const lissom_input list = triples(points, 3);
    REQUIRE(lissom_hairstyle_add_stream(context, style, &list, &curve) == LISSOM_OK);
}

void World::make_strands() {
    drop_one(context, strands, lissom_strands_release);
    const double points[] = {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 1, 2, 0};
    const std::int32_t offsets[] = {0, 2, 5};
    const lissom_input list = triples(points, 5), starts{offsets, 3, 0, LISSOM_INT32};
    REQUIRE(lissom_strands_create(context, &list, &starts, &strands) == LISSOM_OK);
}

void World::make_map() {
    if (map.id != 0) return;
    const auto count = at(lissom_mesh_vertex_count(context, bar));
    const std::vector<double> uvs(2 * count, 0.5);
    const lissom_input pairs{uvs.data(), count, 0, LISSOM_FLOAT64};
    REQUIRE(lissom_mesh_write_attribute(context, bar, "uv", LISSOM_ON_VERTICES, 2, &pairs) ==
            LISSOM_OK);
    const std::vector<std::int32_t> labels(at(lissom_mesh_face_count(context, bar)), 0);
    const lissom_input list{labels.data(), labels.size(), 0, LISSOM_INT32};
    const char* names[] = {"wood"};
    REQUIRE(lissom_mesh_write_labels(context, bar, "material", names, 1, &list) == LISSOM_OK);
    REQUIRE(lissom_render_map_create(context, bar, &map) == LISSOM_OK);
}

void World::drop() {
    if (made_job.id != 0) lissom_job_finish(context, made_job, nullptr);
    made_job = {};
    drop_one(context, made_mesh, lissom_mesh_release);
    drop_one(context, made_rest, lissom_mesh_release);
    drop_one(context, made_region, lissom_region_release);
    drop_one(context, made_deformer, lissom_deformer_release);
    drop_one(context, made_pose, lissom_pose_release);
    drop_one(context, made_space, lissom_pose_space_release);
    drop_one(context, made_merger, lissom_merger_release);
    drop_one(context, made_paste, lissom_paste_release);
    drop_one(context, made_style, lissom_hairstyle_release);
    drop_one(context, made_strands, lissom_strands_release);
    drop_one(context, made_map, lissom_render_map_release);
    drop_one(context, made_script, lissom_script_release);
}

std::string World::content() const {
    std::string text = std::to_string(lissom_object_count(context)) + ": ";
    for (const lissom_mesh mesh : {bar, half, other_half, bump, ball}) {
        text += hash_of(context, mesh);
    }
    if (deformer.id != 0) {
        std::vector<double> points(3 * at(lissom_deformer_row_count(context, deformer)));
        const lissom_output out{points.data(), points.size() / 3, 0, LISSOM_FLOAT64};
        REQUIRE(lissom_deformer_read_positions(context, deformer, &out) == LISSOM_OK);
        double sum = 0.0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            sum += points[i] * (1.0 + std::sin(static_cast<double>(i)));
        }
        text += std::to_string(sum) + " ";
        lissom_transform transform{};
        REQUIRE(lissom_deformer_get_transform(context, deformer, handle, &transform) == LISSOM_OK);
        for (const double number : transform.m) text += std::to_string(number) + " ";
    }
    if (style.id != 0) {
        lissom_bytes json{};
        REQUIRE(lissom_hairstyle_encode(context, style, &json) == LISSOM_OK);
        text.append(static_cast<const char*>(json.data), json.size);
    }
    if (strands.id != 0) {
        text += std::to_string(lissom_strands_point_count(context, strands)) + " points";
    }
    return text;
}

}  // namespace lissom::test
