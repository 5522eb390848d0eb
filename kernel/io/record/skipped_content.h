/// SkippedContent: what a reader found in a file and a mesh has no place for; private to kernel/io.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "kernel/mesh/report.h"

namespace lissom {

/// Counts what was passed over, by name.
class SkippedContent {
  public:
    /// Adds `count` of what is called `what`, for instance "lines" or "element 'camera'". Beyond a
    /// hundred different names, which damaged files have, they are counted together.
    void add(std::string_view what, std::size_t count = 1);
    bool empty() const { return counts_.empty(); }
    /// Adds a finding of kind content_skipped, such as "3 lines, 2 of 'vp'", where there is any.
    void finish(Report& report) const;

  private:
    std::map<std::string, std::size_t, std::less<>> counts_;
};

}  // namespace lissom
