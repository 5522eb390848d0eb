#include "bindings/lua/core/kernel_library.h"

#include <iterator>
#include <utility>

#include "bindings/lua/core/engine_library.h"
#include "bindings/lua/core/listeners.h"
#include "kernel/core/build_info.h"
#include "kernel/core/version.h"
#include "kernel/mesh/report.h"

namespace lissom::lua {

// Of bindings/lua/mesh and bindings/lua/deform, rooms after this one.
std::vector<Function> resample_methods();
std::vector<Record> resample_records();
Type pose_type();
Type pose_space_type();
std::vector<Function> pose_space_functions();
std::vector<Function> transfer_functions();
namespace {

template <typename T>
void add(std::vector<T>& list, std::vector<T> more) {
    std::move(more.begin(), more.end(), std::back_inserter(list));
}

Type whole_mesh_type() {
    Type mesh = mesh_type();
    add(mesh.methods, mesh_edit_methods());
    add(mesh.methods, mesh_query_methods());
    add(mesh.methods, mesh_file_methods());
    add(mesh.methods, mesh_report_methods());
    add(mesh.methods, resample_methods());
    add(mesh.methods, buffer_methods_of_mesh());
    add(mesh.methods, region_methods_of_mesh());
    add(mesh.methods, path_methods_of_mesh());
    add(mesh.methods, cut_methods_of_mesh());
    add(mesh.methods, erase_methods_of_mesh());
    add(mesh.methods, parameterize_methods_of_mesh());
    return mesh;
}

Type whole_path_type() {
    Type path = path_type();
    add(path.methods, trim_methods_of_path());
    return path;
}

Type whole_camera_type() {
    Type camera = camera_type();
    add(camera.methods, pick_methods_of_camera());
    camera.methods.push_back(select_method_of_camera());
    camera.methods.push_back(stroke_method_of_camera());
    return camera;
}

Type whole_curve_type() {
    Type curve = curve_type();
    add(curve.methods, support_methods_of_curve());
    return curve;
}

Type whole_hairstyle_type() {
    Type style = hairstyle_type();
    style.methods.push_back(style_text_method());
    style.methods.push_back(sketch_method_of_hairstyle());
    return style;
}

}  // namespace

Library kernel_library() {
    Library library{
        .name = "lissom",
        .summary =
            "Modeling by few handles: meshes, regions, paths, deformation, merging, hair and "
            "scenes."};
    library.constants = {
        {"version", LISSOM_VERSION, "Version of the library."},
        {"licence", build_info().licence,
         "The licence that the program may be distributed under: \"MIT\", or \"GPL-2.0-or-later\" "
         "if it links CHOLMOD, as the lissom program of builds without LISSOM_GPL=OFF does."}};
    add(library.functions, mesh_file_functions());
    add(library.functions, mesh_functions());
    add(library.functions, shape_functions());
    add(library.functions, deform_functions());
    add(library.functions, pose_space_functions());
    add(library.functions, transfer_functions());
    add(library.functions, merge_functions());
    add(library.functions, paste_functions());
    add(library.functions, scatter_functions());
    add(library.functions, part_functions());
    add(library.functions, scalp_functions());
    add(library.functions, hairstyle_functions());
    library.functions.push_back(read_style_function());
    add(library.functions, groom_functions());
    add(library.functions, strand_functions());
    add(library.functions, scene_functions());
    add(library.functions, polyline_functions());
    add(library.functions, camera_functions());
    add(library.functions, gizmo_functions());
    add(library.functions, tool_functions());
    add(library.functions, parameter_functions());
    library.functions.push_back(listen_function());
    add(library.functions, error_functions());
    library.types = {
        whole_mesh_type(), region_type(),          whole_path_type(),      buffer_type(),
        deformer_type(),   handle_type(),          bones_type(),           pose_space_type(),
        pose_type(),       merger_type(),          provenance_type(),      paste_type(),
        scalp_type(),      whole_hairstyle_type(), whole_curve_type(),     strands_type(),
        guide_set_type(),  cards_type(),           strand_follower_type(), hair_dynamics_type(),
        scene_type(),      polyline_type(),        whole_camera_type(),    gizmo_type(),
        support_type(),    tool_view_type(),       parameters_type()};
    library.records = kernel_records();
    add(library.records, error_records());
    add(library.records, cut_records());
    add(library.records, parameterize_records());
    add(library.records, resample_records());
    add(library.records, merge_records());
    add(library.records, paste_records());
    add(library.records, erase_records());
    add(library.records, scatter_records());
    add(library.records, part_records());
    add(library.records, hairstyle_records());
    add(library.records, curve_records());
    add(library.records, strand_records());
    add(library.records, guide_set_records());
    add(library.records, hair_dynamics_records());
    add(library.records, cards_records());
    add(library.records, strand_level_records());
    add(library.records, strand_check_records());
    add(library.records, groom_records());
    add(library.records, scene_records());
    add(library.records, pick_records());
    add(library.records, stroke_records());
    add(library.records, support_records());
    add(library.records, gizmo_records());
    add(library.records, sketch_records());
    add(library.records, tool_records());
    return library;
}

std::vector<Parameter> rotation_fields(const std::string& about_default) {
    return {axis("axis", "Axis of the rotation."),
            number("angle", "Angle, counter-clockwise seen against the axis.").in("degrees"),
            vector("about", "A point on the axis.").optional(about_default)};
}

std::vector<Result> finding_fields() {
    std::vector<Result> fields{{"lissom.Finding", "[integer]", "The findings in order."}};
    for (const FindingKind kind : all_finding_kinds()) {
        fields.push_back({"lissom.Finding|nil", std::string(finding_name(kind)),
                          std::string(finding_explanation(kind))});
    }
    return fields;
}

std::vector<Record> kernel_records() {
    return {
        {"lissom.Bounds",
         "An axis-aligned box.",
         {{"lissom.Vector", "min", "Smallest coordinates."},
          {"lissom.Vector", "max", "Greatest coordinates."},
          {"lissom.Vector", "center", "The middle."},
          {"number", "diagonal", "Length of the diagonal."}}},
        {"lissom.SurfacePoint",
         "A point of a surface.",
         {{"lissom.Vector", "position", "The point."},
          {"integer", "face", "The face that contains it."},
          {"integer", "vertex", "The nearest vertex of its triangle."},
          {"integer[]", "triangle", "Vertices of the triangle of the face that contains it."},
          {"number[]", "bary", "Its barycentric coordinates in that triangle."},
          {"lissom.Vector", "normal",
           "Unit normal of the triangle; zero for a triangle without area."},
          {"number", "distance", "Distance from the query point, or along the ray."}}},
        {"lissom.Distortion",
         "Differences of a surface from its rest, at every vertex.",
         {{"lissom.Buffer", "stretch",
           "Length of the edge that changed most, over its length at rest: 1 as at rest."},
          {"lissom.Buffer", "area", "Area of the faces around it, over their area at rest."},
          {"lissom.Buffer", "angle", "Greatest change of a corner's angle, in degrees."},
          {"lissom.Buffer", "flips", "Number of flipped faces around it."},
          {"integer[]", "flipped",
           "Faces that look against the faces around them, and did not at rest."}}},
        {"lissom.PathPoint",
         "A point of a path.",
         {{"lissom.Vector", "position", "The point."},
          {"number", "parameter", "Fraction of the path's length up to it, 0 to 1."},
          {"integer", "segment", "It lies between this point of the path and the next."},
          {"number", "distance", "Distance from the query point."}}},
        {"lissom.FillReport",
         "Result of closing a hole.",
         {{"integer", "loop_size", "Vertices around the hole."},
          {"integer", "first_vertex", "The first new vertex."},
          {"integer", "vertex_count", "New vertices; their ids follow each other."},
          {"integer", "first_face", "The first new face."},
          {"integer", "face_count", "New faces; their ids follow each other."},
          {"integer", "parts", "Parts that the loop was divided into."},
          {"integer", "folded_edges", "Edges of the patch that turn by more than 150 degrees."},
          {"boolean", "limit_reached", "Refinement ended at maximum_vertices."}}},
        {"lissom.AttributeInfo",
         "Description of an attribute.",
         {{"string", "name", "Its name."},
          {"string", "domain", "vertex, corner or face."},
          {"integer", "width", "Numbers an element."},
          {"string", "type", "Number type in files: float32, uint8, ..."},
          {"integer", "count", "Elements."}}},
        {"lissom.Check",
         "The state of a mesh.",
         {{"integer", "vertices", "Number of vertices."},
          {"integer", "edges", "Number of edges."},
          {"integer", "faces", "Number of faces."},
          {"integer", "components", "Connected components, vertices without faces included."},
          {"integer", "boundaries", "Open boundaries."},
          {"integer", "genus", "Handles of the surface, summed over the components."},
          {"integer", "euler", "V - E + F over vertices that have faces."},
          {"boolean", "closed", "No open boundary."},
          {"boolean", "manifold", "Every vertex has one fan of faces."},
          {"boolean", "triangles", "All faces are triangles."},
          {"integer[]", "isolated_vertices", "Vertices without faces."},
          {"integer[]", "zero_area_faces", "Faces without area."}}},
        {"lissom.Finding",
         "One finding of a report.",
         {{"string", "kind", "Kind of the finding: vertices_welded, edges_nonmanifold, ..."},
          {"integer", "count", "Number of elements or items."},
          {"string", "summary", "The same in a few words."},
          {"string|nil", "message", "Details, if any."},
          {"string|nil", "element",
           "Element that the ids number: vertex, edge, face or component."},
          {"string|nil", "of",
           "file if the ids are those of the file, mesh if they are the mesh's."},
          {"integer[]|nil", "ids", "The elements; edges are pairs of vertex ids."}}},
        {"lissom.Report", "Findings as a list, and each under the name of its kind.",
         finding_fields()},
        {"lissom.DeformReport",
         "The last result of a deformation beside its rest shape; tostring gives it in words.",
         {{"number", "stretch",
           "The greatest factor by which an edge is longer or shorter than at rest; 1 is none."},
          {"integer[]|nil", "stretched", "The vertices of that edge; nil if none changed."},
          {"integer[]", "flipped",
           "Faces that look against those around them, and did not at rest."},
          {"integer|nil", "crossings",
           "Pairs of faces that intersect and did not at rest; if asked for."},
          {"number|nil", "volume_change", "Volume over that at rest, less 1; nil without one."},
          {"table[]", "tears",
           "Places at which handles nearly touch and tear the surface, the worst first: "
           "`vertices`, a pair that different handles hold, and `slip`, how far they part in "
           "lengths of the edges between."},
          {"lissom.DeformWarning[]", "warnings", "The harms that a user would see."}}},
        {"lissom.Contacts",
         "Pairs of faces that intersect, as a list of {face, face}, the lower first, in ascending "
         "order.",
         {{"integer[]", "faces", "Their faces, ascending."},
          {"lissom.Region", "region", "The vertices of these faces, for pictures."}}},
        {"lissom.ContactStop",
         "The end of a drag that stops at contacts.",
         {{"number", "share", "The share of the way that the handles went, 0 to 1."},
          {"lissom.Contacts", "contacts",
           "The pairs of faces that meet a thousandth of the way further; none if share is 1."}}},
        {"lissom.AvoidedContacts",
         "Contacts that a solve pushed apart.",
         {{"integer", "before", "The number of pairs without pushing."},
          {"lissom.Contacts", "contacts", "The pairs that are left."},
          {"integer", "rounds", "Rounds of pushing, 0 to 3."}}},
        {"lissom.DeformWarning",
         "A harm that a deformation did to the surface.",
         {{"string", "kind",
           "torn: handles that nearly touch go different ways; stretched: edges become more than "
           "3 times as long or short as the handles ask for; folded: faces look against their "
           "neighbours; crossing: the surface runs through itself, if that was asked for; "
           "volume: it is a quarter smaller than the handles ask for, or three quarters larger."},
          {"string", "message", "Its measure and a remedy."},
          {"integer[]|nil", "vertices", "Tears between handles: pairs of vertices, at most 50."},
          {"integer[]|nil", "edges", "Edges, as pairs of vertices, at most 50."},
          {"integer[]|nil", "faces", "Faces, at most 100."}}},
        {"lissom.DeformStats",
         "Sizes and times of the last preparation of a deformation.",
         {{"integer", "region_vertices", "Vertices of the region."},
          {"integer", "free_vertices", "Those that no constraint holds."},
          {"integer", "constrained_vertices", "Those that one holds."},
          {"integer", "handles", "Handles."},
          {"integer", "displaced_vertices", "Degenerate vertices displaced."},
          {"integer", "extended_vertices", "Flat vertices with an unknown beside them."},
          {"integer", "inserted_vertices", "Vertices inserted at corners of the boundary."},
          {"integer", "subdivided_vertices", "Vertices that a refinement of coarse borders added."},
          {"integer", "level_vertices", "Vertices of the thinned surface; 0 without levels."},
          {"integer", "zero_area_faces", "Faces without area."},
          {"integer", "first_nonzeros", "Entries of the first system's factor."},
          {"integer", "second_nonzeros", "Entries of the second system's factor."},
          {"integer", "factor_bytes", "Bytes of both factors."},
          {"number", "assemble_seconds", "Time to assemble the systems."},
          {"number", "first_factor_seconds", "Time to factor the first."},
          {"number", "second_factor_seconds", "Time to factor the second."},
          {"number", "basis_seconds", "Time to compute the handle basis."},
          {"integer", "factorizations", "Factorisations so far: dragging adds none."}}},
        {"lissom.HandleBasis",
         "The first system's solution as a linear function of the handles: vertex v is at fixed(v) "
         "plus, for each handle, its 3 x 4 transform times the four weights of v.",
         {{"integer[]", "vertices", "Vertices of the region; one row of each buffer."},
          {"lissom.Handle[]", "handles", "The handles, in the order of `weights`."},
          {"lissom.Buffer[]", "weights", "For each handle four numbers a vertex."},
          {"lissom.Buffer", "fixed", "The part that no handle moves: three numbers a vertex."}}},
        {"lissom.ParamSchema",
         "The declaration of a parameter.",
         {{"string", "name", "Its name."},
          {"string", "type",
           "number, integer, boolean, string, choice, file, folder, mesh, region, boundary, curve "
           "or head."},
          {"any", "default", "Its default; nil if it must be given."},
          {"any", "value", "Its present value."},
          {"number?", "min", "Smallest value."},
          {"number?", "max", "Greatest value."},
          {"number?", "step", "Step of a slider."},
          {"string[]?", "choices", "The values of a choice."},
          {"string", "unit", "Its unit, or an empty string."},
          {"string", "group", "Heading that it stands under, or an empty string."},
          {"string", "help", "Its help text, or an empty string."},
          {"string?", "of", "The parameter of the mesh or head that it lies on."}}},
    };
}

}  // namespace lissom::lua
