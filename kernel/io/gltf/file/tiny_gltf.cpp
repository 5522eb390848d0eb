// The implementation of tinygltf, with trees of JSON that are destroyed without memory.
#include "kernel/io/stream/json_tree.h"

namespace nlohmann {
using sorted_json = lissom::SortedJson;
}

#define json sorted_json
#define TINYGLTF_IMPLEMENTATION
#include "kernel/io/gltf/file/tiny_gltf.h"
