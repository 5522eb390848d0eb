/// ByteSource: a binary file that is read in order, straight into the lists it is kept in; private
/// to kernel/io.
#pragma once

#include <bit>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/io/stream/endianness.h"
#include "kernel/io/stream/read_error.h"
#include "kernel/io/stream/scalar.h"

namespace lissom {

/// Little-endian data, in memory or in a file.
class ByteSource {
  public:
    explicit ByteSource(std::string_view bytes) : bytes_(bytes), size_(bytes.size()) {}
    /// Errors: as `require_file` and `addressable_size`.
    explicit ByteSource(const std::filesystem::path& path);

    /// Tally of the present read, for the error of data that end too early.
    Tally tally;

    std::size_t size() const { return size_; }
    std::size_t remaining() const { return size_ - at_; }
    /// Throws if fewer bytes are left. Errors: file_truncated.
    void require(std::size_t bytes) const {
        if (remaining() < bytes) refuse_truncated(tally);
    }

    /// Returns the next number. Errors: file_truncated, file_unreadable.
    template <typename T>
    T read() {
        char bytes[sizeof(T)];
        read_bytes(bytes, sizeof(T));
        return from_bytes<T>(bytes, Endianness::little);
    }
    /// Fills `numbers`. Errors: file_truncated, file_unreadable.
    template <typename T>
    void read(std::span<T> numbers) {
        read_bytes(numbers.data(), numbers.size_bytes());
        if constexpr (std::endian::native != std::endian::little) {
            for (T& x : numbers) {
                x = from_bytes<T>(reinterpret_cast<const char*>(&x), Endianness::little);
            }
        }
    }

  private:
    void read_bytes(void* to, std::size_t count);

    std::string_view bytes_;
    std::ifstream file_;
    std::size_t size_ = 0, at_ = 0;
    bool from_file_ = false;
};

/// Fills `numbers` (three a point) piece by piece.
/// Errors: file_truncated; not_finite, naming the strand that holds the point by `offsets`, the
/// place of each strand's first point; cancelled.
void read_points(ByteSource& source, std::span<float> numbers, std::span<const Index> offsets,
                 const Context& context);

/// Throws not_finite naming the strand and its point, if one of `numbers`, `width` a point, is NaN
/// or infinite. `first_point` is the number of the first of these points.
void require_finite(std::span<const float> numbers, std::size_t width, std::size_t first_point,
                    std::span<const Index> offsets);

/// Appends numbers to little-endian data.
template <typename T>
void append_little_endian(std::string& bytes, std::span<const T> numbers) {
    if constexpr (std::endian::native == std::endian::little) {
        bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes());
    } else {
        for (const T x : numbers) append_number(bytes, x, Endianness::little);
    }
}
template <typename T>
void append_little_endian(std::string& bytes, const T& number) {
    append_little_endian(bytes, std::span<const T>(&number, 1));
}

}  // namespace lissom
