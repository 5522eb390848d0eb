/// Painter: draws finished pictures on a thread of its own, with all samples, shadows and strands:
/// those of lissom.render, to the pixel. The window shows them once nothing moves.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "kernel/core/context.h"
#include "viewer/render/picture.h"
#include "viewer/window/session/worker.h"

namespace lissom::window {

class Painter {
  public:
    /// `done` is called on the painter's thread when a picture is finished, or has failed.
    Painter(int threads, std::function<void()> done);
    ~Painter();

    /// Stops the current picture and draws `picture` instead, and writes it to `path`, a .png file,
    /// if that is not empty; `number` is the caller's.
    void draw(std::shared_ptr<const Picture> picture, std::uint64_t number, std::string path = {});
    /// Stops the current picture.
    void stop();
    bool busy() const { return worker_.busy(); }

    struct Result {
        std::uint64_t number = 0;
        Image image;
        /// The file that it was written to.
        std::string path;
        /// Reason for a missing image; empty if there is one.
        std::string error;
    };
    /// Returns the picture finished since the last call.
    std::optional<Result> take();

  private:
    void paint(const Picture& picture, Result result, const Context& context);

    std::function<void()> done_;
    int threads_;
    std::mutex mutex_;
    std::optional<Result> result_;
    /// Context of the last requested picture.
    std::optional<Context> context_;
    std::unique_ptr<Renderer> renderer_;
    // Declared last: it ends before the objects that its jobs use.
    Worker worker_;
};

}  // namespace lissom::window
