#include "bindings/c/thesis_parts.h"

#ifdef LISSOM_HAS_THESIS
#include "kernel/thesis/fidelity.h"

namespace lissom::c {

DeformOptions literal_deform_options() {
    return thesis_deform_options();
}

const ThesisFormulas& literal_formulas() {
    return thesis_formulas();
}

}  // namespace lissom::c
#else
#include "kernel/core/error.h"

namespace lissom::c {
namespace {

[[noreturn]] void refuse_thesis() {
    throw Error(ErrorCode::unsupported,
                "option thesis is not part of this library, which was built without kernel/thesis; "
                "set it to false");
}

}  // namespace

DeformOptions literal_deform_options() {
    refuse_thesis();
}

const ThesisFormulas& literal_formulas() {
    refuse_thesis();
}

}  // namespace lissom::c
#endif
