/// MemoryHold: the memory that an object's lists take, on an account.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>

#include "kernel/core/context.h"

namespace lissom {

/// Memory held by an object that grows with the input. Declared before the lists that it counts: a
/// copy of the object then charges before it takes its memory, and a move brings the charge along.
/// The object calls `resize` before its lists grow.
class MemoryHold {
  public:
    /// Counts nowhere.
    MemoryHold() = default;
    /// Nothing yet, on an account (null: counts nowhere). `purpose`, a string with static storage,
    /// is named in errors: "a mesh".
    MemoryHold(std::shared_ptr<MemoryAccount> account, const char* purpose)
        : account_(std::move(account)), purpose_(purpose) {}
    /// Charges the same account once more. Errors: memory_limit.
    MemoryHold(const MemoryHold& other);
    MemoryHold(MemoryHold&& other) noexcept;
    /// Charges the same account; after an error the old charge remains.
    MemoryHold& operator=(const MemoryHold& other);
    MemoryHold& operator=(MemoryHold&& other) noexcept;
    ~MemoryHold();

    /// Holds `bytes` from now on. Errors: memory_limit, and then nothing has changed.
    void resize(std::size_t bytes);

    /// Returns the bytes held; 0 without an account.
    std::size_t bytes() const { return bytes_; }
    const std::shared_ptr<MemoryAccount>& account() const { return account_; }

  private:
    std::shared_ptr<MemoryAccount> account_;
    const char* purpose_ = "";
    std::size_t bytes_ = 0;
};

}  // namespace lissom
