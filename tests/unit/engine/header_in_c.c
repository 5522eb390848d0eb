#include "tests/unit/engine/header_in_c.h"

#include "bindings/engine/lissom_basis.h"
#include "bindings/engine/lissom_hair.h"

#define MOST_HANDLES 8

int evaluate_in_c(const void* bytes, size_t size, const double* transforms, size_t handle_count,
                  uint32_t first, uint32_t count, float* out) {
    lissom_basis basis;
    float local[12 * MOST_HANDLES];
    size_t h;
    const lissom_basis_status status = lissom_basis_open(&basis, bytes, size);
    if (status != LISSOM_BASIS_OK) return (int)status;
    if (basis.handle_count != handle_count || handle_count > MOST_HANDLES) return -1;
    for (h = 0; h < handle_count; ++h) {
        lissom_basis_local(&basis, transforms + 12 * h, local + 12 * h);
    }
    lissom_basis_evaluate(&basis, local, first, count, out, 3 * sizeof(float));
    return (int)status;
}

int rebuild_in_c(const void* bytes, size_t size, uint32_t count, float* out) {
    lissom_hair hair;
    const lissom_hair_status status = lissom_hair_open(&hair, bytes, size);
    if (status != LISSOM_HAIR_OK) return (int)status;
    lissom_hair_rebuild(&hair, (const float*)0, (const float*)0, 0, count, out);
    return (int)status;
}
