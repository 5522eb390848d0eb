#include "bindings/lua/deform/thesis_parts.h"

#ifdef LISSOM_HAS_THESIS
#include "kernel/thesis/comparison/methods.h"
#include "kernel/thesis/transition/literal_transition.h"

namespace lissom::lua {

ComparisonMaker comparison_maker() {
    return make_comparison;
}

const OverlapTransition* thesis_overlap() {
    return &literal_transition();
}

}  // namespace lissom::lua
#else
namespace lissom::lua {

ComparisonMaker comparison_maker() {
    return nullptr;
}

const OverlapTransition* thesis_overlap() {
    return nullptr;
}

}  // namespace lissom::lua
#endif
