// The command `strutt normal-form`: columns, JSON, exit codes.
#include <array>
#include <catch2/catch.hpp>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "io/scratch.hpp"
#include "support/paths.hpp"

namespace strutt::test::normal_form_test {

namespace {

struct Answer {
  int code = -1;
  std::string out;
};

/// Runs `strutt normal-form --points FILE`, the file holding `points`.
Answer normal_form(const std::string& points, const std::string& flags = "") {
  const strutt::test::ScratchDirectory directory;
  const std::string command = strutt::test::program_path() + " normal-form --points " +
                              directory.with("points.csv", points).string() + " " + flags + " 2>&1";
  FILE* const pipe = ::popen(command.c_str(), "r");
  REQUIRE(pipe != nullptr);
  Answer answer;
  std::array<char, 4096> buffer{};
  while (const std::size_t read = std::fread(buffer.data(), 1, buffer.size(), pipe))
    answer.out.append(buffer.data(), read);
  answer.code = ::pclose(pipe) >> 8;
  return answer;
}

/// CSV text without comments.
std::string data(const std::string& text) {
  std::string result;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (!line.starts_with('#')) result += line + "\n";
  return result;
}

}  // namespace

TEST_CASE("normal-form adds delta and beta to its input", "[apps][free_pendulum]") {
  // Van der Pol, the pendulum at alpha = 3, and a term nobody gave.
  const Answer answer = normal_form("f2_21,alpha,f2_30\n-0.5,1,0\n0,3,0.5\n0,2,0\n");
  CHECK(answer.code == 0);
  CHECK(data(answer.out) ==
        "f2_21,alpha,f2_30,delta,beta\n-0.5,1,0,-0.0625,0\n0,3,0.5,0,-0.1875\n0,2,0,0,0\n");
  CHECK_THAT(answer.out, Catch::Matchers::Contains("# units: 1,1,1,1,1\n"));
}

TEST_CASE("every column of the contract reaches its coefficient", "[apps][free_pendulum]") {
  // Powers of ten keep the cubic terms apart: 8 delta = 3 f1_30 + f2_21 + f1_12 + 3 f2_03, likewise beta.
  const Answer answer = normal_form(
      "alpha,f1_20,f1_11,f1_02,f1_30,f1_21,f1_12,f1_03,f2_20,f2_11,f2_02,f2_30,f2_21,f2_12,f2_03\n"
      "1,0,0,0,8,80,800,8000,0,0,0,80000,800000,8000000,80000000\n"
      "1,2,0,0,0,0,0,0,12,0,0,0,0,0,0\n1,0,0,2,0,0,0,0,0,0,12,0,0,0,0\n1,2,12,0,0,0,0,0,0,0,0,0,0,0,0\n"
      "1,0,0,0,0,0,0,0,12,2,0,0,0,0,0\n",
      "--json");
  REQUIRE(answer.code == 0);
  const auto rows = nlohmann::json::parse(answer.out)["rows"];
  REQUIRE(rows.size() == 5);
  const std::array<double, 5> delta{3 + 100000 + 100 + 30000000, 6, -6, -3, 3};
  const std::array<double, 5> beta{-(30000 - 10 + 1000000 - 3000), -(16 + 1440) / 24.0, -(40 + 576) / 24.0,
                                   -(16 + 144) / 24.0, -(4 + 1440) / 24.0};
  for (std::size_t i = 0; i < 5; ++i) {
    CHECK(rows[i]["delta"].get<double>() == Approx(delta[i]).epsilon(1e-14));
    CHECK(rows[i]["beta"].get<double>() == Approx(beta[i]).epsilon(1e-14));
  }
}

TEST_CASE("normal-form ends with the code of the contract", "[apps][free_pendulum]") {
  const auto ends = [](const Answer& answer, int code, const std::string& says) {
    CHECK(answer.code == code);
    CHECK_THAT(answer.out, Catch::Matchers::Contains(says));
  };
  ends(normal_form("alpha\n1\n", "--tolerance 1e-9"), 2, "--tolerance");
  ends(normal_form("alpha\n1\n", "--method exact"), 2, "--method");
  ends(normal_form("alpha\n1\n0\n"), 3, ":3:1: alpha = 0");
  ends(normal_form("f2_30\n1\n"), 3, "alpha");
  ends(normal_form("alpha,f2_31\n1,1\n"), 3, "f2_31");
  ends(normal_form("alpha,f2_30\n1,nan\n"), 3, ":2:");
  ends(normal_form("alpha,f2_20\n1,1e200\n"), 1, "-inf");
}

}  // namespace strutt::test::normal_form_test
