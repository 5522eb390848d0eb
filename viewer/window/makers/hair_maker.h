/// HairMaker: makes strands ready for the graphics card, and their light, on a thread of its own:
/// few strands and rough light at once, then all.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "kernel/core/context.h"
#include "viewer/render/draw/snapshot.h"
#include "viewer/render/gl/gpu_hair.h"
#include "viewer/window/session/worker.h"

namespace lissom::window {

class HairMaker {
  public:
    /// `done` is called on the maker's thread when something is ready.
    HairMaker(int threads, std::function<void()> done);
    ~HairMaker();

    /// Makes the hair of `snapshot` instead of the current one; nothing if its strands and meshes
    /// are those of the last one.
    void make(const Snapshot& snapshot);
    /// The next call of `make` makes its hair again in any case.
    void forget() { last_.reset(); }
    /// Finds the light of `light` for a camera that turns the world by `to_view`, after that;
    /// `number` is the caller's. Replaces the earlier request.
    void direct(std::shared_ptr<const HairLight> light, const Mat3& to_view, std::uint64_t number);
    /// Gives that up.
    void stop_directing();
    bool busy() const { return worker_.busy(); }

    struct Result {
        Hair hair;
        /// Reason for missing hair; empty if it is there.
        std::string error;
    };
    /// Returns the hair made since the last call.
    std::optional<Result> take();

    struct Directed {
        std::uint64_t number = 0;
        std::shared_ptr<const HairLight> light;
        /// HairLight::directed; empty if there is no memory for it.
        std::vector<std::uint8_t> bytes;
    };
    std::optional<Directed> take_directed();

  private:
    Context context() const;
    std::vector<HairPart> parts_of(const Snapshot& snapshot, bool few_only,
                                   const Context& context) const;
    Hair few_of(const Snapshot& snapshot, const Context& context) const;
    Hair all_of(const Snapshot& snapshot, const Context& context);
    void finish(Result result);

    int threads_;
    std::function<void()> done_;
    std::optional<Snapshot> last_;
    std::optional<Context> making_, directing_;

    // The maker's thread: complete parts stay for the next snapshot.
    std::vector<HairPart> complete_;

    std::mutex mutex_;
    std::optional<Result> result_;
    std::optional<Directed> directed_;
    // Declared last: it ends before the objects that its jobs use.
    Worker worker_;
};

}  // namespace lissom::window
