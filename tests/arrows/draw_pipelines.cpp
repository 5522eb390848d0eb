// Writes docs/pipelines.svg below the folder that is given.
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/arrows/pipelines.h"

int main(int count, char** words) {
    if (count != 2) return 2;
    const std::string root = words[1];
    std::ifstream rooms(root + "/CONTRIBUTING.md", std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(rooms), {}};
    std::ofstream file(root + "/docs/pipelines.svg", std::ios::binary);
    file << lissom::test::pipelines_picture(text);
    if (file.flush()) return 0;
    std::fprintf(stderr, "docs/pipelines.svg cannot be written\n");
    return 1;
}
