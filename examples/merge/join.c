/* Cuts two models and joins them from C: the head of one on the body of the other.
 *
 *     ./join head.obj body.obj joined.obj
 */
#include <stdio.h>

#include <lissom/lissom.h>

static int fail(lissom_context* context) {
    const lissom_error* error = lissom_last_error(context);
    fprintf(stderr, "%s [%s]\n", error->message, error->code);
    lissom_context_destroy(context);
    return 1;
}

/* The part of a model above the middle of its height, or below. */
static lissom_status half(lissom_context* context, const char* path, double up, lissom_mesh* part) {
    const double normal[3] = {0, up, 0};
    double least[3], greatest[3], middle[3];
    lissom_mesh mesh;
    lissom_status status = lissom_mesh_load(context, path, NULL, &mesh);
    if (status == LISSOM_OK) status = lissom_mesh_bounds(context, mesh, least, greatest);
    if (status != LISSOM_OK) return status;
    for (int k = 0; k < 3; ++k) middle[k] = 0.5 * (least[k] + greatest[k]);
    return lissom_cut_by_plane(context, mesh, middle, normal, NULL, part, NULL);
}

int main(int argc, char** argv) {
    lissom_context* context = NULL;
    lissom_mesh head = {0}, body = {0}, joined = {0};
    lissom_merger merger = {0};
    lissom_merge_report report = lissom_default_merge_report();
    /* Boundary 0 of each, and no keys: the best fit is taken. */
    const lissom_join join = {0, 0, 0, NULL, NULL, 0};

    if (argc != 4) {
        fprintf(stderr, "usage: join HEAD BODY JOINED\n");
        return 2;
    }
    if (lissom_context_create(NULL, &context) != LISSOM_OK) return 1;
    if (half(context, argv[1], 1, &head) != LISSOM_OK ||
        half(context, argv[2], -1, &body) != LISSOM_OK ||
        lissom_merger_create(context, head, &body, 1, &join, 1, NULL, &merger) != LISSOM_OK ||
        lissom_merger_solve(context, merger, &joined, &report) != LISSOM_OK) {
        return fail(context);
    }
    printf("scale %.3f; %s\n%s", report.scale, report.verdict, report.warnings);
    if (lissom_mesh_save(context, joined, argv[3], NULL) != LISSOM_OK) return fail(context);
    lissom_context_destroy(context);
    return 0;
}
