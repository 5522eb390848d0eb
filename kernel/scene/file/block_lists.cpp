#include "kernel/scene/file/block_lists.h"

#include <algorithm>

#include "kernel/core/error.h"
#include "kernel/scene/shared_blocks.h"

namespace lissom {
namespace {

std::string block_name(std::size_t number) {
    return "blocks/" + std::to_string(number);
}

}  // namespace

std::size_t BlockSink::number_of(std::string_view block) {
    if (const auto known = numbers_.find(block); known != numbers_.end()) return known->second;
    const std::size_t number = blocks_.size();
    parts_.add(block_name(number), block);
    numbers_.emplace(blocks_.emplace_back(block), number);
    return number;
}

SceneJson BlockSink::put(const ListPlace&, std::string_view bytes, ListForm) {
    SceneJson numbers = SceneJson::array();
    for (; !bytes.empty(); bytes.remove_prefix(std::min(bytes.size(), SharedBlocks::kBlockBytes))) {
        numbers.push_back(number_of(bytes.substr(0, SharedBlocks::kBlockBytes)));
    }
    return numbers;
}

std::string_view BlockSource::get(const std::string& path, const SceneJson* entry, ListForm) {
    const auto refuse = [&] {
        throw Error(ErrorCode::file_syntax,
                    "the history's '" + path + "' must be a list of blocks");
    };
    if (!entry || !entry->is_array()) refuse();
    bytes_.clear();
    for (const SceneJson& number : *entry) {
        if (!number.is_number_unsigned()) refuse();
        bytes_ += parts_.find(block_name(number.get<std::size_t>()));
    }
    return bytes_;
}

}  // namespace lissom
