# 64-bit ARM with Debian's g++-aarch64-linux-gnu; tests run in qemu-user.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
# Multiplications and additions stay apart, as on processors of x86-64 that have no instruction for both: the same
# numbers come out. Notes about how gcc 10 passed pairs of numbers are of no use.
set(CMAKE_CXX_FLAGS_INIT "-ffp-contract=off -U__ARM_FEATURE_FMA -Wno-psabi")
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64 -L /usr/aarch64-linux-gnu)
include(${CMAKE_CURRENT_LIST_DIR}/foreign.cmake)
