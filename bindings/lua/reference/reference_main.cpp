// Writes the annotations and the reference page of the kernel's library:
//     lissom_reference META_FILE REFERENCE_FILE
#include <filesystem>
#include <fstream>
#include <iostream>

#include "bindings/lua/reference/reference.h"

namespace {

bool write(const char* path, const std::string& text) {
    std::filesystem::create_directories(std::filesystem::path(path).parent_path());
    std::ofstream file(path, std::ios::binary);
    file << text;
    return file.good();
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::cerr << "usage: lissom_reference META_FILE REFERENCE_FILE\n";
        return 2;
    }
    const lissom::lua::Library library = lissom::lua::kernel_library();
    const bool written = write(argv[1], lissom::lua::annotations(library)) &&
                         write(argv[2], lissom::lua::reference_page(library));
    if (!written) std::cerr << "lissom_reference: cannot write the files\n";
    return written ? 0 : 1;
}
