# Plays examples/love in LÖVE, on a screen of its own, with the module that was built.
set(game ${FOLDER}/game)
file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${game})
configure_file(${SOURCE}/examples/love/main.lua ${game}/game.lua COPYONLY)
configure_file(${SOURCE}/examples/love/conf.lua ${game}/conf.lua COPYONLY)
configure_file(${SOURCE}/tests/embed/love/main.lua ${game}/main.lua COPYONLY)
configure_file(${MODULE} ${game}/lissom.so COPYONLY)

execute_process(COMMAND ${CMAKE_COMMAND} -E env XDG_DATA_HOME=${FOLDER} XDG_CONFIG_HOME=${FOLDER}
                        ${XVFB} -a -s "-screen 0 1280x800x24" ${LOVE} ${game}
                RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output TIMEOUT 240)
if(NOT status EQUAL 0 OR NOT output MATCHES "drawn in ")
    message(FATAL_ERROR "LÖVE (${status}): ${output}")
endif()
message("${output}")
