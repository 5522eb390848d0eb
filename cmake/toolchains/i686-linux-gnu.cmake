# 32-bit x86 with Debian's g++-i686-linux-gnu; tests run as they are where the system's kernel runs 32-bit programs,
# elsewhere in qemu-user.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR i686)
set(CMAKE_C_COMPILER i686-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER i686-linux-gnu-g++)
# Numbers of 64 bits as elsewhere, and not of 80 bits here and there.
set(CMAKE_CXX_FLAGS_INIT "-msse2 -mfpmath=sse")
set(loader /usr/i686-linux-gnu/lib/ld-linux.so.2)
execute_process(COMMAND ${loader} --version RESULT_VARIABLE status OUTPUT_QUIET ERROR_QUIET)
if(status EQUAL 0)
    set(CMAKE_CROSSCOMPILING_EMULATOR ${loader} --library-path /usr/i686-linux-gnu/lib)
else()
    # The machine's own 32-bit libraries, which the loader's list names, are of another version.
    set(CMAKE_CROSSCOMPILING_EMULATOR qemu-i386 -L /usr/i686-linux-gnu -E
                                      LD_LIBRARY_PATH=/usr/i686-linux-gnu/lib)
endif()
include(${CMAKE_CURRENT_LIST_DIR}/foreign.cmake)
