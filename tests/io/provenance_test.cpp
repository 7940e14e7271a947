#include "strutt/io/provenance.hpp"

#include <stdlib.h>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <optional>

namespace strutt::test::provenance_test {

namespace {

std::string value_of(const Provenance& provenance, const std::string& name) {
  for (const auto& [key, value] : provenance) {
    if (key == name) return value;
  }
  return "(missing)";
}

class Environment {
 public:
  Environment(const char* name, const char* value) : name_(name) {
    if (const char* old = ::getenv(name)) old_ = old;
    ::setenv(name, value, 1);
  }
  ~Environment() {
    if (old_)
      ::setenv(name_, old_->c_str(), 1);
    else
      ::unsetenv(name_);
  }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  const char* name_;
  std::optional<std::string> old_;
};

}  // namespace

TEST_CASE("provenance names program, libraries and command", "[io][provenance]") {
  const auto provenance = make_provenance("strutt chart scene.toml");
  CHECK(value_of(provenance, "program") == "strutt");
  CHECK(value_of(provenance, "command") == "strutt chart scene.toml");
  CHECK(value_of(provenance, "libraries").find("SUNDIALS 6.") != std::string::npos);
  CHECK(value_of(make_provenance(), "command") == "(missing)");
  CHECK(version_text().find("Eigen 3.4.0") != std::string::npos);
}

TEST_CASE("the date is that of SOURCE_DATE_EPOCH", "[io][provenance]") {
  const Environment epoch("SOURCE_DATE_EPOCH", "1000000000");
  CHECK(value_of(make_provenance(), "date") == "2001-09-09T01:46:40Z");
}

TEST_CASE("a date beyond 2106 and a malformed SOURCE_DATE_EPOCH", "[io][provenance][F17]") {
  {
    const Environment epoch("SOURCE_DATE_EPOCH", "5000000000");
    CHECK(value_of(make_provenance(), "date") == "2128-06-11T08:53:20Z");
  }
  const Environment epoch("SOURCE_DATE_EPOCH", "yesterday");
  CHECK(value_of(make_provenance(), "date").size() == 20);
}

TEST_CASE("values of several lines stay comments, escape codes do not reach the terminal",
          "[io][provenance][F6]") {
  const std::string text =
      comment_lines({{"scene", "[hill]\nperiod = 1.0\n"}, {"command", "strutt \x1b[31m"}});
  CHECK(text == "# scene: [hill]\n#   period = 1.0\n# command: strutt \\x1B[31m\n");
}

TEST_CASE("provenance as JSON keeps its order and survives odd bytes", "[io][provenance][F5]") {
  const auto text = json_text({{"b", "1\n2"}, {"a", "\xff"}});
  const auto json = nlohmann::ordered_json::parse(text);
  CHECK(json.begin().key() == "b");
  CHECK(json["b"] == "1\n2");
  CHECK(json["a"] == "\xEF\xBF\xBD");
}

}  // namespace strutt::test::provenance_test
