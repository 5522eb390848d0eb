#include "kernel/io/record/strand_links.h"

#include <array>
#include <string>

#include "kernel/io/stream/read_error.h"

namespace lissom {
namespace {

// The one or two neighbours of each vertex.
using LinkNeighbours = std::vector<std::array<Index, 2>>;

void add_neighbour(LinkNeighbours& neighbours, Index vertex, Index other) {
    std::array<Index, 2>& two = neighbours[at(vertex)];
    if (two[0] == kNoIndex) {
        two[0] = other;
    } else if (two[1] == kNoIndex && two[0] != other) {
        two[1] = other;
    } else {
        refuse(ErrorCode::file_syntax,
               "edges branch at vertex " + std::to_string(vertex) +
                   "; strands are lines in which a vertex has at most two neighbours",
               {ElementKind::vertex, at(vertex)});
    }
}

LinkNeighbours neighbours_of(const std::vector<StrandLink>& links, Index vertex_count) {
    LinkNeighbours neighbours(at(vertex_count), {kNoIndex, kNoIndex});
    for (const StrandLink& link : links) {
        if (link.first == link.second) {
            refuse(ErrorCode::file_syntax,
                   "an edge joins vertex " + std::to_string(link.first) + " with itself",
                   {ElementKind::vertex, at(link.first)});
        }
        add_neighbour(neighbours, link.first, link.second);
        add_neighbour(neighbours, link.second, link.first);
    }
    return neighbours;
}

void follow_links(const LinkNeighbours& neighbours, Index end, std::vector<bool>& seen,
                  StrandOrder& order) {
    Index before = kNoIndex, now = end;
    while (now != kNoIndex) {
        seen[at(now)] = true;
        order.vertices.push_back(now);
        const std::array<Index, 2>& two = neighbours[at(now)];
        const Index next = two[0] == before ? two[1] : two[0];
        before = now;
        now = next;
    }
    order.offsets.push_back(count_of(order.vertices));
}

}  // namespace

StrandOrder strands_of_links(const std::vector<StrandLink>& links, Index vertex_count) {
    const LinkNeighbours neighbours = neighbours_of(links, vertex_count);
    std::vector<bool> seen(at(vertex_count), false);
    StrandOrder order;
    for (Index v = 0; v < vertex_count; ++v) {
        const std::array<Index, 2>& two = neighbours[at(v)];
        if (two[0] == kNoIndex) ++order.unused;
        if (!seen[at(v)] && two[0] != kNoIndex && two[1] == kNoIndex) {
            follow_links(neighbours, v, seen, order);
        }
    }
    for (Index v = 0; v < vertex_count; ++v) {
        if (seen[at(v)] || neighbours[at(v)][0] == kNoIndex) continue;
        refuse(ErrorCode::file_syntax,
               "the line through vertex " + std::to_string(v) + " is closed; a strand has two ends",
               {ElementKind::vertex, at(v)});
    }
    return order;
}

}  // namespace lissom
