/// The strands of a script.
#pragma once

#include <memory>
#include <utility>

#include "bindings/lua/core/call.h"
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

    std::size_t memory_bytes() const { return strands.memory_bytes(); }
};

/// Returns the new strands that work() makes; they grew on the head `grown_on`.
template <typename Work>
int new_strands(Call& call, const Work& work, std::shared_ptr<const Scalp> grown_on = nullptr) {
    const auto result = call.create<StrandsObject>();
    const bool done = call.attempt([&] {
        auto made = std::make_shared<StrandsObject>(work());
        made->grown_on = std::move(grown_on);
        result.set(std::move(made));
    });
    if (!done) return call.fail();
    call.charge(result);
    return 1;
}

}  // namespace lissom::lua
