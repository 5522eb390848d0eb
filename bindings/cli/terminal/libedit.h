/// The functions of libedit that the line editor calls. On Linux the library is loaded when the
/// first line is typed: linked, it takes a fifth of the time of a start.
#pragma once

#include <histedit.h>

namespace lissom::cli {

struct Libedit {
    decltype(&::el_init) init = nullptr;
    decltype(&::el_end) end = nullptr;
    decltype(&::el_set) set = nullptr;
    decltype(&::el_wset) wide_set = nullptr;
    decltype(&::el_get) get = nullptr;
    decltype(&::el_gets) gets = nullptr;
    decltype(&::el_line) line = nullptr;
    decltype(&::el_source) source = nullptr;
    decltype(&::el_insertstr) insert = nullptr;
    decltype(&::el_deletestr) erase = nullptr;
    decltype(&::history) history = nullptr;
    decltype(&::history_init) history_init = nullptr;
    decltype(&::history_end) history_end = nullptr;
};

/// Returns the functions, or null if the library is not installed.
const Libedit* libedit();

}  // namespace lissom::cli
