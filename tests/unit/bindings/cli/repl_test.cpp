// lissom repl as a person meets it: on a terminal.
#include <doctest/doctest.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "bindings/cli/terminal/line_editor.h"
#include "tests/unit/bindings/cli/program_run.h"

#ifdef __linux__
#include <poll.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

namespace lissom::cli {
namespace {

using Folder = test::ProgramFolder;

// Run by Terminal: a fresh process has none of the threads that tests before it have started.
TEST_CASE("a prompt for other tests" * doctest::skip()) {
    std::string name = "lissom", verb = "repl";
    char* argv[] = {name.data(), verb.data(), nullptr};
    std::exit(run_program(2, argv, kernel_parts()));
}

// The program in a process of its own behind a terminal.
class Terminal {
  public:
    explicit Terminal(const Folder& folder) {
        process_ = forkpty(&terminal_, nullptr, nullptr, nullptr);
        if (process_ != 0) return;
        setenv("LISSOM_HISTORY", folder.path("state/history").c_str(), 1);
        setenv("TERM", "dumb", 1);
        execl("/proc/self/exe", "test", "--test-case=a prompt for other tests", "--no-skip",
              nullptr);
        _exit(kFailure);
    }
    Terminal(const Terminal&) = delete;
    Terminal& operator=(const Terminal&) = delete;
    ~Terminal() {
        if (process_ > 0) {
            kill(process_, SIGKILL);
            waitpid(process_, nullptr, 0);
        }
        close(terminal_);
    }

    void type(const std::string& keys) const {
        CHECK(write(terminal_, keys.data(), keys.size()) == static_cast<ssize_t>(keys.size()));
    }

    // Waits until `text` was written behind what was waited for before.
    void wait_for(const std::string& text) {
        constexpr int kMilliseconds = 10000;
        std::size_t at;
        while ((at = seen_.find(text)) == std::string::npos) {
            pollfd output{terminal_, POLLIN, 0};
            char piece[1000];
            if (poll(&output, 1, kMilliseconds) <= 0) break;
            const ssize_t size = read(terminal_, piece, sizeof piece);
            if (size <= 0) break;
            seen_.append(piece, static_cast<std::size_t>(size));
        }
        CHECK_MESSAGE(at != std::string::npos, text, " in ", seen_);
        if (at != std::string::npos) seen_.erase(0, at + text.size());
    }

    // Waits for the next prompt: keys that come before it meet the terminal's own editing of lines.
    void wait_for_prompt() { wait_for("\n> "); }

    // The exit status after Ctrl-D at the next prompt; -1 where the program goes on.
    int end() {
        wait_for_prompt();
        type("\x04");
        wait_for("\n");
        int status = -1;
        for (int i = 0; i < 100 && waitpid(process_, &status, WNOHANG) == 0; ++i) usleep(100000);
        if (!WIFEXITED(status)) return -1;
        process_ = 0;
        return WEXITSTATUS(status);
    }

  private:
    int terminal_ = -1;
    std::string seen_;
    pid_t process_ = 0;
};

TEST_CASE("Ctrl-C clears the line and nothing else") {
    const Folder folder;
    Terminal terminal(folder);
    terminal.wait_for_prompt();
    terminal.type("kept = 41\n");
    terminal.wait_for_prompt();
    for (int i = 0; i < 3; ++i) {
        terminal.type("kept = 'lost");
        terminal.wait_for("lost");
        terminal.type("\x03");
        terminal.wait_for("^C\r\n> ");
    }
    terminal.type("for i = 1, 2 do\n");
    terminal.wait_for(">> ");
    terminal.type("\x03");
    terminal.wait_for("^C\r\n> ");
    terminal.type("kept + 1\n");
    terminal.wait_for("\n42");
    CHECK(terminal.end() == 0);
}

TEST_CASE("Ctrl-C stops what runs, and the prompt comes back") {
    const Folder folder;
    Terminal terminal(folder);
    terminal.wait_for_prompt();
    terminal.type("while true do end\n");
    terminal.wait_for("end\r\n");
    usleep(100000);
    terminal.type("\x03");
    terminal.wait_for("cancelled");
    terminal.wait_for_prompt();
    terminal.type("6 * 7\n");
    terminal.wait_for("\n42");
    CHECK(terminal.end() == 0);
}

TEST_CASE("Tab completes, and lines come back from the file of the history") {
    const Folder folder;
    {
        Terminal terminal(folder);
        terminal.wait_for_prompt();
        terminal.type("b = lissom.shapes.bo\t{ si\t2 }\n");
        terminal.wait_for_prompt();
        terminal.type("b:vertex_c\t()\n");
        terminal.wait_for("\n8");
        CHECK(terminal.end() == 0);
    }
    std::ifstream file(folder.path("state/history"));
    std::ostringstream lines;
    lines << file.rdbuf();
    CHECK(lines.str() == "b = lissom.shapes.box{ size = 2 }\nb:vertex_count()\n");
    Terminal terminal(folder);
    terminal.wait_for_prompt();
    terminal.type("b = lissom.shapes.box()\n");
    terminal.wait_for_prompt();
    terminal.type("\x10\x10\n");
    terminal.wait_for("\n8");
    CHECK(terminal.end() == 0);
}

TEST_CASE("a line is edited where the cursor is") {
    const Folder folder;
    Terminal terminal(folder);
    terminal.wait_for_prompt();
    // Left before the 2, a digit, to the end; Home and a name; a word cut and put back twice.
    terminal.type("12\x1b[D3\x05 + 4\n");
    terminal.wait_for("\n136");
    terminal.wait_for_prompt();
    terminal.type("= 5\x1b[Hvalue \n");
    terminal.wait_for_prompt();
    terminal.type("value * 10\x17\x19\x19\n");
    terminal.wait_for("\n5050");
    terminal.wait_for_prompt();
    // Characters are erased whole.
    terminal.type("#'\xc3\xa4\xe6\xbc\xa2\x7f\x7f'\n");
    terminal.wait_for("\n0");
    CHECK(terminal.end() == 0);
}

TEST_CASE("Tab lists what there is, and completes names of files in strings") {
    const Folder folder;
    std::ofstream(folder.path("only_one.txt")) << "here";
    Terminal terminal(folder);
    terminal.wait_for_prompt();
    terminal.type("lissom.shapes.b\t\x15");
    terminal.wait_for("bar");
    terminal.wait_for("box");
    terminal.type("io.open('" + folder.path("") + "/only\t'):read()\n");
    terminal.wait_for("here");
    CHECK(terminal.end() == 0);
}

TEST_CASE("Ctrl-R finds a line by a part of it, Ctrl-G goes back") {
    const Folder folder;
    Terminal terminal(folder);
    terminal.wait_for_prompt();
    terminal.type("10 + 1\n10 + 2\n20 + 3\n");
    terminal.wait_for("\n23");
    terminal.wait_for_prompt();
    terminal.type(
        "\x12"
        "10\x12\n");
    terminal.wait_for("\n11");
    terminal.wait_for_prompt();
    terminal.type(
        "70\x12"
        "20 +\x07 + 7\n");
    terminal.wait_for("\n77");
    terminal.wait_for_prompt();
    // The line that was begun is there below the last of the history.
    terminal.type("90\x1b[A\x1b[A\x1b[B\x1b[B + 9\n");
    terminal.wait_for("\n99");
    CHECK(terminal.end() == 0);
}

}  // namespace
}  // namespace lissom::cli
#endif

namespace lissom::cli {
namespace {

test::Ended typed(const std::string& lines) {
    std::istringstream input(lines);
    std::streambuf* const old = std::cin.rdbuf(input.rdbuf());
    const test::Ended ended = test::run_program({"repl"});
    std::cin.rdbuf(old);
    return ended;
}

TEST_CASE("help answers for functions, objects and names") {
    CHECK(typed("help(lissom.load)\n").out.find("lissom.load(path, [{...}])\n") == 0);
    CHECK(typed("m = lissom.shapes.box()\nhelp(m.save)\n").out.find("mesh:save(") == 0);
    CHECK(typed("m = lissom.shapes.box()\nhelp(m)\n").out.find("lissom.Mesh\n") == 0);
    CHECK(typed("help('save')\n").out.find("mesh:save(") != std::string::npos);
    CHECK(typed("help('sav')\n").out.find("did you mean 'save'?") != std::string::npos);
    CHECK(typed("help()\n").out.find("lissom.shapes.cactus") != std::string::npos);
    CHECK(test::run_program({"help", "save"}).out.find("mesh:save(") != std::string::npos);
    CHECK(test::run_program({"help", "sav"}).err.find("did you mean 'save'?") != std::string::npos);
    CHECK(test::run_program({"help", "sav"}).status == kUsage);
}

TEST_CASE("results are shown with their content") {
    CHECK(typed("{ a = 1 }\n").out == "{ a = 1 }\n");
    CHECK(typed("1, 'x', nil\n").out == "1\tx\tnil\n");
    CHECK(typed("lissom.load('none.obj')\n")
              .err.find("none.obj: there is no such file [file_not_found]") != std::string::npos);
    CHECK(typed("lissom.load('none.obj')\n").status == kFailure);
}

}  // namespace
}  // namespace lissom::cli
