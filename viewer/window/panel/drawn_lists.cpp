#include "viewer/window/panel/drawn_lists.h"

#include <imgui.h>

#include <algorithm>
#include <cfloat>
#include <cstring>

namespace lissom::window {
namespace {

// Hash of 64 bits, good enough that two frames of a panel are never taken for one.
class Hash {
  public:
    void add(const void* data, std::size_t size) {
        const auto* bytes = static_cast<const unsigned char*>(data);
        for (; size >= sizeof(std::uint64_t); size -= sizeof(std::uint64_t)) {
            std::uint64_t word = 0;
            std::memcpy(&word, bytes, sizeof word);
            mix(word);
            bytes += sizeof word;
        }
        std::uint64_t rest = size;
        std::memcpy(&rest, bytes, size);
        mix(rest + (std::uint64_t{size} << 56));
    }
    std::uint64_t value() const { return value_; }

  private:
    void mix(std::uint64_t word) {
        value_ = (value_ ^ word) * 0x9e3779b97f4a7c15u;
        value_ ^= value_ >> 29;
    }
    std::uint64_t value_ = 1;
};

template <typename Entry>
void add_all(Hash& hash, const ImVector<Entry>& entries) {
    hash.add(entries.Data, static_cast<std::size_t>(entries.Size) * sizeof(Entry));
}

void add(Hash& hash, const ImDrawList& list) {
    for (const ImDrawCmd& command : list.CmdBuffer) {
        hash.add(&command.ClipRect, sizeof command.ClipRect);
        hash.add(&command.ElemCount, sizeof command.ElemCount);
    }
    add_all(hash, list.VtxBuffer);
    add_all(hash, list.IdxBuffer);
}

// Extent of a drawn list.
struct Reach {
    bool inside = false, outside = false;
};

// The rectangle that a command draws in: backgrounds of windows are clipped by nothing.
ImVec4 extent_of(const ImDrawList& list, const ImDrawCmd& command) {
    ImVec4 extent(FLT_MAX, FLT_MAX, -FLT_MAX, -FLT_MAX);
    for (unsigned i = 0; i < command.ElemCount; ++i) {
        const auto index = static_cast<int>(command.IdxOffset + i);
        const int vertex = static_cast<int>(command.VtxOffset) + list.IdxBuffer[index];
        const ImVec2& at = list.VtxBuffer[vertex].pos;
        extent = ImVec4(std::min(extent.x, at.x), std::min(extent.y, at.y),
                        std::max(extent.z, at.x), std::max(extent.w, at.y));
    }
    const ImVec4& clip = command.ClipRect;
    return ImVec4(std::max(extent.x, clip.x), std::max(extent.y, clip.y),
                  std::min(extent.z, clip.z), std::min(extent.w, clip.w));
}

Reach reach_of(const ImDrawList& list, const ImDrawData& data, const Canvas& canvas) {
    const auto left = static_cast<float>(canvas.x), top = static_cast<float>(canvas.y);
    const auto right = static_cast<float>(canvas.x + canvas.width),
               bottom = static_cast<float>(canvas.y + canvas.height);
    Reach reach;
    for (const ImDrawCmd& command : list.CmdBuffer) {
        const ImVec4 extent = extent_of(list, command);
        const float x = std::max(extent.x, 0.0f), y = std::max(extent.y, 0.0f);
        const float end_x = std::min(extent.z, data.DisplaySize.x);
        const float end_y = std::min(extent.w, data.DisplaySize.y);
        if (x >= end_x || y >= end_y) continue;
        if (x < right && end_x > left && y < bottom && end_y > top) reach.inside = true;
        if (x < left || end_x > right || y < top || end_y > bottom) reach.outside = true;
    }
    return reach;
}

}  // namespace

void DrawnLists::see(const ImDrawData& data, const Canvas& canvas) {
    Hash beside, over;
    bool reaches = false;
    over_.clear();
    for (int i = 0; i < data.CmdListsCount; ++i) {
        ImDrawList* const list = data.CmdLists[i];
        const Reach reach = reach_of(*list, data, canvas);
        if (reach.outside) add(beside, *list);
        if (!reach.inside) continue;
        add(over, *list);
        over_.push_back(list);
        reaches = reaches || reach.outside;
    }
    over_differs_ = over.value() != over_hash_;
    beside_differs_ = beside.value() != beside_hash_ || reaches;
    over_hash_ = over.value();
    beside_hash_ = beside.value();
}

}  // namespace lissom::window
