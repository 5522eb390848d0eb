/// Work of a host with the shared library, through its C interface alone.
#pragma once

#include "bindings/c/lissom.h"

namespace lissom::test {

/// A context that ends with its scope.
class WorkContext {
  public:
    explicit WorkContext(int threads = 1);
    ~WorkContext() { lissom_context_destroy(context_); }
    WorkContext(const WorkContext&) = delete;
    WorkContext& operator=(const WorkContext&) = delete;

    operator lissom_context*() const { return context_; }

  private:
    lissom_context* context_ = nullptr;
};

/// Returns a mesh that `lissom_call` makes.
lissom_mesh shape(lissom_context* context, const char* name, const char* options);

/// Bends a ball of 6 * segments * segments faces, `frames` times.
void deform_ball(lissom_context* context, int segments, int frames);
/// Joins two halves of such balls.
void merge_balls(lissom_context* context, int segments);
/// Grows a hairstyle of one stream on the library's head.
void grow_hair(lissom_context* context, int strands);
/// Encodes and decodes a ball.
void code_files(lissom_context* context, int segments);
/// Runs a script that fills a table.
void run_script(lissom_context* context, int entries);

}  // namespace lissom::test
