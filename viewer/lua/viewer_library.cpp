#include "viewer/lua/viewer_library.h"

namespace lissom::lua {

Library viewer_library() {
    Library library;
    library.name = "viewer";
    library.summary = "Cameras and pictures.";
    library.functions = camera_functions();
    for (Function& function : render_functions()) library.functions.push_back(std::move(function));
    library.types.push_back(camera_type());
    return library;
}

}  // namespace lissom::lua
