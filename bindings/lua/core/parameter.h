/// Parameter: the description of one argument or option of a function that scripts call. Argument
/// checks, conversions, editor annotations and the reference page all come from it.
#pragma once

#include <limits>
#include <string>
#include <variant>
#include <vector>

namespace lissom::lua {

/// Values that a parameter accepts in Lua, and their type in a function body (see Call).
enum class Kind {
    /// true or false.
    boolean,
    /// A number without a fraction, as int.
    integer,
    /// A finite number, as double.
    number,
    /// A string.
    string,
    /// One of the strings in `choices`; read as its place among them, from 0.
    choice,
    /// Id of a vertex, face, ...: an integer from 1; read 0-based.
    id,
    /// {x, y, z}. A positional argument may also be three numbers in a row.
    vector,
    /// One number for all axes or {x, y, z}.
    factors,
    /// "x", "-y", ... or a vector with a length.
    axis,
    /// Rows {{...}, ...} of a 4 x 4 matrix whose last row is {0, 0, 0, 1}.
    affine,
    /// Rows of a 3 x 3 matrix.
    matrix3,
    /// Memory of the host, as light userdata; read as void*.
    address,
    /// A list of ids; read 0-based.
    ids,
    /// A list of lists of ids; read 0-based.
    id_lists,
    /// A list of vectors.
    points,
    /// A list of {x, y}.
    pixels,
    /// A list of finite numbers.
    numbers,
    /// A list of integers.
    integers,
    /// A list of strings.
    strings,
    /// An object of the type `type_name`.
    object,
    /// A list of objects of the type `type_name`.
    objects,
    /// A function; `type_name` holds its signature for editors, "fun(i: integer): boolean".
    function,
    /// A table with the keys `fields`; any other key is an error.
    options,
    /// A table of tables, each under a name and with the keys `fields`; read with
    /// Call::select_item.
    option_map,
    /// A list of tables with the keys `fields`; read with Call::select_item.
    option_list,
    /// A table whose content the function reads itself.
    table,
    /// One of `alternatives`, told apart by the Lua type of the value.
    either,
    /// {x, y, z}; some, but not all, may be nil or infinite; nil is read as NaN.
    open_vector,
};

/// One argument or option. Make one with a function below and refine it with the methods, which
/// return the parameter:
///
///     integer("iterations", "Number of passes.").defaults(10).between(0, 1000)
///     number("angle", "Angle of the rotation.").in("degrees")
///     options("sphere", {vector("center", "..."), number("radius", "...").above(0)},
///     "...").optional()
struct Parameter {
    std::string name;
    Kind kind = Kind::boolean;
    /// Its meaning; a sentence for the reference.
    std::string help;
    bool required = true;
    /// Value if the script gives none; a choice has its string.
    std::variant<std::monostate, bool, double, std::string> default_value;
    /// Text for the reference if the default is not a plain value.
    std::string default_text;
    /// Default with fidelity = "thesis" if that is another, and the section of the thesis.
    std::string thesis_text, thesis_section;
    double min = -std::numeric_limits<double>::infinity();
    double max = std::numeric_limits<double>::infinity();
    bool above_min = false;
    bool infinite = false;
    bool flag = false;
    std::string unit;
    std::vector<std::string> choices;
    std::string type_name;
    std::vector<Parameter> fields;
    std::vector<Parameter> alternatives;
    /// Names that other programs have for it: an error about one of them suggests this one.
    std::vector<std::string> other_names;

    /// May be left out; `has` then tells.
    Parameter optional(std::string text = {}) const;
    /// May be left out and then has this value.
    Parameter defaults(bool value) const;
    Parameter defaults(int value) const;
    Parameter defaults(double value) const;
    Parameter defaults(const char* value) const;
    /// Range of a number or integer, both ends included.
    Parameter between(double low, double high) const;
    Parameter at_least(double low) const;
    /// Greater than `low`, which is excluded.
    Parameter above(double low) const;
    /// Infinite numbers are allowed too (never NaN).
    Parameter or_infinite() const;
    /// A table of options may also be `true`, with the defaults of all fields, or `false`, which
    /// counts as left out. Read with `kind`: Kind::boolean then.
    Parameter or_true() const;
    /// With fidelity = "thesis" the default is this, from that section of the thesis: for the
    /// reference, and its table of differences from the thesis.
    Parameter thesis(std::string section, std::string text) const;
    /// Unit, for the reference: "degrees", "mesh units", ...
    Parameter in(std::string name_of_unit) const;
    /// Sets `other_names`.
    Parameter elsewhere(std::vector<std::string> names) const;
};

Parameter boolean(std::string name, std::string help);
Parameter integer(std::string name, std::string help);
Parameter number(std::string name, std::string help);
Parameter string(std::string name, std::string help);
Parameter choice(std::string name, std::vector<std::string> choices, std::string help);
Parameter id(std::string name, std::string help);
Parameter vector(std::string name, std::string help);
Parameter open_vector(std::string name, std::string help);
Parameter factors(std::string name, std::string help);
Parameter axis(std::string name, std::string help);
Parameter affine(std::string name, std::string help);
Parameter matrix3(std::string name, std::string help);
Parameter address(std::string name, std::string help);
Parameter ids(std::string name, std::string help);
Parameter id_lists(std::string name, std::string help);
Parameter points(std::string name, std::string help);
Parameter pixels(std::string name, std::string help);
Parameter numbers(std::string name, std::string help);
Parameter integers(std::string name, std::string help);
Parameter strings(std::string name, std::string help);
/// `type_name` with its prefix: "lissom.Mesh".
Parameter object(std::string name, std::string type_name, std::string help);
Parameter objects(std::string name, std::string type_name, std::string help);
Parameter function(std::string name, std::string signature, std::string help);
Parameter options(std::string name, std::vector<Parameter> fields, std::string help);
Parameter option_map(std::string name, std::vector<Parameter> fields, std::string help);
Parameter option_list(std::string name, std::vector<Parameter> fields, std::string help);
Parameter table(std::string name, std::string help);
/// Alternatives must differ in Lua type, kind or object type: a number, a string, a list, a type
/// each.
Parameter either(std::string name, std::vector<Parameter> alternatives, std::string help);

}  // namespace lissom::lua
