#include "viewer/window/makers/painter.h"

#include <utility>

#include "kernel/core/error.h"
#include "viewer/lua/png_file.h"

namespace lissom::window {

Painter::Painter(int threads, std::function<void()> done)
    : done_(std::move(done)), threads_(threads) {}

Painter::~Painter() {
    stop();
    // The context of the renderer ends on the thread that it was made on.
    worker_.post_only([this] { renderer_.reset(); });
    worker_.wait_idle(10.0);
}

void Painter::draw(std::shared_ptr<const Picture> picture, std::uint64_t number, std::string path) {
    stop();
    ContextOptions options;
    options.threads = threads_;
    context_.emplace(options);
    worker_.post_only(
        [this, picture = std::move(picture), number, path = std::move(path), context = *context_] {
            paint(*picture, {number, {}, path, {}}, context);
        });
}

void Painter::stop() {
    if (context_) context_->cancel();
}

std::optional<Painter::Result> Painter::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(result_, std::nullopt);
}

void Painter::paint(const Picture& picture, Result result, const Context& context) {
    try {
        if (!renderer_) renderer_ = std::make_unique<Renderer>();
        result.image = draw_picture(*renderer_, picture, context);
        if (!result.path.empty()) save_picture(result.image, result.path, context);
    } catch (const Error& error) {
        if (error.code() == ErrorCode::cancelled) return;
        // Its context may be lost.
        renderer_.reset();
        result.error = error.message();
    } catch (const std::bad_alloc&) {
        result.error = "there is no memory for this picture";
    }
    {
        const std::lock_guard lock(mutex_);
        result_ = std::move(result);
    }
    done_();
}

}  // namespace lissom::window
