/* A host of the C ABI that opens a context and closes it. */
#include "bindings/c/lissom.h"

int main(void) {
    lissom_context* context = NULL;
    if (lissom_context_create(NULL, &context) != LISSOM_OK) return 1;
    lissom_context_destroy(context);
    return 0;
}
