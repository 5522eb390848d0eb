#include "kernel/core/build_info.h"

namespace lissom {

LISSOM_REPLACEABLE bool has_gpl_module() {
    return false;
}

BuildInfo build_info() {
    BuildInfo info;
    if (has_gpl_module()) {
        info.gpl = true;
        info.licence = "GPL-2.0-or-later";
    }
#ifdef LISSOM_HAS_TBB
    info.tbb = true;
#endif
    return info;
}

}  // namespace lissom
