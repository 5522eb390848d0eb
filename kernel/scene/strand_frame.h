/// All of strands but their points; private to kernel/scene.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kernel/core/index.h"
#include "kernel/hair/strands/strands.h"

namespace lissom {

struct StrandFrame {
    std::vector<Index> offsets;
    StrandWidths widths;
    StrandRoots roots;
    std::vector<Index> groups;
    std::vector<std::string> group_names;
    std::vector<std::uint32_t> ids;
    StrandGuides guides;
    std::optional<StrandValues<Eigen::Vector3f>> colors;
    StrandValues<float> transparency{0.0f};
    std::string comment;
};

StrandFrame frame_of(const Strands& strands);

/// Gives strands all of a frame but its offsets.
void set_frame(Strands& strands, StrandFrame frame);

}  // namespace lissom
