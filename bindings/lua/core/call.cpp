#include "bindings/lua/core/call.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>
#include <utility>

#include "bindings/lua/core/error_object.h"
#include "bindings/lua/core/file_path.h"
#include "bindings/lua/core/parse/parser.h"

namespace lissom::lua {
namespace {

// Native bytes between two steps of the collector.
constexpr std::size_t kChargeStep = std::size_t{64} << 10;

// Content of the userdata of a held value.
struct HeldSlot {
    const void* mark;
    Cell* cell;
};
const char kHeldMark = 0;

// Returns false if the account has no room.
bool hold_bytes(const State& state, Cell& cell, std::size_t bytes) {
    try {
        cell.bytes = MemoryHold(state.context.memory(), "an object of a script");
        cell.bytes.resize(bytes);
    } catch (const Error&) {
        return false;
    }
    return true;
}

// Whether a place is in the library's own Lua text: then it says nothing to a script.
bool is_own_text(const char* place) {
    return std::strncmp(place, kOwnLuaText, std::strlen(kOwnLuaText)) == 0;
}

}  // namespace

void push_place(lua_State* L) {
    constexpr int kDeepest = 10;
    lua_pushliteral(L, "");
    for (int level = 1; level < kDeepest && lua_tostring(L, -1)[0] == '\0'; ++level) {
        lua_pop(L, 1);
        luaL_where(L, level);
        if (!is_own_text(lua_tostring(L, -1))) continue;
        lua_pop(L, 1);
        lua_pushliteral(L, "");
    }
}

Call::Call(lua_State* L, State& state, const Entry& entry)
    : L_(L), state_(&state), entry_(&entry), name_(entry.function->name.c_str()) {
    if (state.listeners->running) raise("a listener cannot call lissom while an operation runs");
    Parser(*this).run();
}

Call::Call(lua_State* L, State& state, const Operator& op)
    : L_(L), state_(&state), entry_(nullptr), name_(op.name.c_str()) {}

const Value& Call::value(const char* path) const {
    for (std::size_t i = 0; i < entry_->slots.size(); ++i) {
        if (entry_->slots[i].path == path) return values_[i];
    }
    luaL_error(L_, "'%s' has no parameter '%s'", name_, path);
    return values_[0];
}

bool Call::has(const char* path) const {
    return value(path).present;
}
Kind Call::kind(const char* path) const {
    return value(path).kind;
}
bool Call::boolean(const char* path) const {
    return value(path).number != 0.0;
}
int Call::integer(const char* path) const {
    return static_cast<int>(value(path).number);
}
double Call::number(const char* path) const {
    return value(path).number;
}
int Call::stack_index(const char* path) const {
    return value(path).stack;
}

const char* Call::string(const char* path) const {
    return static_cast<const char*>(value(path).data);
}

Vec3 Call::vector(const char* path) const {
    const Value& v = value(path);
    return {v.xyz[0], v.xyz[1], v.xyz[2]};
}

Mat3 Call::matrix3(const char* path) const {
    using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
    return Eigen::Map<const RowMajor>(static_cast<const double*>(value(path).data));
}

Affine Call::affine(const char* path) const {
    using Rows = Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>;
    const Rows rows(static_cast<const double*>(value(path).data));
    return {rows.leftCols<3>(), rows.col(3)};
}

void* Call::address(const char* path) const {
    return const_cast<void*>(value(path).data);
}

std::span<const Index> Call::ids(const char* path) const {
    const Value& v = value(path);
    return {static_cast<const Index*>(v.data), v.size};
}

IdLists Call::id_lists(const char* path) const {
    const Value& v = value(path);
    const std::size_t total = v.offsets[v.size];
    return {{v.offsets, v.size + 1}, {static_cast<const Index*>(v.data), total}};
}

std::span<const Vec3> Call::points(const char* path) const {
    static_assert(sizeof(Vec3) == 3 * sizeof(double));
    const Value& v = value(path);
    return {static_cast<const Vec3*>(v.data), v.size};
}

std::span<const std::array<double, 2>> Call::pixels(const char* path) const {
    const Value& v = value(path);
    return {static_cast<const std::array<double, 2>*>(v.data), v.size};
}

std::span<const double> Call::numbers(const char* path) const {
    const Value& v = value(path);
    return {static_cast<const double*>(v.data), v.size};
}

std::span<const char* const> Call::strings(const char* path) const {
    const Value& v = value(path);
    return {static_cast<const char* const*>(v.data), v.size};
}

void Call::select_item(const char* path, const char* key) {
    for (const Entry::Slot& slot : entry_->slots) {
        if (slot.path == path) return Parser(*this).read_item(slot, value(path).stack, key);
    }
}

void Call::select_item(const char* path, int place) {
    for (const Entry::Slot& slot : entry_->slots) {
        if (slot.path == path) return Parser(*this).read_item(slot, value(path).stack, place);
    }
}

void Call::raise(const char* text) const {
    raise_misuse(L_, text);
}

void Call::reject(const char* path, const char* text) const {
    const char* kind = "option";
    for (int i = 0; i < entry_->arguments; ++i) {
        if (entry_->slots[i].path == path) kind = "argument";
    }
    raise(lua_pushfstring(L_, "bad %s '%s' of '%s' (%s)", kind, path, name_, text));
}

bool Call::holds(const char* path, const char* type_name) const {
    const auto* holder = static_cast<const Holder*>(value(path).data);
    return std::strcmp(holder->type_name, type_name) == 0;
}

void own_cell(lua_State* L, State& state, Cell* cell, std::size_t bytes) {
    bool fits = cell && hold_bytes(state, *cell, bytes);
    if (cell && !fits && lua_gc(L, LUA_GCISRUNNING, 0)) {
        lua_gc(L, LUA_GCCOLLECT, 0);
        fits = hold_bytes(state, *cell, bytes);
    }
    if (fits) return state.cells.add(*cell);
    delete cell;
    // As Lua's own error, without a place: hosts know it.
    lua_pushliteral(L, "not enough memory");
    lua_error(L);
}

namespace {

// Blocks of the allocator: the cell, the counted object, and the object with its own count.
constexpr std::size_t kBlockBytes = 3 * 32;

// Null if there is no memory for one.
ObjectSlot::Content* new_cell() noexcept {
    auto* cell = new (std::nothrow) ObjectSlot::Content;
    try {
        if (cell) cell->counted = std::make_shared<CountedObject>();
    } catch (const std::bad_alloc&) {
        delete std::exchange(cell, nullptr);
    }
    return cell;
}

}  // namespace

Holder* push_holder(lua_State* L, State& state, const char* type_name, std::size_t bytes) {
    auto* holder = static_cast<Holder*>(new_userdata(L, sizeof(Holder)));
    new (holder) Holder(type_name);
    luaL_getmetatable(L, type_name);
    lua_setmetatable(L, -2);
    auto* cell = new_cell();
    own_cell(L, state, cell, sizeof *cell + sizeof(CountedObject) + kBlockBytes + bytes);
    holder->object.set_cell(cell);
    return holder;
}

Cell*& Call::push_held() const {
    auto* slot = static_cast<HeldSlot*>(new_userdata(L_, sizeof(HeldSlot)));
    *slot = {&kHeldMark, nullptr};
    raw_get_pointer(L_, LUA_REGISTRYINDEX, State::held_metatable_key());
    lua_setmetatable(L_, -2);
    return slot->cell;
}

int collect_held(lua_State* L) {
    auto* slot = static_cast<HeldSlot*>(lua_touserdata(L, 1));
    if (!slot || raw_length(L, 1) != sizeof(HeldSlot) || slot->mark != &kHeldMark) return 0;
    delete std::exchange(slot->cell, nullptr);
    return 0;
}

Holder* find_holder(lua_State* L, int index, const char* type_name) {
    if (lua_type(L, index) != LUA_TUSERDATA || raw_length(L, index) != sizeof(Holder)) {
        return nullptr;
    }
    auto* holder = static_cast<Holder*>(lua_touserdata(L, index));
    if (holder->mark != &Holder::kMark) return nullptr;
    return !type_name || std::strcmp(holder->type_name, type_name) == 0 ? holder : nullptr;
}

// Objects that no script holds any more keep their memory until they are collected: they go before
// a limit is run into.
void Call::make_room() const {
    const MemoryAccount& account = *context().memory();
    const std::size_t limit = account.limit(), used = account.used();
    if (limit == 0 || used < limit / 2) return;
    const std::size_t after = state_->used_after_collection;
    const std::size_t room = limit - std::min(limit, after);
    if (used < after + std::min(limit / 8, room / 2)) return;
    if (!lua_gc(L_, LUA_GCISRUNNING, 0)) return;
    lua_gc(L_, LUA_GCCOLLECT, 0);
    state_->used_after_collection = account.used();
}

void Call::begin_work() {
    luaL_checkstack(L_, LUA_MINSTACK, "no room for a listener");
    make_room();
    state_->listeners->running = L_;
}

bool Call::end_work() {
    state_->listeners->running = nullptr;
    release_collected(L_, *state_->listeners);
    state_->end_operation(L_);
    return !failed_;
}

std::filesystem::path Call::file(std::string_view text, FileUse use) const {
    std::filesystem::path path = file_path(text);
    if (state_->host.check_file) state_->host.check_file(path, use);
    return path;
}

void Call::require_addresses() const {
    if (state_->host.addresses) return;
    throw Error(
        ErrorCode::unsupported,
        "the host of this script gives no addresses of memory and takes none; read numbers by "
        "their place, or as a table");
}

int Call::fail() {
    raise_failure(L_, failure_);
}

void Call::resize_held(MemoryHold& held, std::size_t bytes) const {
    if (!held.account()) held = MemoryHold(context().memory(), "an object of a script");
    held.resize(bytes);
}

void Call::hold_memory(MemoryHold& held, std::size_t bytes) const {
    bool fits = true;
    try {
        resize_held(held, bytes);
    } catch (const Error&) {
        fits = false;
    }
    if (fits) return;
    Failure failure;
    failure.set(ErrorCode::memory_limit, "there is no memory left for an object of this size");
    raise_failure(L_, failure);
}

void Call::charge_bytes(std::size_t bytes) const {
    state_->uncharged_bytes += bytes;
    if (state_->uncharged_bytes < kChargeStep || !lua_gc(L_, LUA_GCISRUNNING, 0)) return;
    const std::size_t kilobytes = std::min<std::size_t>(state_->uncharged_bytes >> 10, 1u << 30);
    state_->uncharged_bytes = 0;
    lua_gc(L_, LUA_GCSTEP, index_of(kilobytes));
}

int Call::push(bool value) const {
    lua_pushboolean(L_, value ? 1 : 0);
    return 1;
}

int Call::push(double value) const {
    lua_pushnumber(L_, value);
    return 1;
}

int Call::push(int value) const {
    push_integer(L_, value);
    return 1;
}

int Call::push(std::string_view text) const {
    lua_pushlstring(L_, text.data(), text.size());
    return 1;
}

int Call::push_count(std::size_t value) const {
    push_integer(L_, static_cast<long long>(value));
    return 1;
}

int Call::push_id(Index zero_based) const {
    push_integer(L_, static_cast<long long>(zero_based) + 1);
    return 1;
}

int Call::push_ids(std::span<const Index> zero_based) const {
    lua_createtable(L_, count_of(zero_based), 0);
    for (std::size_t i = 0; i < zero_based.size(); ++i) {
        push_id(zero_based[i]);
        lua_rawseti(L_, -2, index_of(i) + 1);
    }
    return 1;
}

int Call::push_vector(const Vec3& value) const {
    return push_numbers({value.data(), 3});
}

int Call::push_numbers(std::span<const double> values) const {
    lua_createtable(L_, count_of(values), 0);
    for (std::size_t i = 0; i < values.size(); ++i) {
        lua_pushnumber(L_, values[i]);
        lua_rawseti(L_, -2, index_of(i) + 1);
    }
    return 1;
}

int Call::push_affine(const Affine& value) const {
    lua_createtable(L_, 4, 0);
    for (int row = 0; row < 4; ++row) {
        const double last[4] = {0.0, 0.0, 0.0, 1.0};
        const double upper[4] = {value.linear(row % 3, 0), value.linear(row % 3, 1),
                                 value.linear(row % 3, 2), value.translation[row % 3]};
        push_numbers({row < 3 ? upper : last, 4});
        lua_rawseti(L_, -2, row + 1);
    }
    return 1;
}

int Call::push_argument(int index) const {
    lua_pushvalue(L_, index);
    return 1;
}

int Call::push_coordinates(const Vec3& value) const {
    for (int k = 0; k < 3; ++k) lua_pushnumber(L_, value[k]);
    return 3;
}

void Call::set_field(const char* key, int) const {
    lua_setfield(L_, -2, key);
}

void Call::remember(const void* object) const {
    raw_get_pointer(L_, LUA_REGISTRYINDEX, State::object_table_key());
    lua_pushvalue(L_, -2);
    raw_set_pointer(L_, -2, object);
    lua_pop(L_, 1);
}

bool Call::push_remembered(const void* object) const {
    raw_get_pointer(L_, LUA_REGISTRYINDEX, State::object_table_key());
    raw_get_pointer(L_, -1, object);
    lua_remove(L_, -2);
    const Holder* holder = find_holder(L_, -1, nullptr);
    if (holder && holder->object.get() == object) return true;
    lua_pop(L_, 1);
    return false;
}

}  // namespace lissom::lua
