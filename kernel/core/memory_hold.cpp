#include "kernel/core/memory_hold.h"

#include <utility>

namespace lissom {

MemoryHold::MemoryHold(const MemoryHold& other)
    : account_(other.account_), purpose_(other.purpose_) {
    resize(other.bytes_);
}

// The source holds no bytes afterwards, and keeps its account.
MemoryHold::MemoryHold(MemoryHold&& other) noexcept
    // NOLINTNEXTLINE(performance-move-constructor-init)
    : account_(other.account_), purpose_(other.purpose_), bytes_(std::exchange(other.bytes_, 0)) {}

MemoryHold& MemoryHold::operator=(const MemoryHold& other) {
    if (this != &other) *this = MemoryHold(other);
    return *this;
}

MemoryHold& MemoryHold::operator=(MemoryHold&& other) noexcept {
    std::swap(account_, other.account_);
    std::swap(purpose_, other.purpose_);
    std::swap(bytes_, other.bytes_);
    if (this != &other) other.resize(0);
    return *this;
}

MemoryHold::~MemoryHold() {
    if (account_) account_->release(bytes_);
}

void MemoryHold::resize(std::size_t bytes) {
    if (!account_) return;
    if (bytes > bytes_) account_->charge(bytes - bytes_, purpose_);
    if (bytes < bytes_) account_->release(bytes_ - bytes);
    bytes_ = bytes;
}

}  // namespace lissom
