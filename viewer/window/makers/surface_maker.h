/// SurfaceMaker: data of meshes for a graphics card, made on a thread of its own: for many faces it
/// takes longer than a window may be unresponsive.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "kernel/core/context.h"
#include "viewer/render/gl/gpu_scene.h"
#include "viewer/window/session/worker.h"

namespace lissom::window {

class SurfaceMaker {
  public:
    /// `done` is called on the maker's thread when something is ready.
    SurfaceMaker(int threads, std::function<void()> done);
    ~SurfaceMaker();

    /// Makes the surfaces of `needs`. The last request is made; the current one is made as well, so
    /// that something is seen while many follow each other.
    void make(std::vector<SurfaceNeeds> needs, std::uint64_t number);
    /// Frees surfaces: releasing much memory takes long, too.
    void end(std::vector<PreparedSurface> surfaces);
    bool busy() const { return worker_.busy(); }

    struct Result {
        /// The caller's.
        std::uint64_t number = 0;
        std::vector<PreparedSurface> surfaces;
        /// Reason for a missing result; empty if there is one.
        std::string error;
    };
    /// Returns the surfaces made since the last call.
    std::optional<Result> take();

  private:
    void finish(Result result);

    Context context_;
    std::function<void()> done_;
    std::mutex mutex_;
    std::optional<Result> result_;
    // Declared last: it ends before the objects that its jobs use.
    Worker worker_;
};

}  // namespace lissom::window
