/// Quality of a deformed surface.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/error.h"
#include "kernel/core/index.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/query/self_intersections.h"

namespace lissom {

class Deformer;
const Context& own_context();

/// Options of a report.
struct DeformReportOptions {
    /// Searches for faces that run through one another, which takes longer than a frame.
    bool crossings = false;
};

/// Two vertices that are held by different handles, at most two edges apart, and go different ways.
struct Tear {
    std::array<Index, 2> vertices{kNoIndex, kNoIndex};
    /// Distance of the two places that their handles give the middle between them, in edge lengths.
    double slip = 0.0;
};

/// The kinds of harm that a deformation does to a surface.
enum class DeformHarm {
    torn,       ///< handles that nearly touch go different ways
    stretched,  ///< edges change their length far more than the handles ask for
    folded,     ///< faces look against the faces around them
    crossing,   ///< faces run through one another
    volume      ///< the volume changes far more than the handles ask for
};

/// The name of a harm in scripts, for instance "stretched".
const char* harm_name(DeformHarm harm);

/// A reason why a result may not be the one that was wanted.
struct DeformWarning {
    DeformHarm harm = DeformHarm::torn;
    /// Its measure and a remedy.
    std::string message;
    /// The vertices, edges or faces concerned, of the mesh; kind `none` for a volume.
    Elements elements;
};

/// The result that a Deformer shows beside its rest shape.
struct DeformReport {
    /// The greatest factor by which an edge of the region, or next to it, is longer or shorter than
    /// at rest, at least 1, and the vertices of that edge.
    double stretch = 1.0;
    std::array<Index, 2> stretched{kNoIndex, kNoIndex};
    /// Faces that look against those around them, and did not at rest; ascending.
    std::vector<Index> flipped;
    /// Pairs of faces that intersect and did not at rest, if asked for.
    std::optional<std::vector<FacePair>> crossings;
    /// Volume of the mesh over that at rest, less 1; absent without a volume.
    std::optional<double> volume_change;
    /// Tears between handles that nearly touch, the worst first.
    std::vector<Tear> tears;
    /// The harms that a user would see, by the limits in deform_warnings.cpp; of crossings only if
    /// they were asked for.
    std::vector<DeformWarning> warnings;
};

/// Measures the result that a deformer shows beside its rest shape, both as they lie in `mesh`.
/// Errors: as Deformer::apply_to; cancelled.
DeformReport report_of(const Deformer& deformer, const Mesh& mesh,
                       const DeformReportOptions& options = {},
                       const Context& context = own_context());

/// Returns a report in words: "ok", or the kinds of harm; then its measures, and a line for each
/// warning.
std::string report_text(const DeformReport& report);

}  // namespace lissom
