#include "viewer/window/makers/colorer.h"

#include <algorithm>
#include <utility>

#include "kernel/core/error.h"

namespace lissom::window {

Colorer::Colorer(std::function<void()> done) : done_(std::move(done)) {}

Colorer::~Colorer() {
    if (context_) context_->cancel();
}

void Colorer::show(Shown shown) {
    rest_.see(*shown.picture);
    latest_ = std::move(shown);
    color();
}

void Colorer::choose(const Coloring& coloring) {
    coloring_ = coloring;
    color();
}

void Colorer::compare_with_this() {
    if (!latest_) return;
    rest_.forget();
    rest_.see(*latest_->picture);
    color();
}

std::optional<Colored> Colorer::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(result_, std::nullopt);
}

// A choice that the meshes do not have any more leaves them as they are, and waits.
void Colorer::color() {
    if (!latest_) return;
    const std::vector<Coloring> choices = colorings_of(*latest_->picture);
    const bool known = std::find(choices.begin(), choices.end(), coloring_) != choices.end();
    const std::uint64_t number = ++asked_;
    if (coloring_.by == Coloring::By::own || !known) return finish({*latest_}, number);
    context_.emplace();
    worker_.post_only([this, shown = *latest_, coloring = coloring_, rest = rest_.shapes(),
                       context = *context_, number] {
        Colored result{shown};
        try {
            result.shown.picture =
                std::make_shared<const Picture>(colored(*shown.picture, coloring, rest, context));
        } catch (const std::exception& error) {
            result.error = error.what();
        }
        finish(std::move(result), number);
        done_();
    });
}

// Drops results older than the last taken one.
void Colorer::finish(Colored colored, std::uint64_t number) {
    const std::lock_guard lock(mutex_);
    if (number < finished_) return;
    finished_ = number;
    result_ = std::move(colored);
}

}  // namespace lissom::window
