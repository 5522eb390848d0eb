/// Options that follow the thesis to the letter.
///
///     Deformer deformer(mesh, region, thesis_deform_options());
///     Merger merger(head, body, joins, thesis_merge_options());
#pragma once

#include "kernel/deform/options.h"
#include "kernel/merge/merge.h"

namespace lissom {

struct ThesisFormulas;

/// Returns the options of chapter 2: coherence 2, threshold 2e5, literal weights, flat vertices
/// displaced, second system (2.10).
DeformOptions thesis_deform_options();

/// Returns the formulas of chapter 3, for MergeOptions::thesis and PasteOptions::thesis; they live
/// as long as the program.
const ThesisFormulas& thesis_formulas();

/// Returns the options of section 3.3: its formulas, seams by a band, no collar, no trimming, no
/// refinement, and in the fixed configuration frames that keep their directions. `smooth` stays:
/// the thesis makes "several" umbrella steps, but none with a transition, which needs 0.
MergeOptions thesis_merge_options(Configuration configuration = Configuration::free);

}  // namespace lissom
