// mesh:cut, and the methods of a path that trim a boundary.
#include "kernel/mesh/cut/cut.h"

#include <array>

#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/core/push_list.h"
#include "bindings/lua/mesh/path_object.h"
#include "kernel/mesh/cut/trim.h"

namespace lissom::lua {
namespace {

// In the order of CutConcern.
constexpr std::array kConcerns = {"touches_boundary", "folded_line",      "lines_nearby",
                                  "keeps_most",       "several_outlines", "not_separating"};

// ---- mesh:cut

// Result of a cut, until it is pushed.
struct CutResult {
    std::shared_ptr<MeshObject> a, b;
    std::vector<Path> on_a, on_b;
    CutReport report;
};

// Refuses options that do not go together.
void check_options(const Call& call) {
    const int ways = call.has("plane") + call.has("path") + call.has("region");
    if (ways != 1) call.raise("cut needs one of the options 'plane', 'path' and 'region'");
    if (call.has("plane") && call.has("smoothing")) {
        call.reject("smoothing", "only for 'path' and 'region'");
    }
    if (call.has("region") && call.has("seed")) call.reject("seed", "only for 'plane' and 'path'");
}

std::optional<Vec3> given_vector(const Call& call, const char* path) {
    if (!call.has(path)) return std::nullopt;
    return call.vector(path);
}

CutPlane given_plane(const Call& call) {
    return {call.vector("plane.point"), call.vector("plane.normal"),
            given_vector(call, call.has("seed") ? "seed" : "plane.seed"),
            given_vector(call, "plane.near")};
}

Path given_path(const Call& call) {
    if (call.kind("path") == Kind::object) return call.object<PathObject>("path")->current();
    const std::span<const Vec3> points = call.points("path");
    return {{points.begin(), points.end()}, true};
}

// Runs `work` on the given plane, path or region, and on the options.
template <typename Work>
auto with_cut(const Call& call, const Work& work) {
    CutOptions options;
    options.slide = call.number("slide");
    if (call.has("plane")) {
        options.loops = call.choice<CutLoops>("plane.loops");
        return work(given_plane(call), options);
    }
    const double smoothing = call.has("smoothing") ? call.number("smoothing") : 0.04;
    if (call.has("path")) {
        return work(CutPath{given_path(call), given_vector(call, "seed"), smoothing}, options);
    }
    return work(CutRegion{call.object<RegionObject>("region")->current(), smoothing}, options);
}

void push_warnings(Call& call, const std::vector<CutWarning>& warnings) {
    push_list(call, warnings, [&](const CutWarning& warning) {
        lua_createtable(call.lua(), 0, 3);
        call.set_field("kind", call.push(kConcerns[static_cast<std::size_t>(warning.concern)]));
        call.set_field("message", call.push(std::string_view(warning.message)));
        call.set_field("vertices", call.push_ids(warning.elements.ids));
    });
}

void push_report(Call& call, const CutReport& report) {
    lua_createtable(call.lua(), 0, 7);
    push_warnings(call, report.warnings);
    call.set_field("warnings");
    call.set_field("touched_boundaries", call.push_ids(report.touched_boundaries));
    call.set_field("lines_left", call.push(static_cast<int>(report.lines_left)));
    call.set_field("whole_components", call.push(static_cast<int>(report.whole_components)));
    call.set_field("kept_fraction", call.push(report.kept_fraction));
    call.set_field("slid_vertices", call.push_ids(report.slid_vertices));
    call.set_field("divided_faces", call.push(static_cast<int>(report.divided_faces)));
}

int show_cut(Call& call) {
    const auto mesh = call.self<MeshObject>();
    auto& owner = call.hold<std::shared_ptr<MeshObject>>();
    auto& preview = call.hold<CutPreview>();
    const bool done = call.attempt([&] {
        owner = mesh.share();
        preview = with_cut(call, [&](const auto& by, const CutOptions& options) {
            return preview_cut(mesh->mesh, by, options, call.context());
        });
    });
    if (!done) return call.fail();
    if (push_paths(call, owner, preview.lines) != 1) return 4;
    if (push_paths(call, owner, preview.others) != 1) return 4;
    call.set_field("others");
    push_report(call, preview.report);
    call.set_field("report");
    return 1;
}

int cut_mesh(Call& call) {
    check_options(call);
    if (call.boolean("preview")) return show_cut(call);
    const auto mesh = call.self<MeshObject>();
    auto& result = call.hold<CutResult>();
    const auto a = call.create<MeshObject>();
    const bool done = call.attempt([&] {
        Cut parts = with_cut(call, [&](const auto& by, const CutOptions& options) {
            return cut(mesh->mesh, by, options, call.context());
        });
        result.a = std::make_shared<MeshObject>(std::move(parts.kept.mesh));
        result.b = std::make_shared<MeshObject>(std::move(parts.rest.mesh));
        for (CutLine& line : parts.lines) {
            result.on_a.push_back(std::move(line.kept));
            result.on_b.push_back(std::move(line.rest));
        }
        result.report = std::move(parts.report);
        a.set(result.a);
    });
    if (!done) return call.fail();
    call.remember(result.a.get());
    call.charge(a);
    const auto b = call.create<MeshObject>();
    if (!call.attempt_quick([&] { b.set(result.b); })) return call.fail();
    call.remember(result.b.get());
    call.charge(b);
    if (push_paths(call, result.a, result.on_a) != 1) return 4;
    if (push_paths(call, result.b, result.on_b) != 1) return 4;
    call.set_field("b");
    push_report(call, result.report);
    call.set_field("report");
    return 3;
}

// ---- Methods of a path

int path_mean_turn(Call& call) {
    const auto self = call.self<PathObject>();
    return compute(call, [&] { return mean_turn(self->mesh->mesh, self->current()) / kDegree; });
}

int trim_boundary(Call& call) {
    const auto self = call.self<PathObject>();
    TrimOptions options;
    options.smoothing = call.number("smoothing");
    options.margin = call.number("margin");
    options.slide = call.number("slide");
    struct {
        double before, after, smoothing;
        Index removed, divided;
    } report{};
    const auto result = call.create<PathObject>();
    const bool done = call.attempt([&] {
        MeshObject& owner = *self->mesh;
        Trim trimmed = trim(owner.mesh, self->current(), options, call.context());
        report = {trimmed.turn_before, trimmed.turn_after, trimmed.smoothing, trimmed.removed_faces,
                  trimmed.divided_faces};
        result.set(std::make_shared<PathObject>(self->mesh, std::move(trimmed.boundary)));
        owner.mesh.replace_by(std::move(trimmed.mesh));
        owner.changed();
    });
    if (!done) return call.fail();
    call.charge(result);
    lua_createtable(call.lua(), 0, 5);
    call.set_field("before", call.push(report.before / kDegree));
    call.set_field("after", call.push(report.after / kDegree));
    call.set_field("smoothing", call.push(report.smoothing));
    call.set_field("removed_faces", call.push(static_cast<int>(report.removed)));
    call.set_field("divided_faces", call.push(static_cast<int>(report.divided)));
    return 2;
}

Parameter slide_option() {
    return number("slide",
                  "A vertex slides onto the line if that crosses one of its edges within this "
                  "fraction of the edge, so that no slivers appear.")
        .defaults(CutOptions{}.slide)
        .between(0, 0.45);
}

std::vector<Parameter> cut_options() {
    return {
        options(
            "plane",
            {vector("point", "A point of the plane; the line nearest to it is cut."),
             vector("normal", "Towards the part to keep."),
             vector("seed", "A point on or near the part to keep, instead of the normal's side.")
                 .optional(),
             vector("near", "Point that selects the nearest line, instead of the plane's point.")
                 .optional(),
             choice("loops", {"nearest", "all"},
                    "The line nearest to the point, or all lines of the plane.")
                 .defaults("nearest")},
            "Cuts by a plane; other crossings of the plane with the mesh stay whole.")
            .optional(),
        either("path",
               {points("points", "Points on or near the surface."),
                object("line", "lissom.Path", "A closed path of this mesh.")},
               "Cuts along a smooth line near a closed path; the part on its left is kept.")
            .optional(),
        object("region", "lissom.Region", "Cuts along all outlines of a region, which is kept.")
            .optional(),
        vector("seed", "A point on or near the part to keep, for a plane or path.").optional(),
        number("smoothing",
               "The line along a path or outline is smoothed over two edges around, but no more "
               "than this fraction of its length.")
            .between(0, 0.1)
            .above(0)
            .optional("0.04"),
        slide_option(),
        boolean("preview",
                "Cuts nothing and returns the lines alone: those that would be cut, as free paths "
                "with the kept part on their left, and in their fields `others`, lines in which "
                "the plane crosses too, and `report`.")
            .defaults(false)};
}

}  // namespace

std::vector<Function> cut_methods_of_mesh() {
    return {
        {.name = "cut",
         .body = cut_mesh,
         .summary =
             "Cuts the mesh in two along a smooth line through its faces: by exactly one of "
             "plane, path and region. Attributes are interpolated; vertices and faces off the "
             "line stay as they are. The mesh itself is not changed.",
         .options = cut_options(),
         .results = {{"lissom.Mesh", "a", "The part that is kept; with `preview` the lines alone."},
                     {"lissom.Mesh", "b", "The rest."},
                     {"lissom.CutLines", "loops", "The lines on both parts, and a report."}},
         .errors = {ErrorCode::mesh_empty, ErrorCode::invalid_argument,
                    ErrorCode::topology_mismatch, ErrorCode::region_empty,
                    ErrorCode::boundary_conflict, ErrorCode::nonmanifold_edge,
                    ErrorCode::cancelled},
         .example = R"(local cactus = lissom.shapes.cactus{ vertices = 3000 }
local tip, foot, loops = cactus:cut{ plane = { point = { 0, 1.7, 0 }, normal = { 0, 1, 0.2 } } }
assert(#loops == 1 and loops[1]:is_boundary() and #loops[1] == #loops.b[1])
assert(tip:bounds().min[2] > foot:bounds().min[2])
-- The lines of a cut, without cutting:
local lines = cactus:cut{ plane = { point = { 0, 1.7, 0 }, normal = { 0, 1, 0 } }, preview = true }
print(#lines .. " cut, " .. #lines.others .. " left, keeps " .. lines.report.kept_fraction))"}};
}

std::vector<Function> trim_methods_of_path() {
    const TrimOptions defaults;
    return {
        {.name = "trim",
         .body = trim_boundary,
         .summary =
             "Makes a jagged open boundary smooth, in place: cuts a thin strip of the mesh off "
             "along a smooth line just inside. Paths and regions of before are then of an "
             "older topology.",
         .options = {number("smoothing",
                            "Smoothing: standard deviation of the Gaussian that smooths the "
                            "loop, as a fraction of its length.")
                         .defaults(defaults.smoothing)
                         .between(0, 0.1)
                         .above(0),
                     number("margin",
                            "Distance of the new boundary from the innermost vertex of the old "
                            "one, in edge lengths.")
                         .defaults(defaults.margin)
                         .at_least(0),
                     slide_option()},
         .results = {{"lissom.Path", "boundary", "The new boundary of the mesh."},
                     {"lissom.TrimReport", "report", "Measures of the cut."}},
         .errors = {ErrorCode::topology_mismatch, ErrorCode::not_a_boundary,
                    ErrorCode::invalid_argument, ErrorCode::boundary_conflict,
                    ErrorCode::nonmanifold_edge, ErrorCode::cancelled},
         .example = R"(local ball = lissom.shapes.sphere{ kind = "triangles" }
local cap = ball:extract(ball:region{ plane = { point = { 0, 0.2, 0 }, normal = { 0.3, 1, 0 } } })
local border, report = cap:boundaries()[1]:trim()
assert(border:is_boundary() and report.after < report.before))"},
        {.name = "mean_turn",
         .body = path_mean_turn,
         .summary = "Mean angle by which the line turns at its points: small for a smooth one, 30 "
                    "degrees and more for one along the edges of triangles.",
         .results = {{"number", "angle", "In degrees."}},
         .errors = {ErrorCode::topology_mismatch},
         .example = R"(local tube = lissom.shapes.cylinder{ segments = 36, caps = false }
assert(math.abs(tube:boundaries()[1]:mean_turn() - 10) < 1e-6))"}};
}

std::vector<Record> cut_records() {
    return {
        {"lissom.CutLines",
         "The lines of a cut on the part that is kept, as a list.",
         {{"lissom.Path", "[integer]",
           "With the surface on its left; closed unless it ends at open boundaries."},
          {"lissom.Path[]", "b",
           "The same lines on the rest: from the same points, the other way."},
          {"lissom.Path[]|nil", "others",
           "For a preview: other lines of the plane, which would not be cut."},
          {"lissom.CutReport", "report", "Measures and warnings."}}},
        {"lissom.CutReport",
         "Report of a cut.",
         {{"lissom.CutWarning[]", "warnings",
           "Reasons why the result may not be the intended one."},
          {"integer[]", "touched_boundaries",
           "Open boundaries that lines end at: places in mesh:boundaries() of before."},
          {"integer", "lines_left", "Lines in which the plane crosses too, not cut."},
          {"integer", "whole_components", "Components that went to one part as a whole."},
          {"number", "kept_fraction",
           "Part of the mesh's area, 0 to 1, on the side of the lines that is kept."},
          {"integer[]", "slid_vertices", "Vertices of before that slid onto a line."},
          {"integer", "divided_faces", "Faces that were divided."}}},
        {"lissom.CutWarning",
         "Reason why the result of a cut may not be the intended one.",
         {{"string", "kind",
           "touches_boundary: a line ends at an open boundary; folded_line: a line seems to "
           "run over a fin or limb; lines_nearby: the plane crosses the mesh nearby too; "
           "keeps_most: a plane or path without a seed keeps more than 80 % of the area, "
           "perhaps the wrong part; several_outlines: a region was cut along more than one line; "
           "not_separating, of a preview: the cut would fail, its sides are connected."},
          {"string", "message", "The finding and a remedy."},
          {"integer[]", "vertices", "Vertices at the place, of the mesh before, at most 100."}}},
        {"lissom.TrimReport",
         "Report of smoothing a boundary.",
         {{"number", "before", "Mean turn of the boundary before, in degrees."},
          {"number", "after", "Mean turn of the new one."},
          {"number", "smoothing",
           "The smoothing used: less than asked for if the boundary turns too sharply."},
          {"integer", "removed_faces", "Faces that are gone."},
          {"integer", "divided_faces", "Faces that were divided."}}}};
}

}  // namespace lissom::lua
