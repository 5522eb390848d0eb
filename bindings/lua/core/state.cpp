#include "bindings/lua/core/state.h"

#include <utility>

namespace lissom::lua {
namespace {

const char kObjectTable = 0, kHeldMetatable = 0;

ContextOptions observed(const ContextOptions& given, const std::shared_ptr<Listeners>& listeners) {
    ContextOptions options = given;
    options.progress = [listeners, inner = given.progress](std::string_view label,
                                                           double fraction) {
        if (inner) inner(label, fraction);
        report_progress(*listeners, label, fraction);
    };
    options.log = [listeners, inner = given.log](LogLevel level, std::string_view text) {
        if (inner) inner(level, text);
        keep_message(*listeners, level, text);
    };
    return options;
}

}  // namespace

State::State(const HostOptions& options)
    : registry(options.registry), context(observed(options.context, listeners)), host(options) {
    if (!registry) registry = std::make_shared<const Registry>(kernel_registry());
    listeners->context = &context;
}

State::~State() {
    listeners->running = nullptr;
}

void State::end_operation(lua_State* L) {
    if (host.operation_ended) host.operation_ended();
    end_listening(L, *listeners);
}

const void* State::object_table_key() {
    return &kObjectTable;
}
const void* State::held_metatable_key() {
    return &kHeldMetatable;
}

}  // namespace lissom::lua
