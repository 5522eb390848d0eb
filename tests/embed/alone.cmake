# The library by itself: a copy of the tree without the folders that nothing of it may need is configured; its first
# module is built and tested, or with WHOLE=ON all of the library, and the renderer, with their tests.
#     cmake -DSOURCE= -DFOLDER= -DGENERATOR= -DCOMPILER= -DFLAGS= [-DLAUNCHER=] [-DGPL=] [-DTBB=] [-DWHOLE=ON] -P alone.cmake
set(copy ${FOLDER}/source)
file(REMOVE_RECURSE ${copy})
file(COPY ${SOURCE}/CMakeLists.txt ${SOURCE}/cmake ${SOURCE}/kernel ${SOURCE}/bindings ${SOURCE}/viewer ${SOURCE}/tests
          ${SOURCE}/scripts ${SOURCE}/examples ${SOURCE}/docs ${SOURCE}/LICENSE ${SOURCE}/README.md ${SOURCE}/CONTRIBUTING.md
     DESTINATION ${copy})
foreach(product kernel/thesis viewer/window bindings/cli scripts/tools)
    file(REMOVE_RECURSE ${copy}/${product})
endforeach()

function(run)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE text ERROR_VARIABLE text)
    if(NOT status EQUAL 0)
        message(FATAL_ERROR "${ARGN}\n${text}")
    endif()
endfunction()

# As deep below the sources as this project's own build, and with its options: ccache then has most of the objects.
set(build ${copy}/build/release)
set(ENV{CCACHE_BASEDIR} ${copy})
set(ENV{CCACHE_NOHASHDIR} 1)
run(${CMAKE_COMMAND} -S ${copy} -B ${build} -G ${GENERATOR} -DCMAKE_BUILD_TYPE=Release "-DCMAKE_CXX_FLAGS_RELEASE=${FLAGS}"
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER} -DLISSOM_LUA=ON -DLISSOM_GPL=${GPL}
    -DLISSOM_TBB=${TBB} -DLISSOM_TEST_DATA=${SOURCE}/../shared/data)
if(WHOLE)
    run(${CMAKE_COMMAND} --build ${build})
    # The arrows are those of the whole tree.
    run(${CMAKE_CTEST_COMMAND} --test-dir ${build} -L unit -E ^unit_arrows$ --output-on-failure)
else()
    run(${CMAKE_COMMAND} --build ${build} --target test_core)
    run(${CMAKE_CTEST_COMMAND} --test-dir ${build} -R unit_core --output-on-failure)
endif()
