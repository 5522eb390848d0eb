/// Types of scripts for hair in engines: guide sets, cards and checks.
#pragma once

#include <vector>

#include "bindings/lua/core/registry.h"

namespace lissom::lua {

Type guide_set_type();
std::vector<Record> guide_set_records();

Type cards_type();
std::vector<Record> cards_records();

std::vector<Record> strand_check_records();

std::vector<Record> strand_level_records();

Type strand_follower_type();

Type hair_dynamics_type();
std::vector<Record> hair_dynamics_records();

}  // namespace lissom::lua
