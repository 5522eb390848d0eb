/// Rewrites a script of version 0.1 to the present names (bindings/lua/core/old_names.h).
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace lissom::cli {

/// One place of a script that was rewritten.
struct MigratedName {
    int line = 0;
    std::string before, after;
};

/// A line that the text alone does not decide.
struct UndecidedLine {
    int line = 0;
    std::string advice;
};

struct Migration {
    /// The whole text; what no change concerns is kept to the byte.
    std::string text;
    /// By line.
    std::vector<MigratedName> changes;
    std::vector<UndecidedLine> undecided;
};

/// Rewrites the old names in a Lua script, or in the Lua blocks of a Markdown text. Rewriting the
/// result again changes nothing.
Migration migrate(std::string_view text, bool markdown = false);

}  // namespace lissom::cli
