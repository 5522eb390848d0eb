# What the toolchain files share. The kernel is built of headers alone, which are the same for every processor: those
# that this machine has are linked into a folder of their own, away from the headers of its C library.
set(LISSOM_FOREIGN ${CMAKE_CURRENT_LIST_DIR}/../../build/foreign)
if(NOT EXISTS ${LISSOM_FOREIGN}/usr/lib/cmake/doctest)
    file(MAKE_DIRECTORY ${LISSOM_FOREIGN}/usr/include ${LISSOM_FOREIGN}/usr/share/eigen3
         ${LISSOM_FOREIGN}/usr/share/cmake ${LISSOM_FOREIGN}/usr/lib/cmake)
    foreach(path include/eigen3 include/OpenMesh include/nlohmann include/doctest include/tiny_gltf.h
                 share/eigen3/cmake share/cmake/nlohmann_json lib/cmake/doctest)
        execute_process(COMMAND cp -rsf /usr/${path} ${LISSOM_FOREIGN}/usr/${path} COMMAND_ERROR_IS_FATAL ANY)
    endforeach()
endif()
set(CMAKE_FIND_ROOT_PATH ${LISSOM_FOREIGN})
set(CMAKE_PREFIX_PATH /usr)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
foreach(kind LIBRARY INCLUDE PACKAGE)
    set(CMAKE_FIND_ROOT_PATH_MODE_${kind} ONLY)
endforeach()
