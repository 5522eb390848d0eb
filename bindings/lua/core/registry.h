/// The registration table: one description of everything that scripts can call. The binding, its
/// argument checks, the editor annotations (meta/lissom.lua), the reference (docs/lua) and
/// the tests of all examples are made from it.
///
/// A library describes its functions and types as a `Library`, which a `Registry` of a state takes:
///
///     Library viewer_library() {
///         Library library{.name = "viewer"};
///         library.functions.push_back({.name = "render",
///                                      .body = render,
///                                      .summary = "Draws a picture.",
/// .options = {string("file", "The file to write."), ...},
///                                      .results = {{"boolean", "done", "true"}},
///                                      .errors = {ErrorCode::no_display},
///                                      .example = "lissom.render{ file = 'a.png' }"});
///         return library;
///     }
///     registry.add(viewer_library());
///
/// A body reads its arguments through Call (call.h), in four steps that are described there.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bindings/lua/core/parameter.h"
#include "kernel/core/error.h"

namespace lissom::lua {

class Call;

/// Effect of a call on its object, or of a function of the module on its arguments, for journals.
enum class Effect {
    /// Changes the object that it returns.
    by_result,
    /// Changes it, and returns something else.
    changes,
    /// Changes it to a state that does not depend on earlier calls of the method for the same part.
    replaces,
    /// Changes an object that is in no scene.
    shapes,
    /// Concerns steps and files of a scene, not its content.
    unheard
};

/// A function that a script calls: reads `call`, works, pushes results and returns their number.
using Body = int (*)(Call& call);

/// One result of a function. `type` is a LuaCATS type: "number", "integer[]", "lissom.Mesh", ...
struct Result {
    std::string type;
    std::string name;
    std::string help;
};

/// A function of the module or a method of a type.
struct Function {
    /// Name below the module or type; "shapes.box" is a function of the table lissom.shapes.
    std::string name = {};
    Body body = nullptr;
    std::string summary = {};
    /// Arguments by position, without the object of a method.
    std::vector<Parameter> arguments = {};
    /// Arguments may also be given by name among the options: `handle:rotate{ axis = "z", angle =
    /// 60 }` for `handle:rotate("z", 60)`.
    bool named_arguments = false;
    /// Any values may follow the arguments; the body reads them from the stack.
    bool more_arguments = false;
    /// Keys of the option table that follows them. It may be left out if no key is required, and
    /// may stand in the place of an optional argument that is left out.
    std::vector<Parameter> options = {};
    /// Exactly one of the options, or the optional argument, must be given: they are alternatives.
    bool one_option = false;
    std::vector<Result> results = {};
    Effect effect = Effect::by_result;
    /// Codes that the function may end with beside bad arguments.
    std::vector<ErrorCode> errors = {};
    /// A script that runs by itself; `lissom` is the module. Tests run every one.
    std::string example = {};
};

/// A metamethod of a type. Its body reads raw stack slots; nothing is checked beforehand but that
/// the first operand, or for "__eq" both, is an open object of the type.
struct Operator {
    /// "__len", "__tostring", "__eq", "__index", "__newindex", "__pairs". An "__index" is asked
    /// before methods, and pushes nothing (returns 0) if it leaves the key to them.
    std::string name = {};
    Body body = nullptr;
    /// Its form in a script, and its meaning: "#mesh", "number of vertices".
    std::string usage = {};
    std::string help = {};
};

/// A type of object. Objects are shared: a C++ struct T with `static constexpr const char*
/// kTypeName` held by std::shared_ptr in a userdata. `close`, `__gc`, `__close` and `__name` come
/// by themselves.
struct Type {
    /// With its prefix: "lissom.Mesh".
    std::string name = {};
    std::string summary = {};
    std::vector<Function> methods = {};
    std::vector<Operator> operators = {};
    /// Fields that its "__index" answers beside methods, for the reference and for errors.
    std::vector<Result> fields = {};
    /// Frees the contents of the object at once, although others may still share it; may be null.
    /// Must not throw, and must leave an object that its own methods refuse (see Call::self).
    void (*close)(void* object) = nullptr;
    /// Whether journals tell its calls; false for an object of the hand alone.
    bool is_heard = true;
};

/// A plain table that functions return, described for editors.
struct Record {
    std::string name = {};
    std::string summary = {};
    std::vector<Result> fields = {};
};

/// A constant of the module: a string.
struct Constant {
    std::string name = {};
    std::string value = {};
    std::string help = {};
};

/// Functions and types of one library. Each has its own annotation file and reference page.
struct Library {
    std::string name = {};
    std::string summary = {};
    std::vector<Constant> constants = {};
    std::vector<Function> functions = {};
    std::vector<Type> types = {};
    std::vector<Record> records = {};
};

/// A function with the data that calls need at hand: its place and the flat list of its values.
struct Entry {
    /// One value that a call reads: a positional argument, an option ("sphere") or a field of an
    /// option ("sphere.radius").
    struct Slot {
        std::string path;
        const Parameter* parameter;
        /// For an option table, the slots of its fields are [first, last).
        int first = 0, last = 0;
    };

    const Function* function = nullptr;
    /// The type of a method; null for a function of the module.
    const Type* type = nullptr;
    std::vector<Slot> slots;
    /// Slots of the positional arguments are [0, arguments), those of the option table's keys
    /// [options_first, options_last).
    int arguments = 0, options_first = 0, options_last = 0;

    /// Most slots that one function may have.
    static constexpr int kMaximumSlots = 64;
};

/// All libraries of a state; immutable once a state was opened with it, and shared by states.
class Registry {
  public:
    Registry();
    ~Registry();
    Registry(Registry&&) noexcept;
    Registry& operator=(Registry&&) noexcept;

    /// Adds a library. Throws std::logic_error if a name is taken or a description is inconsistent:
    /// mistakes of the programmer, which a test finds.
    void add(Library library);

    const std::vector<std::unique_ptr<const Library>>& libraries() const { return libraries_; }
    const std::vector<std::unique_ptr<const Entry>>& entries() const { return entries_; }
    /// The type called `name` with its prefix, or null.
    const Type* find_type(const std::string& name) const;

  private:
    void add_entry(const Function& function, const Type* type);

    std::vector<std::unique_ptr<const Library>> libraries_;
    std::vector<std::unique_ptr<const Entry>> entries_;
};

/// Returns the library of the kernel: everything described in this folder.
Library kernel_library();

/// A registry with the kernel's library.
Registry kernel_registry();

/// Returns the variable name of a type in examples: "mesh" for lissom.Mesh.
std::string variable_name(const Type& type);

}  // namespace lissom::lua
