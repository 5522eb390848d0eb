#include "kernel/scene/file/part_archive.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstring>

#include "kernel/core/error.h"

namespace lissom {
namespace {

constexpr std::size_t kRecord = 512;
constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 33;

// Fields of a header: their offsets and lengths.
struct Field {
    std::size_t begin, length;
};
constexpr Field kName{0, 100}, kMode{100, 8}, kSize{124, 12}, kTime{136, 12}, kSum{148, 8},
    kType{156, 1}, kMagic{257, 8};
constexpr std::string_view kUstar{
    "ustar\0"
    "00",
    8};

using Header = std::array<char, kRecord>;

void put(Header& header, Field field, std::string_view text) {
    std::copy(text.begin(), text.end(), header.begin() + static_cast<std::ptrdiff_t>(field.begin));
}

void put_octal(Header& header, Field field, std::size_t value) {
    char text[16];
    std::snprintf(text, sizeof text, "%0*zo", static_cast<int>(field.length) - 1, value);
    put(header, field, text);
}

// The checksum counts its own field as blanks.
std::size_t sum_of(std::string_view header) {
    std::size_t sum = 0;
    for (std::size_t i = 0; i < kRecord; ++i) {
        const bool own = i >= kSum.begin && i < kSum.begin + kSum.length;
        sum += own ? ' ' : static_cast<unsigned char>(header[i]);
    }
    return sum;
}

Header header_of(std::string_view name, std::size_t size) {
    Header header{};
    put(header, kName, name);
    put(header, kMode, "0000644");
    put_octal(header, kSize, size);
    put_octal(header, kTime, 0);
    put(header, kType, "0");
    put(header, kMagic, kUstar);
    put_octal(header, {kSum.begin, 7}, sum_of({header.data(), kRecord}));
    return header;
}

std::string_view text_in(std::string_view header, Field field) {
    const std::string_view text = header.substr(field.begin, field.length);
    return text.substr(0, std::min(text.find('\0'), text.size()));
}

[[noreturn]] void refuse_damaged() {
    throw Error(ErrorCode::file_syntax, "this is no scene, or a damaged one");
}

std::uint64_t octal_in(std::string_view header, Field field) {
    std::uint64_t value = 0;
    for (const char digit : text_in(header, field)) {
        if (digit == ' ') break;
        if (digit < '0' || digit > '7') refuse_damaged();
        value = 8 * value + static_cast<std::uint64_t>(digit - '0');
    }
    return value;
}

std::size_t padded(std::size_t size) {
    return (size + kRecord - 1) / kRecord * kRecord;
}

}  // namespace

void PartWriter::add(std::string_view name, std::string_view bytes) {
    require(name.size() < kName.length, "a part's name is too long", ErrorCode::internal);
    require(std::uint64_t{bytes.size()} < kMaxBytes, "an object of the scene has 8 GiB or more",
            ErrorCode::file_too_large);
    const Header header = header_of(name, bytes.size());
    bytes_.append(header.data(), kRecord);
    bytes_.append(bytes);
    bytes_.resize(padded(bytes_.size()));
}

SceneJson PartWriter::put(const ListPlace& place, std::string_view bytes, ListForm) {
    add(place.path, bytes);
    return nullptr;
}

// Two empty records end an archive.
std::string PartWriter::finish() && {
    bytes_.resize(bytes_.size() + 2 * kRecord);
    return std::move(bytes_);
}

PartReader::PartReader(std::string_view archive) {
    std::size_t at = 0;
    while (true) {
        require(archive.size() - at >= kRecord, "the scene is cut short",
                ErrorCode::file_truncated);
        const std::string_view header = archive.substr(at, kRecord);
        if (header.find_first_not_of('\0') == std::string_view::npos) return;
        if (text_in(header, kMagic) != "ustar" || octal_in(header, kSum) != sum_of(header)) {
            refuse_damaged();
        }
        at += kRecord;
        const std::size_t size = octal_in(header, kSize);
        require(size <= archive.size() - at && padded(size) <= archive.size() - at,
                "the scene is cut short", ErrorCode::file_truncated);
        parts_.insert_or_assign(std::string(text_in(header, kName)), archive.substr(at, size));
        at += padded(size);
    }
}

std::string_view PartReader::get(const std::string& path, const SceneJson*, ListForm) {
    return find(path);
}

std::string_view PartReader::find(std::string_view name) const {
    const auto found = parts_.find(name);
    require(found != parts_.end(), "the scene lacks its part '" + std::string(name) + "'",
            ErrorCode::file_truncated);
    return found->second;
}

}  // namespace lissom
