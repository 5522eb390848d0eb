// lissom new tool NAME
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "bindings/cli/verbs.h"

namespace lissom::cli {
namespace {

namespace fs = std::filesystem;

// A tool that works, with NAME in the place of its name.
constexpr std::string_view kToolSkeleton = R"(--- Describe the tool here, in a sentence.
--
-- How a hand uses it. Try it: lissom view MESH --tool NAME.lua; a change of this file is taken up at once.
local lissom = require "lissom"

return lissom.tool{
    name = "NAME",
    help = "Drag over the surface: it bulges.",
    params = {
        radius = { type = "number", default = 30, min = 2, max = 300, unit = "pixels" },
        height = { type = "number", default = 0.01, min = -0.1, max = 0.1, unit = "mesh sizes" },
    },

    -- From press to release is one step of the scene: undo takes all of it back. So does an error.
    press = function(self, ev) self:bulge(ev) end,
    drag = function(self, ev) self:bulge(ev) end,
    -- The cursor moves without a button.
    move = function(self, ev) self.at = { ev.x, ev.y } end,
    -- ev.key is "enter", "a", "7", ...
    key = function(self, ev) if ev.key == "i" then self.params.height = -self.params.height end end,
    -- Over the picture; the scene may not change here.
    draw = function(self, view)
        if self.at then view:circle{ at = self.at, radius = self.params.radius } end
    end,

    -- The tool's own: no name that the host knows.
    bulge = function(self, ev)
        self.at = { ev.x, ev.y }
        for _, found in ipairs(ev:select{ brush = { stroke = { self.at }, radius = self.params.radius } }) do
            local step, normals = self.params.height * found.mesh:size(), {}
            for _, v in ipairs(found.region:vertices()) do normals[v] = { found.mesh:normal(v) } end
            for v, n in pairs(normals) do
                local x, y, z = found.mesh:position(v)
                found.mesh:set_position(v, x + step * n[1], y + step * n[2], z + step * n[3])
            end
        end
    end,
}
)";

bool is_tool_name(const std::string& name) {
    const auto is_letter = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-';
    };
    return !name.empty() && std::all_of(name.begin(), name.end(), is_letter);
}

std::string skeleton_of(const std::string& name) {
    std::string text(kToolSkeleton);
    for (std::size_t at = text.find("NAME"); at != std::string::npos; at = text.find("NAME", at)) {
        text.replace(at, 4, name);
        at += name.size();
    }
    return text;
}

}  // namespace

int make_new(Program& program, const std::vector<std::string>& words) {
    CLI::App app("Writes the beginning of something that runs as it is.", "lissom new");
    std::string what, name;
    app.add_option("WHAT", what, "tool")->required();
    app.add_option("NAME", name, "Its name, which is that of the file, or a path")->required();
    int status = kSuccess;
    if (!program.parse(app, words, status)) return status;
    if (what != "tool") {
        return program.fail("lissom new: there is nothing called '" + what + "'; there is: tool",
                            kUsage);
    }
    fs::path path(name);
    if (path.extension() != ".lua") path += ".lua";
    if (!is_tool_name(path.stem().string())) {
        return program.fail("lissom new: a tool's name has letters, digits, - and _", kUsage);
    }
    std::error_code error;
    if (fs::exists(path, error)) {
        return program.fail("lissom new: " + path.string() + " exists already", kFailure);
    }
    std::ofstream file(path, std::ios::binary);
    if (!(file << skeleton_of(path.stem().string()) && file.flush())) {
        return program.fail("lissom new: " + path.string() + " cannot be written", kFailure);
    }
    std::cout << "wrote " << path.string() << "; try: lissom view MESH --tool " << path.string()
              << std::endl;
    return kSuccess;
}

}  // namespace lissom::cli
