#include "bindings/c/data.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "kernel/io/stream/read_error.h"
#include "kernel/io/stream/utf8.h"

namespace lissom::c {
namespace {

template <typename Number>
Number get(const unsigned char* place) {
    Number value;
    std::memcpy(&value, place, sizeof value);
    return value;
}

template <typename Number>
void put(unsigned char* place, Number value) {
    std::memcpy(place, &value, sizeof value);
}

// The nearest number that an integer of this type holds.
template <typename Number>
Number nearest_integer(double value) {
    using Limits = std::numeric_limits<Number>;
    if (std::isnan(value)) return 0;
    const double least = Limits::min(), most = Limits::max();
    return static_cast<Number>(std::clamp(std::nearbyint(value), least, most));
}

// Returns the nearest float; numbers beyond all floats go to the greatest.
float nearest_float(double value) {
    constexpr double kMost = std::numeric_limits<float>::max();
    return static_cast<float>(std::clamp(value, -kMost, kMost));
}

// A number from -1 to 1 in as many steps: the least integer of the type is none of them.
template <typename Number>
Number nearest_signed_step(double value) {
    constexpr double kSteps = std::numeric_limits<Number>::max();
    return nearest_integer<Number>(kSteps * std::clamp(value, -1.0, 1.0));
}

// Half floats, IEEE 754 binary16: 11 bits of a number, the least of 2^-24.
constexpr double kMaxHalf = 65504.0;
constexpr int kHalfBits = 11, kLeastHalf = -24, kHalfBias = 25;

double number_of_half(std::uint16_t half) {
    const int exponent = half >> 10 & 31, digits = half & 1023;
    double size = std::ldexp(digits, kLeastHalf);
    if (exponent == 31) {
        size = digits == 0 ? std::numeric_limits<double>::infinity()
                           : std::numeric_limits<double>::quiet_NaN();
    } else if (exponent > 0) {
        size = std::ldexp(1024 + digits, exponent - kHalfBias);
    }
    return half & 0x8000 ? -size : size;
}

// The nearest, and of two the even one.
std::uint16_t nearest_half(double value) {
    if (std::isnan(value)) return 0x7e00;
    const int sign = std::signbit(value) ? 0x8000 : 0;
    const double size = std::min(std::abs(value), kMaxHalf);
    if (size == 0.0) return static_cast<std::uint16_t>(sign);
    int exponent = 0;
    std::frexp(size, &exponent);
    const int unit = std::max(exponent - kHalfBits, kLeastHalf);
    const int digits = static_cast<int>(std::nearbyint(std::ldexp(size, -unit)));
    const bool is_normal = exponent - kHalfBits >= kLeastHalf;
    const int bits = is_normal ? ((unit + kHalfBias) << 10) + digits - 1024 : digits;
    return static_cast<std::uint16_t>(sign | bits);
}

bool is_known(lissom_format format) {
    return format >= LISSOM_FLOAT32 && format <= LISSOM_FLOAT16;
}

// Returns the bytes from one element to the next. A stride that is less than an element is long, or
// takes the last of `count` elements around the end of memory, is refused.
std::size_t stride_of(std::size_t stride, std::size_t element, std::size_t count,
                      const char* name) {
    constexpr std::size_t kMostBytes = std::numeric_limits<std::ptrdiff_t>::max();
    const std::size_t step = stride != 0 ? stride : element;
    if (step < element) {
        throw Error(ErrorCode::invalid_argument, std::string(name) +
                                                     ": the stride is less than an element, " +
                                                     std::to_string(element) + " bytes");
    }
    if (step > kMostBytes / std::max<std::size_t>(count, 1)) {
        throw Error(ErrorCode::invalid_argument,
                    std::string(name) + ": the stride is too large for " + std::to_string(count) +
                        " elements; it counts forward");
    }
    return step;
}

// The message takes memory: it is made for an error only.
void require_of(bool condition, const char* name, const char* text) {
    if (!condition) throw Error(ErrorCode::invalid_argument, std::string(name) + text);
}

void require_list(const lissom_input* input, const char* name) {
    require_given(input, name);
    require_of(input->data || input->count == 0, name, " has no data");
    require_of(input->count <= std::size_t{std::numeric_limits<Index>::max()}, name,
               " has too many elements");
    if (!is_known(input->format)) refuse_format(name, "of a lissom_format");
}

double number_at(const unsigned char* place, lissom_format format) {
    switch (format) {
        case LISSOM_FLOAT32:
            return get<float>(place);
        case LISSOM_FLOAT64:
            return get<double>(place);
        case LISSOM_UINT32:
            return get<std::uint32_t>(place);
        case LISSOM_INT32:
            return get<std::int32_t>(place);
        case LISSOM_UINT8:
            return get<std::uint8_t>(place);
        case LISSOM_UINT16:
            return get<std::uint16_t>(place);
        case LISSOM_UNORM8:
            return get<std::uint8_t>(place) / 255.0;
        case LISSOM_UNORM16:
            return get<std::uint16_t>(place) / 65535.0;
        case LISSOM_SNORM8:
            return std::max(get<std::int8_t>(place) / 127.0, -1.0);
        case LISSOM_SNORM16:
            return std::max(get<std::int16_t>(place) / 32767.0, -1.0);
        case LISSOM_FLOAT16:
            return number_of_half(get<std::uint16_t>(place));
    }
    return 0.0;
}

// The greatest integer of a format for ids, or 0 if it has none.
std::uint32_t max_id(lissom_format format) {
    switch (format) {
        case LISSOM_UINT8:
            return 0xff;
        case LISSOM_UINT16:
            return 0xffff;
        case LISSOM_UINT32:
            return 0xffffffff;
        case LISSOM_INT32:
            return 0x7fffffff;
        default:
            return 0;
    }
}

void require_integers(lissom_format format, const char* name) {
    if (max_id(format) == 0) refuse_format(name, "UINT8, UINT16, UINT32 or INT32");
}

void put_integer(unsigned char* place, lissom_format format, Index value) {
    if (format == LISSOM_UINT8) return put(place, static_cast<std::uint8_t>(value));
    if (format == LISSOM_UINT16) return put(place, static_cast<std::uint16_t>(value));
    put(place, std::int32_t{value});
}

}  // namespace

void refuse_format(const char* name, const char* wanted) {
    throw Error(ErrorCode::invalid_argument, std::string(name) + " must be " + wanted);
}

std::size_t size_of(lissom_format format) {
    switch (format) {
        case LISSOM_FLOAT64:
            return 8;
        case LISSOM_UINT8:
        case LISSOM_UNORM8:
        case LISSOM_SNORM8:
            return 1;
        case LISSOM_UINT16:
        case LISSOM_UNORM16:
        case LISSOM_SNORM16:
        case LISSOM_FLOAT16:
            return 2;
        default:
            return 4;
    }
}

bool is_float(lissom_format format) {
    return format == LISSOM_FLOAT32 || format == LISSOM_FLOAT64 || format == LISSOM_FLOAT16;
}

bool is_normalized(lissom_format format) {
    return format >= LISSOM_UNORM8 && format <= LISSOM_SNORM16;
}

void put_number(unsigned char* place, lissom_format format, double value) {
    switch (format) {
        case LISSOM_FLOAT32:
            return put(place, nearest_float(value));
        case LISSOM_FLOAT64:
            return put(place, value);
        case LISSOM_UINT32:
            return put(place, nearest_integer<std::uint32_t>(value));
        case LISSOM_INT32:
            return put(place, nearest_integer<std::int32_t>(value));
        case LISSOM_UINT8:
            return put(place, nearest_integer<std::uint8_t>(value));
        case LISSOM_UINT16:
            return put(place, nearest_integer<std::uint16_t>(value));
        case LISSOM_UNORM8:
            return put(place, nearest_integer<std::uint8_t>(255.0 * value));
        case LISSOM_UNORM16:
            return put(place, nearest_integer<std::uint16_t>(65535.0 * value));
        case LISSOM_SNORM8:
            return put(place, nearest_signed_step<std::int8_t>(value));
        case LISSOM_SNORM16:
            return put(place, nearest_signed_step<std::int16_t>(value));
        case LISSOM_FLOAT16:
            return put(place, nearest_half(value));
    }
}

std::vector<Vec3> read_points(const lissom_input* input, const Space& space, const char* name) {
    require_list(input, name);
    if (!is_float(input->format)) refuse_format(name, "FLOAT16, FLOAT32 or FLOAT64");
    const std::size_t size = size_of(input->format);
    const std::size_t stride = stride_of(input->stride, 3 * size, input->count, name);
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

namespace {

// -1 as an unsigned number.
constexpr double kNoneUnsigned = 4294967295.0;

std::vector<Index> read_ids(const lissom_input* input, bool may_be_none, const char* name,
                            std::size_t width = 1) {
    require_list(input, name);
    require_integers(input->format, name);
    const std::size_t size = size_of(input->format);
    const std::size_t stride = stride_of(input->stride, width * size, input->count, name);
    const auto* const data = static_cast<const unsigned char*>(input->data);
    std::vector<Index> values(width * input->count);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double given = number_at(data + i / width * stride + i % width * size, input->format);
        const bool is_none = may_be_none && (given == -1.0 || given == kNoneUnsigned);
        if (!is_none && (given < 0.0 || given > std::numeric_limits<Index>::max())) {
            throw Error(ErrorCode::out_of_range,
                        std::string(name) + ": ids are from 0 to 2147483647, and one is " +
                            std::to_string(static_cast<std::int64_t>(given)));
        }
        values[i] = is_none ? kNoIndex : static_cast<Index>(given);
    }
    return values;
}

}  // namespace

std::vector<Index> read_integers(const lissom_input* input, const char* name) {
    return read_ids(input, false, name);
}

std::vector<Index> read_labels(const lissom_input* input, const char* name, std::size_t width) {
    return read_ids(input, true, name, width);
}

std::vector<Index> read_any_ids(const lissom_input* input, const char* name) {
    require_list(input, name);
    require_integers(input->format, name);
    if (input->format != LISSOM_INT32) return read_labels(input, name);
    const std::size_t stride = stride_of(input->stride, sizeof(Index), input->count, name);
    const auto* place = static_cast<const unsigned char*>(input->data);
    std::vector<Index> values(input->count);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = get<Index>(place + i * stride);
    return values;
}

void read_numbers_into(const lissom_input* input, Index width, const char* name,
                       std::vector<double>& values) {
    require_list(input, name);
    require_of(width >= 1 && width <= 1024, name, ": an element has 1 to 1024 numbers");
    const std::size_t size = size_of(input->format);
    const std::size_t stride = stride_of(input->stride, at(width) * size, input->count, name);
    const auto* place = static_cast<const unsigned char*>(input->data);
    values.clear();
    values.reserve(input->count * at(width));
    for (std::size_t i = 0; i < input->count; ++i, place += stride) {
        for (std::size_t k = 0; k < at(width); ++k) {
            values.push_back(number_at(place + k * size, input->format));
            if (std::isfinite(values.back())) continue;
            throw Error(ErrorCode::not_finite, std::string(name) + ": a number of element " +
                                                   std::to_string(i) + " is NaN or infinite");
        }
    }
}

std::vector<double> read_numbers(const lissom_input* input, Index width, const char* name) {
    std::vector<double> values;
    read_numbers_into(input, width, name, values);
    return values;
}

void require_room(const lissom_output* output, std::size_t count, std::size_t width,
                  const char* name) {
    require_given(output, name);
    if (!is_known(output->format)) refuse_format(name, "of a lissom_format");
    if (!output->data && count > 0 && output->count > 0) {
        throw Error(ErrorCode::invalid_argument, std::string(name) + ": its data are NULL, for " +
                                                     std::to_string(count) + " elements");
    }
    if (output->count < count) {
        throw Error(ErrorCode::out_of_range, std::string(name) + ": there is room for " +
                                                 std::to_string(output->count) +
                                                 " elements, needed are " + std::to_string(count));
    }
    stride_of(output->stride, width * size_of(output->format), count, name);
}

void require_directions(const lissom_output* output, std::size_t count, std::size_t width,
                        const char* name) {
    require_room(output, count, width, name);
    if (is_float(output->format) || output->format == LISSOM_SNORM8 ||
        output->format == LISSOM_SNORM16) {
        return;
    }
    refuse_format(name, "FLOAT16, FLOAT32, FLOAT64, SNORM8 or SNORM16");
}

void write_integers(const lissom_output* output, std::span<const Index> values, const char* name,
                    std::size_t width) {
    require_room(output, values.size() / width, width, name);
    require_integers(output->format, name);
    const std::uint32_t most = max_id(output->format);
    for (const Index value : values) {
        // -1 in 32 bits is no element.
        const bool fits = size_of(output->format) == 4 || static_cast<std::uint32_t>(value) <= most;
        if (fits) continue;
        throw Error(ErrorCode::out_of_range,
                    std::string(name) + ": integers of this format end at " + std::to_string(most) +
                        ", and one is " + std::to_string(value));
    }
    const std::size_t size = size_of(output->format);
    const std::size_t stride = output->stride != 0 ? output->stride : width * size;
    auto* place = static_cast<unsigned char*>(output->data);
    for (std::size_t i = 0; i < values.size(); i += width, place += stride) {
        for (std::size_t k = 0; k < width; ++k) {
            put_integer(place + k * size, output->format, values[i + k]);
        }
    }
}

// Faces run the other way in a clockwise space; the first corner stays the first.
void reverse_faces(FaceList& faces) {
    for (Index f = 0; f < faces.size(); ++f) {
        std::reverse(faces.vertices.begin() + faces.offsets[at(f)] + 1,
                     faces.vertices.begin() + faces.offsets[at(f) + 1]);
    }
}

FaceList read_faces(const lissom_input* corners, const lissom_input* sizes, const Space& space) {
    FaceList faces;
    faces.vertices = read_integers(corners, "corners");
    const std::size_t count = faces.vertices.size();
    if (sizes) {
        std::size_t end = 0;
        for (const Index size : read_integers(sizes, "sizes")) {
            end += at(size);
            require(end <= count, "the sizes of faces add up to more than there are corners");
            faces.offsets.push_back(index_of(end));
        }
        require(end == count, "the sizes of faces add up to less than there are corners");
    } else {
        require(count % 3 == 0, "corners of triangles come in threes; give sizes for other faces");
        for (std::size_t end = 3; end <= count; end += 3) faces.offsets.push_back(index_of(end));
    }
    if (space.reverses()) reverse_faces(faces);
    return faces;
}

void write_triangles(const lissom_output* output, std::span<const Triangle> triangles,
                     const Space& space) {
    std::vector<Index> values;
    values.reserve(3 * triangles.size());
    for (const Triangle& triangle : triangles) {
        values.push_back(triangle[0]);
        values.push_back(triangle[space.reverses() ? 2 : 1]);
        values.push_back(triangle[space.reverses() ? 1 : 2]);
    }
    write_integers(output, values, "triangles", 3);
}

std::string given_text(const char* text, const char* name) {
    require_given(text, name);
    return text;
}

std::string given_name(const char* text, const char* name) {
    require_given(text, name);
    if (is_utf8(text)) return text;
    throw Error(ErrorCode::invalid_argument,
                std::string(name) + " is not UTF-8: " + in_quotes(text));
}

std::filesystem::path path_of(const std::string& text) {
    return std::filesystem::path(std::u8string(text.begin(), text.end()));
}

}  // namespace lissom::c
