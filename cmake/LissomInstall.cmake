# What `cmake --install` lays down, in four parts (--component): `library`, the shared library of the C ABI;
# `development`, headers, static libraries, the CMake package and pkg-config files; `program` with its Lua scripts; and
# `lua`, the modules for Lua 5.4 and LuaJIT.
include(CMakePackageConfigHelpers)

set(LISSOM_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/lissom)
set(LISSOM_COMPONENTS "")

# lissom_export(COMPONENT TARGETS...): static libraries that find_package(lissom COMPONENTS COMPONENT) gives, under
# the names that they have in this project.
macro(lissom_export component)
    list(APPEND LISSOM_COMPONENTS ${component})
    foreach(target ${ARGN})
        string(REPLACE lissom_ "" name ${target})
        set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
    endforeach()
    install(TARGETS ${ARGN} EXPORT lissom-${component}-targets
            ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
    install(EXPORT lissom-${component}-targets NAMESPACE lissom:: DESTINATION ${LISSOM_PACKAGE_DIR}
            COMPONENT development)
endmacro()

get_target_property(modules lissom_kernel INTERFACE_LINK_LIBRARIES)
string(REPLACE "lissom::" "lissom_" modules "${modules}")
lissom_export(kernel lissom_kernel ${modules})
if(TARGET lissom_lua)
    lissom_export(lua lissom_lua lissom_sandbox)
endif()
if(TARGET lissom_cholmod)
    lissom_export(cholmod lissom_cholmod)
endif()
if(TARGET lissom_renderer)
    lissom_export(viewer lissom_renderer)
endif()

# The C ABI: the shared library needs nothing of the above.
if(TARGET lissom_shared)
    lissom_export(c-static lissom_c)
    list(APPEND LISSOM_COMPONENTS c)
    set_target_properties(lissom_shared PROPERTIES EXPORT_NAME shared)
    install(TARGETS lissom_shared EXPORT lissom-c-targets
            LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT development
            RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT library
            ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
    install(EXPORT lissom-c-targets NAMESPACE lissom:: DESTINATION ${LISSOM_PACKAGE_DIR} COMPONENT development)
endif()

configure_file(${PROJECT_SOURCE_DIR}/cmake/InstallHeaders.cmake.in ${PROJECT_BINARY_DIR}/InstallHeaders.cmake @ONLY)
install(SCRIPT ${PROJECT_BINARY_DIR}/InstallHeaders.cmake COMPONENT development)

# lissom.pc is the shared library of the C ABI, lissom-kernel.pc the static ones of C++.
file(RELATIVE_PATH LISSOM_PC_PREFIX /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
string(REGEX REPLACE "/$" "" LISSOM_PC_PREFIX ${LISSOM_PC_PREFIX})
set(LISSOM_PC_LIBRARIES "")
foreach(module ${modules})
    # Who uses a library stands before it.
    string(REPLACE lissom_ "" module ${module})
    set(LISSOM_PC_LIBRARIES "-llissom_${module} ${LISSOM_PC_LIBRARIES}")
endforeach()
set(LISSOM_PC_REQUIRED eigen3)
get_property(LISSOM_LINKS_TBB GLOBAL PROPERTY LISSOM_LINKS_TBB)
if(LISSOM_LINKS_TBB)
    string(APPEND LISSOM_PC_REQUIRED " tbb")
elseif(LISSOM_TBB)
    string(APPEND LISSOM_PC_LIBRARIES "-ldl")
endif()
get_property(LISSOM_LINKS_DRACO GLOBAL PROPERTY LISSOM_LINKS_DRACO)
get_property(LISSOM_LINKS_MESHOPT GLOBAL PROPERTY LISSOM_LINKS_MESHOPT)
if(LISSOM_LINKS_DRACO)
    string(APPEND LISSOM_PC_LIBRARIES " -ldraco")
endif()
if(LISSOM_LINKS_MESHOPT)
    string(APPEND LISSOM_PC_LIBRARIES " -lmeshoptimizer")
endif()
set(pc_files lissom-kernel)
if(TARGET lissom_shared)
    list(APPEND pc_files lissom)
endif()
foreach(name ${pc_files})
    configure_file(${PROJECT_SOURCE_DIR}/cmake/${name}.pc.in ${PROJECT_BINARY_DIR}/${name}.pc @ONLY)
    install(FILES ${PROJECT_BINARY_DIR}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
            COMPONENT development)
endforeach()

configure_package_config_file(
    ${PROJECT_SOURCE_DIR}/cmake/lissom-config.cmake.in ${PROJECT_BINARY_DIR}/lissom-config.cmake
    INSTALL_DESTINATION ${LISSOM_PACKAGE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/lissom-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/lissom-config.cmake
              ${PROJECT_BINARY_DIR}/lissom-config-version.cmake
              ${PROJECT_SOURCE_DIR}/cmake/FindCHOLMOD.cmake
        DESTINATION ${LISSOM_PACKAGE_DIR} COMPONENT development)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md
        DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT development)
# The reference of C++ and C, made of the docstrings of the public headers; that of Lua, which `lissom_call` of the C ABI
# needs too; and the examples.
find_package(Python3 COMPONENTS Interpreter QUIET)
if(Python3_FOUND)
    install(CODE "
        execute_process(
            COMMAND \"${Python3_EXECUTABLE}\" -B \"${PROJECT_SOURCE_DIR}/cmake/cpp_reference.py\" \"${PROJECT_SOURCE_DIR}\"
                    \"${PROJECT_BINARY_DIR}/cpp_reference\"
            COMMAND_ERROR_IS_FATAL ANY)" COMPONENT development)
    install(DIRECTORY ${PROJECT_BINARY_DIR}/cpp_reference/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/cpp COMPONENT development)
else()
    message(STATUS "Without python3 the C++ reference is not installed")
endif()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs/lua DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT development)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT development
        PATTERN "golden" EXCLUDE)

# The licences of all that is compiled in, with each binary; packages have a folder of their own for them.
if(NOT LISSOM_PACKAGES)
    foreach(component library development program lua)
        install(FILES ${PROJECT_SOURCE_DIR}/NOTICE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT ${component})
    endforeach()
endif()

# Where lua5.4 and luajit look below the prefix: LuaJIT keeps the version of the language it speaks.
# Optional, as one who builds the program alone has neither.
foreach(module "lissom_lua54_module|5.4" "lissom_luajit_module|5.1")
    string(REPLACE "|" ";" module ${module})
    list(GET module 0 target)
    list(GET module 1 version)
    if(TARGET ${target})
        install(TARGETS ${target} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/lua/${version} COMPONENT lua
                OPTIONAL)
    endif()
endforeach()
if(TARGET lissom)
    install(TARGETS lissom RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
    # The Lua library, which the program finds beside itself.
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/scripts
            DESTINATION ${CMAKE_INSTALL_DATADIR}/lissom COMPONENT program
            FILES_MATCHING PATTERN "*.lua")
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples
            DESTINATION ${CMAKE_INSTALL_DATADIR}/lissom COMPONENT program
            FILES_MATCHING PATTERN "*.lua" PATTERN "engine/*.c" PATTERN "engine/*.vert"
                           PATTERN "golden/*.png")
    # Annotations of the Lua functions for editors, a setting that finds them, and the reference.
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/bindings/lua/meta ${PROJECT_SOURCE_DIR}/viewer/meta
            DESTINATION ${CMAKE_INSTALL_DATADIR}/lissom COMPONENT program)
    install(CODE "
        set(annotations \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DATADIR}/lissom/meta\")
        configure_file(\"${PROJECT_SOURCE_DIR}/cmake/luarc.json.in\"
                       \"${PROJECT_BINARY_DIR}/luarc.json\" @ONLY)" COMPONENT program)
    install(FILES ${PROJECT_BINARY_DIR}/luarc.json DESTINATION ${CMAKE_INSTALL_DATADIR}/lissom COMPONENT program
            RENAME .luarc.json)
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs/lua DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
    install(FILES ${PROJECT_SOURCE_DIR}/docs/testing.md ${PROJECT_SOURCE_DIR}/docs/tools.md
            DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
endif()
