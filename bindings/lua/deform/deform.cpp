// lissom.deformer: Deformer.
#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/core/push_list.h"
#include "bindings/lua/deform/deform_object.h"
#include "bindings/lua/deform/deform_options.h"
#include "bindings/lua/deform/deform_points.h"
#include "bindings/lua/deform/deform_texts.h"
#include "bindings/lua/deform/pose_object.h"
#include "bindings/lua/deform/sliding_pins.h"
#include "bindings/lua/mesh/buffer.h"
#include "bindings/lua/mesh/path_object.h"
#include "bindings/lua/mesh/transform_options.h"
#include "kernel/deform/contact/contact_avoid.h"
#include "kernel/deform/contact/contact_stop.h"
#include "kernel/deform/deform_report.h"
#include "kernel/deform/deformed_surface.h"
#include "kernel/deform/description.h"
#include "kernel/deform/handle_basis.h"
#include "kernel/deform/handle_changes.h"
#include "kernel/deform/stats.h"

namespace lissom::lua {

std::size_t DeformObject::memory_bytes() const {
    if (!content) return 0;
    std::size_t bytes = stats_of(*content).factor_bytes;
    for (const AttachedMesh& part : attached) bytes += part.attachment.memory_bytes();
    return bytes + content->positions().size() * 4 * sizeof(Mat3);
}

std::size_t DeformObject::held_bytes() const {
    const std::size_t constraints = content ? constraint_bytes(*content) : 0;
    return constraints + attached.size() * sizeof(AttachedMesh);
}

void DeformObject::show_result(const Context& context) {
    if (attached.empty()) {
        content->apply_to(mesh->mesh);
        mesh->changed();
        return;
    }
    Mesh surface = mesh->mesh;
    content->apply_to(surface);
    std::vector<Mesh> moved;
    for (const AttachedMesh& part : attached) {
        moved.push_back(part.mesh->mesh);
        part.attachment.follow(surface, moved.back(), context);
    }
    mesh->mesh = std::move(surface);
    mesh->changed();
    for (std::size_t i = 0; i < moved.size(); ++i) {
        attached[i].mesh->mesh = std::move(moved[i]);
        attached[i].mesh->changed();
    }
}

Deformer& DeformObject::deformer() {
    if (!content) {
        throw Error(ErrorCode::handle_removed, "the deformer was closed; make a new one");
    }
    require_current(*mesh, topology, "the deformer");
    return *content;
}

namespace {

int new_deformer(Call& call) {
    const auto mesh = call.object<MeshObject>("mesh");
    const auto result = call.create<DeformObject>();
    const bool done = call.attempt([&] {
        result.set(std::make_shared<DeformObject>(mesh.share(), made_deformer(call, *mesh)));
    });
    if (!done) return call.fail();
    call.charge(result);
    return 1;
}

// ---- Deformer

std::vector<MeshPoint> mesh_points(const DeformObject& edit, std::span<const PointSpec> specs) {
    std::vector<MeshPoint> points;
    for (const PointSpec& spec : specs) points.push_back(spec.point(*edit.topology));
    return points;
}

MirrorPlane mirror_plane(const Call& call) {
    return {call.vector("mirror.point"), call.vector("mirror.normal"),
            call.has("mirror.tolerance") ? call.number("mirror.tolerance") : 0.0};
}

int add_handle(Call& call) {
    const auto edit = call.self<DeformObject>();
    const bool has_weight = call.has("weight"), has_points = call.kind("where") == Kind::table;
    const bool on_path = find_holder(call.lua(), 2, PathObject::kTypeName) != nullptr;
    const auto region = call.object<RegionObject>("where");
    const auto path = call.object<PathObject>("where");
    const HandleOptions options{
        call.boolean("position"), call.boolean("gradient"),
        has_weight ? std::optional<double>(call.number("weight")) : std::nullopt,
        call.number("falloff")};
    const bool mirrors = call.has("mirror");
    const MirrorPlane plane = mirrors ? mirror_plane(call) : MirrorPlane{};
    const std::span<const PointSpec> points =
        has_points ? read_points(call, "where") : std::span<const PointSpec>{};
    const auto result = call.create<HandleObject>();
    const bool done = call.attempt([&] {
        Deformer& deformer = edit->deformer();
        const std::size_t size = has_points ? points.size()
                                 : on_path  ? at(path->current().size())
                                            : at(region->current().size());
        call.reserve(edit, (mirrors ? 2 : 1) * handle_bytes(size));
        const auto add = [&]() -> HandleId {
            if (has_points) return deformer.add_handle(mesh_points(*edit, points), options);
            if (!on_path) return deformer.add_handle(region->current(), options);
            return deformer.add_handle(
                path_points(edit->mesh->mesh, path->current(), call.context()), options);
        };
        const HandleId id = add();
        // A handle whose mirror image is refused is not made.
        if (mirrors) {
            try {
                mirror_handle(deformer, id, plane);
            } catch (...) {
                deformer.remove_handle(id);
                throw;
            }
        }
        result.set(std::make_shared<HandleObject>(HandleObject{edit.share(), id}));
    });
    if (!done) return call.fail();
    call.charge(edit);
    return 1;
}

int pin(Call& call) {
    const auto edit = call.self<DeformObject>();
    const auto region = call.object<RegionObject>("region");
    const bool done = call.attempt([&] {
        call.reserve(edit, handle_bytes(at(region->current().size())));
        edit->deformer().add_handle(region->current());
    });
    if (!done) return call.fail();
    call.charge(edit);
    return call.push_argument();
}

int constrain(Call& call) {
    const auto edit = call.self<DeformObject>();
    const PointSpec point = read_point_options(call);
    const bool has_position = call.has("position"), has_gradient = call.has("gradient");
    const bool has_weight = call.has("weight");
    const double weight = has_weight ? call.number("weight") : 1.0;
    const Vec3 position = has_position ? call.vector("position") : Vec3(Vec3::Zero());
    const Mat3 gradient = has_gradient ? call.matrix3("gradient") : Mat3(Mat3::Identity());
    const bool done = call.attempt([&] {
        PointConstraint constraint{point.point(*edit->topology)};
        if (has_weight) constraint.weight = weight;
        if (has_position) constraint.position = position;
        if (has_gradient) constraint.gradient = gradient;
        call.reserve(edit, handle_bytes(1));
        edit->deformer().constrain(constraint);
    });
    if (!done) return call.fail();
    call.charge(edit);
    return call.push_argument();
}

int set_stiffness(Call& call) {
    const auto edit = call.self<DeformObject>();
    const auto region = call.object<RegionObject>("region");
    const double factor = call.number("factor");
    const bool done = call.attempt([&] {
        call.reserve(edit, edit->deformer().positions().size() * 2 * sizeof(double));
        set_stiffness(edit->deformer(), region->current(), factor);
    });
    if (!done) return call.fail();
    call.charge(edit);
    return call.push_argument();
}

int keep_volume(Call& call) {
    const auto edit = call.self<DeformObject>();
    const double share = call.number("share");
    const bool done = call.attempt([&] { keep_volume(edit->deformer(), share); });
    return done ? call.push_argument() : call.fail();
}

// Runs solve(Deformer&), writes the result into the mesh and returns it.
template <typename Solve>
int write_result(Call& call, const Solve& solve) {
    const auto edit = call.self<DeformObject>();
    const bool done = call.attempt([&] {
        Deformer& deformer = edit->deformer();
        require_surroundings(deformer, edit->mesh->mesh);
        for (const AttachedMesh& part : edit->attached) {
            require_current(*part.mesh, part.topology, "the attached mesh");
        }
        solve(deformer);
        edit->show_result(call.context());
    });
    if (!done) return call.fail();
    call.charge(edit);
    return call.push_shared(edit->mesh);
}

int preview(Call& call) {
    return write_result(
        call, [&](Deformer& deformer) { deformer.solve(FrameQuality::preview, call.context()); });
}

// The mesh on the stack, and a record after it, which `contacts` is a field of.
int push_mesh_and_record(Call& call, const DeformObject& edit,
                         const std::vector<FacePair>& contacts) {
    lua_State* L = call.lua();
    const int mesh_place = lua_gettop(L);
    push_contacts(call, edit, contacts);
    const int contacts_place = lua_gettop(L);
    lua_pushvalue(L, mesh_place);
    lua_createtable(L, 0, 3);
    lua_pushvalue(L, contacts_place);
    lua_setfield(L, -2, "contacts");
    return 2;
}

// The mesh, and how far the handles came.
int solve_with_stop(Call& call) {
    const auto edit = call.self<DeformObject>();
    auto& stop = call.hold<ContactStop>();
    const int results = write_result(call, [&](Deformer& deformer) {
        stop = solve_until_contact(deformer, edit->mesh->mesh, call.context());
    });
    if (results != 1) return results;
    push_mesh_and_record(call, *edit, stop.contacts);
    call.set_field("share", call.push(stop.share));
    return 2;
}

// The mesh, and the contacts before and after.
int solve_avoiding(Call& call) {
    const auto edit = call.self<DeformObject>();
    auto& avoided = call.hold<AvoidedContacts>();
    const int results = write_result(call, [&](Deformer& deformer) {
        avoided = solve_avoiding_contacts(deformer, edit->mesh->mesh, call.context());
    });
    if (results != 1) return results;
    push_mesh_and_record(call, *edit, avoided.contacts);
    call.set_field("before", call.push(avoided.before));
    call.set_field("rounds", call.push(avoided.rounds));
    return 2;
}

// The mesh, and the distance from the places of the pins that is left.
int solve_pinned(Call& call) {
    const std::span<const SlidingPinSpec> specs = read_sliding_pins(call);
    auto& pins = call.hold<std::vector<SlidingPin>>();
    double off = 0.0;
    const int results = write_result(call, [&](Deformer& deformer) {
        pins = sliding_pins(specs);
        off = solve_with_pins(deformer, pins, call.context());
    });
    if (results != 1) return results;
    return 1 + call.push(off);
}

int solve(Call& call) {
    const bool draft = call.boolean("draft"), avoid = call.boolean("avoid");
    if (draft && (avoid || call.has("stop"))) {
        call.reject("draft", "contacts are those of a result in full");
    }
    if (avoid && call.has("stop")) {
        call.reject("avoid", "a drag stops at contacts, or pushes them apart");
    }
    if (call.has("pins")) {
        if (draft || avoid || call.has("stop")) {
            call.reject("pins", "they hold in a result in full, without contacts");
        }
        return solve_pinned(call);
    }
    if (call.has("stop")) return solve_with_stop(call);
    if (avoid) return solve_avoiding(call);
    return write_result(call, [&](Deformer& deformer) {
        draft ? deformer.solve(FrameQuality::draft, call.context())
              : deformer.solve(FrameQuality::full, call.context());
    });
}

int reset_all(Call& call) {
    const int results = write_result(call, [](Deformer& deformer) { deformer.reset(); });
    return results == 1 ? call.push_argument() : results;
}

int rebase(Call& call) {
    const int results = write_result(call, [](Deformer& deformer) { deformer.rebase(); });
    return results == 1 ? call.push_argument() : results;
}

int subdivided_mesh(Call& call) {
    const auto edit = call.self<DeformObject>();
    return new_mesh(call, [&] {
        return lissom::subdivided_mesh(edit->deformer(), edit->mesh->mesh, call.context());
    });
}

int stats(Call& call) {
    const auto edit = call.self<DeformObject>();
    DeformStats s;
    if (!call.attempt_quick([&] { s = stats_of(edit->deformer()); })) return call.fail();
    const struct {
        const char* name;
        std::size_t value;
    } counts[] = {{"region_vertices", at(s.region_vertices)},
                  {"free_vertices", at(s.free_vertices)},
                  {"constrained_vertices", at(s.constrained_vertices)},
                  {"handles", at(s.handles)},
                  {"displaced_vertices", at(s.displaced_vertices)},
                  {"extended_vertices", at(s.extended_vertices)},
                  {"inserted_vertices", at(s.inserted_vertices)},
                  {"subdivided_vertices", at(s.refined_vertices)},
                  {"level_vertices", at(s.level_vertices)},
                  {"zero_area_faces", at(s.zero_area_faces)},
                  {"first_nonzeros", s.first_nonzeros},
                  {"second_nonzeros", s.second_nonzeros},
                  {"factor_bytes", s.factor_bytes},
                  {"factorizations", at(s.factorizations)}};
    const struct {
        const char* name;
        double value;
    } times[] = {{"assemble_seconds", s.assemble_seconds},
                 {"first_factor_seconds", s.first_factor_seconds},
                 {"second_factor_seconds", s.second_factor_seconds},
                 {"basis_seconds", s.basis_seconds}};
    lua_createtable(call.lua(), 0, 16);
    for (const auto& count : counts) call.set_field(count.name, call.push_count(count.value));
    for (const auto& time : times) call.set_field(time.name, call.push(time.value));
    return 1;
}

void push_tears(Call& call, const std::vector<Tear>& tears) {
    push_list(call, tears, [&](const auto& tear) {
        lua_createtable(call.lua(), 0, 2);
        call.set_field("vertices", call.push_ids(tear.vertices));
        call.set_field("slip", call.push(tear.slip));
    });
}

const char* list_of(ElementKind kind) {
    return kind == ElementKind::edge ? "edges" : kind == ElementKind::face ? "faces" : "vertices";
}

void push_warnings(Call& call, const std::vector<DeformWarning>& warnings) {
    push_list(call, warnings, [&](const DeformWarning& warning) {
        lua_createtable(call.lua(), 0, 3);
        call.set_field("kind", call.push(std::string_view(harm_name(warning.harm))));
        call.set_field("message", call.push(std::string_view(warning.message)));
        if (warning.elements.kind != ElementKind::none) {
            call.set_field(list_of(warning.elements.kind), call.push_ids(warning.elements.ids));
        }
    });
}

int report_tostring(lua_State* L) {
    lua_pushvalue(L, lua_upvalueindex(1));
    return 1;
}

int report(Call& call) {
    const auto edit = call.self<DeformObject>();
    const DeformReportOptions options{call.boolean("crossings")};
    auto& found = call.hold<DeformReport>();
    auto& text = call.hold<std::string>();
    const bool done = call.attempt([&] {
        found = report_of(edit->deformer(), edit->mesh->mesh, options, call.context());
        text = report_text(found);
    });
    if (!done) return call.fail();
    lua_createtable(call.lua(), 0, 7);
    call.set_field("stretch", call.push(found.stretch));
    if (found.stretched[0] != kNoIndex) {
        call.set_field("stretched", call.push_ids(found.stretched));
    }
    call.set_field("flipped", call.push_ids(found.flipped));
    if (found.crossings) call.set_field("crossings", call.push(count_of(*found.crossings)));
    if (found.volume_change) call.set_field("volume_change", call.push(*found.volume_change));
    push_tears(call, found.tears);
    call.set_field("tears");
    push_warnings(call, found.warnings);
    call.set_field("warnings");
    lua_createtable(call.lua(), 0, 1);
    call.push(std::string_view(text));
    lua_pushcclosure(call.lua(), report_tostring, 1);
    lua_setfield(call.lua(), -2, "__tostring");
    lua_setmetatable(call.lua(), -2);
    return 1;
}

// Pushes rows of N numbers as a buffer of its own.
template <typename Row>
bool push_rows(Call& call, const std::vector<Row>& rows) {
    const auto result = call.create<BufferObject>();
    const bool done = call.attempt_quick([&] {
        auto buffer = std::make_shared<BufferObject>();
        buffer->width = Row::RowsAtCompileTime;
        for (const Row& row : rows) {
            buffer->values.insert(buffer->values.end(), row.data(), row.data() + row.size());
        }
        result.set(std::move(buffer));
    });
    if (done) call.charge(result);
    return done;
}

bool push_handle(Call& call, const Ref<DeformObject>& edit, HandleId id) {
    const auto result = call.create<HandleObject>();
    return call.attempt_quick([&] {
        result.set(std::make_shared<HandleObject>(HandleObject{edit.share(), id}));
    });
}

int handles(Call& call) {
    const auto edit = call.self<DeformObject>();
    auto& ids = call.hold<std::vector<HandleId>>();
    if (!call.attempt_quick([&] { ids = edit->deformer().handles(); })) return call.fail();
    lua_createtable(call.lua(), count_of(ids), 0);
    for (std::size_t i = 0; i < ids.size(); ++i) {
        if (!push_handle(call, edit, ids[i])) return call.fail();
        lua_rawseti(call.lua(), -2, index_of(i) + 1);
    }
    return 1;
}

int basis(Call& call) {
    const auto edit = call.self<DeformObject>();
    lua_State* L = call.lua();
    auto& found = call.hold<HandleBasis>();
    if (!call.attempt([&] { found = basis_of(edit->deformer(), call.context()); }))
        return call.fail();
    call.charge(edit);
    lua_createtable(L, 0, 4);
    call.set_field("vertices", call.push_ids(found.vertices));
    lua_createtable(L, count_of(found.handles), 0);
    lua_createtable(L, count_of(found.handles), 0);
    for (std::size_t h = 0; h < found.handles.size(); ++h) {
        if (!push_handle(call, edit, found.handles[h])) return call.fail();
        lua_rawseti(L, -3, index_of(h) + 1);
        if (!push_rows(call, found.weights[h])) return call.fail();
        lua_rawseti(L, -2, index_of(h) + 1);
    }
    lua_setfield(L, -3, "weights");
    lua_setfield(L, -2, "handles");
    if (!push_rows(call, found.fixed)) return call.fail();
    lua_setfield(L, -2, "fixed");
    return 1;
}

int deformer_mesh(Call& call) {
    return push_owner(call, call.self<DeformObject>()->mesh);
}

int deformer_region(Call& call) {
    const auto edit = call.self<DeformObject>();
    const auto result = call.create<RegionObject>();
    const bool done = call.attempt_quick(
        [&] { result.set(std::make_shared<RegionObject>(edit->mesh, edit->deformer().region())); });
    return done ? 1 : call.fail();
}

int deformer_text(Call& call) {
    const auto edit = call.self<DeformObject>();
    int vertices = 0, count = 0;
    const bool current = call.attempt_quick([&] {
        vertices = edit->deformer().region().size();
        count = count_of(edit->deformer().handles());
    });
    if (!current) return call.push("lissom.Deformer (of an older topology)");
    lua_pushfstring(call.lua(), "lissom.Deformer: %d vertices, %d handles", vertices, count);
    return 1;
}

// ---- Descriptions

const std::vector<ErrorCode> kSolveErrors = {
    ErrorCode::unconstrained, ErrorCode::zero_area,         ErrorCode::not_positive_definite,
    ErrorCode::memory_limit,  ErrorCode::topology_mismatch, ErrorCode::cancelled};
const std::vector<ErrorCode> kBasisErrors = {
    ErrorCode::unconstrained, ErrorCode::zero_area,         ErrorCode::not_positive_definite,
    ErrorCode::memory_limit,  ErrorCode::topology_mismatch, ErrorCode::unsupported,
    ErrorCode::cancelled};
Parameter weight_option() {
    return number("weight",
                  "Draws instead of holding exactly: 1 is a compromise with the shape of the "
                  "surface, 1e6 nearly exact. Depends on neither scale nor resolution.")
        .above(0)
        .optional("held exactly");
}

std::vector<Parameter> constraint_fields() {
    std::vector<Parameter> fields = point_fields();
    fields.push_back(vector("position", "Its position.").optional("free"));
    fields.push_back(
        matrix3("gradient", "Rows of its 3 x 3 deformation gradient.").optional("free"));
    fields.push_back(weight_option());
    return fields;
}

std::vector<Function> solving_methods() {
    const std::vector<Result> mesh = {{"lissom.Mesh", "mesh", "The mesh."}};
    return {
        {.name = "preview",
         .body = preview,
         .summary =
             "Solves the first system only and writes the result into the mesh: quick enough "
             "to follow a drag, with some shear.",
         .results = mesh,
         .effect = Effect::replaces,
         .errors = kSolveErrors,
         .example = kBar + "top:translate(1, 0, 0)\ndeformer:preview()"},
        {.name = "solve",
         .body = solve,
         .summary =
             "Solves both systems and writes the result into the mesh. Handles in their initial "
             "place give the rest shape, to the bit. Other changes of the region's vertices are "
             "overwritten; if the mesh around the region was moved, so that the result would "
             "tear, it is an error.",
         .options = {boolean("draft",
                             "For the frames of a drag: about five digits in half the time. Solve "
                             "once more when the drag ends.")
                         .defaults(false),
                     choice("stop", {"contact"},
                            "\"contact\": goes from the poses of the last solve towards the "
                            "present ones, and stays, with the handles, at the last pose before "
                            "faces intersect that did not at rest. A drag that begins in contact "
                            "goes on while no more do. Each sample of the way takes a frame.")
                         .optional("goes all the way"),
                     boolean(
                         "avoid",
                         "Pushes apart parts that would run through one another, in up to three "
                         "rounds: both alike unless one is held. Handles hold exactly. It takes "
                         "some frames if anything meets; see `contacts` for what is left.")
                         .defaults(false),
                     sliding_pins_option()},
         .results = {{"lissom.Mesh", "mesh", "The mesh."},
                     {"lissom.ContactStop|lissom.AvoidedContacts|number|nil", "record",
                      "With `stop` how far the handles came, with `avoid` the contacts before and "
                      "after, with `pins` the greatest distance of one from its place."}},
         .effect = Effect::replaces,
         .errors = kSolveErrors,
         .example = kBar + R"(top:rotate{ axis = "z", angle = 60 }
assert(deformer:solve() == bar)
top:rotate{ axis = "z", angle = 110 }:translate(0.4, -5, 0)
local mesh, stop = deformer:solve{ stop = "contact" }
assert(stop.share < 1 and #deformer:contacts() == 0))"},
        {.name = "reset",
         .body = reset_all,
         .summary =
             "Handles and mesh go back to the rest shape, to the bit; vertex constraints go.",
         .results = {{"lissom.Deformer", "deformer", "The deformer itself."}},
         .errors = kDeformerErrors,
         .example = kBar + R"(local before = bar:hash()
top:translate(1, 0, 0)
deformer:solve()
deformer:reset()
assert(bar:hash() == before))"},
        {.name = "subdivided_mesh",
         .body = subdivided_mesh,
         .summary =
             "The deformed mesh with the vertices that the deformation inserted along coarse "
             "borders of handles: behind the mesh's own, on faces that become triangles. "
             "Without such vertices it is a copy.",
         .results = {{"lissom.Mesh", "fine", "A new mesh."}},
         .errors = kDeformerErrors,
         .example = kBar + R"(top:translate(1, 0, 0)
deformer:solve()
local fine = deformer:subdivided_mesh()
assert(fine:vertex_count() == bar:vertex_count() + deformer:stats().subdivided_vertices))"},
        {.name = "rebase",
         .body = rebase,
         .summary =
             "Takes the last result as the new rest shape. Handles keep their vertices and "
             "their present places, with the identity as transform; constraints keep the "
             "present places of their points. Factors are rebuilt at the next solve, and reset "
             "returns to this shape.",
         .results = {{"lissom.Deformer", "deformer", "The deformer itself."}},
         .errors = kDeformerErrors,
         .example = kBar + R"(top:translate(1, 0, 0)
deformer:solve()
deformer:rebase()
assert(top:matrix()[1][4] == 0)
top:translate(1, 0, 0)
deformer:solve())"},
        {.name = "stats",
         .body = stats,
         .summary = "Sizes and times of the last preparation.",
         .results = {{"lissom.DeformStats", "stats", "Times are in seconds, sizes in bytes."}},
         .errors = kDeformerErrors,
         .example = kBar + "deformer:solve()\nassert(deformer:stats().handles == 2)"},
        {.name = "report",
         .body = report,
         .summary =
             "Measures the last result beside the rest shape: stretched edges, folded faces, tears "
             "between handles that nearly touch and, on request, crossings, with a warning of each "
             "harm that a user would see.",
         .options = {boolean("crossings",
                             "Counts faces that run through one another, which takes longer than "
                             "to solve.")
                         .defaults(false)},
         .results = {{"lissom.DeformReport", "report", "Measures, and warnings with remedies."}},
         .errors = kDeformerErrors,
         .example = kBar + R"(top:rotate{ axis = "z", angle = 60 }
deformer:solve()
local report = deformer:report{ crossings = true }
assert(report.stretch < 2 and #report.flipped == 0 and report.crossings == 0)
assert(#report.warnings == 0))"},
        {.name = "basis",
         .body = basis,
         .summary = "The first system's solution as a linear function of the handles: data for an "
                    "engine that follows a drag by itself.",
         .results = {{"lissom.HandleBasis", "basis", "Weights of every vertex for every handle."}},
         .errors = kBasisErrors,
         .example = kBar + "assert(deformer:basis().weights[1]:width() == 4)"}};
}

}  // namespace

Type deformer_type() {
    Type type{
        .name = "lissom.Deformer",
        .summary =
            "Deforms a region of a mesh by handles. Its rest shape is the mesh as it was when "
            "the deformation was made; its factors are kept, so that moving a handle costs "
            "no factorisation.",
        .close = [](void* object) { static_cast<DeformObject*>(object)->content.reset(); }};
    type.operators = {{"__tostring", deformer_text, "tostring(deformer)", "its size"}};
    type.methods = {
        {.name = "add_handle",
         .body = add_handle,
         .summary =
             "Makes a handle of some vertices of the region, of a path, or of points of faces and "
             "edges. Points follow the handle exactly: the points of the deformed faces with "
             "the same weights do.",
         .arguments = {either("where",
                              {object("region", "lissom.Region", "Its vertices."),
                               object("path", "lissom.Path", "Its vertices."),
                               table("points",
                                     "A list of {vertex=}, {edge={a, b}, at=}, {face=, bary=}, or "
                                     "of results of Mesh:nearest and Mesh:pick.")},
                              "The part that it holds.")},
         .options =
             {boolean("position", "Holds their positions.").defaults(HandleOptions{}.position),
              boolean("gradient", "Holds their orientation and scale.")
                  .defaults(HandleOptions{}.gradient),
              weight_option(),
              number("falloff",
                     "Within this geodesic distance the surface follows softly, less and less.")
                  .at_least(0)
                  .in("mesh units")
                  .defaults(0.0),
              options(
                  "mirror",
                  {vector("point", "A point of the plane."),
                   vector("normal", "Its normal, of any length."),
                   number("tolerance",
                          "Distance of the mirror image from the surface beyond which "
                          "mirror_residual warns.")
                       .above(0)
                       .in("mesh units")
                       .optional("a fiftieth of the size")},
                  "Adds a second handle, the mirror image, and moves it along: see mirrored. It "
                  "lies on the surface nearest to the reflected one, so that both sides may "
                  "have different vertices: see mirror_residual.")
                  .optional("none")},
         .results = {{"lissom.Handle", "handle", "The handle; move it and solve."}},
         .effect = Effect::changes,
         .errors = {ErrorCode::region_empty, ErrorCode::topology_mismatch,
                    ErrorCode::handle_outside_region, ErrorCode::handle_overlap,
                    ErrorCode::invalid_argument, ErrorCode::out_of_range, ErrorCode::mesh_empty},
         .example =
             kBar + R"(local side = deformer:add_handle({ bar:nearest(0.5, 0, 0) }, { weight = 2 })
side:translate(0.5, 0, 0)
deformer:solve())"},
        {.name = "pin",
         .body = pin,
         .summary = "Holds a region in place: a handle with the identity as transform. Returns the "
                    "deformer.",
         .arguments = {object("region", "lissom.Region", "The vertices that stay.")},
         .results = {{"lissom.Deformer", "deformer", "The deformer itself."}},
         .errors = {ErrorCode::region_empty, ErrorCode::topology_mismatch,
                    ErrorCode::handle_outside_region, ErrorCode::handle_overlap},
         .example = R"(local bar = lissom.shapes.bar{ across = 2, along = 10 }
local deformer = lissom.deformer(bar):pin(bar:region("bottom"))
deformer:add_handle(bar:region("top")):rotate("z", 60)
deformer:solve())"},
        {.name = "constrain",
         .body = constrain,
         .summary =
             "Holds one vertex, or a point of an edge or face, in place of an earlier constraint; "
             "without position and gradient it is free again. Returns the deformation.",
         .options = constraint_fields(),
         .results = {{"lissom.Deformer", "deformer", "The deformer itself."}},
         .errors = {ErrorCode::out_of_range, ErrorCode::handle_outside_region,
                    ErrorCode::handle_overlap, ErrorCode::invalid_argument,
                    ErrorCode::topology_mismatch},
         .example = kBar + R"(local v = bar:nearest(0.5, 0, 0).vertex
deformer:constrain{ vertex = v, position = { 1, 0, 0 } }
deformer:constrain{ face = 1, bary = { 0.4, 0.3, 0.2, 0.1 }, position = { 1, -2, 0 }, weight = 10 }
deformer:solve())"},
        {.name = "stiffness",
         .body = set_stiffness,
         .summary =
             "Sets how much a part of the surface resists being bent and stretched: stiff parts "
             "move rigidly, soft ones take the bend.",
         .arguments = {object("region", "lissom.Region", "The part."),
                       number("factor", "1 is as usual.").between(1e-4, 1e5)},
         .results = {{"lissom.Deformer", "deformer", "The deformer itself."}},
         .errors = {ErrorCode::handle_outside_region, ErrorCode::topology_mismatch},
         .example =
             kBar +
             R"(deformer:stiffness(bar:region{ sphere = { center = { 0, 0, 0 }, radius = 0.8 } }, 100)
top:rotate{ axis = "z", angle = 60 }
deformer:solve())"},
        {.name = "keep_volume",
         .body = keep_volume,
         .summary =
             "Sets the share of its volume that a twisted or bent solid keeps, in place of the "
             "option volume. It costs a frame, and no preparation.",
         .arguments = {number("share", "0: none; 1: all.").between(0, 1)},
         .results = {{"lissom.Deformer", "deformer", "The deformer itself."}},
         .errors = {ErrorCode::invalid_argument, ErrorCode::unsupported},
         .example = kBar + R"(top:rotate{ axis = "z", angle = 150 }
deformer:keep_volume(1)
deformer:solve())"},
        {.name = "handles",
         .body = handles,
         .summary = "Its handles.",
         .results = {{"lissom.Handle[]", "handles", "In the order they were made."}},
         .errors = kDeformerErrors,
         .example = kBar + "assert(deformer:handles()[2] == top)"},
        {.name = "region",
         .body = deformer_region,
         .summary = "The region that may move.",
         .results = {{"lissom.Region", "region", "The region."}},
         .errors = kDeformerErrors,
         .example = kBar + "assert(#deformer:region() == #bar)"},
        {.name = "mesh",
         .body = deformer_mesh,
         .summary = "The mesh that it deforms.",
         .results = {{"lissom.Mesh", "mesh", "The mesh."}},
         .example = kBar + "assert(deformer:mesh() == bar)"}};
    for (Function& method : solving_methods()) type.methods.push_back(std::move(method));
    for (Function& method : deform_engine_methods()) type.methods.push_back(std::move(method));
    for (Function& method : contact_methods()) type.methods.push_back(std::move(method));
    for (Function& method : pose_methods()) type.methods.push_back(std::move(method));
    type.methods.push_back(add_bones_method());
    type.methods.push_back(list_bones_method());
    for (Function& method : attachment_methods()) type.methods.push_back(std::move(method));
    return type;
}

std::vector<Function> deform_functions() {
    std::vector<Function> functions = {deform_function()};
    functions.push_back(
        {.name = "deformer",
         .body = new_deformer,
         .summary = "Makes a deformer of a mesh, or of a region of it: give it handles, move "
                    "them, solve. `lissom.deform` deforms once.",
         .arguments = {object("mesh", "lissom.Mesh", "The mesh, in its rest shape.")},
         .options = deform_parameters(),
         .results = {{"lissom.Deformer", "deformer", "Give it handles, move them, solve."}},
         .errors = {ErrorCode::region_empty, ErrorCode::topology_mismatch,
                    ErrorCode::invalid_argument, ErrorCode::cancelled},
         .example = kBar + R"(top:rotate{ axis = "z", angle = 60 }:translate(1, -0.5, 0)
deformer:solve())"});
    return functions;
}

}  // namespace lissom::lua
