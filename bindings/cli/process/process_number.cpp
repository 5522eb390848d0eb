#include "bindings/cli/process/process_number.h"

#include <unistd.h>

#include <cerrno>
#include <csignal>

namespace lissom::cli {

long process_number() {
    return static_cast<long>(getpid());
}

bool process_runs(long number) {
    return kill(static_cast<pid_t>(number), 0) == 0 || errno == EPERM;
}

}  // namespace lissom::cli
