#include "kernel/scene/strands_item.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "kernel/hair/strands/strand_measures.h"
#include "kernel/scene/strand_frame.h"

namespace lissom {

namespace {

// To the bit: a root without texture coordinates has NaN, which equals nothing.
template <typename Value>
bool equal(const std::vector<Value>& a, const std::vector<Value>& b) {
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Value)) == 0);
}

template <typename Value>
bool equal(const StrandValues<Value>& a, const StrandValues<Value>& b) {
    return equal(std::vector{a.common}, std::vector{b.common}) && a.domain == b.domain &&
           equal(a.values, b.values);
}

bool equal(const StrandRoots& a, const StrandRoots& b) {
    return a.faces == b.faces && equal(a.barycentrics, b.barycentrics) &&
           a.triangles == b.triangles && equal(a.uvs, b.uvs);
}

bool equal_colors(const std::optional<StrandValues<Eigen::Vector3f>>& a,
                  const StrandValues<Eigen::Vector3f>* b) {
    if (!a || !b) return !a && !b;
    return equal(*a, *b);
}

bool equal(const StrandFrame& frame, const Strands& strands) {
    return std::equal(frame.offsets.begin(), frame.offsets.end(), strands.offsets().begin(),
                      strands.offsets().end()) &&
           equal(frame.widths, strands.widths()) &&
           equal(frame.widths.profile, strands.widths().profile) &&
           equal(frame.roots, strands.roots()) && frame.groups == strands.groups() &&
           frame.group_names == strands.group_names() && frame.ids == strands.ids() &&
           frame.guides == strands.guides() && equal_colors(frame.colors, strands.colors()) &&
           equal(frame.transparency, strands.transparency()) && frame.comment == strands.comment();
}

// Texts, and the profile of widths.
std::size_t bytes_beside(const Strands& strands) {
    std::size_t bytes = strands.comment().size() + strands.widths().profile.size() * sizeof(float);
    for (const std::string& name : strands.group_names()) {
        bytes += sizeof(std::string) + name.size();
    }
    return bytes;
}

}  // namespace

StrandFrame frame_of(const Strands& strands) {
    StrandFrame frame{{strands.offsets().begin(), strands.offsets().end()},
                      strands.widths(),
                      strands.roots(),
                      strands.groups(),
                      strands.group_names(),
                      strands.ids(),
                      strands.guides(),
                      std::nullopt,
                      strands.transparency(),
                      strands.comment()};
    if (strands.colors()) frame.colors = *strands.colors();
    return frame;
}

void set_frame(Strands& strands, StrandFrame frame) {
    strands.set_widths(std::move(frame.widths));
    strands.set_roots(std::move(frame.roots));
    strands.set_groups(std::move(frame.groups), std::move(frame.group_names));
    strands.set_ids(std::move(frame.ids));
    strands.set_guides(std::move(frame.guides));
    if (frame.colors) strands.set_colors(*std::move(frame.colors));
    strands.set_transparency(std::move(frame.transparency));
    strands.set_comment(std::move(frame.comment));
}

StrandsContent::StrandsContent(const Strands& strands, const StrandsContent* last,
                               ContentStore& store)
    : points_(std::as_bytes(strands.points()), last ? last->points_ : SharedBlocks(), store) {
    count_own(store, sizeof *this + sizeof(StrandFrame) + points_.list_bytes());
    if (last && equal(*last->frame_->value, strands)) {
        frame_ = last->frame_;
        return;
    }
    const std::size_t bytes = strands.memory_bytes() - strands.points().size_bytes();
    frame_ = store.keep(std::make_shared<const StrandFrame>(frame_of(strands)),
                        bytes + bytes_beside(strands));
}

Strands StrandsContent::strands() const {
    const StrandFrame& frame = *frame_->value;
    Strands strands(std::vector<float>(points_.size() / sizeof(float)), frame.offsets);
    points_.copy_to(std::as_writable_bytes(strands.edit_points()));
    set_frame(strands, frame);
    return strands;
}

bool StrandsContent::write_points(Strands& strands, const StrandsContent& present) const {
    if (frame_ != present.frame_) return false;
    points_.copy_changes_to(std::as_writable_bytes(strands.edit_points()), present.points_);
    return true;
}

void StrandsContent::list_kept(std::vector<const KeptBytes*>& list) const {
    points_.list_kept(list);
    list.push_back(frame_.get());
}

std::uint64_t StrandsContent::compute_hash() const {
    return lissom::hash(strands());
}

std::shared_ptr<const ItemContent> StrandsItem::capture(
    const std::shared_ptr<const ItemContent>& last, ContentStore& store) const {
    const auto* before = dynamic_cast<const StrandsContent*>(last.get());
    auto content = std::make_shared<const StrandsContent>(*strands_, before, store);
    if (before && *content == *before) return last;
    return content;
}

void StrandsItem::restore(const ItemContent& content, const ItemContent* present) {
    const auto& wanted = dynamic_cast<const StrandsContent&>(content);
    const auto* now = dynamic_cast<const StrandsContent*>(present);
    if (!now || !wanted.write_points(*strands_, *now)) *strands_ = wanted.strands();
}

}  // namespace lissom
