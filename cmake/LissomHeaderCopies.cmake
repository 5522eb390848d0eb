# lissom_copy_headers(SOURCE FOLDER HEADERS USERS): writes HEADERS, public headers by their paths from SOURCE, into
# FOLDER under the names by which users include them, with the includes among them as users write them; and
# lissom/kernel.h, which includes USERS. What is equal already keeps its time.
function(lissom_copy_headers source folder headers users)
    set(all "/// All of the kernel.\n#pragma once\n\n")
    foreach(header ${users})
        lissom_header_name(${header} name)
        string(APPEND all "#include \"${name}\"\n")
    endforeach()
    lissom_write_header(${folder}/lissom/kernel.h "${all}")
    foreach(header ${headers})
        lissom_header_name(${header} name)
        file(READ "${source}/${header}" text)
        string(REGEX REPLACE "#include \"(kernel|bindings/c|bindings/engine|bindings)/([^\"\n]*)\""
                             "#include \"lissom/\\2\"" text "${text}")
        string(REPLACE "#include \"viewer/render/" "#include \"lissom/viewer/" text "${text}")
        lissom_write_header(${folder}/${name} "${text}")
    endforeach()
endfunction()

# lissom_header_name(HEADER NAME): what users include for a header of the source tree.
function(lissom_header_name header name)
    string(REGEX REPLACE "^(kernel|bindings/c|bindings/engine|bindings)/" "" short ${header})
    string(REPLACE "viewer/render/" "viewer/" short ${short})
    set(${name} lissom/${short} PARENT_SCOPE)
endfunction()

# lissom_write_header(FILE TEXT)
function(lissom_write_header file text)
    set(before "")
    if(EXISTS ${file})
        file(READ "${file}" before)
    endif()
    if(NOT before STREQUAL text)
        file(WRITE "${file}" "${text}")
    endif()
endfunction()
