# Functions that declare this project's libraries and tests, so that every target gets the same
# language level, include root and warnings.

# lissom_target_defaults(TARGET): what every target of this project is compiled with.
function(lissom_target_defaults target)
    target_compile_features(${target} PUBLIC cxx_std_20)
    set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON)
    target_include_directories(
        ${target} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:include/lissom>)
    if(MSVC)
        target_compile_options(${target} PRIVATE /W4)
    else()
        target_compile_options(
            ${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual
                              $<$<BOOL:${LISSOM_STRICT}>:-Werror>)
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

# lissom_library(NAME FILES...): a static library lissom_NAME with the alias lissom::NAME.
function(lissom_library name)
    add_library(lissom_${name} STATIC ${ARGN})
    add_library(lissom::${name} ALIAS lissom_${name})
    lissom_target_defaults(lissom_${name})
endfunction()

# lissom_unit_test(MODULE FILES...): the doctest executable test_MODULE, registered as unit_MODULE.
# Tests that need real meshes look in LISSOM_TEST_DATA and skip, by name, where it is absent.
function(lissom_unit_test module)
    add_executable(test_${module} ${ARGN} ${PROJECT_SOURCE_DIR}/tests/unit/main.cpp)
    lissom_target_defaults(test_${module})
    target_link_libraries(test_${module} PRIVATE doctest::doctest)
    add_test(NAME unit_${module} COMMAND test_${module})
    set_tests_properties(
        unit_${module} PROPERTIES LABELS unit ENVIRONMENT
                                  "LISSOM_TEST_DATA=${PROJECT_SOURCE_DIR}/../shared/data")
endfunction()
