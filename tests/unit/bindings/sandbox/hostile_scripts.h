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

/// A script that the first wall, that of Lua's own process, ends: by its time, by an error of the
/// limit that `message` names, or because there is nothing to be had.
struct HostileScript {
    std::string name, text;
    HostileEnd end;
    std::string message = {};
};

/// All of them.
std::vector<HostileScript> hostile_scripts();

/// Parts: texts that are kept, addresses, callbacks within the library, and content of objects.
std::vector<HostileScript> hostile_names();
std::vector<HostileScript> hostile_addresses();
std::vector<HostileScript> hostile_callbacks();
std::vector<HostileScript> hostile_keeping();

}  // namespace lissom::test
