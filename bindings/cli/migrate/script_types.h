/// The types of objects in a Lua script, guessed from its text.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>

#include "bindings/cli/migrate/lua_tokens.h"

namespace lissom::cli {

/// Knows of a script which names hold deformers, hairstyles, scalps and mergers: from the calls
/// that they are assigned from, else from the names that the documents use.
class ScriptTypes {
  public:
    explicit ScriptTypes(const LuaTokens& tokens);

    /// The type of the expression that ends with token `last`, "lissom.Deformer"; "" if unknown.
    std::string ending_at(std::size_t last) const;
    /// The first token of the expression that ends with token `last`.
    std::size_t start_of(std::size_t last) const;
    /// Whether token `i` and the two after it read `lissom.NAME`.
    bool is_function(std::size_t i) const;
    /// Whether the script itself defines a function or a field of this name.
    bool defines(std::string_view name) const { return defined_.count(std::string(name)) != 0; }

  private:
    void find_module_names();
    void find_definitions();
    void find_assignments();
    std::string starting_at(std::size_t first) const;
    std::string of_call(std::size_t callee, std::size_t open) const;
    std::string of_name(std::string_view name) const;

    const LuaTokens& tokens_;
    std::set<std::string> modules_{"lissom"}, defined_;
    std::map<std::string, std::set<std::string>> types_;
};

}  // namespace lissom::cli
