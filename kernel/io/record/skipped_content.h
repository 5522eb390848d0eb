/// SkippedContent: content of a file without a place in a mesh; private to kernel/io.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "kernel/mesh/report.h"

namespace lissom {

/// Counts skipped content, by name.
class SkippedContent {
  public:
    /// Adds `count` of the content called `what`, for instance "lines" or "element 'camera'".
    /// Beyond a hundred different names, which damaged files have, they are counted together.
    void add(std::string_view what, std::size_t count = 1);
    bool empty() const { return counts_.empty(); }
    /// Adds a finding of kind content_skipped, such as "3 lines, 2 of 'vp'", if there is any.
    void finish(Report& report) const;

  private:
    std::map<std::string, std::size_t, std::less<>> counts_;
};

}  // namespace lissom
