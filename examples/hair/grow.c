/* Grows hair on a head from C: one curve on either side, and a parting between them.
 *
 *     ./grow head.obj hair.hair
 */
#include <stdio.h>

#include <lissom/lissom.h>

static int fail(lissom_context* context) {
    const lissom_error* error = lissom_last_error(context);
    fprintf(stderr, "%s [%s]\n", error->message, error->code);
    lissom_context_destroy(context);
    return 1;
}

/* A curve through directions from the middle of the head: azimuth, elevation, metres above the
 * skin. */
static lissom_status add_curve(lissom_context* context, lissom_hairstyle style,
                               const double directions[][3], size_t count, int divides) {
    double points[8][3];
    const lissom_input list = {points, count, 0, LISSOM_FLOAT64};
    lissom_status status = LISSOM_OK;
    int32_t curve = -1;
    for (size_t i = 0; i < count && status == LISSOM_OK; ++i) {
        status = lissom_hairstyle_at(context, style, directions[i][0], directions[i][1],
                                     directions[i][2], points[i]);
    }
    if (status != LISSOM_OK) return status;
    return divides ? lissom_hairstyle_add_dividing(context, style, &list, &curve)
                   : lissom_hairstyle_add_stream(context, style, &list, &curve);
}

int main(int argc, char** argv) {
    static const double left[][3] = {{.2, 1.05, .01}, {1.3, .6, .02}, {1.57, -.35, .02}};
    static const double right[][3] = {{-.2, 1.05, .01}, {-1.3, .6, .02}, {-1.57, -.35, .02}};
    static const double parting[][3] = {{0, .7, 0}, {0, 1.4, 0}};
    lissom_context* context = NULL;
    lissom_mesh head = {0};
    lissom_hairstyle style = {0};
    lissom_strands hair = {0};
    lissom_grow_options options = lissom_default_grow_options();
    options.count = 20000;

    if (argc != 3) {
        fprintf(stderr, "usage: grow HEAD HAIR\n");
        return 2;
    }
    if (lissom_context_create(NULL, &context) != LISSOM_OK) return 1;
    if (lissom_mesh_load(context, argv[1], NULL, &head) != LISSOM_OK ||
        lissom_hairstyle_create(context, head, NULL, &style) != LISSOM_OK ||
        add_curve(context, style, left, 3, 0) != LISSOM_OK ||
        add_curve(context, style, right, 3, 0) != LISSOM_OK ||
        add_curve(context, style, parting, 2, 1) != LISSOM_OK ||
        lissom_hairstyle_grow(context, style, &options, &hair) != LISSOM_OK ||
        lissom_strands_save(context, hair, argv[2]) != LISSOM_OK) {
        return fail(context);
    }
    printf("%d strands, %d points\n", lissom_strands_size(context, hair),
           lissom_strands_point_count(context, hair));
    lissom_context_destroy(context);
    return 0;
}
