#include "viewer/window/makers/surface_maker.h"

#include <exception>
#include <utility>

#include "kernel/core/error.h"

namespace lissom::window {
namespace {

Context surface_context(int threads) {
    ContextOptions options;
    options.threads = threads;
    return Context(options);
}

}  // namespace

SurfaceMaker::SurfaceMaker(int threads, std::function<void()> done)
    : context_(surface_context(threads)), done_(std::move(done)) {}

SurfaceMaker::~SurfaceMaker() {
    context_.cancel();
}

void SurfaceMaker::make(std::vector<SurfaceNeeds> needs, std::uint64_t number) {
    worker_.post_only([this, needs = std::move(needs), number] {
        Result result{number, {}, {}};
        try {
            for (const SurfaceNeeds& one : needs) {
                result.surfaces.push_back(prepare(one, context_));
            }
        } catch (const Error& error) {
            if (error.code() == ErrorCode::cancelled) return;
            result.error = error.message();
        } catch (const std::bad_alloc&) {
            result.error = "there is no memory to show this";
        }
        finish(std::move(result));
    });
}

void SurfaceMaker::end(std::vector<PreparedSurface> surfaces) {
    worker_.post([ended = std::make_shared<std::vector<PreparedSurface>>(std::move(surfaces))] {
        ended->clear();
    });
}

void SurfaceMaker::finish(Result result) {
    {
        const std::lock_guard lock(mutex_);
        result_ = std::move(result);
    }
    done_();
}

std::optional<SurfaceMaker::Result> SurfaceMaker::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(result_, std::nullopt);
}

}  // namespace lissom::window
