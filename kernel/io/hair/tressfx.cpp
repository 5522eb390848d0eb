#include "kernel/io/hair/tressfx.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "kernel/hair/strands/strand_measures.h"
#include "kernel/io/stream/byte_source.h"
#include "kernel/io/stream/ticker.h"

namespace lissom {
namespace {

constexpr std::size_t kTfxHeaderBytes = 160, kTfxReserved = 32;
constexpr float kTfxVersion = 4.0f, kFirstTfxVersion = 3.0f, kLastTfxVersion = 6.0f;

// Arrays in the order of their offsets.
enum TfxArray : std::size_t { tfx_points, tfx_root_uvs, tfx_point_uvs, tfx_thickness, tfx_colors };

struct TfxHeader {
    std::uint32_t strands = 0, points = 0;
    std::array<std::uint32_t, 5> offsets{};

    std::size_t point_count() const { return std::size_t{strands} * points; }
    bool has(TfxArray array) const { return offsets[array] != 0; }
};

std::size_t tfx_count_of(const TfxHeader& header, TfxArray array) {
    return array == tfx_root_uvs || array == tfx_thickness ? header.strands : header.point_count();
}

constexpr std::array<std::size_t, 5> kTfxWidths{4, 2, 2, 1, 4};

TfxHeader read_tfx_header(std::string_view bytes) {
    ByteSource source(bytes);
    source.tally = {"bytes of the header", bytes.size(), kTfxHeaderBytes};
    source.require(kTfxHeaderBytes);
    const auto version = source.read<float>();
    if (!(version >= kFirstTfxVersion && version < kLastTfxVersion)) {
        refuse(
            ErrorCode::file_syntax,
            "this is not a .tfx file of TressFX 3, 4 or 5: it does not begin with their version");
    }
    TfxHeader header;
    header.strands = source.read<std::uint32_t>();
    header.points = source.read<std::uint32_t>();
    source.read(std::span<std::uint32_t>(header.offsets));
    return header;
}

// Checks that the file holds all it announces, before anything is made that large.
void require_tfx_arrays(const TfxHeader& header, std::size_t size) {
    constexpr std::array<std::string_view, 5> kNames{"points", "texture coordinates of roots",
                                                     "texture coordinates of points", "thicknesses",
                                                     "colours"};
    checked_count(header.strands, size, "strands", {});
    checked_count(header.points, size, "points of a strand", {});
    checked_count(static_cast<std::int64_t>(header.point_count()), size, "points", {});
    if (header.strands > 0 && (header.points == 0 || !header.has(tfx_points))) {
        refuse(ErrorCode::file_syntax, "the file has strands but no points");
    }
    for (const TfxArray array :
         {tfx_points, tfx_root_uvs, tfx_point_uvs, tfx_thickness, tfx_colors}) {
        if (!header.has(array)) continue;
        const std::string name(kNames[array]);
        const std::uint64_t begin = header.offsets[array];
        const std::uint64_t end =
            begin + sizeof(float) * kTfxWidths[array] * tfx_count_of(header, array);
        if (begin < kTfxHeaderBytes) {
            refuse(ErrorCode::file_syntax, "the array of " + name + " begins within the header");
        }
        if (end > size) {
            refuse(ErrorCode::file_truncated,
                   "the array of " + name + " ends at byte " + std::to_string(end) +
                       " of a file of " + std::to_string(size) + "; copy or export it again");
        }
    }
}

// Reads an array of `width` numbers for each point or strand.
class TfxReader {
  public:
    TfxReader(std::string_view bytes, const Context& context)
        : bytes_(bytes), context_(context), header_(read_tfx_header(bytes)) {
        require_tfx_arrays(header_, bytes.size());
        for (std::size_t s = 0; s <= header_.strands; ++s) {
            offsets_.push_back(index_of(s * header_.points));
        }
    }

    FileHair read() {
        Progress progress(context_, "read strands");
        FileHair hair;
        if (header_.strands == 0) return hair;
        hair.strands = Strands(read_places(), offsets_, context_.memory());
        progress.update(0.6);
        set_uvs(hair.strands);
        set_tfx_widths(hair);
        set_tfx_colors(hair.strands);
        if (header_.has(tfx_point_uvs)) {
            context_.log(LogLevel::warning, "texture coordinates of points were left out");
        }
        return hair;
    }

  private:
    std::vector<float> numbers(TfxArray array) const {
        std::vector<float> values(kTfxWidths[array] * tfx_count_of(header_, array));
        ByteSource source(bytes_.substr(header_.offsets[array]));
        source.read(std::span<float>(values));
        return values;
    }

    // Without the fourth number, which may be anything.
    std::vector<float> read_places() const {
        const std::vector<float> rows = numbers(tfx_points);
        std::vector<float> places;
        places.reserve(3 * header_.point_count());
        for (std::size_t i = 0; i < rows.size(); i += 4) {
            places.insert(places.end(), rows.data() + i, rows.data() + i + 3);
        }
        require_finite(places, 3, 0, offsets_);
        return places;
    }

    // Numbers of strands; an error names the strand.
    std::vector<float> of_strands(TfxArray array) const {
        std::vector<float> values = numbers(array);
        std::vector<Index> each(at(index_of(header_.strands)) + 1);
        for (std::size_t s = 0; s < each.size(); ++s) each[s] = index_of(s);
        require_finite(values, kTfxWidths[array], 0, each);
        return values;
    }

    void set_uvs(Strands& strands) const {
        if (!header_.has(tfx_root_uvs)) return;
        const std::vector<float> values = of_strands(tfx_root_uvs);
        StrandRoots roots;
        for (std::size_t i = 0; i < values.size(); i += 2) {
            roots.uvs.emplace_back(values[i], values[i + 1]);
        }
        strands.set_roots(std::move(roots));
    }

    void set_tfx_widths(FileHair& hair) const {
        if (!header_.has(tfx_thickness)) return;
        StrandWidths widths;
        widths.domain = StrandDomain::strand;
        widths.values = of_strands(tfx_thickness);
        const float first = widths.values.front();
        if (std::all_of(widths.values.begin(), widths.values.end(),
                        [&](float w) { return w == first; })) {
            widths.domain = StrandDomain::all;
            widths.common = first;
            widths.values.clear();
        }
        hair.strands.set_widths(std::move(widths));
        hair.has_widths = true;
    }

    void set_tfx_colors(Strands& strands) const {
        if (!header_.has(tfx_colors)) return;
        const std::vector<float> rows = numbers(tfx_colors);
        require_finite(rows, 4, 0, offsets_);
        StrandValues<Eigen::Vector3f> list{Eigen::Vector3f::Zero(), StrandDomain::point};
        StrandValues<float> transparency{0.0f, StrandDomain::point};
        bool opaque = true;
        for (std::size_t i = 0; i < rows.size(); i += 4) {
            list.values.emplace_back(rows.data() + i);
            transparency.values.push_back(1.0f - rows[i + 3]);
            opaque = opaque && rows[i + 3] == 1.0f;
        }
        strands.set_colors(std::move(list));
        if (!opaque) strands.set_transparency(std::move(transparency));
    }

    std::string_view bytes_;
    const Context& context_;
    TfxHeader header_;
    std::vector<Index> offsets_;
};

class TfxWriter {
  public:
    TfxWriter(const Strands& strands, std::string& bytes) : strands_(strands), bytes_(bytes) {}

    void write(const Context& context) {
        Progress progress(context, "write strands");
        Ticker ticker(progress);
        bytes_.assign(kTfxHeaderBytes, '\0');
        begin_array(tfx_points);
        for (Index s = 0; s < strands_.size(); ++s) {
            ticker.tick([&] { return 0.6 * s / strands_.size(); });
            const StrandView strand = strands_.strand(s);
            for (Index k = 0; k < strand.cols(); ++k) {
                append_little_endian(bytes_, std::span<const float>(strand.data() + 3 * k, 3));
                append_little_endian(bytes_, k == 0 ? 0.0f : 1.0f);
            }
        }
        write_uvs();
        write_thickness();
        write_colors();
        write_header();
    }

  private:
    void begin_array(TfxArray array) {
        bytes_.resize((bytes_.size() + 7) / 8 * 8, '\0');
        offsets_[array] = static_cast<std::uint32_t>(bytes_.size());
    }

    void write_uvs() {
        if (strands_.roots().uvs.empty()) return;
        begin_array(tfx_root_uvs);
        for (const Eigen::Vector2f& uv : strands_.roots().uvs) {
            append_little_endian(bytes_, std::span<const float>(uv.data(), 2));
        }
    }

    void write_thickness() {
        begin_array(tfx_thickness);
        std::vector<float> widths;
        for (Index s = 0; s < strands_.size(); ++s) {
            widths_of(strands_, s, widths);
            append_little_endian(bytes_, widths.front());
        }
    }

    void write_colors() {
        const StrandValues<Eigen::Vector3f>* const list = strands_.colors();
        if (!list) return;
        begin_array(tfx_colors);
        for (Index s = 0; s < strands_.size(); ++s) {
            const Index first = strands_.first_point(s);
            for (Index p = first; p < first + strands_.point_count(s); ++p) {
                append_little_endian(bytes_, std::span<const float>(list->at(s, p).data(), 3));
                append_little_endian(bytes_, 1.0f - strands_.transparency().at(s, p));
            }
        }
    }

    void write_header() {
        const std::uint64_t size = bytes_.size();
        if (size > 0xffffffffu) {
            throw Error(ErrorCode::file_too_large,
                        "the strands need " + std::to_string(size >> 20) +
                            " MB, and .tfx counts 4096 at most; select fewer strands");
        }
        std::string header;
        append_little_endian(header, kTfxVersion);
        append_little_endian(header, static_cast<std::uint32_t>(strands_.size()));
        append_little_endian(
            header, static_cast<std::uint32_t>(strands_.empty() ? kTressFxLeastPoints
                                                                : strands_.point_count(0)));
        append_little_endian(header, std::span<const std::uint32_t>(offsets_));
        for (std::size_t i = 0; i < kTfxReserved; ++i) append_little_endian(header, 0u);
        bytes_.replace(0, kTfxHeaderBytes, header);
    }

    const Strands& strands_;
    std::string& bytes_;
    std::array<std::uint32_t, 5> offsets_{};
};

}  // namespace

Index tressfx_points(Index points) {
    Index count = kTressFxLeastPoints;
    while (count < points && count < kTressFxMostPoints) count *= 2;
    return count;
}

FileHair read_tressfx(std::string_view bytes, const Context& context) {
    return TfxReader(bytes, context).read();
}

void write_tressfx(const Strands& strands, std::string& bytes, const Context& context) {
    TfxWriter(strands, bytes).write(context);
}

}  // namespace lissom
