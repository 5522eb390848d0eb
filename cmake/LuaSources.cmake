# The C sources of the Lua that the shared library carries: those of Debian's source package, with its corrections.
# `cmake -P cmake/FetchLua.cmake` puts them into a folder outside of the tree; LISSOM_LUA_SOURCES names another one.
set(LUA_SOURCE_VERSION "5.4.4-3+deb12u1")
set(LUA_SOURCE_ARCHIVES
    "lua5.4_5.4.4.orig.tar.gz=164c7849653b80ae67bec4b7473b884bf5cc8d2dca05653475ec2ed27b9ebf61"
    "lua5.4_5.4.4-3+deb12u1.debian.tar.xz=2d8e0e380722c648cfeffb8d58287865619b4d035544d93d7ef3a2eaf627abe6")

# lissom_lua_cache(FOLDER): where the sources of this version are kept.
function(lissom_lua_cache folder)
    set(cache "$ENV{XDG_CACHE_HOME}")
    if(NOT cache)
        set(cache "$ENV{HOME}/.cache")
    endif()
    set(${folder} "${cache}/lissom/lua-${LUA_SOURCE_VERSION}" PARENT_SCOPE)
endfunction()
