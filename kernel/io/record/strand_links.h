/// Lines of edges as strands; private to kernel/io.
#pragma once

#include <cstddef>
#include <vector>

#include "kernel/core/index.h"

namespace lissom {

/// Vertices of strands one after the other, and the place of each strand's first.
struct StrandOrder {
    std::vector<Index> vertices;
    std::vector<Index> offsets = {0};
    /// Vertices of no strand.
    std::size_t unused = 0;
};

/// Two vertices.
struct StrandLink {
    Index first = 0, second = 0;
};

/// Follows links from the end of each line that has the lower number; strands come in the order of
/// these ends. Errors: file_syntax naming a vertex where lines branch, or one of a closed line.
StrandOrder strands_of_links(const std::vector<StrandLink>& links, Index vertex_count);

}  // namespace lissom
