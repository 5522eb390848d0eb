/// ContentStore: counts the bytes that the states of a scene hold, each thing once, for as long as
/// one of them holds it.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "kernel/core/context.h"

namespace lissom {

/// Something that states hold, with the bytes that it counts.
struct KeptBytes {
    explicit KeptBytes(MemoryCharge counted) : charge(std::move(counted)) {}

    MemoryCharge charge;
};

/// A value that states hold, and that live objects may hold as well: a topology, labels, a setup.
template <typename T>
struct Kept : KeptBytes {
    Kept(MemoryCharge counted, std::shared_ptr<const T> kept)
        : KeptBytes(std::move(counted)), value(std::move(kept)) {}

    std::shared_ptr<const T> value;
};

class ContentStore {
  public:
    /// Counted bytes are charged to `account` too; null: to none.
    explicit ContentStore(std::shared_ptr<MemoryAccount> account = nullptr)
        : beside_(std::make_shared<MemoryAccount>(0, account)),
          account_(std::make_shared<MemoryAccount>(0, std::move(account))) {}

    /// Bytes of all that is alive.
    std::size_t bytes() const { return account_->used() + counted_->used(); }
    /// Counts `bytes` for as long as the result lives.
    MemoryCharge charge(std::size_t bytes) const { return {account_, bytes, kPurpose}; }

    /// Charges the account alone, for names and lists: they are no part of `bytes()`.
    MemoryCharge charge_beside(std::size_t bytes) const { return {beside_, bytes, kPurpose}; }

    /// Keeps `value`, which counts `bytes`; for a value that is kept already, the same result.
    /// Null for null.
    template <typename T>
    std::shared_ptr<const Kept<T>> keep(const std::shared_ptr<const T>& value, std::size_t bytes) {
        return keep_on(account_, value, bytes);
    }
    /// Returns the same for a value that is charged to an account already, as topologies are: its
    /// bytes only add to `bytes()`.
    template <typename T>
    std::shared_ptr<const Kept<T>> keep_counted(const std::shared_ptr<const T>& value,
                                                std::size_t bytes) {
        return keep_on(counted_, value, bytes);
    }

  private:
    static constexpr std::string_view kPurpose = "the history of a scene";

    template <typename T>
    std::shared_ptr<const Kept<T>> keep_on(const std::shared_ptr<MemoryAccount>& account,
                                           const std::shared_ptr<const T>& value,
                                           std::size_t bytes) {
        if (!value) return nullptr;
        std::weak_ptr<const KeptBytes>& known = kept_[value.get()];
        if (auto found = known.lock()) return std::static_pointer_cast<const Kept<T>>(found);
        auto made = std::make_shared<const Kept<T>>(MemoryCharge(account, bytes, kPurpose), value);
        known = made;
        forget_dead();
        return made;
    }
    void forget_dead();

    std::shared_ptr<MemoryAccount> beside_, account_;
    std::shared_ptr<MemoryAccount> counted_ = std::make_shared<MemoryAccount>(0);
    // Keyed by the address of the value, which lives as long as its kept bytes.
    std::map<const void*, std::weak_ptr<const KeptBytes>> kept_;
    std::size_t forget_at_ = 64;
};

/// Bytes of all things of `list`, each counted once.
std::size_t bytes_of(std::vector<const KeptBytes*> list);

}  // namespace lissom
