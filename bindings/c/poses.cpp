// Poses of deformers, and spaces of posed meshes.
#include <algorithm>
#include <cstddef>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bindings/c/data.h"
#include "kernel/deform/deformer.h"
#include "kernel/deform/poses/deform_pose.h"
#include "kernel/deform/poses/pose_space.h"
#include "kernel/io/poses/pose_targets.h"

namespace lissom::c {
namespace {

// A pose, and memory of the blends that lead to it.
struct HeldPose {
    DeformPose pose, blend;
};

// A space, and memory of its frames.
struct HeldSpace {
    explicit HeldSpace(PoseSpace made) : space(std::move(made)), frames(space) {}

    PoseSpace space;
    PoseFrames frames;
    std::vector<double> weights;
};

Deformer& posed_deformer(lissom_context& context, lissom_deformer deformer) {
    return context.content<Deformer>(deformer.id, Kind::deformer);
}

HeldPose& pose_of_handle(lissom_context& context, lissom_pose pose) {
    return context.content<HeldPose>(pose.id, Kind::pose);
}

std::uint64_t add_pose(lissom_context& context, DeformPose pose) {
    auto made = std::make_shared<HeldPose>();
    made->pose = std::move(pose);
    return context.add(Kind::pose, std::move(made));
}

HeldSpace& space_of(lissom_context& context, lissom_pose_space space) {
    return context.content<HeldSpace>(space.id, Kind::pose_space);
}

std::uint64_t add_space(lissom_context& context, PoseSpace space) {
    return context.add(Kind::pose_space, std::make_shared<HeldSpace>(std::move(space)));
}

std::vector<NamedPose> named_poses(lissom_context& context, const lissom_named_pose* poses,
                                   std::int32_t count) {
    require(count >= 0, "the number of poses is below 0");
    if (count > 0) require_given(poses, "poses");
    std::vector<NamedPose> named;
    for (const lissom_named_pose& given : std::span(poses, at(count))) {
        NamedPose& pose = named.emplace_back();
        pose.name = given_name(given.name, "the name of a pose");
        require(given.shape_count >= 0, "the number of shapes is below 0");
        if (given.shape_count > 0) require_given(given.shapes, "shapes");
        for (const lissom_mesh shape : std::span(given.shapes, at(given.shape_count))) {
            pose.shapes.push_back(shown_mesh(context, shape));
        }
    }
    return named;
}

std::span<const double> read_weights(HeldSpace& held, const lissom_input* weights) {
    read_numbers_into(weights, 1, "weights", held.weights);
    return held.weights;
}

// Weights by name; `values` has one for each pose.
std::vector<PoseWeight> by_name(const PoseSpace& space, std::span<const double> values) {
    const std::vector<std::string> names = space.names();
    require(values.size() == names.size(),
            "there must be a weight for each of the " + std::to_string(names.size()) + " poses");
    std::vector<PoseWeight> weights;
    for (std::size_t p = 0; p < names.size(); ++p) weights.push_back({names[p], values[p]});
    return weights;
}

std::vector<std::vector<PoseWeight>> read_correctives(const PoseSpace& space,
                                                      const lissom_input* correctives) {
    std::vector<std::vector<PoseWeight>> list;
    if (!correctives) return list;
    const std::vector<double> values = read_numbers(correctives, 1, "correctives");
    const std::size_t count = space.names().size();
    require(values.size() % count == 0,
            "correctives must have a weight for each of the " + std::to_string(count) + " poses");
    for (std::size_t first = 0; first < values.size(); first += count) {
        list.push_back(by_name(space, std::span(values).subspan(first, count)));
    }
    return list;
}

lissom_pose_targets_report told_targets(const PoseTargetReport& found) {
    auto told = lissom_default_pose_targets_report();
    const auto is_corrective = [](const PoseTarget& target) { return target.is_corrective; };
    told.correctives =
        index_of(std::count_if(found.targets.begin(), found.targets.end(), is_corrective));
    told.pose_targets = count_of(found.targets) - told.correctives;
    told.linear_error = found.linear_error;
    told.error = found.error;
    return told;
}

}  // namespace
}  // namespace lissom::c

using namespace lissom;
using namespace lissom::c;

extern "C" {

lissom_status lissom_deformer_get_pose(lissom_context* context, lissom_deformer deformer,
                                       lissom_pose* pose) {
    return run(context, [&] {
        require_given(pose, "pose");
        pose->id = add_pose(*context, pose_of(posed_deformer(*context, deformer)));
    });
}

lissom_status lissom_deformer_set_pose(lissom_context* context, lissom_deformer deformer,
                                       lissom_pose pose) {
    return run(context, [&] {
        set_pose(posed_deformer(*context, deformer), pose_of_handle(*context, pose).pose);
    });
}

lissom_status lissom_pose_blend(lissom_context* context, lissom_pose start, lissom_pose end,
                                double t, lissom_pose* pose) {
    return run(context, [&] {
        require_given(pose, "pose");
        pose->id = add_pose(*context, blended(pose_of_handle(*context, start).pose,
                                              pose_of_handle(*context, end).pose, t));
    });
}

lissom_status lissom_deformer_set_blended_pose(lissom_context* context, lissom_deformer deformer,
                                               lissom_pose start, lissom_pose end, double t) {
    return run(context, [&] {
        Deformer& own = posed_deformer(*context, deformer);
        const DeformPose& from = pose_of_handle(*context, start).pose;
        HeldPose& to = pose_of_handle(*context, end);
        blend_into(to.blend, from, to.pose, t);
        set_pose(own, to.blend);
    });
}

lissom_status lissom_pose_space_create(lissom_context* context, lissom_mesh rest,
                                       const lissom_named_pose* poses, int32_t pose_count,
                                       lissom_pose_space* space) {
    return run(context, [&] {
        require_given(space, "space");
        space->id = add_space(*context,
                              PoseSpace(shown_mesh(*context, rest),
                                        named_poses(*context, poses, pose_count), context->kernel));
    });
}

lissom_status lissom_pose_space_begin_create(lissom_context* context, lissom_mesh rest,
                                             const lissom_named_pose* poses, int32_t pose_count,
                                             lissom_job* job) {
    return run(context, [&] {
        const auto made = std::make_shared<std::shared_ptr<PoseSpace>>();
        begin_job(*context,
                  {{},
                   [own = mesh_for_job(*context, rest), made,
                    named = named_poses(*context, poses, pose_count)](const Context& inner) {
                       *made = std::make_shared<PoseSpace>(*own, named, inner);
                   },
                   [context, made](JobResult& result) {
                       result.objects[0] = add_space(*context, **made);
                   }},
                  job);
    });
}

int32_t lissom_pose_space_pose_count(lissom_context* context, lissom_pose_space space) {
    if (!context) return -1;
    return context->count([&] { return space_of(*context, space).frames.pose_count(); });
}

int32_t lissom_pose_space_vertex_count(lissom_context* context, lissom_pose_space space) {
    if (!context) return -1;
    return context->count([&] { return space_of(*context, space).space.rest().vertex_count(); });
}

lissom_status lissom_pose_space_pose_name(lissom_context* context, lissom_pose_space space,
                                          int32_t pose, const char** name) {
    return run(context, [&] {
        require_given(name, "name");
        const std::vector<std::string> names = space_of(*context, space).space.names();
        if (pose < 0 || pose >= count_of(names)) {
            throw Error(ErrorCode::out_of_range,
                        "there are " + std::to_string(names.size()) + " poses, numbered from 0");
        }
        context->text = names[at(pose)];
        *name = context->text.c_str();
    });
}

lissom_status lissom_pose_space_read_positions(lissom_context* context, lissom_pose_space space,
                                               const lissom_input* weights,
                                               const lissom_output* positions) {
    return run(context, [&] {
        HeldSpace& own = space_of(*context, space);
        const std::span<const Vec3> points =
            own.frames.positions(read_weights(own, weights), context->kernel);
        write_points(positions, points.size(), "positions",
                     [&](std::size_t i) { return context->space.to_host(points[i]); });
    });
}

lissom_status lissom_pose_space_blend(lissom_context* context, lissom_pose_space space,
                                      const lissom_input* weights, lissom_mesh* mesh) {
    return run(context, [&] {
        require_given(mesh, "mesh");
        HeldSpace& own = space_of(*context, space);
        mesh->id = context->add_mesh(
            own.space.blend(by_name(own.space, read_weights(own, weights)), context->kernel));
    });
}

lissom_pose_targets_report lissom_default_pose_targets_report(void) {
    lissom_pose_targets_report report{};
    report.struct_size = sizeof report;
    return report;
}

lissom_status lissom_pose_space_targets(lissom_context* context, lissom_pose_space space,
                                        const lissom_input* correctives, lissom_mesh* mesh,
                                        lissom_pose_targets_report* report) {
    return run(context, [&] {
        require_given(mesh, "mesh");
        if (report) take_options(report, lissom_default_pose_targets_report());
        const PoseSpace& own = space_of(*context, space).space;
        PoseTargetOptions options;
        options.correctives = read_correctives(own, correctives);
        PoseTargetReport found;
        Mesh made = pose_targets(own, options, &found, context->kernel);
        mesh->id = context->add_mesh(std::move(made));
        if (!report) return;
        auto told = told_targets(found);
        told.struct_size = report->struct_size;
        std::memcpy(report, &told, std::min(report->struct_size, sizeof told));
    });
}

}  // extern "C"
