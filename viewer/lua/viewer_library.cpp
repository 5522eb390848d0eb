#include "viewer/lua/viewer_library.h"

#include <utility>

namespace lissom::lua {

Library viewer_library() {
    Library library;
    library.name = "viewer";
    library.summary = "Pictures.";
    library.functions = render_functions();
    for (Function& function : bake_functions()) library.functions.push_back(std::move(function));
    return library;
}

}  // namespace lissom::lua
