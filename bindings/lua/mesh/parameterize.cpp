// lissom.Mesh: maps into the plane, as texture coordinates.
#include "kernel/mesh/parameterize/parameterize.h"
#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/mesh/mesh_object.h"
#include "kernel/mesh/parameterize/uv_attribute.h"

namespace lissom::lua {
namespace {

const std::vector<std::string> kMethodNames = {"lscm", "arap", "tutte"};

int push_map_report(const Call& call, const Parameterization& map) {
    lua_createtable(call.lua(), 0, 9);
    call.set_field("method", call.push(kMethodNames[at(static_cast<int>(map.method))].c_str()));
    call.set_field("iterations", call.push(map.iterations));
    call.set_field("energy", call.push_numbers(map.energy));
    call.set_field("flipped", call.push_ids(map.flipped));
    call.set_field("degenerate", call.push_ids(map.degenerate));
    call.set_field("min_scale", call.push(map.min_scale));
    call.set_field("max_scale", call.push(map.max_scale));
    call.set_field("crossings", call.push(map.boundary_crossings));
    call.set_field("boundaries", call.push(count_of(map.loops)));
    return 1;
}

int parameterize_mesh(Call& call) {
    const bool whole = !call.has("region");
    const auto region = call.object<RegionObject>("region");
    const char* name = call.string("attribute");
    ParameterizeOptions options;
    options.method = call.choice<ParameterizeMethod>("method");
    options.maximum_iterations = call.integer("iterations");
    options.close_holes = call.boolean("close_holes");
    const auto placement = call.choice<UvPlacement>("placement");
    auto& map = call.hold<Parameterization>();
    const int results = change_mesh(call, [&](Mesh& mesh) {
        const Region faces = whole ? Region::all(mesh.shared_topology()) : region->current();
        map = parameterize(mesh, faces, options, call.context());
        write_uv(mesh, map, name, placement);
    });
    if (results != 1) return results;
    return 1 + push_map_report(call, map);
}

std::vector<Parameter> parameterize_options() {
    const ParameterizeOptions defaults;
    return {object("region", "lissom.Region",
                   "Its faces are laid out: one part without handles, with at least one boundary.")
                .optional("the whole mesh"),
            choice("method", kMethodNames,
                   "lscm keeps angles; arap, from lscm, angles and lengths, as far as no face "
                   "is turned over; tutte covers a disk and never turns a face over.")
                .defaults("arap"),
            string("attribute",
                   "Attribute for the coordinates: \"uv\", \"uv2\", or a name of your own.")
                .defaults("uv"),
            choice("placement", {"unit_square", "as_is"},
                   "Fitted into the square from 0 to 1, or in lengths of the mesh around the "
                   "origin.")
                .defaults("unit_square"),
            integer("iterations", "Iterations of arap at most.")
                .defaults(defaults.maximum_iterations)
                .at_least(0),
            boolean("close_holes",
                    "Closes every boundary but the longest by triangles that are part of the map "
                    "and not of the result, so that the boundaries do not cross.")
                .defaults(defaults.close_holes)};
}

}  // namespace

std::vector<Record> parameterize_records() {
    return {{"lissom.ParameterizeReport",
             "Quality of a map into the plane.",
             {{"string", "method", "Method that made it: lscm if arap turned faces over at once."},
              {"integer", "iterations", "Iterations of arap that are in it."},
              {"number[]", "energy",
               "For arap, before the first iteration and after each that was made: the mean "
               "squared distance of the map's derivative from a rotation."},
              {"integer[]", "flipped", "Faces that are turned over."},
              {"integer[]", "degenerate", "Faces that have hardly an area on the mesh."},
              {"number", "min_scale",
               "Least factor by which it changes a length, in lengths of the mesh."},
              {"number", "max_scale", "The greatest."},
              {"integer", "crossings", "Pairs of boundary edges that cross in the plane."},
              {"integer", "boundaries", "Boundaries of the faces."}}}};
}

std::vector<Function> parameterize_methods_of_mesh() {
    return {{.name = "parameterize",
             .body = parameterize_mesh,
             .summary = "Lays the surface, or a region of it, out in the plane, and keeps the "
                        "place of each corner as texture coordinates. Other corners keep theirs.",
             .options = parameterize_options(),
             .results = {{"lissom.Mesh", "mesh", "The mesh itself."},
                         {"lissom.ParameterizeReport", "report", "Quality of the map."}},
             .errors = {ErrorCode::topology_mismatch, ErrorCode::region_empty,
                        ErrorCode::invalid_argument, ErrorCode::not_a_disk,
                        ErrorCode::nonmanifold_vertex, ErrorCode::not_positive_definite,
                        ErrorCode::memory_limit, ErrorCode::cancelled},
             .example = R"(local head = lissom.shapes.sphere()
local half = head:region{ plane = { point = { 0, 0, 0 }, normal = { 0, 1, 0 } } }
local _, report = head:parameterize{ region = half }
assert(#report.flipped == 0 and head:attribute("uv"):width() == 2))"}};
}

}  // namespace lissom::lua
