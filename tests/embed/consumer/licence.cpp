// Says which licence a program is under by the libraries that it links.
#include <lissom/core/build_info.h>

#include <cstdio>
#include <cstring>

int main() {
    std::puts(lissom::build_info().licence);
    return std::strcmp(lissom::build_info().licence, EXPECTED_LICENCE) == 0 ? 0 : 1;
}
