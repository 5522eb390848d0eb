# The headers that users see, as <lissom/...>: kernel/mesh/mesh.h is <lissom/mesh/mesh.h>, bindings/c/lissom.h is
# <lissom/lissom.h>, and <lissom/kernel.h> is all of the kernel. The lists public_headers.txt name them. What is
# installed, and the build folder of a project that takes Lissom as a subdirectory, hold copies whose includes are
# written as users write them, so that nothing else of the source tree is in the include path of a user; our own build
# folder holds files of these names that include those of the source tree.

include(${CMAKE_CURRENT_LIST_DIR}/LissomHeaderCopies.cmake)

# lissom_public_headers(FOLDER ALL USERS): the headers that FOLDER/public_headers.txt names, by their paths from the
# root, and those of them that are meant for users.
function(lissom_public_headers folder all users)
    set(list ${PROJECT_SOURCE_DIR}/${folder}/public_headers.txt)
    set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${list})
    file(STRINGS ${list} lines REGEX "\\.(h|hpp)$")
    set(direct ${lines})
    list(FILTER direct EXCLUDE REGEX "^via ")
    list(TRANSFORM lines REPLACE "^via " "")
    list(TRANSFORM lines PREPEND ${folder}/)
    list(TRANSFORM direct PREPEND ${folder}/)
    set(${all} ${lines} PARENT_SCOPE)
    set(${users} ${direct} PARENT_SCOPE)
endfunction()

# lissom_forward(NAME HEADERS...): a file of the build folder that is included as NAME and includes HEADERS.
function(lissom_forward name)
    set(text "#pragma once\n\n")
    foreach(header ${ARGN})
        string(APPEND text "#include \"${header}\"\n")
    endforeach()
    file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/include/${name} CONTENT "${text}" @ONLY)
endfunction()

# lissom_lay_out_headers(): writes the files of the build folder; LISSOM_INSTALLED_HEADERS becomes all
# public headers, LISSOM_USER_HEADERS those of <lissom/kernel.h>.
macro(lissom_lay_out_headers)
    set(LISSOM_INSTALLED_HEADERS "")
    foreach(folder kernel kernel/thesis bindings viewer)
        if(NOT EXISTS ${PROJECT_SOURCE_DIR}/${folder}/public_headers.txt)
            continue()
        endif()
        lissom_public_headers(${folder} headers for_users)
        list(APPEND LISSOM_INSTALLED_HEADERS ${headers})
        if(folder STREQUAL "kernel")
            set(LISSOM_USER_HEADERS ${for_users})
        endif()
    endforeach()
    if(PROJECT_IS_TOP_LEVEL)
        lissom_forward(lissom/kernel.h ${LISSOM_USER_HEADERS})
        foreach(header ${LISSOM_INSTALLED_HEADERS})
            lissom_header_name(${header} name)
            lissom_forward(${name} ${header})
        endforeach()
    else()
        lissom_copy_headers(${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR}/include "${LISSOM_INSTALLED_HEADERS}"
                            "${LISSOM_USER_HEADERS}")
        # A header that changes is copied again.
        set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${LISSOM_INSTALLED_HEADERS})
    endif()
endmacro()
