/// Links between jobs and contexts; private to bindings/c.
#pragma once

#include "bindings/c/context.h"

namespace lissom::c {

/// Returns the kernel's options for the services of a host; `counter` hears its messages before.
ContextOptions kernel_options(const lissom_context_options& host,
                              const std::atomic<MessageCounter*>& counter);

/// Returns once the job has ended.
void wait_for_job(const lissom_context& context, Job& job);

/// Returns what can be read of an object while a job works with it, or null.
std::shared_ptr<void> frozen_content(lissom_context& context, std::uint64_t id, Kind kind);

/// The last frame of a deformer.
struct Frame {
    std::vector<Index> rows;
    std::vector<Vec3> positions, normals;
};

/// Returns the present frame of a deformer.
Frame frame_of(lissom_context& context, std::uint64_t deformer);

}  // namespace lissom::c
