#include "kernel/thesis/fidelity.h"

#include "kernel/merge/blend/overlap_transition.h"
#include "kernel/thesis/transition/literal_transition.h"

namespace lissom {
namespace {

// |M| / sqrt 3, second system (2.11), coherence 2, literal weights on the surface brought to unit
// size.
BoundaryDeformOptions boundary_options() {
    BoundaryDeformOptions options;
    const DeformOptions literal = thesis_deform_options();
    options.size = SizeField::gradient;
    options.second = literal.second;
    options.coherence = literal.coherence;
    options.degenerate_threshold = literal.degenerate_threshold;
    options.scale_free = literal.scale_free;
    return options;
}

}  // namespace

DeformOptions thesis_deform_options() {
    DeformOptions options;
    options.second = SecondSystem::laplacian;
    options.coherence = 2;
    options.degenerate_threshold = 2e5;
    options.scale_free = false;
    options.flat = FlatVertices::displaced;
    return options;
}

const ThesisFormulas& thesis_formulas() {
    static const ThesisFormulas formulas{boundary_options(), literal_transition()};
    return formulas;
}

MergeOptions thesis_merge_options(Configuration configuration) {
    MergeOptions options;
    options.configuration = configuration;
    options.turn_frames = configuration == Configuration::free;
    options.feature_motion = FeatureMotion::common;
    options.seam = SeamKind::band;
    options.collar = options.trim = options.subdivide = false;
    options.thesis = &thesis_formulas();
    return options;
}

}  // namespace lissom
