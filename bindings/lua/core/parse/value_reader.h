/// ValueReader: reads one value of a call as its parameter describes it; private to
/// bindings/lua/core/parse.
#pragma once

#include <cstddef>

#include "bindings/lua/core/call.h"
#include "bindings/lua/core/parse/refusal.h"

namespace lissom::lua {

/// Returns whether the value at `index` is of the Lua type that `p` wants; a ValueReader checks its
/// content.
bool fits(lua_State* L, const Parameter& p, int index);

/// Sets `value` to the unit vector of the axis called "x", "y" or "z", perhaps with a sign.
void set_axis(const char* name, Value& value) noexcept;

/// Each function reads the value at stack index `index`, and refuses it if `p` does not accept it.
class ValueReader {
  public:
    explicit ValueReader(const Call& call) : call_(call), L_(call.lua()) {}

    void read(const Parameter& p, int index, Value& value, const ValuePlace& place) const;
    /// A coordinate of a vector that is given as three arguments.
    double read_coordinate(const Parameter& p, int index, const ValuePlace& place) const;

  private:
    double read_number(const Parameter& p, int index, const ValuePlace& place) const;
    int read_whole(const Parameter& p, int index, const ValuePlace& place) const;
    Holder* read_object(const Parameter& p, int index, const ValuePlace& place) const;
    const char* read_string(const Parameter& p, int index, std::size_t& size,
                            const ValuePlace& place) const;
    void read_choice(const Parameter& p, int index, Value& value, const ValuePlace& place) const;
    void read_alternative(const Parameter& p, int index, Value& value,
                          const ValuePlace& place) const;
    void require_type(int type, const Parameter& p, int index, const ValuePlace& place) const;

    // Vectors and matrices.
    void read_vector(const Parameter& p, int index, double* xyz, const ValuePlace& place) const;
    void read_pair(const Parameter& p, int index, double* xy, const ValuePlace& place) const;
    void read_open_vector(const Parameter& p, int index, double* xyz,
                          const ValuePlace& place) const;
    void read_factors(const Parameter& p, int index, Value& value, const ValuePlace& place) const;
    void read_axis(const Parameter& p, int index, Value& value, const ValuePlace& place) const;
    void read_row(const Parameter& p, int index, int columns, double* row,
                  const ValuePlace& place) const;
    void read_matrix(const Parameter& p, int index, Value& value, const ValuePlace& place) const;

    // Lists.
    void read_list(const Parameter& p, int index, Value& value, const ValuePlace& place) const;
    void read_id_lists(const Parameter& p, int index, Value& value, const ValuePlace& place) const;
    template <typename Item, typename Read>
    void read_items(int index, Value& value, const ValuePlace& place, const Read& read) const;
    template <typename Read>
    void for_each_item(int index, std::size_t size, const ValuePlace& place,
                       const Read& read_item) const;

    const Call& call_;
    lua_State* L_;
};

}  // namespace lissom::lua
