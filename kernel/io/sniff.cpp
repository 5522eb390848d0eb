#include "kernel/io/sniff.h"

#include <algorithm>
#include <array>

#include "kernel/io/stl/stl.h"
#include "kernel/io/stream/text_reader.h"
#include "kernel/io/stream/words.h"

namespace lissom {
namespace {

bool is_off_keyword(std::string_view word) {
    constexpr std::array<std::string_view, 10> kKeywords{
        "OFF", "COFF", "NOFF", "CNOFF", "NCOFF", "STOFF", "STCOFF", "STNOFF", "STCNOFF", "4OFF"};
    return is_one_of(word, kKeywords);
}

bool is_obj_keyword(std::string_view word) {
    constexpr std::array<std::string_view, 7> kKeywords{"v", "vt",     "vn",    "f",
                                                        "o", "mtllib", "usemtl"};
    return is_one_of(word, kKeywords);
}

// JSON with the one member that glTF demands.
bool is_gltf_text(std::string_view bytes) {
    const std::size_t first = bytes.find_first_not_of(" \t\r\n");
    return first != std::string_view::npos && bytes[first] == '{' &&
           bytes.find("\"asset\"") != std::string_view::npos;
}

}  // namespace

std::string_view sniff_format(std::string_view bytes) {
    if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r")) return "PLY";
    if (bytes.starts_with("glTF") || is_gltf_text(bytes)) return "glTF";
    if (is_binary_stl(bytes)) return "STL";
    TextReader text(bytes, {.comment = '#', .continuation = false});
    const std::string_view first = text.at_end() ? "" : text.word();
    if (is_off_keyword(first)) return "OFF";
    if (first == "solid") {
        text.skip_line();
        return !text.at_end() && text.word() == "facet" ? "STL" : "";
    }
    return is_obj_keyword(first) && !text.word().empty() ? "OBJ" : "";
}

}  // namespace lissom
