/// Trees of JSON that take no memory when they are destroyed; private to kernel/io and
/// kernel/scene.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace lissom {

/// std::allocator under another name: trees made by it are a type of this project.
template <typename T>
struct JsonAllocator : std::allocator<T> {
    JsonAllocator() = default;
    template <typename Other>
    JsonAllocator(const JsonAllocator<Other>&) noexcept {}
    // The names are those that the standard library asks for.
    template <typename Other>
    struct rebind {                          // NOLINT(readability-identifier-naming)
        using other = JsonAllocator<Other>;  // NOLINT(readability-identifier-naming)
    };
};

/// JSON with members sorted by name.
using SortedJson = nlohmann::basic_json<std::map, std::vector, std::string, bool, std::int64_t,
                                        std::uint64_t, double, JsonAllocator>;
/// JSON with members in the order in which they were added.
using OrderedJson = nlohmann::basic_json<nlohmann::ordered_map, std::vector, std::string, bool,
                                         std::int64_t, std::uint64_t, double, JsonAllocator>;

/// The list of what remains of a tree that nlohmann's destructor takes apart. That destructor may
/// not throw, and std::vector ends the process if there is no memory. Branches are therefore
/// destroyed as soon as they come, but for those deeper than any reader accepts.
template <typename Json>
class JsonRemains {
  public:
    using value_type = Json;

    void reserve(std::size_t) {}
    void push_back(Json&& branch) {
        if (depth() == kDeepest) {
            if (!deeper_) deeper_ = std::make_unique<Deeper>();
            deeper_->push_back(std::move(branch));
            return;
        }
        ++depth();
        { const Json destroyed(std::move(branch)); }
        --depth();
    }
    bool empty() const { return !deeper_ || deeper_->empty(); }
    Json& back() { return deeper_->back(); }
    void pop_back() { deeper_->pop_back(); }

  private:
    using Deeper = std::deque<Json, JsonAllocator<Json>>;
    static constexpr int kDeepest = 1000;

    static int& depth() {
        thread_local int own = 0;
        return own;
    }

    std::unique_ptr<Deeper> deeper_;
};

}  // namespace lissom

// The type that nlohmann's destructor uses.
template <>
class std::vector<lissom::SortedJson> : public lissom::JsonRemains<lissom::SortedJson> {};
template <>
class std::vector<lissom::OrderedJson> : public lissom::JsonRemains<lissom::OrderedJson> {};
