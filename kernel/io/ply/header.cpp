#include "kernel/io/ply/header.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "kernel/io/stream/percent.h"
#include "kernel/io/stream/read_error.h"
#include "kernel/io/stream/scalar.h"
#include "kernel/io/stream/text_reader.h"

namespace lissom {
namespace {

struct TypeName {
    std::string_view name, other_name;
    ScalarType type;
};

constexpr std::array<TypeName, 8> kTypes{{{"char", "int8", ScalarType::int8},
                                          {"uchar", "uint8", ScalarType::uint8},
                                          {"short", "int16", ScalarType::int16},
                                          {"ushort", "uint16", ScalarType::uint16},
                                          {"int", "int32", ScalarType::int32},
                                          {"uint", "uint32", ScalarType::uint32},
                                          {"float", "float32", ScalarType::float32},
                                          {"double", "float64", ScalarType::float64}}};

std::string_view type_name(ScalarType type) {
    return std::find_if(kTypes.begin(), kTypes.end(),
                        [&](const TypeName& t) { return t.type == type; })
        ->name;
}

// More elements or properties than any program writes, and few enough to look for one among all.
constexpr std::size_t kMaximumDeclarations = 10000;

constexpr std::size_t kMaximumTextures = 1000;

class HeaderReader {
  public:
    explicit HeaderReader(std::string_view bytes) : bytes_(bytes), text_(bytes, {}) {
        text_.tally.elements = "lines, before the header has an end";
    }

    PlyHeader read() {
        if (text_.word() != "ply") refuse_here("the file does not begin with 'ply'");
        text_.rest_of_line();
        lone_returns_ = text_.peek() == '\r' && !at_return_and_feed();
        for (next_line(); text_.remaining() > 0; next_line()) {
            const std::string_view keyword = text_.word();
            if (keyword == "end_header") return finished();
            read_line(keyword);
        }
        refuse_truncated(text_.tally);
    }

  private:
    void next_line() {
        text_.skip_line();
        text_.tally.found = text_.line();
    }

    void read_line(std::string_view keyword) {
        if (keyword == "format") return read_format();
        if (keyword == "element") return read_element();
        if (keyword == "property") return read_property();
        if (keyword == "comment") return read_comment();
        if (keyword.empty() || keyword == "obj_info") return;
        refuse_here("expected a line of a PLY header, found " + in_quotes(keyword));
    }

    void read_format() {
        const std::string_view format = text_.word();
        has_format_ = true;
        header_.binary = format != "ascii";
        if (format == "ascii" || format == "binary_little_endian") return;
        header_.endianness = Endianness::big;
        if (format == "binary_big_endian") return;
        refuse_here("unknown PLY format " + in_quotes(format) +
                    "; known are ascii, binary_little_endian and binary_big_endian");
    }

    // Comments of other programs, and malformed ones, mean nothing.
    void read_comment() {
        const std::string_view kind = text_.word();
        if (kind == "lissom_mtllib") {
            header_.material_libraries.push_back(percent_decoded(text_.word()));
        } else if (kind == "TextureFile" && header_.texture_files.size() < kMaximumTextures) {
            header_.texture_files.emplace_back(text_.rest_of_line());
        } else if (kind == "lissom") {
            read_label_name();
        }
    }

    void read_label_name() {
        const std::string kind = percent_decoded(text_.word());
        std::vector<std::string>& names = header_.label_names[kind];
        if (text_.word() == std::to_string(names.size())) {
            names.push_back(percent_decoded(text_.word()));
        }
    }

    void count_declaration() {
        if (++declarations_ > kMaximumDeclarations) {
            refuse_here("the header declares more than " + std::to_string(kMaximumDeclarations) +
                        " elements and properties");
        }
    }

    void read_element() {
        count_declaration();
        PlyElement element;
        element.name = text_.word();
        const auto same_name = [&](const PlyElement& e) { return e.name == element.name; };
        if (std::any_of(header_.elements.begin(), header_.elements.end(), same_name)) {
            refuse_here("the element " + in_quotes(element.name) + " is declared twice");
        }
        element.count = checked_count(text_.integer(), bytes_.size(),
                                      "elements of " + in_quotes(element.name), text_.place());
        header_.elements.push_back(std::move(element));
    }

    void read_property() {
        count_declaration();
        if (header_.elements.empty()) refuse_here("a property stands before the first element");
        PlyProperty property;
        std::string_view type = text_.word();
        if (type == "list") {
            property.is_list = true;
            property.count_type = read_type(text_.word());
            type = text_.word();
        }
        property.type = read_type(type);
        property.name = text_.rest_of_line();
        if (property.name.empty()) refuse_here("a property has no name");
        header_.elements.back().properties.push_back(std::move(property));
    }

    ScalarType read_type(std::string_view name) {
        for (const TypeName& t : kTypes) {
            if (name == t.name || name == t.other_name) return t.type;
        }
        refuse_here("unknown number type " + in_quotes(name));
    }

    bool at_return_and_feed() const { return bytes_.substr(text_.offset()).starts_with("\r\n"); }

    // Binary data may begin with the byte of a line feed, which then is no part of the line end:
    // lines that end with a lone return are told by the first of them.
    PlyHeader finished() {
        if (!has_format_) refuse_here("the header has no line 'format'");
        text_.rest_of_line();
        const std::size_t line_end = at_return_and_feed() && !lone_returns_ ? 2 : 1;
        header_.size = std::min(text_.offset() + line_end, bytes_.size());
        header_.lines = text_.line() + 1;
        return std::move(header_);
    }

    [[noreturn]] void refuse_here(const std::string& message) {
        refuse(ErrorCode::file_syntax, message, text_.place());
    }

    std::string_view bytes_;
    TextReader text_;
    PlyHeader header_;
    std::size_t declarations_ = 0;
    bool has_format_ = false;
    bool lone_returns_ = false;
};

}  // namespace

Index PlyElement::find(std::string_view property) const {
    const auto found = std::find_if(properties.begin(), properties.end(),
                                    [&](const PlyProperty& p) { return p.name == property; });
    return found == properties.end() ? kNoIndex : index_of(found - properties.begin());
}

std::size_t PlyElement::minimum_bytes(bool binary) const {
    constexpr std::size_t kDigitAndBlank = 2;
    std::size_t bytes = 0;
    for (const PlyProperty& p : properties) {
        bytes += binary ? size_of(p.is_list ? p.count_type : p.type) : kDigitAndBlank;
    }
    return bytes;
}

PlyHeader read_ply_header(std::string_view bytes) {
    return HeaderReader(bytes).read();
}

std::string to_text(const PlyHeader& header) {
    std::string text = "ply\nformat ";
    text += !header.binary                            ? "ascii"
            : header.endianness == Endianness::little ? "binary_little_endian"
                                                      : "binary_big_endian";
    text += " 1.0\ncomment Written by Lissom\n";
    for (const std::string& file : header.material_libraries) {
        text += "comment lissom_mtllib " + percent_encoded(file) + "\n";
    }
    for (const auto& [kind, names] : header.label_names) {
        const std::string start = "comment lissom " + percent_encoded(kind) + " ";
        for (std::size_t i = 0; i < names.size(); ++i) {
            text += start + std::to_string(i) + " " + percent_encoded(names[i]) + "\n";
        }
    }
    for (const PlyElement& element : header.elements) {
        text += "element " + element.name + " " + std::to_string(element.count) + "\n";
        for (const PlyProperty& p : element.properties) {
            text += "property ";
            if (p.is_list) text += "list " + std::string(type_name(p.count_type)) + " ";
            text += std::string(type_name(p.type)) + " " + p.name + "\n";
        }
    }
    return text + "end_header\n";
}

}  // namespace lissom
