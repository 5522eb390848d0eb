#include "kernel/io/hair/guide_file.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "kernel/core/error.h"
#include "kernel/io/stream/file.h"
#include "kernel/io/stream/scalar.h"

namespace lissom {
namespace {

constexpr std::string_view kGuideMagic = "LSMHAIRG";
constexpr std::uint32_t kGuideVersion = 1, kHasDetails = 1;
constexpr std::size_t kGuideHeader = 48, kGuidedBytes = 48;

void require_finite_guides(const GuideSet& set) {
    bool finite = std::isfinite(set.detail_step);
    for (const Eigen::Vector3f& p : set.curves) finite = finite && p.allFinite();
    for (const GuidedStrand& s : set.guided) {
        finite = finite && s.root.allFinite() && std::isfinite(s.length) && std::isfinite(s.width);
    }
    require(finite, "the guides have numbers that are not finite", ErrorCode::not_finite);
}

template <typename T>
void add(std::string& bytes, T value) {
    append_number(bytes, value, Endianness::little);
}

std::size_t padded_size(std::size_t bytes) {
    return (bytes + 15) / 16 * 16;
}

void add_header(const GuideSet& set, bool details, std::size_t size, std::string& bytes) {
    bytes += kGuideMagic;
    add(bytes, kGuideVersion);
    add(bytes, static_cast<std::uint32_t>(set.guided.size()));
    add(bytes, static_cast<std::uint32_t>(set.guide_count()));
    add(bytes, static_cast<std::uint32_t>(set.points));
    add(bytes, details ? kHasDetails : std::uint32_t{0});
    add(bytes, set.detail_step);
    add(bytes, static_cast<std::uint64_t>(size));
    add(bytes, std::uint64_t{0});
}

void add_strand(const GuidedStrand& strand, std::string& bytes) {
    for (const float x : strand.root) add(bytes, x);
    add(bytes, strand.length);
    for (const std::uint32_t guide : strand.guides) add(bytes, guide);
    add(bytes, strand.id);
    for (const float weight : strand.weights) add(bytes, weight);
    add(bytes, strand.width);
}

}  // namespace

std::string encode_guides(const GuideSet& set, const GuideFileOptions& options) {
    require_finite_guides(set);
    const std::size_t strands = kGuideHeader + kGuidedBytes * set.guided.size();
    const std::size_t curves = padded_size(strands + 12 * set.curves.size());
    const std::size_t size =
        options.details ? padded_size(curves + 2 * set.details.size()) : curves;
    std::string bytes;
    bytes.reserve(size);
    add_header(set, options.details, size, bytes);
    for (const GuidedStrand& strand : set.guided) add_strand(strand, bytes);
    for (const Eigen::Vector3f& p : set.curves) {
        for (const float x : p) add(bytes, x);
    }
    bytes.resize(curves, '\0');
    if (options.details) {
        for (const std::int16_t detail : set.details) add(bytes, detail);
    }
    bytes.resize(size, '\0');
    return bytes;
}

void save_guides(const GuideSet& set, const std::filesystem::path& path,
                 const GuideFileOptions& options, const Context& context) {
    write_file_atomically(path, encode_guides(set, options), context);
}

}  // namespace lissom
