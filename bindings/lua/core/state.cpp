#include "bindings/lua/core/state.h"

#include <utility>

#include "bindings/lua/core/script_parameters.h"

namespace lissom::lua {

const char Holder::kMark = 0;
const std::shared_ptr<void> ObjectSlot::kNone;

// Those who share the object share its count.
ObjectSlot& ObjectSlot::operator=(std::shared_ptr<void> object) noexcept {
    if (!cell_) return *this;
    std::shared_ptr<CountedObject> counted = std::move(cell_->counted);
    if (!counted || !object) {
        cell_->object = std::move(object);
        return *this;
    }
    counted->bytes = std::move(cell_->bytes);
    counted->object = std::move(object);
    void* const at = counted->object.get();
    cell_->object = std::shared_ptr<void>(std::move(counted), at);
    return *this;
}

Cell::~Cell() {
    if (before_) before_->after_ = after_;
    if (after_) after_->before_ = before_;
}

void CellList::add(Cell& cell) noexcept {
    cell.before_ = &first_;
    cell.after_ = first_.after_;
    if (first_.after_) first_.after_->before_ = &cell;
    first_.after_ = &cell;
}

void CellList::clear() noexcept {
    while (first_.after_) delete first_.after_;
}

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
    only_help = !host.arguments.script.empty() && asks_for_help(host.arguments.words);
}

State::~State() {
    listeners->running = nullptr;
    cells.clear();
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

int end_for_help(lua_State* L, State& state) {
    Failure failure;
    failure.guard([&] {
        if (state.script_end != ScriptEnd::none) return;
        state.script_end_text = "Usage: lissom run " + state.host.arguments.script +
                                "\n\nThe script works before it declares parameters: its help is "
                                "shown if lissom.params comes first.\n";
        state.script_end = ScriptEnd::help;
    });
    return luaL_error(L, "only the help of the script was asked for");
}

}  // namespace lissom::lua
