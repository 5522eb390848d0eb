# What the toolchain files share. The kernel is built of headers alone, which are the same for every processor: those
# that this machine has are linked into a folder of their own, away from the headers of its C library.
set(LISSOM_FOREIGN ${CMAKE_CURRENT_LIST_DIR}/../../build/foreign)
# Descriptions for CMake are copied: of a link they would take the place that it leads to, and doctest's names /usr.
if(NOT EXISTS ${LISSOM_FOREIGN}/usr/lib/cmake/doctest OR IS_SYMLINK
                                                         ${LISSOM_FOREIGN}/usr/lib/cmake/doctest/doctestTargets.cmake)
    file(MAKE_DIRECTORY ${LISSOM_FOREIGN}/usr/include ${LISSOM_FOREIGN}/usr/share/eigen3
         ${LISSOM_FOREIGN}/usr/share/cmake ${LISSOM_FOREIGN}/usr/lib/cmake)
    foreach(path include/eigen3 include/OpenMesh include/nlohmann include/doctest include/tiny_gltf.h)
        execute_process(COMMAND cp -rsfT /usr/${path} ${LISSOM_FOREIGN}/usr/${path} COMMAND_ERROR_IS_FATAL ANY)
    endforeach()
    foreach(path share/eigen3/cmake share/cmake/nlohmann_json lib/cmake/doctest)
        execute_process(COMMAND cp -rLT --remove-destination /usr/${path} ${LISSOM_FOREIGN}/usr/${path}
                        COMMAND_ERROR_IS_FATAL ANY)
    endforeach()
    get_filename_component(prefix ${LISSOM_FOREIGN}/usr ABSOLUTE)
    execute_process(COMMAND sed -i "s|\"/usr\"|\"${prefix}\"|" ${LISSOM_FOREIGN}/usr/lib/cmake/doctest/doctestTargets.cmake
                    COMMAND_ERROR_IS_FATAL ANY)
endif()
set(CMAKE_FIND_ROOT_PATH ${LISSOM_FOREIGN})
set(CMAKE_PREFIX_PATH /usr)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
foreach(kind LIBRARY INCLUDE PACKAGE)
    set(CMAKE_FIND_ROOT_PATH_MODE_${kind} ONLY)
endforeach()
