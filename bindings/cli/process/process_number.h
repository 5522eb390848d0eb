/// Numbers of processes. The platform that they need is in process_number.cpp.
#pragma once

namespace lissom::cli {

/// Returns the number of this process.
long process_number();
/// Returns whether a process with this number runs.
bool process_runs(long number);

}  // namespace lissom::cli
