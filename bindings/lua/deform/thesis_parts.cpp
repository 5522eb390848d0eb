#include "bindings/lua/deform/thesis_parts.h"

#ifdef LISSOM_HAS_THESIS
#include "kernel/thesis/comparison/methods.h"
#include "kernel/thesis/fidelity.h"

namespace lissom::lua {

ComparisonMaker comparison_maker() {
    return make_comparison;
}

DeformOptions literal_deform_options() {
    return thesis_deform_options();
}

const ThesisFormulas& literal_formulas() {
    return thesis_formulas();
}

MergeOptions literal_merge_options(Configuration configuration) {
    return thesis_merge_options(configuration);
}

}  // namespace lissom::lua
#else
#include "kernel/core/error.h"

namespace lissom::lua {
namespace {

[[noreturn]] void refuse_thesis() {
    throw Error(ErrorCode::unsupported,
                "fidelity = \"thesis\" is not part of this program, which was built without "
                "kernel/thesis; leave it out");
}

}  // namespace

ComparisonMaker comparison_maker() {
    return nullptr;
}

DeformOptions literal_deform_options() {
    refuse_thesis();
}

const ThesisFormulas& literal_formulas() {
    refuse_thesis();
}

MergeOptions literal_merge_options(Configuration /*configuration*/) {
    refuse_thesis();
}

}  // namespace lissom::lua
#endif
