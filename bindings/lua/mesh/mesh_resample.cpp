// lissom.Mesh: other triangles for the same surface, its mirror image, its shell, its place.
#include "bindings/lua/mesh/mesh_resample.h"

#include <optional>
#include <string>

#include "bindings/lua/mesh/mesh_object.h"
#include "kernel/mesh/edit/align.h"
#include "kernel/mesh/edit/symmetrize.h"
#include "kernel/mesh/edit/thicken.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/resample/decimate.h"
#include "kernel/mesh/resample/remesh.h"

namespace lissom::lua {
namespace {

std::optional<double> given_number(const Call& call, const char* name) {
    if (!call.has(name)) return std::nullopt;
    return call.number(name);
}

double crease_angle(const Call& call) {
    return call.number("crease") * kDegree;
}

int decimate_mesh(Call& call) {
    const auto mesh = call.self<MeshObject>();
    const bool whole = !call.has("region");
    const auto region = call.object<RegionObject>("region");
    // Holds a region: a local one would leak if an error of Lua leaves this function.
    auto& options = call.hold<DecimateOptions>();
    if (call.has("faces")) options.faces = call.integer("faces");
    options.error = given_number(call, "error");
    options.crease = crease_angle(call);
    options.attributes = call.number("attributes");
    options.keep_borders = call.boolean("keep_borders");
    double error = 0.0;
    const int results = new_mesh(call, [&] {
        if (!whole) options.region = region->current();
        DecimateResult made = decimate(mesh->mesh, options, call.context());
        error = made.error;
        return std::move(made.mesh);
    });
    if (results != 1) return results;
    return 1 + call.push(error);
}

int remesh_mesh(Call& call) {
    const auto mesh = call.self<MeshObject>();
    const bool whole = !call.has("region");
    const auto region = call.object<RegionObject>("region");
    auto& options = call.hold<RemeshOptions>();
    options.edge = given_number(call, "edge");
    options.error = given_number(call, "error");
    options.shortest = given_number(call, "shortest");
    options.crease = crease_angle(call);
    options.iterations = call.integer("iterations");
    return new_mesh(call, [&] {
        if (!whole) options.region = region->current();
        return remesh(mesh->mesh, options, call.context()).mesh;
    });
}

int symmetrize_mesh(Call& call) {
    const auto mesh = call.self<MeshObject>();
    SymmetrizeOptions options;
    options.point = call.vector("plane.point");
    options.normal = call.vector("plane.normal");
    options.weld = given_number(call, "weld");
    auto& mirror = call.hold<std::vector<Index>>();
    const int results = new_mesh(call, [&] {
        Symmetrized made = symmetrize(mesh->mesh, options, call.context());
        mirror = std::move(made.mirror);
        return std::move(made.mesh);
    });
    if (results != 1) return results;
    return 1 + call.push_ids(mirror);
}

int push_pairs(const Call& call, const std::vector<FacePair>& pairs) {
    lua_createtable(call.lua(), count_of(pairs), 0);
    for (Index i = 0; i < count_of(pairs); ++i) {
        const Index faces[] = {pairs[at(i)].first, pairs[at(i)].second};
        call.push_ids(faces);
        lua_rawseti(call.lua(), -2, i + 1);
    }
    return 1;
}

int thicken_mesh(Call& call) {
    const auto mesh = call.self<MeshObject>();
    ThickenOptions options;
    options.thickness = call.number("thickness");
    options.outside = call.number("outside");
    options.check = call.boolean("check");
    auto& crossings = call.hold<std::vector<FacePair>>();
    const int results = new_mesh(call, [&] {
        Shell shell = thicken(mesh->mesh, options, call.context());
        crossings = std::move(shell.crossings);
        return std::move(shell.mesh);
    });
    if (results != 1) return results;
    return 1 + push_pairs(call, crossings);
}

int offset_mesh(Call& call) {
    const double distance = call.number("distance");
    const bool check = call.boolean("check");
    auto& crossings = call.hold<std::vector<FacePair>>();
    const int results = change_mesh(
        call, [&](Mesh& mesh) { crossings = offset(mesh, distance, check, call.context()); });
    if (results != 1) return results;
    return 1 + push_pairs(call, crossings);
}

int align_mesh(Call& call) {
    const auto target = call.object<MeshObject>("to");
    AlignOptions options;
    options.start = call.choice<AlignStart>("start");
    options.scale = call.boolean("scale");
    options.overlap = call.number("overlap");
    options.samples = call.integer("samples");
    options.iterations = call.integer("iterations");
    auto& found = call.hold<std::optional<AlignReport>>();
    const int results = change_mesh(call, [&](Mesh& mesh) {
        const AlignReport report = align(mesh, target->mesh, options, call.context());
        transform(mesh, report.transform, call.context());
        found = report;
    });
    if (results != 1) return results;
    const AlignReport& report = *found;
    lua_createtable(call.lua(), 0, 7);
    call.set_field("matrix", call.push_affine(report.transform));
    call.set_field("scale", call.push(report.scale));
    call.set_field("residual_before", call.push(report.residual_before));
    call.set_field("residual", call.push(report.residual));
    call.set_field("greatest", call.push(report.greatest));
    call.set_field("iterations", call.push(report.iterations));
    call.set_field("converged", call.push(report.converged));
    return 2;
}

const std::vector<Result> kOneMesh = {{"lissom.Mesh", "mesh", "The new mesh."}};

Parameter crease_option(double degrees) {
    return number("crease",
                  "Edges whose faces' normals differ by more than this are lines that are kept; "
                  "180 for none.")
        .defaults(degrees)
        .between(0, 180)
        .in("degrees");
}

Parameter check_option() {
    return boolean("check", "Whether faces that run through one another are searched for.")
        .defaults(true);
}

Function decimate_method() {
    return {
        .name = "decimate",
        .body = decimate_mesh,
        .summary =
            "A mesh with fewer faces for nearly the same surface: edges collapse, those first that "
            "change shape and attributes the least (quadrics). Polygons are triangulated. Open "
            "borders, seams of texture coordinates, outlines of groups, materials and named "
            "regions stay lines; morph targets and skins are carried. If those lines need more "
            "faces than were wanted, there are more.",
        .options =
            {integer("faces", "Number of faces wanted; give this or `error`, or both.")
                 .at_least(1)
                 .optional("no limit"),
             number("error",
                    "Greatest error of one collapse: the root of the mean squared distance to the "
                    "planes of the faces that it replaces.")
                 .at_least(0)
                 .in("mesh units")
                 .optional("no limit"),
             object("region", "lissom.Region", "Only faces of this region change.").optional("all"),
             crease_option(180),
             number("attributes",
                    "A difference as great as the range of an attribute counts as this part of the "
                    "mesh's size; 0 looks at the shape alone.")
                 .defaults(DecimateOptions{}.attributes)
                 .at_least(0),
             boolean("keep_borders", "Vertices of open borders stay.").defaults(false)},
        .results = {kOneMesh[0], {"number", "error", "Greatest error of a collapse."}},
        .errors = {ErrorCode::invalid_argument, ErrorCode::topology_mismatch,
                   ErrorCode::nonmanifold_edge, ErrorCode::memory_limit, ErrorCode::cancelled},
        .example = R"(local sphere = lissom.shapes.sphere()
local coarse, error = sphere:decimate{ faces = 200 }
assert(coarse:face_count() <= 200 and coarse:is_closed() and error < .05))"};
}

Function remesh_method() {
    const RemeshOptions defaults;
    return {
        .name = "remesh",
        .body = remesh_mesh,
        .summary =
            "The surface with triangles of even size and shape: long edges are split, short ones "
            "collapse, others flip, and vertices move along the surface. Open borders, seams, "
            "outlines of groups, materials and named regions, creases and their corners stay. "
            "Attributes are those of the nearest point of the old surface.",
        .options =
            {number("edge", "Length of edges; the longest where they adapt.")
                 .above(0)
                 .in("mesh units")
                 .optional("the mean of the mesh"),
             number("error",
                    "Edges are shorter where the surface is curved, so that they stay this near to "
                    "it.")
                 .above(0)
                 .in("mesh units")
                 .optional("all edges alike"),
             number("shortest", "Shortest edge where they adapt.")
                 .above(0)
                 .in("mesh units")
                 .optional("an eighth of `edge`"),
             object("region", "lissom.Region",
                    "Only faces of this region change, and not its outline.")
                 .optional("all"),
             crease_option(defaults.crease / kDegree),
             integer("iterations", "Rounds of splits, collapses, flips and moves.")
                 .defaults(defaults.iterations)
                 .between(0, 100)},
        .results = kOneMesh,
        .errors = {ErrorCode::invalid_argument, ErrorCode::out_of_range,
                   ErrorCode::topology_mismatch, ErrorCode::nonmanifold_edge,
                   ErrorCode::memory_limit, ErrorCode::cancelled},
        .example = R"(local box = lissom.shapes.box():remesh{ edge = .2 }
assert(box:is_closed() and math.abs(box:volume() - 1) < 1e-9))"};
}

Function symmetrize_method() {
    return {
        .name = "symmetrize",
        .body = symmetrize_mesh,
        .summary =
            "The half on one side of a plane with its mirror image, welded along the plane. A mesh "
            "that crosses the plane is cut; one that only reaches it is a half model. Texture "
            "coordinates are those of the half, morph targets are mirrored.",
        .options = {options("plane",
                            {vector("point", "A point of the plane."),
                             vector("normal", "Towards the half that is kept.")},
                            "The plane of symmetry."),
                    number("weld", "Vertices of open borders this near to the plane are on it.")
                        .at_least(0)
                        .in("mesh units")
                        .optional("a hundredth of the mean edge")},
        .results = {kOneMesh[0],
                    {"integer[]", "mirror",
                     "For each vertex its mirror image; itself on the plane."}},
        .errors = {ErrorCode::mesh_empty, ErrorCode::invalid_argument, ErrorCode::not_finite,
                   ErrorCode::boundary_conflict, ErrorCode::nonmanifold_vertex,
                   ErrorCode::memory_limit, ErrorCode::cancelled},
        .example = R"(local cactus = lissom.shapes.cactus{ vertices = 2000 }
local even, mirror = cactus:symmetrize{ plane = { point = { 0, 0, 0 }, normal = { 1, 0, 0 } } }
assert(even:is_closed() and mirror[mirror[1]] == 1))"};
}

Function thicken_method() {
    return {
        .name = "thicken",
        .body = thicken_mesh,
        .summary =
            "A solid shell around the surface, for printing: a second side inside, with rims along "
            "open borders. The vertices and faces of the surface come first, then those of the "
            "inner side in the same order, then the rims. A closed surface becomes hollow.",
        .options = {number("thickness", "Thickness of the shell.").above(0).in("mesh units"),
                    number("outside", "Part of the thickness that lies outside the surface.")
                        .defaults(0.0)
                        .between(0, 1),
                    check_option()},
        .results = {kOneMesh[0],
                    {"integer[][]", "crossings",
                     "Pairs of faces that run through one another and did not before."}},
        .errors = {ErrorCode::mesh_empty, ErrorCode::invalid_argument, ErrorCode::out_of_range,
                   ErrorCode::memory_limit, ErrorCode::cancelled},
        .example = R"(local shell, crossings = lissom.shapes.grid():thicken{ thickness = .02 }
assert(shell:is_closed() and #crossings == 0 and shell:volume() > 0))"};
}

Function offset_method() {
    return {.name = "offset",
            .body = offset_mesh,
            .summary = "Moves the surface along its normals, so that its faces move evenly.",
            .options = {number("distance", "Distance outwards; inwards if it is negative.")
                            .in("mesh units"),
                        check_option()},
            .results = {{"lissom.Mesh", "mesh", "The mesh itself."},
                        {"integer[][]", "crossings",
                         "Pairs of faces that run through one another and did not before."}},
            .errors = {ErrorCode::invalid_argument, ErrorCode::cancelled},
            .example = R"(local box = lissom.shapes.box():offset{ distance = .5 }
assert(math.abs(box:volume() - 8) < .1))"};
}

Function align_method() {
    const AlignOptions defaults;
    return {.name = "align",
            .body = align_mesh,
            .summary =
                "Moves the mesh onto another surface as nearly as it fits (iterated closest "
                "points), and tells how near that is.",
            .options = {object("to", "lissom.Mesh", "The surface that it is put onto."),
                        choice("start", {"placed", "axes"},
                               "Begins as the meshes lie, or with the centroids and principal axes "
                               "on each other, whatever the meshes' places.")
                            .defaults("placed"),
                        boolean("scale", "Scales the mesh too.").defaults(defaults.scale),
                        number("overlap", "Part of the surfaces that both have.")
                            .defaults(defaults.overlap)
                            .between(0, 1)
                            .above(0),
                        integer("samples", "Points on each surface that are used.")
                            .defaults(defaults.samples)
                            .at_least(10),
                        integer("iterations", "Greatest number of steps.")
                            .defaults(defaults.iterations)
                            .at_least(0)},
            .results = {{"lissom.Mesh", "mesh", "The mesh itself."},
                        {"lissom.AlignReport", "report", "The motion and how near it comes."}},
            .errors = {ErrorCode::mesh_empty, ErrorCode::invalid_argument, ErrorCode::memory_limit,
                       ErrorCode::cancelled},
            .example = R"(local head = lissom.shapes.head()
local turned = head:copy():transform{ rotate = { axis = "y", angle = 20 }, scale = 1.1 }
local _, report = turned:align{ to = head, scale = true }
assert(report.residual < 1e-3 * head:size()))"};
}

}  // namespace

std::vector<Record> resample_records() {
    return {{"lissom.AlignReport",
             "The motion of one surface onto another.",
             {{"number[][]", "matrix", "The motion, as rows {x, y, z, shift}."},
              {"number", "scale", "Factor by which it scaled the mesh."},
              {"number", "residual_before",
               "RMS distance between the surfaces before, over the part that they both have."},
              {"number", "residual", "The same now."},
              {"number", "greatest", "Greatest of those distances."},
              {"integer", "iterations", "Steps made."},
              {"boolean", "converged", "Whether the last step hardly moved the mesh."}}}};
}

std::vector<Function> resample_methods() {
    return {decimate_method(), remesh_method(), symmetrize_method(),
            thicken_method(),  offset_method(), align_method()};
}

}  // namespace lissom::lua
