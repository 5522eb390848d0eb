/// Outputs of a job: made in a folder of their own, then moved to their place whole.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "bindings/cli/batch/digest.h"
#include "bindings/cli/batch/ledger.h"
#include "bindings/cli/batch/spare_folders.h"

namespace lissom::cli {

/// The work folder of one job.
class Staging {
  public:
    /// Makes an empty folder at `work` for an output; a folder also for the output itself if
    /// `makes_folder`. Errors: file_write_failed.
    Staging(std::filesystem::path work, const std::filesystem::path& output, bool makes_folder,
            SpareFolders& spares);
    /// Removes the folder, or keeps it among `spares` if all in it was published.
    ~Staging();
    Staging(const Staging&) = delete;
    Staging& operator=(const Staging&) = delete;

    /// Path that the script writes to.
    std::filesystem::path output() const { return work_ / output_.filename(); }

    /// Puts empty files in the place of files beside the output, so that the job chooses other
    /// names for its own.
    void hold(const std::set<std::filesystem::path>& names);

    /// Moves all files to the folder of the output, each on the disk before it is renamed, and
    /// removes those of `before` that were not made again. Returns their stamps, and adds to
    /// `folders` those that are to be flushed to the disk. Errors: file_not_found if the script
    /// made no output; file_write_failed, also if the output of another job has the place of a file
    /// with other content.
    std::vector<FileStamp> publish(const JobRecord* before, FileDigests& digests,
                                   std::set<std::filesystem::path>& folders);

    /// Returns the names beside the output for which `publish` has found files with other content.
    const std::set<std::filesystem::path>& taken() const { return taken_; }

  private:
    std::vector<std::filesystem::path> files() const;
    void require_output() const;
    void require_places(const std::vector<std::filesystem::path>& staged, const JobRecord* before,
                        FileDigests& digests);
    std::filesystem::path place_of(const std::filesystem::path& staged) const;
    bool is_taken(const std::filesystem::path& staged, const JobRecord* before,
                  FileDigests& digests) const;

    std::filesystem::path work_, output_;
    std::set<std::filesystem::path> held_, taken_;
    SpareFolders& spares_;
    bool is_published_ = false;
};

}  // namespace lissom::cli
