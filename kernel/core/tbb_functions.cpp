// The functions of oneTBB that parallel loops call, each looked up in the shared library when it is
// first called: a program that runs no parallel loop starts without it. The macro `tbb` puts them
// and the headers of oneTBB into a namespace of their own, so that a host may link oneTBB itself.
#include <dlfcn.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/version.h>

#include "kernel/core/error.h"

namespace {

constexpr char kLibrary[] = "libtbb.so." __TBB_STRING(__TBB_BINARY_VERSION);

void* library() {
    static void* const loaded = dlopen(kLibrary, RTLD_NOW | RTLD_LOCAL);
    if (loaded) return loaded;
    throw lissom::Error(lissom::ErrorCode::unsupported,
                        std::string("more than one thread needs ") + kLibrary +
                            ", which is not on this machine; install oneTBB (on Debian: apt-get "
                            "install libtbb12), or work with one thread");
}

template <typename Function>
Function* find(const char* symbol) {
    if (void* const found = dlsym(library(), symbol)) return reinterpret_cast<Function*>(found);
    throw lissom::Error(
        lissom::ErrorCode::unsupported,
        std::string(kLibrary) + " is another version than this library was built with");
}

}  // namespace

namespace tbb::detail::r1 {

// SYMBOL is the name that the compiler gives the function, behind that of the namespace.
#define LISSOM_TBB(result, name, parameters, arguments, symbol)                            \
    result name parameters {                                                               \
        static auto* const function = find<result parameters>("_ZN3tbb6detail2r1" symbol); \
        return function arguments;                                                         \
    }

LISSOM_TBB(void*, allocate, (d1::small_object_pool * &pool, std::size_t bytes), (pool, bytes),
           "8allocateERPNS0_2d117small_object_poolEm")
LISSOM_TBB(void*, allocate,
           (d1::small_object_pool * &pool, std::size_t bytes, const d1::execution_data& data),
           (pool, bytes, data), "8allocateERPNS0_2d117small_object_poolEmRKNS2_14execution_dataE")
LISSOM_TBB(void, deallocate,
           (d1::small_object_pool & pool, void* object, std::size_t bytes,
            const d1::execution_data& data),
           (pool, object, bytes, data),
           "10deallocateERNS0_2d117small_object_poolEPvmRKNS2_14execution_dataE")
LISSOM_TBB(void, destroy, (d1::task_group_context & context), (context),
           "7destroyERNS0_2d118task_group_contextE")
LISSOM_TBB(void, execute, (d1::task_arena_base & arena, d1::delegate_base& work), (arena, work),
           "7executeERNS0_2d115task_arena_baseERNS2_13delegate_baseE")
LISSOM_TBB(void, execute_and_wait,
           (d1::task & task, d1::task_group_context& context, d1::wait_context& wait,
            d1::task_group_context& waiting),
           (task, context, wait, waiting),
           "16execute_and_waitERNS0_2d14taskERNS2_18task_group_contextERNS2_12wait_contextES6_")
LISSOM_TBB(d1::slot_id, execution_slot, (const d1::execution_data* data), (data),
           "14execution_slotEPKNS0_2d114execution_dataE")
LISSOM_TBB(void, initialize, (d1::task_arena_base & arena), (arena),
           "10initializeERNS0_2d115task_arena_baseE")
LISSOM_TBB(void, initialize, (d1::task_group_context & context), (context),
           "10initializeERNS0_2d118task_group_contextE")
LISSOM_TBB(void, notify_waiters, (std::uintptr_t address), (address), "14notify_waitersEm")
LISSOM_TBB(int, numa_default_concurrency, (int node), (node), "24numa_default_concurrencyEi")
LISSOM_TBB(void, spawn, (d1::task & task, d1::task_group_context& context), (task, context),
           "5spawnERNS0_2d14taskERNS2_18task_group_contextE")
// Called by code that is not optimised.
LISSOM_TBB(void, throw_exception, (d0::exception_id id), (id),
           "15throw_exceptionENS0_2d012exception_idE")
LISSOM_TBB(void, terminate, (d1::task_arena_base & arena), (arena),
           "9terminateERNS0_2d115task_arena_baseE")

#undef LISSOM_TBB

}  // namespace tbb::detail::r1
