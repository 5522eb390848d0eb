/// Options of the verbs that read meshes: the repair of meshes.
#pragma once

#include <string>

#include "kernel/io/mesh_file.h"

namespace CLI {
class App;
}

namespace lissom::cli {

/// The values of --weld and --no-repair.
struct LoadFlags {
    std::string weld;
    bool no_repair = false, keep_unused = false;

    /// Lets `app` fill these values, which must outlive its parsing.
    void declare(CLI::App& app);
    /// Enters them in `options`.
    void apply(LoadOptions& options) const;
};

}  // namespace lissom::cli
