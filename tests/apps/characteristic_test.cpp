// The command `strutt characteristic`: columns, JSON, files, exit codes.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "io/scratch.hpp"
#include "support/program.hpp"

namespace strutt::test::characteristic_test {
namespace {

using Words = std::vector<std::string>;

Result characteristic(const std::string& order, const std::string& q, const Words& more = {}) {
  Words words{"characteristic", "--order", order, "--q", q};
  words.insert(words.end(), more.begin(), more.end());
  return strutt(words);
}

double number(const std::string& text) { return std::strtod(text.c_str(), nullptr); }

}  // namespace

TEST_CASE("characteristic writes the rows of the contract", "[apps][characteristic]") {
  const Result result = characteristic("0:2", "5,-5");
  CHECK(result.code == 0);
  const auto rows = csv_rows(result.out);
  REQUIRE(rows.size() == 7);
  CHECK(rows[0] == Words{"order", "q", "a", "b", "a_error", "b_error"});
  CHECK(csv_comment(result.out, "units") == "1,1,1,1,1,1");
  CHECK(number(rows[1][2]) == Approx(-5.80004602085150841910347).epsilon(1e-15));
  for (const std::size_t zero : {1, 4}) {
    CHECK(rows[zero][0] == "0");
    CHECK(rows[zero][3].empty());
    CHECK(number(rows[zero][4]) > 0.0);
  }
  // a_1 = 1.85818754, b_1 = -5.79008060 at q = 5 (Abramowitz & Stegun table 20.1); the letters change at -5
  CHECK(number(rows[2][2]) == Approx(1.85818754).epsilon(1e-8));
  CHECK(number(rows[2][3]) == Approx(-5.79008060).epsilon(1e-8));
  CHECK(rows[5][1] == "-5");
  CHECK(number(rows[5][2]) == Approx(-5.79008060).epsilon(1e-8));
  CHECK(number(rows[5][3]) == Approx(1.85818754).epsilon(1e-8));
}

TEST_CASE("characteristic writes JSON, with null for b_0, and files", "[apps][characteristic]") {
  const ScratchDirectory directory;
  const std::string file = (directory.path() / "values.json").string();
  CHECK(characteristic("0:1", "0", {"--json", "-o", file}).code == 0);
  const auto json = nlohmann::json::parse(std::ifstream(file));
  CHECK(json["schema_version"] == 1);
  CHECK(json["provenance"]["method"] == "fourier");
  REQUIRE(json["rows"].size() == 2);
  CHECK(json["rows"][0]["b"].is_null());
  CHECK(json["rows"][0]["b_error"].is_null());
  CHECK(json["rows"][0]["a"] == 0);
  CHECK(json["rows"][1]["a"] == 1);
  CHECK(json["rows"][1]["order"] == 1);
}

TEST_CASE("characteristic has the same rows with any number of threads",
          "[apps][characteristic][extreme][N48]") {
  const auto one = characteristic("0:300", "7,1e6", {"--threads", "1"});
  CHECK(csv_rows(one.out).size() == 603);
  CHECK(csv_rows(one.out) == csv_rows(characteristic("0:300", "7,1e6", {"--threads", "2"}).out));
}

TEST_CASE("characteristic names the flag that is wrong, and its range", "[apps][characteristic]") {
  const auto refused = [](const Result& result, const std::string& flag, const std::string& range) {
    CHECK(result.code == 2);
    CHECK(result.out.empty());
    CHECK_THAT(result.err, Catch::Matchers::Contains(flag) && Catch::Matchers::Contains(range));
  };
  for (const char* q : {"1.0000001e8", "-2e8", "5,1e9"}) refused(characteristic("0:3", q), "--q", "1e8");
  for (const char* q : {"nan", "inf", "x", "", "5,"}) refused(characteristic("0:3", q), "--q", "number");
  refused(characteristic("0:3", "1 m"), "--q", "m");
  for (const char* order : {"3:2", "0:10001", "10001:10002", "-1:3", "3", "a:b", "0:1:2"})
    refused(characteristic(order, "1"), "--order", "10000");
  refused(characteristic("0:3", "1", {"--tolerance", "1e-9"}), "--tolerance", "full double precision");
  refused(characteristic("0:3", "1", {"--method", "cvode"}), "--method", "fourier");
  refused(strutt({"characteristic", "--q", "1"}), "--order", "");
  CHECK(characteristic("0:3", "1", {"--method", "fourier"}).code == 0);
  CHECK(characteristic("0:3", "1", {"-o", "/nowhere/at/all.csv"}).code == 5);
}

TEST_CASE("characteristic tells its plan without computing", "[apps][characteristic]") {
  const Result result = characteristic("0:10000", "1e8", {"--dry-run"});
  CHECK(result.code == 0);
  CHECK_THAT(result.out, Catch::Matchers::Contains("rows: 10001") && Catch::Matchers::Contains("2 q cos 2t"));
}

}  // namespace strutt::test::characteristic_test
