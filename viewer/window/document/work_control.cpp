#include "viewer/window/document/work_control.h"

#include "bindings/cli/terminal/interrupt.h"

namespace lissom::window {

void WorkControl::begin() {
    program_.forget_interrupt();
    const std::lock_guard lock(mutex_);
    stage_.clear();
    fraction_ = 0.0;
    began_ = Clock::now();
}

void WorkControl::note(std::string_view stage, double fraction) {
    const std::lock_guard lock(mutex_);
    stage_ = stage;
    fraction_ = fraction;
}

std::pair<std::string, double> WorkControl::progress() const {
    const std::lock_guard lock(mutex_);
    return {stage_, fraction_};
}

double WorkControl::seconds() const {
    const std::lock_guard lock(mutex_);
    return seconds_since(began_);
}

void WorkControl::cancel(bool busy) {
    const std::lock_guard lock(cancel_mutex_);
    if (busy && !saves_) cli::Interrupt::press();
}

void WorkControl::give_up(bool busy) {
    given_up_ = true;
    cancel(busy);
}

void WorkControl::set_saving(bool saves) {
    const std::lock_guard lock(cancel_mutex_);
    saves_ = saves;
    if (saves) program_.forget_interrupt();
}

}  // namespace lissom::window
