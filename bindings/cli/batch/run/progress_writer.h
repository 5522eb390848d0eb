/// Progress of a batch as a line on a terminal, as plain lines, or as JSON.
#pragma once

#include <string>

#include "bindings/cli/batch/driver.h"
#include "bindings/cli/json.h"
#include "bindings/cli/program.h"

namespace lissom::cli {

/// Returns the fields of a progress, with the rate in jobs a second and the seconds left or null.
Json progress_json(const BatchProgress& progress);

class ProgressWriter {
  public:
    /// `form` is auto (a line on a terminal), plain or json (to the standard error) or none.
    ProgressWriter(Program& program, std::string form)
        : program_(program), form_(std::move(form)) {}

    /// Shows it; plain lines and JSON once a second, and at the end.
    void show(const BatchProgress& progress);

  private:
    Program& program_;
    std::string form_;
    double next_ = 0.0;
};

}  // namespace lissom::cli
