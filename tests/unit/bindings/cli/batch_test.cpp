#include <doctest/doctest.h>

#include <fstream>

#include "bindings/cli/batch/digest.h"
#include "bindings/cli/batch/ledger.h"
#include "bindings/cli/batch/plan/axis.h"
#include "bindings/cli/batch/plan/output_name.h"
#include "bindings/cli/batch/plan/table.h"
#include "kernel/core/error.h"
#include "tests/unit/bindings/cli/program_run.h"

using lissom::Error;
using namespace lissom::cli;
using Values = std::vector<std::string>;

TEST_CASE("values of a sweep: lists, steps and counts") {
    CHECK(sweep_values("a,b,c") == Values{"a", "b", "c"});
    CHECK(sweep_values("a\\,b,c") == Values{"a,b", "c"});
    CHECK(sweep_values("5") == Values{"5"});
    CHECK(sweep_values("") == Values{""});
    CHECK(sweep_values("0:1:0.1") ==
          Values{"0", "0.1", "0.2", "0.3", "0.4", "0.5", "0.6", "0.7", "0.8", "0.9", "1"});
    CHECK(sweep_values("10:-10:-10") == Values{"10", "0", "-10"});
    CHECK(sweep_values("0:10:4") == Values{"0", "4", "8"});
    CHECK(sweep_values("0:90/4") == Values{"0", "30", "60", "90"});
    CHECK(sweep_values("-1:1/1") == Values{"-1"});
    CHECK(sweep_values("1:1:1") == Values{"1"});
    CHECK(sweep_values("1e-3:3e-3:1e-3") == Values{"0.001", "0.002", "0.003"});
    CHECK(sweep_values("C:/a:b") == Values{"C:/a:b"});
}

TEST_CASE("ranges without an end, or with too many values, are refused") {
    for (const char* text : {"0:1:0", "0:1:-1", "0:1/0", "0:1/2.5", "0:1:1e-9"}) {
        CAPTURE(text);
        CHECK_THROWS_AS(sweep_values(text), Error);
    }
    CHECK_THROWS_AS(sweep_axis("height"), Error);
    CHECK_THROWS_AS(sweep_axis("=1"), Error);
}

TEST_CASE("a table reads quotes, lines within values and any line ends") {
    const lissom::test::ProgramFolder folder;
    const Axis axis = table_axis(
        folder.write("t.csv", "\xef\xbb\xbfname,text\r\na,\"x, \"\"y\"\"\nz\"\r\n\r\nb,\r\n"));
    CHECK(axis.names == Values{"name", "text"});
    CHECK(axis.rows == std::vector<Values>{{"a", "x, \"y\"\nz"}, {"b", ""}});
    const Axis other = table_axis(
        folder.write("o.csv", "a; b ;\r\n 1;x,\ty;\r\n;;\r\n2;\" z \";\r\n\"\";\"\";\r\n"));
    CHECK(other.names == Values{"a", "b"});
    CHECK(other.rows == std::vector<Values>{{"1", "x,\ty"}, {"2", " z "}, {"", ""}});
    CHECK(other.lines == std::vector<int>{2, 4, 5});
    CHECK(table_axis(folder.write("t.tsv", "a\tb\n1\t\n")).rows == std::vector<Values>{{"1", ""}});
    for (const char* text : {"", "\n\n", "a,b\n", "\xff\xfex\n", "a\n\xfc\n", "a;\n1;2\n",
                             "a,\n1,2\n", "a,a\n1,2\n", "a,b\n1\n", "a\n\"1\n", "a\n\"1\"2\n"}) {
        CAPTURE(text);
        CHECK_THROWS_AS(table_axis(folder.write("bad.csv", text)), Error);
    }
}

TEST_CASE("an output's name is filled by values, which never lead to other folders") {
    const auto fill = [](const std::string& text, const std::string& value) {
        return OutputName(text).fill([&](const std::string&) { return value; }).string();
    };
    CHECK(fill("out/{a}.obj", "x y") == "out/x y.obj");
    CHECK(fill("out/{a}/{b}", "../x") == "out/.._x/.._x");
    CHECK(fill("out/{a}", "..") == "out/__");
    CHECK(fill("out/{a}", "") == "out/_");
    CHECK(fill("out/{dir}/x", "a/../../b") == "out/a/__/__/b/x");
    CHECK(fill("out/{dir}/x", "/etc") == "out/etc/x");
    CHECK(fill("{{{a}}}", "x") == "{x}");
    CHECK(OutputName("out/a{b}/{c}").placeholders() == Values{"b", "c"});
    CHECK(OutputName("out/a{b}/{c}").base() == "out");
    CHECK(OutputName("{b}").base() == ".");
    CHECK(OutputName("out/x.obj").base() == "out");
    for (const char* text : {"{a", "a}", "{a}}"}) CHECK_THROWS_AS(OutputName{text}, Error);
}

TEST_CASE("a record comes back from its line") {
    JobRecord record;
    record.output = "out/\xc3\xbc \"x\".obj";
    record.arguments = {{"height", "3"}, {"text", "a\nb"}};
    record.outcome = "done";
    record.seconds = 1.25;
    record.memory = std::uint64_t{1} << 40;
    record.time = 1700000000123;
    record.reads = {{"in.obj", 12, 1700000000123456789, 7, "0123"}};
    const JobRecord read = read_record(record_line(record));
    CHECK(read.output == record.output);
    CHECK(read.arguments == record.arguments);
    CHECK(read.is_done());
    CHECK(read.memory == record.memory);
    CHECK(read.reads.at(0).time == record.reads[0].time);
    CHECK(record_line(read) == record_line(record));
}

TEST_CASE("the last record of an output counts, and cut lines do not") {
    const lissom::test::ProgramFolder folder;
    JobRecord record;
    record.output = "a";
    record.outcome = "failed";
    record.time = 2;
    const std::string later = record_line(record);
    record.outcome = "done";
    record.time = 1;
    folder.write("results/1.jsonl", later + "\n" + later.substr(0, 30));
    folder.write("results/2.jsonl", record_line(record) + "\n[]\n");
    const Ledger ledger(folder.path("results"));
    REQUIRE(ledger.find("a"));
    CHECK(ledger.find("a")->outcome == "failed");
    CHECK(ledger.records().size() == 1);
    CHECK(Ledger(folder.path("none")).records().empty());
}

TEST_CASE("a file that is known by its size, time and inode is not read again") {
    const lissom::test::ProgramFolder folder;
    const std::string file = folder.write("a", "content");
    FileDigests digests;
    const FileStamp stamp = digests.stamp(file);
    CHECK(stamp.digest == text_digest("content"));
    CHECK(digests.stamp(folder.path("none")).digest.empty());
    FileStamp planted = stamp;
    planted.digest = "planted";
    FileDigests knowing;
    knowing.know(planted);
    CHECK(knowing.stamp(file).digest == "planted");
    folder.write("a", "other content");
    CHECK(knowing.stamp(file).digest == text_digest("other content"));
}
