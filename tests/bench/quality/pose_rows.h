/// Rows of spaces of poses: the volume half way to a pose beside a linear blend, the error of morph
/// targets with and without correctives, and the cost of a blend.
#pragma once

#include <vector>

#include "tests/bench/quality/scenes.h"
#include "tests/bench/report.h"

namespace lissom::bench {

/// Each move of the scenes, up to 180 degrees, is a pose.
void add_pose_rows(Report& report, const std::vector<QualityScene>& scenes);

}  // namespace lissom::bench
