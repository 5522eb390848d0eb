/// Recovery: a copy of the scene on disk that outlives the program, for the case that it is killed,
/// and beside it a journal: the calls that made the scene, as a script.
#pragma once

#include <exception>
#include <filesystem>
#include <vector>

namespace lissom::window {

class Recovery {
  public:
    /// The copy of this process, in `folder`, which is made when it is needed.
    explicit Recovery(std::filesystem::path folder);
    /// Takes the copy away: the program has ended well. If an error ends it the copy stays, for the
    /// next one to offer.
    ~Recovery();
    Recovery(const Recovery&) = delete;
    Recovery& operator=(const Recovery&) = delete;

    /// Returns the path of the copy, for its writer; its folder is there afterwards, if it can be.
    std::filesystem::path file() const;
    /// Returns the path of the journal.
    std::filesystem::path journal() const;
    /// Keeps both, if there is a copy, as a scene that was not saved, and returns the path of the
    /// copy; empty if there is none.
    std::filesystem::path keep() const;

    /// Copies and scenes that were not saved of processes which run no more, the newest first.
    static std::vector<std::filesystem::path> left_in(const std::filesystem::path& folder);
    /// Returns the journal left with a copy; empty if there is none.
    static std::filesystem::path journal_of(const std::filesystem::path& copy);
    /// Removes a left copy, with its journal.
    static void remove(const std::filesystem::path& copy);

  private:
    std::filesystem::path folder_;
    // Number of exceptions under way when it was made.
    int exceptions_ = std::uncaught_exceptions();
};

/// Returns the folder of a program's state between runs: lissom in $XDG_STATE_HOME, in
/// ~/.local/state, or among temporary files.
std::filesystem::path state_folder();

}  // namespace lissom::window
