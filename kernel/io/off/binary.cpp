#include <algorithm>
#include <array>

#include "kernel/io/off/builder.h"
#include "kernel/io/stream/byte_reader.h"
#include "kernel/io/stream/ticker.h"

namespace lissom {
namespace {

// How binary data are laid out. In Geomview's each face ends with the number of its colour values
// and these; the other kind has no such number.
struct BinaryKind {
    Endianness order;
    bool has_color_counts;
};

constexpr std::array<BinaryKind, 3> kBinaryKinds{
    {{Endianness::big, true}, {Endianness::little, false}, {Endianness::big, false}}};

struct BinaryCounts {
    std::uint32_t vertices, faces;
};

BinaryCounts read_binary_counts(ByteReader& data) {
    data.tally.elements = "counts";
    const auto vertices = data.read<std::uint32_t>(), faces = data.read<std::uint32_t>();
    data.skip(sizeof(std::uint32_t));
    return {vertices, faces};
}

std::size_t binary_vertex_bytes(OffLayout layout) {
    return sizeof(float) * (layout.numbers_without_color() + (layout.colors ? 4 : 0));
}

// Moves over a number and as many numbers of four bytes; false if the data end before.
bool skip_counted(ByteReader& data) {
    if (data.remaining() < 4) return false;
    const std::size_t count = data.read<std::uint32_t>();
    if (count > data.remaining() / 4) return false;
    data.skip(4 * count);
    return true;
}

// True if the data, taken to be of this kind, end with the last face.
bool fits(std::string_view bytes, OffLayout layout, BinaryKind kind) {
    ByteReader data(bytes, kind.order);
    const BinaryCounts counts = read_binary_counts(data);
    const std::size_t vertex_bytes = binary_vertex_bytes(layout);
    if (counts.vertices > data.remaining() / vertex_bytes) return false;
    data.skip(counts.vertices * vertex_bytes);
    for (std::uint32_t f = 0; f < counts.faces; ++f) {
        if (!skip_counted(data) || (kind.has_color_counts && !skip_counted(data))) return false;
    }
    return data.remaining() == 0;
}

// The kind that the data fit exactly. If they fit none, for instance because they are cut short,
// the byte order is the one with the smaller counts.
BinaryKind find_kind(std::string_view bytes, OffLayout layout) {
    for (const BinaryKind kind : kBinaryKinds) {
        if (fits(bytes, layout, kind)) return kind;
    }
    ByteReader big(bytes, Endianness::big), little(bytes, Endianness::little);
    const bool is_big = read_binary_counts(big).vertices <= read_binary_counts(little).vertices;
    return kBinaryKinds[is_big ? 0 : 1];
}

class OffBinaryReader {
  public:
    OffBinaryReader(std::string_view bytes, OffLayout layout, const Context& context)
        : bytes_(bytes),
          context_(context),
          kind_(find_kind(bytes, layout)),
          data_(bytes, kind_.order) {
        builder_.layout = layout;
        builder_.number_type = ScalarType::float32;
    }

    MeshData read() {
        Progress progress(context_, "read OFF");
        Ticker ticker(progress);
        const BinaryCounts counts = read_binary_counts(data_);
        builder_.vertex_count = checked_count(counts.vertices, bytes_.size(), "vertices", {});
        builder_.face_count = checked_count(counts.faces, bytes_.size(), "faces", {});

        data_.tally = {"vertices", 0, builder_.vertex_count};
        const std::size_t color_width = builder_.layout.colors ? 4 : 0;
        for (; data_.tally.found < builder_.vertex_count; ++data_.tally.found) {
            ticker.tick([&] { return data_.fraction(); });
            builder_.add_vertex(color_width, [&] { return data_.read<float>(); });
        }
        data_.tally = {"faces", 0, builder_.face_count};
        for (; data_.tally.found < builder_.face_count; ++data_.tally.found) {
            ticker.tick([&] { return data_.fraction(); });
            read_face();
        }
        return builder_.finish();
    }

  private:
    std::size_t read_length() {
        const auto length = data_.read<std::uint32_t>();
        if (length > data_.remaining() / 4) refuse_truncated(data_.tally);
        return length;
    }

    void read_face() {
        const FilePlace place{ElementKind::face, data_.tally.found};
        builder_.face.clear();
        for (std::size_t k = read_length(); k > 0; --k) {
            builder_.face.push_back(builder_.vertices.checked(data_.read<std::int32_t>(), place));
        }
        if (kind_.has_color_counts) read_face_color();
        add_face(builder_.mesh.faces, builder_.face);
    }

    void read_face_color() {
        std::array<double, 4> color{};
        const std::size_t width = read_length();
        for (std::size_t k = 0; k < width; ++k) {
            const double value = data_.read<float>();
            if (k < 4) color[k] = value;
        }
        if (width < 3) return;
        builder_.face_colors.set(builder_.mesh.faces.size(),
                                 {color.data(), std::min<std::size_t>(width, 4)});
    }

    std::string_view bytes_;
    const Context& context_;
    BinaryKind kind_;
    ByteReader data_;
    OffBuilder builder_;
};

}  // namespace

MeshData read_off_binary(std::string_view bytes, OffLayout layout, const Context& context) {
    return OffBinaryReader(bytes, layout, context).read();
}

}  // namespace lissom
