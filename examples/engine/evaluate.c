/* Moves a surface by a handle as a game does: with a saved basis and one header, without the
 * library.
 *
 *     lissom run examples/engine/bake.lua                   # writes out/cactus.basis
 *     cc -std=c99 examples/engine/evaluate.c $(pkg-config --cflags lissom) -lm -o evaluate
 *     ./evaluate out/cactus.basis tip 40 moved.xyz
 *
 * The arguments are the basis, the name of a handle, the degrees by which it turns about its own
 * center, and the file that the vertices are written to, one a line. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include <lissom/lissom_basis.h>

static void* read_file(const char* path, size_t* size) {
    FILE* const file = fopen(path, "rb");
    char* bytes = NULL;
    long length = -1;
    if (!file) return NULL;
    if (fseek(file, 0, SEEK_END) == 0) length = ftell(file);
    rewind(file);
    if (length > 0) bytes = malloc((size_t)length);
    *size = bytes ? fread(bytes, 1, (size_t)length, file) : 0;
    fclose(file);
    return bytes;
}

/* The rotation by `degrees` about the z axis through `center`. The centers of handles are relative
 * to the origin of the basis, as transforms must be: this one can be used as it is. */
static void turn(float* transform, const float center[3], double degrees) {
    const double radians = degrees * 3.14159265358979323846 / 180.0;
    const float c = (float)cos(radians), s = (float)sin(radians);
    lissom_basis_identity(transform);
    transform[0] = c, transform[1] = -s, transform[3] = center[0] - c * center[0] + s * center[1];
    transform[4] = s, transform[5] = c, transform[7] = center[1] - s * center[0] - c * center[1];
}

/* One frame: handles that no one touches have the identity. */
static void evaluate(const lissom_basis* basis, const float* transforms, float* positions) {
    const uint32_t half = basis->vertex_count / 2;
    /* Ranges of vertices do not depend on each other: each thread may take one. */
    lissom_basis_evaluate(basis, transforms, 0, half, positions, 3 * sizeof(float));
    lissom_basis_evaluate(basis, transforms, half, basis->vertex_count - half,
                          positions + 3 * (size_t)half, 3 * sizeof(float));
}

static int write_points(const char* path, const lissom_basis* basis, const float* positions) {
    FILE* const file = fopen(path, "w");
    uint32_t v;
    if (!file) return 0;
    for (v = 0; v < basis->vertex_count; ++v, positions += 3) {
        fprintf(file, "%.9g %.9g %.9g\n", basis->origin[0] + (double)positions[0],
                basis->origin[1] + (double)positions[1], basis->origin[2] + (double)positions[2]);
    }
    return fclose(file) == 0;
}

static int fail(const char* what, const char* about) {
    fprintf(stderr, "%s: %s\n", about, what);
    return 1;
}

int main(int count, char** arguments) {
    lissom_basis basis;
    lissom_basis_status status;
    size_t size = 0;
    uint32_t handle, h;
    void* bytes;
    float *transforms, *positions;

    if (count != 5) return fail("BASIS HANDLE DEGREES OUTPUT", "usage: evaluate");
    bytes = read_file(arguments[1], &size);
    if (!bytes) return fail("cannot be read", arguments[1]);
    status = lissom_basis_open(&basis, bytes, size);
    if (status != LISSOM_BASIS_OK) return fail(lissom_basis_status_text(status), arguments[1]);
    handle = lissom_basis_find_handle(&basis, arguments[2]);
    if (handle == basis.handle_count) return fail("there is no such handle", arguments[2]);

    transforms = malloc(12 * sizeof(float) * basis.handle_count);
    positions = malloc(3 * sizeof(float) * basis.vertex_count);
    if (!transforms || !positions) return fail("there is not enough memory", arguments[1]);
    for (h = 0; h < basis.handle_count; ++h) lissom_basis_identity(transforms + 12 * (size_t)h);
    turn(transforms + 12 * (size_t)handle, basis.handles[handle].center, atof(arguments[3]));
    evaluate(&basis, transforms, positions);
    if (!write_points(arguments[4], &basis, positions))
        return fail("cannot be written", arguments[4]);
    printf("%u vertices, %u handles: %s\n", (unsigned)basis.vertex_count,
           (unsigned)basis.handle_count, arguments[4]);

    free(positions);
    free(transforms);
    free(bytes);
    return 0;
}
