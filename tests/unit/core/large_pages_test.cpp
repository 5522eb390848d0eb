#include "kernel/core/large_pages.h"

#include "tests/unit/support.h"

using namespace lissom;

TEST_CASE("large pages are a hint: what a range holds and what lies beside it stay") {
    const std::size_t megabyte = std::size_t{1} << 20;
    std::vector<unsigned char> bytes(9 * megabyte);
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<unsigned char>(i * 7);
    for (const std::size_t size : {std::size_t{0}, std::size_t{1}, megabyte, 8 * megabyte + 3}) {
        for (const std::size_t offset : {std::size_t{0}, std::size_t{1}, megabyte / 2 + 5}) {
            prefer_large_pages(bytes.data() + offset, size);
        }
    }
    prefer_large_pages(nullptr, 0);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        kept += bytes[i] == static_cast<unsigned char>(i * 7);
    }
    CHECK(kept == bytes.size());
    const auto array = large_array<double>(3 * megabyte);
    array[0] = array[3 * megabyte - 1] = 1.5;
    CHECK(array[0] + array[3 * megabyte - 1] == 3.0);
    CHECK(large_array<int>(0) != nullptr);
}
