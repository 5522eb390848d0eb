#include "bindings/cli/load_flags.h"

#include <CLI/CLI.hpp>

namespace lissom::cli {

void LoadFlags::declare(CLI::App& app) {
    app.add_option("--weld", weld,
                   "Vertices at the same place that become one: those along seams, all, or none "
                   "(default: all for .stl, else seams)")
        ->check(CLI::IsMember({"seams", "all", "none"}));
    app.add_flag("--keep-unused", keep_unused,
                 "Keep vertices that no face uses, in their order (with --weld none: the count and "
                 "the numbers of the file)");
    app.add_flag("--no-repair", no_repair, "Refuse files that would otherwise be repaired");
}

void LoadFlags::apply(LoadOptions& options) const {
    options.repair = !no_repair;
    if (keep_unused) options.unused = UnusedVertices::keep;
    if (weld == "seams") options.weld = Weld::seams;
    if (weld == "all") options.weld = Weld::all;
    if (weld == "none") options.weld = Weld::none;
}

}  // namespace lissom::cli
