#include "bindings/c/context.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>

#include "bindings/c/jobs.h"
#include "bindings/c/script_host.h"
#include "kernel/core/build_info.h"
#include "kernel/core/version.h"

namespace lissom::c {
namespace {

// Least and greatest number of bytes of a struct of options: of any version there may be.
constexpr std::size_t kMinOptions = 2 * sizeof(std::size_t), kMaxOptions = 4096;

// Ids that a context takes at a time, and the first: numbers that a host counts by itself are none.
constexpr std::uint64_t kIdBlock = 1024, kFirstId = std::uint64_t{1} << 32;

// The first id that no context has taken: the only state of the process.
std::uint64_t take_ids() {
    static std::atomic<std::uint64_t> free{kFirstId};
    return free.fetch_add(kIdBlock, std::memory_order_relaxed);
}

lissom_status status_of(ErrorCode code) {
    return static_cast<lissom_status>(static_cast<int>(code) + 1);
}
static_assert(static_cast<int>(ErrorCode::cancelled) + 1 == LISSOM_CANCELLED);
static_assert(static_cast<int>(ErrorCode::unknown_format) + 1 == LISSOM_UNKNOWN_FORMAT);
static_assert(static_cast<int>(ErrorCode::region_empty) + 1 == LISSOM_REGION_EMPTY);
static_assert(static_cast<int>(ErrorCode::internal) + 1 == LISSOM_INTERNAL);

// Sink of the host's reader. Errors must not pass through the host's function.
struct ReadCallback {
    const std::function<void(std::string_view)>* sink;
    std::exception_ptr failed = nullptr;

    static void take(void* argument, const void* bytes, std::size_t size) {
        auto& own = *static_cast<ReadCallback*>(argument);
        if (own.failed) return;
        try {
            (*own.sink)({static_cast<const char*>(bytes), size});
        } catch (...) {
            own.failed = std::current_exception();
        }
    }
};

FileTable files_of(const lissom_context_options& host) {
    FileTable files;
    if (host.read_file) {
        files.read = [read = host.read_file, user = host.user](
                         std::string_view path, const std::function<void(std::string_view)>& sink) {
            ReadCallback callback{&sink};
            const bool found = read(user, std::string(path).c_str(), ReadCallback::take, &callback);
            if (callback.failed) std::rethrow_exception(callback.failed);
            return found;
        };
    }
    if (host.write_file) {
        files.write = [write = host.write_file, user = host.user](std::string_view path,
                                                                  std::string_view bytes) {
            return write(user, std::string(path).c_str(), bytes.data(), bytes.size());
        };
    }
    return files;
}

}  // namespace

ContextOptions kernel_options(const lissom_context_options& host,
                              const std::atomic<MessageCounter*>& counter) {
    ContextOptions options;
    options.threads = host.threads;
    options.memory_limit = host.memory_limit;
    if (host.log) {
        options.log = [log = host.log, user = host.user, &counter](LogLevel level,
                                                                   std::string_view message) {
            MessageCounter* const hears = counter;
            if (hears && !hears->count(level, message.size())) return;
            log(user, static_cast<lissom_log_level>(level), std::string(message).c_str());
        };
    }
    if (host.progress) {
        options.progress = [tell = host.progress, user = host.user](std::string_view label,
                                                                    double fraction) {
            tell(user, std::string(label).c_str(), fraction);
        };
    }
    if (host.parallel_for) {
        using Chunk = const std::function<void(std::size_t)>;
        options.parallel_for = [loop = host.parallel_for, user = host.user](std::size_t count,
                                                                            Chunk& chunk) {
            const auto call = [](void* argument, std::size_t i) {
                (*static_cast<Chunk*>(argument))(i);
            };
            loop(user, count, call, const_cast<void*>(static_cast<const void*>(&chunk)));
        };
    }
    options.files = files_of(host);
    return options;
}

namespace {

Mat3 axes_of(const lissom_space& space) {
    Mat3 axes = Mat3::Identity();
    if (space.z_up) axes << 1, 0, 0, 0, 0, 1, 0, -1, 0;
    if (space.left_handed) axes.row(2) *= -1.0;
    return axes;
}

}  // namespace

void CallError::guard(FunctionRef<void()> work) noexcept {
    try {
        try {
            status = LISSOM_OK;
            message.clear();
            elements = {};
            work();
        } catch (const Error& error) {
            status = status_of(error.code());
            message = error.message();
            elements = error.elements();
        } catch (const StatusError& error) {
            status = error.status();
            message = error.what();
            elements = error.elements();
        } catch (const std::bad_alloc&) {
            status = LISSOM_MEMORY_LIMIT;
            message = "there is not enough memory";
        } catch (const std::exception& error) {
            status = LISSOM_INTERNAL;
            message = error.what();
        } catch (...) {
            status = LISSOM_INTERNAL;
            message = "an unknown exception was thrown";
        }
    } catch (...) {
        // The text of the error needs memory that there is not.
        status = LISSOM_MEMORY_LIMIT;
        message.clear();
        elements = {};
    }
}

// ---- Objects

std::uint64_t IdSource::next() {
    if (next_ == end_) {
        next_ = take_ids();
        end_ = next_ + kIdBlock;
    }
    return next_++;
}

std::uint64_t ObjectTable::add(Kind kind, std::shared_ptr<void> content, MemoryCharge charge) {
    const std::uint64_t id = ids_.next();
    Object& object = objects_[id];
    object.kind = kind;
    object.content = std::move(content);
    object.charge = std::move(charge);
    return id;
}

ObjectTable::Object* ObjectTable::find(std::uint64_t id, Kind kind) {
    const auto found = objects_.find(id);
    return found != objects_.end() && found->second.kind == kind ? &found->second : nullptr;
}

const ObjectTable::Object* ObjectTable::find(std::uint64_t id, Kind kind) const {
    return const_cast<ObjectTable*>(this)->find(id, kind);
}

void ObjectTable::for_each(FunctionRef<void(std::uint64_t, Object&)> visit) {
    for (auto& [id, object] : objects_) visit(id, object);
}

// ---- Space

Space::Space(const lissom_space& space)
    : axes_(axes_of(space)), reverses_(space.clockwise), mirrors_(space.left_handed) {}

Vec3 Space::to_kernel(const double p[3]) const {
    const Vec3 given(p[0], p[1], p[2]);
    require(given.allFinite(), "a coordinate is not finite", ErrorCode::not_finite);
    return axes_ * given;
}

Affine Space::to_kernel(const lissom_transform& transform) const {
    for (const double number : transform.m) {
        require(std::isfinite(number), "a number of the transform is not finite",
                ErrorCode::not_finite);
    }
    Affine map;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            map.linear(row, column) = transform.m[4 * row + column];
        }
        map.translation[row] = transform.m[4 * row + 3];
    }
    return {axes_ * map.linear * axes_.transpose(), axes_ * map.translation};
}

lissom_transform Space::to_host(const Affine& map) const {
    const Mat3 linear = axes_.transpose() * map.linear * axes_;
    const Vec3 translation = axes_.transpose() * map.translation;
    lissom_transform transform{};
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            transform.m[4 * row + column] = linear(row, column);
        }
        transform.m[4 * row + 3] = translation[row];
    }
    return transform;
}

// ---- Calls

lissom_status run(lissom_context* context, FunctionRef<void()> work) noexcept {
    if (!context) return LISSOM_INVALID_HANDLE;
    context->user_thread.store(std::this_thread::get_id(), std::memory_order_relaxed);
    context->error.guard(work);
    return context->error.status;
}

void require_given(const void* pointer, const char* name) {
    if (!pointer) throw Error(ErrorCode::invalid_argument, std::string(name) + " is NULL");
}

void copy_options(const void* given, std::size_t given_size, void* options, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(given);
    bool fits = given_size >= kMinOptions && given_size <= kMaxOptions;
    // Options of a later version must not be ignored silently.
    for (std::size_t i = size; fits && i < given_size; ++i) fits = bytes[i] == 0;
    if (!fits) {
        throw StatusError(LISSOM_BAD_STRUCT,
                          "the options do not come from their lissom_default_ function, or belong "
                          "to a later version");
    }
    std::memcpy(options, given, std::min(given_size, size));
}

const Mesh& shown_mesh(lissom_context& context, lissom_mesh mesh) {
    return context.readable<Mesh>(mesh.id, Kind::mesh);
}

std::shared_ptr<const Mesh> mesh_for_job(lissom_context& context, lissom_mesh mesh) {
    return std::make_shared<const Mesh>(shown_mesh(context, mesh));
}

Mesh& mesh_of(lissom_context& context, lissom_mesh mesh) {
    return context.content<Mesh>(mesh.id, Kind::mesh);
}

const Region& region_of(lissom_context& context, lissom_region region) {
    return context.content<Region>(region.id, Kind::region);
}

namespace {

// The text of an error; its explanation if there was no memory for one.
const char* message_of(const CallError& error) {
    const bool lost = error.status != LISSOM_OK && error.message.empty();
    return lost ? lissom_status_explanation(error.status) : error.message.c_str();
}

}  // namespace

}  // namespace lissom::c

using namespace lissom;
using namespace lissom::c;

lissom_context::lissom_context(const lissom_context_options& given)
    : options(given), space(given.space), kernel(kernel_options(given, message_counter)) {
    connect_scripts(*this);
}

lissom_context::~lissom_context() {
    // No job may still use the memory freed here.
    for (auto& [id, job] : jobs) job->context.cancel();
    for (auto& [id, job] : jobs) wait_for_job(*this, *job);
}

const std::shared_ptr<void>& lissom_context::shared(std::uint64_t id, Kind kind) {
    ObjectTable::Object* object = objects.find(id, kind);
    if (!object) {
        throw StatusError(LISSOM_INVALID_HANDLE,
                          "the handle names no such object of this context: it was released, is of "
                          "another kind, or comes from another context");
    }
    if (object->jobs > 0) {
        throw StatusError(LISSOM_BUSY, "a job works with the object; finish the job first");
    }
    return object->content;
}

std::uint64_t lissom_context::add_mesh(Mesh&& mesh) {
    return add(Kind::mesh, sharing.make_mesh(std::move(mesh)));
}

std::int32_t lissom_context::count(FunctionRef<std::int32_t()> work) noexcept {
    std::int32_t result = -1;
    const lissom_status status = run(this, [&] { result = work(); });
    return status == LISSOM_OK ? result : -1;
}

// ---- Contexts

extern "C" {

lissom_context_options lissom_default_context_options(void) {
    lissom_context_options options{};
    options.struct_size = sizeof options;
    options.threads = 1;
    return options;
}

lissom_status lissom_context_create(const lissom_context_options* options,
                                    lissom_context** context) {
    if (!context) return LISSOM_INVALID_ARGUMENT;
    CallError error;
    lissom_context_options taken{};
    error.guard([&] {
        taken = take_options(options, lissom_default_context_options());
        require(taken.threads >= 1, "threads must be 1 or more");
        require(!taken.enqueue == !taken.wait, "enqueue and wait belong together");
        *context = new lissom_context(taken);
    });
    // There is no context that could keep the error.
    if (error.status != LISSOM_OK && taken.log) {
        taken.log(taken.user, LISSOM_WARNING, error.message.c_str());
    }
    return error.status;
}

void lissom_context_destroy(lissom_context* context) {
    delete context;
}

const lissom_error* lissom_last_error(const lissom_context* context) {
    static constexpr lissom_error kNoContext{LISSOM_INVALID_HANDLE,
                                             "invalid_handle",
                                             "the context is NULL",
                                             LISSOM_NO_ELEMENT,
                                             0,
                                             nullptr,
                                             0};
    if (!context) return &kNoContext;
    // The text is made on demand: calls that succeed pay nothing.
    auto& own = *const_cast<lissom_context*>(context);
    const CallError& error = own.error;
    own.shown = {error.status,
                 error.status == LISSOM_OK ? "" : lissom_status_name(error.status),
                 message_of(error),
                 static_cast<lissom_element>(error.elements.kind),
                 error.elements.count,
                 error.elements.ids.data(),
                 error.elements.ids.size()};
    return &own.shown;
}

void lissom_cancel(lissom_context* context) {
    if (!context) return;
    context->kernel.cancel();
    const std::lock_guard lock(context->jobs_mutex);
    for (auto& [id, job] : context->jobs) job->context.cancel();
}

void lissom_clear_cancel(lissom_context* context) {
    if (context) context->kernel.clear_cancel();
}

size_t lissom_memory_used(const lissom_context* context) {
    return context ? context->kernel.memory()->used() : 0;
}

size_t lissom_memory_peak(const lissom_context* context) {
    return context ? context->kernel.memory()->peak() : 0;
}

size_t lissom_object_count(const lissom_context* context) {
    return context ? context->objects.size() : 0;
}

lissom_transform lissom_identity(void) {
    return {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}};
}

// ---- Version

int32_t lissom_version(void) {
    return LISSOM_VERSION_NUMBER;
}

const char* lissom_licence(void) {
    return build_info().licence;
}

const char* lissom_version_text(void) {
    return LISSOM_VERSION;
}

}  // extern "C"
