/// The strands of a script.
#pragma once

#include <memory>
#include <utility>

#include "bindings/lua/core/call.h"
#include "kernel/hair/strands/strands.h"

namespace lissom::lua {

struct StrandsObject {
    static constexpr const char* kTypeName = "lissom.Strands";

    explicit StrandsObject(Strands content) : strands(std::move(content)) {}

    Strands strands;
    std::size_t charged_bytes = 0;

    std::size_t memory_bytes() const { return strands.memory_bytes(); }
};

/// Returns the new strands that work() makes.
template <typename Work>
int new_strands(Call& call, const Work& work) {
    const auto result = call.create<StrandsObject>();
    if (!call.attempt([&] { result.set(std::make_shared<StrandsObject>(work())); }))
        return call.fail();
    call.charge(result);
    return 1;
}

}  // namespace lissom::lua
