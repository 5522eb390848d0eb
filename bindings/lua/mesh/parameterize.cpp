// lissom.Mesh: maps into the plane, as texture coordinates.
#include "kernel/mesh/parameterize/parameterize.h"
#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/mesh/mesh_object.h"
#include "kernel/mesh/parameterize/uv_attribute.h"
#include "kernel/mesh/unwrap/unwrap.h"

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

int unwrap_mesh(Call& call) {
    const char* name = call.string("attribute");
    const char* chart_name = call.has("charts") ? call.string("charts") : nullptr;
    UnwrapOptions options;
    options.stretch = call.number("stretch");
    options.crease = call.number("crease");
    options.gap = call.number("gap");
    auto& made = call.hold<Unwrapping>();
    const int results = change_mesh(call, [&](Mesh& mesh) {
        require(*name && (!chart_name || *chart_name), "an attribute needs a name");
        require(!chart_name || std::string_view(chart_name) != name,
                "coordinates and charts need attributes of different names");
        made = unwrap(mesh, options, call.context());
        write_unwrapping(mesh, made, name);
        if (chart_name) {
            Attribute charts{chart_name, Domain::face, 1, ScalarType::int32, {}};
            for (const Index chart : made.chart) charts.values.push_back(chart + 1.0);
            if (mesh.attributes().find(chart_name)) mesh.attributes().remove(chart_name);
            mesh.attributes().add(std::move(charts));
        }
    });
    if (results != 1) return results;
    lua_createtable(call.lua(), 0, 7);
    call.set_field("charts", call.push(made.chart_count));
    call.set_field("coverage", call.push(made.coverage));
    call.set_field("side", call.push(made.side));
    call.set_field("mean_stretch", call.push(made.mean_stretch));
    call.set_field("stretch", call.push(made.stretch));
    call.set_field("seam_length", call.push(made.seam_length));
    call.set_field("flipped", call.push_ids(made.flipped));
    return 2;
}

std::vector<Parameter> unwrap_options() {
    const UnwrapOptions d;
    return {
        number("stretch",
               "Greatest factor by which a length may change, for all but a fiftieth of a "
               "chart's area: more charts for less.")
            .defaults(d.stretch)
            .above(1),
        number("crease", "How much seams prefer creases to short ways.")
            .defaults(d.crease)
            .at_least(0),
        number("gap",
               "Space between two charts, as a part of the square's side: 4 / 1024 are four "
               "pixels of a texture with 1,024.")
            .defaults(d.gap)
            .between(0.0005, 0.1),
        string("attribute",
               "Attribute for the coordinates: \"uv\", \"uv2\", or a name of your own.")
            .defaults("uv"),
        string("charts", "Attribute of faces for the numbers of their charts.").optional("none")};
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
    return {{"lissom.UnwrapReport",
             "A surface as charts in the unit square.",
             {{"integer", "charts", "Number of charts; they are numbered from the largest on."},
              {"number", "coverage", "Part of the square that they cover."},
              {"number", "side", "Side of the square, in lengths of the mesh."},
              {"number", "mean_stretch",
               "Mean of the factors by which lengths change most at a point; 1 for none."},
              {"number", "stretch", "The greatest of them but for a fiftieth of the area."},
              {"number", "seam_length", "Length of the seams on the surface."},
              {"integer[]", "flipped", "Faces that are turned over."}}},
            {"lissom.ParameterizeReport",
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
    return {{.name = "unwrap",
             .body = unwrap_mesh,
             .summary =
                 "Cuts the whole surface into charts that lie flat with little stretch, and packs "
                 "them into the unit square as texture coordinates, in place of those it had. "
                 "Seams keep to creases; open meshes, handles and several parts are welcome.",
             .options = unwrap_options(),
             .results = {{"lissom.Mesh", "mesh", "The mesh itself."},
                         {"lissom.UnwrapReport", "report", "Charts and their quality."}},
             .errors = {ErrorCode::mesh_empty, ErrorCode::invalid_argument, ErrorCode::memory_limit,
                        ErrorCode::cancelled},
             .example = R"(local box = lissom.shapes.box()
local _, report = box:unwrap{ stretch = 1.2 }
assert(report.stretch < 1.01 and #report.flipped == 0))"},
            {.name = "parameterize",
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
