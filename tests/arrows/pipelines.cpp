#include "tests/arrows/pipelines.h"

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <vector>

#include "tests/arrows/include_rules.h"

namespace lissom::test {
namespace {

using Lines = std::vector<std::string>;

// Pixels.
constexpr int kWidth = 1350, kEdge = 20, kGap = 22, kLine = 16;
constexpr int kBoxWidth = 138, kBoxHeight = 92, kTitle = 30, kLaneHeight = kTitle + kBoxHeight + 14;
constexpr int kLaneLeft = 46;
// Letters of a caption that a box has room for in a line.
constexpr std::size_t kLetters = 20;

struct Lane {
    std::string_view module, title, color;
};

// From the top; those that others stand on first.
constexpr Lane kLanes[] = {{"kernel/deform", "deformation", "#3b6fb5"},
                           {"kernel/merge", "merging", "#8a5a2b"},
                           {"kernel/hair", "hair", "#7a4a9a"}};
constexpr std::string_view kBase[] = {"kernel/core", "kernel/solve", "kernel/mesh"};

std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text) {
        if (c == '&') {
            result += "&amp;";
        } else if (c == '<') {
            result += "&lt;";
        } else {
            result += c;
        }
    }
    return result;
}

// A cell of a table without the marks of Markdown: links become their text; what stands in
// brackets, names of files, is left out.
std::string plain(std::string_view cell) {
    std::string result;
    for (std::size_t i = 0; i < cell.size(); ++i) {
        const bool link = cell.substr(i).starts_with("](");
        if (link || cell.substr(i).starts_with(" (")) {
            i = cell.find(')', i);
        } else if (cell[i] != '[' && cell[i] != '`') {
            result += cell[i];
        }
        if (i == std::string_view::npos) break;
    }
    return result;
}

// The description of a room in the table of rooms; empty if it has no row.
std::string caption_of(std::string_view rooms, std::string_view room) {
    const std::string row = "| [" + std::string(room) + "](";
    std::size_t at = rooms.find(row);
    // Other tables have links to rooms inside their rows.
    while (at != std::string_view::npos && at > 0 && rooms[at - 1] != '\n') {
        at = rooms.find(row, at + 1);
    }
    if (at == std::string_view::npos) return "";
    const std::size_t begin = rooms.find("| ", at + row.size()) + 2;
    return plain(rooms.substr(begin, rooms.find(" |", begin) - begin));
}

Lines wrapped(const std::string& text, std::size_t letters) {
    Lines lines;
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        if (!lines.empty() && lines.back().size() + 1 + word.size() <= letters) {
            lines.back() += " " + word;
        } else {
            lines.push_back(word);
        }
    }
    return lines;
}

std::string last_part(std::string_view path) {
    return std::string(path.substr(path.rfind('/') + 1));
}

// Shapes of an SVG file, one a line.
class Drawing {
  public:
    void box(int x, int y, int width, int height, std::string_view fill, std::string_view stroke) {
        out_ << "<rect x=\"" << x << "\" y=\"" << y << "\" width=\"" << width << "\" height=\""
             << height << "\" rx=\"6\" fill=\"" << fill << "\" stroke=\"" << stroke << "\"/>\n";
    }
    void text(int x, int y, std::string_view kind, std::string_view text) {
        out_ << "<text x=\"" << x << "\" y=\"" << y << "\" class=\"" << kind << "\">"
             << escaped(text) << "</text>\n";
    }
    // Through points x, y, x, y, ...
    void arrow(std::initializer_list<int> points) {
        out_ << "<polyline class=\"arrow\" points=\"";
        for (const int p : points) out_ << p << " ";
        out_ << "\"/>\n";
    }
    std::string finish(int height) const {
        std::ostringstream file;
        file << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << kWidth << " "
             << height << "\" width=\"" << kWidth << "\" height=\"" << height << "\">\n"
             << "<style>text { font-family: Helvetica, Arial, sans-serif; fill: #222; }\n"
             << ".title { font-size: 16px; font-weight: bold; } .room { font-size: 14px; "
                "font-weight: bold; }\n"
             << ".caption { font-size: 12px; fill: #444; } .note { font-size: 13px; fill: #444; }\n"
             << ".arrow { fill: none; stroke: #444; stroke-width: 1.6; marker-end: url(#head); }"
                "</style>\n"
             << "<defs><marker id=\"head\" markerWidth=\"9\" markerHeight=\"8\" refX=\"8\" "
                "refY=\"4\" orient=\"auto\"><path d=\"M0,0 L9,4 L0,8 z\" fill=\"#444\"/></marker>"
                "</defs>\n"
             << "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
             << out_.str() << "</svg>\n";
        return file.str();
    }

  private:
    std::ostringstream out_;
};

void draw_room(Drawing& drawing, int x, int y, std::string_view name, std::string_view caption,
               std::string_view color) {
    drawing.box(x, y, kBoxWidth, kBoxHeight, "#fff", color);
    drawing.text(x + 8, y + 20, "room", name);
    int base = y + 38;
    for (const std::string& line : wrapped(std::string(caption), kLetters)) {
        drawing.text(x + 8, base, "caption", line);
        base += kLine;
    }
}

// Rooms from left to right, each with an arrow to the next.
void draw_lane(Drawing& drawing, const Lane& lane, int y, std::string_view rooms) {
    drawing.box(kLaneLeft, y, kWidth - kEdge - kLaneLeft, kLaneHeight, "#f6f6f4", lane.color);
    drawing.text(kLaneLeft + 12, y + 21, "title",
                 std::string(lane.module) + ": " + std::string(lane.title));
    int x = kLaneLeft + 12;
    bool first = true;
    for (const std::string_view room : rooms_of(lane.module)) {
        const std::string caption = caption_of(rooms, room);
        const bool within = room.find('/', lane.module.size() + 1) != std::string_view::npos;
        if (caption.empty() || within) continue;  // a single file; a room of a room
        if (!first) drawing.arrow({x - kGap, y + kTitle + 14, x - 1, y + kTitle + 14});
        first = false;
        const std::string name = room == lane.module ? last_part(room) + "/" : last_part(room);
        draw_room(drawing, x, y + kTitle, name, caption, lane.color);
        x += kBoxWidth + kGap;
    }
}

// The modules that all stand on, with the names of their rooms.
int draw_base(Drawing& drawing, std::string_view rooms) {
    const int width = (kWidth - 2 * kEdge - 2 * kGap) / 3, y = kEdge;
    int x = kEdge;
    for (const std::string_view module : kBase) {
        drawing.box(x, y, width, kBoxHeight, "#f6f6f4", "#777");
        drawing.text(x + 12, y + 21, "title", module);
        std::string names;
        for (const std::string_view room : rooms_of(module)) {
            if (room != module) names += (names.empty() ? "" : ", ") + last_part(room);
        }
        int base = y + 42;
        for (const std::string& line : wrapped(caption_of(rooms, module), 56)) {
            drawing.text(x + 12, base, "caption", line);
            base += kLine;
        }
        if (!names.empty()) drawing.text(x + 12, base + 4, "caption", "rooms: " + names);
        if (x > kEdge) drawing.arrow({x - kGap, y + 46, x - 1, y + 46});
        x += width + kGap;
    }
    return y + kBoxHeight;
}

bool knows(std::string_view module, std::string_view other) {
    const auto known = known_modules(module);
    return std::find(known.begin(), known.end(), other) != known.end();
}

}  // namespace

std::string pipelines_picture(std::string_view rooms) {
    Drawing drawing;
    const int below = draw_base(drawing, rooms);
    int y = below + 2 * kGap;
    std::string_view above;
    for (const Lane& lane : kLanes) {
        // The nearest module that it may include: the lane above, or the last that all stand on.
        if (!above.empty() && knows(lane.module, above)) {
            drawing.arrow({kWidth / 2, y - kGap, kWidth / 2, y - 1});
        } else if (knows(lane.module, kBase[2])) {
            const int middle = y + kLaneHeight / 2;
            drawing.arrow({kWidth - 200, below, kWidth - 200, below + kGap, kEdge + 6, below + kGap,
                           kEdge + 6, middle, kLaneLeft - 1, middle});
        }
        draw_lane(drawing, lane, y, rooms);
        above = lane.module;
        y += kLaneHeight + kGap;
    }
    drawing.text(kLaneLeft, y + 4, "note",
                 "What stands at the start of an arrow knows nothing of what stands at its end. A "
                 "room may include those to its left and all that leads to its module.");
    return drawing.finish(y + kEdge);
}

}  // namespace lissom::test
