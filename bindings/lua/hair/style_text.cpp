// Styles as text in memory.
#include <memory>
#include <string>

#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/hair/hair_object.h"
#include "kernel/io/style_file.h"

namespace lissom::lua {
namespace {

int push_style_text(Call& call) {
    const auto style = call.self<HairstyleObject>();
    auto& text = call.hold<std::string>();
    if (!call.attempt([&] { text = encode_style(content_of(style->style())); })) return call.fail();
    return call.push(std::string_view(text));
}

int read_style_text(Call& call) {
    const std::string_view text = call.string("text");
    const bool has_scalp = call.has("scalp");
    const auto head = call.object<MeshObject>("head");
    const auto result = call.create<HairstyleObject>();
    const bool done = call.attempt([&] {
        const StyleContent content = decode_style(text);
        const auto mesh = head.share();
        const auto scalp =
            has_scalp ? call.object<ScalpObject>("scalp")->scalp
                      : std::make_shared<const Scalp>(mesh->mesh, ScalpOptions{}, call.context());
        result.set(std::make_shared<HairstyleObject>(
            mesh, make_style(content, mesh->mesh, scalp, call.context())));
    });
    if (!done) return call.fail();
    call.remember(result.get());
    call.charge(result);
    return 1;
}

}  // namespace

Function style_text_method() {
    return {.name = "text",
            .body = push_style_text,
            .summary = "The text of its file, as `save` writes it. See `lissom.read_style`.",
            .results = {{"string", "text", "JSON."}},
            .errors = {ErrorCode::handle_removed, ErrorCode::memory_limit},
            .example = kStyle + "assert(style:text():find('\"stream\"'))"};
}

Function read_style_function() {
    return {.name = "read_style",
            .body = read_style_text,
            .summary = "Makes a style of the text of a style file.",
            .arguments = {string("text", "JSON, as style:text gives it."),
                          object("head", "lissom.Mesh", "The head that it goes on.")},
            .options = {object("scalp", "lissom.Scalp", "The scalp.").optional("guessed")},
            .results = {{"lissom.Hairstyle", "style", "The hairstyle."}},
            .errors = {ErrorCode::file_syntax, ErrorCode::unsupported, ErrorCode::invalid_argument,
                       ErrorCode::out_of_range, ErrorCode::mesh_empty, ErrorCode::memory_limit,
                       ErrorCode::cancelled},
            .example = kStyle +
                       "local copy = lissom.read_style(style:text(), head)\n"
                       "assert(copy:text() == style:text())"};
}

}  // namespace lissom::lua
