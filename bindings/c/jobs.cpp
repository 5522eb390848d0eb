// Jobs: calls that run beside the host's thread.
#include "bindings/c/jobs.h"

#include <algorithm>
#include <cstring>

namespace lissom::c {

void JobProgress::tell(std::string_view label, double fraction) {
    const std::lock_guard lock(mutex_);
    label_ = label;
    fraction_ = fraction;
}

double JobProgress::read(char* label, std::size_t room) const {
    const std::lock_guard lock(mutex_);
    if (label && room > 0) {
        const std::size_t size = std::min(room - 1, label_.size());
        std::memcpy(label, label_.data(), size);
        label[size] = 0;
    }
    return fraction_;
}

void wait_for_job(const lissom_context& context, Job& job) {
    if (job.task) context.options.wait(context.options.user, std::exchange(job.task, nullptr));
    job.ended.wait(false, std::memory_order_acquire);
}

std::shared_ptr<void> frozen_content(lissom_context& context, std::uint64_t id, Kind kind) {
    if (kind == Kind::deformer) return std::make_shared<Frame>(frame_of(context, id));
    if (kind == Kind::mesh) return std::make_shared<Mesh>(context.content<Mesh>(id, kind));
    return nullptr;
}

namespace {

// A context of its own for a job, as operations of two threads cannot share one; the memory is that
// of the host's.
Context job_context(const lissom_context& context, const std::shared_ptr<JobProgress>& told) {
    ContextOptions options = kernel_options(context.options, context.message_counter);
    options.memory = context.kernel.memory();
    options.progress = [told, host = std::move(options.progress)](std::string_view label,
                                                                  double fraction) {
        told->tell(label, fraction);
        if (host) host(label, fraction);
    };
    return Context(std::move(options));
}

void run_job(void* argument) {
    auto& job = *static_cast<Job*>(argument);
    job.error.guard([&] {
        job.context.checkpoint();
        job.plan.work(job.context);
    });
    job.plan.work = nullptr;
    job.ended.store(true, std::memory_order_release);
    job.ended.notify_all();
}

// Objects of a job can be read as they are now, and change no more until it is finished.
void hold_objects(lissom_context& context, const Job& job) {
    std::vector<std::shared_ptr<void>> frozen;
    for (const auto& [id, kind] : job.plan.held) {
        frozen.push_back(frozen_content(context, id, kind));
    }
    for (std::size_t i = 0; i < frozen.size(); ++i) {
        auto* object = context.objects.find(job.plan.held[i].first, job.plan.held[i].second);
        object->frozen = std::move(frozen[i]);
        ++object->jobs;
    }
}

void free_objects(lissom_context& context, const Job& job) {
    for (const auto& [id, kind] : job.plan.held) {
        auto* object = context.objects.find(id, kind);
        if (object && --object->jobs == 0) object->frozen = nullptr;
    }
}

std::shared_ptr<Job> find_job(const lissom_context& context, lissom_job job) {
    const std::lock_guard lock(context.jobs_mutex);
    const auto found = context.jobs.find(job.id);
    return found == context.jobs.end() ? nullptr : found->second;
}

// A call that any thread may make: its error is told to the thread that uses the context alone.
lissom_status tell(const lissom_context* context, lissom_status status, const char* text) {
    if (!context ||
        context->user_thread.load(std::memory_order_relaxed) != std::this_thread::get_id()) {
        return status;
    }
    CallError& error = const_cast<lissom_context*>(context)->error;
    error.guard([&] {
        if (status != LISSOM_OK) throw StatusError(status, text);
    });
    return error.status;
}

lissom_status refuse_job(const lissom_context* context) {
    return tell(context, LISSOM_INVALID_HANDLE,
                "the context has no such job: it was finished, or is that of another");
}

// Gives up the job and its objects, and takes over its result or throws its error.
void finish_job(lissom_context& context, lissom_job job, JobResult& result) {
    const auto found = find_job(context, job);
    if (!found) {
        throw StatusError(LISSOM_INVALID_HANDLE,
                          "the context has no such job: it was finished, or is that of another");
    }
    wait_for_job(context, *found);
    free_objects(context, *found);
    {
        const std::lock_guard lock(context.jobs_mutex);
        context.jobs.erase(job.id);
    }
    struct End {
        const std::function<void()>& end;
        ~End() {
            if (end) end();
        }
    } const end{found->plan.end};
    CallError& error = found->error;
    if (error.status != LISSOM_OK) {
        throw StatusError(error.status, std::move(error.message), std::move(error.elements));
    }
    if (found->plan.take) found->plan.take(result);
}

// Forgets objects that the host does not take.
void drop_objects(lissom_context& context, const JobResult& result, std::size_t first) {
    for (std::size_t i = first; i < std::size(result.objects); ++i) {
        context.objects.release(result.objects[i]);
    }
}

void give_outcome(const JobResult& result, lissom_job_outcome* outcome) {
    lissom_job_outcome given = lissom_default_job_outcome();
    std::memcpy(&given, outcome, std::min(outcome->struct_size, sizeof given));
    std::copy(std::begin(result.objects), std::end(result.objects), given.objects);
    given.json = result.json;
    if (given.report && result.report) {
        lissom_merge_report told = *result.report;
        told.struct_size = given.report->struct_size;
        std::memcpy(given.report, &told, std::min(told.struct_size, sizeof told));
    }
    std::memcpy(outcome, &given, std::min(outcome->struct_size, sizeof given));
}

}  // namespace

void begin_job(lissom_context& context, JobPlan plan, lissom_job* job) {
    require_given(job, "job");
    const auto made = std::make_shared<Job>();
    made->progress = std::make_shared<JobProgress>();
    made->context = job_context(context, made->progress);
    made->plan = std::move(plan);
    const std::uint64_t id = context.objects.new_id();
    hold_objects(context, *made);
    try {
        const std::lock_guard lock(context.jobs_mutex);
        context.jobs.emplace(id, made);
    } catch (...) {
        free_objects(context, *made);
        throw;
    }
    if (context.kernel.cancelled()) made->context.cancel();
    if (context.options.enqueue) {
        made->task = context.options.enqueue(context.options.user, run_job, made.get());
    } else {
        run_job(made.get());
    }
    job->id = id;
}

}  // namespace lissom::c

using namespace lissom;
using namespace lissom::c;

extern "C" {

bool lissom_job_is_valid(const lissom_context* context, lissom_job job) {
    return context && find_job(*context, job);
}

lissom_status lissom_job_poll(const lissom_context* context, lissom_job job,
                              lissom_job_state* state) {
    const auto found = context ? find_job(*context, job) : nullptr;
    if (!found) return refuse_job(context);
    if (!state) return tell(context, LISSOM_INVALID_ARGUMENT, "state is NULL");
    *state = found->ended.load(std::memory_order_acquire) ? LISSOM_JOB_DONE : LISSOM_JOB_RUNNING;
    return tell(context, LISSOM_OK, "");
}

lissom_status lissom_job_progress(const lissom_context* context, lissom_job job, double* fraction,
                                  char* label, size_t label_size) {
    const auto found = context ? find_job(*context, job) : nullptr;
    if (!found) return refuse_job(context);
    if (!fraction) return tell(context, LISSOM_INVALID_ARGUMENT, "fraction is NULL");
    *fraction = found->progress->read(label, label_size);
    return tell(context, LISSOM_OK, "");
}

lissom_status lissom_job_cancel(const lissom_context* context, lissom_job job) {
    const auto found = context ? find_job(*context, job) : nullptr;
    if (!found) return refuse_job(context);
    found->context.cancel();
    return tell(context, LISSOM_OK, "");
}

lissom_status lissom_job_finish(lissom_context* context, lissom_job job, uint64_t* result) {
    return run(context, [&] {
        JobResult made;
        finish_job(*context, job, made);
        drop_objects(*context, made, result ? 1 : 0);
        if (result) *result = made.objects[0];
    });
}

lissom_job_outcome lissom_default_job_outcome(void) {
    lissom_job_outcome outcome{};
    outcome.struct_size = sizeof outcome;
    return outcome;
}

lissom_status lissom_job_finish_with(lissom_context* context, lissom_job job,
                                     lissom_job_outcome* outcome) {
    return run(context, [&] {
        require_given(outcome, "outcome");
        const auto given = take_options(outcome, lissom_default_job_outcome());
        if (given.report) take_options(given.report, lissom_default_merge_report());
        JobResult made;
        made.wants_json = true;
        finish_job(*context, job, made);
        give_outcome(made, outcome);
    });
}

}  // extern "C"
