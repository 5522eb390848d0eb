#include "kernel/io/obj/mtl.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "kernel/core/numbers/number_text.h"
#include "kernel/io/stream/text_reader.h"
#include "kernel/io/stream/text_writer.h"
#include "kernel/io/stream/words.h"

namespace lissom {
namespace {

// Statements that an MtlMaterial has members for.
constexpr std::array<std::string_view, 11> kMtlStatements{
    "newmtl", "Kd", "Ke", "d", "Tr", "Pm", "Pr", "Ns", "map_Kd", "map_Ke", "norm"};

std::optional<double> finite_number(std::string_view word) {
    double value = 0.0;
    const auto [end, error] = read_number(word.data(), word.data() + word.size(), value);
    const bool good = error == std::errc() && end == word.data() + word.size();
    return good && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

// Statements that are not understood are passed over, as other readers of the format do.
class LibraryReader {
  public:
    explicit LibraryReader(std::string_view text)
        : text_(text, {.comment = '#', .continuation = true}) {}

    std::vector<MtlMaterial> read() {
        for (; !text_.at_end(); text_.skip_line()) read_statement(text_.word());
        return std::move(materials_);
    }

  private:
    void read_statement(std::string_view keyword) {
        if (keyword == "newmtl") {
            materials_.emplace_back().name = text_.rest_of_line();
            return;
        }
        if (materials_.empty()) return;
        MtlMaterial& m = materials_.back();
        if (keyword == "Kd") return read_color(m.diffuse);
        if (keyword == "Ke") return read_color(m.emissive);
        if (keyword == "map_Kd") return read_file_name(m.diffuse_map);
        if (keyword == "map_Ke") return read_file_name(m.emissive_map);
        if (keyword == "norm") return read_file_name(m.normal_map);
        if (!read_number(keyword, m)) keep(keyword, m);
    }

    bool read_number(std::string_view keyword, MtlMaterial& m) {
        if (keyword == "d") {
            read_share(m.opacity);
        } else if (keyword == "Tr") {
            if (read_share(m.opacity)) m.opacity = 1.0 - m.opacity;
        } else if (keyword == "Pm") {
            read_share(m.metalness);
        } else if (keyword == "Pr") {
            m.roughness = share();
        } else if (keyword == "Ns") {
            m.shininess = finite_number(text_.word());
        } else {
            return false;
        }
        return true;
    }

    void keep(std::string_view keyword, MtlMaterial& m) {
        const std::string line = std::string(keyword) + " " + std::string(text_.rest_of_line());
        if (is_other_mtl_statement(line)) m.others.push_back(line);
    }

    std::optional<double> share() {
        const std::optional<double> value = finite_number(text_.word());
        return value ? std::optional(std::clamp(*value, 0.0, 1.0)) : std::nullopt;
    }

    bool read_share(double& target) {
        const std::optional<double> value = share();
        if (value) target = *value;
        return value.has_value();
    }

    // One number stands for all three.
    void read_color(std::array<double, 3>& color) {
        const std::optional<double> r = share();
        if (!r) return;
        const std::optional<double> g = share(), b = share();
        color = {*r, g.value_or(*r), b.value_or(*r)};
    }

    // Reads the name after the options, such as "-s 1 1 1" and "-clamp on"; names may have blanks.
    void read_file_name(std::string& name) {
        std::string_view rest = text_.rest_of_line();
        while (rest.starts_with('-')) {
            const std::string_view option = take_word(rest);
            const bool has_numbers = option == "-o" || option == "-s" || option == "-t" ||
                                     option == "-mm" || option == "-bm" || option == "-boost" ||
                                     option == "-texres";
            if (!has_numbers) {
                take_word(rest);
                continue;
            }
            while (finite_number(rest.substr(0, rest.find_first_of(" \t")))) take_word(rest);
        }
        name = rest;
        std::replace(name.begin(), name.end(), '\\', '/');
    }

    static std::string_view take_word(std::string_view& text) {
        const std::size_t end = std::min(text.find_first_of(" \t"), text.size());
        const std::string_view word = text.substr(0, end);
        text.remove_prefix(end);
        text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
        return word;
    }

    TextReader text_;
    std::vector<MtlMaterial> materials_;
};

void write_color(std::string_view keyword, const std::array<double, 3>& color, std::string& text) {
    text += keyword;
    append_numbers(text, color);
    text += '\n';
}

void write_mtl_number(std::string_view keyword, std::optional<double> value, std::string& text) {
    if (!value) return;
    text += std::string(keyword) + ' ';
    append_number(text, *value);
    text += '\n';
}

void write_file_name(std::string_view keyword, const std::string& name, std::string& text) {
    if (!name.empty()) text += std::string(keyword) + ' ' + one_line(name) + '\n';
}

}  // namespace

bool is_other_mtl_statement(std::string_view line) {
    const std::string_view keyword = line.substr(0, line.find_first_of(" \t"));
    const auto is_letter = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '_';
    };
    const auto is_printable = [](char c) { return static_cast<unsigned char>(c) >= 0x20; };
    return !keyword.empty() && keyword.size() < line.size() &&
           std::all_of(keyword.begin(), keyword.end(), is_letter) &&
           std::all_of(line.begin(), line.end(), is_printable) && !line.ends_with('\\') &&
           !is_one_of(keyword, kMtlStatements);
}

bool names_file(std::string_view statement) {
    constexpr std::array<std::string_view, 4> kOthers{"bump", "disp", "decal", "refl"};
    return statement.starts_with("map_") ||
           is_one_of(statement.substr(0, statement.find(' ')), kOthers);
}

std::vector<MtlMaterial> read_mtl(std::string_view text) {
    return LibraryReader(text).read();
}

void write_mtl(const MtlMaterial& material, std::string& text) {
    text += "newmtl " + one_line(material.name) + "\n";
    write_color("Kd", material.diffuse, text);
    if (material.emissive != std::array<double, 3>{}) write_color("Ke", material.emissive, text);
    if (material.opacity != 1.0) write_mtl_number("d", material.opacity, text);
    write_mtl_number("Ns", material.shininess, text);
    write_mtl_number("Pr", material.roughness, text);
    write_mtl_number("Pm", material.metalness, text);
    write_file_name("map_Kd", material.diffuse_map, text);
    write_file_name("map_Ke", material.emissive_map, text);
    write_file_name("norm", material.normal_map, text);
    for (const std::string& line : material.others) text += line + "\n";
}

}  // namespace lissom
