// Writes the annotations and the reference pages of all that scripts can call:
//     lissom_reference ROOT
#include <filesystem>
#include <fstream>
#include <iostream>

#include "bindings/lua/reference/reference.h"
#include "viewer/lua/viewer_library.h"

namespace {

namespace fs = std::filesystem;

bool write(const fs::path& path, const std::string& text) {
    fs::create_directories(path.parent_path());
    std::ofstream file(path, std::ios::binary);
    file << text;
    return file.good();
}

// Pages of types that are gone go too.
bool write_pages(const fs::path& folder) {
    lissom::lua::Registry registry = lissom::lua::kernel_registry();
    registry.add(lissom::lua::viewer_library());
    fs::create_directories(folder);
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (entry.path().extension() == ".md") fs::remove(entry.path());
    }
    bool written = true;
    for (const lissom::lua::Page& page : lissom::lua::reference_pages(registry)) {
        written = write(folder / page.file, page.text) && written;
    }
    return written;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::cerr << "usage: lissom_reference ROOT\n";
        return 2;
    }
    using namespace lissom::lua;
    const fs::path root = argv[1];
    const bool written =
        write(root / "bindings/lua/meta/lissom.lua", annotations(kernel_library())) &&
        write(root / "viewer/meta/lissom_viewer.lua", annotations(viewer_library())) &&
        write_pages(root / "docs/lua");
    if (!written) std::cerr << "lissom_reference: cannot write the files\n";
    return written ? 0 : 1;
}
