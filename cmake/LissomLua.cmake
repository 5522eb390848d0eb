# The Lua inside the shared library, whose host may have another one.
include(${CMAKE_CURRENT_LIST_DIR}/LuaSources.cmake)
set(LISSOM_LUA_SOURCES "" CACHE PATH "Folder of Lua 5.4's C sources; by default that of cmake/FetchLua.cmake")

# lissom_own_lua(): declares the static library lissom_own_lua, none of whose names others see, from those sources. If
# they are absent it says so and declares nothing: the shared library then links the system's Lua. It loads no modules
# of C, which would find the Lua of the host.
function(lissom_own_lua)
    set(folder ${LISSOM_LUA_SOURCES})
    if(NOT folder)
        lissom_lua_cache(folder)
        set(folder ${folder}/src)
    endif()
    if(NOT EXISTS ${folder}/lapi.c)
        message(STATUS "No sources of Lua in ${folder}: liblissom links the system's Lua, and is not for hosts that "
                       "have LuaJIT or another Lua. `cmake -P cmake/FetchLua.cmake` fetches them.")
        return()
    endif()
    file(GLOB sources ${folder}/*.c)
    list(FILTER sources EXCLUDE REGEX "/luac?\\.c$")
    add_library(lissom_own_lua STATIC EXCLUDE_FROM_ALL ${sources})
    target_compile_definitions(lissom_own_lua PRIVATE LUA_COMPAT_5_3 $<$<BOOL:${UNIX}>:LUA_USE_POSIX>)
    set_target_properties(lissom_own_lua PROPERTIES C_VISIBILITY_PRESET hidden)
    if(EMSCRIPTEN)
        # Debian's header names the folder of modules in C, of which there are none.
        file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/lua/lua5.4-deb-multiarch.h "#define DEB_HOST_MULTIARCH \"wasm32\"\n")
        target_include_directories(lissom_own_lua SYSTEM PUBLIC ${folder} ${CMAKE_CURRENT_BINARY_DIR}/lua)
    else()
        set_target_properties(lissom_own_lua PROPERTIES POSITION_INDEPENDENT_CODE ON)
    endif()
    if(NOT MSVC)
        # Nor is it checked by options that are meant for this project's own code.
        target_compile_options(lissom_own_lua PRIVATE -w $<$<CONFIG:>:-O2>)
    endif()
    if(CMAKE_C_FLAGS MATCHES "-fsanitize")
        target_compile_options(lissom_own_lua PRIVATE -fno-sanitize=all)
    endif()
    if(UNIX)
        target_link_libraries(lissom_own_lua INTERFACE m)
    endif()
endfunction()
