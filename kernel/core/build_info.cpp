#include "kernel/core/build_info.h"

namespace lissom {

BuildInfo build_info() {
    BuildInfo info;
#ifdef LISSOM_HAS_GPL
    info.gpl = true;
    info.licence = "GPL-2.0-or-later";
#endif
#ifdef LISSOM_HAS_TBB
    info.tbb = true;
#endif
    return info;
}

}  // namespace lissom
