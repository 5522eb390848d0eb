# Plays a game in LÖVE that loads the shared library by ffi.
#     cmake -DSOURCE= -DFOLDER= -DLIBRARY= -DLOVE= -DXVFB= -P love.cmake
set(game ${FOLDER}/game)
file(REMOVE_RECURSE ${FOLDER})
configure_file(${SOURCE}/love_main.lua ${game}/main.lua COPYONLY)
configure_file(${SOURCE}/library.lua ${game}/library.lua COPYONLY)
execute_process(COMMAND ${CMAKE_COMMAND} -E env XDG_DATA_HOME=${FOLDER} XDG_CONFIG_HOME=${FOLDER}
                        LISSOM_LIBRARY=${LIBRARY} ${XVFB} -a -s "-screen 0 1280x800x24" ${LOVE} ${game}
                RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output TIMEOUT 240)
message("${output}")
if(NOT status EQUAL 0 OR NOT output MATCHES "both work")
    message(FATAL_ERROR "LÖVE (${status})")
endif()
