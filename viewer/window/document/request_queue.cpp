#include "viewer/window/document/request_queue.h"

namespace lissom::window {

void RequestQueue::post(ToolInput input) {
    const std::lock_guard lock(mutex_);
    last_setting_.reset();
    if (!takes_inputs_last_ || inputs_.empty()) {
        inputs_.emplace_back();
        takes_inputs_last_ = true;
        worker_.post(take_inputs_);
    }
    push_input(inputs_.back(), std::move(input));
}

void RequestQueue::post(Worker::Job job, bool stays) {
    const std::lock_guard lock(mutex_);
    takes_inputs_last_ = false;
    last_setting_.reset();
    worker_.post(std::move(job), stays);
}

void RequestQueue::post_only(Worker::Job job) {
    const std::lock_guard lock(mutex_);
    std::vector<ToolInput> kept;
    for (std::vector<ToolInput>& batch : std::exchange(inputs_, {})) {
        for (ToolInput& input : batch) {
            if (input.kind == ToolInput::Kind::look) kept = {std::move(input)};
        }
    }
    worker_.post_only(std::move(job));
    last_setting_.reset();
    takes_inputs_last_ = !kept.empty();
    if (kept.empty()) return;
    inputs_.push_back(std::move(kept));
    worker_.post(take_inputs_);
}

void RequestQueue::post(Setting setting, const std::function<void(const Setting&)>& use) {
    const std::lock_guard lock(mutex_);
    if (last_setting_ && last_setting_->first == setting.first) {
        last_setting_->second = std::move(setting.second);
        return;
    }
    const auto kept = std::make_shared<Setting>(std::move(setting));
    takes_inputs_last_ = false;
    last_setting_ = kept;
    worker_.post([this, kept, use] { use(taken(kept)); });
}

// Its value is no longer replaced by a newer one.
RequestQueue::Setting RequestQueue::taken(const std::shared_ptr<Setting>& setting) {
    const std::lock_guard lock(mutex_);
    if (last_setting_ == setting) last_setting_.reset();
    return *setting;
}

bool RequestQueue::has_setting() const {
    const std::lock_guard lock(mutex_);
    return last_setting_ != nullptr;
}

std::vector<ToolInput> RequestQueue::next_inputs() {
    const std::lock_guard lock(mutex_);
    if (inputs_.empty()) return {};
    std::vector<ToolInput> inputs = std::move(inputs_.front());
    inputs_.pop_front();
    return inputs;
}

}  // namespace lissom::window
