/// Numbers of a PLY file's text or binary data, one after the other; private to kernel/io.
#pragma once

#include <cstddef>
#include <string_view>

#include "kernel/core/error.h"
#include "kernel/io/ply/header.h"
#include "kernel/io/stream/byte_reader.h"
#include "kernel/io/stream/read_error.h"
#include "kernel/io/stream/text_reader.h"
#include "kernel/mesh/attributes.h"

namespace lissom {

/// The numbers of a text.
class PlyText {
  public:
    PlyText(std::string_view bytes, const PlyHeader& header)
        : text_(bytes.substr(header.size), {}, header.lines) {}

    Tally& tally() { return text_.tally; }
    double number(ScalarType) { return text_.next_number(); }
    std::size_t remaining() const { return text_.remaining(); }
    double fraction() const { return text_.fraction(); }
    FilePlace place(ElementKind, std::size_t) const { return text_.place(); }

  private:
    TextReader text_;
};

/// The numbers of binary data.
class PlyBinary {
  public:
    PlyBinary(std::string_view bytes, const PlyHeader& header)
        : bytes_(bytes.substr(header.size), header.endianness) {}

    Tally& tally() { return bytes_.tally; }
    double number(ScalarType type) { return bytes_.read(type); }
    std::size_t remaining() const { return bytes_.remaining(); }
    double fraction() const { return bytes_.fraction(); }
    /// Place of the element `row` of a kind.
    FilePlace place(ElementKind kind, std::size_t row) const { return {kind, row}; }

  private:
    ByteReader bytes_;
};

}  // namespace lissom
