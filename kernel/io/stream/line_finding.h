/// LineFinding: a finding in a text, with its lines; private to kernel/io.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "kernel/core/index.h"
#include "kernel/mesh/report.h"

namespace lissom {

/// Collects the lines of findings of one kind.
class LineFinding {
  public:
    /// One more, on a line that is counted from 0.
    void add(std::size_t line);
    /// Adds it to `report`, if there is any, with a message as "normals on lines 3 and 7".
    void finish(Report& report, FindingKind kind, const std::string& what);

  private:
    std::size_t count_ = 0;
    std::vector<Index> lines_;
};

}  // namespace lissom
