#include "bindings/lua/mesh/weld_option.h"

namespace lissom::lua {

Parameter weld_option() {
    return either(
        "weld",
        {choice("name", {"seams", "all"}, "Vertices that are joined."),
         boolean("off", "false: no vertices are joined.")},
        "Vertices at the same place that become one. \"seams\": those that join open edges "
        "at the same place and of opposite direction, so that surfaces that only touch, as "
        "closed lips do, stay apart; \"all\": all of them; false: none.");
}

Weld given_weld(const Call& call) {
    if (call.kind("weld") == Kind::choice)
        return call.integer("weld") == 0 ? Weld::seams : Weld::all;
    if (call.boolean("weld")) call.reject("weld", "give \"seams\", \"all\" or false");
    return Weld::none;
}

}  // namespace lissom::lua
