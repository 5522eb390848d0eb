/// Attributes between the host's space and the kernel's; private to bindings/c.
#pragma once

#include <vector>

#include "bindings/c/data.h"
#include "kernel/mesh/attributes.h"
#include "kernel/mesh/topology.h"

namespace lissom::c {

/// Returns the kernel's corner for each corner of a host whose faces run the other way.
std::vector<Index> host_corners(const Topology& topology);

/// Sorts values in the host's order of corners into the kernel's.
void reorder(Attribute& attribute, const std::vector<Index>& order);

/// Turns directions and offsets into the kernel's space.
void to_kernel_space(Attribute& attribute, const Space& space);

/// Returns the numbers of an element in the host's space.
std::vector<double> host_values(const Attribute& attribute, Index element, const Space& space);

/// Writes `count` elements; element_of(i) is the one of place i, or kNoIndex to leave it as it is.
template <typename ElementOf>
void write_attribute(const lissom_output* output, const Attribute& attribute, Index count,
                     const Space& space, const ElementOf& element_of) {
    require_room(output, at(count), at(attribute.width), "values");
    std::vector<double> values;
    write_elements(
        *output, at(count), at(attribute.width),
        [&](std::size_t, std::size_t k) { return values[k]; },
        [&](std::size_t i) {
            const Index element = element_of(i);
            if (element != kNoIndex) values = host_values(attribute, element, space);
            return element == kNoIndex;
        });
}

}  // namespace lissom::c
