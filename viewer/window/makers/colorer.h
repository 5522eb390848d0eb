/// Colorer: gives the pictures of a session the chosen colours, on a thread of its own: pictures
/// with their own colours pass at once.
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
    /// Reason for keeping its own colours; empty if it has the chosen ones.
    std::string error = {};
};

class Colorer {
  public:
    /// `done` is called on the colorer's thread when something is coloured.
    explicit Colorer(std::function<void()> done);
    ~Colorer();

    /// Colours `shown` next, instead of the waiting one.
    void show(Shown shown);
    /// Colours the last shown picture in another way.
    void choose(const Coloring& coloring);
    /// Makes the last shown picture the shape that others are compared with from now on.
    void compare_with_this();
    bool busy() const { return worker_.busy(); }
    const Coloring& coloring() const { return coloring_; }

    /// Returns the picture coloured since the last call.
    std::optional<Colored> take();

  private:
    void color();
    void finish(Colored colored, std::uint64_t number);

    std::function<void()> done_;
    Coloring coloring_;
    RestShapes rest_;
    // The last one shown by the session.
    std::optional<Shown> latest_;
    std::optional<Context> context_;
    // Number of the last request.
    std::uint64_t asked_ = 0;

    std::mutex mutex_;
    std::optional<Colored> result_;
    // Number of the result.
    std::uint64_t finished_ = 0;
    // Declared last: it ends before the objects that its jobs use.
    Worker worker_;
};

}  // namespace lissom::window
