/// Completions at the prompt: names of variables, fields, functions, methods and options, the last
/// three from the registration table.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/core/state.h"

namespace lissom::cli {

struct Completions {
    /// Begin of the completed word.
    std::size_t begin = 0;
    /// Whole words, in order; names of options end with " = ".
    std::vector<std::string> words;
    /// The text ends inside a string: the name of a file may be meant.
    bool in_string = false;
};

/// Returns the completions of `text`, the typed chunk up to the cursor. Runs no code of the
/// script: reads variables and fields raw, and takes the types of results from their
/// descriptions.
Completions completions(lua_State* L, std::string_view text);

}  // namespace lissom::cli
