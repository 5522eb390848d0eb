/// Jobs that one process runs, one after the other.
#pragma once

#include <memory>
#include <vector>

#include "bindings/cli/batch/attempt.h"

namespace lissom::cli {

using Attempts = std::vector<std::unique_ptr<Attempt>>;

class JobPack {
  public:
    /// Starts a process for attempts that are free. It ends the attempts before their locks go.
    JobPack(Attempts attempts, const BatchOptions& options);
    ~JobPack() { process_.reset(); }
    JobPack(const JobPack&) = delete;
    JobPack& operator=(const JobPack&) = delete;

    const ChildProcess& process() const { return *process_; }
    bool has_ended() const { return process_->has_ended(); }

    /// Returns the attempts that have ended since the last call. The attempt at which the process
    /// died is one of them, the attempts behind it are not.
    Attempts take_ended();
    /// Returns the attempts that a process that has ended did not come to.
    Attempts take_others();

  private:
    // A job alone has ended with its process, in a pack with its news.
    bool is_alone() const { return attempts_.size() == 1; }
    void take(const std::string& line, Attempts& ended);
    void end_current(const ProcessEnd& end, Attempts& ended);
    void kill_if_late();

    Attempts attempts_;
    double timeout_;
    std::size_t current_ = 0;
    bool is_late_ = false;
    std::unique_ptr<ChildProcess> process_;
};

}  // namespace lissom::cli
