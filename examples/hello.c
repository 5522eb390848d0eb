/* Bends a cactus from C, as a host does: the surface of every frame goes into floats of its own.
 *
 *     ./hello [bent.obj]
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <lissom/lissom.h>

static int fail(lissom_context* context) {
    const lissom_error* error = lissom_last_error(context);
    fprintf(stderr, "%s [%s]\n", error->message, error->code);
    lissom_context_destroy(context);
    return 1;
}

/* The handle in {"object": ID, ...}, as lissom_call answers. */
static uint64_t object_in(lissom_bytes json) {
    const char* found = strstr(json.data, "\"object\":");
    return found ? strtoull(found + strlen("\"object\":"), NULL, 10) : 0;
}

/* The rotation by `angle` radians about the z axis through `center`. */
static lissom_transform turned(double angle, const double center[3]) {
    const double c = cos(angle), s = sin(angle);
    lissom_transform map = lissom_identity();
    map.m[0] = c, map.m[1] = -s, map.m[3] = center[0] - c * center[0] + s * center[1];
    map.m[4] = s, map.m[5] = c, map.m[7] = center[1] - s * center[0] - c * center[1];
    return map;
}

int main(int argc, char** argv) {
    lissom_context* context = NULL;
    lissom_bytes json = {NULL, 0};
    lissom_mesh mesh = {0};
    lissom_region all = {0}, base = {0}, tip = {0};
    lissom_deformer deformer = {0};
    int32_t still = -1, moving = -1;
    double center[3];

    if (lissom_context_create(NULL, &context) != LISSOM_OK) return 1;
    /* A shape of the library; lissom_mesh_load reads one of yours. */
    if (lissom_call(context, "shapes.cactus", "[{\"vertices\": 9000}]", &json) != LISSOM_OK) {
        return fail(context);
    }
    mesh.id = object_in(json);

    if (lissom_region_all(context, mesh, &all) != LISSOM_OK ||
        lissom_region_named(context, mesh, "base", &base) != LISSOM_OK ||
        lissom_region_named(context, mesh, "tip", &tip) != LISSOM_OK ||
        lissom_deformer_create(context, mesh, all, NULL, &deformer) != LISSOM_OK ||
        lissom_deformer_add_handle(context, deformer, base, NULL, &still) != LISSOM_OK ||
        lissom_deformer_add_handle(context, deformer, tip, NULL, &moving) != LISSOM_OK ||
        lissom_deformer_handle_center(context, deformer, moving, center) != LISSOM_OK) {
        return fail(context);
    }

    /* Ten frames of a drag. `positions` could be a mapped vertex buffer. */
    const size_t rows = (size_t)lissom_deformer_row_count(context, deformer);
    float* positions = malloc(rows * 3 * sizeof(float));
    const lissom_output out = {positions, rows, 0, LISSOM_FLOAT32};
    lissom_status status = LISSOM_OK;
    for (int frame = 1; frame <= 10 && status == LISSOM_OK; ++frame) {
        const lissom_transform map = turned(0.1 * frame, center);
        status = lissom_deformer_set_transform(context, deformer, moving, &map);
        if (status == LISSOM_OK) status = lissom_deformer_solve(context, deformer, LISSOM_DRAFT);
        if (status == LISSOM_OK) status = lissom_deformer_read_positions(context, deformer, &out);
    }
    free(positions);
    if (status != LISSOM_OK) return fail(context);

    if (lissom_deformer_solve(context, deformer, LISSOM_FULL) != LISSOM_OK ||
        lissom_deformer_apply(context, deformer, mesh) != LISSOM_OK ||
        lissom_mesh_save(context, mesh, argc > 1 ? argv[1] : "bent.obj", NULL) != LISSOM_OK) {
        return fail(context);
    }
    printf("%d vertices, %.1f MB at most\n", lissom_mesh_vertex_count(context, mesh),
           (double)lissom_memory_peak(context) / 1e6);
    lissom_context_destroy(context);
    return 0;
}
