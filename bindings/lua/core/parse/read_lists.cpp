// Readers of lists.
#include <array>
#include <limits>

#include "bindings/lua/core/parse/value_reader.h"

namespace lissom::lua {

template <typename Read>
void ValueReader::for_each_item(int index, std::size_t size, const ValuePlace& place,
                                const Read& read_item) const {
    for (std::size_t i = 0; i < size; ++i) {
        lua_rawgeti(L_, index, index_of(i) + 1);
        read_item(lua_gettop(L_), i, ValuePlace{place.argument, place.path, index_of(i) + 1});
        lua_pop(L_, 1);
    }
}

// `read` fills an entry from its stack index and its place in the call.
template <typename Item, typename Read>
void ValueReader::read_items(int index, Value& value, const ValuePlace& place,
                             const Read& read) const {
    auto* list = call_.scratch<Item>(value.size);
    for_each_item(index, value.size, place,
                  [&](int at, std::size_t i, const ValuePlace& item) { read(list[i], at, item); });
    value.data = list;
}

void ValueReader::read_list(const Parameter& p, int index, Value& value,
                            const ValuePlace& place) const {
    require_type(LUA_TTABLE, p, index, place);
    value.size = raw_length(L_, index);
    if (value.size > at(std::numeric_limits<Index>::max())) {
        refuse(call_, place, "shorter list", "too many entries");
    }
    using Place = const ValuePlace&;
    const auto triple = [&](auto& to, int at, Place item) { read_vector(p, at, to.data(), item); };
    const auto pair = [&](auto& to, int at, Place item) { read_pair(p, at, to.data(), item); };
    const auto number = [&](double& to, int at, Place item) { to = read_number(p, at, item); };
    // The strings stay in the script's table, which stays on the stack.
    const auto string = [&](const char*& to, int at, Place item) {
        std::size_t length = 0;
        to = read_string(p, at, length, item);
    };
    const auto object = [&](Holder*& to, int at, Place item) { to = read_object(p, at, item); };
    const int shift = p.kind == Kind::ids ? 1 : 0;
    const auto whole = [&](Index& to, int at, Place item) { to = read_whole(p, at, item) - shift; };
    switch (p.kind) {
        case Kind::points:
            return read_items<std::array<double, 3>>(index, value, place, triple);
        case Kind::pixels:
            return read_items<std::array<double, 2>>(index, value, place, pair);
        case Kind::numbers:
            return read_items<double>(index, value, place, number);
        case Kind::strings:
            return read_items<const char*>(index, value, place, string);
        case Kind::objects:
            return read_items<Holder*>(index, value, place, object);
        default:
            return read_items<Index>(index, value, place, whole);
    }
}

void ValueReader::read_id_lists(const Parameter& p, int index, Value& value,
                                const ValuePlace& place) const {
    if (lua_type(L_, index) != LUA_TTABLE) refuse_value(call_, p, index, place);
    const std::size_t size = raw_length(L_, index);
    std::size_t total = 0;
    for_each_item(index, size, place, [&](int at, std::size_t, const ValuePlace& item) {
        if (lua_type(L_, at) != LUA_TTABLE) refuse_value(call_, p, at, item);
        total += raw_length(L_, at);
    });
    if (size + total > at(std::numeric_limits<Index>::max()) - 1) {
        refuse(call_, place, "shorter list", "too many entries");
    }
    auto* offsets = call_.scratch<Index>(size + 1);
    auto* ids = call_.scratch<Index>(total);
    std::size_t filled = 0;
    offsets[0] = 0;
    for_each_item(index, size, place, [&](int at, std::size_t i, const ValuePlace& item) {
        const std::size_t length = raw_length(L_, at);
        for (std::size_t k = 0; k < length; ++k) {
            lua_rawgeti(L_, at, index_of(k) + 1);
            ids[filled++] = read_whole(p, lua_gettop(L_), item) - 1;
            lua_pop(L_, 1);
        }
        offsets[i + 1] = index_of(filled);
    });
    value.data = ids;
    value.offsets = offsets;
    value.size = size;
}

}  // namespace lissom::lua
