#include "bindings/c/data.h"

#include <cstdint>
#include <limits>

namespace lissom::c {
namespace {

std::size_t size_of(lissom_format format) {
    return format == LISSOM_FLOAT64 ? sizeof(double) : sizeof(float);
}

template <typename Number>
Number get(const unsigned char* place) {
    Number value;
    std::memcpy(&value, place, sizeof value);
    return value;
}

// Bytes from one element to the next. The stride may not be less than an element is long.
std::size_t stride_of(std::size_t stride, std::size_t element, const char* name) {
    if (stride == 0) return element;
    require(stride >= element, std::string(name) + ": the stride is less than an element");
    return stride;
}

void require_list(const lissom_input* input, const char* name) {
    require_given(input, name);
    require(input->data || input->count == 0, std::string(name) + " has no data");
    require(input->count <= std::size_t{std::numeric_limits<Index>::max()},
            std::string(name) + " has too many elements");
}

double number_at(const unsigned char* place, lissom_format format) {
    return format == LISSOM_FLOAT64 ? get<double>(place) : double{get<float>(place)};
}

[[noreturn]] void refuse_format(const char* name, const char* wanted) {
    throw Error(ErrorCode::invalid_argument, std::string(name) + " must be " + wanted);
}

}  // namespace

std::vector<Vec3> read_points(const lissom_input* input, const Space& space, const char* name) {
    require_list(input, name);
    if (input->format != LISSOM_FLOAT32 && input->format != LISSOM_FLOAT64) {
        refuse_format(name, "FLOAT32 or FLOAT64");
    }
    const std::size_t size = size_of(input->format);
    const std::size_t stride = stride_of(input->stride, 3 * size, name);
    const auto* place = static_cast<const unsigned char*>(input->data);
    std::vector<Vec3> points(input->count);
    for (Vec3& point : points) {
        Vec3 given;
        for (int k = 0; k < 3; ++k) given[k] = number_at(place + k * size, input->format);
        point = space.to_kernel(given);
        place += stride;
    }
    return points;
}

std::vector<Index> read_integers(const lissom_input* input, const char* name) {
    require_list(input, name);
    if (input->format != LISSOM_UINT32 && input->format != LISSOM_INT32) {
        refuse_format(name, "UINT32 or INT32");
    }
    const std::size_t stride = stride_of(input->stride, sizeof(std::uint32_t), name);
    const auto* place = static_cast<const unsigned char*>(input->data);
    std::vector<Index> values(input->count);
    for (Index& value : values) {
        value = get<std::int32_t>(place);
        if (value < 0) {
            throw Error(ErrorCode::out_of_range,
                        std::string(name) + ": ids are from 0 to 2147483647");
        }
        place += stride;
    }
    return values;
}

void require_room(const lissom_output* output, std::size_t count, const char* name) {
    require_given(output, name);
    if (!output->data && count > 0 && output->count > 0) {
        throw Error(ErrorCode::out_of_range, std::string(name) + ": its data are NULL, for " +
                                                 std::to_string(count) + " elements");
    }
    if (output->count < count) {
        throw Error(ErrorCode::out_of_range, std::string(name) + ": there is room for " +
                                                 std::to_string(output->count) +
                                                 " elements, needed are " + std::to_string(count));
    }
    if (output->stride != 0) {
        const std::size_t element =
            output->format == LISSOM_UINT32 || output->format == LISSOM_INT32
                ? sizeof(std::uint32_t)
                : size_of(output->format);
        stride_of(output->stride, element, name);
    }
}

void write_integers(const lissom_output* output, std::span<const Index> values, const char* name) {
    require_room(output, values.size(), name);
    if (output->format != LISSOM_UINT32 && output->format != LISSOM_INT32) {
        refuse_format(name, "UINT32 or INT32");
    }
    const std::size_t stride = output->stride != 0 ? output->stride : sizeof(std::uint32_t);
    auto* place = static_cast<unsigned char*>(output->data);
    for (const Index value : values) {
        put(place, static_cast<std::int32_t>(value));
        place += stride;
    }
}

std::string given_text(const char* text, const char* name) {
    require_given(text, name);
    return text;
}

}  // namespace lissom::c
