# The installed program and modules in PREFIX: scripts are found beside the program, never in the source
# folder; each Lua loads the module that was built for it.
function(check what)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
    if(NOT status EQUAL 0)
        message(SEND_ERROR "${what} (${status}): ${output}")
    endif()
endfunction()

file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${FOLDER})

file(WRITE ${FOLDER}/beside.lua "
local place = assert(package.searchpath('recipes.add_tail', package.path))
assert(place:find('${PREFIX}/share/lissom/scripts/', 1, true) == 1, place)
assert(not package.path:find('${SOURCE}/scripts', 1, true), package.path)
require 'recipes.add_tail'
")
check("scripts beside the program" ${PREFIX}/bin/lissom run ${FOLDER}/beside.lua)

file(WRITE ${FOLDER}/installed_test.lua "
test('an installed program runs tests', function()
    expect.equal(#require('lissom').shapes.box(), 8)
end)
")
check("tests" ${PREFIX}/bin/lissom test ${FOLDER}/installed_test.lua)

# Alone it has no scripts: it does not look where it was built either.
# Outside of the folder it was built in, where it would take those of its source.
execute_process(COMMAND mktemp -d OUTPUT_VARIABLE alone OUTPUT_STRIP_TRAILING_WHITESPACE)
file(COPY ${PREFIX}/bin/lissom DESTINATION ${alone})
file(WRITE ${FOLDER}/without.lua
     "assert(not package.searchpath('recipes.add_tail', package.path), package.path)\n")
check("a program without scripts" ${alone}/lissom run ${FOLDER}/without.lua)
file(REMOVE_RECURSE ${alone})

if(NOT EXISTS ${PREFIX}/share/lissom/.luarc.json OR NOT EXISTS ${PREFIX}/share/lissom/meta/lissom.lua)
    message(SEND_ERROR "the annotations for editors are not installed")
endif()

file(WRITE ${FOLDER}/module.lua "
local lissom = require 'lissom'
assert(#lissom.shapes.box() == 8 and lissom.version)
assert(rawget(lissom, 'render') == nil)
")
foreach(pair "lua/5.4|${LUA54}" "lua/5.1|${LUAJIT}")
    string(REPLACE "|" ";" pair ${pair})
    list(GET pair 0 place)
    list(GET pair 1 interpreter)
    file(GLOB_RECURSE module ${PREFIX}/lib*/lissom.so)
    list(FILTER module INCLUDE REGEX "/${place}/lissom.so$")
    if(interpreter AND NOT SANITIZED)
        get_filename_component(module_folder "${module}" DIRECTORY)
        check("the module in ${place}" ${CMAKE_COMMAND} -E env "LUA_CPATH=${module_folder}/?.so"
              ${interpreter} ${FOLDER}/module.lua)
    endif()
endforeach()
