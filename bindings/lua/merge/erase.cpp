// mesh:erase and mesh:clone: features of one mesh removed, and repeated.
#include <memory>
#include <utility>

#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/merge/paste_object.h"
#include "kernel/merge/paste/erase/erase_feature.h"

namespace lissom::lua {
namespace {

void push_erase_report(const Call& call, const EraseReport& report) {
    lua_createtable(call.lua(), 0, 15);
    call.set_field("loop_size", call.push(report.loop_size));
    call.set_field("loop_cost", call.push(report.loop_cost));
    call.set_field("ring", call.push(report.ring));
    call.set_field("removed_vertices", call.push(report.removed_vertices));
    call.set_field("removed_faces", call.push(report.removed_faces));
    call.set_field("added_faces", call.push(report.patch.face_count));
    call.set_field("limit_reached", call.push(report.patch.limit_reached));
    const bool curved = report.continuity == FairContinuity::curvature;
    call.set_field("continuity", call.push(curved ? "curvature" : "tangents"));
    call.set_field("max_dihedral", call.push(report.max_dihedral / kDegree));
    call.set_field("max_around", call.push(report.max_around / kDegree));
    call.set_field("density", call.push(report.density));
    call.set_field("ok", call.push(report.ok));
    call.set_field("verdict", call.push(report.verdict));
}

// The vertices of the patch, those of its rim included.
Region patch_region(const Mesh& mesh, const FillReport& patch) {
    std::vector<Index> vertices;
    for (Index f = patch.first_face; f < mesh.face_count(); ++f) {
        for (const Index v : mesh.topology().face(f)) vertices.push_back(v);
    }
    return {mesh.shared_topology(), std::move(vertices)};
}

// Result of an erasure, until it is pushed.
struct Erasure {
    std::shared_ptr<MeshObject> mesh;
    std::shared_ptr<PathObject> loop;
    std::shared_ptr<RegionObject> patch;
    EraseReport report;
};

Erasure erased(const std::shared_ptr<MeshObject>& mesh, const Region& region,
               const EraseOptions& options, const Context& context) {
    ErasedFeature feature = erase_feature(mesh->mesh, region, options, context);
    Erasure result;
    result.report = feature.report;
    result.loop = std::make_shared<PathObject>(mesh, std::move(feature.loop));
    result.mesh = std::make_shared<MeshObject>(std::move(feature.mesh));
    result.patch = std::make_shared<RegionObject>(
        result.mesh, patch_region(result.mesh->mesh, result.report.patch));
    return result;
}

int erase_region(Call& call) {
    const auto mesh = call.self<MeshObject>();
    const auto region = call.object<RegionObject>("region");
    EraseOptions options;
    options.ring = call.number("ring");
    options.bend = call.number("bend");
    options.continuity = call.choice<FairContinuity>("continuity");
    options.maximum_vertices = call.integer("maximum_vertices");
    auto& made = call.hold<Erasure>();
    const auto result = call.create<MeshObject>();
    const bool done = call.attempt([&] {
        made = erased(mesh.share(), region->current(), options, call.context());
        result.set(made.mesh);
    });
    if (!done) return call.fail();
    call.remember(made.mesh.get());
    call.charge(result);
    push_erase_report(call, made.report);
    const auto loop = call.create<PathObject>();
    call.set_field("loop");
    const auto patch = call.create<RegionObject>();
    call.set_field("patch");
    const bool set = call.attempt_quick([&] {
        loop.set(made.loop);
        patch.set(made.patch);
    });
    return set ? 2 : call.fail();
}

PasteOptions clone_options(const Call& call) {
    PasteOptions options;
    options.share = call.number("ring");
    options.normals = call.number("normals");
    read_clearing(call, options);
    return options;
}

int clone_region(Call& call) {
    const auto mesh = call.self<MeshObject>();
    const auto region = call.object<RegionObject>("from");
    const bool given = call.is_object<RegionObject>("feature");
    const PasteMergeOptions how = read_paste_merge(call, "size");
    auto& inputs = call.hold<MergeInputs>();
    auto& result = call.hold<std::unique_ptr<PasteResult>>();
    const bool done = call.attempt([&] {
        std::optional<Region> feature;
        if (given) feature = call.object<RegionObject>("feature")->current();
        Paste paste(mesh->mesh, mesh->mesh, region->current(), feature, std::nullopt,
                    read_placement(call, "", {}, "to"), clone_options(call), call.context());
        paste.optimize(20, call.context());
        result = std::make_unique<PasteResult>(paste.merge(how, call.context()));
        inputs.vertices.assign(2, mesh->mesh.vertex_count());
        inputs.faces.assign(2, mesh->mesh.face_count());
    });
    return done ? push_paste_result(call, *result, inputs) : call.fail();
}

std::vector<Parameter> clone_parameters() {
    std::vector<Parameter> all = {
        object("from", "lissom.Region", "Part of the surface around the feature."),
        vector("to",
               "The middle of the feature comes to lie on the point of the mesh that is nearest "
               "to this."),
        either("feature",
               {object("region", "lissom.Region", ""),
                choice("auto", {"auto"}, "The core of the region.")},
               "See lissom.paste.")
            .optional("auto")};
    for (const Parameter& field : placement_fields(false)) {
        if (field.name != "at") all.push_back(field);
    }
    all.push_back(clear_parameter());
    all.push_back(number("ring", "Share of the region that is searched if no feature is given.")
                      .between(0.01, 0.99)
                      .defaults(0.5));
    all.push_back(number("normals", "Weight of the normals in the energy of a boundary.")
                      .at_least(0)
                      .defaults(0.0));
    for (const Parameter& option : paste_merge_parameters("size")) all.push_back(option);
    return all;
}

constexpr const char* kNose = R"(local head = lissom.shapes.sphere{ segments = 24 }
for i = 1, head:vertex_count() do
    local x, y, z = head:position(i)
    if z > 0 then head:set_position(i, x, y, z + 0.5 * math.exp(-14 * (x * x + y * y))) end
end
local nose = head:region{ sphere = { center = { 0, 0, 1.2 }, radius = 0.75 } }
)";

}  // namespace

std::vector<Function> erase_methods_of_mesh() {
    const EraseOptions defaults;
    const std::string nose = kNose;
    return {
        {.name = "erase",
         .body = erase_region,
         .summary =
             "A new mesh without the marked feature: it is cut along the least-cost loop around "
             "the region, which runs over even surface, and closed by a patch that continues "
             "the surface. The feature may have handles and open boundaries. Everything outside "
             "the loop keeps its values to the bit; labels, colours and texture coordinates are "
             "continued over the patch.",
         .arguments = {object("region", "lissom.Region",
                              "The feature to remove, marked casually.")},
         .options =
             {number("ring",
                     "Distance from the region within which the mesh may be cut, in radii of the "
                     "region's outline. 0: along the outline itself.")
                  .at_least(0)
                  .defaults(defaults.ring),
              number("bend",
                     "Cost of a cut through bent surface: an edge costs its length "
                     "times 1 + bend R k, with the outline's radius R and k the sum of both "
                     "principal curvatures, without signs. 0: the shortest loop.")
                  .at_least(0)
                  .defaults(defaults.bend),
              choice("continuity", {"tangents", "curvature"},
                     "Continuity of the patch with the surface around it: curvature if that "
                     "is even around the cut, else tangents.")
                  .defaults("curvature"),
              integer("maximum_vertices", "Vertices that the patch may have.")
                  .at_least(0)
                  .defaults(defaults.maximum_vertices)},
         .results = {{"lissom.Mesh", "mesh", "The mesh without the feature."},
                     {"lissom.EraseReport", "report", "Measures of the result."}},
         .errors = {ErrorCode::topology_mismatch, ErrorCode::region_empty, ErrorCode::not_a_disk,
                    ErrorCode::boundary_conflict, ErrorCode::invalid_argument,
                    ErrorCode::not_positive_definite, ErrorCode::memory_limit,
                    ErrorCode::cancelled},
         .example = nose + R"(local plain, report = head:erase(nose)
assert(plain:is_closed() and plain:bounds().max[3] < 1.1)
print(report.removed_faces, #report.patch))"},
        {.name = "clone",
         .body = clone_region,
         .summary =
             "A new mesh that has a feature of this one twice: it is pasted onto another place of "
             "the same mesh, along the loop around it that fits best (lissom.paste with itself as "
             "target).",
         .options = clone_parameters(),
         .results = {{"lissom.Mesh", "mesh", "The mesh with both."},
                     {"lissom.MergeReport", "report",
                      "The report of lissom.merge; its field `paste` is a lissom.PasteReport."}},
         .errors = {ErrorCode::topology_mismatch, ErrorCode::region_empty,
                    ErrorCode::boundary_conflict, ErrorCode::not_a_disk,
                    ErrorCode::invalid_argument, ErrorCode::mesh_empty, ErrorCode::not_finite,
                    ErrorCode::not_positive_definite, ErrorCode::nonmanifold_edge,
                    ErrorCode::skin_mismatch, ErrorCode::zero_area, ErrorCode::memory_limit,
                    ErrorCode::cancelled},
         .example = nose + R"(local two = head:clone{ from = nose, to = { 0, 0, -1 } }
assert(two:is_closed() and two:bounds().min[3] < -1.2))"}};
}

std::vector<Record> erase_records() {
    return {
        {"lissom.EraseReport",
         "Report of mesh:erase.",
         {{"lissom.Path", "loop", "The cut, on the mesh as it was."},
          {"lissom.Region", "patch", "The patch, with its rim, on the new mesh."},
          {"integer", "loop_size", "Vertices of the cut."},
          {"number", "loop_cost", "Its cost; see `bend`."},
          {"number", "ring", "Width around the region that was searched, in mesh units."},
          {"integer", "removed_vertices", "Vertices that went."},
          {"integer", "removed_faces", "Faces that went."},
          {"integer", "added_faces", "Faces of the patch."},
          {"string", "continuity", "Continuity of the patch: curvature or tangents."},
          {"number", "max_dihedral",
           "The greatest angle between neighbouring faces of which one is in the patch."},
          {"number", "max_around", "The same of the surface within three rings around the patch."},
          {"number", "density",
           "Density of the patch, over that of the surface around it: 1, or up to 4 if it "
           "would have been too coarse to bend from a steep rim."},
          {"boolean", "ok",
           "The patch turns by at most 30 degrees from face to face, or no more than the "
           "surface around it."},
          {"string", "verdict", "The same in one line, with the reason."},
          {"boolean", "limit_reached", "The patch has `maximum_vertices`."}}}};
}

}  // namespace lissom::lua
