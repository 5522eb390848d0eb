#include "viewer/window/document/shown_pictures.h"

#include <memory>
#include <utility>

#include "kernel/core/error.h"

namespace lissom::window {

void ShownPictures::show(Picture picture, std::vector<std::string> names) {
    Picture frozen = frozen_.freeze(std::move(picture));
    Shown next;
    next.names = std::move(names);
    try {
        next.snapshot = snapshot_of(frozen);
        next.bounds = bounds_.of(next.snapshot);
    } catch (const Error& error) {
        return news_.tell(LineKind::error, error.message());
    }
    next.picture = std::make_shared<const Picture>(std::move(frozen));
    news_.show(next);
    last_ = std::move(next);
    news_.wake();
}

void ShownPictures::show_last() {
    if (last_) news_.show(*last_);
}

void ShownPictures::show_again(const std::optional<Shown>& shown) {
    if (!shown || !last_ || last_->number == shown->number) return;
    last_ = shown;
    show_last();
}

}  // namespace lissom::window
