#include "bindings/cli/program.h"

int main(int argc, char** argv) {
    return lissom::cli::run_program(argc, argv, lissom::cli::kernel_parts());
}
