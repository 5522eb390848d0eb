// lissom.deform: a deformation in one call.
#include <new>

#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/deform/deform_options.h"
#include "bindings/lua/deform/deform_texts.h"
#include "bindings/lua/mesh/transform_options.h"

namespace lissom::lua {
namespace {

// One entry of `handles`, as plain data.
struct HandleSpec {
    const RegionObject* region;
    TransformOptions transform;
};

std::span<const HandleSpec> read_handles(Call& call) {
    if (!call.has("handles")) {
        call.raise(
            "lissom.deform deforms once and needs handles = { { region = ..., rotate = ... } }; "
            "lissom.deformer(mesh, {...}) makes a deformer whose handles are moved later");
    }
    const auto count = raw_length(call.lua(), call.stack_index("handles"));
    if (count == 0) call.reject("handles", "list of { region =, rotate =, ... } expected");
    auto* handles = call.scratch<HandleSpec>(count);
    for (std::size_t i = 0; i < count; ++i) {
        call.select_item("handles", index_of(i) + 1);
        new (&handles[i]) HandleSpec{call.object<RegionObject>("handles.region").get(),
                                     TransformOptions::read(call, "handles.")};
    }
    return {handles, count};
}

void add_pins(const Call& call, Deformer& deformer) {
    if (!call.has("pin")) return;
    if (call.kind("pin") == Kind::object) {
        deformer.pin(call.object<RegionObject>("pin")->current());
        return;
    }
    for (std::size_t i = 0; i < call.object_count("pin"); ++i) {
        deformer.pin(call.object_at<RegionObject>("pin", i)->current());
    }
}

void add_moved(Deformer& deformer, const HandleSpec& spec) {
    const HandleId id = deformer.add_handle(spec.region->current());
    const Vec3 center = deformer.handle(id).center;
    const Affine map = spec.transform.relative_to(center).map(Vec3::Zero());
    deformer.set_transform(id, map, center, spec.transform.turn());
}

int deform_mesh(Call& call) {
    const auto mesh = call.object<MeshObject>("mesh");
    const std::span<const HandleSpec> handles = read_handles(call);
    const bool done = call.attempt([&] {
        Deformer deformer = made_deformer(call, *mesh);
        add_pins(call, deformer);
        for (const HandleSpec& handle : handles) add_moved(deformer, handle);
        deformer.solve(FrameQuality::full, call.context());
        deformer.apply_to(mesh->mesh);
        mesh->changed();
    });
    return done ? call.push_argument() : call.fail();
}

std::vector<Parameter> handle_fields() {
    std::vector<Parameter> fields = {object("region", "lissom.Region", "Its vertices.")};
    for (Parameter& field : transform_fields("the center of the region")) {
        fields.push_back(std::move(field));
    }
    return fields;
}

std::vector<Parameter> once_parameters() {
    std::vector<Parameter> all = deform_parameters();
    all.push_back(
        either("pin",
               {object("region", "lissom.Region", ""), objects("regions", "lissom.Region", "")},
               "The region, or the regions, that stay in place.")
            .optional("none"));
    all.push_back(option_list("handles", handle_fields(),
                              "Regions that are moved as wholes: scaled, then rotated, then "
                              "translated.")
                      .optional("required"));
    return all;
}

}  // namespace

Function deform_function() {
    return {
        .name = "deform",
        .body = deform_mesh,
        .summary =
            "Deforms a mesh once: pinned regions stay, those of the handles take their "
            "transforms, and the surface between follows. Returns the mesh. `lissom.deformer` "
            "keeps its factors, for handles that move again.",
        .arguments = {object("mesh", "lissom.Mesh", "The mesh; it is changed.")},
        .options = once_parameters(),
        .results = {{"lissom.Mesh", "mesh", "The mesh itself."}},
        .effect = Effect::changes,
        .errors = {ErrorCode::region_empty, ErrorCode::topology_mismatch,
                   ErrorCode::invalid_argument, ErrorCode::handle_outside_region,
                   ErrorCode::handle_overlap, ErrorCode::singular_transform,
                   ErrorCode::unconstrained, ErrorCode::zero_area, ErrorCode::not_positive_definite,
                   ErrorCode::memory_limit, ErrorCode::cancelled},
        .example = R"(local bar = lissom.shapes.bar{ across = 2, along = 10 }
lissom.deform(bar, {
    pin = bar:region("bottom"),
    handles = { { region = bar:region("top"), rotate = { axis = "z", angle = 60 } } },
}))"};
}

}  // namespace lissom::lua
