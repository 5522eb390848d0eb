#include "viewer/window/painter.h"

#include <utility>

#include "kernel/core/error.h"

namespace lissom::window {

Painter::Painter(int threads, std::function<void()> done)
    : done_(std::move(done)), threads_(threads) {}

Painter::~Painter() {
    stop();
}

void Painter::draw(std::shared_ptr<const Picture> picture, std::uint64_t number) {
    stop();
    ContextOptions options;
    options.threads = threads_;
    context_.emplace(options);
    worker_.post_only([this, picture = std::move(picture), number, context = *context_] {
        paint(*picture, number, context);
    });
}

void Painter::stop() {
    if (context_) context_->cancel();
}

std::optional<Painter::Result> Painter::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(result_, std::nullopt);
}

void Painter::paint(const Picture& picture, std::uint64_t number, const Context& context) {
    Result result;
    result.number = number;
    try {
        if (!renderer_) renderer_ = std::make_unique<Renderer>();
        result.image = draw_picture(*renderer_, picture, context);
    } catch (const Error& error) {
        if (error.code() == ErrorCode::cancelled) return;
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
