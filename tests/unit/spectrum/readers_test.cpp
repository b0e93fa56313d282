// Files of spectra as instruments and spreadsheets write them, and what is said about those that are wrong.
#include "base/error.h"
#include "base/files.h"
#include "spectrum/readers/reader.h"
#include "support/temporary_folder.h"

#include <catch2/catch.hpp>

using namespace spectrad;
using Values = std::vector<double>;

TEST_CASE("A CSV file has head lines, column names and rows") {
    const SpectrumTable t = readCsv(
        "# title: Two paints\n#unit: 1\n# just words\nwavelength_nm,red,\"Patch, "
        "7\"\n400,0.1,0.2\n\n500,0.3,4e-1\n",
        "a.csv");
    CHECK(t.head.at("title") == "Two paints");
    CHECK(t.head.at("unit") == "1");
    CHECK(t.head.size() == 2);
    CHECK(t.header == std::vector<std::string>{"red", "Patch, 7"});
    CHECK(t.nm == Values{400, 500});
    CHECK(t.columns[0] == Values{0.1, 0.3});
    CHECK(t.columns[1] == Values{0.2, 0.4});
}

TEST_CASE("A CSV file needs no header, and its columns then have numbers for names") {
    const SpectrumTable t = readCsv("400,0.1,1\n500,0.3,2\n", "a.csv");
    CHECK(t.header == std::vector<std::string>{"column 2", "column 3"});
    CHECK(t.columns[1] == Values{1, 2});
}

TEST_CASE("With semicolons a comma is a decimal comma") {
    const SpectrumTable t = readCsv("nm;Wert\n400,5;0,25\n500;0.5\n", "a.csv");
    CHECK(t.nm == Values{400.5, 500});
    CHECK(t.columns[0] == Values{0.25, 0.5});
}

TEST_CASE("Byte-order marks, foreign line ends, Latin-1 and empty trailing cells do no harm") {
    CHECK(readCsv("\xef\xbb\xbfnm,v\r\n400,1\r\n500,2\r\n", "a.csv").columns[0] == Values{1, 2});
    CHECK(readCsv("nm,v\r400,1\r500,2", "a.csv").columns[0] == Values{1, 2});
    CHECK(readCsv("nm,gr\xfcn\n400,1\n", "a.csv").header[0] == "gr\u00fcn");
    CHECK(readCsv("nm,gr\xc3\xbcn\n400,1\n", "a.csv").header[0] == "gr\u00fcn");
    CHECK(readCsv("nm,v,,\n400,1,,\n500,2,,\n", "a.csv").columns.size() == 1);
}

TEST_CASE("Rows in any order are sorted by wavelength") {
    const SpectrumTable t = readCsv("700,3\n400,1\n550,2\n", "a.csv");
    CHECK(t.nm == Values{400, 550, 700});
    CHECK(t.columns[0] == Values{1, 2, 3});
}

TEST_CASE("Columns are separated by blanks or tabs, with comments and perhaps decimal commas") {
    const SpectrumTable t = readColumns("# source: my lamp\n400 1.5  # first\n\t500\t2,5\n", "a.spd");
    CHECK(t.head.at("source") == "my lamp");
    CHECK(t.nm == Values{400, 500});
    CHECK(t.columns[0] == Values{1.5, 2.5});
    CHECK(readColumns("nm\tPatch 7\tb\n400\t1\t2\n", "a.txt").header ==
          std::vector<std::string>{"Patch 7", "b"});
    CHECK(readColumns("nm a b\n400 1 2\n", "a.txt").header == std::vector<std::string>{"a", "b"});
}

TEST_CASE("Pairs are nm:value with blanks between") {
    const SpectrumTable t = readPairs(" 400:0.10\n500:-2.5e-1\t700:.3 ", {});
    CHECK(t.nm == Values{400, 500, 700});
    CHECK(t.columns[0] == Values{0.1, -0.25, 0.3});
}

TEST_CASE("A damaged row is an error that names file, line and column") {
    CHECK_THROWS_WITH(readCsv("nm,v\n400,1\n500,\n", "a.csv"), "a.csv:3: column 2 ('v') is empty");
    CHECK_THROWS_WITH(readCsv("nm,v\n400,1\n500,x\n", "a.csv"),
                      "a.csv:3: column 2 ('v') is 'x', not a number");
    CHECK_THROWS_WITH(readCsv("nm,v\n400,1\n500,NaN\n", "a.csv"),
                      "a.csv:3: column 2 ('v') is 'NaN', not a finite number");
    CHECK_THROWS_WITH(readCsv("400,-inf\n", "a.csv"), "a.csv:1: column 2 is '-inf', not a finite number");
    CHECK_THROWS_WITH(readCsv("400,1\n500,#N/A\n", "a.csv"),
                      "a.csv:2: column 2 is '#N/A', not a finite number");
    CHECK_THROWS_WITH(readCsv("400,1\n500,1e400\n", "a.csv"), "a.csv:2: column 2 is '1e400', not a number");
    CHECK_THROWS_WITH(readCsv("400,1\n500,1,2\n", "a.csv"),
                      "a.csv:2: has 3 values where the rows above have 2");
    CHECK_THROWS_WITH(readCsv("nm,a,b\n500,1\n", "a.csv"),
                      "a.csv:2: has 2 values where the rows above have 3");
    CHECK_THROWS_WITH(readCsv("400,1\n500,2\n400.0,3\n", "a.csv"),
                      "a.csv:3: 400 nm stands in line 1 already");
    CHECK_THROWS_WITH(readCsv("0,1\n", "a.csv"), "a.csv:1: wavelength 0 nm (allowed: above 0)");
    CHECK_THROWS_WITH(readColumns("400\n", "a.txt"),
                      "a.txt:1: has one value (a spectrum needs a wavelength and a value in every row)");
    CHECK_THROWS_WITH(readColumns("400 1\n500 abc\n", "a.txt"), "a.txt:2: column 2 is 'abc', not a number");
}

TEST_CASE("A table that holds no spectrum says so") {
    CHECK_THROWS_WITH(readCsv("nm,v\n", "a.csv"), "a.csv: holds no rows of numbers");
    CHECK_THROWS_WITH(readCsv("nm\n400\n", "a.csv"),
                      "a.csv:1: the header names one column, 'nm' (a spectrum needs wavelengths and values)");
    CHECK_THROWS_WITH(readCsv("wavelength_um,n\n0.4,1.5\n", "a.csv"),
                      "a.csv:1: the first column 'wavelength_um' is in um (allowed: wavelengths in nm)");
    CHECK_THROWS_WITH(readCsv("0.38,1\n0.78,2\n", "a.csv"),
                      "a.csv: wavelengths from 0.38 to 0.78: these look like micrometres (allowed: nm)");
    CHECK_THROWS_WITH(readCsv("\xff\xfe"
                              "4\0",
                              "a.csv"),
                      "a.csv: is UTF-16 text; save it as UTF-8");
}

TEST_CASE("Pairs that are none are refused in words") {
    const SourceLocation at{"s.xml", 3, 7};
    const std::string how = "(allowed: pairs of finite numbers with blanks between, as in 400:0.1 700:0.3)";
    CHECK_THROWS_WITH(readPairs("400:0.1 500", at), "s.xml:3:7: '500' is not a pair nm:value " + how);
    CHECK_THROWS_WITH(readPairs("400:nan", at), "s.xml:3:7: '400:nan' is not a pair nm:value " + how);
    CHECK_THROWS_WITH(readPairs("400:1:2", at), "s.xml:3:7: '400:1:2' is not a pair nm:value " + how);
    CHECK_THROWS_WITH(readPairs("400:1 400:2", at), "s.xml:3:7: two values at 400 nm");
    CHECK_THROWS_WITH(readPairs("500:1 400:2", at),
                      "s.xml:3:7: wavelengths must ascend, but 400 nm follows 500 nm");
    CHECK_THROWS_WITH(readPairs("-1:1", at), "s.xml:3:7: wavelength -1 nm (allowed: above 0)");
    CHECK_THROWS_WITH(readPairs("", at), "s.xml:3:7: no pairs nm:value (allowed: as in 400:0.1 700:0.3)");
}

TEST_CASE("A file is read by its content, whatever its extension says") {
    const TemporaryFolder folder;
    const auto read = [&](const std::string& name, const std::string& text) {
        writeFile(folder.path() / name, text);
        return readTable(folder.path() / name);
    };
    CHECK(read("a.csv", "nm,v\n400,1\n").columns[0] == Values{1});
    CHECK(read("b.csv", "nm\tv\n400\t1\n").columns[0] == Values{1});
    CHECK(read("c.txt", "nm;v\n400;0,5\n").columns[0] == Values{0.5});
    CHECK(read("d.txt", "400, 1\n500, 2\n").columns[0] == Values{1, 2});
    CHECK(read("e.txt", "400 0,5\n").columns[0] == Values{0.5});
    CHECK(read("f.dat", "nm old,blue new\n400 1 2\n").columns.size() == 2);
    CHECK(read("g", "400 1\n").columns[0] == Values{1});
}

TEST_CASE("A file of another kind is named for what it is") {
    const TemporaryFolder folder;
    const std::string formats = " (allowed: text of comma-separated values or columns: .csv, .spd, .txt)";
    const auto path = [&](const std::string& name, const std::string& text) {
        writeFile(folder.path() / name, text);
        return folder.path() / name;
    };
    const auto message = [&](const std::filesystem::path& p, const std::string& rest) {
        return p.string() + ": " + rest;
    };
    auto p = path("a.exr", "\x76\x2f\x31\x01xx");
    CHECK_THROWS_WITH(readTable(p), message(p, "is an OpenEXR image, not a table of spectra" + formats));
    p = path("a.xlsx", "PK\x03\x04zz");
    CHECK_THROWS_WITH(readTable(p),
                      message(p, "is a zip archive or spreadsheet, not a table of spectra" + formats));
    p = path("a.xml", "<scene/>");
    CHECK_THROWS_WITH(readTable(p), message(p, "is XML or HTML, not a table of spectra" + formats));
    p = path("a.bin", std::string("ab\0cd", 5));
    CHECK_THROWS_WITH(readTable(p), message(p, "is a binary file" + formats));
    p = path("a.md", "hello world\n");
    CHECK_THROWS_WITH(readTable(p), message(p, "is not a table of spectra" + formats));
    p = path("a.csv", "");
    CHECK_THROWS_WITH(readTable(p), message(p, "holds no rows of numbers"));
    p = path("b.csv", "hello\n");
    CHECK_THROWS_AS(readTable(p), InputError);
    CHECK_THROWS_AS(readTable(folder.path() / "absent.csv"), InputError);
    CHECK_THROWS_AS(readTable(folder.path()), InputError);
}
