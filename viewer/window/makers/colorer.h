/// Colorer: gives what a session shows the colours that a person has chosen, on a thread of its
/// own: what has its own colours passes at once.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "kernel/core/context.h"
#include "viewer/window/makers/coloring.h"
#include "viewer/window/session/session.h"
#include "viewer/window/session/worker.h"

namespace lissom::window {

struct Colored {
    Shown shown;
    /// Why it has its own colours; empty where it has those that were chosen.
    std::string error = {};
};

class Colorer {
  public:
    /// `done` is called on the colorer's thread when something is coloured.
    explicit Colorer(std::function<void()> done);
    ~Colorer();

    /// Colours `shown` next, instead of what waits.
    void show(Shown shown);
    /// Colours what was shown last in another way.
    void choose(const Coloring& coloring);
    /// What was shown last is the shape that others are compared with from now on.
    void compare_with_this();
    bool busy() const { return worker_.busy(); }
    const Coloring& coloring() const { return coloring_; }

    /// What was coloured since the last call.
    std::optional<Colored> take();

  private:
    void color();
    void finish(Colored colored, std::uint64_t number);

    std::function<void()> done_;
    Coloring coloring_;
    RestShapes rest_;
    // As the session has shown it.
    std::optional<Shown> latest_;
    std::optional<Context> context_;
    // Of what was asked for last.
    std::uint64_t asked_ = 0;

    std::mutex mutex_;
    std::optional<Colored> result_;
    // Of the result.
    std::uint64_t finished_ = 0;
    // Last: it ends before what its jobs use.
    Worker worker_;
};

}  // namespace lissom::window
