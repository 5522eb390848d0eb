#include "kernel/io/off/off.h"

#include <optional>

#include "kernel/io/off/builder.h"
#include "kernel/io/stream/text_reader.h"

namespace lissom {
namespace {

constexpr TextReader::Style kStyle{.comment = '#', .continuation = false};

bool begins_number(std::string_view word) {
    return (word[0] >= '0' && word[0] <= '9') || word[0] == '-' || word[0] == '+';
}

// Parses the keyword: [ST][C][N][4][n]OFF.
std::optional<OffLayout> parse_keyword(std::string_view word, FilePlace place) {
    if (!word.ends_with("OFF")) return std::nullopt;
    OffLayout layout;
    for (std::string_view prefix = word.substr(0, word.size() - 3); !prefix.empty();) {
        if (prefix.starts_with("ST")) {
            layout.uvs = true;
            prefix.remove_prefix(1);
        } else if (prefix[0] == 'C') {
            layout.colors = true;
        } else if (prefix[0] == 'N') {
            layout.normals = true;
        } else if (prefix[0] == '4' || prefix[0] == 'n') {
            refuse(ErrorCode::unsupported,
                   "points of " + in_quotes(word) +
                       " have other than three coordinates; convert it to OFF",
                   place);
        } else {
            return std::nullopt;
        }
        prefix.remove_prefix(1);
    }
    return layout;
}

}  // namespace

MeshData read_off(std::string_view bytes, const Context& context) {
    const TextReader start(bytes, kStyle);
    TextReader text = start;
    text.tally.elements = "keywords";
    const std::string_view keyword = text.next_word();
    const std::optional<OffLayout> layout = parse_keyword(keyword, text.place());
    if (!layout) {
        if (!begins_number(keyword)) {
            refuse(ErrorCode::file_syntax,
                   "expected the keyword 'OFF', found " + in_quotes(keyword), text.place());
        }
        return read_off_text(start, bytes.size(), {}, context);
    }
    TextReader ahead = text;
    if (ahead.word() != "BINARY") return read_off_text(text, bytes.size(), *layout, context);
    ahead.skip_line();
    return read_off_binary(bytes.substr(ahead.offset()), *layout, context);
}

}  // namespace lissom
