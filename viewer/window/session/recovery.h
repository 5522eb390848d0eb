/// Recovery: a copy of the scene on disk that outlives the program, for the case that it is killed.
#pragma once

#include <filesystem>
#include <vector>

namespace lissom::window {

class Recovery {
  public:
    /// The copy of this process, in `folder`, which is made when it is needed.
    explicit Recovery(std::filesystem::path folder);
    /// Takes the copy away: the program has ended well.
    ~Recovery();
    Recovery(const Recovery&) = delete;
    Recovery& operator=(const Recovery&) = delete;

    /// Where the copy belongs, for whoever writes it; its folder is there afterwards, if it can be.
    std::filesystem::path file() const;
    /// Keeps the copy, where there is one, as the one that was not saved last, and answers its
    /// path; empty where there is none.
    std::filesystem::path keep() const;

    /// Copies that processes left which run no more, the newest first.
    static std::vector<std::filesystem::path> left_in(const std::filesystem::path& folder);

  private:
    std::filesystem::path folder_;
};

/// The folder for what a program keeps between runs: lissom in $XDG_STATE_HOME, in ~/.local/state,
/// or among temporary files.
std::filesystem::path state_folder();

}  // namespace lissom::window
