/// WorkControl: cancel and progress of the work of a session. Safe from any thread.
#pragma once

#include <atomic>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>

#include "bindings/cli/script.h"
#include "kernel/core/clock.h"

namespace lissom::window {

class WorkControl {
  public:
    explicit WorkControl(cli::Program& program) : program_(program) {}

    /// Begins a job, without the cancel and the progress of the last.
    void begin();
    /// Notes the progress of an operation, and the fraction done.
    void note(std::string_view stage, double fraction);
    /// Returns both.
    std::pair<std::string, double> progress() const;
    /// Returns the seconds since the last job began.
    double seconds() const;

    /// Stops the running work, but not a save; does nothing unless `busy`.
    void cancel(bool busy);
    /// Stops it because something else takes its place: nobody has to be told.
    void give_up(bool busy);
    bool is_given_up() const { return given_up_; }
    /// Begins the work that has taken its place.
    void go_on() { given_up_ = false; }
    /// Begins or ends a save, which is short and asked for: no cancel meant for other work stops
    /// it.
    void set_saving(bool saves);

  private:
    cli::Program& program_;
    std::atomic<bool> given_up_{false};
    // Guards `saves_`.
    std::mutex cancel_mutex_;
    bool saves_ = false;
    // Guards the others.
    mutable std::mutex mutex_;
    std::string stage_;
    double fraction_ = 0.0;
    Clock::time_point began_;
};

}  // namespace lissom::window
