/// lissom.h: the C interface of Lissom. Deformation of meshes by handles, merging, pasting, hair,
/// and scripts.
///
///     lissom_context_options options = lissom_default_context_options();
///     lissom_context* context = NULL;
///     if (lissom_context_create(&options, &context) != LISSOM_OK) return 1;
///
///     lissom_mesh mesh;
///     if (lissom_mesh_load(context, "arm.obj", NULL, &mesh) != LISSOM_OK)
///         puts(lissom_last_error(context)->message);
///     ...
///     lissom_context_destroy(context);                 // frees all that was made in it
///
/// Calls
///     A function that can fail returns a lissom_status. It writes its results through the last
///     parameters, only if it returns LISSOM_OK. After any other status nothing has changed, and
///     lissom_last_error returns the text, the code and the elements concerned, until the next call
///     with this context. No function throws, prints or ends the process. Ids count from 0, angles
///     are in radians, texts and paths are UTF-8.
///
/// Options
///     Structs of options begin with `struct_size`. Take one from its lissom_default_ function and
///     change its fields; a struct filled with zeros is refused (LISSOM_BAD_STRUCT). If NULL is
///     allowed it means the defaults. Later versions add fields at the end, so that programs
///     compiled before continue to work.
///
/// Objects
///     An object is a handle of 8 bytes, passed by value: a number below 2^53 that no other object
///     of the process has or had. Zero is no object. A handle that was released, comes from another
///     context or is of another kind is refused (LISSOM_INVALID_HANDLE) and never touches memory.
///     Objects are independent: a mesh may be released while a deformer of it is in use.
///     `lissom_X_release` frees one, `lissom_context_destroy` all.
///
/// Threads
///     Use a context and its objects from one thread at a time; different contexts may be used at
///     once. Functions marked [any thread] may be called from any thread at any time. Callbacks
///     document the thread they run on. The library starts threads only if `threads` asks for them.
///
/// Space
///     The kernel is right-handed with y up, faces counter-clockwise seen from outside. A host with
///     other axes declares them once, in lissom_space: points, directions, transforms and triangles
///     are converted in both directions on their way through this interface. Files keep the axes
///     given in their options.
///
/// MIT license, as all of Lissom.
#pragma once

// NOLINTBEGIN(readability-identifier-naming, modernize-deprecated-headers): this is C.
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/// Attributes of every function; define it before the include to build or use a shared library.
#ifndef LISSOM_API
#define LISSOM_API
#endif
/// Marks functions that the next minor version may change or remove, without a new
/// LISSOM_ABI_VERSION. Define it as a warning attribute to find their uses.
#ifndef LISSOM_EXPERIMENTAL
#define LISSOM_EXPERIMENTAL
#endif

#ifdef __cplusplus
extern "C" {
#endif

/// Incremented if programs must be compiled again after a change of a function or struct. A program
/// compiled with another version does not link: the number is part of the name of
/// lissom_context_create.
#define LISSOM_ABI_VERSION 1
#define lissom_context_create lissom_context_create_abi1

// ---- Status and errors

typedef enum lissom_status {
    LISSOM_OK = 0,
    LISSOM_CANCELLED = 1,
    LISSOM_INVALID_ARGUMENT = 2,
    LISSOM_OUT_OF_RANGE = 3,
    LISSOM_FILE_NOT_FOUND = 4,
    LISSOM_FILE_IS_DIRECTORY = 5,
    LISSOM_FILE_EMPTY = 6,
    LISSOM_FILE_UNREADABLE = 7,
    LISSOM_FILE_WRITE_FAILED = 8,
    LISSOM_FILE_SYNTAX = 9,
    LISSOM_FILE_TRUNCATED = 10,
    LISSOM_FILE_TOO_LARGE = 11,
    LISSOM_UNKNOWN_FORMAT = 12,
    LISSOM_UNSAFE_PATH = 13,
    LISSOM_NOT_FINITE = 14,
    LISSOM_MESH_EMPTY = 15,
    LISSOM_FACE_INDEX = 16,
    LISSOM_FACE_TOO_SMALL = 17,
    LISSOM_REPEATED_VERTEX = 18,
    LISSOM_DUPLICATE_FACE = 19,
    LISSOM_NONMANIFOLD_EDGE = 20,
    LISSOM_NONMANIFOLD_VERTEX = 21,
    LISSOM_INCONSISTENT_ORIENTATION = 22,
    LISSOM_UNREFERENCED_VERTEX = 23,
    LISSOM_ZERO_AREA = 24,
    LISSOM_REGION_EMPTY = 25,
    LISSOM_TOPOLOGY_MISMATCH = 26,
    LISSOM_HANDLE_OUTSIDE_REGION = 27,
    LISSOM_HANDLE_OVERLAP = 28,
    LISSOM_HANDLE_REMOVED = 29,
    LISSOM_SINGULAR_TRANSFORM = 30,
    LISSOM_UNCONSTRAINED = 31,
    LISSOM_NOT_A_BOUNDARY = 32,
    LISSOM_NOT_A_DISK = 33,
    LISSOM_BOUNDARY_CONFLICT = 34,
    LISSOM_KEY_CONFLICT = 35,
    LISSOM_SKIN_MISMATCH = 36,
    LISSOM_NOT_POSITIVE_DEFINITE = 37,
    LISSOM_MEMORY_LIMIT = 38,
    LISSOM_UNSUPPORTED = 39,
    LISSOM_NO_DISPLAY = 40,
    LISSOM_INTERNAL = 41,
    /// The handle names no object of this kind in this context.
    LISSOM_INVALID_HANDLE = 100,
    /// A job works with the object; finish the job first.
    LISSOM_BUSY = 101,
    /// A struct of options does not come from its lissom_default_ function.
    LISSOM_BAD_STRUCT = 102,
    /// The script failed; the message has its file and line.
    LISSOM_SCRIPT_ERROR = 103
} lissom_status;

typedef enum lissom_element {
    LISSOM_NO_ELEMENT = 0,
    LISSOM_VERTEX = 1,
    LISSOM_EDGE = 2,
    LISSOM_FACE = 3,
    LISSOM_CORNER = 4,
    LISSOM_ROW = 5,
    LISSOM_COMPONENT = 6,
    LISSOM_LINE = 7,
    LISSOM_STRAND = 8
} lissom_element;

/// Error of the last call.
typedef struct lissom_error {
    lissom_status status;
    /// The name of the status in scripts and documentation: "file_not_found"; "" for LISSOM_OK.
    const char* code;
    /// The cause of the error and its remedy.
    const char* message;
    /// Elements concerned: their kind, their true number, and the ids of the first hundred (edges:
    /// two vertices each).
    lissom_element element;
    size_t element_count;
    const int32_t* ids;
    size_t id_count;
} lissom_error;

/// Returns "file_not_found", ..., or "unknown" for any other number. Lives for ever. [any thread]
LISSOM_API const char* lissom_status_name(lissom_status status);
/// Returns a paragraph on the meaning of a status and its remedy. Lives for ever. [any thread]
LISSOM_API const char* lissom_status_explanation(lissom_status status);

// ---- Version

/// Returns 10000 * major + 100 * minor + patch of the library. [any thread]
LISSOM_API int32_t lissom_version(void);
/// Returns "0.2.0". [any thread]
LISSOM_API const char* lissom_version_text(void);
/// Returns the licence that a program with this library may be distributed under: "MIT", or
/// "GPL-2.0-or-later" in a program that links the static library and takes in lissom::cholmod.
/// [any thread]
LISSOM_API const char* lissom_licence(void);
/// Returns whether scripts and lissom_call are part of this library. [any thread]
LISSOM_API bool lissom_has_scripts(void);

// ---- Context

typedef struct lissom_context lissom_context;

typedef enum lissom_log_level {
    LISSOM_DEBUG = 0,
    LISSOM_INFO = 1,
    LISSOM_WARNING = 2
} lissom_log_level;

/// Axes and orientation of the host's space; see above. All zero is the kernel's own.
typedef struct lissom_space {
    /// z is up; in a right-handed space y then points away from the viewer.
    bool z_up;
    bool left_handed;
    /// Faces are clockwise seen from outside.
    bool clockwise;
} lissom_space;

/// Receives bytes; a file may take several calls. [called by the host]
typedef void lissom_sink(void* argument, const void* bytes, size_t size);

/// Host services of a context. Each function is optional and receives `user`.
typedef struct lissom_context_options {
    size_t struct_size;
    void* user;
    /// Receives messages, on the thread of the operation. Without it the library is silent.
    void (*log)(void* user, lissom_log_level level, const char* message);
    /// Receives the current step and the fraction done, 0 to 1, on the thread of the operation.
    void (*progress)(void* user, const char* label, double fraction);
    /// Calls chunk(argument, i) once for each i below `count`, in any order, on any threads, and
    /// returns when all have returned. Replaces threads of the library.
    void (*parallel_for)(void* user, size_t count, void (*chunk)(void* argument, size_t i),
                         void* argument);
    /// Runs task(argument) once, on any thread, at once or later, and returns the argument of
    /// `wait`. Jobs run in it; without it a job runs when it begins. Must be given together with
    /// `wait`.
    void* (*enqueue)(void* user, void (*task)(void* argument), void* argument);
    /// Returns once that task has returned.
    void (*wait)(void* user, void* task);
    /// Reads a file: passes its bytes to the sink and returns true, or returns false if there is
    /// none. With it the library opens no file for reading: files named by a file (.gltf: .bin) are
    /// read through it too, by their path from the folder of that file, and so are files of
    /// scripts.
    bool (*read_file)(void* user, const char* path, lissom_sink* sink, void* argument);
    /// Writes a whole file; returns false on failure. With it the library writes no file.
    bool (*write_file)(void* user, const char* path, const void* bytes, size_t size);
    /// Bytes that objects and operations may take together; 0 is no limit.
    size_t memory_limit;
    /// Threads of the library's own loops without parallel_for; 1 starts none.
    int32_t threads;
    lissom_space space;
} lissom_context_options;

/// Returns the defaults. [any thread]
LISSOM_API lissom_context_options lissom_default_context_options(void);
/// Makes a context. `options` may be NULL. [any thread]
/// Errors: BAD_STRUCT; INVALID_ARGUMENT for threads below 1, or `enqueue` without `wait`;
/// MEMORY_LIMIT. The message of an error goes to `log`, as there is no context yet.
LISSOM_API lissom_status lissom_context_create(const lissom_context_options* options,
                                               lissom_context** context);
/// Cancels jobs, waits for them, and frees the context with all its objects. NULL is allowed.
LISSOM_API void lissom_context_destroy(lissom_context* context);
/// Returns the error of the last call; never NULL, and of status LISSOM_OK if it succeeded.
LISSOM_API const lissom_error* lissom_last_error(const lissom_context* context);
/// Stops running calls: they return CANCELLED soon and change nothing. Later calls stop too, until
/// lissom_clear_cancel. [any thread]
LISSOM_API void lissom_cancel(lissom_context* context);
LISSOM_API void lissom_clear_cancel(lissom_context* context);
/// Return the bytes in use by objects and operations, and their peak so far. [any thread]
LISSOM_API size_t lissom_memory_used(const lissom_context* context);
LISSOM_API size_t lissom_memory_peak(const lissom_context* context);
/// Returns the number of objects that were not released.
LISSOM_API size_t lissom_object_count(const lissom_context* context);

// ---- Memory of the process

/// Blocks for which Linux is asked for pages of 2 MiB (madvise, where the system has transparent
/// huge pages). Other systems have none of this.
typedef enum lissom_large_pages {
    /// Matrices and factors of deformations, which are written at large.
    LISSOM_LARGE_PAGES_AUTOMATIC = 0,
    LISSOM_LARGE_PAGES_NEVER = 1,
    /// Every block of 4 MiB or more.
    LISSOM_LARGE_PAGES_ALWAYS = 2
} lissom_large_pages;

/// Memory of the library in this process, for all contexts: objects move between them, threads
/// share them, and one may free the blocks of another.
typedef struct lissom_memory_options {
    size_t struct_size;
    void* user;
    /// Returns `size` bytes at a multiple of `alignment`, a power of two, or NULL if there are
    /// none: the call then ends with MEMORY_LIMIT. NULL: the C runtime's malloc. [any thread]
    void* (*allocate)(void* user, size_t size, size_t alignment);
    /// Takes back a block of that function, with the same size and alignment. Neither function may
    /// call the library or throw. [any thread]
    void (*release)(void* user, void* block, size_t size, size_t alignment);
    /// Smaller blocks come from the C runtime; 0: all come from `allocate`.
    size_t min_bytes;
    lissom_large_pages large_pages;
} lissom_memory_options;

/// Returns the C runtime's memory and automatic large pages. [any thread]
LISSOM_API lissom_memory_options lissom_default_memory_options(void);
/// Sets where memory comes from, from now on; NULL: the defaults. Best called before the first
/// context is made. A block always goes back to the `release` that came with the `allocate` that
/// made it: both functions and `user` must work until all contexts are destroyed. Then no block is
/// left with them, as tables that the process keeps are in memory of the C runtime.
///
/// All that the library takes by new, malloc and Lua comes from the host: meshes, matrices and
/// factors, strands, states of Lua. Not so buffers of files that are open, stacks of
/// threads, and oneTBB's own memory. Only the shared library on Linux takes an allocator or
/// LARGE_PAGES_ALWAYS. In a program that links the static library, its own operator new and malloc
/// are used, and may be replaced as C++ has it. [any thread]
/// Errors: BAD_STRUCT; INVALID_ARGUMENT for one function without the other or unknown large_pages;
/// UNSUPPORTED; OUT_OF_RANGE for the 256th different allocator of a process.
LISSOM_API lissom_status lissom_set_memory(const lissom_memory_options* options);

// ---- Data of the host

typedef enum lissom_format {
    LISSOM_FLOAT32 = 0,
    LISSOM_FLOAT64 = 1,
    LISSOM_UINT32 = 2,
    LISSOM_INT32 = 3,
    LISSOM_UINT8 = 4,
    LISSOM_UINT16 = 5,
    LISSOM_UNORM8 = 6,   ///< 0 to 255 for numbers from 0 to 1
    LISSOM_UNORM16 = 7,  ///< 0 to 65535 for numbers from 0 to 1
    LISSOM_SNORM8 = 8,   ///< -127 to 127 for numbers from -1 to 1
    LISSOM_SNORM16 = 9,  ///< -32767 to 32767 for numbers from -1 to 1
    LISSOM_FLOAT16 = 10  ///< IEEE 754 binary16, up to 65504
} lissom_format;

/// A list in the host's memory that is read, for instance the positions among the vertices of an
/// engine. Its elements are numbers or triples of numbers, as the function says. Positions are
/// FLOAT16, FLOAT32 or FLOAT64; integers are UINT8, UINT16, UINT32 or INT32; attributes have any
/// format. An element may not overlap the next: such a stride is refused (INVALID_ARGUMENT).
typedef struct lissom_input {
    const void* data;
    size_t count;
    /// Bytes from one element to the next; 0: they follow each other without gaps.
    size_t stride;
    lissom_format format;
} lissom_input;

/// A list in the host's memory that is written: mapped vertex buffers too, as nothing is read from
/// it. `count` is its capacity in elements; if it is too small the call is refused as OUT_OF_RANGE.
/// The required number is returned by the neighbouring functions. Bytes between elements are left
/// as they are. `data` may be NULL only if no element is written, else INVALID_ARGUMENT. Normals
/// and tangents may be SNORM8 or SNORM16 too.
///
/// Ids and counts that the format cannot hold are refused (OUT_OF_RANGE). All other numbers are
/// rounded to the nearest that it holds, also beyond its range: to 3.40282347e38 or its negative as
/// FLOAT32, 65504 or -65504 as FLOAT16, 0 or 1 as UNORM8 and UNORM16, -1 or 1 as SNORM8 and
/// SNORM16, and the least or greatest integer as UINT8, UINT16, UINT32 and INT32. NAN is 0 in
/// formats that have none.
typedef struct lissom_output {
    void* data;
    size_t count;
    size_t stride;
    lissom_format format;
} lissom_output;

/// Bytes made by the library, followed by a zero byte, for texts. They live until the next call
/// with the context.
typedef struct lissom_bytes {
    const void* data;
    size_t size;
} lissom_bytes;

/// An affine map p' = m p: the rows of a 3 x 4 matrix.
typedef struct lissom_transform {
    double m[12];
} lissom_transform;

/// Returns the identity map. [any thread]
LISSOM_API lissom_transform lissom_identity(void);

// ---- Kinds of objects

typedef struct lissom_mesh {
    uint64_t id;
} lissom_mesh;
typedef struct lissom_region {
    uint64_t id;
} lissom_region;
typedef struct lissom_deformer {
    uint64_t id;
} lissom_deformer;
typedef struct lissom_pose {
    uint64_t id;
} lissom_pose;
typedef struct lissom_pose_space {
    uint64_t id;
} lissom_pose_space;
typedef struct lissom_merger {
    uint64_t id;
} lissom_merger;
typedef struct lissom_paste {
    uint64_t id;
} lissom_paste;
typedef struct lissom_hairstyle {
    uint64_t id;
} lissom_hairstyle;
typedef struct lissom_strands {
    uint64_t id;
} lissom_strands;
typedef struct lissom_render_map {
    uint64_t id;
} lissom_render_map;
typedef struct lissom_job {
    uint64_t id;
} lissom_job;
typedef struct lissom_script {
    uint64_t id;
} lissom_script;
/// An object of scripts and lissom_call alone: a path, a curve, a scene, ...
typedef struct lissom_object {
    uint64_t id;
} lissom_object;

/// Returns whether the handle names an object of this context.
LISSOM_API bool lissom_mesh_is_valid(const lissom_context* context, lissom_mesh mesh);
LISSOM_API bool lissom_region_is_valid(const lissom_context* context, lissom_region region);
LISSOM_API bool lissom_deformer_is_valid(const lissom_context* context, lissom_deformer deformer);
LISSOM_API bool lissom_pose_is_valid(const lissom_context* context, lissom_pose pose);
LISSOM_API bool lissom_pose_space_is_valid(const lissom_context* context, lissom_pose_space space);
LISSOM_API bool lissom_merger_is_valid(const lissom_context* context, lissom_merger merger);
LISSOM_API bool lissom_paste_is_valid(const lissom_context* context, lissom_paste paste);
LISSOM_API bool lissom_hairstyle_is_valid(const lissom_context* context, lissom_hairstyle style);
LISSOM_API bool lissom_strands_is_valid(const lissom_context* context, lissom_strands strands);
LISSOM_API bool lissom_render_map_is_valid(const lissom_context* context, lissom_render_map map);
LISSOM_API bool lissom_job_is_valid(const lissom_context* context, lissom_job job);
LISSOM_API bool lissom_script_is_valid(const lissom_context* context, lissom_script script);
LISSOM_API bool lissom_object_is_valid(const lissom_context* context, lissom_object object);

/// Frees an object. Errors: INVALID_HANDLE; BUSY while a job works with it.
LISSOM_API lissom_status lissom_mesh_release(lissom_context* context, lissom_mesh mesh);
LISSOM_API lissom_status lissom_region_release(lissom_context* context, lissom_region region);
LISSOM_API lissom_status lissom_deformer_release(lissom_context* context, lissom_deformer deformer);
LISSOM_API lissom_status lissom_pose_release(lissom_context* context, lissom_pose pose);
LISSOM_API lissom_status lissom_pose_space_release(lissom_context* context,
                                                   lissom_pose_space space);
LISSOM_API lissom_status lissom_merger_release(lissom_context* context, lissom_merger merger);
LISSOM_API lissom_status lissom_paste_release(lissom_context* context, lissom_paste paste);
LISSOM_API lissom_status lissom_hairstyle_release(lissom_context* context, lissom_hairstyle style);
LISSOM_API lissom_status lissom_strands_release(lissom_context* context, lissom_strands strands);
LISSOM_API lissom_status lissom_render_map_release(lissom_context* context, lissom_render_map map);
LISSOM_API lissom_status lissom_script_release(lissom_context* context, lissom_script script);
LISSOM_API lissom_status lissom_object_release(lissom_context* context, lissom_object object);

// ---- Jobs
//
// Functions with `begin` in their name start a job and return at once if the host has given
// `enqueue`; without it the job has run when they return. Each does what the function of the same
// name without `begin` does, and its arguments may be freed once it has returned. Progress, log,
// and the functions for files are called on the thread that the host runs the job on.
//
// Meshes that a job reads (to save, cut, merge, paste, erase) are copied when it begins and stay
// free. Other objects that it works with are BUSY until it is finished, but the last frame of a
// deformer and the content of a mesh can be read meanwhile, as they were when the job began. A job
// of a script or of lissom_call works with all objects that scripts know; other scripts and calls
// are BUSY.

typedef enum lissom_job_state { LISSOM_JOB_RUNNING = 0, LISSOM_JOB_DONE = 1 } lissom_job_state;

/// Receives whether the job has ended, successfully or not. Does not wait. Called on the thread of
/// the last other call with the context it sets lissom_last_error, as do lissom_job_progress and
/// lissom_job_cancel. Errors: INVALID_HANDLE; INVALID_ARGUMENT. [any thread]
LISSOM_API lissom_status lissom_job_poll(const lissom_context* context, lissom_job job,
                                         lissom_job_state* state);
/// Receives the fraction done, 0 to 1, and writes the name of the current step, cut to `label_size`
/// bytes with the zero at its end; `label` may be NULL. Does not wait. [any thread]
LISSOM_API lissom_status lissom_job_progress(const lissom_context* context, lissom_job job,
                                             double* fraction, char* label, size_t label_size);
/// Asks this job alone to stop; finish it all the same. [any thread]
LISSOM_API lissom_status lissom_job_cancel(const lissom_context* context, lissom_job job);
/// Waits for the job if it still runs, takes over its result, and frees it. Returns the status of
/// the function without `begin`; the error is that of the job. `result` receives the handle of the
/// first new object if the job makes one (`id` of its struct), else 0; it may be NULL. Objects that
/// are not received are dropped.
LISSOM_API lissom_status lissom_job_finish(lissom_context* context, lissom_job job,
                                           uint64_t* result);

/// All that a job leaves.
typedef struct lissom_job_outcome {
    size_t struct_size;
    /// Handles of new objects in the order of the function's parameters, as a mesh and its map, or
    /// both parts of a cut; 0 for no object.
    uint64_t objects[2];
    /// Results of a script or of lissom_call. They live until the next call with the context.
    lissom_bytes json;
    /// Set it to a report to receive that of a merge or a paste; NULL for none.
    struct lissom_merge_report* report;
} lissom_job_outcome;

LISSOM_API lissom_job_outcome lissom_default_job_outcome(void);
/// Finishes a job as lissom_job_finish does, and receives all that it leaves.
LISSOM_API lissom_status lissom_job_finish_with(lissom_context* context, lissom_job job,
                                                lissom_job_outcome* outcome);

// ---- Between contexts

/// Moves an object to another context that the same thread uses: the handle in `context` is
/// released and `moved` receives the new one. Meshes move with their attributes, regions and files'
/// contents, strands with all their values. Regions, deformers and other objects belong to a mesh,
/// and are made again in the other context. Errors, those of `context`: UNSUPPORTED for an object
/// of such a kind, naming how it is made again; INVALID_HANDLE; BUSY; MEMORY_LIMIT of `other`.
/// Nothing has moved then.
LISSOM_API lissom_status lissom_move(lissom_context* context, uint64_t object,
                                     lissom_context* other, uint64_t* moved);

// ---- Meshes

typedef enum lissom_weld {
    LISSOM_WELD_AUTOMATIC = 0,  ///< all for STL, else seams
    LISSOM_WELD_SEAMS = 1,      ///< vertices at one place along open edges become one
    LISSOM_WELD_ALL = 2,
    LISSOM_WELD_NONE = 3
} lissom_weld;

/// Compression of glTF files.
typedef enum lissom_compression {
    LISSOM_COMPRESSION_NONE = 0,
    LISSOM_COMPRESSION_MESHOPT = 1,  ///< EXT_meshopt_compression
    LISSOM_COMPRESSION_DRACO = 2     ///< KHR_draco_mesh_compression
} lissom_compression;

typedef struct lissom_mesh_load_options {
    size_t struct_size;
    lissom_weld weld;
    /// Repairs the mesh; if false, defects are errors.
    bool repair;
    /// The file's z axis is up.
    bool z_up;
    /// Length of the file's unit in units of the mesh; above 0.
    double unit;
} lissom_mesh_load_options;

typedef struct lissom_mesh_save_options {
    size_t struct_size;
    bool z_up;
    double unit;
    /// Binary or text, for PLY and STL.
    bool binary;
    /// UNSUPPORTED if the library was built without the codec, INVALID_ARGUMENT but for glTF.
    lissom_compression compression;
    /// Bits of positions in a compressed file, relative to the size of the object, 6 to 20; texture
    /// coordinates have as many, directions half as many but at least 8. 0 keeps all numbers.
    int32_t quantize;
} lissom_mesh_save_options;

LISSOM_API lissom_mesh_load_options lissom_default_mesh_load_options(void);
LISSOM_API lissom_mesh_save_options lissom_default_mesh_save_options(void);

/// Makes a mesh of positions (triples) and faces. `corners` are the vertices of all faces one after
/// the other (integers); `sizes` are their numbers per face (integers), or NULL if all are
/// triangles. Accepts oriented 2-manifolds of polygons, with or without boundary. Errors:
/// NOT_FINITE; FACE_INDEX, FACE_TOO_SMALL, REPEATED_VERTEX, DUPLICATE_FACE, NONMANIFOLD_EDGE,
/// NONMANIFOLD_VERTEX, INCONSISTENT_ORIENTATION, each naming the elements; INVALID_ARGUMENT if
/// sizes and corners do not fit; CANCELLED; MEMORY_LIMIT.
LISSOM_API lissom_status lissom_mesh_create(lissom_context* context, const lissom_input* positions,
                                            const lissom_input* corners, const lissom_input* sizes,
                                            lissom_mesh* mesh);
/// Loads .obj .ply .off .stl .gltf .glb. `options` may be NULL. Repairs are listed in the log.
/// Errors: FILE_NOT_FOUND, UNKNOWN_FORMAT, FILE_SYNTAX, ... as lissom_status lists them.
LISSOM_API lissom_status lissom_mesh_load(lissom_context* context, const char* path,
                                          const lissom_mesh_load_options* options,
                                          lissom_mesh* mesh);
/// Reads a mesh from the bytes of a file; `extension` is "obj", "glb", ... Errors: FILE_EMPTY
/// without bytes; else as lissom_mesh_load.
LISSOM_API lissom_status lissom_mesh_decode(lissom_context* context, const void* bytes, size_t size,
                                            const char* extension,
                                            const lissom_mesh_load_options* options,
                                            lissom_mesh* mesh);
/// Saves by extension, whole or not at all. Data that the format cannot hold is named in the log.
LISSOM_API lissom_status lissom_mesh_save(lissom_context* context, lissom_mesh mesh,
                                          const char* path,
                                          const lissom_mesh_save_options* options);
/// Start the load, whose result is a mesh, and the save, as jobs.
LISSOM_API lissom_status lissom_mesh_begin_load(lissom_context* context, const char* path,
                                                const lissom_mesh_load_options* options,
                                                lissom_job* job);
LISSOM_API lissom_status lissom_mesh_begin_save(lissom_context* context, lissom_mesh mesh,
                                                const char* path,
                                                const lissom_mesh_save_options* options,
                                                lissom_job* job);
LISSOM_API lissom_status lissom_mesh_encode(lissom_context* context, lissom_mesh mesh,
                                            const char* extension,
                                            const lissom_mesh_save_options* options,
                                            lissom_bytes* bytes);
LISSOM_API lissom_status lissom_mesh_copy(lissom_context* context, lissom_mesh mesh,
                                          lissom_mesh* copy);

/// Return numbers of elements, or -1 for an invalid handle. Polygons are counted as their
/// triangles.
LISSOM_API int32_t lissom_mesh_vertex_count(lissom_context* context, lissom_mesh mesh);
LISSOM_API int32_t lissom_mesh_face_count(lissom_context* context, lissom_mesh mesh);
LISSOM_API int32_t lissom_mesh_corner_count(lissom_context* context, lissom_mesh mesh);
LISSOM_API int32_t lissom_mesh_triangle_count(lissom_context* context, lissom_mesh mesh);
LISSOM_API int32_t lissom_mesh_boundary_count(lissom_context* context, lissom_mesh mesh);

/// Write one triple a vertex. Normals are of unit length, weighted by the angles of faces; zero if
/// no face of the vertex has area.
LISSOM_API lissom_status lissom_mesh_read_positions(lissom_context* context, lissom_mesh mesh,
                                                    const lissom_output* positions);
LISSOM_API lissom_status lissom_mesh_read_normals(lissom_context* context, lissom_mesh mesh,
                                                  const lissom_output* normals);
/// Writes triples of vertices, one a triangle (integers).
LISSOM_API lissom_status lissom_mesh_read_triangles(lissom_context* context, lissom_mesh mesh,
                                                    const lissom_output* triangles);
/// Writes the vertices of all faces, one integer a corner, and the number of corners of each.
/// Either may be NULL.
LISSOM_API lissom_status lissom_mesh_read_faces(lissom_context* context, lissom_mesh mesh,
                                                const lissom_output* corners,
                                                const lissom_output* sizes);
/// Writes the vertices of open boundary `number`, in order. `count` receives their number;
/// `vertices` may be NULL to ask for that alone. Errors: OUT_OF_RANGE.
LISSOM_API lissom_status lissom_mesh_read_boundary(lissom_context* context, lissom_mesh mesh,
                                                   int32_t number, const lissom_output* vertices,
                                                   int32_t* count);
/// Replaces all positions (triples). Errors: INVALID_ARGUMENT for another number; NOT_FINITE.
LISSOM_API lissom_status lissom_mesh_set_positions(lissom_context* context, lissom_mesh mesh,
                                                   const lissom_input* positions);
/// Moves all vertices; a map that mirrors turns the faces over. Errors: SINGULAR_TRANSFORM;
/// NOT_FINITE.
LISSOM_API lissom_status lissom_mesh_transform(lissom_context* context, lissom_mesh mesh,
                                               const lissom_transform* map);
/// Receives the least and greatest coordinates. Errors: MESH_EMPTY.
LISSOM_API lissom_status lissom_mesh_bounds(lissom_context* context, lissom_mesh mesh,
                                            double least[3], double greatest[3]);
/// Receives a hash of all content, the same on every platform; equal meshes have equal hashes.
LISSOM_API lissom_status lissom_mesh_hash(lissom_context* context, lissom_mesh mesh,
                                          uint64_t* hash);

// ---- Attributes of meshes: texture coordinates, colours, weights of skins, morph targets, and
// lists of the host's own. Names have a meaning: "uv", "uv2", ... (2 numbers), "color", "color2",
// ... (3 or 4, linear), "normal" (3), "tangent" (4), "joints" and "weights" (4 or a multiple of
// it), "morph.1.position", "morph.1.normal", "morph.1.tangent" (3), "morph.2.position", ...; they
// travel through every operation and every file that can hold them. Directions and offsets are in
// the host's space. Corners are in the order of lissom_mesh_read_faces.

typedef enum lissom_domain {
    LISSOM_ON_VERTICES = 0,
    LISSOM_ON_CORNERS = 1,
    LISSOM_ON_FACES = 2
} lissom_domain;

typedef struct lissom_attribute {
    size_t struct_size;
    /// Lives until the next call with the context.
    const char* name;
    lissom_domain domain;
    /// Numbers in an element.
    int32_t width;
    /// Elements: vertices, corners or faces of the mesh.
    int32_t count;
} lissom_attribute;

LISSOM_API lissom_attribute lissom_default_attribute(void);
/// Returns the number of attributes of a mesh, or -1 for an invalid handle.
LISSOM_API int32_t lissom_mesh_attribute_count(lissom_context* context, lissom_mesh mesh);
/// Receives the name and shape of attribute `number`, from 0. Errors: OUT_OF_RANGE; BAD_STRUCT.
LISSOM_API lissom_status lissom_mesh_attribute(lissom_context* context, lissom_mesh mesh,
                                               int32_t number, lissom_attribute* attribute);
/// Receives the same of the attribute called `name`. Errors: OUT_OF_RANGE if there is none.
LISSOM_API lissom_status lissom_mesh_find_attribute(lissom_context* context, lissom_mesh mesh,
                                                    const char* name, lissom_attribute* attribute);
/// Writes all elements of an attribute, in any format. An element without values is NAN in formats
/// that have it, else 0. Errors: OUT_OF_RANGE.
LISSOM_API lissom_status lissom_mesh_read_attribute(lissom_context* context, lissom_mesh mesh,
                                                    const char* name, const lissom_output* values);
/// Adds an attribute of `width` numbers an element, or replaces the one of this name. Files get it
/// as the type of the list's format if they can. Errors: INVALID_ARGUMENT for another number of
/// elements than the domain has, an empty name or one that is not UTF-8, or a width that does not
/// suit a name with a meaning; NOT_FINITE.
LISSOM_API lissom_status lissom_mesh_write_attribute(lissom_context* context, lissom_mesh mesh,
                                                     const char* name, lissom_domain domain,
                                                     int32_t width, const lissom_input* values);
/// Errors: OUT_OF_RANGE if there is none.
LISSOM_API lissom_status lissom_mesh_remove_attribute(lissom_context* context, lissom_mesh mesh,
                                                      const char* name);
/// Return the number of labels of a kind ("material", "group", "object", "smoothing"), 0 for a mesh
/// without them, -1 for an invalid handle; and the name of one, which lives until the next call.
/// Errors: OUT_OF_RANGE.
LISSOM_API int32_t lissom_mesh_label_count(lissom_context* context, lissom_mesh mesh,
                                           const char* kind);
LISSOM_API lissom_status lissom_mesh_label_name(lissom_context* context, lissom_mesh mesh,
                                                const char* kind, int32_t label, const char** name);
/// Writes the label of each face (integers); -1 in 32 bits for a face without one. Errors:
/// OUT_OF_RANGE without labels of this kind.
LISSOM_API lissom_status lissom_mesh_read_labels(lissom_context* context, lissom_mesh mesh,
                                                 const char* kind, const lissom_output* labels);
/// Sets the labels of all faces as places in `names`. Errors: INVALID_ARGUMENT; OUT_OF_RANGE for a
/// label that has no name.
LISSOM_API lissom_status lissom_mesh_write_labels(lissom_context* context, lissom_mesh mesh,
                                                  const char* kind, const char* const* names,
                                                  int32_t name_count, const lissom_input* labels);
/// Write the origin of each vertex or face of a mesh that a merge, a paste or an erasure made, as
/// long as its topology stays: the number of the input (0: the target or the first target, then
/// further targets, the source last), and its element there; -1 in both for new ones. An element
/// that blends several has the heaviest. Either list may be NULL. Errors: OUT_OF_RANGE for another
/// mesh.
LISSOM_API lissom_status lissom_mesh_read_vertex_origins(lissom_context* context, lissom_mesh mesh,
                                                         const lissom_output* inputs,
                                                         const lissom_output* elements);
LISSOM_API lissom_status lissom_mesh_read_face_origins(lissom_context* context, lissom_mesh mesh,
                                                       const lissom_output* inputs,
                                                       const lissom_output* elements);

// ---- Render maps: the vertices that an engine draws. A mesh has one vertex at a place; a vertex
// buffer has several there if texture coordinates or normals differ, along seams. A map joins both:
// it belongs to the topology of a mesh, and after that has changed its use is refused
// (TOPOLOGY_MISMATCH). It takes part in no operation and may be used with any copy of the mesh.

/// A vertex buffer and its faces.
typedef struct lissom_buffer {
    size_t struct_size;
    /// Triples.
    lissom_input positions;
    /// Integers: the vertices of all faces. `sizes` are their numbers per face; without elements
    /// all are triangles.
    lissom_input corners, sizes;
    /// One triple a vertex, or no element: vertices at one place whose normals differ by more than
    /// a degree get normals of their own. They become the attribute "normal".
    lissom_input normals;
    /// One pair a vertex, or no element. They become the attribute "uv".
    lissom_input uvs;
    /// Vertices with equal coordinates that become one vertex of the mesh.
    lissom_weld weld;
    /// Repairs the mesh as loading does; if false, defects are errors.
    bool repair;
} lissom_buffer;

/// Returns a buffer without elements that is welded along seams and repaired.
LISSOM_API lissom_buffer lissom_default_buffer(void);
/// Makes a mesh of a vertex buffer, and its map; `map` may be NULL. Repairs are listed in the log.
/// Errors: as lissom_mesh_create; with `repair` only NOT_FINITE, FACE_INDEX and INVALID_ARGUMENT.
LISSOM_API lissom_status lissom_mesh_create_welded(lissom_context* context,
                                                   const lissom_buffer* buffer, lissom_mesh* mesh,
                                                   lissom_render_map* map);
/// Starts that as a job, whose results are a mesh and its map. The buffer is read before it
/// returns.
LISSOM_API lissom_status lissom_mesh_begin_create(lissom_context* context,
                                                  const lissom_buffer* buffer, lissom_job* job);
/// Makes the map of a mesh that did not come from a buffer, such as the result of a merge: its
/// render vertices are apart if an attribute of corners differs between faces, or if texture
/// coordinates are mirrored from one face to the next.
LISSOM_API lissom_status lissom_render_map_create(lissom_context* context, lissom_mesh mesh,
                                                  lissom_render_map* map);
/// Return the number of render vertices and of triangles, or -1 for an invalid handle. The
/// triangles of a buffer may be fewer than were given: those that were dropped are not drawn.
LISSOM_API int32_t lissom_render_map_size(lissom_context* context, lissom_render_map map);
LISSOM_API int32_t lissom_render_map_triangle_count(lissom_context* context, lissom_render_map map);
/// Writes the vertex of the mesh below each render vertex (integers); -1 in 32 bits if its faces
/// were dropped and no other vertex lies at its place.
LISSOM_API lissom_status lissom_render_map_read_vertices(lissom_context* context,
                                                         lissom_render_map map,
                                                         const lissom_output* vertices);
/// Writes triples of render vertices, one a triangle (integers). Errors: OUT_OF_RANGE if the format
/// is too small for the number of a vertex.
LISSOM_API lissom_status lissom_render_map_read_triangles(lissom_context* context,
                                                          lissom_render_map map, lissom_mesh mesh,
                                                          const lissom_output* triangles);
/// Write one triple a render vertex, of the present shape of a mesh. Render vertices without a
/// vertex of the mesh are left as they are. Normals are of unit length, weighted by the angles of
/// faces, across seams but not across creases.
LISSOM_API lissom_status lissom_render_map_read_positions(lissom_context* context,
                                                          lissom_render_map map, lissom_mesh mesh,
                                                          const lissom_output* positions);
LISSOM_API lissom_status lissom_render_map_read_normals(lissom_context* context,
                                                        lissom_render_map map, lissom_mesh mesh,
                                                        const lissom_output* normals);
/// Writes four numbers a render vertex by the rule of MikkTSpace: a unit tangent along the first
/// texture coordinate, and the sign of the bitangent, sign * cross(normal, tangent). `uv` names the
/// attribute of texture coordinates; NULL is "uv". In a left-handed space the sign is that of its
/// own cross product. Errors: OUT_OF_RANGE without such an attribute.
LISSOM_API lissom_status lissom_render_map_read_tangents(lissom_context* context,
                                                         lissom_render_map map, lissom_mesh mesh,
                                                         const char* uv,
                                                         const lissom_output* tangents);
/// Writes an attribute of vertices or corners, one element a render vertex. Errors: OUT_OF_RANGE if
/// there is none.
LISSOM_API lissom_status lissom_render_map_read_attribute(lissom_context* context,
                                                          lissom_render_map map, lissom_mesh mesh,
                                                          const char* name,
                                                          const lissom_output* values);

// ---- Regions: sets of vertices of a mesh. A region belongs to the mesh's topology; after that has
// changed its use is refused (TOPOLOGY_MISMATCH).

LISSOM_API lissom_status lissom_region_all(lissom_context* context, lissom_mesh mesh,
                                           lissom_region* region);
/// Makes a region of a list of ids (integers), in any order. Errors: OUT_OF_RANGE naming the
/// vertices.
LISSOM_API lissom_status lissom_region_of_vertices(lissom_context* context, lissom_mesh mesh,
                                                   const lissom_input* vertices,
                                                   lissom_region* region);
LISSOM_API lissom_status lissom_region_sphere(lissom_context* context, lissom_mesh mesh,
                                              const double center[3], double radius,
                                              lissom_region* region);
LISSOM_API lissom_status lissom_region_box(lissom_context* context, lissom_mesh mesh,
                                           const double least[3], const double greatest[3],
                                           lissom_region* region);
/// Vertices on the side of a plane that `normal` points to.
LISSOM_API lissom_status lissom_region_plane(lissom_context* context, lissom_mesh mesh,
                                             const double point[3], const double normal[3],
                                             lissom_region* region);
/// Vertices within `radius` over the surface from the vertex nearest to `point`.
LISSOM_API lissom_status lissom_region_geodesic(lissom_context* context, lissom_mesh mesh,
                                                const double point[3], double radius,
                                                lissom_region* region);
/// Finds a region saved with the mesh or set below. Errors: OUT_OF_RANGE if there is none.
LISSOM_API lissom_status lissom_region_named(lissom_context* context, lissom_mesh mesh,
                                             const char* name, lissom_region* region);
/// Keeps a region with its mesh under a name; it is saved if the format can.
LISSOM_API lissom_status lissom_mesh_set_region(lissom_context* context, lissom_mesh mesh,
                                                const char* name, lissom_region region);

typedef enum lissom_region_operation {
    LISSOM_UNION = 0,
    LISSOM_INTERSECTION = 1,
    LISSOM_DIFFERENCE = 2
} lissom_region_operation;

/// Errors: TOPOLOGY_MISMATCH for regions of different meshes.
LISSOM_API lissom_status lissom_region_combine(lissom_context* context, lissom_region a,
                                               lissom_region b, lissom_region_operation operation,
                                               lissom_region* region);
LISSOM_API lissom_status lissom_region_invert(lissom_context* context, lissom_region a,
                                              lissom_region* region);
/// Adds `rings` one-rings, or removes as many if negative.
LISSOM_API lissom_status lissom_region_grow(lissom_context* context, lissom_region a, int32_t rings,
                                            lissom_region* region);
/// Returns the number of vertices, or -1 for an invalid handle.
LISSOM_API int32_t lissom_region_size(lissom_context* context, lissom_region region);
/// Writes ascending ids (integers).
LISSOM_API lissom_status lissom_region_read_vertices(lissom_context* context, lissom_region region,
                                                     const lissom_output* vertices);

// ---- Deformation by handles (thesis, chapter 2)

typedef enum lissom_second_system {
    LISSOM_SECOND_BLEND = 0,
    LISSOM_SECOND_LAPLACIAN = 1,
    LISSOM_SECOND_POISSON = 2
} lissom_second_system;

/// Connected parts of a region that no handle or point holds, such as buttons and eyes.
typedef enum lissom_loose_parts {
    LISSOM_LOOSE_ERROR = 0,  ///< UNCONSTRAINED, naming them
    LISSOM_LOOSE_STAY = 1,
    LISSOM_LOOSE_FOLLOW = 2  ///< each follows the surface nearest to it, as a rigid piece
} lissom_loose_parts;

typedef struct lissom_deformer_options {
    size_t struct_size;
    lissom_second_system second;
    /// Scale details with the surface around them (Eq 2.11) in place of keeping their size (Eq
    /// 2.10).
    bool scale_details;
    /// ARAP iterations, over-relaxed, 0 to 2.
    int32_t refine;
    /// Geodesic distance from the region's outline within which the deformation fades; in units of
    /// length.
    double transition;
    /// The thesis to the letter, for comparison; UNSUPPORTED in a library built without it.
    bool thesis;
    lissom_loose_parts loose;
    /// Rings of vertices, 0 to 10, that handles release if they nearly touch another: handles that
    /// go different ways would tear the surface between.
    int32_t free_rings;
    /// Above 0, a region of at least four times as many vertices is deformed on two levels: the
    /// method works on a thinned surface of about so many, and all others follow it. 40,000 is good
    /// for large meshes; 0, or at least 100.
    size_t level_vertices;
} lissom_deformer_options;

typedef struct lissom_handle_options {
    size_t struct_size;
    bool position;
    bool gradient;
    /// 0: the handle is hard. Otherwise it is soft: at 1 a compromise with the shape of the
    /// surface.
    double weight;
    /// Geodesic distance within which the surface follows softly.
    double falloff;
} lissom_handle_options;

LISSOM_API lissom_deformer_options lissom_default_deformer_options(void);
LISSOM_API lissom_handle_options lissom_default_handle_options(void);

/// Makes a deformer of `region` (zero: the whole mesh), with the present shape of the mesh as rest
/// shape. Vertices outside of the region do not move. Errors: REGION_EMPTY; TOPOLOGY_MISMATCH;
/// INVALID_ARGUMENT.
LISSOM_API lissom_status lissom_deformer_create(lissom_context* context, lissom_mesh mesh,
                                                lissom_region region,
                                                const lissom_deformer_options* options,
                                                lissom_deformer* deformer);
/// Adds a handle: vertices that move rigidly together. It stays in place until it gets a transform
/// by lissom_deformer_set_transform. `handle` numbers the handles of this deformer from 0; messages
/// count them from 1. Errors: REGION_EMPTY; HANDLE_OUTSIDE_REGION; HANDLE_OVERLAP, naming the
/// vertices.
LISSOM_API lissom_status lissom_deformer_add_handle(lissom_context* context,
                                                    lissom_deformer deformer,
                                                    lissom_region vertices,
                                                    const lissom_handle_options* options,
                                                    int32_t* handle);
/// Holds vertices where they are: a handle that keeps the identity. Errors: as
/// lissom_deformer_add_handle.
LISSOM_API lissom_status lissom_deformer_pin(lissom_context* context, lissom_deformer deformer,
                                             lissom_region vertices);
LISSOM_API lissom_status lissom_deformer_remove_handle(lissom_context* context,
                                                       lissom_deformer deformer, int32_t handle);
/// Receives the mean of the handle's vertices at rest.
LISSOM_API lissom_status lissom_deformer_handle_center(lissom_context* context,
                                                       lissom_deformer deformer, int32_t handle,
                                                       double center[3]);
/// Sets the transform of a handle from its rest shape. Rotations continue beyond half a turn.
/// Errors: SINGULAR_TRANSFORM; HANDLE_REMOVED.
LISSOM_API lissom_status lissom_deformer_set_transform(lissom_context* context,
                                                       lissom_deformer deformer, int32_t handle,
                                                       const lissom_transform* transform);
LISSOM_API lissom_status lissom_deformer_get_transform(lissom_context* context,
                                                       lissom_deformer deformer, int32_t handle,
                                                       lissom_transform* transform);
/// Constrains one vertex to a point; weight 0 is hard. Errors: OUT_OF_RANGE; HANDLE_OUTSIDE_REGION;
/// HANDLE_OVERLAP.
LISSOM_API lissom_status lissom_deformer_constrain(lissom_context* context,
                                                   lissom_deformer deformer, int32_t vertex,
                                                   const double position[3], double weight);
/// Frees a vertex that was constrained.
LISSOM_API lissom_status lissom_deformer_free(lissom_context* context, lissom_deformer deformer,
                                              int32_t vertex);
/// Factors the systems of the handles, so that the first frame of a drag is as fast as the others.
/// Errors: UNCONSTRAINED; ZERO_AREA; NOT_POSITIVE_DEFINITE; MEMORY_LIMIT; CANCELLED.
LISSOM_API lissom_status lissom_deformer_prepare(lissom_context* context, lissom_deformer deformer);
LISSOM_API lissom_status lissom_deformer_begin_prepare(lissom_context* context,
                                                       lissom_deformer deformer, lissom_job* job);

typedef enum lissom_quality {
    LISSOM_PREVIEW = 0,  ///< the first system, by the handle basis: fastest, with some shear
    LISSOM_DRAFT = 1,    ///< both systems, to about five digits
    LISSOM_FULL = 2      ///< both systems
} lissom_quality;

/// Computes the surface for the present transforms. Prepares if needed. Errors: as prepare.
LISSOM_API lissom_status lissom_deformer_solve(lissom_context* context, lissom_deformer deformer,
                                               lissom_quality quality);
LISSOM_API lissom_status lissom_deformer_begin_solve(lissom_context* context,
                                                     lissom_deformer deformer,
                                                     lissom_quality quality, lissom_job* job);
/// Return the number of vertices of the region, and their ascending ids (integers): the rows below.
LISSOM_API int32_t lissom_deformer_row_count(lissom_context* context, lissom_deformer deformer);
LISSOM_API lissom_status lissom_deformer_read_rows(lissom_context* context,
                                                   lissom_deformer deformer,
                                                   const lissom_output* vertices);
/// Writes the positions of the region after the last solve, one triple a row: the update of a frame
/// of a drag.
LISSOM_API lissom_status lissom_deformer_read_positions(lissom_context* context,
                                                        lissom_deformer deformer,
                                                        const lissom_output* positions);
/// Writes unit normals of the surface at the same rows, weighted by the angles of faces as in
/// lissom_mesh_read_normals: read them beside the positions of a frame. Vertices outside the region
/// but next to it keep their place; their normals turn only with the faces they share.
LISSOM_API lissom_status lissom_deformer_read_normals(lissom_context* context,
                                                      lissom_deformer deformer,
                                                      const lissom_output* normals);
/// Writes the last result into a mesh: the one it was made for, or a copy of it; custom normals and
/// morph targets follow. Errors: TOPOLOGY_MISMATCH for another mesh, or one that changed around the
/// region.
LISSOM_API lissom_status lissom_deformer_apply(lissom_context* context, lissom_deformer deformer,
                                               lissom_mesh mesh);

/// Kinds of harm that a deformation does to a surface, as bits.
typedef enum lissom_deform_harm {
    LISSOM_HARM_TORN = 1,       ///< handles that nearly touch go different ways
    LISSOM_HARM_STRETCHED = 2,  ///< edges change their length far more than the handles ask for
    LISSOM_HARM_FOLDED = 4,     ///< faces look against their neighbours
    LISSOM_HARM_CROSSING = 8,   ///< faces run through one another, if they were counted
    LISSOM_HARM_VOLUME = 16     ///< the volume changes far more than the handles ask for
} lissom_deform_harm;

/// The last result of a deformation beside its rest shape.
typedef struct lissom_deform_report {
    size_t struct_size;
    /// Bits of lissom_deform_harm that a user would see; 0 for a good result.
    uint32_t harms;
    /// The greatest factor by which an edge is longer or shorter than at rest, at least 1, and the
    /// vertices of that edge; -1 without one.
    double stretch;
    int32_t stretched[2];
    /// Faces that look against their neighbours and did not at rest.
    int32_t flipped;
    /// Pairs of faces that run through one another and did not at rest; -1: not counted.
    int32_t crossings;
    /// Pairs of vertices at which handles tear the surface.
    int32_t tears;
    /// Volume over that at rest, less 1; NAN for a mesh without a volume.
    double volume_change;
    /// A line for each harm with its measure and a remedy. It lives until the next call.
    const char* warnings;
} lissom_deform_report;

LISSOM_API lissom_deform_report lissom_default_deform_report(void);
/// Measures the last result as it lies in the mesh that the deformer was made for, or a copy of
/// it; the mesh stays as it is. Counting `crossings` takes longer than a frame. Errors:
/// TOPOLOGY_MISMATCH; CANCELLED.
LISSOM_API lissom_status lissom_deformer_report(lissom_context* context, lissom_deformer deformer,
                                                lissom_mesh mesh, bool crossings,
                                                lissom_deform_report* report);

/// Pairs of faces that run through one another in the last result of a deformer and did not at
/// rest.
typedef struct lissom_contacts {
    /// Two faces for each pair, the lower first, in ascending order. They live until the next call
    /// with the context.
    const int32_t* faces;
    /// Number of pairs.
    size_t count;
} lissom_contacts;

/// Finds the contacts of the last result, in about the time of a frame. Takes the mesh that the
/// deformer was made for, or a copy; its shape within the region does not matter. Errors:
/// TOPOLOGY_MISMATCH; NOT_FINITE beyond 1e30; MEMORY_LIMIT; CANCELLED.
LISSOM_API lissom_status lissom_deformer_find_contacts(lissom_context* context,
                                                       lissom_deformer deformer, lissom_mesh mesh,
                                                       lissom_contacts* contacts);
/// Solves in full along the way from the poses of the last solve to the present ones, and stays,
/// with the handles, before contacts appear. `share` is that of the way that was gone, 0 to 1, and
/// `contacts`, which may be NULL, those a thousandth of the way further. Errors: as solve and
/// find_contacts.
LISSOM_API lissom_status lissom_deformer_solve_until_contact(lissom_context* context,
                                                             lissom_deformer deformer,
                                                             lissom_mesh mesh, double* share,
                                                             lissom_contacts* contacts);
/// Solves in full and pushes apart parts that meet; handles hold exactly. `before`, which
/// may be NULL, is the number of contacts without pushing, and `left` those that stay, no more.
/// Errors: as solve and find_contacts; UNSUPPORTED for a comparison method.
LISSOM_API lissom_status lissom_deformer_solve_avoiding_contacts(lissom_context* context,
                                                                 lissom_deformer deformer,
                                                                 lissom_mesh mesh, int32_t* before,
                                                                 lissom_contacts* left);
/// The places on which a pin may slide.
typedef enum lissom_pin_place {
    LISSOM_PIN_PLANE = 0,
    LISSOM_PIN_LINE = 1,
    LISSOM_PIN_SPHERE = 2
} lissom_pin_place;

/// A vertex that slides on a plane, a line or a sphere.
typedef struct lissom_sliding_pin {
    int32_t vertex;
    lissom_pin_place on;
    /// A point of the plane or line, or the centre of the sphere.
    double point[3];
    /// Normal of the plane or direction of the line, of any length.
    double direction[3];
    /// Of the sphere: the distance from its centre.
    double radius;
} lissom_sliding_pin;

/// Solves in full with vertices held on places, at most 512, by forces square to these; handles
/// hold exactly. `distance` is the greatest that is left between a vertex and its place: places
/// that contradict each other stay apart. Errors: as solve; OUT_OF_RANGE; HANDLE_OUTSIDE_REGION;
/// HANDLE_OVERLAP for a vertex that a handle holds or that is pinned twice; INVALID_ARGUMENT for a
/// direction without length or a radius that is not above 0; NOT_FINITE; UNSUPPORTED for a
/// comparison method.
LISSOM_API lissom_status lissom_deformer_solve_with_pins(lissom_context* context,
                                                         lissom_deformer deformer,
                                                         const lissom_sliding_pin* pins,
                                                         size_t pin_count, double* distance);
/// Returns all handles and the surface to rest.
LISSOM_API lissom_status lissom_deformer_reset(lissom_context* context, lissom_deformer deformer);
/// Makes the last result the rest shape; handles stay in place on it.
LISSOM_API lissom_status lissom_deformer_rebase(lissom_context* context, lissom_deformer deformer);
/// Encodes the handle basis as a file: lissom_basis.h evaluates it into vertex buffers without the
/// library, on any thread, and so does a vertex shader. Errors: as prepare.
LISSOM_API lissom_status lissom_deformer_encode_basis(lissom_context* context,
                                                      lissom_deformer deformer,
                                                      lissom_bytes* bytes);
/// Encodes the handle basis with key poses, at which lissom_basis.h gives the result of
/// LISSOM_FULL, and between which it blends by the pose. `transforms` has one for each handle in
/// the order they were added, key after key; the deformer is as before afterwards. Errors: as
/// prepare and lissom_deformer_set_transform; INVALID_ARGUMENT for more than 256 keys, for another
/// number of transforms, and for two keys of one pose.
LISSOM_API lissom_status lissom_deformer_encode_keyed_basis(lissom_context* context,
                                                            lissom_deformer deformer,
                                                            const lissom_transform* transforms,
                                                            size_t transform_count,
                                                            size_t key_count, lissom_bytes* bytes);

// ---- Bones: chains of handles that turn at joints. Each bone holds the surface around its middle,
// and the solver finds how the rest follows. A chain is a part of its deformer and named by the
// number of its first handle, `bones`; bone i, from 0, is the handle `bones` + i. Poses hold
// transforms of handles and know bones by them.

typedef struct lissom_bones_options {
    size_t struct_size;
    /// For each bone the greatest angle from its rest direction, as seen from the bone before it,
    /// in radians; no element: no limits.
    lissom_input limits;
    /// Part of each bone's length, around its middle, along which it holds the surface; above 0, at
    /// most 1.
    double share;
    /// Above 0 a bone holds the vertices within this distance of it, and joints may lie anywhere:
    /// for lines along a surface, such as brows and lips. In units of length.
    double radius;
} lissom_bones_options;

LISSOM_API lissom_bones_options lissom_default_bones_options(void);

/// Lays a chain of bones into a limb. `mesh` is the one that the deformer was made for, or a copy;
/// `joints` (triples) lie within the surface at rest, from the base to the tip. Errors:
/// INVALID_ARGUMENT for fewer than two joints, bones without length, options out of range, and
/// naming the joint outside the surface or the bone that holds nothing; NOT_FINITE; HANDLE_OVERLAP;
/// TOPOLOGY_MISMATCH; MEMORY_LIMIT; CANCELLED.
LISSOM_API lissom_status lissom_deformer_add_bones(lissom_context* context,
                                                   lissom_deformer deformer, lissom_mesh mesh,
                                                   const lissom_input* joints,
                                                   const lissom_bones_options* options,
                                                   int32_t* bones);
/// Removes a chain and its handles. This and the functions below fail with HANDLE_REMOVED once one
/// of its handles is removed.
LISSOM_API lissom_status lissom_deformer_remove_bones(lissom_context* context,
                                                      lissom_deformer deformer, int32_t bones);
/// Turns a bone, and those behind it, about its first joint by an angle in radians about an axis of
/// any length, within its limit. Errors: OUT_OF_RANGE; INVALID_ARGUMENT for an axis without length;
/// NOT_FINITE.
LISSOM_API lissom_status lissom_deformer_turn_bone(lissom_context* context,
                                                   lissom_deformer deformer, int32_t bones,
                                                   int32_t bone, const double axis[3],
                                                   double angle);
/// Inverse kinematics: turns bones so that the tip comes to a point, or as near to it as lengths
/// and limits let it. A stretched chain whose target lies along it bends about `axis`; zeros are
/// one square to it. Receives the distance that is left. Errors: NOT_FINITE, also beyond 1e100.
LISSOM_API lissom_status lissom_deformer_reach_with_bones(lissom_context* context,
                                                          lissom_deformer deformer, int32_t bones,
                                                          const double target[3],
                                                          const double axis[3], double* distance);
/// Puts the first joint at a point; all bones go along as they are. Errors: NOT_FINITE.
LISSOM_API lissom_status lissom_deformer_move_bones(lissom_context* context,
                                                    lissom_deformer deformer, int32_t bones,
                                                    const double base[3]);
/// Lays a chain along a smooth curve through points (triples): spline IK. The base lies at its
/// start, and bones turn least from one to the next, and by `twist` radians about the curve from
/// the base to the tip. Lengths and limits stay, and behind its end bones go on straight; with
/// `stretch` joints keep their shares of the length, bones stretch along themselves, and no limit
/// holds. Errors: INVALID_ARGUMENT if fewer than two points differ, or a stretched chain would fold
/// onto itself; NOT_FINITE.
LISSOM_API lissom_status lissom_deformer_follow_with_bones(lissom_context* context,
                                                           lissom_deformer deformer, int32_t bones,
                                                           const lissom_input* points, bool stretch,
                                                           double twist);
/// Carries a handle, of bones or not, along a smooth curve through points (triples), turning with
/// it and by `twist` radians about it. `start` and `share` are its places at rest and now, as
/// shares of the curve's length; `start` below 0 is the nearest to its middle. Replaces its former
/// motion. Errors: INVALID_ARGUMENT if fewer than two points differ; NOT_FINITE; HANDLE_REMOVED.
LISSOM_API lissom_status lissom_deformer_carry_handle(lissom_context* context,
                                                      lissom_deformer deformer, int32_t handle,
                                                      const lissom_input* points, double start,
                                                      double share, double twist);
/// Puts all bones of a chain back to rest.
LISSOM_API lissom_status lissom_deformer_reset_bones(lissom_context* context,
                                                     lissom_deformer deformer, int32_t bones);
/// Returns the number of joints of a chain, or -1 if there is none of that number.
LISSOM_API int32_t lissom_deformer_joint_count(lissom_context* context, lissom_deformer deformer,
                                               int32_t bones);
/// Writes the joints of a chain as they are now, one triple each, by the transforms of its handles.
LISSOM_API lissom_status lissom_deformer_read_joints(lissom_context* context,
                                                     lissom_deformer deformer, int32_t bones,
                                                     const lissom_output* joints);

// ---- Poses

/// Makes a value of the present transforms of all handles and of the points that vertices are
/// constrained to. Handles may move on afterwards.
LISSOM_API lissom_status lissom_deformer_get_pose(lissom_context* context, lissom_deformer deformer,
                                                  lissom_pose* pose);
/// Moves the handles to a pose, for the next solve. Handles that were added since stay, and those
/// that were removed are passed over. Errors: INVALID_ARGUMENT for a pose of another deformer, or
/// of its rest shape before lissom_deformer_rebase.
LISSOM_API lissom_status lissom_deformer_set_pose(lissom_context* context, lissom_deformer deformer,
                                                  lissom_pose pose);
/// Makes the pose at `t` on the way from one pose, at 0, to another, at 1: handles turn and shift
/// as screws by the turns that they made, full ones too. Beyond 0 and 1 they go on. Errors:
/// INVALID_ARGUMENT for poses of other handles; NOT_FINITE; SINGULAR_TRANSFORM if a handle is
/// scaled by zero on the way.
LISSOM_API lissom_status lissom_pose_blend(lissom_context* context, lissom_pose start,
                                           lissom_pose end, double t, lissom_pose* pose);
/// Moves the handles to the pose at `t` on the way between two poses, as lissom_pose_blend and
/// lissom_deformer_set_pose do, for a frame between two keys: takes no memory once two frames were
/// made. Errors: as these.
LISSOM_API lissom_status lissom_deformer_set_blended_pose(lissom_context* context,
                                                          lissom_deformer deformer,
                                                          lissom_pose start, lissom_pose end,
                                                          double t);

/// A pose of a mesh by name. Several shapes are a path from rest: of n shapes, shape k, counted
/// from 1, is at weight k / n.
typedef struct lissom_named_pose {
    const char* name;
    const lissom_mesh* shapes;
    int32_t shape_count;
} lissom_named_pose;

/// Makes a space of poses: meshes with the vertices and faces of `rest` that blend by rotations, so
/// that half of a bent arm is an arm bent by half. The meshes stay as they are and may be released.
/// Errors: MESH_EMPTY; INVALID_ARGUMENT without poses, for a pose without shapes, and for a name
/// that is empty or there twice; TOPOLOGY_MISMATCH, naming the pose; MEMORY_LIMIT; CANCELLED.
LISSOM_API lissom_status lissom_pose_space_create(lissom_context* context, lissom_mesh rest,
                                                  const lissom_named_pose* poses,
                                                  int32_t pose_count, lissom_pose_space* space);
/// Starts to make a space as a job, whose result it is.
LISSOM_API lissom_status lissom_pose_space_begin_create(lissom_context* context, lissom_mesh rest,
                                                        const lissom_named_pose* poses,
                                                        int32_t pose_count, lissom_job* job);
/// Return the number of poses and the number of vertices, or -1 for an invalid handle.
LISSOM_API int32_t lissom_pose_space_pose_count(lissom_context* context, lissom_pose_space space);
LISSOM_API int32_t lissom_pose_space_vertex_count(lissom_context* context, lissom_pose_space space);
/// Receives the name of a pose; it lives until the next call. Poses keep the order in which they
/// were given. Errors: OUT_OF_RANGE.
LISSOM_API lissom_status lissom_pose_space_pose_name(lissom_context* context,
                                                     lissom_pose_space space, int32_t pose,
                                                     const char** name);
/// Writes the positions of a blend, with a weight for each pose in their order: 0 is rest, 1 the
/// pose, others go beyond. All weights 0 give the rest shape to the bit, and a pose alone its last
/// shape. A frame of an animation: takes no memory once two frames were made. Errors:
/// INVALID_ARGUMENT for another number of weights; NOT_FINITE; CANCELLED.
LISSOM_API lissom_status lissom_pose_space_read_positions(lissom_context* context,
                                                          lissom_pose_space space,
                                                          const lissom_input* weights,
                                                          const lissom_output* positions);
/// Makes the rest mesh in the blended shape; custom normals, tangents and morph targets turn along.
/// Errors: as lissom_pose_space_read_positions; MEMORY_LIMIT.
LISSOM_API lissom_status lissom_pose_space_blend(lissom_context* context, lissom_pose_space space,
                                                 const lissom_input* weights, lissom_mesh* mesh);

/// Morph targets of a space beside its blends. Lengths are in the units of the mesh.
typedef struct lissom_pose_targets_report {
    size_t struct_size;
    /// Number of targets of poses, which come first, and of correctives behind them.
    int32_t pose_targets;
    int32_t correctives;
    /// Greatest distance of a vertex from the blend, over tenths of the way from rest to every pose
    /// and to every corrective: by the poses' targets alone, and with correctives.
    double linear_error;
    double error;
} lissom_pose_targets_report;

LISSOM_API lissom_pose_targets_report lissom_default_pose_targets_report(void);
/// Makes the rest mesh with a morph target for each pose, for engines that blend linearly, and with
/// correctives that take back the error of that: at the weights in `correctives`, one number for
/// each pose, corrective after corrective (NULL: none), and at the shapes of paths. A mesh without
/// normals is given those of its surface. `report` may be NULL. Errors: INVALID_ARGUMENT for a
/// number of weights that is no multiple of the poses, for a corrective without weights other than
/// 0, at a pose alone, or there twice; NOT_FINITE; UNSUPPORTED for a mesh without faces;
/// MEMORY_LIMIT; CANCELLED.
LISSOM_API lissom_status lissom_pose_space_targets(lissom_context* context, lissom_pose_space space,
                                                   const lissom_input* correctives,
                                                   lissom_mesh* mesh,
                                                   lissom_pose_targets_report* report);

// ---- Cutting

typedef struct lissom_cut_options {
    size_t struct_size;
    /// Cut every line in which a plane crosses the mesh, not only the one nearest to its point.
    bool all_lines;
    /// Fraction of an edge within which vertices slide onto the line; 0 to 0.45.
    double slide;
} lissom_cut_options;

LISSOM_API lissom_cut_options lissom_default_cut_options(void);
/// Cuts by a plane near a point of it; the part that `normal` points to is `kept`. `rest` may be
/// NULL. Errors: INVALID_ARGUMENT if the plane does not cross the mesh; BOUNDARY_CONFLICT if the
/// line does not separate it; MESH_EMPTY; NOT_FINITE; CANCELLED.
LISSOM_API lissom_status lissom_cut_by_plane(lissom_context* context, lissom_mesh mesh,
                                             const double point[3], const double normal[3],
                                             const lissom_cut_options* options, lissom_mesh* kept,
                                             lissom_mesh* rest);
/// Cuts out a region along its smoothed outlines. Errors: as above; REGION_EMPTY.
LISSOM_API lissom_status lissom_cut_by_region(lissom_context* context, lissom_mesh mesh,
                                              lissom_region region,
                                              const lissom_cut_options* options, lissom_mesh* kept,
                                              lissom_mesh* rest);
/// Start the cuts as jobs, whose results are the kept part and the rest.
LISSOM_API lissom_status lissom_cut_begin_by_plane(lissom_context* context, lissom_mesh mesh,
                                                   const double point[3], const double normal[3],
                                                   const lissom_cut_options* options,
                                                   lissom_job* job);
LISSOM_API lissom_status lissom_cut_begin_by_region(lissom_context* context, lissom_mesh mesh,
                                                    lissom_region region,
                                                    const lissom_cut_options* options,
                                                    lissom_job* job);

// ---- Merging (thesis, section 3.3)

/// Two open boundaries that become one, and points that meet: pairs of triples, one pair a key.
typedef struct lissom_join {
    int32_t source_boundary;
    /// Number of the target, and of its boundary.
    int32_t target;
    int32_t target_boundary;
    /// `key_count` points on the source's boundary and as many on the target's; may be NULL for
    /// none.
    const double* source_keys;
    const double* target_keys;
    int32_t key_count;
} lissom_join;

typedef struct lissom_merge_options {
    size_t struct_size;
    /// Bends the source in place; otherwise it is moved to the target first.
    bool fixed_configuration;
    /// Umbrella steps at the seam, at most.
    int32_t smooth;
    /// Remeshes beside a seam whose sides differ in density.
    bool collar;
    /// Chooses widths over which the details of both sides fade into each other.
    bool transition;
    /// Finds new self-intersections.
    bool find_intersections;
    /// The thesis to the letter, for comparison; UNSUPPORTED in a library built without it.
    bool thesis;
} lissom_merge_options;

/// Result of a merge or a paste.
typedef struct lissom_merge_report {
    size_t struct_size;
    /// Whether the seams are good.
    bool ok;
    /// Scale of the source at the first join.
    double scale;
    /// Steepest dihedral angle at the seams, in radians.
    double max_dihedral;
    int32_t intersections;
    /// The fault of the seams, in a line; warnings, one a line. They live until the next call.
    const char* verdict;
    const char* warnings;
} lissom_merge_report;

LISSOM_API lissom_merge_options lissom_default_merge_options(void);
LISSOM_API lissom_merge_report lissom_default_merge_report(void);

/// Merges `source` with one target; the meshes stay as they are. Without joins (NULL and 0) their
/// nearest boundaries meet. `options` and `report` may be NULL. Errors: NOT_A_BOUNDARY for a closed
/// mesh; as lissom_merger_create and lissom_merger_solve.
LISSOM_API lissom_status lissom_merge(lissom_context* context, lissom_mesh source,
                                      lissom_mesh target, const lissom_join* joins,
                                      int32_t join_count, const lissom_merge_options* options,
                                      lissom_mesh* mesh, lissom_merge_report* report);
/// Starts the merge as a job, whose result is a mesh, with a report.
LISSOM_API lissom_status lissom_begin_merge(lissom_context* context, lissom_mesh source,
                                            lissom_mesh target, const lissom_join* joins,
                                            int32_t join_count, const lissom_merge_options* options,
                                            lissom_job* job);
/// Checks and prepares a merge of `source` onto `target_count` targets, to be solved again with
/// other keys. Without joins each target meets the source at their nearest boundaries. The meshes
/// stay as they are. Errors: INVALID_ARGUMENT; OUT_OF_RANGE for a boundary; BOUNDARY_CONFLICT;
/// UNCONSTRAINED; ZERO_AREA; MEMORY_LIMIT; CANCELLED.
LISSOM_API lissom_status lissom_merger_create(lissom_context* context, lissom_mesh source,
                                              const lissom_mesh* targets, int32_t target_count,
                                              const lissom_join* joins, int32_t join_count,
                                              const lissom_merge_options* options,
                                              lissom_merger* merger);
/// Replaces the keys of one join; nothing is factored again. Errors: OUT_OF_RANGE; KEY_CONFLICT.
LISSOM_API lissom_status lissom_merger_set_keys(lissom_context* context, lissom_merger merger,
                                                int32_t join, const double* source_keys,
                                                const double* target_keys, int32_t key_count);
/// Computes the merged mesh. `report` may be NULL. Errors: KEY_CONFLICT; BOUNDARY_CONFLICT;
/// CANCELLED.
LISSOM_API lissom_status lissom_merger_solve(lissom_context* context, lissom_merger merger,
                                             lissom_mesh* mesh, lissom_merge_report* report);
/// Starts the solve as a job, whose result is a mesh.
LISSOM_API lissom_status lissom_merger_begin_solve(lissom_context* context, lissom_merger merger,
                                                   lissom_job* job);

// ---- Pasting with an optimal boundary (thesis, section 3.4)

typedef struct lissom_placement {
    size_t struct_size;
    /// Position of the middle of the feature, projected to the nearest point of the target.
    double at[3];
    /// Direction on the target of the source's `up`; all zero: the same as on the
    /// source.
    double toward[3];
    double up[3];
    /// Rotation about the surface's normal, from `toward`; NAN: the best fit.
    double angle;
    double scale;
} lissom_placement;

LISSOM_API lissom_placement lissom_default_placement(void);

/// Prepares the paste of the feature in `region` of `source` onto `target`. `feature` and `onto`
/// may be zero: the inner part of the region, and a disk around the placement. Errors:
/// TOPOLOGY_MISMATCH, REGION_EMPTY, BOUNDARY_CONFLICT, NOT_A_DISK naming elements; CANCELLED.
LISSOM_EXPERIMENTAL LISSOM_API lissom_status
lissom_paste_create(lissom_context* context, lissom_mesh source, lissom_mesh target,
                    lissom_region region, lissom_region feature, lissom_region onto,
                    const lissom_placement* placement, lissom_paste* paste);
/// Optimizes the loop for the least distortion.
LISSOM_EXPERIMENTAL LISSOM_API lissom_status lissom_paste_optimize(lissom_context* context,
                                                                   lissom_paste paste,
                                                                   int32_t iterations);
/// Replaces the placement; after an error the last good placement stays.
LISSOM_EXPERIMENTAL LISSOM_API lissom_status lissom_paste_move(lissom_context* context,
                                                               lissom_paste paste,
                                                               const lissom_placement* placement);
/// Computes the target with the feature. `report` may be NULL.
LISSOM_EXPERIMENTAL LISSOM_API lissom_status lissom_paste_merge(lissom_context* context,
                                                                lissom_paste paste,
                                                                lissom_mesh* mesh,
                                                                lissom_merge_report* report);
/// Start these as jobs: the result is a paste, nothing, or a mesh with a report.
LISSOM_EXPERIMENTAL LISSOM_API lissom_status lissom_paste_begin_create(
    lissom_context* context, lissom_mesh source, lissom_mesh target, lissom_region region,
    lissom_region feature, lissom_region onto, const lissom_placement* placement, lissom_job* job);
LISSOM_EXPERIMENTAL LISSOM_API lissom_status lissom_paste_begin_optimize(lissom_context* context,
                                                                         lissom_paste paste,
                                                                         int32_t iterations,
                                                                         lissom_job* job);
LISSOM_EXPERIMENTAL LISSOM_API lissom_status lissom_paste_begin_merge(lissom_context* context,
                                                                      lissom_paste paste,
                                                                      lissom_job* job);
/// Makes a copy of a mesh without the feature in a region: the surface around goes on over its
/// place. Errors: REGION_EMPTY; TOPOLOGY_MISMATCH; NOT_A_DISK; BOUNDARY_CONFLICT; CANCELLED.
LISSOM_EXPERIMENTAL LISSOM_API lissom_status lissom_erase(lissom_context* context, lissom_mesh mesh,
                                                          lissom_region region,
                                                          lissom_mesh* erased);
/// Starts that as a job, whose result is a mesh.
LISSOM_EXPERIMENTAL LISSOM_API lissom_status lissom_begin_erase(lissom_context* context,
                                                                lissom_mesh mesh,
                                                                lissom_region region,
                                                                lissom_job* job);

// ---- Hair (thesis, chapter 4). Points are in the space of the head's mesh; lengths of hair are in
// metres of an average head, so that they fit any head. Strands are in metres: a point of the mesh
// times the unit of lissom_hairstyle_unit.

typedef struct lissom_hairstyle_options {
    size_t struct_size;
    /// Maximum number of points of the field's grid.
    int32_t resolution;
    /// Metres in one unit of the head's mesh; 0: estimated.
    double unit;
    /// Region of roots; zero: the mesh's region "scalp", or the part above the hairline.
    lissom_region scalp;
    /// Directions of the head in the mesh; all zero: estimated.
    double up[3];
    double front[3];
    /// Hair that no curve is near falls, and goes to the ties of ponytails; 0: the curves alone
    /// determine all hair; at most 1.
    double gravity;
} lissom_hairstyle_options;

typedef struct lissom_grow_options {
    size_t struct_size;
    int32_t count;
    uint64_t seed;
    /// Length of a strand, in metres, and the fraction by which it varies.
    double length;
    double variation;
} lissom_grow_options;

LISSOM_API lissom_hairstyle_options lissom_default_hairstyle_options(void);
LISSOM_API lissom_grow_options lissom_default_grow_options(void);

/// Makes a style without curves. Errors: INVALID_ARGUMENT; MESH_EMPTY; MEMORY_LIMIT; CANCELLED.
LISSOM_API lissom_status lissom_hairstyle_create(lissom_context* context, lissom_mesh head,
                                                 const lissom_hairstyle_options* options,
                                                 lissom_hairstyle* style);
/// Reads a style from a file's text (JSON), onto any head; resolution and gravity are those of the
/// file.
LISSOM_API lissom_status lissom_hairstyle_decode(lissom_context* context, const void* text,
                                                 size_t size, lissom_mesh head,
                                                 const lissom_hairstyle_options* options,
                                                 lissom_hairstyle* style);
LISSOM_API lissom_status lissom_hairstyle_encode(lissom_context* context, lissom_hairstyle style,
                                                 lissom_bytes* text);
/// Receives the point of the head in a direction from its middle, `lift` metres of an average head
/// above it: azimuth 0 in front and pi / 2 at the head's left, elevation pi / 2 up. Errors:
/// OUT_OF_RANGE.
LISSOM_API lissom_status lissom_hairstyle_at(lissom_context* context, lissom_hairstyle style,
                                             double azimuth, double elevation, double lift,
                                             double point[3]);
/// Receives the normal of the head below that point, of length 1.
LISSOM_API lissom_status lissom_hairstyle_normal_at(lissom_context* context, lissom_hairstyle style,
                                                    double azimuth, double elevation,
                                                    double normal[3]);
/// Receives the metres in one unit of the head's mesh, by which strands are larger than the mesh,
/// and the units of the mesh in one metre of an average head. Either may be NULL.
LISSOM_API lissom_status lissom_hairstyle_unit(lissom_context* context, lissom_hairstyle style,
                                               double* metres, double* scale);
/// Adds a curve through points (triples): hair flows along a stream curve, parts at a dividing
/// curve, and gathers in a ponytail at the beginning of its spine. A radius of 0 is the default.
/// `curve` is its number in this style. Errors: INVALID_ARGUMENT if fewer than two points differ;
/// OUT_OF_RANGE outside of the volume; NOT_FINITE.
LISSOM_API lissom_status lissom_hairstyle_add_stream(lissom_context* context,
                                                     lissom_hairstyle style,
                                                     const lissom_input* points, int32_t* curve);
LISSOM_API lissom_status lissom_hairstyle_add_dividing(lissom_context* context,
                                                       lissom_hairstyle style,
                                                       const lissom_input* points, int32_t* curve);
LISSOM_API lissom_status lissom_hairstyle_add_ponytail(lissom_context* context,
                                                       lissom_hairstyle style,
                                                       const lissom_input* spine, double radius,
                                                       int32_t* curve);
LISSOM_API lissom_status lissom_curve_set_points(lissom_context* context, lissom_hairstyle style,
                                                 int32_t curve, const lissom_input* points);
LISSOM_API lissom_status lissom_curve_enable(lissom_context* context, lissom_hairstyle style,
                                             int32_t curve, bool on);
LISSOM_API lissom_status lissom_curve_remove(lissom_context* context, lissom_hairstyle style,
                                             int32_t curve);
/// Return the number of curves, and the numbers of all curves in order (integers).
LISSOM_API int32_t lissom_hairstyle_curve_count(lissom_context* context, lissom_hairstyle style);
LISSOM_API lissom_status lissom_hairstyle_read_curves(lissom_context* context,
                                                      lissom_hairstyle style,
                                                      const lissom_output* curves);
/// Receives the direction of hair at a point. Errors: INVALID_ARGUMENT before a solve.
LISSOM_API lissom_status lissom_hairstyle_field(lissom_context* context, lissom_hairstyle style,
                                                const double point[3], double direction[3]);
/// Updates the field; lissom_hairstyle_grow does so by itself.
LISSOM_API lissom_status lissom_hairstyle_solve(lissom_context* context, lissom_hairstyle style);
/// Starts the update as a job.
LISSOM_API lissom_status lissom_hairstyle_begin_solve(lissom_context* context,
                                                      lissom_hairstyle style, lissom_job* job);
/// Grows hair into new strands. If `strands` is valid its content is replaced and its memory
/// reused: set it to zero before the first call. Errors: INVALID_ARGUMENT without a curve;
/// CANCELLED.
LISSOM_API lissom_status lissom_hairstyle_grow(lissom_context* context, lissom_hairstyle style,
                                               const lissom_grow_options* options,
                                               lissom_strands* strands);
/// Starts the growth as a job, whose result is new strands.
LISSOM_API lissom_status lissom_hairstyle_begin_grow(lissom_context* context,
                                                     lissom_hairstyle style,
                                                     const lissom_grow_options* options,
                                                     lissom_job* job);

// ---- Strands

/// Makes strands. Strand s has the points offsets[s] to offsets[s + 1] - 1 (integers, one more than
/// strands).
LISSOM_API lissom_status lissom_strands_create(lissom_context* context, const lissom_input* points,
                                               const lissom_input* offsets,
                                               lissom_strands* strands);
/// Load .hair, .data, .usda, .tfx, .ply; save also .rib, .glb, .obj. Files are in metres.
LISSOM_API lissom_status lissom_strands_load(lissom_context* context, const char* path,
                                             lissom_strands* strands);
LISSOM_API lissom_status lissom_strands_save(lissom_context* context, lissom_strands strands,
                                             const char* path);
/// Start the load, whose result is new strands, and the save, as jobs. Strands that are saved are
/// BUSY.
LISSOM_API lissom_status lissom_strands_begin_load(lissom_context* context, const char* path,
                                                   lissom_job* job);
LISSOM_API lissom_status lissom_strands_begin_save(lissom_context* context, lissom_strands strands,
                                                   const char* path, lissom_job* job);
/// Return the numbers of strands and of points, or -1 for an invalid handle.
LISSOM_API int32_t lissom_strands_size(lissom_context* context, lissom_strands strands);
LISSOM_API int32_t lissom_strands_point_count(lissom_context* context, lissom_strands strands);
LISSOM_API lissom_status lissom_strands_read_points(lissom_context* context, lissom_strands strands,
                                                    const lissom_output* points);
LISSOM_API lissom_status lissom_strands_read_offsets(lissom_context* context,
                                                     lissom_strands strands,
                                                     const lissom_output* offsets);

/// Values of strands.
typedef enum lissom_strand_value {
    LISSOM_STRAND_WIDTH = 0,             ///< diameter in metres; 1 number, on strands or points
    LISSOM_STRAND_COLOR = 1,             ///< linear RGB; 3, on strands or points
    LISSOM_STRAND_TRANSPARENCY = 2,      ///< 0 is opaque; 1, on strands or points
    LISSOM_STRAND_ROOT_UV = 3,           ///< texture coordinates of the root; 2
    LISSOM_STRAND_ROOT_FACE = 4,         ///< face of the head; 1 integer
    LISSOM_STRAND_ROOT_BARYCENTRIC = 5,  ///< weights of the triangle's vertices; 3
    LISSOM_STRAND_GROUP = 6,             ///< place in the list of groups, -1 for none; 1 integer
    LISSOM_STRAND_ID = 7,         ///< stays with the strand when some are selected; 1 integer
    LISSOM_STRAND_GUIDE = 8,      ///< id of the strand it follows, -1 for none; 1 integer
    LISSOM_STRAND_GUIDE_ARC = 9,  ///< metres along the guide that its tip follows; 1
    /// Vertices of the triangle of the face that contains the root; 3 integers. Absent on heads of
    /// triangles: then it has the three corners of the face.
    LISSOM_STRAND_ROOT_TRIANGLE = 10
} lissom_strand_value;

/// Returns whether strands have these values: 0 or 1; -1 for an invalid handle. Widths,
/// transparency and ids are always there.
LISSOM_API int32_t lissom_strands_has(lissom_context* context, lissom_strands strands,
                                      lissom_strand_value value);
/// Write one element a strand, or one a point for widths, colours and transparency, which take the
/// profile along the strand in. Integers go to UINT32 or INT32 lists, others to any format but
/// those. Errors: OUT_OF_RANGE if there are none.
LISSOM_API lissom_status lissom_strands_read(lissom_context* context, lissom_strands strands,
                                             lissom_strand_value value,
                                             const lissom_output* values);
LISSOM_API lissom_status lissom_strands_read_at_points(lissom_context* context,
                                                       lissom_strands strands,
                                                       lissom_strand_value value,
                                                       const lissom_output* values);
/// Replace values of all strands, one element a strand, or one a point. Errors: INVALID_ARGUMENT
/// for another number of elements; OUT_OF_RANGE for a group that has no name; NOT_FINITE.
LISSOM_API lissom_status lissom_strands_write(lissom_context* context, lissom_strands strands,
                                              lissom_strand_value value,
                                              const lissom_input* values);
LISSOM_API lissom_status lissom_strands_write_at_points(lissom_context* context,
                                                        lissom_strands strands,
                                                        lissom_strand_value value,
                                                        const lissom_input* values);
/// Replaces all points (triples); strands keep their numbers of points. Errors: INVALID_ARGUMENT
/// for another number; NOT_FINITE, also beyond 32-bit floats, which strands keep.
LISSOM_API lissom_status lissom_strands_set_points(lissom_context* context, lissom_strands strands,
                                                   const lissom_input* points);
/// Return the number of groups, or -1 for an invalid handle; and the name of one, which lives until
/// the next call. Errors: OUT_OF_RANGE.
LISSOM_API int32_t lissom_strands_group_count(lissom_context* context, lissom_strands strands);
LISSOM_API lissom_status lissom_strands_group_name(lissom_context* context, lissom_strands strands,
                                                   int32_t group, const char** name);
/// Names the groups, and with them all groups there are; strands of a group without a name are then
/// in none. Errors: INVALID_ARGUMENT for an empty name.
LISSOM_API lissom_status lissom_strands_set_groups(lissom_context* context, lissom_strands strands,
                                                   const char* const* names, int32_t count);

// ---- Scripts, and everything else. These return UNSUPPORTED if the library was built without
// Lua.
//
// A context runs its scripts in one Lua state of its own, whose memory counts to the context. They
// have Lua's libraries, except functions that end the process (os.exit) or write to its output
// (print goes to the log), and the `lissom` of the reference, in the kernel's space. The library
// opens files for them as for the host; Lua's own io opens any. The shared library has a Lua of its
// own inside, beside that of the host, and loads no Lua modules written in C. Ids of scripts count
// from 1 and their angles are in degrees.

/// Limits of untrusted scripts. Times and instructions are for one run or call; 0 is no
/// limit.
typedef struct lissom_sandbox_options {
    size_t struct_size;
    /// Wall time.
    double seconds;
    /// Instructions of Lua's virtual machine, counted in hundreds.
    int64_t instructions;
    /// Bytes for Lua, objects of scripts and their operations, all together; they count to the
    /// context too.
    size_t memory;
    /// Bytes that are printed and written to files, all together. A file is counted after it is
    /// written, so that the last one may exceed the limit.
    size_t output;
    /// Folders below which files may be read and written, and searched by `require` for NAME.lua.
    /// Without folders no file may, except by read_file and write_file, which then decide.
    const char* const* read_folders;
    const char* const* write_folders;
    const char* const* module_folders;
    int32_t read_folder_count;
    int32_t write_folder_count;
    int32_t module_folder_count;
} lissom_sandbox_options;

/// Returns 10 seconds, any number of instructions, 256 MiB of memory, 64 MiB of output, no folders.
/// [any thread]
LISSOM_API lissom_sandbox_options lissom_default_sandbox_options(void);
/// Runs the scripts and calls of this context in a sandbox from now on: with Lua's language,
/// strings, tables, numbers and coroutines, and the library, but without the system, without binary
/// chunks, and within fixed limits. A script that exceeds the time, the instructions or the output
/// is CANCELLED; one that exceeds the memory gets MEMORY_LIMIT; the next one runs. `options` may be
/// NULL. Errors: BAD_STRUCT; INVALID_ARGUMENT after a script or call, for a second sandbox, or for
/// limits or numbers of folders below 0; MEMORY_LIMIT.
LISSOM_API lissom_status lissom_sandbox_scripts(lissom_context* context,
                                                const lissom_sandbox_options* options);

/// Loads a script, as `name` in messages, and runs it only until it declares its parameters.
/// Errors: SCRIPT_ERROR.
LISSOM_API lissom_status lissom_script_load(lissom_context* context, const char* text, size_t size,
                                            const char* name, lissom_script* script);
/// Receives the parameters of the script as JSON: a list of {"name", "type", "default", "value",
/// "min", "max", "step", "choices", "unit", "group", "help", "of"}; [] if it has none. Types are
/// "number", "integer", "boolean", "string", "choice", "file", "folder", and those a host has a
/// picker for: "mesh", "region", "boundary", "curve", "head"; their values are texts.
LISSOM_API lissom_status lissom_script_parameters(lissom_context* context, lissom_script script,
                                                  lissom_bytes* json);
/// Sets a parameter by its text, as a command line does. Errors: INVALID_ARGUMENT for an unknown
/// parameter, naming the nearest, or for a value that it refuses.
LISSOM_API lissom_status lissom_script_set(lissom_context* context, lissom_script script,
                                           const char* parameter, const char* value);
/// Runs the script. `arguments` is a JSON list of its arguments `...`, in the format of
/// lissom_call, or NULL. `json` receives the list of its results; it may be NULL. Errors:
/// SCRIPT_ERROR with file and line; CANCELLED; MEMORY_LIMIT; INVALID_ARGUMENT for bad JSON.
LISSOM_API lissom_status lissom_script_run(lissom_context* context, lissom_script script,
                                           const char* arguments, lissom_bytes* json);
/// Starts the run as a job, whose results are JSON.
LISSOM_API lissom_status lissom_script_begin_run(lissom_context* context, lissom_script script,
                                                 const char* arguments, lissom_job* job);

/// Calls any function of the Lua reference. `name` is "shapes.box", or "Mesh.smooth" for a method.
/// `arguments` is a JSON list of at most 250: first the object of a method, then others, then the
/// table of options, as in the reference. An object is {"object": ID} with the `id` of a handle,
/// which is the object itself and no copy. `json` receives the list of results in the same format,
/// objects with "type": "lissom.Mesh", ...: lissom.Mesh, Region, Deformer, Hairstyle and Strands
/// are handles of those kinds, all others of lissom_object. Release objects that are not needed.
/// Integers have 64 bits; a number beyond, a result that is not finite, a text that is not UTF-8, a
/// table that is a list and has names, and any other value that JSON cannot hold are refused.
/// Errors: OUT_OF_RANGE for an unknown name, with the nearest; INVALID_ARGUMENT for bad JSON or
/// arguments; INVALID_HANDLE; those of the function.
LISSOM_API lissom_status lissom_call(lissom_context* context, const char* name,
                                     const char* arguments, lissom_bytes* json);
/// Starts the call as a job, whose results are JSON.
LISSOM_API lissom_status lissom_begin_call(lissom_context* context, const char* name,
                                           const char* arguments, lissom_job* job);

// ---- Typed lists in calls: a lissom.Buffer of the Lua reference is an object that functions take
// and return, as positions of a mesh or the weights of a basis. Here it goes in and out of the
// host's memory without JSON, in the kernel's space. A buffer of a mesh is a view of its numbers.

/// Makes a list of its own of `width` numbers an element. Errors: INVALID_ARGUMENT; NOT_FINITE;
/// MEMORY_LIMIT; BUSY.
LISSOM_API lissom_status lissom_numbers_create(lissom_context* context, const lissom_input* values,
                                               int32_t width, lissom_object* numbers);
/// Return the number of elements, and of numbers in one, or -1 for another handle.
LISSOM_API int32_t lissom_numbers_size(lissom_context* context, lissom_object numbers);
LISSOM_API int32_t lissom_numbers_width(lissom_context* context, lissom_object numbers);
/// Writes all elements. A list of a mesh keeps that mesh: it is read after lissom_mesh_release too.
/// Errors: INVALID_ARGUMENT for an object that is no list; TOPOLOGY_MISMATCH for a list of a mesh
/// that has another topology by now, or of an attribute that has gone.
LISSOM_API lissom_status lissom_numbers_read(lissom_context* context, lissom_object numbers,
                                             const lissom_output* values);

#ifdef __cplusplus
}
#endif
// NOLINTEND(readability-identifier-naming, modernize-deprecated-headers)
