/// Scripts that mean harm, or look as if they did.
#pragma once

#include <string>
#include <vector>

namespace lissom::test {

/// How a script has to end.
enum class HostileEnd {
    /// By a limit of time.
    time,
    /// By an error whose message has `text`.
    error,
    /// Well, returning true: it has found that it can do no harm.
    harmless,
    /// By an error or well: what counts is that it ends, and within the limits.
    any,
};

struct HostileScript {
    std::string name, text;
    HostileEnd end;
    std::string message = {};
};

std::vector<HostileScript> hostile_scripts();

}  // namespace lissom::test
