#include "kernel/io/hair/cyhair.h"

#include <array>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "kernel/hair/strands/strand_measures.h"

namespace lissom {
namespace {

constexpr std::string_view kHairMagic = "HAIR";
constexpr std::size_t kHairHeaderBytes = 128, kTextBytes = 88;
constexpr Index kMaxSegments = 65535;

// Bits that say which arrays follow.
using ArrayBit = std::uint32_t;
constexpr ArrayBit kSegments = 1, kPoints = 2, kThickness = 4, kTransparency = 8, kColors = 16;

struct HairHeader {
    std::uint32_t strands = 0, points = 0, arrays = 0, segments = 0;
    float thickness = 0.0f, transparency = 0.0f;
    std::array<float, 3> color{};
    std::array<char, kTextBytes> text{};

    bool has(ArrayBit bit) const { return (arrays & bit) != 0; }
};

HairHeader read_header(ByteSource& source) {
    source.tally = {"bytes of the header", source.size(), kHairHeaderBytes};
    std::array<char, 4> magic{};
    source.require(magic.size());
    source.read(std::span<char>(magic));
    if (std::string_view(magic.data(), magic.size()) != kHairMagic) {
        refuse(ErrorCode::file_syntax, "this is not a .hair file: it does not begin with HAIR");
    }
    source.require(kHairHeaderBytes - magic.size());
    HairHeader header;
    for (auto* field : {&header.strands, &header.points, &header.arrays, &header.segments}) {
        *field = source.read<std::uint32_t>();
    }
    header.thickness = source.read<float>();
    header.transparency = source.read<float>();
    source.read(std::span<float>(header.color));
    source.read(std::span<char>(header.text));
    return header;
}

// Checks that the file has room for all it announces, before anything is made that large.
void require_room(const HairHeader& header, const ByteSource& source) {
    checked_count(header.points, source.size(), "points", {});
    checked_count(header.strands, source.size(), "strands", {});
    if (!header.has(kPoints)) {
        refuse(ErrorCode::unsupported, "the file has no array of points, which cannot be guessed");
    }
    const std::uint64_t numbers = std::uint64_t{3} + (header.has(kThickness) ? 1 : 0) +
                                  (header.has(kTransparency) ? 1 : 0) +
                                  (header.has(kColors) ? 3 : 0);
    const std::uint64_t needed = (header.has(kSegments) ? std::uint64_t{2} * header.strands : 0) +
                                 sizeof(float) * numbers * header.points;
    if (needed > source.remaining()) {
        refuse(ErrorCode::file_truncated,
               "the header announces " + std::to_string(needed) + " bytes of data, but only " +
                   std::to_string(source.remaining()) + " follow; copy or export it again");
    }
}

std::vector<Index> read_offsets(const HairHeader& header, ByteSource& source) {
    if (!header.has(kSegments) &&
        std::uint64_t{header.strands} * (std::uint64_t{header.segments} + 1) != header.points) {
        refuse(ErrorCode::file_syntax, std::to_string(header.strands) + " strands of " +
                                           std::to_string(header.segments) +
                                           " segments do not have the " +
                                           std::to_string(header.points) + " points announced");
    }
    std::vector<std::uint16_t> segments(header.has(kSegments) ? header.strands : 0);
    source.read(std::span(segments));
    std::vector<Index> offsets(std::size_t{header.strands} + 1, 0);
    std::uint64_t total = 0;
    for (std::size_t s = 0; s < header.strands; ++s) {
        total += std::uint64_t{header.has(kSegments) ? segments[s] : header.segments} + 1;
        if (total > header.points) {
            refuse(ErrorCode::file_syntax,
                   "strand " + std::to_string(s) + " goes beyond the " +
                       std::to_string(header.points) + " points announced",
                   {ElementKind::strand, s});
        }
        offsets[s + 1] = index_of(total);
    }
    if (total != header.points) {
        refuse(ErrorCode::file_syntax, "the strands have " + std::to_string(total) +
                                           " points together, but the header announces " +
                                           std::to_string(header.points));
    }
    return offsets;
}

std::vector<float> read_values(const HairHeader& header, std::size_t width, ByteSource& source,
                               const std::vector<Index>& offsets) {
    std::vector<float> values(width * header.points);
    source.read(std::span(values));
    require_finite(values, width, 0, offsets);
    return values;
}

void require_header_values(const HairHeader& header) {
    for (const float x : {header.thickness, header.transparency, header.color[0], header.color[1],
                          header.color[2]}) {
        if (x - x == 0.0f) continue;
        refuse(ErrorCode::not_finite, "a value in the header is NaN or infinite");
    }
}

void set_values(const HairHeader& header, ByteSource& source, Strands& strands) {
    const std::vector<Index> offsets(strands.offsets().begin(), strands.offsets().end());
    StrandWidths widths;
    widths.common = header.thickness;
    if (header.has(kThickness)) {
        widths.domain = StrandDomain::point;
        widths.values = read_values(header, 1, source, offsets);
    }
    strands.set_widths(std::move(widths));
    StrandValues<float> transparency{header.transparency};
    if (header.has(kTransparency)) {
        transparency.domain = StrandDomain::point;
        transparency.values = read_values(header, 1, source, offsets);
    }
    strands.set_transparency(std::move(transparency));
    StrandValues<Eigen::Vector3f> colors{Eigen::Vector3f(header.color.data())};
    // Missing colours are black.
    if (!header.has(kColors) && colors.common.isZero(0.0f)) return;
    if (header.has(kColors)) {
        colors.domain = StrandDomain::point;
        const std::vector<float> numbers = read_values(header, 3, source, offsets);
        colors.values.reserve(header.points);
        for (std::size_t i = 0; i < numbers.size(); i += 3) {
            colors.values.emplace_back(numbers.data() + i);
        }
    }
    strands.set_colors(std::move(colors));
}

void set_comment(const HairHeader& header, Strands& strands) {
    std::string text(header.text.data(), header.text.size());
    text.erase(text.find_last_not_of('\0') + 1);
    strands.set_comment(std::move(text));
}

// ---- writing ----

// Segments that all strands have, or 0 if they differ.
Index common_segments(const Strands& strands) {
    if (strands.empty()) return 0;
    const Index first = strands.point_count(0);
    for (Index s = 1; s < strands.size(); ++s) {
        if (strands.point_count(s) != first) return 0;
    }
    return first - 1;
}

void require_countable(const Strands& strands) {
    Elements beyond{ElementKind::strand, 0, {}};
    for (Index s = 0; s < strands.size(); ++s) {
        if (strands.point_count(s) - 1 > kMaxSegments) beyond.add(s);
    }
    if (beyond.count == 0) return;
    const std::string names = describe(beyond);
    throw Error(ErrorCode::file_too_large,
                names + ": more than 65,535 segments, which .hair cannot count; resample them",
                std::move(beyond));
}

std::uint32_t arrays_for(const Strands& strands, Index segments) {
    std::uint32_t arrays = kPoints;
    if (segments == 0 && !strands.empty()) arrays |= kSegments;
    const StrandWidths& widths = strands.widths();
    if (widths.domain != StrandDomain::all || !widths.profile.empty()) arrays |= kThickness;
    if (strands.transparency().domain != StrandDomain::all) arrays |= kTransparency;
    if (strands.colors() && strands.colors()->domain != StrandDomain::all) arrays |= kColors;
    return arrays;
}

void append_header(const Strands& strands, std::uint32_t arrays, Index segments,
                   std::string& bytes) {
    bytes += kHairMagic;
    append_little_endian(bytes, static_cast<std::uint32_t>(strands.size()));
    append_little_endian(bytes, static_cast<std::uint32_t>(strands.point_count()));
    append_little_endian(bytes, arrays);
    append_little_endian(bytes, static_cast<std::uint32_t>(segments));
    append_little_endian(bytes, strands.widths().common);
    append_little_endian(bytes, strands.transparency().common);
    const Eigen::Vector3f color =
        strands.colors() ? strands.colors()->common : Eigen::Vector3f::Zero();
    append_little_endian(bytes, std::span<const float>(color.data(), 3));
    std::string text = strands.comment().substr(0, kTextBytes);
    text.resize(kTextBytes, '\0');
    bytes += text;
}

void append_thickness(const Strands& strands, std::string& bytes) {
    std::vector<float> widths;
    for (Index s = 0; s < strands.size(); ++s) {
        widths_of(strands, s, widths);
        append_little_endian(bytes, std::span<const float>(widths));
    }
}

}  // namespace

Strands read_cyhair(ByteSource& source, const Context& context) {
    const HairHeader header = read_header(source);
    require_room(header, source);
    require_header_values(header);
    source.tally = {"strands", 0, header.strands};
    std::vector<Index> offsets = read_offsets(header, source);
    MemoryCharge charge = context.charge(source.remaining(), "reading strands");
    std::vector<float> points(std::size_t{3} * header.points);
    read_points(source, points, offsets, context);
    charge = {};
    Strands strands(std::move(points), std::move(offsets), context.memory());
    set_values(header, source, strands);
    set_comment(header, strands);
    if (source.remaining() > 0) {
        context.log(LogLevel::warning, std::to_string(source.remaining()) +
                                           " bytes after the last array were left out");
    }
    return strands;
}

void write_cyhair(const Strands& strands, std::string& bytes) {
    require_countable(strands);
    const Index segments = common_segments(strands);
    const std::uint32_t arrays = arrays_for(strands, segments);
    const auto has = [&](ArrayBit bit) { return (arrays & bit) != 0; };
    const std::size_t points = strands.point_count();
    bytes.reserve(kHairHeaderBytes + 2 * at(strands.size()) +
                  points * (12 + (has(kThickness) ? 4 : 0) + (has(kTransparency) ? 4 : 0) +
                            (has(kColors) ? 12 : 0)));
    append_header(strands, arrays, segments, bytes);
    for (Index s = 0; has(kSegments) && s < strands.size(); ++s) {
        append_little_endian(bytes, static_cast<std::uint16_t>(strands.point_count(s) - 1));
    }
    append_little_endian(bytes, strands.points());
    if (has(kThickness)) append_thickness(strands, bytes);
    for (Index s = 0; s < strands.size(); ++s) {
        const Index first = strands.first_point(s), end = first + strands.point_count(s);
        for (Index p = first; has(kTransparency) && p < end; ++p) {
            append_little_endian(bytes, strands.transparency().at(s, p));
        }
    }
    for (Index s = 0; has(kColors) && s < strands.size(); ++s) {
        const Index first = strands.first_point(s), end = first + strands.point_count(s);
        for (Index p = first; p < end; ++p) {
            const Eigen::Vector3f& color = strands.colors()->at(s, p);
            append_little_endian(bytes, std::span<const float>(color.data(), 3));
        }
    }
}

}  // namespace lissom
