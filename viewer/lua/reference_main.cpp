// Writes the annotations and the reference page of the viewer's library:
//     viewer_reference META_FILE REFERENCE_FILE
#include <fstream>
#include <iostream>

#include "bindings/lua/reference/reference.h"
#include "viewer/lua/viewer_library.h"

namespace {

bool write(const char* path, const std::string& text) {
    std::ofstream file(path, std::ios::binary);
    file << text;
    return file.good();
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::cerr << "usage: viewer_reference META_FILE REFERENCE_FILE\n";
        return 2;
    }
    const lissom::lua::Library library = lissom::lua::viewer_library();
    const bool written = write(argv[1], lissom::lua::annotations(library)) &&
                         write(argv[2], lissom::lua::reference_page(library));
    if (!written) std::cerr << "viewer_reference: cannot write the files\n";
    return written ? 0 : 1;
}
