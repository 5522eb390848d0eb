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
    /// Takes the copy away: the program has ended well. Where an error ends it the copy stays, for
    /// the next one to offer.
    ~Recovery();
    Recovery(const Recovery&) = delete;
    Recovery& operator=(const Recovery&) = delete;

    /// Where the copy belongs, for whoever writes it; its folder is there afterwards, if it can be.
    std::filesystem::path file() const;
    /// Where the journal belongs.
    std::filesystem::path journal() const;
    /// Keeps both, where there is a copy, as a scene that was not saved, and answers the path of
    /// the copy; empty where there is none.
    std::filesystem::path keep() const;

    /// Copies and scenes that were not saved of processes which run no more, the newest first.
    static std::vector<std::filesystem::path> left_in(const std::filesystem::path& folder);
    /// The journal that was left with a copy; empty where there is none.
    static std::filesystem::path journal_of(const std::filesystem::path& copy);
    /// Takes away what was left, with its journal.
    static void remove(const std::filesystem::path& copy);

  private:
    std::filesystem::path folder_;
    // Of errors that were on their way when it was made.
    int exceptions_ = std::uncaught_exceptions();
};

/// The folder for what a program keeps between runs: lissom in $XDG_STATE_HOME, in ~/.local/state,
/// or among temporary files.
std::filesystem::path state_folder();

}  // namespace lissom::window
