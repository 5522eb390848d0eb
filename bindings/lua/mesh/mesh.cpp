// lissom.Mesh: making one, its elements and its measures.
#include <array>
#include <cstdio>

#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/core/push_list.h"
#include "bindings/lua/mesh/buffer.h"
#include "bindings/lua/mesh/mesh_object.h"
#include "bindings/lua/mesh/weld_option.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/query/self_intersections.h"

namespace lissom::lua {
namespace {

const Mesh& own_mesh(const Call& call) {
    return call.self<MeshObject>()->mesh;
}

// ---- lissom.mesh

std::vector<Vec3> given_positions(const Call& call) {
    if (call.kind("positions") == Kind::object) {
        return call.object<BufferObject>("positions")->as_points();
    }
    const auto points = call.points("positions");
    return {points.begin(), points.end()};
}

int make_mesh(Call& call) {
    const IdLists faces = call.id_lists("faces");
    const bool mend = call.boolean("repair");
    const Weld weld = call.has("weld") ? given_weld(call) : Weld::none;
    return new_mesh(call, [&] {
        FaceList list;
        list.offsets.assign(faces.offsets.begin(), faces.offsets.end());
        list.vertices.assign(faces.ids.begin(), faces.ids.end());
        std::vector<Vec3> positions = given_positions(call);
        if (!mend && weld == Weld::none)
            return Mesh(std::move(positions), std::move(list), call.context());
        Soup soup;
        soup.positions = std::move(positions);
        soup.faces = std::move(list);
        return repair(std::move(soup), {weld, mend}, call.context());
    });
}

// ---- Counts and measures

int vertex_count(Call& call) {
    return call.push(own_mesh(call).vertex_count());
}
int face_count(Call& call) {
    return call.push(own_mesh(call).face_count());
}
int component_count(Call& call) {
    return call.push(own_mesh(call).topology().component_count());
}
int is_closed(Call& call) {
    return call.push(own_mesh(call).topology().is_closed());
}

int mesh_size(Call& call) {
    return compute(call, [&] { return surface_radius(own_mesh(call)); });
}

int mesh_area(Call& call) {
    return compute(call, [&] { return area(own_mesh(call)); });
}

int mesh_volume(Call& call) {
    return compute(call, [&] { return volume(own_mesh(call)); });
}

int mesh_genus(Call& call) {
    return compute(call, [&] { return genus(own_mesh(call).topology()); });
}

std::vector<Index> isolated_vertices(const Topology& topology) {
    std::vector<Index> isolated;
    for (Index v = 0; v < topology.vertex_count(); ++v) {
        if (topology.is_isolated(v)) isolated.push_back(v);
    }
    return isolated;
}

int is_manifold(Call& call) {
    return compute(call, [&] { return isolated_vertices(own_mesh(call).topology()).empty(); });
}

int mesh_hash(Call& call) {
    std::uint64_t value = 0;
    if (!call.attempt([&] { value = hash(own_mesh(call)); })) return call.fail();
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value));
    return call.push(std::string_view(text));
}

int mesh_bounds(Call& call) {
    Box box;
    const bool done = call.attempt([&] {
        box = bounds(own_mesh(call));
        if (box.empty())
            throw Error(ErrorCode::mesh_empty, "a mesh without vertices has no bounds");
    });
    return done ? push_bounds(call, box) : call.fail();
}

int mesh_check(Call& call) {
    const Topology& topology = own_mesh(call).topology();
    auto& isolated = call.hold<std::vector<Index>>();
    auto& without_area = call.hold<std::vector<Index>>();
    Index genus_found = 0, euler = 0;
    const bool done = call.attempt([&] {
        isolated = isolated_vertices(topology);
        without_area = zero_area_faces(own_mesh(call));
        genus_found = genus(topology);
        euler = euler_characteristic(topology);
    });
    if (!done) return call.fail();
    const struct {
        const char* name;
        int value;
    } counts[] = {{"vertices", topology.vertex_count()},
                  {"edges", topology.edge_count()},
                  {"faces", topology.face_count()},
                  {"components", topology.component_count()},
                  {"boundaries", count_of(topology.boundary_loops())},
                  {"genus", genus_found},
                  {"euler", euler}};
    lua_createtable(call.lua(), 0, 12);
    for (const auto& count : counts) call.set_field(count.name, call.push(count.value));
    call.set_field("closed", call.push(topology.is_closed()));
    call.set_field("manifold", call.push(isolated.empty()));
    call.set_field("triangles", call.push(topology.is_triangle_mesh()));
    call.set_field("isolated_vertices", call.push_ids(isolated));
    call.set_field("zero_area_faces", call.push_ids(without_area));
    return 1;
}

int mesh_self_intersections(Call& call) {
    auto& pairs = call.hold<std::vector<FacePair>>();
    if (!call.attempt([&] { pairs = self_intersections(own_mesh(call), {}, call.context()); })) {
        return call.fail();
    }
    return push_list(call, pairs, [&](const auto& pair) {
        call.push_ids(std::array{pair.first, pair.second});
    });
}

// ---- Elements

int vertex_position(Call& call) {
    const Mesh& mesh = own_mesh(call);
    const Index v = call.id("vertex");
    if (!check_id(call, v, mesh.vertex_count(), ElementKind::vertex)) return call.fail();
    return call.push_coordinates(mesh.position(v));
}

int set_vertex_position(Call& call) {
    const auto mesh = call.self<MeshObject>();
    const Index v = call.id("vertex");
    const Vec3 position = call.vector("position");
    const bool done = call.attempt_quick([&] { mesh->mesh.set_position(v, position); });
    return done ? call.push_argument() : call.fail();
}

int vertex_normal(Call& call) {
    const auto mesh = call.self<MeshObject>();
    const Index v = call.id("vertex");
    if (!check_id(call, v, mesh->mesh.vertex_count(), ElementKind::vertex)) return call.fail();
    Vec3 normal = Vec3::Zero();
    if (!call.attempt([&] { normal = mesh->normals()[v]; })) {
        return call.fail();
    }
    return call.push_coordinates(normal);
}

int face_vertices(Call& call) {
    const Topology& topology = own_mesh(call).topology();
    const Index f = call.id("face");
    if (!check_id(call, f, topology.face_count(), ElementKind::face)) return call.fail();
    return call.push_ids(topology.face(f));
}

int all_faces(Call& call) {
    const Topology& topology = own_mesh(call).topology();
    lua_createtable(call.lua(), topology.face_count(), 0);
    for (Index f = 0; f < topology.face_count(); ++f) {
        call.push_ids(topology.face(f));
        lua_rawseti(call.lua(), -2, f + 1);
    }
    return 1;
}

int vertex_neighbors(Call& call) {
    const Topology& topology = own_mesh(call).topology();
    const Index v = call.id("vertex");
    if (!check_id(call, v, topology.vertex_count(), ElementKind::vertex)) return call.fail();
    return call.push_ids(topology.neighbors(v));
}

// ---- Operators

int mesh_text(Call& call) {
    const Mesh& mesh = own_mesh(call);
    Box box;
    if (!call.attempt([&] { box = bounds(mesh); })) return call.fail();
    char text[256];
    int length = std::snprintf(text, sizeof text, "lissom.Mesh: %d vertices, %d faces",
                               mesh.vertex_count(), mesh.face_count());
    if (!box.empty()) {
        length += std::snprintf(text + length, sizeof text - length,
                                ", from (%.6g, %.6g, %.6g) to (%.6g, %.6g, %.6g)", box.min.x(),
                                box.min.y(), box.min.z(), box.max.x(), box.max.y(), box.max.z());
    }
    return call.push(std::string_view(text, length));
}

int equal_meshes(Call& call) {
    const Mesh& a = call.self<MeshObject>(1)->mesh;
    const Mesh& b = call.self<MeshObject>(2)->mesh;
    const FaceList &p = a.topology().faces(), &q = b.topology().faces();
    return call.push(std::equal(a.positions().begin(), a.positions().end(), b.positions().begin(),
                                b.positions().end()) &&
                     p.offsets == q.offsets && p.vertices == q.vertices);
}

}  // namespace

namespace {

// "{min = {0, 0, 0}, max = {1, 1, 1}, center = {0.5, 0.5, 0.5}, diagonal = 1.73205}"
int bounds_text(lua_State* L) {
    luaL_checktype(L, 1, LUA_TTABLE);
    lua_pushliteral(L, "{");
    for (const char* name : {"min", "max", "center"}) {
        lua_getfield(L, 1, name);
        double xyz[3] = {};
        for (int k = 0; k < 3 && lua_istable(L, -1); ++k) {
            lua_rawgeti(L, -1, k + 1);
            xyz[k] = lua_tonumber(L, -1);
            lua_pop(L, 1);
        }
        lua_pop(L, 1);
        char text[128];
        std::snprintf(text, sizeof text, "%s = {%.6g, %.6g, %.6g}, ", name, xyz[0], xyz[1], xyz[2]);
        lua_pushstring(L, text);
        lua_concat(L, 2);
    }
    lua_getfield(L, 1, "diagonal");
    char text[64];
    std::snprintf(text, sizeof text, "diagonal = %.6g}", lua_tonumber(L, -1));
    lua_pop(L, 1);
    lua_pushstring(L, text);
    lua_concat(L, 2);
    return 1;
}

}  // namespace

int push_bounds(const Call& call, const Box& box) {
    lua_createtable(call.lua(), 0, 4);
    call.set_field("min", call.push_vector(box.min));
    call.set_field("max", call.push_vector(box.max));
    call.set_field("center", call.push_vector(box.center()));
    call.set_field("diagonal", call.push(box.diagonal()));
    lua_State* L = call.lua();
    if (luaL_newmetatable(L, "lissom.Bounds")) {
        lua_pushcfunction(L, bounds_text);
        lua_setfield(L, -2, "__tostring");
    }
    lua_setmetatable(L, -2);
    return 1;
}

Type mesh_type() {
    const auto vertex = id("vertex", "Id of the vertex.");
    Type type{.name = "lissom.Mesh",
              .summary =
                  "An oriented 2-manifold of polygons, with or without boundary. Vertices and "
                  "faces count from 1.",
              .close = [](void* object) { static_cast<MeshObject*>(object)->close(); }};
    type.operators = {{"__len", vertex_count, "#mesh", "number of vertices"},
                      {"__tostring", mesh_text, "tostring(mesh)", "counts and bounds"},
                      {"__eq", equal_meshes, "a == b", "the same positions and faces, to the bit"}};
    type.methods = {
        {.name = "vertex_count",
         .body = vertex_count,
         .summary = "Number of vertices.",
         .results = {{"integer", "count", "Number of vertices."}},
         .example = "assert(lissom.shapes.box():vertex_count() == 8)"},
        {.name = "face_count",
         .body = face_count,
         .summary = "Number of faces.",
         .results = {{"integer", "count", "Number of faces."}},
         .example = "assert(lissom.shapes.box():face_count() == 6)"},
        {.name = "bounds",
         .body = mesh_bounds,
         .summary = "The axis-aligned box around all vertices.",
         .results = {{"lissom.Bounds", "bounds", "The box."}},
         .errors = {ErrorCode::mesh_empty},
         .example = "assert(lissom.shapes.box():bounds().max[2] == 0.5)"},
        {.name = "size",
         .body = mesh_size,
         .summary =
             "RMS distance of the surface to its centroid: the length that default lengths derive "
             "from. Turning the mesh does not change it.",
         .results = {{"number", "size", "In the mesh's unit."}},
         .example = "assert(math.abs(lissom.shapes.sphere():size() - 1) < 0.01)"},
        {.name = "area",
         .body = mesh_area,
         .summary = "Area of the surface.",
         .results = {{"number", "area", "In the mesh's unit squared."}},
         .example = "assert(math.abs(lissom.shapes.box():area() - 6) < 1e-12)"},
        {.name = "volume",
         .body = mesh_volume,
         .summary = "Enclosed volume, positive if the faces look outward. Open boundaries count as "
                    "closed by cones to their mean points.",
         .results = {{"number", "volume", "In the mesh's unit cubed."}},
         .example = "assert(math.abs(lissom.shapes.box():volume() - 1) < 1e-12)"},
        {.name = "genus",
         .body = mesh_genus,
         .summary = "Handles of the surface, summed over its components.",
         .results = {{"integer", "genus", "0 for a sphere, 1 for a torus."}},
         .example = "assert(lissom.shapes.torus():genus() == 1)"},
        {.name = "components",
         .body = component_count,
         .summary = "Number of connected components. A vertex without faces is one of its own.",
         .results = {{"integer", "count", "Number of components."}},
         .example = "assert(lissom.shapes.box():components() == 1)"},
        {.name = "is_closed",
         .body = is_closed,
         .summary = "Whether the mesh has no open boundary.",
         .results = {{"boolean", "closed", "False if there is a boundary."}},
         .example = "assert(not lissom.shapes.grid():is_closed())"},
        {.name = "is_manifold",
         .body = is_manifold,
         .summary = "Whether every vertex has exactly one fan of faces. Faces are always manifold; "
                    "vertices without faces make it false.",
         .results = {{"boolean", "manifold", "False if a vertex has no face."}},
         .example = "assert(lissom.shapes.box():is_manifold())"},
        {.name = "check",
         .body = mesh_check,
         .summary = "Counts, and the ids of elements that may cause trouble.",
         .results = {{"lissom.Check", "report", "The findings."}},
         .example = "assert(#lissom.shapes.box():check().zero_area_faces == 0)"},
        {.name = "self_intersections",
         .body = mesh_self_intersections,
         .summary =
             "The pairs of faces that meet other than at a vertex or an edge that both have, in "
             "ascending order. Faces that touch or lie on one another count; vertices at one place "
             "count as one.",
         .results = {{"integer[][]", "pairs", "Two faces each, the lower number first."}},
         .example = "assert(#lissom.shapes.torus():self_intersections() == 0)"},
        {.name = "hash",
         .body = mesh_hash,
         .summary =
             "Hash of positions, faces, attributes, labels and regions, to the bit: the same on "
             "every machine.",
         .results = {{"string", "hash", "16 hexadecimal digits."}},
         .example = "assert(lissom.shapes.box():hash() == lissom.shapes.box():hash())"},
        {.name = "position",
         .body = vertex_position,
         .summary = "Position of a vertex.",
         .arguments = {vertex},
         .results = {{"number", "x", ""}, {"number", "y", ""}, {"number", "z", ""}},
         .errors = {ErrorCode::out_of_range},
         .example = "local x, y, z = lissom.shapes.box():position(1)"},
        {.name = "set_position",
         .body = set_vertex_position,
         .summary = "Moves a vertex and returns the mesh.",
         .arguments = {vertex, vector("position", "Its position: three numbers or {x, y, z}.")},
         .results = {{"lissom.Mesh", "mesh", "The mesh itself."}},
         .effect = Effect::replaces,
         .errors = {ErrorCode::out_of_range},
         .example = R"(local mesh = lissom.shapes.box()
mesh:set_position(1, 0, 0, 0):set_position(2, { 1, 0, 0 }))"},
        {.name = "normal",
         .body = vertex_normal,
         .summary =
             "Unit normal of the surface at a vertex, from the faces around it; zero if they "
             "have no area.",
         .arguments = {vertex},
         .results = {{"number", "x", ""}, {"number", "y", ""}, {"number", "z", ""}},
         .errors = {ErrorCode::out_of_range},
         .example = "local x, y, z = lissom.shapes.grid():normal(1)\nassert(y == 1)"},
        {.name = "face",
         .body = face_vertices,
         .summary = "The vertices of a face, counter-clockwise seen from outside.",
         .arguments = {id("face", "Id of the face.")},
         .results = {{"integer[]", "vertices", "Their ids."}},
         .errors = {ErrorCode::out_of_range},
         .example = "assert(#lissom.shapes.box():face(1) == 4)"},
        {.name = "faces",
         .body = all_faces,
         .summary = "The vertices of all faces.",
         .results = {{"integer[][]", "faces", "For each face the ids of its vertices."}},
         .example = "assert(#lissom.shapes.box():faces() == 6)"},
        {.name = "neighbors",
         .body = vertex_neighbors,
         .summary = "The vertices that an edge joins to a vertex, counter-clockwise.",
         .arguments = {vertex},
         .results = {{"integer[]", "vertices", "Their ids."}},
         .errors = {ErrorCode::out_of_range},
         .example = "assert(#lissom.shapes.box():neighbors(1) == 3)"}};
    return type;
}

std::vector<Function> mesh_functions() {
    return {
        {.name = "mesh",
         .body = make_mesh,
         .summary = "Makes a mesh from positions and faces.",
         .options = {either("positions",
                            {points("list", "A list of {x, y, z}."),
                             object("buffer", "lissom.Buffer", "Rows of three numbers.")},
                            "Positions of the vertices."),
                     id_lists("faces",
                              "For each face the ids of its vertices, counter-clockwise seen "
                              "from outside."),
                     weld_option().optional("false"),
                     boolean("repair", "Whether defects are mended, as lissom.load does.")
                         .defaults(false)},
         .results = {{"lissom.Mesh", "mesh", "The mesh."}},
         .errors = {ErrorCode::face_index, ErrorCode::face_too_small, ErrorCode::repeated_vertex,
                    ErrorCode::duplicate_face, ErrorCode::nonmanifold_edge,
                    ErrorCode::inconsistent_orientation, ErrorCode::nonmanifold_vertex,
                    ErrorCode::unreferenced_vertex, ErrorCode::zero_area, ErrorCode::cancelled},
         .example = R"(local mesh = lissom.mesh{
    positions = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } },
    faces = { { 1, 2, 3 } },
}
assert(#mesh == 3 and not mesh:is_closed()))"}};
}

}  // namespace lissom::lua
