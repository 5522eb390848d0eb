/// Options of a session.
#pragma once

#include <string>

#include "kernel/io/mesh_file.h"

namespace lissom::window {

struct SessionOptions {
    /// The tool that is in hand from the first: a file, or the name of one that ships.
    std::string tool = {};
    /// File that records the work of tools; empty for none.
    std::string record = {};
    /// File that keeps the calls of tools as a script; empty for none but that of `copy_scene`.
    std::string journal = {};
    /// Options for reading mesh files.
    LoadOptions load = {};
};

}  // namespace lissom::window
