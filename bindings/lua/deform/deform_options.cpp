// The options of lissom.deformer and lissom.deform.
#include "bindings/lua/deform/deform_options.h"

#include <string>

#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/core/parse/expectation.h"
#include "bindings/lua/deform/thesis_parts.h"

namespace lissom::lua {
namespace {

template <typename Enum>
void take_choice(const Call& call, const char* path, Enum& target) {
    if (call.has(path)) target = call.choice<Enum>(path);
}

void take_number(const Call& call, const char* path, double& target) {
    if (call.has(path)) target = call.number(path);
}

DeformOptions deform_options(const Call& call) {
    const bool thesis = call.integer("fidelity") == 1;
    DeformOptions options = thesis ? literal_deform_options() : DeformOptions{};
    take_choice(call, "method", options.method);
    options.comparison = comparison_maker();
    take_choice(call, "second", options.second);
    take_choice(call, "local_size", options.local_size);
    take_choice(call, "weights", options.weights);
    if (call.has("coherence")) options.coherence = call.integer("coherence");
    if (call.has("refine")) options.refine = call.integer("refine");
    if (call.has("subdivide_borders"))
        options.subdivide_borders = call.boolean("subdivide_borders");
    take_choice(call, "flat", options.flat);
    options.loose = call.choice<UnheldParts>("loose");
    if (call.has("free_rings")) options.free_rings = call.integer("free_rings");
    if (call.integer("levels") == 1) {
        options.level_vertices = call.integer("level_vertices");
    }
    take_number(call, "displacement", options.displacement);
    options.transition = call.number("transition");
    take_number(call, "volume", options.volume);
    take_number(call, "degenerate_threshold", options.degenerate_threshold);
    return options;
}

}  // namespace

Deformer made_deformer(const Call& call, const MeshObject& mesh) {
    const DeformOptions options = deform_options(call);
    const Region region = call.has("region") ? call.object<RegionObject>("region")->current()
                                             : Region::all(mesh.mesh.shared_topology());
    return Deformer(mesh.mesh, region, options, call.context());
}

std::vector<Parameter> deform_parameters() {
    const DeformOptions defaults;
    return {
        object("region", "lissom.Region", "The part that may move. Outside nothing does.")
            .optional("all"),
        choice(
            "method",
            {"implicit", "naive", "rotation_estimate", "similarity", "geodesic", "harmonic",
             "frames"},
            "implicit is this kernel's own method. The others are for comparison: Laplacian "
            "coordinates as they are; turned by rotations estimated from that (Lipman 2004); by "
            "similarities implicit in the positions (Sorkine 2004); handle rotations propagated "
            "by geodesic distance (Yu 2004) or by harmonic fields (Zayer 2005); rotation-"
            "invariant coordinates (Lipman 2005). Of the other options they take `weights` only, "
            "and geodesic not even that; they have no basis, and preview equals solve.")
            .optional("\"implicit\""),
        choice("local_size", {"keep", "scale"},
               "Whether details keep their size or scale with the surface around them.")
            .optional("\"keep\""),
        choice(
            "second", {"blend", "laplacian", "poisson"},
            "The system that makes the shape from the rotations: blend is smooth at handles with "
            "little distortion, laplacian is the thesis's, poisson has the least distortion. Keep "
            "blend unless something asks for another: laplacian for the smoothest surface, "
            "which may stretch, poisson for one that may crease at handles, as along an edge of "
            "the part. Compared in examples/deform/second.png.")
            .optional("\"blend\"")
            .thesis("2.4.4", "\"laplacian\""),
        integer("coherence", "Rings of neighbours that turn alike.")
            .between(1, 2)
            .optional(std::to_string(defaults.coherence))
            .thesis("2.4.2", "2"),
        choice("weights", {"cotangent", "uniform"}, "Weights of the Laplacian coordinates.")
            .optional("\"cotangent\""),
        integer("refine",
                "Rounds, 0 to 2, of fitting the rotations to the result and solving for it again: "
                "less distortion for half a frame each. For bars and limbs that bend and twist. "
                "Less of it is kept the nearer parts of the surface come to one another and the "
                "more edges stretch, and nothing crosses that would not without; a draft does not "
                "check. Beside handles that change their size it fades to nothing. Compared in "
                "examples/deform/refine.png.")
            .at_least(0)
            .optional(std::to_string(defaults.refine)),
        number("volume",
               "Share of the thickness at rest that is kept, by springs across the inside: twisted "
               "and bent solids keep their volume and get no waist. It acts between the two sides "
               "of the region, and fades beside handles that change the size; a sheet has no "
               "inside. 1 keeps "
               "all of it, at about a third of a frame; keep_volume changes it. Compared in "
               "examples/deform/volume.png.")
            .between(0, 1)
            .optional(plain_number(defaults.volume)),
        choice("loose", {"error", "stay", "follow"},
               "Treatment of separate parts that no handle holds, such as buttons and eyes: an "
               "error that names them; they stay; or each follows the surface nearest to it, as "
               "a rigid piece; in a basis as an affine one.")
            .defaults("error"),
        integer("free_rings",
                "Rings of vertices that handles release if they nearly touch another, at most "
                "two edges apart, so that the surface between has room: handles that go "
                "different ways would tear it. report says how many help.")
            .between(0, 10)
            .optional("0"),
        choice("levels", {"none", "auto"},
               "auto deforms a very large region on two levels, if it has at least four times "
               "`level_vertices`: the method works on a thinned surface, and all vertices follow "
               "it with their details, several times as fast and in less memory. Handles hold "
               "their vertices exactly. What needs the whole surface, as soft handles do, gets "
               "it, with a warning.")
            .defaults("none"),
        integer("level_vertices", "Vertices of the thinned surface.")
            .at_least(100)
            .defaults(kLevelVertices),
        boolean("subdivide_borders",
                "Works on a surface that is subdivided along borders of handles that are coarse "
                "beside the region; the mesh keeps its faces.")
            .optional("true"),
        choice("flat", {"extended", "displaced"},
               "Rotation of a vertex whose surroundings are flat: extended, by an "
               "unknown of its own beside it, so that a flat part that is moved within its plane "
               "stays flat; displaced, by moving it out of the plane while solving.")
            .optional("\"extended\"")
            .thesis("2.4.3", "\"displaced\""),
        number("displacement",
               "Distance by which degenerate vertices are displaced, and beside flat ones their "
               "unknown lies.")
            .above(0)
            .in("mean lengths of their edges")
            .optional(plain_number(defaults.displacement)),
        number("degenerate_threshold",
               "Condition number from which a vertex counts as degenerate and is displaced. Below "
               "about 100 that is nearly every vertex.")
            .above(1)
            .optional(plain_number(defaults.degenerate_threshold))
            .thesis("2.4.3", "200000"),
        number("transition",
               "Width of the zone along the region's outline, in geodesic distance, over which "
               "the deformation fades into the fixed part.")
            .at_least(0)
            .in("mesh units")
            .defaults(0.0),
        choice("fidelity", {"default", "thesis"},
               "thesis: coherence 2, second laplacian, and the weights and threshold of the thesis "
               "unless another option gives them; the page thesis.md of the reference names all "
               "of it.")
            .defaults("default")};
}

}  // namespace lissom::lua
