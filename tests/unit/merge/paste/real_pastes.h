/// Pastes of features of real models, marked casually: by planes and balls.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "kernel/merge/paste/paste_options.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/region.h"

namespace lissom::test {

struct RealPaste {
    std::string name;
    /// Files in the folder of the test data.
    std::string source, target;
    std::function<Region(const Mesh&)> region, feature;
    PastePlacement placement;
    /// What the energy near the seam keeps below.
    double energy = 0.0;
    /// What it should come to: the best that was found for this pair; below 0 where none was.
    double best = -1.0;
    /// What is known of a best one that is not reached.
    std::string apart = {};
};

const std::vector<RealPaste>& real_pastes();

}  // namespace lissom::test
