/// The strands of a script.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <utility>

#include "bindings/lua/core/call.h"
#include "kernel/core/memory_hold.h"
#include "kernel/hair/scalp/scalp.h"
#include "kernel/hair/strands/strands.h"

namespace lissom::lua {

struct StrandsObject {
    static constexpr const char* kTypeName = "lissom.Strands";

    explicit StrandsObject(Strands content) : strands(std::move(content)) {}

    Strands strands;
    /// The head that they grew on with the shape it had, or null.
    std::shared_ptr<const Scalp> grown_on = nullptr;
    std::size_t charged_bytes = 0;
    MemoryHold held;

    std::size_t memory_bytes() const { return strands.memory_bytes() + held_bytes(); }
    /// Bytes of what the strands' own account has not: texts, and the profile of widths.
    std::size_t held_bytes() const {
        std::size_t bytes = strands.comment().size() + strands.widths().profile.size() * 4;
        for (const std::string& name : strands.group_names()) bytes += sizeof name + name.size();
        return bytes;
    }
};

/// Returns the new strands that work() makes; they grew on the head `grown_on`, which somebody else
/// holds: an error jumps over the destructor of an argument by value.
template <typename Work>
int new_strands(Call& call, const Work& work,
                const std::shared_ptr<const Scalp>& grown_on = nullptr) {
    const auto result = call.create<StrandsObject>();
    const bool done = call.attempt([&] {
        auto made = std::make_shared<StrandsObject>(work());
        made->grown_on = grown_on;
        result.set(std::move(made));
    });
    if (!done) return call.fail();
    call.charge(result);
    return 1;
}

}  // namespace lissom::lua
