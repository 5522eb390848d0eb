/// lissom_basis.h: evaluates the handle basis of a deformation. C99 and C++, this file alone.
///
/// A basis is written by `deformer:save_basis("arm.basis")` (`save_basis` in C++): the shape of a
/// deformed region as a linear function of the transforms of its handles. A program with a basis
/// moves handles and gets the surface without a solver: 4 multiplications and additions a
/// coordinate, handle and vertex. It allocates nothing, calls no library and keeps no state.
///
///     #include "lissom_basis.h"
///
///     lissom_basis basis;
///     if (lissom_basis_open(&basis, bytes, size) != LISSOM_BASIS_OK) ...
///     float transforms[2][12];                            // one 3 x 4 matrix a handle
///     lissom_basis_identity(transforms[0]);               // the first handle stays
///     lissom_basis_local(&basis, wanted, transforms[1]);  // the second is moved by `wanted`
///     lissom_basis_evaluate(&basis, transforms[0], 0, basis.vertex_count, out, 3 * sizeof(float));
///
/// Accuracy
///     Without key poses the result is that of `deformer:preview()`, the first system of the
///     method, to the rounding of floats: 4e-7 of `size` for handles that move about as far as the
///     surface is large. It follows a drag and has some shear if handles turn far;
///     `deformer:solve()` takes the shear out and cannot be written as a sum of matrices. With
///     every handle at the identity the result is the rest shape, to the bit. Normals are not part
///     of a basis: `lissom_basis_normals` makes them from the positions. A basis with key poses
///     holds the offset of `solve()` at each of them. There the result is that of `solve()`, to
///     1e-5 of `size`; between them the offsets are blended by the pose, and beyond their range
///     they stay. Turns of handles are told apart up to half a turn.
///
/// Coordinates
///     Positions and transforms are relative to `origin`, the middle of the surface, so that floats
///     keep their digits wherever the mesh lies: put `origin` into the model's own transform, or
///     add it to the positions. `lissom_basis_local` converts a transform of the mesh's space.
///     A transform is a 3 x 4 matrix, row by row: x' = m[0] x + m[1] y + m[2] z + m[3], and so on.
///
/// The function
///     position(v) = rest(v) + sum over handles h of (T_h - I) weight(h, v) with a 3 x 4 matrix
///     T_h, the 3 x 4 identity I and 4 numbers weight(h, v). Over all handles the weights of a
///     vertex add up to (rest, 1) if nothing outside the region holds it.
///
/// Threads
///     Every function only reads the basis. `lissom_basis_evaluate` takes a range of vertices:
///     give each thread one.
///
/// The file, version 1: little endian, in this order and without gaps
///      offset  bytes  content
///           0      8  "LSMBASIS"
///           8      4  uint32: version, 1
///          12      4  uint32: handles H
///          16      4  uint32: vertices of the region n
///          20      4  uint32: vertices of the mesh, below 2^31
///          24      4  uint32: bytes of the names N
///          28      4  float: size, the greatest distance of a rest position from the origin
///          32     24  3 doubles: origin, in the mesh's space
///          56      8  uint64: bytes of the file, 64 + 16 H + 16 n + 16 H n + N
///          64   16 H  for each handle, 3 floats: center of its vertices at rest, relative to the
///                     origin; uint32: offset of its name among the names
///                4 n  uint32: ids of the vertices in the mesh, from 0, ascending
///               12 n  for each vertex, 3 floats: rest position, relative to the origin
///             16 H n  for each handle, for each vertex, 4 floats: weights
///                  N  names: UTF-8, each ended by a zero byte
///     The weights begin at a multiple of 16 bytes and can be given to a graphics card as they are:
///     see examples/engine/basis.vert.
///
/// Key poses, if there are any, at the next multiple of 16 bytes behind the basis
///           0      8  "LSMBKEYS"
///           8      4  uint32: keys K, 1 to 256
///          12      4  uint32: nodes N: K, or K + 1 if the rest pose is no key
///          16      4  uint32: axes D, at most K
///          20      4  0
///          24      8  uint64: bytes of this part, 32 + 8 (D (12 H + 2 + N) + (N + D + 1) K) + 12 K
///          n 32         doubles: D axes of 12 H numbers; the least and then the greatest
///          coordinate of
///                     the keys along each; N nodes of D coordinates; N + D + 1 rows of K numbers
///            12 K n   for each key, for each vertex, 3 floats: offset
///     The 12 numbers of a handle are its turn as a rotation vector; the way of its center, in
///     units of `size`; and the upper triangle of its stretch less 1, row by row. Turn and stretch
///     are the factors of its matrix by Gram and Schmidt. A pose has the coordinates c = axes *
///     numbers, each held between the least and the greatest. The rows are the weights that the
///     cubed distance to each node, each coordinate, and the number 1 add to each key.
///
/// MIT license, as all of Lissom.
#pragma once

// NOLINTBEGIN: C, and names as C has them.

#include <stddef.h>
#include <stdint.h>

/// Declaration of the functions; define it before the include to change that.
#ifndef LISSOM_BASIS_API
#define LISSOM_BASIS_API static inline
#endif

#define LISSOM_BASIS_VERSION 1u
#define LISSOM_BASIS_MAX_KEYS 256u

/// Result of `lissom_basis_open`.
typedef enum lissom_basis_status {
    LISSOM_BASIS_OK = 0,
    /// The memory ends before the basis does.
    LISSOM_BASIS_TRUNCATED,
    /// The memory does not begin with a basis.
    LISSOM_BASIS_NOT_A_BASIS,
    /// A basis of a version that this file does not know.
    LISSOM_BASIS_UNKNOWN_VERSION,
    /// Sizes, vertices or names contradict each other, or a number is not finite.
    LISSOM_BASIS_DAMAGED,
    /// The memory does not begin at a multiple of 4 bytes.
    LISSOM_BASIS_NOT_ALIGNED,
    /// This machine is not little endian with 32-bit floats.
    LISSOM_BASIS_UNSUPPORTED_MACHINE
} lissom_basis_status;

/// A handle as it stands in the file.
typedef struct lissom_basis_handle {
    /// Center of its vertices at rest, relative to the origin.
    float center[3];
    /// Offset of its name in `names`.
    uint32_t name;
} lissom_basis_handle;

/// An open basis. Plain data that points into the memory it was opened on, which must stay.
typedef struct lissom_basis {
    /// Vertices of the region that is deformed, handles, vertices of the whole mesh.
    uint32_t vertex_count, handle_count, mesh_vertex_count;
    /// Origin of all coordinates, in the mesh's space.
    double origin[3];
    /// Greatest distance of a rest position from the origin.
    float size;
    const lissom_basis_handle* handles;
    /// Id in the mesh of each vertex, from 0, ascending.
    const uint32_t* vertices;
    /// 3 floats a vertex.
    const float* rest;
    /// 4 floats a vertex, handle after handle.
    const float* weights;
    const char* names;
    /// Key poses: 0 for a basis without them. Nodes and axes of their space.
    uint32_t key_count, node_count, axis_count;
    /// 3 floats a vertex, key after key: offsets from the basis.
    const float* corrections;
    /// Axes, ranges, nodes and rows of weights, as in the file: doubles at a multiple of 4 bytes.
    const unsigned char* key_numbers;
} lissom_basis;

// ---- Private

#define LISSOM_BASIS__HEADER 64u
#define LISSOM_BASIS__BLOCK 64u
#define LISSOM_BASIS__KEYS_HEADER 32u

LISSOM_BASIS_API uint32_t lissom_basis__u32(const unsigned char* at) {
    return (uint32_t)at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
}

LISSOM_BASIS_API uint64_t lissom_basis__u64(const unsigned char* at) {
    return (uint64_t)lissom_basis__u32(at) | (uint64_t)lissom_basis__u32(at + 4) << 32;
}

LISSOM_BASIS_API int lissom_basis__machine_fits(void) {
    union {
        float number;
        unsigned char bytes[4];
    } one;
    one.number = 1.0f;
    return sizeof(float) == 4 && sizeof(double) == 8 && sizeof(lissom_basis_handle) == 16 &&
           one.bytes[0] == 0 && one.bytes[2] == 0x80 && one.bytes[3] == 0x3f;
}

/// Returns whether `count` numbers of 4 bytes are finite.
LISSOM_BASIS_API int lissom_basis__finite(const unsigned char* at, uint64_t count) {
    uint64_t i;
    for (i = 0; i < count; ++i, at += 4) {
        if ((at[3] & 0x7f) == 0x7f && (at[2] & 0x80)) return 0;
    }
    return 1;
}

/// Returns whether ids ascend and are below the mesh's count, and names begin inside the names.
LISSOM_BASIS_API int lissom_basis__ids_fit(const lissom_basis* basis, uint32_t names_bytes) {
    uint32_t i;
    if (basis->mesh_vertex_count > 0x7fffffffu) return 0;
    for (i = 0; i < basis->vertex_count; ++i) {
        if (basis->vertices[i] >= basis->mesh_vertex_count) return 0;
        if (i > 0 && basis->vertices[i] <= basis->vertices[i - 1]) return 0;
    }
    for (i = 0; i < basis->handle_count; ++i) {
        if (basis->handles[i].name >= names_bytes) return 0;
    }
    return names_bytes == 0 || basis->names[names_bytes - 1] == '\0';
}

LISSOM_BASIS_API void lissom_basis__copy_double(const unsigned char* from, double* to) {
    union {
        double number;
        unsigned char bytes[8];
    } value;
    int i;
    for (i = 0; i < 8; ++i) value.bytes[i] = from[i];
    *to = value.number;
}

LISSOM_BASIS_API double lissom_basis__double(const unsigned char* from, uint64_t index) {
    double number;
    lissom_basis__copy_double(from + 8 * index, &number);
    return number;
}

/// Opens the key poses behind a basis, if there are any.
LISSOM_BASIS_API lissom_basis_status lissom_basis__open_keys(lissom_basis* basis,
                                                             const unsigned char* bytes,
                                                             uint64_t size) {
    static const unsigned char magic[8] = {'L', 'S', 'M', 'B', 'K', 'E', 'Y', 'S'};
    const uint64_t handles = basis->handle_count, vertices = basis->vertex_count;
    uint64_t keys, nodes, axes, doubles, i;
    basis->key_count = basis->node_count = basis->axis_count = 0;
    basis->corrections = 0;
    basis->key_numbers = 0;
    for (i = 0; i < 8; ++i) {
        if (i >= size || bytes[i] != magic[i]) return LISSOM_BASIS_OK;
    }
    if (size < LISSOM_BASIS__KEYS_HEADER) return LISSOM_BASIS_TRUNCATED;
    keys = lissom_basis__u32(bytes + 8);
    nodes = lissom_basis__u32(bytes + 12);
    axes = lissom_basis__u32(bytes + 16);
    if (keys == 0 || keys > LISSOM_BASIS_MAX_KEYS || nodes < keys || nodes > keys + 1 ||
        axes > keys) {
        return LISSOM_BASIS_DAMAGED;
    }
    doubles = axes * (12 * handles + 2 + nodes) + (nodes + axes + 1) * keys;
    if (lissom_basis__u64(bytes + 24) !=
        LISSOM_BASIS__KEYS_HEADER + 8 * doubles + 12 * keys * vertices) {
        return LISSOM_BASIS_DAMAGED;
    }
    if (size < lissom_basis__u64(bytes + 24)) return LISSOM_BASIS_TRUNCATED;
    bytes += LISSOM_BASIS__KEYS_HEADER;
    for (i = 0; i < doubles; ++i) {
        const double number = lissom_basis__double(bytes, i);
        if (!(number - number == 0.0)) return LISSOM_BASIS_DAMAGED;
    }
    if (!lissom_basis__finite(bytes + 8 * doubles, 3 * keys * vertices)) {
        return LISSOM_BASIS_DAMAGED;
    }
    basis->key_count = (uint32_t)keys;
    basis->node_count = (uint32_t)nodes;
    basis->axis_count = (uint32_t)axes;
    basis->key_numbers = bytes;
    basis->corrections = (const float*)(const void*)(bytes + 8 * doubles);
    return LISSOM_BASIS_OK;
}

// ---- Opening

/// Finds the parts of a basis of `handles` handles and `vertices` vertices in `bytes`.
LISSOM_BASIS_API void lissom_basis__find_parts(const unsigned char* bytes, uint32_t handles,
                                               uint32_t vertices, lissom_basis* found) {
    int i;
    found->handle_count = handles;
    found->vertex_count = vertices;
    found->mesh_vertex_count = lissom_basis__u32(bytes + 20);
    for (i = 0; i < 3; ++i) lissom_basis__copy_double(bytes + 32 + 8 * i, &found->origin[i]);
    found->size = *(const float*)(const void*)(bytes + 28);
    found->handles = (const lissom_basis_handle*)(const void*)(bytes + LISSOM_BASIS__HEADER);
    found->vertices = (const uint32_t*)(const void*)(found->handles + handles);
    found->rest = (const float*)(const void*)(found->vertices + vertices);
    found->weights = found->rest + 3 * (uint64_t)vertices;
    found->names = (const char*)(found->weights + 4 * (uint64_t)handles * vertices);
}

/// Returns whether all numbers are finite, and ids and names inside their bounds.
LISSOM_BASIS_API int lissom_basis__sound(const lissom_basis* basis, uint32_t names) {
    const uint64_t numbers = (3 + 4 * (uint64_t)basis->handle_count) * basis->vertex_count;
    uint32_t i;
    for (i = 0; i < 3; ++i) {
        if (!(basis->origin[i] - basis->origin[i] == 0.0)) return 0;
    }
    if (!(basis->size - basis->size == 0.0f) || basis->size < 0.0f ||
        !lissom_basis__ids_fit(basis, names) ||
        !lissom_basis__finite((const unsigned char*)basis->rest, numbers)) {
        return 0;
    }
    for (i = 0; i < basis->handle_count; ++i) {
        if (!lissom_basis__finite((const unsigned char*)basis->handles[i].center, 3)) return 0;
    }
    return 1;
}

/// Opens the basis in `size` bytes of memory, which begin at a multiple of 4 bytes, as all memory
/// of malloc does. Checks everything: the functions below stay inside the memory for any content.
/// Reads all numbers once. Changes `basis` only if it returns LISSOM_BASIS_OK. Bytes behind the
/// basis do no harm, unless they begin as key poses do and are none.
LISSOM_BASIS_API lissom_basis_status lissom_basis_open(lissom_basis* basis, const void* memory,
                                                       size_t size) {
    static const unsigned char magic[8] = {'L', 'S', 'M', 'B', 'A', 'S', 'I', 'S'};
    const unsigned char* const bytes = (const unsigned char*)memory;
    lissom_basis found;
    uint64_t handles, vertices, names, total, blocks;
    lissom_basis_status status;
    int i;

    if (!lissom_basis__machine_fits()) return LISSOM_BASIS_UNSUPPORTED_MACHINE;
    if (!memory) return LISSOM_BASIS_TRUNCATED;
    if ((uintptr_t)memory % 4 != 0) return LISSOM_BASIS_NOT_ALIGNED;
    for (i = 0; i < 8; ++i) {
        if ((size_t)i >= size) return LISSOM_BASIS_TRUNCATED;
        if (bytes[i] != magic[i]) return LISSOM_BASIS_NOT_A_BASIS;
    }
    if (size < LISSOM_BASIS__HEADER) return LISSOM_BASIS_TRUNCATED;
    if (lissom_basis__u32(bytes + 8) != LISSOM_BASIS_VERSION) return LISSOM_BASIS_UNKNOWN_VERSION;

    handles = lissom_basis__u32(bytes + 12);
    vertices = lissom_basis__u32(bytes + 16);
    names = lissom_basis__u32(bytes + 24);
    total = lissom_basis__u64(bytes + 56);
    if (total > size) return LISSOM_BASIS_TRUNCATED;
    if (total < LISSOM_BASIS__HEADER + names) return LISSOM_BASIS_DAMAGED;
    blocks = (total - LISSOM_BASIS__HEADER - names) / 16;
    /* handles + vertices + handles * vertices = blocks, without overflow. */
    if ((total - LISSOM_BASIS__HEADER - names) % 16 != 0) return LISSOM_BASIS_DAMAGED;
    if (handles > blocks || (blocks - handles) % (handles + 1) != 0 ||
        (blocks - handles) / (handles + 1) != vertices) {
        return LISSOM_BASIS_DAMAGED;
    }

    lissom_basis__find_parts(bytes, (uint32_t)handles, (uint32_t)vertices, &found);
    if (!lissom_basis__sound(&found, (uint32_t)names)) return LISSOM_BASIS_DAMAGED;
    total = (total + 15) / 16 * 16;
    if (total > size) total = size;
    status = lissom_basis__open_keys(&found, bytes + total, size - total);
    if (status == LISSOM_BASIS_OK) *basis = found;
    return status;
}

/// Returns the meaning of a status, in a few words.
LISSOM_BASIS_API const char* lissom_basis_status_text(lissom_basis_status status) {
    switch (status) {
        case LISSOM_BASIS_OK:
            return "no error";
        case LISSOM_BASIS_TRUNCATED:
            return "the basis is cut short";
        case LISSOM_BASIS_NOT_A_BASIS:
            return "this is no basis";
        case LISSOM_BASIS_UNKNOWN_VERSION:
            return "the basis has a version that is not known";
        case LISSOM_BASIS_DAMAGED:
            return "the basis is damaged";
        case LISSOM_BASIS_NOT_ALIGNED:
            return "the memory must begin at a multiple of 4 bytes";
        case LISSOM_BASIS_UNSUPPORTED_MACHINE:
            return "this machine is not little endian";
    }
    return "unknown status";
}

// ---- Handles

/// Returns the name of a handle, or "" if it has none or does not exist.
LISSOM_BASIS_API const char* lissom_basis_handle_name(const lissom_basis* basis, uint32_t handle) {
    return handle < basis->handle_count ? basis->names + basis->handles[handle].name : "";
}

/// Returns the first handle called `name`, or `handle_count` if there is none.
LISSOM_BASIS_API uint32_t lissom_basis_find_handle(const lissom_basis* basis, const char* name) {
    uint32_t h;
    for (h = 0; h < basis->handle_count; ++h) {
        const char *a = lissom_basis_handle_name(basis, h), *b = name;
        while (*a && *a == *b) ++a, ++b;
        if (*a == *b) break;
    }
    return h;
}

// ---- Transforms

/// Writes the transform of a handle that stays in place.
LISSOM_BASIS_API void lissom_basis_identity(float transform[12]) {
    int i;
    for (i = 0; i < 12; ++i) transform[i] = i % 5 == 0 ? 1.0f : 0.0f;
}

/// A transform of the mesh's space as one relative to the origin: [L t] becomes [L, L o + t - o].
LISSOM_BASIS_API void lissom_basis_local(const lissom_basis* basis, const double transform[12],
                                         float local[12]) {
    const double* const o = basis->origin;
    int r, c;
    for (r = 0; r < 3; ++r) {
        const double* const row = transform + 4 * r;
        for (c = 0; c < 3; ++c) local[4 * r + c] = (float)row[c];
        local[4 * r + 3] = (float)(row[0] * o[0] + row[1] * o[1] + row[2] * o[2] + (row[3] - o[r]));
    }
}

// ---- Key poses

/* The square root of a number that is not negative, by Newton's method from half its exponent. */
LISSOM_BASIS_API double lissom_basis__root_of(double square) {
    union {
        double number;
        uint64_t bits;
    } root;
    int i;
    if (!(square > 1e-290)) return square - square == 0.0 ? 0.0 : square;
    if (!(square - square == 0.0)) return square;
    root.number = square;
    root.bits = (root.bits >> 1) + ((uint64_t)1023 << 51);
    for (i = 0; i < 5; ++i) root.number = 0.5 * (root.number + square / root.number);
    return root.number;
}

/* Scales to length one and returns the length; zero if it has none. */
LISSOM_BASIS_API double lissom_basis__unit(double* v) {
    const double length = lissom_basis__root_of(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    int i;
    for (i = 0; i < 3; ++i) v[i] = length > 0.0 ? v[i] / length : 0.0;
    return length;
}

/* The angle of the direction (x, y) from the x axis, neither negative: its tangent is halved until
 * the series of the arc tangent is short. */
LISSOM_BASIS_API double lissom_basis__arc(double y, double x) {
    const int steep = y > x;
    double t = steep ? x / y : y / x, power, sum = 0.0, factor = 1.0;
    int i;
    for (i = 0; i < 3; ++i) {
        t = t / (1.0 + lissom_basis__root_of(1.0 + t * t));
        factor *= 2.0;
    }
    power = t;
    for (i = 0; i < 9; ++i) {
        sum += (i % 2 == 0 ? power : -power) / (2 * i + 1);
        power *= t * t;
    }
    sum *= factor;
    return steep ? 1.57079632679489661923 - sum : sum;
}

/* The rotation vector of the rotation with these columns, at most half a turn. */
LISSOM_BASIS_API void lissom_basis__turn(const double c[3][3], double turn[3]) {
    const double squares[4] = {1 + c[0][0] + c[1][1] + c[2][2], 1 + c[0][0] - c[1][1] - c[2][2],
                               1 - c[0][0] + c[1][1] - c[2][2], 1 - c[0][0] - c[1][1] + c[2][2]};
    const double x = c[1][2] - c[2][1], y = c[2][0] - c[0][2], z = c[0][1] - c[1][0];
    const double xy = c[0][1] + c[1][0], xz = c[0][2] + c[2][0], yz = c[1][2] + c[2][1];
    const double q[4][4] = {{squares[0], x, y, z},
                            {x, squares[1], xy, xz},
                            {y, xy, squares[2], yz},
                            {z, xz, yz, squares[3]}};
    double length, w, angle;
    int largest = 0, i, back = 0;
    for (i = 1; i < 4; ++i) {
        if (squares[i] > squares[largest]) largest = i;
    }
    for (i = 0; i < 3; ++i) turn[i] = q[largest][i + 1];
    length = lissom_basis__unit(turn);
    if (!(length > 0.0)) return;
    w = q[largest][0] < 0.0 ? -q[largest][0] : q[largest][0];
    if (w <= 1e-4 * length) {
        /* Half a turn one way is half a turn the other way. */
        for (i = 2; i >= 0; --i) {
            if (turn[i] > 0.51) back = 0;
            if (turn[i] < -0.51) back = 1;
        }
    } else {
        back = q[largest][0] < 0.0;
    }
    angle = 2.0 * lissom_basis__arc(length, w);
    for (i = 0; i < 3; ++i) turn[i] *= back ? -angle : angle;
}

/* The 12 numbers of a handle's pose. */
LISSOM_BASIS_API void lissom_basis__pose(const lissom_basis* basis, uint32_t handle,
                                         const float* transform, double pose[12]) {
    const float* const center = basis->handles[handle].center;
    const double size = basis->size > 0.0f ? (double)basis->size : 1.0;
    double columns[3][3], turn[3][3], along;
    int r, c, k = 6;
    for (c = 0; c < 3; ++c) {
        for (r = 0; r < 3; ++r) turn[c][r] = columns[c][r] = (double)transform[4 * r + c];
    }
    (void)lissom_basis__unit(turn[0]);
    along = turn[0][0] * turn[1][0] + turn[0][1] * turn[1][1] + turn[0][2] * turn[1][2];
    for (r = 0; r < 3; ++r) turn[1][r] -= along * turn[0][r];
    (void)lissom_basis__unit(turn[1]);
    for (r = 0; r < 3; ++r) {
        turn[2][r] = turn[0][(r + 1) % 3] * turn[1][(r + 2) % 3] -
                     turn[0][(r + 2) % 3] * turn[1][(r + 1) % 3];
    }
    lissom_basis__turn((const double(*)[3])turn, pose);
    for (r = 0; r < 3; ++r) {
        double moved = (double)transform[4 * r + 3] - (double)center[r];
        for (c = 0; c < 3; ++c) moved += columns[c][r] * (double)center[c];
        pose[3 + r] = moved / size;
    }
    for (r = 0; r < 3; ++r) {
        for (c = r; c < 3; ++c) {
            pose[k++] = turn[r][0] * columns[c][0] + turn[r][1] * columns[c][1] +
                        turn[r][2] * columns[c][2] - (r == c ? 1.0 : 0.0);
        }
    }
}

LISSOM_BASIS_API int lissom_basis__is_identity(const float* transform) {
    int i;
    for (i = 0; i < 12; ++i) {
        if (transform[i] != (i % 5 == 0 ? 1.0f : 0.0f)) return 0;
    }
    return 1;
}

/* Coordinates of a pose along the axes of the keys, held within their range. */
LISSOM_BASIS_API void lissom_basis__coordinates(const lissom_basis* basis, const float* transforms,
                                                double* at) {
    const unsigned char* const ranges =
        basis->key_numbers + 96 * (size_t)basis->handle_count * basis->axis_count;
    uint32_t h, d, i;
    for (d = 0; d < basis->axis_count; ++d) at[d] = 0.0;
    for (h = 0; h < basis->handle_count; ++h) {
        double pose[12];
        lissom_basis__pose(basis, h, transforms + 12 * (size_t)h, pose);
        for (d = 0; d < basis->axis_count; ++d) {
            const uint64_t first = 12 * ((uint64_t)d * basis->handle_count + h);
            for (i = 0; i < 12; ++i) {
                at[d] += pose[i] * lissom_basis__double(basis->key_numbers, first + i);
            }
        }
    }
    for (d = 0; d < basis->axis_count; ++d) {
        const double least = lissom_basis__double(ranges, d);
        const double greatest = lissom_basis__double(ranges, (uint64_t)basis->axis_count + d);
        if (at[d] < least) at[d] = least;
        if (at[d] > greatest) at[d] = greatest;
    }
}

/// Writes the weight of each key at a pose, `key_count` floats, for vertex shaders:
/// `lissom_basis_evaluate` finds them by itself. `transforms` has 12 floats a handle.
LISSOM_BASIS_API void lissom_basis_key_weights(const lissom_basis* basis, const float* transforms,
                                               float* weights) {
    const uint32_t keys = basis->key_count, nodes = basis->node_count, axes = basis->axis_count;
    double at[LISSOM_BASIS_MAX_KEYS], sums[LISSOM_BASIS_MAX_KEYS];
    const unsigned char *places, *rows;
    uint32_t k, n, d, h, rests = nodes > keys;
    for (k = 0; k < keys; ++k) weights[k] = 0.0f;
    for (h = 0; h < basis->handle_count && rests; ++h) {
        rests = (uint32_t)lissom_basis__is_identity(transforms + 12 * (size_t)h);
    }
    if (keys == 0 || rests) return;
    lissom_basis__coordinates(basis, transforms, at);
    places = basis->key_numbers + 8 * ((size_t)axes * (12 * (size_t)basis->handle_count + 2));
    rows = places + 8 * (size_t)nodes * axes;
    for (k = 0; k < keys; ++k) sums[k] = 0.0;
    for (n = 0; n < nodes + axes + 1; ++n) {
        double value = n < nodes ? 0.0 : n < nodes + axes ? at[n - nodes] : 1.0;
        if (n < nodes) {
            for (d = 0; d < axes; ++d) {
                const double way = lissom_basis__double(places, (uint64_t)n * axes + d) - at[d];
                value += way * way;
            }
            value *= lissom_basis__root_of(value);
        }
        for (k = 0; k < keys; ++k) {
            sums[k] += value * lissom_basis__double(rows, (uint64_t)n * keys + k);
        }
    }
    for (k = 0; k < keys; ++k) weights[k] = (float)sums[k];
}

// ---- Evaluation

/// Adds to `count` points x the displacement by one handle, for the vertices from `first` on.
LISSOM_BASIS_API void lissom_basis__add(const float* transform, const float* weights,
                                        uint32_t count, float* x) {
    const float a = transform[0] - 1.0f, b = transform[1], c = transform[2], d = transform[3];
    const float e = transform[4], f = transform[5] - 1.0f, g = transform[6], h = transform[7];
    const float i = transform[8], j = transform[9], k = transform[10] - 1.0f, l = transform[11];
    uint32_t n;
    for (n = 0; n < count; ++n) {
        const float* const w = weights + 4 * (size_t)n;
        x[3 * n] += a * w[0] + b * w[1] + c * w[2] + d * w[3];
        x[3 * n + 1] += e * w[0] + f * w[1] + g * w[2] + h * w[3];
        x[3 * n + 2] += i * w[0] + j * w[1] + k * w[2] + l * w[3];
    }
}

/// Evaluates up to LISSOM_BASIS__BLOCK vertices from `first` on.
LISSOM_BASIS_API void lissom_basis__block(const lissom_basis* basis, const float* transforms,
                                          const float* key_weights, uint32_t first, uint32_t count,
                                          float* x) {
    const float* const rest = basis->rest + 3 * (size_t)first;
    uint32_t i, h, k;
    for (i = 0; i < 3 * count; ++i) x[i] = rest[i];
    for (h = 0; h < basis->handle_count; ++h) {
        const float* const transform = transforms + 12 * (size_t)h;
        const size_t row = (size_t)h * basis->vertex_count + first;
        if (lissom_basis__is_identity(transform)) continue;
        lissom_basis__add(transform, basis->weights + 4 * row, count, x);
    }
    for (k = 0; k < basis->key_count; ++k) {
        const float weight = key_weights[k];
        const float* const offsets =
            basis->corrections + 3 * ((size_t)k * basis->vertex_count + first);
        if (weight == 0.0f) continue;
        for (i = 0; i < 3 * count; ++i) x[i] += weight * offsets[i];
    }
}

LISSOM_BASIS_API void lissom_basis__run(const lissom_basis* basis, const float* transforms,
                                        uint32_t first, uint32_t count, float* out,
                                        size_t stride_bytes, int scatter) {
    float x[3 * LISSOM_BASIS__BLOCK], key_weights[LISSOM_BASIS_MAX_KEYS];
    uint32_t done, i;
    int c;
    lissom_basis_key_weights(basis, transforms, key_weights);
    if (first > basis->vertex_count) first = basis->vertex_count;
    if (count > basis->vertex_count - first) count = basis->vertex_count - first;
    for (done = 0; done < count; done += LISSOM_BASIS__BLOCK) {
        const uint32_t left = count - done;
        const uint32_t block = left < LISSOM_BASIS__BLOCK ? left : LISSOM_BASIS__BLOCK;
        lissom_basis__block(basis, transforms, key_weights, first + done, block, x);
        for (i = 0; i < block; ++i) {
            const size_t place = scatter ? basis->vertices[first + done + i] : (size_t)done + i;
            float* const to = (float*)(void*)((unsigned char*)out + place * stride_bytes);
            for (c = 0; c < 3; ++c) to[c] = x[3 * i + (uint32_t)c];
        }
    }
}

/// Writes the positions of the vertices `first` to `first + count - 1` of the region, 3 floats
/// each, `stride_bytes` apart (a multiple of 4), to `out`, which points to the first of them.
/// `transforms` has 12 floats a handle. A range beyond the last vertex ends there.
LISSOM_BASIS_API void lissom_basis_evaluate(const lissom_basis* basis, const float* transforms,
                                            uint32_t first, uint32_t count, float* out,
                                            size_t stride_bytes) {
    lissom_basis__run(basis, transforms, first, count, out, stride_bytes, 0);
}

/// Works as `lissom_basis_evaluate`, into the positions of the whole mesh: vertex v of the mesh
/// stands v * stride_bytes behind `mesh_positions`, which has room for `mesh_vertex_count`.
/// Vertices outside the region are left alone.
LISSOM_BASIS_API void lissom_basis_scatter(const lissom_basis* basis, const float* transforms,
                                           uint32_t first, uint32_t count, float* mesh_positions,
                                           size_t stride_bytes) {
    lissom_basis__run(basis, transforms, first, count, mesh_positions, stride_bytes, 1);
}

// ---- Normals

/* The square root of a number from 1 to 3, by Newton's method. */
LISSOM_BASIS_API float lissom_basis__root(float square) {
    float root = 0.5f + 0.5f * square;
    int i;
    for (i = 0; i < 4; ++i) root = 0.5f * (root + square / root);
    return root;
}

/* Scales to length one and returns the length; leaves zero and numbers that are not finite. */
LISSOM_BASIS_API float lissom_basis__normalize(float* n) {
    float largest = 0.0f, length;
    int i;
    for (i = 0; i < 3; ++i) {
        const float size = n[i] < 0.0f ? -n[i] : n[i];
        if (size > largest) largest = size;
    }
    if (!(largest > 0.0f) || !(largest - largest == 0.0f)) return 0.0f;
    for (i = 0; i < 3; ++i) n[i] /= largest;
    length = lissom_basis__root(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (i = 0; i < 3; ++i) n[i] /= length;
    return largest * length;
}

/* The angle of the direction (x, y) from the x axis, y not negative: atan as Moshier has it. */
LISSOM_BASIS_API float lissom_basis__angle(float y, float x) {
    const float pi = 3.14159265f, across = x < 0.0f ? -x : x;
    const float low = y < across ? y : across, high = y < across ? across : y;
    const int reduced = low > 0.4142f * high;
    const float above = reduced ? low - high : low, below = reduced ? low + high : high;
    const float t = below > 0.0f ? above / below : 0.0f, z = t * t;
    const float small =
        (reduced ? pi / 4 : 0.0f) + t +
        t * z *
            (((8.05374449538e-2f * z - 1.38776856032e-1f) * z + 1.99777106478e-1f) * z -
             3.33329491539e-1f);
    const float right = y > across ? pi / 2 - small : small;
    return x < 0.0f ? pi - right : right;
}

LISSOM_BASIS_API void lissom_basis__add_normal(const float* p[3], float* n[3]) {
    float edge[3][3], normal[3], size = 0.0f;
    int k, c;
    for (k = 0; k < 3; ++k) {
        for (c = 0; c < 3; ++c) {
            edge[k][c] = p[(k + 1) % 3][c] - p[k][c];
            if (edge[k][c] > size) size = edge[k][c];
            if (-edge[k][c] > size) size = -edge[k][c];
        }
    }
    if (!(size > 0.0f) || !(size - size == 0.0f)) return;
    /* Edges of about length one, so that squares neither vanish nor overflow. */
    for (k = 0; k < 3; ++k) {
        for (c = 0; c < 3; ++c) edge[k][c] /= size;
    }
    for (c = 0; c < 3; ++c) {
        normal[c] = edge[0][(c + 1) % 3] * edge[1][(c + 2) % 3] -
                    edge[0][(c + 2) % 3] * edge[1][(c + 1) % 3];
    }
    size = lissom_basis__normalize(normal);
    if (!(size > 0.0f)) return;
    for (k = 0; k < 3; ++k) {
        const float* const to = edge[k];
        const float* const from = edge[(k + 2) % 3];
        const float cosine = -(to[0] * from[0] + to[1] * from[1] + to[2] * from[2]);
        const float angle = lissom_basis__angle(size, cosine);
        for (c = 0; c < 3; ++c) n[k][c] += angle * normal[c];
    }
}

/// Makes unit normals of a triangle mesh from its positions: the normals of the triangles at each
/// vertex, weighted by their angles there, as in Lissom itself and its pictures. Zero if no
/// triangle at a vertex has an area. For the whole mesh, because vertices at the border of the
/// region have triangles on both sides. `triangles` has 3 vertices each; triangles with a vertex
/// that does not exist are skipped. Strides are in bytes, multiples of 4.
LISSOM_BASIS_API void lissom_basis_normals(const float* positions, size_t position_stride,
                                           uint32_t vertex_count, const uint32_t* triangles,
                                           uint32_t triangle_count, float* normals,
                                           size_t normal_stride) {
    const unsigned char* const from = (const unsigned char*)positions;
    unsigned char* const to = (unsigned char*)normals;
    uint32_t v, t;
    int k;
    for (v = 0; v < vertex_count; ++v) {
        float* const n = (float*)(void*)(to + v * normal_stride);
        n[0] = n[1] = n[2] = 0.0f;
    }
    for (t = 0; t < triangle_count; ++t) {
        const uint32_t* const triangle = triangles + 3 * (size_t)t;
        const float* p[3];
        float* n[3];
        if (triangle[0] >= vertex_count || triangle[1] >= vertex_count ||
            triangle[2] >= vertex_count) {
            continue;
        }
        for (k = 0; k < 3; ++k) {
            p[k] = (const float*)(const void*)(from + triangle[k] * position_stride);
            n[k] = (float*)(void*)(to + triangle[k] * normal_stride);
        }
        lissom_basis__add_normal(p, n);
    }
    for (v = 0; v < vertex_count; ++v) {
        (void)lissom_basis__normalize((float*)(void*)(to + v * normal_stride));
    }
}

// NOLINTEND
