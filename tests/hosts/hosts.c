/* Runs a script of examples/hosts by the C interface, as hosts.lua does: hosts FOLDER NAME. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bindings/c/lissom.h"

static void check(lissom_context* context, lissom_status status) {
    if (status == LISSOM_OK) return;
    fprintf(stderr, "%s\n", lissom_last_error(context)->message);
    exit(1);
}

/* The whole file; NULL if it cannot be read. */
static char* read_text(const char* path, size_t* size) {
    const size_t limit = 1 << 16;
    FILE* file = fopen(path, "rb");
    char* text = file ? malloc(limit) : NULL;
    if (text) *size = fread(text, 1, limit, file);
    if (file) fclose(file);
    return text;
}

/* A copy of the results, which the next call with the context frees. */
static char* copy_of(lissom_bytes json) {
    char* copy = malloc(json.size + 1);
    if (copy) memcpy(copy, json.data, json.size + 1);
    return copy;
}

/* Prints the hash of the object of a kind with this id. */
static void print_hash(lissom_context* context, const char* name, const char* kind,
                       unsigned long long id) {
    char call[32], arguments[64];
    lissom_bytes hash = {NULL, 0};
    snprintf(call, sizeof call, "%s.hash", kind);
    snprintf(arguments, sizeof arguments, "[{\"object\": %llu}]", id);
    check(context, lissom_call(context, call, arguments, &hash));
    /* ["hash"] */
    printf("HASH %s %.*s\n", name, (int)hash.size - 4, (const char*)hash.data + 2);
}

/* Prints the hash of each mesh and hair among the results. */
static void print_hashes(lissom_context* context, const char* name, const char* json) {
    const char* const kinds[] = {"Mesh", "Strands"};
    const char* object = json;
    while ((object = strstr(object, "\"object\":")) != NULL) {
        const char* number = object + strlen("\"object\":");
        const char* type = strstr(object, "lissom.");
        for (int k = 0; type && k < 2; ++k) {
            const size_t length = strlen(kinds[k]);
            const char* word = type + strlen("lissom.");
            if (strncmp(word, kinds[k], length) == 0 && word[length] == '"') {
                print_hash(context, name, kinds[k], strtoull(number, NULL, 10));
            }
        }
        object = number;
    }
}

int main(int count, char** words) {
    char path[4096];
    size_t size = 0;
    lissom_context* context = NULL;
    lissom_script script = {0};
    lissom_bytes results = {NULL, 0};
    if (count != 3) return 2;
    snprintf(path, sizeof path, "%s/%s.lua", words[1], words[2]);
    char* text = read_text(path, &size);
    if (!text || lissom_context_create(NULL, &context) != LISSOM_OK) return 1;
    check(context, lissom_script_load(context, text, size, path, &script));
    check(context, lissom_script_run(context, script, NULL, &results));
    char* json = copy_of(results);
    if (!json) return 1;
    print_hashes(context, words[2], json);
    free(json);
    free(text);
    lissom_context_destroy(context);
    return 0;
}
