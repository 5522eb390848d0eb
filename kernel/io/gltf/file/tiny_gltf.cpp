// The implementation of tinygltf.
#define TINYGLTF_IMPLEMENTATION
#include "kernel/io/gltf/file/tiny_gltf.h"
