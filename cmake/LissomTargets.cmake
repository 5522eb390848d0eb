# Functions that declare this project's libraries and tests, so that every target gets the same
# language level, include root and warnings.

# lissom_includes(TARGET): who links TARGET may include <lissom/...>. This project's own code does not: it names
# headers by their place, private ones too, which only it sees where a project is around it.
function(lissom_includes target)
    set(own $<BOOL:$<TARGET_PROPERTY:LISSOM_OWN>>)
    set(root ${PROJECT_SOURCE_DIR})
    if(NOT PROJECT_IS_TOP_LEVEL)
        set(root $<${own}:${root}>)
    endif()
    target_include_directories(
        ${target} INTERFACE $<BUILD_INTERFACE:${root}> $<BUILD_INTERFACE:$<$<NOT:${own}>:${PROJECT_BINARY_DIR}/include>>
                            $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
endfunction()

# lissom_target_defaults(TARGET): what every target of this project is compiled with.
function(lissom_target_defaults target)
    target_compile_features(${target} PUBLIC cxx_std_20)
    set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF LISSOM_OWN ON)
    # WebAssembly has no shared libraries here, and code for them is slower.
    if(NOT EMSCRIPTEN)
        set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    endif()
    # Before what a project around this one includes, where there may be a folder of the same name.
    target_include_directories(${target} BEFORE PRIVATE ${PROJECT_SOURCE_DIR})
    lissom_includes(${target})
    if(MSVC)
        target_compile_options(${target} PRIVATE /W4)
    else()
        target_compile_options(
            ${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual
                              $<$<BOOL:${LISSOM_STRICT}>:-Werror>)
        # Where no kind of build is chosen, a frame would take ten times as long.
        target_compile_options(${target} PRIVATE $<$<CONFIG:>:-O2>)
        # Code for any processor: gcc does not align vectors of 32 bytes on the stack of Windows (gcc bug 54412).
        if(WIN32 AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
            target_compile_definitions(${target} PRIVATE LISSOM_PORTABLE)
        endif()
        # What nothing calls is left out of a small library.
        target_compile_options(${target} PRIVATE $<$<CONFIG:MinSizeRel>:-ffunction-sections>
                                                 $<$<CONFIG:MinSizeRel>:-fdata-sections>)
        # gcc 12 reports overlaps in std::string's operator+ that cannot happen (gcc bug 105651).
        if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
            target_compile_options(${target} PRIVATE -Wno-restrict)
            # Instrumented code defeats its flow analysis: it then reports what the standard library holds.
            if(CMAKE_CXX_FLAGS MATCHES "-fsanitize")
                target_compile_options(${target} PRIVATE -Wno-maybe-uninitialized)
            endif()
        endif()
    endif()
endfunction()

# lissom_unity(TARGET): compiles sources together, so that their headers are read once: those of a room (a
# folder), at most eight and of a library about 32 KB at a time, so that a change is soon compiled; or, with
# LISSOM_UNITY=LARGE, those of all rooms of a library, so that a build from nothing takes half the time. Names in
# anonymous namespaces are therefore unique within a library, and within a room of tests. Sources with options of
# their own, and those marked SKIP_UNITY_BUILD_INCLUSION, are compiled alone.
function(lissom_unity target)
    if(NOT LISSOM_UNITY)
        return()
    endif()
    get_target_property(sources ${target} SOURCES)
    get_target_property(type ${target} TYPE)
    set(rooms "")
    foreach(source ${sources})
        set(room "library")
        set(most 40)
        set(max_bytes 1000000)
        if(NOT LISSOM_UNITY STREQUAL "LARGE" OR type STREQUAL "EXECUTABLE")
            get_filename_component(room ${source} DIRECTORY)
            string(REPLACE "${PROJECT_SOURCE_DIR}/" "" room "room_${room}")
            string(MAKE_C_IDENTIFIER "${room}" room)
            set(most 8)
            if(NOT type STREQUAL "EXECUTABLE")
                set(max_bytes 32000)
            endif()
        endif()
        get_filename_component(path ${source} ABSOLUTE BASE_DIR ${CMAKE_CURRENT_SOURCE_DIR})
        file(SIZE ${path} bytes)
        if(NOT room IN_LIST rooms)
            list(APPEND rooms ${room})
            set(part_${room} 0)
            set(count_${room} 0)
            set(bytes_${room} 0)
        endif()
        math(EXPR bytes "${bytes} + ${bytes_${room}}")
        if(count_${room} EQUAL most OR (count_${room} GREATER 0 AND bytes GREATER max_bytes))
            math(EXPR part_${room} "${part_${room}} + 1")
            math(EXPR bytes "${bytes} - ${bytes_${room}}")
            set(count_${room} 0)
        endif()
        math(EXPR count_${room} "${count_${room}} + 1")
        set(bytes_${room} ${bytes})
        set_property(SOURCE ${source} PROPERTY UNITY_GROUP ${room}_${part_${room}})
    endforeach()
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
    # A type of one source may hold names of its anonymous namespace: no other source sees it.
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
    endif()
    # Collecting garbage below this size, in KB, takes a tenth of the time of a large unit.
    if(LISSOM_UNITY STREQUAL "LARGE" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        target_compile_options(${target} PRIVATE --param=ggc-min-heapsize=800000)
    endif()
    # Nor does a local name hide one of another source.
    if(LISSOM_UNITY STREQUAL "LARGE" AND NOT MSVC)
        target_compile_options(${target} PRIVATE -Wno-shadow)
    endif()
endfunction()

# lissom_headers: with LISSOM_PCH, compiles Eigen, the mesh with its OpenMesh, and what most sources include of the
# standard library once; the libraries take them from there. Not the sources that lissom_hot_loops names, which are
# compiled always alike.
function(lissom_headers)
    file(WRITE ${PROJECT_BINARY_DIR}/headers.cpp "")
    add_library(lissom_headers OBJECT EXCLUDE_FROM_ALL ${PROJECT_BINARY_DIR}/headers.cpp)
    lissom_target_defaults(lissom_headers)
    target_link_libraries(lissom_headers PRIVATE Eigen3::Eigen)
    target_precompile_headers(
        lissom_headers PRIVATE <Eigen/Geometry> <Eigen/LU> <algorithm> <array> <atomic> <charconv> <chrono> <cmath>
        <cstdint> <cstring> <deque> <filesystem> <functional> <limits> <map> <memory> <mutex> <numeric> <optional>
        <set> <span> <sstream> <string> <string_view> <thread> <tuple> <unordered_map> <unordered_set> <utility>
        <variant> <vector> ${PROJECT_SOURCE_DIR}/kernel/mesh/mesh.h)
endfunction()

# lissom_library(NAME FILES...): a static library lissom_NAME with the alias lissom::NAME.
function(lissom_library name)
    add_library(lissom_${name} STATIC ${ARGN})
    add_library(lissom::${name} ALIAS lissom_${name})
    lissom_target_defaults(lissom_${name})
    lissom_unity(lissom_${name})
    if(LISSOM_PCH)
        target_precompile_headers(lissom_${name} REUSE_FROM lissom_headers)
    endif()
endfunction()

# lissom_hot_loops(TARGET FILES...): for libraries whose time goes into loops over numbers; builds that are small, or
# soonest done, leave out what takes room or long to compile. FILES hold functions for processors with fused
# multiply-add: what a compiler fuses depends on its level and on what is compiled beside, so these are compiled alone
# and always alike, and every release build gives the same numbers.
function(lissom_hot_loops target)
    set(fast $<OR:$<CONFIG:Release>,$<CONFIG:MinSizeRel>,$<CONFIG:>>)
    set(release $<AND:${fast},$<CXX_COMPILER_ID:GNU,Clang>>)
    if(LISSOM_UNITY STREQUAL "LARGE")
        target_compile_options(${target} PRIVATE $<${release}:-O2>)
    else()
        target_compile_options(${target} PRIVATE $<${release}:-O$<IF:$<CONFIG:MinSizeRel>,2,3>>)
    endif()
    if(ARGN)
        set_property(SOURCE ${ARGN} PROPERTY SKIP_UNITY_BUILD_INCLUSION ON)
        set_property(SOURCE ${ARGN} PROPERTY SKIP_PRECOMPILE_HEADERS ON)
        set_property(SOURCE ${ARGN} APPEND PROPERTY COMPILE_OPTIONS $<${release}:-O3>)
    endif()
endfunction()

# lissom_lean_file(TARGETS...): the files of a shared library or a program without what nothing in them calls.
function(lissom_lean_file)
    if(NOT CMAKE_SYSTEM_NAME STREQUAL "Linux")
        return()
    endif()
    foreach(target ${ARGN})
        target_link_options(${target} PRIVATE -Wl,-O1 -Wl,--gc-sections -Wl,--as-needed)
    endforeach()
endfunction()

# lissom_quick_start(TARGET): a program with the C++ library in it. The shared one takes a third of the time of a
# start, for the symbols that it looks up. Not where another shared library brings it anyway, nor with sanitizers,
# whose runtime is made for the shared one.
function(lissom_quick_start target)
    get_property(links_tbb GLOBAL PROPERTY LISSOM_LINKS_TBB)
    if(CMAKE_SYSTEM_NAME STREQUAL "Linux" AND NOT links_tbb AND NOT CMAKE_CXX_FLAGS MATCHES "-fsanitize")
        target_link_options(${target} PRIVATE -static-libstdc++)
    endif()
endfunction()

set(LISSOM_TEST_DATA ${PROJECT_SOURCE_DIR}/../shared/data CACHE PATH "Real meshes and heads for tests")
# Where a processor is emulated, the cases that take longest are left out by it.
set(LISSOM_UNIT_OPTIONS "" CACHE STRING "Options of doctest for unit tests, separated by semicolons")
mark_as_advanced(LISSOM_UNIT_OPTIONS)

# lissom_unit_test(MODULE FILES...): the doctest executable test_MODULE, registered as unit_MODULE.
# Tests that need real meshes look in LISSOM_TEST_DATA and skip, by name, where it is absent.
function(lissom_unit_test module)
    add_executable(test_${module} ${ARGN} ${PROJECT_SOURCE_DIR}/tests/unit/main.cpp)
    lissom_target_defaults(test_${module})
    target_link_libraries(test_${module} PRIVATE doctest::doctest)
    # Optimising the tests themselves takes longer than they run.
    target_compile_options(test_${module} PRIVATE $<$<AND:$<CONFIG:Release>,$<CXX_COMPILER_ID:GNU,Clang>>:-O1>)
    set_source_files_properties(${PROJECT_SOURCE_DIR}/tests/unit/main.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    lissom_unity(test_${module})
    add_test(NAME unit_${module} COMMAND test_${module} ${LISSOM_UNIT_OPTIONS})
    set_tests_properties(
        unit_${module} PROPERTIES LABELS unit ENVIRONMENT
                                  "LISSOM_TEST_DATA=${LISSOM_TEST_DATA}")
endfunction()
