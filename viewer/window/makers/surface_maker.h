/// SurfaceMaker: what a graphics card is given of meshes, made on a thread of its own: of many
/// faces it takes longer than a window may be away.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "kernel/core/context.h"
#include "viewer/gl/gpu_scene.h"
#include "viewer/window/session/worker.h"

namespace lissom::window {

class SurfaceMaker {
  public:
    /// `done` is called on the maker's thread when something is ready.
    SurfaceMaker(int threads, std::function<void()> done);
    ~SurfaceMaker();

    /// Makes what `needs` says. The last that is asked for is made; what is under way then is made
    /// as well, so that something is seen while many follow each other.
    void make(std::vector<SurfaceNeeds> needs, std::uint64_t number);
    /// Ends what is not needed any more: to give much memory back takes long, too.
    void end(std::vector<PreparedSurface> surfaces);
    bool busy() const { return worker_.busy(); }

    struct Result {
        /// The caller's.
        std::uint64_t number = 0;
        std::vector<PreparedSurface> surfaces;
        /// Why there is nothing; empty where there is.
        std::string error;
    };
    /// What was made since the last call.
    std::optional<Result> take();

  private:
    void finish(Result result);

    Context context_;
    std::function<void()> done_;
    std::mutex mutex_;
    std::optional<Result> result_;
    // Last: it ends before what its jobs use.
    Worker worker_;
};

}  // namespace lissom::window
