/// FileHair: hair as a file has it, before it comes into the kernel's unit and axes; private to
/// kernel/io.
#pragma once

#include <optional>

#include "kernel/hair/strands/strands.h"
#include "kernel/io/record/options.h"

namespace lissom {

/// Hair of a file, and the statements of the file about it.
struct FileHair {
    Strands strands;
    /// Length of its unit in metres and its up axis, if it gives them.
    std::optional<double> meters_per_unit = std::nullopt;
    UpAxis up = UpAxis::none;
    /// False if it says nothing of widths.
    bool has_widths = false;
};

}  // namespace lissom
