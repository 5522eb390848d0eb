# The engine of examples/engine without a window: it draws a picture of a drag, and says how far its basis is from the
# library's own preview.
file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${FOLDER})
execute_process(COMMAND ${ENGINE} ${SOURCE} --picture ${FOLDER}/engine.png
                RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output TIMEOUT 240)
message("${output}")
if(status EQUAL 77 AND NOT DEFINED ENV{LISSOM_REQUIRE_GL})
    message("skipped: no OpenGL")
    return()
endif()
if(NOT output MATCHES "[1-9][0-9]* frames of 4753 render vertices on 4656 of the mesh")
    message(FATAL_ERROR "the engine did not bend its textured model")
endif()
string(REGEX MATCH "([0-9]+) tasks" tasks "${output}")
if(NOT status EQUAL 0 OR NOT EXISTS ${FOLDER}/engine.png OR CMAKE_MATCH_1 LESS 10)
    message(FATAL_ERROR "the engine (${status})")
endif()
