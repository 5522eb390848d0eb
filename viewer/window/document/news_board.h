/// NewsBoard: results that the thread of a session leaves for its window. Safe from any thread.
#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <string>

#include "viewer/window/session/session_news.h"

namespace lissom::window {

class NewsBoard {
  public:
    /// `wake` is called when there is something new.
    explicit NewsBoard(std::function<void()> wake) : wake_(std::move(wake)) {}

    /// Adds a line of the console.
    void tell(LineKind kind, const std::string& text);
    /// Leaves a picture, and gives it the next number.
    void show(Shown& shown);
    /// Calls change(news) with the results that were not taken.
    template <typename Change>
    void change(const Change& change) {
        const std::lock_guard lock(mutex_);
        change(news_);
    }
    void wake() const { wake_(); }
    /// Returns the results since the last call.
    SessionNews take();

  private:
    std::function<void()> wake_;
    std::mutex mutex_;
    SessionNews news_;
    std::uint64_t number_ = 0;
};

}  // namespace lissom::window
