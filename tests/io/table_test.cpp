#include "strutt/io/table.hpp"

#include <catch2/catch.hpp>
#include <clocale>
#include <cmath>
#include <limits>

#include "io/scratch.hpp"

namespace strutt::test::table_test {

namespace {

using test::message_of;
using test::ScratchDirectory;

const TableSchema kSchema{.required = {"alpha"}, .optional = {"beta", "gamma"}};

NumericTable read(const std::string& content) {
  const ScratchDirectory directory;
  return read_table(directory.with("in.csv", content), kSchema);
}

/// The message without the directory before "in.csv".
std::string complaint(const std::string& content) {
  const auto message = message_of<FileError>([&] { read(content); });
  const auto at = message.find("in.csv");
  return at == std::string::npos ? message : message.substr(at);
}

double number(const std::string& text) {
  double value = 0.0;
  INFO(text);
  REQUIRE(parse_number(text, value));
  return value;
}

bool is_refused(const std::string& text) {
  double value = 0.0;
  return !parse_number(text, value);
}

}  // namespace

TEST_CASE("a plain table is read with the lines of its rows", "[io][table]") {
  const auto table = read("# a comment, with, commas\nalpha,beta\n1,-2.5e-3\n# another\n3,4\n");
  CHECK(table.columns == std::vector<std::string>{"alpha", "beta"});
  CHECK(table.rows == std::vector<std::vector<double>>{{1, -2.5e-3}, {3, 4}});
  CHECK(table.lines == std::vector<int>{3, 5});
  CHECK(table.cell_columns == std::vector<int>{1, 3, 1, 3});
  CHECK(table.column("beta") == 1);
  CHECK(message_of<FileError>([&] { (void)table.column("gamma"); }).find("'alpha', 'beta'") !=
        std::string::npos);
}

TEST_CASE("a complaint about a cell names its place", "[io][table]") {
  const auto table = read("alpha,beta\n1,2\n\t3 , 14\n");
  CHECK(std::string(table.error_at(0, 1, "too large").what()).ends_with("in.csv:2:3: too large"));
  CHECK(std::string(table.error_at(1, 0, "too large").what()).ends_with("in.csv:3:2: too large"));
  CHECK(std::string(table.error_at(1, 1, "too large").what()).ends_with("in.csv:3:6: too large"));
}

TEST_CASE("harmless varieties of CSV mean the same", "[io][table]") {
  const std::vector<std::vector<double>> expected{{1, 2}, {3, 4}};
  const std::string content =
      GENERATE("alpha,beta\n1,2\n3,4", "alpha,beta\r\n1,2\r\n3,4\r\n",
               "\xEF\xBB\xBF"
               "alpha,beta\n1,2\n3,4\n",
               "alpha,beta\n1,2\n3,4\n\n", "alpha,beta\r\n1,2\r\n3,4\r\n\r\n",
               "\xEF\xBB\xBF# units: m,s\r\nalpha,beta\r\n1,2\r\n3,4", "alpha [m],beta [rad/s]\n1,2\n3,4\n",
               "alpha, beta\n 1,\t2 \n3, 4\n", "alpha,beta\n1.,2.0\n+3,04\n");
  CHECK(read(content).rows == expected);
}

TEST_CASE("a unit in the header converts the column", "[io][table]") {
  const ScratchDirectory directory;
  const TableSchema schema{.required = {"length"}, .optional = {"label"}, .units = {{"length", "m"}}};
  const auto rows = [&](const std::string& text) {
    return read_table(directory.with("t.csv", text), schema).rows;
  };
  using Rows = std::vector<std::vector<double>>;
  CHECK(rows("length [cm],label [anything]\n7,7\n") == Rows{{0.07, 7.0}});  // correctly rounded, not 7 * 0.01
  CHECK(rows("length[ mm ]\n1e3\n") == Rows{{1.0}});
  CHECK(rows("length [m]\n7\n") == Rows{{7.0}});
  CHECK(rows("length []\n7\n") == Rows{{7.0}});
  const auto refusal = [&](const std::string& text) { return message_of<FileError>([&] { rows(text); }); };
  CHECK_THAT(refusal("label,length [s]\n1,2\n"), Catch::Matchers::Contains("t.csv:1:7: column 'length': ") &&
                                                     Catch::Matchers::Contains("wrong dimension"));
  CHECK_THAT(refusal("length [km]\n1\n1e308\n"),
             Catch::Matchers::Contains("t.csv:3:1: ") && Catch::Matchers::Contains("beyond the range"));
  CHECK_THAT(refusal("length [cm]\n7 cm\n"), Catch::Matchers::Contains("t.csv:2:1: '7 cm'"));
}

TEST_CASE("what is wrong in a table is named with file, line and column", "[io][table][F3]") {
  CHECK(complaint("alpha,beta\n1\n") == "in.csv:2:1: this row has 1 cells, the header 2");
  CHECK(complaint("alpha,beta\n1,2\n1,2,3\n") == "in.csv:3:5: this row has 3 cells, the header 2");
  CHECK(complaint("alpha,bta\n1,2\n") == "in.csv:1:7: unknown column 'bta'; did you mean 'beta'?");
  CHECK(complaint("alpha,x\n1,2\n") == "in.csv:1:7: unknown column 'x'; known are 'alpha', 'beta', 'gamma'");
  CHECK(complaint("beta\n1\n") == "in.csv:1:1: the column 'alpha' is missing; the columns are 'beta'");
  CHECK(complaint("alpha,beta,alpha\n1,2,3\n") ==
        "in.csv:1:12: the column 'alpha' stands here a second time");
  CHECK(complaint("alpha,beta\n1,\n") == "in.csv:2:3: empty cell in column 'beta'");
  CHECK(complaint("alpha,,beta\n1,2,3\n") == "in.csv:1:7: a column has no name");
  CHECK(complaint("alpha\n1\n\n2\n") == "in.csv:3:1: blank line inside the table");
  CHECK(complaint("alpha\n\"1\"\n") == "in.csv:2:1: quotation marks are not allowed");
  CHECK(complaint("alpha\n") == "in.csv:1: there are no rows below the header");
  CHECK(complaint("") == "in.csv:1:1: the file is empty: a line with column names is missing");
  CHECK(complaint("# nothing\n") == "in.csv:1:1: the file is empty: a line with column names is missing");
  CHECK(complaint("alpha,beta\n1,5,2\n") == "in.csv:2:5: this row has 3 cells, the header 2");
}

TEST_CASE("cells that are no finite decimal numbers are refused", "[io][table][F3]") {
  const std::string cell =
      GENERATE("nan", "NaN", "-nan", "inf", "-Infinity", "1e999", "-1e400", "0x1p3", "0x10", "1;5", "1e",
               "e5", ".", "-", "1.2.3", "1 2", "1_000", "1.0f", "٣", "--1", "1e5.0");
  INFO(cell);
  const auto message = complaint("beta,alpha\n7," + cell + "\n");
  CHECK(message.starts_with("in.csv:2:3: '"));
  CHECK(message.find("in column 'alpha' is not a finite decimal number in the range of double") !=
        std::string::npos);
}

TEST_CASE("bytes that are no text are refused where they stand", "[io][table][F3]") {
  CHECK(complaint(std::string("alpha\n1\0\n", 9)) == "in.csv:2:2: the control character 0x00 is not allowed");
  CHECK(complaint("alpha\n1\xff\n") == "in.csv:2:2: the byte 0xFF is not part of valid UTF-8");
  CHECK(complaint("# caf\xe9\nalpha\n1\n") == "in.csv:1:6: the byte 0xE9 is not part of valid UTF-8");
  CHECK(complaint("alpha\r1\r") == "in.csv:1:6: the control character 0x0D is not allowed");
  CHECK(complaint(std::string("\xff\xfe"
                              "a\0",
                              4))
            .starts_with("in.csv:1:1: the byte 0xFF"));
  CHECK(complaint("al\x1b[31mpha\n1\n").starts_with("in.csv:1:3: the control character 0x1B"));
}

TEST_CASE("a million columns and a line without end stop early", "[io][table][F3]") {
  std::string columns = "alpha";
  for (int i = 0; i < 1'000'000; ++i) columns += ",x";
  CHECK(complaint(columns + "\n1\n").starts_with("in.csv:1:7: unknown column 'x'"));
  CHECK(complaint(std::string((1 << 24) + 100'000, 'x'))
            .starts_with("in.csv:1:1: the line is longer than 16 MiB"));
}

TEST_CASE("a table that cannot be read is an input/output error", "[io][table]") {
  const ScratchDirectory directory;
  CHECK_THROWS_AS(read_table(directory / "missing.csv", kSchema), InputOutputError);
  CHECK_THROWS_AS(read_table(directory.path(), kSchema), InputOutputError);
}

TEST_CASE("odd bytes in file names are escaped in messages", "[io][table][F5]") {
  const ScratchDirectory directory;
  const auto path = directory.with("a\n\x1b[31m\xff.csv", "beta\n1\n");
  const auto message = message_of<FileError>([&] { read_table(path, kSchema); });
  CHECK(message.find("a\\x0A\\x1B[31m\\xFF.csv:1:1:") != std::string::npos);
}

TEST_CASE("decimals of any length are correctly rounded", "[io][table][number]") {
  // Half way between 1 and its successor, then a hair above and below.
  const std::string half = "1.00000000000000011102230246251565404236316680908203125";
  CHECK(number(half) == 1.0);
  CHECK(number(half + std::string(300, '0') + "1") == std::nextafter(1.0, 2.0));
  CHECK(number("1.0000000000000001110223024625156540423631668090820312" + std::string(300, '4')) == 1.0);
  CHECK(number("0." + std::string(1000, '3')) == 1.0 / 3.0);
  CHECK(number(std::string(300, '9')) == 1e300);
  CHECK(number("0." + std::string(400, '0') + "1e401") == 1.0);
  CHECK(number("1" + std::string(400, '0') + "e-400") == 1.0);
  CHECK(number("1" + std::string(1'000'000, '0') + "e-1000000") == 1.0);
}

TEST_CASE("the ends of the range of double", "[io][table][number]") {
  CHECK(number("1.7976931348623157e308") == std::numeric_limits<double>::max());
  CHECK(is_refused("1.7976931348623159e308"));
  CHECK(is_refused("1e99999999999999999999"));
  CHECK(number("5e-324") == std::numeric_limits<double>::denorm_min());
  CHECK(number("3e-324") == std::numeric_limits<double>::denorm_min());
  CHECK(number("2e-324") == 0.0);
  CHECK(number("2.2250738585072011e-308") < std::numeric_limits<double>::min());
  CHECK(number("1e-99999999999999999999") == 0.0);
  CHECK(number("0e99999999999999999999") == 0.0);
  CHECK(std::signbit(number("-0")));
  CHECK(std::signbit(number("-1e-400")));
  CHECK(is_refused(""));
  CHECK(is_refused("+"));
  CHECK(is_refused("+-1"));
}

TEST_CASE("the decimal point does not depend on the locale", "[io][table][number][F4]") {
  const std::string old = std::setlocale(LC_ALL, nullptr);
  bool any = false;
  for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "tr_TR.UTF-8"}) {
    if (std::setlocale(LC_ALL, name) == nullptr) continue;
    any = true;
    CHECK(number("0.5") == 0.5);
    CHECK(number("1.25e2") == 125.0);
    CHECK(is_refused("0,5"));
    CHECK(to_text(0.5) == "0.5");
  }
  std::setlocale(LC_ALL, old.c_str());
  if (!any) WARN("no locale with a decimal comma is installed");
}

}  // namespace strutt::test::table_test
