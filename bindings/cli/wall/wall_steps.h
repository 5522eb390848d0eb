/// Steps by which a process goes behind the wall; private to bindings/cli/wall.
#pragma once

#include "bindings/cli/wall/wall.h"

namespace lissom::cli {

/// Version of Landlock; below 1 if the system has none.
int landlock_version();
/// Leaves the process the rights of files that `rights` names, and those that its libraries need.
/// Throws std::runtime_error.
void restrict_files(const WallRights& rights);

/// Returns whether system calls can be filtered here.
bool can_filter_calls();
/// Refuses network, programs, other processes, and all that changes the system, to every thread of
/// the process. Throws std::runtime_error.
void filter_calls();

/// Waits for the child, and ends it at its limits.
WallEnd watch_child(int child, const WallRights& rights);

}  // namespace lissom::cli
