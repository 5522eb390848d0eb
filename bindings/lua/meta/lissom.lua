---@meta lissom
-- Made from the registration table; do not edit.

---Three numbers: {x, y, z}.
---@alias lissom.Vector number[]

---Elements that an error is about.
---@class lissom.Elements
---@field kind string vertex, edge, face, corner, component or line.
---@field count integer How many there are.
---@field ids integer[]|integer[][] The first hundred; pairs of vertices for edges.

---An axis-aligned box.
---@class lissom.Bounds
---@field min lissom.Vector Smallest coordinates.
---@field max lissom.Vector Greatest coordinates.
---@field center lissom.Vector The middle.
---@field diagonal number Length of the diagonal.

---A point of a surface.
---@class lissom.SurfacePoint
---@field position lissom.Vector The point.
---@field face integer The face that contains it.
---@field vertex integer The nearest vertex of its triangle.
---@field triangle integer[] Vertices of the triangle of the face that contains it.
---@field bary number[] Its barycentric coordinates in that triangle.
---@field normal lissom.Vector Unit normal of the triangle; zero for a triangle without area.
---@field distance number Distance from the query point, or along the ray.

---Differences of a surface from its rest, at every vertex.
---@class lissom.Distortion
---@field stretch lissom.Buffer Length of the edge that changed most, over its length at rest: 1 as at rest.
---@field area lissom.Buffer Area of the faces around it, over their area at rest.
---@field angle lissom.Buffer Greatest change of a corner's angle, in degrees.
---@field flips lissom.Buffer Number of flipped faces around it.
---@field flipped integer[] Faces that look against the faces around them, and did not at rest.

---A point of a path.
---@class lissom.PathPoint
---@field position lissom.Vector The point.
---@field parameter number Fraction of the path's length up to it, 0 to 1.
---@field segment integer It lies between this point of the path and the next.
---@field distance number Distance from the query point.

---Result of closing a hole.
---@class lissom.FillReport
---@field loop_size integer Vertices around the hole.
---@field first_vertex integer The first new vertex.
---@field vertex_count integer New vertices; their ids follow each other.
---@field first_face integer The first new face.
---@field face_count integer New faces; their ids follow each other.
---@field parts integer Parts that the loop was divided into.
---@field folded_edges integer Edges of the patch that turn by more than 150 degrees.
---@field limit_reached boolean Refinement ended at maximum_vertices.

---Description of an attribute.
---@class lissom.AttributeInfo
---@field name string Its name.
---@field domain string vertex, corner or face.
---@field width integer Numbers an element.
---@field type string Number type in files: float32, uint8, ...
---@field count integer Elements.

---The state of a mesh.
---@class lissom.Check
---@field vertices integer Number of vertices.
---@field edges integer Number of edges.
---@field faces integer Number of faces.
---@field components integer Connected components, vertices without faces included.
---@field boundaries integer Open boundaries.
---@field genus integer Handles of the surface, summed over the components.
---@field euler integer V - E + F over vertices that have faces.
---@field closed boolean No open boundary.
---@field manifold boolean Every vertex has one fan of faces.
---@field triangles boolean All faces are triangles.
---@field isolated_vertices integer[] Vertices without faces.
---@field zero_area_faces integer[] Faces without area.

---One finding of a report.
---@class lissom.Finding
---@field kind string Kind of the finding: vertices_welded, edges_nonmanifold, ...
---@field count integer Number of elements or items.
---@field summary string The same in a few words.
---@field message string|nil Details, if any.
---@field element string|nil Element that the ids number: vertex, edge, face or component.
---@field of string|nil file if the ids are those of the file, mesh if they are the mesh's.
---@field ids integer[]|nil The elements; edges are pairs of vertex ids.

---Findings as a list, and each under the name of its kind.
---@class lissom.Report
---@field [integer] lissom.Finding The findings in order.
---@field vertices_welded lissom.Finding|nil Merged with another vertex at the same place.
---@field vertices_unreferenced lissom.Finding|nil Used by no face; dropped.
---@field corners_repeated lissom.Finding|nil Faces that name a vertex twice in a row; the repeats were dropped.
---@field faces_collapsed lissom.Finding|nil Faces with fewer than three different vertices; dropped.
---@field faces_pinched lissom.Finding|nil Faces that pass a vertex twice; split there.
---@field faces_duplicate lissom.Finding|nil Copies of other faces; dropped.
---@field faces_flipped lissom.Finding|nil Faces that ran against their neighbours; turned over.
---@field edges_nonmanifold lissom.Finding|nil Edges where more than two faces meet; cut open between the pieces.
---@field edges_unorientable lissom.Finding|nil Edges cut open because no turning of faces makes both sides agree.
---@field vertices_nonmanifold lissom.Finding|nil Vertices where separate fans of faces touch; each fan got one of its own.
---@field faces_zero_area lissom.Finding|nil Faces without area; kept.
---@field faces_sliver lissom.Finding|nil Triangles with an angle below one degree; kept.
---@field components_small lissom.Finding|nil Components with less than a thousandth of the largest one's area; kept.
---@field components_inverted lissom.Finding|nil Closed components that face inward; kept.
---@field points_only lissom.Finding|nil The file has no faces; its points were kept.
---@field indices_dangling lissom.Finding|nil References to texture coordinates or normals that do not exist.
---@field values_not_finite lissom.Finding|nil Attribute values that were NaN or infinite; dropped.
---@field content_skipped lissom.Finding|nil Content of the file that a mesh has no place for.
---@field files_missing lissom.Finding|nil Textures and other files that were not found.
---@field extensions_dropped lissom.Finding|nil Extensions of the format that are not understood; dropped.

---The last result of a deformation beside its rest shape; tostring gives it in words.
---@class lissom.DeformReport
---@field stretch number The greatest factor by which an edge is longer or shorter than at rest; 1 is none.
---@field stretched integer[]|nil The vertices of that edge; nil if none changed.
---@field flipped integer[] Faces that look against those around them, and did not at rest.
---@field crossings integer|nil Pairs of faces that intersect and did not at rest; if asked for.
---@field volume_change number|nil Volume over that at rest, less 1; nil without one.
---@field tears table[] Places at which handles nearly touch and tear the surface, the worst first: `vertices`, a pair that different handles hold, and `slip`, how far they part in lengths of the edges between.
---@field warnings lissom.DeformWarning[] The harms that a user would see.

---Pairs of faces that intersect, as a list of {face, face}, the lower first, in ascending order.
---@class lissom.Contacts
---@field faces integer[] Their faces, ascending.
---@field region lissom.Region The vertices of these faces, for pictures.

---The end of a drag that stops at contacts.
---@class lissom.ContactStop
---@field share number The share of the way that the handles went, 0 to 1.
---@field contacts lissom.Contacts The pairs of faces that meet a thousandth of the way further; none if share is 1.

---Contacts that a solve pushed apart.
---@class lissom.AvoidedContacts
---@field before integer The number of pairs without pushing.
---@field contacts lissom.Contacts The pairs that are left.
---@field rounds integer Rounds of pushing, 0 to 3.

---A harm that a deformation did to the surface.
---@class lissom.DeformWarning
---@field kind string torn: handles that nearly touch go different ways; stretched: edges become more than 3 times as long or short as the handles ask for; folded: faces look against their neighbours; crossing: the surface runs through itself, if that was asked for; volume: it is a quarter smaller than the handles ask for, or three quarters larger.
---@field message string Its measure and a remedy.
---@field vertices integer[]|nil Tears between handles: pairs of vertices, at most 50.
---@field edges integer[]|nil Edges, as pairs of vertices, at most 50.
---@field faces integer[]|nil Faces, at most 100.

---Sizes and times of the last preparation of a deformation.
---@class lissom.DeformStats
---@field region_vertices integer Vertices of the region.
---@field free_vertices integer Those that no constraint holds.
---@field constrained_vertices integer Those that one holds.
---@field handles integer Handles.
---@field displaced_vertices integer Degenerate vertices displaced.
---@field extended_vertices integer Flat vertices with an unknown beside them.
---@field inserted_vertices integer Vertices inserted at corners of the boundary.
---@field subdivided_vertices integer Vertices that a refinement of coarse borders added.
---@field level_vertices integer Vertices of the thinned surface; 0 without levels.
---@field zero_area_faces integer Faces without area.
---@field first_nonzeros integer Entries of the first system's factor.
---@field second_nonzeros integer Entries of the second system's factor.
---@field factor_bytes integer Bytes of both factors.
---@field assemble_seconds number Time to assemble the systems.
---@field first_factor_seconds number Time to factor the first.
---@field second_factor_seconds number Time to factor the second.
---@field basis_seconds number Time to compute the handle basis.
---@field factorizations integer Factorisations so far: dragging adds none.

---The first system's solution as a linear function of the handles: vertex v is at fixed(v) plus, for each handle, its 3 x 4 transform times the four weights of v.
---@class lissom.HandleBasis
---@field vertices integer[] Vertices of the region; one row of each buffer.
---@field handles lissom.Handle[] The handles, in the order of `weights`.
---@field weights lissom.Buffer[] For each handle four numbers a vertex.
---@field fixed lissom.Buffer The part that no handle moves: three numbers a vertex.

---The declaration of a parameter.
---@class lissom.ParamSchema
---@field name string Its name.
---@field type string number, integer, boolean, string, choice, file, folder, mesh, region, boundary, curve or head.
---@field default any Its default; nil if it must be given.
---@field value any Its present value.
---@field min number? Smallest value.
---@field max number? Greatest value.
---@field step number? Step of a slider.
---@field choices string[]? The values of a choice.
---@field unit string Its unit, or an empty string.
---@field group string Heading that it stands under, or an empty string.
---@field help string Its help text, or an empty string.
---@field of string? The parameter of the mesh or head that it lies on.

---Raised by everything that fails. tostring gives the message, and so does `..`; two are equal only if they are the same.
---@class lissom.Error
---@field message string The fault and a remedy, a sentence.
---@field code string Its [code](codes.md): "file_not_found", ...
---@field elements lissom.Elements? The elements concerned.
---@field file string? The file that was to be read or written.
---@field line integer? The line of that file.
---@field place string? File and line of the script: "bend.lua:3".

---The lines of a cut on the part that is kept, as a list.
---@class lissom.CutLines
---@field [integer] lissom.Path With the surface on its left; closed unless it ends at open boundaries.
---@field b lissom.Path[] The same lines on the rest: from the same points, the other way.
---@field others lissom.Path[]|nil For a preview: other lines of the plane, which would not be cut.
---@field report lissom.CutReport Measures and warnings.

---Report of a cut.
---@class lissom.CutReport
---@field warnings lissom.CutWarning[] Reasons why the result may not be the intended one.
---@field touched_boundaries integer[] Open boundaries that lines end at: places in mesh:boundaries() of before.
---@field lines_left integer Lines in which the plane crosses too, not cut.
---@field whole_components integer Components that went to one part as a whole.
---@field kept_fraction number Part of the mesh's area, 0 to 1, on the side of the lines that is kept.
---@field slid_vertices integer[] Vertices of before that slid onto a line.
---@field divided_faces integer Faces that were divided.

---Reason why the result of a cut may not be the intended one.
---@class lissom.CutWarning
---@field kind string touches_boundary: a line ends at an open boundary; folded_line: a line seems to run over a fin or limb; lines_nearby: the plane crosses the mesh nearby too; keeps_most: a plane or path without a seed keeps more than 80 % of the area, perhaps the wrong part; several_outlines: a region was cut along more than one line; not_separating, of a preview: the cut would fail, its sides are connected.
---@field message string The finding and a remedy.
---@field vertices integer[] Vertices at the place, of the mesh before, at most 100.

---Report of smoothing a boundary.
---@class lissom.TrimReport
---@field before number Mean turn of the boundary before, in degrees.
---@field after number Mean turn of the new one.
---@field smoothing number The smoothing used: less than asked for if the boundary turns too sharply.
---@field removed_faces integer Faces that are gone.
---@field divided_faces integer Faces that were divided.

---A surface as charts in the unit square.
---@class lissom.UnwrapReport
---@field charts integer Number of charts; they are numbered from the largest on.
---@field coverage number Part of the square that they cover.
---@field side number Side of the square, in lengths of the mesh.
---@field mean_stretch number Mean of the factors by which lengths change most at a point; 1 for none.
---@field stretch number The greatest of them but for a fiftieth of the area.
---@field seam_length number Length of the seams on the surface.
---@field flipped integer[] Faces that are turned over.

---Quality of a map into the plane.
---@class lissom.ParameterizeReport
---@field method string Method that made it: lscm if arap turned faces over at once.
---@field iterations integer Iterations of arap that are in it.
---@field energy number[] For arap, before the first iteration and after each that was made: the mean squared distance of the map's derivative from a rotation.
---@field flipped integer[] Faces that are turned over.
---@field degenerate integer[] Faces that have hardly an area on the mesh.
---@field min_scale number Least factor by which it changes a length, in lengths of the mesh.
---@field max_scale number The greatest.
---@field crossings integer Pairs of boundary edges that cross in the plane.
---@field boundaries integer Boundaries of the faces.

---The motion of one surface onto another.
---@class lissom.AlignReport
---@field matrix number[][] The motion, as rows {x, y, z, shift}.
---@field scale number Factor by which it scaled the mesh.
---@field residual_before number RMS distance between the surfaces before, over the part that they both have.
---@field residual number The same now.
---@field greatest number Greatest of those distances.
---@field iterations integer Steps made.
---@field converged boolean Whether the last step hardly moved the mesh.

---An element that another comes from.
---@class lissom.Origin
---@field side string source or target.
---@field target integer|nil Number of the target.
---@field vertex integer|nil A vertex of that mesh.
---@field face integer|nil A face of that mesh.
---@field weight number Its part of all.

---Visibility of seams; angles in degrees.
---@class lissom.SeamQuality
---@field max_dihedral number The greatest angle between faces across a seam.
---@field rms_dihedral number Their root mean square, weighted by edge length.
---@field max_near number The greatest angle on and next to a seam.
---@field smallest_angle number The smallest angle of a triangle at a seam; 0 without any.
---@field low_angle number The 5th percentile of the triangles' smallest angles.

---Measures of sewing.
---@class lissom.SeamReport
---@field inserted_into_target integer Vertices of the source inserted into its faces.
---@field inserted_into_source integer The other way round.
---@field snapped integer Pairs of vertices that became one because they were close.
---@field collapsed integer Short edges of the source's boundary that became a vertex.
---@field flipped integer Edges flipped to avoid slivers.
---@field band_removed integer Faces of the target that the band replaced.
---@field band_added integer Faces that the band added.
---@field smoothed integer Umbrella steps that were made.
---@field collar_removed integer Faces that collars took the place of.
---@field collar_added integer Triangles of the collars.
---@field before lissom.SeamQuality Before collars and smoothing.
---@field after lissom.SeamQuality The final quality.
---@field region lissom.Region The vertices of the seams and their neighbours: mesh:set_region shows them by name.

---Report of one join; angles in degrees.
---@class lissom.JoinReport
---@field source_size integer Vertices of the source's boundary as it was joined.
---@field target_size integer Vertices of the target's.
---@field scale number Growth of the source there, as a factor.
---@field placed string Criterion of the source's rotation: keys, as placed, directions or shape.
---@field guessed boolean The shapes decided, or directions that contradict each other.
---@field certainty number|nil For a guess: the probability, 0 to 1, that it is right; below .75 give a key.
---@field any_turn boolean The parts are round: no turn is better than another.
---@field turn table Rotation of the source from its given place: axis, a unit vector, and angle in degrees.
---@field key number[][]|nil A point of the source's boundary and the point of the target's that it meets: keys = { key } makes the same result. nil in the thesis's transition.
---@field source_turn number Mean turn of the source's boundary at a vertex, as given.
---@field target_turn number The same of the target's.
---@field source_trimmed boolean It was jagged and has been trimmed.
---@field target_trimmed boolean The same of the target's.
---@field subdivided boolean Faces of the source were split there.
---@field target_subdivided boolean Faces of the target were split there.
---@field fits boolean The boundaries are one curve, as they lie or, in the free configuration, up to a similarity, and the surface goes on across it: all vertices are kept there, and nothing is smoothed, trimmed or subdivided.
---@field same_side boolean In the fixed configuration: both parts lie on the same side of the boundary, so that the source turns over.
---@field band lissom.BandQuality The surface around the seam, against both sides before; zeros of a draft.

---The surface around a seam, against the parts before they were joined; angles in degrees.
---@class lissom.BandQuality
---@field roughness number The RMS angle at the edges within half a radius of the seam, weighted by length, without the seam's own.
---@field rest_roughness number The same beside both boundaries before.
---@field source_roughness number The same of the source alone.
---@field rest_source_roughness number The same of the source before.
---@field target_roughness number The same of the target alone.
---@field rest_target_roughness number The same of the target before.
---@field source_grain number `source_roughness` of the edges that turn by less than 40 degrees: between creases.
---@field rest_source_grain number The same of the source before.
---@field target_grain number The same of the target alone.
---@field rest_target_grain number The same of the target before.
---@field wrinkled number Length of the source's edges within half a radius that turn by more than 25 degrees, in radii of the seam, beyond that before.
---@field crumpled number Length of the edges of both sides within half a radius that turn by over 20 degrees more than at rest, or the other way, in radii of the seam.
---@field steep number Angle of the seam's edges that a thirtieth of its length exceeds.
---@field rest_steep number The same of the edges of the faces at the boundaries before, of the steeper side.
---@field bend number The RMS angle between planes fitted to the surface on either side of points of the seam, to strips a third of the radius wide.
---@field rest_bend number The same before on the side that bends more, from the strip at the boundary to the one behind it.
---@field max_bend number Angle that a tenth of those in `bend` exceed.
---@field rest_max_bend number Angle that a tenth of those in `rest_bend` exceed.
---@field folded number Length of the edges within one radius at which the surface folds back by more than 135 degrees, in radii of the seam.
---@field rest_folded number That of the edges of both sides before that turned by more than 105 degrees.
---@field flare number The RMS angle by which the rim of the source turns outward beside the seam more than at rest; 0 of a paste.
---@field spike number Sharpness of the sharpest tip or pit within half a radius of the seam: the greatest sum of angles missing to full turns around the vertices within .15 radii, in degrees. The corner of a cube has 90, a needle 360.
---@field rest_spike number The same of both sides before.
---@field sharpened number Length of the edges within half a radius that turn by more than 60 degrees, in radii of the seam, beyond that of the same side before: of the side that gained most.
---@field pinched number Sum of the widths, in radii of the seam, of the vertices of the source within half a radius that became thorns or pits: their neighbours slope away from them by 30 degrees more than at rest, to either side.
---@field source_volume number Volume between source and seam, over that of the source at rest at its scale: 1 if it was kept, negative if it turned inside out.
---@field target_volume number The same of the target; of a paste the share of the target's area that is left.
---@field radius number Radius of the seam.

---Reason why a merge is not good. tostring gives text and remedy.
---@class lissom.MergeReason
---@field fault string crossings, side, folds, roughness, volume, bend, flare, spike, bite, seam, place or slivers; of a scatter "left out" as well.
---@field join integer|nil The join that it is of; nil of all of them.
---@field value number Measured value: degrees for roughness, bend, flare, spike, seam and slivers; radii of the seam for folds and bites; pairs of faces for crossings; the part that was kept for volume; the certainty for place.
---@field limit number The limit that it passes.
---@field faces integer[]|nil For crossings: the faces of the merged mesh concerned.
---@field text string The fault, in plain words.
---@field remedy string The remedy.

---Loss of the target's edges that turn by more than 35 degrees, by a paste: parts of them stand out of the result, or lie below the surface still left of the target.
---@class lissom.TargetBite
---@field length number Their length, in radii of the seam.
---@field depth number Their greatest distance from the result, in these radii.

---Report of a merge.
---@class lissom.MergeReport
---@field bite lissom.TargetBite Loss of the sharp edges of its target, by a paste.
---@field ok boolean Whether the result is good: no faces run through one another that did not before, but for those that only touch; the surface around the seam does not fold back, has no sharp edges along 1.3 radii that it had not, is at most 1.4 times as rough as the parts were there (or turns by less than 8 degrees an edge), the source at most 1.6 times as it was (or by 11 degrees; merged above 14 degrees 1.4 times) and the target 1.3 times (or by 5 degrees), and bends by no more than 35 degrees from one side to the other and 60 along a tenth of it, or 1.3 times the angle before (and by the crease of a paste); the rim of the source of a merge turns outward by no more than 65 degrees more than before, or 22.5 if it crumples; no tip lacks more than 88 degrees to flat (45 beside smooth parts), or 1.35 times as many as the sharpest before; a paste takes no sharp edge of its target along more than .3 of its radius or deeper than .15; each part keeps two fifths of its volume; the seam turns by no more than 30 degrees but for a thirtieth of its length and 20 in the mean, or than the surfaces did beside the boundaries; no place is a toss; no triangle at the seam has less than 2 degrees, or than there were.
---@field verdict string The same in one line, with the reasons.
---@field reasons lissom.MergeReason[] Each fault with its measure, its limit and a remedy; empty if ok. tostring(report) lists them.
---@field joins lissom.JoinReport[] One a join.
---@field warnings string[] Points to look at, in plain words.
---@field loose_parts integer Parts of the source without a joined boundary: in the free configuration they move along with the nearest joined part.
---@field flipped table source and targets: whether they were inside out and have been turned over.
---@field seam lissom.SeamReport Measures of sewing, and the quality of the seam.
---@field transition table[] For each seam source and target: width, vertices, and flipped and unmapped ones, of its bands; its field `region` has the vertices that they moved.
---@field transition_kept number|nil The part of the way that the bands of a transition went: 0 if it was left out, since it would have folded the surface.
---@field intersections integer[][] Pairs of faces that run through one another and come from faces that did not.
---@field known_intersections integer Number of pairs of moved or made faces that come from faces that did.
---@field seams lissom.Path[] The seams on the merged mesh.
---@field source lissom.Region The vertices of the merged mesh that are the source's.
---@field target lissom.Region Those that are the targets'.
---@field provenance lissom.Provenance|nil Provenance of every element; nil for the draft of a paste.
---@field free_vertices integer Vertices of the source that moved freely.
---@field displaced_vertices integer Degenerate vertices displaced.
---@field first_factor_seconds number Time to factor the first system.
---@field second_factor_seconds number Time to factor the second.
---@field first_solve_seconds number Time to solve the first system.
---@field polar_seconds number Time for the rotations and sizes of all gradients.
---@field second_solve_seconds number Time to solve the second system.
---@field prepare_seconds number Time to check, trim and factor.
---@field solve_seconds number Time to deform and sew.

---Result of the search for the boundary.
---@class lissom.PasteSearch
---@field energy number[] Energy of the first loop and after each iteration.
---@field misfit number[] The mean difference of the loop's edges from their images, over their length.
---@field outline_energy number|nil Measures of the outline of the region, if all of it lies on the target's region.
---@field outline_misfit number|nil The same of the misfit.
---@field smooth_energy number|nil Measures of the boundary free of edges, if one was found that costs no more than the loop.
---@field smooth_misfit number|nil The same of the misfit.
---@field stop string converged, iterations or cycle: why it ended.
---@field kept_outline boolean Nothing better than the outline was found.
---@field scale number Growth of the loop, as a factor.
---@field loop_size integer Vertices of the loop.
---@field closest_rounds integer Rounds of nearest points that were kept.

---Quality of the map of a surface into the plane.
---@class lissom.PasteMapQuality
---@field method string arap, lscm or tutte.
---@field faces integer Faces that were laid out.
---@field flipped integer Faces that are turned over.
---@field flipped_fill integer Number of turned triangles in the hole of the feature.
---@field crossings integer Pairs of boundary edges that cross.
---@field min_scale number Least factor by which it changes a length.
---@field max_scale number The greatest.

---Distortion of the part's faces.
---@class lissom.PasteDistortion
---@field anisotropy number 95th percentile of greatest over least stretch of a face.
---@field energy number Mean squared difference of the stretches from 1, after scaling.
---@field faces integer Number of these faces.

---Part of a target that is removed under a part.
---@class lissom.PasteClearing
---@field faces integer Number of faces, of the target as it is split there.
---@field area number Their area.
---@field height number How far they stand out of the surface that takes their place, or are sunk in it, at most.

---Report of a draft of a paste.
---@class lissom.PasteDraft
---@field scale number Growth of the part, as a factor.
---@field smooth boolean The boundary runs through faces.
---@field kept_outline boolean It is the outline, if the surface is distorted less there.
---@field near lissom.PasteDistortion Within three rings of the boundary.
---@field laid lissom.PasteDistortion The same once the part lies on the edge of its hole.

---Report of a paste.
---@class lissom.PasteReport
---@field search lissom.PasteSearch Search for the boundary.
---@field source_map lissom.PasteMapQuality The map of the ring.
---@field target_map lissom.PasteMapQuality The map of the target's region.
---@field angle number Angle of the placement, in degrees.
---@field angle_chosen boolean It was not given, and is the best of twelve.
---@field upright boolean Neither `toward` nor an angle was given, and the part's `up` points the same way on the target, as far as the surface allows.
---@field scale number Growth of the part, as a factor.
---@field near lissom.PasteDistortion Within three rings of the boundary.
---@field laid lissom.PasteDistortion The same once the part lies on the target as it was opened.
---@field feature lissom.PasteDistortion In the feature.
---@field outline_near lissom.PasteDistortion|nil Near the outline of the region, were it the boundary.
---@field clearing lissom.PasteClearing|nil The part of the target removed under the part, if any.
---@field kept_outline boolean The outline was pasted along, since the surface there is distorted less.
---@field tight boolean The feature's own outline was pasted along, since more of the target's sharp edges stays there.
---@field draped boolean The feature stands on sharp edges of the target: it kept its shape, and its foot was drawn down to the surface.
---@field joined boolean The region had several outlines, such as those around a handle's feet: the surface between them came along with the feature, inside one outline.
---@field smooth boolean The boundary runs through faces.
---@field draft boolean It is a draft: merged without that option its seam is better.
---@field euler_characteristic integer Euler characteristic of the result.
---@field expected_characteristic integer The one expected from the target and the part.

---Report of mesh:erase.
---@class lissom.EraseReport
---@field loop lissom.Path The cut, on the mesh as it was.
---@field patch lissom.Region The patch, with its rim, on the new mesh.
---@field loop_size integer Vertices of the cut.
---@field loop_cost number Its cost; see `bend`.
---@field ring number Width around the region that was searched, in mesh units.
---@field removed_vertices integer Vertices that went.
---@field removed_faces integer Faces that went.
---@field added_faces integer Faces of the patch.
---@field continuity string Continuity of the patch: curvature or tangents.
---@field max_dihedral number The greatest angle between neighbouring faces of which one is in the patch.
---@field max_around number The same of the surface within three rings around the patch.
---@field density number Density of the patch, over that of the surface around it: 1, or up to 4 if it would have been too coarse to bend from a steep rim.
---@field ok boolean The patch turns by at most 30 degrees from face to face, or no more than the surface around it.
---@field verdict string The same in one line, with the reason.
---@field limit_reached boolean The patch has `maximum_vertices`.

---A place that was left out.
---@class lissom.RefusedPlace
---@field place integer Its number.
---@field code string Code of the failure; see lissom explain.
---@field message string Why.

---A place whose part was made smaller so that it crosses nothing.
---@class lissom.ShrunkPlace
---@field place integer Its number.
---@field scale number The scale it has.

---A place whose part was moved away from a sharp edge of the target.
---@class lissom.MovedPlace
---@field place integer Its number.
---@field at number[] {x, y, z}: its position.

---A part of a scatter that stands though it is not good.
---@class lissom.FaultyPlace
---@field place integer The number of its place.
---@field reasons lissom.MergeReason[] Why, as of a merge.

---Report of lissom.scatter. tostring gives the verdict and remedies.
---@class lissom.ScatterReport
---@field ok boolean All parts that stand are good, nothing crosses, and nine of ten places have a part.
---@field verdict string The same in one line, with the numbers of parts.
---@field reasons lissom.MergeReason[] Each kind of fault: how many parts have it, or the part of the places left out.
---@field placed integer Parts that stand.
---@field moved lissom.MovedPlace[] Places whose parts were moved, by number.
---@field faulty lissom.FaultyPlace[] Parts that stand but are not good, by number.
---@field refused lissom.RefusedPlace[] Places that were left out, by number.
---@field shrunk lissom.ShrunkPlace[] Places whose parts were made smaller, by number.
---@field crossings integer Pairs of faces that cross, of parts that were kept nevertheless.
---@field parts lissom.Region All parts, on the new mesh.
---@field place_of_face integer[] For each face the number of the place that its part was put to, or 0.
---@field rounds integer Times that parts were put into the mesh together.

---A feature to paste.
---@class lissom.Part
---@field mesh lissom.Mesh Its surface and some of that around it.
---@field region lissom.Region The region around it.
---@field feature lissom.Region|nil The feature, if it was given.
---@field up lissom.Vector The way that is up on it: y.
---@field front lissom.Vector The way that it looks: z.

---A vector that a hairstyle gives its field at a grid point.
---@class lissom.StyleConstraint
---@field point number[] {x, y, z}, in mesh units.
---@field vector number[] {x, y, z}: the field there, of length 1 at most.
---@field kind string Its source: "stream", along a stream curve; "stop", vanishing beyond its end; "parting", along the Gaussian beside a dividing curve, and "separation" above it; "section", "spine" and "gather" of a ponytail: near its cross sections, along the rest of its spine, into its tie; "scalp", of avoid_scalp.
---@field curve integer? Place of the curve among style:curves(); nil for the scalp's.
---@field weight number Weight with which it is kept.

---Sizes of a hairstyle.
---@class lissom.HairstyleStats
---@field fidelity string "default" or "thesis".
---@field curves integer Number of curves.
---@field constraints integer Constrained grid points of the last solve.
---@field grid_points integer Points of the grid.
---@field step number Distance of neighbouring grid points, in metres of an average head.

---A stroke of a brush on a scalp.
---@class lissom.ScalpMask
---@field kind string "length" or "density".
---@field points number[][] Its way, in mesh units.
---@field value number Painted value.
---@field radius number Radius of the brush, in metres of an average head.
---@field softness number The share of the radius over which it fades.

---Changes made by a comb.
---@class lissom.CombReport
---@field bent lissom.Curve[] Streams that it has bent.
---@field added lissom.Curve? The stream that it has added.
---@field before number The angle between the field and the stroke along it, root of the mean square, in degrees.
---@field after number The same afterwards.
---@field change number How much the field has changed beyond the reach of the stroke, root of the mean square; vectors near curves are of length 1.

---The tilts of a dividing curve.
---@class lissom.CurveTilt
---@field left lissom.SideTilt Tilt seen along the curve from outside.
---@field right lissom.SideTilt The other side.

---The tilt of one side of a dividing curve, in degrees.
---@class lissom.SideTilt
---@field start number At the curve's first point.
---@field finish number At its last point.
---@field pieces integer Pieces of hints, about 0.003 metres long, that told it.
---@field error number By how much these differ from it (root of mean square).

---The ring around the beginning of a ponytail.
---@class lissom.HairTie
---@field center number[] In mesh units.
---@field direction number[] Direction of the spine there, away from the head; of length 1.
---@field radius number In metres of an average head.

---Measures of strands.
---@class lissom.StrandStats
---@field strands integer Number of strands.
---@field points integer Number of points.
---@field min_points integer Fewest points of a strand.
---@field max_points integer Most points of a strand.
---@field min_length number Length of the shortest, in metres.
---@field mean_length number Mean length, in metres.
---@field max_length number Length of the longest, in metres.
---@field max_turn number Greatest angle between two segments, in degrees.
---@field max_turn_strand integer|nil The strand that has it.
---@field sharp integer Strands with a sharp turn.
---@field zero_length integer Strands without length.
---@field zero_segments integer Strands with a segment without length.
---@field not_finite integer Strands with a coordinate that is NaN or infinite.
---@field penetrating integer|nil With `style`: strands with a point inside the head.
---@field deepest number|nil With `style`: how deep the deepest is, in metres.

---The root of a strand.
---@class lissom.StrandRoot
---@field id integer Stays with the strand when some are selected.
---@field position number[] Its first point, in metres.
---@field face integer|nil The face of the head that it lies on.
---@field bary number[]|nil Weights of the vertices of `triangle`, else of the three corners of the face.
---@field triangle integer[]|nil Vertices of the triangle of the face that contains the root, on heads with polygons.
---@field uv number[]|nil Texture coordinates there.
---@field group string|nil The name of its group.
---@field guide integer|nil The id of the strand that it follows.
---@field arc number|nil The place on that guide of its tip, in metres.

---A finding in strands that were saved.
---@class lissom.StrandFinding
---@field kind string strands_too_short, points_repeated, content_dropped, ...
---@field message string The finding, and its treatment.
---@field count integer Number of strands concerned.
---@field strands integer[] The strands, the first hundred of them.

---A strand as a sum of guides.
---@class lissom.GuideWeights
---@field guides integer[] Three numbers of guides, as `guides` has them.
---@field weights number[] Their weights, which sum to 1.
---@field length number Factor of the guides' shape.
---@field root lissom.Vector Its root, in metres.

---Distances between strands and their sums of guides, in metres.
---@class lissom.GuideError
---@field rms number Root of the mean square.
---@field max number The greatest.
---@field strand integer|nil The strand that has it.

---Hair in motion against the style at rest, as seen from the head; metres.
---@class lissom.HairMotion
---@field time number Seconds since the beginning.
---@field rms number Root of the mean square of the points' distances from their places.
---@field max number The greatest of them.
---@field guide integer|nil The guide that has it.
---@field speed number Root of the mean square of the points' speeds, in m/s.
---@field stretch number Greatest change of a segment's length, as a part of it.
---@field depth number Depth of the deepest point in the body, beyond that at rest.

---All that holds guides; metres, in the space of the head.
---@class lissom.HairRig
---@field guides integer Number of guides.
---@field points integer Points of each.
---@field links integer Number of links between points of two guides.
---@field bound_links integer Those of them within bound groups.
---@field ties lissom.RigTie[] Ties with the points that they hold.
---@field capsules lissom.Capsule[] Capsules that stand for the body.
---@field capsule_cover number Part of the body around the guides that they cover.

---A tie of hair.
---@class lissom.RigTie
---@field name string Its name.
---@field center lissom.Vector Its center.
---@field radius number Its radius.
---@field points integer[] Points of guides, numbered over all of them.

---All points near a segment.
---@class lissom.Capsule
---@field a lissom.Vector One end of the segment.
---@field b lissom.Vector The other end, which may be the same.
---@field radius number Greatest distance of its points from the segment.

---Measures of cards.
---@class lissom.CardStats
---@field cards integer Number of cards.
---@field slots integer Pictures in the atlas, that of the cap among them.
---@field triangles integer Number of triangles, those of the cap among them.
---@field covered number Part of the strands' points that lie on their cards.
---@field rms number Distance of strands from the plane of their card, in metres.

---A level of detail.
---@class lissom.HairLevel
---@field kind string "strands", "cards" or "shell".
---@field group string|nil The group whose level it is.
---@field screen_size number Part of a picture's height up to which it suffices.
---@field silhouette lissom.SilhouetteError Its difference from all hair, from all sides.
---@field strands lissom.Strands|nil The strands, as wide as they cover the head.
---@field widen number|nil The factor by which they are wider.
---@field cards lissom.Cards|nil The cards.
---@field mesh lissom.Mesh|nil The shell.

---Difference of silhouettes, as a part of the silhouette of all hair.
---@class lissom.SilhouetteError
---@field mean number Over all views.
---@field worst number In one view.

---Faults of hair.
---@class lissom.StrandCheck
---@field ok boolean Whether there are no errors; warnings may remain.
---@field findings lissom.StrandFault[] Each kind of fault once.

---One kind of fault.
---@class lissom.StrandFault
---@field code string not_finite, no_length, few_points, many_points, large_group, no_widths, no_root_uvs, off_head, inside_head, duplicate_roots, wrong_unit, wrong_axis, lost_guide, short_guide or many_triangles.
---@field severity string "error", or "warning" if the target takes it.
---@field count integer Number of strands, or of triangles for many_triangles.
---@field strands integer[] The strands; empty if it is a fault of all hair.
---@field message string The fault with its limit.
---@field remedy string A call that mends it.

---Layers of hair and their operators.
---@class lissom.Groom
---@field evaluated integer Number of growths and operators that ran so far.
---@field hair fun(self: any): lissom.Strands The hair of all layers that are on, new strands. Only what follows a change is evaluated again: a curve, an option, the order, a layer below.
---@field set fun(self: any, layer: any, operator: integer, options: table): lissom.Groom Changes options of an operator. The layer by its name or number, the operator by its place.
---@field switch fun(self: any, layer: any, operator: integer?, on: boolean): lissom.Groom Switches an operator off or on, or, without one, the layer.
---@field insert fun(self: any, layer: any, operator: table, place: integer?): lissom.Groom Puts an operator before a place, or behind all.
---@field remove fun(self: any, layer: any, operator: integer): lissom.Groom Takes an operator out.
---@field grow fun(self: any, layer: any, options: table): lissom.Groom Changes options of the growth of a layer.
---@field operators fun(self: any): string[] The names of all operators, in their order.
---@field options fun(self: any, layer: any, operator: integer?): table[] Options of an operator, or without one of the growth of a layer, that a switch, a slider or a list sets: declarations as those of lissom.params, with `name` and the `value` that is set, if any; `above` if `min` itself is excluded. The layer by its name or number, the operator by its place.
---@field layer fun(self: any, layer: any): table A layer: its name, style, operators and so on.
---@field show fun(self: any, scene: lissom.Scene, name: string): lissom.Groom Adds the hair to a scene, unless it is the hair that the groom was made of. From then on the groom follows undo and redo there: its text is the comment of that hair. Styles that are objects of the scene too are undone in place, others are read from the text.
---@field update fun(self: any, step: string?): lissom.Groom Evaluates the hair in the scene, as a step with this name, "groom" by default.
---@field text fun(self: any): string The groom with its styles as JSON.
---@field save fun(self: any, path: string): lissom.Groom Writes that text: lissom.save_groom.

---An object of a scene.
---@class lissom.SceneEntry
---@field name string Its name.
---@field number integer Its number, which it keeps and which no other gets.
---@field kind string mesh, deformation, strands, hairstyle or polyline.
---@field transform number[][] Rows of the 4 x 4 matrix from its space to the scene's.
---@field visible boolean Whether it is drawn.
---@field style table Its appearance; the fields are the options of scene:set.

---A step of a scene's history.
---@class lissom.HistoryStep
---@field name string Its name.
---@field bytes integer Memory that it added to the history.

---The steps of a scene's history, oldest first.
---@class lissom.History
---@field [integer] lissom.HistoryStep The steps in order.
---@field place integer Number of those that can be undone; the others can be done again.
---@field bytes integer Memory of all steps, beside one copy of the present content.
---@field limit integer Limit of `bytes`.
---@field dropped integer Number of steps that were forgotten because of it.

---Something under a pixel. For a point or a free line the fields of surfaces are nil.
---@class lissom.PickHit
---@field kind string point, polyline, vertex, boundary, edge or face.
---@field object string? Its name in the scene, if one was given.
---@field mesh lissom.Mesh? The mesh of a surface.
---@field index integer Number of the point, vertex, face or strand; of the loop in mesh:boundaries(); of the curve in its hairstyle.
---@field position lissom.Vector The point in the world.
---@field normal lissom.Vector? Unit normal in the world; at vertices and edges the mean of the faces around.
---@field face integer? The face at the point.
---@field triangle integer[]? Vertices of the triangle of that face that contains it.
---@field bary number[]? Its barycentric coordinates in that triangle.
---@field vertex integer? The nearest vertex of that triangle.
---@field ends integer[]? The two vertices of an edge, or of a segment of a boundary.
---@field segment integer? Segment of a line or boundary: it lies between this point and the next.
---@field along number? Place along the edge or segment, 0 to 1.
---@field depth number Along the view, in the unit of the world.
---@field pixels number From the pixel that was asked about; 0 for faces.

---Selection on one surface.
---@class lissom.Selected
---@field object string? Its name in the scene, if one was given.
---@field mesh lissom.Mesh The mesh.
---@field region lissom.Region The selected vertices, or those of the selected faces.
---@field faces integer[] The selected faces; empty for a selection of vertices.
---@field unseen lissom.Region Vertices inside the shape that are not seen; empty for a selection of faces.

---A line that a hand drew, at even steps.
---@class lissom.DrawnStroke
---@field points lissom.Vector[] In the world, one for each pixel; empty if it is on nothing. Over a scalp by the envelope they begin at the hair: the pixels before that have none, or a point comes before the first.
---@field pixels number[][] On the picture, {x, y}.
---@field corners integer[] Places of corners in `pixels`.
---@field times number[] Time of each pixel.
---@field pressures number[] Pressure of each pixel.
---@field click boolean Whether the pen only touched the picture.
---@field beside integer Number of points that lay beside the supporting surface that was drawn on; their depth is a guess.

---Reading of a hint stroke.
---@class lissom.HintReading
---@field operation string "cut", "concatenate" or "insert".
---@field sure boolean False if a slightly different stroke has another meaning: show its reading.
---@field others string[] Other readings, likelier first.
---@field pixels number Length of the curve on the picture, in logical pixels: below 120 hints are hard to tell, so ask to come nearer.

---A point of a supporting surface.
---@class lissom.SupportPoint
---@field position lissom.Vector The point.
---@field distance number From the ray's origin.
---@field along number Arc length along the curve, more than its length beyond it.
---@field across number The way from the curve.

---Motion of a drag. `matrix` is all of it, as handle:set_matrix takes it; mesh:transform takes its parts if the axes are the world's.
---@class lissom.GizmoMotion
---@field kind string move, rotate or scale.
---@field part string The part that is held.
---@field translation lissom.Vector? Translation of a move.
---@field axis lissom.Vector? Axis of a turn; unit length.
---@field angle number? Angle of a turn, in degrees; counts full turns.
---@field factors lissom.Vector? Factors of scaling, along the gizmo's axes.
---@field about lissom.Vector Former position of the gizmo: the centre of turns and scaling.
---@field matrix number[][] All of it as the rows of a 4 x 4 matrix of the world.
---@field amounts number[] The value for set_amount: a length, degrees or a factor, or two lengths in a plane.

---Shape to draw.
---@class lissom.GizmoShape
---@field lines lissom.GizmoLine[] Polylines.
---@field points lissom.GizmoPoint[] Disks.
---@field part string? The part that is highlighted.

---A polyline of a gizmo.
---@class lissom.GizmoLine
---@field part string The part that it belongs to.
---@field role string x, y, z or view.
---@field color number[] {red, green, blue} in sRGB, each 0 to 1.
---@field highlighted boolean Held or under the pixel.
---@field points lissom.Vector[] In the world.
---@field closed boolean The last point is joined to the first.
---@field width number Pixels.

---A disk of a gizmo.
---@class lissom.GizmoPoint
---@field part string The part that it belongs to.
---@field role string x, y, z or view.
---@field color number[] {red, green, blue} in sRGB, each 0 to 1.
---@field highlighted boolean Held or under the pixel.
---@field position lissom.Vector In the world.
---@field radius number Pixels.

---A stroke for `hairstyle:sketch`, a click, or a key.
---@class lissom.SketchStroke
---@field tool string|table? Name of the tool, "stream", "parting", "ponytail", ..., or a tool.
---@field points number[][]? Pixels {x, y} from press to release; a single one is a click.
---@field key string? A key in place of points, as "tab".
---@field camera lissom.Camera? The camera that the head is seen by, in mesh units.
---@field params table? Values of the tool's parameters, by name.
---@field shift boolean? Held down during this stroke; false by default.
---@field ctrl boolean? The same.
---@field alt boolean? The same.

---Result of a stroke of `hairstyle:sketch`.
---@class lissom.Sketched
---@field tool string The tool that it was drawn with.
---@field added lissom.Curve[] New curves of the style.
---@field changed boolean Whether the style is another than before.

---Calls tools with a hand's input.
---@class lissom.ToolHost
---@field scene lissom.Scene The scene that the tools work on.
---@field camera lissom.Camera The camera that it is seen by.
---@field size integer[] {width, height} of the picture in pixels.
---@field tool table? The present tool.
---@field use fun(self: any, tool: table?, word: string?): lissom.ToolHost Another tool, or none; `word` is its word in a recording, if that is not its name.
---@field look fun(self: any, camera: lissom.Camera, size: integer[]?): lissom.ToolHost Another camera and size of the picture.
---@field press fun(self: any, event: lissom.MouseEvent): lissom.ToolHost A button went down: a step of the scene begins.
---@field move fun(self: any, event: lissom.MouseEvent): lissom.ToolHost The cursor moved: a drag while a button is down.
---@field release fun(self: any, event: lissom.MouseEvent): lissom.ToolHost The button came up: the step ends.
---@field click fun(self: any, event: lissom.MouseEvent): lissom.ToolHost Press and release.
---@field wheel fun(self: any, event: lissom.WheelEvent): lissom.ToolHost The wheel turned: part of the gesture while a button is down, else a step of its own.
---@field tick fun(self: any, event: lissom.ClockEvent): lissom.ToolHost Time passed while a button is down: part of the gesture.
---@field key fun(self: any, event: lissom.KeyEvent): lissom.ToolHost A key was pressed.
---@field type fun(self: any, text: string): lissom.ToolHost A key for each character.
---@field set fun(self: any, values: table): lissom.ToolHost Sets parameters of the tool.
---@field cancel fun(self: any): lissom.ToolHost Escape: takes the present gesture back; the tool forgets its beginnings.
---@field undo fun(self: any): string? The scene's undo, which a running gesture only cancels; the name of the step.
---@field redo fun(self: any): string? The scene's redo.
---@field show fun(self: any, name: string, visible: boolean): lissom.ToolHost Shows or hides an object: a step of its own.
---@field draw fun(self: any): lissom.ToolMarks Marks of the tool over the picture.
---@field prompt fun(self: any): string? The question to the person, or the tool's help.
---@field record fun(self: any, open: string[]?): lissom.ToolHost Begins a recording, before a tool is used; `open` names the files of the scene.
---@field recording fun(self: any): string The text of the recording: a script that does all again.
---@field keep_journal fun(self: any, open: string[]?): lissom.ToolHost Begins a journal: the calls that the tools make; `open` as for record.
---@field journal_text fun(self: any): string The journal: a script of calls that makes the same scene, to be read and changed.
---@field recover fun(self: any): lissom.ToolHost Takes back the changes of a tool that was stopped from outside, for instance by a limit of instructions.

---An event of a mouse.
---@class lissom.MouseEvent
---@field x number From the left edge of the picture.
---@field y number From the top of the picture.
---@field button string? The button, left if it is left out; of a press.
---@field pressure number? Of a pen, 0 to 1; 1 if it is left out, as a mouse has none.
---@field late boolean? Whether a later place of the same drag is known already; of a move.
---@field shift boolean? Whether this key is down.
---@field ctrl boolean? Likewise.
---@field alt boolean? Likewise.

---Motion of the wheel: part of the gesture while a button is down, else a step of its own.
---@class lissom.WheelEvent
---@field x number From the left edge of the picture.
---@field y number From the top of the picture.
---@field lines number Turn of the wheel: upwards is above 0.
---@field shift boolean? Whether this key is down.
---@field ctrl boolean? Likewise.
---@field alt boolean? Likewise.

---Time that passed while a button is down.
---@class lissom.ClockEvent
---@field seconds number Time since the last tick, or since the press.

---A key that was pressed.
---@class lissom.KeyEvent
---@field key string "enter", "escape", "a", ...
---@field shift boolean? Whether this key is down.
---@field ctrl boolean? Likewise.
---@field alt boolean? Likewise.

---Argument of a tool's functions.
---@class lissom.ToolEvent
---@field x number? Pixels from the left edge of the picture.
---@field y number? Pixels from its top.
---@field start number[]? Pixel at which the button went down, {x, y}.
---@field button string? left, right or middle.
---@field pressure number Of a pen, 0 to 1; 1 of a mouse.
---@field key string? The key, of key.
---@field lines number? Turn of the wheel, of wheel: upwards is above 0.
---@field seconds number? Time since the last tick, of tick.
---@field parameter string? The parameter that was set, of changed.
---@field shift boolean Whether this key is down.
---@field ctrl boolean Likewise.
---@field alt boolean Likewise.
---@field late boolean? For drag, a later place of the same drag is known already: a slow tool takes this one, and leaves out marks that only show until then.
---@field camera lissom.Camera The camera that the scene is seen by.
---@field scene lissom.Scene The scene.
---@field size integer[] {width, height} of the picture in pixels.
---@field up "y"|"z" The axis of the world that points up in views.
---@field ray fun(self: any): any Origin and direction, as camera:ray.
---@field hit fun(self: any): lissom.PickHit? The surface under the cursor.
---@field pick fun(self: any, options: table?): lissom.PickHit? camera:pick of the scene at the cursor.
---@field select fun(self: any, options: table): lissom.Selected[] camera:select of the scene.
---@field look fun(self: any, camera: lissom.Camera) From now on the scene is seen by this camera; no step of the scene.

---Marks of a tool, as the tables it was drawn with.
---@class lissom.ToolMarks
---@field points table[] Balls.
---@field lines table[] Lines in the world.
---@field labels table[] Text at points.
---@field outlines table[] Lines in the picture.
---@field circles table[] Circles in the picture.
---@field regions table[] Coloured vertices.
---@field surfaces table[] Surfaces between two lines.
---@field meshes table[] Meshes that are not in the scene.

---An oriented 2-manifold of polygons, with or without boundary. Vertices and faces count from 1.
---@class lissom.Mesh
---@operator len: integer
local Mesh = {}

---Number of vertices.
---@return integer count # Number of vertices.
function Mesh:vertex_count() end

---Number of faces.
---@return integer count # Number of faces.
function Mesh:face_count() end

---The axis-aligned box around all vertices.
---@return lissom.Bounds bounds # The box.
function Mesh:bounds() end

---RMS distance of the surface to its centroid: the length that default lengths derive from. Turning the mesh does not change it.
---@return number size # In the mesh's unit.
function Mesh:size() end

---Area of the surface.
---@return number area # In the mesh's unit squared.
function Mesh:area() end

---Enclosed volume, positive if the faces look outward. Open boundaries count as closed by cones to their mean points.
---@return number volume # In the mesh's unit cubed.
function Mesh:volume() end

---Handles of the surface, summed over its components.
---@return integer genus # 0 for a sphere, 1 for a torus.
function Mesh:genus() end

---Number of connected components. A vertex without faces is one of its own.
---@return integer count # Number of components.
function Mesh:components() end

---Whether the mesh has no open boundary.
---@return boolean closed # False if there is a boundary.
function Mesh:is_closed() end

---Whether every vertex has exactly one fan of faces. Faces are always manifold; vertices without faces make it false.
---@return boolean manifold # False if a vertex has no face.
function Mesh:is_manifold() end

---Counts, and the ids of elements that may cause trouble.
---@return lissom.Check report # The findings.
function Mesh:check() end

---The pairs of faces that meet other than at a vertex or an edge that both have, in ascending order. Faces that touch or lie on one another count; vertices at one place count as one.
---@return integer[][] pairs # Two faces each, the lower number first.
function Mesh:self_intersections() end

---Hash of positions, faces, attributes, labels and regions, to the bit: the same on every machine.
---@return string hash # 16 hexadecimal digits.
function Mesh:hash() end

---Position of a vertex.
---@param vertex integer Id of the vertex.
---@return number x
---@return number y
---@return number z
function Mesh:position(vertex) end

---Moves a vertex and returns the mesh.
---@param vertex integer Id of the vertex.
---@param position lissom.Vector Its position: three numbers or {x, y, z}.
---@return lissom.Mesh mesh # The mesh itself.
---@overload fun(self: lissom.Mesh, vertex: integer, x: number, y: number, z: number): lissom.Mesh
function Mesh:set_position(vertex, position) end

---Unit normal of the surface at a vertex, from the faces around it; zero if they have no area.
---@param vertex integer Id of the vertex.
---@return number x
---@return number y
---@return number z
function Mesh:normal(vertex) end

---The vertices of a face, counter-clockwise seen from outside.
---@param face integer Id of the face.
---@return integer[] vertices # Their ids.
function Mesh:face(face) end

---The vertices of all faces.
---@return integer[][] faces # For each face the ids of its vertices.
function Mesh:faces() end

---The vertices that an edge joins to a vertex, counter-clockwise.
---@param vertex integer Id of the vertex.
---@return integer[] vertices # Their ids.
function Mesh:neighbors(vertex) end

---Adds the vertices and faces of another mesh after its own, unconnected, with all attributes, groups and regions. A part without colors becomes white, one without texture coordinates gets 0, 0; a warning in the log names them. Other attributes have no value there (NaN).
---@param other lissom.Mesh The mesh to add.
---@return lissom.Mesh mesh # The mesh itself.
function Mesh:append(other) end

---Splits every polygon into triangles; vertices stay.
---@return lissom.Mesh mesh # The mesh itself.
function Mesh:triangulate() end

---Turns the surface inside out: reverses all faces and normals.
---@return lissom.Mesh mesh # The mesh itself.
function Mesh:flip() end

---@class lissom.Mesh.TransformOptions.Rotate
---@field axis "x"|"y"|"z"|lissom.Vector Axis of the rotation.
---@field angle number Angle, counter-clockwise seen against the axis. In degrees.
---@field about? lissom.Vector A point on the axis. Default: the option `about`.

---@class lissom.Mesh.TransformOptions
---@field translate? lissom.Vector Added last. In mesh units. Default: {0, 0, 0}.
---@field rotate? lissom.Mesh.TransformOptions.Rotate Applied after the scale. Default: none.
---@field scale? number|lissom.Vector Factor for all axes, or one for each; applied first. Default: 1.
---@field about? lissom.Vector The point that scale and rotation keep. Default: the origin.

---Scales, then rotates, then translates all vertices. A mirroring scale also reverses the faces, so that they go on looking outward.
---@param options? lissom.Mesh.TransformOptions
---@return lissom.Mesh mesh # The mesh itself.
function Mesh:transform(options) end

---@class lissom.Mesh.SmoothOptions
---@field iterations? integer Number of steps. Default: 10.
---@field strength? number Fraction of the way to the mean of its neighbours that a vertex moves in a step. Default: 0.5.
---@field weights? "uniform"|"cotangent" Weights of the neighbours: uniform ones also even out the spacing, cotangents keep it. Default: "uniform".
---@field boundary? "fixed"|"along" Vertices on open boundaries stay, or are smoothed along their loop. Default: "fixed".
---@field keep_volume? boolean Follows each step by one outwards (Taubin 1995). Default: false.
---@field region? lissom.Region Vertices that may move. Default: all.

---Smooths the surface by explicit Laplacian steps. Normals turn with it.
---@param options? lissom.Mesh.SmoothOptions
---@return lissom.Mesh mesh # The mesh itself.
function Mesh:smooth(options) end

---A copy with all attributes, groups and regions.
---@return lissom.Mesh copy # The new mesh.
function Mesh:copy() end

---@class lissom.Mesh.SubdivideOptions
---@field scheme? "midpoint"|"loop"|"catmull_clark" midpoint keeps the shape; the others smooth it. Default: "midpoint".
---@field region? lissom.Region Splits the faces of this region only. Triangles beside it are divided at their common edges, and polygons take the new vertices in, so that the mesh stays watertight. Default: all.

---A finer mesh. Old vertices keep their ids.
---@param levels? integer Number of times that each face is split. Default: 1.
---@param options? lissom.Mesh.SubdivideOptions
---@return lissom.Mesh mesh # The new mesh.
---@overload fun(self: lissom.Mesh, options: lissom.Mesh.SubdivideOptions): lissom.Mesh
function Mesh:subdivide(levels, options) end

---The faces of a region with their vertices as a mesh of their own.
---@param region lissom.Region A region of this mesh.
---@return lissom.Mesh part # The new mesh.
---@return integer[] map # For each of its vertices the vertex of the old mesh.
function Mesh:extract(region) end

---The mesh without the faces of a region, as a new mesh.
---@param region lissom.Region A region of this mesh.
---@return lissom.Mesh part # The new mesh.
---@return integer[] map # For each of its vertices the vertex of the old mesh.
function Mesh:remove(region) end

---The point of the surface nearest to a given one.
---@param point lissom.Vector Three numbers or {x, y, z}.
---@return lissom.SurfacePoint found # The nearest point.
---@overload fun(self: lissom.Mesh, x: number, y: number, z: number): lissom.SurfacePoint
function Mesh:nearest(point) end

---The first point of the surface that a ray hits, on either side.
---@param origin lissom.Vector Start of the ray.
---@param direction lissom.Vector Direction of the ray; any length.
---@return lissom.SurfacePoint? hit # The point; nil if the ray misses.
---@overload fun(self: lissom.Mesh, origin_x: number, origin_y: number, origin_z: number, direction_x: number, direction_y: number, direction_z: number): lissom.SurfacePoint?
function Mesh:pick(origin, direction) end

---@class lissom.Mesh.DistancesOptions
---@field from integer|lissom.Region|table Start of distances: a vertex, a region, a list of vertices, or a point {x, y, z}, of which the nearest on the surface counts, also a result of Mesh:nearest and Mesh:pick. Three whole numbers above 0 may be vertices or a point: write { vertices = {a, b, c} } or { point = {x, y, z} }.
---@field method? "heat"|"front"|"edges" Geodesic by the heat method, which prepares a mesh once and is fast from then on; geodesic by an advancing front, which needs no preparation; or along edges. Default: "heat".

---Distance of every vertex over the surface to the nearest of the given vertices, or to a point; infinite for vertices without a path.
---@param options lissom.Mesh.DistancesOptions
---@return lissom.Buffer distances # One number a vertex.
function Mesh:distances(options) end

---Stretch, shear and folds of this mesh, compared with another shape of it, as numbers of the vertices that lissom.render draws in colours: lissom.render{ mesh = mesh, scalars = mesh:distortion(rest).area, ... }.
---@param rest lissom.Mesh A mesh with the same faces, such as a copy from before.
---@return lissom.Distortion found # Numbers of the vertices.
function Mesh:distortion(rest) end

---@class lissom.Mesh.SaveOptions
---@field normals? boolean Write the normals of the surface, one a vertex, for a mesh without the attribute "normal". STL has those of its triangles in any case. Default: false.
---@field compression? "none"|"meshopt"|"draco" Compression of .glb and .gltf: "meshopt" (EXT_meshopt_compression) of all vertices, morph targets and indices, "draco" (KHR_draco_mesh_compression). Vertices and faces keep their order, but for vertices of objects that have several materials under "draco". Default: "none".
---@field quantize? integer Bits of positions in a .glb or .gltf file, relative to the size of the object: 14 keep a 16000th. Texture coordinates have as many, and directions half as many but at least 8; so have morph targets. Without compression they are integers (KHR_mesh_quantization), but for positions, if these are as fine and the numbers lie from -1 to 1. Default: all numbers are kept.
---@field up? "y"|"z" The up axis that the file shall have. Default: as it is.
---@field unit? number Length of the file's unit in the unit of the mesh: positions are divided by it. In mesh units. Default: 1.
---@field binary? boolean Binary or text, for .ply and .stl. Default: true.
---@field endianness? "little"|"big" Byte order of a binary .ply. Default: "little".
---@field origin? "keep"|"auto" "auto" moves the file's origin into a mesh that is farther from it than it is large, so that 32-bit numbers (.glb, .gltf, binary .stl) can hold its detail. glTF keeps the place in its nodes; for other formats it is returned. Default: "keep".

---Writes the mesh to a file, whole or not at all.
---@param path string The file; its extension names the format.
---@param options? lissom.Mesh.SaveOptions
---@return lissom.Mesh mesh # The mesh itself.
---@return lissom.Vector? origin # With origin = "auto": the point of the mesh that is the origin of the file, zero if it stayed or glTF keeps it.
function Mesh:save(path, options) end

---Elements that were welded, split, dropped, flagged or left out when the mesh was loaded: a list of findings, each also under the name of its kind. Empty for a mesh that was made otherwise.
---@return lissom.Report report # The findings.
function Mesh:report() end

---@class lissom.Mesh.DecimateOptions
---@field faces? integer Number of faces wanted; give this or `error`, or both. Default: no limit.
---@field error? number Greatest error of one collapse: the root of the mean squared distance to the planes of the faces that it replaces. In mesh units. Default: no limit.
---@field region? lissom.Region Only faces of this region change. Default: all.
---@field crease? number Edges whose faces' normals differ by more than this are lines that are kept; 180 for none. In degrees. Default: 180.
---@field attributes? number A difference as great as the range of an attribute counts as this part of the mesh's size; 0 looks at the shape alone. Default: 0.1.
---@field keep_borders? boolean Vertices of open borders stay. Default: false.

---A mesh with fewer faces for nearly the same surface: edges collapse, those first that change shape and attributes the least (quadrics). Polygons are triangulated. Open borders, seams of texture coordinates, outlines of groups, materials and named regions stay lines; morph targets and skins are carried. If those lines need more faces than were wanted, there are more.
---@param options? lissom.Mesh.DecimateOptions
---@return lissom.Mesh mesh # The new mesh.
---@return number error # Greatest error of a collapse.
function Mesh:decimate(options) end

---@class lissom.Mesh.RemeshOptions
---@field edge? number Length of edges; the longest where they adapt. In mesh units. Default: the mean of the mesh.
---@field error? number Edges are shorter where the surface is curved, so that they stay this near to it. In mesh units. Default: all edges alike.
---@field shortest? number Shortest edge where they adapt. In mesh units. Default: an eighth of `edge`.
---@field region? lissom.Region Only faces of this region change, and not its outline. Default: all.
---@field crease? number Edges whose faces' normals differ by more than this are lines that are kept; 180 for none. In degrees. Default: 40.
---@field iterations? integer Rounds of splits, collapses, flips and moves. Default: 8.

---The surface with triangles of even size and shape: long edges are split, short ones collapse, others flip, and vertices move along the surface. Open borders, seams, outlines of groups, materials and named regions, creases and their corners stay. Attributes are those of the nearest point of the old surface.
---@param options? lissom.Mesh.RemeshOptions
---@return lissom.Mesh mesh # The new mesh.
function Mesh:remesh(options) end

---@class lissom.Mesh.SymmetrizeOptions.Plane
---@field point lissom.Vector A point of the plane.
---@field normal lissom.Vector Towards the half that is kept.

---@class lissom.Mesh.SymmetrizeOptions
---@field plane lissom.Mesh.SymmetrizeOptions.Plane The plane of symmetry.
---@field weld? number Vertices of open borders this near to the plane are on it. In mesh units. Default: a hundredth of the mean edge.

---The half on one side of a plane with its mirror image, welded along the plane. A mesh that crosses the plane is cut; one that only reaches it is a half model. Texture coordinates are those of the half, morph targets are mirrored.
---@param options lissom.Mesh.SymmetrizeOptions
---@return lissom.Mesh mesh # The new mesh.
---@return integer[] mirror # For each vertex its mirror image; itself on the plane.
function Mesh:symmetrize(options) end

---@class lissom.Mesh.ThickenOptions
---@field thickness number Thickness of the shell. In mesh units.
---@field outside? number Part of the thickness that lies outside the surface. Default: 0.
---@field check? boolean Whether faces that run through one another are searched for. Default: true.

---A solid shell around the surface, for printing: a second side inside, with rims along open borders. The vertices and faces of the surface come first, then those of the inner side in the same order, then the rims. A closed surface becomes hollow.
---@param options lissom.Mesh.ThickenOptions
---@return lissom.Mesh mesh # The new mesh.
---@return integer[][] crossings # Pairs of faces that run through one another and did not before.
function Mesh:thicken(options) end

---@class lissom.Mesh.OffsetOptions
---@field distance number Distance outwards; inwards if it is negative. In mesh units.
---@field check? boolean Whether faces that run through one another are searched for. Default: true.

---Moves the surface along its normals, so that its faces move evenly.
---@param options lissom.Mesh.OffsetOptions
---@return lissom.Mesh mesh # The mesh itself.
---@return integer[][] crossings # Pairs of faces that run through one another and did not before.
function Mesh:offset(options) end

---@class lissom.Mesh.AlignOptions
---@field to lissom.Mesh The surface that it is put onto.
---@field start? "placed"|"axes" Begins as the meshes lie, or with the centroids and principal axes on each other, whatever the meshes' places. Default: "placed".
---@field scale? boolean Scales the mesh too. Default: false.
---@field overlap? number Part of the surfaces that both have. Default: 1.
---@field samples? integer Points on each surface that are used. Default: 2000.
---@field iterations? integer Greatest number of steps. Default: 60.

---Moves the mesh onto another surface as nearly as it fits (iterated closest points), and tells how near that is.
---@param options lissom.Mesh.AlignOptions
---@return lissom.Mesh mesh # The mesh itself.
---@return lissom.AlignReport report # The motion and how near it comes.
function Mesh:align(options) end

---The positions as a typed buffer without a copy: x, y, z of vertex 1, of vertex 2, and so on.
---@return lissom.Buffer positions # Three numbers a vertex.
function Mesh:positions() end

---The attributes of the mesh.
---@return lissom.AttributeInfo[] attributes # In the order they were added.
function Mesh:attributes() end

---The numbers of an attribute as a typed buffer without a copy. A NaN means that an element has no value.
---@param name string Name of the attribute: "uv", "normal", "color", ...
---@return lissom.Buffer? buffer # Its numbers.
function Mesh:attribute(name) end

---@class lissom.Mesh.Add_attributeOptions
---@field name string Its name. "uv", "normal" and "color" have a meaning in files.
---@field domain? "vertex"|"corner"|"face" The elements that it is on. Default: "vertex".
---@field width? integer Numbers an element. Default: 1.
---@field type? "float32"|"float64"|"int8"|"uint8"|"int16"|"uint16"|"int32"|"uint32" Number type in files. Default: "float32".
---@field values? number|number[] The numbers. Default: 0.

---Adds an attribute, in place of one of the same name.
---@param options lissom.Mesh.Add_attributeOptions
---@return lissom.Buffer buffer # Its numbers.
function Mesh:add_attribute(options) end

---Removes an attribute.
---@param name string Name of the attribute.
---@return boolean removed # False if there was none.
function Mesh:remove_attribute(name) end

---@class lissom.Mesh.RegionOptions.Sphere
---@field center lissom.Vector Its center.
---@field radius number Its radius. In mesh units.

---@class lissom.Mesh.RegionOptions.Box
---@field min? lissom.Vector Smallest coordinates; nil or math.huge for an open side. Default: no limit.
---@field max? lissom.Vector Greatest coordinates; nil or math.huge for an open side. Default: no limit.

---@class lissom.Mesh.RegionOptions.Fraction
---@field min? lissom.Vector Smallest fractions; nil or math.huge for an open side. Default: no limit.
---@field max? lissom.Vector Greatest fractions; nil or math.huge for an open side. Default: no limit.

---@class lissom.Mesh.RegionOptions.Plane
---@field point lissom.Vector A point of the plane.
---@field normal lissom.Vector Points to the side that is selected.

---@class lissom.Mesh.RegionOptions.Geodesic
---@field from integer|lissom.Region|table Start of distances: a vertex, a region, a list of vertices, or a point {x, y, z}, of which the nearest on the surface counts, also a result of Mesh:nearest and Mesh:pick. Three whole numbers above 0 may be vertices or a point: write { vertices = {a, b, c} } or { point = {x, y, z} }.
---@field radius number Distance over the surface. In mesh units.

---@class lissom.Mesh.RegionOptions
---@field sphere? lissom.Mesh.RegionOptions.Sphere Vertices within a sphere.
---@field box? lissom.Mesh.RegionOptions.Box Vertices within an axis-aligned box, its sides included.
---@field fraction? lissom.Mesh.RegionOptions.Fraction Vertices within a box in fractions of the mesh's bounds: 0 is the least coordinate of an axis, 1 the greatest.
---@field plane? lissom.Mesh.RegionOptions.Plane Vertices on one side of a plane, the plane included.
---@field geodesic? lissom.Mesh.RegionOptions.Geodesic Vertices within a distance over the surface.
---@field vertices? integer[] These vertices.
---@field group? string Vertices of the faces of a group.
---@field material? string Vertices of the faces of a material.
---@field component? integer Vertices of a connected component, numbered by smallest vertex.
---@field attribute? table {name, min, max}: vertices whose first number of an attribute lies in the range.
---@field where? fun(vertex: integer, x: number, y: number, z: number): boolean Vertices for which the function returns true.
---@field all? boolean true: all vertices.

---A region by its name, or the vertices that one of the options selects.
---@param name? string Name of a region that is kept with the mesh.
---@param options? lissom.Mesh.RegionOptions
---@return lissom.Region region # The region, maybe empty.
---@overload fun(self: lissom.Mesh, options: lissom.Mesh.RegionOptions): lissom.Region
function Mesh:region(name, options) end

---Keeps a region under a name, in place of one before, and returns the mesh. Named regions are saved in formats that can hold them.
---@param name string Its name.
---@param region lissom.Region A region of this mesh.
---@return lissom.Mesh mesh # The mesh itself.
function Mesh:set_region(name, region) end

---Forgets a named region.
---@param name string Its name.
---@return boolean removed # False if there was none.
function Mesh:remove_region(name) end

---The names of the mesh's groups of faces, for region{ group = }.
---@return string[] names # In the order of the file.
function Mesh:groups() end

---The names of its materials, for region{ material = }.
---@return string[] names # In the order of the file.
function Mesh:materials() end

---The names of the regions that are kept with the mesh.
---@return string[] names # In alphabetical order.
function Mesh:regions() end

---The open boundaries, ordered by their smallest vertex.
---@return lissom.Path[] boundaries # Closed paths with the surface on their left.
function Mesh:boundaries() end

---@class lissom.Mesh.PathOptions
---@field points lissom.Vector[]|integer[] Points to visit.
---@field closed? boolean Returns to the first. Default: false.

---The shortest line along edges that visits the given vertices in order.
---@param options lissom.Mesh.PathOptions
---@return lissom.Path path # The line.
function Mesh:path(options) end

---@class lissom.Mesh.FillOptions
---@field method? "angle"|"area" Begins with the triangles whose greatest angle to one another and to the mesh is least, or with those of the least area, a lid. Default: "angle".
---@field subdivide? boolean Makes the patch as dense as the mesh around it. Default: true.
---@field density? number Its density over that of the mesh around it; more than 1 lets a patch bend whose rim has few vertices. Default: 1.
---@field fair? boolean Bends the patch to continue the surface smoothly. Default: true.
---@field continuity? "tangents"|"curvature" Order of continuity of a faired patch with the surface. With curvature a large patch in a round surface is round. Default: "tangents".
---@field maximum_vertices? integer Vertices that `subdivide` may insert. Default: 200000.

---Closes an open boundary by a patch of triangles that continues the surface, in place. Old ids stay.
---@param boundary lissom.Path An open boundary of this mesh.
---@param options? lissom.Mesh.FillOptions
---@return lissom.Mesh mesh # The mesh itself.
---@return lissom.FillReport report # The added elements.
function Mesh:fill(boundary, options) end

---Joins two open boundaries by a strip of triangles between their vertices, in place: two parts become one, holes on both sides of a part a tunnel. Boundaries are matched by arc length at their closest points. All ids stay; a triangle has the groups and attributes of the face at its boundary edge.
---@param a lissom.Path An open boundary of this mesh.
---@param b lissom.Path Another one.
---@return lissom.Mesh mesh # The mesh itself.
---@return integer first_face # The first of the triangles.
---@return integer face_count # Their number; they are the last of all faces.
function Mesh:bridge(a, b) end

---@class lissom.Mesh.CutOptions.Plane
---@field point lissom.Vector A point of the plane; the line nearest to it is cut.
---@field normal lissom.Vector Towards the part to keep.
---@field seed? lissom.Vector A point on or near the part to keep, instead of the normal's side.
---@field near? lissom.Vector Point that selects the nearest line, instead of the plane's point.
---@field loops? "nearest"|"all" The line nearest to the point, or all lines of the plane. Default: "nearest".

---@class lissom.Mesh.CutOptions
---@field plane? lissom.Mesh.CutOptions.Plane Cuts by a plane; other crossings of the plane with the mesh stay whole.
---@field path? lissom.Vector[]|lissom.Path Cuts along a smooth line near a closed path; the part on its left is kept.
---@field region? lissom.Region Cuts along all outlines of a region, which is kept.
---@field seed? lissom.Vector A point on or near the part to keep, for a plane or path.
---@field smoothing? number The line along a path or outline is smoothed over two edges around, but no more than this fraction of its length. Default: 0.04.
---@field slide? number A vertex slides onto the line if that crosses one of its edges within this fraction of the edge, so that no slivers appear. Default: 0.25.
---@field preview? boolean Cuts nothing and returns the lines alone: those that would be cut, as free paths with the kept part on their left, and in their fields `others`, lines in which the plane crosses too, and `report`. Default: false.

---Cuts the mesh in two along a smooth line through its faces: by exactly one of plane, path and region. Attributes are interpolated; vertices and faces off the line stay as they are. The mesh itself is not changed.
---@param options? lissom.Mesh.CutOptions
---@return lissom.Mesh a # The part that is kept; with `preview` the lines alone.
---@return lissom.Mesh b # The rest.
---@return lissom.CutLines loops # The lines on both parts, and a report.
function Mesh:cut(options) end

---@class lissom.Mesh.EraseOptions
---@field ring? number Distance from the region within which the mesh may be cut, in radii of the region's outline. 0: along the outline itself. Default: 0.5.
---@field bend? number Cost of a cut through bent surface: an edge costs its length times 1 + bend R k, with the outline's radius R and k the sum of both principal curvatures, without signs. 0: the shortest loop. Default: 1.
---@field continuity? "tangents"|"curvature" Continuity of the patch with the surface around it: curvature if that is even around the cut, else tangents. Default: "curvature".
---@field maximum_vertices? integer Vertices that the patch may have. Default: 200000.

---A new mesh without the marked feature: it is cut along the least-cost loop around the region, which runs over even surface, and closed by a patch that continues the surface. The feature may have handles and open boundaries. Everything outside the loop keeps its values to the bit; labels, colours and texture coordinates are continued over the patch.
---@param region lissom.Region The feature to remove, marked casually.
---@param options? lissom.Mesh.EraseOptions
---@return lissom.Mesh mesh # The mesh without the feature.
---@return lissom.EraseReport report # Measures of the result.
function Mesh:erase(region, options) end

---@class lissom.Mesh.CloneOptions
---@field from lissom.Region Part of the surface around the feature.
---@field to lissom.Vector The middle of the feature comes to lie on the point of the mesh that is nearest to this.
---@field feature? lissom.Region|"auto" See lissom.paste. Default: auto.
---@field toward? "x"|"y"|"z"|lissom.Vector The way on the target that `up` of the source is to point, as far as both lie in the surfaces. Default: the same as `up`.
---@field up? "x"|"y"|"z"|lissom.Vector The direction of the source that belongs to it. Default: y.
---@field angle? number Turns the part about the surface's normal, counter-clockwise seen from outside, from `toward`. In degrees. Default: 0, or the best of twelve if `up` does not lie in the surfaces and `toward` is not given.
---@field scale? number Size of the part on the target over its size on the source. Default: 1.
---@field offset? number[] {x, y}: moves the part in the plane of the target's map, in lengths of the target; the way of placing of thesis 3.4.1. Default: {0, 0}.
---@field clear? boolean|lissom.Region Removes the target's features under the part first, as mesh:erase does: those under the part's boundary and nothing beyond it, or a region of the target with a ring around it. paste:clearing() shows them before. Default: false.
---@field ring? number Share of the region that is searched if no feature is given. Default: 0.5.
---@field normals? number Weight of the normals in the energy of a boundary. Default: 0.
---@field smooth? integer Umbrella steps at the seam, at most, as in lissom.merge. Default: 3.
---@field collar? boolean Makes faces anew beside the seam if one side is coarser. Default: true.
---@field intersections? boolean Looks for faces that run through one another and did not before. Default: true.
---@field size? "boundary"|"lock" Size of the part: that of its boundary on the target, which depends on the loop, or the placement's scale. Default: "boundary".
---@field compare? boolean Tries variants that may distort the surface near the boundary less, and takes the best: ARAP iterations of the part; the outline of the region; and, once `optimize` was called and by nearest points, a boundary that slides over the target towards the relaxed position of the part. Default: true.
---@field mend? boolean Fairs the places beside the seam at which a side became crumpled. If the verdict still finds fault with the surface there, tries a fair seam, a transition and, with `compare`, other boundaries, and keeps the result with fewest faults; a warning says so. Not without smoothing or collar. Default: true.

---A new mesh that has a feature of this one twice: it is pasted onto another place of the same mesh, along the loop around it that fits best (lissom.paste with itself as target).
---@param options lissom.Mesh.CloneOptions
---@return lissom.Mesh mesh # The mesh with both.
---@return lissom.MergeReport report # The report of lissom.merge; its field `paste` is a lissom.PasteReport.
function Mesh:clone(options) end

---@class lissom.Mesh.UnwrapOptions
---@field stretch? number Greatest factor by which a length may change, for all but a fiftieth of a chart's area: more charts for less. Default: 1.3.
---@field crease? number How much seams prefer creases to short ways. Default: 1.
---@field gap? number Space between two charts, as a part of the square's side: 4 / 1024 are four pixels of a texture with 1,024. Default: 0.00390625.
---@field attribute? string Attribute for the coordinates: "uv", "uv2", or a name of your own. Default: "uv".
---@field charts? string Attribute of faces for the numbers of their charts. Default: none.

---Cuts the whole surface into charts that lie flat with little stretch, and packs them into the unit square as texture coordinates, in place of those it had. Seams keep to creases; open meshes, handles and several parts are welcome.
---@param options? lissom.Mesh.UnwrapOptions
---@return lissom.Mesh mesh # The mesh itself.
---@return lissom.UnwrapReport report # Charts and their quality.
function Mesh:unwrap(options) end

---@class lissom.Mesh.ParameterizeOptions
---@field region? lissom.Region Its faces are laid out: one part without handles, with at least one boundary. Default: the whole mesh.
---@field method? "lscm"|"arap"|"tutte" lscm keeps angles; arap, from lscm, angles and lengths, as far as no face is turned over; tutte covers a disk and never turns a face over. Default: "arap".
---@field attribute? string Attribute for the coordinates: "uv", "uv2", or a name of your own. Default: "uv".
---@field placement? "unit_square"|"as_is" Fitted into the square from 0 to 1, or in lengths of the mesh around the origin. Default: "unit_square".
---@field iterations? integer Iterations of arap at most. Default: 20.
---@field close_holes? boolean Closes every boundary but the longest by triangles that are part of the map and not of the result, so that the boundaries do not cross. Default: true.

---Lays the surface, or a region of it, out in the plane, and keeps the place of each corner as texture coordinates. Other corners keep theirs.
---@param options? lissom.Mesh.ParameterizeOptions
---@return lissom.Mesh mesh # The mesh itself.
---@return lissom.ParameterizeReport report # Quality of the map.
function Mesh:parameterize(options) end

---Frees the contents of the object. It may be called again; any other use is an error then.
function Mesh:close() end

---A set of vertices of one version of a mesh's topology. After a change of the topology it is an error to use it.
---@class lissom.Region
---@operator len: integer
local Region = {}

---Vertices in this region or the other.
---@param other lissom.Region A region of the same mesh.
---@return lissom.Region region # A new region.
function Region:union(other) end

---Vertices in this region but not in the other.
---@param other lissom.Region A region of the same mesh.
---@return lissom.Region region # A new region.
function Region:minus(other) end

---Vertices in both regions.
---@param other lissom.Region A region of the same mesh.
---@return lissom.Region region # A new region.
function Region:intersect(other) end

---Vertices that are not in this region.
---@return lissom.Region region # A new region.
function Region:invert() end

---This region and rings of neighbours around it.
---@param rings? integer Number of rings of neighbours. Default: 1.
---@return lissom.Region region # A new region.
function Region:grow(rings) end

---This region without the vertices within so many edges of a vertex outside. Open boundaries of the mesh do not count as outside.
---@param rings? integer Number of rings of neighbours. Default: 1.
---@return lissom.Region region # A new region.
function Region:shrink(rings) end

---@class lissom.Region.ConnectedOptions
---@field at integer|lissom.Vector A vertex of the region, or a point, of which the region's nearest vertex counts.

---The part of this region that is connected with a point, by edges between the region's vertices.
---@param options lissom.Region.ConnectedOptions
---@return lissom.Region region # A new region.
function Region:connected(options) end

---A smoother outline by majority vote over one-rings; specks and pinholes go.
---@param iterations? integer Number of votes. Default: 3.
---@return lissom.Region region # A new region.
function Region:smooth(iterations) end

---Whether a vertex is in the region.
---@param vertex integer Id of the vertex.
---@return boolean inside # True if it is.
function Region:contains(vertex) end

---Mean of the positions of the region's vertices.
---@return lissom.Vector center # {x, y, z}.
function Region:center() end

---The axis-aligned box around the region's vertices.
---@return lissom.Bounds bounds # The box.
function Region:bounds() end

---The region's vertices.
---@return integer[] vertices # Their ids, ascending.
function Region:vertices() end

---The faces that have all their vertices in the region.
---@return integer[] faces # Their ids, ascending.
function Region:faces() end

---The loops around the region's faces, each in the direction of those faces.
---@return lissom.Path[] loops # Closed paths.
function Region:boundaries() end

---The mesh that the region belongs to.
---@return lissom.Mesh mesh # The mesh.
function Region:mesh() end

---Frees the contents of the object. It may be called again; any other use is an error then.
function Region:close() end

---A line through vertices of one version of a mesh's topology, open or closed. A boundary is a closed path around a hole, with the surface on its left. The preview of a cut returns lines through points of their own, without vertices.
---@class lissom.Path
---@operator len: integer
local Path = {}

---The vertices in order; the first of a closed path is not repeated.
---@return integer[] vertices # Their ids.
function Path:vertices() end

---The positions of its vertices in order.
---@return lissom.Vector[] points # A list of {x, y, z}.
function Path:points() end

---Length of the line.
---@return number length # In the mesh's unit.
function Path:length() end

---The point of the line nearest to a given one.
---@param point lissom.Vector Three numbers or {x, y, z}.
---@return lissom.PathPoint found # The nearest point.
---@overload fun(self: lissom.Path, x: number, y: number, z: number): lissom.PathPoint
function Path:nearest(point) end

---@class lissom.Path.SmoothOptions
---@field iterations? integer Number of steps. Default: 10.
---@field strength? number Fraction of the way to the middle of its neighbours that a vertex moves in a step. Default: 0.5.

---Smooths the line by moving the mesh's vertices under it, and returns the path. Ends of open paths stay.
---@param options? lissom.Path.SmoothOptions
---@return lissom.Path path # The path itself.
function Path:smooth(options) end

---Whether its end is joined to its start.
---@return boolean closed # True for a boundary.
function Path:is_closed() end

---Whether it is one of the open boundaries of the mesh.
---@return boolean boundary # In either direction.
function Path:is_boundary() end

---The same line run the other way.
---@return lissom.Path path # A new path.
function Path:reversed() end

---The region of its vertices.
---@return lissom.Region region # A new region.
function Path:region() end

---The mesh that it runs on.
---@return lissom.Mesh mesh # The mesh.
function Path:mesh() end

---@class lissom.Path.TrimOptions
---@field smoothing? number Smoothing: standard deviation of the Gaussian that smooths the loop, as a fraction of its length. Default: 0.04.
---@field margin? number Distance of the new boundary from the innermost vertex of the old one, in edge lengths. Default: 0.15.
---@field slide? number A vertex slides onto the line if that crosses one of its edges within this fraction of the edge, so that no slivers appear. Default: 0.25.

---Makes a jagged open boundary smooth, in place: cuts a thin strip of the mesh off along a smooth line just inside. Paths and regions of before are then of an older topology.
---@param options? lissom.Path.TrimOptions
---@return lissom.Path boundary # The new boundary of the mesh.
---@return lissom.TrimReport report # Measures of the cut.
function Path:trim(options) end

---Mean angle by which the line turns at its points: small for a smooth one, 30 degrees and more for one along the edges of triangles.
---@return number angle # In degrees.
function Path:mean_turn() end

---Frees the contents of the object. It may be called again; any other use is an error then.
function Path:close() end

---Numbers of the kernel, read and written in place. It keeps its mesh alive and refuses to work once the mesh has another topology.
---@class lissom.Buffer
---@field [integer] number
---@operator len: integer
local Buffer = {}

---Numbers a row: 3 for positions.
---@return integer width # Numbers a row.
function Buffer:width() end

---Number of rows: of vertices, corners or faces.
---@return integer rows # Number of rows.
function Buffer:count() end

---The numbers of a row, as several results.
---@param row integer Number of the row: the id of its vertex, corner or face.
---@return number ... # Numbers of the row, as many as the buffer is wide.
function Buffer:get(row) end

---Writes a row and returns the buffer.
---@param row integer Number of the row: the id of its vertex, corner or face.
---@param values number[] Numbers, as many as the buffer is wide.
---@return lissom.Buffer buffer # The buffer.
function Buffer:set(row, values) end

---The address of the numbers, doubles in rows, for LuaJIT's ffi. It is valid until the mesh's topology or attributes change. Call `changed` after writing.
---@return lightuserdata address # Address of the first number.
function Buffer:pointer() end

---@class lissom.Buffer.Write_floatsOptions
---@field offset? integer Bytes from the address to the first row. Default: 0.
---@field stride? integer Bytes from one row to the next, if other data stands between them; without it they follow each other.

---Writes all numbers into memory of the host as floats of 32 bits, row after row, as graphics cards take them: of a mapped buffer, or LÖVE's `data:getPointer()` and `data:getSize()`. Nothing is written after an error.
---@param address lightuserdata Address of the first row.
---@param size number Bytes that may be written from there on.
---@param options? lissom.Buffer.Write_floatsOptions
---@return lissom.Buffer buffer # The buffer.
function Buffer:write_floats(address, size, options) end

---Tells the mesh that numbers were written through `pointer`, and checks them.
---@return lissom.Buffer buffer # The buffer.
function Buffer:changed() end

---All numbers as one list.
---@return number[] numbers # A copy of the numbers.
function Buffer:table() end

---Frees the contents of the object. It may be called again; any other use is an error then.
function Buffer:close() end

---Deforms a region of a mesh by handles. Its rest shape is the mesh as it was when the deformation was made; its factors are kept, so that moving a handle costs no factorisation.
---@class lissom.Deformer
local Deformer = {}

---@class lissom.Deformer.Add_handleOptions.Mirror
---@field point lissom.Vector A point of the plane.
---@field normal lissom.Vector Its normal, of any length.
---@field tolerance? number Distance of the mirror image from the surface beyond which mirror_residual warns. In mesh units. Default: a fiftieth of the size.

---@class lissom.Deformer.Add_handleOptions
---@field position? boolean Holds their positions. Default: true.
---@field gradient? boolean Holds their orientation and scale. Default: true.
---@field weight? number Draws instead of holding exactly: 1 is a compromise with the shape of the surface, 1e6 nearly exact. Depends on neither scale nor resolution. Default: held exactly.
---@field falloff? number Within this geodesic distance the surface follows softly, less and less. In mesh units. Default: 0.
---@field mirror? lissom.Deformer.Add_handleOptions.Mirror Adds a second handle, the mirror image, and moves it along: see mirrored. It lies on the surface nearest to the reflected one, so that both sides may have different vertices: see mirror_residual. Default: none.

---Makes a handle of some vertices of the region, of a path, or of points of faces and edges. Points follow the handle exactly: the points of the deformed faces with the same weights do.
---@param where lissom.Region|lissom.Path|table The part that it holds.
---@param options? lissom.Deformer.Add_handleOptions
---@return lissom.Handle handle # The handle; move it and solve.
function Deformer:add_handle(where, options) end

---Holds a region in place: a handle with the identity as transform. Returns the deformer.
---@param region lissom.Region The vertices that stay.
---@return lissom.Deformer deformer # The deformer itself.
function Deformer:pin(region) end

---@class lissom.Deformer.ConstrainOptions
---@field vertex? integer A vertex.
---@field edge? integer[] The two vertices of an edge.
---@field at? number Place on the edge: 0 is its first vertex, 1 its second. Default: 0.5.
---@field face? integer A face.
---@field bary? number[] Weights of the face's corners, which sum to 1.
---@field triangle? integer[] Three vertices of the face that bary weighs instead, as nearest and pick give.
---@field position? lissom.Vector Its position. Default: free.
---@field gradient? number[][] Rows of its 3 x 3 deformation gradient. Default: free.
---@field weight? number Draws instead of holding exactly: 1 is a compromise with the shape of the surface, 1e6 nearly exact. Depends on neither scale nor resolution. Default: held exactly.

---Holds one vertex, or a point of an edge or face, in place of an earlier constraint; without position and gradient it is free again. Returns the deformation.
---@param options? lissom.Deformer.ConstrainOptions
---@return lissom.Deformer deformer # The deformer itself.
function Deformer:constrain(options) end

---Sets how much a part of the surface resists being bent and stretched: stiff parts move rigidly, soft ones take the bend.
---@param region lissom.Region The part.
---@param factor number 1 is as usual.
---@return lissom.Deformer deformer # The deformer itself.
function Deformer:stiffness(region, factor) end

---Sets the share of its volume that a twisted or bent solid keeps, in place of the option volume. It costs a frame, and no preparation.
---@param share number 0: none; 1: all.
---@return lissom.Deformer deformer # The deformer itself.
function Deformer:keep_volume(share) end

---Its handles.
---@return lissom.Handle[] handles # In the order they were made.
function Deformer:handles() end

---The region that may move.
---@return lissom.Region region # The region.
function Deformer:region() end

---The mesh that it deforms.
---@return lissom.Mesh mesh # The mesh.
function Deformer:mesh() end

---Solves the first system only and writes the result into the mesh: quick enough to follow a drag, with some shear.
---@return lissom.Mesh mesh # The mesh.
function Deformer:preview() end

---@class lissom.Deformer.SolveOptions.Pins.Plane
---@field point lissom.Vector A point of it.
---@field normal "x"|"y"|"z"|lissom.Vector Its normal.

---@class lissom.Deformer.SolveOptions.Pins.Line
---@field point lissom.Vector A point of it.
---@field direction "x"|"y"|"z"|lissom.Vector Its direction.

---@class lissom.Deformer.SolveOptions.Pins.Sphere
---@field center lissom.Vector The point that it keeps its distance from.
---@field radius number That distance. In mesh units.

---@class lissom.Deformer.SolveOptions.Pins
---@field vertex? integer The pinned vertex. Default: those of the region.
---@field region? lissom.Region Pinned vertices, each for itself. Default: the vertex.
---@field plane? lissom.Deformer.SolveOptions.Pins.Plane The plane that it slides on. Default: another place.
---@field line? lissom.Deformer.SolveOptions.Pins.Line The line that it slides on. Default: another place.
---@field sphere? lissom.Deformer.SolveOptions.Pins.Sphere The sphere that it slides on. Default: another place.

---@class lissom.Deformer.SolveOptions
---@field draft? boolean For the frames of a drag: about five digits in half the time. Solve once more when the drag ends. Default: false.
---@field stop? "contact" "contact": goes from the poses of the last solve towards the present ones, and stays, with the handles, at the last pose before faces intersect that did not at rest. A drag that begins in contact goes on while no more do. Each sample of the way takes a frame. Default: goes all the way.
---@field avoid? boolean Pushes apart parts that would run through one another, in up to three rounds: both alike unless one is held. Handles hold exactly. It takes some frames if anything meets; see `contacts` for what is left. Default: false.
---@field pins? lissom.Deformer.SolveOptions.Pins[] Vertices that slide on a place and are held there by forces square to it, in this solve: at most 512, each with one place. Handles hold exactly; places that contradict each other are kept as nearly as they can be. Not with `draft`, `stop` or `avoid`. Default: none.

---Solves both systems and writes the result into the mesh. Handles in their initial place give the rest shape, to the bit. Other changes of the region's vertices are overwritten; if the mesh around the region was moved, so that the result would tear, it is an error.
---@param options? lissom.Deformer.SolveOptions
---@return lissom.Mesh mesh # The mesh.
---@return lissom.ContactStop|lissom.AvoidedContacts|number|nil record # With `stop` how far the handles came, with `avoid` the contacts before and after, with `pins` the greatest distance of one from its place.
function Deformer:solve(options) end

---Handles and mesh go back to the rest shape, to the bit; vertex constraints go.
---@return lissom.Deformer deformer # The deformer itself.
function Deformer:reset() end

---The deformed mesh with the vertices that the deformation inserted along coarse borders of handles: behind the mesh's own, on faces that become triangles. Without such vertices it is a copy.
---@return lissom.Mesh fine # A new mesh.
function Deformer:subdivided_mesh() end

---Takes the last result as the new rest shape. Handles keep their vertices and their present places, with the identity as transform; constraints keep the present places of their points. Factors are rebuilt at the next solve, and reset returns to this shape.
---@return lissom.Deformer deformer # The deformer itself.
function Deformer:rebase() end

---Sizes and times of the last preparation.
---@return lissom.DeformStats stats # Times are in seconds, sizes in bytes.
function Deformer:stats() end

---@class lissom.Deformer.ReportOptions
---@field crossings? boolean Counts faces that run through one another, which takes longer than to solve. Default: false.

---Measures the last result beside the rest shape: stretched edges, folded faces, tears between handles that nearly touch and, on request, crossings, with a warning of each harm that a user would see.
---@param options? lissom.Deformer.ReportOptions
---@return lissom.DeformReport report # Measures, and warnings with remedies.
function Deformer:report(options) end

---The first system's solution as a linear function of the handles: data for an engine that follows a drag by itself.
---@return lissom.HandleBasis basis # Weights of every vertex for every handle.
function Deformer:basis() end

---@class lissom.Deformer.Save_basisOptions
---@field names? string[] Names of the handles, in the order of deformer:handles(): a program finds them by these. Default: that of the mesh's region with the same vertices.
---@field pose? fun(key: number, number: integer) Moves handles to a key pose from their present place; called with each number of 'keys', and with its place in the list from 1. Default: there are no key poses.
---@field keys? number[] Numbers of the key poses, at most 256 different poses; their meaning is that of 'pose'. Default: there are no key poses.

---Writes the basis to a file for a program without a solver: 4 floats a vertex and handle, relative to the middle of the region. bindings/engine/lissom_basis.h, one C header, describes the file and computes the result of preview. With key poses, 3 floats a vertex and key more, it computes the result of solve at each key, and blends between them by the turns, places and stretches of the handles; beyond the range of the keys the offsets stay. Turns are told apart up to half a turn. Handles and last result are restored afterwards.
---@param path string The file.
---@param options? lissom.Deformer.Save_basisOptions
---@return lissom.Deformer deformer # The deformer itself.
function Deformer:save_basis(path, options) end

---@class lissom.Deformer.BakeOptions.Keys
---@field time number Its time in seconds; ascending.
---@field pose lissom.Pose A pose of this deformer.

---@class lissom.Deformer.BakeOptions
---@field pose? fun(time: number, frame: integer) Moves handles; called for each frame with its time and its number from 1. Default: keys is given.
---@field keys? lissom.Deformer.BakeOptions.Keys[] Key poses, instead of a function: handles turn and shift between them as Pose:blend does. Before the first and after the last they keep still. Without duration and times the animation ends at the last. Default: pose is given.
---@field easing? "linear"|"smooth"|"slow in"|"slow out"|"step" The pace between two key poses: even; slow at both, at the first, or at the second; or the first pose until the second key. Default: "linear".
---@field duration? number Length of the animation; it starts at 0 and has a frame at its end. In seconds. Default: times are given.
---@field fps? number Frames a second. Default: 24.
---@field times? number[] Time of each frame in seconds, ascending, instead of a duration. Default: duration is given.
---@field interpolation? "linear"|"step" Between frames the surface moves along straight lines, or stays and then jumps. Default: "linear".
---@field preview? boolean Poses as preview makes them: the first system only. Default: false.
---@field normals? boolean Gives a mesh without normals those of its surface, so that light follows the motion. Default: true.
---@field tolerance? number Greatest distance of a vertex from its pose. Above 0 the targets are the principal components of the poses, as few as keep it and turn normals by about 1 degree at most: files become several times smaller. At 0 each different pose is a target. In mesh units. Default: 0.
---@field name? string Name of the animation. Default: "deformation".

---Makes an animation of a sequence of poses: a new mesh with a morph target for each different shape, which mesh:save writes as .glb or .gltf and any viewer of such files plays. For each frame the handles start from their present place, the function moves them, and the deformation is solved. Handles, mesh and last result are restored afterwards, even if the function fails.
---@param options? lissom.Deformer.BakeOptions
---@return lissom.Mesh mesh # The rest shape with its targets and the animation.
---@return table report # `keys` and `targets`, their numbers; `max_error`, the greatest distance of a vertex from its pose in mesh units; `max_direction_error`, that of a unit normal or tangent.
function Deformer:bake(options) end

---@class lissom.Deformer.Bake_textureOptions.Keys
---@field time number Its time in seconds; ascending.
---@field pose lissom.Pose A pose of this deformer.

---@class lissom.Deformer.Bake_textureOptions
---@field pose? fun(time: number, frame: integer) Moves handles; called for each frame with its time and its number from 1. Default: keys is given.
---@field keys? lissom.Deformer.Bake_textureOptions.Keys[] Key poses, instead of a function: handles turn and shift between them as Pose:blend does. Before the first and after the last they keep still. Without duration and times the animation ends at the last. Default: pose is given.
---@field easing? "linear"|"smooth"|"slow in"|"slow out"|"step" The pace between two key poses: even; slow at both, at the first, or at the second; or the first pose until the second key. Default: "linear".
---@field duration? number Length of the animation; it starts at 0 and has a frame at its end. In seconds. Default: times are given.
---@field fps? number Frames a second. Default: 24.
---@field times? number[] Time of each frame in seconds, ascending, instead of a duration. Default: duration is given.
---@field preview? boolean Poses as preview makes them: the first system only. Default: false.

---Writes a sequence of poses as a vertex animation texture: PATH_positions.png and PATH_normals.png with 16 bits a channel, a texel for each vertex and frame; PATH.glb, the mesh at rest, whose last texture coordinates are the texel of each vertex in the first frame; and PATH.json with the bounds, the times and `frame_step`, by which v goes on from frame to frame. The frames of a vertex stand below one another: a bilinear sampler blends between them. Pictures must be read as linear, without mip maps. Handles, mesh and last result are restored afterwards.
---@param path string The files without their endings.
---@param options? lissom.Deformer.Bake_textureOptions
---@return table report # `frames`; `width` and `height` of the pictures; `max_error`, the greatest distance of a vertex from its pose by 16 bits, in mesh units; `max_normal_error`, that of a unit normal.
function Deformer:bake_texture(path, options) end

---@class lissom.Deformer.SkinOptions
---@field joints? integer Joints of the skin. One of them stays if the region is a part of the mesh. Default: 8.
---@field influences? integer Joints that a vertex may follow. Default: 4.
---@field pose? fun(time: number, frame: integer) Moves handles; called for each frame with its time and its number from 1. Default: each handle is turned by the angle.
---@field duration? number Length of the animation; it starts at 0 and has a frame at its end. In seconds. Default: times are given.
---@field fps? number Frames a second. Default: 24.
---@field times? number[] Time of each frame in seconds, ascending, instead of a duration. Default: duration is given.
---@field angle? number Turn of each handle in the poses without a function. In degrees. Default: 45.
---@field preview? boolean Poses as preview makes them: the first system only. Default: false.
---@field name? string Name of the animation. Default: "deformation".

---Makes an ordinary skinned mesh of the deformation: joints that move rigidly, and weights of each vertex for a few of them, fitted to poses by least squares (Le and Deng 2012). With a function, the poses are the frames of its path and the joints are animated along it; without, each handle is turned about three axes. mesh:save writes the skin as .glb or .gltf. Handles, mesh and last result are restored afterwards.
---@param options? lissom.Deformer.SkinOptions
---@return lissom.Mesh mesh # The rest shape with the attributes "joints" and "weights", its skeleton, and the animation if there is a path.
---@return table report # `joints`, their number; `max_error` and `rms_error`, distances of the skinned vertices from the deformation's over all poses, in mesh units.
function Deformer:skin(options) end

---The pairs of faces that intersect in the last result, and did not at rest. Quick enough to follow a drag: boxes around the faces are made once, and fitted to each result.
---@return lissom.Contacts contacts # The pairs; none if the list is empty.
function Deformer:contacts() end

---The present transforms of all handles, and places of constraints, as a value.
---@return lissom.Pose pose # It stays as it is when handles move on.
function Deformer:pose() end

---Moves all handles and constraints to a pose, for the next solve. Handles that were added since the pose was taken stay.
---@param pose lissom.Pose A pose of this deformer, and of its present rest shape.
---@return lissom.Deformer deformer # The deformer itself.
function Deformer:set_pose(pose) end

---@class lissom.Deformer.Add_bonesOptions
---@field joints lissom.Vector[] Joints at rest within the surface, from the base to the tip; two at least.
---@field limits? number[] For each bone the greatest angle from its rest direction, as seen from the bone before it, in degrees. Default: no limits.
---@field share? number Part of each bone's length along which it holds the surface. Default: 0.3.
---@field radius? number Above 0 a bone holds the vertices within this distance of it, and joints may lie anywhere: for lines along a surface, such as brows and lips. In mesh units. Default: 0.

---Adds a chain of bones. Each holds the surface around its middle as a handle, and the solver finds how the rest follows: there are no weights to paint.
---@param options lissom.Deformer.Add_bonesOptions
---@return lissom.Bones bones # Turn them, then solve.
function Deformer:add_bones(options) end

---Returns the chains of bones, in the order they were added. A chain goes when one of its handles is removed; its other handles stay.
---@return lissom.Bones[] chains # The chains.
function Deformer:bones() end

---@class lissom.Deformer.AttachOptions
---@field mode? "components"|"vertices" Pieces that keep their shape: connected components, such as buttons and eyes; or none, each vertex follows the surface nearest to it, as clothes do. Default: "components".
---@field scale? boolean Whether pieces grow and shrink with the surface below them. Default: false.
---@field max_distance? number Greatest distance of a component from the surface; beyond it is an error. In mesh units. Default: the size of the surface.

---Attaches another mesh, such as buttons or clothes, to the surface as both are now. Each solve moves it along. Attached again, it takes its new place.
---@param mesh lissom.Mesh The mesh that follows.
---@param options? lissom.Deformer.AttachOptions
---@return lissom.Deformer deformer # The deformer itself.
function Deformer:attach(mesh, options) end

---Lets an attached mesh stay at its present place from now on.
---@param mesh lissom.Mesh The mesh; one that is not attached is passed over.
---@return lissom.Deformer deformer # The deformer itself.
function Deformer:detach(mesh) end

---Frees the contents of the object. It may be called again; any other use is an error then.
function Deformer:close() end

---Vertices of a deformation that follow one transform.
---@class lissom.Handle
local Handle = {}

---Moves the handle on by an offset.
---@param offset lissom.Vector Three numbers or {x, y, z}. In mesh units.
---@return lissom.Handle handle # The handle itself.
---@overload fun(self: lissom.Handle, x: number, y: number, z: number): lissom.Handle
function Handle:translate(offset) end

---@class lissom.Handle.RotateOptions
---@field about? lissom.Vector A point on the axis. Default: the handle's present center.
---@field axis? "x"|"y"|"z"|lissom.Vector Axis of the rotation.
---@field angle? number Angle, counter-clockwise seen against the axis. In degrees.

---Turns the handle on.
---@param axis "x"|"y"|"z"|lissom.Vector Axis of the rotation.
---@param angle number Angle, counter-clockwise seen against the axis. In degrees.
---@param options? lissom.Handle.RotateOptions
---@return lissom.Handle handle # The handle itself.
---@overload fun(self: lissom.Handle, options: lissom.Handle.RotateOptions): lissom.Handle
function Handle:rotate(axis, angle, options) end

---@class lissom.Handle.ScaleOptions
---@field about? lissom.Vector The point that stays. Default: the handle's present center.

---Scales the handle on.
---@param factor number|lissom.Vector Factor for all axes, or one for each.
---@param options? lissom.Handle.ScaleOptions
---@return lissom.Handle handle # The handle itself.
function Handle:scale(factor, options) end

---@class lissom.Handle.SetOptions.Rotate
---@field axis "x"|"y"|"z"|lissom.Vector Axis of the rotation.
---@field angle number Angle, counter-clockwise seen against the axis. In degrees.
---@field about? lissom.Vector A point on the axis. Default: the option `about`.

---@class lissom.Handle.SetOptions
---@field translate? lissom.Vector Added last. In mesh units. Default: {0, 0, 0}.
---@field rotate? lissom.Handle.SetOptions.Rotate Applied after the scale. Default: none.
---@field scale? number|lissom.Vector Factor for all axes, or one for each; applied first. Default: 1.
---@field about? lissom.Vector The point that scale and rotation keep. Default: the handle's center at rest.

---Sets the whole transform: scales the rest shape, then rotates, then translates it. For sliders.
---@param options? lissom.Handle.SetOptions
---@return lissom.Handle handle # The handle itself.
function Handle:set(options) end

---Sets the whole transform as a matrix. A matrix does not say how often the handle has turned round: the field `turn` that Handle:matrix gives does; without it, the turn nearest to the present one is taken.
---@param matrix number[][] Rows of a 4 x 4 matrix; maps rest positions to their new places.
---@return lissom.Handle handle # The handle itself.
function Handle:set_matrix(matrix) end

---@class lissom.Handle.FollowOptions
---@field from? number Place that the handle has at rest. Default: the nearest to its middle.
---@field twist? number Turn about the curve at that place. In degrees. Default: 0.

---Carries the handle along a smooth curve through points, turning with it and not about it. Replaces its former motion.
---@param points lissom.Vector[] Points of the curve, such as polyline:points().
---@param share number Place on the curve, as a share of its length; beyond its ends it goes on straight.
---@param options? lissom.Handle.FollowOptions
---@return lissom.Handle handle # The handle itself.
function Handle:follow(points, share, options) end

---The handle goes back to its initial place.
---@return lissom.Handle handle # The handle itself.
function Handle:reset() end

---The transform so far.
---@return number[][] matrix # Rows of a 4 x 4 matrix; its field `turn` is the rotation as {x, y, z}, axis times angle in degrees, counting full turns.
function Handle:matrix() end

---The handle's present center.
---@return lissom.Vector center # {x, y, z}.
function Handle:center() end

---The handle's vertices.
---@return lissom.Region region # The region.
function Handle:region() end

---Its mirror image, which moves along, or nil.
---@return lissom.Handle? image # The other handle.
function Handle:mirrored() end

---Measures how well both sides of the rest shape match if the handle has a mirror image: the distances of the reflected vertices from the surface, in sizes of the deformed part.
---@return table residual # {max=, mean=, warning=}; the warning, with a remedy, only if the greatest is more than the mirror's tolerance.
function Handle:mirror_residual() end

---Gives the handle other vertices. Its transform stays, and the mesh keeps the old result until the next solve.
---@param region lissom.Region Its new vertices.
---@return lissom.Handle handle # The handle itself.
function Handle:set_region(region) end

---Takes the handle out of the deformation; it cannot be used any more.
function Handle:remove() end

---Frees the contents of the object. It may be called again; any other use is an error then.
function Handle:close() end

---A chain of bones in a deformer, which keeps it: it is undone and saved with scenes. Its pose is that of its handles.
---@class lissom.Bones
---@operator len: integer
local Bones = {}

---Turns a bone, and those behind it, about its joint, within its limit. The surface follows at the next solve.
---@param bone integer Its number, from the base.
---@param axis "x"|"y"|"z"|lissom.Vector The axis, in the world.
---@param angle number The angle. In degrees.
---@return lissom.Bones bones # The bones themselves.
function Bones:turn(bone, axis, angle) end

---@class lissom.Bones.ReachOptions
---@field axis? "x"|"y"|"z"|lissom.Vector Axis about which a stretched chain bends if the target lies along it. Default: one square to it.
---@field rounds? integer Rounds over all joints, at most. Default: 200.

---Inverse kinematics: turns bones so that the tip comes to a point, or as near to it as their lengths and limits let it.
---@param target lissom.Vector The point.
---@param options? lissom.Bones.ReachOptions
---@return number distance # The distance from the tip that is left.
---@overload fun(self: lissom.Bones, x: number, y: number, z: number, options?: lissom.Bones.ReachOptions): number
function Bones:reach(target, options) end

---@class lissom.Bones.FollowOptions
---@field stretch? boolean Joints keep their shares of the length, and bones stretch along themselves to span them (a wire); no limit holds then. Default: false.
---@field twist? number Turn about the curve from the base to the tip. In degrees. Default: 0.

---Lays the chain along a smooth curve through points (spline IK): the base at its start, and bones turned least from one to the next. Lengths and limits stay; behind its end bones go on straight.
---@param points lissom.Vector[] Points of the curve, such as polyline:points().
---@param options? lissom.Bones.FollowOptions
---@return lissom.Bones bones # The bones themselves.
function Bones:follow(points, options) end

---Puts the base at a point; all bones go along as they are.
---@param base lissom.Vector The place of the first joint.
---@return lissom.Bones bones # The bones themselves.
---@overload fun(self: lissom.Bones, x: number, y: number, z: number): lissom.Bones
function Bones:move(base) end

---Puts all bones back to rest.
---@return lissom.Bones bones # The bones themselves.
function Bones:reset() end

---The joints as they are now, by the poses of the handles.
---@return lissom.Vector[] joints # From the base to the tip.
function Bones:joints() end

---The handle of a bone: the surface that it holds.
---@param bone integer Its number, from the base.
---@return lissom.Handle handle # The handle.
function Bones:handle(bone) end

---Removes the chain and its handles: the surface that they held is free.
function Bones:remove() end

---Frees the contents of the object. It may be called again; any other use is an error then.
function Bones:close() end

---Posed meshes of one topology, and their blends.
---@class lissom.PoseSpace
local PoseSpace = {}

---A blend of poses: rotations add up as rotation vectors, stretches as they are, and the surface is fitted to both. Vertices that no pose moves stay.
---@param weights table Weights of poses by name: 0 is rest, 1 the pose, others go beyond. Poses that are left out have 0.
---@return lissom.Mesh mesh # A new mesh: rest with the blended shape. Custom normals, tangents and morph targets turn along.
function PoseSpace:blend(weights) end

---@class lissom.PoseSpace.TargetsOptions
---@field correctives? table A list of weights by name of pose, as for blend: halves, pairs. Default: none.
---@field normals? boolean Gives a mesh without normals those of its surface, so that light follows. Default: true.

---The mesh at rest with a morph target for each pose, for engines that blend linearly, and correctives, which take back the error of that at chosen weights and at the meshes of a path. mesh:save writes them to .glb and .gltf. The weight of a corrective is the product over its poses, with weight w and at a, of (w - 1) / (a - 1) if a is above 1, or w above an a between 0 and 1, else of w / a; never below 0.
---@param options? lissom.PoseSpace.TargetsOptions
---@return lissom.Mesh mesh # The rest shape with its targets. Morph targets that it had are left out.
---@return table report # `targets`, a list in the order of the mesh's targets: `name`, `corrective` and `at`, its weights; `linear_error` and `error`, the greatest distances of a vertex from the blend, without and with correctives, over tenths of the way from rest to each target.
function PoseSpace:targets(options) end

---The names of the poses, in alphabetical order.
---@return string[] names # The names.
function PoseSpace:names() end

---Frees the contents of the object. It may be called again; any other use is an error then.
function PoseSpace:close() end

---Transforms of the handles of a deformer at one time.
---@class lissom.Pose
local Pose = {}

---The pose at a share of the way to another: handles turn and shift as screws, by the turns that they made, full ones too, and stretch evenly.
---@param other lissom.Pose A pose of the same deformer.
---@param share number 0 is this pose, 1 the other; others go beyond.
---@return lissom.Pose pose # A new pose.
function Pose:blend(other, share) end

---Frees the contents of the object. It may be called again; any other use is an error then.
function Pose:close() end

---A merge that is solved again, without factoring again, after its keys have moved: for a tool while the user drags a key.
---@class lissom.Merger
local Merger = {}

---Replaces the keys of one join, and returns the merge. Keys that do not fit are an error at once, and those of before stay.
---@param join integer Number of the join, from 1.
---@param keys table List of { s, t }, as in lissom.merge.
---@return lissom.Merger merger # The same merger.
function Merger:set_keys(join, keys) end

---Merges, and returns a new mesh and a report.
---@return lissom.Mesh mesh # The merged mesh.
---@return lissom.MergeReport report # Measures and results.
function Merger:solve() end

---Returns findings of the preparation, such as a thin outline that is to meet a round one; the report has them as well.
---@return string[] warnings # In plain words.
function Merger:warnings() end

---Frees the contents of the object. It may be called again; any other use is an error then.
function Merger:close() end

---Provenance of the elements of a merged mesh: elements of the source and of the targets as they were given.
---@class lissom.Provenance
local Provenance = {}

---The sources of a vertex, with weights, before it was moved: one vertex, or several for one made on an edge; on a seam those of both sides.
---@param vertex integer A vertex of the merged mesh.
---@return lissom.Origin[] origins # With weights that sum to 1.
function Provenance:vertex(vertex) end

---The face that a face comes from.
---@param face integer A face of the merged mesh.
---@return lissom.Origin[] origins # With weights that sum to 1.
function Provenance:face(face) end

---Frees the contents of the object. It may be called again; any other use is an error then.
function Provenance:close() end

---A feature of one mesh that is being put onto another: it can be moved, its boundary sought, and pasted, as often as one likes.
---@class lissom.Paste
local Paste = {}

---@class lissom.Paste.OptimizeOptions
---@field iterations? integer At most. Default: 20.

---Seeks the loop around the feature whose shape on the target differs least from its shape on the source, by turns with the similarity between both (thesis 3.4.3).
---@param options? lissom.Paste.OptimizeOptions
---@return lissom.Path loop # The boundary on the source: points of its surface, or vertices if it runs along edges.
---@return lissom.PasteSearch report # Result of the search.
function Paste:optimize(options) end

---@class lissom.Paste.MergeOptions
---@field smooth? integer Umbrella steps at the seam, at most, as in lissom.merge. Default: 3.
---@field collar? boolean Makes faces anew beside the seam if one side is coarser. Default: true.
---@field intersections? boolean Looks for faces that run through one another and did not before. Default: true.
---@field scale? "boundary"|"lock" Size of the part: that of its boundary on the target, which depends on the loop, or the placement's scale. Default: "boundary".
---@field compare? boolean Tries variants that may distort the surface near the boundary less, and takes the best: ARAP iterations of the part; the outline of the region; and, once `optimize` was called and by nearest points, a boundary that slides over the target towards the relaxed position of the part. Default: true.
---@field mend? boolean Fairs the places beside the seam at which a side became crumpled. If the verdict still finds fault with the surface there, tries a fair seam, a transition and, with `compare`, other boundaries, and keeps the result with fewest faults; a warning says so. Not without smoothing or collar. Default: true.
---@field draft? boolean For a part that is being dragged: the same place and boundary, but the part is not refined, nor does its boundary slide, the seam is sewn and no more unless faces turn over at it, whatever `smooth`, `collar` and `intersections` say, and the report has no provenance. Default: false.

---Opens the target along the loop's image and pastes the part inside the loop, deformed to fit, as a new mesh. Without `optimize` the loop is the outline of the region.
---@param options? lissom.Paste.MergeOptions
---@return lissom.Mesh mesh # The target with the feature.
---@return lissom.MergeReport report # The report of lissom.merge; its field `paste` is a lissom.PasteReport.
function Paste:merge(options) end

---@class lissom.Paste.DraftOptions
---@field scale? "boundary"|"lock" Size of the part: that of its boundary on the target, which depends on the loop, or the placement's scale. Default: "boundary".
---@field compare? boolean Takes the outline of the region if the surface is distorted less near that than near the boundary that was found. Default: true.

---The part as `merge` with `draft` has it, but alone and neither sewn nor smoothed: for a part that is shown many times a second while it is dragged. The cost does not grow with the target.
---@param options? lissom.Paste.DraftOptions
---@return lissom.Mesh mesh # The part inside the boundary, deformed onto the edge of its hole.
---@return lissom.Path boundary # Its boundary there.
---@return lissom.PasteDraft report # Measures of the draft.
function Paste:draft(options) end

---@class lissom.Paste.MoveOptions
---@field at? lissom.Vector The middle of the feature comes to lie on the point of the target that is nearest to this. Default: as it was.
---@field toward? "x"|"y"|"z"|lissom.Vector The way on the target that `up` of the source is to point, as far as both lie in the surfaces. Default: as it was.
---@field up? "x"|"y"|"z"|lissom.Vector The direction of the source that belongs to it. Default: as it was.
---@field angle? number Turns the part about the surface's normal, counter-clockwise seen from outside, from `toward`. In degrees. Default: as it was.
---@field scale? number Size of the part on the target over its size on the source. Default: as it was.
---@field offset? number[] {x, y}: moves the part in the plane of the target's map, in lengths of the target; the way of placing of thesis 3.4.1. Default: as it was.
---@field search? boolean false keeps the loop while a part is dragged, unless the outline fits better. Default: true.

---Places the feature anew, and seeks its boundary again from the former one if `optimize` was called. Options that are left out stay. If the feature does not fit there, the last good placement stays.
---@param options? lissom.Paste.MoveOptions
---@return lissom.Paste paste # The same paste.
function Paste:move(options) end

---The result of the last search for the boundary.
---@return lissom.PasteSearch report # Before `optimize`, of the loop that is used without.
function Paste:search() end

---The loop that `merge` pastes along, and its image on the target.
---@return lissom.Path loop # On the source, as by `optimize`.
---@return lissom.Path image # Points of the target's surface.
function Paste:loop() end

---The part of the target that `clear` removes under the part, on the target as it was given: to draw it, or to ask before `merge`.
---@return lissom.Region region # The vertices of the faces that go; nil if nothing goes.
---@return lissom.PasteClearing report # Its extent.
function Paste:clearing() end

---Frees the contents of the object. It may be called again; any other use is an error then.
function Paste:close() end

---The hairy part of a head, and the frame in which styles fit any head. It is that of the head's shape when it was made.
---@class lissom.Scalp
local Scalp = {}

---@class lissom.Scalp.AtOptions
---@field azimuth number 0 in front, 90 at the head's left, 180 behind. In degrees.
---@field elevation number 0 is level, 90 up. In degrees.
---@field lift? number Height above the head. In metres. Default: 0.

---Returns a point over the head, in a direction from the center of its frame.
---@param options lissom.Scalp.AtOptions
---@return number[] point # {x, y, z}, in mesh units.
function Scalp:at(options) end

---@class lissom.Scalp.Normal_atOptions
---@field azimuth number 0 in front, 90 at the head's left, 180 behind. In degrees.
---@field elevation number 0 is level, 90 up. In degrees.
---@field lift? number Height above the head. In metres. Default: 0.

---Returns the normal of the head below the point that `at` returns.
---@param options lissom.Scalp.Normal_atOptions
---@return number[] normal # {x, y, z}, outward, of length 1.
function Scalp:normal_at(options) end

---The hairy region.
---@return lissom.Region region # Vertices of the head.
function Scalp:region() end

---The mesh of the head.
---@return lissom.Mesh head # The mesh.
function Scalp:head() end

---Whether the region was guessed from an average hairline.
---@return boolean guessed # False if a region was given or named.
function Scalp:guessed() end

---Certainty of the head's place and direction of view. Making a scalp whose confidence is below 0.5 gives a warning: look at `up` and `front`, or give them, and the region.
---@return number confidence # Near 1 for a whole bald head, near 0 for masks, halves of heads, heads with modelled hair, and other shapes.
function Scalp:confidence() end

---Reason for a low confidence.
---@return string doubt # Empty if there is none.
function Scalp:doubt() end

---The center of the frame, about the middle between the ears.
---@return number[] center # {x, y, z}, in mesh units.
function Scalp:center() end

---Direction upwards.
---@return number[] direction # {x, y, z}, of length 1.
function Scalp:up() end

---Direction that the head looks in.
---@return number[] direction # {x, y, z}, of length 1.
function Scalp:front() end

---The head's left.
---@return number[] direction # {x, y, z}, of length 1.
function Scalp:left() end

---Length of a unit of the mesh.
---@return number unit # Metres in one unit of the mesh.
function Scalp:unit() end

---Whether the unit was given, or a usual one makes this the width of a head. Otherwise `unit` is that of an average head, and making the scalp gives a warning.
---@return boolean known # False for models of some other size.
function Scalp:knows_unit() end

---Size of the head: styles are made in metres of an average head.
---@return number scale # Mesh units in one metre of a style.
function Scalp:scale() end

---A point given in metres of an average head: x to the head's left, y up, z to the front of the center.
---@param point lissom.Vector Three numbers or {x, y, z}. In metres.
---@return number[] point # {x, y, z}, in mesh units.
---@overload fun(self: lissom.Scalp, x: number, y: number, z: number): number[]
function Scalp:from_metres(point) end

---A point of the mesh in metres of an average head, from the center.
---@param point lissom.Vector Three numbers or {x, y, z}. In mesh units.
---@return number[] point # {x, y, z}, in metres.
---@overload fun(self: lissom.Scalp, x: number, y: number, z: number): number[]
function Scalp:to_metres(point) end

---Frees the contents of the object. It may be called again; any other use is an error then.
function Scalp:close() end

---Style curves on a head, and the hair that follows them. It is made for the shape that the head had then. Lengths among its options are in metres of an average head, so that a style fits any head; points are in mesh units.
---@class lissom.Hairstyle
local Hairstyle = {}

---@class lissom.Hairstyle.AtOptions
---@field azimuth number 0 in front, 90 at the head's left, 180 behind. In degrees.
---@field elevation number 0 is level, 90 up. In degrees.
---@field lift? number Height above the head. In metres. Default: 0.

---Returns a point over the head, in a direction from the center of its frame.
---@param options lissom.Hairstyle.AtOptions
---@return number[] point # {x, y, z}, in mesh units.
function Hairstyle:at(options) end

---@class lissom.Hairstyle.Normal_atOptions
---@field azimuth number 0 in front, 90 at the head's left, 180 behind. In degrees.
---@field elevation number 0 is level, 90 up. In degrees.
---@field lift? number Height above the head. In metres. Default: 0.

---Returns the normal of the head below the point that `at` returns.
---@param options lissom.Hairstyle.Normal_atOptions
---@return number[] normal # {x, y, z}, outward, of length 1.
function Hairstyle:normal_at(options) end

---Its curves in their order.
---@return lissom.Curve[] curves # A list.
function Hairstyle:curves() end

---The scalp that it was made for.
---@return lissom.Scalp scalp # The scalp.
function Hairstyle:scalp() end

---The mesh of the head.
---@return lissom.Mesh head # The mesh.
function Hairstyle:head() end

---@class lissom.Hairstyle.SaveOptions
---@field head? string Path of the head's mesh as the file shall have it, best beside it. Default: none.

---Writes curves and options as JSON that people can read and edit, in metres of an average head. See `lissom.load_style`.
---@param path string The file.
---@param options? lissom.Hairstyle.SaveOptions
---@return lissom.Hairstyle style # The hairstyle itself.
function Hairstyle:save(path, options) end

---Sizes of the grid and of the system.
---@return lissom.HairstyleStats stats # Numbers.
function Hairstyle:stats() end

---@class lissom.Hairstyle.Add_streamOptions
---@field stop? boolean|number Keeps hair from growing on beyond the end of the curve, by vectors that vanish over a length. Default: true, 0.04 metres.
---@field clearance? number The curve is moved out to this height. In metres. Default: 0.004; as in the thesis 0.
---@field name? string For people, and for groups of strands.
---@field enabled? boolean Curves that are not have no effect. Default: true.
---@field weight? number Weight of the curve in the field (omega of the thesis). Default: 100.
---@field points? lissom.Vector[] From the root to the tip; the curve runs smoothly through them. In mesh units.

---Adds a stream curve: hair flows along it.
---@param points lissom.Vector[] From the root to the tip; the curve runs smoothly through them. In mesh units.
---@param options? lissom.Hairstyle.Add_streamOptions
---@return lissom.Curve curve # The curve, behind all others.
---@overload fun(self: lissom.Hairstyle, options: lissom.Hairstyle.Add_streamOptions): lissom.Curve
function Hairstyle:add_stream(points, options) end

---@class lissom.Hairstyle.Add_dividingOptions
---@field tilt? number[] {at its first point, at its last}: by how much hair on both sides is turned towards the curve's end, in degrees. Default: {0, 0}.
---@field left? number[] The same for one side, as seen along the curve from outside. Default: tilt.
---@field right? number[] The same for the other. Default: tilt.
---@field sigma? number Distance from the line to the crest of the hair. In metres. Default: a grid step.
---@field height? number h of the thesis: the crest is 0.39 times as high. In metres. Default: half a grid step.
---@field reach? number Distance from the line within which hair is shaped. In metres. Default: 2.5 sigma.
---@field thickness? number Distance above and below its line within which hair is shaped. In metres. Default: 0.8 grid steps.
---@field separation? number Magnitude of the vectors that keep both sides apart. Default: 0.3.
---@field wall_width? number Distance of these from the line. In metres. Default: 1.2 grid steps.
---@field wall_height? number Their height. In metres. Default: 2.6 grid steps.
---@field ramp? number Nearer to the line, vectors away from it fade; 0 as in the thesis. In metres. Default: 0.87 grid steps; as in the thesis 0.
---@field gap? number Width of the bare skin along the line. In metres. Default: 0.0024; as in the thesis 0.
---@field name? string For people, and for groups of strands.
---@field enabled? boolean Curves that are not have no effect. Default: true.
---@field weight? number Weight of the curve in the field (omega of the thesis). Default: 100.
---@field points? lissom.Vector[] On the scalp, or near it. In mesh units.

---Adds a dividing curve: hair parts along it. In a grid of more points the same lengths in metres mean the same style; the defaults follow the grid.
---@param points lissom.Vector[] On the scalp, or near it. In mesh units.
---@param options? lissom.Hairstyle.Add_dividingOptions
---@return lissom.Curve curve # The curve, behind all others.
---@overload fun(self: lissom.Hairstyle, options: lissom.Hairstyle.Add_dividingOptions): lissom.Curve
function Hairstyle:add_dividing(points, options) end

---@class lissom.Hairstyle.Add_ponytailOptions
---@field stop? boolean|number Keeps hair from growing on beyond the end of the curve, by vectors that vanish over a length. Default: true, 0.04 metres.
---@field radius? number Radius of the tie, the first cross section. In metres. Default: from section or profiles, else 1.5 grid steps.
---@field section? lissom.Vector[] A closed curve around the spine, seen from anywhere: the tie stands there, and is as wide as it is across the spine.
---@field profiles? table {a, b}: two lists of points along the spine on either side of the tail; its cross sections reach between them along their common part, in either direction.
---@field share? number Without profiles: how much of the spine has cross sections. Default: 0.7.
---@field fullness? number Without profiles: the tail swells to 1 + fullness radii. Default: 1.
---@field inner? number Hair is drawn into the tie from this many radii on (R1 of the thesis). Default: 1.3.
---@field outer? number And up to this many (R2). Default: 1.9.
---@field ring? number It is at least so wide. In metres. Default: 2.5 grid steps; as in the thesis 0.
---@field free? number Nearer to the head than this the tail leaves hair alone. In metres. Default: 1.5 grid steps; as in the thesis 0.
---@field lead? number The ring begins so far in front of the tie. In metres. Default: 1.5 grid steps; as in the thesis half a grid step.
---@field grip? number Strength with which the tail holds its hair together: the turn inward of vectors just outside, a grid step. 0 as in the thesis. Default: 4; as in the thesis 0.
---@field spread? number Strength with which hair spreads again behind the tie and fills the tail. 0 as in the thesis. Default: 2; as in the thesis 0.
---@field tightness? number Magnitude of the vectors that do so. Default: 0.6.
---@field tail_length? number Length of the hair behind the tie. In metres. Default: as long as the spine; as in the thesis as long as hair without a tie.
---@field ragged? number Share of that by which tips differ. Default: 0.45; as in the thesis 0.
---@field name? string For people, and for groups of strands.
---@field enabled? boolean Curves that are not have no effect. Default: true.
---@field weight? number Weight of the curve in the field (omega of the thesis). Default: 100.
---@field spine? lissom.Vector[] From the tie to the tip of the tail. In mesh units.

---Adds a ponytail: hair is drawn into a tie and goes on along a spine.
---@param spine lissom.Vector[] From the tie to the tip of the tail. In mesh units.
---@param options? lissom.Hairstyle.Add_ponytailOptions
---@return lissom.Curve curve # The curve, behind all others.
---@overload fun(self: lissom.Hairstyle, options: lissom.Hairstyle.Add_ponytailOptions): lissom.Curve
function Hairstyle:add_ponytail(spine, options) end

---Constraints of the field from the enabled curves and avoid_scalp: one vector a constrained grid point. `lissom.render{ style = }` draws them.
---@return lissom.StyleConstraint[] constraints # A list.
function Hairstyle:constraints() end

---Brings the field up to date with the curves. `grow` and `field` do so by themselves.
---@return lissom.Hairstyle style # The hairstyle itself.
function Hairstyle:solve() end

---The field at a point: which way hair grows there.
---@param point lissom.Vector Three numbers or {x, y, z}. In mesh units.
---@return number[] direction # {x, y, z}; of length 1 near curves.
---@return number distance # To the head, in mesh units; negative inside of it.
---@overload fun(self: lissom.Hairstyle, x: number, y: number, z: number): number[]
function Hairstyle:field(point) end

---@class lissom.Hairstyle.Avoid_scalpOptions
---@field magnitude? number Length of the vectors that do so: small, so that they change little elsewhere. Default: 0.3.
---@field band? number Grid points nearer to the head than this, on either side. In metres. Default: a grid step.

---Turns the field along the head at points at which it points into the head (section 4.6 of the thesis), also on the neck, past which hair only flows. For the end of a design: it stays as it is until it is done again. Hair that grows with `avoid` stays outside anyway.
---@param options? lissom.Hairstyle.Avoid_scalpOptions
---@return lissom.Hairstyle style # The hairstyle itself.
function Hairstyle:avoid_scalp(options) end

---Undoes avoid_scalp.
---@return lissom.Hairstyle style # The hairstyle itself.
function Hairstyle:forget_scalp() end

---@class lissom.Hairstyle.GrowOptions.Cut
---@field point lissom.Vector A point of the plane. In mesh units.
---@field normal? lissom.Vector Direction without hair. Default: down.
---@field ragged? number Strands meet the plane moved by this at most. In metres. Default: 0.006.

---@class lissom.Hairstyle.GrowOptions
---@field seed? integer Another seed gives other roots and other chance. Default: 1.
---@field length? number|(fun(vertex: integer, x: number, y: number, z: number): number) Length of a strand, at most twice the diagonal of the volume. By function(vertex, x, y, z) in metres, for instance for a fringe that is shorter than the rest: it is asked for each vertex of the head with its number and its place in mesh units. In metres. Default: 0.25; as in the thesis as the field carries it.
---@field variation? number Share by which strands are longer or shorter at most. Default: 0.1; as in the thesis 0.
---@field roots? "poisson"|"angles"|"steps" Evenly spread; a root at a random place of each cell of polar angles; or in equal steps of the angles with little randomness, as in the thesis: of steps the first n of more are spread alike, but not the same. Default: "poisson"; as in the thesis "steps".
---@field density? number[]|string|(fun(vertex: integer, x: number, y: number, z: number): number) Relative density of hair. For the vertices of the head: a list, the name of an attribute, or function(vertex, x, y, z), asked with the vertex's number and its place in mesh units. Default: 1 everywhere.
---@field lengths? number[]|string|(fun(vertex: integer, x: number, y: number, z: number): number) Factors of the length. For the vertices of the head: a list, the name of an attribute, or function(vertex, x, y, z), asked with the vertex's number and its place in mesh units. Default: 1 everywhere.
---@field cut? lissom.Hairstyle.GrowOptions.Cut Cuts hair off along a plane, but for tails.
---@field avoid? boolean Keeps strands outside the head while they grow. Default: true; as in the thesis false.
---@field clearance? number The lowest strands lie this high. For `avoid`. In metres. Default: 0.002.
---@field layer? number The highest lie higher by this. For `avoid`. In metres. Default: 0.012.
---@field ramp? number Length over which strands rise to their height. For `avoid`. In metres. Default: 0.03.
---@field lift? number Share of the normal of the head in the first segment. Default: 0.15; as in the thesis 0.
---@field segment? number Length of a segment, in steps of the grid. Default: 0.5.
---@field min_speed? number A strand ends if the field is shorter than this. Default: 0.05.
---@field max_turn? number A strand ends before a segment that turns by more than this, as about a sink of the field; 180 lets strands turn as they like. In degrees. Default: 88; as in the thesis 180.
---@field max_segments? integer A strand has no more segments. Default: 400.
---@field into? lissom.Strands Strands whose place the new ones take. After an error they are as they were, or empty if growth had begun. Default: new strands.
---@field count? integer Number of strands; the first n of more are the same. Default: 100000.

---Grows hair that follows the field from its roots on the scalp. Lengths are those of a style, in metres of an average head. Strands that pass through the tie of a ponytail are in the group of its name.
---@param count? integer Number of strands; the first n of more are the same. Default: 100000.
---@param options? lissom.Hairstyle.GrowOptions
---@return lissom.Strands hair # The strands.
---@overload fun(self: lissom.Hairstyle, options: lissom.Hairstyle.GrowOptions): lissom.Strands
function Hairstyle:grow(count, options) end

---@class lissom.Hairstyle.MaskOptions
---@field kind "length"|"density" Factors of the length of hair, or the relative density of its roots.
---@field points lissom.Vector[] The way of the brush over the head; one point is a dab. In mesh units.
---@field value? number Painted value: to 4 for the length, to 1 for the density; 1 erases. Default: 0.5.
---@field radius? number Radius of the brush. In metres. Default: 0.02.
---@field softness? number The share of the radius over which the brush fades. Default: 0.5.

---Paints on the scalp with a round brush to make hair shorter, longer or thinner. A style keeps its strokes, in metres of an average head, and hair grows by them besides `lengths` and `density` of `grow`.
---@param options lissom.Hairstyle.MaskOptions
---@return lissom.Hairstyle style # The hairstyle itself.
function Hairstyle:mask(options) end

---The masks painted on the scalp, in their order.
---@return lissom.ScalpMask[] masks # Same as given to `mask`.
function Hairstyle:masks() end

---@class lissom.Hairstyle.Clear_masksOptions
---@field kind? "length"|"density" Factors of the length of hair, or the relative density of its roots. Default: both.

---Erases the masks of the scalp.
---@param options? lissom.Hairstyle.Clear_masksOptions
---@return lissom.Hairstyle style # The hairstyle itself.
function Hairstyle:clear_masks(options) end

---@class lissom.Hairstyle.CombOptions
---@field points lissom.Vector[] The stroke, in the hair: `camera:stroke{ on = strands }` puts it there. In mesh units.
---@field by? "least"|"bend"|"add" least: the smallest change; bent streams alone; or an added one. Default: "least".
---@field reach? number Streams nearer to the stroke than this are bent: wholly up to half of it, less and less beyond. In metres. Default: 0.04.
---@field tolerance? number Hair follows the stroke if it runs within this angle of it, root of the mean square. In degrees. Default: 15.

---Makes hair flow along a stroke, which runs as hair grows. Hair that follows it already does not change; otherwise streams beside it are bent, or one is added along it, whichever explains the stroke and changes the rest of the hair least.
---@param options lissom.Hairstyle.CombOptions
---@return lissom.CombReport report # The changes made.
function Hairstyle:comb(options) end

---The text of its file, as `save` writes it. See `lissom.read_style`.
---@return string text # JSON.
function Hairstyle:text() end

---@class lissom.Hairstyle.SketchOptions
---@field camera? lissom.Camera Camera of the first stroke, in mesh units. Default: the strokes say it.
---@field size? integer|integer[] {width, height} of the picture in pixels; one number for a square. Default: {1280, 960}.
---@field strands? integer Number of strands that the tools grow, to be returned. Default: 0.

---Draws on the style by the tools of the window: each stroke is a drag of a tool, with its meaning there. All strokes are done, or, if a tool refuses one, none: the error names the stroke and the reason.
---@param strokes table A list of lissom.SketchStroke. Fields that a stroke leaves out, but for its points or its key, are those of the one before.
---@param options? lissom.Hairstyle.SketchOptions
---@return lissom.Sketched[] done # One for each stroke.
---@return lissom.Strands? hair # The grown hair.
function Hairstyle:sketch(strokes, options) end

---Frees the contents of the object. It may be called again; any other use is an error then.
function Hairstyle:close() end

---A style curve: says how hair flows near it. It lives in its hairstyle.
---@class lissom.Curve
local Curve = {}

---The kind of the curve.
---@return string kind # "stream", "dividing" or "ponytail".
function Curve:kind() end

---Its name.
---@return string name # Empty if it has none.
function Curve:name() end

---Whether it has an effect.
---@return boolean enabled # True if it has.
function Curve:enabled() end

---The points that it was drawn with, of a ponytail those of the spine.
---@return number[][] points # {x, y, z} each, in mesh units.
function Curve:points() end

---The curve as it acts: smooth, outside the head, in segments of about a step of the grid.
---@return number[][] points # {x, y, z} each, in mesh units.
function Curve:course() end

---The hairstyle that it belongs to.
---@return lissom.Hairstyle style # The hairstyle.
function Curve:hairstyle() end

---Draws the curve anew.
---@param points lissom.Vector[] The new points, of a ponytail those of the spine. In mesh units.
---@return lissom.Curve curve # The curve itself.
function Curve:set_points(points) end

---@class lissom.Curve.SetOptions
---@field points? lissom.Vector[] Points of a stream or dividing curve.
---@field spine? lissom.Vector[] Spine of a ponytail.
---@field stop? boolean|number Keeps hair from growing on beyond the end of the curve, by vectors that vanish over a length. Default: true, 0.04 metres.
---@field clearance? number The curve is moved out to this height. In metres. Default: 0.004; as in the thesis 0.
---@field tilt? number[] {at its first point, at its last}: by how much hair on both sides is turned towards the curve's end, in degrees. Default: {0, 0}.
---@field left? number[] The same for one side, as seen along the curve from outside. Default: tilt.
---@field right? number[] The same for the other. Default: tilt.
---@field sigma? number Distance from the line to the crest of the hair. In metres. Default: a grid step.
---@field height? number h of the thesis: the crest is 0.39 times as high. In metres. Default: half a grid step.
---@field reach? number Distance from the line within which hair is shaped. In metres. Default: 2.5 sigma.
---@field thickness? number Distance above and below its line within which hair is shaped. In metres. Default: 0.8 grid steps.
---@field separation? number Magnitude of the vectors that keep both sides apart. Default: 0.3.
---@field wall_width? number Distance of these from the line. In metres. Default: 1.2 grid steps.
---@field wall_height? number Their height. In metres. Default: 2.6 grid steps.
---@field ramp? number Nearer to the line, vectors away from it fade; 0 as in the thesis. In metres. Default: 0.87 grid steps; as in the thesis 0.
---@field gap? number Width of the bare skin along the line. In metres. Default: 0.0024; as in the thesis 0.
---@field radius? number Radius of the tie, the first cross section. In metres. Default: from section or profiles, else 1.5 grid steps.
---@field section? lissom.Vector[] A closed curve around the spine, seen from anywhere: the tie stands there, and is as wide as it is across the spine.
---@field profiles? table {a, b}: two lists of points along the spine on either side of the tail; its cross sections reach between them along their common part, in either direction.
---@field share? number Without profiles: how much of the spine has cross sections. Default: 0.7.
---@field fullness? number Without profiles: the tail swells to 1 + fullness radii. Default: 1.
---@field inner? number Hair is drawn into the tie from this many radii on (R1 of the thesis). Default: 1.3.
---@field outer? number And up to this many (R2). Default: 1.9.
---@field ring? number It is at least so wide. In metres. Default: 2.5 grid steps; as in the thesis 0.
---@field free? number Nearer to the head than this the tail leaves hair alone. In metres. Default: 1.5 grid steps; as in the thesis 0.
---@field lead? number The ring begins so far in front of the tie. In metres. Default: 1.5 grid steps; as in the thesis half a grid step.
---@field grip? number Strength with which the tail holds its hair together: the turn inward of vectors just outside, a grid step. 0 as in the thesis. Default: 4; as in the thesis 0.
---@field spread? number Strength with which hair spreads again behind the tie and fills the tail. 0 as in the thesis. Default: 2; as in the thesis 0.
---@field tightness? number Magnitude of the vectors that do so. Default: 0.6.
---@field tail_length? number Length of the hair behind the tie. In metres. Default: as long as the spine; as in the thesis as long as hair without a tie.
---@field ragged? number Share of that by which tips differ. Default: 0.45; as in the thesis 0.
---@field name? string For people, and for groups of strands.
---@field enabled? boolean Curves that are not have no effect. Default: true.
---@field weight? number Weight of the curve in the field (omega of the thesis). Default: 100.

---Changes some of the options that it was made with.
---@param options? lissom.Curve.SetOptions
---@return lissom.Curve curve # The curve itself.
function Curve:set(options) end

---Lets it act, or not.
---@param on? boolean Whether it does. Default: true.
---@return lissom.Curve curve # The curve itself.
function Curve:enable(on) end

---Gives it another place in the order: the later of several curves counts at a point, but dividing curves before all others.
---@param place integer Its place among the curves of the style.
---@return lissom.Curve curve # The curve itself.
function Curve:reorder(place) end

---Takes it out of the style.
function Curve:remove() end

---@class lissom.Curve.Hint_operationOptions
---@field near? number Distance from the curve that counts as on it: about 20 pixels of the picture that the stroke was drawn in. In metres. Default: 0.007.

---The meaning of a hint stroke, by its ends and by its general direction. Call the method of that name with it.
---@param hint lissom.Vector[] A polyline that begins, ends or passes near the curve. In mesh units.
---@param options? lissom.Curve.Hint_operationOptions
---@return string operation # "cut", "concatenate" or "insert".
---@return boolean sure # False if a slightly different stroke has another meaning.
function Curve:hint_operation(hint, options) end

---@class lissom.Curve.CutOptions
---@field reach? number A hint that is farther from the curve has nothing to do with it. In metres. Default: 0.03.

---Ends the curve at the crossing of a hint stroke.
---@param hint lissom.Vector[] A polyline that passes near the curve. In mesh units.
---@param options? lissom.Curve.CutOptions
---@return lissom.Curve curve # The curve itself.
function Curve:cut(hint, options) end

---@class lissom.Curve.ConcatenateOptions
---@field reach? number A hint that is farther from the curve has nothing to do with it. In metres. Default: 0.03.
---@field join? number Length of the curve and of the hint that a smooth join replaces. In metres. Default: 0.015.

---Goes on along a hint stroke that begins near the curve: from there to the end the curve is replaced.
---@param hint lissom.Vector[] A polyline that begins near the curve. In mesh units.
---@param options? lissom.Curve.ConcatenateOptions
---@return lissom.Curve curve # The curve itself.
function Curve:concatenate(hint, options) end

---@class lissom.Curve.InsertOptions
---@field reach? number A hint that is farther from the curve has nothing to do with it. In metres. Default: 0.03.
---@field join? number Length of the curve and of the hint that a smooth join replaces. In metres. Default: 0.015.

---Replaces the part of the curve between the ends of a hint stroke that begins and ends near it.
---@param hint lissom.Vector[] A polyline whose ends are near the curve. In mesh units.
---@param options? lissom.Curve.InsertOptions
---@return lissom.Curve curve # The curve itself.
function Curve:insert(hint, options) end

---By how much hair on both sides of a dividing curve is turned towards the curve's end, as the options say or as the hints do.
---@return lissom.CurveTilt tilt # Tilt of both sides.
function Curve:tilt() end

---A stroke beside a dividing curve that says which way hair flows away from it. The curve keeps its hints, and all hints on a side tell its tilt together; one alone means an even tilt. To set the tilt by numbers takes them out.
---@param hint lissom.Vector[] A polyline away from the curve, at most 0.03 metres of an average head beside it. In mesh units.
---@return lissom.CurveTilt tilt # The present tilt of the curve.
function Curve:add_hint(hint) end

---The hints of a dividing curve.
---@return number[][][] hints # A list of points {x, y, z} each, in mesh units.
function Curve:hints() end

---Takes the hints of a dividing curve out: its tilts are those of its options.
---@return lissom.Curve curve # The curve itself.
function Curve:remove_hints() end

---Its effective options, by the names and in the units of `set`: also defaults, and those that follow from the drawn points.
---@return table options # A table of its own.
function Curve:options() end

---The point at which a ponytail is tied.
---@return lissom.HairTie tie # Its first cross section.
function Curve:tie() end

---The curve that was drawn around the spine of a ponytail.
---@return number[][] points # In mesh units; none if there are none.
function Curve:section() end

---The curves that were drawn along a ponytail, as `set` takes them.
---@return number[][][] profiles # Two lists of points in mesh units, each empty if there is none.
function Curve:profiles() end

---@class lissom.Curve.SupportOptions
---@field mode? "ruled"|"strip" Kind of surface. Default: "strip".
---@field camera lissom.Camera The viewpoint; that of the stroke may be another.
---@field width? number To each side of the curve; a strip is narrower in bends. In metres of an average head. Default: 0.03 of a strip, 0.075 of a ruled surface.
---@field extension? number Length beyond the tip. In metres of an average head. Default: 0.035.

---The surface through the curve that strokes about it are drawn on (Figure 4.3): the strip keeps the depth of the curve and changes how it looks from the viewpoint, the ruled surface of the lines of sight keeps how it looks and changes its depth, seen from aside. Up to about 50 degrees from the viewpoint the strip is seen better, beyond that the ruled one. Give it to camera:stroke as `on`.
---@param options lissom.Curve.SupportOptions
---@return lissom.Support support # The surface, of the curve as it is now.
function Curve:support(options) end

---@class lissom.Curve.Read_hintOptions
---@field camera lissom.Camera The camera that it is seen by.
---@field points number[][] The stroke on the picture, smoothed; see camera:stroke.
---@field scale? number Pixels of the picture to a logical one, on dense screens. Default: 1.
---@field size? integer|integer[] {width, height} of the picture in pixels; one number for a square. Default: {1280, 960}.

---The meaning of a hint stroke, seen on the picture: within 20 pixels is near. Draw it on the curve's supporting surface, and call the method of that name with it.
---@param options lissom.Curve.Read_hintOptions
---@return lissom.HintReading reading # Its reading.
function Curve:read_hint(options) end

---Frees the contents of the object. It may be called again; any other use is an error then.
function Curve:close() end

---Hair: polylines from root to tip, in metres. Strands count from 1. Operators never move roots, and their effect on a strand does not depend on the number of strands.
---@class lissom.Strands
---@operator len: integer
local Strands = {}

---The points of one strand, root first: a copy, a row of x, y, z a point.
---@param strand integer Its number.
---@return lissom.Buffer points # The points.
function Strands:strand(strand) end

---Root of a strand, and its other properties.
---@param strand integer Its number.
---@return lissom.StrandRoot root # Fields that are not known are absent.
function Strands:root(strand) end

---The points of all strands, one strand after the other: a copy.
---@return lissom.Buffer points # A row of x, y, z a point.
function Strands:points() end

---Numbers of points of the strands.
---@return integer[] counts # One number a strand.
function Strands:point_counts() end

---The names of the groups.
---@return string[] names # In their order; empty if there are none.
function Strands:groups() end

---The axis-aligned box around all points.
---@return lissom.Bounds bounds # The box.
function Strands:bounds() end

---A hash of all that the strands hold, the same on every platform.
---@return string hash # 16 hexadecimal digits.
function Strands:hash() end

---@class lissom.Strands.StatsOptions
---@field sharp_turn? number A turn between two segments above this is sharp. In degrees. Default: 90.
---@field style? lissom.Hairstyle Measures too how many strands are inside its head, on which they grew, by the distance to its surface. Default: not measured.
---@field depth? number Depth from which on they count. In metres. Default: 0.0005, as the head is larger than an average one.

---Counts, lengths and turns, and how many strands are damaged.
---@param options? lissom.Strands.StatsOptions
---@return lissom.StrandStats stats # The measures.
function Strands:stats(options) end

---@class lissom.Strands.SaveOptions.Camera
---@field eye lissom.Vector Its position, in units of the head.
---@field target lissom.Vector The middle of the picture.
---@field up? "x"|"y"|"z"|lissom.Vector Direction upwards. Default: "y".
---@field fov? number Vertical opening angle. In degrees. Default: 30.

---@class lissom.Strands.SaveOptions
---@field up? "y"|"z" The up axis that the file shall have. Default: y.
---@field unit? number Length of the file's unit in metres: points and widths are divided by it. In metres. Default: 1.
---@field mend? boolean false makes a change or an omission an error that names the strands. Default: true.
---@field head? lissom.Mesh For .rib: the head that the picture shows. For .usda: the head that the hair grew on, with a skin of its file; the strands are bound to its joints (UsdSkel). Default: none.
---@field camera? lissom.Strands.SaveOptions.Camera For .rib: the camera of the picture. Default: hair and head whole, from the front, a little aside.
---@field archive? boolean For .rib: the curves alone, for other RIB files to read; else a scene with camera, lights and shaders, of which a RenderMan renderer makes the picture. Default: false.

---Writes the strands to a .hair, .data, .usda, .tfx, .ply, .rib, .glb, .gltf or .obj file, whole or not at all. They are checked before, and changed if they would break in other programs; the strands themselves stay as they are.
---@param path string The file; its extension names the format.
---@param options? lissom.Strands.SaveOptions
---@return lissom.Strands strands # The strands themselves.
---@return lissom.StrandFinding[] report # Findings, changes and omissions.
function Strands:save(path, options) end

---@class lissom.Strands.SelectOptions.Near
---@field curve lissom.Curve A curve of a hairstyle.
---@field radius? number In metres of an average head. Default: 0.02.

---@class lissom.Strands.SelectOptions
---@field strands? integer[] Their numbers, in the order wanted.
---@field group? string Those of a group.
---@field region? lissom.Region Those rooted on a face of a region of the head that they grew on.
---@field near? lissom.Strands.SelectOptions.Near Those that come near a style curve.
---@field first? integer So many from the beginning: a level of detail.
---@field where? fun(strand: integer, x: number, y: number, z: number): boolean Those for which the function, asked with the root, returns true.

---Some of the strands as new ones, with all that is known of them.
---@param options lissom.Strands.SelectOptions
---@return lissom.Strands strands # The new strands.
function Strands:select(options) end

---A copy of all strands.
---@return lissom.Strands strands # The new strands.
function Strands:copy() end

---Adds other strands after these. Groups of the same name become one.
---@param other lissom.Strands The strands to add.
---@return lissom.Strands strands # The strands themselves.
function Strands:append(other) end

---Takes the content of other strands, with all that they know.
---@param other lissom.Strands They stay as they are.
---@return lissom.Strands strands # The strands themselves.
function Strands:assign(other) end

---The comment of the strands, as of their file; that of hair which a groom keeps in a scene is the text of the groom.
---@return string text # The comment, "" without one.
function Strands:comment() end

---Replaces the comment, which scenes and files of hair keep (.hair the first 88 bytes).
---@param text string The comment.
---@return lissom.Strands strands # The strands themselves.
function Strands:set_comment(text) end

---@class lissom.Strands.TransformOptions.Rotate
---@field axis "x"|"y"|"z"|lissom.Vector Axis of the rotation.
---@field angle number Angle, counter-clockwise seen against the axis. In degrees.
---@field about? lissom.Vector A point on the axis. Default: the option `about`.

---@class lissom.Strands.TransformOptions
---@field translate? lissom.Vector Added last. In mesh units. Default: {0, 0, 0}.
---@field rotate? lissom.Strands.TransformOptions.Rotate Applied after the scale. Default: none.
---@field scale? number|lissom.Vector Factor for all axes, or one for each; applied first. Default: 1.
---@field about? lissom.Vector The point that scale and rotation keep. Default: the origin.

---Scales, then rotates, then translates all points. Widths scale too.
---@param options? lissom.Strands.TransformOptions
---@return lissom.Strands strands # The strands themselves.
function Strands:transform(options) end

---@class lissom.Strands.ResampleOptions
---@field count? integer Points of each strand.
---@field step? number Distance of points. In metres.

---Spreads points evenly along each strand; roots and tips stay.
---@param options lissom.Strands.ResampleOptions
---@return lissom.Strands strands # The strands themselves.
function Strands:resample(options) end

---@class lissom.Strands.Set_widthsOptions
---@field width? number Diameter of all strands. In metres.
---@field widths? number[] Diameters in metres, one a strand or one a point.
---@field profile? number[] Factors at equal steps from the root to the tip, linear between; empty for none.

---Sets the thickness of strands; options that are not given stay. Pictures and files have the widths, times the profile.
---@param options? lissom.Strands.Set_widthsOptions
---@return lissom.Strands strands # The strands themselves.
function Strands:set_widths(options) end

---@class lissom.Strands.Set_colorsOptions
---@field color? lissom.Vector The colour of all strands.
---@field colors? lissom.Vector[] Colours, one a strand or one a point.
---@field profile? lissom.Vector[] Colours at equal steps from the root to the tip, linear between: two or more.

---Sets the colours of strands as linear red, green and blue, each 0 to 1; pictures and files have them.
---@param options lissom.Strands.Set_colorsOptions
---@return lissom.Strands strands # The strands themselves.
function Strands:set_colors(options) end

---@class lissom.Strands.ClumpOptions
---@field clumps? integer Number of guides: the strands of the lowest ids. Default: the guides that strands have, else 900, at most one for eight strands.
---@field strength? number Part of the way to the guide that tips move. Default: 0.7.
---@field variation? number The strength of a clump is up to this fraction higher or lower, at random. Default: 0.5.
---@field shape? number The pull grows with this power of the place along the strand. Default: 1.
---@field radius? number Strands rooted further from their guide stay. In metres. Default: 0.03.
---@field apart? number Weight of it in the choice of a guide that strands are combed apart, as at a parting. Default: 0.5.
---@field tip_spread? number Random distance by which tips miss their guide. In metres. Default: 0.001.
---@field offset? number Random distance by which the tip of a whole clump moves. In metres. Default: 0.
---@field within_groups? boolean Guides are of the strand's own group. Default: true.
---@field keep_length? boolean Segments keep their lengths. Default: true.
---@field seed? integer Another seed gives another result of the same kind. Default: 1.
---@field factor? number Part of the effect; 0 changes nothing. Default: 1.
---@field mask? number[]|string|lissom.Region|(fun(strand: integer, x: number, y: number, z: number): number|boolean) Part of the effect on each strand, 0 to 1. Default: all strands.

---Gathers strands around guides; roots stay.
---@param options? lissom.Strands.ClumpOptions
---@return lissom.Strands strands # The strands themselves.
function Strands:clump(options) end

---@class lissom.Strands.NoiseOptions
---@field amplitude? number Greatest distance, about, that a tip moves. It moves less if that would turn a segment by more than 27 degrees; a warning says so. In metres. Default: 0.0016.
---@field across? number Distance of roots that wander apart. In metres. Default: 0.02.
---@field along? number Length along a strand of one deviation. In metres. Default: 0.11.
---@field shape? number The amplitude grows with this power of the place along the strand. Default: 1.
---@field cumulative? boolean Deviations add up along the strand. Default: false.
---@field keep_length? boolean Segments keep their lengths. Default: true.
---@field seed? integer Another seed gives another result of the same kind. Default: 1.
---@field factor? number Part of the effect; 0 changes nothing. Default: 1.
---@field mask? number[]|string|lissom.Region|(fun(strand: integer, x: number, y: number, z: number): number|boolean) Part of the effect on each strand, 0 to 1. Default: all strands.

---Lets strands wander off their course, neighbours together; roots stay.
---@param options? lissom.Strands.NoiseOptions
---@return lissom.Strands strands # The strands themselves.
function Strands:noise(options) end

---@class lissom.Strands.TaperOptions
---@field tip? number Width of the tip as a fraction of its former width. Default: 0.2.
---@field start? number Start of the taper: 0 is the root, 1 the tip. Default: 0.
---@field shape? number 1 is a cone, 2 stays wide for longer. Default: 1.

---Makes strands thinner towards their tips.
---@param options? lissom.Strands.TaperOptions
---@return lissom.Strands strands # The strands themselves.
function Strands:taper(options) end

---@class lissom.Strands.TrimOptions.Plane
---@field point lissom.Vector A point of the plane.
---@field normal lissom.Vector Points to the side that is cut off.

---@class lissom.Strands.TrimOptions
---@field length? number Longest length that is left. In metres. Default: no limit.
---@field factor? number Part of its length that each strand keeps. Default: 1.
---@field variation? number Each strand keeps up to this fraction less, at random. Default: 0.
---@field plane? lissom.Strands.TrimOptions.Plane The part beyond a plane is cut off.
---@field jitter? number Each strand meets the plane moved by at most this. In metres. Default: 0.
---@field least? number No strand becomes shorter. In metres. Default: 0.001.
---@field seed? integer Another seed gives another result of the same kind. Default: 1.

---Cuts strands off at the tip, by the first of the options that applies.
---@param options? lissom.Strands.TrimOptions
---@return lissom.Strands strands # The strands themselves.
function Strands:trim(options) end

---@class lissom.Strands.SmoothOptions
---@field iterations? integer Number of passes. Default: 3.
---@field strength? number Fraction of the way to the middle of its neighbours that a point moves in a pass. Default: 0.5.
---@field factor? number Part of the effect; 0 changes nothing. Default: 1.
---@field mask? number[]|string|lissom.Region|(fun(strand: integer, x: number, y: number, z: number): number|boolean) Part of the effect on each strand, 0 to 1. Default: all strands.

---Evens out kinks along each strand; roots and tips stay.
---@param options? lissom.Strands.SmoothOptions
---@return lissom.Strands strands # The strands themselves.
function Strands:smooth(options) end

---@class lissom.Strands.GuidesOptions
---@field count? integer Number of guides: the strands of the lowest ids. Default: 400.
---@field apart? number Weight of it in the choice of a guide that strands are combed apart, as at a parting. Default: 0.5.
---@field radius? number Strands rooted further from a guide follow none. In metres. Default: inf.
---@field within_groups? boolean Guides are of the strand's own group. Default: true.

---Lets each strand follow the nearest of some guides from now on; operators, copies and files keep them, and strands:root tells them.
---@param options? lissom.Strands.GuidesOptions
---@return lissom.Strands strands # The strands themselves.
function Strands:guides(options) end

---@class lissom.Strands.GatherOptions
---@field ramp? number Length over which strands come to their guide. In metres. Default: 0.02.
---@field spread? number Random distance of strands from their guide, about. In metres. Default: 0.001.
---@field guides? integer Assigns so many guides, which stay with the strands: those of the lowest ids. Default: the guides that strands have, else 400.
---@field factor? number Part of the effect; 0 changes nothing. Default: 1.
---@field mask? number[]|string|lissom.Region|(fun(strand: integer, x: number, y: number, z: number): number|boolean) Part of the effect on each strand, 0 to 1. Default: all strands.
---@field shape? number|number[] Course of the effect along the strand. Default: 0.
---@field keep_length? boolean Segments keep their lengths. Default: false.
---@field seed? integer Another seed gives another result of the same kind. Default: 1.

---Gathers strands to locks around their guides, from the end of a ramp on; roots stay.
---@param options? lissom.Strands.GatherOptions
---@return lissom.Strands strands # The strands themselves.
function Strands:gather(options) end

---@class lissom.Strands.TwistOptions
---@field wavelength? number Length of one turn; negative turns the other way. In metres. Default: 0.05.
---@field ramp? number Length over which the turning begins. In metres. Default: 0.02.
---@field guides? integer Assigns so many guides, which stay with the strands: those of the lowest ids. Default: the guides that strands have, else 400.
---@field factor? number Part of the effect; 0 changes nothing. Default: 1.
---@field mask? number[]|string|lissom.Region|(fun(strand: integer, x: number, y: number, z: number): number|boolean) Part of the effect on each strand, 0 to 1. Default: all strands.
---@field shape? number|number[] Course of the effect along the strand. Default: 0.
---@field keep_length? boolean Segments keep their lengths. Default: false.
---@field seed? integer Another seed gives another result of the same kind. Default: 1.

---Turns strands about their guide, as hair twisted to a rope; guides stay.
---@param options? lissom.Strands.TwistOptions
---@return lissom.Strands strands # The strands themselves.
function Strands:twist(options) end

---@class lissom.Strands.PinchOptions
---@field place? number 0 at the root, 1 at the tip. Default: 0.5.
---@field width? number Part of the length over which the pull falls off. Default: 0.15.
---@field guides? integer Assigns so many guides, which stay with the strands: those of the lowest ids. Default: the guides that strands have, else 400.
---@field factor? number Part of the effect; 0 changes nothing. Default: 1.
---@field mask? number[]|string|lissom.Region|(fun(strand: integer, x: number, y: number, z: number): number|boolean) Part of the effect on each strand, 0 to 1. Default: all strands.
---@field shape? number|number[] Course of the effect along the strand. Default: 0.
---@field keep_length? boolean Segments keep their lengths. Default: false.
---@field seed? integer Another seed gives another result of the same kind. Default: 1.

---Pulls strands to their guide at one place along them, as a tie does.
---@param options? lissom.Strands.PinchOptions
---@return lissom.Strands strands # The strands themselves.
function Strands:pinch(options) end

---@class lissom.Strands.CurlOptions
---@field radius? number From the course of the strand to the curl. In metres. Default: 0.0095.
---@field wavelength? number Length along the course of one turn. In metres. Default: 0.03.
---@field tip? number Radius at the tip as a part of `radius`. Default: 1.
---@field start? number Distance from the root at which it begins. In metres. Default: 0.02.
---@field ramp? number Length over which it reaches its radius. In metres. Default: 0.1.
---@field hang? number Turns are longer at the root and shorter at the tip by this part. Default: 0.5.
---@field variation? number Radius and wavelength of a guide are up to this part more or less. Default: 0.2.
---@field phase? number Part of a turn by which strands of a guide differ: .06 is a wire, .2 a ribbon, .5 a coil, 1 fuzz. Default: 0.22.
---@field depth? number 1 is a helix, 0 a wave in a surface. Default: 1.
---@field together? boolean Neighbouring guides begin their turns alike. Default: false.
---@field begin? number[]|(fun(strand: integer, x: number, y: number, z: number): number) Turns that strands have at their roots: if they grow with the way from a line, crests run along it, as in finger waves. Default: those of the guide.
---@field hand? "random"|"left"|"right"|"mirrored" Sense of the turns: mirrored is right for roots with x above 0, and left for others. Default: "random".
---@field points_per_turn? integer Strands with fewer points get more; 0 keeps them. Default: 12.
---@field guides? integer Assigns so many guides, which stay with the strands: those of the lowest ids. Default: the guides that strands have, else 400.
---@field factor? number Part of the effect; 0 changes nothing. Default: 1.
---@field mask? number[]|string|lissom.Region|(fun(strand: integer, x: number, y: number, z: number): number|boolean) Part of the effect on each strand, 0 to 1. Default: all strands.
---@field shape? number|number[] Course of the effect along the strand. Default: 0.
---@field keep_length? boolean Segments keep their lengths. Default: true.
---@field seed? integer Another seed gives another result of the same kind. Default: 1.

---Winds strands around their course, those of a guide together; with keep_length hair becomes shorter on the head.
---@param options? lissom.Strands.CurlOptions
---@return lissom.Strands strands # The strands themselves.
function Strands:curl(options) end

---@class lissom.Strands.WaveOptions
---@field radius? number From the course of the strand to the curl. In metres. Default: 0.009.
---@field wavelength? number Length along the course of one turn. In metres. Default: 0.095.
---@field tip? number Radius at the tip as a part of `radius`. Default: 1.3.
---@field start? number Distance from the root at which it begins. In metres. Default: 0.07.
---@field ramp? number Length over which it reaches its radius. In metres. Default: 0.09.
---@field hang? number Turns are longer at the root and shorter at the tip by this part. Default: 0.
---@field variation? number Radius and wavelength of a guide are up to this part more or less. Default: 0.2.
---@field phase? number Part of a turn by which strands of a guide differ: .06 is a wire, .2 a ribbon, .5 a coil, 1 fuzz. Default: 0.05.
---@field depth? number 1 is a helix, 0 a wave in a surface. Default: 0.6.
---@field together? boolean Neighbouring guides begin their turns alike. Default: true.
---@field begin? number[]|(fun(strand: integer, x: number, y: number, z: number): number) Turns that strands have at their roots: if they grow with the way from a line, crests run along it, as in finger waves. Default: those of the guide.
---@field hand? "random"|"left"|"right"|"mirrored" Sense of the turns: mirrored is right for roots with x above 0, and left for others. Default: "mirrored".
---@field points_per_turn? integer Strands with fewer points get more; 0 keeps them. Default: 12.
---@field guides? integer Assigns so many guides, which stay with the strands: those of the lowest ids. Default: the guides that strands have, else 400.
---@field factor? number Part of the effect; 0 changes nothing. Default: 1.
---@field mask? number[]|string|lissom.Region|(fun(strand: integer, x: number, y: number, z: number): number|boolean) Part of the effect on each strand, 0 to 1. Default: all strands.
---@field shape? number|number[] Course of the effect along the strand. Default: 0.
---@field keep_length? boolean Segments keep their lengths. Default: true.
---@field seed? integer Another seed gives another result of the same kind. Default: 1.

---Curls with the defaults of waves: wide, flat, and alike for neighbours.
---@param options? lissom.Strands.WaveOptions
---@return lissom.Strands strands # The strands themselves.
function Strands:wave(options) end

---@class lissom.Strands.FrizzOptions
---@field amplitude? number Distance, about, that tips move. In metres. Default: 0.0009.
---@field wavelength? number Length along the strand of one bend. In metres. Default: 0.03.
---@field flyaways? number Part of the strands that move more. Default: 0.03.
---@field flyaway? number Factor of their moves. Default: 4.
---@field factor? number Part of the effect; 0 changes nothing. Default: 1.
---@field mask? number[]|string|lissom.Region|(fun(strand: integer, x: number, y: number, z: number): number|boolean) Part of the effect on each strand, 0 to 1. Default: all strands.
---@field shape? number|number[] Course of the effect along the strand. Default: 0.7.
---@field keep_length? boolean Segments keep their lengths. Default: true.
---@field seed? integer Another seed gives another result of the same kind. Default: 1.

---Lets single hairs leave their lock, each on its own.
---@param options? lissom.Strands.FrizzOptions
---@return lissom.Strands strands # The strands themselves.
function Strands:frizz(options) end

---@class lissom.Strands.StraightenOptions
---@field factor? number Part of the effect; 0 changes nothing. Default: 1.
---@field mask? number[]|string|lissom.Region|(fun(strand: integer, x: number, y: number, z: number): number|boolean) Part of the effect on each strand, 0 to 1. Default: all strands.
---@field shape? number|number[] Course of the effect along the strand. Default: 0.
---@field keep_length? boolean Segments keep their lengths. Default: true.
---@field seed? integer Another seed gives another result of the same kind. Default: 1.

---Stretches strands out towards the line from their root to their tip.
---@param options? lissom.Strands.StraightenOptions
---@return lissom.Strands strands # The strands themselves.
function Strands:straighten(options) end

---@class lissom.Strands.RotateOptions
---@field axis? "x"|"y"|"z"|lissom.Vector Axis of the turn. Default: the direction of each strand at its root.
---@field angle? number Angle of the turn. In degrees. Default: 0.
---@field variation? number Each strand turns up to this more or less, at random. In degrees. Default: 0.
---@field factor? number Part of the effect; 0 changes nothing. Default: 1.
---@field mask? number[]|string|lissom.Region|(fun(strand: integer, x: number, y: number, z: number): number|boolean) Part of the effect on each strand, 0 to 1. Default: all strands.
---@field shape? number|number[] Course of the effect along the strand. Default: 0.
---@field seed? integer Another seed gives another result of the same kind. Default: 1.

---Turns strands about their roots; lengths stay.
---@param options? lissom.Strands.RotateOptions
---@return lissom.Strands strands # The strands themselves.
function Strands:rotate(options) end

---@class lissom.Strands.RollOptions
---@field radius? number Radius of the roll. In metres. Default: 0.015.
---@field start? number Its beginning: 0 at the root, 1 at the tip. Default: 0.5.
---@field outward? boolean Rolls away from the head. Default: false.
---@field center? lissom.Vector Inside of the head, in metres of the strands. Default: the middle of all roots.
---@field factor? number Part of the effect; 0 changes nothing. Default: 1.
---@field mask? number[]|string|lissom.Region|(fun(strand: integer, x: number, y: number, z: number): number|boolean) Part of the effect on each strand, 0 to 1. Default: all strands.
---@field shape? number|number[] Course of the effect along the strand. Default: 0.
---@field seed? integer Another seed gives another result of the same kind. Default: 1.

---Rolls up the ends of strands, as on curlers; lengths stay.
---@param options? lissom.Strands.RollOptions
---@return lissom.Strands strands # The strands themselves.
function Strands:roll(options) end

---@class lissom.Strands.PuffOptions
---@field amount? number Distance that strands rise; negative lets them sink. In metres. Default: 0.01.
---@field center? lissom.Vector Inside of the head, in metres of the strands. Default: the middle of all roots.
---@field factor? number Part of the effect; 0 changes nothing. Default: 1.
---@field mask? number[]|string|lissom.Region|(fun(strand: integer, x: number, y: number, z: number): number|boolean) Part of the effect on each strand, 0 to 1. Default: all strands.
---@field shape? number|number[] Course of the effect along the strand. Default: from 0 to 1.
---@field keep_length? boolean Segments keep their lengths. Default: true.
---@field seed? integer Another seed gives another result of the same kind. Default: 1.

---Lifts strands off the head.
---@param options? lissom.Strands.PuffOptions
---@return lissom.Strands strands # The strands themselves.
function Strands:puff(options) end

---@class lissom.Strands.DisplaceOptions
---@field offset? lissom.Vector That all tips move, in metres. Default: none.
---@field offsets? lissom.Vector[] Besides, one vector for each strand. Default: none.
---@field factor? number Part of the effect; 0 changes nothing. Default: 1.
---@field mask? number[]|string|lissom.Region|(fun(strand: integer, x: number, y: number, z: number): number|boolean) Part of the effect on each strand, 0 to 1. Default: all strands.
---@field shape? number|number[] Course of the effect along the strand. Default: 1.
---@field keep_length? boolean Segments keep their lengths. Default: true.
---@field seed? integer Another seed gives another result of the same kind. Default: 1.

---Moves strands by vectors, tips the most; roots stay.
---@param options? lissom.Strands.DisplaceOptions
---@return lissom.Strands strands # The strands themselves.
function Strands:displace(options) end

---@class lissom.Strands.Set_lengthOptions
---@field length? number Length of each strand. In metres. Default: as it is.
---@field scale? number Factor of the length. Default: 1.
---@field variation? number Each is up to this part longer or shorter, at random. Default: 0.
---@field factor? number Part of the effect; 0 changes nothing. Default: 1.
---@field mask? number[]|string|lissom.Region|(fun(strand: integer, x: number, y: number, z: number): number|boolean) Part of the effect on each strand, 0 to 1. Default: all strands.
---@field shape? number|number[] Course of the effect along the strand. Default: 0.
---@field seed? integer Another seed gives another result of the same kind. Default: 1.

---Makes strands longer or shorter by scaling them about their roots.
---@param options? lissom.Strands.Set_lengthOptions
---@return lissom.Strands strands # The strands themselves.
function Strands:set_length(options) end

---@class lissom.Strands.CutOptions.Plane
---@field point lissom.Vector A point of the plane.
---@field normal lissom.Vector Points to the side that is cut off.

---@class lissom.Strands.CutOptions.Ellipsoid
---@field center lissom.Vector Its center.
---@field radii lissom.Vector Along the axes.

---@class lissom.Strands.CutOptions
---@field plane? lissom.Strands.CutOptions.Plane Hair beyond a plane is cut off.
---@field ellipsoid? lissom.Strands.CutOptions.Ellipsoid Hair outside of an ellipsoid is cut off.
---@field hem? number[][] A hem around the head: {azimuth in degrees, height in metres}, linear between; hair below is cut off. Without negative azimuths both sides are alike.
---@field inside? fun(x: number, y: number, z: number, strand: integer): number|boolean Asked with each point; below 0, or false, is cut off.
---@field scalp? lissom.Scalp The shape is in metres of this scalp's frame: x to the left of the head, y up, z to the front. Default: in metres and along the axes of the strands.
---@field jitter? number Each strand meets the shape moved by up to this, at random. In metres. Default: 0.
---@field guide_jitter? number The same for each guide with its strands. In metres. Default: 0.
---@field least? number No strand becomes shorter. In metres. Default: 0.001.
---@field seed? integer Another seed gives another result of the same kind. Default: 1.
---@field factor? number Part of the effect; 0 changes nothing. Default: 1.
---@field mask? number[]|string|lissom.Region|(fun(strand: integer, x: number, y: number, z: number): number|boolean) Part of the effect on each strand, 0 to 1. Default: all strands.

---Cuts strands off where they first leave a shape.
---@param options? lissom.Strands.CutOptions
---@return lissom.Strands strands # The strands themselves.
function Strands:cut(options) end

---@class lissom.Strands.CullOptions
---@field part? number Part of the strands that goes. Default: all of the mask.
---@field locks? boolean All strands of a guide go if one goes. Default: false.
---@field seed? integer Another seed removes others. Default: 1.
---@field factor? number Part of the effect; 0 changes nothing. Default: 1.
---@field mask? number[]|string|lissom.Region|(fun(strand: integer, x: number, y: number, z: number): number|boolean) Part of the effect on each strand, 0 to 1. Default: all strands.

---Removes strands: a part of them at random, or those of a mask.
---@param options? lissom.Strands.CullOptions
---@return lissom.Strands strands # The strands themselves.
function Strands:cull(options) end

---@class lissom.Strands.Push_outOptions
---@field head lissom.Hairstyle A style on the head that they grew on.
---@field layer? lissom.Strands Hair below: strands are lifted over it first, by the clearance above the thickness that it has over the head, and by up to 6 mm more at random. Default: none.
---@field clearance? number Distance that hair stays off the surface. In metres. Default: 0.0005.
---@field ramp? number Length from the root over which it comes to stay off so far. In metres. Default: 0.01.
---@field factor? number Part of the effect; 0 changes nothing. Default: 1.
---@field mask? number[]|string|lissom.Region|(fun(strand: integer, x: number, y: number, z: number): number|boolean) Part of the effect on each strand, 0 to 1. Default: all strands.
---@field shape? number|number[] Course of the effect along the strand. Default: 0.
---@field keep_length? boolean Segments keep their lengths. Default: true.
---@field seed? integer Another seed gives another result of the same kind. Default: 1.

---Moves hair that lies in the head, the neck or the shoulders out of them; segments between points count too.
---@param options lissom.Strands.Push_outOptions
---@return lissom.Strands strands # The strands themselves.
function Strands:push_out(options) end

---@class lissom.Strands.Soften_edgeOptions
---@field head lissom.Hairstyle A style on the head that they grew on.
---@field reach? number Distance inside the hairline from which hair is as usual. In metres. Default: 0.02.
---@field width? number Factor of the widths at the edge. Default: 0.45.
---@field length? number Factor of the lengths at the edge. Default: 0.8.
---@field baby? number Share of the strands at the edge that are baby hair. Default: 0.35.
---@field baby_length? number Length of baby hair, at most. In metres. Default: 0.022.
---@field stray? number Distance that tips of baby hair lean away. In metres. Default: 0.006.
---@field seed? integer Another seed gives another result of the same kind. Default: 1.

---Makes strands at the hairline finer and shorter, and some of them baby hair.
---@param options lissom.Strands.Soften_edgeOptions
---@return lissom.Strands strands # The strands themselves.
function Strands:soften_edge(options) end

---@class lissom.Strands.ShrinkwrapOptions
---@field head lissom.Hairstyle A style on the head that they grew on.
---@field lift? number Distance above the surface. In metres. Default: 0.003.
---@field factor? number Part of the effect; 0 changes nothing. Default: 1.
---@field mask? number[]|string|lissom.Region|(fun(strand: integer, x: number, y: number, z: number): number|boolean) Part of the effect on each strand, 0 to 1. Default: all strands.
---@field shape? number|number[] Course of the effect along the strand. Default: 0.
---@field keep_length? boolean Segments keep their lengths. Default: true.
---@field seed? integer Another seed gives another result of the same kind. Default: 1.

---Draws strands onto the head.
---@param options lissom.Strands.ShrinkwrapOptions
---@return lissom.Strands strands # The strands themselves.
function Strands:shrinkwrap(options) end

---@class lissom.Strands.InterpolateOptions
---@field style lissom.Hairstyle A style on the head of the guides.
---@field count? integer Number of new strands. Default: 20000.
---@field near? integer Number of guides around a root that a strand is between. Default: 4.
---@field apart? number Guides that are combed to another side than the nearest, by more than this angle, do not count, as at a parting. In degrees. Default: 75.
---@field points? integer Points of each strand. Default: 24.
---@field seed? integer Another seed gives other roots. Default: 1.

---Grows hair between these strands as guides: each new strand is the mean of the nearest, from a root of its own on the scalp.
---@param options lissom.Strands.InterpolateOptions
---@return lissom.Strands strands # The new strands.
function Strands:interpolate(options) end

---@class lissom.Strands.DuplicateOptions
---@field copies? integer Copies of each strand. Default: 4.
---@field radius? number Their roots lie so far from the strand at most. In metres. Default: 0.002.
---@field tip? number Factor of that distance at the tip: 0 brings them to one point. Default: 1.
---@field seed? integer Another seed gives other places. Default: 1.

---Adds copies beside each strand, behind all others.
---@param options? lissom.Strands.DuplicateOptions
---@return lissom.Strands strands # The strands themselves.
function Strands:duplicate(options) end

---@class lissom.Strands.BlendOptions
---@field guides? integer Number of guides: the strands of the lowest ids. Default: 400.
---@field near? integer Number of guides around a root that a strand is between. Default: 4.
---@field factor? number Part of the effect; 0 changes nothing. Default: 1.
---@field mask? number[]|string|lissom.Region|(fun(strand: integer, x: number, y: number, z: number): number|boolean) Part of the effect on each strand, 0 to 1. Default: all strands.
---@field shape? number|number[] Course of the effect along the strand. Default: 0.
---@field keep_length? boolean Segments keep their lengths. Default: true.
---@field seed? integer Another seed gives another result of the same kind. Default: 1.

---Moves strands towards the mean of the guides around them, so that neighbours become alike.
---@param options? lissom.Strands.BlendOptions
---@return lissom.Strands strands # The strands themselves.
function Strands:blend(options) end

---@class lissom.Strands.AttachOptions
---@field head lissom.Hairstyle A style on the head.
---@field snap? boolean Moves each strand so that its root lies on the surface. Default: true.

---Roots strands at the nearest places of a head, as hair that was drawn or loaded: they get faces and texture coordinates.
---@param options lissom.Strands.AttachOptions
---@return lissom.Strands strands # The strands themselves.
function Strands:attach(options) end

---@class lissom.Strands.DetailOptions
---@field from lissom.Strands|string The examples.
---@field span? number Bends shorter than this are details, longer ones the course of a strand. In metres. Default: 0.06.
---@field scale? number Size of the details, as a multiple of that of the examples. Default: 1.
---@field turn? number Details of each guide are turned about the strand by up to this part of a turn, at random. Default: 0.
---@field resample? boolean Strands with longer segments than their example get more points. Default: true.
---@field factor? number Part of the effect; 0 changes nothing. Default: 1.
---@field mask? number[]|string|lissom.Region|(fun(strand: integer, x: number, y: number, z: number): number|boolean) Part of the effect on each strand, 0 to 1. Default: all strands.
---@field shape? number|number[] Course of the effect along the strand. Default: 0.
---@field keep_length? boolean Segments keep their lengths. Default: true.
---@field seed? integer Another seed gives another result of the same kind. Default: 1.

---Gives strands the curls and kinks of examples in place of their own, by differential coordinates along each strand, while its course stays; strands of a guide take those of one example.
---@param options lissom.Strands.DetailOptions
---@return lissom.Strands strands # The strands themselves.
function Strands:detail(options) end

---@class lissom.Strands.DetailsOptions
---@field span? number Bends shorter than this are details, longer ones the course of a strand. In metres. Default: 0.06.

---Takes the details alone: the same strands with straight courses, which hang down from their roots. Saved, they are examples for strands:detail.
---@param options? lissom.Strands.DetailsOptions
---@return lissom.Strands strands # The new strands.
function Strands:details(options) end

---@class lissom.Strands.Feed_braidOptions
---@field spine lissom.Vector[] The middle of the braid.
---@field across lissom.Vector Direction across the braid at its beginning: its widest.
---@field radius? number Radius of each of the three tubes. In metres. Default: 0.0085.
---@field wide? number From the spine to the middle of a tube, across. In metres. Default: 1.25 radii.
---@field high? number The same towards the viewer. In metres. Default: 0.8 radii.
---@field wavelength? number Length of one turn of a tube. In metres. Default: 7 radii.
---@field reach? number A strand joins where it first comes so near to the spine, else at its nearest point within 2.5 times of it. In metres. Default: 0.01.
---@field joined? number Part of the spine within which strands join; below 1 a ring closes that ends on its beginning. Default: 1.
---@field blend? number Over which hair comes into its tube. In metres. Default: 0.02.
---@field min_run? number Least length that a strand runs in the braid. In metres. Default: 0.06.
---@field max_run? number Greatest one. In metres. Default: 0.12.
---@field tail? number Part of the strands that run to the end. Default: 0.
---@field begin_size? number Size at the beginning as a part of that further on. Default: 1.
---@field end_size? number The same at the end. Default: 1.
---@field loose? number Part of the strands that lie loosely. Default: 0.02.
---@field step? number Between points. In metres. Default: 0.002.
---@field drop_others? boolean Removes strands of the mask that come nowhere near the spine. Default: false.
---@field scalp? lissom.Scalp Points are in the unit of its head, as scalp:at gives them. Default: points are in metres of the strands.
---@field seed? integer Another seed gives another braid. Default: 1.
---@field factor? number Part of the effect; 0 changes nothing. Default: 1.
---@field mask? number[]|string|lissom.Region|(fun(strand: integer, x: number, y: number, z: number): number|boolean) Part of the effect on each strand, 0 to 1. Default: all strands.

---Braids strands that join along a spine, as in crown braids and cornrows.
---@param options lissom.Strands.Feed_braidOptions
---@return lissom.Strands strands # The strands themselves.
---@return integer count # Number of strands that joined.
function Strands:feed_braid(options) end

---@class lissom.Strands.BraidOptions
---@field spine lissom.Vector[] The middle of the braid, from its tie on.
---@field across lissom.Vector Direction across the braid: its widest.
---@field radius? number Radius of each of the three tubes. In metres. Default: 0.0125.
---@field reach? number Distance from the spine within which strands pass the tie. In metres. Default: 2.86 radii.
---@field length? number From the tie to the lower tie. In metres. Default: 0.25.
---@field tuft? number Below the lower tie. In metres. Default: 0.04.
---@field wavelength? number Length of one turn of a tube. In metres. Default: 7 radii.
---@field taper? number Part by which it is narrower at its end. Default: 0.35.
---@field blend? number Over which hair comes into its tube. In metres. Default: 0.03.
---@field loose? number Part of the strands that lie loosely. Default: 0.03.
---@field early? number Part of the strands that end early. Default: 0.05.
---@field step? number Between points. In metres. Default: 0.0025.
---@field scalp? lissom.Scalp Points are in the unit of its head, as scalp:at gives them. Default: points are in metres of the strands.
---@field seed? integer Another seed gives another braid. Default: 1.
---@field factor? number Part of the effect; 0 changes nothing. Default: 1.
---@field mask? number[]|string|lissom.Region|(fun(strand: integer, x: number, y: number, z: number): number|boolean) Part of the effect on each strand, 0 to 1. Default: all strands.

---Braids the strands that pass a tie at the beginning of a spine; others stay.
---@param options lissom.Strands.BraidOptions
---@return lissom.Strands strands # The strands themselves.
---@return integer count # Number of strands that pass the tie.
function Strands:braid(options) end

---@class lissom.Strands.BunOptions
---@field center lissom.Vector Center of the tie.
---@field direction lissom.Vector Direction in which hair passes it.
---@field reach? number Distance from the center within which strands pass the tie. In metres. Default: 0.035.
---@field radius? number From the axis to the middle of the torus. In metres. Default: 0.0175.
---@field tube? number Radius of its tube. In metres. Default: 0.0195.
---@field lift? number Height of its middle above the tie. In metres. Default: 0.005.
---@field turn? number Turn of hair around the axis. In degrees. Default: 165.
---@field locks? integer Number of its locks. Default: 9.
---@field loose? number Part of the strands that lie loosely. Default: 0.02.
---@field points? integer Number of points of each strand in the bun. Default: 60.
---@field scalp? lissom.Scalp Points are in the unit of its head, as scalp:at gives them. Default: points are in metres of the strands.
---@field seed? integer Another seed gives another braid. Default: 1.
---@field factor? number Part of the effect; 0 changes nothing. Default: 1.
---@field mask? number[]|string|lissom.Region|(fun(strand: integer, x: number, y: number, z: number): number|boolean) Part of the effect on each strand, 0 to 1. Default: all strands.

---Winds the strands that pass a tie over a torus around it; others stay.
---@param options lissom.Strands.BunOptions
---@return lissom.Strands strands # The strands themselves.
---@return integer count # Number of strands that pass the tie.
function Strands:bun(options) end

---@class lissom.Strands.Guide_setOptions
---@field count? integer Number of guides, for of = "count". Default: 200.
---@field of? "count"|"groups"|"locks" Guides: as many as `count`, one for each group, or one for each guide that strands follow, as one a curl. Default: "count".
---@field points? integer Points of each guide, and of strands that are rebuilt. Default: 16.
---@field shape? number Weight of the difference of two strands' shapes against the distance of their roots. Default: 1.

---Chooses guides for engines and simulations, by k-medoids over place and shape, and finds three of them with weights for each strand.
---@param options? lissom.Strands.Guide_setOptions
---@return lissom.GuideSet set # The guides and weights.
function Strands:guide_set(options) end

---@class lissom.Strands.CardsOptions
---@field count? integer Number of cards. Default: 200.
---@field triangles? integer Triangles of all cards, instead of `sections`. Default: as sections say.
---@field sections? integer Points along each card. Default: 16.
---@field crossed? boolean Clusters about as thick as wide, such as ringlets, have two cards that cross, and there are fewer clusters. Default: true.
---@field slots? integer Pictures in the atlas, which cards that are alike share. Default: 64.
---@field coverage? number Part of the points of its strands that a card is wide enough for. Default: 0.97.
---@field bend? number Normals are those of the card at 0, and those of the head below it at 1. Default: 0.7.
---@field clearance? number Least distance of cards from the head of `style`. In metres. Default: 0.002.
---@field style? lissom.Hairstyle A style on the head of the strands. Default: none: cards may go through the head.
---@field cap? boolean Adds the skin below the hair, a little over it, in its colour. Default: true with `style`.

---Makes cards: strips of triangles along clusters of strands, as games draw hair. `lissom.bake_cards` makes their pictures.
---@param options? lissom.Strands.CardsOptions
---@return lissom.Cards cards # The cards, with a copy of the strands.
function Strands:cards(options) end

---@class lissom.Strands.CheckOptions
---@field target? "unreal"|"unity"|"godot"|"film" Receiver of the hair, whose limits count. Default: "unreal".
---@field head? lissom.Hairstyle A style on the head of the strands. Default: none: roots and depth are not checked.
---@field cards? lissom.Cards Cards that stand for the hair. Default: none.
---@field root_distance? number Distance from the head that a root may have. In metres. Default: 0.005.
---@field depth? number Depth that a point may have in the head. In metres. Default: 0.002.

---Searches for faults that an engine stumbles over: broken, short or doubled strands, widths, root UVs, roots off the head, unit and up axis, guides that do not reach, limits of points, groups and cards. Each has a remedy.
---@param options? lissom.Strands.CheckOptions
---@return lissom.StrandCheck check # The faults found.
function Strands:check(options) end

---@class lissom.Strands.FollowOptions
---@field rest? lissom.Mesh The head with the shape it has under the strands. Default: the head that they grew on or were attached to, as it was then.
---@field scale? number Factor of the strands' lengths. Default: that of the head if it was scaled as a whole, else 1.
---@field ramp? number Length over which hair goes over from the rotation of the skin at its root to that of the head around it. In metres. Default: 0.04.
---@field smoothing? number Length over which rotations of the skin are smoothed. In metres. Default: 0.015.
---@field collision? "none"|"near"|"all" Hair that is kept out of the head: none; points near the skin at rest, over the place below them, which is fast; all. None is pushed farther out than it was at rest. Default: "all".
---@field clearance? number Distance that hair stays off the skin. In metres. Default: 0.0005.

---Moves hair with its head that was bent, morphed, scaled or skinned: roots stay on their places of the skin, lengths stay, or grow with a head that is scaled as a whole. Guides, groups, widths and colours are kept.
---@param head lissom.Mesh The deformed head: the vertices and faces of the one at rest.
---@param options? lissom.Strands.FollowOptions
---@return lissom.Strands strands # New strands.
function Strands:follow(head, options) end

---@class lissom.Strands.TransferOptions
---@field from? lissom.Scalp The scalp of the head that the hair comes from. Default: that of the head that they grew on or were attached to.
---@field scale? number Factor of the strands' lengths. Default: the ratio of the heads' sizes.
---@field push_out? boolean Keeps the hair out of the other head. Default: true.
---@field clearance? number Distance that hair stays off the skin. In metres. Default: 0.0005.

---Puts hair onto another head, of other faces, shape, size, place or unit. Places correspond by their directions from the middles of the heads; the hair follows its head as that takes the shape of the other, and is rooted there. Guides, groups, widths and colours are kept.
---@param scalp lissom.Scalp The scalp of the other head.
---@param options? lissom.Strands.TransferOptions
---@return lissom.Strands strands # New strands.
function Strands:transfer(scalp, options) end

---@class lissom.Strands.FollowerOptions
---@field rest? lissom.Mesh The head with the shape it has under the strands. Default: the head that they grew on or were attached to, as it was then.
---@field scale? number Factor of the strands' lengths. Default: that of the head if it was scaled as a whole, else 1.
---@field ramp? number Length over which hair goes over from the rotation of the skin at its root to that of the head around it. In metres. Default: 0.04.
---@field smoothing? number Length over which rotations of the skin are smoothed. In metres. Default: 0.015.
---@field collision? "none"|"near"|"all" Hair that is kept out of the head: none; points near the skin at rest, over the place below them, which is fast; all. None is pushed farther out than it was at rest. Default: "all".
---@field clearance? number Distance that hair stays off the skin. In metres. Default: 0.0005.

---Prepares hair to follow its head for each frame of an animation.
---@param options? lissom.Strands.FollowerOptions
---@return lissom.StrandFollower follower # The prepared strands, a copy.
function Strands:follower(options) end

---@class lissom.Strands.ShellOptions
---@field triangles? integer Triangles wanted. Default: 2000.
---@field cell? number Distance of the places at which the density of hair is measured; smaller details vanish. In metres. Default: 0.005.
---@field level? number The shell runs where hair is this part, below 1, as dense as most of it is. Default: 0.2.
---@field clearance? number Least distance from the head of `style`. In metres. Default: 0.001.
---@field style? lissom.Hairstyle A style on the head of the strands: there is no surface below hair on the skin, and the mesh is in the unit of the head. Default: none: the surface is closed, in metres.

---Makes one surface around the hair, its coarsest level of detail, with the attributes "normal" and, if the strands have colours, "color", darker where less light arrives. Strands apart from the others are outside of it.
---@param options? lissom.Strands.ShellOptions
---@return lissom.Mesh mesh # The surface.
function Strands:shell(options) end

---@class lissom.Strands.Silhouette_errorOptions
---@field strands? lissom.Strands A level of fewer strands or points. Default: none.
---@field widen? number Factor of the widths of `strands`. Default: 1.
---@field cards? lissom.Cards A level of cards, with the strands drawn on them. Default: none.
---@field mesh? lissom.Mesh A level that is a surface, as `strands:shell` makes. Default: none.
---@field unit? number Length of a unit of `mesh`. In metres. Default: 1.
---@field views? integer Directions around the hair, and as many again from 30 degrees above. Default: 8.
---@field pixel? number Size of a pixel. In metres. Default: 0.002.

---Compares the silhouette of a level of detail with that of the hair, from all sides: the part of the hair's silhouette that only one of the two covers.
---@param options? lissom.Strands.Silhouette_errorOptions
---@return lissom.SilhouetteError error # 0 for equal silhouettes.
function Strands:silhouette_error(options) end

---@class lissom.Strands.LevelsOptions.Strands
---@field count? integer Number of strands, at most those of the hair; else give `screen_size`. Default: as `screen_size` says.
---@field screen_size? number Part of a picture's height that the level is for: so large a part of the strands is kept. Default: as `count` says.
---@field points? integer Points of each strand. Default: they stay.
---@field widen? number Factor of the widths. Default: all strands / kept strands, which keeps the thickness.

---@class lissom.Strands.LevelsOptions.Cards
---@field count? integer Number of cards. Default: 200.
---@field triangles? integer Triangles of all cards, instead of `sections`. Default: as sections say.
---@field sections? integer Points along each card. Default: 16.

---@class lissom.Strands.LevelsOptions.Shell
---@field triangles? integer Triangles wanted. Default: 2000.
---@field cell? number Distance of the places at which the density of hair is measured. In metres. Default: 0.005.

---@class lissom.Strands.LevelsOptions
---@field strands? lissom.Strands.LevelsOptions.Strands[] Up to eight levels of strands, finest first. Default: none; with neither strands, cards nor shell: three of each, and a shell.
---@field cards? lissom.Strands.LevelsOptions.Cards[] Up to eight levels of cards, finest first. Default: none.
---@field shell? lissom.Strands.LevelsOptions.Shell The last level, one surface; {} for the defaults. Default: none.
---@field of? "all"|"groups" Levels of all hair, or of each group, which then has its part of each count; groups that cover no pixel have none. Default: "all".
---@field slots? integer Pictures in the atlas of each level of cards. Default: 64.
---@field style? lissom.Hairstyle A style on the head of the strands: cards and shell stay out of it, and are in the unit of the head. Default: none: cards may go through the head, and the shell is closed.
---@field cap? boolean Adds the skin below the hair to cards, in its colour. Default: true with `style`.
---@field width? number Diameter that stands for full hair in silhouettes and on cards: a few thousand strands of a natural one leave holes. In metres. Default: their own.
---@field views? integer Directions around the hair, and as many again from 30 degrees above. Default: 8.
---@field pixel? number Size of a pixel of silhouettes. In metres. Default: 0.002.

---Makes levels of detail, finest first: fewer and wider strands, then cards, then a shell. Each tells the error of its silhouette, and up to what part of a picture's height it suffices. Strands of a level are those of the first n, for every n, spread over the head.
---@param options? lissom.Strands.LevelsOptions
---@return lissom.HairLevel[] levels # The levels, group by group.
function Strands:levels(options) end

---Frees the contents of the object. It may be called again; any other use is an error then.
function Strands:close() end

---A few strands that move, and all others as sums of three of them.
---@class lissom.GuideSet
---@operator len: integer
local GuideSet = {}

---The guides, as strands with points at equal steps and the ids of the strands that they are.
---@return lissom.Strands guides # In the order that weights count them.
function GuideSet:guides() end

---A strand as a sum of guides: its points are root + length * (the weighted sum of the guides' points less their roots).
---@param strand integer Its number among the strands that the set was made of.
---@return lissom.GuideWeights weights # The guide of the greatest weight first.
function GuideSet:weights(strand) end

---Distances between the strands and their sums of guides, without details.
---@return lissom.GuideError error # Over all points.
function GuideSet:error() end

---@class lissom.GuideSet.RebuildOptions
---@field guides? lissom.Strands Moved guides, with as many points as those of `guides`. Default: those at rest.
---@field details? boolean Adds the differences of the strands from their sums. Default: true.

---All strands from the guides, as lissom_hair.h does it in an engine.
---@param options? lissom.GuideSet.RebuildOptions
---@return lissom.Strands strands # In the order of the strands.
function GuideSet:rebuild(options) end

---@class lissom.GuideSet.SaveOptions
---@field details? boolean Writes the details, six bytes a point. Default: true.

---Writes a guide file, which bindings/engine/lissom_hair.h reads, whole or not at all.
---@param path string The file.
---@param options? lissom.GuideSet.SaveOptions
---@return lissom.GuideSet set # The set itself.
function GuideSet:save(path, options) end

---@class lissom.GuideSet.DynamicsOptions.Ties
---@field name? string Name, for messages and files. Default: "tie".
---@field center lissom.Vector Its center, in metres of the strands.
---@field radius? number Its radius. In metres. Default: 0.02.

---@class lissom.GuideSet.DynamicsOptions
---@field head? lissom.Hairstyle A style on the head that they grew on: its body keeps the hair out. Default: no body.
---@field ties? lissom.GuideSet.DynamicsOptions.Ties[] Balls that hold the hair in them to the head, as elastics and pins do. Default: those of the ponytails of `head`.
---@field bound? string[] Groups of strands whose guides are bound to one another wherever they touch, as in a braid. Default: none.
---@field reach? number Distance of points of two guides up to which they are linked. In metres. Default: 0.015.
---@field links? integer Links of a point to others, at most. Default: 2.
---@field capsules? integer Capsules that stand for the body in files, at most. Default: 12.
---@field gravity? lissom.Vector Gravity in the world. In m/s^2. Default: 9.81 down, by the head, else along -y.
---@field wind? lissom.Vector Speed of the air in the world. In m/s. Default: {0, 0, 0}.
---@field gusts? number Part of the wind that comes and goes. Default: 0.5.
---@field stiffness? number Length of a straight strand that droops by an eighth of it if its root is held level. Hair as it is: 0.05; with gel: 0.2. In metres. Default: 0.05.
---@field hold? number Part of the weight at rest that the style carries: with 1 it stays as it is until head or wind move it. Default: 0.
---@field drag? number Rate at which hair takes the speed of the air. In 1/s. Default: 4.
---@field cohesion? number Strength of links between guides that are not bound. Default: 0.2.
---@field friction? number Friction at the body. Default: 0.4.
---@field clearance? number Distance that hair stays off the body, if it did so at rest. In metres. Default: 0.001.
---@field substeps? integer Steps in a thirtieth of a second. Default: 20.
---@field seed? integer Seed of the gusts. Default: 1.

---Prepares the guides to move: rods that gravity, wind and the motion of the head bend, to see whether a style holds.
---@param options? lissom.GuideSet.DynamicsOptions
---@return lissom.HairDynamics dynamics # The hair at rest.
function GuideSet:dynamics(options) end

---Frees the contents of the object. It may be called again; any other use is an error then.
function GuideSet:close() end

---Strips of triangles that stand for strands, and slots of an atlas.
---@class lissom.Cards
---@operator len: integer
local Cards = {}

---The triangles: a copy, in the unit of the head of `style`, else in metres. It has "uv", "normal", "tangent" towards the tip, "color" (light from all around, and alpha that ends the cap), "color2" (the same light, 0 at the root to 1 at the tip, a number of the card) and the material "hair".
---@return lissom.Mesh mesh # The mesh.
function Cards:mesh() end

---Counts, and how well the strands lie on their cards.
---@return lissom.CardStats stats # The measures.
function Cards:stats() end

---Frees the contents of the object. It may be called again; any other use is an error then.
function Cards:close() end

---Strands prepared for the motion of their head.
---@class lissom.StrandFollower
---@operator len: integer
local StrandFollower = {}

---@class lissom.StrandFollower.FollowOptions
---@field into? lissom.Strands Strands whose place the moved ones take. Default: new strands.

---Moves the hair with its head in another shape, as `strands:follow`.
---@param head lissom.Mesh The deformed head: the vertices and faces of the one at rest.
---@param options? lissom.StrandFollower.FollowOptions
---@return lissom.Strands strands # The moved strands.
function StrandFollower:follow(head, options) end

---Frees the contents of the object. It may be called again; any other use is an error then.
function StrandFollower:close() end

---Guides in motion, and their rig.
---@class lissom.HairDynamics
local HairDynamics = {}

---@class lissom.HairDynamics.StepOptions.Rotate
---@field axis "x"|"y"|"z"|lissom.Vector Axis of the rotation.
---@field angle number Angle, counter-clockwise seen against the axis. In degrees.
---@field about? lissom.Vector A point on the axis. Default: the origin.

---@class lissom.HairDynamics.StepOptions
---@field head? number[][] Place of the head in the world, metres; instead of the others. Default: that of the others.
---@field translate? lissom.Vector Translation of the head in the world, from its place at the beginning; added last. In metres. Default: with rotate none, else that of the present place.
---@field rotate? lissom.HairDynamics.StepOptions.Rotate Rotation of the head from that at the beginning. Default: with translate none, else that of the present place.

---Moves the hair on, while the head goes evenly from its present place to the one given. The same for any number of threads.
---@param seconds number Time of the step.
---@param options? lissom.HairDynamics.StepOptions
---@return lissom.HairDynamics dynamics # The dynamics itself.
function HairDynamics:step(seconds, options) end

---@class lissom.HairDynamics.SetOptions
---@field gravity? lissom.Vector Gravity in the world. In m/s^2. Default: as it is.
---@field wind? lissom.Vector Speed of the air in the world. In m/s. Default: as it is.
---@field gusts? number Part of the wind that comes and goes. Default: as it is.
---@field stiffness? number Length of a straight strand that droops by an eighth of it if its root is held level. Hair as it is: 0.05; with gel: 0.2. In metres. Default: as it is.
---@field hold? number Part of the weight at rest that the style carries: with 1 it stays as it is until head or wind move it. Default: as it is.
---@field drag? number Rate at which hair takes the speed of the air. In 1/s. Default: as it is.
---@field cohesion? number Strength of links between guides that are not bound. Default: as it is.
---@field friction? number Friction at the body. Default: as it is.
---@field clearance? number Distance that hair stays off the body, if it did so at rest. In metres. Default: as it is.
---@field substeps? integer Steps in a thirtieth of a second. Default: as it is.
---@field seed? integer Seed of the gusts. Default: as it is.

---Changes options of the next steps.
---@param options? lissom.HairDynamics.SetOptions
---@return lissom.HairDynamics dynamics # The dynamics itself.
function HairDynamics:set(options) end

---Puts hair and head back to the beginning.
---@return lissom.HairDynamics dynamics # The dynamics itself.
function HairDynamics:reset() end

---The guides as they are now, in the space of the head.
---@return lissom.Strands guides # As `guides` of the set.
function HairDynamics:guides() end

---@class lissom.HairDynamics.StrandsOptions
---@field details? boolean Adds the differences of the strands from their sums. Default: true.
---@field into? lissom.Strands Strands of the set, which take the new places and keep all else. Default: new strands.

---All strands as they are now, in the space of the head, as `rebuild` of the set makes them.
---@param options? lissom.HairDynamics.StrandsOptions
---@return lissom.Strands strands # In the order of the strands.
function HairDynamics:strands(options) end

---How far the hair is from the style at rest, and how fast it moves.
---@return lissom.HairMotion motion # As seen from the head.
function HairDynamics:motion() end

---Ties, links and capsules, as a simulation of an engine takes them.
---@return lissom.HairRig rig # A copy.
function HairDynamics:rig() end

---Writes the rig as JSON, whole or not at all: guides with lengths and root frames, ties, links, capsules, and the length of each strand at rest.
---@param path string The file.
---@return lissom.HairDynamics dynamics # The dynamics itself.
function HairDynamics:save(path) end

---Frees the contents of the object. It may be called again; any other use is an error then.
function HairDynamics:close() end

---Named objects in an order, with a history of their changes.
---@class lissom.Scene
---@operator len: integer
local Scene = {}

---@class lissom.Scene.AddOptions.Style
---@field color? string|lissom.Vector Colour of the object, instead of that of its kind.
---@field vertex_colors? boolean Draws the attribute "color" of a mesh, if any.
---@field shading? "smooth"|"flat" Smooth normals, or one a face.
---@field crease? number Edges sharper than this angle stay sharp. In degrees.
---@field wire? boolean Draws the polygons' edges.
---@field wire_color? string|lissom.Vector Their colour.
---@field wire_width? number Their width. In pixels.
---@field line_width? number Width of curves and open boundaries. In pixels.
---@field boundaries? boolean Draws the loops of open boundaries.
---@field region? string The named region of a mesh to draw in a colour of its own; "": none.
---@field handles? boolean Draws region and handles of a deformation.
---@field level? number Part of the strands that is drawn.

---@class lissom.Scene.AddOptions
---@field transform? number[][] Its place in the scene: rows of a 4 x 4 matrix. The object's own coordinates stay.
---@field visible? boolean Whether it is drawn.
---@field style? lissom.Scene.AddOptions.Style Its style; options that are left out stay.

---Adds an object under a name, behind all others. The scene holds the object itself, not a copy: changes of the object show in the scene.
---@param name string A name that no object of the scene has.
---@param object lissom.Mesh|lissom.Deformer|lissom.Strands|lissom.Hairstyle|lissom.Polyline The object to add.
---@param options? lissom.Scene.AddOptions
---@return any object # The object.
function Scene:add(name, object, options) end

---The object of a name.
---@param name string The name of the object.
---@return any object # The very object that was added.
function Scene:get(name) end

---Number, kind, place and look of an object.
---@param name string The name of the object.
---@return lissom.SceneEntry entry # A table of its own.
function Scene:info(name) end

---The names of all objects, in their order.
---@return string[] names # A list.
function Scene:names() end

---Takes an object out of the scene. The object itself lives on.
---@param name string The name of the object.
---@return lissom.Scene scene # The scene itself.
function Scene:remove(name) end

---Gives an object another name.
---@param name string The name of the object.
---@param new_name string A name that no other object has.
---@return lissom.Scene scene # The scene itself.
function Scene:rename(name, new_name) end

---Gives an object another place in the order.
---@param name string The name of the object.
---@param place integer Its place; 1 is the first.
---@return lissom.Scene scene # The scene itself.
function Scene:move(name, place) end

---@class lissom.Scene.SetOptions.Style
---@field color? string|lissom.Vector Colour of the object, instead of that of its kind.
---@field vertex_colors? boolean Draws the attribute "color" of a mesh, if any.
---@field shading? "smooth"|"flat" Smooth normals, or one a face.
---@field crease? number Edges sharper than this angle stay sharp. In degrees.
---@field wire? boolean Draws the polygons' edges.
---@field wire_color? string|lissom.Vector Their colour.
---@field wire_width? number Their width. In pixels.
---@field line_width? number Width of curves and open boundaries. In pixels.
---@field boundaries? boolean Draws the loops of open boundaries.
---@field region? string The named region of a mesh to draw in a colour of its own; "": none.
---@field handles? boolean Draws region and handles of a deformation.
---@field level? number Part of the strands that is drawn.

---@class lissom.Scene.SetOptions
---@field transform? number[][] Its place in the scene: rows of a 4 x 4 matrix. The object's own coordinates stay.
---@field visible? boolean Whether it is drawn.
---@field style? lissom.Scene.SetOptions.Style Its style; options that are left out stay.

---Changes an object's place and style; options that are left out stay.
---@param name string The name of the object.
---@param options? lissom.Scene.SetOptions
---@return lissom.Scene scene # The scene itself.
function Scene:set(name, options) end

---Runs a function whose changes of the scene and its objects are one step, which undo takes back. After an error in it the scene and its objects are as they were, and the error goes on. A step inside a step becomes part of that. The function cannot yield; in a coroutine use begin and commit.
---@param name string Its name for undo.
---@param action fun(): any The function to run.
---@return any ... # The results of the function.
function Scene:step(name, action) end

---Opens a step, for instance when a drag begins; commit or rollback ends it.
---@param name string Its name for undo.
---@return lissom.Scene scene # The scene itself.
function Scene:begin(name) end

---Ends the step opened last. A step in which nothing changed is none.
---@return boolean changed # Whether anything changed.
function Scene:commit() end

---Ends the step opened last and takes back its changes.
---@return lissom.Scene scene # The scene itself.
function Scene:rollback() end

---Number of steps that are open.
---@return integer depth # 0 outside steps.
function Scene:depth() end

---Takes back the last step: the contents go back into the objects themselves. Changes outside a step are a step called "edited".
---@return string|nil name # The name of the step; nil if there is none.
function Scene:undo() end

---Does the step again that was undone last. A new step forgets those that were undone.
---@return string|nil name # The name of the step; nil if there is none.
function Scene:redo() end

---The steps, and their memory.
---@return lissom.History history # A table of its own.
function Scene:history() end

---Forgets all steps; the scene stays as it is.
---@return lissom.Scene scene # The scene itself.
function Scene:clear_history() end

---Hash of names, order, looks and contents of all objects; the same on every machine, whatever led to the scene.
---@return string hash # 16 hexadecimal digits.
function Scene:hash() end

---@class lissom.Scene.SaveOptions
---@field form? "automatic"|"file"|"folder" Kind of file to write, whichever the path looks like. Default: automatic.
---@field history? boolean Keeps the steps too: in a folder as its file history.tar, in which steps share their common content. Default: false.

---Writes the scene, whole or not at all: objects with their looks, regions, handles, curves and parameters, to the bit. A file is an uncompressed tar archive. A folder is for looking at and for version control: scene.json describes the scene, meshes and strands are OBJ files under the names of the objects, lists of numbers are text, and only changed files are written; other files in it stay.
---@param path string A file, usually with the extension .lissom, or a folder: one that is there, ends with "/", or has no extension and is new.
---@param options? lissom.Scene.SaveOptions
---@return lissom.Scene scene # The scene itself.
---@return string[] left_out # Content without a place in the file, a sentence each: materials and skeletons of meshes.
function Scene:save(path, options) end

---Keeps values of a tool or script with the scene: they are saved with it. They are no part of its history nor of its hash. A lissom.tool_host does this with the parameters of its tools.
---@param owner string Their owner: the name of the tool or script.
---@param values table|lissom.Params The new values, in place of the former ones.
---@return lissom.Scene scene # The scene itself.
function Scene:set_parameters(owner, values) end

---The values that are kept for a tool or script.
---@param owner string Their owner: the name of the tool or script.
---@return table|nil values # By name; nil if there are none.
function Scene:parameters(owner) end

---Frees the contents of the object. It may be called again; any other use is an error then.
function Scene:close() end

---A curve through points in space: a drawn stroke, a guide.
---@class lissom.Polyline
---@operator len: integer
local Polyline = {}

---Its points.
---@return lissom.Vector[] points # A list of {x, y, z}.
function Polyline:points() end

---Replaces its points.
---@param points lissom.Vector[] Any number of them.
---@return lissom.Polyline line # The polyline itself.
function Polyline:set_points(points) end

---@class lissom.Polyline.TransformOptions.Rotate
---@field axis "x"|"y"|"z"|lissom.Vector Axis of the rotation.
---@field angle number Angle, counter-clockwise seen against the axis. In degrees.
---@field about? lissom.Vector A point on the axis. Default: the option `about`.

---@class lissom.Polyline.TransformOptions
---@field translate? lissom.Vector Added last. In mesh units. Default: {0, 0, 0}.
---@field rotate? lissom.Polyline.TransformOptions.Rotate Applied after the scale. Default: none.
---@field scale? number|lissom.Vector Factor for all axes, or one for each; applied first. Default: 1.
---@field about? lissom.Vector The point that scale and rotation keep. Default: the origin.

---Scales, then rotates, then translates all points.
---@param options? lissom.Polyline.TransformOptions
---@return lissom.Polyline line # The polyline itself.
function Polyline:transform(options) end

---Whether its last point is joined to the first.
---@return boolean closed # Whether it was made closed.
function Polyline:is_closed() end

---Its length.
---@return number length # In the unit of its points.
function Polyline:length() end

---Frees the contents of the object. It may be called again; any other use is an error then.
function Polyline:close() end

---View of a world in a picture. It does not change. Pixels count from the top left corner of the picture.
---@class lissom.Camera
local Camera = {}

---Position of the camera.
---@return number[] vector # {x, y, z}.
function Camera:eye() end

---The point in the middle of the picture.
---@return number[] vector # {x, y, z}.
function Camera:target() end

---Unit vector to the right of the picture.
---@return number[] vector # {x, y, z}.
function Camera:right() end

---Unit vector upwards in the picture, orthogonal to the view.
---@return number[] vector # {x, y, z}.
function Camera:up() end

---Unit vector into the scene.
---@return number[] vector # {x, y, z}.
function Camera:forward() end

---Vertical opening angle in degrees.
---@return number? angle # nil for a camera without perspective.
function Camera:fov() end

---Height of the picture in world units, of a camera without perspective.
---@return number? height # nil for a camera with perspective.
function Camera:ortho() end

---Image of a point: pixels from the top left, and its depth along the view. With perspective, x and y are NaN for a point that is not in front of the camera.
---@param point lissom.Vector The point.
---@param size? integer|integer[] {width, height} of the picture in pixels; one number for a square. Default: {1280, 960}.
---@return number x # Pixels to the right.
---@return number y # Pixels down.
---@return number depth # Mesh units.
---@overload fun(self: lissom.Camera, x: number, y: number, z: number, size?: integer|integer[]): number
function Camera:project(point, size) end

---The inverse of project.
---@param pixel lissom.Vector {x, y, depth}.
---@param size? integer|integer[] {width, height} of the picture in pixels; one number for a square. Default: {1280, 960}.
---@return number[] point # The point, {x, y, z}.
---@overload fun(self: lissom.Camera, x: number, y: number, z: number, size?: integer|integer[]): number[]
function Camera:unproject(pixel, size) end

---The ray of points that are seen at a pixel; mesh:pick takes it.
---@param x number Pixels from the left.
---@param y number Pixels from the top.
---@param size? integer|integer[] {width, height} of the picture in pixels; one number for a square. Default: {1280, 960}.
---@return number[] origin # Start of the ray.
---@return number[] direction # Direction of the ray; unit length.
function Camera:ray(x, y, size) end

---Turns it about its target, as a drag by so many pixels does: across the height of the picture by half a turn; up and down no further than along its up.
---@param right number Pixels to the right.
---@param down number Pixels down.
---@param size? integer|integer[] {width, height} of the picture in pixels; one number for a square. Default: {1280, 960}.
---@return lissom.Camera camera # Another camera.
function Camera:orbit(right, down, size) end

---Moves it beside itself: points as far away as its target follow the drag.
---@param right number Pixels to the right.
---@param down number Pixels down.
---@param size? integer|integer[] {width, height} of the picture in pixels; one number for a square. Default: {1280, 960}.
---@return lissom.Camera camera # Another camera.
function Camera:pan(right, down, size) end

---@class lissom.Camera.ZoomOptions
---@field extent? number Size of the object: its distance stays between 1e-6 and 1e6 times that. Default: 1.

---Comes nearer to the point seen at a pixel, which stays there.
---@param x number Pixels from the left.
---@param y number Pixels from the top.
---@param factor number 2: half the distance, 0.5: twice the distance.
---@param size? integer|integer[] {width, height} of the picture in pixels; one number for a square. Default: {1280, 960}.
---@param options? lissom.Camera.ZoomOptions
---@return lissom.Camera camera # Another camera.
function Camera:zoom(x, y, factor, size, options) end

---@class lissom.Camera.FrameOptions
---@field margin? number Share of the picture left free on every side. Default: 0.06.

---Looks in the same direction at the box around points, as near as the margin allows.
---@param points lissom.Vector[] The points to show.
---@param size? integer|integer[] {width, height} of the picture in pixels; one number for a square. Default: {1280, 960}.
---@param options? lissom.Camera.FrameOptions
---@return lissom.Camera camera # Another camera.
function Camera:frame(points, size, options) end

---The camera without perspective, or with it, that shows as much as far away as its target is.
---@param parallel boolean Without perspective.
---@return lissom.Camera camera # Another camera.
function Camera:parallel(parallel) end

---@class lissom.Camera.PickOptions
---@field scene? lissom.Scene Its visible objects, in their places: meshes, deformations, free curves, the curves of hairstyles, and for polylines the strands of hair.
---@field mesh? lissom.Mesh A mesh in its own coordinates.
---@field meshes? lissom.Mesh[] Several such meshes.
---@field x number Pixels from the left edge of the picture.
---@field y number Pixels from its top.
---@field size? integer|integer[] {width, height} of the picture in pixels; one number for a square. Default: {1280, 960}.
---@field points? lissom.Vector[] Points of the world, such as the middles of handles.
---@field points_on_top? boolean They are drawn over everything, and no surface hides them. Default: true.
---@field kinds? "point"|"polyline"|"vertex"|"boundary"|"edge"|"face"|string[] Kinds to look for, in this order of preference regardless of the order given: point, polyline, vertex, boundary, edge, face. Default: "face".
---@field radius? number Distance from the pixel within which all but faces are picked. In pixels. Default: 8.
---@field through? boolean Includes elements hidden by surfaces. Default: false.
---@field back_faces? boolean Faces that are seen from behind count; if not, they neither are picked nor hide anything. Default: true.

---Picks under a pixel: of the kinds looked for the first that has anything within the radius, and of that the nearest in pixels that no surface hides.
---@param options lissom.Camera.PickOptions
---@return lissom.PickHit? hit # nil if there is nothing.
function Camera:pick(options) end

---@class lissom.Camera.Pick_allOptions
---@field scene? lissom.Scene Its visible objects, in their places: meshes, deformations, free curves, the curves of hairstyles, and for polylines the strands of hair.
---@field mesh? lissom.Mesh A mesh in its own coordinates.
---@field meshes? lissom.Mesh[] Several such meshes.
---@field x number Pixels from the left edge of the picture.
---@field y number Pixels from its top.
---@field size? integer|integer[] {width, height} of the picture in pixels; one number for a square. Default: {1280, 960}.
---@field points? lissom.Vector[] Points of the world, such as the middles of handles.
---@field points_on_top? boolean They are drawn over everything, and no surface hides them. Default: true.
---@field kinds? "point"|"polyline"|"vertex"|"boundary"|"edge"|"face"|string[] Kinds to look for, in this order of preference regardless of the order given: point, polyline, vertex, boundary, edge, face. Default: "face".
---@field radius? number Distance from the pixel within which all but faces are picked. In pixels. Default: 8.
---@field through? boolean Includes elements hidden by surfaces. Default: false.
---@field back_faces? boolean Faces that are seen from behind count; if not, they neither are picked nor hide anything. Default: true.
---@field most? integer At most so many. Default: 1000.

---All that lies under a pixel, in the order in which pick prefers it; with `through` all faces along the ray.
---@param options lissom.Camera.Pick_allOptions
---@return lissom.PickHit[] hits # A list.
function Camera:pick_all(options) end

---@class lissom.Camera.SelectOptions.Brush
---@field stroke number[][] Positions of its middle; one point is a dab.
---@field radius? number Radius of the disk. In pixels. Default: 20.

---@class lissom.Camera.SelectOptions
---@field scene? lissom.Scene Its visible objects, in their places: meshes, deformations, free curves, the curves of hairstyles, and for polylines the strands of hair.
---@field mesh? lissom.Mesh A mesh in its own coordinates.
---@field meshes? lissom.Mesh[] Several such meshes.
---@field rectangle? number[][] Two opposite corners, {{x, y}, {x, y}}.
---@field lasso? number[][] An outline, which is closed: selects elements that it goes around at least once.
---@field brush? lissom.Camera.SelectOptions.Brush A disk that is moved along a stroke.
---@field size? integer|integer[] {width, height} of the picture in pixels; one number for a square. Default: {1280, 960}.
---@field what? "vertices"|"faces" Vertices that are seen inside; or faces of which the centroid of a triangle is, and under a brush also those that it touches. Default: "vertices".
---@field through? boolean Includes elements hidden by surfaces. Default: false.
---@field back_faces? boolean Faces that are seen from behind count; if not, neither they nor their vertices are selected, and they hide nothing. Default: true.
---@field known? lissom.Region[] Vertices that were found before, or found unseen by the same camera, which are left out: the cost of a long stroke then depends only on the new vertices under it.

---Selects the visible elements in a rectangle, inside a lasso or under a brush. Pixels may lie outside the picture.
---@param options? lissom.Camera.SelectOptions
---@return lissom.Selected[] selected # One for each surface, in order.
function Camera:select(options) end

---@class lissom.Camera.StrokeOptions.Plane
---@field point lissom.Vector A point of the plane.
---@field normal lissom.Vector Its normal; any length.

---@class lissom.Camera.StrokeOptions
---@field points number[][] Positions of the pen.
---@field times? number[] Seconds, one for each point; they tell a click.
---@field pressures? number[] 0 to 1, one for each point.
---@field on? lissom.Scalp|lissom.Strands|lissom.Mesh|lissom.Support|lissom.Curve The surface drawn on. Default: only on the picture.
---@field plane? lissom.Camera.StrokeOptions.Plane The plane that is drawn on.
---@field depth? "envelope"|"last" On a scalp: in front of all of the head, changing gently; or as deep as the scalp, and beyond it as deep as it was left (section 4.5). Default: "envelope".
---@field lift? number Distance in front of the surface; of a scalp in metres of an average head. Default: 0.02 on a scalp by the envelope, else 0.
---@field smoothing? number Multiple of the smoothing that suits a mouse; 0 keeps every wiggle. Default: 1.
---@field spacing? number Between two points of the result. In pixels. Default: 4.
---@field scale? number Pixels of the picture to a logical one, on dense screens. Default: 1.
---@field size? integer|integer[] {width, height} of the picture in pixels; one number for a square. Default: {1280, 960}.

---A line that a hand drew on the picture, as it was meant: without hooks at its ends, fair between its corners, and put into the world by a rule of depth. On a scalp it is the course of a stream curve, in front of the head wherever it goes; beyond the silhouette its depth is a guess, to be drawn again from another view.
---@param options lissom.Camera.StrokeOptions
---@return lissom.DrawnStroke stroke # The line.
function Camera:stroke(options) end

---Frees the contents of the object. It may be called again; any other use is an error then.
function Camera:close() end

---Axes, planes and rings around a point, by which a hand moves, turns and scales. It draws nothing and moves nothing: it returns the shape to draw, the part under a pixel, and the motion of a drag.
---@class lissom.Gizmo
local Gizmo = {}

---@class lissom.Gizmo.HitOptions
---@field reach? number Distance within which a part is picked. In pixels. Default: 7.

---The part under a pixel. Axes that are seen end-on and planes from the side are not offered.
---@param camera lissom.Camera The camera that it is seen by.
---@param size integer|integer[] {width, height} of the picture in pixels; one number for a square.
---@param x number Pixels from the left.
---@param y number Pixels from the top.
---@param options? lissom.Gizmo.HitOptions
---@return string? part # "move-x", "move-yz", "rotate-view", "scale-all", ...; nil for none.
function Gizmo:hit(camera, size, x, y, options) end

---Begins a drag: holds a part at the pixel. The camera is that of the whole drag.
---@param part "move-x"|"move-y"|"move-z"|"move-yz"|"move-zx"|"move-xy"|"move-view"|"rotate-x"|"rotate-y"|"rotate-z"|"rotate-view"|"scale-x"|"scale-y"|"scale-z"|"scale-all" The part, as hit names it.
---@param camera lissom.Camera The camera that it is seen by.
---@param size integer|integer[] {width, height} of the picture in pixels; one number for a square.
---@param x number Pixels from the left.
---@param y number Pixels from the top.
---@return lissom.Gizmo gizmo # The gizmo itself.
function Gizmo:begin(part, camera, size, x, y) end

---@class lissom.Gizmo.DragOptions
---@field snap? boolean Whole steps only, counted from begin. Default: false.
---@field precise? boolean A tenth as far, from here on. Default: false.

---The pixel has moved. The part stays under it, but lags behind in degenerate views: end-on, from the side, near the horizon. A pixel that is back undoes all but full turns.
---@param x number Pixels from the left.
---@param y number Pixels from the top.
---@param options? lissom.Gizmo.DragOptions
---@return lissom.GizmoMotion motion # The motion since begin.
function Gizmo:drag(x, y, options) end

---A typed number in place of the pixel, not snapped: a length along the axis, degrees, a factor; in a plane two lengths along its axes.
---@param first number The number.
---@param second? number The second, in a plane. Default: 0.
---@return lissom.GizmoMotion motion # The motion since begin.
function Gizmo:set_amount(first, second) end

---The motion since begin; nil if no part is held.
---@return lissom.GizmoMotion? motion # Same as drag returned.
function Gizmo:motion() end

---The part that is held.
---@return string? part # nil if none is.
function Gizmo:part() end

---Ends the drag. The gizmo keeps its moved place.
---@return lissom.GizmoMotion motion # The motion since begin.
function Gizmo:finish() end

---Ends the drag, if there is one. The gizmo goes back to its former place.
---@return lissom.Gizmo gizmo # The gizmo itself.
function Gizmo:cancel() end

---@class lissom.Gizmo.SetOptions.Steps
---@field length? number Of moves. Default: 1, 2 or 5 times a power of ten that is seen as 10 pixels or more.
---@field angle? number Of turns. In degrees. Default: 15.
---@field factor? number Of scaling. Default: 0.1.

---@class lissom.Gizmo.SetOptions
---@field origin? lissom.Vector The point that it stands at, and that turns and scaling are about. Default: {0, 0, 0}.
---@field mode? "move"|"rotate"|"scale"|"all" Mode of its parts. Default: all.
---@field axes? "world"|"local"|"view" Directions of its axes: the world's, those of `local_axes`, or to the right, upwards and to the viewer. Default: world.
---@field local_axes? number[][] Rows of a rotation; its columns are the object's axes.
---@field size? number Length of an axis, the same at every distance. In pixels. Default: 90.
---@field steps? lissom.Gizmo.SetOptions.Steps The steps of snapping.

---Changes options; those that are left out stay.
---@param options? lissom.Gizmo.SetOptions
---@return lissom.Gizmo gizmo # The gizmo itself.
function Gizmo:set(options) end

---Its position; during a drag the moved one.
---@return number[] point # {x, y, z}.
function Gizmo:origin() end

---Its three axes in a view, of unit length.
---@param camera lissom.Camera The camera that it is seen by.
---@return number[] x # The first.
---@return number[] y # The second.
---@return number[] z # The third.
function Gizmo:axes(camera) end

---@class lissom.Gizmo.ShapeOptions
---@field x? number The pixel, from the left.
---@field y? number The pixel, from the top.

---Shape to draw; the part that is held, or else under a pixel, is highlighted.
---@param camera lissom.Camera The camera that it is seen by.
---@param size integer|integer[] {width, height} of the picture in pixels; one number for a square.
---@param options? lissom.Gizmo.ShapeOptions
---@return lissom.GizmoShape shape # Empty if it lies behind the camera.
function Gizmo:shape(camera, size, options) end

---Frees the contents of the object. It may be called again; any other use is an error then.
function Gizmo:close() end

---A surface through a curve, on which strokes about the curve are drawn; see lissom.Curve:support.
---@class lissom.Support
local Support = {}

---Kind of the surface.
---@return string mode # "ruled" or "strip".
function Support:mode() end

---Fraction of the curve that is seen end-on from the viewpoint, at which a surface says little of it. Warn above a third, and take another viewpoint.
---@return number share # Fraction of its length, 0 to 1.
function Support:end_on() end

---Cosine at which a camera sees the surface. Strokes need 0.3.
---@param camera lissom.Camera The camera.
---@return number cosine # 0, seen edge-on, to 1.
function Support:seen_from(camera) end

---Its two edges, for drawing it with view:surface.
---@return lissom.Vector[] first # From the root to beyond the tip.
---@return lissom.Vector[] second # Likewise, as many points.
function Support:edges() end

---The surface as a mesh: two vertices and two triangles a line.
---@return lissom.Mesh mesh # A new mesh.
function Support:mesh() end

---First intersection with a ray.
---@param origin lissom.Vector Start of the ray.
---@param direction lissom.Vector Its direction; any length.
---@return lissom.SupportPoint? hit # nil if there is none.
---@overload fun(self: lissom.Support, origin_x: number, origin_y: number, origin_z: number, direction_x: number, direction_y: number, direction_z: number): lissom.SupportPoint?
function Support:pick(origin, direction) end

---Frees the contents of the object. It may be called again; any other use is an error then.
function Support:close() end

---A tool draws on it, over the picture. Each method returns the view.
---@class lissom.ToolView
---@field camera lissom.Camera The camera that the scene is seen by.
---@field scene lissom.Scene The scene.
---@field size integer[] {width, height} of the picture in pixels.
---@field up "y"|"z" The axis of the world that points up in views.
---@field cursor number[]? Position of the cursor, if it is known.
local ToolView = {}

---@class lissom.ToolView.PointsOptions
---@field points lissom.Vector[] The points.
---@field color? string "#rrggbb". Default: the usual one.
---@field radius? number Their radius. In pixels. Default: 5.

---Draws balls at points of the world.
---@param options lissom.ToolView.PointsOptions
---@return lissom.ToolView view # The view itself.
function ToolView:points(options) end

---@class lissom.ToolView.HandleOptions
---@field at lissom.Vector A point of the world.
---@field color? string "#rrggbb". Default: "#e8a33d".
---@field radius? number Its radius. In pixels. Default: 7.

---Draws a ball to take hold of.
---@param options lissom.ToolView.HandleOptions
---@return lissom.ToolView view # The view itself.
function ToolView:handle(options) end

---@class lissom.ToolView.LabelOptions
---@field at lissom.Vector The point.
---@field text? string The text. Default: "".
---@field color? string "#rrggbb". Default: the usual one.

---Writes text at a point of the world; long lines are wrapped.
---@param options lissom.ToolView.LabelOptions
---@return lissom.ToolView view # The view itself.
function ToolView:label(options) end

---@class lissom.ToolView.LineOptions
---@field points lissom.Vector[] Points of the world.
---@field color? string "#rrggbb". Default: the usual one.
---@field width? number Its width. In pixels. Default: 3.
---@field closed? boolean Goes back to its first point. Default: false.

---Draws a line in the world.
---@param options lissom.ToolView.LineOptions
---@return lissom.ToolView view # The view itself.
function ToolView:line(options) end

---@class lissom.ToolView.CurveOptions
---@field points lissom.Vector[] Points of the world.
---@field color? string "#rrggbb". Default: the usual one.
---@field width? number Its width. In pixels. Default: 3.
---@field closed? boolean Goes back to its first point. Default: false.

---Draws a line in the world, as line.
---@param options lissom.ToolView.CurveOptions
---@return lissom.ToolView view # The view itself.
function ToolView:curve(options) end

---@class lissom.ToolView.OutlineOptions
---@field pixels number[][] From the top left corner of the picture.
---@field color? string "#rrggbb". Default: the usual one.
---@field width? number Its width. In pixels. Default: 1.5.
---@field closed? boolean Goes back to its first pixel. Default: false.
---@field opacity? number From 0, nothing, to 1. Default: 1.

---Draws a line in the picture.
---@param options lissom.ToolView.OutlineOptions
---@return lissom.ToolView view # The view itself.
function ToolView:outline(options) end

---@class lissom.ToolView.CircleOptions
---@field at number[] Its middle, {x, y}.
---@field radius? number Its radius. In pixels. Default: 20.
---@field color? string "#rrggbb". Default: the usual one.

---Draws a circle in the picture.
---@param options lissom.ToolView.CircleOptions
---@return lissom.ToolView view # The view itself.
function ToolView:circle(options) end

---@class lissom.ToolView.RegionOptions
---@field region lissom.Region The vertices.
---@field mesh? lissom.Mesh The mesh. Default: the region's.
---@field color? string "#rrggbb". Default: the usual one.

---Colours vertices of a mesh of the scene.
---@param options lissom.ToolView.RegionOptions
---@return lissom.ToolView view # The view itself.
function ToolView:region(options) end

---@class lissom.ToolView.SurfaceOptions
---@field from lissom.Vector[] A line of the world.
---@field to lissom.Vector[] The other line.
---@field color? string "#rrggbb". Default: the usual one.
---@field opacity? number From 0, nothing, to 1. Default: 0.25.

---Draws a surface between two lines of as many points, which is seen through.
---@param options lissom.ToolView.SurfaceOptions
---@return lissom.ToolView view # The view itself.
function ToolView:surface(options) end

---@class lissom.ToolView.MeshOptions
---@field mesh lissom.Mesh The mesh.
---@field transform? number[][] Its place in the world. Default: the identity.
---@field color? string "#rrggbb". Default: the usual one.

---Draws a mesh that is not in the scene, before the surfaces that it lies on; it must not change afterwards.
---@param options lissom.ToolView.MeshOptions
---@return lissom.ToolView view # The view itself.
function ToolView:mesh(options) end

---Draws a gizmo as it is seen now.
---@param gizmo lissom.Gizmo The gizmo.
---@param chosen? string The part that is drawn as the one in hand. Default: the one under the cursor.
---@return lissom.ToolView view # The view itself.
function ToolView:gizmo(gizmo, chosen) end

---Frees the contents of the object. It may be called again; any other use is an error then.
function ToolView:close() end

---Values of a script's parameters: `params.length`. Values that are set are checked as those of the command line.
---@class lissom.Params
---@field [string] any
---@operator len: integer
local Params = {}

---All declarations with their present values, ordered by group and name.
---@return lissom.ParamSchema[] schema # One table for each parameter.
function Params:schema() end

---Frees the contents of the object. It may be called again; any other use is an error then.
function Params:close() end

---Modeling by few handles: meshes, regions, paths, deformation, merging, hair and scenes.
---@class lissom
---@field version string Version of the library.
---@field licence string The licence that the program may be distributed under: "MIT", or "GPL-2.0-or-later" if it links CHOLMOD, as the lissom program of builds without LISSOM_GPL=OFF does.
local lissom = {}

lissom.shapes = {}

lissom.part = {}

lissom.pick = {}

---@class lissom.LoadOptions
---@field weld? "seams"|"all"|boolean Vertices at the same place that become one. "seams": those that join open edges at the same place and of opposite direction, so that surfaces that only touch, as closed lips do, stay apart; "all": all of them; false: none. Default: "all" for .stl, "seams" for others.
---@field unused? "drop"|"keep" Treatment of vertices that no face uses. "keep" leaves them in their order, for programs that match vertices by number; with weld = false all vertices of a sound file keep their numbers. Default: "drop".
---@field repair? boolean false makes each defect that would be mended, and each face without area, an error that names the elements. Default: true.
---@field up? "y"|"z" The file's up axis; z is turned to y, which is up here. Default: as it is.
---@field unit? number Length of the file's unit in the unit of the mesh: positions are multiplied by it. In mesh units. Default: 1.

---Reads a mesh from an .obj, .ply, .off, .stl, .gltf or .glb file, with its groups, materials, texture coordinates, normals, colours, skins and morph targets. It is checked and repaired: mesh:report() lists the changes.
---@param path string The file; its extension names the format.
---@param options? lissom.LoadOptions
---@return lissom.Mesh mesh # The mesh.
function lissom.load(path, options) end

---@class lissom.MeshOptions
---@field positions lissom.Vector[]|lissom.Buffer Positions of the vertices.
---@field faces integer[][] For each face the ids of its vertices, counter-clockwise seen from outside.
---@field weld? "seams"|"all"|boolean Vertices at the same place that become one. "seams": those that join open edges at the same place and of opposite direction, so that surfaces that only touch, as closed lips do, stay apart; "all": all of them; false: none. Default: false.
---@field repair? boolean Whether defects are mended, as lissom.load does. Default: false.

---Makes a mesh from positions and faces.
---@param options lissom.MeshOptions
---@return lissom.Mesh mesh # The mesh.
function lissom.mesh(options) end

---@class lissom.BoxOptions
---@field size? number|lissom.Vector Length of its sides. Default: 1.
---@field segments? integer|integer[] Quads along x, y and z. Default: 1.

---An axis-aligned box of quads around the origin. Regions: left, right, bottom, top, back, front.
---@param options? lissom.BoxOptions
---@return lissom.Mesh mesh # A new mesh that faces outward.
function lissom.shapes.box(options) end

---@class lissom.BarOptions
---@field width? number Side of the cross section. In mesh units. Default: 1.
---@field length? number Length along y. In mesh units. Default: 5.
---@field across? integer Quads across each side. Default: 8.
---@field along? integer Quads along the bar. Default: 40.

---A bar of quads with a square cross section along y. Regions: bottom, top.
---@param options? lissom.BarOptions
---@return lissom.Mesh mesh # A new mesh that faces outward.
function lissom.shapes.bar(options) end

---@class lissom.SphereOptions
---@field radius? number Its radius. In mesh units. Default: 1.
---@field segments? integer Divisions of each edge of the cube or icosahedron that it is made from. Default: 16.
---@field kind? "quads"|"triangles" From a cube's quads, or an icosahedron. Default: "quads".

---A sphere around the origin.
---@param options? lissom.SphereOptions
---@return lissom.Mesh mesh # A new mesh that faces outward.
function lissom.shapes.sphere(options) end

---@class lissom.CylinderOptions
---@field radius? number Its radius. In mesh units. Default: 0.5.
---@field height? number Its height. In mesh units. Default: 2.
---@field segments? integer Quads around. Default: 32.
---@field rings? integer Quads along. Default: 16.
---@field caps? boolean Closes the ends. Default: true.
---@field cap_rings? integer Rings of each cap. Default: 4.

---A cylinder along y around the origin. Regions: bottom, top, and caps if there are any.
---@param options? lissom.CylinderOptions
---@return lissom.Mesh mesh # A new mesh that faces outward.
function lissom.shapes.cylinder(options) end

---@class lissom.GridOptions
---@field size? number|number[] Length of its sides. Default: 1.
---@field segments? integer|integer[] Quads along x and z. Default: 10.

---An open rectangle of quads in the xz plane that faces +y. Region: border.
---@param options? lissom.GridOptions
---@return lissom.Mesh mesh # A new mesh that faces outward.
function lissom.shapes.grid(options) end

---@class lissom.TorusOptions
---@field radius? number Radius of the circle in the tube's middle. In mesh units. Default: 1.
---@field tube_radius? number Radius of the tube; the smaller one. In mesh units. Default: 0.35.
---@field segments? integer Quads around the axis. Default: 48.
---@field tube_segments? integer Quads around the tube. Default: 24.

---A torus of quads around the y axis.
---@param options? lissom.TorusOptions
---@return lissom.Mesh mesh # A new mesh that faces outward.
function lissom.shapes.torus(options) end

---@class lissom.CactusOptions
---@field height? number Its height. In mesh units. Default: 2.
---@field vertices? integer Vertices wanted; the result is within 10 %. Default: 9000.
---@field ribs? integer Ribs around the trunk: 0, or 4 to 40. Default: 12.
---@field rib_depth? number Depth of the grooves as a fraction of the trunk's radius. Default: 0.2.
---@field thorns? number Height of the thorns as a fraction of the trunk's radius. Default: 0.06.

---A saguaro with two arms that stands on y = 0. Regions: base, tip, left_arm, right_arm, left_tip, right_tip.
---@param options? lissom.CactusOptions
---@return lissom.Mesh mesh # A new mesh that faces outward.
function lissom.shapes.cactus(options) end

---@class lissom.HeadOptions
---@field height? number From the bottom of the bust to the crown. In metres. Default: 0.4.
---@field vertices? integer Vertices wanted; the result is within 10 %. Default: 10000.

---A bald, stylised head with neck and shoulders that faces +z, to show hair on; symmetric in x, the origin between the ears. Regions: scalp, ears, bottom.
---@param options? lissom.HeadOptions
---@return lissom.Mesh mesh # A new mesh that faces outward.
function lissom.shapes.head(options) end

---@class lissom.DeformOptions.Handles.Rotate
---@field axis "x"|"y"|"z"|lissom.Vector Axis of the rotation.
---@field angle number Angle, counter-clockwise seen against the axis. In degrees.
---@field about? lissom.Vector A point on the axis. Default: the option `about`.

---@class lissom.DeformOptions.Handles
---@field region lissom.Region Its vertices.
---@field translate? lissom.Vector Added last. In mesh units. Default: {0, 0, 0}.
---@field rotate? lissom.DeformOptions.Handles.Rotate Applied after the scale. Default: none.
---@field scale? number|lissom.Vector Factor for all axes, or one for each; applied first. Default: 1.
---@field about? lissom.Vector The point that scale and rotation keep. Default: the center of the region.

---@class lissom.DeformOptions
---@field region? lissom.Region The part that may move. Outside nothing does. Default: all.
---@field method? "implicit"|"naive"|"rotation_estimate"|"similarity"|"geodesic"|"harmonic"|"frames" implicit is this kernel's own method. The others are for comparison: Laplacian coordinates as they are; turned by rotations estimated from that (Lipman 2004); by similarities implicit in the positions (Sorkine 2004); handle rotations propagated by geodesic distance (Yu 2004) or by harmonic fields (Zayer 2005); rotation-invariant coordinates (Lipman 2005). Of the other options they take `weights` only, and geodesic not even that; they have no basis, and preview equals solve. Default: "implicit".
---@field local_size? "keep"|"scale" Whether details keep their size or scale with the surface around them. Default: "keep".
---@field second? "blend"|"laplacian"|"poisson" The system that makes the shape from the rotations: blend is smooth at handles with little distortion, laplacian is the thesis's, poisson has the least distortion. Keep blend unless something asks for another: laplacian for the smoothest surface, which may stretch, poisson for one that may crease at handles, as along an edge of the part. Compared in examples/deform/second.png. Default: "blend"; as in the thesis "laplacian".
---@field coherence? integer Rings of neighbours that turn alike. Default: 1; as in the thesis 2.
---@field weights? "cotangent"|"uniform" Weights of the Laplacian coordinates. Default: "cotangent".
---@field refine? integer Rounds, 0 to 2, of fitting the rotations to the result and solving for it again: less distortion for half a frame each. For bars and limbs that bend and twist. Less of it is kept the nearer parts of the surface come to one another and the more edges stretch, and nothing crosses that would not without; a draft does not check. Beside handles that change their size it fades to nothing. Compared in examples/deform/refine.png. Default: 0.
---@field volume? number Share of the thickness at rest that is kept, by springs across the inside: twisted and bent solids keep their volume and get no waist. It acts between the two sides of the region, and fades beside handles that change the size; a sheet has no inside. 1 keeps all of it, at about a third of a frame; keep_volume changes it. Compared in examples/deform/volume.png. Default: 0.
---@field loose? "error"|"stay"|"follow" Treatment of separate parts that no handle holds, such as buttons and eyes: an error that names them; they stay; or each follows the surface nearest to it, as a rigid piece; in a basis as an affine one. Default: "error".
---@field free_rings? integer Rings of vertices that handles release if they nearly touch another, at most two edges apart, so that the surface between has room: handles that go different ways would tear it. report says how many help. Default: 0.
---@field levels? "none"|"auto" auto deforms a very large region on two levels, if it has at least four times `level_vertices`: the method works on a thinned surface, and all vertices follow it with their details, several times as fast and in less memory. Handles hold their vertices exactly. What needs the whole surface, as soft handles do, gets it, with a warning. Default: "none".
---@field level_vertices? integer Vertices of the thinned surface. Default: 40000.
---@field subdivide_borders? boolean Works on a surface that is subdivided along borders of handles that are coarse beside the region; the mesh keeps its faces. Default: true.
---@field flat? "extended"|"displaced" Rotation of a vertex whose surroundings are flat: extended, by an unknown of its own beside it, so that a flat part that is moved within its plane stays flat; displaced, by moving it out of the plane while solving. Default: "extended"; as in the thesis "displaced".
---@field displacement? number Distance by which degenerate vertices are displaced, and beside flat ones their unknown lies. In mean lengths of their edges. Default: 0.2.
---@field degenerate_threshold? number Condition number from which a vertex counts as degenerate and is displaced. Below about 100 that is nearly every vertex. Default: 20000; as in the thesis 200000.
---@field transition? number Width of the zone along the region's outline, in geodesic distance, over which the deformation fades into the fixed part. In mesh units. Default: 0.
---@field fidelity? "default"|"thesis" thesis: coherence 2, second laplacian, and the weights and threshold of the thesis unless another option gives them; the page thesis.md of the reference names all of it. Default: "default".
---@field pin? lissom.Region|lissom.Region[] The region, or the regions, that stay in place. Default: none.
---@field handles? lissom.DeformOptions.Handles[] Regions that are moved as wholes: scaled, then rotated, then translated. Default: required.

---Deforms a mesh once: pinned regions stay, those of the handles take their transforms, and the surface between follows. Returns the mesh. `lissom.deformer` keeps its factors, for handles that move again.
---@param mesh lissom.Mesh The mesh; it is changed.
---@param options? lissom.DeformOptions
---@return lissom.Mesh mesh # The mesh itself.
function lissom.deform(mesh, options) end

---@class lissom.DeformerOptions
---@field region? lissom.Region The part that may move. Outside nothing does. Default: all.
---@field method? "implicit"|"naive"|"rotation_estimate"|"similarity"|"geodesic"|"harmonic"|"frames" implicit is this kernel's own method. The others are for comparison: Laplacian coordinates as they are; turned by rotations estimated from that (Lipman 2004); by similarities implicit in the positions (Sorkine 2004); handle rotations propagated by geodesic distance (Yu 2004) or by harmonic fields (Zayer 2005); rotation-invariant coordinates (Lipman 2005). Of the other options they take `weights` only, and geodesic not even that; they have no basis, and preview equals solve. Default: "implicit".
---@field local_size? "keep"|"scale" Whether details keep their size or scale with the surface around them. Default: "keep".
---@field second? "blend"|"laplacian"|"poisson" The system that makes the shape from the rotations: blend is smooth at handles with little distortion, laplacian is the thesis's, poisson has the least distortion. Keep blend unless something asks for another: laplacian for the smoothest surface, which may stretch, poisson for one that may crease at handles, as along an edge of the part. Compared in examples/deform/second.png. Default: "blend"; as in the thesis "laplacian".
---@field coherence? integer Rings of neighbours that turn alike. Default: 1; as in the thesis 2.
---@field weights? "cotangent"|"uniform" Weights of the Laplacian coordinates. Default: "cotangent".
---@field refine? integer Rounds, 0 to 2, of fitting the rotations to the result and solving for it again: less distortion for half a frame each. For bars and limbs that bend and twist. Less of it is kept the nearer parts of the surface come to one another and the more edges stretch, and nothing crosses that would not without; a draft does not check. Beside handles that change their size it fades to nothing. Compared in examples/deform/refine.png. Default: 0.
---@field volume? number Share of the thickness at rest that is kept, by springs across the inside: twisted and bent solids keep their volume and get no waist. It acts between the two sides of the region, and fades beside handles that change the size; a sheet has no inside. 1 keeps all of it, at about a third of a frame; keep_volume changes it. Compared in examples/deform/volume.png. Default: 0.
---@field loose? "error"|"stay"|"follow" Treatment of separate parts that no handle holds, such as buttons and eyes: an error that names them; they stay; or each follows the surface nearest to it, as a rigid piece; in a basis as an affine one. Default: "error".
---@field free_rings? integer Rings of vertices that handles release if they nearly touch another, at most two edges apart, so that the surface between has room: handles that go different ways would tear it. report says how many help. Default: 0.
---@field levels? "none"|"auto" auto deforms a very large region on two levels, if it has at least four times `level_vertices`: the method works on a thinned surface, and all vertices follow it with their details, several times as fast and in less memory. Handles hold their vertices exactly. What needs the whole surface, as soft handles do, gets it, with a warning. Default: "none".
---@field level_vertices? integer Vertices of the thinned surface. Default: 40000.
---@field subdivide_borders? boolean Works on a surface that is subdivided along borders of handles that are coarse beside the region; the mesh keeps its faces. Default: true.
---@field flat? "extended"|"displaced" Rotation of a vertex whose surroundings are flat: extended, by an unknown of its own beside it, so that a flat part that is moved within its plane stays flat; displaced, by moving it out of the plane while solving. Default: "extended"; as in the thesis "displaced".
---@field displacement? number Distance by which degenerate vertices are displaced, and beside flat ones their unknown lies. In mean lengths of their edges. Default: 0.2.
---@field degenerate_threshold? number Condition number from which a vertex counts as degenerate and is displaced. Below about 100 that is nearly every vertex. Default: 20000; as in the thesis 200000.
---@field transition? number Width of the zone along the region's outline, in geodesic distance, over which the deformation fades into the fixed part. In mesh units. Default: 0.
---@field fidelity? "default"|"thesis" thesis: coherence 2, second laplacian, and the weights and threshold of the thesis unless another option gives them; the page thesis.md of the reference names all of it. Default: "default".

---Makes a deformer of a mesh, or of a region of it: give it handles, move them, solve. `lissom.deform` deforms once.
---@param mesh lissom.Mesh The mesh, in its rest shape.
---@param options? lissom.DeformerOptions
---@return lissom.Deformer deformer # Give it handles, move them, solve.
function lissom.deformer(mesh, options) end

---@class lissom.Pose_spaceOptions
---@field rest lissom.Mesh The mesh at rest.
---@field poses table Meshes by name. A list of n meshes is a path from rest: mesh k is at weight k / n.

---Makes a space of poses: meshes with the vertices and faces of one at rest, which blend by rotations. Half of a bent arm is an arm bent by half, of its full length; details turn along. Turns beyond half a turn are kept if the surface leads to them.
---@param options lissom.Pose_spaceOptions
---@return lissom.PoseSpace space # Its poses are copies.
function lissom.pose_space(options) end

---@class lissom.TransferOptions.Pairs
---@field from lissom.Region A part of the posed mesh.
---@field to lissom.Region The part that corresponds.

---@class lissom.TransferOptions
---@field from lissom.Mesh The mesh at rest whose pose it is.
---@field from_posed lissom.Mesh The same mesh posed.
---@field to lissom.Mesh The mesh that takes the pose, at rest.
---@field pairs? lissom.TransferOptions.Pairs[] Parts of both meshes that correspond, such as their heads. Default: none.
---@field regions? string[] Names of regions that both meshes have and that correspond. Default: none.

---Another mesh takes the pose of a mesh: each of its triangles deforms as the corresponding part of the posed mesh does (Sumner and Popovic 2004). Both meshes stand alike at rest; sizes and places may differ. Without pairs and regions their faces correspond one to one. Else points correspond by harmonic functions of the pairs: some at the ends of limbs and at the trunk serve best. Parts that the pose does not move stay.
---@param options lissom.TransferOptions
---@return lissom.Mesh mesh # A copy of `to` in the pose.
function lissom.transfer(options) end

---@class lissom.MergeOptions.Transition
---@field source? number Width on the source. In units of the source. Default: 0.
---@field target? number Width on the target. In units of the target. Default: 0.
---@field weight? number w_T of thesis 3.3.3, for fidelity = "thesis", which needs both widths. Default: 0.1.

---@class lissom.MergeOptions
---@field joins? table List of { source = boundary, target = boundary, keys = { { s, t }, ... } }: which boundaries meet, and points that do: vertices of the boundaries, or points {x, y, z} on them, the source's first. Between keys arc length decides. Without keys the directions below decide, or else `place`; the report says which turn was taken and how certain it is. All sources lie on one mesh; targets may lie on several, and each boundary is in one join. Default: the boundaries of source and target that lie nearest to each other, one join for each target.
---@field place? "as placed"|"shape" Turn of joins without keys and directions about the axis of the boundary. as placed: least from how the source lies beside the target, so that a part that was laid roughly, or both as they were modelled, come right; the result is the same if both are moved together, or if the source is moved without a turn and scaled. shape: as the shapes of both parts suggest, the same wherever the source lies; the report says how certain that is. A part that must be turned over by more than 150 degrees is placed by shape as well. Default: "as placed".
---@field source_up? "x"|"y"|"z"|lissom.Vector A direction of the source that is to lie the way `target_up` does, for joins without keys. It counts as far as it lies in the plane of the boundary: that of a neck's axis says little.
---@field target_up? "x"|"y"|"z"|lissom.Vector The direction of the targets that belongs to it.
---@field source_front? "x"|"y"|"z"|lissom.Vector Another direction of the source: the view of a face.
---@field target_front? "x"|"y"|"z"|lissom.Vector The direction of the targets that belongs to it.
---@field configuration? "free"|"fixed" free: the source comes from any place, turned and scaled to fit (thesis 3.3.1). fixed: it stays in place and bends near the boundaries (3.3.2). Default: "free".
---@field fixed? lissom.Region[] Regions of the source that keep their shape: in the free configuration each moves as a whole, in the fixed one it stays. Default: none.
---@field features? "common"|"fitted" Similarity by which those of the free configuration move. common: each has one deformation gradient, an unknown of the systems (thesis 3.5). fitted: the surface is deformed without them first, and again with the fitted similarity: less distortion around them, by 5 to 44 % on four merges of real models, in up to twice the time. Default: "fitted"; as in the thesis "common".
---@field reach? number fixed configuration: how far from its boundaries the source deforms, along edges. In units of the source. Default: all of it if `fixed` is given, else three radii of the boundary.
---@field frames? "turn"|"keep" fixed configuration: whether the surface at the boundary turns to meet the target's, or keeps its directions as in the thesis, which leaves a crease. Default: "turn"; as in the thesis "keep".
---@field seam? "conform"|"fair"|"band" conform: vertices of both boundaries are inserted into the faces of the other side. fair: then the surface around the seam is bent smooth, but for flat faces and creases of the target, unless a transition does that. band: a band of the target's faces is replaced, as in the thesis. Default: "conform"; as in the thesis "band".
---@field smooth? integer Umbrella steps at the seam, at most: the first that would fold it is the last. With 0 and without a collar no vertex of the target moves. Default: 3.
---@field collar? boolean Makes the faces of a side anew if its edges are more than 1.5 times as long as the seam's, from small to large; sharp edges keep their shape. Default: true; as in the thesis false.
---@field transition? lissom.MergeOptions.Transition|boolean Bands on either side of the seam in which details of both fade into each other; `true` chooses widths that suit each seam: .9 of its radius, at least three edges, at most half of the side; flat faces of the target stay flat then. If the surface has no room for a width, the band is narrower and a warning says so. Default: none.
---@field trim? boolean Boundaries with teeth are cut to smooth lines first, and the report says so. Default: true; as in the thesis false.
---@field max_turn? number Mean turn of a boundary at its vertices above which it is trimmed. In degrees. Default: 20.
---@field subdivide? boolean Faces of the source at a boundary are split once if its edges are more than 1.5 times as long as those they meet. Edges more than 3 times as long as edges inside the source are split until they are not, and those of the target with them (thesis 2.5). Default: true; as in the thesis false, as which boundaries have too few vertices is not said.
---@field intersections? boolean Looks for faces that run through one another and did not before, for the report. Default: true.
---@field mend? boolean If neither `seam` nor `transition` is given, fairs the places beside the seams at which a side became crumpled. If the verdict still finds fault with the surface there, sews again with the seam fair and then with a transition, and keeps the result with fewest faults; a warning says so. Takes the time of sewing up to three times. Not without smoothing or collar. Default: true.
---@field fidelity? "default"|"thesis" thesis: section 3.3 to the letter, for comparison, unless another option differs; the page thesis.md of the reference names all of it. Default: "default".
---@field source? lissom.Mesh The mesh that is deformed. Default: the mesh of the joins' sources.
---@field target? lissom.Mesh|lissom.Mesh[] The mesh, or the meshes, that stay. Default: the meshes of the joins' targets.

---Joins a source to one or several targets along open boundaries, into a new mesh. The source is deformed so that its boundaries meet those of the targets, wherever it lies and whatever its size; the targets stay. Vertices and faces of the targets come first, in their order, then those of the source; attributes, labels and regions of all are kept. A side without colors becomes white, one without texture coordinates gets 0, 0, and a warning says so. If source and target are one mesh, two of its boundaries are joined by a bridge of triangles, and nothing moves: options that say how a source is deformed are refused.
---@param source? lissom.Mesh The mesh that is deformed. Default: the mesh of the joins' sources.
---@param target? lissom.Mesh|lissom.Mesh[] The mesh, or the meshes, that stay. Default: the meshes of the joins' targets.
---@param options? lissom.MergeOptions
---@return lissom.Mesh mesh # The merged mesh.
---@return lissom.MergeReport report # Measures and results.
---@overload fun(options: lissom.MergeOptions): lissom.Mesh
function lissom.merge(source, target, options) end

---@class lissom.MergerOptions.Transition
---@field source? number Width on the source. In units of the source. Default: 0.
---@field target? number Width on the target. In units of the target. Default: 0.
---@field weight? number w_T of thesis 3.3.3, for fidelity = "thesis", which needs both widths. Default: 0.1.

---@class lissom.MergerOptions
---@field joins? table List of { source = boundary, target = boundary, keys = { { s, t }, ... } }: which boundaries meet, and points that do: vertices of the boundaries, or points {x, y, z} on them, the source's first. Between keys arc length decides. Without keys the directions below decide, or else `place`; the report says which turn was taken and how certain it is. All sources lie on one mesh; targets may lie on several, and each boundary is in one join. Default: the boundaries of source and target that lie nearest to each other, one join for each target.
---@field place? "as placed"|"shape" Turn of joins without keys and directions about the axis of the boundary. as placed: least from how the source lies beside the target, so that a part that was laid roughly, or both as they were modelled, come right; the result is the same if both are moved together, or if the source is moved without a turn and scaled. shape: as the shapes of both parts suggest, the same wherever the source lies; the report says how certain that is. A part that must be turned over by more than 150 degrees is placed by shape as well. Default: "as placed".
---@field source_up? "x"|"y"|"z"|lissom.Vector A direction of the source that is to lie the way `target_up` does, for joins without keys. It counts as far as it lies in the plane of the boundary: that of a neck's axis says little.
---@field target_up? "x"|"y"|"z"|lissom.Vector The direction of the targets that belongs to it.
---@field source_front? "x"|"y"|"z"|lissom.Vector Another direction of the source: the view of a face.
---@field target_front? "x"|"y"|"z"|lissom.Vector The direction of the targets that belongs to it.
---@field configuration? "free"|"fixed" free: the source comes from any place, turned and scaled to fit (thesis 3.3.1). fixed: it stays in place and bends near the boundaries (3.3.2). Default: "free".
---@field fixed? lissom.Region[] Regions of the source that keep their shape: in the free configuration each moves as a whole, in the fixed one it stays. Default: none.
---@field features? "common"|"fitted" Similarity by which those of the free configuration move. common: each has one deformation gradient, an unknown of the systems (thesis 3.5). fitted: the surface is deformed without them first, and again with the fitted similarity: less distortion around them, by 5 to 44 % on four merges of real models, in up to twice the time. Default: "fitted"; as in the thesis "common".
---@field reach? number fixed configuration: how far from its boundaries the source deforms, along edges. In units of the source. Default: all of it if `fixed` is given, else three radii of the boundary.
---@field frames? "turn"|"keep" fixed configuration: whether the surface at the boundary turns to meet the target's, or keeps its directions as in the thesis, which leaves a crease. Default: "turn"; as in the thesis "keep".
---@field seam? "conform"|"fair"|"band" conform: vertices of both boundaries are inserted into the faces of the other side. fair: then the surface around the seam is bent smooth, but for flat faces and creases of the target, unless a transition does that. band: a band of the target's faces is replaced, as in the thesis. Default: "conform"; as in the thesis "band".
---@field smooth? integer Umbrella steps at the seam, at most: the first that would fold it is the last. With 0 and without a collar no vertex of the target moves. Default: 3.
---@field collar? boolean Makes the faces of a side anew if its edges are more than 1.5 times as long as the seam's, from small to large; sharp edges keep their shape. Default: true; as in the thesis false.
---@field transition? lissom.MergerOptions.Transition|boolean Bands on either side of the seam in which details of both fade into each other; `true` chooses widths that suit each seam: .9 of its radius, at least three edges, at most half of the side; flat faces of the target stay flat then. If the surface has no room for a width, the band is narrower and a warning says so. Default: none.
---@field trim? boolean Boundaries with teeth are cut to smooth lines first, and the report says so. Default: true; as in the thesis false.
---@field max_turn? number Mean turn of a boundary at its vertices above which it is trimmed. In degrees. Default: 20.
---@field subdivide? boolean Faces of the source at a boundary are split once if its edges are more than 1.5 times as long as those they meet. Edges more than 3 times as long as edges inside the source are split until they are not, and those of the target with them (thesis 2.5). Default: true; as in the thesis false, as which boundaries have too few vertices is not said.
---@field intersections? boolean Looks for faces that run through one another and did not before, for the report. Default: false.
---@field mend? boolean If neither `seam` nor `transition` is given, fairs the places beside the seams at which a side became crumpled. If the verdict still finds fault with the surface there, sews again with the seam fair and then with a transition, and keeps the result with fewest faults; a warning says so. Takes the time of sewing up to three times. Not without smoothing or collar. Default: false.
---@field fidelity? "default"|"thesis" thesis: section 3.3 to the letter, for comparison, unless another option differs; the page thesis.md of the reference names all of it. Default: "default".
---@field source? lissom.Mesh The mesh that is deformed. Default: the mesh of the joins' sources.
---@field target? lissom.Mesh|lissom.Mesh[] The mesh, or the meshes, that stay. Default: the meshes of the joins' targets.

---Like lissom.merge, but returns an object that keeps its preparation, so that a moved key costs a fraction of the first merge.
---@param source? lissom.Mesh The mesh that is deformed. Default: the mesh of the joins' sources.
---@param target? lissom.Mesh|lissom.Mesh[] The mesh, or the meshes, that stay. Default: the meshes of the joins' targets.
---@param options? lissom.MergerOptions
---@return lissom.Merger merger # The merger, not solved yet.
---@overload fun(options: lissom.MergerOptions): lissom.Merger
function lissom.merger(source, target, options) end

---@class lissom.PasteOptions.Placement
---@field at lissom.Vector The middle of the feature comes to lie on the point of the target that is nearest to this.
---@field toward? "x"|"y"|"z"|lissom.Vector The way on the target that `up` of the source is to point, as far as both lie in the surfaces. Default: the same as `up`.
---@field up? "x"|"y"|"z"|lissom.Vector The direction of the source that belongs to it. Default: y.
---@field angle? number Turns the part about the surface's normal, counter-clockwise seen from outside, from `toward`. In degrees. Default: 0, or the best of twelve if `up` does not lie in the surfaces and `toward` is not given.
---@field scale? number Size of the part on the target over its size on the source. Default: 1.
---@field offset? number[] {x, y}: moves the part in the plane of the target's map, in lengths of the target; the way of placing of thesis 3.4.1. Default: {0, 0}.

---@class lissom.PasteOptions
---@field source lissom.Mesh The mesh that has the feature; it stays as it is.
---@field target lissom.Mesh The mesh that it is pasted onto; it stays as it is.
---@field region lissom.Region Part of the source around the feature, marked casually: the boundary is sought between its outline and the feature. If it has several outlines, such as those around the feet of a handle, the surface along the shortest way between them joins it.
---@field feature? lissom.Region|"auto" Part of the source that keeps out of the search; of any genus, and of several parts. auto: the part farther from the region's outline than the share `ring` of the way to its middle, or of the outline's radius if that is less; with the open boundaries and the handles inside the region. Default: auto.
---@field onto? lissom.Region Part of the target that the feature may go to: without holes and handles, and larger than the region of the source will be. Default: a disk around the placement.
---@field placement lissom.PasteOptions.Placement Place of the feature.
---@field clear? boolean|lissom.Region Removes the target's features under the part first, as mesh:erase does: those under the part's boundary and nothing beyond it, or a region of the target with a ring around it. paste:clearing() shows them before. Default: false.
---@field ring? number Share of the region that is searched if no feature is given. Default: 0.5.
---@field correspondence? "map"|"closest" map: vertices lie at their images under the plane maps of both surfaces. closest: `optimize` then draws them, in rounds, to the nearest point of the target, if that distorts the surface near the boundary less. Default: "closest".
---@field loop? "smooth"|"mesh" smooth: the boundary runs through faces, near the best loop of edges, so that the seam has no teeth. mesh: it is that loop. Default: "smooth".
---@field normals? number Weight of the normals in the energy of a boundary; .1 to .3 help features that overhang. Default: 0.
---@field crease? number About the greatest angle at which part and target may meet, instead of the part's boundary turning until its surface goes on in the target's: the more it turns, the more the part is distorted beside it. 0: no crease, as with fidelity = "thesis". In degrees. Default: 30.
---@field fidelity? "default"|"thesis" thesis: maps that keep angles alone, the energy of Eq 3.1 with its similarity, a boundary along edges, and its deformation, for comparison. Default: "default".

---Puts a feature of one mesh onto another, wherever that is and however it is curved (thesis section 3.4): a nose, an ear, a horn, a handle. Lays the surface around the feature and the target out in one plane; `optimize` then finds the best boundary and `merge` makes the new mesh.
---@param options lissom.PasteOptions
---@return lissom.Paste paste # The paste, placed and not optimised yet.
function lissom.paste(options) end

---@class lissom.ScatterOptions
---@field source lissom.Mesh The mesh that has the feature; it stays as it is.
---@field target lissom.Mesh The mesh that it is pasted onto; it stays as it is.
---@field region lissom.Region Part of the source around the feature.
---@field feature? lissom.Region|"auto" See lissom.paste. Default: auto.
---@field at lissom.Vector[] Places: the middle of the feature comes to lie on the nearest point of the target. The first of two that meet counts.
---@field toward? lissom.Vector[] See the placement of lissom.paste: one for all or one a place. Default: the same as `up`.
---@field up? "x"|"y"|"z"|lissom.Vector The direction of the source that belongs to it. Default: y.
---@field angles? number[] See the placement of lissom.paste: one for all or one a place. In degrees. Default: 0, or the best of twelve if `up` does not lie in the surfaces and `toward` is not given.
---@field scales? number[] See the placement of lissom.paste: one for all or one a place. Default: 1.
---@field iterations? integer Iterations of the search for each boundary; 0 takes the outline of the region. Default: 4.
---@field ring? number Share of the region that is searched if no feature is given. Default: 0.5.
---@field normals? number Weight of the normals in the energy of a boundary. Default: 0.
---@field smooth? integer Umbrella steps at a seam, at most. Default: 3.
---@field collar? boolean Makes faces anew beside a seam if one side is coarser. Default: true.
---@field size? "boundary"|"lock" Size of a part: that of its boundary on the target, or its `scales`. Default: "boundary".
---@field crossings? "shrink"|"leave out"|"keep" Treatment of a part that would run through itself, the target or a part before it, bite into a sharp edge of the target or fold. shrink: one that bites moves away from the edge; it is made smaller, by a fifth at a time and by a half at most, and left out if that does not help. keep: it stays, and the report tells it. Default: "shrink".

---Pastes one feature many times: scales, spikes, leaves. Each paste sees a small disk of the target alone, and all that do not touch are put into the mesh together, so that hundreds are quick. A place on another part, or without room, is refused and told; scripts/recipes/scatter.lua finds places.
---@param options lissom.ScatterOptions
---@return lissom.Mesh mesh # The target with all parts.
---@return lissom.ScatterReport report # Refused places, and the places of parts.
function lissom.scatter(options) end

---@class lissom.SaveOptions
---@field mesh lissom.Mesh The mesh that has the feature.
---@field region lissom.Region Part of the mesh around the feature.
---@field feature? lissom.Region The feature, a part of the region. Default: the core of the region.
---@field up? "x"|"y"|"z"|lissom.Vector The way that is up on the part: along y in the file. Default: y.
---@field front? "x"|"y"|"z"|lissom.Vector The way that it looks, at an angle to `up`: along z in the file. Default: z.

---Keeps a feature for later pastes in a .glb or .gltf file: the surface of its region and three rings of faces around it, with all they carry, turned upright. Such a file opens as any other model; its regions are called "region" and "feature".
---@param path string The file.
---@param options lissom.SaveOptions
---@return boolean done # true.
function lissom.part.save(path, options) end

---Reads a feature that part.save has kept, or any .glb or .gltf file with a region called "region".
---@param path string The file.
---@return lissom.Part part # The part for lissom.paste and lissom.scatter.
function lissom.part.load(path) end

---@class lissom.ScalpOptions
---@field region? lissom.Region The hairy part. Default: the region "scalp", or the part above an average hairline.
---@field up? "x"|"y"|"z"|lissom.Vector Direction upwards. Default: guessed.
---@field front? "x"|"y"|"z"|lissom.Vector Direction that the head looks in. Default: guessed.
---@field unit? number Length of a unit of the mesh. In metres. Default: m, cm, mm, dm or inch, if one makes this the width of a head; else that of an average head.
---@field softness? number Width of the band over which hair thins out at the hairline. In metres. Default: 0.011.
---@field hairline? number[][] The edge of the hair: {azimuth, elevation} in degrees around the head, smooth between. Without negative azimuths both sides are alike. This and the following count before a region "scalp" of the mesh. Default: an average hairline.
---@field drawn? lissom.Vector[] A line on the head through which the hairline runs; on one side it counts for both. In mesh units.
---@field forehead? number Rise of the hairline over the forehead. In metres. Default: 0.
---@field recession? number Depth of the bays beside the middle. In metres. Default: 0.
---@field peak? number Depth of a widow's peak. In metres. Default: 0.
---@field sideburns? number Length added to the hair in front of the ears. In metres. Default: 0.
---@field nape? number Length added to the hair at the nape. In metres. Default: 0.
---@field irregular? number Height by which the hairline wanders up and down around the head: hair grows up to no ruled line. In metres. Default: 0.

---Finds the scalp of a bald head, bust or body, and which way it looks.
---@param head lissom.Mesh The head.
---@param options? lissom.ScalpOptions
---@return lissom.Scalp scalp # The scalp.
function lissom.scalp(head, options) end

---@class lissom.Load_styleOptions
---@field scalp? lissom.Scalp The scalp. Default: guessed.

---Reads a style that `save` wrote.
---@param path string The JSON file.
---@param head? lissom.Mesh The head that it goes on. Default: the one that the file names, beside it.
---@param options? lissom.Load_styleOptions
---@return lissom.Hairstyle style # The hairstyle.
function lissom.load_style(path, head, options) end

---@class lissom.HairstyleOptions.Volume
---@field min lissom.Vector A corner.
---@field max lissom.Vector The opposite corner.

---@class lissom.HairstyleOptions
---@field scalp? lissom.Scalp The scalp. Default: guessed.
---@field resolution? integer Grid points of the field. 25,000 do for smooth styles, 50,000 for ponytails. Default: 50000.
---@field volume? lissom.HairstyleOptions.Volume A box in metres of an average head, around the center of its frame: x to its left, y up, z to the front. Hair ends at its faces. Default: around the head, down to the chest.
---@field solver? "dual"|"cholesky" dual is fast; cholesky is the thesis's way, a reference: it updates its factor, or makes it again in a build without CHOLMOD. Default: "dual".
---@field boundary? "zero_flux"|"thesis" Condition of the field at the box. Default: "zero_flux"; as in the thesis "thesis".
---@field tension? number Keeps the field from growing far from the curves. Default: 0.03; as in the thesis 0.
---@field gravity? number Hair that no curve is near falls along the head, goes to the sides over the face, and to the nearest tie if there are ponytails; a stream that ends close to a tie leads into it, and from the end of any other hair falls on. 0: the curves alone determine all hair. Default: 1; as in the thesis 0.
---@field fidelity? "default"|"thesis" thesis: chapter 4 to the letter, for comparison. It changes the defaults, also for the curves and for `grow`; the page thesis.md of the reference names all of it. Default: "default".

---Starts a hairstyle without curves on a head.
---@param head lissom.Mesh The head; its shape is copied.
---@param options? lissom.HairstyleOptions
---@return lissom.Hairstyle style # The hairstyle.
function lissom.hairstyle(head, options) end

---@class lissom.Read_styleOptions
---@field scalp? lissom.Scalp The scalp. Default: guessed.

---Makes a style of the text of a style file.
---@param text string JSON, as style:text gives it.
---@param head lissom.Mesh The head that it goes on.
---@param options? lissom.Read_styleOptions
---@return lissom.Hairstyle style # The hairstyle.
function lissom.read_style(text, head, options) end

---@class lissom.GroomOptions
---@field head lissom.Mesh The head of all styles.
---@field layers? table A list of layers, tables with `style`, a lissom.Hairstyle; `grow`, options of style:grow; `mask`, the part of the scalp that it grows on: numbers for the vertices of the head, function(vertex, x, y, z) or a lissom.Region; `operators`, a list of tables that begin with the name of a method of lissom.Strands, with its options (push_out, shrinkwrap, cut, braid, bun and feed_braid get the layer's head or scalp), and are skipped with `off = true`; a braid or a bun without a spine or a center follows the curve of the style whose name is `along`, else its first ponytail, as it was drawn; `name`; `on`, true by default; `over`, whether it is lifted over the layers below, true by default, by `gap` more than they are thick, 0.001 metres by default; `collide`, whether hair that operators moved is pushed out of the head at the end, true by default. Functions of vertices are asked once. Default: those of `hair`.
---@field hair? lissom.Strands Hair of a groom in a scene, to go on with it. Default: none.
---@field scalp? lissom.Scalp With `hair`: the scalp of its styles. Default: guessed.

---Makes a groom: layers of hair, the first below the others, each of a style and an ordered stack of operators.
---@param options lissom.GroomOptions
---@return lissom.Groom groom # The groom.
function lissom.groom(options) end

---@class lissom.Load_groomOptions
---@field scalp? lissom.Scalp The scalp of its styles. Default: guessed.

---Reads a groom for a head, which may be another than it was made on.
---@param path string The JSON file.
---@param head lissom.Mesh The head that it goes on.
---@param options? lissom.Load_groomOptions
---@return lissom.Groom groom # The groom.
function lissom.load_groom(path, head, options) end

---Writes a groom with its styles as JSON that people can read and edit.
---@param groom table A groom.
---@param path string The file.
---@return lissom.Groom groom # The groom.
function lissom.save_groom(groom, path) end

---@class lissom.Load_strandsOptions
---@field up? "y"|"z" The file's up axis; z is turned to y, which is up here. Default: the file's own, else y.
---@field unit? number Length of the file's unit in metres. In metres. Default: the file's own, else 1.

---Reads hair from a .hair, .data (HairSalon, HairNet), .usda (BasisCurves), .tfx (TressFX), .glb, .gltf (lines) or .ply file (points with edges, as HairStep and Open3D write them, or with an element 'strand').
---@param path string The file; its extension names the format.
---@param options? lissom.Load_strandsOptions
---@return lissom.Strands strands # The strands.
function lissom.load_strands(path, options) end

---@class lissom.StrandsOptions
---@field points lissom.Vector[] The points of all strands, root to tip, in metres.
---@field counts integer[] Number of points of each strand.
---@field like? lissom.Strands As many strands, whose roots, groups, ids, guides, widths and colours the new ones have. Default: none.

---Strands of given points.
---@param options lissom.StrandsOptions
---@return lissom.Strands strands # The new strands.
function lissom.strands(options) end

---@class lissom.Load_sceneOptions
---@field history? number Memory that its history may take beside one copy of the present content; the oldest steps are forgotten beyond it. 0: it has none. In bytes. Default: 536870912.

---Reads a scene that scene:save has written, with its parameters, and with its history if that was saved. A folder that was edited by hand is read as it is then, without the history.
---@param path string The file or the folder.
---@param options? lissom.Load_sceneOptions
---@return lissom.Scene scene # A scene with the same hash.
function lissom.load_scene(path, options) end

---@class lissom.SceneOptions
---@field history? number Memory that its history may take beside one copy of the present content; the oldest steps are forgotten beyond it. 0: it has none. In bytes. Default: 536870912.

---Makes an empty scene.
---@param options? lissom.SceneOptions
---@return lissom.Scene scene # Give it objects by add.
function lissom.scene(options) end

---@class lissom.PolylineOptions
---@field points lissom.Vector[] Its points, in order.
---@field closed? boolean Joins the last point to the first. Default: false.

---Makes a free curve.
---@param options lissom.PolylineOptions
---@return lissom.Polyline line # A new polyline.
function lissom.polyline(options) end

---@class lissom.CameraOptions
---@field eye lissom.Vector Its position.
---@field target? lissom.Vector The point in the middle of the picture. Default: {0, 0, 0}.
---@field up? "x"|"y"|"z"|lissom.Vector The direction that is up in the picture. Default: "y".
---@field fov? number Vertical opening angle. In degrees. Default: 30.
---@field ortho? number Height of the picture in world units; the camera then has no perspective.

---A camera that stands at a point and looks at another.
---@param options lissom.CameraOptions
---@return lissom.Camera camera # The camera.
function lissom.camera(options) end

---@class lissom.FrameOptions
---@field view? "front"|"back"|"left"|"right"|"top"|"bottom"|"three-quarter" The side to look from, of the world and not of the object: with y upwards the camera stands at +z for front, -z for back, +x for right, -x for left. For a head that faces +z, as is usual, left shows its own right side. three-quarter stands between front and right, and above. Default: three-quarter.
---@field up? "y"|"z" The axis that points up in the view. Default: y.
---@field parallel? boolean Without perspective. Default: false.
---@field margin? number Share of the picture left free on every side. Default: 0.06.
---@field fov? number Vertical opening angle. In degrees. Default: 30.
---@field size? integer|integer[] {width, height} of the picture in pixels; one number for a square. Default: {1280, 960}.

---The camera of a standard view that shows all of a mesh, as large as the margin allows. Use it for several pictures that are to be compared.
---@param mesh lissom.Mesh The mesh to show.
---@param options? lissom.FrameOptions
---@return lissom.Camera camera # The camera.
function lissom.frame(mesh, options) end

---@class lissom.GizmoOptions.Steps
---@field length? number Of moves. Default: 1, 2 or 5 times a power of ten that is seen as 10 pixels or more.
---@field angle? number Of turns. In degrees. Default: 15.
---@field factor? number Of scaling. Default: 0.1.

---@class lissom.GizmoOptions
---@field origin? lissom.Vector The point that it stands at, and that turns and scaling are about. Default: {0, 0, 0}.
---@field mode? "move"|"rotate"|"scale"|"all" Mode of its parts. Default: all.
---@field axes? "world"|"local"|"view" Directions of its axes: the world's, those of `local_axes`, or to the right, upwards and to the viewer. Default: world.
---@field local_axes? number[][] Rows of a rotation; its columns are the object's axes.
---@field size? number Length of an axis, the same at every distance. In pixels. Default: 90.
---@field steps? lissom.GizmoOptions.Steps The steps of snapping.

---A gizmo for moving, turning and scaling by hand.
---@param options? lissom.GizmoOptions
---@return lissom.Gizmo gizmo # The gizmo.
function lissom.gizmo(options) end

---Makes a tool: functions that are called with a hand's input. press, drag and release, or run, a coroutine that asks by lissom.pick, of which clicks are the answers unless press returns true; tick, called about 30 times a second while a button is down; move, wheel, key, changed (of a parameter), draw, activate, deactivate, cancel. All take the tool itself and a lissom.ToolEvent, draw a lissom.ToolView. From press to release is one step of the scene, any other call is one of its own; after an error the scene is as before. A release that returns false takes the gesture back, for what is only shown. drag is called with every place that the hand came to. The table's other keys are the tool's own.
---@param tool table name, help, params (as for lissom.params) and functions.
---@return table tool # The same table; `tool.params` are the values now.
function lissom.tool(tool) end

---Reads a tool from its file, each time a new one.
---@param name string A file that ends with .lua, or the name of one that ships: "select", "deform", ... (tools/NAME.lua on package.path).
---@return table tool # The result of the file.
function lissom.load_tool(name) end

---@class lissom.Tool_hostOptions
---@field scene lissom.Scene The scene that the tools work on.
---@field camera lissom.Camera The camera that it is seen by.
---@field size? integer|integer[] {width, height} of the picture in pixels; one number for a square. Default: {1280, 960}.
---@field up? "y"|"z" The axis of the world that points up in views. Default: "y".
---@field tool? table The first tool. Default: none.

---Runs tools without a window: calls them with a hand's input. Errors of a tool go on once the scene is as before.
---@param options lissom.Tool_hostOptions
---@return lissom.ToolHost host # Call its methods.
function lissom.tool_host(options) end

---@class lissom.ReplayOptions
---@field scene? lissom.Scene The scene to work on; else the files that the recording names are opened.
---@field tools? table Tools by which those of the same names are replaced: a list. Default: none.

---Repeats a recording, and compares the hash of the scene before it, after each step and at the end. A recording is a script that calls this; the files that it names are looked for from its own folder.
---@param recording string|table The recorded events.
---@param options? lissom.ReplayOptions
---@return lissom.Scene scene # The scene as it is then.
function lissom.replay(recording, options) end

---@class lissom.PointOptions
---@field prompt string The question to the person, in a line.
---@field optional? boolean The Enter key answers too, with nil. Default: false.
---@field object? string Only on the object of the scene with this name. Default: any.

---Asks for a point of a surface and waits for a click there, inside the run function of a tool.
---@param options lissom.PointOptions
---@return lissom.PickHit? hit # The clicked element; for a boundary it has the Boundary too, `boundary`.
function lissom.pick.point(options) end

---@class lissom.VertexOptions
---@field prompt string The question to the person, in a line.
---@field optional? boolean The Enter key answers too, with nil. Default: false.
---@field object? string Only on the object of the scene with this name. Default: any.

---Asks for a vertex and waits for a click there, inside the run function of a tool.
---@param options lissom.VertexOptions
---@return lissom.PickHit? hit # The clicked element; for a boundary it has the Boundary too, `boundary`.
function lissom.pick.vertex(options) end

---@class lissom.FaceOptions
---@field prompt string The question to the person, in a line.
---@field optional? boolean The Enter key answers too, with nil. Default: false.
---@field object? string Only on the object of the scene with this name. Default: any.

---Asks for a face and waits for a click there, inside the run function of a tool.
---@param options lissom.FaceOptions
---@return lissom.PickHit? hit # The clicked element; for a boundary it has the Boundary too, `boundary`.
function lissom.pick.face(options) end

---@class lissom.EdgeOptions
---@field prompt string The question to the person, in a line.
---@field optional? boolean The Enter key answers too, with nil. Default: false.
---@field object? string Only on the object of the scene with this name. Default: any.

---Asks for an edge and waits for a click there, inside the run function of a tool.
---@param options lissom.EdgeOptions
---@return lissom.PickHit? hit # The clicked element; for a boundary it has the Boundary too, `boundary`.
function lissom.pick.edge(options) end

---@class lissom.BoundaryOptions
---@field prompt string The question to the person, in a line.
---@field optional? boolean The Enter key answers too, with nil. Default: false.
---@field object? string Only on the object of the scene with this name. Default: any.

---Asks for an open boundary and waits for a click there, inside the run function of a tool.
---@param options lissom.BoundaryOptions
---@return lissom.PickHit? hit # The clicked element; for a boundary it has the Boundary too, `boundary`.
function lissom.pick.boundary(options) end

---@class lissom.ObjectOptions
---@field prompt string The question to the person, in a line.
---@field optional? boolean The Enter key answers too, with nil. Default: false.
---@field object? string Only on the object of the scene with this name. Default: any.

---Asks for an object and waits for a click there, inside the run function of a tool.
---@param options lissom.ObjectOptions
---@return lissom.PickHit? hit # The clicked element; for a boundary it has the Boundary too, `boundary`.
function lissom.pick.object(options) end

---@class lissom.NumberOptions
---@field prompt string The question to the person, in a line.
---@field default? number The value of Enter alone. Default: none.

---Asks for a number, which is typed and ended by Enter.
---@param options lissom.NumberOptions
---@return number number # The typed number.
function lissom.pick.number(options) end

---@class lissom.ConfirmOptions
---@field prompt string The question to the person, in a line.

---Waits for the Enter key.
---@param options lissom.ConfirmOptions
---@return boolean done # true
function lissom.pick.confirm(options) end

---@class lissom.ParamsOptions.Declarations
---@field type "number"|"integer"|"boolean"|"string"|"choice"|"file"|"folder"|"mesh"|"region"|"boundary"|"curve"|"head" Type of its values. A folder is one to write to: it is made, if it is missing, when the parameters are declared or it is set. The last five are texts for which a host shows a picker: the file or name of a mesh or a head, the name of a region, the name or number of an open boundary or a curve.
---@field default? boolean|number|string Its default; without one it must be given. Default: required.
---@field min? number Smallest value of a number or integer. Default: no limit.
---@field max? number Greatest value. Default: no limit.
---@field step? number Step of a slider. Default: any.
---@field choices? string[] The values of a choice.
---@field unit? string Shown after the value. Default: none.
---@field group? string Heading that it stands under. Default: none.
---@field help? string Its help text, one line. Default: none.
---@field of? string For a region, boundary or curve: the name of the parameter with the mesh or head that it lies on. Default: none.

---@class lissom.ParamsOptions
---@field command_line? boolean They are the script's. If not, they have their defaults, and may be declared any number of times: for tools. Default: true.
---@field words? boolean The command line may have words that are no flags; else `lissom run` refuses them, unless the script reads `arg` or `...`. Default: false.

---Declares the parameters of the script, once, and returns their values. Under `lissom run` they come from flags (--name value), and --help lists them.
---@param declarations table<string, lissom.ParamsOptions.Declarations> Description of the parameter by its name.
---@param options? lissom.ParamsOptions
---@return lissom.Params params # Their values.
---@return string[] rest # The words of the command line that are no flags.
function lissom.params(declarations, options) end

---@class lissom.ListenOptions
---@field progress? fun(label: string, fraction: number): boolean? Called during an operation with the name of the step and the fraction done, 0 to 1. If it returns false the operation is cancelled. Default: none.
---@field log? fun(level: string, message: string) Called after an operation with each of its messages; the level is debug, info or warning. Default: none.

---Sets the functions that hear of long operations, in place of those before. They cannot call lissom themselves.
---@param options? lissom.ListenOptions
function lissom.listen(options) end

---Calls a function; returns its results, or nil and its error.
---@param f function The function; its arguments follow.
---@param ... any Its arguments.
---@return any result # The results of the function; nil if it fails.
---@return lissom.Error? error # The error; an error that is not of lissom is handed on as it is.
function lissom.try(f, ...) end

---@class lissom.ErrorOptions
---@field message string The fault and a remedy, a sentence.
---@field code? "cancelled"|"invalid_argument"|"out_of_range"|"file_not_found"|"file_is_directory"|"file_empty"|"file_unreadable"|"file_write_failed"|"file_syntax"|"file_truncated"|"file_too_large"|"unknown_format"|"unsafe_path"|"not_finite"|"mesh_empty"|"face_index"|"face_too_small"|"repeated_vertex"|"duplicate_face"|"nonmanifold_edge"|"nonmanifold_vertex"|"inconsistent_orientation"|"unreferenced_vertex"|"zero_area"|"region_empty"|"topology_mismatch"|"handle_outside_region"|"handle_overlap"|"handle_removed"|"singular_transform"|"unconstrained"|"not_a_boundary"|"not_a_disk"|"boundary_conflict"|"key_conflict"|"skin_mismatch"|"not_positive_definite"|"memory_limit"|"unsupported"|"no_display"|"internal" Its code. Default: "invalid_argument".
---@field elements? table A lissom.Elements: the elements concerned. Default: none.
---@field file? string The input file concerned. Default: none.
---@field line? integer The line of that file. Default: none.
---@field level? integer Level of the line that is the error's place: 1 for this call, 2 for the call of the function that it is in. Default: 1.

---Raises an error object, as every function of lissom that fails.
---@param options lissom.ErrorOptions
function lissom.error(options) end

return lissom
