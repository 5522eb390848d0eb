// The library without Lua.
#include <string>

#include "tests/unit/c/host.h"

namespace lissom::test {

TEST_CASE("a library without Lua says so, and refuses every script") {
    const Host host;
    CHECK_FALSE(lissom_has_scripts());
    const auto refuses = [&](lissom_status status) {
        CHECK(status == LISSOM_UNSUPPORTED);
        CHECK(host.message().find("LISSOM_LUA=ON") != std::string::npos);
    };
    lissom_script script{};
    lissom_bytes bytes{};
    const auto sandbox = lissom_default_sandbox_options();
    CHECK(sandbox.struct_size == sizeof sandbox);
    refuses(lissom_sandbox_scripts(host, &sandbox));
    refuses(lissom_script_load(host, "", 0, "tool.lua", &script));
    refuses(lissom_script_parameters(host, script, &bytes));
    refuses(lissom_script_set(host, script, "size", "1"));
    refuses(lissom_script_run(host, script, nullptr, &bytes));
    refuses(lissom_call(host, "shapes.box", "[]", &bytes));
}

}  // namespace lissom::test
