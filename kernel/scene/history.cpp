#include "kernel/scene/history.h"

#include <cstddef>
#include <utility>

namespace lissom {
namespace {

// Bytes of the live objects that `state` has and `next` has not.
std::size_t removed_bytes(const SceneState& state, const SceneState& next) {
    std::size_t bytes = 0;
    for (std::size_t i = 0; i < state.items.size(); ++i) {
        const SceneItem& item = *state.items[i].item;
        if (!next.find(item.identity(), i)) bytes += item.memory_bytes();
    }
    return bytes;
}

}  // namespace

std::size_t History::bytes() const {
    return bytes_beside(bytes_of(*present()));
}

std::size_t History::bytes_beside(std::size_t present) const {
    std::size_t bytes = store_.bytes() - present;
    for (const Step& step : steps_) bytes += step.removed;
    return bytes;
}

void History::push(std::string name, std::shared_ptr<const SceneState> next, std::size_t captured) {
    // Nothing may fail once steps have changed: the steps to be done again go last.
    const std::size_t present_bytes = bytes_of(*next);
    MemoryCharge charge = store_.charge_beside(sizeof(Step) + name.size());
    Step step{std::move(name), captured, removed_bytes(*present(), *next), std::move(next),
              std::move(charge)};
    steps_.insert(steps_.begin() + static_cast<std::ptrdiff_t>(place_), std::move(step));
    ++place_;
    while (steps_.size() > place_) steps_.pop_back();
    while (place_ > 0 && bytes_beside(present_bytes) > limit_) drop_oldest();
}

void History::drop_oldest() {
    first_ = steps_.front().state;
    steps_.pop_front();
    --place_;
    ++dropped_;
}

void History::clear() {
    first_ = present();
    steps_.clear();
    place_ = 0;
}

}  // namespace lissom
