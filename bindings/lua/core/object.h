/// Objects of the kernel in Lua: a userdata names a cell of its Lua state, and that holds a shared
/// pointer, so that a region can keep its mesh alive whatever the collector does.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>

#include "kernel/core/memory_hold.h"

namespace lissom::lua {

/// C++ that belongs to a Lua state, by one userdata, whose finalizer deletes it. Lua frees a
/// userdata without its finalizer if that finds no memory or no stack to run, or if the state
/// is being closed: cells are on a list of their own, and go with the state at the latest.
class Cell {
  public:
    Cell() = default;
    Cell(const Cell&) = delete;
    Cell& operator=(const Cell&) = delete;
    virtual ~Cell();

    /// The cell's own bytes, on the account of the script.
    MemoryHold bytes;

  private:
    friend class CellList;
    Cell *before_ = nullptr, *after_ = nullptr;
};

/// The cells of a state.
class CellList {
  public:
    CellList() = default;
    CellList(const CellList&) = delete;
    CellList& operator=(const CellList&) = delete;
    ~CellList() { clear(); }

    void add(Cell& cell) noexcept;
    /// Deletes all cells, those added meanwhile too.
    void clear() noexcept;

  private:
    struct End : Cell {};
    End first_;
};

/// An object with the bytes of its own structs, which are on the account of its script for as long
/// as anything holds the object.
struct CountedObject {
    MemoryHold bytes;
    std::shared_ptr<void> object;
};

/// The object of a userdata; none once that was closed or collected.
class ObjectSlot {
  public:
    struct Content : Cell {
        std::shared_ptr<void> object;
        /// Takes over `bytes` along with the first object; null afterwards.
        std::shared_ptr<CountedObject> counted;
    };

    explicit operator bool() const { return get() != nullptr; }
    void* get() const { return cell_ ? cell_->object.get() : nullptr; }
    const std::shared_ptr<void>& shared() const { return cell_ ? cell_->object : kNone; }
    /// Puts an object there, unless the userdata was collected.
    ObjectSlot& operator=(std::shared_ptr<void> object) noexcept;
    void reset() {
        if (cell_) cell_->object.reset();
    }

    /// Sets the cell of a new userdata, which had none.
    void set_cell(Content* cell) { cell_ = cell; }
    /// Ends the userdata: deletes its cell, and the object if no other owns it.
    void end() { delete std::exchange(cell_, nullptr); }

  private:
    static const std::shared_ptr<void> kNone;
    Content* cell_ = nullptr;
};

/// Content of every userdata of this binding that scripts hold. Plain data.
struct Holder {
    explicit Holder(const char* name) : type_name(name) {}
    Holder(const Holder&) = delete;
    Holder& operator=(const Holder&) = delete;

    /// Mark that tells it from a foreign userdata, whichever metatable a script has set: the
    /// address of the binding's own byte.
    const void* mark = &kMark;
    /// Name of the type that `object` is of; a constant of the program.
    const char* type_name;
    ObjectSlot object;

    static const char kMark;
};

/// Bytes that an object takes before its lists: its struct, and if T has `kBytesBeside`, so many in
/// blocks of their own.
template <typename T>
constexpr std::size_t own_bytes() {
    if constexpr (requires { T::kBytesBeside; }) {
        return sizeof(T) + T::kBytesBeside;
    } else {
        return sizeof(T);
    }
}

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
    std::shared_ptr<T> share() const {
        return std::static_pointer_cast<T>(holder_->object.shared());
    }
    /// Puts an object into an empty userdata. Inside Call::attempt only.
    void set(std::shared_ptr<T> object) const { holder_->object = std::move(object); }

  private:
    Holder* holder_;
};

}  // namespace lissom::lua
