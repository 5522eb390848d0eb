// What every program costs: only the C++ library is loaded, as it is used.
#include <iostream>

int main(int argc, char**) {
    if (argc > 100) std::cout << argc;
    return 0;
}
