// A library without Lua.
#include "bindings/c/script_host.h"

namespace lissom::c {

void connect_scripts(lissom_context&) {}

namespace {

lissom_status refuse(lissom_context* context) {
    return run(context, [] {
        throw Error(ErrorCode::unsupported,
                    "this library was built without Lua: it runs no scripts, and lissom_call calls "
                    "nothing; configure it with LISSOM_LUA=ON");
    });
}

}  // namespace
}  // namespace lissom::c

using namespace lissom::c;

extern "C" {

bool lissom_has_scripts(void) {
    return false;
}

lissom_sandbox_options lissom_default_sandbox_options(void) {
    lissom_sandbox_options options{};
    options.struct_size = sizeof options;
    return options;
}

lissom_status lissom_sandbox_scripts(lissom_context* context, const lissom_sandbox_options*) {
    return refuse(context);
}

lissom_status lissom_script_load(lissom_context* context, const char*, size_t, const char*,
                                 lissom_script*) {
    return refuse(context);
}

lissom_status lissom_script_parameters(lissom_context* context, lissom_script, lissom_bytes*) {
    return refuse(context);
}

lissom_status lissom_script_set(lissom_context* context, lissom_script, const char*, const char*) {
    return refuse(context);
}

lissom_status lissom_script_run(lissom_context* context, lissom_script, const char*,
                                lissom_bytes*) {
    return refuse(context);
}

lissom_status lissom_call(lissom_context* context, const char*, const char*, lissom_bytes*) {
    return refuse(context);
}

lissom_status lissom_script_begin_run(lissom_context* context, lissom_script, const char*,
                                      lissom_job*) {
    return refuse(context);
}

lissom_status lissom_begin_call(lissom_context* context, const char*, const char*, lissom_job*) {
    return refuse(context);
}

lissom_status lissom_numbers_create(lissom_context* context, const lissom_input*, int32_t,
                                    lissom_object*) {
    return refuse(context);
}

int32_t lissom_numbers_size(lissom_context* context, lissom_object) {
    refuse(context);
    return -1;
}

int32_t lissom_numbers_width(lissom_context* context, lissom_object) {
    refuse(context);
    return -1;
}

lissom_status lissom_numbers_read(lissom_context* context, lissom_object, const lissom_output*) {
    return refuse(context);
}

}  // extern "C"
