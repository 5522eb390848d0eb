/* The header as C99, and a call of each kind from C. */
#include "bindings/c/lissom.h"

int lissom_calls_from_c(void);

int lissom_calls_from_c(void) {
    lissom_context_options options = lissom_default_context_options();
    lissom_context* context = NULL;
    lissom_mesh mesh = {0};
    const double positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    const uint32_t corners[] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    const lissom_input points = {positions, 4, 0, LISSOM_FLOAT64};
    const lissom_input faces = {corners, 12, 0, LISSOM_UINT32};
    int count = -1;
    if (lissom_context_create(&options, &context) != LISSOM_OK) return -1;
    if (lissom_mesh_create(context, &points, &faces, NULL, &mesh) == LISSOM_OK) {
        count = lissom_mesh_triangle_count(context, mesh);
    }
    lissom_context_destroy(context);
    return count;
}
