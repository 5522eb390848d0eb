/// Records of the jobs that have ended: one line of JSON each, in a file for each process that
/// writes them. A line that was cut is passed over.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bindings/cli/batch/digest.h"
#include "bindings/cli/batch/durable_files.h"

namespace lissom::cli {

/// The end of one job.
struct JobRecord {
    /// Path of the output, by which a job is known.
    std::string output;
    std::vector<std::pair<std::string, std::string>> arguments;
    /// "done", "failed", "timed_out" or "crashed".
    std::string outcome;
    /// Exit status, or the signal that ended the process.
    int status = 0;
    /// Last line of the error, or "".
    std::string message;
    /// Answer of a verb as JSON, or "".
    std::string result;
    /// Log of the last attempt, below the folder of the batch.
    std::string log;
    int attempts = 1, warnings = 0;
    /// Seconds of the last attempt, of its processors; its greatest memory in bytes.
    double seconds = 0.0, cpu_seconds = 0.0;
    std::uint64_t memory = 0;
    /// Time of the end, in milliseconds since 1970.
    std::int64_t time = 0;
    /// Digest of the program and its version.
    std::string program;
    /// The script, its modules and other files that were read; files that were written.
    std::vector<FileStamp> reads, outputs;

    bool is_done() const { return outcome == "done"; }
};

/// Returns a record as one line, and the record of a line. Throws on a line that is none.
std::string record_line(const JobRecord& record);
JobRecord read_record(const std::string& line);

class Ledger {
  public:
    /// Reads all records in a folder; none if it is missing. Later ones replace earlier ones of the
    /// same output.
    explicit Ledger(const std::filesystem::path& folder);

    /// Returns the last record of an output, or null.
    const JobRecord* find(const std::string& output) const;
    /// Writes records to the disk, into the folder, which must exist. Errors: file_write_failed.
    void add(const std::vector<JobRecord>& records);

    /// Reads the records that other processes have added.
    void refresh();

    const std::map<std::string, JobRecord>& records() const { return records_; }

  private:
    void read(const std::filesystem::path& file);

    std::filesystem::path folder_;
    GrowingFile file_;
    // Bytes of each file that were read, up to the end of a line.
    std::map<std::filesystem::path, std::streamoff> read_;
    std::map<std::string, JobRecord> records_;
};

}  // namespace lissom::cli
