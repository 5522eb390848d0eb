/// Objects of the kernel in Lua: a userdata holds a shared pointer, so that a region can keep its
/// mesh alive whatever the collector does.
#pragma once

#include <memory>
#include <utility>

namespace lissom::lua {

/// Content of every userdata of this binding that scripts hold.
struct Holder {
    explicit Holder(const char* name) : type_name(name) {}

    /// Mark that tells it from a foreign userdata, whichever metatable a script has set: the
    /// address of the binding's own byte.
    const void* mark = &kMark;
    /// Name of the type that `object` is of; a constant of the program.
    const char* type_name;
    /// Null once it was closed.
    std::shared_ptr<void> object;

    static const char kMark;
};

/// The object in a userdata on the stack of the present call. Plain data: it may be left by
/// longjmp. T has `static constexpr const char* kTypeName`, the name of its Type.
template <typename T>
class Ref {
  public:
    explicit Ref(Holder* holder) : holder_(holder) {}

    T* get() const { return static_cast<T*>(holder_->object.get()); }
    T* operator->() const { return get(); }
    T& operator*() const { return *get(); }

    /// Another owner of the object. Inside Call::attempt only.
    std::shared_ptr<T> share() const { return std::static_pointer_cast<T>(holder_->object); }
    /// Puts an object into an empty userdata. Inside Call::attempt only.
    void set(std::shared_ptr<T> object) const { holder_->object = std::move(object); }

  private:
    Holder* holder_;
};

}  // namespace lissom::lua
