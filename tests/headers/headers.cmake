# CHECK is `together`: HEADERS, the public ones of the kernel below SOURCE, in one file, in the order of their names and
# the other way round; or `alone`: each in a file of its own.
if(CHECK STREQUAL "alone" AND NOT DEFINED ENV{LISSOM_TRIALS})
    message("skipped: each header alone takes a quarter of an hour; set LISSOM_TRIALS")
    return()
endif()
set(headers ${HEADERS})
list(SORT headers)

function(compile name)
    set(text "")
    foreach(header ${ARGN})
        string(APPEND text "#include \"${header}\"\n")
    endforeach()
    file(WRITE ${FOLDER}/${name}.cpp "${text}")
    execute_process(
        COMMAND ${COMPILER} -std=c++20 -fsyntax-only -Wall -Wextra -Wconversion -Werror -I${SOURCE} -isystem
                ${EIGEN} ${FOLDER}/${name}.cpp RESULT_VARIABLE status ERROR_VARIABLE errors)
    if(NOT status EQUAL 0)
        message(SEND_ERROR "${name}:\n${errors}")
    endif()
endfunction()

if(CHECK STREQUAL "together")
    compile(forward ${headers})
    list(REVERSE headers)
    compile(backward ${headers})
else()
    foreach(header ${headers})
        string(REGEX REPLACE "[/.]" "_" name ${header})
        compile(${name} ${header})
    endforeach()
endif()
