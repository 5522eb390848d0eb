// lissom.deform: Handle.
#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/deform/deform_object.h"
#include "bindings/lua/deform/deform_texts.h"
#include "bindings/lua/mesh/transform_options.h"
#include "kernel/deform/bones/bones.h"
#include "kernel/deform/bones/framed_curve.h"
#include "kernel/deform/handle_changes.h"
#include "kernel/deform/rotation/winding.h"

namespace lissom::lua {
namespace {

// Sets the handle's transform to work(present transform, rest center), and returns the handle. The
// transforms are about that center, so that a mesh far from the origin keeps its digits.
template <typename Work>
int move_handle(Call& call, const Work& work) {
    const auto handle = call.self<HandleObject>();
    const bool done = call.attempt_quick([&] {
        Deformer& deformer = handle->edit->deformer();
        const Vec3 center = deformer.handle(handle->id).center;
        const Affine now = transform_about(deformer, handle->id, center);
        deformer.set_transform(handle->id, work(now, center), center);
    });
    return done ? call.push_argument() : call.fail();
}

int translate_handle(Call& call) {
    const Vec3 offset = call.vector("offset");
    return move_handle(call,
                       [&](const Affine& now, const Vec3&) { return translation(offset) * now; });
}

int rotate_handle(Call& call) {
    const RotationOptions options = RotationOptions::read(call);
    const auto handle = call.self<HandleObject>();
    const bool done = call.attempt_quick([&] {
        Deformer& deformer = handle->edit->deformer();
        const Vec3 center = deformer.handle(handle->id).center;
        const Affine now = transform_about(deformer, handle->id, center);
        const Affine next = options.relative_to(center).map(now.translation) * now;
        deformer.set_transform(handle->id, next, center,
                               turned(deformer.pose(handle->id).turn, options.turn()));
    });
    return done ? call.push_argument() : call.fail();
}

int scale_handle(Call& call) {
    const Vec3 factors = call.vector("factor");
    const bool has_about = call.has("about");
    const Vec3 about = has_about ? call.vector("about") : Vec3(Vec3::Zero());
    return move_handle(call, [&](const Affine& now, const Vec3& rest) {
        return scaling(factors, has_about ? Vec3(about - rest) : now.translation) * now;
    });
}

int set_handle(Call& call) {
    const TransformOptions options = TransformOptions::read(call);
    const auto handle = call.self<HandleObject>();
    const bool done = call.attempt_quick([&] {
        Deformer& deformer = handle->edit->deformer();
        const Vec3 center = deformer.handle(handle->id).center;
        const Affine map = options.relative_to(center).map(Vec3::Zero());
        deformer.set_transform(handle->id, map, center, options.turn());
    });
    return done ? call.push_argument() : call.fail();
}

constexpr double kDegreesOfTurn = 180.0 / kPi;

// The field `turn` of the matrix, in radians; false if there is none.
bool read_turn(const Call& call, double (&turn)[3]) {
    lua_State* L = call.lua();
    lua_pushstring(L, "turn");
    lua_rawget(L, call.stack_index("matrix"));
    if (lua_isnil(L, -1)) return false;
    if (lua_type(L, -1) != LUA_TTABLE) call.reject("matrix", "turn: {x, y, z} expected");
    for (int k = 0; k < 3; ++k) {
        lua_rawgeti(L, -1, k + 1);
        if (lua_type(L, -1) != LUA_TNUMBER) call.reject("matrix", "turn: {x, y, z} expected");
        turn[k] = lua_tonumber(L, -1) / kDegreesOfTurn;
        lua_pop(L, 1);
    }
    return true;
}

int set_handle_matrix(Call& call) {
    const Affine map = call.affine("matrix");
    double turn[3] = {};
    const bool has_turn = read_turn(call, turn);
    const auto handle = call.self<HandleObject>();
    const bool done = call.attempt_quick([&] {
        Deformer& deformer = handle->edit->deformer();
        const Vec3 near =
            has_turn ? Vec3(turn[0], turn[1], turn[2]) : deformer.pose(handle->id).turn;
        deformer.set_transform(handle->id, map, Vec3::Zero(), near);
    });
    return done ? call.push_argument() : call.fail();
}

int follow_with_handle(Call& call) {
    const auto handle = call.self<HandleObject>();
    const std::span<const Vec3> points = call.points("points");
    const double share = call.number("share"), twist = call.number("twist") / kDegreesOfTurn;
    const bool has_from = call.has("from");
    const double from = has_from ? call.number("from") : 0.0;
    const bool done = call.attempt_quick([&] {
        Deformer& deformer = handle->edit->deformer();
        const FramedCurve curve(points);
        CarryOptions options;
        options.from =
            has_from ? from * curve.length() : curve.nearest(deformer.handle(handle->id).center);
        options.along = share * curve.length();
        options.twist = twist;
        follow(deformer, handle->id, curve, options);
    });
    return done ? call.push_argument() : call.fail();
}

int reset_handle(Call& call) {
    const auto handle = call.self<HandleObject>();
    const bool done = call.attempt_quick([&] {
        handle->edit->deformer().set_transform(handle->id, {}, Vec3::Zero(), Vec3::Zero());
    });
    return done ? call.push_argument() : call.fail();
}

int handle_matrix(Call& call) {
    const auto handle = call.self<HandleObject>();
    Affine map;
    Vec3 turn = Vec3::Zero();
    const bool done = call.attempt_quick([&] {
        const Deformer& deformer = handle->edit->deformer();
        map = deformer.pose(handle->id).transform;
        turn = deformer.pose(handle->id).turn;
    });
    if (!done) return call.fail();
    call.push_affine(map);
    call.set_field("turn", call.push_vector(kDegreesOfTurn * turn));
    return 1;
}

int handle_center(Call& call) {
    const auto handle = call.self<HandleObject>();
    Vec3 center = Vec3::Zero();
    const bool done = call.attempt_quick([&] {
        const Deformer& deformer = handle->edit->deformer();
        center = deformer.handle(handle->id).center;
        center += transform_about(deformer, handle->id, center).translation;
    });
    return done ? call.push_vector(center) : call.fail();
}

int handle_region(Call& call) {
    const auto handle = call.self<HandleObject>();
    const auto result = call.create<RegionObject>();
    const bool done = call.attempt_quick([&] {
        DeformObject& edit = *handle->edit;
        result.set(
            std::make_shared<RegionObject>(edit.mesh, edit.deformer().handle(handle->id).region));
    });
    return done ? 1 : call.fail();
}

int set_handle_region(Call& call) {
    const auto handle = call.self<HandleObject>();
    const auto region = call.object<RegionObject>("region");
    const bool done = call.attempt([&] {
        call.reserve(handle->edit, handle_bytes(at(region->current().size())));
        set_handle_region(handle->edit->deformer(), handle->id, region->current());
    });
    if (!done) return call.fail();
    call.charge(handle->edit);
    return call.push_argument();
}

int mirrored_handle(Call& call) {
    const auto handle = call.self<HandleObject>();
    HandleId id;
    const auto result = call.create<HandleObject>();
    const bool done = call.attempt_quick([&] {
        id = handle->edit->deformer().handle(handle->id).image.value_or(HandleId{});
        result.set(std::make_shared<HandleObject>(HandleObject{handle->edit, id}));
    });
    if (!done) return call.fail();
    if (id == HandleId{}) lua_pushnil(call.lua());
    return 1;
}

int mirror_residual(Call& call) {
    const auto handle = call.self<HandleObject>();
    MirrorResidual residual;
    const bool done =
        call.attempt([&] { residual = mirror_residual_of(handle->edit->deformer(), handle->id); });
    if (!done) return call.fail();
    lua_State* L = call.lua();
    lua_createtable(L, 0, 3);
    lua_pushnumber(L, residual.max);
    lua_setfield(L, -2, "max");
    lua_pushnumber(L, residual.mean);
    lua_setfield(L, -2, "mean");
    if (!residual.warning.empty()) {
        lua_pushstring(L, residual.warning.c_str());
        lua_setfield(L, -2, "warning");
    }
    return 1;
}

int remove_handle(Call& call) {
    const auto handle = call.self<HandleObject>();
    const bool done =
        call.attempt_quick([&] { handle->edit->deformer().remove_handle(handle->id); });
    return done ? 0 : call.fail();
}

int equal_handles(Call& call) {
    const auto a = call.self<HandleObject>(1), b = call.self<HandleObject>(2);
    return call.push(a->edit == b->edit && a->id == b->id);
}

int handle_text(Call& call) {
    const auto handle = call.self<HandleObject>();
    int vertices = 0;
    const bool present = call.attempt_quick(
        [&] { vertices = handle->edit->deformer().handle(handle->id).region.size(); });
    if (!present) return call.push("lissom.Handle (removed)");
    lua_pushfstring(call.lua(), "lissom.Handle: %d vertices", vertices);
    return 1;
}

// ---- Descriptions

const std::vector<ErrorCode> kHandleErrors = {
    ErrorCode::handle_removed, ErrorCode::singular_transform, ErrorCode::topology_mismatch};

// The axis and the angle of rotation_fields.
std::vector<Parameter> rotation_arguments() {
    std::vector<Parameter> fields = rotation_fields("");
    fields.pop_back();
    return fields;
}

std::vector<Function> handle_moves() {
    const std::vector<Result> self = {{"lissom.Handle", "handle", "The handle itself."}};
    const std::string center = "the handle's present center";
    return {{.name = "translate",
             .body = translate_handle,
             .summary = "Moves the handle on by an offset.",
             .arguments = {vector("offset", "Three numbers or {x, y, z}.").in("mesh units")},
             .results = self,
             .errors = kHandleErrors,
             .example = kBar + "top:translate(0, 1, 0):translate{ 0, 1, 0 }"},
            {.name = "rotate",
             .body = rotate_handle,
             .summary = "Turns the handle on.",
             .arguments = rotation_arguments(),
             .named_arguments = true,
             .options = {vector("about", "A point on the axis.").optional(center)},
             .results = self,
             .errors = kHandleErrors,
             .example = kBar + R"(top:rotate("z", 45)
top:rotate{ axis = { 1, 0, 0 }, angle = 10, about = { 0, 0, 0 } })"},
            {.name = "scale",
             .body = scale_handle,
             .summary = "Scales the handle on.",
             .arguments = {factors("factor", "Factor for all axes, or one for each.")},
             .options = {vector("about", "The point that stays.").optional(center)},
             .results = self,
             .errors = kHandleErrors,
             .example = kBar + "top:scale(1.5)"},
            {.name = "set",
             .body = set_handle,
             .summary =
                 "Sets the whole transform: scales the rest shape, then rotates, then translates "
                 "it. For sliders.",
             .options = transform_fields("the handle's center at rest"),
             .results = self,
             .errors = kHandleErrors,
             .example =
                 kBar + "top:set{ translate = { 1, 0, 0 }, rotate = { axis = 'y', angle = 90 } }"},
            {.name = "set_matrix",
             .body = set_handle_matrix,
             .summary =
                 "Sets the whole transform as a matrix. A matrix does not say how often the handle "
                 "has turned round: the field `turn` that Handle:matrix gives does; without it, "
                 "the turn nearest to the present one is taken.",
             .arguments = {affine("matrix",
                                  "Rows of a 4 x 4 matrix; maps rest positions to their new "
                                  "places.")},
             .results = self,
             .effect = Effect::replaces,
             .errors = kHandleErrors,
             .example = kBar + "top:set_matrix(top:matrix())"},
            {.name = "follow",
             .body = follow_with_handle,
             .summary =
                 "Carries the handle along a smooth curve through points, turning with it and not "
                 "about it. Replaces its former motion.",
             .arguments = {points("points", "Points of the curve, such as polyline:points()."),
                           number("share",
                                  "Place on the curve, as a share of its length; beyond its ends "
                                  "it goes on straight.")},
             .options =
                 {number("from", "Place that the handle has at rest.")
                      .optional("the nearest to its middle"),
                  number("twist", "Turn about the curve at that place.").in("degrees").defaults(0)},
             .results = self,
             .effect = Effect::replaces,
             .errors = kHandleErrors,
             .example = kBar + "top:follow({ { 0, 2.5, 0 }, { 0.5, 3, 0 }, { 1.5, 3, 0 } }, 0.7)\n"
                               "deformer:solve()"},
            {.name = "reset",
             .body = reset_handle,
             .summary = "The handle goes back to its initial place.",
             .results = self,
             .effect = Effect::replaces,
             .errors = kHandleErrors,
             .example = kBar + "top:translate(1, 0, 0):reset()"}};
}

}  // namespace

Type handle_type() {
    Type type{.name = "lissom.Handle",
              .summary = "Vertices of a deformation that follow one transform."};
    type.operators = {{"__tostring", handle_text, "tostring(handle)", "its size"},
                      {"__eq", equal_handles, "a == b", "the same handle of the same deformation"}};
    type.methods = handle_moves();
    const std::vector<Function> queries = {
        {.name = "matrix",
         .body = handle_matrix,
         .summary = "The transform so far.",
         .results = {{"number[][]", "matrix",
                      "Rows of a 4 x 4 matrix; its field `turn` is the rotation as {x, y, z}, axis "
                      "times angle in degrees, counting full turns."}},
         .errors = kDeformerErrors,
         .example = kBar + "assert(top:matrix()[1][1] == 1)"},
        {.name = "center",
         .body = handle_center,
         .summary = "The handle's present center.",
         .results = {{"lissom.Vector", "center", "{x, y, z}."}},
         .errors = kDeformerErrors,
         .example =
             kBar + "top:translate(0, 1, 0)\nassert(math.abs(top:center()[2] - 3.5) < 1e-12)"},
        {.name = "region",
         .body = handle_region,
         .summary = "The handle's vertices.",
         .results = {{"lissom.Region", "region", "The region."}},
         .errors = kDeformerErrors,
         .example = kBar + "assert(top:region() == bar:region('top'))"},
        {.name = "mirrored",
         .body = mirrored_handle,
         .summary = "Its mirror image, which moves along, or nil.",
         .results = {{"lissom.Handle?", "image", "The other handle."}},
         .errors = kDeformerErrors,
         .example =
             kBar +
             R"(local side = bar:region{ box = { min = { 0.4, -0.5, -1 }, max = { 1, 0.5, 1 } } }
local right = deformer:add_handle(side, { mirror = { point = { 0, 0, 0 }, normal = { 1, 0, 0 } } })
right:translate(0.5, 0, 0)
assert(right:mirrored():matrix()[1][4] == -0.5)
deformer:solve())"},
        {.name = "mirror_residual",
         .body = mirror_residual,
         .summary = "Measures how well both sides of the rest shape match if the handle has a "
                    "mirror image: the distances of the reflected vertices from the surface, in "
                    "sizes of the deformed part.",
         .results = {{"table", "residual",
                      "{max=, mean=, warning=}; the warning, with a remedy, only if the "
                      "greatest is more than the mirror's tolerance."}},
         .errors = {ErrorCode::handle_removed, ErrorCode::invalid_argument},
         .example =
             kBar +
             R"(local side = bar:region{ box = { min = { 0.4, -0.5, -1 }, max = { 1, 0.5, 1 } } }
local right = deformer:add_handle(side, { mirror = { point = { 0, 0, 0 }, normal = { 1, 0, 0 } } })
assert(right:mirror_residual().max < 1e-9))"},
        {.name = "set_region",
         .body = set_handle_region,
         .summary =
             "Gives the handle other vertices. Its transform stays, and the mesh keeps the old "
             "result until the next solve.",
         .arguments = {object("region", "lissom.Region", "Its new vertices.")},
         .results = {{"lissom.Handle", "handle", "The handle itself."}},
         .errors = {ErrorCode::region_empty, ErrorCode::topology_mismatch,
                    ErrorCode::handle_outside_region, ErrorCode::handle_overlap,
                    ErrorCode::handle_removed},
         .example = kBar + "top:set_region(bar:region('top'):grow(1)):translate(0, 1, 0)"},
        {.name = "remove",
         .body = remove_handle,
         .summary = "Takes the handle out of the deformation; it cannot be used any more.",
         .effect = Effect::changes,
         .errors = kDeformerErrors,
         .example = kBar + "top:remove()\nassert(#deformer:handles() == 1)"}};
    for (const Function& query : queries) type.methods.push_back(query);
    return type;
}

}  // namespace lissom::lua
