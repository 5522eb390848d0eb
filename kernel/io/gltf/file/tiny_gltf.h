/// tinygltf as this library compiles it in: without images, and under a name of its own, so that a
/// host may have another tinygltf; private to kernel/io and not installed.
#pragma once

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define tinygltf lissom_tinygltf

#include <tiny_gltf.h>
