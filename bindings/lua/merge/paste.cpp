// lissom.paste: features put onto other surfaces.
#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/deform/thesis_parts.h"
#include "bindings/lua/merge/paste_object.h"

namespace lissom::lua {

Paste& PasteSetup::paste() {
    if (!content) throw Error(ErrorCode::handle_removed, "the paste was closed; make a new one");
    return *content;
}

PastePlacement read_placement(const Call& call, const std::string& path, PastePlacement placement,
                              const char* at) {
    const auto name = [&](const char* field) { return path + field; };
    if (call.has(name(at).c_str())) placement.at = call.vector(name(at).c_str());
    if (call.has(name("toward").c_str())) placement.toward = call.vector(name("toward").c_str());
    if (call.has(name("up").c_str())) placement.up = call.vector(name("up").c_str());
    if (call.has(name("angle").c_str())) {
        placement.angle = kDegree * call.number(name("angle").c_str());
    }
    if (call.has(name("scale").c_str())) placement.scale = call.number(name("scale").c_str());
    if (call.has(name("offset").c_str())) {
        const auto offset = call.numbers(name("offset").c_str());
        require(offset.size() == 2, "the offset of a placement has two numbers");
        placement.offset = {offset[0], offset[1]};
    }
    return placement;
}

PasteMergeOptions read_paste_merge(const Call& call, const char* size) {
    PasteMergeOptions options;
    options.smooth = call.integer("smooth");
    options.collar = call.boolean("collar");
    options.find_intersections = call.boolean("intersections");
    options.lock_scale = call.integer(size) == 1;
    options.compare = call.boolean("compare");
    options.mend = call.boolean("mend");
    return options;
}

void read_clearing(const Call& call, PasteOptions& options) {
    if (!call.has("clear")) return;
    if (call.is_object<RegionObject>("clear")) {
        options.cleared = call.object<RegionObject>("clear")->current();
    } else {
        options.clear = call.boolean("clear");
    }
}

int push_paste_result(Call& call, PasteResult& result, const MergeInputs& inputs) {
    const int pushed = push_merge_result(call, result.merged, inputs);
    if (pushed != 2) return pushed;
    push_paste_report(call, result.report);
    call.set_field("paste");
    return 2;
}

namespace {

int new_paste(Call& call) {
    const auto source = call.object<MeshObject>("source");
    const auto target = call.object<MeshObject>("target");
    const auto region = call.object<RegionObject>("region");
    const bool given = call.is_object<RegionObject>("feature");
    const auto result = call.create<PasteSetup>();
    const bool done = call.attempt([&] {
        PasteOptions options;
        options.correspondence = call.choice<PasteCorrespondence>("correspondence");
        options.loop = call.choice<PasteBoundary>("loop");
        options.share = call.number("ring");
        options.normals = call.number("normals");
        options.crease = kDegree * call.number("crease");
        if (call.integer("fidelity") == 1) options.thesis = &literal_formulas();
        std::optional<Region> feature, onto;
        if (given) feature = call.object<RegionObject>("feature")->current();
        read_clearing(call, options);
        if (call.has("onto")) onto = call.object<RegionObject>("onto")->current();
        const auto setup = std::make_shared<PasteSetup>();
        setup->content.emplace(source->mesh, target->mesh, region->current(), feature, onto,
                               read_placement(call, "placement.", {}), options, call.context());
        setup->source = source.share();
        setup->target = target.share();
        for (const MeshObject* mesh : {target.get(), source.get()}) {
            setup->inputs.vertices.push_back(mesh->mesh.vertex_count());
            setup->inputs.faces.push_back(mesh->mesh.face_count());
        }
        result.set(setup);
    });
    if (!done) return call.fail();
    call.charge(result);
    return 1;
}

// ---- Paste

int optimize_paste(Call& call) {
    const auto setup = call.self<PasteSetup>();
    const Index iterations = call.integer("iterations");
    auto& report = call.hold<PasteSearch>();
    const auto loop = call.create<PathObject>();
    const bool done = call.attempt([&] {
        Path path = setup->paste().optimize(iterations, call.context());
        report = setup->paste().search();
        loop.set(std::make_shared<PathObject>(setup->source, std::move(path)));
    });
    return done ? 1 + push_paste_search(call, report) : call.fail();
}

int merge_paste(Call& call) {
    const auto setup = call.self<PasteSetup>();
    PasteMergeOptions options = read_paste_merge(call, "scale");
    options.draft = call.boolean("draft");
    auto& result = call.hold<std::unique_ptr<PasteResult>>();
    const bool done = call.attempt([&] {
        result = std::make_unique<PasteResult>(setup->paste().merge(options, call.context()));
    });
    return done ? push_paste_result(call, *result, setup->inputs) : call.fail();
}

int draft_paste(Call& call) {
    const auto setup = call.self<PasteSetup>();
    const PasteDraftOptions options{call.integer("scale") == 1, call.boolean("compare")};
    auto& draft = call.hold<std::optional<PasteDraft>>();
    const auto mesh = call.create<MeshObject>();
    const auto boundary = call.create<PathObject>();
    const bool done = call.attempt([&] {
        draft = setup->paste().draft(options, call.context());
        const auto part = std::make_shared<MeshObject>(std::move(draft->part));
        boundary.set(std::make_shared<PathObject>(
            part, Path(part->mesh.shared_topology(), std::move(draft->rim), true)));
        mesh.set(part);
    });
    if (!done) return call.fail();
    call.charge(mesh);
    return 2 + push_paste_draft(call, *draft);
}

int move_paste(Call& call) {
    const auto setup = call.self<PasteSetup>();
    const bool seeks = call.boolean("search");
    const bool done = call.attempt([&] {
        Paste& paste = setup->paste();
        const PastePlacement placement = read_placement(call, "", paste.placement());
        if (seeks) {
            paste.move(placement, call.context());
        } else {
            paste.slide(placement, call.context());
        }
    });
    return done ? call.push_argument() : call.fail();
}

int search_of_paste(Call& call) {
    const auto setup = call.self<PasteSetup>();
    auto& report = call.hold<PasteSearch>();
    if (!call.attempt_quick([&] { report = setup->paste().search(); })) return call.fail();
    return push_paste_search(call, report);
}

int loop_of_paste(Call& call) {
    const auto setup = call.self<PasteSetup>();
    const auto loop = call.create<PathObject>();
    const auto image = call.create<PathObject>();
    const bool done = call.attempt_quick([&] {
        loop.set(std::make_shared<PathObject>(setup->source, setup->paste().loop()));
        image.set(std::make_shared<PathObject>(setup->target, setup->paste().image()));
    });
    return done ? 2 : call.fail();
}

int clearing_of_paste(Call& call) {
    const auto setup = call.self<PasteSetup>();
    auto& found = call.hold<std::optional<PasteClearing>>();
    const auto region = call.create<RegionObject>();
    const bool done = call.attempt_quick([&] {
        found = setup->paste().clearing();
        if (found) {
            region.set(std::make_shared<RegionObject>(setup->target, *setup->paste().cleared()));
        }
    });
    if (!done) return call.fail();
    if (!found) {
        lua_pushnil(call.lua());
        return 1;
    }
    return 1 + push_clearing(call, *found);
}

void close_paste(void* object) {
    auto& setup = *static_cast<PasteSetup*>(object);
    setup.content.reset();
    setup.source.reset();
    setup.target.reset();
}

// ---- Descriptions

}  // namespace

std::vector<Parameter> placement_fields(bool moved) {
    const auto kept = [&](const Parameter& parameter, const char* first) {
        return parameter.optional(moved ? "as it was" : first);
    };
    Parameter at = vector("at",
                          "The middle of the feature comes to lie on the point of the target that "
                          "is nearest to this.");
    return {
        moved ? at.optional("as it was") : at,
        kept(axis("toward",
                  "The way on the target that `up` of the source is to point, as far as both lie "
                  "in the surfaces."),
             "the same as `up`"),
        kept(axis("up", "The direction of the source that belongs to it."), "y"),
        kept(number("angle",
                    "Turns the part about the surface's normal, counter-clockwise seen from "
                    "outside, from `toward`.")
                 .in("degrees"),
             "0, or the best of twelve if `up` does not lie in the surfaces and `toward` is not "
             "given"),
        kept(
            number("scale", "Size of the part on the target over its size on the source.").above(0),
            "1"),
        kept(numbers("offset",
                     "{x, y}: moves the part in the plane of the target's map, in lengths of the "
                     "target; the way of placing of thesis 3.4.1."),
             "{0, 0}")};
}

Parameter clear_parameter() {
    return either("clear", {boolean("under", ""), object("region", "lissom.Region", "")},
                  "Removes the target's features under the part first, as mesh:erase does: "
                  "those under the part's boundary and nothing beyond it, or a region of the "
                  "target with a ring around it. paste:clearing() shows them before.")
        .optional("false");
}

namespace {

Parameter size_parameter(const char* name) {
    return choice(name, {"boundary", "lock"},
                  "Size of the part: that of its boundary on the target, which depends on the "
                  "loop, or the placement's scale.")
        .defaults("boundary");
}

}  // namespace

std::vector<Parameter> paste_merge_parameters(const char* size) {
    return {
        integer("smooth", "Umbrella steps at the seam, at most, as in lissom.merge.")
            .between(0, 1000)
            .defaults(3),
        boolean("collar", "Makes faces anew beside the seam if one side is coarser.")
            .defaults(true),
        boolean("intersections", "Looks for faces that run through one another and did not before.")
            .defaults(true),
        size_parameter(size),
        boolean("compare",
                "Tries variants that may distort the surface near the boundary less, and takes "
                "the best: ARAP iterations of the part; the outline of the region; and, once "
                "`optimize` was called and by nearest points, a boundary that slides over the "
                "target towards the relaxed position of the part.")
            .defaults(true),
        boolean("mend",
                "Fairs the places beside the seam at which a side became crumpled. If the verdict "
                "still finds fault with the surface there, tries a fair seam, a transition and, "
                "with `compare`, other boundaries, and keeps the result with fewest faults; a "
                "warning says so. Not without smoothing or collar.")
            .defaults(true)};
}

namespace {

std::vector<Parameter> merge_parameters() {
    std::vector<Parameter> all = paste_merge_parameters("scale");
    all.push_back(boolean("draft",
                          "For a part that is being dragged: the same place and boundary, but the "
                          "part is not refined, nor does its boundary slide, the seam is sewn and "
                          "no more unless faces turn over at it, whatever `smooth`, `collar` and "
                          "`intersections` say, and the "
                          "report has no provenance.")
                      .defaults(false));
    return all;
}

std::vector<Parameter> draft_parameters() {
    return {size_parameter("scale"),
            boolean("compare",
                    "Takes the outline of the region if the surface is distorted less near that "
                    "than near the boundary that was found.")
                .defaults(true)};
}

std::vector<Parameter> move_parameters() {
    std::vector<Parameter> all = placement_fields(true);
    all.push_back(boolean("search",
                          "false keeps the loop while a part is dragged, unless the "
                          "outline fits better.")
                      .defaults(true));
    return all;
}

std::vector<Parameter> paste_parameters() {
    return {
        object("source", "lissom.Mesh", "The mesh that has the feature; it stays as it is."),
        object("target", "lissom.Mesh", "The mesh that it is pasted onto; it stays as it is."),
        object(
            "region", "lissom.Region",
            "Part of the source around the feature, marked casually: the boundary is sought "
            "between its outline and the feature. If it has several outlines, such as those around "
            "the feet of a handle, the surface along the shortest way between them joins it."),
        either("feature",
               {object("region", "lissom.Region", ""),
                choice("auto", {"auto"}, "The core of the region.")},
               "Part of the source that keeps out of the search; of any genus, and of several "
               "parts. auto: the part farther from the region's outline than the share `ring` of "
               "the way to its middle, or of the outline's radius if that is less; with the open "
               "boundaries and the handles inside the region.")
            .optional("auto"),
        object("onto", "lissom.Region",
               "Part of the target that the feature may go to: without holes and handles, and "
               "larger than the region of the source will be.")
            .optional("a disk around the placement"),
        options("placement", placement_fields(false), "Place of the feature."),
        clear_parameter(),
        number("ring", "Share of the region that is searched if no feature is given.")
            .between(0.01, 0.99)
            .defaults(0.5),
        choice("correspondence", {"map", "closest"},
               "map: vertices lie at their images under the plane maps of both surfaces. "
               "closest: `optimize` then draws them, in rounds, to the nearest point of the "
               "target, if that distorts the surface near the boundary less.")
            .defaults("closest"),
        choice("loop", {"smooth", "mesh"},
               "smooth: the boundary runs through faces, near the best loop of edges, so that the "
               "seam has no teeth. mesh: it is that loop.")
            .defaults("smooth"),
        number("normals",
               "Weight of the normals in the energy of a boundary; .1 to .3 help features that "
               "overhang.")
            .at_least(0)
            .defaults(0.0),
        number("crease",
               "About the greatest angle at which part and target may meet, instead of the part's "
               "boundary turning until its surface goes on in the target's: the more it turns, the "
               "more the part is distorted beside it. 0: no crease, as with fidelity = \"thesis\".")
            .in("degrees")
            .between(0, 180)
            .defaults(30.0),
        choice("fidelity", {"default", "thesis"},
               "thesis: maps that keep angles alone, the energy of Eq 3.1 with its similarity, a "
               "boundary along edges, and its deformation, for comparison.")
            .defaults("default")};
}

std::vector<ErrorCode> paste_errors() {
    return {ErrorCode::topology_mismatch, ErrorCode::region_empty,
            ErrorCode::boundary_conflict, ErrorCode::not_a_disk,
            ErrorCode::invalid_argument,  ErrorCode::mesh_empty,
            ErrorCode::not_finite,        ErrorCode::not_positive_definite,
            ErrorCode::memory_limit,      ErrorCode::cancelled};
}

constexpr const char* kHorn = R"(local source = lissom.shapes.sphere{ segments = 24 }
for i = 1, source:vertex_count() do
    local x, y, z = source:position(i)
    if y > 0 then source:set_position(i, x, y + 0.8 * math.exp(-12 * (x * x + z * z)), z) end
end
local target = lissom.shapes.sphere{ segments = 20, radius = 2 }
local paste = lissom.paste{
    source = source, target = target,
    region = source:region{ sphere = { center = { 0, 1.3, 0 }, radius = 0.95 } },
    placement = { at = { 2, 0, 0 } },
}
)";

}  // namespace

Type paste_type() {
    const std::string horn = kHorn;
    return {
        .name = "lissom.Paste",
        .summary =
            "A feature of one mesh that is being put onto another: it can be moved, its "
            "boundary sought, and pasted, as often as one likes.",
        .methods =
            {{.name = "optimize",
              .body = optimize_paste,
              .summary =
                  "Seeks the loop around the feature whose shape on the target differs least from "
                  "its shape on the source, by turns with the similarity between both (thesis "
                  "3.4.3).",
              .options = {integer("iterations", "At most.").at_least(1).defaults(20)},
              .results = {{"lissom.Path", "loop",
                           "The boundary on the source: points of its surface, or vertices if "
                           "it runs along edges."},
                          {"lissom.PasteSearch", "report", "Result of the search."}},
              .effect = Effect::shapes,
              .errors = {ErrorCode::invalid_argument, ErrorCode::handle_removed,
                         ErrorCode::cancelled},
              .example = horn + R"(local loop, report = paste:optimize()
assert(loop:is_closed() and report.misfit[#report.misfit] <= report.misfit[1]))"},
             {.name = "merge",
              .body = merge_paste,
              .summary = "Opens the target along the loop's image and pastes the part inside the "
                         "loop, deformed to fit, as a new mesh. Without `optimize` the loop is the "
                         "outline of the region.",
              .options = merge_parameters(),
              .results = {{"lissom.Mesh", "mesh", "The target with the feature."},
                          {"lissom.MergeReport", "report",
                           "The report of lissom.merge; its field `paste` is a "
                           "lissom.PasteReport."}},
              .errors = {ErrorCode::invalid_argument, ErrorCode::boundary_conflict,
                         ErrorCode::nonmanifold_edge, ErrorCode::skin_mismatch,
                         ErrorCode::zero_area, ErrorCode::handle_removed, ErrorCode::memory_limit,
                         ErrorCode::cancelled},
              .example = horn + R"(paste:optimize()
local mesh, report = paste:merge()
assert(mesh:is_closed() and mesh:genus() == 0)
assert(report.paste.scale > 0.5))"},
             {.name = "draft",
              .body = draft_paste,
              .summary =
                  "The part as `merge` with `draft` has it, but alone and neither sewn nor "
                  "smoothed: "
                  "for a part that is shown many times a second while it is dragged. The cost "
                  "does not grow with the target.",
              .options = draft_parameters(),
              .results = {{"lissom.Mesh", "mesh",
                           "The part inside the boundary, deformed onto the edge of its hole."},
                          {"lissom.Path", "boundary", "Its boundary there."},
                          {"lissom.PasteDraft", "report", "Measures of the draft."}},
              .errors = {ErrorCode::boundary_conflict, ErrorCode::handle_removed,
                         ErrorCode::memory_limit, ErrorCode::cancelled},
              .example = horn + R"(paste:optimize()
assert(paste:move{ at = { 0, 0, 2 }, angle = 30 })
local part, boundary, report = paste:draft()
assert(#part:boundaries() == 1 and boundary:is_closed() and report.scale > 0.5))"},
             {.name = "move",
              .body = move_paste,
              .summary =
                  "Places the feature anew, and seeks its boundary again from the former one if "
                  "`optimize` was called. Options that are left out stay. If the feature does "
                  "not fit there, the last good placement stays.",
              .options = move_parameters(),
              .results = {{"lissom.Paste", "paste", "The same paste."}},
              .effect = Effect::shapes,
              .errors = {ErrorCode::boundary_conflict, ErrorCode::invalid_argument,
                         ErrorCode::not_a_disk, ErrorCode::not_finite, ErrorCode::handle_removed,
                         ErrorCode::memory_limit, ErrorCode::cancelled},
              .example = horn + R"(paste:optimize()
assert(paste:move{ at = { 0, 0, 2 }, angle = 30 })
assert(paste:merge():is_closed()))"},
             {.name = "search",
              .body = search_of_paste,
              .summary = "The result of the last search for the boundary.",
              .results = {{"lissom.PasteSearch", "report",
                           "Before `optimize`, of the loop that is "
                           "used without."}},
              .errors = {ErrorCode::handle_removed},
              .example = horn + "assert(paste:search().misfit[1] >= 0)"},
             {.name = "loop",
              .body = loop_of_paste,
              .summary = "The loop that `merge` pastes along, and its image on the target.",
              .results = {{"lissom.Path", "loop", "On the source, as by `optimize`."},
                          {"lissom.Path", "image", "Points of the target's surface."}},
              .errors = {ErrorCode::handle_removed},
              .example = horn + R"(local loop, image = paste:loop()
assert(#loop:points() == #image:points()))"},
             {.name = "clearing",
              .body = clearing_of_paste,
              .summary = "The part of the target that `clear` removes under the part, on the "
                         "target as it was given: to draw it, or to ask before `merge`.",
              .results = {{"lissom.Region", "region",
                           "The vertices of the faces that go; nil if nothing goes."},
                          {"lissom.PasteClearing", "report", "Its extent."}},
              .errors = {ErrorCode::handle_removed},
              .example = horn + R"(local nosed = lissom.paste{
    source = source, target = source, clear = true,
    region = source:region{ sphere = { center = { 0, 1.3, 0 }, radius = 0.95 } },
    placement = { at = { 0, 1.8, 0 } },
}
local region, report = nosed:clearing()
assert(#region > 0 and report.height > 0.5))"}},
        .close = close_paste};
}

std::vector<Function> paste_functions() {
    const std::string horn = kHorn;
    return {{.name = "paste",
             .body = new_paste,
             .summary =
                 "Puts a feature of one mesh onto another, wherever that is and however it is "
                 "curved (thesis section 3.4): a nose, an ear, a horn, a handle. Lays the surface "
                 "around the feature and the target out in one plane; `optimize` then finds the "
                 "best boundary and `merge` makes the new mesh.",
             .options = paste_parameters(),
             .results = {{"lissom.Paste", "paste", "The paste, placed and not optimised yet."}},
             .errors = paste_errors(),
             .example = horn + R"(local loop, search = paste:optimize()
local mesh, report = paste:merge()
assert(mesh:is_closed() and mesh:components() == 1)
print(#loop:vertices(), search.misfit[#search.misfit], report.verdict))"}};
}

}  // namespace lissom::lua
