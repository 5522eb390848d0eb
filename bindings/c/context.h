/// The state behind lissom_context: objects by handle, the last error, jobs; private to bindings/c.
#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "bindings/c/lissom.h"
#include "kernel/core/context.h"
#include "kernel/core/error.h"
#include "kernel/core/geometry.h"
#include "kernel/hair/strands/strands.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/region.h"

namespace lissom::c {

enum class Kind : std::uint8_t {
    none,
    mesh,
    region,
    deformer,
    merger,
    paste,
    hairstyle,
    strands,
    script,
    object,
    render_map,
    pose,
    pose_space,
};

/// A callable of the caller, for the time of a call: unlike a std::function it takes no memory.
template <typename Signature>
class FunctionRef;

template <typename Result, typename... Arguments>
class FunctionRef<Result(Arguments...)> {
  public:
    template <typename Function>
    FunctionRef(const Function& function)
        : function_(&function), call_([](const void* own, Arguments... arguments) -> Result {
              return (*static_cast<const Function*>(own))(std::forward<Arguments>(arguments)...);
          }) {}

    Result operator()(Arguments... arguments) const {
        return call_(function_, std::forward<Arguments>(arguments)...);
    }

  private:
    const void* function_;
    Result (*call_)(const void*, Arguments...);
};

/// A refusal that the kernel knows nothing of.
class StatusError : public std::exception {
  public:
    StatusError(lissom_status status, std::string message, Elements elements = {})
        : status_(status), message_(std::move(message)), elements_(std::move(elements)) {}

    const char* what() const noexcept override { return message_.c_str(); }
    lissom_status status() const { return status_; }
    const Elements& elements() const { return elements_; }

  private:
    lissom_status status_;
    std::string message_;
    Elements elements_;
};

/// The error of the last call, returned by lissom_last_error.
struct CallError {
    lissom_status status = LISSOM_OK;
    std::string message = {};
    Elements elements = {};

    /// Runs `work` and keeps its exceptions.
    void guard(FunctionRef<void()> work) noexcept;
};

/// Makes ids of objects and jobs. No other source of the process makes the same, so that stale and
/// foreign handles are told from others. They stay below 2^53, which JSON readers of doubles keep.
class IdSource {
  public:
    std::uint64_t next();

  private:
    std::uint64_t next_ = 0, end_ = 0;
};

/// Objects by handle.
class ObjectTable {
  public:
    struct Object {
        Kind kind = Kind::none;
        /// Jobs that work with it.
        int jobs = 0;
        std::shared_ptr<void> content;
        MemoryCharge charge;
        /// The content as it was when a job began to work with it, for reading; or null.
        std::shared_ptr<void> frozen = nullptr;
        /// Whether scripts know the object.
        bool scripted = false;
        /// Facts about the content that it does not hold itself, or null.
        std::shared_ptr<void> beside = nullptr;
    };

    std::uint64_t add(Kind kind, std::shared_ptr<void> content, MemoryCharge charge);
    /// Returns the object, or null for a handle that is not valid or of another kind.
    Object* find(std::uint64_t id, Kind kind);
    const Object* find(std::uint64_t id, Kind kind) const;
    /// Forgets an object, of any kind; nothing if there is none.
    void release(std::uint64_t id) noexcept { objects_.erase(id); }
    std::size_t size() const { return objects_.size(); }
    /// Returns a new id, for a job.
    std::uint64_t new_id() { return ids_.next(); }
    /// Calls visit(id, object) for every object, in the order in which they were made.
    void for_each(FunctionRef<void(std::uint64_t, Object&)> visit);

  private:
    IdSource ids_;
    std::map<std::uint64_t, Object> objects_;
};

/// Conversion between the host's space and the kernel's.
class Space {
  public:
    explicit Space(const lissom_space& space);

    Vec3 to_kernel(const Vec3& p) const { return axes_ * p; }
    Vec3 to_host(const Vec3& p) const { return axes_.transpose() * p; }
    /// Both of these throw NOT_FINITE if a number of the host is not finite.
    Affine to_kernel(const lissom_transform& transform) const;
    Vec3 to_kernel(const double p[3]) const;
    lissom_transform to_host(const Affine& map) const;
    /// Returns whether faces run the other way.
    bool reverses() const { return reverses_; }
    /// Returns whether the space is a mirror image of the kernel's.
    bool mirrors() const { return mirrors_; }

  private:
    Mat3 axes_;
    bool reverses_, mirrors_;
};

/// The last progress of a job, read from any thread.
class JobProgress {
  public:
    void tell(std::string_view label, double fraction);
    /// Writes the label, cut to `room` bytes with a zero at the end, and returns the fraction.
    double read(char* label, std::size_t room) const;

  private:
    mutable std::mutex mutex_;
    std::string label_;
    double fraction_ = 0.0;
};

/// Result of a job: handles of new objects in the order of the function's parameters.
struct JobResult {
    std::uint64_t objects[2] = {0, 0};
    std::optional<lissom_merge_report> report = {};
    /// Results of a script, made only if they are wanted.
    bool wants_json = false;
    lissom_bytes json{};
};

/// An object by its handle.
using Held = std::pair<std::uint64_t, Kind>;

/// Work to run beside the host's thread.
struct JobPlan {
    /// Objects that nothing else may change meanwhile.
    std::vector<Held> held = {};
    std::function<void(const Context&)> work;
    /// Takes over the result, on the host's thread; null for none.
    std::function<void(JobResult&)> take = nullptr;
    /// Called on the host's thread once the job is finished, whatever its end was; null for
    /// nothing.
    std::function<void()> end = nullptr;
};

struct Job {
    JobPlan plan;
    std::shared_ptr<JobProgress> progress;
    Context context;
    CallError error;
    std::atomic<bool> ended{false};
    void* task = nullptr;
};

/// Memory of normals that are read in every frame.
struct NormalsRoom {
    std::vector<Vec3> sums, found;
};

/// State of scripts and lissom_call; null if the library was built without Lua.
class ScriptHost;

/// Hears of messages before the host does.
class MessageCounter {
  public:
    MessageCounter() = default;
    MessageCounter(const MessageCounter&) = delete;
    MessageCounter& operator=(const MessageCounter&) = delete;
    virtual ~MessageCounter() = default;

    /// Returns whether the host may be told. Called on any thread.
    virtual bool count(LogLevel level, std::size_t bytes) noexcept = 0;
};

/// Hooks that make and change objects so that scripts can share them.
struct Sharing {
    std::function<std::shared_ptr<Mesh>(Mesh&&)> make_mesh = [](Mesh&& mesh) {
        return std::make_shared<Mesh>(std::move(mesh));
    };
    std::function<std::shared_ptr<Strands>(Strands&&)> make_strands = [](Strands&& strands) {
        return std::make_shared<Strands>(std::move(strands));
    };
    /// Call after a change of a mesh.
    std::function<void(const Mesh&)> changed = [](const Mesh&) {};
    /// Tells which mesh an object was made for.
    std::function<void(const void* object, const Mesh&)> belongs = [](const void*, const Mesh&) {};
};

}  // namespace lissom::c

struct lissom_context {
    explicit lissom_context(const lissom_context_options& given);
    ~lissom_context();
    lissom_context(const lissom_context&) = delete;
    lissom_context& operator=(const lissom_context&) = delete;

    lissom_context_options options;
    lissom::c::Space space;
    /// Null until scripts have limits.
    std::atomic<lissom::c::MessageCounter*> message_counter{nullptr};
    lissom::Context kernel;
    lissom::c::ObjectTable objects;
    /// Error of the last call; `shown` points into it.
    lissom::c::CallError error;
    lissom_error shown{};
    /// Memory that lissom_bytes and texts of reports point to.
    std::string bytes, text, more_text;
    /// Memory that lissom_contacts point to.
    std::vector<std::int32_t> faces;
    lissom::c::NormalsRoom normals;
    /// Jobs that were not finished; polled and cancelled from any thread.
    mutable std::mutex jobs_mutex;
    std::map<std::uint64_t, std::shared_ptr<lissom::c::Job>> jobs;
    /// The thread of the last call: lissom_last_error is for that one.
    std::atomic<std::thread::id> user_thread{std::this_thread::get_id()};
    lissom::c::Sharing sharing;
    std::shared_ptr<lissom::c::ScriptHost> scripts;

    std::uint64_t add_mesh(lissom::Mesh&& mesh);
    template <typename T>
    std::uint64_t add(lissom::c::Kind kind, std::shared_ptr<T> content,
                      std::size_t bytes_taken = 0) {
        return objects.add(kind, std::move(content),
                           kernel.charge(bytes_taken, "an object of the host"));
    }
    /// Returns the content of a valid handle that no job works with. Errors: StatusError.
    template <typename T>
    T& content(std::uint64_t id, lissom::c::Kind kind) {
        return *static_cast<T*>(shared(id, kind).get());
    }
    /// Returns the content for reading: as it was if a job works with it now. Errors: as content.
    template <typename T>
    const T& readable(std::uint64_t id, lissom::c::Kind kind) {
        const lissom::c::ObjectTable::Object* object = objects.find(id, kind);
        const bool is_frozen = object && object->jobs > 0 && object->frozen;
        return is_frozen ? *static_cast<const T*>(object->frozen.get()) : content<T>(id, kind);
    }
    template <typename T>
    std::shared_ptr<T> share(std::uint64_t id, lissom::c::Kind kind) {
        return std::static_pointer_cast<T>(shared(id, kind));
    }
    /// Returns the number of a list of an object, or -1 for an invalid handle.
    std::int32_t count(lissom::c::FunctionRef<std::int32_t()> work) noexcept;

  private:
    const std::shared_ptr<void>& shared(std::uint64_t id, lissom::c::Kind kind);
};

namespace lissom::c {

/// Runs a call: `work` throws its errors.
lissom_status run(lissom_context* context, FunctionRef<void()> work) noexcept;

/// Begins a job and gives its handle. Errors: INVALID_ARGUMENT if `job` is NULL.
void begin_job(lissom_context& context, JobPlan plan, lissom_job* job);

/// Throws INVALID_ARGUMENT, naming it, if a pointer is NULL.
void require_given(const void* pointer, const char* name);

/// Returns the options of a host over the defaults, for any version of the header. Errors:
/// BAD_STRUCT.
template <typename Options>
Options take_options(const Options* given, Options defaults);

void copy_options(const void* given, std::size_t given_size, void* options, std::size_t size);

template <typename Options>
Options take_options(const Options* given, Options defaults) {
    if (given) copy_options(given, given->struct_size, &defaults, sizeof(Options));
    return defaults;
}

/// Returns the mesh of a handle for reading, also while a job works with it.
const Mesh& shown_mesh(lissom_context& context, lissom_mesh mesh);
/// Returns a copy of it for a job, so that the mesh itself stays free.
std::shared_ptr<const Mesh> mesh_for_job(lissom_context& context, lissom_mesh mesh);
/// Returns the mesh of a handle.
Mesh& mesh_of(lissom_context& context, lissom_mesh mesh);
/// Returns the region of a handle.
const Region& region_of(lissom_context& context, lissom_region region);

}  // namespace lissom::c
