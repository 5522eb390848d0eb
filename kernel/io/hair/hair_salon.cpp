#include "kernel/io/hair/hair_salon.h"

#include <cstdint>
#include <utility>
#include <vector>

#include "kernel/io/stream/ticker.h"

namespace lissom {
namespace {

constexpr std::size_t kPointBytes = 12, kCountBytes = 4;

std::size_t read_point_count(ByteSource& source) {
    const auto count = source.read<std::int32_t>();
    const std::size_t strand = source.tally.found;
    const FilePlace place{ElementKind::strand, strand};
    if (count < 0) {
        refuse(ErrorCode::file_syntax,
               "strand " + std::to_string(strand) + " has " + std::to_string(count) + " points",
               place);
    }
    if (at(count) > source.remaining() / kPointBytes) {
        refuse(ErrorCode::file_truncated,
               "strand " + std::to_string(strand) + " of " +
                   std::to_string(source.tally.announced) + " has " + std::to_string(count) +
                   " points, but the file ends before; copy or export it again",
               place);
    }
    return count;
}

void warn_of_skipped(std::size_t empty, std::size_t count, std::size_t bytes,
                     const Context& context) {
    if (empty > 0) {
        context.log(LogLevel::warning,
                    std::to_string(empty) + " of " + std::to_string(count) +
                        (count == 1 ? " strand has" : " strands have") +
                        " no points and were left out: others have lower numbers than in the file");
    }
    if (bytes > 0) {
        context.log(LogLevel::warning,
                    std::to_string(bytes) + " bytes after the last strand were left out");
    }
}

}  // namespace

Strands read_hair_salon(ByteSource& source, const Context& context) {
    source.tally = {"bytes of the header", source.size(), kCountBytes};
    const std::size_t count =
        checked_count(source.read<std::int32_t>(), source.size(), "strands", {});
    source.tally = {"strands", 0, count};
    source.require(count * kCountBytes);
    Progress progress(context, "read strands");
    Ticker ticker(progress);
    const MemoryCharge charge = context.charge(source.remaining(), "reading strands");

    const std::size_t most = (source.remaining() - count * kCountBytes) / kPointBytes;
    std::vector<float> points(3 * most);
    std::vector<Index> offsets = {0};
    offsets.reserve(count + 1);
    std::size_t total = 0, empty = 0;
    for (; source.tally.found < count; ++source.tally.found) {
        ticker.tick([&] { return 1.0 - double(source.remaining()) / double(source.size()); });
        const std::size_t added = read_point_count(source);
        if (added == 0) {
            ++empty;
            continue;
        }
        if (added > most - total) refuse_truncated(source.tally);
        const auto strand = std::span(points).subspan(3 * total, 3 * added);
        source.read(strand);
        require_finite(strand, 3, total, offsets);
        total += added;
        checked_count(static_cast<std::int64_t>(total), source.size(), "points", {});
        offsets.push_back(index_of(total));
    }
    points.resize(3 * total);
    warn_of_skipped(empty, count, source.remaining(), context);
    return {std::move(points), std::move(offsets), context.memory()};
}

void write_hair_salon(const Strands& strands, std::string& bytes) {
    const std::size_t count = strands.size();
    bytes.reserve(kCountBytes * (count + 1) + strands.points().size_bytes());
    append_little_endian(bytes, strands.size());
    for (Index s = 0; s < strands.size(); ++s) {
        const StrandView strand = strands.strand(s);
        append_little_endian(bytes, index_of(strand.cols()));
        append_little_endian(bytes, std::span<const float>(strand.data(), at(strand.size())));
    }
}

}  // namespace lissom
