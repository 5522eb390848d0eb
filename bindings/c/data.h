/// Lists in the host's memory, read and written; private to bindings/c.
#pragma once

#include <cstring>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "bindings/c/context.h"

namespace lissom::c {

/// Returns triples of a host's list in the kernel's space. Errors: INVALID_ARGUMENT, naming the
/// list, if it is NULL or of integers.
std::vector<Vec3> read_points(const lissom_input* input, const Space& space, const char* name);

/// Returns integers of a host's list. Errors: as above; OUT_OF_RANGE if one is no id.
std::vector<Index> read_integers(const lissom_input* input, const char* name);

/// Throws OUT_OF_RANGE if a host's list has no room for `count` elements.
void require_room(const lissom_output* output, std::size_t count, const char* name);

void write_integers(const lissom_output* output, std::span<const Index> values, const char* name);

/// Writes a value without regard to how the host's memory is aligned.
template <typename Number>
void put(unsigned char* place, Number value) {
    std::memcpy(place, &value, sizeof value);
}

template <typename Number, typename Point>
void write_triples(const lissom_output& output, std::size_t count, const Point& point) {
    const std::size_t stride = output.stride != 0 ? output.stride : 3 * sizeof(Number);
    auto* place = static_cast<unsigned char*>(output.data);
    for (std::size_t i = 0; i < count; ++i, place += stride) {
        const Vec3 p = point(i);
        for (int k = 0; k < 3; ++k) put(place + k * sizeof(Number), static_cast<Number>(p[k]));
    }
}

/// Writes triples; point(i) is in the host's space.
template <typename Point>
void write_points(const lissom_output* output, std::size_t count, const char* name,
                  const Point& point) {
    require_room(output, count, name);
    if (output->format == LISSOM_FLOAT32) {
        write_triples<float>(*output, count, point);
    } else if (output->format == LISSOM_FLOAT64) {
        write_triples<double>(*output, count, point);
    } else {
        throw Error(ErrorCode::invalid_argument, std::string(name) + " must be FLOAT32 or FLOAT64");
    }
}

/// Returns a required text. Errors: INVALID_ARGUMENT, naming it, if it is NULL.
std::string given_text(const char* text, const char* name);

}  // namespace lissom::c
