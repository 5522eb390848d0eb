#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "kernel/io/off/builder.h"
#include "kernel/io/record/skipped_content.h"
#include "kernel/io/stream/ticker.h"

namespace lissom {
namespace {

// One way to understand the numbers of a file.
struct Reading {
    /// Each vertex is one line; otherwise lines mean nothing among vertices.
    bool vertices_by_line = false;
    std::size_t color_width = 0;
    /// The rest of a face's line after the indices is its colour; otherwise faces have none.
    bool face_colors = true;
    /// The number of edges stands on a line of its own.
    bool edges_on_own_line = false;
};

struct Counts {
    std::size_t vertices = 0, faces = 0;
    std::int64_t edges = 0;
};

// Reads the data after the counts in one way, to their end.
class OffTextReader {
  public:
    OffTextReader(TextReader text, const Counts& counts, OffLayout layout, const Reading& reading)
        : text_(text), counts_(counts), reading_(reading) {
        builder_.layout = layout;
        builder_.vertex_count = counts.vertices;
        builder_.face_count = counts.faces;
    }

    // `tick(fraction)` is called for each vertex and face. Errors: those of `read_off`, and
    // file_syntax if the data do not end with the last face.
    template <typename Tick>
    MeshData read(const Tick& tick) {
        if (reading_.edges_on_own_line) counts_.edges = text_.next_integer();
        text_.tally = {"vertices", 0, counts_.vertices};
        for (; text_.tally.found < counts_.vertices; ++text_.tally.found) {
            tick([&] { return text_.fraction(); });
            read_vertex();
        }
        text_.tally = {"faces", 0, counts_.faces};
        for (; text_.tally.found < counts_.faces; ++text_.tally.found) {
            tick([&] { return text_.fraction(); });
            read_face();
        }
        skip_edges();
        MeshData mesh = builder_.finish();
        skipped_.finish(mesh.report);
        return mesh;
    }

  private:
    void read_vertex() {
        if (!reading_.vertices_by_line) {
            return builder_.add_vertex(reading_.color_width, [&] { return text_.next_number(); });
        }
        if (text_.at_end()) refuse_truncated(text_.tally);
        builder_.add_vertex(reading_.color_width, [&] { return number_on_line(); });
        if (text_.at_line_end()) return;
        refuse(ErrorCode::file_syntax, "the vertex has more numbers than the first one",
               text_.place());
    }

    double number_on_line() {
        if (text_.at_line_end()) {
            TextReader ahead = text_;
            if (ahead.at_end()) refuse_truncated(text_.tally);
        }
        return text_.number();
    }

    void read_face() {
        const std::int64_t size = text_.next_integer();
        const FilePlace place = text_.place();
        if (size < 0 || (size == 0 && !reading_.vertices_by_line)) {
            refuse(ErrorCode::file_syntax, "a face has " + std::to_string(size) + " vertices",
                   place);
        }
        if (at(size) > text_.remaining()) refuse_truncated(text_.tally);
        builder_.face.clear();
        for (std::int64_t k = 0; k < size; ++k) {
            const std::int64_t index = text_.next_integer();
            builder_.face.push_back(builder_.vertices.checked(index, text_.place()));
        }
        if (reading_.face_colors) read_face_color();
        add_face(builder_.mesh.faces, builder_.face);
    }

    // A colour is the rest of the line.
    void read_face_color() {
        std::array<double, 4> color{};
        std::size_t width = 0;
        while (width < 4 && !text_.at_line_end()) color[width++] = text_.number();
        if (width == 0) return;
        if (width < 3) {
            skipped_.add("indices into a colour map");
        } else {
            builder_.face_colors.set(builder_.mesh.faces.size(), {color.data(), width});
        }
        if (text_.at_line_end()) return;
        refuse(ErrorCode::file_syntax, "a face has more numbers than vertices and a colour of 4",
               text_.place());
    }

    // Some programs write a line for each edge after the faces.
    void skip_edges() {
        if (text_.at_end()) return;
        const FilePlace place = text_.place();
        std::int64_t lines = 0;
        for (; !text_.at_end(); text_.skip_line()) ++lines;
        if (lines != counts_.edges) {
            refuse(ErrorCode::file_syntax,
                   "the file goes on after the last of the " + std::to_string(counts_.faces) +
                       " faces that its header announces; correct the counts there",
                   place);
        }
        skipped_.add("edges", lines);
    }

    TextReader text_;
    Counts counts_;
    Reading reading_;
    OffBuilder builder_;
    SkippedContent skipped_;
};

std::size_t read_count(TextReader& text, std::size_t file_bytes, std::string_view elements) {
    const std::int64_t count = text.next_integer();
    return checked_count(count, file_bytes, elements, text.place());
}

// How many numbers the next line has; more than `enough` are not counted.
std::size_t numbers_on_next_line(TextReader text, std::size_t enough) {
    if (text.at_end()) return 0;
    std::size_t count = 0;
    for (; count <= enough && !text.at_line_end(); ++count) text.number();
    return count;
}

// Returns the readings to try, in this order. The line of the first vertex tells how many values a
// colour has, three, four or none, for any keyword. If lines mean nothing, the keyword decides.
std::vector<Reading> possible_readings(OffLayout layout, std::size_t on_first_line,
                                       bool has_edge_count) {
    const std::size_t others = layout.numbers_without_color();
    std::vector<Reading> list;
    for (const bool face_colors : {true, false}) {
        const std::size_t rest = on_first_line - others;
        if (on_first_line >= others && (rest == 0 || rest == 3 || rest == 4)) {
            list.push_back({true, rest, face_colors, false});
        }
        for (const std::size_t width : {4, 3, 0}) {
            if (width == 0 || layout.colors) list.push_back({false, width, face_colors, false});
        }
    }
    const std::size_t without_edges = list.size();
    for (std::size_t i = 0; i < without_edges && !has_edge_count; ++i) {
        list.push_back(list[i]);
        list.back().edges_on_own_line = true;
    }
    return list;
}

bool concerns_content(const Error& error) {
    return error.code() != ErrorCode::cancelled && error.code() != ErrorCode::memory_limit;
}

// Returns the reason that a first line with this count of numbers is no vertex, if it is not.
std::optional<Error> first_line_error(OffLayout layout, std::size_t on_first_line,
                                      FilePlace place) {
    const std::size_t others = layout.numbers_without_color();
    const bool is_odd = on_first_line == others + 1 || on_first_line == others + 2;
    if (!is_odd) return std::nullopt;
    return Error(ErrorCode::file_syntax,
                 "the first vertex has " + std::to_string(on_first_line) + " numbers, but " +
                     std::to_string(others) + " and a colour of 3 or 4 were expected",
                 {place.kind, 1, {index_of(place.id)}});
}

}  // namespace

MeshData read_off_text(const TextReader& start, std::size_t file_bytes, OffLayout layout,
                       const Context& context) {
    Progress progress(context, "read OFF");
    Ticker ticker(progress);
    TextReader text = start;
    text.tally.elements = "counts";
    Counts counts;
    counts.vertices = read_count(text, file_bytes, "vertices");
    counts.faces = read_count(text, file_bytes, "faces");
    const bool has_edge_count = !text.at_line_end();
    if (has_edge_count) counts.edges = text.integer();

    std::size_t on_first_line = layout.numbers_without_color();
    if (counts.vertices > 0 && !text.at_end()) {
        on_first_line = numbers_on_next_line(text, on_first_line + 5);
    }
    std::optional<Error> first_error = first_line_error(layout, on_first_line, text.place());
    double left = 1.0;
    for (const Reading& reading : possible_readings(layout, on_first_line, has_edge_count)) {
        try {
            return OffTextReader(text, counts, layout, reading).read([&](const auto& fraction) {
                ticker.tick([&] { return 1.0 - left * (1.0 - 0.9 * fraction()); });
            });
        } catch (const Error& error) {
            if (!concerns_content(error)) throw;
            if (!first_error) first_error = error;
            left *= 0.1;
        }
    }
    throw Error(*first_error);
}

}  // namespace lissom
