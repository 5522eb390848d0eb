/// Handles that nearly touch and go different ways; private to kernel/deform.
#pragma once

#include <vector>

#include "kernel/deform/deform_report.h"
#include "kernel/deform/holds/poses.h"
#include "kernel/deform/preparation.h"

namespace lissom {

/// The gaps of a preparation that `poses` tear, the worst first: those at which handles part by
/// more than one and a half times the length between them.
std::vector<Tear> tears_of(const Preparation& preparation, const Poses& poses);

/// Returns a warning with the measure of the worst tear and a remedy; there is one at least.
DeformWarning tear_warning(const Preparation& preparation, const std::vector<Tear>& tears);

}  // namespace lissom
