/// CurvesPrim: the attributes of one BasisCurves, and the strands they stand for; private to
/// kernel/io.
#pragma once

#include <string>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/hair/strands/strands.h"
#include "kernel/io/stream/read_error.h"

namespace lissom {

/// Assignment of values to curves.
enum class CurveInterpolation { constant, uniform, varying, vertex };

/// Numbers of an attribute, `width` of them a value.
struct CurveValues {
    std::vector<float> numbers;
    CurveInterpolation interpolation = CurveInterpolation::vertex;
    bool found = false;
    /// Number of the value of each element; only if `is_indexed`.
    std::vector<double> indices = {};
    bool is_indexed = false;
};

/// Values of the file; defaults are those of USD.
struct CurvesPrim {
    std::string name;
    /// First place of the prim.
    FilePlace place;
    std::string type = "cubic", basis = "bezier", wrap = "nonperiodic";
    std::vector<double> counts;
    std::vector<float> points;
    CurveValues widths, uvs, colors, opacities;
    std::vector<std::string> group_names;
    std::vector<double> groups, ids, guides, faces, root_vertices;
    std::vector<float> guide_arcs;
    std::vector<float> barycentrics;
    /// Additional data of this program: widths before their profile, and the sources of opacities.
    /// They count if widths and opacities are still those that follow from them.
    CurveValues base_widths, transparencies;
    std::vector<float> width_profile;
    std::string comment;
    /// False if it, or a prim around it, is inactive or invisible.
    bool is_drawn = true;
    /// The map from its points to the layer, and whether no prim further out adds to it.
    Affine transform;
    bool is_placed = false;
};

/// Returns the strands of a prim in the space of the layer. Widths are scaled by the cube root of
/// the transform's determinant. Errors: file_syntax at the prim if its numbers contradict each
/// other; not_finite if the transform takes them out of the range of 32-bit numbers; unsupported
/// for kinds of curves that are not known.
Strands strands_of(CurvesPrim prim, const Context& context);

/// Replaces the control points of cubic curves, and all values that go with them, by points on the
/// curves; the type is linear then. Errors: as `strands_of`.
void make_linear(CurvesPrim& prim);

/// Number of points of each curve. Errors: file_syntax if they do not add up to the points.
std::vector<Index> curve_counts(const CurvesPrim& prim);

}  // namespace lissom
