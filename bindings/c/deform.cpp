// Deformation by handles.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "bindings/c/data.h"
#include "bindings/c/jobs.h"
#include "bindings/c/thesis_parts.h"
#include "kernel/deform/contact/contact_avoid.h"
#include "kernel/deform/contact/contact_stop.h"
#include "kernel/deform/contact/contacts.h"
#include "kernel/deform/deform_report.h"
#include "kernel/deform/deformed_surface.h"
#include "kernel/deform/deformer.h"
#include "kernel/deform/pins/surface_pins.h"
#include "kernel/io/basis_file.h"

namespace lissom::c {
namespace {

// Options of a program that knows none behind `thesis` end in padding, where `loose` is now.
lissom_deformer_options taken_deformer_options(const lissom_deformer_options* given) {
    auto taken = take_options(given, lissom_default_deformer_options());
    const bool knows_loose =
        !given || given->struct_size > offsetof(lissom_deformer_options, free_rings);
    if (!knows_loose) taken.loose = LISSOM_LOOSE_ERROR;
    return taken;
}

DeformOptions deform_options(const lissom_deformer_options* given) {
    const auto taken = taken_deformer_options(given);
    DeformOptions options = taken.thesis ? literal_deform_options() : DeformOptions();
    require(taken.second >= LISSOM_SECOND_BLEND && taken.second <= LISSOM_SECOND_POISSON,
            "there is no such second system");
    require(taken.loose >= LISSOM_LOOSE_ERROR && taken.loose <= LISSOM_LOOSE_FOLLOW,
            "loose must be LOOSE_ERROR, LOOSE_STAY or LOOSE_FOLLOW");
    if (!taken.thesis) options.second = static_cast<SecondSystem>(taken.second);
    if (taken.scale_details) options.local_size = LocalSize::scale;
    options.refine = taken.refine;
    options.transition = taken.transition;
    options.loose = static_cast<UnheldParts>(taken.loose);
    options.free_rings = taken.free_rings;
    require(taken.level_vertices <= 1'000'000'000, "level_vertices must be at most 1,000,000,000");
    options.level_vertices = static_cast<Index>(taken.level_vertices);
    return options;
}

// The weight of a constraint of the host, for which 0 is hard.
std::optional<double> given_weight(double weight) {
    require(weight >= 0.0 && std::isfinite(weight),
            "a weight must be above 0, or 0 for a hard constraint");
    return weight > 0.0 ? std::optional<double>(weight) : std::nullopt;
}

HandleOptions handle_options(const lissom_handle_options* given) {
    const auto taken = take_options(given, lissom_default_handle_options());
    HandleOptions options;
    options.position = taken.position;
    options.gradient = taken.gradient;
    options.weight = given_weight(taken.weight);
    options.falloff = taken.falloff;
    return options;
}

Deformer& deformer_of(lissom_context& context, lissom_deformer deformer) {
    return context.content<Deformer>(deformer.id, Kind::deformer);
}

FrameQuality quality_of(lissom_quality quality) {
    switch (quality) {
        case LISSOM_PREVIEW:
            return FrameQuality::preview;
        case LISSOM_DRAFT:
            return FrameQuality::draft;
        case LISSOM_FULL:
            return FrameQuality::full;
    }
    throw Error(ErrorCode::invalid_argument, "there is no such quality");
}

VertexConstraint constraint_of(const lissom_context& context, Index vertex, const double* position,
                               double weight) {
    VertexConstraint constraint;
    constraint.vertex = vertex;
    if (position) constraint.position = context.space.to_kernel(position);
    constraint.weight = given_weight(weight);
    return constraint;
}

// The frame before the job that works with the deformer now, or null.
const Frame* last_frame(const lissom_context& context, lissom_deformer deformer) {
    const auto* object = context.objects.find(deformer.id, Kind::deformer);
    const bool is_busy = object && object->jobs > 0;
    return is_busy ? static_cast<const Frame*>(object->frozen.get()) : nullptr;
}

lissom_deform_report told_report(lissom_context& context, const DeformReport& found) {
    lissom_deform_report told = lissom_default_deform_report();
    told.stretch = found.stretch;
    std::copy(found.stretched.begin(), found.stretched.end(), told.stretched);
    told.flipped = count_of(found.flipped);
    if (found.crossings) told.crossings = count_of(*found.crossings);
    told.tears = count_of(found.tears);
    if (found.volume_change) told.volume_change = *found.volume_change;
    context.text.clear();
    for (const DeformWarning& warning : found.warnings) {
        told.harms |= 1U << static_cast<unsigned>(warning.harm);
        context.text += warning.message + '\n';
    }
    told.warnings = context.text.c_str();
    return told;
}

lissom_contacts told_contacts(lissom_context& context, const std::vector<FacePair>& pairs) {
    context.faces.clear();
    for (const FacePair& pair : pairs) {
        context.faces.push_back(pair.first);
        context.faces.push_back(pair.second);
    }
    return {context.faces.data(), pairs.size()};
}

std::vector<SlidingPin> sliding_pins(const lissom_context& context,
                                     std::span<const lissom_sliding_pin> given) {
    std::vector<SlidingPin> pins;
    for (const lissom_sliding_pin& one : given) {
        require(one.on >= LISSOM_PIN_PLANE && one.on <= LISSOM_PIN_SPHERE,
                "there is no such place of a pin");
        pins.push_back({one.vertex, static_cast<PinPlace>(one.on),
                        context.space.to_kernel(one.point), context.space.to_kernel(one.direction),
                        one.radius});
    }
    return pins;
}

// ---- Bases, in the host's space

Eigen::Vector3f in_host(const Space& space, const Eigen::Vector3f& v) {
    return space.to_host(v.cast<double>()).cast<float>();
}

// The axes of both spaces are the same up to order and sign: nothing is rounded.
EngineBasis host_basis(lissom_context& context, Deformer& deformer) {
    EngineBasis basis = make_engine_basis(deformer, {}, context.kernel);
    const Space& space = context.space;
    basis.origin = space.to_host(basis.origin);
    for (EngineHandle& handle : basis.handles) handle.center = in_host(space, handle.center);
    for (Eigen::Vector3f& p : basis.rest) p = in_host(space, p);
    for (auto& weights : basis.weights) {
        for (Eigen::Vector4f& w : weights) w.head<3>() = in_host(space, w.head<3>());
    }
    return basis;
}

Affine host_affine(const lissom_transform& transform) {
    Affine map;
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) map.linear(r, c) = transform.m[4 * r + c];
        map.translation[r] = transform.m[4 * r + 3];
    }
    return map;
}

std::vector<std::vector<Affine>> key_poses(const lissom_context& context, const Deformer& deformer,
                                           std::span<const lissom_transform> transforms,
                                           std::size_t count) {
    const std::size_t handles = deformer.handles().size();
    require(count <= kMaxBasisKeys, "there are more than 256 key poses");
    require(transforms.size() == count * handles,
            "there must be a transform for each key and handle");
    std::vector<std::vector<Affine>> poses(count);
    for (std::size_t i = 0; i < transforms.size(); ++i) {
        poses[i / handles].push_back(context.space.to_kernel(transforms[i]));
    }
    return poses;
}

// Key poses with the host's transforms and positions.
std::vector<BasisKey> host_keys(const lissom_context& context, std::vector<BasisKey> keys,
                                std::span<const lissom_transform> transforms) {
    std::size_t next = 0;
    for (BasisKey& key : keys) {
        for (Affine& map : key.transforms) map = host_affine(transforms[next++]);
        for (Vec3& p : key.positions) p = context.space.to_host(p);
    }
    return keys;
}

}  // namespace

Frame frame_of(lissom_context& context, std::uint64_t deformer) {
    auto& own = context.content<Deformer>(deformer, Kind::deformer);
    return {own.region().vertices(), own.positions(), normals_of(own, context.kernel)};
}

}  // namespace lissom::c

using namespace lissom;
using namespace lissom::c;

extern "C" {

lissom_deformer_options lissom_default_deformer_options(void) {
    lissom_deformer_options options{};
    options.struct_size = sizeof options;
    return options;
}

lissom_handle_options lissom_default_handle_options(void) {
    lissom_handle_options options{};
    options.struct_size = sizeof options;
    options.position = true;
    options.gradient = true;
    return options;
}

lissom_status lissom_deformer_create(lissom_context* context, lissom_mesh mesh,
                                     lissom_region region, const lissom_deformer_options* options,
                                     lissom_deformer* deformer) {
    return run(context, [&] {
        require_given(deformer, "deformer");
        const Mesh& own = mesh_of(*context, mesh);
        const Region all =
            region.id == 0 ? Region::all(own.shared_topology()) : region_of(*context, region);
        auto made = std::make_shared<Deformer>(own, all, deform_options(options), context->kernel);
        context->sharing.belongs(made.get(), own);
        deformer->id = context->add(Kind::deformer, std::move(made));
    });
}

lissom_status lissom_deformer_add_handle(lissom_context* context, lissom_deformer deformer,
                                         lissom_region vertices,
                                         const lissom_handle_options* options, int32_t* handle) {
    return run(context, [&] {
        require_given(handle, "handle");
        *handle = deformer_of(*context, deformer)
                      .add_handle(region_of(*context, vertices), handle_options(options))
                      .value;
    });
}

lissom_status lissom_deformer_pin(lissom_context* context, lissom_deformer deformer,
                                  lissom_region vertices) {
    return run(context,
               [&] { deformer_of(*context, deformer).add_handle(region_of(*context, vertices)); });
}

lissom_status lissom_deformer_remove_handle(lissom_context* context, lissom_deformer deformer,
                                            int32_t handle) {
    return run(context, [&] { deformer_of(*context, deformer).remove_handle(HandleId{handle}); });
}

lissom_status lissom_deformer_handle_center(lissom_context* context, lissom_deformer deformer,
                                            int32_t handle, double center[3]) {
    return run(context, [&] {
        require_given(center, "center");
        const Vec3 own =
            context->space.to_host(deformer_of(*context, deformer).handle(HandleId{handle}).center);
        for (int k = 0; k < 3; ++k) center[k] = own[k];
    });
}

lissom_status lissom_deformer_set_transform(lissom_context* context, lissom_deformer deformer,
                                            int32_t handle, const lissom_transform* transform) {
    return run(context, [&] {
        require_given(transform, "transform");
        deformer_of(*context, deformer)
            .set_transform(HandleId{handle}, context->space.to_kernel(*transform));
    });
}

lissom_status lissom_deformer_get_transform(lissom_context* context, lissom_deformer deformer,
                                            int32_t handle, lissom_transform* transform) {
    return run(context, [&] {
        require_given(transform, "transform");
        *transform = context->space.to_host(
            deformer_of(*context, deformer).pose(HandleId{handle}).transform);
    });
}

lissom_status lissom_deformer_constrain(lissom_context* context, lissom_deformer deformer,
                                        int32_t vertex, const double position[3], double weight) {
    return run(context, [&] {
        require_given(position, "position");
        deformer_of(*context, deformer)
            .constrain(constraint_of(*context, vertex, position, weight));
    });
}

lissom_status lissom_deformer_free(lissom_context* context, lissom_deformer deformer,
                                   int32_t vertex) {
    return run(context, [&] {
        deformer_of(*context, deformer).constrain(constraint_of(*context, vertex, nullptr, 0.0));
    });
}

lissom_status lissom_deformer_prepare(lissom_context* context, lissom_deformer deformer) {
    return run(context, [&] { deformer_of(*context, deformer).prepare(context->kernel); });
}

lissom_status lissom_deformer_begin_prepare(lissom_context* context, lissom_deformer deformer,
                                            lissom_job* job) {
    return run(context, [&] {
        require_given(job, "job");
        const auto own = context->share<Deformer>(deformer.id, Kind::deformer);
        begin_job(
            *context,
            {{{deformer.id, Kind::deformer}}, [own](const Context& inner) { own->prepare(inner); }},
            job);
    });
}

lissom_status lissom_deformer_solve(lissom_context* context, lissom_deformer deformer,
                                    lissom_quality quality) {
    return run(context, [&] {
        deformer_of(*context, deformer).solve(quality_of(quality), context->kernel);
    });
}

lissom_status lissom_deformer_begin_solve(lissom_context* context, lissom_deformer deformer,
                                          lissom_quality quality, lissom_job* job) {
    return run(context, [&] {
        require_given(job, "job");
        const auto own = context->share<Deformer>(deformer.id, Kind::deformer);
        begin_job(*context,
                  {{{deformer.id, Kind::deformer}},
                   [own, wanted = quality_of(quality)](const Context& inner) {
                       own->solve(wanted, inner);
                   }},
                  job);
    });
}

int32_t lissom_deformer_row_count(lissom_context* context, lissom_deformer deformer) {
    if (!context) return -1;
    return context->count([&] {
        if (const Frame* frame = last_frame(*context, deformer)) return count_of(frame->rows);
        return deformer_of(*context, deformer).region().size();
    });
}

lissom_status lissom_deformer_read_rows(lissom_context* context, lissom_deformer deformer,
                                        const lissom_output* vertices) {
    return run(context, [&] {
        const Frame* frame = last_frame(*context, deformer);
        write_integers(vertices,
                       frame ? frame->rows : deformer_of(*context, deformer).region().vertices(),
                       "vertices");
    });
}

lissom_status lissom_deformer_read_positions(lissom_context* context, lissom_deformer deformer,
                                             const lissom_output* positions) {
    return run(context, [&] {
        const Frame* frame = last_frame(*context, deformer);
        const std::vector<Vec3>& points =
            frame ? frame->positions : deformer_of(*context, deformer).positions();
        write_points(positions, points.size(), "positions",
                     [&](std::size_t i) { return context->space.to_host(points[i]); });
    });
}

lissom_status lissom_deformer_read_normals(lissom_context* context, lissom_deformer deformer,
                                           const lissom_output* normals) {
    return run(context, [&] {
        const Frame* frame = last_frame(*context, deformer);
        const std::vector<Vec3>& own =
            frame ? frame->normals : normals_of(deformer_of(*context, deformer), context->kernel);
        write_directions(normals, own.size(), "normals",
                         [&](std::size_t i) { return context->space.to_host(own[i]); });
    });
}

lissom_status lissom_deformer_apply(lissom_context* context, lissom_deformer deformer,
                                    lissom_mesh mesh) {
    return run(context, [&] {
        Mesh& own = mesh_of(*context, mesh);
        deformer_of(*context, deformer).apply_to(own);
        context->sharing.changed(own);
    });
}

lissom_deform_report lissom_default_deform_report(void) {
    lissom_deform_report report{};
    report.struct_size = sizeof report;
    report.stretch = 1.0;
    report.stretched[0] = report.stretched[1] = -1;
    report.crossings = -1;
    report.volume_change = std::numeric_limits<double>::quiet_NaN();
    report.warnings = "";
    return report;
}

lissom_status lissom_deformer_report(lissom_context* context, lissom_deformer deformer,
                                     lissom_mesh mesh, bool crossings,
                                     lissom_deform_report* report) {
    return run(context, [&] {
        require_given(report, "report");
        take_options(report, lissom_default_deform_report());
        lissom_deform_report told =
            told_report(*context, report_of(deformer_of(*context, deformer),
                                            mesh_of(*context, mesh), {crossings}, context->kernel));
        told.struct_size = report->struct_size;
        std::memcpy(report, &told, std::min(report->struct_size, sizeof told));
    });
}

lissom_status lissom_deformer_find_contacts(lissom_context* context, lissom_deformer deformer,
                                            lissom_mesh mesh, lissom_contacts* contacts) {
    return run(context, [&] {
        require_given(contacts, "contacts");
        *contacts = told_contacts(*context, contacts_of(deformer_of(*context, deformer),
                                                        mesh_of(*context, mesh), context->kernel));
    });
}

lissom_status lissom_deformer_solve_until_contact(lissom_context* context, lissom_deformer deformer,
                                                  lissom_mesh mesh, double* share,
                                                  lissom_contacts* contacts) {
    return run(context, [&] {
        require_given(share, "share");
        const ContactStop stop = solve_until_contact(deformer_of(*context, deformer),
                                                     mesh_of(*context, mesh), context->kernel);
        *share = stop.share;
        if (contacts) *contacts = told_contacts(*context, stop.contacts);
    });
}

lissom_status lissom_deformer_solve_avoiding_contacts(lissom_context* context,
                                                      lissom_deformer deformer, lissom_mesh mesh,
                                                      int32_t* before, lissom_contacts* left) {
    return run(context, [&] {
        require_given(left, "left");
        const AvoidedContacts avoided = solve_avoiding_contacts(
            deformer_of(*context, deformer), mesh_of(*context, mesh), context->kernel);
        if (before) *before = avoided.before;
        *left = told_contacts(*context, avoided.contacts);
    });
}

lissom_status lissom_deformer_solve_with_pins(lissom_context* context, lissom_deformer deformer,
                                              const lissom_sliding_pin* pins, size_t pin_count,
                                              double* distance) {
    return run(context, [&] {
        if (pin_count > 0) require_given(pins, "pins");
        require_given(distance, "distance");
        *distance = solve_with_pins(deformer_of(*context, deformer),
                                    sliding_pins(*context, {pins, pin_count}), context->kernel);
    });
}

lissom_status lissom_deformer_reset(lissom_context* context, lissom_deformer deformer) {
    return run(context, [&] { deformer_of(*context, deformer).reset(); });
}

lissom_status lissom_deformer_rebase(lissom_context* context, lissom_deformer deformer) {
    return run(context, [&] { deformer_of(*context, deformer).rebase(); });
}

lissom_status lissom_deformer_encode_basis(lissom_context* context, lissom_deformer deformer,
                                           lissom_bytes* bytes) {
    return lissom_deformer_encode_keyed_basis(context, deformer, nullptr, 0, 0, bytes);
}

lissom_status lissom_deformer_encode_keyed_basis(lissom_context* context, lissom_deformer deformer,
                                                 const lissom_transform* transforms,
                                                 size_t transform_count, size_t key_count,
                                                 lissom_bytes* bytes) {
    return run(context, [&] {
        require_given(bytes, "bytes");
        if (transform_count > 0) require_given(transforms, "transforms");
        const std::span<const lissom_transform> given(transforms, transform_count);
        Deformer& own = deformer_of(*context, deformer);
        const auto poses = key_poses(*context, own, given, key_count);
        EngineBasis basis = host_basis(*context, own);
        set_keys(basis, host_keys(*context, make_basis_keys(own, poses, context->kernel), given));
        context->bytes = encode_basis(basis);
        *bytes = {context->bytes.data(), context->bytes.size()};
    });
}

}  // extern "C"
