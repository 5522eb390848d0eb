/// Reads numbers from binary data in memory; private to kernel/io.
#pragma once

#include <cstddef>
#include <string_view>

#include "kernel/io/stream/endianness.h"
#include "kernel/io/stream/read_error.h"
#include "kernel/io/stream/scalar.h"
#include "kernel/mesh/attributes.h"

namespace lissom {

/// A position in binary data that moves forward.
class ByteReader {
  public:
    ByteReader(std::string_view bytes, Endianness order) : bytes_(bytes), order_(order) {}

    /// Tally of the present read, for the error of data that end too early.
    Tally tally;

    std::size_t remaining() const { return bytes_.size() - at_; }
    /// Share of the data that lies behind, 0 to 1.
    double fraction() const { return bytes_.empty() ? 1.0 : double(at_) / double(bytes_.size()); }

    /// Returns the next number. Errors: file_truncated.
    template <typename T>
    T read() {
        if (remaining() < sizeof(T)) refuse_truncated(tally);
        const char* const next = bytes_.data() + at_;
        at_ += sizeof(T);
        return from_bytes<T>(next, order_);
    }
    /// Returns the next number as a double, which holds every value of every type. Errors:
    /// file_truncated.
    double read(ScalarType type) {
        return with_scalar(type,
                           [&](auto zero) { return static_cast<double>(read<decltype(zero)>()); });
    }
    /// Moves on by `count` bytes. Errors: file_truncated.
    void skip(std::size_t count) {
        if (remaining() < count) refuse_truncated(tally);
        at_ += count;
    }

  private:
    std::string_view bytes_;
    std::size_t at_ = 0;
    Endianness order_;
};

}  // namespace lissom
