# Debian packages, by CPack: one for each part of what is installed. `./dev package` makes them in build/packages.
# The folders of modules and libraries are those of the system, so the prefix is set when the build is configured.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME lissom)
set(CPACK_PACKAGE_VENDOR "The Lissom authors")
set(CPACK_PACKAGE_CONTACT "The Lissom authors <lissom@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX ${CMAKE_INSTALL_PREFIX})
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENTS_ALL library development program lua)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)

# lissom_package(COMPONENT NAME SECTION SUMMARY TEXT): its name, what it is, and its licence.
macro(lissom_package component name section summary text)
    string(TOUPPER ${component} upper)
    set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name})
    set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section})
    set(CPACK_DEBIAN_${upper}_DESCRIPTION "${summary}\n${text}")
    install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name}
            COMPONENT ${component} RENAME copyright)
    install(FILES ${PROJECT_SOURCE_DIR}/NOTICE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name}
            COMPONENT ${component})
endmacro()
lissom_package(library liblissom libs "modeling kernel for shapes with fine detail (C library)"
               "Deforms detailed meshes with a few handles, merges parts of models, and grows hair.")
lissom_package(development liblissom-dev libdevel "modeling kernel for shapes with fine detail (development)"
               "Headers for C and C++, static libraries, and files for CMake and pkg-config.")
lissom_package(program lissom graphics "modeling kernel for shapes with fine detail (program)"
               "Runs Lua scripts that model, draws pictures, converts files, and opens a window.")
lissom_package(lua lua-lissom interpreters "modeling kernel for shapes with fine detail (Lua modules)"
               "What require \"lissom\" loads in Lua 5.4 and in LuaJIT.")

# What cannot be read from the binaries. Static libraries carry no dependencies; oneTBB, GLFW and OpenGL are loaded
# when they are used.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "liblissom (= ${PROJECT_VERSION}), libeigen3-dev, libstdc++-dev | libstdc++-12-dev")
if(LISSOM_LINKS_TBB)
    string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS ", libtbb-dev")
elseif(LISSOM_TBB)
    foreach(component LIBRARY PROGRAM LUA)
        set(CPACK_DEBIAN_${component}_PACKAGE_DEPENDS "libtbb12")
    endforeach()
endif()
if(TARGET lissom_cholmod)
    string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS ", libsuitesparse-dev")
endif()
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS "pkg-config | pkgconf, liblua5.4-dev, libtbb12, libepoxy0")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS
    "libedit2, libglfw3, libepoxy0, libegl1, libgl1, libegl-mesa0, libgl1-mesa-dri, fonts-dejavu-core")
set(CPACK_DEBIAN_LUA_PACKAGE_RECOMMENDS "lua5.4 | luajit | love")

include(CPack)
