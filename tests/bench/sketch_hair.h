/// Speed of sketching hair: from an event of a hand to the strands that it changes.
#pragma once

#include "tests/bench/report.h"

namespace lissom::bench {

/// Rows of a whole hairstyle of ten streams at 50K grid points, one of which is drawn, dragged and
/// combed.
void run_sketched_hair(Report& report);

}  // namespace lissom::bench
