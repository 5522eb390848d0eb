/// Parser: reads the arguments of one call as the table describes them; private to
/// bindings/lua/core.
#pragma once

#include "bindings/lua/core/call.h"
#include "bindings/lua/core/parse/value_reader.h"

namespace lissom::lua {

class Parser {
  public:
    explicit Parser(Call& call) : call_(call), L_(call.L_), entry_(*call.entry_), values_(call) {}

    /// Fills the call's values, or raises a Lua error that names the argument.
    void run();
    /// Fills the values of an option map's fields from the table under `key`.
    void read_item(const Entry::Slot& slot, int table, const char* key);
    /// Fills the values of an option list's fields from its table at `place`, from 1.
    void read_item(const Entry::Slot& slot, int table, int place);

  private:
    void check_self();
    int read_argument(int slot, int index, int given);
    bool is_option_table(const Parameter& p, int index) const;
    bool is_left_out(const Parameter& p, int index, int given) const;
    void read_options(int index, int given);
    void require_arguments();
    void read_table(int index, int first, int last);
    void read_named_table(int index);
    void read_fields(int index, int first, int last);
    bool knows_key(const char* key, int first, int last) const;
    void check_key(int first, int last);
    [[noreturn]] void refuse_key(const char* key, int first, int last);
    void drop_item(const Entry::Slot& slot);
    void read_top_item(const Entry::Slot& slot, const char* name, const char* key);
    void require_one_option();
    void fill_default(const Parameter& p, Value& value);
    void fill_defaults(int first, int last);

    Call& call_;
    lua_State* L_;
    const Entry& entry_;
    const ValueReader values_;
    // Arguments that were given by position.
    int by_position_ = 0;
};

}  // namespace lissom::lua
