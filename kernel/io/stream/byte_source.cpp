#include "kernel/io/stream/byte_source.h"

#include <algorithm>
#include <cstdint>

#include "kernel/core/numbers/bits.h"
#include "kernel/io/stream/file.h"
#include "kernel/io/stream/open_file.h"

namespace lissom {
namespace {

// Numbers that stay in the cache between reading and checking them.
constexpr std::size_t kPieceNumbers = 3 * (std::size_t{1} << 15);

bool is_finite(float x) {
    constexpr std::uint32_t kExponent = 0x7f800000;
    return (bits_as<std::uint32_t>(x) & kExponent) != kExponent;
}

// Without a branch in the loop, so that it is vectorised.
bool all_finite(std::span<const float> numbers) {
    bool finite = true;
    for (const float x : numbers) finite = finite & is_finite(x);
    return finite;
}

}  // namespace

ByteSource::ByteSource(const std::filesystem::path& path) : from_file_(true) {
    require_file(path);
    file_ = open_to_read(path);
    size_ = addressable_size(path);
}

void ByteSource::read_bytes(void* to, std::size_t count) {
    require(count);
    if (count == 0) return;
    if (!from_file_) {
        std::memcpy(to, bytes_.data() + at_, count);
    } else if (!file_.read(static_cast<char*>(to), static_cast<std::streamsize>(count))) {
        refuse(ErrorCode::file_unreadable, "reading stopped before the end of the file");
    }
    at_ += count;
}

void read_points(ByteSource& source, std::span<float> numbers, std::span<const Index> offsets,
                 const Context& context) {
    source.require(numbers.size_bytes());
    Progress progress(context, "read strands");
    for (std::size_t done = 0; done < numbers.size(); done += kPieceNumbers) {
        progress.update(done, numbers.size());
        const auto piece = numbers.subspan(done, std::min(kPieceNumbers, numbers.size() - done));
        source.read(piece);
        require_finite(piece, 3, done / 3, offsets);
    }
}

void require_finite(std::span<const float> numbers, std::size_t width, std::size_t first_point,
                    std::span<const Index> offsets) {
    if (all_finite(numbers)) return;
    const auto bad = std::find_if_not(numbers.begin(), numbers.end(), is_finite);
    const auto point = index_of(first_point + (bad - numbers.begin()) / width);
    const auto after = std::upper_bound(offsets.begin(), offsets.end(), point);
    const auto strand = at(after - offsets.begin()) - 1;
    refuse(ErrorCode::not_finite,
           "strand " + std::to_string(strand) +
               " has a value that is NaN or infinite, at its "
               "point " +
               std::to_string(point - offsets[strand]),
           {ElementKind::strand, strand});
}

}  // namespace lissom
