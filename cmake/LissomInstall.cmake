# What `cmake --install` lays down: the kernel's headers and static libraries with a CMake package, and
# the program with its Lua scripts where they were built.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(LISSOM_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/lissom)

# lissom_kernel links lissom::core, lissom::solve, ...: export each module under that name.
get_target_property(modules lissom_kernel INTERFACE_LINK_LIBRARIES)
string(REPLACE "lissom::" "" modules "${modules}")
set(LISSOM_KERNEL_TARGETS lissom_kernel)
set_target_properties(lissom_kernel PROPERTIES EXPORT_NAME kernel)
foreach(module ${modules})
    list(APPEND LISSOM_KERNEL_TARGETS lissom_${module})
    set_target_properties(lissom_${module} PROPERTIES EXPORT_NAME ${module})
endforeach()

install(TARGETS ${LISSOM_KERNEL_TARGETS} EXPORT lissom-targets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT lissom-targets NAMESPACE lissom:: DESTINATION ${LISSOM_PACKAGE_DIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/kernel DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/lissom
        FILES_MATCHING PATTERN "*.h"
        REGEX "${LISSOM_PRIVATE_HEADERS}" EXCLUDE)

# The evaluator of saved bases needs nothing else of the package.
install(FILES ${PROJECT_SOURCE_DIR}/bindings/engine/lissom_basis.h
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/lissom/bindings/engine)

# The C ABI: its header, and the shared library, which needs nothing of the above.
if(TARGET lissom_shared)
    set_target_properties(lissom_shared PROPERTIES EXPORT_NAME shared)
    target_include_directories(lissom_shared INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/lissom>)
    install(TARGETS lissom_shared EXPORT lissom-targets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
    install(FILES ${PROJECT_SOURCE_DIR}/bindings/c/lissom.h ${PROJECT_SOURCE_DIR}/bindings/c/lissom.hpp
            DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/lissom/bindings/c)
    configure_file(${PROJECT_SOURCE_DIR}/cmake/lissom.pc.in ${PROJECT_BINARY_DIR}/lissom.pc @ONLY)
    install(FILES ${PROJECT_BINARY_DIR}/lissom.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endif()

configure_package_config_file(
    ${PROJECT_SOURCE_DIR}/cmake/lissom-config.cmake.in ${PROJECT_BINARY_DIR}/lissom-config.cmake
    INSTALL_DESTINATION ${LISSOM_PACKAGE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/lissom-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/lissom-config.cmake
              ${PROJECT_BINARY_DIR}/lissom-config-version.cmake
              ${PROJECT_SOURCE_DIR}/cmake/FindCHOLMOD.cmake DESTINATION ${LISSOM_PACKAGE_DIR})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md
        DESTINATION ${CMAKE_INSTALL_DOCDIR})

# Where lua5.4 and luajit look below the prefix: LuaJIT keeps the version of the language it speaks.
# Optional, as one who builds the program alone has neither.
if(TARGET lissom_lua54_module)
    install(TARGETS lissom_lua54_module LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/lua/5.4
            OPTIONAL)
endif()
if(TARGET lissom_luajit_module)
    install(TARGETS lissom_luajit_module LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/lua/5.1
            OPTIONAL)
endif()
if(TARGET lissom)
    install(TARGETS lissom RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
    # The Lua library, which the program finds beside itself.
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/scripts
            DESTINATION ${CMAKE_INSTALL_DATADIR}/lissom
            FILES_MATCHING PATTERN "*.lua")
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples
            DESTINATION ${CMAKE_INSTALL_DATADIR}/lissom
            FILES_MATCHING PATTERN "*.lua" PATTERN "engine/*.c" PATTERN "engine/*.vert"
                           PATTERN "golden/*.png")
    # Annotations of the Lua functions for editors, a setting that finds them, and the reference.
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/bindings/lua/meta ${PROJECT_SOURCE_DIR}/viewer/meta
            DESTINATION ${CMAKE_INSTALL_DATADIR}/lissom)
    install(CODE "
        set(annotations \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DATADIR}/lissom/meta\")
        configure_file(\"${PROJECT_SOURCE_DIR}/cmake/luarc.json.in\"
                       \"${PROJECT_BINARY_DIR}/luarc.json\" @ONLY)")
    install(FILES ${PROJECT_BINARY_DIR}/luarc.json DESTINATION ${CMAKE_INSTALL_DATADIR}/lissom
            RENAME .luarc.json)
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs/lua DESTINATION ${CMAKE_INSTALL_DOCDIR})
    install(FILES ${PROJECT_SOURCE_DIR}/docs/testing.md ${PROJECT_SOURCE_DIR}/docs/tools.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
endif()
