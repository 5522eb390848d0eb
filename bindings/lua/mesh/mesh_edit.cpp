// lissom.Mesh: copies and changes of the whole mesh.
#include <array>

#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/mesh/mesh_object.h"
#include "bindings/lua/mesh/transform_options.h"
#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/edit/extract.h"
#include "kernel/mesh/edit/smooth.h"
#include "kernel/mesh/edit/subdivide.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/edit/triangulate.h"

namespace lissom::lua {
namespace {

int copy_mesh(Call& call) {
    const auto mesh = call.self<MeshObject>();
    return new_mesh(call, [&] { return Mesh(mesh->mesh); });
}

int append_mesh(Call& call) {
    const auto other = call.object<MeshObject>("other");
    return change_mesh(call, [&](Mesh& mesh) {
        // A copy, because the other mesh may be this one.
        for (const std::string& warning : append(mesh, Mesh(other->mesh), call.context())) {
            call.context().log(LogLevel::warning, warning);
        }
    });
}

int triangulate_mesh(Call& call) {
    return change_mesh(call, [&](Mesh& mesh) { triangulate(mesh, call.context()); });
}

int flip_mesh(Call& call) {
    return change_mesh(call, [&](Mesh& mesh) { flip(mesh, call.context()); });
}

int transform_mesh(Call& call) {
    const TransformOptions options = TransformOptions::read(call);
    return change_mesh(
        call, [&](Mesh& mesh) { transform(mesh, options.map(Vec3::Zero()), call.context()); });
}

int subdivide_mesh(Call& call) {
    const auto mesh = call.self<MeshObject>();
    const bool whole = !call.has("region");
    const auto region = call.object<RegionObject>("region");
    SubdivideOptions options;
    options.levels = call.integer("levels");
    options.scheme = call.choice<SubdivisionScheme>("scheme");
    return new_mesh(call, [&] {
        if (!whole) options.region = region->current();
        return subdivide(mesh->mesh, options, call.context());
    });
}

int smooth_mesh(Call& call) {
    const bool whole = !call.has("region");
    const auto region = call.object<RegionObject>("region");
    const int iterations = call.integer("iterations");
    const double strength = call.number("strength");
    const auto weights = call.choice<SmoothWeights>("weights");
    const auto boundary = call.choice<SmoothBoundary>("boundary");
    const bool keep_volume = call.boolean("keep_volume");
    return change_mesh(call, [&](Mesh& mesh) {
        SmoothOptions options;
        options.iterations = iterations;
        options.strength = strength;
        options.weights = weights;
        options.boundary = boundary;
        options.keep_volume = keep_volume;
        if (!whole) options.region = region->current();
        smooth(mesh, options, call.context());
    });
}

// Returns a new mesh and the list of old vertices that its vertices were.
template <typename Take>
int new_part(Call& call, const Take& take) {
    const auto mesh = call.self<MeshObject>();
    const auto region = call.object<RegionObject>("region");
    auto& old_vertices = call.hold<std::vector<Index>>();
    const auto result = call.create<MeshObject>();
    const bool done = call.attempt([&] {
        MeshPart part = take(mesh->mesh, region->current(), call.context());
        result.set(std::make_shared<MeshObject>(std::move(part.mesh)));
        old_vertices = std::move(part.vertex_map);
    });
    if (!done) return call.fail();
    call.remember(result.get());
    call.charge(result);
    return 1 + call.push_ids(old_vertices);
}

int extract_region(Call& call) {
    return new_part(call, [](const Mesh& mesh, const Region& region, const Context& context) {
        return extract(mesh, region, context);
    });
}

int remove_region(Call& call) {
    return new_part(call, [](const Mesh& mesh, const Region& region, const Context& context) {
        return remove(mesh, region, context);
    });
}

const std::vector<Result> kSelf = {{"lissom.Mesh", "mesh", "The mesh itself."}};

std::vector<Function> in_place_methods() {
    const SmoothOptions smooth_defaults;
    return {
        {.name = "append",
         .body = append_mesh,
         .summary =
             "Adds the vertices and faces of another mesh after its own, unconnected, with all "
             "attributes, groups and regions. A part without colors becomes white, one without "
             "texture coordinates gets 0, 0; a warning in the log names them. Other attributes "
             "have no value there (NaN).",
         .arguments = {object("other", "lissom.Mesh", "The mesh to add.")},
         .results = kSelf,
         .errors = {ErrorCode::out_of_range, ErrorCode::cancelled},
         .example = R"(local mesh = lissom.shapes.box():append(lissom.shapes.sphere())
assert(mesh:components() == 2))"},
        {.name = "triangulate",
         .body = triangulate_mesh,
         .summary = "Splits every polygon into triangles; vertices stay.",
         .results = kSelf,
         .errors = {ErrorCode::nonmanifold_edge, ErrorCode::duplicate_face, ErrorCode::cancelled},
         .example = "assert(lissom.shapes.box():triangulate():face_count() == 12)"},
        {.name = "flip",
         .body = flip_mesh,
         .summary = "Turns the surface inside out: reverses all faces and normals.",
         .results = kSelf,
         .errors = {ErrorCode::cancelled},
         .example = "assert(lissom.shapes.box():flip():volume() < 0)"},
        {.name = "transform",
         .body = transform_mesh,
         .summary = "Scales, then rotates, then translates all vertices. A mirroring scale also "
                    "reverses the faces, so that they go on looking outward.",
         .options = transform_fields("the origin"),
         .results = kSelf,
         .errors = {ErrorCode::singular_transform, ErrorCode::not_finite, ErrorCode::cancelled},
         .example = R"(local mesh = lissom.shapes.box()
mesh:transform{ rotate = { axis = "y", angle = 45 }, scale = 2, translate = { 0, 1, 0 } })"},
        {.name = "smooth",
         .body = smooth_mesh,
         .summary = "Smooths the surface by explicit Laplacian steps. Normals turn with it.",
         .options = {integer("iterations", "Number of steps.")
                         .defaults(smooth_defaults.iterations)
                         .at_least(0),
                     number("strength",
                            "Fraction of the way to the mean of its neighbours that a vertex "
                            "moves in a step.")
                         .defaults(smooth_defaults.strength)
                         .between(0, 1)
                         .above(0),
                     choice("weights", {"uniform", "cotangent"},
                            "Weights of the neighbours: uniform ones also even out the spacing, "
                            "cotangents keep it.")
                         .defaults("uniform"),
                     choice("boundary", {"fixed", "along"},
                            "Vertices on open boundaries stay, or are smoothed along their loop.")
                         .defaults("fixed"),
                     boolean("keep_volume", "Follows each step by one outwards (Taubin 1995).")
                         .defaults(smooth_defaults.keep_volume),
                     object("region", "lissom.Region", "Vertices that may move.").optional("all")},
         .results = kSelf,
         .errors = {ErrorCode::invalid_argument, ErrorCode::topology_mismatch,
                    ErrorCode::cancelled},
         .example = R"(local mesh = lissom.shapes.cactus{ vertices = 2000 }
mesh:smooth{ iterations = 5, region = mesh:region("left_arm") })"}};
}

std::vector<Function> new_mesh_methods() {
    const auto region = object("region", "lissom.Region", "A region of this mesh.");
    const std::vector<Result> part = {
        {"lissom.Mesh", "part", "The new mesh."},
        {"integer[]", "map", "For each of its vertices the vertex of the old mesh."}};
    return {
        {.name = "copy",
         .body = copy_mesh,
         .summary = "A copy with all attributes, groups and regions.",
         .results = {{"lissom.Mesh", "copy", "The new mesh."}},
         .example = "local mesh = lissom.shapes.box()\nassert(mesh:copy() == mesh)"},
        {.name = "subdivide",
         .body = subdivide_mesh,
         .summary = "A finer mesh. Old vertices keep their ids.",
         .arguments = {integer("levels", "Number of times that each face is split.")
                           .defaults(SubdivideOptions{}.levels)
                           .between(0, 12)},
         .options = {choice("scheme", {"midpoint", "loop", "catmull_clark"},
                            "midpoint keeps the shape; the others smooth it.")
                         .defaults("midpoint"),
                     object("region", "lissom.Region",
                            "Splits the faces of this region only. Triangles beside it are divided "
                            "at their common edges, and polygons take the new vertices in, so "
                            "that the mesh stays watertight.")
                         .optional("all")},
         .results = {{"lissom.Mesh", "mesh", "The new mesh."}},
         .errors = {ErrorCode::out_of_range, ErrorCode::topology_mismatch, ErrorCode::region_empty,
                    ErrorCode::memory_limit, ErrorCode::cancelled},
         .example = R"(local mesh = lissom.shapes.box():subdivide(2, { scheme = "catmull_clark" })
assert(mesh:face_count() == 96)
local top = mesh:region{ plane = { point = { 0, 0, 0 }, normal = { 0, 1, 0 } } }
assert(mesh:subdivide{ region = top }:is_closed()))"},
        {.name = "extract",
         .body = extract_region,
         .summary = "The faces of a region with their vertices as a mesh of their own.",
         .arguments = {region},
         .results = part,
         .errors = {ErrorCode::topology_mismatch, ErrorCode::region_empty, ErrorCode::cancelled},
         .example = R"(local mesh = lissom.shapes.cactus{ vertices = 2000 }
local arm, map = mesh:extract(mesh:region("left_arm"))
assert(#map == #arm))"},
        {.name = "remove",
         .body = remove_region,
         .summary = "The mesh without the faces of a region, as a new mesh.",
         .arguments = {region},
         .results = part,
         .errors = {ErrorCode::topology_mismatch, ErrorCode::region_empty, ErrorCode::cancelled},
         .example = R"(local mesh = lissom.shapes.cactus{ vertices = 2000 }
local rest = mesh:remove(mesh:region("left_arm"))
assert(not rest:is_closed()))"}};
}

}  // namespace

std::vector<Function> mesh_edit_methods() {
    std::vector<Function> methods = in_place_methods();
    for (Function& method : new_mesh_methods()) methods.push_back(std::move(method));
    return methods;
}

}  // namespace lissom::lua
