/// lissom.hpp: lissom.h with destructors and exceptions, for C++17 and later. Header-only: it needs
/// nothing of the library but its C functions, so that compilers and standard libraries may differ.
///
///     lissom::api::Context context;
///     lissom::api::Mesh mesh = context.load_mesh("arm.obj");
///     lissom::api::Deformer edit(mesh, mesh.all());
///     edit.add_handle(mesh.region("shoulder"));
///     const int hand = edit.add_handle(mesh.region("hand"));
///     edit.set_transform(hand, transform);
///     edit.solve();
///     edit.apply(mesh);
///
/// Every object belongs to a context, which must live longer. Objects move and do not copy. A
/// function that fails throws an Error; lissom.h documents each function and its errors. Call its
/// further functions with `get()` and `handle()` of the objects.
#pragma once

#include <cstdint>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "lissom.h"

namespace lissom::api {

/// Error of a call, copied from lissom_last_error.
class Error : public std::exception {
  public:
    explicit Error(const lissom_error& error)
        : status_(error.status),
          code_(error.code),
          message_(error.message),
          element_(error.element),
          ids_(error.ids, error.ids + error.id_count) {}

    const char* what() const noexcept override { return message_.c_str(); }
    lissom_status status() const { return status_; }
    const std::string& code() const { return code_; }
    /// Returns the ids of the elements concerned, at most a hundred, and their kind.
    const std::vector<std::int32_t>& ids() const { return ids_; }
    lissom_element element() const { return element_; }

  private:
    lissom_status status_;
    std::string code_, message_;
    lissom_element element_;
    std::vector<std::int32_t> ids_;
};

/// Throws the error of a call.
inline void check(lissom_context* context, lissom_status status) {
    if (status != LISSOM_OK) throw Error(*lissom_last_error(context));
}

/// Lists in the memory of the host: lissom_input and lissom_output.
inline lissom_input input(const float* data, std::size_t count, std::size_t stride = 0) {
    return {data, count, stride, LISSOM_FLOAT32};
}
inline lissom_input input(const double* data, std::size_t count, std::size_t stride = 0) {
    return {data, count, stride, LISSOM_FLOAT64};
}
inline lissom_input input(const std::uint32_t* data, std::size_t count, std::size_t stride = 0) {
    return {data, count, stride, LISSOM_UINT32};
}
inline lissom_output output(float* data, std::size_t count, std::size_t stride = 0) {
    return {data, count, stride, LISSOM_FLOAT32};
}
inline lissom_output output(double* data, std::size_t count, std::size_t stride = 0) {
    return {data, count, stride, LISSOM_FLOAT64};
}
inline lissom_output output(std::uint32_t* data, std::size_t count, std::size_t stride = 0) {
    return {data, count, stride, LISSOM_UINT32};
}

/// A handle that is released when it goes out of scope.
template <typename Handle, lissom_status (*Release)(lissom_context*, Handle)>
class Object {
  public:
    Object() = default;
    Object(lissom_context* context, Handle handle) : context_(context), handle_(handle) {}
    Object(Object&& other) noexcept
        : context_(other.context_), handle_(std::exchange(other.handle_, Handle{0})) {}
    Object& operator=(Object&& other) noexcept {
        std::swap(context_, other.context_);
        std::swap(handle_, other.handle_);
        return *this;
    }
    Object(const Object&) = delete;
    Object& operator=(const Object&) = delete;
    ~Object() {
        if (handle_.id != 0) Release(context_, handle_);
    }

    Handle handle() const { return handle_; }
    /// Returns the handle, which is then the caller's to release.
    Handle take() { return std::exchange(handle_, Handle{0}); }
    lissom_context* get() const { return context_; }
    explicit operator bool() const { return handle_.id != 0; }

  protected:
    void check(lissom_status status) const { api::check(context_, status); }

    lissom_context* context_ = nullptr;
    Handle handle_{0};
};

class Region : public Object<lissom_region, lissom_region_release> {
  public:
    using Object::Object;

    std::int32_t size() const { return lissom_region_size(context_, handle_); }
    std::vector<std::uint32_t> vertices() const {
        std::vector<std::uint32_t> ids(static_cast<std::size_t>(size()));
        const lissom_output out = output(ids.data(), ids.size());
        check(lissom_region_read_vertices(context_, handle_, &out));
        return ids;
    }
    Region inverted() const {
        lissom_region made{};
        check(lissom_region_invert(context_, handle_, &made));
        return {context_, made};
    }
    Region grown(std::int32_t rings) const {
        lissom_region made{};
        check(lissom_region_grow(context_, handle_, rings, &made));
        return {context_, made};
    }
    Region combined(const Region& other, lissom_region_operation operation) const {
        lissom_region made{};
        check(lissom_region_combine(context_, handle_, other.handle(), operation, &made));
        return {context_, made};
    }
};

class Mesh : public Object<lissom_mesh, lissom_mesh_release> {
  public:
    using Object::Object;

    std::int32_t vertex_count() const { return lissom_mesh_vertex_count(context_, handle_); }
    std::int32_t face_count() const { return lissom_mesh_face_count(context_, handle_); }
    std::int32_t triangle_count() const { return lissom_mesh_triangle_count(context_, handle_); }
    std::int32_t boundary_count() const { return lissom_mesh_boundary_count(context_, handle_); }

    void read_positions(const lissom_output& out) const {
        check(lissom_mesh_read_positions(context_, handle_, &out));
    }
    void read_normals(const lissom_output& out) const {
        check(lissom_mesh_read_normals(context_, handle_, &out));
    }
    void read_triangles(const lissom_output& out) const {
        check(lissom_mesh_read_triangles(context_, handle_, &out));
    }
    void set_positions(const lissom_input& in) {
        check(lissom_mesh_set_positions(context_, handle_, &in));
    }
    void transform(const lissom_transform& map) {
        check(lissom_mesh_transform(context_, handle_, &map));
    }
    void save(const std::string& path, const lissom_mesh_save_options* options = nullptr) const {
        check(lissom_mesh_save(context_, handle_, path.c_str(), options));
    }
    Mesh copy() const {
        lissom_mesh made{};
        check(lissom_mesh_copy(context_, handle_, &made));
        return {context_, made};
    }
    std::uint64_t hash() const {
        std::uint64_t value = 0;
        check(lissom_mesh_hash(context_, handle_, &value));
        return value;
    }

    Region all() const {
        lissom_region made{};
        check(lissom_region_all(context_, handle_, &made));
        return {context_, made};
    }
    Region region(const std::string& name) const {
        lissom_region made{};
        check(lissom_region_named(context_, handle_, name.c_str(), &made));
        return {context_, made};
    }
    Region sphere(const double (&center)[3], double radius) const {
        lissom_region made{};
        check(lissom_region_sphere(context_, handle_, center, radius, &made));
        return {context_, made};
    }
    Region plane(const double (&point)[3], const double (&normal)[3]) const {
        lissom_region made{};
        check(lissom_region_plane(context_, handle_, point, normal, &made));
        return {context_, made};
    }
    /// Returns the part on the side of the plane that the normal points to, and the rest.
    std::pair<Mesh, Mesh> cut(const double (&point)[3], const double (&normal)[3]) const {
        lissom_mesh kept{}, rest{};
        check(lissom_cut_by_plane(context_, handle_, point, normal, nullptr, &kept, &rest));
        return {Mesh(context_, kept), Mesh(context_, rest)};
    }
};

class Deformer : public Object<lissom_deformer, lissom_deformer_release> {
  public:
    /// Deforms the whole mesh.
    explicit Deformer(const Mesh& mesh, const lissom_deformer_options* options = nullptr)
        : Object(mesh.get(), {0}) {
        check(lissom_deformer_create(context_, mesh.handle(), {0}, options, &handle_));
    }
    Deformer(const Mesh& mesh, const Region& region,
             const lissom_deformer_options* options = nullptr)
        : Object(mesh.get(), {0}) {
        check(lissom_deformer_create(context_, mesh.handle(), region.handle(), options, &handle_));
    }

    std::int32_t add_handle(const Region& vertices,
                            const lissom_handle_options* options = nullptr) {
        std::int32_t handle = -1;
        check(lissom_deformer_add_handle(context_, handle_, vertices.handle(), options, &handle));
        return handle;
    }
    void pin(const Region& vertices) {
        check(lissom_deformer_pin(context_, handle_, vertices.handle()));
    }
    void set_transform(std::int32_t handle, const lissom_transform& transform) {
        check(lissom_deformer_set_transform(context_, handle_, handle, &transform));
    }
    void prepare() { check(lissom_deformer_prepare(context_, handle_)); }
    void solve(lissom_quality quality = LISSOM_FULL) {
        check(lissom_deformer_solve(context_, handle_, quality));
    }
    std::int32_t row_count() const { return lissom_deformer_row_count(context_, handle_); }
    void read_positions(const lissom_output& out) const {
        check(lissom_deformer_read_positions(context_, handle_, &out));
    }
    void read_normals(const lissom_output& out) const {
        check(lissom_deformer_read_normals(context_, handle_, &out));
    }
    void apply(Mesh& mesh) const { check(lissom_deformer_apply(context_, handle_, mesh.handle())); }
    lissom_deform_report report(const Mesh& mesh, bool crossings = false) const {
        lissom_deform_report found = lissom_default_deform_report();
        check(lissom_deformer_report(context_, handle_, mesh.handle(), crossings, &found));
        return found;
    }
    lissom_contacts find_contacts(const Mesh& mesh) {
        lissom_contacts contacts{};
        check(lissom_deformer_find_contacts(context_, handle_, mesh.handle(), &contacts));
        return contacts;
    }
    /// Returns the share of the way that was gone.
    double solve_until_contact(const Mesh& mesh) {
        double share = 0.0;
        check(
            lissom_deformer_solve_until_contact(context_, handle_, mesh.handle(), &share, nullptr));
        return share;
    }
    /// Returns the contacts that are left.
    lissom_contacts solve_avoiding_contacts(const Mesh& mesh) {
        lissom_contacts left{};
        check(lissom_deformer_solve_avoiding_contacts(context_, handle_, mesh.handle(), nullptr,
                                                      &left));
        return left;
    }
    void reset() { check(lissom_deformer_reset(context_, handle_)); }
};

class Strands : public Object<lissom_strands, lissom_strands_release> {
  public:
    using Object::Object;

    std::int32_t size() const { return lissom_strands_size(context_, handle_); }
    std::int32_t point_count() const { return lissom_strands_point_count(context_, handle_); }
    void read_points(const lissom_output& out) const {
        check(lissom_strands_read_points(context_, handle_, &out));
    }
    void read_offsets(const lissom_output& out) const {
        check(lissom_strands_read_offsets(context_, handle_, &out));
    }
    void save(const std::string& path) const {
        check(lissom_strands_save(context_, handle_, path.c_str()));
    }
};

class Hairstyle : public Object<lissom_hairstyle, lissom_hairstyle_release> {
  public:
    explicit Hairstyle(const Mesh& head, const lissom_hairstyle_options* options = nullptr)
        : Object(head.get(), {0}) {
        check(lissom_hairstyle_create(context_, head.handle(), options, &handle_));
    }

    std::int32_t add_stream(const lissom_input& points) {
        std::int32_t curve = -1;
        check(lissom_hairstyle_add_stream(context_, handle_, &points, &curve));
        return curve;
    }
    std::int32_t add_dividing(const lissom_input& points) {
        std::int32_t curve = -1;
        check(lissom_hairstyle_add_dividing(context_, handle_, &points, &curve));
        return curve;
    }
    std::int32_t add_ponytail(const lissom_input& spine, double radius = 0.0) {
        std::int32_t curve = -1;
        check(lissom_hairstyle_add_ponytail(context_, handle_, &spine, radius, &curve));
        return curve;
    }
    void set_points(std::int32_t curve, const lissom_input& points) {
        check(lissom_curve_set_points(context_, handle_, curve, &points));
    }
    Strands grow(const lissom_grow_options* options = nullptr) {
        lissom_strands made{};
        check(lissom_hairstyle_grow(context_, handle_, options, &made));
        return {context_, made};
    }
};

/// A context; see lissom_context_create. It outlives its objects.
class Context {
  public:
    Context() : Context(lissom_default_context_options()) {}
    explicit Context(const lissom_context_options& options) {
        const lissom_status status = lissom_context_create(&options, &context_);
        if (status != LISSOM_OK) {
            throw Error({status, lissom_status_name(status), lissom_status_explanation(status),
                         LISSOM_NO_ELEMENT, 0, nullptr, 0});
        }
    }
    ~Context() { lissom_context_destroy(context_); }
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    lissom_context* get() const { return context_; }
    void cancel() { lissom_cancel(context_); }
    void clear_cancel() { lissom_clear_cancel(context_); }

    Mesh mesh(const lissom_input& positions, const lissom_input& corners,
              const lissom_input* sizes = nullptr) const {
        lissom_mesh made{};
        check(context_, lissom_mesh_create(context_, &positions, &corners, sizes, &made));
        return {context_, made};
    }
    Mesh load_mesh(const std::string& path,
                   const lissom_mesh_load_options* options = nullptr) const {
        lissom_mesh made{};
        check(context_, lissom_mesh_load(context_, path.c_str(), options, &made));
        return {context_, made};
    }
    /// Runs scripts and calls in a sandbox from now on; see lissom_sandbox_scripts.
    void sandbox_scripts(const lissom_sandbox_options& options = lissom_default_sandbox_options()) {
        check(context_, lissom_sandbox_scripts(context_, &options));
    }
    /// The JSON list of results of lissom_call.
    std::string call(const std::string& name, const std::string& arguments = "[]") const {
        lissom_bytes bytes{};
        check(context_, lissom_call(context_, name.c_str(), arguments.c_str(), &bytes));
        return {static_cast<const char*>(bytes.data), bytes.size};
    }

  private:
    lissom_context* context_ = nullptr;
};

}  // namespace lissom::api
