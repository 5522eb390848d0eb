/// Lazy: a value that is found when it is first needed; private to kernel/deform.
#pragma once

#include <memory>
#include <mutex>
#include <utility>

namespace lissom {

/// A value that threads find when they first need it. It follows from immutable input, so that
/// either of two values found at the same time may be kept; nobody waits, as a loop that waits may
/// take up other work.
template <typename Value>
class Lazy {
  public:
    template <typename Find>
    const Value& get(const Find& find) const {
        if (const Value* found = look()) return *found;
        auto value = std::make_unique<const Value>(find());
        const std::lock_guard guard(lock_);
        if (!value_) value_ = std::move(value);
        return *value_;
    }

    bool is_known() const { return look() != nullptr; }

  private:
    const Value* look() const {
        const std::lock_guard guard(lock_);
        return value_.get();
    }

    mutable std::mutex lock_;
    mutable std::unique_ptr<const Value> value_;
};

}  // namespace lissom
