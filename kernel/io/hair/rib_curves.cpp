#include "kernel/io/hair/rib_curves.h"

#include <span>
#include <utility>
#include <vector>

#include "kernel/hair/strands/strand_measures.h"
#include "kernel/io/stream/text_writer.h"

namespace lissom {
namespace {

constexpr int kValuesInLine = 24;

class RibWriter {
  public:
    RibWriter(const Strands& strands, std::string& text, const Context& context)
        : strands_(strands), text_(text), context_(context) {}

    void write() {
        Progress progress(context_, "write strands");
        std::vector<std::vector<Index>> blocks(strands_.group_names().size() + 1);
        for (Index s = 0; s < strands_.size(); ++s) {
            const Index group = strands_.group(s);
            blocks[group == kNoIndex ? 0 : at(group) + 1].push_back(s);
        }
        for (std::size_t g = 0; g < blocks.size(); ++g) {
            progress.update(g, blocks.size());
            if (blocks[g].empty()) continue;
            write_block(blocks[g], g == 0 ? "hair" : strands_.group_names()[g - 1]);
        }
    }

  private:
    void write_block(const std::vector<Index>& list, std::string_view name) {
        text_ +=
            "AttributeBegin\nAttribute \"identifier\" \"string name\" [" + rib_text(name) + "]\n";
        const StrandValues<Eigen::Vector3f>* const colors = strands_.colors();
        if (colors && colors->domain == StrandDomain::all) {
            text_ += "Color [";
            append_numbers(text_, std::span(colors->common.data(), 3));
            text_ += " ]\n";
        }
        text_ += "Curves \"linear\" [";
        for_each(list, [&](Index s) { number(strands_.point_count(s)); });
        text_ += " ]\n\"nonperiodic\" \"P\" [";
        for_each(list, [&](Index s) {
            const StrandView strand = strands_.strand(s);
            for (Index i = 0; i < strand.size(); ++i) number(strand.data()[i]);
        });
        text_ += " ]\n";
        write_widths(list);
        if (colors && colors->domain != StrandDomain::all) write_colors(list, *colors);
        text_ += "AttributeEnd\n";
    }

    void write_widths(const std::vector<Index>& list) {
        const StrandWidths& widths = strands_.widths();
        if (widths.domain == StrandDomain::all && widths.profile.empty()) {
            text_ += "\"constantwidth\" [ ";
            append_number(text_, widths.common);
            text_ += " ]\n";
            return;
        }
        text_ += "\"width\" [";
        std::vector<float> one;
        for_each(list, [&](Index s) {
            widths_of(strands_, s, one);
            for (const float width : one) number(width);
        });
        text_ += " ]\n";
    }

    void write_colors(const std::vector<Index>& list, const StrandValues<Eigen::Vector3f>& colors) {
        const bool of_points = colors.domain == StrandDomain::point;
        text_ += of_points ? "\"varying color Cs\" [" : "\"uniform color Cs\" [";
        for_each(list, [&](Index s) {
            const Index first = strands_.first_point(s);
            for (Index k = 0; k < (of_points ? strands_.point_count(s) : 1); ++k) {
                for (const float x : colors.at(s, first + k)) number(x);
            }
        });
        text_ += " ]\n";
    }

    template <typename Visit>
    void for_each(const std::vector<Index>& list, const Visit& visit) {
        in_line_ = 0;
        for (std::size_t i = 0; i < list.size(); ++i) {
            if (i % 1024 == 0) context_.checkpoint();
            visit(list[i]);
        }
    }

    template <typename Number>
    void number(Number value) {
        text_ += in_line_ == kValuesInLine ? '\n' : ' ';
        in_line_ = in_line_ == kValuesInLine ? 1 : in_line_ + 1;
        append_number(text_, value);
    }

    const Strands& strands_;
    std::string& text_;
    const Context& context_;
    int in_line_ = 0;
};

}  // namespace

std::string rib_text(std::string_view text) {
    std::string result = "\"";
    for (const char c : one_line(text)) {
        if (c == '"' || c == '\\') result += '\\';
        result += c;
    }
    return result + '"';
}

void write_rib_curves(const Strands& strands, std::string& bytes, const Context& context) {
    bytes.reserve(bytes.size() + 40 * at(strands.point_count()) + 1000);
    RibWriter(strands, bytes, context).write();
}

}  // namespace lissom
