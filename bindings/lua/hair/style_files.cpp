// Hairstyles are made, saved and loaded.
#include <filesystem>
#include <string>

#include "bindings/lua/core/file_path.h"
#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/core/parse/expectation.h"
#include "bindings/lua/hair/hair_object.h"
#include "kernel/io/mesh_file.h"
#include "kernel/io/stream/file.h"
#include "kernel/io/stream/file_error.h"
#include "kernel/io/style_file.h"

namespace lissom::lua {
namespace {

// ---- lissom.hairstyle

HairstyleOptions style_options(const Call& call) {
    const bool thesis = call.integer("fidelity") == 1;
    HairstyleOptions options =
        style_options_with(thesis ? HairFidelity::thesis : HairFidelity::lissom);
    options.resolution = call.integer("resolution");
    if (call.has("volume"))
        options.volume = Box{call.vector("volume.min"), call.vector("volume.max")};
    options.field.solver = call.choice<GridSolver>("solver");
    if (call.has("boundary")) options.field.boundary = call.choice<GridBoundary>("boundary");
    if (call.has("tension")) options.field.tension = call.number("tension");
    if (call.has("gravity")) options.gravity = call.number("gravity");
    return options;
}

int make_hairstyle(Call& call) {
    const auto head = call.object<MeshObject>("head");
    const auto result = call.create<HairstyleObject>();
    const bool done = call.attempt([&] {
        const HairstyleOptions options = style_options(call);
        const auto scalp = call.has("scalp") ? call.object<ScalpObject>("scalp")->scalp
                                             : std::make_shared<const Scalp>(
                                                   head->mesh, ScalpOptions{}, call.context());
        Hairstyle style(head->mesh, scalp, options, call.context());
        result.set(std::make_shared<HairstyleObject>(head.share(), std::move(style)));
    });
    if (!done) return call.fail();
    call.remember(result.get());
    call.charge(result);
    return 1;
}

// ---- Files

int save_style(Call& call) {
    const auto style = call.self<HairstyleObject>();
    const char* path = call.string("path");
    const char* head = call.has("head") ? call.string("head") : "";
    const bool done = call.attempt([&] {
        lissom::save_style(content_of(style->style(), head), call.file(path, FileUse::write),
                           call.context());
    });
    return done ? call.push_argument() : call.fail();
}

// The head that a style names, relative paths beside the style's file.
std::shared_ptr<MeshObject> named_head(const Call& call, const std::filesystem::path& style,
                                       const StyleContent& content) {
    if (content.head.empty()) {
        throw Error(ErrorCode::invalid_argument,
                    display_name(style) + ": the style names no head; give one");
    }
    return std::make_shared<MeshObject>(load_mesh(
        call.file(display_name(style.parent_path() / file_path(content.head)), FileUse::read), {},
        call.context()));
}

bool refuses_a_value(ErrorCode code) {
    return code == ErrorCode::invalid_argument || code == ErrorCode::out_of_range ||
           code == ErrorCode::region_empty || code == ErrorCode::singular_transform;
}

// The hairstyle of a file. Values that no style can have are the file's mistake, not the script's.
Hairstyle style_of(const std::filesystem::path& path, const StyleContent& content, const Mesh& head,
                   const std::shared_ptr<const Scalp>& scalp, const Context& context) {
    try {
        return make_style(content, head, scalp, context);
    } catch (const Error& error) {
        if (!refuses_a_value(error.code())) throw;
        const std::string file = display_name(path);
        throw FileError(ErrorCode::file_syntax, file, file + ": " + error.message());
    }
}

int load_style(Call& call) {
    const std::string_view path = call.string("path");
    const bool has_head = call.has("head"), has_scalp = call.has("scalp");
    const auto head = call.object<MeshObject>("head");
    const auto result = call.create<HairstyleObject>();
    const bool done = call.attempt([&] {
        const std::filesystem::path file = call.file(path, FileUse::read);
        const StyleContent content = lissom::load_style(file, call.context());
        const auto mesh = has_head ? head.share() : named_head(call, file, content);
        const auto scalp =
            has_scalp ? call.object<ScalpObject>("scalp")->scalp
                      : std::make_shared<const Scalp>(mesh->mesh, ScalpOptions{}, call.context());
        result.set(std::make_shared<HairstyleObject>(
            mesh, style_of(file, content, mesh->mesh, scalp, call.context())));
    });
    if (!done) return call.fail();
    call.remember(result.get());
    call.charge(result);
    return 1;
}

// ---- Descriptions

std::vector<Parameter> style_fields() {
    return {
        object("scalp", "lissom.Scalp", "The scalp.").optional("guessed"),
        integer("resolution",
                "Grid points of the field. 25,000 do for smooth styles, 50,000 for ponytails.")
            .defaults(index_of(HairstyleOptions{}.resolution))
            .between(kMinimumResolution, kMaximumResolution),
        options("volume", {vector("min", "A corner."), vector("max", "The opposite corner.")},
                "A box in metres of an average head, around the center of its frame: x to its "
                "left, y up, z to the front. Hair ends at its faces.")
            .optional("around the head, down to the chest"),
        choice("solver", {"dual", "cholesky"},
               "dual is fast; cholesky is the thesis's way, a reference: it updates its factor, "
               "or makes it again in a build without CHOLMOD.")
            .defaults("dual"),
        choice("boundary", {"zero_flux", "thesis"}, "Condition of the field at the box.")
            .optional("\"zero_flux\"")
            .thesis("4.4.1", "\"thesis\""),
        number("tension", "Keeps the field from growing far from the curves.")
            .optional(plain_number(HairField::default_options().tension))
            .thesis("4.4.1", "0")
            .at_least(0),
        number("gravity",
               "Hair that no curve is near falls along the head, goes to the sides over the face, "
               "and to the nearest tie if there are ponytails; a stream that ends close to a tie "
               "leads into it, and from the end of any other hair falls on. 0: the curves alone "
               "determine all hair.")
            .optional(plain_number(HairstyleOptions{}.gravity))
            .thesis("4.4", "0")
            .between(0, 1),
        choice("fidelity", {"default", "thesis"},
               "thesis: chapter 4 to the letter, for comparison. It changes the defaults, also "
               "for the curves and for `grow`; the page thesis.md of the reference names all of "
               "it.")
            .defaults("default")};
}

}  // namespace

Function style_save_method() {
    return {.name = "save",
            .body = save_style,
            .summary =
                "Writes curves and options as JSON that people can read and edit, in metres "
                "of an average head. See `lissom.load_style`.",
            .arguments = {string("path", "The file.")},
            .options = {string("head",
                               "Path of the head's mesh as the file shall have it, best "
                               "beside it.")
                            .optional("none")},
            .results = {{"lissom.Hairstyle", "style", "The hairstyle itself."}},
            .errors = {ErrorCode::file_write_failed, ErrorCode::file_is_directory,
                       ErrorCode::handle_removed, ErrorCode::cancelled},
            .example = kStyle + "local path = os.tmpname()\nstyle:save(path)\nos.remove(path)"};
}

std::vector<Function> hairstyle_functions() {
    return {
        {.name = "load_style",
         .body = load_style,
         .summary = "Reads a style that `save` wrote.",
         .arguments = {string("path", "The JSON file."),
                       object("head", "lissom.Mesh", "The head that it goes on.")
                           .optional("the one that the file names, beside it")},
         .options = {object("scalp", "lissom.Scalp", "The scalp.").optional("guessed")},
         .results = {{"lissom.Hairstyle", "style", "The hairstyle."}},
         .errors = {ErrorCode::file_not_found, ErrorCode::file_is_directory, ErrorCode::file_empty,
                    ErrorCode::file_unreadable, ErrorCode::file_syntax, ErrorCode::unsupported,
                    ErrorCode::invalid_argument, ErrorCode::out_of_range, ErrorCode::mesh_empty,
                    ErrorCode::memory_limit, ErrorCode::cancelled},
         .example = kStyle + R"(local path = os.tmpname()
style:save(path)
local copy = lissom.load_style(path, head)
assert(#copy:curves() == 1)
os.remove(path))"},
        {.name = "hairstyle",
         .body = make_hairstyle,
         .summary = "Starts a hairstyle without curves on a head.",
         .arguments = {object("head", "lissom.Mesh", "The head; its shape is copied.")},
         .options = style_fields(),
         .results = {{"lissom.Hairstyle", "style", "The hairstyle."}},
         .errors = {ErrorCode::mesh_empty, ErrorCode::invalid_argument,
                    ErrorCode::topology_mismatch, ErrorCode::memory_limit, ErrorCode::cancelled},
         .example = kStyle}};
}

}  // namespace lissom::lua
