// Results of a merge: the mesh, and a report with the provenance of its elements.
#include <algorithm>

#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/core/push_list.h"
#include "bindings/lua/merge/merge_object.h"

namespace lissom::lua {

std::size_t ProvenanceObject::memory_bytes() const {
    const std::size_t count = vertices.size() + faces.size();
    return count * (sizeof(std::size_t) + sizeof(ElementMap::Source));
}

namespace {

constexpr double kDegrees = 180.0 / kPi;

void push_quality(const Call& call, const SeamQuality& quality) {
    lua_createtable(call.lua(), 0, 5);
    call.set_field("max_dihedral", call.push(kDegrees * quality.max_dihedral));
    call.set_field("rms_dihedral", call.push(kDegrees * quality.rms_dihedral));
    call.set_field("max_near", call.push(kDegrees * quality.max_near));
    call.set_field("smallest_angle", call.push(kDegrees * quality.smallest_angle));
    call.set_field("low_angle", call.push(kDegrees * quality.low_angle));
}

void push_seam(const Call& call, const SewReport& seam) {
    lua_createtable(call.lua(), 0, 12);
    call.set_field("inserted_into_target", call.push(seam.inserted_into_target));
    call.set_field("inserted_into_source", call.push(seam.inserted_into_source));
    call.set_field("snapped", call.push(seam.snapped));
    call.set_field("collapsed", call.push(seam.collapsed));
    call.set_field("flipped", call.push(seam.flipped));
    call.set_field("band_removed", call.push(seam.band_removed));
    call.set_field("band_added", call.push(seam.band_added));
    call.set_field("smoothed", call.push(seam.smoothed));
    call.set_field("collar_removed", call.push(seam.collar_removed));
    call.set_field("collar_added", call.push(seam.collar_added));
    push_quality(call, seam.before);
    call.set_field("before");
    push_quality(call, seam.after);
    call.set_field("after");
}

constexpr const char* kPlacings[] = {"keys", "as placed", "directions", "shape"};

// A key whose ends are points, as those of the report are.
void push_key(const Call& call, const KeyPair& key) {
    lua_createtable(call.lua(), 2, 0);
    call.push_vector(std::get<Vec3>(key.source));
    lua_rawseti(call.lua(), -2, 1);
    call.push_vector(std::get<Vec3>(key.target));
    lua_rawseti(call.lua(), -2, 2);
}

void push_turn(const Call& call, const Vec3& turn) {
    const double angle = turn.norm();
    lua_createtable(call.lua(), 0, 2);
    call.set_field("axis", call.push_vector(angle > 0.0 ? Vec3(turn / angle) : Vec3::UnitY()));
    call.set_field("angle", call.push(kDegrees * angle));
}

void push_join_place(const Call& call, const JoinReport& join) {
    call.set_field("placed", call.push(kPlacings[static_cast<int>(join.placed)]));
    call.set_field("guessed", call.push(join.guessed));
    if (join.guessed) call.set_field("certainty", call.push(join.certainty));
    call.set_field("any_turn", call.push(join.any_turn));
    push_turn(call, join.turn);
    call.set_field("turn");
    if (!join.key) return;
    push_key(call, *join.key);
    call.set_field("key");
}

void push_band_quality(const Call& call, const BandQuality& band) {
    lua_createtable(call.lua(), 0, 27);
    call.set_field("roughness", call.push(kDegrees * band.roughness));
    call.set_field("rest_roughness", call.push(kDegrees * band.rest_roughness));
    call.set_field("source_roughness", call.push(kDegrees * band.source_roughness));
    call.set_field("rest_source_roughness", call.push(kDegrees * band.rest_source_roughness));
    call.set_field("target_roughness", call.push(kDegrees * band.target_roughness));
    call.set_field("rest_target_roughness", call.push(kDegrees * band.rest_target_roughness));
    call.set_field("source_grain", call.push(kDegrees * band.source_grain));
    call.set_field("rest_source_grain", call.push(kDegrees * band.rest_source_grain));
    call.set_field("target_grain", call.push(kDegrees * band.target_grain));
    call.set_field("rest_target_grain", call.push(kDegrees * band.rest_target_grain));
    call.set_field("wrinkled", call.push(band.wrinkled));
    call.set_field("crumpled", call.push(band.crumpled));
    call.set_field("steep", call.push(kDegrees * band.steep));
    call.set_field("rest_steep", call.push(kDegrees * band.rest_steep));
    call.set_field("bend", call.push(kDegrees * band.bend));
    call.set_field("rest_bend", call.push(kDegrees * band.rest_bend));
    call.set_field("max_bend", call.push(kDegrees * band.max_bend));
    call.set_field("rest_max_bend", call.push(kDegrees * band.rest_max_bend));
    call.set_field("folded", call.push(band.folded));
    call.set_field("rest_folded", call.push(band.rest_folded));
    call.set_field("flare", call.push(kDegrees * band.flare));
    call.set_field("spike", call.push(kDegrees * band.spike));
    call.set_field("rest_spike", call.push(kDegrees * band.rest_spike));
    call.set_field("sharpened", call.push(band.sharpened));
    call.set_field("pinched", call.push(band.pinched));
    call.set_field("source_volume", call.push(band.source_volume));
    call.set_field("target_volume", call.push(band.target_volume));
    call.set_field("radius", call.push(band.radius));
}

bool is_angle(MergeFault fault) {
    return fault == MergeFault::roughness || fault == MergeFault::bend ||
           fault == MergeFault::flare || fault == MergeFault::spike || fault == MergeFault::seam ||
           fault == MergeFault::slivers;
}

// Its text with the remedy, for tostring.
int reason_text(lua_State* L) {
    lua_getfield(L, 1, "text");
    lua_pushliteral(L, "; ");
    lua_getfield(L, 1, "remedy");
    lua_concat(L, 3);
    return 1;
}

void push_reason(const Call& call, const MergeReason& reason) {
    lua_State* L = call.lua();
    lua_createtable(L, 0, 7);
    const double unit = is_angle(reason.fault) ? kDegrees : 1.0;
    call.set_field("fault", call.push(fault_name(reason.fault)));
    if (reason.join != kNoIndex) call.set_field("join", call.push_id(reason.join));
    call.set_field("value", call.push(unit * reason.value));
    call.set_field("limit", call.push(unit * reason.limit));
    call.set_field("text", call.push(reason.text));
    call.set_field("remedy", call.push(reason.remedy));
    if (reason.fault == MergeFault::crossings) call.set_field("faces", call.push_ids(reason.faces));
    lua_createtable(L, 0, 1);
    lua_pushcfunction(L, reason_text);
    lua_setfield(L, -2, "__tostring");
    lua_setmetatable(L, -2);
}

// The verdict and below it the remedy for each reason, for tostring.
int report_text(lua_State* L) {
    lua_settop(L, 1);
    lua_getfield(L, 1, "verdict");
    lua_getfield(L, 1, "reasons");
    for (int i = 1; lua_istable(L, 3); ++i) {
        lua_rawgeti(L, 3, i);
        if (!lua_istable(L, 4)) break;
        lua_pushvalue(L, 2);
        lua_pushliteral(L, "\n  ");
        lua_getfield(L, 4, "fault");
        lua_pushliteral(L, ": ");
        lua_getfield(L, 4, "remedy");
        lua_concat(L, 5);
        lua_replace(L, 2);
        lua_settop(L, 3);
    }
    lua_settop(L, 2);
    return 1;
}

void push_join(const Call& call, const JoinReport& join) {
    lua_createtable(call.lua(), 0, 18);
    push_join_place(call, join);
    call.set_field("source_size", call.push(join.source_size));
    call.set_field("target_size", call.push(join.target_size));
    call.set_field("scale", call.push(join.scale));
    call.set_field("source_turn", call.push(kDegrees * join.source_turn));
    call.set_field("target_turn", call.push(kDegrees * join.target_turn));
    call.set_field("source_trimmed", call.push(join.source_trimmed));
    call.set_field("target_trimmed", call.push(join.target_trimmed));
    call.set_field("subdivided", call.push(join.subdivided));
    call.set_field("target_subdivided", call.push(join.target_subdivided));
    call.set_field("fits", call.push(join.fits));
    call.set_field("same_side", call.push(join.same_side));
    push_band_quality(call, join.band);
    call.set_field("band");
}

void push_times(const Call& call, const MergeReport& report) {
    call.set_field("free_vertices", call.push(report.deform.free_vertices));
    call.set_field("displaced_vertices", call.push(report.deform.displaced_vertices));
    call.set_field("first_factor_seconds", call.push(report.deform.first_factor_seconds));
    call.set_field("second_factor_seconds", call.push(report.deform.second_factor_seconds));
    call.set_field("first_solve_seconds", call.push(report.deform_seconds.first));
    call.set_field("polar_seconds", call.push(report.deform_seconds.polar));
    call.set_field("second_solve_seconds", call.push(report.deform_seconds.second));
    call.set_field("prepare_seconds", call.push(report.prepare_seconds));
    call.set_field("solve_seconds", call.push(report.solve_seconds));
}

// Vertices of faces that come from one side.
Region side_region(const Mesh& mesh, const std::vector<SeamSide>& side_of_face, SeamSide side) {
    std::vector<char> inside(mesh.vertex_count(), 0);
    for (Index f = 0; f < mesh.face_count(); ++f) {
        if (side_of_face[f] != side) continue;
        for (const Index v : mesh.topology().face(f)) inside[v] = 1;
    }
    std::vector<Index> vertices;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (inside[v]) vertices.push_back(v);
    }
    return Region(mesh.shared_topology(), std::move(vertices));
}

void push_flips(const Call& call, const MergeReport& report) {
    lua_createtable(call.lua(), 0, 2);
    call.set_field("source", call.push(report.source_flipped));
    call.set_field("targets", call.push_ids(report.targets_flipped));
}

void push_intersections(const Call& call, const std::vector<FacePair>& pairs) {
    push_list(call, pairs, [&](const FacePair& pair) {
        const Index ids[] = {pair.first, pair.second};
        call.push_ids(ids);
    });
}

void push_band(const Call& call, const TransitionBand& band) {
    lua_createtable(call.lua(), 0, 4);
    call.set_field("width", call.push(band.width));
    call.set_field("vertices", call.push(band.vertices));
    call.set_field("flipped", call.push(band.flipped));
    call.set_field("unmapped", call.push(band.unmapped));
}

// One pair of bands a seam; an empty list without a transition.
void push_transition(const Call& call, const TransitionReport& transition) {
    const std::size_t count = std::min(transition.source.size(), transition.target.size());
    lua_createtable(call.lua(), index_of(count), 0);
    for (std::size_t i = 0; i < count; ++i) {
        lua_createtable(call.lua(), 0, 2);
        push_band(call, transition.source[i]);
        call.set_field("source");
        push_band(call, transition.target[i]);
        call.set_field("target");
        lua_rawseti(call.lua(), -2, index_of(i) + 1);
    }
}

// ---- Provenance

// Which mesh an element of all inputs together belongs to, and its number there.
std::pair<std::size_t, Index> placed(const std::vector<Index>& counts, Index element) {
    std::size_t mesh = 0;
    while (mesh + 1 < counts.size() && element >= counts[mesh]) element -= counts[mesh++];
    return {mesh, element};
}

int push_sources(const Call& call, std::span<const ElementMap::Source> sources,
                 const std::vector<Index>& counts, const char* element) {
    return push_list(call, sources, [&](const ElementMap::Source& source) {
        const auto [mesh, id] = placed(counts, source.element);
        const bool from_source = mesh + 1 == counts.size();
        lua_createtable(call.lua(), 0, 4);
        call.set_field("side", call.push(from_source ? "source" : "target"));
        if (!from_source) call.set_field("target", call.push(index_of(mesh) + 1));
        call.set_field(element, call.push_id(id));
        call.set_field("weight", call.push(source.weight));
    });
}

int provenance_vertex(Call& call) {
    const auto from = call.self<ProvenanceObject>();
    const Index v = call.id("vertex");
    if (!check_id(call, v, from->vertices.size(), ElementKind::vertex)) return call.fail();
    return push_sources(call, from->vertices[v], from->inputs.vertices, "vertex");
}

int provenance_face(Call& call) {
    const auto from = call.self<ProvenanceObject>();
    const Index f = call.id("face");
    if (!check_id(call, f, from->faces.size(), ElementKind::face)) return call.fail();
    return push_sources(call, from->faces[f], from->inputs.faces, "face");
}

void close_provenance(void* object) {
    auto& from = *static_cast<ProvenanceObject*>(object);
    from.vertices = {};
    from.faces = {};
}

// The seams with their neighbours.
Region seam_region(const MergeResult& result) {
    std::vector<Index> vertices;
    for (const std::vector<Index>& seam : result.seams) {
        vertices.insert(vertices.end(), seam.begin(), seam.end());
    }
    return Region(result.mesh.shared_topology(), std::move(vertices)).grown(1);
}

constexpr const char* kMerged = R"(local ball = lissom.shapes.sphere{ segments = 24 }
local half = ball:cut{ plane = { point = { 0, 0, 0 }, normal = { 0, 1, 0 } } }
local other = half:copy():transform{ rotate = { axis = "x", angle = 180 }, scale = 3 }
local mesh, report = lissom.merge{
    joins = { { source = half:boundaries()[1], target = other:boundaries()[1] } },
}
)";

void push_bite(const Call& call, const TargetBite& bite) {
    lua_createtable(call.lua(), 0, 2);
    call.set_field("length", call.push(bite.length));
    call.set_field("depth", call.push(bite.depth));
}

// ---- The result of a merge

struct MergedObjects {
    Ref<MeshObject> mesh;
    Ref<ProvenanceObject> provenance;
    Ref<RegionObject> source, target, seam, band;
};

// Places on the stack from the mesh on; two values that the call holds follow the objects.
constexpr int kProvenancePlace = 1, kSourcePlace = 2, kTargetPlace = 3, kSeamPlace = 4,
              kBandPlace = 5, kMergedValues = 8;

MergedObjects create_merged_objects(const Call& call) {
    return {call.create<MeshObject>(),   call.create<ProvenanceObject>(),
            call.create<RegionObject>(), call.create<RegionObject>(),
            call.create<RegionObject>(), call.create<RegionObject>()};
}

std::vector<Path> seam_paths(const MergeResult& result) {
    std::vector<Path> paths;
    for (const std::vector<Index>& seam : result.seams) {
        paths.emplace_back(result.mesh.shared_topology(), seam, true);
    }
    return paths;
}

std::shared_ptr<ProvenanceObject> provenance_of(MergeResult& result, const MergeInputs& inputs) {
    auto from = std::make_shared<ProvenanceObject>();
    from->vertices = std::move(result.provenance.vertices);
    from->faces = std::move(result.provenance.faces);
    from->inputs = inputs;
    return from;
}

// Moves the mesh and the provenance out of `result`. Returns the object of the mesh.
std::shared_ptr<MeshObject> fill_merged_objects(const MergedObjects& objects, MergeResult& result,
                                                const MergeInputs& inputs) {
    Region source = side_region(result.mesh, result.side_of_face, SeamSide::source);
    Region target = side_region(result.mesh, result.side_of_face, SeamSide::target);
    Region seam = seam_region(result);
    Region band(result.mesh.shared_topology(), result.report.transition.moved);
    auto owner = std::make_shared<MeshObject>(std::move(result.mesh));
    objects.mesh.set(owner);
    objects.source.set(std::make_shared<RegionObject>(owner, std::move(source)));
    objects.target.set(std::make_shared<RegionObject>(owner, std::move(target)));
    objects.seam.set(std::make_shared<RegionObject>(owner, std::move(seam)));
    objects.band.set(std::make_shared<RegionObject>(owner, std::move(band)));
    objects.provenance.set(provenance_of(result, inputs));
    return owner;
}

// Gives the table on top of the stack the value at `index`.
void set_from_stack(const Call& call, const char* field, int index) {
    lua_pushvalue(call.lua(), index);
    call.set_field(field);
}

void set_outcome(const Call& call, const MergeReport& report) {
    call.set_field("joins", push_list(call, report.joins,
                                      [&](const JoinReport& join) { push_join(call, join); }));
    set_verdict(call, report.ok, report.verdict, report.reasons);
    push_bite(call, report.bite);
    call.set_field("bite");
    call.set_field("loose_parts", call.push(report.loose_parts));
    call.set_field("warnings", push_list(call, report.warnings,
                                         [&](const std::string& text) { call.push(text); }));
    push_flips(call, report);
    call.set_field("flipped");
    push_intersections(call, report.intersections);
    call.set_field("intersections");
    call.set_field("known_intersections", call.push(report.known_intersections));
}

// The seam and the transition with their regions, which lie behind the mesh at `first`.
void set_stages(const Call& call, const MergeReport& report, int first) {
    push_seam(call, report.seam);
    set_from_stack(call, "region", first + kSeamPlace);
    call.set_field("seam");
    const bool blended = !report.transition.source.empty();
    push_transition(call, report.transition);
    if (blended) set_from_stack(call, "region", first + kBandPlace);
    call.set_field("transition");
    if (blended) call.set_field("transition_kept", call.push(report.transition.kept));
    push_times(call, report);
}

}  // namespace

void push_reasons(const Call& call, const std::vector<MergeReason>& reasons) {
    push_list(call, reasons, [&](const MergeReason& reason) { push_reason(call, reason); });
}

void set_verdict(const Call& call, bool ok, const std::string& verdict,
                 const std::vector<MergeReason>& reasons) {
    call.set_field("ok", call.push(ok));
    call.set_field("verdict", call.push(verdict));
    push_reasons(call, reasons);
    call.set_field("reasons");
    lua_createtable(call.lua(), 0, 1);
    lua_pushcfunction(call.lua(), report_text);
    lua_setfield(call.lua(), -2, "__tostring");
    lua_setmetatable(call.lua(), -2);
}

int push_merge_result(Call& call, MergeResult& result, const MergeInputs& inputs) {
    const MergedObjects objects = create_merged_objects(call);
    auto& owner = call.hold<std::shared_ptr<MeshObject>>();
    auto& seams = call.hold<std::vector<Path>>();
    const int first = lua_gettop(call.lua()) - kMergedValues + 1;
    const bool has_provenance = result.provenance.vertices.size() > 0;
    const bool done = call.attempt_quick([&] {
        seams = seam_paths(result);
        owner = fill_merged_objects(objects, result, inputs);
    });
    if (!done) return call.fail();
    call.charge(objects.mesh);
    call.charge(objects.provenance);
    lua_pushvalue(call.lua(), first);
    call.remember(owner.get());
    lua_createtable(call.lua(), 0, 25);
    set_outcome(call, result.report);
    set_stages(call, result.report, first);
    if (push_paths(call, owner, seams) != 1) return call.fail();
    call.set_field("seams");
    if (has_provenance) set_from_stack(call, "provenance", first + kProvenancePlace);
    set_from_stack(call, "source", first + kSourcePlace);
    set_from_stack(call, "target", first + kTargetPlace);
    return 2;
}

Type provenance_type() {
    const std::string example = kMerged;
    return {.name = "lissom.Provenance",
            .summary =
                "Provenance of the elements of a merged mesh: elements of the source and of the "
                "targets as they were given.",
            .methods =
                {{.name = "vertex",
                  .body = provenance_vertex,
                  .summary = "The sources of a vertex, with weights, before it was moved: one "
                             "vertex, or several for one made on an edge; on a seam those of "
                             "both sides.",
                  .arguments = {id("vertex", "A vertex of the merged mesh.")},
                  .results = {{"lissom.Origin[]", "origins", "With weights that sum to 1."}},
                  .errors = {ErrorCode::out_of_range},
                  .example = example + R"(local from = report.provenance:vertex(1)
assert(from[1].side == "target" and from[1].vertex == 1))"},
                 {.name = "face",
                  .body = provenance_face,
                  .summary = "The face that a face comes from.",
                  .arguments = {id("face", "A face of the merged mesh.")},
                  .results = {{"lissom.Origin[]", "origins", "With weights that sum to 1."}},
                  .errors = {ErrorCode::out_of_range},
                  .example =
                      example +
                      R"(assert(report.provenance:face(mesh:face_count())[1].side == "source"))"}},
            .close = close_provenance};
}

std::vector<Record> merge_records() {
    return {
        {"lissom.Origin",
         "An element that another comes from.",
         {{"string", "side", "source or target."},
          {"integer|nil", "target", "Number of the target."},
          {"integer|nil", "vertex", "A vertex of that mesh."},
          {"integer|nil", "face", "A face of that mesh."},
          {"number", "weight", "Its part of all."}}},
        {"lissom.SeamQuality",
         "Visibility of seams; angles in degrees.",
         {{"number", "max_dihedral", "The greatest angle between faces across a seam."},
          {"number", "rms_dihedral", "Their root mean square, weighted by edge length."},
          {"number", "max_near", "The greatest angle on and next to a seam."},
          {"number", "smallest_angle",
           "The smallest angle of a triangle at a seam; 0 without any."},
          {"number", "low_angle", "The 5th percentile of the triangles' smallest angles."}}},
        {"lissom.SeamReport",
         "Measures of sewing.",
         {{"integer", "inserted_into_target", "Vertices of the source inserted into its faces."},
          {"integer", "inserted_into_source", "The other way round."},
          {"integer", "snapped", "Pairs of vertices that became one because they were close."},
          {"integer", "collapsed", "Short edges of the source's boundary that became a vertex."},
          {"integer", "flipped", "Edges flipped to avoid slivers."},
          {"integer", "band_removed", "Faces of the target that the band replaced."},
          {"integer", "band_added", "Faces that the band added."},
          {"integer", "smoothed", "Umbrella steps that were made."},
          {"integer", "collar_removed", "Faces that collars took the place of."},
          {"integer", "collar_added", "Triangles of the collars."},
          {"lissom.SeamQuality", "before", "Before collars and smoothing."},
          {"lissom.SeamQuality", "after", "The final quality."},
          {"lissom.Region", "region",
           "The vertices of the seams and their neighbours: mesh:set_region shows them by name."}}},
        {"lissom.JoinReport",
         "Report of one join; angles in degrees.",
         {{"integer", "source_size", "Vertices of the source's boundary as it was joined."},
          {"integer", "target_size", "Vertices of the target's."},
          {"number", "scale", "Growth of the source there, as a factor."},
          {"string", "placed",
           "Criterion of the source's rotation: keys, as placed, directions or shape."},
          {"boolean", "guessed", "The shapes decided, or directions that contradict each other."},
          {"number|nil", "certainty",
           "For a guess: the probability, 0 to 1, that it is right; below .75 give a key."},
          {"boolean", "any_turn", "The parts are round: no turn is better than another."},
          {"table", "turn",
           "Rotation of the source from its given place: axis, a unit vector, and angle in "
           "degrees."},
          {"number[][]|nil", "key",
           "A point of the source's boundary and the point of the target's that it meets: "
           "keys = { key } makes the same result. nil in the thesis's transition."},
          {"number", "source_turn", "Mean turn of the source's boundary at a vertex, as given."},
          {"number", "target_turn", "The same of the target's."},
          {"boolean", "source_trimmed", "It was jagged and has been trimmed."},
          {"boolean", "target_trimmed", "The same of the target's."},
          {"boolean", "subdivided", "Faces of the source were split there."},
          {"boolean", "target_subdivided", "Faces of the target were split there."},
          {"boolean", "fits",
           "The boundaries are one curve, as they lie or, in the free configuration, up to a "
           "similarity, and the surface goes on across it: all vertices are kept there, and "
           "nothing "
           "is smoothed, trimmed or subdivided."},
          {"boolean", "same_side",
           "In the fixed configuration: both parts lie on the same side of the boundary, so that "
           "the source turns over."},
          {"lissom.BandQuality", "band",
           "The surface around the seam, against both sides before; zeros of a draft."}}},
        {"lissom.BandQuality",
         "The surface around a seam, against the parts before they were joined; angles in degrees.",
         {{"number", "roughness",
           "The RMS angle at the edges within half a radius of the seam, weighted by length, "
           "without the seam's own."},
          {"number", "rest_roughness", "The same beside both boundaries before."},
          {"number", "source_roughness", "The same of the source alone."},
          {"number", "rest_source_roughness", "The same of the source before."},
          {"number", "target_roughness", "The same of the target alone."},
          {"number", "rest_target_roughness", "The same of the target before."},
          {"number", "source_grain",
           "`source_roughness` of the edges that turn by less than 40 degrees: between creases."},
          {"number", "rest_source_grain", "The same of the source before."},
          {"number", "target_grain", "The same of the target alone."},
          {"number", "rest_target_grain", "The same of the target before."},
          {"number", "wrinkled",
           "Length of the source's edges within half a radius that turn by more than 25 degrees, "
           "in radii of the seam, beyond that before."},
          {"number", "crumpled",
           "Length of the edges of both sides within half a radius that turn by over 20 degrees "
           "more than at rest, or the other way, in radii of the seam."},
          {"number", "steep", "Angle of the seam's edges that a thirtieth of its length exceeds."},
          {"number", "rest_steep",
           "The same of the edges of the faces at the boundaries before, of the steeper side."},
          {"number", "bend",
           "The RMS angle between planes fitted to the surface on either side of points of the "
           "seam, to strips a third of the radius wide."},
          {"number", "rest_bend",
           "The same before on the side that bends more, from the strip at the boundary to the one "
           "behind it."},
          {"number", "max_bend", "Angle that a tenth of those in `bend` exceed."},
          {"number", "rest_max_bend", "Angle that a tenth of those in `rest_bend` exceed."},
          {"number", "folded",
           "Length of the edges within one radius at which the surface folds back by more than "
           "135 degrees, in radii of the seam."},
          {"number", "rest_folded",
           "That of the edges of both sides before that turned by more than 105 degrees."},
          {"number", "flare",
           "The RMS angle by which the rim of the source turns outward beside the seam more than "
           "at rest; 0 of a paste."},
          {"number", "spike",
           "Sharpness of the sharpest tip or pit within half a radius of the seam: the greatest "
           "sum of angles missing to full turns around the vertices within .15 radii, in degrees. "
           "The corner of a cube has 90, a needle 360."},
          {"number", "rest_spike", "The same of both sides before."},
          {"number", "sharpened",
           "Length of the edges within half a radius that turn by more than 60 degrees, in radii "
           "of the seam, beyond that of the same side before: of the side that gained most."},
          {"number", "pinched",
           "Sum of the widths, in radii of the seam, of the vertices of the source within half a "
           "radius that became thorns or pits: their neighbours slope away from them by 30 degrees "
           "more than at rest, to either side."},
          {"number", "source_volume",
           "Volume between source and seam, over that of the source at rest at its scale: 1 if "
           "it was kept, negative if it turned inside out."},
          {"number", "target_volume",
           "The same of the target; of a paste the share of the target's area that is left."},
          {"number", "radius", "Radius of the seam."}}},
        {"lissom.MergeReason",
         "Reason why a merge is not good. tostring gives text and remedy.",
         {{"string", "fault",
           "crossings, side, folds, roughness, volume, bend, flare, spike, bite, seam, place or "
           "slivers; "
           "of a scatter \"left out\" as well."},
          {"integer|nil", "join", "The join that it is of; nil of all of them."},
          {"number", "value",
           "Measured value: degrees for roughness, bend, flare, spike, seam and slivers; radii of "
           "the seam for folds and bites; pairs of faces for crossings; the part that was kept for "
           "volume; the certainty for place."},
          {"number", "limit", "The limit that it passes."},
          {"integer[]|nil", "faces", "For crossings: the faces of the merged mesh concerned."},
          {"string", "text", "The fault, in plain words."},
          {"string", "remedy", "The remedy."}}},
        {"lissom.TargetBite",
         "Loss of the target's edges that turn by more than 35 degrees, by a paste: parts of "
         "them stand out of the result, or lie below the surface still left of the target.",
         {{"number", "length", "Their length, in radii of the seam."},
          {"number", "depth", "Their greatest distance from the result, in these radii."}}},
        {"lissom.MergeReport",
         "Report of a merge.",
         {{"lissom.TargetBite", "bite", "Loss of the sharp edges of its target, by a paste."},
          {"boolean", "ok",
           "Whether the result is good: no faces run through one another that did not before, but "
           "for those that only touch; the "
           "surface around the seam does not fold back, has no sharp edges along 1.3 radii that it "
           "had not, is at most 1.4 times as rough as the parts "
           "were there (or turns by less than 8 degrees an edge), the source at most 1.6 times as "
           "it was (or by 11 degrees; merged above 14 degrees 1.4 times) and the target 1.3 "
           "times (or by 5 degrees), and bends by no more than 35 "
           "degrees from one side to the other and 60 along a tenth of it, or 1.3 times the "
           "angle before (and by the crease of a paste); the rim of the source of a merge turns "
           "outward by no more than 65 degrees more than before, or 22.5 if it crumples; no tip "
           "lacks more than 88 degrees to flat (45 beside smooth parts), or 1.35 times as many as "
           "the sharpest before; a paste takes no sharp edge of "
           "its target along more than .3 of its radius or deeper than .15; each part keeps "
           "two fifths of its volume; the seam turns by no more than 30 degrees but for a "
           "thirtieth of its length and 20 in the "
           "mean, or than the surfaces did beside the boundaries; no place is a toss; no "
           "triangle at the seam has less than 2 degrees, or than there were."},
          {"string", "verdict", "The same in one line, with the reasons."},
          {"lissom.MergeReason[]", "reasons",
           "Each fault with its measure, its limit and a remedy; empty if ok. tostring(report) "
           "lists them."},
          {"lissom.JoinReport[]", "joins", "One a join."},
          {"string[]", "warnings", "Points to look at, in plain words."},
          {"integer", "loose_parts",
           "Parts of the source without a joined boundary: in the free configuration they move "
           "along with the nearest joined part."},
          {"table", "flipped",
           "source and targets: whether they were inside out and have been turned over."},
          {"lissom.SeamReport", "seam", "Measures of sewing, and the quality of the seam."},
          {"table[]", "transition",
           "For each seam source and target: width, vertices, and flipped and unmapped ones, of "
           "its bands; its field `region` has the vertices that they moved."},
          {"number|nil", "transition_kept",
           "The part of the way that the bands of a transition went: 0 if it was left out, "
           "since it would have folded the surface."},
          {"integer[][]", "intersections",
           "Pairs of faces that run through one another and come from faces that did not."},
          {"integer", "known_intersections",
           "Number of pairs of moved or made faces that come from faces that did."},
          {"lissom.Path[]", "seams", "The seams on the merged mesh."},
          {"lissom.Region", "source", "The vertices of the merged mesh that are the source's."},
          {"lissom.Region", "target", "Those that are the targets'."},
          {"lissom.Provenance|nil", "provenance",
           "Provenance of every element; nil for the draft of a paste."},
          {"integer", "free_vertices", "Vertices of the source that moved freely."},
          {"integer", "displaced_vertices", "Degenerate vertices displaced."},
          {"number", "first_factor_seconds", "Time to factor the first system."},
          {"number", "second_factor_seconds", "Time to factor the second."},
          {"number", "first_solve_seconds", "Time to solve the first system."},
          {"number", "polar_seconds", "Time for the rotations and sizes of all gradients."},
          {"number", "second_solve_seconds", "Time to solve the second system."},
          {"number", "prepare_seconds", "Time to check, trim and factor."},
          {"number", "solve_seconds", "Time to deform and sew."}}}};
}

}  // namespace lissom::lua
