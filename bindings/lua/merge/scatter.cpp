// lissom.scatter: one feature pasted many times.
#include "kernel/merge/paste/scatter.h"

#include <memory>
#include <utility>

#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/core/push_list.h"
#include "bindings/lua/merge/paste_object.h"

namespace lissom::lua {
namespace {

// Returns one number of as many as there are places, or the one for all.
double given_for(std::span<const double> values, std::size_t place) {
    return values.size() == 1 ? values.front() : values[place];
}

void require_one_each(std::size_t given, std::size_t places, const char* name) {
    require(given == 1 || given == places,
            std::string("scatter takes one of '") + name + "' for all places, or one for each");
}

std::vector<PastePlacement> read_places(const Call& call) {
    const std::span<const Vec3> points = call.points("at");
    std::vector<PastePlacement> places(points.size());
    for (std::size_t i = 0; i < places.size(); ++i) places[i].at = points[i];
    for (PastePlacement& place : places) {
        if (call.has("up")) place.up = call.vector("up");
    }
    if (call.has("toward")) {
        const std::span<const Vec3> toward = call.points("toward");
        require_one_each(toward.size(), places.size(), "toward");
        for (std::size_t i = 0; i < places.size(); ++i) {
            places[i].toward = toward[toward.size() == 1 ? 0 : i];
        }
    }
    if (call.has("angles")) {
        const auto angles = call.numbers("angles");
        require_one_each(angles.size(), places.size(), "angles");
        for (std::size_t i = 0; i < places.size(); ++i) {
            places[i].angle = given_for(angles, i) * kDegree;
        }
    }
    if (call.has("scales")) {
        const auto scales = call.numbers("scales");
        require_one_each(scales.size(), places.size(), "scales");
        for (std::size_t i = 0; i < places.size(); ++i) places[i].scale = given_for(scales, i);
    }
    return places;
}

void push_shrunk(const Call& call, const std::vector<ShrunkPlace>& shrunk) {
    push_list(call, shrunk, [&](const auto& place) {
        lua_createtable(call.lua(), 0, 2);
        call.set_field("place", call.push(place.place + 1));
        call.set_field("scale", call.push(place.scale));
    });
}

void push_moved(const Call& call, const std::vector<MovedPlace>& moved) {
    push_list(call, moved, [&](const auto& place) {
        lua_createtable(call.lua(), 0, 2);
        call.set_field("place", call.push(place.place + 1));
        call.set_field("at", call.push_vector(place.at));
    });
}

void push_faulty(const Call& call, const std::vector<FaultyPlace>& faulty) {
    push_list(call, faulty, [&](const auto& place) {
        lua_createtable(call.lua(), 0, 2);
        call.set_field("place", call.push(place.place + 1));
        push_reasons(call, place.reasons);
        call.set_field("reasons");
    });
}

void push_refused(const Call& call, const std::vector<RefusedPlace>& refused) {
    push_list(call, refused, [&](const auto& place) {
        lua_createtable(call.lua(), 0, 3);
        call.set_field("place", call.push(place.place + 1));
        call.set_field("code", call.push(std::string_view(code_name(place.code))));
        call.set_field("message", call.push(std::string_view(place.message)));
    });
}

// The vertices of faces that belong to a place.
Region region_of_parts(const Mesh& mesh, const std::vector<Index>& place_of_face) {
    std::vector<Index> vertices;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        if (place_of_face[at(f)] == kNoIndex) continue;
        for (const Index v : mesh.topology().face(f)) vertices.push_back(v);
    }
    return {mesh.shared_topology(), std::move(vertices)};
}

ScatterOptions read_scatter_options(const Call& call) {
    ScatterOptions options;
    options.iterations = call.integer("iterations");
    options.paste.share = call.number("ring");
    options.paste.normals = call.number("normals");
    options.merge.smooth = call.integer("smooth");
    options.merge.collar = call.boolean("collar");
    options.merge.lock_scale = call.integer("size") == 1;
    options.crossings = call.choice<ScatterCrossings>("crossings");
    return options;
}

void push_scatter_report(const Call& call, const ScatterResult& found) {
    lua_createtable(call.lua(), 0, 12);
    set_verdict(call, found.ok, found.verdict, found.reasons);
    call.set_field("placed", call.push(found.placed));
    push_moved(call, found.moved);
    call.set_field("moved");
    push_faulty(call, found.faulty);
    call.set_field("faulty");
    push_refused(call, found.refused);
    call.set_field("refused");
    push_shrunk(call, found.shrunk);
    call.set_field("shrunk");
    call.set_field("crossings", call.push(found.crossings));
    call.set_field("rounds", call.push(found.rounds));
    call.set_field("place_of_face", call.push_ids(found.place_of_face));
}

int scatter_part(Call& call) {
    const auto source = call.object<MeshObject>("source");
    const auto target = call.object<MeshObject>("target");
    const auto region = call.object<RegionObject>("region");
    const bool given = call.is_object<RegionObject>("feature");
    auto& found = call.hold<std::unique_ptr<ScatterResult>>();
    auto& made = call.hold<std::shared_ptr<MeshObject>>();
    const auto mesh = call.create<MeshObject>();
    const bool done = call.attempt([&] {
        const ScatterOptions options = read_scatter_options(call);
        std::optional<Region> feature;
        if (given) feature = call.object<RegionObject>("feature")->current();
        found = std::make_unique<ScatterResult>(
            scatter(source->mesh, target->mesh, region->current(), feature, read_places(call),
                    options, call.context()));
        made = std::make_shared<MeshObject>(std::move(found->mesh));
        mesh.set(made);
    });
    if (!done) return call.fail();
    call.remember(made.get());
    call.charge(mesh);
    push_scatter_report(call, *found);
    const auto parts = call.create<RegionObject>();
    call.set_field("parts");
    const bool set = call.attempt_quick([&] {
        parts.set(std::make_shared<RegionObject>(
            made, region_of_parts(made->mesh, found->place_of_face)));
    });
    return set ? 2 : call.fail();
}

std::vector<Parameter> scatter_parameters() {
    const ScatterOptions defaults;
    return {
        object("source", "lissom.Mesh", "The mesh that has the feature; it stays as it is."),
        object("target", "lissom.Mesh", "The mesh that it is pasted onto; it stays as it is."),
        object("region", "lissom.Region", "Part of the source around the feature."),
        either("feature",
               {object("region", "lissom.Region", ""),
                choice("auto", {"auto"}, "The core of the region.")},
               "See lissom.paste.")
            .optional("auto"),
        points("at",
               "Places: the middle of the feature comes to lie on the nearest point of the "
               "target. The first of two that meet counts."),
        points("toward", "See the placement of lissom.paste: one for all or one a place.")
            .optional("the same as `up`"),
        axis("up", "The direction of the source that belongs to it.").optional("y"),
        numbers("angles", "See the placement of lissom.paste: one for all or one a place.")
            .in("degrees")
            .optional("0, or the best of twelve if `up` does not lie in the surfaces and "
                      "`toward` is not given"),
        numbers("scales", "See the placement of lissom.paste: one for all or one a place.")
            .optional("1"),
        integer("iterations",
                "Iterations of the search for each boundary; 0 takes the outline of the region.")
            .at_least(0)
            .defaults(defaults.iterations),
        number("ring", "Share of the region that is searched if no feature is given.")
            .between(0.01, 0.99)
            .defaults(0.5),
        number("normals", "Weight of the normals in the energy of a boundary.")
            .at_least(0)
            .defaults(0.0),
        integer("smooth", "Umbrella steps at a seam, at most.").between(0, 1000).defaults(3),
        boolean("collar", "Makes faces anew beside a seam if one side is coarser.").defaults(true),
        choice("size", {"boundary", "lock"},
               "Size of a part: that of its boundary on the target, or its `scales`.")
            .defaults("boundary"),
        choice("crossings", {"shrink", "leave out", "keep"},
               "Treatment of a part that would run through itself, the target or a part before "
               "it, bite into a sharp edge of the target or fold. shrink: one that bites moves "
               "away from the edge; it is made smaller, by a fifth at a time and by a half at "
               "most, and left out if that does not help. keep: it stays, and the report tells it.")
            .defaults("shrink")};
}

}  // namespace

std::vector<Function> scatter_functions() {
    return {
        {.name = "scatter",
         .body = scatter_part,
         .summary =
             "Pastes one feature many times: scales, spikes, leaves. Each paste sees a small disk "
             "of the target alone, and all that do not touch are put into the mesh together, so "
             "that hundreds are quick. A place on another part, or without room, is refused and "
             "told; scripts/recipes/scatter.lua finds places.",
         .options = scatter_parameters(),
         .results = {{"lissom.Mesh", "mesh", "The target with all parts."},
                     {"lissom.ScatterReport", "report",
                      "Refused places, and the places of parts."}},
         .errors = {ErrorCode::topology_mismatch, ErrorCode::region_empty,
                    ErrorCode::boundary_conflict, ErrorCode::not_a_disk,
                    ErrorCode::invalid_argument, ErrorCode::mesh_empty, ErrorCode::not_finite,
                    ErrorCode::not_positive_definite, ErrorCode::memory_limit,
                    ErrorCode::cancelled},
         .example = R"(local source = lissom.shapes.sphere{ segments = 16 }
for i = 1, source:vertex_count() do
    local x, y, z = source:position(i)
    if y > 0 then source:set_position(i, x, y + 0.8 * math.exp(-12 * (x * x + z * z)), z) end
end
local mesh, report = lissom.scatter{
    source = source, target = lissom.shapes.sphere{ segments = 24, radius = 3 },
    region = source:region{ sphere = { center = { 0, 1.3, 0 }, radius = 0.95 } },
    at = { { 3, 0, 0 }, { 0, 3, 0 }, { 0, 0, 3 }, { 3, 0.1, 0 } }, scales = { 0.5 },
}
assert(mesh:is_closed() and #report.refused == 1 and report.refused[1].place == 4))"}};
}

std::vector<Record> scatter_records() {
    return {
        {"lissom.RefusedPlace",
         "A place that was left out.",
         {{"integer", "place", "Its number."},
          {"string", "code", "Code of the failure; see lissom explain."},
          {"string", "message", "Why."}}},
        {"lissom.ShrunkPlace",
         "A place whose part was made smaller so that it crosses nothing.",
         {{"integer", "place", "Its number."}, {"number", "scale", "The scale it has."}}},
        {"lissom.MovedPlace",
         "A place whose part was moved away from a sharp edge of the target.",
         {{"integer", "place", "Its number."}, {"number[]", "at", "{x, y, z}: its position."}}},
        {"lissom.FaultyPlace",
         "A part of a scatter that stands though it is not good.",
         {{"integer", "place", "The number of its place."},
          {"lissom.MergeReason[]", "reasons", "Why, as of a merge."}}},
        {"lissom.ScatterReport",
         "Report of lissom.scatter. tostring gives the verdict and remedies.",
         {{"boolean", "ok",
           "All parts that stand are good, nothing crosses, and nine of ten places have a part."},
          {"string", "verdict", "The same in one line, with the numbers of parts."},
          {"lissom.MergeReason[]", "reasons",
           "Each kind of fault: how many parts have it, or the part of the places left out."},
          {"integer", "placed", "Parts that stand."},
          {"lissom.MovedPlace[]", "moved", "Places whose parts were moved, by number."},
          {"lissom.FaultyPlace[]", "faulty", "Parts that stand but are not good, by number."},
          {"lissom.RefusedPlace[]", "refused", "Places that were left out, by number."},
          {"lissom.ShrunkPlace[]", "shrunk", "Places whose parts were made smaller, by number."},
          {"integer", "crossings",
           "Pairs of faces that cross, of parts that were kept nevertheless."},
          {"lissom.Region", "parts", "All parts, on the new mesh."},
          {"integer[]", "place_of_face",
           "For each face the number of the place that its part was put to, or 0."},
          {"integer", "rounds", "Times that parts were put into the mesh together."}}}};
}

}  // namespace lissom::lua
