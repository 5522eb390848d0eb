/// tinygltf, compiled into this library by tiny_gltf.cpp under a namespace of its own, so that a
/// program may link another copy; private to kernel/io and not installed. It parses: what it could
/// do with images is left out.
#pragma once

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define tinygltf lissom_tinygltf
#include <tiny_gltf.h>
