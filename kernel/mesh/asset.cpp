#include "kernel/mesh/asset.h"

namespace lissom {

// Here, so that one object file holds the class's virtual table.
Asset::~Asset() = default;

}  // namespace lissom
