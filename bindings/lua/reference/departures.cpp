#include "bindings/lua/reference/departures.h"

#include <algorithm>
#include <utility>

#include "bindings/lua/core/parse/expectation.h"

namespace lissom::lua {

const char* const kByFidelity = "`fidelity = \"thesis\"`";

namespace {

// The description of an option names its default.
void add_option_departures(std::vector<Departure>& list, const Function& function,
                           const std::string& call) {
    // One changes an existing object and has no defaults; the other has those of lissom.merge.
    if (function.name == "set" || function.name == "merger" || function.name == "deform") return;
    for (const Parameter& p : function.options) {
        if (p.thesis_text.empty()) continue;
        list.push_back({p.thesis_section, "`" + p.name + "` of `" + call + "`", p.default_text,
                        p.thesis_text, kByFidelity, p.name});
    }
}

std::vector<Departure> deform_departures() {
    return {{"2.4.2", "Weights of both terms of (2.6) and (2.7)",
             "by the areas of vertices and the cotangents of edges, so that neither the scale nor "
             "the resolution of the mesh matters",
             "all 1", kByFidelity},
            {"2.4.2", "Handles that are turned by more than half a turn",
             "the surface turns as far as was asked for", "it turns the shorter way", kByFidelity}};
}

std::vector<Departure> merge_departures() {
    return {
        {"3.3.1", "Which points of two boundaries meet between keys",
         "by arc length of both smoothed; vertices that nearly meet do",
         "by arc length; each goes to its own place", kByFidelity},
        {"3.3.1", "Boundaries without keys", "meet at the best fit", "always have keys", ""},
        {"3.3.1", "Frames along a boundary",
         "smoothed along it, with normals continued to it from within",
         "as they are at each vertex", kByFidelity},
        {"3.3.1", "How much the source grows at a boundary",
         "one factor a join, from the spread of both boundaries",
         "the ratio of tangent lengths at each vertex", kByFidelity},
        {"3.3.1", "How much local features grow, |M| of (2.11)",
         "a harmonic field with the factors at the boundaries", "|M| / sqrt 3", kByFidelity},
        {"3.3.1", "Systems of the deformation",
         "as `lissom.deformer` by default, with the second system blend",
         "as `lissom.deformer` of the thesis, on the surface brought to unit size", kByFidelity},
        {"3.3.1", "Umbrella steps at the seam: `smooth` of `lissom.merge`",
         "3, none of which may fold it; slivers are flipped away; also before a transition",
         "several, of seam and neighbours here; none with a transition", kByFidelity},
        {"3.3.1", "Meshes that are inside out", "are turned over, and a warning says so",
         "not said", ""},
        {"3.3.1", "Parts of the source without a boundary that is joined",
         "go along with the nearest joined part", "not said", ""},
        {"3.3.3", "Transition regions",
         "lie side by side at the seam, which is blended with coordinates along the surface",
         "overlap, and the source's is kept; bands cut open and laid over the unit square, and the "
         "term E_T with `transition.weight`",
         kByFidelity},
        {"3.3.3", "Laplacian coordinates that are interpolated",
         "by area, as those of meshes of unlike density differ otherwise", "not said", ""}};
}

std::vector<Departure> field_departures() {
    return {{"4.4.2", "`solver` of `lissom.hairstyle`",
             "dual, which finds the field of (4.3) many times faster",
             "Cholesky factors that are updated and downdated", "`solver = \"cholesky\"`"},
            {"4.5", "Grid points that several curves claim",
             "dividing curves count first, then the later curve, with those that agree with it "
             "within 60 degrees",
             "not said", ""},
            {"4.5", "Segments of curves",
             "of equal length along a smooth curve through the points that are drawn, as near to "
             "the grid's step as whole numbers come",
             "of the length of the grid's step", ""},
            {"4.5", "The vanishing extension of curves: `stop`", "0.04 metres, whatever the grid",
             "a few segments", "`stop = LENGTH`"}};
}

std::vector<Departure> curve_departures() {
    return {{"4.5", "Grid points beside several segments of a curve", "the mean of their tangents",
             "the tangent of the nearest", kByFidelity},
            {"4.5", "Local planes of dividing curves",
             "a tilt turns vectors; heights are distances to the head",
             "a tilt turns the planes, and vectors lie in them; heights are along the normal at "
             "the curve",
             kByFidelity},
            {"4.5", "The ring of a ponytail",
             "a slab in front of the tie, outside the head; cross sections count before it",
             "from R1 to R2 at the grid points nearest to the tie's plane, also in the head; it "
             "counts first, and is an error if the grid has no point in it",
             kByFidelity},
            {"4.5", "A ponytail without `profiles`",
             "cross sections along `share` of the spine, swollen by `fullness`",
             "always has two profiles", "`profiles = {...}`"},
            {"4.5", "Grid points near the cross sections of a ponytail",
             "those inside, and up to 0.6 steps outside", "not said", ""}};
}

std::vector<Departure> growth_departures() {
    return {{"4.6", "Strands in a tail",
             "fill it: each is drawn to a place of its own in the cross section, with `spread`",
             "follow the field alone", kByFidelity},
            {"4.6", "Vectors longer than 1, which the field has away from curves",
             "count as of length 1", "count as they are", kByFidelity},
            {"4.6", "First segments that point into the head", "are turned along it",
             "stay as they are", kByFidelity},
            {"4.6", "`max_segments` of `hairstyle:grow`, for closed flow lines", "400", "no limit",
             "`max_segments = NUMBER`"},
            {"4.6", "Density of roots", "thins out at the hairline", "even in the angles",
             "a scalp with `softness = 0`"},
            {"4.6", "Points at which `hairstyle:avoid_scalp` adds vectors",
             "the scalp, and the rest of the head at points at which the field points into it, "
             "but for points that curves constrain",
             "all grid points near the scalp", ""}};
}

void append(std::vector<Departure>& list, const std::vector<Departure>& more) {
    list.insert(list.end(), more.begin(), more.end());
}

}  // namespace

std::vector<Departure> departures(const Registry& registry) {
    std::vector<Departure> list;
    for (const auto& library : registry.libraries()) {
        for (const Function& f : library->functions) {
            add_option_departures(list, f, "lissom." + f.name);
        }
        for (const Type& type : library->types) {
            const std::string of = variable_name(type) + ":";
            for (const Function& f : type.methods) add_option_departures(list, f, of + f.name);
        }
    }
    for (const auto& more : {deform_departures(), merge_departures(), field_departures(),
                             curve_departures(), growth_departures()}) {
        append(list, more);
    }
    std::stable_sort(list.begin(), list.end(),
                     [](const Departure& a, const Departure& b) { return a.section < b.section; });
    return list;
}

}  // namespace lissom::lua
