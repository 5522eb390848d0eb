// lissom.Region, and the methods of a mesh that make, keep and find regions.
#include <cmath>

#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/mesh/mesh_object.h"
#include "bindings/lua/mesh/path_object.h"
#include "bindings/lua/mesh/sources.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/query/region_select.h"

namespace lissom::lua {
namespace {

// ---- mesh:region

int named_region(Call& call) {
    const auto mesh = call.self<MeshObject>();
    const char* name = call.string("name");
    const auto result = call.create<RegionObject>();
    const bool done = call.attempt_quick([&] {
        const Region* region = mesh->mesh.find_region(name);
        if (!region) {
            std::vector<std::string_view> names;
            for (const auto& [key, value] : mesh->mesh.regions()) names.push_back(key);
            refuse_absent("region", name, names);
        }
        result.set(std::make_shared<RegionObject>(mesh.share(), *region));
    });
    return done ? 1 : call.fail();
}

// Asks the script's function about every vertex; runs before any C++ object is alive, so that an
// error in it simply passes through.
std::span<const Index> ask_function(Call& call) {
    lua_State* L = call.lua();
    const auto mesh = call.self<MeshObject>();
    const Topology* topology = &mesh->mesh.topology();
    const Index count = mesh->mesh.vertex_count();
    auto* selected = call.scratch<Index>(at(count));
    std::size_t size = 0;
    for (Index v = 0; v < count; ++v) {
        if (!mesh.get() || &mesh->mesh.topology() != topology) {
            call.raise("the function of 'where' must not change the mesh");
        }
        lua_pushvalue(L, call.stack_index("where"));
        call.push_id(v);
        call.push_coordinates(mesh->mesh.position(v));
        lua_call(L, 4, 1);
        if (lua_toboolean(L, -1)) selected[size++] = v;
        lua_pop(L, 1);
    }
    if (!mesh.get()) call.raise("the function of 'where' must not close the mesh");
    return {selected, size};
}

// {name, min, max}
struct AttributeRange {
    const char* name;
    double min, max;

    static AttributeRange read(Call& call) {
        lua_State* L = call.lua();
        const int table = call.stack_index("attribute");
        for (int i = 1; i <= 3; ++i) lua_rawgeti(L, table, i);
        const bool fits = lua_type(L, -3) == LUA_TSTRING && lua_type(L, -2) == LUA_TNUMBER &&
                          lua_type(L, -1) == LUA_TNUMBER;
        if (!fits) call.reject("attribute", "{name, min, max} expected");
        return {lua_tostring(L, -3), lua_tonumber(L, -2), lua_tonumber(L, -1)};
    }
};

// Coordinates that the script left open are NaN.
Box given_box(const Call& call, const char* min, const char* max) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    Box box{Vec3::Constant(-kInfinity), Vec3::Constant(kInfinity)};
    const Vec3 low = call.has(min) ? call.vector(min) : box.min;
    const Vec3 high = call.has(max) ? call.vector(max) : box.max;
    for (int k = 0; k < 3; ++k) {
        if (!std::isnan(low[k])) box.min[k] = low[k];
        if (!std::isnan(high[k])) box.max[k] = high[k];
    }
    return box;
}

// Values of the script beside numbers, strings and objects of the call.
struct Asked {
    std::span<const Index> vertices;
    AttributeRange range;
    SourceSpec sources;
};

Region select_by_distance(const Call& call, MeshObject& object, const SourceSpec& sources) {
    const double radius = call.number("geodesic.radius");
    if (!sources.is_point) {
        return select_geodesic(object.mesh, sources.vertices, radius, call.context());
    }
    return select_around(object.mesh, sources.nearest(object, call.context()), radius,
                         call.context());
}

// The option that the call has; the registration allows exactly one.
Region select(const Call& call, MeshObject& object, const Asked& asked) {
    const Mesh& mesh = object.mesh;
    if (call.has("sphere")) {
        return select_sphere(mesh, call.vector("sphere.center"), call.number("sphere.radius"));
    }
    if (call.has("box")) return select_box(mesh, given_box(call, "box.min", "box.max"));
    if (call.has("fraction")) {
        return select_fraction(mesh, given_box(call, "fraction.min", "fraction.max"));
    }
    if (call.has("plane")) {
        return select_plane(mesh, call.vector("plane.point"), call.vector("plane.normal"));
    }
    if (call.has("geodesic")) return select_by_distance(call, object, asked.sources);
    if (call.has("vertices")) {
        const auto ids = call.ids("vertices");
        return {mesh.shared_topology(), {ids.begin(), ids.end()}};
    }
    if (call.has("group")) return select_group(mesh, call.string("group"));
    if (call.has("material")) return select_material(mesh, call.string("material"));
    if (call.has("component")) return select_component(mesh, call.id("component"));
    if (call.has("attribute")) {
        return select_attribute(mesh, asked.range.name, asked.range.min, asked.range.max);
    }
    if (call.has("where")) {
        return {mesh.shared_topology(), {asked.vertices.begin(), asked.vertices.end()}};
    }
    return Region::all(mesh.shared_topology());
}

int make_region(Call& call) {
    if (call.has("name")) return named_region(call);
    if (call.has("all") && !call.boolean("all")) call.reject("all", "true expected, got false");
    Asked asked{};
    if (call.has("where")) asked.vertices = ask_function(call);
    if (call.has("attribute")) asked.range = AttributeRange::read(call);
    if (call.has("geodesic")) asked.sources = read_sources(call, "geodesic.from");
    const auto mesh = call.self<MeshObject>();
    return new_region(call, mesh, [&] { return select(call, *mesh, asked); });
}

// Names are not counted as memory, but the entry of a region is.
constexpr std::size_t kLongestName = 255;

int set_region(Call& call) {
    const auto mesh = call.self<MeshObject>();
    const char* name = call.string("name");
    const auto region = call.object<RegionObject>("region");
    const bool done = call.attempt([&] {
        require(std::string_view(name).size() <= kLongestName,
                "the name of a region has at most 255 bytes");
        mesh->mesh.set_region(name, region->current());
    });
    if (!done) return call.fail();
    call.charge(mesh);
    return call.push_argument();
}

int remove_named_region(Call& call) {
    const auto mesh = call.self<MeshObject>();
    const char* name = call.string("name");
    return compute(call, [&] { return mesh->mesh.remove_region(name); });
}

int region_names(Call& call) {
    const auto& regions = call.self<MeshObject>()->mesh.regions();
    lua_createtable(call.lua(), count_of(regions), 0);
    int i = 0;
    for (const auto& [name, region] : regions) {
        call.push(std::string_view(name));
        lua_rawseti(call.lua(), -2, ++i);
    }
    return 1;
}

// The names that faces of the mesh may carry.
int push_labels(Call& call, const char* kind) {
    const auto& all = call.self<MeshObject>()->mesh.attributes().labels();
    const auto found = all.find(kind);
    lua_newtable(call.lua());
    if (found == all.end()) return 1;
    int i = 0;
    for (const std::string& name : found->second.names) {
        call.push(std::string_view(name));
        lua_rawseti(call.lua(), -2, ++i);
    }
    return 1;
}

int group_names(Call& call) {
    return push_labels(call, "group");
}
int material_names(Call& call) {
    return push_labels(call, "material");
}

// ---- Methods of a region

// Returns the region that work(const Region&) makes of this one.
template <typename Work>
int derive_region(Call& call, const Work& work) {
    const auto self = call.self<RegionObject>();
    const auto result = call.create<RegionObject>();
    const bool done = call.attempt(
        [&] { result.set(std::make_shared<RegionObject>(self->mesh, work(self->current()))); });
    if (!done) return call.fail();
    call.charge(result);
    return 1;
}

int unite(Call& call) {
    const auto other = call.object<RegionObject>("other");
    return derive_region(call, [&](const Region& r) { return r.united(other->current()); });
}

int subtract(Call& call) {
    const auto other = call.object<RegionObject>("other");
    return derive_region(call, [&](const Region& r) { return r.minus(other->current()); });
}

int intersect(Call& call) {
    const auto other = call.object<RegionObject>("other");
    return derive_region(call, [&](const Region& r) { return r.intersected(other->current()); });
}

int invert(Call& call) {
    return derive_region(call, [](const Region& r) { return r.inverted(); });
}

int grow(Call& call) {
    const Index rings = call.integer("rings");
    return derive_region(call, [&](const Region& r) { return r.grown(rings); });
}

int shrink(Call& call) {
    const Index rings = call.integer("rings");
    return derive_region(call, [&](const Region& r) { return r.shrunk(rings); });
}

int smooth_outline(Call& call) {
    const Index iterations = call.integer("iterations");
    return derive_region(call, [&](const Region& r) { return r.smoothed(iterations); });
}

int connected(Call& call) {
    const auto self = call.self<RegionObject>();
    const bool by_vertex = call.kind("at") == Kind::id;
    const Index vertex = by_vertex ? call.id("at") : kNoIndex;
    const Vec3 point = by_vertex ? Vec3(Vec3::Zero()) : call.vector("at");
    return derive_region(call, [&](const Region& r) {
        return by_vertex ? connected_part(r, vertex) : connected_part(self->mesh->mesh, r, point);
    });
}

int contains(Call& call) {
    const auto self = call.self<RegionObject>();
    const Index v = call.id("vertex");
    return compute(call, [&] { return self->current().contains(v); });
}

int region_center(Call& call) {
    const auto self = call.self<RegionObject>();
    Vec3 result = Vec3::Zero();
    const bool done = call.attempt([&] { result = center(self->mesh->mesh, self->current()); });
    return done ? call.push_vector(result) : call.fail();
}

int region_bounds(Call& call) {
    const auto self = call.self<RegionObject>();
    Box box;
    const bool done = call.attempt([&] {
        box = bounds(self->mesh->mesh, self->current());
        if (box.empty()) throw Error(ErrorCode::region_empty, "an empty region has no bounds");
    });
    return done ? push_bounds(call, box) : call.fail();
}

int region_vertices(Call& call) {
    const auto self = call.self<RegionObject>();
    if (!call.attempt_quick([&] { self->current(); })) return call.fail();
    return call.push_ids(self->region.vertices());
}

int region_faces(Call& call) {
    const auto self = call.self<RegionObject>();
    auto& faces = call.hold<std::vector<Index>>();
    if (!call.attempt([&] { faces = self->current().faces(); })) return call.fail();
    return call.push_ids(faces);
}

int region_boundaries(Call& call) {
    const auto self = call.self<RegionObject>();
    auto& paths = call.hold<std::vector<Path>>();
    if (!call.attempt([&] { paths = boundaries(self->current()); })) return call.fail();
    return push_paths(call, self->mesh, paths);
}

int region_mesh(Call& call) {
    return push_owner(call, call.self<RegionObject>()->mesh);
}

int region_size(Call& call) {
    const auto self = call.self<RegionObject>();
    return compute(call, [&] { return self->current().size(); });
}

int region_text(Call& call) {
    const auto self = call.self<RegionObject>();
    const bool current = call.attempt_quick([&] { self->current(); });
    if (!current) return call.push("lissom.Region (of an older topology)");
    lua_pushfstring(call.lua(), "lissom.Region: %d of %d vertices", self->region.size(),
                    self->mesh->mesh.vertex_count());
    return 1;
}

int equal_regions(Call& call) {
    const auto a = call.self<RegionObject>(1), b = call.self<RegionObject>(2);
    return compute(call, [&] { return a->current() == b->current(); });
}

const std::vector<Result> kRegion = {{"lissom.Region", "region", "A new region."}};

std::vector<Function> set_operations() {
    const std::vector<Parameter> other = {
        object("other", "lissom.Region", "A region of the same mesh.")};
    const auto rings = integer("rings", "Number of rings of neighbours.").defaults(1).at_least(0);
    const std::vector<ErrorCode> errors = {ErrorCode::topology_mismatch};
    const std::string two = R"(local mesh = lissom.shapes.box()
local a, b = mesh:region("top"), mesh:region("left")
)";
    return {
        {.name = "union",
         .body = unite,
         .summary = "Vertices in this region or the other.",
         .arguments = other,
         .results = kRegion,
         .errors = errors,
         .example = two + "assert(#a:union(b) == 6)"},
        {.name = "minus",
         .body = subtract,
         .summary = "Vertices in this region but not in the other.",
         .arguments = other,
         .results = kRegion,
         .errors = errors,
         .example = two + "assert(#a:minus(b) == 2)"},
        {.name = "intersect",
         .body = intersect,
         .summary = "Vertices in both regions.",
         .arguments = other,
         .results = kRegion,
         .errors = errors,
         .example = two + "assert(#a:intersect(b) == 2)"},
        {.name = "invert",
         .body = invert,
         .summary = "Vertices that are not in this region.",
         .results = kRegion,
         .errors = errors,
         .example = two + "assert(#a:invert() == 4)"},
        {.name = "grow",
         .body = grow,
         .summary = "This region and rings of neighbours around it.",
         .arguments = {rings},
         .results = kRegion,
         .errors = errors,
         .example = two + "assert(#a:grow() == 8)"},
        {.name = "shrink",
         .body = shrink,
         .summary =
             "This region without the vertices within so many edges of a vertex outside. Open "
             "boundaries of the mesh do not count as outside.",
         .arguments = {rings},
         .results = kRegion,
         .errors = errors,
         .example = two + "assert(#a:shrink() == 0)"},
        {.name = "connected",
         .body = connected,
         .summary = "The part of this region that is connected with a point, by edges between "
                    "the region's vertices.",
         .options = {either("at",
                            {id("vertex", "A vertex of the region."),
                             vector("point", "A point; the region's vertex nearest to it counts.")},
                            "A vertex of the region, or a point, of which the region's nearest "
                            "vertex counts.")},
         .results = kRegion,
         .errors = {ErrorCode::topology_mismatch, ErrorCode::region_empty, ErrorCode::out_of_range},
         .example = R"(local bar = lissom.shapes.bar()
local ends = bar:region("top"):union(bar:region("bottom"))
assert(ends:connected{ at = { 0, 9, 0 } } == bar:region("top")))"},
        {.name = "smooth",
         .body = smooth_outline,
         .summary = "A smoother outline by majority vote over one-rings; specks and pinholes go.",
         .arguments = {integer("iterations", "Number of votes.").defaults(3).at_least(0)},
         .results = kRegion,
         .errors = errors,
         .example = two + "local smoother = a:smooth(2)"}};
}

std::vector<Function> region_queries() {
    const std::vector<ErrorCode> errors = {ErrorCode::topology_mismatch};
    const std::string top = "local top = lissom.shapes.box():region('top')\n";
    return {
        {.name = "contains",
         .body = contains,
         .summary = "Whether a vertex is in the region.",
         .arguments = {id("vertex", "Id of the vertex.")},
         .results = {{"boolean", "inside", "True if it is."}},
         .errors = errors,
         .example = top + "assert(top:contains(top:vertices()[1]))"},
        {.name = "center",
         .body = region_center,
         .summary = "Mean of the positions of the region's vertices.",
         .results = {{"lissom.Vector", "center", "{x, y, z}."}},
         .errors = {ErrorCode::topology_mismatch, ErrorCode::region_empty},
         .example = top + "assert(top:center()[2] == 0.5)"},
        {.name = "bounds",
         .body = region_bounds,
         .summary = "The axis-aligned box around the region's vertices.",
         .results = {{"lissom.Bounds", "bounds", "The box."}},
         .errors = {ErrorCode::topology_mismatch, ErrorCode::region_empty},
         .example = top + "assert(top:bounds().min[2] == 0.5)"},
        {.name = "vertices",
         .body = region_vertices,
         .summary = "The region's vertices.",
         .results = {{"integer[]", "vertices", "Their ids, ascending."}},
         .errors = errors,
         .example = top + "assert(#top:vertices() == 4)"},
        {.name = "faces",
         .body = region_faces,
         .summary = "The faces that have all their vertices in the region.",
         .results = {{"integer[]", "faces", "Their ids, ascending."}},
         .errors = errors,
         .example = top + "assert(#top:faces() == 1)"},
        {.name = "boundaries",
         .body = region_boundaries,
         .summary = "The loops around the region's faces, each in the direction of those faces.",
         .results = {{"lissom.Path[]", "loops", "Closed paths."}},
         .errors = errors,
         .example = top + "assert(#top:boundaries() == 1)"},
        {.name = "mesh",
         .body = region_mesh,
         .summary = "The mesh that the region belongs to.",
         .results = {{"lissom.Mesh", "mesh", "The mesh."}},
         .example = top + "assert(#top:mesh() == 8)"}};
}

std::vector<Parameter> region_options() {
    const std::string open = " nil or math.huge for an open side.";
    return {options("sphere",
                    {vector("center", "Its center."),
                     number("radius", "Its radius.").at_least(0).in("mesh units")},
                    "Vertices within a sphere.")
                .optional(),
            options("box",
                    {open_vector("min", "Smallest coordinates;" + open).optional("no limit"),
                     open_vector("max", "Greatest coordinates;" + open).optional("no limit")},
                    "Vertices within an axis-aligned box, its sides included.")
                .optional(),
            options("fraction",
                    {open_vector("min", "Smallest fractions;" + open).optional("no limit"),
                     open_vector("max", "Greatest fractions;" + open).optional("no limit")},
                    "Vertices within a box in fractions of the mesh's bounds: 0 is the least "
                    "coordinate of an axis, 1 the greatest.")
                .optional(),
            options("plane",
                    {vector("point", "A point of the plane."),
                     vector("normal", "Points to the side that is selected.")},
                    "Vertices on one side of a plane, the plane included.")
                .optional(),
            options("geodesic",
                    {source_option(),
                     number("radius", "Distance over the surface.").at_least(0).in("mesh units")},
                    "Vertices within a distance over the surface.")
                .optional(),
            ids("vertices", "These vertices.").optional(),
            string("group", "Vertices of the faces of a group.").optional(),
            string("material", "Vertices of the faces of a material.").optional(),
            id("component", "Vertices of a connected component, numbered by smallest vertex.")
                .optional(),
            table("attribute",
                  "{name, min, max}: vertices whose first number of an attribute lies in the "
                  "range.")
                .optional(),
            function("where", "fun(vertex: integer, x: number, y: number, z: number): boolean",
                     "Vertices for which the function returns true.")
                .optional(),
            boolean("all", "true: all vertices.").optional()};
}

}  // namespace

Type region_type() {
    Type type{.name = "lissom.Region",
              .summary =
                  "A set of vertices of one version of a mesh's topology. After a change of the "
                  "topology it is an error to use it."};
    type.operators = {{"__len", region_size, "#region", "number of vertices"},
                      {"__tostring", region_text, "tostring(region)", "its size"},
                      {"__eq", equal_regions, "a == b", "the same vertices of the same topology"}};
    type.methods = set_operations();
    for (Function& query : region_queries()) type.methods.push_back(std::move(query));
    return type;
}

std::vector<Function> region_methods_of_mesh() {
    return {
        {.name = "region",
         .body = make_region,
         .summary = "A region by its name, or the vertices that one of the options selects.",
         .arguments = {string("name", "Name of a region that is kept with the mesh.").optional()},
         .options = region_options(),
         .one_option = true,
         .results = {{"lissom.Region", "region", "The region, maybe empty."}},
         .errors = {ErrorCode::out_of_range, ErrorCode::invalid_argument, ErrorCode::cancelled},
         .example = R"(local mesh = lissom.shapes.cactus{ vertices = 2000 }
local arm = mesh:region("left_arm")
local high = mesh:region{ where = function(i, x, y, z) return y > 1 end }
local near = mesh:region{ sphere = { center = { 0, 2, 0 }, radius = 0.3 } }
local upper_third = mesh:region{ fraction = { min = { nil, 2 / 3, nil } } }
local around = mesh:region{ geodesic = { from = { 0, 2.5, 0 }, radius = 0.3 } }
assert(#arm > 0 and #high > 0 and #near > 0 and #upper_third > 0 and #around > 0))"},
        {.name = "set_region",
         .body = set_region,
         .summary =
             "Keeps a region under a name, in place of one before, and returns the mesh. Named "
             "regions are saved in formats that can hold them.",
         .arguments = {string("name", "Its name."),
                       object("region", "lissom.Region", "A region of this mesh.")},
         .results = {{"lissom.Mesh", "mesh", "The mesh itself."}},
         .effect = Effect::replaces,
         .errors = {ErrorCode::topology_mismatch, ErrorCode::invalid_argument},
         .example = R"(local mesh = lissom.shapes.box()
mesh:set_region("all", mesh:region{ all = true })
assert(#mesh:region("all") == 8))"},
        {.name = "remove_region",
         .body = remove_named_region,
         .summary = "Forgets a named region.",
         .arguments = {string("name", "Its name.")},
         .results = {{"boolean", "removed", "False if there was none."}},
         .effect = Effect::replaces,
         .example = "assert(lissom.shapes.box():remove_region('top'))"},
        {.name = "groups",
         .body = group_names,
         .summary = "The names of the mesh's groups of faces, for region{ group = }.",
         .results = {{"string[]", "names", "In the order of the file."}},
         .example = "assert(#lissom.shapes.box():groups() == 0)"},
        {.name = "materials",
         .body = material_names,
         .summary = "The names of its materials, for region{ material = }.",
         .results = {{"string[]", "names", "In the order of the file."}},
         .example = "assert(#lissom.shapes.box():materials() == 0)"},
        {.name = "regions",
         .body = region_names,
         .summary = "The names of the regions that are kept with the mesh.",
         .results = {{"string[]", "names", "In alphabetical order."}},
         .example = "assert(#lissom.shapes.box():regions() == 6)"}};
}

}  // namespace lissom::lua
