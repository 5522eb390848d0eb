/// RequestQueue: jobs and the input of a hand for the thread of a session, in the order of the
/// requests. Safe from any thread.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "bindings/lua/core/script_parameters.h"
#include "viewer/window/session/worker.h"
#include "viewer/window/tools/tool_input.h"

namespace lissom::window {

class RequestQueue {
  public:
    /// `take_inputs` is the job of a batch of inputs: it gets them by `next_inputs`.
    explicit RequestQueue(Worker::Job take_inputs) : take_inputs_(std::move(take_inputs)) {}

    /// Adds input of a hand. It keeps its place among all requests: inputs after another job wait
    /// for it.
    void post(ToolInput input);
    /// Adds a job; see Worker::post.
    void post(Worker::Job job, bool stays = false);
    /// Adds a job instead of those that wait; but the view known by now counts for the next ones.
    void post_only(Worker::Job job);
    /// Adds a value of a parameter for `use`. If the last waiting job sets the same parameter, the
    /// newer value takes its place.
    using Setting = std::pair<std::string, lua::ParameterValue>;
    void post(Setting setting, const std::function<void(const Setting&)>& use);
    /// Returns whether a value of a parameter is the last waiting job.
    bool has_setting() const;
    /// Returns the next batch of inputs.
    std::vector<ToolInput> next_inputs();

    bool busy() const { return worker_.busy(); }
    /// Waits until nothing runs, `seconds` at most; returns whether that is so.
    bool wait_idle(double seconds) { return worker_.wait_idle(seconds); }

  private:
    Setting taken(const std::shared_ptr<Setting>& setting);

    Worker::Job take_inputs_;
    mutable std::mutex mutex_;
    // Each is taken by a job of its own; the last of them grows while no other job follows it.
    std::deque<std::vector<ToolInput>> inputs_;
    bool takes_inputs_last_ = false;
    // The last waiting job, if it sets a parameter of the tool.
    std::shared_ptr<Setting> last_setting_;
    Worker worker_;
};

}  // namespace lissom::window
