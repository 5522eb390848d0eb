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
        # These show libraries that users of the package need not have.
        PATTERN "gltf" EXCLUDE
        PATTERN "growth_lanes.h" EXCLUDE
        PATTERN "lane_grower.h" EXCLUDE)

# The evaluator of saved bases needs nothing else of the package.
install(FILES ${PROJECT_SOURCE_DIR}/bindings/engine/lissom_basis.h
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/lissom/bindings/engine)

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

if(TARGET lissom_lua54_module)
    install(TARGETS lissom_lua54_module LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/lua/5.4)
endif()
if(TARGET lissom)
    install(TARGETS lissom RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples
            DESTINATION ${CMAKE_INSTALL_DATADIR}/lissom
            FILES_MATCHING PATTERN "*.lua" PATTERN "engine/*.c" PATTERN "engine/*.vert")
    # Annotations of the Lua functions for editors.
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/bindings/lua/meta ${PROJECT_SOURCE_DIR}/viewer/meta
            DESTINATION ${CMAKE_INSTALL_DATADIR}/lissom)
endif()
