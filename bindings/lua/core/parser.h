/// Parser: reads the arguments of one call as the table describes them; private to bindings/lua.
#pragma once

#include "bindings/lua/core/call.h"

namespace lissom::lua {

/// Returns the accepted values of a parameter, for messages: "integer from 1 to 10", "\"x\", \"y\",
/// \"z\" or {x, y, z}".
std::string expectation(const Parameter& parameter);

class Parser {
  public:
    explicit Parser(Call& call) : call_(call), L_(call.L_), entry_(*call.entry_) {}

    /// Fills the call's values, or raises a Lua error that names the argument.
    void run();
    /// Fills the values of an option map's fields from the table under `key`.
    void read_item(const Entry::Slot& slot, int table, const char* key);
    /// Fills the values of an option list's fields from its table at `place`, from 1.
    void read_item(const Entry::Slot& slot, int table, int place);

  private:
    // Place of a value in the call, for messages.
    struct Place {
        int argument;
        const char* path;
        // Place in a list, from 1; 0 for the value itself.
        int item;
    };

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

    void read(const Parameter& p, int index, Value& value, const Place& place);
    double read_number(const Parameter& p, int index, const Place& place);
    int read_whole(const Parameter& p, int index, const Place& place);
    double read_coordinate(const Parameter& p, int index, const Place& place);
    Holder* read_object(const Parameter& p, int index, const Place& place);
    const char* read_string(const Parameter& p, int index, std::size_t& size, const Place& place);
    void read_choice(const Parameter& p, int index, Value& value, const Place& place);
    void read_vector(const Parameter& p, int index, double* xyz, const Place& place);
    void read_pair(const Parameter& p, int index, double* xy, const Place& place);
    void read_open_vector(const Parameter& p, int index, double* xyz, const Place& place);
    void read_factors(const Parameter& p, int index, Value& value, const Place& place);
    void read_axis(const Parameter& p, int index, Value& value, const Place& place);
    void read_matrix(const Parameter& p, int index, Value& value, const Place& place);
    void read_list(const Parameter& p, int index, Value& value, const Place& place);
    void read_id_lists(const Parameter& p, int index, Value& value, const Place& place);
    template <typename Read>
    void for_each_item(int index, std::size_t size, const Place& place, const Read& read_item);
    void read_alternative(const Parameter& p, int index, Value& value, const Place& place);
    bool fits(const Parameter& p, int index) const;
    int first_item_type(int index) const;

    [[noreturn]] void mismatch(const Parameter& p, int index, const Place& place);
    [[noreturn]] void refuse_missing(const Parameter& p, const Place& place);
    [[noreturn]] void refuse(const Place& place, const char* expected, const char* got);

    Call& call_;
    lua_State* L_;
    const Entry& entry_;
    // Arguments that were given by position.
    int by_position_ = 0;
};

/// A number as people write it: without trailing zeros.
std::string plain_number(double value);

}  // namespace lissom::lua
