/// Context: services of the host. They are progress, cancel, log, threads and a memory account, one
/// per host and none of them global. A Context is a handle: copies share one state.
#pragma once

#include <atomic>
#include <concepts>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "kernel/core/index.h"

namespace lissom {

enum class LogLevel { debug, info, warning };

class MemoryAccount;

/// A host's own files: archives, assets, a database. Paths are passed on as given, in UTF-8.
struct FileTable {
    /// Passes the bytes of a file to `sink`, in one call or several. Returns false if the file does
    /// not exist. If it is set, the kernel opens no file for reading.
    std::function<bool(std::string_view path, const std::function<void(std::string_view)>& sink)>
        read;
    /// Replaces or creates a file. Returns false if that fails. If it is set, the kernel writes no
    /// file itself.
    std::function<bool(std::string_view path, std::string_view bytes)> write;
};

/// Services of the host. Every field is optional; without them the kernel is silent and serial.
struct ContextOptions {
    /// Receives messages; the kernel itself prints nothing.
    std::function<void(LogLevel, std::string_view message)> log;
    /// Receives progress: the name of the step and the fraction done, 0 to 1, never decreasing
    /// within one operation. Called on the thread that runs the operation.
    std::function<void(std::string_view label, double fraction)> progress;
    /// Runs `chunk(i)` once for each i in [0, chunk_count), in any order, on any threads, and
    /// returns when all have returned. Replaces the built-in loop.
    std::function<void(std::size_t chunk_count, const std::function<void(std::size_t)>& chunk)>
        parallel_for;
    /// Threads of the built-in loop; 1 starts none. Results do not depend on it.
    int threads = 1;
    /// Bytes that objects and operations may take at one time; 0 is no limit.
    std::size_t memory_limit = 0;
    /// Account charged by objects and operations. Contexts may share one; its limit then replaces
    /// `memory_limit`. Null: the context makes its own.
    std::shared_ptr<MemoryAccount> memory;
    /// Files of the host, read and written on the thread of the operation.
    FileTable files;
};

/// Bytes in use by objects of the kernel and by its operations, against a limit. Thread-safe.
class MemoryAccount {
  public:
    /// `limit` 0 is none. Charges also go to the account `within`, if given.
    explicit MemoryAccount(std::size_t limit, std::shared_ptr<MemoryAccount> within = nullptr)
        : limit_(limit), within_(std::move(within)) {}

    std::size_t limit() const { return limit_; }
    std::size_t used() const { return used_.load(std::memory_order_relaxed); }
    std::size_t peak() const { return peak_.load(std::memory_order_relaxed); }

    /// Adds `bytes`. Errors: memory_limit, and then nothing was added; `purpose` is named in it.
    void charge(std::size_t bytes, std::string_view purpose);
    void release(std::size_t bytes);

  private:
    friend class MemoryOverdraft;

    void require_room(std::size_t used, std::size_t bytes, std::string_view purpose) const;

    std::size_t limit_;
    std::shared_ptr<MemoryAccount> within_;
    std::atomic<std::size_t> used_{0};
    std::atomic<std::size_t> peak_{0};
    std::atomic<int> overdrafts_{0};
};

/// Suspends the limit of an account and of its parents while it lives: for the rollback of a failed
/// operation.
class MemoryOverdraft {
  public:
    explicit MemoryOverdraft(std::shared_ptr<MemoryAccount> account);
    ~MemoryOverdraft();
    MemoryOverdraft(const MemoryOverdraft&) = delete;
    MemoryOverdraft& operator=(const MemoryOverdraft&) = delete;

  private:
    std::shared_ptr<MemoryAccount> account_;
};

/// Holds a charge on an account for its own lifetime. Movable; it keeps the account alive.
class MemoryCharge {
  public:
    MemoryCharge() = default;
    MemoryCharge(std::shared_ptr<MemoryAccount> account, std::size_t bytes,
                 std::string_view purpose);
    MemoryCharge(MemoryCharge&& other) noexcept;
    MemoryCharge& operator=(MemoryCharge&& other) noexcept;
    MemoryCharge(const MemoryCharge&) = delete;
    MemoryCharge& operator=(const MemoryCharge&) = delete;
    ~MemoryCharge();

    std::size_t bytes() const { return bytes_; }

  private:
    std::shared_ptr<MemoryAccount> account_;
    std::size_t bytes_ = 0;
};

/// Handle to the state that operations run under. The default context is silent, serial and
/// unlimited.
class Context {
  public:
    Context();
    explicit Context(ContextOptions options);

    /// Asks running operations to stop: they throw `cancelled` at their next checkpoint and change
    /// nothing. Sticky: operations started later stop too, until `clear_cancel`. Thread-safe.
    void cancel() const;
    void clear_cancel() const;
    bool cancelled() const;
    /// Throws `cancelled` if cancel was asked for. Call it often in long loops.
    void checkpoint() const;

    void log(LogLevel level, std::string_view message) const;
    int threads() const;

    const FileTable& files() const;

    std::shared_ptr<MemoryAccount> memory() const;
    /// Returns the same context charging `account`, usually one within its own.
    Context charging(std::shared_ptr<MemoryAccount> account) const;
    /// Returns the same context, but for its files.
    Context with_files(FileTable files) const;
    /// Charges `bytes` for as long as the result lives. Errors: memory_limit.
    MemoryCharge charge(std::size_t bytes, std::string_view purpose) const;

    /// Runs `body(begin, end)` over [begin, end) in chunks of `grain` elements. Chunks are the same
    /// for any number of threads, so sums kept per chunk are reproducible. The first exception
    /// thrown by a body, in chunk order, is thrown again here once all chunks have ended. A cancel
    /// skips the chunks that have not started and throws `cancelled`.
    void parallel_for(Index begin, Index end, Index grain,
                      const std::function<void(Index, Index)>& body) const;

  private:
    friend class Progress;
    struct State;
    std::shared_ptr<State> state_;
    // Null: the state's.
    std::shared_ptr<MemoryAccount> account_;
    std::shared_ptr<const FileTable> files_;
};

/// Reports the progress of one operation. Open one at the top of a long operation; an operation
/// called inside it opens its own, which fills the step its caller announced. Lives on one thread,
/// as a local.
///
///     Progress progress(context, "deform: prepare");
///     progress.step(0.3);  // the code below is the next 30 %
///     assemble(context);   // may open its own Progress, which fills those 30 %
///     progress.step(0.7);
///     factor(context);
class Progress {
  public:
    Progress(const Context& context, std::string_view label);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Ends the step before and opens the next, a fraction of this operation (fractions sum to 1).
    /// A checkpoint: throws `cancelled`.
    void step(double fraction);
    /// Reports `fraction` (0 to 1) of the current step, or of the whole operation if no step is
    /// open. A checkpoint: throws `cancelled`.
    void update(double fraction);
    /// `done` of `all` steps.
    void update(std::integral auto done, std::integral auto all) {
        update(static_cast<double>(done) / static_cast<double>(all));
    }

  private:
    void report(double fraction);

    std::shared_ptr<Context::State> state_;
    Context context_;
    std::string label_;
    double outer_begin_, outer_end_;
    double step_begin_ = 0.0, step_end_ = 0.0;
};

}  // namespace lissom
