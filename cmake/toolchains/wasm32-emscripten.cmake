# WebAssembly with Debian's emscripten; tests run in node. Exceptions, and the jumps of Lua, are those of WebAssembly:
# browsers of 2022 and later have them, and its SIMD.
include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)
set(flags "-msimd128 -fwasm-exceptions -sSUPPORT_LONGJMP=wasm")
set(CMAKE_C_FLAGS_INIT "${flags}")
# Multiplications and additions stay apart, as in the preset portable.
set(CMAKE_CXX_FLAGS_INIT "${flags} -ffp-contract=off")
set(CMAKE_EXE_LINKER_FLAGS_INIT
    "-sALLOW_MEMORY_GROWTH=1 -sINITIAL_MEMORY=64MB -sTOTAL_STACK=4MB -sMAXIMUM_MEMORY=4GB")
set(CMAKE_CROSSCOMPILING_EMULATOR node --no-experimental-fetch)
# Node from elsewhere does not find the modules of Debian's that emscripten links with.
set_property(GLOBAL PROPERTY RULE_LAUNCH_LINK "${CMAKE_COMMAND} -E env NODE_PATH=/usr/share/nodejs")
include(${CMAKE_CURRENT_LIST_DIR}/foreign.cmake)
