#include "viewer/lua/viewer_library.h"

namespace lissom::lua {

Library viewer_library() {
    Library library;
    library.name = "viewer";
    library.summary = "Pictures.";
    library.functions = render_functions();
    return library;
}

}  // namespace lissom::lua
