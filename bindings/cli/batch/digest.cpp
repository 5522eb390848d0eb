#include "bindings/cli/batch/digest.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <fstream>
#include <memory>
#include <vector>

#include "bindings/cli/batch/durable_files.h"

namespace lissom::cli {
namespace {

namespace fs = std::filesystem;

std::string hexadecimal(const XXH128_hash_t& hash) {
    constexpr char kDigits[] = "0123456789abcdef";
    std::string text;
    for (const std::uint64_t half : {hash.high64, hash.low64}) {
        for (int shift = 60; shift >= 0; shift -= 4) text += kDigits[(half >> shift) & 15u];
    }
    return text;
}

// Empty for a file that cannot be read.
std::string content_digest(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) return {};
    const std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state(XXH3_createState(),
                                                                                XXH3_freeState);
    if (!state) throw std::bad_alloc();
    XXH3_128bits_reset(state.get());
    std::vector<char> buffer(1 << 18);
    while (stream) {
        stream.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
        XXH3_128bits_update(state.get(), buffer.data(), static_cast<std::size_t>(stream.gcount()));
    }
    return stream.bad() ? std::string() : hexadecimal(XXH3_128bits_digest(state.get()));
}

}  // namespace

std::string text_digest(std::string_view text) {
    return hexadecimal(XXH3_128bits(text.data(), text.size()));
}

void FileDigests::know(const FileStamp& stamp) {
    if (stamp.digest.empty()) return;
    known_[{stamp.path, stamp.size, stamp.time, stamp.inode}] = stamp.digest;
}

FileStamp FileDigests::stamp(const fs::path& file) {
    FileStamp stamp;
    stamp.path = file.string();
    const FileIdentity identity = file_identity(file);
    if (!identity.is_file) return stamp;
    stamp.size = identity.size;
    stamp.time = identity.time;
    stamp.inode = identity.inode;
    std::string& known = known_[{stamp.path, stamp.size, stamp.time, stamp.inode}];
    if (known.empty()) known = content_digest(file);
    stamp.digest = known;
    return stamp;
}

}  // namespace lissom::cli
