/// lissom_hair.h: rebuilds strands of hair from guides. C99 and C++, this file alone.
///
/// A guide file is written by `strands:guide_set():save("bob.guides")` (`save_guides` in C++): a
/// few strands as guides, and every strand as a sum of three of them with its own root and detail.
/// A program simulates or poses the guides and gets all strands. It allocates nothing, calls no
/// library and keeps no state.
///
///     #include "lissom_hair.h"
///
///     lissom_hair hair;
///     if (lissom_hair_open(&hair, bytes, size) != LISSOM_HAIR_OK) ...
///     lissom_hair_turns(&hair, guides, turns);   // 9 floats a point of a guide
///     lissom_hair_rebuild(&hair, guides, turns, 0, hair.strand_count, out);
///
/// Coordinates
///     Metres in the space of the head. Put the head's transform into the model's own: guides are
///     then simulated in the space of the head, and a head that turns takes the hair along.
///
/// The function
///     point(s, k) = root(s) + sum over i < 3 of weight(s, i) (moved(g, 0) - rest(g, 0))
///                 + length(s) * sum over i < 3 of weight(s, i) (moved(g, k) - moved(g, 0))
///                 + turn(g0, k) * detail(s, k)
///     with the guides g of the strand, g0 the first of them, which has the greatest weight. With
///     guides at rest the result is the strand that was saved, at equal steps along it, to half of
///     `detail_step` and the rounding of floats.
///
/// Threads
///     Every function only reads the hair. `lissom_hair_rebuild` takes a range of strands: give
///     each thread one.
///
/// The file, version 1: little endian, in this order
///      offset  bytes  content
///           0      8  "LSMHAIRG"
///           8      4  uint32: version, 1
///          12      4  uint32: strands S
///          16      4  uint32: guides G
///          20      4  uint32: points of each guide and strand P, 2 to 256
///          24      4  uint32: 1 if there are details, else 0
///          28      4  float: detail_step, metres
///          32      8  uint64: bytes of the file
///          40      8  0
///          48   48 S  for each strand, 3 floats: root; float: length; 3 uint32: guides; uint32:
///          id;
///                     3 floats: weights, 0 or more, which sum to 1; float: diameter in metres
///               12 GP for each guide, for each point, 3 floats
///                     zeros up to the next multiple of 16 bytes
///                6 SP for each strand, for each point, 3 int16: detail over detail_step
///                     zeros up to the next multiple of 16 bytes
///     Strands and details can be given to a graphics card as they are: see
///     examples/engine/hair.vert.
///
/// MIT license, as all of Lissom.
#pragma once

// NOLINTBEGIN: C, and names as C has them.

#include <stddef.h>
#include <stdint.h>

/// Declaration of the functions; define it before the include to change that.
#ifndef LISSOM_HAIR_API
#define LISSOM_HAIR_API static inline
#endif

#define LISSOM_HAIR_VERSION 1u
#define LISSOM_HAIR_MAX_POINTS 256u

/// Result of `lissom_hair_open`.
typedef enum lissom_hair_status {
    LISSOM_HAIR_OK = 0,
    /// The memory ends before the hair does.
    LISSOM_HAIR_TRUNCATED,
    /// The memory does not begin with hair.
    LISSOM_HAIR_NOT_HAIR,
    /// Hair of a version that this file does not know.
    LISSOM_HAIR_UNKNOWN_VERSION,
    /// Sizes or guides contradict each other, or a number is not finite.
    LISSOM_HAIR_DAMAGED,
    /// The memory does not begin at a multiple of 4 bytes.
    LISSOM_HAIR_NOT_ALIGNED,
    /// This machine is not little endian with 32-bit floats.
    LISSOM_HAIR_UNSUPPORTED_MACHINE
} lissom_hair_status;

/// A strand as it stands in the file.
typedef struct lissom_hair_strand {
    float root[3], length;
    uint32_t guides[3], id;
    float weights[3], width;
} lissom_hair_strand;

/// Open hair. Plain data that points into the memory it was opened on, which must stay.
typedef struct lissom_hair {
    uint32_t strand_count, guide_count, point_count;
    /// Metres that a detail of 1 is.
    float detail_step;
    const lissom_hair_strand* strands;
    /// 3 floats a point, guide after guide: the guides at rest.
    const float* guides;
    /// 3 numbers a point, strand after strand; null without details.
    const int16_t* details;
} lissom_hair;

// ---- Private

#define LISSOM_HAIR__HEADER 48u

LISSOM_HAIR_API uint32_t lissom_hair__u32(const unsigned char* at) {
    return (uint32_t)at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
}

LISSOM_HAIR_API uint64_t lissom_hair__u64(const unsigned char* at) {
    return (uint64_t)lissom_hair__u32(at) | (uint64_t)lissom_hair__u32(at + 4) << 32;
}

LISSOM_HAIR_API int lissom_hair__machine_fits(void) {
    union {
        float number;
        unsigned char bytes[4];
    } one;
    one.number = 1.0f;
    return sizeof(float) == 4 && sizeof(lissom_hair_strand) == 48 && one.bytes[0] == 0 &&
           one.bytes[2] == 0x80 && one.bytes[3] == 0x3f;
}

LISSOM_HAIR_API int lissom_hair__finite(const float* at, uint64_t count) {
    uint64_t i;
    for (i = 0; i < count; ++i) {
        if (!(at[i] - at[i] == 0.0f)) return 0;
    }
    return 1;
}

LISSOM_HAIR_API int lissom_hair__strands_fit(const lissom_hair* hair) {
    uint32_t s;
    int i;
    for (s = 0; s < hair->strand_count; ++s) {
        const lissom_hair_strand* const strand = hair->strands + s;
        if (!lissom_hair__finite(strand->root, 4)) return 0;
        if (!lissom_hair__finite(strand->weights, 4)) return 0;
        for (i = 0; i < 3; ++i) {
            if (strand->guides[i] >= hair->guide_count) return 0;
        }
    }
    return 1;
}

/* The root of a number from 1 to 4, by Newton's method. */
LISSOM_HAIR_API float lissom_hair__root(float square) {
    float root = 0.5f + 0.5f * square;
    int i;
    for (i = 0; i < 5; ++i) root = 0.5f * (root + square / root);
    return root;
}

/* Scales to length one; leaves zero and numbers that are not finite, and returns 0 for them. */
LISSOM_HAIR_API int lissom_hair__normalize(float* n) {
    float largest = 0.0f, length;
    int i;
    for (i = 0; i < 3; ++i) {
        const float size = n[i] < 0.0f ? -n[i] : n[i];
        if (size > largest) largest = size;
    }
    if (!(largest > 0.0f) || !(largest - largest == 0.0f)) return 0;
    for (i = 0; i < 3; ++i) n[i] /= largest;
    length = lissom_hair__root(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (i = 0; i < 3; ++i) n[i] /= length;
    return 1;
}

/* The unit direction of a guide at point k, from the point before to the one after. */
LISSOM_HAIR_API int lissom_hair__tangent(const float* guide, uint32_t points, uint32_t k,
                                         float* tangent) {
    const float* const from = guide + 3 * (size_t)(k > 0 ? k - 1 : 0);
    const float* const to = guide + 3 * (size_t)(k + 1 < points ? k + 1 : k);
    int i;
    for (i = 0; i < 3; ++i) tangent[i] = to[i] - from[i];
    return lissom_hair__normalize(tangent);
}

/* The least rotation from one unit vector to another, row by row. */
LISSOM_HAIR_API void lissom_hair__turn(const float* from, const float* to, float* turn) {
    const float axis[3] = {from[1] * to[2] - from[2] * to[1], from[2] * to[0] - from[0] * to[2],
                           from[0] * to[1] - from[1] * to[0]};
    const float cosine = from[0] * to[0] + from[1] * to[1] + from[2] * to[2];
    const float factor = 1.0f + cosine > 1e-4f ? 1.0f / (1.0f + cosine) : 0.0f;
    int r, c;
    for (r = 0; r < 3; ++r) {
        for (c = 0; c < 3; ++c) {
            turn[3 * r + c] = (r == c ? cosine : 0.0f) + factor * axis[r] * axis[c];
        }
    }
    turn[1] -= axis[2];
    turn[2] += axis[1];
    turn[3] += axis[2];
    turn[5] -= axis[0];
    turn[6] -= axis[1];
    turn[7] += axis[0];
}

// ---- Public

/// Opens hair in memory that begins at a multiple of 4 bytes. Checks all of it.
LISSOM_HAIR_API lissom_hair_status lissom_hair_open(lissom_hair* hair, const void* memory,
                                                    size_t size) {
    static const char magic[8] = {'L', 'S', 'M', 'H', 'A', 'I', 'R', 'G'};
    const unsigned char* const bytes = (const unsigned char*)memory;
    uint64_t strands, guides, details, end;
    uint32_t flags;
    int i;
    if (!lissom_hair__machine_fits()) return LISSOM_HAIR_UNSUPPORTED_MACHINE;
    if ((uintptr_t)memory % 4 != 0) return LISSOM_HAIR_NOT_ALIGNED;
    for (i = 0; i < 8; ++i) {
        if ((size_t)i >= size) return LISSOM_HAIR_TRUNCATED;
        if (bytes[i] != (unsigned char)magic[i]) return LISSOM_HAIR_NOT_HAIR;
    }
    if (size < LISSOM_HAIR__HEADER) return LISSOM_HAIR_TRUNCATED;
    if (lissom_hair__u32(bytes + 8) != LISSOM_HAIR_VERSION) return LISSOM_HAIR_UNKNOWN_VERSION;
    hair->strand_count = lissom_hair__u32(bytes + 12);
    hair->guide_count = lissom_hair__u32(bytes + 16);
    hair->point_count = lissom_hair__u32(bytes + 20);
    flags = lissom_hair__u32(bytes + 24);
    hair->detail_step = *(const float*)(const void*)(bytes + 28);
    if (hair->point_count < 2 || hair->point_count > LISSOM_HAIR_MAX_POINTS || flags > 1 ||
        hair->strand_count > 0x7fffffffu || hair->guide_count > 0x7fffffffu ||
        !lissom_hair__finite(&hair->detail_step, 1)) {
        return LISSOM_HAIR_DAMAGED;
    }
    strands = LISSOM_HAIR__HEADER + 48 * (uint64_t)hair->strand_count;
    guides = strands + 12 * (uint64_t)hair->guide_count * hair->point_count;
    details = (guides + 15) / 16 * 16;
    end = details;
    if (flags == 1) end += 6 * (uint64_t)hair->strand_count * hair->point_count;
    end = (end + 15) / 16 * 16;
    if (lissom_hair__u64(bytes + 32) != end) return LISSOM_HAIR_DAMAGED;
    if (size < end) return LISSOM_HAIR_TRUNCATED;
    hair->strands = (const lissom_hair_strand*)(const void*)(bytes + LISSOM_HAIR__HEADER);
    hair->guides = (const float*)(const void*)(bytes + strands);
    hair->details = flags == 1 ? (const int16_t*)(const void*)(bytes + details) : (const int16_t*)0;
    if (!lissom_hair__finite(hair->guides, 3 * (uint64_t)hair->guide_count * hair->point_count) ||
        !lissom_hair__strands_fit(hair)) {
        return LISSOM_HAIR_DAMAGED;
    }
    return LISSOM_HAIR_OK;
}

/// Writes the least rotation of each point of each guide from rest, 9 floats row by row, by which
/// details turn with their guide. `guides` has 3 floats a point.
LISSOM_HAIR_API void lissom_hair_turns(const lissom_hair* hair, const float* guides, float* turns) {
    const uint32_t points = hair->point_count;
    uint32_t g, k;
    int i;
    for (g = 0; g < hair->guide_count; ++g) {
        const size_t first = (size_t)g * points;
        for (k = 0; k < points; ++k) {
            float rest[3], moved[3];
            float* const turn = turns + 9 * (first + k);
            if (lissom_hair__tangent(hair->guides + 3 * first, points, k, rest) &&
                lissom_hair__tangent(guides + 3 * first, points, k, moved)) {
                lissom_hair__turn(rest, moved, turn);
            } else {
                for (i = 0; i < 9; ++i) turn[i] = i % 4 == 0 ? 1.0f : 0.0f;
            }
        }
    }
}

/* Adds the details of a strand. `turns` are those of its first guide, or null. */
LISSOM_HAIR_API void lissom_hair__add_details(const int16_t* details, float step,
                                              const float* turns, uint32_t points, float* out) {
    uint32_t k;
    if (!turns) {
        for (k = 0; k < 3 * points; ++k) out[k] += step * (float)details[k];
        return;
    }
    for (k = 0; k < points; ++k) {
        const float* const m = turns + 9 * (size_t)k;
        const float x = step * (float)details[3 * k], y = step * (float)details[3 * k + 1],
                    z = step * (float)details[3 * k + 2];
        out[3 * k] += m[0] * x + m[1] * y + m[2] * z;
        out[3 * k + 1] += m[3] * x + m[4] * y + m[5] * z;
        out[3 * k + 2] += m[6] * x + m[7] * y + m[8] * z;
    }
}

/// Rebuilds the strands `first` to `first + count - 1`: 3 floats a point, point_count points a
/// strand, to `out`, which points to the first of them. `guides` has the moved guides, 3 floats a
/// point, or is null for those at rest. `turns` comes from lissom_hair_turns; null leaves details
/// unturned. A range beyond the last strand ends there.
LISSOM_HAIR_API void lissom_hair_rebuild(const lissom_hair* hair, const float* guides,
                                         const float* turns, uint32_t first, uint32_t count,
                                         float* out) {
    const uint32_t points = hair->point_count, numbers = 3 * points;
    const float* const moved = guides ? guides : hair->guides;
    uint32_t s, i, k;
    if (first > hair->strand_count) first = hair->strand_count;
    if (count > hair->strand_count - first) count = hair->strand_count - first;
    for (s = first; s < first + count; ++s, out += numbers) {
        const lissom_hair_strand* const strand = hair->strands + s;
        const float *g[3], *r[3];
        float w[3], root[3];
        for (i = 0; i < 3; ++i) {
            const size_t at = (size_t)strand->guides[i] * numbers;
            g[i] = moved + at;
            r[i] = hair->guides + at;
            w[i] = strand->length * strand->weights[i];
        }
        for (k = 0; k < 3; ++k) {
            root[k] = strand->root[k];
            for (i = 0; i < 3; ++i) {
                root[k] += strand->weights[i] * (g[i][k] - r[i][k]) - w[i] * g[i][k];
            }
        }
        for (k = 0; k < numbers; k += 3) {
            out[k] = root[0] + w[0] * g[0][k] + w[1] * g[1][k] + w[2] * g[2][k];
            out[k + 1] = root[1] + w[0] * g[0][k + 1] + w[1] * g[1][k + 1] + w[2] * g[2][k + 1];
            out[k + 2] = root[2] + w[0] * g[0][k + 2] + w[1] * g[1][k + 2] + w[2] * g[2][k + 2];
        }
        if (hair->details) {
            lissom_hair__add_details(
                hair->details + (size_t)s * numbers, hair->detail_step,
                turns ? turns + 9 * (size_t)strand->guides[0] * points : (const float*)0, points,
                out);
        }
    }
}

// NOLINTEND
