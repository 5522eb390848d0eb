// What keys do to a line, and the file of the history.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "bindings/cli/terminal/edited_line.h"
#include "bindings/cli/terminal/history.h"
#include "bindings/cli/terminal/keys.h"
#include "tests/unit/bindings/program_run.h"

namespace lissom::cli {
namespace {

std::vector<KeyPress> keys_of(const std::string& bytes) {
    std::vector<KeyPress> keys;
    std::size_t at = 0;
    while (at < bytes.size()) {
        const char first = bytes[at++];
        keys.push_back(read_key(first, [&]() -> std::optional<char> {
            if (at == bytes.size()) return std::nullopt;
            return bytes[at++];
        }));
    }
    return keys;
}

Key key_of(const std::string& bytes) {
    const std::vector<KeyPress> keys = keys_of(bytes);
    CHECK(keys.size() == 1);
    return keys.front().key;
}

EditedLine line_at(const std::string& text, std::size_t cursor) {
    EditedLine line;
    line.replace(text);
    while (line.cursor() > cursor) line.left();
    return line;
}

TEST_CASE("keys: controls, sequences and characters") {
    CHECK(key_of("\x01") == Key::begin);
    CHECK(key_of("\r") == Key::enter);
    CHECK(key_of("\x7f") == Key::erase_before);
    CHECK(key_of("\x1b[A") == Key::older);
    CHECK(key_of("\x1bOB") == Key::newer);
    CHECK(key_of("\x1b[3~") == Key::erase_after);
    CHECK(key_of("\x1b[1;5C") == Key::word_right);
    CHECK(key_of("\x1b[4711;9x") == Key::none);
    CHECK(key_of("\x1b"
                 "b") == Key::word_left);
    CHECK(key_of("\x1b") == Key::leave);
    CHECK(key_of("\x1c") == Key::none);
    const auto keys = keys_of("a\xc3\xa4\xf0\x9f\x98\x80\xff");
    REQUIRE(keys.size() == 4);
    CHECK(keys[0].text == "a");
    CHECK(keys[1].text == "\xc3\xa4");
    CHECK(keys[2].text == "\xf0\x9f\x98\x80");
    CHECK(keys[3].text == "\xff");
}

TEST_CASE("cells: wide characters take two, combining ones none, bad bytes one") {
    CHECK(cells_of("") == 0);
    CHECK(cells_of("plain") == 5);
    CHECK(cells_of("\xc3\xa4") == 1);
    CHECK(cells_of("a\xcc\x88") == 1);
    CHECK(cells_of("\xe6\xbc\xa2") == 2);
    CHECK(cells_of("\xf0\x9f\x98\x80") == 2);
    CHECK(cells_of("\xff\xc3") == 2);
}

TEST_CASE("line: characters are moved over and erased whole, with what combines with them") {
    EditedLine line = line_at("xa\xcc\x88\xe6\xbc\xa2", 100);
    line.left();
    CHECK(line.before() == "xa\xcc\x88");
    line.erase_before();
    CHECK(line.text() == "x\xe6\xbc\xa2");
    line.erase_after();
    CHECK(line.text() == "x");
    line.erase_after();
    line.left();
    line.left();
    line.erase_before();
    CHECK(line.text() == "x");
}

TEST_CASE("line: words are cut, put back and exchanged") {
    EditedLine line = line_at("mesh:save(name)", 9);
    line.cut_word_before();
    CHECK(line.text() == "mesh:(name)");
    line.to_end();
    line.paste();
    CHECK(line.text() == "mesh:(name)save");
    line.word_left();
    line.word_left();
    CHECK(line.before() == "mesh:(");
    line.cut_word_after();
    CHECK(line.text() == "mesh:()save");
    line.cut_to_end();
    line.cut_to_begin();
    CHECK(line.text().empty());
    line.paste();
    CHECK(line.text() == "mesh:(");
    line.transpose();
    CHECK(line.text() == "mesh(:");
    line.to_begin();
    line.transpose();
    CHECK(line.text() == "mesh(:");
}

TEST_CASE("line: any keys leave the cursor between characters of the text") {
    std::mt19937 random(5);
    const std::vector<std::string> pieces = {
        "a", " ", "\xc3\xa4", "\xcc\x88", "\xe6\xbc\xa2", "\xff", "\xc3", "(", "\xf0\x9f\x98\x80"};
    EditedLine line;
    for (int i = 0; i < 20000; ++i) {
        switch (random() % 14) {
            case 0:
                line.left();
                break;
            case 1:
                line.right();
                break;
            case 2:
                line.to_begin();
                break;
            case 3:
                line.to_end();
                break;
            case 4:
                line.word_left();
                break;
            case 5:
                line.word_right();
                break;
            case 6:
                line.erase_before();
                break;
            case 7:
                line.erase_after();
                break;
            case 8:
                line.transpose();
                break;
            case 9:
                line.cut_word_before();
                break;
            case 10:
                line.cut_word_after();
                break;
            case 11:
                line.paste();
                break;
            default:
                line.insert(pieces[random() % pieces.size()]);
        }
        REQUIRE(line.cursor() <= line.text().size());
        if (line.text().size() > 200) line.cut_to_end();
    }
}

TEST_CASE("history: lines are kept in a file, once each in a row, the last thousand") {
    const test::ProgramFolder folder;
    const std::filesystem::path file = folder.path("deep/state/history");
    {
        History history(file);
        history.add("one");
        history.add("one");
        history.add("");
        history.add("two");
        CHECK(history.size() == 2);
        CHECK(history.find("n", history.size()) == 0);
        CHECK(history.find("o", 1) == 0);
        CHECK_FALSE(history.find("three", history.size()).has_value());
    }
    std::ofstream(file, std::ios::app) << "of another program\n";
    History again(file);
    REQUIRE(again.size() == 3);
    CHECK(again.line(2) == "of another program");
    for (int i = 0; i < 1500; ++i) again.add(std::to_string(i));
    CHECK(again.size() == 1000);
    again.shorten_file();
    History shortened(file);
    CHECK(shortened.size() == 1000);
    CHECK(shortened.line(999) == "1499");
    CHECK(History(std::filesystem::path()).size() == 0);
}

}  // namespace
}  // namespace lissom::cli
