// lissom.Path, and the methods of a mesh that make paths and close boundaries.
#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/core/push_list.h"
#include "bindings/lua/mesh/path_object.h"
#include "kernel/mesh/fill/bridge.h"
#include "kernel/mesh/fill/fill.h"
#include "kernel/mesh/query/path_smooth.h"

namespace lissom::lua {

const Path& PathObject::current() const {
    if (path.on_mesh()) require_current(*mesh, path.topology(), "the path");
    return path;
}

int push_paths(Call& call, const std::shared_ptr<MeshObject>& mesh, std::vector<Path>& paths) {
    lua_createtable(call.lua(), count_of(paths), 0);
    for (std::size_t i = 0; i < paths.size(); ++i) {
        const auto result = call.create<PathObject>();
        const bool done = call.attempt_quick(
            [&] { result.set(std::make_shared<PathObject>(mesh, std::move(paths[i]))); });
        if (!done) return call.fail();
        call.charge(result);
        lua_rawseti(call.lua(), -2, index_of(i) + 1);
    }
    return 1;
}

namespace {

// ---- Methods of a mesh

int mesh_boundaries(Call& call) {
    const auto mesh = call.self<MeshObject>();
    auto& owner = call.hold<std::shared_ptr<MeshObject>>();
    auto& paths = call.hold<std::vector<Path>>();
    const bool done = call.attempt([&] {
        owner = mesh.share();
        paths = boundaries(mesh->mesh);
    });
    return done ? push_paths(call, owner, paths) : call.fail();
}

// The vertices that a path is to visit: given ones, or those nearest to given points.
std::vector<Index> stations(const Call& call, MeshObject& mesh) {
    std::vector<Index> vertices;
    if (call.kind("points") == Kind::ids) {
        const auto ids = call.ids("points");
        return {ids.begin(), ids.end()};
    }
    const SpatialTree& tree = mesh.tree(call.context());
    for (const Vec3& point : call.points("points")) {
        const Index v = tree.nearest(point).vertex;
        if (vertices.empty() || vertices.back() != v) vertices.push_back(v);
    }
    return vertices;
}

int make_path(Call& call) {
    const auto mesh = call.self<MeshObject>();
    const bool closed = call.boolean("closed");
    const auto result = call.create<PathObject>();
    const bool done = call.attempt([&] {
        Path path = path_through(mesh->mesh, stations(call, *mesh), closed, call.context());
        result.set(std::make_shared<PathObject>(mesh.share(), std::move(path)));
    });
    if (!done) return call.fail();
    call.charge(mesh);
    call.charge(result);
    return 1;
}

int fill_boundary(Call& call) {
    const auto boundary = call.object<PathObject>("boundary");
    FillOptions options;
    options.method = call.choice<FillMethod>("method");
    options.subdivide = call.boolean("subdivide");
    options.density = call.number("density");
    options.fair = call.boolean("fair");
    options.continuity = call.choice<FairContinuity>("continuity");
    options.maximum_vertices = call.integer("maximum_vertices");
    FillReport report;
    const int results = change_mesh(call, [&](Mesh& mesh) {
        report = fill(mesh, boundary->current(), options, call.context());
    });
    if (results != 1) return results;
    const struct {
        const char* name;
        int value;
    } counts[] = {{"loop_size", report.loop_size},       {"first_vertex", report.first_vertex + 1},
                  {"vertex_count", report.vertex_count}, {"first_face", report.first_face + 1},
                  {"face_count", report.face_count},     {"parts", report.parts},
                  {"folded_edges", report.folded_edges}};
    lua_createtable(call.lua(), 0, 8);
    for (const auto& count : counts) call.set_field(count.name, call.push(count.value));
    call.set_field("limit_reached", call.push(report.limit_reached));
    return 2;
}

int bridge_boundaries(Call& call) {
    const auto a = call.object<PathObject>("a");
    const auto b = call.object<PathObject>("b");
    BridgeReport report;
    const int results = change_mesh(call, [&](Mesh& mesh) {
        report = bridge(mesh, a->current(), b->current(), call.context());
    });
    if (results != 1) return results;
    call.push(report.first_face + 1);
    call.push(report.face_count);
    return 3;
}

// ---- Methods of a path

int path_vertices(Call& call) {
    const auto self = call.self<PathObject>();
    if (!call.attempt_quick([&] { self->current(); })) return call.fail();
    return call.push_ids(self->path.vertices());
}

int path_points(Call& call) {
    const auto self = call.self<PathObject>();
    auto& points = call.hold<std::vector<Vec3>>();
    if (!call.attempt([&] { points = self->current().points(self->mesh->mesh); })) {
        return call.fail();
    }
    return push_list(call, points, [&](const Vec3& point) { call.push_vector(point); });
}

int path_length(Call& call) {
    const auto self = call.self<PathObject>();
    return compute(call, [&] { return self->current().length(self->mesh->mesh); });
}

int path_nearest(Call& call) {
    const auto self = call.self<PathObject>();
    const Vec3 point = call.vector("point");
    PathPoint found;
    const bool done =
        call.attempt([&] { found = self->current().nearest(self->mesh->mesh, point); });
    if (!done) return call.fail();
    lua_createtable(call.lua(), 0, 4);
    call.set_field("position", call.push_vector(found.point));
    call.set_field("parameter", call.push(found.parameter));
    call.set_field("segment", call.push_id(found.segment));
    call.set_field("distance", call.push(found.distance));
    return 1;
}

int smooth_vertices(Call& call) {
    const auto self = call.self<PathObject>();
    const Index iterations = call.integer("iterations");
    const double strength = call.number("strength");
    const bool done = call.attempt([&] {
        smooth_path(self->mesh->mesh, self->current(), iterations, strength, call.context());
        self->mesh->changed();
    });
    return done ? call.push_argument() : call.fail();
}

int path_closed(Call& call) {
    return call.push(call.self<PathObject>()->path.closed());
}

int path_is_boundary(Call& call) {
    const auto self = call.self<PathObject>();
    return compute(call, [&] { return self->current().is_boundary(); });
}

int path_reversed(Call& call) {
    const auto self = call.self<PathObject>();
    const auto result = call.create<PathObject>();
    const bool done = call.attempt(
        [&] { result.set(std::make_shared<PathObject>(self->mesh, self->current().reversed())); });
    if (!done) return call.fail();
    call.charge(result);
    return 1;
}

int path_region(Call& call) {
    const auto self = call.self<PathObject>();
    const auto result = call.create<RegionObject>();
    const bool done = call.attempt([&] {
        const Path& path = self->current();
        if (!path.on_mesh()) {
            throw Error(ErrorCode::invalid_argument,
                        "the path runs through points of its own and no vertices of the mesh");
        }
        result.set(
            std::make_shared<RegionObject>(self->mesh, Region(path.topology(), path.vertices())));
    });
    if (!done) return call.fail();
    call.charge(result);
    return 1;
}

int path_mesh(Call& call) {
    return push_owner(call, call.self<PathObject>()->mesh);
}

int path_size(Call& call) {
    return call.push(call.self<PathObject>()->path.size());
}

int path_text(Call& call) {
    const auto self = call.self<PathObject>();
    const bool current = call.attempt_quick([&] { self->current(); });
    if (!current) return call.push("lissom.Path (of an older topology)");
    lua_pushfstring(call.lua(), "lissom.Path: %d vertices, %s", self->path.size(),
                    self->path.closed() ? "closed" : "open");
    return 1;
}

}  // namespace

Type path_type() {
    const std::vector<ErrorCode> errors = {ErrorCode::topology_mismatch};
    const std::string border = "local border = lissom.shapes.grid():boundaries()[1]\n";
    Type type{.name = "lissom.Path",
              .summary =
                  "A line through vertices of one version of a mesh's topology, open or closed. A "
                  "boundary is a closed path around a hole, with the surface on its left. The "
                  "preview of a cut returns lines through points of their own, without vertices."};
    type.operators = {{"__len", path_size, "#path", "number of vertices"},
                      {"__tostring", path_text, "tostring(path)", "its size"}};
    type.methods = {
        {.name = "vertices",
         .body = path_vertices,
         .summary = "The vertices in order; the first of a closed path is not repeated.",
         .results = {{"integer[]", "vertices", "Their ids."}},
         .errors = errors,
         .example = border + "assert(#border:vertices() == 40)"},
        {.name = "points",
         .body = path_points,
         .summary = "The positions of its vertices in order.",
         .results = {{"lissom.Vector[]", "points", "A list of {x, y, z}."}},
         .errors = errors,
         .example = border + "assert(#border:points() == 40)"},
        {.name = "length",
         .body = path_length,
         .summary = "Length of the line.",
         .results = {{"number", "length", "In the mesh's unit."}},
         .errors = errors,
         .example = border + "assert(math.abs(border:length() - 4) < 1e-12)"},
        {.name = "nearest",
         .body = path_nearest,
         .summary = "The point of the line nearest to a given one.",
         .arguments = {vector("point", "Three numbers or {x, y, z}.")},
         .results = {{"lissom.PathPoint", "found", "The nearest point."}},
         .errors = errors,
         .example = border + "assert(math.abs(border:nearest(2, 0, 0).distance - 1.5) < 1e-12)"},
        {.name = "smooth",
         .body = smooth_vertices,
         .summary =
             "Smooths the line by moving the mesh's vertices under it, and returns the path. Ends "
             "of open paths stay.",
         .options = {integer("iterations", "Number of steps.").defaults(10).at_least(0),
                     number("strength",
                            "Fraction of the way to the middle of its neighbours that a "
                            "vertex moves in a step.")
                         .defaults(0.5)
                         .between(0, 1)},
         .results = {{"lissom.Path", "path", "The path itself."}},
         .errors = {ErrorCode::topology_mismatch, ErrorCode::cancelled},
         .example = border + "border:smooth{ iterations = 3 }"},
        {.name = "is_closed",
         .body = path_closed,
         .summary = "Whether its end is joined to its start.",
         .results = {{"boolean", "closed", "True for a boundary."}},
         .example = border + "assert(border:is_closed())"},
        {.name = "is_boundary",
         .body = path_is_boundary,
         .summary = "Whether it is one of the open boundaries of the mesh.",
         .results = {{"boolean", "boundary", "In either direction."}},
         .errors = errors,
         .example = border + "assert(border:is_boundary())"},
        {.name = "reversed",
         .body = path_reversed,
         .summary = "The same line run the other way.",
         .results = {{"lissom.Path", "path", "A new path."}},
         .errors = errors,
         .example = border + "assert(border:reversed():vertices()[2] == border:vertices()[40])"},
        {.name = "region",
         .body = path_region,
         .summary = "The region of its vertices.",
         .results = {{"lissom.Region", "region", "A new region."}},
         .errors = errors,
         .example = border + "assert(#border:region() == 40)"},
        {.name = "mesh",
         .body = path_mesh,
         .summary = "The mesh that it runs on.",
         .results = {{"lissom.Mesh", "mesh", "The mesh."}},
         .example = border + "assert(#border:mesh() == 121)"}};
    return type;
}

std::vector<Function> path_methods_of_mesh() {
    const FillOptions fill_defaults;
    return {
        {.name = "boundaries",
         .body = mesh_boundaries,
         .summary = "The open boundaries, ordered by their smallest vertex.",
         .results = {{"lissom.Path[]", "boundaries",
                      "Closed paths with the surface on their left."}},
         .example = "assert(#lissom.shapes.cylinder{ caps = false }:boundaries() == 2)"},
        {.name = "path",
         .body = make_path,
         .summary = "The shortest line along edges that visits the given vertices in order.",
         .options = {either(
                         "points",
                         {points("positions", "Points; each stands for the vertex nearest to it."),
                          ids("vertices", "Ids of vertices.")},
                         "Points to visit."),
                     boolean("closed", "Returns to the first.").defaults(false)},
         .results = {{"lissom.Path", "path", "The line."}},
         .errors = {ErrorCode::invalid_argument, ErrorCode::out_of_range, ErrorCode::mesh_empty,
                    ErrorCode::cancelled},
         .example = R"(local grid = lissom.shapes.grid()
local path = grid:path{ points = { { -0.5, 0, -0.5 }, { 0.5, 0, -0.5 } } }
assert(#path == 11))"},
        {.name = "fill",
         .body = fill_boundary,
         .summary =
             "Closes an open boundary by a patch of triangles that continues the surface, in "
             "place. Old ids stay.",
         .arguments = {object("boundary", "lissom.Path", "An open boundary of this mesh.")},
         .options =
             {choice("method", {"angle", "area"},
                     "Begins with the triangles whose greatest angle to one another and "
                     "to the mesh is least, or with those of the least area, a lid.")
                  .defaults("angle"),
              boolean("subdivide", "Makes the patch as dense as the mesh around it.")
                  .defaults(fill_defaults.subdivide),
              number("density",
                     "Its density over that of the mesh around it; more than 1 lets a patch bend "
                     "whose rim has few vertices.")
                  .above(0)
                  .defaults(fill_defaults.density),
              boolean("fair", "Bends the patch to continue the surface smoothly.")
                  .defaults(fill_defaults.fair),
              choice("continuity", {"tangents", "curvature"},
                     "Order of continuity of a faired patch with the surface. With "
                     "curvature a large patch in a round surface is round.")
                  .defaults("tangents"),
              integer("maximum_vertices", "Vertices that `subdivide` may insert.")
                  .defaults(fill_defaults.maximum_vertices)
                  .at_least(0)},
         .results = {{"lissom.Mesh", "mesh", "The mesh itself."},
                     {"lissom.FillReport", "report", "The added elements."}},
         .effect = Effect::changes,
         .errors = {ErrorCode::topology_mismatch, ErrorCode::invalid_argument,
                    ErrorCode::unsupported, ErrorCode::memory_limit, ErrorCode::cancelled},
         .example = R"(local tube = lissom.shapes.cylinder{ caps = false }
while #tube:boundaries() > 0 do tube:fill(tube:boundaries()[1]) end
assert(tube:is_closed()))"},
        {.name = "bridge",
         .body = bridge_boundaries,
         .summary =
             "Joins two open boundaries by a strip of triangles between their vertices, in "
             "place: two parts become one, holes on both sides of a part a tunnel. Boundaries "
             "are matched by arc length at their closest points. All ids stay; a triangle "
             "has the groups and attributes of the face at its boundary edge.",
         .arguments = {object("a", "lissom.Path", "An open boundary of this mesh."),
                       object("b", "lissom.Path", "Another one.")},
         .results = {{"lissom.Mesh", "mesh", "The mesh itself."},
                     {"integer", "first_face", "The first of the triangles."},
                     {"integer", "face_count", "Their number; they are the last of all faces."}},
         .errors = {ErrorCode::topology_mismatch, ErrorCode::not_a_boundary,
                    ErrorCode::boundary_conflict, ErrorCode::inconsistent_orientation,
                    ErrorCode::memory_limit, ErrorCode::cancelled},
         .example = R"(local tube = lissom.shapes.cylinder{ caps = false }
tube:append(tube:copy():transform{ translate = { 0, 5, 0 } })
local rims = tube:boundaries()
tube:bridge(rims[2], rims[3])
assert(tube:components() == 1))"}};
}

}  // namespace lissom::lua
