/// Lists in the host's memory, read and written; private to bindings/c.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "bindings/c/context.h"
#include "kernel/mesh/measure/triangulation.h"
#include "kernel/mesh/topology.h"

namespace lissom::c {

/// Returns triples of a host's list in the kernel's space. Errors: INVALID_ARGUMENT, naming the
/// list, if it is NULL or of integers.
std::vector<Vec3> read_points(const lissom_input* input, const Space& space, const char* name);

/// Returns integers of a host's list. Errors: as above; OUT_OF_RANGE if one is no id.
std::vector<Index> read_integers(const lissom_input* input, const char* name);

/// Returns labels of a host's list, `width` an element: -1 in 32 bits is none. Errors: as
/// read_integers.
std::vector<Index> read_labels(const lissom_input* input, const char* name, std::size_t width = 1);

/// Returns the ids of a host's list, those below 0 too: whoever takes them names the wrong ones.
/// Errors: as read_integers, but for those.
std::vector<Index> read_any_ids(const lissom_input* input, const char* name);

/// Returns the numbers of a host's list of any format, `width` an element. Errors:
/// INVALID_ARGUMENT; NOT_FINITE.
std::vector<double> read_numbers(const lissom_input* input, Index width, const char* name);
/// Puts them into `values`, whose memory is used again.
void read_numbers_into(const lissom_input* input, Index width, const char* name,
                       std::vector<double>& values);

/// Throws OUT_OF_RANGE if a host's list has no room for `count` elements of `width` numbers, and
/// INVALID_ARGUMENT if elements overlap or the format is unknown.
void require_room(const lissom_output* output, std::size_t count, std::size_t width,
                  const char* name);

/// Writes integers, `width` an element. Errors: OUT_OF_RANGE if the format cannot hold one of them.
/// Nothing is written then.
void write_integers(const lissom_output* output, std::span<const Index> values, const char* name,
                    std::size_t width = 1);

/// Returns the bytes of one number.
std::size_t size_of(lissom_format format);
bool is_float(lissom_format format);
/// Returns whether the format holds numbers from -1 or 0 to 1 as integers.
bool is_normalized(lissom_format format);

/// Writes a number without regard to how the host's memory is aligned; formats that hold less take
/// the nearest they can.
void put_number(unsigned char* place, lissom_format format, double value);

/// Writes `width` numbers an element: value(i, k) is number k of element i; elements for which
/// skip(i) are left as they are.
template <typename Value, typename Skip>
void write_elements(const lissom_output& output, std::size_t count, std::size_t width,
                    const Value& value, const Skip& skip) {
    const std::size_t size = size_of(output.format);
    const std::size_t stride = output.stride != 0 ? output.stride : width * size;
    auto* place = static_cast<unsigned char*>(output.data);
    for (std::size_t i = 0; i < count; ++i, place += stride) {
        if (skip(i)) continue;
        for (std::size_t k = 0; k < width; ++k) {
            put_number(place + k * size, output.format, value(i, k));
        }
    }
}

[[noreturn]] void refuse_format(const char* name, const char* wanted);

/// Puts point(i) into rows of three numbers.
template <typename Point>
void put_points(const lissom_output& output, std::size_t count, const Point& point) {
    const std::size_t size = size_of(output.format);
    const std::size_t stride = output.stride != 0 ? output.stride : 3 * size;
    auto* place = static_cast<unsigned char*>(output.data);
    for (std::size_t i = 0; i < count; ++i, place += stride) {
        const Vec3 p = point(i);
        for (int k = 0; k < 3; ++k) put_number(place + k * size, output.format, p[k]);
    }
}

/// Writes triples; point(i) is in the host's space.
template <typename Point>
void write_points(const lissom_output* output, std::size_t count, const char* name,
                  const Point& point) {
    require_room(output, count, 3, name);
    if (!is_float(output->format)) refuse_format(name, "FLOAT16, FLOAT32 or FLOAT64");
    put_points(*output, count, point);
}

/// Throws if a list of directions is neither of floats nor of numbers from -1 to 1.
void require_directions(const lissom_output* output, std::size_t count, std::size_t width,
                        const char* name);

/// Writes unit vectors in a format of floats, or of numbers from -1 to 1: direction(i).
template <typename Direction>
void write_directions(const lissom_output* output, std::size_t count, const char* name,
                      const Direction& direction) {
    require_directions(output, count, 3, name);
    put_points(*output, count, direction);
}

/// Turns all faces over; the first corner of each stays the first.
void reverse_faces(FaceList& faces);

/// Returns faces of a host's lists; all are triangles if `sizes` is NULL. Errors: as read_integers;
/// INVALID_ARGUMENT if the lists do not fit.
FaceList read_faces(const lissom_input* corners, const lissom_input* sizes, const Space& space);

/// Writes three integers a triangle, in the host's order.
void write_triangles(const lissom_output* output, std::span<const Triangle> triangles,
                     const Space& space);

/// Returns a required text. Errors: INVALID_ARGUMENT, naming it, if it is NULL.
std::string given_text(const char* text, const char* name);

/// Returns a required text that is kept or looked for. Errors: INVALID_ARGUMENT, naming it, if it
/// is NULL or not UTF-8.
std::string given_name(const char* text, const char* name);

/// Returns a path of UTF-8.
std::filesystem::path path_of(const std::string& text);

}  // namespace lissom::c
