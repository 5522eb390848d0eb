/// Call: one call of an exposed function. A body works in four steps, because a Lua error may leave
/// a C function by longjmp, which skips destructors, and an exception must never reach Lua:
///
///     int smooth(Call& call) {
///         // 1. Read: plain data only.
///         const auto mesh = call.self<MeshObject>();
///         const int iterations = call.integer("iterations");
///         // 2. Make an empty result.
///         const auto result = call.create<MeshObject>();
///         // 3. Work: C++, no Lua.
///         if (!call.attempt([&] { result.set(smoothed(*mesh, iterations)); })) return call.fail();
///         // 4. Push.
///         return 1;
///     }
///
/// Arguments are checked against the table before the body runs. Outside `attempt` only trivially
/// destructible values may be alive.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <type_traits>

#include "bindings/lua/core/compat.h"
#include "bindings/lua/core/failure.h"
#include "bindings/lua/core/object.h"
#include "bindings/lua/core/registry.h"
#include "bindings/lua/core/state.h"
#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/memory_hold.h"

namespace lissom::lua {

/// A list of lists of ids: list i has ids[offsets[i]] .. ids[offsets[i + 1] - 1].
struct IdLists {
    std::span<const Index> offsets;
    std::span<const Index> ids;
};

/// One value that was read, as plain data. Which fields count depends on `kind`.
struct Value {
    bool present;
    Kind kind;
    /// Stack index of a function or table.
    int stack;
    /// Boolean, integer, number, id (0-based), place of a choice.
    double number;
    double xyz[3];
    /// Bytes of a string, elements of a list, the Holder of an object, 12 or 9 numbers of a matrix.
    const void* data;
    std::size_t size;
    /// For a list of lists, `size` + 1 offsets into `data`.
    const Index* offsets;
};

class Call {
  public:
    /// A call of `entry`, whose arguments are on the stack of `L`. Checks them: raises a Lua error.
    Call(lua_State* L, State& state, const Entry& entry);
    /// A call of a metamethod, whose operands are on the stack; nothing is checked.
    Call(lua_State* L, State& state, const Operator& op);

    /// The Lua stack: arguments from 1 on, then values pushed by parsing and `create`.
    lua_State* lua() const { return L_; }
    /// The function's name, for messages.
    const char* name() const { return name_; }
    State& state() const { return *state_; }
    const Context& context() const { return state_->context; }

    // ---- Step 1: arguments. `path` is the name of an argument or option, or "option.field".

    /// Whether the script gave a value or the table has a default.
    bool has(const char* path) const;
    /// Returns the alternative that was given.
    Kind kind(const char* path) const;
    bool boolean(const char* path) const;
    int integer(const char* path) const;
    double number(const char* path) const;
    /// A string that lives as long as the call.
    const char* string(const char* path) const;
    /// A choice as an enum of the kernel whose values are in the order of the choices.
    template <typename Enum = int>
    Enum choice(const char* path) const {
        return static_cast<Enum>(integer(path));
    }
    /// 0-based.
    Index id(const char* path) const { return integer(path); }
    /// Also of factors and of an axis.
    Vec3 vector(const char* path) const;
    Mat3 matrix3(const char* path) const;
    Affine affine(const char* path) const;
    void* address(const char* path) const;
    /// 0-based ids, or the integers of a list.
    std::span<const Index> ids(const char* path) const;
    IdLists id_lists(const char* path) const;
    std::span<const Vec3> points(const char* path) const;
    std::span<const std::array<double, 2>> pixels(const char* path) const;
    std::span<const double> numbers(const char* path) const;
    std::span<const char* const> strings(const char* path) const;
    /// Stack index of a function or table.
    int stack_index(const char* path) const;
    template <typename T>
    Ref<T> object(const char* path) const {
        return Ref<T>(static_cast<Holder*>(const_cast<void*>(value(path).data)));
    }
    /// Whether an object of this type was given, of those that the parameter accepts.
    template <typename T>
    bool is_object(const char* path) const {
        return kind(path) == Kind::object && holds(path, T::kTypeName);
    }
    /// Number of objects in a list, and each of them.
    std::size_t object_count(const char* path) const { return value(path).size; }
    template <typename T>
    Ref<T> object_at(const char* path, std::size_t i) const {
        return Ref<T>(static_cast<Holder* const*>(value(path).data)[i]);
    }

    /// Reads the table under `key` in a table of option tables: its fields are at "path.field"
    /// until the next one is selected, which pops them. Raises a Lua error for bad
    /// ones.
    void select_item(const char* path, const char* key);
    /// The same for the table at `place`, from 1, of a list of option tables.
    void select_item(const char* path, int place);

    /// The object whose method this is, or operand `index` of a metamethod.
    template <typename T>
    Ref<T> self(int index = 1) const {
        return Ref<T>(static_cast<Holder*>(lua_touserdata(L_, index)));
    }

    /// Raises "bad option 'radius' of 'region' (`text`)" for a value that only the body could
    /// judge.
    [[noreturn]] void reject(const char* path, const char* text) const;
    /// Raises an error object with the code `invalid_argument`.
    [[noreturn]] void raise(const char* text) const;

    /// Memory for plain data that lives as long as the call.
    template <typename T>
    T* scratch(std::size_t count) const {
        static_assert(std::is_trivially_destructible_v<T>);
        return static_cast<T*>(new_userdata(L_, count * sizeof(T)));
    }

    /// A value that needs a destructor, alive as long as the call: the collector owns it. Filled in
    /// step 3 and pushed in step 4.
    template <typename T>
    T& hold() const {
        static_assert(std::is_nothrow_default_constructible_v<T>);
        struct Held : Cell {
            T value{};
        };
        Cell*& slot = push_held();
        auto* held = own(new (std::nothrow) Held, sizeof(Held));
        slot = held;
        return held->value;
    }

    // ---- Step 2: results.

    /// Pushes a new userdata without an object.
    template <typename T>
    Ref<T> create() const {
        return Ref<T>(push_holder(L_, *state_, T::kTypeName, own_bytes<T>()));
    }

    // ---- Step 3: C++.

    /// Returns the path of a script's UTF-8 text, if the host lets it use that file.
    std::filesystem::path file(std::string_view text, FileUse use) const;
    /// Throws unsupported if the host lets scripts have no addresses.
    void require_addresses() const;

    /// Runs `work` and keeps its exception as the call's failure; false then. `work` calls no Lua.
    template <typename Work>
    bool attempt(const Work& work) {
        static_assert(std::is_trivially_destructible_v<Work>, "capture by reference");
        begin_work();
        failed_ = !failure_.guard(work);
        return end_work();
    }

    /// Like `attempt`, for quick work without a context: no listener, no progress.
    template <typename Work>
    bool attempt_quick(const Work& work) {
        static_assert(std::is_trivially_destructible_v<Work>, "capture by reference");
        failed_ = !failure_.guard(work);
        return !failed_;
    }

    // ---- Step 4: the end.

    /// Ends the call: raises the failure as an error object.
    [[noreturn]] int fail();

    /// Tells the collector how much native memory `object`, a Ref or pointer to a T, has now;
    /// growth since the last time makes it work. May run finalizers. T has `memory_bytes()` and
    /// `charged_bytes`; if it has `held` too, that many bytes are held on the context's account, or
    /// `held_bytes()` if it has that: those that nothing else counts. Raises a Lua error if there
    /// is no room.
    template <typename Object>
    void charge(const Object& object) const {
        if constexpr (requires { object->held; }) {
            hold_memory(object->held, held_bytes_of(object));
        }
        const std::size_t before = object->charged_bytes;
        object->charged_bytes = object->memory_bytes();
        if (object->charged_bytes > before) charge_bytes(object->charged_bytes - before);
    }
    void charge_bytes(std::size_t bytes) const;

    /// Inside attempt, before `object` grows by about `more` bytes that `charge` will hold: a
    /// script that catches the error has not kept them. Errors: memory_limit.
    template <typename Object>
    void reserve(const Object& object, std::size_t more) const {
        resize_held(object->held, held_bytes_of(object) + more);
    }

    /// Each pushes one value and returns 1.
    int push(bool value) const;
    int push(double value) const;
    int push(int value) const;
    int push(std::string_view text) const;
    int push(const char* text) const { return push(std::string_view(text)); }
    int push_count(std::size_t value) const;
    int push_id(Index zero_based) const;
    int push_ids(std::span<const Index> zero_based) const;
    /// {x, y, z}.
    int push_vector(const Vec3& value) const;
    int push_numbers(std::span<const double> values) const;
    /// Rows of a 4 x 4 matrix.
    int push_affine(const Affine& value) const;
    /// The object of a method that changes it, or an argument.
    int push_argument(int index = 1) const;
    /// x, y, z as three results; returns 3.
    int push_coordinates(const Vec3& value) const;

    /// Stores the value on top of the stack in the table below it: `set_field("x", push(1))`.
    void set_field(const char* key, int pushed = 1) const;

    /// Lets `push_shared` find the userdata at the top of the stack, which holds `object`.
    void remember(const void* object) const;
    /// Pushes the userdata that holds `object` already, or a new one. `object` must be owned by
    /// more than a local.
    template <typename T>
    int push_shared(const std::shared_ptr<T>& object) const {
        if (push_remembered(object.get())) return 1;
        create<T>().set(object);
        remember(object.get());
        return 1;
    }

  private:
    friend class Parser;

    const Value& value(const char* path) const;
    bool holds(const char* path, const char* type_name) const;
    Cell*& push_held() const;
    // A new cell, null if there is no memory for one, becomes the state's.
    template <typename T>
    T* own(T* cell, std::size_t bytes) const {
        own_cell(L_, *state_, cell, bytes);
        return cell;
    }
    template <typename Object>
    static std::size_t held_bytes_of(const Object& object) {
        if constexpr (requires { object->held_bytes(); }) {
            return object->held_bytes();
        } else {
            return object->memory_bytes();
        }
    }
    void hold_memory(MemoryHold& held, std::size_t bytes) const;
    void resize_held(MemoryHold& held, std::size_t bytes) const;
    bool push_remembered(const void* object) const;
    void make_room() const;
    void begin_work();
    bool end_work();

    lua_State* L_;
    State* state_;
    const Entry* entry_;
    const char* name_;
    bool failed_ = false;
    // Top of the stack below the item selected last; 0 before.
    int item_top_ = 0;
    Failure failure_;
    Value values_[Entry::kMaximumSlots];
};

/// Places in the Lua text that is part of this library begin so; scripts are never told them.
inline constexpr const char kOwnLuaText[] = "lissom tools:";

/// Pushes "file:line: " of the innermost Lua function, or "" if there is none near: the script's
/// place even after a tail call or inside a metamethod.
void push_place(lua_State* L);

/// Pushes a new userdata of the type with this name, without an object. `bytes`, those of the
/// object's own structs, are on the account of the state's context.
Holder* push_holder(lua_State* L, State& state, const char* type_name, std::size_t bytes);

/// Gives a new cell of `bytes` to the state, on the account of its context. Deletes it and raises a
/// Lua error if there is no room, or if it is null.
void own_cell(lua_State* L, State& state, Cell* cell, std::size_t bytes);

/// __gc of held values.
int collect_held(lua_State* L);

/// Returns the Holder in the userdata at `index`, or null if that is foreign, or of another type
/// than `type_name` (null: any). A metatable proves nothing: scripts can set any on any.
Holder* find_holder(lua_State* L, int index, const char* type_name);

static_assert(std::is_trivially_destructible_v<Call>);
static_assert(std::is_trivially_destructible_v<Affine>);

}  // namespace lissom::lua
