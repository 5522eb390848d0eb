#ifdef LISSOM_HAS_LIBEDIT
#include "bindings/cli/terminal/libedit.h"

#ifdef __linux__
#include <dlfcn.h>
#endif

namespace lissom::cli {
namespace {

#ifdef __linux__

template <typename Function>
void find(void* library, const char* name, Function& function, bool& complete) {
    function = reinterpret_cast<Function>(dlsym(library, name));
    complete = complete && function;
}

bool load(Libedit& functions) {
    void* const library = dlopen("libedit.so.2", RTLD_NOW | RTLD_LOCAL);
    if (!library) return false;
    bool complete = true;
    find(library, "el_init", functions.init, complete);
    find(library, "el_end", functions.end, complete);
    find(library, "el_set", functions.set, complete);
    find(library, "el_wset", functions.wide_set, complete);
    find(library, "el_get", functions.get, complete);
    find(library, "el_gets", functions.gets, complete);
    find(library, "el_line", functions.line, complete);
    find(library, "el_source", functions.source, complete);
    find(library, "el_insertstr", functions.insert, complete);
    find(library, "el_deletestr", functions.erase, complete);
    find(library, "history", functions.history, complete);
    find(library, "history_init", functions.history_init, complete);
    find(library, "history_end", functions.history_end, complete);
    return complete;
}

#else

bool load(Libedit& functions) {
    functions = {el_init,   el_end,       el_set,       el_wset, el_get,       el_gets,    el_line,
                 el_source, el_insertstr, el_deletestr, history, history_init, history_end};
    return true;
}

#endif

}  // namespace

const Libedit* libedit() {
    static Libedit functions;
    static const bool loaded = load(functions);
    return loaded ? &functions : nullptr;
}

}  // namespace lissom::cli
#endif
