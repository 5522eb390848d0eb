rockspec_format = "3.0"
package = "lissom"
version = "0.2.0-1"
-- An archive of the sources that lies beside this file; `luarocks make` takes the folder that it is called in.
source = { url = "lissom-0.2.0.tar.gz" }
description = {
    summary = "Deforms detailed meshes with a few handles, merges parts of models, and grows hair.",
    detailed = "A modeling kernel in C++20. Its build needs a C++ compiler, CMake, Eigen, OpenMesh, oneTBB, tinygltf and "
        .. "nlohmann-json (on Debian: libeigen3-dev libopenmesh-dev libtbb-dev libtinygltf-dev nlohmann-json3-dev).",
    license = "MIT",
    labels = { "geometry", "graphics", "mesh" },
}
supported_platforms = { "unix" }
-- Lua 5.4, or LuaJIT, which calls itself 5.1; not the stock 5.1, 5.2 and 5.3.
dependencies = { "lua >= 5.1, < 5.5" }
build = {
    type = "cmake",
    variables = {
        CMAKE_BUILD_TYPE = "Release",
        CMAKE_CXX_FLAGS_RELEASE = "-O2 -DNDEBUG",
        CMAKE_INSTALL_PREFIX = "$(PREFIX)",
        LISSOM_ROCK_INCDIR = "$(LUA_INCDIR)",
        LISSOM_ROCK_LIBDIR = "$(LIBDIR)",
        LISSOM_GPL = "OFF",
        LISSOM_LUA = "ON",
        LISSOM_C = "OFF",
        LISSOM_PROGRAM = "OFF",
        LISSOM_VIEWER = "OFF",
        LISSOM_TESTS = "OFF",
        LISSOM_INSTALL = "OFF",
        LISSOM_STRICT = "OFF",
        -- From nothing, in half the time.
        LISSOM_UNITY = "LARGE",
    },
}
