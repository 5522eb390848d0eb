# Builds and runs the consumer project. WAY is `installed` (the tree built in BUILD is installed below
# FOLDER first) or `subdirectory` (all of the kernel of SOURCE is configured, one module of it built).
function(run)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE status)
    if(NOT status EQUAL 0)
        list(JOIN ARGN " " command)
        message(FATAL_ERROR "failed (${status}): ${command}")
    endif()
endfunction()

set(arguments -G ${GENERATOR} -DCMAKE_CXX_COMPILER=${COMPILER} "-DCMAKE_CXX_FLAGS=${FLAGS}"
              -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER} -DHELLO=${SOURCE}/examples/hello.cpp
              -DEVALUATE=${SOURCE}/examples/engine/evaluate.c -DC_HELLO=${SOURCE}/examples/hello.c)
if(WAY STREQUAL "installed")
    file(REMOVE_RECURSE ${FOLDER})
    run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${FOLDER}/prefix)
    list(APPEND arguments -DCMAKE_PREFIX_PATH=${FOLDER}/prefix -DCMAKE_BUILD_TYPE=Release)
else()
    list(APPEND arguments -DLISSOM_SOURCE=${SOURCE} -DLISSOM_GPL=${GPL} -DLISSOM_TBB=${TBB}
                -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O0)
endif()

set(programs solver)
if(WAY STREQUAL "installed")
    list(APPEND programs consumer)
    file(GLOB_RECURSE shared ${FOLDER}/prefix/*/liblissom.*)
    if(shared)
        list(APPEND programs c_host wrapper)
    endif()
endif()

run(${CMAKE_COMMAND} -S ${SOURCE}/tests/embed/consumer -B ${FOLDER}/build ${arguments})
run(${CMAKE_COMMAND} --build ${FOLDER}/build --target ${programs} evaluate)
file(MAKE_DIRECTORY ${FOLDER}/out)
foreach(program ${programs})
    run(${CMAKE_COMMAND} -E chdir ${FOLDER}/out ${FOLDER}/build/${program})
endforeach()
