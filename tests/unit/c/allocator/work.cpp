#include "tests/unit/c/allocator/work.h"

#include <doctest/doctest.h>

#include <cstring>
#include <string>
#include <vector>

namespace lissom::test {
namespace {

// Requires that a call has succeeded, and else shows its message.
void done(lissom_context* context, lissom_status status) {
    INFO(std::string(lissom_last_error(context)->message));
    REQUIRE(status == LISSOM_OK);
}

std::string ball_options(int segments, double radius) {
    return "[{\"segments\": " + std::to_string(segments) +
           ", \"radius\": " + std::to_string(radius) + "}]";
}

lissom_mesh half_ball(lissom_context* context, int segments, double radius, double up) {
    const lissom_mesh ball =
        shape(context, "shapes.sphere", ball_options(segments, radius).c_str());
    const double origin[] = {0, 0.1, 0}, normal[] = {0, up, 0};
    lissom_mesh half{};
    done(context, lissom_cut_by_plane(context, ball, origin, normal, nullptr, &half, nullptr));
    done(context, lissom_mesh_release(context, ball));
    return half;
}

}  // namespace

WorkContext::WorkContext(int threads) {
    lissom_context_options options = lissom_default_context_options();
    options.threads = threads;
    REQUIRE(lissom_context_create(&options, &context_) == LISSOM_OK);
}

lissom_mesh shape(lissom_context* context, const char* name, const char* options) {
    lissom_bytes json{};
    done(context, lissom_call(context, name, options, &json));
    const std::string text(static_cast<const char*>(json.data), json.size);
    const std::size_t place = text.find("\"object\":");
    REQUIRE(place != std::string::npos);
    return {std::stoull(text.substr(place + 9))};
}

void deform_ball(lissom_context* context, int segments, int frames) {
    const lissom_mesh ball = shape(context, "shapes.sphere", ball_options(segments, 1.0).c_str());
    const double top[] = {0, 1, 0}, bottom[] = {0, -1, 0};
    lissom_region held{}, moved{};
    done(context, lissom_region_sphere(context, ball, bottom, 0.5, &held));
    done(context, lissom_region_sphere(context, ball, top, 0.5, &moved));
    lissom_deformer deformer{};
    std::int32_t handle = -1;
    done(context, lissom_deformer_create(context, ball, {0}, nullptr, &deformer));
    done(context, lissom_deformer_pin(context, deformer, held));
    done(context, lissom_deformer_add_handle(context, deformer, moved, nullptr, &handle));
    std::vector<float> points(3 *
                              static_cast<std::size_t>(lissom_mesh_vertex_count(context, ball)));
    const lissom_output out{points.data(), points.size() / 3, 0, LISSOM_FLOAT32};
    for (int frame = 0; frame < frames; ++frame) {
        lissom_transform map = lissom_identity();
        map.m[3] = 0.1 * frame;
        done(context, lissom_deformer_set_transform(context, deformer, handle, &map));
        done(context, lissom_deformer_solve(context, deformer, LISSOM_FULL));
        done(context, lissom_deformer_read_positions(context, deformer, &out));
    }
}

void merge_balls(lissom_context* context, int segments) {
    const lissom_mesh half = half_ball(context, segments, 1.0, 1.0);
    const lissom_mesh other = half_ball(context, segments, 1.5, -1.0);
    lissom_mesh merged{};
    done(context, lissom_merge(context, half, other, nullptr, 0, nullptr, &merged, nullptr));
}

void grow_hair(lissom_context* context, int strands) {
    const lissom_mesh head = shape(context, "shapes.head", "[]");
    lissom_hairstyle style{};
    done(context, lissom_hairstyle_create(context, head, nullptr, &style));
    double points[9];
    for (int i = 0; i < 3; ++i) {
        done(context,
             lissom_hairstyle_at(context, style, 1.3, 1.0 - 0.5 * i, 0.02, points + 3 * i));
    }
    const lissom_input list{points, 3, 0, LISSOM_FLOAT64};
    std::int32_t curve = -1;
    done(context, lissom_hairstyle_add_stream(context, style, &list, &curve));
    lissom_grow_options options = lissom_default_grow_options();
    options.count = strands;
    lissom_strands grown{};
    done(context, lissom_hairstyle_grow(context, style, &options, &grown));
    CHECK(lissom_strands_size(context, grown) > strands / 2);
}

void code_files(lissom_context* context, int segments) {
    const lissom_mesh ball = shape(context, "shapes.sphere", ball_options(segments, 1.0).c_str());
    for (const char* extension : {"obj", "ply", "stl", "glb"}) {
        lissom_bytes bytes{};
        done(context, lissom_mesh_encode(context, ball, extension, nullptr, &bytes));
        std::vector<char> copy(bytes.size);
        std::memcpy(copy.data(), bytes.data, bytes.size);
        lissom_mesh read{};
        done(context,
             lissom_mesh_decode(context, copy.data(), copy.size(), extension, nullptr, &read));
    }
    lissom_bytes ignored{};
    CHECK(lissom_mesh_encode(context, ball, "none", nullptr, &ignored) == LISSOM_UNKNOWN_FORMAT);
}

void run_script(lissom_context* context, int entries) {
    static const char kText[] =
        "local list = {}\n"
        "for i = 1, ... do list[i] = { name = 'entry ' .. i } end\n"
        "return #list";
    lissom_script script{};
    done(context, lissom_script_load(context, kText, sizeof kText - 1, "fill.lua", &script));
    lissom_bytes json{};
    const std::string arguments = "[" + std::to_string(entries) + "]";
    done(context, lissom_script_run(context, script, arguments.c_str(), &json));
    CHECK(std::string(static_cast<const char*>(json.data), json.size) == arguments);
}

}  // namespace lissom::test
