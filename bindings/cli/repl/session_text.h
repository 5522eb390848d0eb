/// Lines typed at the prompt; Lua compiles each by itself.
#pragma once

#include <string>
#include <string_view>

namespace lissom::cli {

/// The chunk with its outermost locals made variables of the session, so that lines pasted from a
/// script find them: "local x = 1" becomes "; x = 1", "local x" gives nil. Those within blocks and
/// functions stay local, as does one with <close>.
std::string with_session_variables(std::string_view chunk);

}  // namespace lissom::cli
