// Names and explanations of status codes.
#include <array>
#include <string>
#include <string_view>

#include "bindings/c/lissom.h"
#include "kernel/core/error.h"

namespace lissom::c {
namespace {

struct StatusText {
    lissom_status status;
    const char* name;
    const char* explanation;
};

// Statuses unknown to the kernel.
constexpr std::array<StatusText, 5> kOwnStatus{{
    {LISSOM_OK, "ok", "The call succeeded."},
    {LISSOM_INVALID_HANDLE, "invalid_handle",
     "The handle names no object of this kind in this context: it was released, was never set, "
     "or comes from another context. "
     "Keep handles beside the context they were made in, "
     "and set them to zero once they are released."},
    {LISSOM_BUSY, "busy",
     "A job works with the object. Finish the job with lissom_job_finish, then use the object."},
    {LISSOM_BAD_STRUCT, "bad_struct",
     "A struct of options was not taken from its lissom_default_ function, "
     "or belongs to a later version of the library. "
     "Begin with the defaults and change their fields."},
    {LISSOM_SCRIPT_ERROR, "script_error",
     "The script raised an error; the message has its file and line."},
}};

const StatusText* own_text(lissom_status status) {
    for (const StatusText& one : kOwnStatus) {
        if (one.status == status) return &one;
    }
    return nullptr;
}

bool is_kernel_status(lissom_status status) {
    return status > LISSOM_OK && status <= LISSOM_INTERNAL;
}

ErrorCode code_of(lissom_status status) {
    return static_cast<ErrorCode>(static_cast<int>(status) - 1);
}

}  // namespace
}  // namespace lissom::c

using namespace lissom::c;

extern "C" {

const char* lissom_status_name(lissom_status status) {
    if (is_kernel_status(status)) return lissom::code_name(code_of(status)).data();
    const StatusText* text = own_text(status);
    return text ? text->name : "unknown";
}

const char* lissom_status_explanation(lissom_status status) {
    if (is_kernel_status(status)) return lissom::code_explanation(code_of(status)).data();
    const StatusText* text = own_text(status);
    return text ? text->explanation : "There is no such status.";
}

}  // extern "C"
