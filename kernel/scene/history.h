/// History: the states of a scene in the order in which steps made them; private to kernel/scene.
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <string>
#include <utility>

#include "kernel/core/context.h"
#include "kernel/scene/content_store.h"
#include "kernel/scene/scene_state.h"

namespace lissom {

/// A list of states with a place in it: steps before it can be undone, those behind it done again.
/// The limit bounds the bytes held beside the present state: the oldest steps go first.
class History {
  public:
    struct Step {
        std::string name;
        /// Bytes captured for it, and of live objects that it took out of the scene.
        std::size_t captured = 0, removed = 0;
        /// The state that it led to.
        std::shared_ptr<const SceneState> state;
        /// Memory of the step itself and its name.
        MemoryCharge charge;
    };

    /// Begins with `first`. The contents of all states are in `store`, which outlives the history.
    History(std::shared_ptr<const SceneState> first, std::size_t limit, const ContentStore& store)
        : store_(store), limit_(limit), first_(std::move(first)) {}

    const std::shared_ptr<const SceneState>& present() const { return state(place_); }
    /// Returns the state before the present one, or behind it; null if there is none.
    std::shared_ptr<const SceneState> before() const {
        return place_ ? state(place_ - 1) : nullptr;
    }
    std::shared_ptr<const SceneState> after() const {
        return place_ < steps_.size() ? state(place_ + 1) : nullptr;
    }
    const std::deque<Step>& steps() const { return steps_; }
    /// Returns the state after the first `i` steps.
    const std::shared_ptr<const SceneState>& state(std::size_t i) const {
        return i == 0 ? first_ : steps_[i - 1].state;
    }
    /// Number of steps that can be undone.
    std::size_t place() const { return place_; }
    /// Number of steps that went because of the limit.
    std::size_t dropped() const { return dropped_; }
    /// Bytes held beside the present state.
    std::size_t bytes() const;

    /// Moves the place to `before` or `after`, which is there.
    void go_back() { --place_; }
    void go_on() { ++place_; }
    /// Adds a step that leads from the present state to `next`, with `captured` bytes captured for
    /// it; steps to be done again go.
    void push(std::string name, std::shared_ptr<const SceneState> next, std::size_t captured);
    /// Forgets all steps, as if the present state had been the first.
    void clear();

  private:
    std::size_t bytes_beside(std::size_t present) const;
    void drop_oldest();

    const ContentStore& store_;
    std::size_t limit_;
    std::shared_ptr<const SceneState> first_;
    std::deque<Step> steps_;
    std::size_t place_ = 0, dropped_ = 0;
};

}  // namespace lissom
