#include "kernel/io/obj/strands.h"

#include <span>

#include "kernel/io/stream/text_writer.h"
#include "kernel/io/stream/ticker.h"

namespace lissom {
namespace {

std::string group_statement(const Strands& strands, Index group) {
    if (group == kNoIndex) return "g\n";
    return "g " + one_line(strands.group_names()[group]) + "\n";
}

}  // namespace

void write_obj_strands(const Strands& strands, std::string& bytes, const Context& context) {
    Progress progress(context, "write strands");
    Ticker ticker(progress);
    const std::size_t count = strands.point_count();
    bytes.reserve(45 * count + 100);
    bytes += "# " + std::to_string(strands.size()) + " strands of hair\n";
    for (std::size_t p = 0; p < count; ++p) {
        ticker.tick([&] { return 0.8 * double(p) / double(count); });
        bytes += 'v';
        append_numbers(bytes, strands.points().subspan(3 * p, 3));
        bytes += '\n';
    }
    Index group = kNoIndex;
    for (Index s = 0; s < strands.size(); ++s) {
        ticker.tick([&] { return 0.8 + 0.2 * double(s) / double(strands.size()); });
        if (strands.group(s) != group) {
            group = strands.group(s);
            bytes += group_statement(strands, group);
        }
        bytes += 'l';
        for (Index k = 1; k <= strands.point_count(s); ++k) {
            bytes += ' ';
            append_number(bytes, strands.first_point(s) + k);
        }
        bytes += '\n';
    }
}

}  // namespace lissom
