#include "bindings/cli/batch/spare_folders.h"

#include <string>
#include <system_error>
#include <utility>

#include "bindings/cli/process/process_number.h"

namespace lissom::cli {

namespace fs = std::filesystem;

SpareFolders::~SpareFolders() {
    std::error_code ignored;
    for (const fs::path& spare : spare_) fs::remove(spare, ignored);
}

bool SpareFolders::give(const fs::path& place) {
    std::error_code error;
    while (!spare_.empty()) {
        const fs::path spare = std::move(spare_.back());
        spare_.pop_back();
        // A batch that came later may have removed it.
        fs::rename(spare, place, error);
        if (!error) return true;
    }
    return false;
}

bool SpareFolders::keep(const fs::path& empty) {
    std::error_code error;
    if (!fs::is_empty(empty, error) || error) return false;
    const fs::path spare = folder_ / (std::string(kName) + std::to_string(process_number()) + "." +
                                      std::to_string(spare_.size()));
    fs::rename(empty, spare, error);
    if (error) return false;
    spare_.push_back(spare);
    return true;
}

}  // namespace lissom::cli
